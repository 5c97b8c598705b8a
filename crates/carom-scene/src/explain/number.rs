//! Numbers as people read them: six significant digits, no trailing zeros, a real minus sign, a decimal comma where the
//! language has one.

/// The digits that are shown.
const DIGITS: usize = 6;

/// Where a number is set, and in which language.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Notation {
    /// 0,5 instead of 0.5.
    pub comma: bool,
    /// LaTeX source instead of plain characters.
    pub latex: bool,
}

impl Notation {
    /// The number: plain from 1e-4 to 1e6 (whole numbers to 1e7), beyond as 1.23×10⁻⁷.
    pub fn number(self, x: f64) -> String {
        if x.is_nan() {
            return "?".into();
        }
        let minus = if x < 0.0 { self.minus() } else { "" };
        let x = x.abs();
        if x.is_infinite() {
            return format!("{minus}{}", if self.latex { "\\infty" } else { "∞" });
        }
        if x == 0.0 {
            return "0".into();
        }
        if x < 1e7 && x.fract() == 0.0 {
            return format!("{minus}{x}");
        }
        let (mantissa, exponent) = parts(x);
        if (-4..6).contains(&exponent) {
            let places = (DIGITS as i32 - 1 - exponent).max(0) as usize;
            return format!("{minus}{}", self.point(&format!("{x:.places$}")));
        }
        let mantissa = self.point(&mantissa);
        let power = self.power(exponent);
        // 1×10⁻⁷ says no more than 10⁻⁷.
        if mantissa == "1" {
            return format!("{minus}{power}");
        }
        format!("{minus}{mantissa}{}{power}", if self.latex { " \\times " } else { "×" })
    }

    /// What stands between the components of a vector: with a decimal comma, a comma would be read as one.
    pub fn separator(self) -> &'static str {
        match (self.comma, self.latex) {
            (false, false) => ", ",
            (false, true) => ",\\; ",
            (true, false) => "; ",
            (true, true) => ";\\; ",
        }
    }

    /// The minus sign.
    pub fn minus(self) -> &'static str {
        if self.latex { "-" } else { "−" }
    }

    /// Decimal digits without their trailing zeros, with the language's decimal sign.
    fn point(self, digits: &str) -> String {
        let trimmed = if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits };
        match (self.comma, self.latex) {
            (false, _) => trimmed.into(),
            (true, false) => trimmed.replace('.', ","),
            (true, true) => trimmed.replace('.', "{,}"),
        }
    }

    fn power(self, exponent: i32) -> String {
        if self.latex {
            return format!("10^{{{exponent}}}");
        }
        let raise = |c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            // The other raised digits stand in the order of their values.
            c => char::from_u32('⁰' as u32 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
        };
        format!("10{}", exponent.to_string().chars().map(raise).collect::<String>())
    }
}

/// Mantissa digits and exponent after rounding to the digits shown.
fn parts(x: f64) -> (String, i32) {
    let scientific = format!("{x:.*e}", DIGITS - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    (mantissa.into(), exponent.parse().unwrap_or(0))
}

/// True if the digits shown are not the whole number, rounding noise of the arithmetic aside.
pub(crate) fn is_rounded(x: f64) -> bool {
    if !x.is_finite() || (x.abs() < 1e7 && x.fract() == 0.0) {
        return false;
    }
    let shown = crate::number(&format!("{x:.*e}", DIGITS - 1)).unwrap_or(x);
    (shown - x).abs() > 1e-12 * x.abs()
}

/// The unit of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Unit {
    /// A pure number.
    #[default]
    One,
    /// Mass, kg.
    Mass,
    /// Velocity, m/s.
    Velocity,
    /// Momentum, kg m/s.
    Momentum,
    /// Impulse, N s.
    Impulse,
    /// Force, N.
    Force,
    /// Energy, J.
    Energy,
    /// Time, s.
    Time,
    /// Angle, rad.
    Angle,
    /// Angle, degrees.
    Degree,
    /// Inverse mass, 1/kg.
    InverseMass,
    /// Spin, rad/s.
    Spin,
    /// Moment of inertia, kg m².
    Inertia,
}

impl Unit {
    /// The unit as it is printed; empty for a pure number.
    pub fn symbol(self) -> &'static str {
        match self {
            Unit::One => "",
            Unit::Mass => "kg",
            Unit::Velocity => "m/s",
            Unit::Momentum => "kg m/s",
            Unit::Impulse => "N s",
            Unit::Force => "N",
            Unit::Energy => "J",
            Unit::Time => "s",
            Unit::Angle => "rad",
            Unit::Degree => "°",
            Unit::InverseMass => "kg⁻¹",
            Unit::Spin => "rad/s",
            Unit::Inertia => "kg m²",
        }
    }

    pub(crate) fn latex(self) -> String {
        match self {
            Unit::One => String::new(),
            Unit::Degree => "^\\circ".into(),
            Unit::InverseMass => "\\,\\mathrm{kg}^{-1}".into(),
            Unit::Inertia => "\\,\\mathrm{kg\\,m^2}".into(),
            _ => format!("\\,\\mathrm{{{}}}", self.symbol().replace(' ', "\\,")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EN: Notation = Notation { comma: false, latex: false };
    const PT: Notation = Notation { comma: true, latex: false };

    #[test]
    fn numbers_as_people_read_them() {
        let table = [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (-1.0, "−1"),
            (0.5, "0.5"),
            (2.0 / 3.0, "0.666667"),
            (-100.0 / 3.0, "−33.3333"),
            (3.6 - 4e-16, "3.6"),
            (0.1 + 0.2, "0.3"),
            (1234567.0, "1234567"),
            (123456.7, "123457"),
            (999999.9, "10⁶"),
            (1.5e6 + 0.5, "1.5×10⁶"),
            (1e7, "10⁷"),
            (6.02214076e23, "6.02214×10²³"),
            (1e-4, "0.0001"),
            (0.000123456789, "0.000123457"),
            (1.23e-7, "1.23×10⁻⁷"),
            (-4.5678e-100, "−4.5678×10⁻¹⁰⁰"),
            (f64::INFINITY, "∞"),
            (f64::NEG_INFINITY, "−∞"),
        ];
        for (x, want) in table {
            println!("{x:>12e} {want}");
            assert_eq!(EN.number(x), want, "{x:e}");
        }
        assert_eq!(PT.number(-0.25), "−0,25");
        assert_eq!(PT.number(1.5e-9), "1,5×10⁻⁹");
    }

    #[test]
    fn numbers_in_latex() {
        let (en, pt) = (Notation { comma: false, latex: true }, Notation { comma: true, latex: true });
        assert_eq!(en.number(-0.25), "-0.25");
        assert_eq!(pt.number(-0.25), "-0{,}25");
        assert_eq!(pt.number(1.5e-9), "1{,}5 \\times 10^{-9}");
        assert_eq!(en.number(f64::INFINITY), "\\infty");
        assert_eq!(Unit::Momentum.latex(), "\\,\\mathrm{kg\\,m/s}");
    }

    #[test]
    fn rounding_is_known() {
        assert!(is_rounded(2.0 / 3.0) && is_rounded(0.1234567) && is_rounded(1e7 + 1.0));
        assert!(!is_rounded(0.1 + 0.2) && !is_rounded(1234567.0) && !is_rounded(0.0) && !is_rounded(3.6 - 4e-16));
    }
}
