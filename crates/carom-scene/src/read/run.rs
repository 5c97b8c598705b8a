//! `[run]` and `[[output]]`
use crate::fields::Fields;
use crate::model::{Law, Output, Run, Together, Until};

/// The rest speed of a scene that names none (m/s).
const REST_SPEED: f64 = 0.01;
/// The seed of a scene that names none.
const SEED: u64 = 1;

/// The run; every key has a default.
pub(super) fn read(fields: Option<&Fields<'_>>) -> Run {
    let until = fields.and_then(|f| f.table("until")).map_or_else(Until::default, |f| Until {
        time: f.number("time"),
        impacts: f.integer("impacts"),
        rest: f.flag("rest").unwrap_or(false),
    });
    Run {
        until,
        seed: fields.and_then(|f| f.integer("seed")).unwrap_or(SEED),
        together: fields.and_then(|f| f.choice("together")).and_then(Together::named).unwrap_or_default(),
        law: fields.and_then(|f| f.choice("law")).and_then(Law::named).unwrap_or_default(),
        rest_speed: fields.and_then(|f| f.number("rest_speed")).unwrap_or(REST_SPEED),
    }
}

/// One output.
pub(super) fn output(fields: &Fields<'_>) -> Output {
    let path = fields.text("path").unwrap_or_default();
    let output = Output { path: path.to_owned(), every: fields.table("every").and_then(|every| every.number("time")) };
    if fields.has("path") && !crate::extensions::is_known(&output.extension()) {
        fields.tell_key(
            "path",
            format!("unknown extension of the output `{path}`"),
            format!("the extension picks the format: {}", crate::extensions::known()),
        );
    }
    output
}
