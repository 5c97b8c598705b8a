//! A JSON reader (RFC 8259) that keeps the place of every value: scenes in JSON deserve the same errors as scenes in TOML.
//!
//! Stricter than most in what matters for a scene: a key that comes twice is an error, nesting is bounded, a lone surrogate
//! is an error. Numbers are rounded correctly (`str::parse`).
use std::collections::HashSet;

use crate::node::{Entry, Node, Source, Span, Value};
use crate::problem::Problem;

/// How deep lists and tables may nest: a scene needs six.
pub(crate) const DEEPEST: usize = 32;

/// The tree of a JSON text.
pub(crate) fn parse(sources: &[Source], source: usize) -> Result<Node, Problem> {
    let text = sources[source].text.as_str();
    let mut reader = Reader { text, bytes: text.as_bytes(), at: 0, source, depth: 0 };
    let result = reader.value().and_then(|node| {
        reader.blank();
        if reader.at < text.len() { Err(reader.wrong("nothing may follow the scene", None)) } else { Ok(node) }
    });
    result.map_err(|wrong| {
        let span = Span { source, start: wrong.start, end: wrong.end };
        let mut problem = Problem::new("", format!("not valid JSON: {}", wrong.message));
        problem.help = wrong.help;
        span.tell(sources, problem)
    })
}

struct Wrong {
    start: usize,
    end: usize,
    message: String,
    help: Option<String>,
}

struct Reader<'t> {
    text: &'t str,
    bytes: &'t [u8],
    at: usize,
    source: usize,
    depth: usize,
}

