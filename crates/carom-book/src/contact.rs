//! Cases of one contact: a law is asked without a world.
//!
//! Words: `Px Py Pz P4` (the impulse on the second body, N s), `Pn` (along the normal), `Pt` (its length across), `lost` (J), `approach`, `departure`
//! (m/s), `vx[a] vy[a] vz[a] v4[a]` and the same of b (velocities after), `spin[a]` in the plane and `wx[a] wy[a] wz[a]` in space.
use carom::law::rough::{self, Turning};
use carom::law::smooth::{self, Moving};
use carom::law::{self, Side, line, rotated};
use carom::material::Coefficients;
use carom::{Law, Matrix, Rotates, Vector};

use crate::case::{Body, Contact, Names};
use crate::formula::{Misread, Words};

/// What a law did.
#[derive(Clone, Debug, Default)]
pub struct Done {
    impulse: Vec<f64>,
    normal: Vec<f64>,
    before: [Vec<f64>; 2],
    after: [Vec<f64>; 2],
    spins: [Vec<f64>; 2],
    lost: f64,
    approach: f64,
    departure: f64,
}

/// A contact with all its numbers.
struct Given {
    law: String,
    normal: Vec<f64>,
    c: Coefficients,
    sides: [Numbers; 2],
}

struct Numbers {
    mass: f64,
    velocity: Vec<f64>,
    spin: Vec<f64>,
    radius: f64,
    kappa: f64,
    inertia: Vec<f64>,
    arm: Vec<f64>,
}

/// Asks the law of a contact.
pub fn ask(contact: &Contact, names: &Names<'_>) -> Result<Done, Misread> {
    let normal = names.list(&contact.normal)?;
    let wall = || {
        let velocity = vec![0.0; normal.len()];
        let nothing = Vec::new;
        Numbers {
            mass: f64::INFINITY,
            velocity,
            spin: nothing(),
            radius: 0.0,
            kappa: 1.0,
            inertia: nothing(),
            arm: nothing(),
        }
    };
    let numbers = |body: &Body| -> Result<Numbers, Misread> {
        Ok(Numbers {
            mass: names.value(&body.mass)?,
            velocity: names.list(&body.velocity)?,
            spin: names.list(&body.spin)?,
            radius: names.or(body.radius.as_ref(), 0.0)?,
            kappa: names.or(body.kappa.as_ref(), 1.0)?,
            inertia: names.list(&body.inertia)?,
            arm: names.list(&body.arm)?,
        })
    };
    let b = contact.b.as_ref().map(numbers).transpose()?.unwrap_or_else(wall);
    let c = Coefficients {
        restitution: names.value(&contact.restitution)?,
        friction: names.or(contact.friction.as_ref(), 0.0)?,
        tangential: names.or(contact.tangential.as_ref(), 0.0)?,
        ..Default::default()
    };
    let given = Given { law: contact.law.clone(), normal, c, sides: [numbers(&contact.a)?, b] };
    match (given.law.as_str(), given.normal.len()) {
        ("smooth", 1) => smooth::<1>(&given),
        ("smooth", 2) => smooth::<2>(&given),
        ("smooth", 3) => smooth::<3>(&given),
        ("smooth", 4) => smooth::<4>(&given),
        ("line", 1) => on_a_line(&given),
        ("rotated", 2) => by_angles(&given),
        ("rough", 2) => rough::<2>(&given),
        ("rough", 3) => rough::<3>(&given),
        (_, 2) => general::<2>(&given, |i| i.first().map_or(0.0, |i| 1.0 / i)),
        (_, 3) => general::<3>(&given, |i| {
            Matrix::from_fn(|j, k| if j == k { i.get(j).map_or(0.0, |i| 1.0 / i) } else { 0.0 })
        }),
        (law, dim) => Err(Misread(format!("the law \"{law}\" knows no contact with {dim} components"))),
    }
}

fn vector<const D: usize>(numbers: &[f64]) -> Result<Vector<D>, Misread> {
    let array: [f64; D] = numbers.try_into().map_err(|_| Misread(format!("{numbers:?} has not {D} components")))?;
    Ok(Vector(array))
}

