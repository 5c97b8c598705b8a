//! A ball and a thin triangle: its face, its edges, its corners.
use super::path::Path;
use super::plane::closing;
use super::radial::{ANY, Radial};
use super::segment::{Edge, Reading, bounds, corner, earlier, near, nearest_on_segment, segment};
use super::windows::Windows;
use crate::Vector;
use crate::vector::Rotates;

/// When a ball meets the triangle between three points (m): thin, met from both sides, with its edges and corners, which may
/// come in any order. `path` is that of the centre relative to the same origin as the corners, `radius` (m) has to be positive.
///
/// # Accuracy
/// The error of t times the closing speed is a few units in the last place of the distances along the way, from the path's
/// start to the corners included; for a face, times its longest edge over its height. A sliver whose face rounding turns by
/// more than it bulges between its edges is taken as its three edges. The face is a quadratic, edges and corners are
/// quartics; with no acceleration all are closed forms. Source: THEORY 5.1, 5.3.
pub fn triangle<const D: usize>(path: &Path<D>, corners: [Vector<D>; 3], radius: f64) -> f64 {
    if !(radius >= 0.0) || !path.is_finite() || !corners.iter().all(|c| c.is_finite()) {
        return f64::INFINITY;
    }
    let (low, high) = bounds(corners);
    if near(path, low, high, radius).are_empty() {
        return f64::INFINITY;
    }
    let Some(sides) = Sides::new(corners, radius) else {
        return (0..3)
            .fold(f64::INFINITY, |first, k| earlier(first, segment(path, corners[k], corners[(k + 1) % 3], radius)));
    };
    // Every part reads its motion from its own corner, and what two parts share they read alike.
    let from = corners.map(|corner| Path { position: path.position - corner, ..*path });
    let outside: [Reading; 3] =
        core::array::from_fn(|k| Reading::new(&from[k], sides.outward[k], sides.slender, Vector::ZERO));
    let after_start: [Reading; 3] = core::array::from_fn(|k| sides.edges[k].after_start(&from[k]));
    let before_end: [Reading; 3] = core::array::from_fn(|k| sides.edges[k].before_end(&from[k]));

    let mut first = f64::INFINITY;
    let over_face = outside.iter().fold(Windows::ALWAYS, |over, side| over.and(&side.negated().not_negative()));
    if !over_face.are_empty() {
        first = earlier(first, sides.closing(&from[0], radius).and(&over_face).first());
    }
    for k in 0..3 {
        let past_start = after_start[k].not_negative();
        let over_edge = past_start.and(&before_end[k].not_negative()).and(&outside[k].not_negative());
        if !over_edge.are_empty() {
            first = earlier(first, sides.edges[k].closing(&from[k], radius).and(&over_edge).first());
        }
        let not_past_start = after_start[k].negated().not_negative();
        let over_corner = not_past_start.and(&before_end[(k + 2) % 3].negated().not_negative());
        first = earlier(first, corner(&from[k], Vector::ZERO, radius, &over_corner));
    }
    first
}

/// The point of the triangle that is nearest to `point` (m).
pub fn nearest_on_triangle<const D: usize>(point: Vector<D>, corners: [Vector<D>; 3]) -> Vector<D> {
    let mut nearest = corners[0];
    let mut distance = f64::INFINITY;
    for k in 0..3 {
        let candidate = nearest_on_segment(point, corners[k], corners[(k + 1) % 3]);
        let from_point = (point - candidate).norm();
        if from_point < distance {
            (nearest, distance) = (candidate, from_point);
        }
    }
    match Sides::new(corners, distance) {
        Some(sides) if (0..3).all(|k| (point - corners[k]).dot(sides.outward[k]) <= 0.0) => {
            point - sides.off(point - corners[0])
        }
        _ => nearest,
    }
}

/// A triangle that has a face.
struct Sides<const D: usize> {
    edges: [Edge<D>; 3],
    /// The unit vectors in its plane that point out of its edges.
    outward: [Vector<D>; 3],
    /// Its unit normal; zero unless it lies in space.
    normal: Vector<D>,
    /// Its longest edge over its height: by so much more than a number do its directions round.
    slender: f64,
}

