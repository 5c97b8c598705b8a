//! The speeds of a gas in equilibrium (J. C. Maxwell, 1860), in one, two and three dimensions.
use std::f64::consts::PI;

/// The density (s/m) of the speed `v` (m/s) of a body of this mass (kg) at this temperature, which is <m v^2> / dim (J).
///
/// With a = m / (2 T): on the line 2 (a / pi)^(1/2) exp(-a v^2), in the plane 2 a v exp(-a v^2), in space
/// 4 pi (a / pi)^(3/2) v^2 exp(-a v^2).
pub fn maxwell(dim: usize, mass: f64, temperature: f64, v: f64) -> f64 {
    let a = 0.5 * mass / temperature;
    if !(a > 0.0) || !a.is_finite() {
        return 0.0;
    }
    let fall = libm::exp(-a * v * v);
    match dim {
        1 => 2.0 * (a / PI).sqrt() * fall,
        2 => 2.0 * a * v * fall,
        _ => 4.0 * PI * (a / PI) * (a / PI).sqrt() * v * v * fall,
    }
}

#[cfg(test)]
mod tests {
    use super::maxwell;

    #[test]
    fn it_is_a_density_with_the_right_temperature() {
        for dim in 1..=3 {
            let (mass, temperature, dv) = (2.0, 1.5, 1e-3);
            let (mut whole, mut energy) = (0.0, 0.0);
            for k in 0..20_000 {
                let v = (f64::from(k) + 0.5) * dv;
                let f = maxwell(dim, mass, temperature, v) * dv;
                whole += f;
                energy += f * mass * v * v / dim as f64;
            }
            // The midpoint rule's error is of order dv^2.
            assert!((whole - 1.0).abs() < 1e-5 && (energy - temperature).abs() < 1e-5, "{dim}: {whole} {energy}");
        }
    }
}
