//! From a line of a run to the question that explains it.
use super::{Explanation, Mistake, Question, origin};
use crate::output::{ImpactLine, Motion};
use crate::plan::Plan;
use carom::law::rough::{self, Turning};
use carom::law::smooth::Moving;
use carom::{Rotates, Vector};

/// How near the lecture's impulse must come to the engine's: what several iterations came to is no impact of the lecture.
const SAME: f64 = 1e-9;

impl Question {
    /// What is asked of an impact of a run: who took part (the numbers of bodies in the plan, none for a wall), and its line.
    /// The coefficients are those that the materials and the pair table give at the speeds of this impact, and say so.
    pub fn of_contact(plan: &Plan, parties: [Option<usize>; 2], line: &ImpactLine) -> Self {
        let bodies = parties.map(|k| k.and_then(|k| plan.bodies.get(k)));
        let mass = |k: usize| bodies[k].filter(|b| !b.fixed).and_then(|b| b.mass).unwrap_or(f64::INFINITY);
        let velocity = [line.before[0].velocity.clone(), line.before[1].velocity.clone()];
        let mut question = Question::new([mass(0), mass(1)], velocity).normal(line.normal.clone());
        question.restitution = line.restitution;
        // Of a wall neither radius nor inertia counts.
        let radius = bodies.map(|b| b.map_or(1.0, |b| b.radius));
        let material = |k: usize| match bodies[k] {
            Some(body) => body.material,
            None => plan.sides.iter().find(|s| s.label == line.bodies[k]).map_or(0, |s| s.material),
        };
        let slip = slip(&line.before, &line.normal, radius);
        question.origins = origin::of(plan, [material(0), material(1)], line, slip);
        if let Some(origins) = &question.origins {
            question.friction = origins.friction.value;
            question.tangential = origins.tangential.value;
            question.law = origins.law;
        }
        let turning = line.before.iter().flat_map(|m| &m.spin).any(|w| *w != 0.0);
        if turning || question.friction > 0.0 {
            let default = if line.point.len() == 2 { 0.5 } else { 0.4 };
            question.spin = Some([line.before[0].spin.clone(), line.before[1].spin.clone()]);
            question.radius = Some(radius);
            question.inertia = Some(bodies.map(|b| b.and_then(|b| b.inertia).unwrap_or(default)));
        }
        question
    }
}

/// How fast the surfaces of the two parties of a contact slip over one another before the instant and after it (m/s).
pub fn slips(plan: &Plan, parties: [Option<usize>; 2], line: &ImpactLine) -> [f64; 2] {
    let radius = parties.map(|k| k.and_then(|k| plan.bodies.get(k)).map_or(1.0, |b| b.radius));
    [&line.before, &line.after].map(|motion| slip(motion, &line.normal, radius))
}

/// How fast the surfaces of two parties that move like this slip over one another (m/s).
fn slip(motion: &[Motion; 2], normal: &[f64], radius: [f64; 2]) -> f64 {
    match normal.len() {
        2 => slip_in::<2>(motion, normal, radius),
        3 => slip_in::<3>(motion, normal, radius),
        _ => 0.0,
    }
}

fn slip_in<const D: usize>(motion: &[Motion; 2], normal: &[f64], radius: [f64; 2]) -> f64
where
    Vector<D>: Rotates,
{
    let vector = |v: &[f64]| Vector::<D>::from_fn(|k| v.get(k).copied().unwrap_or(0.0));
    let ball = |k: usize| Turning {
        moving: Moving::driven(vector(&motion[k].velocity)),
        spin: Vector::<D>::spin_from(&motion[k].spin).unwrap_or_default(),
        radius: radius[k],
        kappa: 1.0,
    };
    rough::slip(&ball(0), &ball(1), vector(normal)).norm()
}

impl Explanation {
    /// The explanation of an impact of a run, if it was alone in its instant and is one that the lecture knows.
    ///
    /// # Errors
    /// What is wrong with the question: masses or velocities that are too large.
    pub fn of_contact(
        plan: &Plan,
        parties: [Option<usize>; 2],
        line: &ImpactLine,
        duration: Option<f64>,
    ) -> Result<Option<Self>, Mistake> {
        if line.together > 1 {
            return Ok(None);
        }
        let mut question = Question::of_contact(plan, parties, line);
        question.duration = duration;
        Self::of_impulse(&question, line.impulse, &line.friction_impulse)
    }

    /// The explanation of what is asked, if the impulses (N s) that the engine found, along the normal and across it, are those of
    /// the lecture.
    ///
    /// # Errors
    /// What is wrong with the question.
    pub fn of_impulse(question: &Question, impulse: f64, friction_impulse: &[f64]) -> Result<Option<Self>, Mistake> {
        let answer = question.answer()?;
        let apart: f64 = answer.friction_impulse.iter().zip(friction_impulse).map(|(a, b)| (a - b).abs()).sum();
        let same = (answer.impulse - impulse).abs() <= SAME * impulse && apart <= SAME * impulse;
        Ok(same.then_some(answer))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Language, Source};
    use super::*;
    use crate::Document;

