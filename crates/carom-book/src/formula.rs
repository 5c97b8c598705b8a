//! Formulas: what a case expects and what it reads, as one would write it on paper.
//!
//! ```text
//! (m1 - e*m2)/(m1 + m2)*v1        numbers, names, + - * / ^ ( ), and functions: sqrt(x), min(x, y), ...
//! 2*vx[A] + impulse[3]            what is measured: a word, and in brackets of what
//! ```
//!
//! `^` binds tightest and to the right, then a sign, then `*` and `/`, then `+` and `-`. Names are a case's own (`let`), `pi`,
//! `eps` (2^-52) or a measured word. Functions are those of `libm`, so that a book says the same on every machine.
use thiserror::Error;

/// What is wrong with a formula, in words.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct Misread(pub String);

/// What the names of a formula mean.
pub trait Words {
    /// The value of a name.
    fn name(&self, name: &str) -> Result<f64, Misread>;
    /// The value of a word with something in brackets, as in `vx[A]`.
    fn of(&self, word: &str, what: &str) -> Result<f64, Misread>;
}

/// A formula, read.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula(Term);

#[derive(Clone, Debug, PartialEq)]
enum Term {
    Number(f64),
    Name(String),
    Of(String, String),
    Call(&'static Function, Vec<Term>),
    Minus(Box<Term>),
    Two(char, Box<Term>, Box<Term>),
}

/// A function: its name, how many arguments, and what it does.
#[derive(Debug)]
struct Function {
    name: &'static str,
    arguments: usize,
    does: fn(&[f64]) -> f64,
}

impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

const FUNCTIONS: &[Function] = &[
    Function { name: "sqrt", arguments: 1, does: |x| libm::sqrt(x[0]) },
    Function { name: "sin", arguments: 1, does: |x| libm::sin(x[0]) },
    Function { name: "cos", arguments: 1, does: |x| libm::cos(x[0]) },
    Function { name: "tan", arguments: 1, does: |x| libm::tan(x[0]) },
    Function { name: "asin", arguments: 1, does: |x| libm::asin(x[0]) },
    Function { name: "acos", arguments: 1, does: |x| libm::acos(x[0]) },
    Function { name: "atan", arguments: 1, does: |x| libm::atan(x[0]) },
    Function { name: "atan2", arguments: 2, does: |x| libm::atan2(x[0], x[1]) },
    Function { name: "exp", arguments: 1, does: |x| libm::exp(x[0]) },
    Function { name: "ln", arguments: 1, does: |x| libm::log(x[0]) },
    Function { name: "abs", arguments: 1, does: |x| x[0].abs() },
    Function { name: "floor", arguments: 1, does: |x| libm::floor(x[0]) },
    Function { name: "ceil", arguments: 1, does: |x| libm::ceil(x[0]) },
    Function { name: "hypot", arguments: 2, does: |x| libm::sqrt(x[0] * x[0] + x[1] * x[1]) },
    Function { name: "min", arguments: 2, does: |x| if x[0] < x[1] { x[0] } else { x[1] } },
    Function { name: "max", arguments: 2, does: |x| if x[0] > x[1] { x[0] } else { x[1] } },
];

/// Brackets within brackets: more is no formula that anyone wrote.
const DEEPEST: usize = 64;
/// Characters: a sum of more terms than these allow is no formula either.
const LONGEST: usize = 4000;

impl Formula {
    /// Reads a formula.
    pub fn read(text: &str) -> Result<Self, Misread> {
        if text.len() > LONGEST {
            return Err(Misread(format!("a formula of {} characters is too long", text.len())));
        }
        let mut reader = Reader { text, at: 0, depth: 0 };
        let term = reader.sum()?;
        match reader.peek() {
            None => Ok(Self(term)),
            Some(c) => Err(reader.wrong(&format!("`{c}` is not expected here"))),
        }
    }

    /// Its value.
    pub fn value(&self, words: &dyn Words) -> Result<f64, Misread> {
        self.0.value(words)
    }

