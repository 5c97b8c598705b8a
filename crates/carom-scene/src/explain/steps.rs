//! The eleven steps of the lecture, with the numbers of one impact put in.
use super::number::is_rounded;
use super::rub;
use super::words::{Phrase, relations};
use super::{
    Chain, Choice, Explanation, Formula, Inline, Item, Language, Matrices, Origin, Piece, Row, Side, Source, Step,
    Table, Unit, Value, Values,
};

/// Axes by name.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Tells one impact in one language.
pub(super) struct Teller<'a> {
    pub x: &'a Explanation,
    pub values: Values,
    pub language: Language,
    items: Vec<Item>,
    steps: Vec<Step>,
}

impl Explanation {
    /// The lecture's chain with the numbers of this impact, in a language.
    pub fn chain(&self, language: Language) -> Chain {
        let mut teller = Teller { x: self, values: letters(self), language, items: Vec::new(), steps: Vec::new() };
        teller.opening();
        let opening = core::mem::take(&mut teller.items);
        teller.momentum();
        teller.force();
        teller.impulse();
        teller.conservation();
        teller.kinds();
        teller.along();
        teller.one_short();
        teller.restitution();
        teller.closed();
        teller.rotated();
        teller.projection();
        if let Some(rough) = &self.rough {
            teller.friction(rough);
        }
        teller.outcome();
        let title = match (self.wall().is_some(), self.dim) {
            (false, 1) => Phrase::TitleBodies1,
            (false, 2) => Phrase::TitleBodies2,
            (false, _) => Phrase::TitleBodies3,
            (true, 1) => Phrase::TitleWall1,
            (true, 2) => Phrase::TitleWall2,
            (true, _) => Phrase::TitleWall3,
        };
        Chain { language, dim: self.dim, title: title.words(language).into(), opening, steps: teller.steps }
    }
}

/// The heart of the chain in a few lines: normal, approach, reduced mass, impulse, velocities after, energy lost.
pub(super) fn brief(x: &Explanation, language: Language) -> Vec<Row> {
    let teller = Teller { x, values: letters(x), language, items: Vec::new(), steps: Vec::new() };
    let mut rows = Vec::new();
    let backwards = x.dim == 1 && x.normal[0] < 0.0;
    if x.dim > 1 {
        rows.push(teller.row("n", Unit::One));
    }
    let approach = match (x.dim, backwards) {
        (1, false) => "u = v1 - v2",
        (1, true) => "u = v2 - v1",
        _ => "u = (v1 - v2)·n",
    };
    rows.push(teller.row(approach, Unit::Velocity));
    if !x.meets() {
        rows.extend(["v1' = v1", "v2' = v2"].map(|r| teller.row(r, Unit::Velocity)));
        return rows;
    }
    let mass = teller.reduced_mass();
    rows.push(teller.row(&mass, Unit::Mass));
    rows.push(teller.row(&teller.fitted("J = (1 + e) #m u"), Unit::Impulse));
    if let Some(rough) = &x.rough {
        rows.extend(teller.friction_in_short(rough));
        rows.push(teller.row("Q = Qn + Qt", Unit::Energy));
        return rows;
    }
    for (k, [along, against]) in [("1", ["-", "+"]), ("2", ["+", "-"])] {
        let wall = x.wall().is_some_and(|w| (w + 1).to_string() == k);
        let (sign, n) = (if backwards { against } else { along }, if x.dim == 1 { "" } else { " n" });
        let source = if wall { format!("v{k}' = v{k}") } else { format!("v{k}' = v{k} {sign} J/m{k}{n}") };
        rows.push(teller.row(&source, Unit::Velocity));
    }
    rows.push(teller.row("Q = ½ μ (1 - e^2) u^2", Unit::Energy));
    rows
}

