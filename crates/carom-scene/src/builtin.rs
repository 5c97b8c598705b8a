//! The scenes that are in the binary: one idea each, and each its own explanation.

/// A scene that comes with the program.
#[derive(Clone, Copy, Debug)]
pub struct Builtin {
    /// What to call it on the command line.
    pub name: &'static str,
    /// Its file.
    pub text: &'static str,
}

/// From the name to the file.
macro_rules! builtins {
    ($($name:literal),* $(,)?) => {
        &[$(Builtin { name: $name, text: include_str!(concat!("../../../scenes/", $name, ".toml")) }),*]
    };
}

/// All of them, from the simplest on.
const ALL: &[Builtin] = builtins![
    "two-balls",
    "oblique",
    "space",
    "wall",
    "piston",
    "bounce",
    "drop",
    "cradle",
    "cradle-both",
    "cradle-masses",
    "cradle-soft",
    "bernoulli",
    "three-on-one",
    "corner",
    "wedge",
    "pinned",
    "locked",
    "collapse",
    "tower",
    "heap",
    "pi-31",
    "pi",
    "break",
    "galton",
    "marble",
    "superball",
    "grip",
    "slide-roll",
    "topspin",
    "throw",
    "thirty-degrees",
    "slope",
    "repose",
    "gas",
    "spheres",
];

impl Builtin {
    /// Its title.
    pub fn title(&self) -> &'static str {
        let line = self.text.lines().find_map(|line| line.strip_prefix("title = \""));
        line.and_then(|line| line.split('"').next()).unwrap_or(self.name)
    }
}

/// The built-in scenes, from the simplest on.
pub fn builtins() -> impl Iterator<Item = &'static Builtin> {
    ALL.iter()
}

/// The file of the built-in scene of this name.
pub fn builtin(name: &str) -> Option<&'static str> {
    ALL.iter().find(|b| b.name == name).map(|b| b.text)
}

/// The built-in name nearest to one that is not known, for a message.
pub fn nearest_builtin(name: &str) -> Option<&'static str> {
    crate::nearest::nearest(name, ALL.iter().map(|b| b.name)).filter(|n| n.1).map(|n| n.0)
}
