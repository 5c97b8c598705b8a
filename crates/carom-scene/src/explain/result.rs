//! What comes out: the table before and after, the energy that is lost, the checks and the special cases.
use super::teller::Teller;
use super::words::{Phrase, relations};
use super::{Balance, Explanation, Formula, Inline, Item, Letter, Row, Side, Special, Table, Unit, Value};

impl Teller<'_> {
    /// Everything after the lecture's steps.
    pub(super) fn outcome(&mut self) {
        self.result();
        self.checks();
        self.cases();
    }

    fn result(&mut self) {
        let x = self.x;
        let mut head = vec![vec![], self.words(Phrase::Before), self.words(Phrase::After)];
        // Three vectors of space side by side do not fit a terminal.
        let with_change = x.dim < 3;
        if with_change {
            head.push(self.words(Phrase::Change));
        }
        head.push(self.words(Phrase::HeadUnit));
        let quantities = ["v1", "v2", "p1", "p2", "P", "ω1", "ω2", "Ω1", "Ω2", "K"];
        let rows = quantities.into_iter().filter_map(|name| {
            let (before, after) = (self.values.get(name)?, self.values.get(&format!("{name}'"))?);
            let unit = match name {
                "v1" | "v2" => Unit::Velocity,
                "ω1" | "ω2" | "Ω1" | "Ω2" => Unit::Spin,
                "K" => Unit::Energy,
                _ => Unit::Momentum,
            };
            let quantity = |v: Value| vec![Inline::Quantity(v, Unit::One)];
            let mut row = vec![
                vec![Inline::Formula(vec![(String::new(), Formula::Letter(Letter(name.into())))])],
                quantity(before.clone()),
                quantity(after.clone()),
            ];
            if with_change {
                row.push(quantity(change(before, after)));
            }
            row.push(vec![Inline::Words(unit.symbol().into())]);
            Some(row)
        });
        let rows = rows.collect();
        self.add(Item::Table(Table { head, rows }));
        if x.rough.is_some() {
            // The energies below spell the spins out.
        } else if x.spin_energy > 0.0 {
            let spins = Inline::Quantity(Value::Scalar(x.spin_energy), Unit::Energy);
            self.say(Phrase::EnergyOfSpins, &[("R", spins)]);
        } else if x.before.spin.iter().flatten().any(|w| *w != 0.0) {
            self.say(Phrase::SpinEnergyUnknown, &[]);
        }
        if x.work != 0.0 {
            self.say(Phrase::WorkSays, &[("W", self.quantity("W", Unit::Energy))]);
        }
        if x.meets() {
            self.say(if x.rough.is_some() { Phrase::LostSaysRough } else { Phrase::LostSays }, &[]);
            self.show(["", "'"].iter().map(|prime| self.row(&kinetic(x, prime), Unit::Energy)).collect());
            let mass = self.row(&self.reduced_mass(), Unit::Mass);
            match &x.rough {
                Some(rough) => {
                    let friction = self.lost_to_friction(rough);
                    self.show(vec![mass, self.row("Qn = ½ mn (1 - e^2) u^2", Unit::Energy), friction]);
                    self.show(vec![self.row("Q = Qn + Qt", Unit::Energy)]);
                }
                None => self.show(vec![mass, self.row("Q = ½ μ (1 - e^2) u^2", Unit::Energy)]),
            }
        }
        self.close(None, Phrase::Result);
    }

    fn checks(&mut self) {
        let x = self.x;
        let mut checks = Vec::new();
        for check in &x.checks {
            let (name, source, unit) = match check.balance {
                Balance::Momentum => (Phrase::CheckMomentum, momentum(x), Unit::Momentum),
                Balance::Restitution if !x.meets() => continue,
                Balance::Restitution => (Phrase::CheckRestitution, "u' - e u", Unit::Velocity),
                Balance::Energy if x.work != 0.0 => (Phrase::CheckEnergy, "K + W - K' - Q", Unit::Energy),
                Balance::Energy => (Phrase::CheckEnergy, "K - K' - Q", Unit::Energy),
            };
            checks.push((check.holds, self.words(name), self.remainder(source, unit, check.holds)));
        }
        self.add(Item::Checks(checks));
        self.close(None, Phrase::Checks);
    }

    /// A balance that leaves nothing, up to the rounding that the check has weighed.
    fn remainder(&self, source: &str, unit: Unit, holds: bool) -> Row {
        let formula = relations(source).swap_remove(0).1;
        let value = self.values.evaluate(&formula).unwrap_or(Value::Scalar(f64::NAN));
        let left = match value {
            Value::Scalar(_) if holds => Value::Scalar(0.0),
            Value::Vector(v) if holds => Value::Vector(vec![0.0; v.len()]),
            other => other,
        };
        let numbers = self.values.put(&formula, false);
        let side = |formula: Formula, unit: Unit, result: bool| Side { relation: "=", formula, unit, result };
        let sides =
            vec![side(formula, Unit::One, false), side(numbers, Unit::One, false), side(left.formula(), unit, true)];
        Row { sides, tick: false }
    }

    fn cases(&mut self) {
        let x = self.x;
        if x.special.is_empty() {
            return;
        }
        let along = x.dim > 1;
        let say = |case: &Special| {
            let (phrase, place) = match case {
                Special::Parting => (Phrase::CaseParting, None),
                Special::Exchange if along => (Phrase::CaseExchangeAlong, None),
                Special::Exchange => (Phrase::CaseExchange, None),
                Special::Common => {
                    let phrase = if along { Phrase::CaseCommonAlong } else { Phrase::CaseCommon };
                    (phrase, Some(self.quantity(if along { "vp2'" } else { "v2'" }, Unit::Velocity)))
                }
                Special::Wall => {
                    let wall = x.wall().unwrap_or(1);
                    let rests = x.before.velocity[wall].iter().all(|v| *v == 0.0);
                    (if rests { Phrase::CaseWall } else { Phrase::CaseDriven }, None)
                }
                Special::RightAngle => (Phrase::CaseRightAngle, None),
                Special::Rolls => (Phrase::CaseRolls, None),
                Special::Superball => (Phrase::CaseSuperball, None),
                Special::CentreOfMass => {
                    let total = x.masses[0] + x.masses[1];
                    let velocity = match self.values.get("P") {
                        Some(Value::Scalar(p)) => Value::Scalar(p / total),
                        Some(Value::Vector(p)) => Value::Vector(p.iter().map(|p| p / total).collect()),
                        None => Value::Scalar(f64::NAN),
                    };
                    (Phrase::CaseCentre, Some(Inline::Quantity(velocity, Unit::Velocity)))
                }
            };
            let places: Vec<(&str, Inline)> = place.into_iter().map(|p| ("V", p)).collect();
            phrase.fill(self.language, &places)
        };
        let points = x.special.iter().map(say).collect();
        self.add(Item::Points(points));
        self.close(None, Phrase::Cases);
    }
}

