//! The letters of the lecture: p, v, F̂, J, e, with the body, the axis and the prime they carry.

/// A letter as formulas name it, in ASCII where possible:
///
/// ```text
/// v1'      the velocity of body 1 after        Fh2      the impulse on body 2 (the lecture's F-hat)
/// vx1      its x component                     vp1 vn1  along and across the line of centres (the lecture's letters)
/// [dp/dt]  one of the fixed signs              Δt θ μ   as they are
/// s ω1     slip and spin in the plane           σ Ω1 Σ   s, ω and w as vectors of space
/// mn mt et Jt Fht Qn   along the normal and across it
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

/// The letter that is shown for a base: vectors of space have names of their own for what is a number in the plane.
fn shown(base: char) -> char {
    match base {
        'Ω' => 'ω',
        'σ' => 's',
        'Σ' => 'w',
        base => base,
    }
}

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
        let mut text = shown(p.base).to_string();
        if p.hat {
            text.push('\u{302}');
        }
        match p.axis {
            // Small letters below the line, where there is no velocity's axis to tell them from.
            "n" if p.base != 'v' && p.base != 'n' => text.push('ₙ'),
            "t" if p.base != 'v' => text.push('ₜ'),
            "s" if p.base == 'J' => text.push('ₛ'),
            axis => text += axis,
        }
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
        let mut text = match p.base {
            'ω' => "\\omega".into(),
            'Ω' => "\\boldsymbol{\\omega}".into(),
            'σ' => "\\mathbf{s}".into(),
            'Σ' => "\\mathbf{w}".into(),
            'φ' => "\\varphi".into(),
            base => base.to_string(),
        };
        let along_and_across = p.base == 'F' && p.axis == "n";
        if bold && "vpPFndrVMt".contains(p.base) && (matches!(p.axis, "" | "t") || along_and_across) {
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
            ("ω1'", "ω₁′", "\\omega_1'"),
            ("Ω2", "ω₂", "\\boldsymbol{\\omega}_2"),
            ("σ'", "s′", "\\mathbf{s}'"),
            ("mt", "mₜ", "m_t"),
            ("Fht", "F̂ₜ", "\\hat{\\mathbf{F}}_t"),
            ("vn1", "vn₁", "v_{n1}"),
            ("dp/dt", "dp/dt", "\\frac{d\\mathbf{p}}{dt}"),
        ] {
            let letter = Letter(name.into());
            assert_eq!((letter.text().as_str(), letter.latex(true).as_str()), (text, latex));
        }
        assert_eq!(Letter("v1".into()).latex(false), "v_1");
        assert_eq!(Letter("∫F dt".into()).latex(false), "\\int F\\,dt");
    }
}
