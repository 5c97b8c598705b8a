//! What is given and what comes out, at a glance, and where the coefficients come from.
use super::teller::{Teller, read};
use super::words::Phrase;
use super::{Inline, Item, Origin, Source, Table, Unit, Value};

impl Teller<'_> {
    pub fn opening(&mut self) {
        let x = self.x;
        let turning = x.before.spin.iter().flatten().any(|w| *w != 0.0);
        let mut head =
            vec![vec![], self.words(Phrase::HeadMass), self.words(Phrase::HeadBefore), self.words(Phrase::HeadAfter)];
        if turning && x.rough.is_none() {
            head.push(self.words(Phrase::HeadSpin));
        }
        let rows = (0..2).map(|k| {
            let body = k + 1;
            let mut row = vec![self.name(k)];
            for letter in [format!("m{body}"), format!("v{body}"), format!("v{body}'")] {
                row.push(vec![self.quantity(&letter, Unit::One)]);
            }
            if turning && x.rough.is_none() {
                row.push(vec![Inline::Quantity(Value::from(x.before.spin[k].as_slice()), Unit::One)]);
            }
            row
        });
        let rows = rows.collect();
        self.add(Item::Table(Table { head, rows }));
        let places = [
            ("n", self.quantity("n", Unit::One)),
            ("e", self.quantity("e", Unit::One)),
            ("u", self.quantity("u", Unit::Velocity)),
            ("w", self.quantity("u'", Unit::Velocity)),
            ("J", self.quantity("J", Unit::Impulse)),
            ("Q", self.quantity("Q", Unit::Energy)),
        ];
        let plain = x.dim == 1 && x.normal == [1.0];
        if x.rough.is_some() {
            self.rough_opening(&places);
            return self.origins();
        }
        self.say(if plain { Phrase::Given } else { Phrase::GivenNormal }, &places);
        if x.friction > 0.0 && x.dim == 1 {
            self.say(Phrase::FrictionOnALine, &[("f", Inline::Quantity(Value::Scalar(x.friction), Unit::One))]);
        }
        let story = match (x.meets(), x.lost > 0.0, x.dim) {
            (false, ..) => Phrase::StoryParting,
            (_, true, 1) => Phrase::Story,
            (_, true, _) => Phrase::StoryAlong,
            (_, false, 1) => Phrase::StoryElastic,
            (_, false, _) => Phrase::StoryAlongElastic,
        };
        self.say(story, &places);
        self.origins();
    }

    /// Where the coefficients of an impact of a run come from; friction only where there is any.
    fn origins(&mut self) {
        let Some(origins) = &self.x.origins else { return };
        let mut rows = vec![self.origin("e", &origins.restitution, false)];
        if self.x.friction > 0.0 && self.x.dim > 1 {
            rows.extend([self.origin("μ", &origins.friction, false), self.origin("et", &origins.tangential, true)]);
        }
        let head = vec![vec![], self.words(Phrase::HeadValue), self.words(Phrase::HeadOrigin)];
        self.add(Item::Table(Table { head, rows }));
    }

    fn origin(&self, letter: &str, origin: &Origin, mean: bool) -> Vec<Vec<Inline>> {
        let number = |x: f64, unit: Unit| Inline::Quantity(Value::Scalar(x), unit);
        let word = |w: &String| Inline::Words(w.clone());
        let (phrase, places) = match &origin.source {
            Source::Pair { materials: [a, b] } => (Phrase::OriginPair, vec![("A", word(a)), ("B", word(b))]),
            Source::Both { materials: [a, b], said: [x, y] } => (
                if mean { Phrase::OriginMean } else { Phrase::OriginBoth },
                vec![("A", word(a)), ("B", word(b)), ("a", number(*x, Unit::One)), ("b", number(*y, Unit::One))],
            ),
            Source::One { material } => (Phrase::OriginOne, vec![("A", word(material))]),
            Source::Unsaid => (Phrase::OriginUnsaid, Vec::new()),
            Source::Rest => (Phrase::OriginRest, Vec::new()),
        };
        let mut from = phrase.fill(self.language, &places);
        if let Some(speed) = origin.speed {
            from.extend(Phrase::OriginCurve.fill(self.language, &[("u", number(speed, Unit::Velocity))]));
        }
        vec![vec![Inline::Formula(vec![(String::new(), read(letter))])], vec![number(origin.value, Unit::One)], from]
    }
}