    /// True if some word is read that `which` says yes to; it is given the word and what stands in brackets.
    pub fn any(&self, which: &dyn Fn(&str, &str) -> bool) -> bool {
        self.0.any(which)
    }
}

impl Term {
    fn value(&self, words: &dyn Words) -> Result<f64, Misread> {
        Ok(match self {
            Self::Number(x) => *x,
            Self::Name(name) => match name.as_str() {
                "pi" => std::f64::consts::PI,
                "eps" => f64::EPSILON,
                "inf" => f64::INFINITY,
                _ => words.name(name)?,
            },
            Self::Of(word, what) => words.of(word, what)?,
            Self::Minus(term) => -term.value(words)?,
            Self::Two(sign, a, b) => {
                let (a, b) = (a.value(words)?, b.value(words)?);
                match sign {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    '/' => a / b,
                    _ => power(a, b),
                }
            }
            Self::Call(function, arguments) => {
                let values = arguments.iter().map(|a| a.value(words)).collect::<Result<Vec<f64>, _>>()?;
                (function.does)(&values)
            }
        })
    }

    fn any(&self, which: &dyn Fn(&str, &str) -> bool) -> bool {
        match self {
            Self::Number(_) => false,
            Self::Name(name) => which(name, ""),
            Self::Of(word, what) => which(word, what),
            Self::Minus(term) => term.any(which),
            Self::Two(_, a, b) => a.any(which) || b.any(which),
            Self::Call(_, arguments) => arguments.iter().any(|a| a.any(which)),
        }
    }
}

/// x^y; squares and cubes are products, which round as those of the engine do.
fn power(x: f64, y: f64) -> f64 {
    match y {
        2.0 => x * x,
        3.0 => x * x * x,
        _ => libm::pow(x, y),
    }
}

struct Reader<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
}

