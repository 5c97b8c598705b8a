//! A sheet as SVG. Letters are outlines; numbers are rounded to a hundredth of a pixel.
use crate::colour::Colour;
use crate::sheet::{At, Form, Mark, Pen, Sheet, Step, Window};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The sheets, one on another, as an SVG document of this size.
pub fn svg(size: [u32; 2], paper: Colour, title: &str, sheets: &[&Sheet]) -> String {
    let [width, height] = size;
    let mut out = String::new();
    let _ = writeln!(
        out,
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" role="img">"#
    );
    if !title.is_empty() {
        let _ = writeln!(out, "<title>{}</title>", escaped(title));
    }
    let marks = || sheets.iter().flat_map(|sheet| &sheet.marks);
    // Windows and lights are named in the order in which they are met.
    let mut windows: Vec<Window> = Vec::new();
    let mut lights: BTreeMap<Colour, usize> = BTreeMap::new();
    for mark in marks() {
        if let Some(window) = mark.window
            && !windows.contains(&window)
        {
            windows.push(window);
        }
        if let (Form::Ball { .. }, Some(colour)) = (&mark.form, mark.fill) {
            let next = lights.len();
            lights.entry(colour).or_insert(next);
        }
    }
    if !windows.is_empty() || !lights.is_empty() {
        out += "<defs>\n";
        for (k, [left, top, right, bottom]) in windows.iter().enumerate() {
            let (x, y, w, h) = (number(*left), number(*top), number(right - left), number(bottom - top));
            let _ = writeln!(out, r#"<clipPath id="w{k}"><rect x="{x}" y="{y}" width="{w}" height="{h}"/></clipPath>"#);
        }
        for (colour, k) in &lights {
            let _ = write!(out, r#"<radialGradient id="b{k}" cx="0.36" cy="0.33" r="0.72">"#);
            for (at, shade) in crate::ball::STOPS {
                let lit = crate::ball::lit(*colour, shade);
                let _ = write!(out, r#"<stop offset="{at}" stop-color="{}"/>"#, hex(lit));
            }
            out += "</radialGradient>\n";
        }
        out += "</defs>\n";
    }
    let _ = writeln!(out, r#"<rect width="{width}" height="{height}" fill="{}"/>"#, hex(paper));
    let mut open: Option<Window> = None;
    for mark in marks() {
        if mark.window != open {
            if open.is_some() {
                out += "</g>\n";
            }
            if let Some(k) = mark.window.and_then(|w| windows.iter().position(|o| *o == w)) {
                let _ = writeln!(out, r#"<g clip-path="url(#w{k})">"#);
            }
            open = mark.window;
        }
        write_mark(&mut out, mark, &lights);
    }
    if open.is_some() {
        out += "</g>\n";
    }
    out + "</svg>\n"
}

fn write_mark(out: &mut String, mark: &Mark, lights: &BTreeMap<Colour, usize>) {
    match &mark.form {
        Form::Disc { centre, radius } | Form::Ball { centre, radius } => {
            let [x, y] = centre.map(number);
            let _ = write!(out, r#"<circle cx="{x}" cy="{y}" r="{}""#, number(*radius));
        }
        Form::Outline(steps) => {
            let _ = write!(out, r#"<path d="{}""#, path(steps));
        }
    }
    match (&mark.form, mark.fill) {
        (Form::Ball { .. }, Some(colour)) => {
            let _ = write!(out, r#" fill="url(#b{})""#, lights.get(&colour).copied().unwrap_or(0));
        }
        (_, Some(colour)) => paint(out, "fill", colour),
        (_, None) => out.push_str(r#" fill="none""#),
    }
    if let Some(Pen { colour, width, dash }) = mark.pen {
        paint(out, "stroke", colour);
        let _ = write!(out, r#" stroke-width="{}" stroke-linecap="round" stroke-linejoin="round""#, number(width));
        if let Some([dash, gap]) = dash {
            let _ = write!(out, r#" stroke-dasharray="{} {}""#, number(dash), number(gap));
        }
    }
    match &mark.says {
        Some(says) => {
            let _ = writeln!(out, r#" aria-label="{}"/>"#, escaped(says));
        }
        None => out.push_str("/>\n"),
    }
}

fn paint(out: &mut String, what: &str, colour: Colour) {
    let _ = write!(out, r#" {what}="{}""#, hex(colour));
    if colour.a < 255 {
        let _ = write!(out, r#" {what}-opacity="{}""#, number(f64::from(colour.a) / 255.0));
    }
}

fn path(steps: &[Step]) -> String {
    let mut out = String::new();
    let point = |out: &mut String, p: At| {
        let _ = write!(out, "{} {}", number(p[0]), number(p[1]));
    };
    for step in steps {
        match *step {
            Step::Move(p) => {
                out.push('M');
                point(&mut out, p);
            }
            Step::Line(p) => {
                out.push('L');
                point(&mut out, p);
            }
            Step::Quad(c, p) => {
                out.push('Q');
                point(&mut out, c);
                out.push(' ');
                point(&mut out, p);
            }
            Step::Cubic(c, d, p) => {
                out.push('C');
                for (k, x) in [c, d, p].into_iter().enumerate() {
                    if k > 0 {
                        out.push(' ');
                    }
                    point(&mut out, x);
                }
            }
            Step::Close => out.push('Z'),
        }
    }
    out
}

fn hex(colour: Colour) -> String {
    format!("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b)
}

/// A number to a hundredth, as short as it goes.
fn number(x: f64) -> String {
    let rounded = (x * 100.0).round() / 100.0;
    if rounded == 0.0 { "0".into() } else { format!("{rounded}") }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_text_is_escaped() {
        assert_eq!([0.0, -0.001, 1.0, 2.345, -2.5].map(number), ["0", "0", "1", "2.35", "-2.5"]);
        let mut sheet = Sheet::new();
        sheet.disc([1.0, 2.0], 3.0, Colour::hex(0x0072b2));
        sheet.disc([f64::NAN, 2.0], 3.0, Colour::hex(0x0072b2));
        let text = svg([10, 20], Colour::hex(0xffffff), "a < b & \"c\"", &[&sheet]);
        assert!(text.contains("<title>a &lt; b &amp; &quot;c&quot;</title>"));
        assert!(text.contains(r##"<circle cx="1" cy="2" r="3" fill="#0072b2"/>"##));
        assert_eq!(text.matches("<circle").count(), 1, "what is nowhere is not drawn");
    }
}
