//! Formulas as the lecture writes them, kept as trees: one formula shows its letters, the same with numbers put in, in plain
//! characters or in LaTeX, and can be evaluated, so that no line of the chain can say something else than the numbers.
use super::Letter;

/// A formula. Parentheses are kept as they were written.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    /// A letter.
    Letter(Letter),
    /// A number.
    Number(f64),
    /// A vector of two or three numbers.
    Vector(Vec<f64>),
    /// -a.
    Negative(Box<Formula>),
    /// Terms, each added (`true`) or subtracted.
    Sum(Vec<(bool, Formula)>),
    /// Factors side by side.
    Product(Vec<Formula>),
    /// The scalar product a·b.
    Dot(Box<Formula>, Box<Formula>),
    /// The vector product a × b in space.
    Cross(Box<Formula>, Box<Formula>),
    /// a/b.
    Over(Box<Formula>, Box<Formula>),
    /// a^2.
    Square(Box<Formula>),
    /// The length |a|.
    Length(Box<Formula>),
    /// (a).
    Group(Box<Formula>),
    /// A named function of its arguments.
    Call(String, Vec<Formula>),
}

impl Formula {
    /// Reads a formula: `(1 + e) m2/(m1 + m2) v2`. A product is written side by side or, where both are vectors, with `·` or `×`;
    /// `/` binds as tightly, from the left; `|v|` is a length, `^2` a square, `[..]` a fixed sign; `½` stays ½.
    /// `None` if it is not one.
    pub fn parse(source: &str) -> Option<Self> {
        let mut reader = Reader { rest: source, in_bars: false };
        let sum = reader.sum()?;
        reader.skip();
        reader.rest.is_empty().then_some(sum)
    }

    /// This formula with letters replaced by what `value` knows of them.
    pub fn put(&self, value: &dyn Fn(&Letter) -> Option<Formula>) -> Formula {
        let put = |f: &Formula| Box::new(f.put(value));
        match self {
            Formula::Letter(letter) => value(letter).unwrap_or_else(|| self.clone()),
            Formula::Number(_) | Formula::Vector(_) => self.clone(),
            Formula::Negative(a) => Formula::Negative(put(a)),
            Formula::Sum(terms) => Formula::Sum(terms.iter().map(|(plus, t)| (*plus, t.put(value))).collect()),
            Formula::Product(factors) => Formula::Product(factors.iter().map(|f| f.put(value)).collect()),
            Formula::Dot(a, b) => Formula::Dot(put(a), put(b)),
            Formula::Cross(a, b) => Formula::Cross(put(a), put(b)),
            Formula::Over(a, b) => Formula::Over(put(a), put(b)),
            Formula::Square(a) => Formula::Square(put(a)),
            Formula::Length(a) => Formula::Length(put(a)),
            Formula::Group(a) => match a.put(value) {
                // (x) with a number in place of x needs its parentheses no longer.
                number @ (Formula::Number(_) | Formula::Vector(_)) => number,
                other => Formula::Group(Box::new(other)),
            },
            Formula::Call(name, arguments) => {
                Formula::Call(name.clone(), arguments.iter().map(|a| a.put(value)).collect())
            }
        }
    }

    /// True if `is` holds for some leaf.
    pub(crate) fn any(&self, is: &dyn Fn(&Formula) -> bool) -> bool {
        match self {
            Formula::Letter(_) | Formula::Number(_) | Formula::Vector(_) => is(self),
            Formula::Negative(a) | Formula::Square(a) | Formula::Length(a) | Formula::Group(a) => a.any(is),
            Formula::Sum(terms) => terms.iter().any(|(_, t)| t.any(is)),
            Formula::Product(all) | Formula::Call(_, all) => all.iter().any(|f| f.any(is)),
            Formula::Dot(a, b) | Formula::Cross(a, b) | Formula::Over(a, b) => a.any(is) || b.any(is),
        }
    }
}

struct Reader<'a> {
    rest: &'a str,
    /// Inside |..|, where the next bar closes.
    in_bars: bool,
}

