//! The letters of the lecture: p, v, F̂, J, e, with the body, the axis and the prime they carry.

/// A letter as formulas name it, in ASCII where possible:
///
/// ```text
/// v1'      the velocity of body 1 after        Fh2      the impulse on body 2 (the lecture's F-hat)
/// vx1      its x component                     vp1 vn1  along and across the line of centres (the lecture's letters)
/// [dp/dt]  one of the fixed signs              Δt θ μ   as they are
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Letter(pub String);

/// Signs that are not built from base, axis, body and prime: name, plain characters, LaTeX with @ before a vector.
const SIGNS: [(&str, &str, &str); 13] = [
    ("½", "½", "\\tfrac{1}{2}"),
    ("∫F dt", "∫ F dt", "\\int @F\\,dt"),
    ("dp/dt", "dp/dt", "\\frac{d@p}{dt}"),
    ("dP/dt", "dP/dt", "\\frac{d@P}{dt}"),
    ("constant", "C", "C"),
    ("cosθ", "cos θ", "\\cos\\theta"),
    ("sinθ", "sin θ", "\\sin\\theta"),
    ("Δp", "Δp", "\\Delta @p"),
    ("Δt", "Δt", "\\Delta t"),
    ("θ", "θ", "\\theta"),
    ("μ", "μ", "\\mu"),
    ("ω", "ω", "\\omega"),
    ("∞", "∞", "\\infty"),
];

/// Base, hat, axis, body, prime.
struct Parts<'a> {
    base: char,
    hat: bool,
    axis: &'a str,
    body: Option<char>,
    prime: bool,
}

impl Letter {
    fn sign(&self) -> Option<&'static (&'static str, &'static str, &'static str)> {
        SIGNS.iter().find(|s| s.0 == self.0)
    }

    fn parts(&self) -> Parts<'_> {
        let (name, prime) = self.0.strip_suffix('\'').map_or((self.0.as_str(), false), |n| (n, true));
        let body = name.chars().next_back().filter(char::is_ascii_digit);
        let name = if body.is_some() { &name[..name.len() - 1] } else { name };
        let base = name.chars().next().unwrap_or('?');
        let rest = &name[base.len_utf8().min(name.len())..];
        let (hat, axis) = rest.strip_prefix('h').map_or((false, rest), |axis| (true, axis));
        Parts { base, hat, axis, body, prime }
    }

    /// In plain characters: v₁′, vx₁, F̂₂.
    pub fn text(&self) -> String {
        if let Some(sign) = self.sign() {
            return sign.1.into();
        }
        let p = self.parts();
        let mut text = p.base.to_string();
        if p.hat {
            text.push('\u{302}');
        }
        text += p.axis;
        match p.body {
            Some('1') => text.push('₁'),
            Some('2') => text.push('₂'),
            _ => {}
        }
        if p.prime {
            text.push('′');
        }
        text
    }

    /// In LaTeX; vectors are bold where there is more than one component.
    pub fn latex(&self, bold: bool) -> String {
        if let Some(sign) = self.sign() {
            let Some((before, vector)) = sign.2.split_once('@') else { return sign.2.into() };
            let (letter, after) = vector.split_at(1);
            return if bold {
                format!("{before}\\mathbf{{{letter}}}{after}")
            } else {
                format!("{before}{letter}{after}")
            };
        }
        let p = self.parts();
        let mut text = p.base.to_string();
        if bold && "vpPFndrV".contains(p.base) && matches!(p.axis, "" | "t") {
            text = format!("\\mathbf{{{text}}}");
        }
        if p.hat {
            text = format!("\\hat{{{text}}}");
        }
        let lower: String = p.axis.chars().chain(p.body).collect();
        match lower.len() {
            0 => {}
            1 => text += &format!("_{lower}"),
            _ => text += &format!("_{{{lower}}}"),
        }
        if p.prime {
            text.push('\'');
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_the_lecture() {
        for (name, text, latex) in [
            ("v1'", "v₁′", "\\mathbf{v}_1'"),
            ("vx2", "vx₂", "v_{x2}"),
            ("Fh1", "F̂₁", "\\hat{\\mathbf{F}}_1"),
            ("J", "J", "J"),
            ("Px", "Px", "P_x"),
            ("Δt", "Δt", "\\Delta t"),
            ("dp/dt", "dp/dt", "\\frac{d\\mathbf{p}}{dt}"),
        ] {
            let letter = Letter(name.into());
            assert_eq!((letter.text().as_str(), letter.latex(true).as_str()), (text, latex));
        }
        assert_eq!(Letter("v1".into()).latex(false), "v_1");
        assert_eq!(Letter("∫F dt".into()).latex(false), "\\int F\\,dt");
    }
}
