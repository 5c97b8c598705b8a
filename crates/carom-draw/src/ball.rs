//! A ball with light and shade.
use crate::colour::Colour;

/// Shades from where the light falls (0) to the far edge (1), for a gradient: place and brightness.
pub(crate) const STOPS: [(f64, f64); 5] = [(0.0, 1.0), (0.2, 0.86), (0.5, 0.62), (0.8, 0.34), (1.0, 0.12)];

/// How many shades a raster ball has: so few that a film's palette holds them, and so many that they are not seen as rings.
pub(crate) const SHADES: usize = 64;

/// Where the light comes from: the upper left, in front (a unit vector; y downwards, z towards the eye).
const LIGHT: [f64; 3] = [-0.424, -0.53, 0.734];

/// The colour of a surface that gets this part of the light, 0 to 1.
pub(crate) fn lit(colour: Colour, part: f64) -> Colour {
    let dark = colour.mix(Colour::hex(0x101828), 0.62);
    let bright = colour.mix(Colour::hex(0xffffff), 0.72);
    // The last tenth is the highlight.
    if part > 0.84 { colour.mix(bright, (part - 0.84) / 0.16) } else { dark.mix(colour, part / 0.84) }
}

/// The part of the light, 0 to 1, that falls on a ball of radius 1 at (x, y) from its middle; a rim of 1 counts as edge.
pub(crate) fn light(x: f64, y: f64) -> f64 {
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    let lambert = LIGHT[0] * x + LIGHT[1] * y + LIGHT[2] * z;
    // Half of the light comes from everywhere, so that the far side is not black.
    let soft = 0.30 + 0.56 * lambert.max(0.0);
    let mirror = lambert.max(0.0);
    let shine = mirror * mirror;
    let shine = shine * shine;
    let shine = shine * shine;
    (soft + 0.16 * shine * shine).clamp(0.0, 1.0)
}
