//! What a wall is: planes, segments, arcs and triangles, at rest or driven at a constant velocity.
use crate::codec::{Codec, Hash, Reader};
use crate::meet::{self, Arc, Path};
use crate::vector::Exact;
use crate::{Coefficient, Error, MaterialId, Rotates, Vector};
use alloc::vec::Vec;

/// A wall of a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct WallId {
    pub(crate) index: u32,
    pub(crate) generation: u32,
}

impl WallId {
    /// The place of the wall in the world. A world's boundary comes after its walls.
    pub fn index(self) -> usize {
        self.index as usize
    }
}

/// The shape of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape<const D: usize> {
    /// A half-space: balls live on the side of the unit normal.
    Plane {
        /// A point of its surface (m).
        point: Vector<D>,
        /// Unit normal.
        normal: Vector<D>,
    },
    /// A thin two-sided segment with its end points.
    Segment {
        /// One end (m).
        from: Vector<D>,
        /// The other (m).
        to: Vector<D>,
    },
    /// A thin two-sided arc of a circle, in the plane.
    Arc(Arc<D>),
    /// A thin two-sided triangle with its edges and corners, in space.
    Triangle([Vector<D>; 3]),
}

impl<const D: usize> Codec for Shape<D>
where
    Vector<D>: Rotates,
{
    fn layout(hash: &mut Hash) {
        hash.add(b"Shape");
        Arc::<D>::layout(hash);
    }
    fn write(&self, to: &mut Vec<u8>) {
        match *self {
            Self::Plane { point, normal } => (0u8, point, normal).write(to),
            Self::Segment { from, to: end } => (1u8, from, end).write(to),
            Self::Arc(arc) => (2u8, arc).write(to),
            Self::Triangle(corners) => (3u8, corners).write(to),
        }
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        Some(match u8::read(from)? {
            0 => Self::Plane { point: Codec::read(from)?, normal: Codec::read(from)? },
            1 => Self::Segment { from: Codec::read(from)?, to: Codec::read(from)? },
            2 => Self::Arc(Codec::read(from)?),
            3 => Self::Triangle(Codec::read(from)?),
            _ => return None,
        })
    }
}

/// A wall: nothing can move it, and if it is driven it keeps its velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall<const D: usize> {
    /// Its shape, where it is at the time it is added.
    pub shape: Shape<D>,
    /// Its velocity (m/s).
    pub velocity: Vector<D>,
    /// Its material.
    pub material: MaterialId,
    /// What this wall alone says of its surface, in place of what its material says.
    pub restitution: Option<Coefficient>,
}

impl<const D: usize> Wall<D> {
    fn new(shape: Shape<D>) -> Self {
        Self { shape, velocity: Vector::ZERO, material: MaterialId::default(), restitution: None }
    }

    /// A half-space through `point` with balls on the side of `normal` (any length but 0).
    pub fn plane(point: impl Into<Vector<D>>, normal: impl Into<Vector<D>>) -> Self {
        let normal: Vector<D> = normal.into();
        // What has no direction stays as it is, and is refused by `check`.
        Self::new(Shape::Plane { point: point.into(), normal: normal.unit().unwrap_or(normal) })
    }

    /// A thin segment from one point to another (m), in the plane.
    pub fn segment(from: impl Into<Vector<D>>, to: impl Into<Vector<D>>) -> Self {
        Self::new(Shape::Segment { from: from.into(), to: to.into() })
    }

    /// A thin arc, counter-clockwise from the angle `from` to the angle `to` (rad, from +x), in the plane.
    pub fn arc(centre: impl Into<Vector<D>>, radius: f64, from: f64, to: f64) -> Self {
        Self::new(Shape::Arc(Arc::new(centre.into(), radius, from, to)))
    }

    /// A thin triangle, in space.
    pub fn triangle(a: impl Into<Vector<D>>, b: impl Into<Vector<D>>, c: impl Into<Vector<D>>) -> Self {
        Self::new(Shape::Triangle([a.into(), b.into(), c.into()]))
    }

    /// Driven at this velocity (m/s).
    pub fn moving(self, velocity: impl Into<Vector<D>>) -> Self {
        Self { velocity: velocity.into(), ..self }
    }

    /// Of this material.
    pub fn material(self, material: MaterialId) -> Self {
        Self { material, ..self }
    }

    /// With this coefficient of restitution, whatever its material says.
    pub fn restitution(self, e: impl Into<Coefficient>) -> Self {
        Self { restitution: Some(e.into()), ..self }
    }

