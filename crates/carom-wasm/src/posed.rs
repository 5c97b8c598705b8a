//! A question about an impact on its way from an engine to the words: numbers, bit for bit, and the names of materials. So the words
//! need neither the scene nor a reader of text.
use carom::Law;
use carom_scene::explain::{Origin, Origins, Question, Source};

/// A question, and the impulses (N s) that the engine found, along the normal and across it.
#[derive(Clone, Debug, PartialEq)]
pub struct Posed {
    /// What is asked.
    pub question: Question,
    /// Along the normal.
    pub impulse: f64,
    /// Across it, on the second body.
    pub friction_impulse: Vec<f64>,
}

/// What is not there.
const NONE: f64 = f64::NAN;

impl Posed {
    /// The numbers, then the names one after the other; the numbers say how long each is.
    pub fn pack(&self) -> (Vec<f64>, String) {
        let q = &self.question;
        let law = Law::ALL.iter().position(|l| *l == q.law).unwrap_or(0) as f64;
        let mut numbers = vec![q.dim() as f64, q.restitution, q.friction, q.tangential, law, self.impulse];
        let mut names = String::new();
        numbers.extend(q.masses);
        numbers.extend(q.velocity.iter().flatten());
        numbers.extend(q.normal.iter().flatten());
        numbers.extend(&self.friction_impulse);
        numbers.extend(q.radius.unwrap_or([NONE; 2]));
        numbers.extend(q.inertia.unwrap_or([NONE; 2]));
        numbers.push(if q.spin.is_some() { 1.0 } else { NONE });
        numbers.extend(q.spin.iter().flatten().flatten());
        numbers.push(if q.origins.is_some() { 1.0 } else { NONE });
        if let Some(origins) = &q.origins {
            for origin in [&origins.restitution, &origins.friction, &origins.tangential] {
                let (kind, materials, said): (f64, &[String], [f64; 2]) = match &origin.source {
                    Source::Pair { materials } => (0.0, materials, [NONE; 2]),
                    Source::Both { materials, said } => (1.0, materials, *said),
                    Source::One { material } => (2.0, core::slice::from_ref(material), [NONE; 2]),
                    Source::Unsaid => (3.0, &[], [NONE; 2]),
                    Source::Rest => (4.0, &[], [NONE; 2]),
                };
                numbers.extend([origin.value, origin.speed.unwrap_or(NONE), kind]);
                numbers.extend(said);
                for k in 0..2 {
                    let name = materials.get(k).map_or("", String::as_str);
                    numbers.push(name.len() as f64);
                    names += name;
                }
            }
        }
        (numbers, names)
    }

    /// The question that was packed; `None` if it is not one.
    pub fn unpack(numbers: &[f64], names: &str) -> Option<Self> {
        let mut from = Reader { numbers, names };
        let dim = from.count().filter(|d| (1..=3).contains(d))?;
        let [restitution, friction, tangential] = from.several()?;
        let law = *Law::ALL.get(from.count()?)?;
        let [impulse] = from.several()?;
        let masses = from.several()?;
        let velocity = [from.list(dim)?, from.list(dim)?];
        let normal = from.list(dim)?;
        let friction_impulse = from.list(dim)?;
        let radius = from.there()?;
        let inertia = from.there()?;
        let [spinning] = from.several()?;
        let spins = [0, 1, 3][dim - 1];
        let spin = if spinning.is_nan() { None } else { Some([from.list(spins)?, from.list(spins)?]) };
        let [known] = from.several()?;
        let origins = if known.is_nan() {
            None
        } else {
            Some(Origins { restitution: from.origin()?, friction: from.origin()?, tangential: from.origin()?, law })
        };
        let question = Question {
            restitution,
            friction,
            tangential,
            law,
            spin,
            radius,
            inertia,
            origins,
            ..Question::new(masses, velocity).normal(normal)
        };
        Some(Self { question, impulse, friction_impulse })
    }
}

struct Reader<'a> {
    numbers: &'a [f64],
    names: &'a str,
}

impl Reader<'_> {
    fn several<const N: usize>(&mut self) -> Option<[f64; N]> {
        let (first, rest) = self.numbers.split_first_chunk::<N>()?;
        self.numbers = rest;
        Some(*first)
    }

    fn list(&mut self, length: usize) -> Option<Vec<f64>> {
        let (first, rest) = self.numbers.split_at_checked(length)?;
        self.numbers = rest;
        Some(first.to_vec())
    }

    fn count(&mut self) -> Option<usize> {
        let [x] = self.several()?;
        (x >= 0.0 && x <= f64::from(u32::MAX)).then_some(x as usize)
    }

    /// Two numbers that may not be there.
    fn there(&mut self) -> Option<Option<[f64; 2]>> {
        let both: [f64; 2] = self.several()?;
        Some((!both[0].is_nan()).then_some(both))
    }

    fn name(&mut self) -> Option<String> {
        let length = self.count()?;
        let (name, rest) = self.names.split_at_checked(length)?;
        self.names = rest;
        Some(name.into())
    }

    fn origin(&mut self) -> Option<Origin> {
        let [value, speed] = self.several()?;
        let kind = self.count()?;
        let said = self.several()?;
        let materials = [self.name()?, self.name()?];
        let source = match kind {
            0 => Source::Pair { materials },
            1 => Source::Both { materials, said },
            2 => Source::One { material: materials.into_iter().next()? },
            3 => Source::Unsaid,
            _ => Source::Rest,
        };
        Some(Origin { value, source, speed: (!speed.is_nan()).then_some(speed) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every kind of origin, every dimension, and what may be missing.
    #[test]
    fn what_is_packed_comes_out_again() {
        let both = ["ivory".to_owned(), "Filz\u{0}ß".to_owned()];
        let origin = |value: f64, source: Source, speed: Option<f64>| Origin { value, source, speed };
        let origins = Origins {
            restitution: origin(0.6, Source::Both { materials: both.clone(), said: [0.9, 0.4] }, Some(5.0)),
            friction: origin(0.1, Source::Pair { materials: both }, None),
            tangential: origin(0.25, Source::One { material: "ivory".into() }, None),
            law: Law::Stronge,
        };
        let quiet = Origins {
            restitution: origin(0.0, Source::Rest, None),
            friction: origin(0.0, Source::Unsaid, None),
            ..origins.clone()
        };
        for dim in 1..=3 {
            let list = |x: f64| (0..dim).map(|k| x + k as f64).collect::<Vec<_>>();
            let smooth = Question::new([2.0, f64::INFINITY], [list(0.1), list(-3.0)]).normal(list(1.0));
            let spins = [0, 1, 3][dim - 1];
            let rough = Question {
                law: Law::Stronge,
                friction: 0.1,
                tangential: 0.25,
                spin: Some([vec![4.0; spins], vec![-1.0; spins]]),
                radius: Some([0.5, 1.0]),
                inertia: Some([0.4, 0.5]),
                ..smooth.clone()
            };
            let told = |origins: &Origins| Question { origins: Some(origins.clone()), ..rough.clone() };
            for question in [smooth, rough.clone(), told(&origins), told(&quiet)] {
                let posed = Posed { question, impulse: 3.6, friction_impulse: list(0.5) };
                let (numbers, names) = posed.pack();
                assert_eq!(Posed::unpack(&numbers, &names), Some(posed));
                // What is cut short is no question, and no trouble.
                for length in 0..numbers.len() {
                    assert_eq!(Posed::unpack(&numbers[..length], &names), None);
                }
            }
        }
        assert_eq!(Posed::unpack(&[f64::NAN; 40], "x"), None);
    }
}
