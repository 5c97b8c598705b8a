//! A sheet of paper with marks on it, before it is known how it will be written: lengths in pixels, y downwards.
use crate::colour::Colour;
use crate::font::{self, Weight};

/// A point of a sheet.
pub type At = [f64; 2];

/// A piece of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Starts anew at a point.
    Move(At),
    /// A straight line to a point.
    Line(At),
    /// A parabola by a control point to a point.
    Quad(At, At),
    /// A cubic by two control points to a point.
    Cubic(At, At, At),
    /// Back to where it started.
    Close,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// Its colour.
    pub colour: Colour,
    /// Its width.
    pub width: f64,
    /// Lengths of dash and gap.
    pub dash: Option<[f64; 2]>,
}

impl Pen {
    /// A solid line.
    pub fn new(colour: Colour, width: f64) -> Self {
        Self { colour, width, dash: None }
    }

    /// A dashed line.
    pub fn dashed(self, dash: f64, gap: f64) -> Self {
        Self { dash: Some([dash, gap]), ..self }
    }
}

/// What a mark looks like.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A disc.
    Disc {
        /// Its centre.
        centre: At,
        /// Its radius.
        radius: f64,
    },
    /// A ball, lit from the upper left.
    Ball {
        /// Its centre.
        centre: At,
        /// Its radius.
        radius: f64,
    },
    /// An outline.
    Outline(Vec<Step>),
}

/// A rectangle: left, top, right, bottom.
pub type Window = [f64; 4];

/// A mark.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// What it looks like.
    pub form: Form,
    /// What fills it.
    pub fill: Option<Colour>,
    /// Its edge.
    pub pen: Option<Pen>,
    /// What does not lie in this window is not seen.
    pub window: Option<Window>,
    /// What it says, if it is writing.
    pub says: Option<String>,
}

/// Where a text stands relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// To the right of it.
    Start,
    /// In the middle over it.
    Middle,
    /// To the left of it.
    End,
}

/// How a text is set.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// The size of an em.
    pub size: f64,
    /// Its weight.
    pub weight: Weight,
    /// Its colour.
    pub colour: Colour,
    /// Which side of its point it takes.
    pub side: Side,
}

impl Style {
    /// Plain text that starts at its point.
    pub fn new(size: f64, colour: Colour) -> Self {
        Self { size, weight: Weight::Regular, colour, side: Side::Start }
    }

    /// The same, heavier.
    pub fn bold(self) -> Self {
        Self { weight: Weight::Semibold, ..self }
    }

    /// The same, on another side.
    pub fn side(self, side: Side) -> Self {
        Self { side, ..self }
    }
}

/// A sheet of marks, the first at the bottom.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// The marks.
    pub marks: Vec<Mark>,
    /// The window of the marks to come.
    pub window: Option<Window>,
}

impl Sheet {
    /// An empty sheet.
    pub fn new() -> Self {
        Self::default()
    }

    fn put(&mut self, form: Form, fill: Option<Colour>, pen: Option<Pen>) {
        self.marks.push(Mark { form, fill, pen, window: self.window, says: None });
    }

    /// A filled disc.
    pub fn disc(&mut self, centre: At, radius: f64, fill: Colour) {
        if finite(&[centre]) && radius > 0.0 {
            self.put(Form::Disc { centre, radius }, Some(fill), None);
        }
    }

    /// A circle.
    pub fn ring(&mut self, centre: At, radius: f64, pen: Pen) {
        if finite(&[centre]) && radius > 0.0 {
            self.put(Form::Disc { centre, radius }, None, Some(pen));
        }
    }

    /// A ball with light and shade.
    pub fn ball(&mut self, centre: At, radius: f64, fill: Colour) {
        if finite(&[centre]) && radius > 0.0 {
            self.put(Form::Ball { centre, radius }, Some(fill), None);
        }
    }

    /// A line through points.
    pub fn line(&mut self, points: &[At], pen: Pen) {
        if points.len() > 1 && finite(points) {
            self.put(Form::Outline(polyline(points, false)), None, Some(pen));
        }
    }

    /// A filled polygon.
    pub fn area(&mut self, points: &[At], fill: Colour) {
        if points.len() > 2 && finite(points) {
            self.put(Form::Outline(polyline(points, true)), Some(fill), None);
        }
    }

    /// A filled rectangle.
    pub fn rectangle(&mut self, [left, top, right, bottom]: Window, fill: Colour) {
        self.area(&[[left, top], [right, top], [right, bottom], [left, bottom]], fill);
    }