impl Reader<'_> {
    fn skip(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn take(&mut self, sign: char) -> bool {
        self.skip();
        self.rest.strip_prefix(sign).map(|rest| self.rest = rest).is_some()
    }

    /// True where a product can go no further.
    fn ends(&self) -> bool {
        self.rest.is_empty()
            || self.rest.starts_with(['+', '-', ')', ','])
            || (self.in_bars && self.rest.starts_with('|'))
    }

    fn sum(&mut self) -> Option<Formula> {
        let first = if self.take('-') { Formula::Negative(Box::new(self.product()?)) } else { self.product()? };
        let mut terms = vec![(true, first)];
        loop {
            let plus = if self.take('+') {
                true
            } else if self.take('-') {
                false
            } else {
                break;
            };
            terms.push((plus, self.product()?));
        }
        if terms.len() == 1 { terms.pop().map(|t| t.1) } else { Some(Formula::Sum(terms)) }
    }

    fn product(&mut self) -> Option<Formula> {
        let mut factors = vec![self.factor()?];
        loop {
            self.skip();
            if self.take('/') {
                let above = Box::new(factors.pop()?);
                factors.push(Formula::Over(above, Box::new(self.factor()?)));
            } else if self.take('·') {
                let left = Box::new(factors.pop()?);
                factors.push(Formula::Dot(left, Box::new(self.factor()?)));
            } else if self.take('×') {
                let left = Box::new(factors.pop()?);
                factors.push(Formula::Cross(left, Box::new(self.factor()?)));
            } else if self.ends() {
                break;
            } else {
                factors.push(self.factor()?);
            }
        }
        if factors.len() == 1 { factors.pop() } else { Some(Formula::Product(factors)) }
    }

    fn factor(&mut self) -> Option<Formula> {
        let atom = self.atom()?;
        match self.rest.strip_prefix("^2") {
            Some(rest) => {
                self.rest = rest;
                Some(Formula::Square(Box::new(atom)))
            }
            None => Some(atom),
        }
    }

    fn atom(&mut self) -> Option<Formula> {
        if self.take('(') {
            let inner = self.sum()?;
            return self.take(')').then(|| Formula::Group(Box::new(inner)));
        }
        if self.take('|') {
            self.in_bars = true;
            let inner = self.sum()?;
            self.in_bars = false;
            return self.take('|').then(|| Formula::Length(Box::new(inner)));
        }
        if self.take('[') {
            let (sign, rest) = self.rest.split_once(']')?;
            self.rest = rest;
            return Some(Formula::Letter(Letter(sign.into())));
        }
        if self.take('½') {
            return Some(Formula::Letter(Letter("½".into())));
        }
        let digits = self.rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(self.rest.len());
        if digits > 0 {
            let number = crate::number(&self.rest[..digits])?;
            self.rest = &self.rest[digits..];
            return Some(Formula::Number(number));
        }
        self.name()
    }

    fn name(&mut self) -> Option<Formula> {
        let rest = self.rest;
        let letters = rest.find(|c: char| !c.is_alphabetic() && c != '∞').filter(|n| *n > 0).unwrap_or(rest.len());
        if letters == 0 {
            return None;
        }
        let digit = usize::from(rest[letters..].starts_with(['1', '2']));
        let prime = usize::from(rest[letters + digit..].starts_with('\''));
        let (name, rest) = rest.split_at(letters + digit + prime);
        if !name.starts_with(|c: char| c.is_alphabetic() || c == '∞') {
            return None;
        }
        self.rest = rest;
        if name == "atan2" && self.take('(') {
            let first = self.sum()?;
            let second = self.take(',').then(|| self.sum()).flatten()?;
            return self.take(')').then(|| Formula::Call(name.into(), vec![first, second]));
        }
        if name == "arctan" && self.take('(') {
            let argument = self.sum()?;
            return self.take(')').then(|| Formula::Call(name.into(), vec![argument]));
        }
        Some(Formula::Letter(Letter(name.into())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn letter(name: &str) -> Formula {
        Formula::Letter(Letter(name.into()))
    }

    #[test]
    fn formulas_are_read() {
        assert_eq!(Formula::parse("m1 v1'"), Some(Formula::Product(vec![letter("m1"), letter("v1'")])));
        let over = Formula::Over(Box::new(letter("m2")), Box::new(letter("m1")));
        assert_eq!(Formula::parse("e m2/m1 v"), Some(Formula::Product(vec![letter("e"), over, letter("v")])));
        assert!(matches!(Formula::parse("-(v1 - v2)"), Some(Formula::Negative(_))));
        assert!(matches!(Formula::parse("|v1|^2"), Some(Formula::Square(_))));
        assert!(matches!(Formula::parse("½ m1 |v1|^2 + ½ m2 |v2|^2"), Some(Formula::Sum(t)) if t.len() == 2));
        assert!(matches!(Formula::parse("atan2(ny, nx)"), Some(Formula::Call(_, a)) if a.len() == 2));
        assert!(
            matches!(Formula::parse("R1/I1 n × Fht"), Some(Formula::Product(f)) if matches!(f[1], Formula::Cross(..)))
        );
        assert!(matches!(Formula::parse("arctan(μ)"), Some(Formula::Call(_, a)) if a.len() == 1));
        assert_eq!(Formula::parse("[∫F dt]"), Some(letter("∫F dt")));
        for wrong in ["", "(m1", "m1 +", "m1)", "1..2", "|v"] {
            assert_eq!(Formula::parse(wrong), None, "{wrong}");
        }
    }
}