impl<const D: usize> Sides<D> {
    /// `None` if the edges alone are the better triangle for a ball of this radius.
    fn new(corners: [Vector<D>; 3], radius: f64) -> Option<Self> {
        let edges: [Edge<D>; 3] = core::array::from_fn(|k| Edge::new(corners[(k + 1) % 3] - corners[k]));
        let longest = Vector(core::array::from_fn::<f64, 3, _>(|k| edges[k].length)).largest();
        let mut outward = [Vector::ZERO; 3];
        let mut height = f64::INFINITY;
        for k in 0..3 {
            let along = edges[k].along.unit()?;
            // The opposite corner, seen from the nearer end.
            let (before, after) = (&edges[(k + 2) % 3], &edges[(k + 1) % 3]);
            let to_opposite = if before.length < after.length { -before.along } else { after.along };
            let inward = to_opposite - along * to_opposite.dot(along);
            height = earlier(height, inward.norm());
            outward[k] = -inward.unit()?;
        }
        // Without its face it lacks a bulge of h^2 / (8 r); rounding turns its face by eps L / h, and the far end by L times that.
        if !(height * height * height > 32.0 * f64::EPSILON * longest * longest * radius) {
            return None;
        }
        // The normal is best from the two shorter edges.
        let k = (0..3).find(|&k| edges[k].length >= longest)?;
        let normal = normal(edges[(k + 1) % 3].along, edges[(k + 2) % 3].along)?;
        Some(Self { edges, outward, normal, slender: longest / height })
    }

    /// The part of a vector that is perpendicular to the plane.
    fn off(&self, v: Vector<D>) -> Vector<D> {
        match D {
            0..=2 => Vector::ZERO,
            3 => self.normal * v.dot(self.normal),
            _ => {
                let along = self.edges[0].along / self.edges[0].length;
                v - along * v.dot(along) - self.outward[0] * v.dot(self.outward[0])
            }
        }
    }

    /// When the path closes in on the plane. In the plane itself nothing does: there the triangle is full.
    fn closing(&self, path: &Path<D>, radius: f64) -> Windows {
        let (x, v, a) = (path.position, path.velocity, path.acceleration);
        match D {
            0..=2 => Windows::NEVER,
            3 => closing(x.dot(self.normal), v.dot(self.normal), a.dot(self.normal), radius),
            _ => Radial::new(&Path { position: self.off(x), velocity: self.off(v), acceleration: self.off(a) })
                .falls(radius, ANY),
        }
    }
}

