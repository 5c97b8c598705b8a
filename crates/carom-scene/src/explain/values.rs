//! What the letters stand for in one impact, and the value of a formula.
use super::{Formula, Letter};
use std::collections::BTreeMap;

/// A number or a vector of two or three numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Scalar(f64),
    /// A vector.
    Vector(Vec<f64>),
}

impl From<f64> for Value {
    fn from(x: f64) -> Self {
        Value::Scalar(x)
    }
}

impl From<&[f64]> for Value {
    /// On the line a vector is a number.
    fn from(v: &[f64]) -> Self {
        match v {
            [x] => Value::Scalar(*x),
            _ => Value::Vector(v.to_vec()),
        }
    }
}

impl Value {
    fn map(&self, f: impl Fn(f64) -> f64) -> Value {
        match self {
            Value::Scalar(x) => Value::Scalar(f(*x)),
            Value::Vector(v) => Value::Vector(v.iter().map(|x| f(*x)).collect()),
        }
    }

    fn plus(&self, other: &Value) -> Option<Value> {
        match (self, other) {
            (Value::Scalar(a), Value::Scalar(b)) => Some(Value::Scalar(a + b)),
            (Value::Vector(a), Value::Vector(b)) if a.len() == b.len() => {
                Some(Value::Vector(a.iter().zip(b).map(|(a, b)| a + b).collect()))
            }
            _ => None,
        }
    }

    fn dot(&self, other: &Value) -> Option<f64> {
        match (self, other) {
            (Value::Scalar(a), Value::Scalar(b)) => Some(a * b),
            (Value::Vector(a), Value::Vector(b)) if a.len() == b.len() => {
                Some(a.iter().zip(b).map(|(a, b)| a * b).sum())
            }
            _ => None,
        }
    }

    /// The numbers.
    pub fn numbers(&self) -> &[f64] {
        match self {
            Value::Scalar(x) => core::slice::from_ref(x),
            Value::Vector(v) => v,
        }
    }
}

/// What each letter stands for, by its name.
#[derive(Clone, Debug, Default)]
pub struct Values(BTreeMap<String, Value>);

impl Values {
    /// Lets a letter stand for a value.
    pub fn set(&mut self, name: impl Into<String>, value: impl Into<Value>) {
        self.0.insert(name.into(), value.into());
    }

    /// What a letter stands for.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.0.get(name)
    }

    /// All letters and what they stand for, by name.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }

    /// A formula with the known letters replaced by their numbers; with `only_before`, letters with a prime stay unknowns.
    pub fn put(&self, formula: &Formula, only_before: bool) -> Formula {
        formula.put(&|letter: &Letter| {
            if only_before && letter.0.ends_with('\'') {
                return None;
            }
            self.get(&letter.0).map(Value::formula)
        })
    }

    /// The value of a formula; `None` if a letter is unknown or the operands do not fit.
    pub fn evaluate(&self, formula: &Formula) -> Option<Value> {
        let scalar = |f: &Formula| match self.evaluate(f)? {
            Value::Scalar(x) => Some(x),
            Value::Vector(_) => None,
        };
        Some(match formula {
            Formula::Letter(letter) if letter.0 == "½" => Value::Scalar(0.5),
            Formula::Letter(letter) => self.get(&letter.0)?.clone(),
            Formula::Number(x) => Value::Scalar(*x),
            Formula::Vector(v) => Value::Vector(v.clone()),
            Formula::Negative(a) => self.evaluate(a)?.map(|x| -x),
            Formula::Sum(terms) => {
                let mut terms = terms.iter();
                let mut sum = self.evaluate(&terms.next()?.1)?;
                for (plus, term) in terms {
                    let sign = if *plus { 1.0 } else { -1.0 };
                    sum = sum.plus(&self.evaluate(term)?.map(|x| sign * x))?;
                }
                sum
            }
            Formula::Product(factors) => {
                let mut product = Value::Scalar(1.0);
                for factor in factors {
                    product = match (product, self.evaluate(factor)?) {
                        (Value::Scalar(k), other) | (other, Value::Scalar(k)) => other.map(|x| k * x),
                        _ => return None,
                    };
                }
                product
            }
            Formula::Dot(a, b) => Value::Scalar(self.evaluate(a)?.dot(&self.evaluate(b)?)?),
            Formula::Cross(a, b) => match (self.evaluate(a)?.numbers(), self.evaluate(b)?.numbers()) {
                ([ax, ay, az], [bx, by, bz]) => {
                    Value::Vector(vec![ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
                }
                _ => return None,
            },
            Formula::Over(a, b) => {
                let below = scalar(b)?;
                self.evaluate(a)?.map(|x| x / below)
            }
            Formula::Square(a) => {
                let a = self.evaluate(a)?;
                Value::Scalar(a.dot(&a)?)
            }
            Formula::Length(a) => {
                let a = self.evaluate(a)?;
                Value::Scalar(a.dot(&a)?.sqrt())
            }
            Formula::Group(a) => self.evaluate(a)?,
            Formula::Call(name, arguments) => match (name.as_str(), arguments.as_slice()) {
                ("atan2", [y, x]) => Value::Scalar(libm::atan2(scalar(y)?, scalar(x)?)),
                ("arctan", [x]) => Value::Scalar(libm::atan(scalar(x)?)),
                _ => return None,
            },
        })
    }
}

impl Value {
    pub(crate) fn formula(&self) -> Formula {
        match self {
            Value::Scalar(x) => Formula::Number(*x),
            Value::Vector(v) => Formula::Vector(v.clone()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_have_values() {
        let mut values = Values::default();
        for (name, x) in [("m1", 2.0), ("m2", 1.0), ("v1", 3.0), ("v2", -1.0), ("e", 0.5)] {
            values.set(name, x);
        }
        values.set("d", [3.0, 4.0].as_slice());
        for (source, want) in [
            ("(m1 - e m2)/(m1 + m2) v1 + (1 + e) m2/(m1 + m2) v2", 1.0),
            ("-(v1 - v2)", -4.0),
            ("d·d", 25.0),
            ("|d|", 5.0),
            ("½ m1 v1^2", 9.0),
            ("atan2(0, 1)", 0.0),
        ] {
            let formula = Formula::parse(source).unwrap();
            assert_eq!(values.evaluate(&formula), Some(Value::Scalar(want)), "{source}");
            assert_eq!(
                values.evaluate(&values.put(&formula, false)),
                Some(Value::Scalar(want)),
                "{source} with numbers"
            );
        }
        assert_eq!(values.evaluate(&Formula::parse("d + v1").unwrap()), None);
        values.set("n", [0.0, 0.0, 2.0].as_slice());
        values.set("r", [3.0, -1.0, 5.0].as_slice());
        let cross = values.evaluate(&Formula::parse("½ n × r").unwrap());
        assert_eq!(cross, Some(Value::Vector(vec![1.0, 3.0, 0.0])));
        assert_eq!(values.evaluate(&Formula::parse("d × d").unwrap()), None, "the plane has no vector product");
    }
}
