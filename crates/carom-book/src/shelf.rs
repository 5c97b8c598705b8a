//! The files of the book, which are in the binary: what is verified does not depend on where one stands.

/// From names to files, in the order of the table.
macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../../book/", $name, ".toml")))),*]
    };
}

/// Name and text of every file, from the lecture on.
pub(crate) const FILES: &[(&str, &str)] = files![
    "lecture",
    "two-bodies-1d",
    "oblique",
    "walls-and-pistons",
    "textbook",
    "restitution-tables",
    "bounces",
    "friction-and-spin",
    "impact-laws",
    "sliding-and-rolling",
    "pool",
    "cradles-and-chains",
    "racks-and-wedges",
    "galperin",
    "meetings",
    "hard-discs",
    "hard-spheres",
    "gas-statistics",
    "determinism",
];
