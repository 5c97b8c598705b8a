//! An instant at which several contacts exchanged impulses: the contacts, both ends of the instant, and the accounts.
use crate::event::Event;
use crate::figures::{NOISE, digits};
use crate::table::{Table, escape};
use crate::tally::numbers;
use carom_scene::explain::{Language, Question, slips};
use carom_scene::model::Together;
use carom_scene::output::{ImpactLine, Motion};
use serde_json::json;
use std::collections::BTreeMap;

/// One body of the instant.
struct Member<'a> {
    name: &'a str,
    mass: Option<f64>,
    /// Moment of inertia, kg m2.
    inertia: f64,
    before: &'a Motion,
    after: &'a Motion,
}

/// Words, and the decimal sign.
struct Pen(Language);

impl Pen {
    fn say(&self, english: &'static str, portuguese: &'static str) -> &'static str {
        if self.0 == Language::English { english } else { portuguese }
    }

    fn number(&self, text: String) -> String {
        if self.0 == Language::English { text } else { text.replace('.', ",") }
    }

    fn vector(&self, v: &[f64], scale: f64) -> String {
        let one = |x: &f64| self.number(digits(if x.abs() <= NOISE * scale { 0.0 } else { *x }, 5));
        let all: Vec<String> = v.iter().map(one).collect();
        match &all[..] {
            [x] => x.clone(),
            all => format!("({})", all.join(self.say(", ", "; "))),
        }
    }
}

/// As JSON: the time, how many contacts, by which operator, and the lines of `carom events`.
pub fn json(event: &Event) -> String {
    let line = event.line();
    let contacts: Vec<String> = event.lines.iter().map(|l| format!("    {}", l.json())).collect();
    format!(
        "{{\n  \"time\": {},\n  \"together\": {},\n  \"operator\": {},\n  \"contacts\": [\n{}\n  ]\n}}\n",
        json!(line.time),
        line.together,
        json!(event.ready.scene.run.together.name()),
        contacts.join(",\n")
    )
}

/// For people.
pub fn text(event: &Event, language: Language, colour: bool) -> String {
    let sheet = sheet(event, language);
    let mut text = format!("\n  {}\n\n{}\n", sheet.title, sheet.operator);
    for (table, note) in &sheet.tables {
        text += &table.text(colour);
        if let Some(note) = note {
            text += &format!("  ({note})\n");
        }
        text.push('\n');
    }
    text
}

/// For a page.
pub fn markdown(event: &Event, language: Language) -> String {
    let sheet = sheet(event, language);
    let mut text = format!("# {}\n\n{}\n$$\n{}\n$$\n", sheet.title, flowing(sheet.operator), sheet.system);
    for (table, note) in &sheet.tables {
        text += &format!("\n{}", table.markdown());
        if let Some(note) = note {
            text += &format!("\n{note}\n");
        }
    }
    text
}

/// For a paper: a section, to be input.
pub fn latex(event: &Event, language: Language) -> String {
    let sheet = sheet(event, language);
    let operator = escape(&flowing(sheet.operator).replace('`', ""));
    let mut text = format!("\\section*{{{}}}\n{operator}\\[\n  {}\n\\]\n", escape(&sheet.title), sheet.system);
    for (table, note) in &sheet.tables {
        text += &format!("\n\\begin{{center}}\n{}\\end{{center}}\n", table.latex());
        if let Some(note) = note {
            text += &format!("{}.\n", escape(note));
        }
    }
    text
}

/// Lines of the terminal as one paragraph.
fn flowing(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ") + "\n"
}

/// What there is to say, for each format to set.
struct Sheet {
    title: String,
    /// What the operator does, in lines of the terminal, and the system that it solves.
    operator: &'static str,
    system: &'static str,
    /// Tables, and what is to be said of them.
    tables: Vec<(Table, Option<String>)>,
}

