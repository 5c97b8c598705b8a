//! From a line of a run to the question that explains it.
use super::{Explanation, Mistake, Question};
use crate::output::ImpactLine;
use crate::plan::Plan;

/// How near the lecture's impulse must come to the engine's: what several iterations came to is no impact of the lecture.
const SAME: f64 = 1e-9;

impl Question {
    /// What is asked of an impact of a run: who took part (the numbers of bodies in the plan, none for a wall), and its line.
    pub fn of_contact(plan: &Plan, parties: [Option<usize>; 2], line: &ImpactLine) -> Self {
        let bodies = parties.map(|k| k.and_then(|k| plan.bodies.get(k)));
        let mass = |k: usize| bodies[k].filter(|b| !b.fixed).and_then(|b| b.mass).unwrap_or(f64::INFINITY);
        let velocity = [line.before[0].velocity.clone(), line.before[1].velocity.clone()];
        let mut question = Question::new([mass(0), mass(1)], velocity).normal(line.normal.clone());
        question.restitution = line.restitution;
        if line.before.iter().flat_map(|m| &m.spin).any(|w| *w != 0.0) {
            let default = if line.point.len() == 2 { 0.5 } else { 0.4 };
            question.spin = Some([line.before[0].spin.clone(), line.before[1].spin.clone()]);
            // Of a wall neither counts.
            question.radius = Some(bodies.map(|b| b.map_or(1.0, |b| b.radius)));
            question.inertia = Some(bodies.map(|b| b.and_then(|b| b.inertia).unwrap_or(default)));
        }
        question
    }
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
        let answer = question.answer()?;
        let same = (answer.impulse - line.impulse).abs() <= SAME * line.impulse;
        Ok(same.then_some(answer))
    }
}