/// What every letter stands for. Components that are nothing but rounding noise of larger ones are shown as zero.
pub(super) fn letters(x: &Explanation) -> Values {
    let mut values = Values::default();
    let largest = |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, |most: f64, v| most.max(v.abs()));
    let quiet = |v: &[f64], scale: f64| -> Vec<f64> {
        v.iter().map(|c| if c.abs() < 8.0 * f64::EPSILON * scale { 0.0 } else { *c }).collect()
    };
    let speed = largest(&mut x.before.velocity.iter().chain(&x.after.velocity).flatten().copied());
    let states = [("", &x.before), ("'", &x.after)];
    for (prime, state) in states {
        for (k, body) in ["1", "2"].into_iter().enumerate() {
            // What was given is shown as given. After the impact a component may be the remainder of two that cancel.
            let parts = x.before.velocity[k].iter().zip(&state.velocity[k]);
            let v: Vec<f64> = parts.map(|(v0, v)| quiet(&[*v], v0.abs().max((v - v0).abs()))[0]).collect();
            let along = quiet(&[x.normal_part(&state.velocity[k])], speed)[0];
            values.set(format!("v{body}{prime}"), v.as_slice());
            for (axis, component) in AXES.iter().zip(&v) {
                values.set(format!("v{axis}{body}{prime}"), *component);
            }
            values.set(format!("vp{body}{prime}"), along);
            let across: Vec<f64> = state.velocity[k].iter().zip(&x.normal).map(|(v, n)| v - along * n).collect();
            values.set(format!("vt{body}{prime}"), quiet(&across, speed).as_slice());
            if let ([vx, vy], [nx, ny]) = (state.velocity[k].as_slice(), x.normal.as_slice()) {
                values.set(format!("vn{body}{prime}"), quiet(&[vy * nx - vx * ny], speed)[0]);
            }
            if x.masses[k].is_finite() {
                let p: Vec<f64> = v.iter().map(|v| x.masses[k] * v).collect();
                values.set(format!("p{body}{prime}"), p.as_slice());
            }
        }
        if let Some(total) = &state.momentum {
            let scale = largest(&mut (0..2).flat_map(|k| state.velocity[k].iter().map(move |v| x.masses[k] * v)));
            let total = quiet(total, scale);
            values.set(format!("P{prime}"), total.as_slice());
            for (axis, component) in AXES.iter().zip(&total) {
                values.set(format!("P{axis}{prime}"), *component);
                values.set(format!("C{axis}"), *component);
            }
        }
        values.set(format!("K{prime}"), state.energy);
    }
    let given = quiet(&x.exchanged, largest(&mut x.exchanged.iter().copied()));
    let back: Vec<f64> = given.iter().map(|p| 0.0 - p).collect();
    values.set("Fh", given.as_slice());
    values.set("Fh1", back.as_slice());
    values.set("Fh2", given.as_slice());
    if let (Some(force), Some(duration)) = (&x.mean_force, x.duration) {
        for (name, force) in ["F1", "F2"].into_iter().zip(force) {
            values.set(name, quiet(force, largest(&mut force.iter().copied())).as_slice());
        }
        values.set("Δt", duration);
    }
    for (name, value) in [
        ("m1", x.masses[0]),
        ("m2", x.masses[1]),
        ("e", x.restitution),
        ("J", x.impulse),
        ("u", quiet(&[x.approach], speed)[0]),
        ("u'", quiet(&[x.departure], speed)[0]),
        ("μ", x.reduced_mass),
        ("Q", x.lost),
        ("W", x.work),
        ("R", x.spin_energy),
    ] {
        values.set(name, value);
    }
    rub::letters(x, &mut values);
    let n = quiet(&x.normal, 1.0);
    values.set("n", n.as_slice());
    values.set("d", x.along.as_slice());
    for (axis, component) in AXES.iter().zip(&n) {
        values.set(format!("n{axis}"), *component);
    }
    let r: Vec<f64> = x.before.velocity[0].iter().zip(&x.before.velocity[1]).map(|(a, b)| a - b).collect();
    values.set("r", quiet(&r, speed).as_slice());
    if let (Some(rotated), [nx, ny]) = (&x.rotated, n.as_slice()) {
        values.set("θ", rotated.theta);
        values.set("cosθ", *nx);
        values.set("sinθ", *ny);
    }
    values
}

fn read(source: &str) -> Formula {
    Formula::parse(source).unwrap_or(Formula::Number(f64::NAN))
}

fn side(formula: Formula, unit: Unit, result: bool) -> Side {
    let rounded = formula.any(&|leaf| match leaf {
        Formula::Number(x) => is_rounded(*x),
        Formula::Vector(v) => v.iter().any(|x| is_rounded(*x)),
        _ => false,
    });
    Side { relation: if rounded { "≈" } else { "=" }, formula, unit, result }
}

