//! `[[wall]]`
use crate::fields::Fields;
use crate::model::{Form, Wall};
use crate::problem::Problem;

/// The shapes, and the dimension that each needs.
const SHAPES: [(&str, Option<usize>); 4] =
    [("plane", None), ("segment", Some(2)), ("arc", Some(2)), ("triangle", Some(3))];

/// The `k`-th wall, from 1.
pub(super) fn read(fields: &Fields<'_>, k: usize, dim: usize) -> Wall {
    let given: Vec<_> = SHAPES.iter().filter(|s| fields.has(s.0)).collect();
    let choice = "exactly one of plane (any dim), segment (2D), arc (2D), triangle (3D)";
    let mut form = None;
    match given[..] {
        [] => fields.tell(Problem::new(fields.path.clone(), "a wall needs a shape").help(choice)),
        [&(shape, needs)] => match needs {
            Some(needs) if needs != dim => {
                fields.tell_key(shape, format!("a {shape} lives in {needs}D, and dim = {dim}"), choice);
            }
            _ => form = read_form(fields, shape),
        },
        [first, second, ..] => {
            fields.tell_key(second.0, format!("a wall has one shape, and this one has {} already", first.0), choice);
        }
    }
    Wall {
        name: super::name(fields, "wall", k),
        form: form.unwrap_or_else(|| Form::Plane { point: vec![0.0; dim], normal: vec![1.0; dim] }),
        velocity: fields.vector("velocity").unwrap_or_else(|| vec![0.0; dim]),
        material: fields.text("material").unwrap_or("default").to_owned(),
    }
}

fn read_form(fields: &Fields<'_>, shape: &str) -> Option<Form> {
    let shape = fields.table(shape)?;
    let name = shape.path.rsplit('.').next().unwrap_or_default();
    match name {
        "plane" => {
            let (point, normal) = (shape.vector("point"), shape.vector("normal"));
            let (point, normal) = (point?, normal?);
            if normal.iter().all(|x| *x == 0.0) {
                shape.tell_key("normal", "normal must not be zero", "any length but 0, towards the balls");
                return None;
            }
            Some(Form::Plane { point, normal })
        }
        "segment" => {
            let (from, to) = (shape.vector("from"), shape.vector("to"));
            let (from, to) = (from?, to?);
            if from == to {
                shape.tell_key("to", "a segment must have a length, and its ends are the same", "two different points");
                return None;
            }
            Some(Form::Segment { from, to })
        }
        "arc" => {
            let (centre, radius) = (shape.vector("centre"), shape.number("radius"));
            let (from, to) = (shape.number("from"), shape.number("to"));
            let (from, to) = (from?, to?);
            let help = "degrees, counter-clockwise from +x: from = 0, to = 90 is the upper right quarter";
            if from == to {
                shape.tell_key("to", "an arc must have a length, and its ends are the same", help);
                return None;
            }
            if !((to - from).abs() <= 360.0) {
                shape.tell_key("to", format!("an arc is at most one turn, got {} degrees", to - from), help);
                return None;
            }
            Some(Form::Arc { centre: centre?, radius: radius?, from, to })
        }
        _ => {
            let corners = [shape.vector("a"), shape.vector("b"), shape.vector("c")];
            let [Some(a), Some(b), Some(c)] = corners else { return None };
            if crate::geometry::area_vector(&a, &b, &c).iter().all(|x| *x == 0.0) {
                let key = shape.path.clone();
                shape.tell(
                    Problem::new(key, "a triangle must have an area, and its corners lie on one line")
                        .help("three corners that do not lie on one line"),
                );
                return None;
            }
            Some(Form::Triangle([a, b, c]))
        }
    }
}
