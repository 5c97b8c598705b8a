//! The heart of an impact in a few lines.
use super::teller::Teller;
use super::{Explanation, Language, Row, Unit};

/// Normal, approach, reduced mass, impulse, velocities after, energy lost.
pub(super) fn brief(x: &Explanation, language: Language) -> Vec<Row> {
    let teller = Teller::new(x, language);
    let mut rows = Vec::new();
    let backwards = x.dim == 1 && x.normal[0] < 0.0;
    if x.dim > 1 {
        rows.push(teller.row("n", Unit::One));
    }
    let approach = match (x.dim, backwards) {
        (1, false) => "u = v1 - v2",
        (1, true) => "u = v2 - v1",
        _ => "u = (v1 - v2)·n",
    };
    rows.push(teller.row(approach, Unit::Velocity));
    if !x.meets() {
        rows.extend(["v1' = v1", "v2' = v2"].map(|r| teller.row(r, Unit::Velocity)));
        return rows;
    }
    let mass = teller.reduced_mass();
    rows.push(teller.row(&mass, Unit::Mass));
    rows.push(teller.row(&teller.fitted("J = (1 + e) #m u"), Unit::Impulse));
    if let Some(rough) = &x.rough {
        rows.extend(teller.friction_in_short(rough));
        rows.push(teller.row("Q = Qn + Qt", Unit::Energy));
        return rows;
    }
    for (k, [along, against]) in [("1", ["-", "+"]), ("2", ["+", "-"])] {
        let wall = x.wall().is_some_and(|w| (w + 1).to_string() == k);
        let (sign, n) = (if backwards { against } else { along }, if x.dim == 1 { "" } else { " n" });
        let source = if wall { format!("v{k}' = v{k}") } else { format!("v{k}' = v{k} {sign} J/m{k}{n}") };
        rows.push(teller.row(&source, Unit::Velocity));
    }
    rows.push(teller.row("Q = ½ μ (1 - e^2) u^2", Unit::Energy));
    rows
}