    /// A filled rectangle with round corners.
    pub fn rounded(&mut self, window: Window, radius: f64, fill: Colour) {
        let [left, top, right, bottom] = window;
        let r = radius.min(0.5 * (right - left)).min(0.5 * (bottom - top));
        if !(r > 0.0) || !finite(&[[left, top], [right, bottom]]) {
            return self.rectangle(window, fill);
        }
        let steps = vec![
            Step::Move([left + r, top]),
            Step::Line([right - r, top]),
            Step::Quad([right, top], [right, top + r]),
            Step::Line([right, bottom - r]),
            Step::Quad([right, bottom], [right - r, bottom]),
            Step::Line([left + r, bottom]),
            Step::Quad([left, bottom], [left, bottom - r]),
            Step::Line([left, top + r]),
            Step::Quad([left, top], [left + r, top]),
            Step::Close,
        ];
        self.put(Form::Outline(steps), Some(fill), None);
    }

    /// An outline, drawn.
    pub fn stroke(&mut self, steps: Vec<Step>, pen: Pen) {
        self.put(Form::Outline(steps), None, Some(pen));
    }

    /// A text on a baseline; its width.
    pub fn text(&mut self, at: At, text: &str, style: Style) -> f64 {
        let width = font::width(text, style.size, style.weight);
        let left = match style.side {
            Side::Start => at[0],
            Side::Middle => at[0] - 0.5 * width,
            Side::End => at[0] - width,
        };
        let steps = font::outline(text, [left, at[1]], style.size, style.weight);
        if finite(&[[left, at[1]]]) && !steps.is_empty() {
            self.put(Form::Outline(steps), Some(style.colour), None);
            if let Some(mark) = self.marks.last_mut() {
                mark.says = Some(text.to_owned());
            }
        }
        width
    }

    /// A text turned by a quarter to the left, centred on its point.
    pub fn upright(&mut self, at: At, text: &str, style: Style) {
        let width = font::width(text, style.size, style.weight);
        let turn = |p: At| [at[0] + p[1], at[1] + 0.5 * width - p[0]];
        let steps: Vec<Step> = font::outline(text, [0.0, 0.0], style.size, style.weight)
            .into_iter()
            .map(|step| match step {
                Step::Move(p) => Step::Move(turn(p)),
                Step::Line(p) => Step::Line(turn(p)),
                Step::Quad(c, p) => Step::Quad(turn(c), turn(p)),
                Step::Cubic(c, d, p) => Step::Cubic(turn(c), turn(d), turn(p)),
                Step::Close => Step::Close,
            })
            .collect();
        if !steps.is_empty() {
            self.put(Form::Outline(steps), Some(style.colour), None);
            if let Some(mark) = self.marks.last_mut() {
                mark.says = Some(text.to_owned());
            }
        }
    }

    /// An arrow from one point to another, its head at the second.
    pub fn arrow(&mut self, from: At, to: At, pen: Pen) {
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
        if !(length > 0.5) || !finite(&[from, to]) {
            return;
        }
        let u = [along[0] / length, along[1] / length];
        let head = (4.5 * pen.width).min(length);
        let half = 0.42 * head;
        let neck = [to[0] - u[0] * head, to[1] - u[1] * head];
        if length > head {
            self.line(&[from, [neck[0] + u[0] * 0.3 * head, neck[1] + u[1] * 0.3 * head]], pen);
        }
        let back = [neck[0] + u[0] * 0.12 * head, neck[1] + u[1] * 0.12 * head];
        let left = [neck[0] - u[1] * half, neck[1] + u[0] * half];
        let right = [neck[0] + u[1] * half, neck[1] - u[0] * half];
        self.area(&[to, left, back, right], pen.colour);
    }

    /// All marks of another sheet, on top.
    pub fn append(&mut self, other: Sheet) {
        self.marks.extend(other.marks);
    }
}

fn polyline(points: &[At], close: bool) -> Vec<Step> {
    let mut steps: Vec<Step> =
        points.iter().enumerate().map(|(k, p)| if k == 0 { Step::Move(*p) } else { Step::Line(*p) }).collect();
    if close {
        steps.push(Step::Close);
    }
    steps
}

/// True if all of these can be drawn: what has left the numbers is left out.
fn finite(points: &[At]) -> bool {
    points.iter().flatten().all(|x| x.abs() < 1e6)
}