fn sheet(event: &Event, language: Language) -> Sheet {
    let pen = Pen(language);
    let asked = event.line();
    let title = match language {
        Language::English => format!(
            "{} contacts at one instant, t = {} s, in {}",
            event.lines.len(),
            digits(asked.time, 8),
            event.ready.name
        ),
        _ => format!(
            "{} contatos no mesmo instante, t = {} s, em {}",
            event.lines.len(),
            pen.number(digits(asked.time, 8)),
            event.ready.name
        ),
    };
    let mut tables = Vec::new();
    let mut table = Table::new(
        "rlrrrrr",
        [
            "n",
            pen.say("contact", "contato"),
            pen.say("approach", "aproximação"),
            "e",
            pen.say("departure", "afastamento"),
            pen.say("impulse N s", "impulso N s"),
            pen.say("lost J", "perdida J"),
        ],
    );
    for line in &event.lines {
        let mark = if line.n == asked.n { "> " } else { "" };
        let mut row = vec![format!("{mark}{}", line.n), line.bodies.join(" - ")];
        row.extend(numbers(line).map(|x| pen.number(x)));
        table.row(row);
    }
    let note = pen.say(
        "impulses are summed over the iterations; approach 0 or less: a contact that transmits",
        "impulsos somados sobre as iterações; aproximação 0 ou menor: um contato que transmite",
    );
    tables.push((table, Some(note.to_string())));
    tables.extend(friction(event, &pen));
    let members = members(event);
    let fastest = members
        .iter()
        .flat_map(|m| m.before.velocity.iter().chain(&m.after.velocity))
        .fold(0.0, |most: f64, v| most.max(v.abs()));
    let spins = members.iter().flat_map(|m| m.before.spin.iter().chain(&m.after.spin)).any(|w| *w != 0.0);
    let mut head = vec![
        pen.say("body", "corpo"),
        pen.say("mass kg", "massa kg"),
        pen.say("v before m/s", "v antes m/s"),
        pen.say("v after m/s", "v depois m/s"),
    ];
    if spins {
        head.extend([pen.say("spin before", "giro antes"), pen.say("spin after", "giro depois")]);
    }
    let mut table = Table::new("lrrrrr", head);
    for m in &members {
        let mass = m.mass.map_or("inf".to_string(), |mass| pen.number(digits(mass, 5)));
        let mut row = vec![
            m.name.to_string(),
            mass,
            pen.vector(&m.before.velocity, fastest),
            pen.vector(&m.after.velocity, fastest),
        ];
        if spins {
            row.extend([pen.vector(&m.before.spin, 0.0), pen.vector(&m.after.spin, 0.0)]);
        }
        table.row(row);
    }
    tables.push((table, None));
    tables.push(accounts(event, &members, &pen));
    let together = event.ready.scene.run.together;
    Sheet { title, operator: operator(together, &pen), system: system(together), tables }
}

/// Where surfaces rub: the tangential impulse beside the cone of the normal one, and whether they stick or slip.
fn friction(event: &Event, pen: &Pen) -> Option<(Table, Option<String>)> {
    let plan = &event.ready.plan;
    let mut table = Table::new(
        "rlrrrrl",
        [
            "n",
            pen.say("friction", "atrito"),
            pen.say("slip m/s", "deslize m/s"),
            pen.say("after", "depois"),
            "|J_t| N s",
            "mu J N s",
            "",
        ],
    );
    let mut any = false;
    let still = event.lines.iter().map(|l| l.approach.abs()).fold(0.0, f64::max);
    for (line, &parties) in event.lines.iter().zip(&event.parties) {
        let mu = Question::of_contact(plan, parties, line).friction;
        let tangential = line.friction_impulse.iter().map(|j| j * j).sum::<f64>().sqrt();
        if !(mu > 0.0) {
            continue;
        }
        any = true;
        let [before, after] = slips(plan, parties, line);
        let limit = mu * line.impulse;

        let said = if tangential < limit * (1.0 - 1e-9) {
            pen.say("inside the cone", "dentro do cone")
        } else {
            pen.say("on the cone, slips", "sobre o cone, desliza")
        };
        let number = |x: f64, scale: f64| pen.vector(&[x], scale);
        table.row([
            line.n.to_string(),
            line.bodies.join(" - "),
            number(before, still),
            number(after, still),
            number(tangential, limit),
            number(limit, 0.0),
            said.to_string(),
        ]);
    }
    let note = pen.say(
        "friction is solved for all contacts, with their normal impulses as they are: inside the cone the slip ends; what is left after\n  comes from the projection that opens what friction closed",
        "o atrito é resolvido para todos os contatos, com seus impulsos normais: dentro do cone o deslize acaba; o que resta depois\n  vem da projeção que abre o que o atrito fechou",
    );
    any.then(|| (table, Some(note.to_string())))
}

