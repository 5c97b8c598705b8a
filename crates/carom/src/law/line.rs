//! Two balls on a line: the closed forms of the lecture (its steps 6 to 9), for teaching and as an oracle.
//!
//! Momentum is conserved, m1 (v1' - v1) + m2 (v2' - v2) = 0: one equation for two unknowns. The second one is the
//! coefficient of restitution,
//!
//! ```text
//! e (v1 - v2) = -(v1' - v2')          e = 1 elastic, e = 0 perfectly inelastic
//! ```
//!
//! The slide before it in the lecture prints the elastic case as v1 - v2 = v1' - v2'. **That is a slip of sign**: with it
//! nothing would happen at all (v1' = v1, v2' = v2 solves both equations). The minus that the next slide has is right: the
//! balls part as fast as they approached, *the other way round*.

/// The velocities after an impact on a line, from the closed forms
///
/// ```text
/// v1' = (m1 - e m2)/(m1 + m2) v1 + (1 + e) m2/(m1 + m2) v2
/// v2' = (1 + e) m1/(m1 + m2) v1 + (m2 - e m1)/(m1 + m2) v2
/// ```
///
/// Masses in kg, positive and finite; velocities in m/s. The forms do not ask whether the balls approach: that is the
/// caller's question.
///
/// # Accuracy
/// Each velocity is good to a few units in the last place of the larger of |v1|, |v2|, but the *difference* v1' - v2' is
/// not: where v1 and v2 are close, restitution is off by up to 1e11 units (m1 - e m2 cancels, and so do the two
/// products). [`super::smooth`] does not have that weakness and is what the engine runs.
pub fn velocities(m1: f64, m2: f64, v1: f64, v2: f64, e: f64) -> (f64, f64) {
    let total = m1 + m2;
    ((m1 - e * m2) / total * v1 + (1.0 + e) * m2 / total * v2, (1.0 + e) * m1 / total * v1 + (m2 - e * m1) / total * v2)
}

/// The same against a wall (the limit of an infinite m2, which keeps its velocity `wall`): v' = -e v + (1 + e) V.
pub fn against_wall(v: f64, wall: f64, e: f64) -> f64 {
    -e * v + (1.0 + e) * wall
}

/// The coefficient of restitution that was at work: e = -(v1' - v2') / (v1 - v2). Infinite or NaN if the balls did not
/// approach.
pub fn restitution(before: (f64, f64), after: (f64, f64)) -> f64 {
    -(after.0 - after.1) / (before.0 - before.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lecture_s_two_balls() {
        assert_eq!(velocities(2.0, 1.0, 3.0, -1.0, 0.5), (1.0, 3.0));
        assert_eq!(restitution((3.0, -1.0), (1.0, 3.0)), 0.5);
        assert_eq!(velocities(1.0, 1.0, 3.0, -1.0, 1.0), (-1.0, 3.0), "equal masses exchange their velocities");
        assert_eq!(against_wall(2.0, -3.0, 1.0), -8.0);
    }

    #[test]
    fn the_slip_of_sign_would_let_them_pass() {
        // Momentum and v1 - v2 = v1' - v2' together are solved by "nothing happens": no collision at all.
        let (m1, m2, v1, v2) = (2.0, 1.0, 3.0, -1.0);
        let (w1, w2) = velocities(m1, m2, v1, v2, -1.0); // e = -1 is what that line says
        assert_eq!((w1, w2), (v1, v2));
    }
}