    /// True if the wall could be added to a world.
    ///
    /// # Errors
    /// The first rule it breaks: finite numbers, a normal that is not zero, a shape of this dimension, e in [0, 1].
    pub fn check(&self) -> Result<(), Error> {
        let finite = |points: &[Vector<D>]| points.iter().all(|p| p.is_finite());
        match &self.shape {
            Shape::Plane { point, normal } => {
                if !finite(&[*point, *normal]) {
                    return Err(Error::NotFinite("plane"));
                }
                if !(normal.norm_squared() > 0.5) {
                    return Err(Error::ZeroVector("normal"));
                }
            }
            Shape::Segment { from, to } => {
                if D != 2 {
                    return Err(Error::WrongDimension("a segment is a wall of the plane: dim must be 2"));
                }
                if !finite(&[*from, *to]) {
                    return Err(Error::NotFinite("segment"));
                }
                if from == to {
                    return Err(Error::ZeroVector("segment"));
                }
            }
            Shape::Arc(arc) => {
                if D != 2 {
                    return Err(Error::WrongDimension("an arc is a wall of the plane: dim must be 2"));
                }
                let (from, to) = arc.angles();
                if !arc.centre().is_finite() || !arc.radius().is_finite() || !from.is_finite() || !to.is_finite() {
                    return Err(Error::NotFinite("arc"));
                }
                if !(arc.radius() > 0.0) {
                    return Err(Error::NotPositive("radius"));
                }
                if !(to > from) {
                    return Err(Error::OutOfRange(
                        "an arc runs counter-clockwise: its `to` must be larger than its `from`",
                    ));
                }
            }
            Shape::Triangle(corners) => {
                if D != 3 {
                    return Err(Error::WrongDimension("a triangle is a wall of space: dim must be 3"));
                }
                if !finite(corners) {
                    return Err(Error::NotFinite("triangle"));
                }
            }
        }
        if !self.velocity.is_finite() {
            return Err(Error::NotFinite("velocity"));
        }
        if !self.restitution.as_ref().is_none_or(|e| e.is_valid(0.0, 1.0)) {
            return Err(Error::OutOfRange("restitution must lie in [0, 1]"));
        }
        Ok(())
    }
}

/// Where a ball's centre lies over a wall: the vector to the wall's nearest point, and the gap to the ball's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Over<const D: usize> {
    /// From the centre towards the wall, along the normal of contact; its length is not promised.
    pub towards: Vector<D>,
    /// The distance of the ball's surface from the wall (m); negative where they overlap.
    pub gap: f64,
    /// The nearest point of the wall (m).
    pub point: Vector<D>,
}

impl<const D: usize> Shape<D> {
    /// When a ball of `radius` whose centre moves on `path` (relative to the wall) meets the wall; infinite if never.
    pub fn meets(&self, path: &Path<D>, radius: f64) -> f64 {
        match self {
            Self::Plane { point, normal } => meet::plane(
                (path.position - *point).dot(*normal),
                path.velocity.dot(*normal),
                path.acceleration.dot(*normal),
                radius,
            ),
            Self::Segment { from, to } => meet::segment(path, *from, *to, radius),
            Self::Arc(arc) => meet::arc(path, arc, radius),
            Self::Triangle(corners) => meet::triangle(path, *corners, radius),
        }
    }

    /// Where a ball of `radius` with its centre at `x` lies over the wall.
    pub fn over(&self, x: Vector<D>, radius: f64) -> Over<D> {
        let nearest = match self {
            Self::Plane { point, normal } => {
                let height = (x - *point).dot(*normal);
                return Over { towards: -*normal, gap: height - radius, point: x - *normal * height };
            }
            Self::Segment { from, to } => meet::nearest_on_segment(x, *from, *to),
            Self::Arc(arc) => meet::nearest_on_arc(x, arc),
            Self::Triangle(corners) => meet::nearest_on_triangle(x, *corners),
        };
        let towards = nearest - x;
        let distance = towards.norm();
        // A centre on the wall itself has no side; any direction will do, for the overlap is beyond mending anyway.
        let towards = if distance > 0.0 { towards } else { Vector::axis(D - 1) };
        Over { towards, gap: distance - radius, point: nearest }
    }

