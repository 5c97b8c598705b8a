//! `carom explain`: one impact, the lecture's chain with the numbers put in.
use crate::event::{self, Event};
use crate::figures::digits;
use crate::instant;
use crate::minus::{list, number};
use crate::source::Changes;
use crate::trouble::{Trouble, colour, print};
use carom::Law;
use carom_scene::explain::{Explanation, Language, Question};
use clap::{Args, ValueEnum};

const EXAMPLES: &str = "\
Examples:
  carom explain --mass 2 1 --velocity 3 -1 --restitution 0.5                    on a line
  carom explain --mass 2 3 --velocity 5,0 -1,2 --normal 3,4 --restitution 0.5   in the plane
  carom explain --mass 1 4 --velocity 7,0,0 0,0,0 --normal 2,3,6                in space
  carom explain --mass inf 2 --velocity 0 -3 --duration 0.01                    a wall and a ball
  carom explain --mass 1 inf --velocity 3,-2 0,0 --normal 0,-1 --friction 0.3 --radius 0.1 --spin 20
                                                                                friction and spin on a floor
  carom explain oblique --event 1                                               an impact of a scene

Values for the two bodies follow one another (--mass 2 1) or repeat the option (--mass 2 --mass 1).
The components of a vector are separated by commas, without spaces. SI units: kg, m/s, s, rad/s.";

/// Explain one impact, step by step, with the numbers put in
///
/// Two balls meet, or a ball and a wall, on a line, in the plane or in space; how many components the velocities have says
/// which. With --friction the surfaces stick or slip and turn the balls.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Explain {
    /// A scene instead of numbers: explain one of its impacts
    #[arg(requires = "event", conflicts_with_all = ["mass", "velocity", "normal", "spin", "radius", "inertia", "restitution", "friction", "tangential", "law"])]
    scene: Option<String>,
    /// Which impact of the scene: the line of `carom events`, from 1
    #[arg(long, value_name = "N", requires = "scene", value_parser = line, help_heading = SCENE)]
    event: Option<u64>,
    #[command(flatten, next_help_heading = SCENE)]
    changes: Changes,

    /// Masses of the two bodies, kg; inf for a wall
    #[arg(long, value_name = "M1 M2", num_args = 1.., value_parser = List, help_heading = BODIES)]
    mass: Vec<Numbers>,
    /// Velocities, m/s: 3 -1 on a line, 5,0 -1,2 in the plane, three numbers each in space
    #[arg(long, value_name = "V1 V2", num_args = 1.., value_parser = List, help_heading = BODIES)]
    velocity: Vec<Numbers>,
    /// Line of centres from the first body to the second, of any length [on a line: 1]
    #[arg(long, value_name = "N", num_args = 1.., value_parser = List, help_heading = BODIES)]
    normal: Vec<Numbers>,
    /// Spins, rad/s: one number each in the plane (counter-clockwise), three in space; with a wall that of the ball alone
    /// will do [default: none]
    #[arg(long, value_name = "W1 W2", num_args = 1.., value_parser = List, help_heading = BODIES)]
    spin: Vec<Numbers>,
    /// Radii, m: with them the energy counts the spins; friction needs them; with a wall that of the ball alone will do
    #[arg(long, value_name = "R1 R2", num_args = 1.., value_parser = List, help_heading = BODIES)]
    radius: Vec<Numbers>,
    /// k in the moment of inertia k m R^2 [default: 0.5 in the plane, 0.4 in space]
    #[arg(long, value_name = "K1 K2", num_args = 1.., value_parser = List, help_heading = BODIES)]
    inertia: Vec<Numbers>,

    /// Coefficient of restitution e: 1 elastic, 0 perfectly inelastic
    #[arg(long, value_name = "E", default_value = "1", value_parser = number, help_heading = IMPACT)]
    restitution: f64,
    /// Coulomb's coefficient of friction mu; needs --radius
    #[arg(long, value_name = "MU", default_value = "0", value_parser = number, help_heading = IMPACT)]
    friction: f64,
    /// Tangential restitution in [-1, 1]: 0 the slip stops, 1 it turns round (superball); matters only with friction
    #[arg(long, value_name = "ET", default_value = "0", value_parser = number, help_heading = IMPACT)]
    tangential: f64,
    /// The law of the impact: chatterjee-ruina, stronge or newton; for balls the last two know no tangential restitution
    #[arg(long, value_name = "LAW", default_value = "chatterjee-ruina", value_parser = law, help_heading = IMPACT)]
    law: Law,
    /// How long the contact lasts, s: adds the mean force
    #[arg(long, value_name = "S", value_parser = number, help_heading = IMPACT)]
    duration: Option<f64>,

    /// How to write it
    #[arg(long, value_enum, default_value = "text", help_heading = OUTPUT)]
    format: Format,
    /// The language of text, markdown and latex: en, or pt-BR with a decimal comma
    #[arg(long, value_name = "LANG", default_value = "en", value_parser = clap::value_parser!(Language), help_heading = OUTPUT)]
    lang: Language,
}