/// The kinetic energy of the bodies of finite mass, `prime` for after.
fn kinetic(x: &Explanation, prime: &str) -> String {
    let moving = [1, 2].into_iter().filter(|k| x.masses[k - 1].is_finite());
    let (open, close) = if x.dim == 1 { ("", "") } else { ("|", "|") };
    let mut terms: Vec<String> = moving.clone().map(|k| format!("½ m{k} {open}v{k}{prime}{close}^2")).collect();
    if x.rough.is_some() {
        terms.extend(
            moving
                .map(|k| if x.dim == 2 { format!("½ I{k} ω{k}{prime}^2") } else { format!("½ I{k} |Ω{k}{prime}|^2") }),
        );
    } else if x.spin_energy > 0.0 {
        terms.push("R".into());
    }
    format!("K{prime} = {}", terms.join(" + "))
}

/// The balance of momentum: of both bodies, or of the one against what it was given.
fn momentum(x: &Explanation) -> &'static str {
    match x.wall() {
        Some(0) => "p2' - p2 - Fh2",
        Some(_) => "p1' - p1 - Fh1",
        None => "P' - P",
    }
}

/// After minus before; what is only rounding noise of the two is zero.
fn change(before: &Value, after: &Value) -> Value {
    let one = |(b, a): (&f64, &f64)| {
        let d = a - b;
        if d.abs() < 8.0 * f64::EPSILON * a.abs().max(b.abs()) { 0.0 } else { d }
    };
    let changes: Vec<f64> = before.numbers().iter().zip(after.numbers()).map(one).collect();
    Value::from(changes.as_slice())
}
