//! The audit for people: what there was, what was given and taken, what there is, and what nothing explains.
use crate::figures::{beside, digits, plural};
use crate::table::Table;
use carom::ledger::{DRIFT_LIMIT, OVERLAP_LIMIT};
use carom_scene::output::{Audit, Report, Share};

const AXES: [&str; 3] = ["x", "y", "z"];

/// The table, and the verdict.
pub fn text(report: &Report, colour: bool) -> String {
    let audit = &report.audit;
    let e = &audit.energy;
    // The size of the terms behind each account: what is far smaller is rounding.
    let energy = e.start.abs().max(e.end.abs()).max(e.kinetic).max(e.work.abs()).max(e.lost.abs());
    let moving = || report.bodies.iter().filter(|b| b.state != "fixed");
    let mass: f64 = moving().filter_map(|b| b.mass).sum();
    let arm = moving().flat_map(|b| &b.position).fold(0.0, |far: f64, x| far.max(x.abs()));
    let momentum = (2.0 * mass * energy).sqrt();
    let mut table = Table::new("lrrrr", ["Audit", "start", "given", "end", "unexplained"]);
    let mut share = |name: &str, unit: &str, share: &Share, scale: f64| {
        let all = [&share.start, &share.given, &share.end].into_iter().flatten();
        let scale = all.fold(scale, |scale, x| scale.max(x.abs()));
        for k in 0..share.start.len() {
            // On a line there is one component, and in the plane one spin: no letters.
            let axis = if share.start.len() > 1 { format!(" {}", AXES[k]) } else { String::new() };
            let cells = [share.start[k], share.given[k], share.end[k]].map(|x| beside(x, scale));
            let drift = if k == 0 { digits(share.drift, 2) } else { String::new() };
            table.row([vec![format!("{name}{axis}, {unit}")], cells.into(), vec![drift]].concat());
        }
    };
    share("momentum", "kg m/s", &audit.momentum, momentum);
    if let Some(angular) = &audit.angular_momentum {
        share("angular momentum", "kg m2/s", angular, momentum * arm);
    }
    let short = |x: f64| beside(x, energy);
    let cells = [e.start, e.work - e.lost, e.end].map(short);
    table.row([vec!["energy, J".to_string()], cells.into(), vec![digits(e.drift, 2)]].concat());
    let mut text = table.text(colour);
    let mut notes = vec![format!("lost in impacts {} J", short(e.lost))];
    if e.work != 0.0 {
        notes.push(format!("work of what is driven {} J", short(e.work)));
    }
    if e.potential != 0.0 {
        notes.push(format!("kinetic {} J, potential {} J at the end", short(e.kinetic), short(e.potential)));
    }
    text += &format!("  ({})\n", notes.join("; "));
    let capped = match audit.capped {
        0 => String::new(),
        n => format!(" {} cut off by an iteration limit.", plural(n, "instant")),
    };
    text += &match audit.pass {
        true => format!(
            "  {} every account closes to {} (limit {}); deepest overlap {}.{capped}\n",
            stamp("PASSED", "32", colour),
            digits(audit.worst(), 2),
            digits(DRIFT_LIMIT, 2),
            digits(audit.overlap, 2)
        ),
        false => format!("  {} {}.{capped}\n", stamp("FAILED", "31", colour), failure(audit)),
    };
    text
}

fn stamp(word: &str, code: &str, colour: bool) -> String {
    if colour { format!("\x1b[1;{code}m{word}\x1b[0m") } else { format!("{word}:") }
}

/// What the audit objects to.
pub fn failure(audit: &Audit) -> String {
    let angular = audit.angular_momentum.as_ref().map_or(0.0, |a| a.drift);
    let mut all = Vec::new();
    for (what, drift) in
        [("momentum", audit.momentum.drift), ("angular momentum", angular), ("energy", audit.energy.drift)]
    {
        if !drift.is_finite() {
            all.push(format!("the {what} is not a finite number"));
        } else if drift >= DRIFT_LIMIT {
            all.push(format!("{} of the {what} is unexplained (limit {})", digits(drift, 2), digits(DRIFT_LIMIT, 2)));
        }
    }
    if !(audit.overlap < OVERLAP_LIMIT) {
        let limit = digits(OVERLAP_LIMIT, 2);
        all.push(format!("bodies overlap by {} of the smaller radius (limit {limit})", digits(audit.overlap, 2)));
    }
    all.join("; ")
}