const SCENE: &str = "An impact of a scene";
const BODIES: &str = "The two bodies";
const IMPACT: &str = "The impact";
const OUTPUT: &str = "Output";

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// for a terminal
    Text,
    /// for a page
    Markdown,
    /// for a document with amsmath
    Latex,
    /// for programs
    Json,
}

/// One argument: a number, or several with commas between.
type Numbers = Vec<f64>;

/// Reads [`Numbers`].
#[derive(Clone)]
struct List;

impl clap::builder::TypedValueParser for List {
    type Value = Numbers;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &std::ffi::OsStr,
    ) -> Result<Numbers, clap::Error> {
        let parse = |text: &str| list(text);
        parse.parse_ref(command, argument, value)
    }
}

impl Explain {
    pub fn run(mut self) -> Result<(), Trouble> {
        let (format, language) = (self.format, self.lang);
        if let (Some(scene), Some(n)) = (self.scene.take(), self.event) {
            let event = event::find(scene, self.changes, n)?;
            let Some(explanation) = event.alone(self.duration)? else {
                return print(&match format {
                    Format::Text => instant::text(&event, language, colour()),
                    Format::Json => instant::json(&event),
                    Format::Markdown => instant::markdown(&event, language),
                    Format::Latex => instant::latex(&event, language),
                });
            };
            return print(&show(&explanation, format, language, Some(title(&event, language))));
        }
        if !self.changes.set.is_empty() || !self.changes.until.is_empty() {
            return Err(Trouble::usage(
                "--set and --until change a scene; name one, as in carom explain oblique --event 1",
            ));
        }
        let explanation = self.question()?.answer().map_err(|m| Trouble::usage(format!("--{}: {}", m.key, m.rule)))?;
        print(&show(&explanation, format, language, None))
    }

    fn question(self) -> Result<Question, Trouble> {
        if self.mass.is_empty() && self.velocity.is_empty() {
            let message = "explain needs two bodies: their masses and their velocities";
            return Err(Trouble::usage(format!(
                "{message}\n\n{EXAMPLES}\n\n`carom explain --help` lists all options."
            )));
        }
        for (given, key, like) in [(&self.mass, "mass", "--mass 2 1"), (&self.velocity, "velocity", "--velocity 3 -1")]
        {
            if given.is_empty() {
                return Err(Trouble::usage(format!("--{key} is missing; for example {like}")));
            }
        }
        let masses = pair("mass", self.mass)?;
        let mut question = Question::new(masses, velocities(self.velocity)?);
        question.normal = (!self.normal.is_empty()).then(|| self.normal.concat());
        question.restitution = self.restitution;
        question.friction = self.friction;
        question.tangential = self.tangential;
        question.law = self.law;
        question.duration = self.duration;
        let wall = masses.iter().position(|m| m.is_infinite());
        let mut spin = self.spin;
        if let ([one], Some(wall)) = (spin.as_slice(), wall) {
            let still = vec![0.0; one.len()];
            spin.insert(wall, still);
        }
        question.spin = two("spin", spin)?;
        question.radius = optional("radius", beside(self.radius, wall))?;
        question.inertia = optional("inertia", beside(self.inertia, wall))?;
        Ok(question)
    }
}