/// Numbers that are a value already, and need no further side to say so.
fn is_value(formula: &Formula) -> bool {
    match formula {
        Formula::Number(_) | Formula::Vector(_) => true,
        Formula::Negative(a) => matches!(**a, Formula::Number(x) if x >= 0.0),
        _ => false,
    }
}

impl Teller<'_> {
    pub fn say(&mut self, phrase: Phrase, places: &[(&str, Inline)]) {
        let prose = phrase.fill(self.language, places);
        self.items.push(Item::Prose(prose));
    }

    pub fn show(&mut self, rows: Vec<Row>) {
        self.items.push(Item::Equations(rows));
    }

    pub fn add(&mut self, item: Item) {
        self.items.push(item);
    }

    /// Closes a step with what was said since the last.
    pub fn close(&mut self, number: Option<u8>, title: Phrase) {
        let items = core::mem::take(&mut self.items);
        self.steps.push(Step { number, title: self.words(title), items });
    }

    pub fn words(&self, phrase: Phrase) -> Vec<Inline> {
        phrase.fill(self.language, &[])
    }

    /// What a letter stands for, for a place in a phrase.
    pub fn quantity(&self, name: &str, unit: Unit) -> Inline {
        let value = self.values.get(name).cloned().unwrap_or(Value::Scalar(f64::NAN));
        Inline::Quantity(value, unit)
    }

    /// Letters only: the sides of `a = b = c`.
    fn letters(&self, source: &str) -> Row {
        let sides = relations(source).into_iter().map(|(_, f)| side(f, Unit::One, false)).collect();
        Row { sides, tick: false }
    }

    /// `a = formula = numbers = value`.
    pub fn row(&self, source: &str, unit: Unit) -> Row {
        let parts: Vec<Formula> = relations(source).into_iter().map(|p| p.1).collect();
        let numbers = parts.last().map(|last| self.values.put(last, false));
        self.finish(parts, numbers, unit)
    }

    /// The same, with other letters for the numbers than for the formula.
    fn row_by(&self, source: &str, numbers: &str, unit: Unit) -> Row {
        let parts = relations(source).into_iter().map(|p| p.1).collect();
        self.finish(parts, Some(self.values.put(&read(numbers), false)), unit)
    }

    fn finish(&self, parts: Vec<Formula>, numbers: Option<Formula>, unit: Unit) -> Row {
        // What the engine says, where the left side is a letter; else what the right side is worth.
        let known = parts.first().and_then(|left| match left {
            Formula::Letter(letter) => self.values.get(&letter.0).cloned(),
            _ => None,
        });
        let value = known.or_else(|| self.values.evaluate(parts.last()?));
        let mut sides: Vec<Side> = parts.into_iter().map(|f| side(f, Unit::One, false)).collect();
        if let Some(numbers) = numbers.filter(|n| !is_value(n)) {
            sides.push(side(numbers, Unit::One, false));
        }
        if let Some(value) = value {
            sides.push(side(value.formula(), unit, true));
        }
        Row { sides, tick: false }
    }

    /// Two accounts that agree: in letters, in numbers, and in value.
    fn both(&self, source: &str, unit: Unit) -> Vec<Row> {
        let parts: Vec<Formula> = relations(source).into_iter().map(|p| p.1).collect();
        let row = |formulas: Vec<Formula>, unit: Unit, result: bool| Row {
            sides: formulas.into_iter().map(|f| side(f, unit, result)).collect(),
            tick: result,
        };
        let numbers = parts.iter().map(|f| self.values.put(f, false)).collect();
        let values = parts.iter().filter_map(|f| self.values.evaluate(f)).map(|v| v.formula()).collect();
        vec![row(parts, Unit::One, false), row(numbers, Unit::One, false), row(values, unit, true)]
    }

    /// The letter of a velocity along the line of centres: on a line the velocity itself.
    fn v(&self) -> &'static str {
        if self.x.dim == 1 { "v" } else { "vp" }
    }

    /// A formula for this impact: `v_` stands for the velocity along the line of centres, `#b` for the body of finite mass,
    /// `#w` for the wall and `#m` for the reduced mass, which leaves the letter μ to friction where there is any.
    pub fn fitted(&self, source: &str) -> String {
        let wall = self.x.wall().unwrap_or(1);
        let (body, wall) = ((2 - wall).to_string(), (wall + 1).to_string());
        let mass = if self.x.rough.is_some() { "mn" } else { "μ" };
        source.replace("v_", self.v()).replace("#b", &body).replace("#w", &wall).replace("#m", mass)
    }

    /// What the reduced mass is.
    pub fn reduced_mass(&self) -> String {
        self.fitted(if self.x.wall().is_some() { "#m = m#b" } else { "#m = (m1 m2)/(m1 + m2)" })
    }

    /// What to call a body.
    pub fn name(&self, k: usize) -> Vec<Inline> {
        self.words(match (self.x.wall() == Some(k), k) {
            (true, _) => Phrase::Wall,
            (_, 0) => Phrase::Body1,
            _ => Phrase::Body2,
        })
    }

    fn axes(&self) -> &'static [&'static str] {
        &AXES[..self.x.dim]
    }

    fn opening(&mut self) {
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

    fn momentum(&mut self) {
        self.say(if self.x.dim == 1 { Phrase::MomentumLine } else { Phrase::MomentumSays }, &[]);
        if self.x.wall().is_some() {
            self.show(vec![self.row(&self.fitted("p#b = m#b v#b"), Unit::Momentum)]);
            self.say(Phrase::MomentumWall, &[]);
        } else {
            let rows = ["p1 = m1 v1", "p2 = m2 v2", "P = p1 + p2"];
            self.show(rows.iter().map(|r| self.row(r, Unit::Momentum)).collect());
            if self.x.dim > 1 {
                self.say(Phrase::ByComponents, &[]);
                let row = |a: &&str| self.row(&format!("P{a} = m1 v{a}1 + m2 v{a}2"), Unit::Momentum);
                self.show(self.axes().iter().map(row).collect());
            }
        }
        self.close(Some(1), Phrase::Momentum);
    }

    fn force(&mut self) {
        self.say(Phrase::ForceSays, &[]);
        self.show(vec![self.letters("F = [dp/dt]"), self.letters("F1 + F2 = 0")]);
        if self.x.duration.is_some() {
            self.say(Phrase::ForceMean, &[("t", self.quantity("Δt", Unit::Time))]);
            self.show(vec![self.row("F1 = Fh1/Δt", Unit::Force), self.row("F2 = Fh2/Δt", Unit::Force)]);
        } else {
            self.say(Phrase::ForceUnknown, &[]);
        }
        self.close(Some(2), Phrase::Force);
    }

    fn impulse(&mut self) {
        self.say(Phrase::ImpulseSays, &[]);
        self.show(vec![self.letters("Fh = [∫F dt] = Δp = m (v' - v)")]);
        self.say(Phrase::ImpulseHere, &[]);
        let rows = match self.x.wall() {
            Some(_) => [self.fitted("Fh#b = m#b (v#b' - v#b)"), self.fitted("Fh#w = -Fh#b")],
            None => ["Fh1 = m1 (v1' - v1)".into(), "Fh2 = m2 (v2' - v2)".into()],
        };
        self.show(rows.iter().map(|r| self.row(r, Unit::Impulse)).collect());
        if let Some(rough) = &self.x.rough {
            let across = Inline::Quantity(Value::Scalar(rough.impulse), Unit::Impulse);
            self.say(Phrase::ImpulsePairRough, &[("J", self.quantity("J", Unit::Impulse)), ("T", across)]);
        } else if self.x.meets() {
            self.say(Phrase::ImpulsePair, &[("J", self.quantity("J", Unit::Impulse))]);
        }
        self.close(Some(3), Phrase::Impulse);
    }

    fn conservation(&mut self) {
        if self.x.wall().is_some() {
            self.say(Phrase::ConservationWall, &[]);
            let rows = ["Fh#b = p#b' - p#b", "Fh#w = -Fh#b"];
            self.show(rows.iter().map(|r| self.row(&self.fitted(r), Unit::Impulse)).collect());
        } else if self.x.dim == 1 {
            self.say(Phrase::ConservationLine, &[]);
            self.show(self.both("m1 v1 + m2 v2 = m1 v1' + m2 v2'", Unit::Momentum));
        } else {
            self.say(Phrase::ConservationSays, &[]);
            self.show(vec![self.letters("m1 v1 + m2 v2 = m1 v1' + m2 v2'")]);
            let row = |a: &&str| {
                let sides = relations(&format!("C{a} = m1 v{a}1 + m2 v{a}2 = m1 v{a}1' + m2 v{a}2'"));
                let numbers = sides.iter().skip(1).map(|(_, f)| side(self.values.put(f, false), Unit::One, false));
                let mut all = vec![side(sides[0].1.clone(), Unit::One, false)];
                all.extend(numbers);
                all.push(side(self.values.put(&sides[0].1, false), Unit::Momentum, true));
                Row { sides: all, tick: true }
            };
            self.show(self.axes().iter().map(row).collect());
        }
        self.close(Some(4), Phrase::Conservation);
    }

    fn kinds(&mut self) {
        self.say(if self.x.wall().is_some() { Phrase::KindsWall } else { Phrase::KindsSay }, &[]);
        let e = self.x.restitution;
        let choice = |holds: bool, when: &str, then: Phrase| Choice {
            holds,
            when: vec![Inline::Formula(relations(when))],
            then: self.words(then),
        };
        let choices = vec![
            choice(e == 1.0, "e = 1", Phrase::Elastic),
            choice(e > 0.0 && e < 1.0, "0 < e < 1", Phrase::Inelastic),
            choice(e == 0.0, "e = 0", Phrase::Plastic),
        ];
        self.add(Item::Choices(choices));
        self.close(Some(5), Phrase::Kinds);
    }

    fn along(&mut self) {
        let wall = self.x.wall().is_some();
        let exchange = if wall {
            vec![
                self.letters(&self.fitted("m#b (v_#b' - v_#b) = Fhp#b")),
                self.row(&self.fitted("v_#w' = v_#w"), Unit::Velocity),
            ]
        } else {
            let balance = "m1 (v_1' - v_1) + m2 (v_2' - v_2) = 0";
            let source = self.fitted(balance);
            let left = relations(&source).swap_remove(0).1;
            let numbers = Row {
                sides: vec![
                    side(self.values.put(&left, false), Unit::One, false),
                    side(Formula::Number(0.0), Unit::One, true),
                ],
                tick: true,
            };
            vec![self.letters(&source), numbers]
        };
        if self.x.dim == 1 {
            if wall {
                self.say(Phrase::AlongWallLine, &[]);
                self.show(vec![
                    self.letters(&self.fitted("m#b (v#b' - v#b) = Fh#b")),
                    self.row(&self.fitted("v#w' = v#w"), Unit::Velocity),
                ]);
            } else {
                self.say(Phrase::AlongLine, &[]);
                let mut rows = vec![self.letters("m1 (v1' - v1) = -Fh"), self.letters("m2 (v2' - v2) = Fh")];
                rows.extend(exchange);
                self.show(rows);
            }
            self.say(Phrase::NoFriction, &[]);
        } else {
            self.say(if self.x.rough.is_some() { Phrase::AlongRough } else { Phrase::AlongSays }, &[]);
            self.show(vec![self.row("vp1 = v1·n", Unit::Velocity), self.row("vp2 = v2·n", Unit::Velocity)]);
            self.say(if wall { Phrase::AlongWall } else { Phrase::AlongExchange }, &[]);
            self.show(exchange);
            if self.x.rough.is_some() {
                self.say(if self.x.dim == 2 { Phrase::AcrossRough2 } else { Phrase::AcrossRough3 }, &[]);
                self.close(Some(6), Phrase::Along);
                return;
            }
            let (letter, phrase) = if self.x.dim == 2 { ("vn", Phrase::Across2) } else { ("vt", Phrase::Across3) };
            self.say(phrase, &[]);
            let row = |k: &str| {
                let source = match letter {
                    "vn" => format!("vn{k}' = vn{k} = vy{k} nx - vx{k} ny"),
                    _ => format!("vt{k}' = vt{k} = v{k} - vp{k} n"),
                };
                self.row(&source, Unit::Velocity)
            };
            self.show(vec![row("1"), row("2")]);
        }
        if self.x.before.spin.iter().flatten().any(|w| *w != 0.0) {
            self.say(Phrase::SpinStays, &[]);
        }
        self.close(Some(6), Phrase::Along);
    }

    fn one_short(&mut self) {
        if self.x.wall().is_some() {
            self.say(Phrase::OneShortWall, &[]);
            let source = self.fitted("m#b (v_#b' - v_#b)");
            let known = self.values.put(&read(&source), true);
            let unknown = side(read("J"), Unit::One, false);
            // The impulse on the body has the sign of -n for the first body, of +n for the second.
            let negative = self.x.wall() == Some(1);
            let along = if self.x.dim == 1 { self.x.normal[0] } else { 1.0 };
            let unknown = if negative == (along > 0.0) { Side { formula: read("-J"), ..unknown } } else { unknown };
            self.show(vec![Row { sides: vec![side(known, Unit::One, false), unknown], tick: false }]);
        } else {
            self.say(Phrase::OneShortSays, &[]);
            let left = read(&self.fitted("m1 v_1' + m2 v_2'"));
            let right = read(&self.fitted("m1 v_1 + m2 v_2"));
            let mut sides = vec![
                side(self.values.put(&left, true), Unit::One, false),
                side(self.values.put(&right, false), Unit::One, false),
            ];
            sides.extend(self.values.evaluate(&right).map(|v| side(v.formula(), Unit::Momentum, true)));
            self.show(vec![Row { sides, tick: false }]);
        }
        let note = if self.x.dim == 1 { Phrase::Slip } else { Phrase::SlipAlong };
        self.add(Item::Note(self.words(note)));
        self.close(Some(7), Phrase::OneShort);
    }

    fn restitution(&mut self) {
        let source = self.fitted("e (v_1 - v_2) = -(v_1' - v_2')");
        if self.x.meets() {
            self.say(Phrase::RestitutionSays, &[]);
            self.show(self.both(&source, Unit::Velocity));
            self.say(Phrase::RestitutionSpeeds, &[]);
            let backwards = self.x.dim == 1 && self.x.normal[0] < 0.0;
            let (u, w) =
                if backwards { ("u = v_2 - v_1", "u' = v_1' - v_2'") } else { ("u = v_1 - v_2", "u' = v_2' - v_1'") };
            self.show(vec![self.row(&self.fitted(u), Unit::Velocity), self.row(&self.fitted(w), Unit::Velocity)]);
        } else {
            self.say(Phrase::RestitutionParting, &[("u", self.quantity("u", Unit::Velocity))]);
            self.show(vec![self.letters(&source)]);
        }
        self.close(Some(8), Phrase::Restitution);
    }

    fn closed(&mut self) {
        let wall = self.x.wall().is_some();
        let rows = if wall {
            ["v_#b' = -e v_#b + (1 + e) v_#w", "v_#w' = v_#w"]
        } else {
            [
                "v_1' = (m1 - e m2)/(m1 + m2) v_1 + (1 + e) m2/(m1 + m2) v_2",
                "v_2' = (1 + e) m1/(m1 + m2) v_1 + (m2 - e m1)/(m1 + m2) v_2",
            ]
        };
        let rows = rows.map(|r| self.fitted(r));
        if self.x.meets() {
            self.say(
                match (wall, self.x.dim) {
                    (true, _) => Phrase::ClosedWall,
                    (_, 1) => Phrase::ClosedSays,
                    _ => Phrase::ClosedAlong,
                },
                &[],
            );
            for r in &rows {
                self.show(vec![self.row(r, Unit::Velocity)]);
            }
        } else {
            self.say(Phrase::ClosedParting, &[]);
            self.show(rows.iter().map(|r| self.letters(r)).collect());
            self.show(["v_1' = v_1", "v_2' = v_2"].iter().map(|r| self.row(&self.fitted(r), Unit::Velocity)).collect());
        }
        self.close(Some(9), Phrase::Closed);
    }

    fn rotated(&mut self) {
        let Some(rotated) = &self.x.rotated else {
            self.say(if self.x.dim == 1 { Phrase::RotatedLine } else { Phrase::RotatedSpace }, &[]);
            self.close(Some(10), Phrase::Rotated);
            return;
        };
        self.say(Phrase::RotatedSays, &[]);
        let mut angle = self.row("θ = atan2(ny, nx)", Unit::Angle);
        angle.sides.push(side(Formula::Number(rotated.theta.to_degrees()), Unit::Degree, true));
        self.show(vec![angle]);
        self.say(Phrase::RotatedEnter, &[]);
        let rows = ["1", "2"]
            .into_iter()
            .flat_map(|k| [format!("vp{k} = vx{k} cosθ + vy{k} sinθ"), format!("vn{k} = -vx{k} sinθ + vy{k} cosθ")]);
        self.show(rows.map(|r| self.row(&r, Unit::Velocity)).collect());
        let back = match (self.x.meets(), &self.x.rough) {
            (false, _) => Phrase::RotatedBackParting,
            (_, None) => Phrase::RotatedBack,
            (_, Some(_)) => Phrase::RotatedBackRough,
        };
        self.say(back, &[]);
        let column = |names: [&str; 2]| Piece::Matrix(names.iter().map(|n| vec![read(n)]).collect());
        let turn = [["cosθ", "-sinθ"], ["sinθ", "cosθ"]].map(|r| r.map(read).to_vec()).to_vec();
        let put = |piece: &Piece| match piece {
            Piece::Matrix(rows) => {
                let number = |f: &Formula| self.values.evaluate(f).map_or_else(|| f.clone(), |v| v.formula());
                Piece::Matrix(rows.iter().map(|r| r.iter().map(number).collect()).collect())
            }
            Piece::Sign(sign) => Piece::Sign(sign),
        };
        let mut all = Vec::new();
        for k in ["1", "2"] {
            let [vx, vy, vp, vn] = ["vx", "vy", "vp", "vn"].map(|v| format!("{v}{k}'"));
            let (result, turned) = (column([&vx, &vy]), column([&vp, &vn]));
            let rounded = [&result, &turned].into_iter().any(|p| match put(p) {
                Piece::Matrix(rows) => rows.iter().flatten().any(|f| matches!(f, Formula::Number(x) if is_rounded(*x))),
                Piece::Sign(_) => false,
            });
            let matrix = Piece::Matrix(turn.clone());
            all.push(Matrices(vec![
                result.clone(),
                Piece::Sign("="),
                matrix.clone(),
                turned.clone(),
                Piece::Sign(if rounded { "≈" } else { "=" }),
                put(&matrix),
                put(&turned),
                Piece::Sign(if rounded { "≈" } else { "=" }),
                put(&result),
            ]));
        }
        self.add(Item::Matrices(all));
        self.close(Some(10), Phrase::Rotated);
    }

    fn projection(&mut self) {
        self.say(Phrase::ProjectionSays, &[]);
        let worth = |source: &str, unit: Unit| {
            let formula = read(source);
            let numbers = self.values.put(&formula, false);
            self.finish(vec![formula], Some(numbers), unit)
        };
        let mut rows =
            vec![self.row("d", Unit::One), self.row("r = v1 - v2", Unit::Velocity), worth("r·d", Unit::Velocity)];
        if !self.x.meets() {
            self.show(rows);
            self.say(Phrase::ProjectionParting, &[]);
            self.show(vec![self.row("v1' = v1", Unit::Velocity), self.row("v2' = v2", Unit::Velocity)]);
            self.close(Some(11), Phrase::Projection);
            return;
        }
        rows.push(worth("d·d", Unit::One));
        rows.push(worth("1/m1 + 1/m2", Unit::InverseMass));
        self.show(rows);
        for (name, source) in [("rd", "r·d"), ("dd", "d·d"), ("im", "1/m1 + 1/m2")] {
            if let Some(value) = self.values.evaluate(&read(source)) {
                self.values.set(name, value);
            }
        }
        if self.x.rough.is_some() {
            let law = "Fhn = (1 + e) (r·d)/((d·d) (1/m1 + 1/m2)) d";
            self.show(vec![
                self.row_by(law, "(1 + e) rd/(dd im) d", Unit::Impulse),
                self.row("J = |Fhn|", Unit::Impulse),
            ]);
            self.say(Phrase::ProjectionRough, &[]);
            self.close(Some(11), Phrase::Projection);
            return;
        }
        let law = "Fh = (1 + e) (r·d)/((d·d) (1/m1 + 1/m2)) d";
        let mut rows = vec![self.row_by(law, "(1 + e) rd/(dd im) d", Unit::Impulse)];
        if self.x.dim > 1 {
            rows.push(self.row("J = |Fh|", Unit::Impulse));
        }
        self.show(rows);
        self.show(vec![self.row("v1' = v1 - Fh/m1", Unit::Velocity), self.row("v2' = v2 + Fh/m2", Unit::Velocity)]);
        self.say(Phrase::ProjectionEngine, &[]);
        self.close(Some(11), Phrase::Projection);
    }
}
