//! Friction told with numbers: how the surfaces slip, whether they stick, and how that turns the bodies.
use super::teller::Teller;
use super::words::{Phrase, relations};
use super::{Choice, Explanation, Friction, Inline, Item, Row, Special, Table, Unit, Value, Values};
use carom::Law;

/// What the letters of friction stand for. In the plane slip and spin are numbers, in space vectors.
pub(super) fn letters(x: &Explanation, values: &mut Values) {
    let Some(rough) = &x.rough else { return };
    let fastest =
        x.before.velocity.iter().chain(&x.after.velocity).flatten().fold(0.0, |most: f64, v| most.max(v.abs()));
    let quiet = |v: f64, scale: f64| if v.abs() < 8.0 * f64::EPSILON * scale { 0.0 } else { v };
    let calm = |v: &[f64], scale: f64| v.iter().map(|v| quiet(*v, scale)).collect::<Vec<f64>>();
    let radius = x.radius.unwrap_or_default();
    for (prime, state, slip) in [("", &x.before, &rough.slip[0]), ("'", &x.after, &rough.slip[1])] {
        let scale = fastest.max(rough.slip_speed);
        match x.normal.as_slice() {
            [nx, ny] => values.set(format!("s{prime}"), quiet(slip[1] * nx - slip[0] * ny, scale)),
            _ => values.set(format!("σ{prime}"), calm(slip, scale).as_slice()),
        }
        if let ("", [a @ [_, _, _], b @ [_, _, _]]) = (prime, [state.spin[0].as_slice(), state.spin[1].as_slice()]) {
            let sum: Vec<f64> = a.iter().zip(b).map(|(a, b)| radius[0] * a + radius[1] * b).collect();
            let scale = a.iter().chain(b).fold(0.0, |most: f64, w| most.max(w.abs())) * radius[0].max(radius[1]);
            values.set("Σ", calm(&sum, scale).as_slice());
        }
        for (k, spin) in state.spin.iter().enumerate() {
            let scale = x.before.spin[k].iter().chain(spin).fold(0.0, |most: f64, w| most.max(w.abs()));
            match spin.as_slice() {
                [w] => values.set(format!("ω{}{prime}", k + 1), quiet(*w, scale)),
                _ => values.set(format!("Ω{}{prime}", k + 1), calm(spin, scale).as_slice()),
            }
        }
    }
    for k in 0..2 {
        values.set(format!("R{}", k + 1), radius[k]);
        values.set(format!("k{}", k + 1), x.inertia[k]);
        if x.masses[k].is_finite() {
            values.set(format!("I{}", k + 1), x.inertia[k] * x.masses[k] * radius[k] * radius[k]);
        }
    }
    let across = calm(&x.friction_impulse, rough.impulse);
    let normal: Vec<f64> = x.exchanged.iter().zip(&x.friction_impulse).map(|(all, part)| all - part).collect();
    values.set("Fht", across.as_slice());
    values.set("Fhn", calm(&normal, x.impulse.max(rough.impulse)).as_slice());
    match (x.normal.as_slice(), across.as_slice()) {
        ([nx, ny], [x, y]) => values.set("Jt", y * nx - x * ny),
        ([nx, ny, nz], [x, y, z]) => {
            let lever = [ny * z - nz * y, nz * x - nx * z, nx * y - ny * x];
            values.set("M", calm(&lever, rough.impulse).as_slice());
            values.set("Jt", rough.impulse);
            let direction: Vec<f64> = rough.slip[0].iter().map(|s| s / rough.slip_speed).collect();
            values.set("t", calm(&direction, 1.0).as_slice());
        }
        _ => {}
    }
    for (name, value) in [
        ("μ", x.friction),
        ("et", returned(x)),
        ("mn", x.reduced_mass),
        ("mt", rough.tangential_mass),
        ("Js", rough.stick),
        ("Qn", rough.lost_normal),
        ("Qt", quiet(rough.lost_friction, rough.impulse * rough.slip_speed)),
    ] {
        values.set(name, value);
    }
}

/// The tangential restitution that is at work: only the default law knows one.
fn returned(x: &Explanation) -> f64 {
    if x.law == Law::ChatterjeeRuina { x.tangential } else { 0.0 }
}

