//! What every time of impact has to satisfy, whatever the motion and the obstacle.
use carom::Vector;
use carom::meet::{self, Arc, Path};
use proptest::prelude::*;

/// An obstacle of the plane or of space, and how to ask about it.
trait Obstacle<const D: usize>: std::fmt::Debug {
    fn meet(&self, path: &Path<D>, radius: f64) -> f64;
    fn nearest(&self, point: Vector<D>) -> Vector<D>;
    /// The same, point-reflected in the origin.
    fn mirrored(&self) -> Self;
    /// A length that bounds it, and by which its rounding counts.
    fn size(&self) -> f64;
}

#[derive(Debug)]
struct Point;

impl<const D: usize> Obstacle<D> for Point {
    fn meet(&self, path: &Path<D>, radius: f64) -> f64 {
        meet::ball_ball_accelerated(path, radius)
    }
    fn nearest(&self, _: Vector<D>) -> Vector<D> {
        Vector::ZERO
    }
    fn mirrored(&self) -> Self {
        Point
    }
    fn size(&self) -> f64 {
        0.0
    }
}

#[derive(Debug)]
struct Segment<const D: usize>(Vector<D>, Vector<D>);

impl<const D: usize> Obstacle<D> for Segment<D> {
    fn meet(&self, path: &Path<D>, radius: f64) -> f64 {
        meet::segment(path, self.0, self.1, radius)
    }
    fn nearest(&self, point: Vector<D>) -> Vector<D> {
        meet::nearest_on_segment(point, self.0, self.1)
    }
    fn mirrored(&self) -> Self {
        Self(-self.0, -self.1)
    }
    fn size(&self) -> f64 {
        self.0.norm() + self.1.norm()
    }
}

#[derive(Debug)]
struct Round(Arc<2>);

impl Obstacle<2> for Round {
    fn meet(&self, path: &Path<2>, radius: f64) -> f64 {
        meet::arc(path, &self.0, radius)
    }
    fn nearest(&self, point: Vector<2>) -> Vector<2> {
        meet::nearest_on_arc(point, &self.0)
    }
    fn mirrored(&self) -> Self {
        let (from, to) = self.0.angles();
        let half = std::f64::consts::PI;
        Self(Arc::new(-self.0.centre(), self.0.radius(), from + half, to + half))
    }
    fn size(&self) -> f64 {
        self.0.centre().norm() + 8.0 * self.0.radius()
    }
}

#[derive(Debug)]
struct Triangle([Vector<3>; 3]);

impl Triangle {
    /// Its longest edge over its height.
    fn slender(&self) -> f64 {
        let [a, b, c] = self.0;
        let edges = [b - a, c - b, a - c];
        let longest = edges.iter().map(|e| e.norm()).fold(0.0, f64::max);
        let e = edges[0] / edges[0].norm();
        let area = (edges[2] - e * edges[2].dot(e)).norm() * edges[0].norm();
        longest * longest / area
    }
}

impl Obstacle<3> for Triangle {
    fn meet(&self, path: &Path<3>, radius: f64) -> f64 {
        meet::triangle(path, self.0, radius)
    }
    fn nearest(&self, point: Vector<3>) -> Vector<3> {
        meet::nearest_on_triangle(point, self.0)
    }
    fn mirrored(&self) -> Self {
        let [a, b, c] = self.0;
        Self([-b, -a, -c]) // and in another order
    }
    fn size(&self) -> f64 {
        self.0.iter().map(|c| c.norm()).sum::<f64>() * (1.0 + self.slender())
    }
}

/// The gap, and how fast it grows.
fn gap<const D: usize>(obstacle: &impl Obstacle<D>, path: &Path<D>, radius: f64, t: f64) -> (f64, f64) {
    let p = path.position_at(t);
    let away = p - obstacle.nearest(p);
    let distance = away.norm();
    (distance - radius, away.dot(path.velocity_at(t)) / distance)
}

