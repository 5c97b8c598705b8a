//! Colours, the palette that tells bodies apart, and the scale that shows how much.

/// A colour in sRGB with an opacity, 0 to 255 each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Colour {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
    /// Opacity.
    pub a: u8,
}

impl Colour {
    /// The opaque colour 0xRRGGBB.
    pub const fn hex(rgb: u32) -> Self {
        Self { r: (rgb >> 16) as u8, g: (rgb >> 8) as u8, b: rgb as u8, a: 255 }
    }

    /// The same colour, this opaque (0 to 1).
    pub fn opacity(self, part: f64) -> Self {
        Self { a: byte(f64::from(self.a) * part.clamp(0.0, 1.0)), ..self }
    }

    /// From this colour (0) to another (1).
    pub fn mix(self, other: Self, part: f64) -> Self {
        let part = part.clamp(0.0, 1.0);
        let between = |a: u8, b: u8| byte(f64::from(a) + (f64::from(b) - f64::from(a)) * part);
        Self {
            r: between(self.r, other.r),
            g: between(self.g, other.g),
            b: between(self.b, other.b),
            a: between(self.a, other.a),
        }
    }

    /// How light it looks, 0 to 1 (the luma of ITU-R BT.601: what decides between dark and light letters on it).
    pub fn lightness(self) -> f64 {
        (0.299 * f64::from(self.r) + 0.587 * f64::from(self.g) + 0.114 * f64::from(self.b)) / 255.0
    }
}

fn byte(x: f64) -> u8 {
    (x + 0.5).clamp(0.0, 255.0) as u8
}

/// Eight colours that stay apart for every kind of colour vision, by Okabe and Ito (2008, "Color universal design"), their
/// yellow darkened for light paper and their black replaced by a violet that shows on dark paper.
pub const PALETTE_LIGHT: [Colour; 8] = [
    Colour::hex(0x0072b2),
    Colour::hex(0xe69f00),
    Colour::hex(0x009e73),
    Colour::hex(0xcc79a7),
    Colour::hex(0xd55e00),
    Colour::hex(0x56b4e9),
    Colour::hex(0xe3cf3a),
    Colour::hex(0x6a51a3),
];

/// The same, for dark paper.
pub const PALETTE_DARK: [Colour; 8] = [
    Colour::hex(0x3d9ddb),
    Colour::hex(0xf0a918),
    Colour::hex(0x1fb78c),
    Colour::hex(0xd98bb6),
    Colour::hex(0xea7327),
    Colour::hex(0x7cc8f2),
    Colour::hex(0xf2e35c),
    Colour::hex(0x9a86d6),
];

/// What names of bodies may say of their colour: on light paper and on dark.
const SPOKEN: [(&[&str], u32, u32); 11] = [
    (&["red"], 0xc8102e, 0xe5394e),
    (&["orange"], 0xf07f13, 0xf58a1f),
    (&["yellow"], 0xf2c511, 0xf5d13d),
    (&["green"], 0x1e8449, 0x2fa563),
    (&["blue"], 0x1f4fb2, 0x3f74dd),
    (&["purple", "violet"], 0x6c3a9c, 0x8d5cc2),
    (&["pink"], 0xf08cae, 0xf29dbb),
    (&["brown"], 0x7a4a21, 0x9a6236),
    (&["white"], 0xf6f4ee, 0xf6f4ee),
    (&["grey", "gray"], 0x8a8f98, 0x9aa0aa),
    (&["black"], 0x22252b, 0x3a3f49),
];

/// The colour that a name says, if one of its words is a colour's: `red`, `red-7`, `ball-black`.
pub fn spoken(name: &str, dark: bool) -> Option<Colour> {
    let name = name.to_lowercase();
    let mut words = name.split(|c: char| !c.is_alphabetic());
    let (_, light, night) = words.find_map(|word| SPOKEN.iter().find(|(names, ..)| names.contains(&word)))?;
    Some(Colour::hex(if dark { *night } else { *light }))
}

/// From little to much: the colour map "plasma" (S. van der Walt, N. Smith, 2015), which is even to the eye and safe for
/// every kind of colour vision, without its ends, which vanish on dark or light paper.
const SCALE: [Colour; 9] = [
    Colour::hex(0x3b049a),
    Colour::hex(0x6300a7),
    Colour::hex(0x8707a6),
    Colour::hex(0xa62098),
    Colour::hex(0xc03a83),
    Colour::hex(0xd5546e),
    Colour::hex(0xe76f5a),
    Colour::hex(0xf58c46),
    Colour::hex(0xfdad32),
];

/// The colour of a part (0 to 1) of the scale; on dark paper the scale starts a little higher.
pub fn scale(part: f64, dark: bool) -> Colour {
    let part = if part > 0.0 { part.min(1.0) } else { 0.0 };
    let at = if dark { 1.5 + part * 6.5 } else { part * 8.0 };
    let k = (at as usize).min(SCALE.len() - 2);
    // In 64 steps, so that a film needs few colours.
    let step = ((at - k as f64) * 8.0 + 0.5) as u32;
    SCALE[k].mix(SCALE[k + 1], f64::from(step) / 8.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_colours_are_heard() {
        let of = |name| spoken(name, false);
        assert_eq!(of("red"), Some(Colour::hex(0xc8102e)));
        assert!(of("Red 7") == of("red") && of("ball-red") == of("red") && of("grey") == of("gray"));
        assert!(of("cue").is_none() && of("redder").is_none() && of("").is_none());
    }

    #[test]
    fn scales_and_mixes_meet_their_ends() {
        assert_eq!(scale(0.0, false), SCALE[0]);
        assert_eq!(scale(1.0, false), SCALE[8]);
        assert_eq!(scale(1.0, true), SCALE[8]);
        assert_eq!(scale(f64::NAN, false), SCALE[0]);
        let (a, b) = (Colour::hex(0x102030), Colour::hex(0xf0e0d0));
        assert_eq!((a.mix(b, 0.0), a.mix(b, 1.0)), (a, b));
        assert_eq!(a.opacity(0.5).a, 128);
    }

    #[test]
    fn the_scale_rises_in_lightness() {
        let light: Vec<f64> = (0..=64).map(|k| scale(f64::from(k) / 64.0, false).lightness()).collect();
        assert!(light.windows(2).all(|w| w[1] >= w[0] - 1e-3), "{light:?}");
    }
}