/// The unit normal of two vectors in space, zero elsewhere; `None` if they are parallel.
fn normal<const D: usize>(a: Vector<D>, b: Vector<D>) -> Option<Vector<D>> {
    if D != 3 {
        return Some(Vector::ZERO);
    }
    let product = Vector::<3>::moment(Vector([a[0], a[1], a[2]]), Vector([b[0], b[1], b[2]])).unit()?;
    Some(Vector::from_fn(|k| product[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEVER: f64 = f64::INFINITY;
    const CORNERS: [Vector<3>; 3] = [Vector([0.0, 0.0, 0.0]), Vector([8.0, 0.0, 0.0]), Vector([0.0, 8.0, 0.0])];

    fn meet(x: [f64; 3], v: [f64; 3], radius: f64) -> f64 {
        triangle(&Path::new(x, v, [0.0; 3]), CORNERS, radius)
    }

    fn close(found: f64, expected: f64) {
        assert!(found == expected || (found - expected).abs() < 4e-15, "{found} is not {expected}");
    }

    #[test]
    fn face_edges_and_corners() {
        for side in [1.0, -1.0] {
            let down = |x, y| meet([x, y, 9.0 * side], [0.0, 0.0, -2.0 * side], 1.0);
            close(down(2.0, 2.0), 4.0);
            close(down(4.0, 4.0), 4.0); // on an edge
            close(down(0.0, 0.0), 4.0); // on the corners
            close(down(8.0, 0.0), 4.0);
            close(down(0.0, 8.0), 4.0);
            close(down(4.0, -0.6), 4.1); // beside an edge, 3-4-5
            close(down(-0.6, 4.0), 4.1);
            close(down(4.0 + 0.3 * 2.0_f64.sqrt(), 4.0 + 0.3 * 2.0_f64.sqrt()), 4.1);
            close(down(8.6, 0.0), 4.1); // beside a corner
            close(down(0.0, -0.6), 4.1);
            close(down(-0.36, -0.48), 4.1);
            close(down(-1.1, 4.0), NEVER);
            close(down(-0.8, -0.8), NEVER);
        }
        close(meet([4.0, -9.0, 0.0], [0.0, 1.0, 0.0], 1.0), 8.0); // onto an edge, in the plane
        close(meet([-9.0, 0.0, 0.0], [1.0, 0.0, 0.0], 1.0), 8.0); // onto a corner
        close(meet([2.0, 2.0, 1.0], [1.0, 0.0, -1.0], 1.0), 0.0);
        close(meet([2.0, 2.0, 1.0_f64.next_down()], [1.0, 0.0, 1.0], 1.0), NEVER);
        // Overlapping the face, parting from it and heading over the edge at a low angle: still parting.
        close(meet([2.0, 0.1, 0.9], [0.0, -5.0, 0.2], 1.0), NEVER);
    }

    #[test]
    fn the_next_bounce_is_2v_over_g() {
        let path = |x: [f64; 2], v: [f64; 3]| Path::new([x[0], x[1], 1.0_f64.next_down()], v, [0.0, 0.0, -8.0]);
        close(triangle(&path([2.0, 2.0], [0.0, 0.0, 4.0]), CORNERS, 1.0), 1.0);
        close(triangle(&path([2.0, 2.0], [2.0, 2.0, 4.0]), CORNERS, 1.0), 1.0); // onto the edge
        close(triangle(&path([2.0, 2.0], [6.0, -2.0, 4.0]), CORNERS, 1.0), 1.0); // onto a corner
        close(triangle(&path([2.0, 2.0], [6.0, 6.0, 4.0]), CORNERS, 1.0), NEVER);
    }

    #[test]
    fn slivers_are_not_missed() {
        for height in [0.0, 1e-300, 1e-17, 1e-14, 1e-11, 1e-8, 1e-6, 1e-5, 1e-4] {
            for foot in [-0.5, 0.0, 0.3, 0.5, 1.0] {
                let corners = [Vector([0.0; 3]), Vector([1.0, 0.0, 0.0]), Vector([foot, height, 0.0])];
                for x in [0.0, 0.2, 0.7, 1.0] {
                    let path = Path::new([x, 0.2 * height, 5.0], [0.0, 0.0, -1.0], [0.0; 3]);
                    let t = triangle(&path, corners, 0.1);
                    assert!((t - 4.9).abs() < 1e-8, "{height} {foot} {x} {t}");
                }
            }
        }
        let point = [Vector([0.0; 3]); 3];
        close(triangle(&Path::new([0.0, 0.0, 5.0], [0.0, 0.0, -1.0], [0.0; 3]), point, 1.0), 4.0);
    }

    #[test]
    fn the_nearest_point() {
        let near = |x| nearest_on_triangle(Vector(x), CORNERS);
        assert_eq!(near([2.0, 3.0, -4.0]), Vector([2.0, 3.0, 0.0]));
        assert_eq!(near([-2.0, 3.0, -4.0]), Vector([0.0, 3.0, 0.0]));
        assert_eq!(near([-2.0, -3.0, -4.0]), Vector([0.0, 0.0, 0.0]));
        assert_eq!(near([6.0, 6.0, 1.0]), Vector([4.0, 4.0, 0.0]));
        assert_eq!(nearest_on_triangle(Vector([1.0, 1.0, 0.0]), [Vector([0.0; 3]); 3]), Vector([0.0; 3]));
    }
}