impl Reader<'_> {
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn blank(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | b'\n' | b'\r')) {
            self.at += 1;
        }
    }

    fn span(&self, start: usize) -> Span {
        Span { source: self.source, start, end: self.at }
    }

    fn wrong(&self, message: impl Into<String>, help: Option<&str>) -> Wrong {
        Wrong { start: self.at, end: self.at + 1, message: message.into(), help: help.map(str::to_owned) }
    }

    /// What stands here, for a message.
    fn found(&self) -> String {
        match self.text.get(self.at..).and_then(|rest| rest.chars().next()) {
            Some(c) if c.is_control() => format!("the control character U+{:04X}", c as u32),
            Some(c) => format!("`{c}`"),
            None => "the end of the file".to_owned(),
        }
    }

    fn expect(&mut self, byte: u8, where_: &str) -> Result<(), Wrong> {
        self.blank();
        if self.peek() == Some(byte) {
            self.at += 1;
            return Ok(());
        }
        Err(self.wrong(format!("expected `{}` {where_}, found {}", byte as char, self.found()), None))
    }

    fn value(&mut self) -> Result<Node, Wrong> {
        self.blank();
        let start = self.at;
        let value = match self.peek() {
            Some(b'{') => self.nested(Self::table)?,
            Some(b'[') => self.nested(Self::list)?,
            Some(b'"') => Value::Text(self.string()?),
            Some(b'-' | b'0'..=b'9') => self.number()?,
            Some(b'a'..=b'z' | b'A'..=b'Z' | b'\'' | b'+' | b'.') => self.word()?,
            Some(b'}' | b']' | b',') => {
                return Err(self.wrong(
                    format!("expected a value, found {}", self.found()),
                    Some("JSON allows no comma after the last value"),
                ));
            }
            _ => return Err(self.wrong(format!("expected a value, found {}", self.found()), None)),
        };
        Ok(Node { value, span: self.span(start) })
    }

    fn nested(&mut self, read: fn(&mut Self) -> Result<Value, Wrong>) -> Result<Value, Wrong> {
        if self.depth == DEEPEST {
            return Err(self.wrong(format!("nested more than {DEEPEST} deep"), Some("a scene needs no more than six")));
        }
        self.depth += 1;
        self.at += 1;
        let value = read(self);
        self.depth -= 1;
        value
    }

    fn table(&mut self) -> Result<Value, Wrong> {
        let mut entries: Vec<Entry> = Vec::new();
        let mut seen = HashSet::new();
        self.blank();
        if self.peek() == Some(b'}') {
            self.at += 1;
            return Ok(Value::Table(entries));
        }
        loop {
            self.blank();
            let start = self.at;
            if self.peek() != Some(b'"') {
                return Err(self.wrong(
                    format!("expected a key in double quotes, found {}", self.found()),
                    (self.peek() == Some(b'}')).then_some("JSON allows no comma after the last value"),
                ));
            }
            let key = self.string()?;
            let key_span = self.span(start);
            if !seen.insert(key.clone()) {
                return Err(Wrong {
                    start,
                    end: self.at,
                    message: format!("the key `{key}` comes twice in one table"),
                    help: Some("keep one of them".to_owned()),
                });
            }
            self.expect(b':', "after a key")?;
            let node = self.value()?;
            entries.push(Entry { key, key_span, node });
            self.blank();
            match self.peek() {
                Some(b',') => self.at += 1,
                Some(b'}') => {
                    self.at += 1;
                    return Ok(Value::Table(entries));
                }
                _ => return Err(self.wrong(format!("expected `,` or `}}`, found {}", self.found()), None)),
            }
        }
    }

    fn list(&mut self) -> Result<Value, Wrong> {
        let mut nodes = Vec::new();
        self.blank();
        if self.peek() == Some(b']') {
            self.at += 1;
            return Ok(Value::List(nodes));
        }
        loop {
            nodes.push(self.value()?);
            self.blank();
            match self.peek() {
                Some(b',') => self.at += 1,
                Some(b']') => {
                    self.at += 1;
                    return Ok(Value::List(nodes));
                }
                _ => return Err(self.wrong(format!("expected `,` or `]`, found {}", self.found()), None)),
            }
        }
    }

    fn word(&mut self) -> Result<Value, Wrong> {
        let start = self.at;
        while matches!(self.peek(), Some(b'a'..=b'z' | b'A'..=b'Z' | b'_' | b'0'..=b'9')) {
            self.at += 1;
        }
        match &self.text[start..self.at] {
            "true" => Ok(Value::Flag(true)),
            "false" => Ok(Value::Flag(false)),
            "null" => Ok(Value::Null),
            word => {
                let help = match word {
                    "NaN" | "Infinity" | "nan" | "inf" => "JSON has finite numbers only, and so has a scene",
                    "" => "text stands in double quotes; numbers start with a digit or a minus",
                    _ => "text stands in double quotes",
                };
                let shown = if word.is_empty() { self.found() } else { format!("`{word}`") };
                Err(Wrong {
                    start,
                    end: self.at.max(start + 1),
                    message: format!("expected a value, found {shown}"),
                    help: Some(help.to_owned()),
                })
            }
        }
    }

    fn digits(&mut self) -> usize {
        let start = self.at;
        while matches!(self.peek(), Some(b'0'..=b'9')) {
            self.at += 1;
        }
        self.at - start
    }

    fn number(&mut self) -> Result<Value, Wrong> {
        let start = self.at;
        if self.peek() == Some(b'-') {
            self.at += 1;
        }
        let leading = self.peek();
        match self.digits() {
            0 => return Err(self.wrong(format!("expected a digit, found {}", self.found()), None)),
            1 => {}
            _ if leading == Some(b'0') => {
                return Err(Wrong {
                    start,
                    end: self.at,
                    message: "a number may not start with 0".to_owned(),
                    help: None,
                });
            }
            _ => {}
        }
        let mut whole = true;
        if self.peek() == Some(b'.') {
            whole = false;
            self.at += 1;
            if self.digits() == 0 {
                return Err(self.wrong(format!("expected a digit after the point, found {}", self.found()), None));
            }
        }
        if matches!(self.peek(), Some(b'e' | b'E')) {
            whole = false;
            self.at += 1;
            if matches!(self.peek(), Some(b'+' | b'-')) {
                self.at += 1;
            }
            if self.digits() == 0 {
                return Err(self.wrong(format!("expected a digit of the exponent, found {}", self.found()), None));
            }
        }
        let written = &self.text[start..self.at];
        if whole && let Ok(k) = written.parse::<i128>() {
            // -0 is a number with a sign.
            return Ok(if k == 0 && written.starts_with('-') { Value::Number(-0.0) } else { Value::Integer(k) });
        }
        match crate::number(written) {
            Some(x) => Ok(Value::Number(x)),
            None => Err(Wrong { start, end: self.at, message: format!("`{written}` is no number"), help: None }),
        }
    }

    fn string(&mut self) -> Result<String, Wrong> {
        let open = self.at;
        self.at += 1;
        let mut text = String::new();
        loop {
            let start = self.at;
            while !matches!(self.peek(), None | Some(b'"' | b'\\' | 0..=0x1f)) {
                self.at += 1;
            }
            // Every byte that stops the loop is ASCII, so both ends are characters' ends.
            text.push_str(&self.text[start..self.at]);
            match self.peek() {
                Some(b'"') => {
                    self.at += 1;
                    return Ok(text);
                }
                Some(b'\\') => text.push(self.escape()?),
                None | Some(b'\n' | b'\r') => {
                    return Err(Wrong {
                        start: open,
                        end: self.at,
                        message: "this text has no closing quote".to_owned(),
                        help: None,
                    });
                }
                Some(_) => {
                    return Err(self
                        .wrong(format!("{} may not stand in text", self.found()), Some("write it as an escape, \\t")));
                }
            }
        }
    }

    fn escape(&mut self) -> Result<char, Wrong> {
        let start = self.at;
        self.at += 1;
        let c = match self.peek() {
            Some(c @ (b'"' | b'\\' | b'/')) => c as char,
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => {
                self.at += 1;
                return self.unicode(start);
            }
            _ => return Err(self.wrong(format!("`\\` followed by {} is no escape", self.found()), None)),
        };
        self.at += 1;
        Ok(c)
    }

    fn unicode(&mut self, start: usize) -> Result<char, Wrong> {
        let lone = |end| Wrong { start, end, message: "half of a surrogate pair".to_owned(), help: None };
        let high = self.hex()?;
        if !(0xd800..0xe000).contains(&high) {
            return char::from_u32(high).ok_or_else(|| lone(self.at));
        }
        if high >= 0xdc00 || !self.text[self.at..].starts_with("\\u") {
            return Err(lone(self.at));
        }
        self.at += 2;
        let low = self.hex()?;
        if !(0xdc00..0xe000).contains(&low) {
            return Err(lone(self.at));
        }
        char::from_u32(0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00)).ok_or_else(|| lone(self.at))
    }

    fn hex(&mut self) -> Result<u32, Wrong> {
        let mut code = 0;
        for _ in 0..4 {
            let Some(digit) = self.peek().and_then(|b| (b as char).to_digit(16)) else {
                return Err(self.wrong(format!("expected four hexadecimal digits, found {}", self.found()), None));
            };
            code = 16 * code + digit;
            self.at += 1;
        }
        Ok(code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Node, Problem> {
        parse(&[Source { name: "t.json".to_owned(), text: text.to_owned() }], 0)
    }

    #[test]
    fn values() {
        let node = read(
            r#" { "a" : [ 1 , -2.5e3 , 0.1, 18446744073709551615 ], "b" : "\u00e9\ud83d\ude00\n\/", "c": {}, "d": [] ,
            "e": true, "f": null } "#,
        )
        .unwrap();
        let Value::List(a) = &node.get("a").unwrap().value else { panic!() };
        assert_eq!(
            a.iter().map(|n| n.number().unwrap()).collect::<Vec<_>>(),
            [1.0, -2500.0, 0.1, 18446744073709551615.0]
        );
        assert_eq!(a[3].integer(), Some(u64::MAX as i128));
        assert_eq!(node.get("b").unwrap().text(), Some("é😀\n/"));
        assert!(matches!(node.get("e").unwrap().value, Value::Flag(true)));
        assert!(matches!(node.get("f").unwrap().value, Value::Null));
    }

    #[test]
    fn numbers_are_rounded_correctly() {
        // 2^53 + 1 lies halfway; this one lies just above halfway, in its 767th digit, and must round up.
        let text = format!("9007199254740993.{}1", "0".repeat(750));
        assert_eq!(read(&text).unwrap().number(), Some(9007199254740994.0));
        assert_eq!(read("9007199254740993.0").unwrap().number(), Some(9007199254740992.0));
        assert_eq!(read("1e400").unwrap().number(), Some(f64::INFINITY));
        assert!(read("-0").unwrap().number().unwrap().is_sign_negative());
    }

    #[test]
    fn what_is_no_json_says_where() {
        let deep = "[".repeat(100_000);
        for (text, line, column, says) in [
            ("", 1, 1, "the end of the file"),
            ("{\n \"a\": 1,\n}", 3, 1, "key in double quotes"),
            ("[1,]", 1, 4, "expected a value"),
            ("{\"a\": 1 \"b\": 2}", 1, 9, "expected `,` or `}`"),
            ("{\"a\": 1, \"a\": 2}", 1, 10, "comes twice"),
            ("{\"a\" 1}", 1, 6, "expected `:`"),
            ("[01]", 1, 2, "may not start with 0"),
            ("[1.]", 1, 4, "after the point"),
            ("[1e]", 1, 4, "exponent"),
            ("[-]", 1, 3, "a digit"),
            ("[NaN]", 1, 2, "`NaN`"),
            ("['a']", 1, 2, "`'`"),
            ("[+1]", 1, 2, "`+`"),
            ("\"\\ud800\"", 1, 2, "surrogate"),
            ("\"\\ud800\\u0041\"", 1, 2, "surrogate"),
            ("\"\\udc00\"", 1, 2, "surrogate"),
            ("\"\\x\"", 1, 3, "no escape"),
            ("\"\\u12g4\"", 1, 6, "hexadecimal"),
            ("\"a\nb\"", 1, 1, "no closing quote"),
            ("\"a\tb\"", 1, 3, "U+0009"),
            ("{} {}", 1, 4, "nothing may follow"),
            (&deep, 1, DEEPEST + 1, "nested more than"),
            ("[\"é\", ?]", 1, 7, "`?`"),
        ] {
            let problem = read(text).unwrap_err();
            let shown = problem.to_string();
            assert!(problem.message.contains(says), "{shown}");
            assert_eq!((problem.line(), problem.column()), (Some(line), Some(column)), "{shown}");
        }
    }
}