fn smooth<const D: usize>(given: &Given) -> Result<Done, Misread> {
    let along = vector::<D>(&given.normal)?;
    let [mut a, mut b] = [
        Moving::new(given.sides[0].mass, vector::<D>(&given.sides[0].velocity)?),
        Moving::new(given.sides[1].mass, vector::<D>(&given.sides[1].velocity)?),
    ];
    let approach = (a.velocity - b.velocity).dot(along) / along.norm();
    let lost = smooth::energy_lost(smooth::reduced_mass(&a, &b), approach, given.c.restitution);
    let impulse = smooth::impact(&mut a, &mut b, along, given.c.restitution);
    let after = [a.velocity.0.to_vec(), b.velocity.0.to_vec()];
    Ok(Done { impulse: impulse.0.to_vec(), after, lost, ..Done::of(given) })
}

fn on_a_line(given: &Given) -> Result<Done, Misread> {
    let [a, b] = &given.sides;
    let (v, w) = (a.velocity[0], b.velocity[0]);
    let (v, w) = match b.mass.is_finite() {
        true => line::velocities(a.mass, b.mass, v, w, given.c.restitution),
        false => (line::against_wall(v, w, given.c.restitution), w),
    };
    Ok(Done { after: [vec![v], vec![w]], impulse: vec![a.mass * (a.velocity[0] - v)], ..Done::of(given) })
}

fn by_angles(given: &Given) -> Result<Done, Misread> {
    let [a, b] = &given.sides;
    let velocities = [vector::<2>(&a.velocity)?, vector::<2>(&b.velocity)?];
    let (_, after) = rotated::impact([a.mass, b.mass], velocities, vector(&given.normal)?, given.c.restitution);
    let impulse = (velocities[0] - after[0]) * a.mass;
    Ok(Done { after: after.map(|v| v.0.to_vec()), impulse: impulse.0.to_vec(), ..Done::of(given) })
}

fn rough<const D: usize>(given: &Given) -> Result<Done, Misread>
where
    Vector<D>: Rotates,
{
    let along = vector::<D>(&given.normal)?;
    let turning = |side: &Numbers| -> Result<Turning<D>, Misread> {
        Ok(Turning {
            moving: Moving::new(side.mass, vector::<D>(&side.velocity)?),
            spin: spin::<D>(&side.spin)?,
            radius: side.radius,
            kappa: side.kappa,
        })
    };
    let [mut a, mut b] = [turning(&given.sides[0])?, turning(&given.sides[1])?];
    let parts = rough::parts(&a, &b, along, given.c);
    rough::exchange(&mut a, &mut b, along, parts);
    let after = [a.moving.velocity.0.to_vec(), b.moving.velocity.0.to_vec()];
    let spins = [a.spin, b.spin].map(|w| Vector::<D>::spin_slice(&w).to_vec());
    Ok(Done { impulse: (parts[0] + parts[1]).0.to_vec(), after, spins, ..Done::of(given) })
}

fn spin<const D: usize>(numbers: &[f64]) -> Result<<Vector<D> as Rotates>::Spin, Misread>
where
    Vector<D>: Rotates,
{
    if numbers.is_empty() {
        return Ok(Default::default());
    }
    Vector::<D>::spin_from(numbers).ok_or_else(|| Misread(format!("{numbers:?} is no spin in {D} dimensions")))
}

