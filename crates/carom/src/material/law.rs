//! The names of the laws of one contact, of which a pair of surfaces may ask for one. What they compute stands in
//! [`crate::law`].

/// The law of one contact with friction. Without friction all of them are the lecture's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Law {
    /// Chatterjee and Ruina (1998): closed form, e exact, never gains energy. For balls the law of Walton and Luding.
    #[default]
    ChatterjeeRuina,
    /// Stronge (1990): Coulomb's friction through the course of the impact, e^2 the share of the energy of compression that
    /// comes back. Never gains energy.
    Stronge,
    /// The textbook's: Coulomb's friction through the course of the impact until the bodies part at e times the speed of
    /// approach. **Able to gain energy** where bodies are not balls; for comparison only.
    Newton,
}

crate::codec::codec!(enum Law: Law::ALL);

impl Law {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::ChatterjeeRuina, Self::Stronge, Self::Newton];

    /// The name in scene files: "chatterjee-ruina", "stronge" or "newton".
    pub fn as_str(self) -> &'static str {
        match self {
            Self::ChatterjeeRuina => "chatterjee-ruina",
            Self::Stronge => "stronge",
            Self::Newton => "newton",
        }
    }

    /// The law of this name, if there is one.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.as_str() == name)
    }
}