impl Teller<'_> {
    /// The steps that follow the lecture's eleven.
    pub(super) fn friction(&mut self, rough: &Friction) {
        self.slipping();
        self.sticking(rough);
        self.turning(rough);
    }

    /// What is given and what happens, at a glance.
    pub(super) fn rough_opening(&mut self, places: &[(&str, Inline)]) {
        let Some(rough) = &self.x.rough else { return };
        let number = |x: f64, unit: Unit| Inline::Quantity(Value::Scalar(x), unit);
        let mut places = places.to_vec();
        places.extend([
            ("f", number(self.x.friction, Unit::One)),
            ("t", self.quantity("et", Unit::One)),
            ("s", number(rough.slip_speed, Unit::Velocity)),
            ("T", number(rough.impulse, Unit::Impulse)),
            ("q", self.quantity("Qn", Unit::Energy)),
            ("g", self.quantity("Qt", Unit::Energy)),
        ]);
        self.spin_table();
        self.say(Phrase::GivenRough, &places);
        match self.x.law {
            Law::ChatterjeeRuina => {}
            Law::Stronge => self.say(Phrase::LawStronge, &[]),
            Law::Newton => self.say(Phrase::LawNewton, &[]),
        }
        let story = match (rough.slip_speed > 0.0, rough.sticks) {
            (false, _) => Phrase::StoryNoSlip,
            _ if self.x.special.contains(&Special::Superball) => Phrase::StorySuperball,
            (_, true) => Phrase::StorySticks,
            (_, false) => Phrase::StorySlips,
        };
        self.say(story, &places);
    }

    /// Radii and spins, in a table of their own: beside the velocities it would be too wide.
    fn spin_table(&mut self) {
        let head = [Phrase::HeadRadius, Phrase::HeadSpinBefore, Phrase::HeadSpinAfter].map(|h| self.words(h));
        let spin = |spin: &[f64]| vec![Inline::Quantity(Value::from(spin), Unit::One)];
        let row = |k: usize| {
            let radius = vec![self.quantity(&format!("R{}", k + 1), Unit::One)];
            let name = if self.flat() { "ω" } else { "Ω" };
            let numbers = ["", "'"].map(|prime| {
                let value = self.values.get(&format!("{name}{}{prime}", k + 1));
                spin(value.map_or(&[], Value::numbers))
            });
            core::iter::once(self.name(k)).chain([radius]).chain(numbers).collect()
        };
        let rows = (0..2).filter(|k| self.spins_count(*k)).map(row).collect();
        self.add(Item::Table(Table { head: core::iter::once(vec![]).chain(head).collect(), rows }));
    }

    /// Friction in the few lines of the brief chain.
    pub(super) fn friction_in_short(&self, rough: &Friction) -> Vec<Row> {
        let mut rows = self.slip("");
        rows.extend([
            self.row(&self.tangential_mass(), Unit::Mass),
            self.row(&self.stick(), Unit::Impulse),
            self.row("μ J", Unit::Impulse),
        ]);
        rows.extend(self.given(rough));
        rows.extend(self.velocities());
        rows.extend(self.spins());
        rows
    }

    fn flat(&self) -> bool {
        self.x.dim == 2
    }

    /// "s" in the plane, "σ" in space.
    fn letter(&self) -> &'static str {
        if self.flat() { "s" } else { "σ" }
    }

    /// True if the surface of a body moves by its spin: a wall's hardly ever does.
    fn spins_count(&self, k: usize) -> bool {
        self.x.masses[k].is_finite() || self.x.before.spin[k].iter().any(|w| *w != 0.0)
    }

    /// The slip before, with the way to it; in the plane also after, with a `prime`.
    fn slip(&self, prime: &str) -> Vec<Row> {
        let counts = [self.spins_count(0), self.spins_count(1)];
        if self.flat() {
            let first = if counts[0] { format!("(vn1{prime} + R1 ω1{prime})") } else { format!("vn1{prime}") };
            let second = if counts[1] { format!("(vn2{prime} - R2 ω2{prime})") } else { format!("vn2{prime}") };
            return vec![self.row(&format!("s{prime} = {first} - {second}"), Unit::Velocity)];
        }
        let terms: Vec<String> = (1..=2).filter(|k| counts[k - 1]).map(|k| format!("R{k} Ω{k}{prime}")).collect();
        vec![
            self.row(&format!("Σ = {}", terms.join(" + ")), Unit::Velocity),
            self.row("σ = vt1 - vt2 + Σ × n", Unit::Velocity),
        ]
    }

    fn tangential_mass(&self) -> String {
        let term = |k: usize| format!("1/m{k} + R{k}^2/I{k}");
        let terms: Vec<String> = (1..=2).filter(|k| self.x.masses[k - 1].is_finite()).map(term).collect();
        format!("mt = 1/({})", terms.join(" + "))
    }

    fn stick(&self) -> String {
        format!("Js = (1 + et) mt |{}|", self.letter())
    }

    /// What friction gives the second body: in the plane a number, in space a vector and its size.
    fn given(&self, rough: &Friction) -> Vec<Row> {
        match (self.flat(), rough.sticks) {
            (true, true) => vec![self.row("Jt = (1 + et) mt s", Unit::Impulse)],
            (true, false) => vec![self.row("Jt = μ J s/|s|", Unit::Impulse)],
            (false, true) => {
                vec![self.row("Fht = (1 + et) mt σ", Unit::Impulse), self.row("Jt = |Fht|", Unit::Impulse)]
            }
            (false, false) => vec![
                self.row("t = σ/|σ|", Unit::One),
                self.row("Fht = μ J t", Unit::Impulse),
                self.row("Jt = |Fht|", Unit::Impulse),
            ],
        }
    }

    /// The velocities that friction changes: across the line of centres in the plane, as a whole in space.
    fn velocities(&self) -> Vec<Row> {
        let whole = (!self.flat()).then(|| self.row("Fh = Fhn + Fht", Unit::Impulse));
        let row = |k: usize| {
            let sign = if k == 1 { "-" } else { "+" };
            let source = match (self.flat(), self.x.masses[k - 1].is_finite()) {
                (true, true) => format!("vn{k}' = vn{k} {sign} Jt/m{k}"),
                (true, false) => format!("vn{k}' = vn{k}"),
                (false, true) => format!("v{k}' = v{k} {sign} Fh/m{k}"),
                (false, false) => format!("v{k}' = v{k}"),
            };
            self.row(&source, Unit::Velocity)
        };
        whole.into_iter().chain([row(1), row(2)]).collect()
    }

    fn spins(&self) -> Vec<Row> {
        let row = |k: usize| {
            let source = match (self.flat(), self.x.masses[k - 1].is_finite()) {
                (true, true) => format!("ω{k}' = ω{k} - R{k} Jt/I{k}"),
                (true, false) => format!("ω{k}' = ω{k}"),
                (false, true) => format!("Ω{k}' = Ω{k} - R{k}/I{k} M"),
                (false, false) => format!("Ω{k}' = Ω{k}"),
            };
            self.row(&source, Unit::Spin)
        };
        let lever = (!self.flat()).then(|| self.row("M = n × Fht", Unit::Impulse));
        lever.into_iter().chain((1..=2).filter(|k| self.spins_count(k - 1)).map(row)).collect()
    }

    fn slipping(&mut self) {
        self.say(if self.flat() { Phrase::SlippingSays2 } else { Phrase::SlippingSays3 }, &[]);
        let across = |k: &str| match self.flat() {
            true => self.row(&format!("vn{k} = vy{k} nx - vx{k} ny"), Unit::Velocity),
            false => self.row(&format!("vt{k} = v{k} - vp{k} n"), Unit::Velocity),
        };
        self.show([across("1"), across("2")].into_iter().chain(self.slip("")).collect());
        self.say(if self.x.wall().is_some() { Phrase::SlippingMassWall } else { Phrase::SlippingMass }, &[]);
        let finite = (1..=2).filter(|k| self.x.masses[k - 1].is_finite());
        let mut rows: Vec<Row> = finite.map(|k| self.row(&format!("I{k} = k{k} m{k} R{k}^2"), Unit::Inertia)).collect();
        rows.push(self.row(&self.tangential_mass(), Unit::Mass));
        self.show(rows);
        self.close(None, Phrase::Slipping);
    }

    fn sticking(&mut self, rough: &Friction) {
        self.say(Phrase::StickingSays, &[]);
        self.show(vec![self.row(&self.stick(), Unit::Impulse), self.row("μ J", Unit::Impulse)]);
        let choice = |holds: bool, when: &str, then: Phrase| Choice {
            holds,
            when: vec![Inline::Formula(relations(when))],
            then: self.words(then),
        };
        let choices =
            vec![choice(rough.sticks, "Js ≤ μ J", Phrase::Sticks), choice(!rough.sticks, "Js > μ J", Phrase::Slips)];
        self.add(Item::Choices(choices));
        self.say(Phrase::StickingGives, &[]);
        self.show(self.given(rough));
        let degrees = |above: f64, below: f64| {
            Inline::Quantity(Value::Scalar(libm::atan2(above, below).to_degrees()), Unit::Degree)
        };
        let places = [("a", degrees(rough.impulse, self.x.impulse)), ("b", degrees(self.x.friction, 1.0))];
        self.say(if rough.sticks { Phrase::Cone } else { Phrase::ConeEdge }, &places);
        self.close(None, Phrase::Sticking);
    }

    fn turning(&mut self, rough: &Friction) {
        self.say(if self.flat() { Phrase::TurningVelocities } else { Phrase::TurningWhole }, &[]);
        self.show(self.velocities());
        self.say(if self.x.wall().is_some() { Phrase::TurningSpinWall } else { Phrase::TurningSpins }, &[]);
        self.show(self.spins());
        self.say(if rough.sticks { Phrase::TurningStuck } else { Phrase::TurningSlipped }, &[]);
        // In space the whole way would be long; the slip has its own mass.
        let left = if self.flat() { self.slip("'") } else { vec![self.row("σ' = σ - Fht/mt", Unit::Velocity)] };
        self.show(left);
        self.close(None, Phrase::Turning);
    }

    /// What friction takes, as a row of the energies.
    pub(super) fn lost_to_friction(&self, rough: &Friction) -> Row {
        let s = self.letter();
        let size = if self.flat() { "|Jt|" } else { "Jt" };
        let source = if rough.sticks {
            format!("Qt = ½ mt (1 - et^2) |{s}|^2")
        } else {
            format!("Qt = {size} |{s}| - {size}^2/(2 mt)")
        };
        self.row(&source, Unit::Energy)
    }
}
