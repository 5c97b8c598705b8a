//! `[material.name]` and `[[pair]]`
use crate::fields::Fields;
use crate::model::{Law, Pair, Surface};

/// All materials: the default one first, the others in the order of the file.
pub(super) fn all(fields: &Fields<'_>) -> Vec<Surface> {
    let mut all = vec![Surface { name: "default".to_owned(), ..Surface::default() }];
    for (name, fields) in fields.named("material") {
        let surface = Surface {
            name: name.to_owned(),
            restitution: fields.coefficient("restitution"),
            friction: fields.coefficient("friction"),
            tangential: fields.number("tangential"),
            rolling: fields.number("rolling"),
            spinning: fields.number("spinning"),
        };
        match name {
            "default" => all[0] = surface,
            _ => all.push(surface),
        }
    }
    all
}

/// One line of the pair table.
pub(super) fn pair(fields: &Fields<'_>) -> Pair {
    Pair {
        materials: fields.two_names("materials").unwrap_or_else(|| ["default".to_owned(), "default".to_owned()]),
        restitution: fields.coefficient("restitution"),
        friction: fields.coefficient("friction"),
        tangential: fields.number("tangential"),
        law: fields.choice("law").and_then(Law::named),
    }
}