/// What rounding may do to a position on the way to time `t` (m): three terms and the obstacle, each by half an epsilon a few
/// times (32 in all, as the seams between parts are widened by 32).
fn rounding<const D: usize>(obstacle: &impl Obstacle<D>, path: &Path<D>, radius: f64, t: f64) -> f64 {
    let way = path.velocity.norm() * t + 0.5 * path.acceleration.norm() * t * t;
    32.0 * f64::EPSILON * (path.position.norm() + way + obstacle.size() + radius)
}

fn holds<const D: usize>(obstacle: &impl Obstacle<D>, path: &Path<D>, radius: f64) -> Result<(), TestCaseError> {
    let t = obstacle.meet(path, radius);
    prop_assert!(t >= 0.0, "{t}");

    // Looked at from the other side, it is the same meeting: to the bit where nothing turns, else within roundings.
    let mirror = Path { position: -path.position, velocity: -path.velocity, acceleration: -path.acceleration };
    let mirrored = obstacle.mirrored().meet(&mirror, radius);
    let last = if t.is_finite() { t } else { 10.0 };
    let slip = rounding(obstacle, path, radius, last);
    let (at_end, closing) = gap(obstacle, path, radius, last);
    let (start, rate) = gap(obstacle, path, radius, 0.0);
    if t.is_finite() {
        // Off by the roundings over the closing speed; within them of a grazing touch anything may come out.
        let sharp = -closing > 1e-6 * path.velocity_at(t).norm();
        if sharp && at_end > -slip && t > 0.0 {
            prop_assert!((t - mirrored).abs() <= 8.0 * slip / -closing, "mirrored: {t} {mirrored}");
        }
        // There they touch or overlap, and close (at a turning point: are about to).
        prop_assert!(at_end <= slip, "gap {at_end} at {t}");
        let turning = path.velocity_at(t).norm() * slip / radius;
        let kink = gap(obstacle, path, radius, t * (1.0 + 1e-12) + 1e-12).1;
        prop_assert!(closing <= 1e-6 || kink <= turning + 1e-9, "parting at {closing} at {t}");
    }

    // Before that, no contact: the gap is positive, or was negative from the start and has not closed since.
    let mut inside = start <= 0.0;
    prop_assert!(!(start < -slip && rate < -1e-6 && t > 0.0), "overlaps by {start}, closes at {rate}, but {t}");
    for k in 0..=400 {
        let s = last * f64::from(k) / 400.0;
        if s >= t {
            break;
        }
        let (gap, rate) = gap(obstacle, path, radius, s);
        if gap > 0.0 {
            inside = false;
        }
        prop_assert!(inside || gap >= -slip, "gap {gap} at {s} before {t}");
        // A thousandth of the span before the end the rounding of a turning point is long over.
        prop_assert!(!(gap < -slip && rate < -1e-6 && s < 0.999 * t), "closes at {rate} at {s} before {t}");
    }

    // A little later it is that much less.
    if t.is_finite() && t > 0.0 && start > slip && -closing > 1e-3 * path.velocity_at(t).norm() {
        for part in [0.25, 0.5, 0.9] {
            let later = Path {
                position: path.position_at(part * t),
                velocity: path.velocity_at(part * t),
                acceleration: path.acceleration,
            };
            let rest = obstacle.meet(&later, radius);
            prop_assert!((rest + part * t - t).abs() <= 8.0 * slip / -closing, "{rest} is left of {t} after {part}");
        }
    }
    Ok(())
}

fn vector<const D: usize>(size: f64) -> impl Strategy<Value = Vector<D>> {
    proptest::collection::vec(-size..size, D).prop_map(|v| Vector::from_fn(|k| v[k]))
}

/// Paths at random, half of them through (about) where the obstacle is, a third without acceleration, a third under gravity.
fn path<const D: usize>() -> impl Strategy<Value = Path<D>> {
    let acceleration = prop_oneof![
        Just(Vector::ZERO),
        Just(Vector::from_fn(|k| if k == D - 1 { -9.81 } else { 0.0 })),
        vector::<D>(5.0)
    ];
    (vector::<D>(6.0), vector::<D>(5.0), acceleration, 0.1..3.0_f64, any::<bool>()).prop_map(|(x, v, a, t, aimed)| {
        // Aimed: there at time t at the place x / 3.
        let position = if aimed { x / 3.0 - (v + a * (0.5 * t)) * t } else { x };
        let velocity = v;
        Path { position, velocity, acceleration: a }
    })
}