impl Reader<'_> {
    /// The next character that is not blank.
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        let blank = rest.len() - rest.trim_start().len();
        self.at += blank;
        self.text[self.at..].chars().next()
    }

    /// Takes this character, if it is the next.
    fn take(&mut self, c: char) -> bool {
        let there = self.peek() == Some(c);
        self.at += if there { c.len_utf8() } else { 0 };
        there
    }

    fn wrong(&self, what: &str) -> Misread {
        Misread(format!("{what}, after `{}` in `{}`", &self.text[..self.at], self.text))
    }

    fn sum(&mut self) -> Result<Term, Misread> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.wrong("too many brackets"));
        }
        let mut left = self.product()?;
        while let Some(sign @ ('+' | '-')) = self.peek() {
            self.at += 1;
            left = Term::Two(sign, Box::new(left), Box::new(self.product()?));
        }
        self.depth -= 1;
        Ok(left)
    }

    fn product(&mut self) -> Result<Term, Misread> {
        let mut left = self.signed()?;
        while let Some(sign @ ('*' | '/')) = self.peek() {
            self.at += 1;
            left = Term::Two(sign, Box::new(left), Box::new(self.signed()?));
        }
        Ok(left)
    }

    /// Signs, many of them, are walked over and not gone into.
    fn signed(&mut self) -> Result<Term, Misread> {
        let mut minus = false;
        while let Some(sign @ ('+' | '-')) = self.peek() {
            self.at += 1;
            minus ^= sign == '-';
        }
        let base = self.atom()?;
        let term = if self.take('^') {
            self.depth += 1;
            if self.depth > DEEPEST {
                return Err(self.wrong("too many powers"));
            }
            let exponent = self.signed()?;
            self.depth -= 1;
            Term::Two('^', Box::new(base), Box::new(exponent))
        } else {
            base
        };
        Ok(if minus { Term::Minus(Box::new(term)) } else { term })
    }

    fn atom(&mut self) -> Result<Term, Misread> {
        match self.peek() {
            Some('(') => {
                self.at += 1;
                let inner = self.sum()?;
                if self.take(')') { Ok(inner) } else { Err(self.wrong("a `)` is missing")) }
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_ascii_alphabetic() => self.word(),
            Some(c) => Err(self.wrong(&format!("`{c}` is not expected"))),
            None => Err(self.wrong("something is missing")),
        }
    }

    fn number(&mut self) -> Result<Term, Misread> {
        let bytes = self.text.as_bytes();
        let mut end = self.at;
        while end < bytes.len() {
            let c = bytes[end];
            let exponent = matches!(c, b'+' | b'-') && matches!(bytes[end - 1], b'e' | b'E');
            if !(c.is_ascii_digit() || matches!(c, b'.' | b'_' | b'e' | b'E') || exponent && end > self.at) {
                break;
            }
            end += 1;
        }
        let written = self.text[self.at..end].replace('_', "");
        let number = written.parse().map_err(|_| self.wrong(&format!("`{written}` is no number")))?;
        self.at = end;
        Ok(Term::Number(number))
    }

    fn word(&mut self) -> Result<Term, Misread> {
        let rest = &self.text[self.at..];
        let length = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
        let word = rest[..length].to_owned();
        self.at += length;
        if self.take('[') {
            let rest = &self.text[self.at..];
            let Some(length) = rest.find(']') else { return Err(self.wrong("a `]` is missing")) };
            let what = rest[..length].trim().to_owned();
            self.at += length + 1;
            return Ok(Term::Of(word, what));
        }
        if !self.take('(') {
            return Ok(Term::Name(word));
        }
        let Some(function) = FUNCTIONS.iter().find(|f| f.name == word) else {
            let known: Vec<&str> = FUNCTIONS.iter().map(|f| f.name).collect();
            return Err(self.wrong(&format!("there is no function `{word}`; there are {}", known.join(", "))));
        };
        let mut arguments = vec![self.sum()?];
        while self.take(',') {
            arguments.push(self.sum()?);
        }
        if !self.take(')') {
            return Err(self.wrong("a `)` is missing"));
        }
        if arguments.len() != function.arguments {
            return Err(self.wrong(&format!("`{word}` takes {} arguments", function.arguments)));
        }
        Ok(Term::Call(function, arguments))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Three;

    impl Words for Three {
        fn name(&self, name: &str) -> Result<f64, Misread> {
            if name == "x" { Ok(3.0) } else { Err(Misread(format!("no {name}"))) }
        }
        fn of(&self, word: &str, what: &str) -> Result<f64, Misread> {
            Ok((word.len() + what.len()) as f64)
        }
    }

    fn value(text: &str) -> f64 {
        Formula::read(text).and_then(|f| f.value(&Three)).unwrap()
    }

    #[test]
    fn as_on_paper() {
        for (text, want) in [
            ("1 + 2*3 - 4/2", 5.0),
            ("-x^2", -9.0),
            ("2^3^2", 512.0),
            ("2^-1", 0.5),
            ("(1 + x)*(1 - x)", -8.0),
            ("10 - 2 - 3", 5.0),
            ("--x", 3.0),
            ("1e-3*1_000 + 2.5E+1", 26.0),
            ("sqrt(x*x + 16)", 5.0),
            ("min(x, 2) + max(x, 2)", 5.0),
            ("vx[ball-1] + 1", 9.0),
            ("floor(pi*10^2)", 314.0),
        ] {
            assert_eq!(value(text), want, "{text}");
        }
    }

    #[test]
    fn what_is_no_formula_is_said() {
        for text in ["", "1 +", "(1", "2 x", "vx[A", "sine(1)", "min(1)", "1..2", "#", "y"] {
            let wrong = Formula::read(text).and_then(|f| f.value(&Three)).unwrap_err();
            println!("{wrong}");
        }
        for text in ["(", "2^", "1+"] {
            assert!(Formula::read(&(text.repeat(1000) + "1")).is_err() == (text != "1+"));
            assert!(Formula::read(&text.repeat(100_000)).is_err());
        }
        assert_eq!(value(&("-".repeat(1000) + "x")), 3.0);
    }
}