    /// How far along a ray from `origin` in the unit `direction` it crosses the wall; infinite if it does not. A plane is crossed
    /// from the side of its normal only.
    pub(crate) fn crossed_by(&self, origin: Vector<D>, direction: Vector<D>) -> f64 {
        /// A crossing belongs to an arc or a triangle if it lies within this part of the wall's size of it.
        const ON: f64 = 1e-9;
        let first = |a: f64, b: f64| if b < a { b } else { a };
        match self {
            Self::Plane { point, normal } => {
                let (height, speed) = ((origin - *point).dot(*normal), direction.dot(*normal));
                if height >= 0.0 && speed < 0.0 { height / -speed } else { f64::INFINITY }
            }
            Self::Segment { from, to } => {
                // origin + t direction = from + s along: the areas give t and s.
                let (along, d) = (*to - *from, origin - *from);
                let area = |a: Vector<D>, b: Vector<D>| if D == 2 { a[0] * b[1] - a[1] * b[0] } else { f64::NAN };
                let slope = area(along, direction);
                let (distance, part) = (area(along, d) / -slope, area(direction, d) / -slope);
                if distance >= 0.0 && (0.0..=1.0).contains(&part) { distance } else { f64::INFINITY }
            }
            Self::Arc(arc) => {
                let d = origin - arc.centre();
                let half = d.dot(direction);
                let across = (d - direction * half).norm();
                let square = (arc.radius() - across) * (arc.radius() + across);
                if !(square >= 0.0) {
                    return f64::INFINITY;
                }
                let on = |t: f64| {
                    let p = origin + direction * t;
                    let hits = t >= 0.0 && (meet::nearest_on_arc(p, arc) - p).norm() <= ON * arc.radius();
                    if hits { t } else { f64::INFINITY }
                };
                first(on(-half - square.sqrt_()), on(-half + square.sqrt_()))
            }
            Self::Triangle(corners) => {
                let (edge, other) = (corners[1] - corners[0], corners[2] - corners[0]);
                // What of the ray lies across the triangle: less its parts along two directions in the triangle's plane.
                let second = other - edge * (other.dot(edge) / edge.norm_squared());
                let normal = direction
                    - edge * (direction.dot(edge) / edge.norm_squared())
                    - second * (direction.dot(second) / second.norm_squared());
                let t = (corners[0] - origin).dot(normal) / direction.dot(normal);
                let p = origin + direction * t;
                let size = edge.norm() + other.norm();
                let hits = t >= 0.0 && (meet::nearest_on_triangle(p, *corners) - p).norm() <= ON * size;
                if hits { t } else { f64::INFINITY }
            }
        }
    }

    /// True if a ball of `radius` at `x` touches, or lies nearest to, the inside of an arc that bends towards it.
    pub(crate) fn curves_in(&self, x: Vector<D>, radius: f64) -> bool {
        self.hollow(x, radius).is_some()
    }

    /// For a ball of `radius` at `x` inside an arc: the arc's centre, and how far from it the ball's centre may be (m).
    pub(crate) fn hollow(&self, x: Vector<D>, radius: f64) -> Option<(Vector<D>, f64)> {
        let Self::Arc(arc) = self else { return None };
        let towards = meet::nearest_on_arc(x, arc) - x;
        let out = x - arc.centre();
        let (limit, distance) = (arc.radius() - radius, out.norm());
        // Inside if the nearest point lies beyond the ball's centre, seen from the arc's.
        let beyond = towards.dot(out) >= (1.0 - 1e-12) * distance * towards.norm();
        (limit > 0.0 && distance < arc.radius() && beyond).then_some((arc.centre(), limit))
    }

    /// The shape, somewhere else.
    pub(crate) fn shifted(&self, by: Vector<D>) -> Self {
        match self {
            Self::Plane { point, normal } => Self::Plane { point: *point + by, normal: *normal },
            Self::Segment { from, to } => Self::Segment { from: *from + by, to: *to + by },
            Self::Arc(arc) => Self::Arc(Arc::new(arc.centre() + by, arc.radius(), arc.angles().0, arc.angles().1)),
            Self::Triangle(corners) => Self::Triangle(corners.map(|c| c + by)),
        }
    }

    /// The smallest box around the wall; `None` for a plane, which has none.
    pub(crate) fn bounds(&self) -> Option<(Vector<D>, Vector<D>)> {
        let around = |points: &[Vector<D>]| {
            let (mut low, mut high) = (points[0], points[0]);
            for p in points {
                for k in 0..D {
                    low[k] = if p[k] < low[k] { p[k] } else { low[k] };
                    high[k] = if p[k] > high[k] { p[k] } else { high[k] };
                }
            }
            (low, high)
        };
        match self {
            Self::Plane { .. } => None,
            Self::Segment { from, to } => Some(around(&[*from, *to])),
            Self::Arc(arc) => {
                let reach = Vector::from_fn(|_| arc.radius());
                Some((arc.centre() - reach, arc.centre() + reach))
            }
            Self::Triangle(corners) => Some(around(corners)),
        }
    }
}
