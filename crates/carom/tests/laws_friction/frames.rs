//! An impact does not know how we look at it: turned, mirrored, from a moving frame, or with the names of the bodies swapped,
//! it is the same impact.
use carom::law::{Contact, Law, Side};
use carom::{Matrix, Vector};

use crate::draw::{self, Draw, Shapes, cases};

/// The condition of K (about 100, see invariants.rs) times a few dozen roundings: of turning the scene, of the law, of turning
/// the impulse back.
const ROUNDING: f64 = 100.0 * 50.0 * f64::EPSILON;
/// Laws that integrate take other steps in other axes: the tolerance a step, and as many steps.
const INTEGRATED: f64 = 1e-8;

/// An orthogonal map of the plane or of space. Spins are axial: a mirror turns them the other way (det = -1).
trait Mapped: Shapes {
    fn map(draw: &mut Draw) -> Matrix3;
    fn apply(m: &Matrix3, v: Self) -> Self;
    fn spin(m: &Matrix3, w: Self::Spin) -> Self::Spin;
    fn inertia(m: &Matrix3, inverse: Self::InverseInertia) -> Self::InverseInertia;
}

/// The map, with its determinant.
struct Matrix3 {
    rows: Matrix<3>,
    det: f64,
}

impl Mapped for Vector<2> {
    fn map(draw: &mut Draw) -> Matrix3 {
        let [c, s] = draw.unit::<2>().0;
        let det = if draw.one_in(2) { -1.0 } else { 1.0 };
        Matrix3 { rows: Matrix([[c, -s * det, 0.0], [s, c * det, 0.0], [0.0, 0.0, 1.0]]), det }
    }
    fn apply(m: &Matrix3, v: Self) -> Self {
        let [x, y, _] = (m.rows * Vector([v[0], v[1], 0.0])).0;
        Vector([x, y])
    }
    fn spin(m: &Matrix3, w: Vector<1>) -> Vector<1> {
        w * m.det
    }
    fn inertia(_: &Matrix3, inverse: f64) -> f64 {
        inverse
    }
}

impl Mapped for Vector<3> {
    fn map(draw: &mut Draw) -> Matrix3 {
        let det = if draw.one_in(2) { -1.0 } else { 1.0 };
        let r = draw::rotation(draw);
        Matrix3 { rows: Matrix::from_fn(|i, j| r.0[i][j] * det), det }
    }
    fn apply(m: &Matrix3, v: Self) -> Self {
        m.rows * v
    }
    fn spin(m: &Matrix3, w: Self) -> Self {
        m.rows * w * m.det
    }
    fn inertia(m: &Matrix3, inverse: Matrix<3>) -> Matrix<3> {
        let half: Matrix<3> = Matrix::from_fn(|i, j| (0..3).map(|k| m.rows.0[i][k] * inverse.0[k][j]).sum::<f64>());
        let full: Matrix<3> = Matrix::from_fn(|i, j| (0..3).map(|k| half.0[i][k] * m.rows.0[j][k]).sum::<f64>());
        // Symmetric, as an inertia is.
        Matrix::from_fn(|i, j| 0.5 * (full.0[i][j] + full.0[j][i]))
    }
}

fn seen<const D: usize>(m: &Matrix3, boost: Vector<D>, contact: &Contact<D>) -> Contact<D>
where
    Vector<D>: Mapped,
{
    let side = |s: &Side<D>| Side {
        velocity: Vector::<D>::apply(m, s.velocity) + boost,
        spin: <Vector<D> as Mapped>::spin(m, s.spin),
        inverse_mass: s.inverse_mass,
        inverse_inertia: Vector::<D>::inertia(m, s.inverse_inertia),
        arm: Vector::<D>::apply(m, s.arm),
    };
    let normal = Vector::<D>::apply(m, contact.normal).unit().unwrap_or(contact.normal);
    Contact { normal, sides: [side(&contact.sides[0]), side(&contact.sides[1])] }
}

/// Slips that hardly stop, or hardly stay in the cone, do either in two frames; both are right, and the impulses differ by
/// what the law's own slope says. Laws are continuous there, so rounding moves the impulse by rounding; what is not
/// continuous is a slip that starts at exactly zero, and none is drawn.
fn from_every_side<const D: usize>(law: Law, seed: u64, number: u64, tolerance: f64)
where
    Vector<D>: Mapped,
{
    let mut draw = Draw::new(seed);
    let mut worst = [0.0f64; 3];
    for n in 0..number {
        let contact = draw::contact::<D>(&mut draw);
        let c = draw.coefficients();
        // Grazing impacts have no digits to compare: the approach is the difference of speeds of order 1.
        let u = contact.relative_velocity().norm();
        if contact.approach() < 0.01 * u || u < 0.1 {
            continue;
        }
        let impulse = law.impulse(&contact, c);
        let size = impulse.norm();

        let m = Vector::<D>::map(&mut draw);
        let turned = law.impulse(&seen(&m, Vector::ZERO, &contact), c);
        let moving =
            Contact { sides: contact.sides.map(|s| Side { velocity: s.velocity + Vector([3.0; D]), ..s }), ..contact };
        let [a, b] = contact.sides;
        let swapped = Contact { normal: -contact.normal, sides: [b, a] };
        let differ = [
            (turned - Vector::<D>::apply(&m, impulse)).norm(),
            (law.impulse(&moving, c) - impulse).norm(),
            (law.impulse(&swapped, c) + impulse).norm(),
        ];
        for (worst, (d, what)) in worst.iter_mut().zip(differ.into_iter().zip(["turned", "boosted", "swapped"])) {
            *worst = worst.max(d / size);
            // A grazing approach of 0.01 loses two digits to the boost.
            assert!(d <= 100.0 * tolerance * size, "impact {n}, {what}: {impulse:?} off by {d} {contact:?} {c:?}");
        }
    }
    println!(
        "{law:?} in {D}D: turned or mirrored {:.1e}, boosted {:.1e}, swapped {:.1e}",
        worst[0], worst[1], worst[2]
    );
}

#[test]
fn the_default_looks_the_same_from_everywhere() {
    from_every_side::<2>(Law::ChatterjeeRuina, 11, cases(100_000), ROUNDING);
    from_every_side::<3>(Law::ChatterjeeRuina, 12, cases(100_000), ROUNDING);
}

#[test]
fn followed_impacts_look_the_same_from_everywhere() {
    for law in [Law::Stronge, Law::Newton] {
        from_every_side::<2>(law, 13, cases(100_000), ROUNDING);
        from_every_side::<3>(law, 14, cases(3_000), INTEGRATED);
    }
}
