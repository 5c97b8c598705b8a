//! A sheet of characters to draw on: eight dots in each (braille), and letters over them.

/// Dots across and down in one character.
pub const ACROSS: usize = 2;
pub const DOWN: usize = 4;

/// A sheet. Dots are counted from the upper left corner.
pub struct Canvas {
    columns: usize,
    rows: usize,
    dots: Vec<u8>,
    letters: Vec<Option<char>>,
}

impl Canvas {
    pub fn new(columns: usize, rows: usize) -> Self {
        Self { columns, rows, dots: vec![0; columns * rows], letters: vec![None; columns * rows] }
    }

    /// Its size in dots.
    pub fn size(&self) -> [usize; 2] {
        [self.columns * ACROSS, self.rows * DOWN]
    }

    /// Sets a dot; nothing happens outside.
    pub fn dot(&mut self, x: f64, y: f64) {
        let [width, height] = self.size();
        let (x, y) = (x.floor(), y.floor());
        if !(x >= 0.0 && y >= 0.0 && x < width as f64 && y < height as f64) {
            return;
        }
        let (x, y) = (x as usize, y as usize);
        // The Unicode order: the left column down, the right column down, then the last row.
        const BITS: [[u8; ACROSS]; DOWN] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];
        self.dots[y / DOWN * self.columns + x / ACROSS] |= BITS[y % DOWN][x % ACROSS];
    }

    /// A straight line of dots, cut to the sheet first: its ends may lie anywhere.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2]) {
        let [width, height] = self.size().map(|n| n as f64);
        let Some((from, to)) = cut(from, to, [width, height]) else { return };
        let steps = (to[0] - from[0]).abs().max((to[1] - from[1]).abs()).ceil().max(1.0);
        for k in 0..=steps as usize {
            let part = k as f64 / steps;
            self.dot(from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1]));
        }
    }

    /// A circle of dots.
    pub fn circle(&mut self, centre: [f64; 2], radius: f64) {
        self.arc(centre, radius, 0.0, std::f64::consts::TAU);
    }

    /// An arc of dots between two angles (rad), as seen on the sheet: y downwards.
    pub fn arc(&mut self, centre: [f64; 2], radius: f64, from: f64, to: f64) {
        let steps = ((to - from).abs() * radius * 1.5).ceil().clamp(1.0, 4000.0);
        for k in 0..=steps as usize {
            let angle = from + (to - from) * k as f64 / steps;
            self.dot(centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin());
        }
    }

    /// Writes over the dots, as far as there is room; `x` and `y` are dots.
    pub fn write(&mut self, x: f64, y: f64, text: &str) {
        let [width, height] = self.size().map(|n| n as f64);
        if !(x >= 0.0 && y >= 0.0 && x < width && y < height) {
            return;
        }
        let length = text.chars().count();
        // Centred on the dot.
        let column =
            (x as usize / ACROSS + 1).saturating_sub(length.div_ceil(2)).min(self.columns.saturating_sub(length));
        let row = y as usize / DOWN;
        for (k, letter) in text.chars().enumerate().take(self.columns - column) {
            self.letters[row * self.columns + column + k] = Some(letter);
        }
    }

    /// The lines of the sheet, blanks at their ends left out.
    pub fn lines(&self) -> Vec<String> {
        let cell = |k: usize| match (self.letters[k], self.dots[k]) {
            (Some(letter), _) => letter,
            (None, 0) => ' ',
            (None, dots) => char::from_u32(0x2800 + u32::from(dots)).unwrap_or(' '),
        };
        let line = |row: usize| (0..self.columns).map(|column| cell(row * self.columns + column)).collect::<String>();
        (0..self.rows).map(|row| line(row).trim_end().to_string()).collect()
    }
}

/// The part of a segment that lies on a sheet of this size (Liang and Barsky 1984).
fn cut(from: [f64; 2], to: [f64; 2], size: [f64; 2]) -> Option<([f64; 2], [f64; 2])> {
    let d = [to[0] - from[0], to[1] - from[1]];
    let (mut first, mut last) = (0.0f64, 1.0f64);
    for k in 0..2 {
        for (rate, room) in [(-d[k], from[k]), (d[k], size[k] - from[k])] {
            if rate == 0.0 && room < 0.0 {
                return None;
            } else if rate < 0.0 {
                first = first.max(room / rate);
            } else if rate > 0.0 {
                last = last.min(room / rate);
            }
        }
    }
    let at = |s: f64| [from[0] + s * d[0], from[1] + s * d[1]];
    // Not a number compares false with everything: nothing is drawn.
    (first <= last).then(|| (at(first), at(last)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dots_and_letters() {
        let mut canvas = Canvas::new(3, 1);
        canvas.line([0.0, 0.0], [0.0, 3.0]);
        canvas.dot(3.0, 3.0);
        canvas.write(5.0, 0.0, "A");
        assert_eq!(canvas.lines(), ["⡇⢀A"]);
    }

    #[test]
    fn nothing_outside_is_drawn() {
        let mut canvas = Canvas::new(2, 2);
        for far in [-1e300, -1.0, 1e9, f64::INFINITY, f64::NAN] {
            canvas.dot(far, 0.0);
            canvas.line([far, far], [far, far]);
            canvas.write(far, 0.0, "A");
            canvas.circle([far, far], 1.0);
        }
        canvas.line([-10.0, 4.0], [10.0, 4.0]);
        assert_eq!(canvas.lines(), ["", "⠉⠉"]);
    }
}
