//! The eleven steps of the lecture, with the numbers of one impact put in.
use super::number::is_rounded;
use super::teller::{Teller, read, side};
use super::words::{Phrase, relations};
use super::{Chain, Choice, Explanation, Formula, Inline, Item, Language, Matrices, Piece, Row, Side, Unit, Value};

impl Explanation {
    /// The lecture's chain with the numbers of this impact, in a language.
    pub fn chain(&self, language: Language) -> Chain {
        let mut teller = Teller::new(self, language);
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

impl Teller<'_> {
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