    /// Two materials, a pair table that names a law, curves of both speeds; the impact as a run would report it.
    fn explained(pair: &str) -> Explanation {
        let scene = format!(
            "carom = 1\n[world]\ndim = 2\n[material.ivory]\nrestitution = 0.9\ntangential = 0.5\n\
             friction = {{ curve = [[0.0, 0.4], [10.0, 0.2]] }}\n[material.felt]\nrestitution = 0.4\ntangential = 0.0\n{pair}\
             [[body]]\nmass = 1.0\nradius = 0.5\nposition = [0.0, 2.0]\nvelocity = [3.0, -1.0]\nspin = [4.0]\n\
             material = \"ivory\"\n[[wall]]\nname = \"floor\"\nplane = {{ point = [0.0, 0.0], normal = [0.0, 1.0] }}\n\
             material = \"felt\"\n[run]\nuntil = {{ impacts = 1 }}\nlaw = \"stronge\"\n"
        );
        let document = Document::parse("bounce.toml", &scene).unwrap();
        let scene = document.scene().unwrap();
        let plan = document.plan(&scene).unwrap();
        let still = Motion { velocity: vec![0.0, 0.0], spin: vec![0.0] };
        let mut line = ImpactLine {
            n: 1,
            time: 1.5,
            bodies: ["body-1".into(), "wall:floor".into()],
            point: vec![4.5, 0.0],
            normal: vec![0.0, -1.0],
            approach: 1.0,
            departure: 0.0,
            restitution: 0.6,
            impulse: 0.0,
            friction_impulse: vec![0.0, 0.0],
            before: [Motion { velocity: vec![3.0, -1.0], spin: vec![4.0] }, still.clone()],
            after: [still.clone(), still],
            lost: 0.0,
            together: 1,
        };
        // What a run that follows the law would have reported.
        let answer = Question::of_contact(&plan, [Some(0), None], &line).answer().unwrap();
        (line.impulse, line.friction_impulse) = (answer.impulse, answer.friction_impulse.clone());
        let explained = Explanation::of_contact(&plan, [Some(0), None], &line, None).unwrap().unwrap();
        line.friction_impulse[0] += 1e-3;
        assert_eq!(Explanation::of_contact(&plan, [Some(0), None], &line, None).unwrap(), None, "another impact");
        explained
    }

    #[test]
    fn coefficients_tell_where_they_come_from() {
        let x = explained("");
        let origins = x.origins.clone().unwrap();
        let materials = ["ivory".to_owned(), "felt".to_owned()];
        // e = sqrt(0.9 0.4) = 0.6; the surface slips at 3 + 0.5 4 = 5 m/s, where the curve of ivory alone reads 0.3;
        // e_t = (0.5 + 0)/2, which Stronge's law does not know.
        assert_eq!(origins.restitution.source, Source::Both { materials, said: [0.9, 0.4] });
        assert!((origins.restitution.value - 0.6).abs() < 1e-15);
        assert!((origins.friction.value - 0.3).abs() < 1e-15 && origins.friction.speed == Some(5.0));
        assert_eq!(origins.friction.source, Source::One { material: "ivory".into() });
        assert_eq!((origins.tangential.value, x.law), (0.25, carom::Law::Stronge));
        let friction = x.rough.as_ref().unwrap();
        assert_eq!(friction.slip[0], [5.0, 0.0]);
        let text = x.chain(Language::Portuguese).text(false);
        println!("{text}");
        for words in
            ["média geométrica de 0,9 (ivory) e 0,4 (felt)", "material: ivory, curva lida a 5 m/s", "de Stronge"]
        {
            assert!(text.contains(words), "{words}");
        }
        let json: serde_json::Value = serde_json::from_str(&x.json()).unwrap();
        assert_eq!(json["origins"]["friction"]["from"], "one");
        assert_eq!(json["origins"]["law"], "stronge");
    }

    #[test]
    fn a_line_of_the_pair_table_says_so() {
        let line = "[[pair]]\nmaterials = [\"felt\", \"ivory\"]\nrestitution = 0.6\nfriction = 0.1\nlaw = \"newton\"\n";
        let x = explained(line);
        let origins = x.origins.clone().unwrap();
        assert_eq!(origins.restitution.source, Source::Pair { materials: ["ivory".into(), "felt".into()] });
        assert_eq!((origins.friction.value, origins.friction.speed, origins.law), (0.1, None, carom::Law::Newton));
        assert!(matches!(origins.tangential.source, Source::Both { .. }));
        assert!(x.chain(Language::English).text(false).contains("the pair table: ivory and felt"));
    }

    #[test]
    fn what_rest_made_plastic_is_said() {
        let line = "[[pair]]\nmaterials = [\"felt\", \"ivory\"]\nrestitution = 0.8\nfriction = 0.1\n";
        assert_eq!(explained(line).origins.unwrap().restitution.source, Source::Rest, "0.6 is not what the table says");
    }
}