/// Of a wall neither radius nor inertia counts, so one number is the ball's.
fn beside(given: Vec<Numbers>, wall: Option<usize>) -> Vec<Numbers> {
    let mut all = given.concat();
    if let ([one], Some(wall)) = (all.as_slice(), wall) {
        let same = *one;
        all.insert(wall, same);
    }
    if all.is_empty() { Vec::new() } else { vec![all] }
}

/// A law by its name.
fn law(name: &str) -> Result<Law, String> {
    Law::named(name).ok_or_else(|| format!("expected one of {}", Law::ALL.map(Law::as_str).join(", ")))
}

/// The explanation in this format, under a title of its own if it has one.
fn show(explanation: &Explanation, format: Format, language: Language, title: Option<String>) -> String {
    let mut chain = explanation.chain(language);
    chain.title = title.unwrap_or(chain.title);
    match format {
        Format::Text => chain.text(colour()),
        Format::Markdown => chain.markdown(),
        Format::Latex => chain.latex(),
        Format::Json => explanation.json(),
    }
}

/// The number of an impact.
fn line(text: &str) -> Result<u64, String> {
    match text.trim().parse() {
        Ok(n) if n > 0 => Ok(n),
        _ => Err("impacts are counted from 1, as in the lines of `carom events`".into()),
    }
}

/// Which impact it is, and who is 1 and 2.
fn title(event: &Event, language: Language) -> String {
    let line = event.line();
    let ([a, b], time) = (&line.bodies, digits(line.time, 8));
    match language {
        Language::English => format!("Impact {} of {}, t = {time} s: {a} (1) meets {b} (2)", line.n, event.ready.name),
        _ => {
            let time = time.replace('.', ",");
            format!("Impacto {} de {}, t = {time} s: {a} (1) e {b} (2)", line.n, event.ready.name)
        }
    }
}

/// One number for each body, however the list was written.
fn pair(key: &str, given: Vec<Numbers>) -> Result<[f64; 2], Trouble> {
    let all = given.concat();
    <[f64; 2]>::try_from(all.as_slice())
        .map_err(|_| Trouble::usage(format!("--{key} expects 2 numbers, one for each body; got {}", all.len())))
}

fn optional(key: &str, given: Vec<Numbers>) -> Result<Option<[f64; 2]>, Trouble> {
    if given.is_empty() { Ok(None) } else { pair(key, given).map(Some) }
}

fn two(key: &str, given: Vec<Numbers>) -> Result<Option<[Numbers; 2]>, Trouble> {
    if given.is_empty() {
        return Ok(None);
    }
    let got = given.len();
    <[Numbers; 2]>::try_from(given)
        .map(Some)
        .map_err(|_| Trouble::usage(format!("--{key} expects 2 values, one for each body; got {got}")))
}

fn velocities(given: Vec<Numbers>) -> Result<[Numbers; 2], Trouble> {
    <[Numbers; 2]>::try_from(given).map_err(|given| {
        let flat = given.concat();
        let list = |v: &[f64]| v.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let hint = match (given.len(), given[0].len()) {
            (1, 2) => format!(
                "{0} is one velocity in the plane. On a line: --velocity {1} {2}. In the plane: --velocity {0} 0,0",
                list(&flat),
                flat[0],
                flat[1]
            ),
            (1, n) => format!("for a second body at rest: --velocity {} {}", list(&flat), list(&vec![0.0; n])),
            (4 | 6, 1) => {
                let (first, second) = flat.split_at(flat.len() / 2);
                format!("commas join the components of one vector: --velocity {} {}", list(first), list(second))
            }
            _ => "for example --velocity 3 -1, or in the plane --velocity 5,0 -1,2".into(),
        };
        Trouble::usage(format!("--velocity expects 2 velocities, one for each body; got {}: {hint}", given.len()))
    })
}