/// Momentum and energy of the bodies that move, before and after.
fn accounts(event: &Event, members: &[Member<'_>], pen: &Pen) -> (Table, Option<String>) {
    let dim = event.line().point.len();
    let momentum = |of: &dyn Fn(&Member<'_>) -> Vec<f64>| -> Vec<f64> {
        (0..dim).map(|k| members.iter().filter_map(|m| Some(m.mass? * of(m)[k])).sum()).collect()
    };
    let (p, after) = (momentum(&|m| m.before.velocity.clone()), momentum(&|m| m.after.velocity.clone()));
    let scale: f64 = members
        .iter()
        .filter_map(|m| {
            Some(m.mass? * m.before.velocity.iter().chain(&m.after.velocity).fold(0.0, |a: f64, v| a.max(v.abs())))
        })
        .sum();
    // What stands fast or is driven pushes from outside: +J n on the second, -J n on the first.
    let mut given = vec![0.0; dim];
    for (line, parties) in event.lines.iter().zip(&event.parties) {
        let free = parties.map(|k| k.is_some_and(|k| event.ready.plan.bodies.get(k).is_some_and(|b| !b.fixed)));
        let sign = match free {
            [true, false] => -1.0,
            [false, true] => 1.0,
            _ => 0.0,
        };
        for k in 0..dim {
            given[k] += sign * (line.impulse * line.normal[k] + line.friction_impulse[k]);
        }
    }
    let square = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>();
    let energy = |m: &Member<'_>, motion: &Motion| {
        m.mass.map_or(0.0, |mass| 0.5 * (mass * square(&motion.velocity) + m.inertia * square(&motion.spin)))
    };
    let k0: f64 = members.iter().map(|m| energy(m, m.before)).sum();
    let k1: f64 = members.iter().map(|m| energy(m, m.after)).sum();
    let lost: f64 = event.lines.iter().map(|l| l.lost).sum();
    let mut table = Table::new(
        "lrrr",
        [
            pen.say("accounts", "balanços"),
            pen.say("before", "antes"),
            pen.say("given", "recebido"),
            pen.say("after", "depois"),
        ],
    );
    let name = pen.say("momentum, kg m/s", "momento, kg m/s");
    table.row([name.to_string(), pen.vector(&p, scale), pen.vector(&given, scale), pen.vector(&after, scale)]);
    let name = pen.say("kinetic energy, J", "energia cinética, J");
    let given = k1 - k0;
    table.row([name.to_string(), pen.vector(&[k0], k0), pen.vector(&[given], k0.max(k1)), pen.vector(&[k1], k0)]);
    let total = pen.say("lost by all contacts together", "perdida por todos os contatos juntos");
    let note = format!("{total}: {} J", pen.vector(&[lost], k0.max(k1)));
    (table, Some(note))
}

/// The system that the operator solves, in TeX: u opens the contacts, Q couples them, A are those that close.
fn system(together: Together) -> &'static str {
    match together {
        Together::Reflect => {
            r"\text{on } A = \{i : u_i < 0\}: \quad 0 \le \lambda \perp u' + E u \ge 0, \quad u' = u + Q \lambda, \quad E = \mathrm{diag}(e_i)"
        }
        Together::Lcp => r"0 \le \lambda \perp u' + E u \ge 0, \quad u' = u + Q \lambda, \quad E = \mathrm{diag}(e_i)",
        Together::Sequential => {
            r"\lambda_i = -(1 + e_i)\, u_i / Q_{ii} \quad \text{for one contact after the other with } u_i < 0"
        }
    }
}

/// What the operator does, in a sentence.
fn operator(together: Together, pen: &Pen) -> &'static str {
    match together {
        Together::Reflect => pen.say(
            "  Operator `reflect` (GR-e): the contacts that close reflect together, and again those\n  that close then, until none does.\n",
            "  Operador `reflect` (GR-e): os contatos que se fecham refletem juntos, e de novo os que\n  então se fecham, até que nenhum se feche.\n",
        ),
        Together::Sequential => pen.say(
            "  Operator `sequential`: one contact after the other, until none closes.\n",
            "  Operador `sequential`: um contato após o outro, até que nenhum se feche.\n",
        ),
        Together::Lcp => pen.say(
            "  Operator `lcp`: Newton's coefficient at all contacts at once.\n",
            "  Operador `lcp`: o coeficiente de Newton em todos os contatos ao mesmo tempo.\n",
        ),
    }
}

/// The bodies of the instant in the order of their numbers; walls are not among them.
fn members(event: &Event) -> Vec<Member<'_>> {
    let mut all: BTreeMap<usize, Member<'_>> = BTreeMap::new();
    for (line, parties) in event.lines.iter().zip(&event.parties) {
        let line: &ImpactLine = line;
        for side in 0..2 {
            let Some(k) = parties[side] else { continue };
            let body = event.ready.plan.bodies.get(k);
            all.entry(k).or_insert(Member {
                name: &line.bodies[side],
                mass: body.filter(|b| !b.fixed).and_then(|b| b.mass),
                inertia: body.map_or(0.0, |b| {
                    let kappa = b.inertia.unwrap_or(if line.point.len() == 2 { 0.5 } else { 0.4 });
                    kappa * b.mass.unwrap_or(0.0) * b.radius * b.radius
                }),
                before: &line.before[side],
                after: &line.after[side],
            });
        }
    }
    all.into_values().collect()
}
