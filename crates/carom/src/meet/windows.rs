//! Spans of time: when something is so.

/// At most eight spans of time, each of positive length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Windows {
    spans: [(f64, f64); Self::MOST],
    count: usize,
}

impl Windows {
    /// A quadratic is positive in two windows at most, three of them at once in four (over a part), six in seven (near a box);
    /// a part closes in during two at most, and both then hold in five. Eight is never full where it counts.
    const MOST: usize = 8;
    pub(super) const NEVER: Self = Self { spans: [(0.0, 0.0); Self::MOST], count: 0 };
    pub(super) const ALWAYS: Self = {
        let mut always = Self::NEVER;
        always.spans[0] = (0.0, f64::INFINITY);
        always.count = 1;
        always
    };

    /// Adds a span, unless it is empty or not a number.
    pub(super) fn add(&mut self, start: f64, end: f64) {
        if start < end && self.count < Self::MOST {
            self.spans[self.count] = (start, end);
            self.count += 1;
        }
    }

    pub(super) fn are_empty(&self) -> bool {
        self.count == 0
    }

    fn spans(&self) -> &[(f64, f64)] {
        &self.spans[..self.count]
    }

    /// When both are so.
    pub(super) fn and(&self, other: &Self) -> Self {
        let mut both = Self::NEVER;
        for &(s, e) in self.spans() {
            for &(start, end) in other.spans() {
                both.add(if start > s { start } else { s }, if end < e { end } else { e });
            }
        }
        both
    }

    /// The start of the first window; infinity if there is none.
    pub(super) fn first(&self) -> f64 {
        self.spans().iter().fold(f64::INFINITY, |first, &(start, _)| if start < first { start } else { first })
    }
}