fn radius() -> impl Strategy<Value = f64> {
    prop_oneof![0.01..0.3_f64, 0.3..3.0_f64]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn points_in_the_plane(path in path::<2>(), radius in radius()) {
        holds(&Point, &path, radius)?;
    }

    #[test]
    fn points_in_space(path in path::<3>(), radius in radius()) {
        holds(&Point, &path, radius)?;
    }

    #[test]
    fn segments(path in path::<2>(), from in vector::<2>(2.0), to in vector::<2>(2.0), radius in radius()) {
        holds(&Segment(from, to), &path, radius)?;
    }

    #[test]
    fn wires(path in path::<3>(), from in vector::<3>(2.0), to in vector::<3>(2.0), radius in radius()) {
        holds(&Segment(from, to), &path, radius)?;
    }

    #[test]
    fn arcs(
        path in path::<2>(), centre in vector::<2>(1.0), size in 0.2..4.0_f64, from in -4.0..4.0_f64, sweep in 0.0..7.0_f64,
        radius in radius(),
    ) {
        holds(&Round(Arc::new(centre, size, from, from + sweep)), &path, radius)?;
    }

    #[test]
    fn triangles(path in path::<3>(), a in vector::<3>(2.0), b in vector::<3>(2.0), c in vector::<3>(2.0), radius in radius()) {
        holds(&Triangle([a, b, c]), &path, radius)?;
    }

    #[test]
    fn planes(height in -1.0..9.0_f64, speed in -5.0..5.0_f64, pull in -9.81..9.81_f64, radius in 0.0..1.0_f64) {
        // The plane is the end of a segment on the line, seen from above.
        let path = Path::new([height], [speed], [pull]);
        let t = meet::plane(height, speed, pull, radius);
        if height > 0.0 {
            let point = meet::ball_ball_accelerated(&path, radius);
            prop_assert!(t == point || (t - point).abs() * path.velocity_at(t).norm() < 1e-13 * (1.0 + t * t), "{} {}", t, point);
        }
        if t.is_finite() && t > 0.0 {
            prop_assert!(path.velocity_at(t)[0] <= 1e-14 * (1.0 + t));
            prop_assert!(path.position_at(t)[0] - radius <= 1e-14 * (10.0 + t * t * 10.0));
        }
    }

    #[test]
    fn cells(x in 0.0..1.0_f64, v in -5.0..5.0_f64, a in -9.81..9.81_f64) {
        let t = meet::exit(x, v, a, 0.0, 1.0);
        let mirrored = meet::exit(-x, -v, -a, -1.0, 0.0);
        prop_assert!(t == mirrored || (t - mirrored).abs() <= 1e-14 * (1.0 + t));
        let path = Path::new([x], [v], [a]);
        let at_wall = |t| { let x = path.position_at(t)[0]; x.min(1.0 - x) };
        prop_assert!(at_wall(t).abs() <= 1e-14 * (1.0 + t * t * 10.0), "{}", t);
        for k in 0..100 {
            prop_assert!(at_wall(t * f64::from(k) / 100.0) > -1e-14);
        }
    }

    #[test]
    fn two_balls_of_either_name(x in vector::<3>(6.0), v in vector::<3>(5.0), radius in radius()) {
        let t = meet::ball_ball(x, v, radius);
        prop_assert_eq!(t, meet::ball_ball(-x, -v, radius));
        let quartic = meet::ball_ball_accelerated(&Path::new(x, v, [0.0; 3]), radius);
        prop_assert!(t == quartic || (t - quartic).abs() <= 1e-9 * (1.0 + t), "{} {}", t, quartic);
    }
}