fn general<const D: usize>(
    given: &Given,
    inverse: impl Fn(&[f64]) -> <Vector<D> as Rotates>::InverseInertia,
) -> Result<Done, Misread>
where
    Vector<D>: Rotates,
{
    let Some(law) = Law::ALL.into_iter().find(|law| law.as_str() == given.law) else {
        return Err(Misread(format!("there is no law \"{}\"", given.law)));
    };
    let normal = vector::<D>(&given.normal)?;
    let normal = normal.unit().ok_or_else(|| Misread("the normal has no direction".into()))?;
    let side = |side: &Numbers, sign: f64| -> Result<Side<D>, Misread> {
        let velocity = vector::<D>(&side.velocity)?;
        if !side.mass.is_finite() {
            return Ok(Side::driven(velocity));
        }
        let spin = spin::<D>(&side.spin)?;
        if side.radius > 0.0 {
            let arm = normal * (sign * side.radius);
            return Ok(Side::ball(1.0 / side.mass, side.radius, side.kappa, velocity, spin, arm));
        }
        let arm = vector::<D>(&side.arm)?;
        Ok(Side { velocity, spin, inverse_mass: 1.0 / side.mass, inverse_inertia: inverse(&side.inertia), arm })
    };
    let contact = law::Contact { normal, sides: [side(&given.sides[0], 1.0)?, side(&given.sides[1], -1.0)?] };
    let impulse = law.impulse(&contact, given.c);
    let after = contact.after(impulse);
    let done = Done {
        impulse: impulse.0.to_vec(),
        after: [after.sides[0].velocity.0.to_vec(), after.sides[1].velocity.0.to_vec()],
        spins: [0, 1].map(|k: usize| Vector::<D>::spin_slice(&after.sides[k].spin).to_vec()),
        lost: contact.energy_lost(impulse),
        ..Done::of(given)
    };
    Ok(Done { approach: contact.approach(), departure: -after.approach(), ..done })
}

impl Done {
    /// What is known of a contact before its law is asked.
    fn of(given: &Given) -> Self {
        let length = libm::sqrt(given.normal.iter().map(|x| x * x).sum());
        let before = [given.sides[0].velocity.clone(), given.sides[1].velocity.clone()];
        let mut done = Self { normal: given.normal.iter().map(|x| x / length).collect(), before, ..Self::default() };
        done.approach = done.closing(&done.before);
        done.lost = f64::NAN;
        done.departure = f64::NAN;
        done
    }

    /// (va - vb).n.
    fn closing(&self, v: &[Vec<f64>; 2]) -> f64 {
        self.normal.iter().enumerate().map(|(k, n)| n * (v[0][k] - v[1][k])).sum()
    }
}

/// The number of a component from the last letter of a word: x, y, z, 4 of Px and of vx.
pub fn component(word: &str, first: &str) -> Option<usize> {
    match word.strip_prefix(first)? {
        "x" => Some(0),
        "y" => Some(1),
        "z" => Some(2),
        "4" => Some(3),
        _ => None,
    }
}

impl Words for Done {
    fn name(&self, name: &str) -> Result<f64, Misread> {
        let along: f64 = self.impulse.iter().zip(&self.normal).map(|(p, n)| p * n).sum();
        match name {
            "Pn" => return Ok(along),
            "Pt" => {
                let across = self.impulse.iter().zip(&self.normal).map(|(p, n)| p - along * n);
                return Ok(libm::sqrt(across.map(|p| p * p).sum()));
            }
            "lost" if self.lost.is_finite() => return Ok(self.lost),
            "approach" => return Ok(self.approach),
            // Balls part as their centres do.
            "departure" if self.departure.is_finite() => return Ok(self.departure),
            "departure" => return Ok(-self.closing(&self.after)),
            _ => {}
        }
        let k = component(name, "P").and_then(|k| self.impulse.get(k));
        k.copied().ok_or_else(|| Misread(format!("a contact has no `{name}`")))
    }

    fn of(&self, word: &str, what: &str) -> Result<f64, Misread> {
        let body = match what {
            "a" => 0,
            "b" => 1,
            _ => return Err(Misread(format!("the bodies of a contact are a and b, not `{what}`"))),
        };
        let found = match (component(word, "v"), component(word, "w"), word) {
            (Some(k), _, _) => self.after[body].get(k),
            (_, Some(k), _) => self.spins[body].get(k),
            (_, _, "spin") if self.spins[body].len() == 1 => self.spins[body].first(),
            _ => None,
        };
        found.copied().ok_or_else(|| Misread(format!("a contact has no `{word}[{what}]`")))
    }
}
