//! Light and dark.
use crate::colour::{Colour, PALETTE_DARK, PALETTE_LIGHT};

/// What is drawn on what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Paper {
    /// Dark on light.
    #[default]
    Light,
    /// Light on dark.
    Dark,
}

/// The colours of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Theme {
    /// True on dark paper.
    pub dark: bool,
    /// Around the stage.
    pub paper: Colour,
    /// The stage.
    pub floor: Colour,
    /// Letters and what matters.
    pub ink: Colour,
    /// Letters that matter less.
    pub quiet: Colour,
    /// Grids, tracks.
    pub faint: Colour,
    /// Walls.
    pub wall: Colour,
    /// What stands fast.
    pub fixed: Colour,
    /// Impacts.
    pub flash: Colour,
    /// Kinetic, potential and lost energy.
    pub energy: [Colour; 3],
    /// Arrows of velocity, momentum and impulse.
    pub arrows: [Colour; 3],
    /// Bodies, told apart.
    pub palette: [Colour; 8],
}

impl Paper {
    /// Its colours.
    pub fn theme(self) -> Theme {
        match self {
            Self::Light => Theme {
                dark: false,
                paper: Colour::hex(0xffffff),
                floor: Colour::hex(0xf6f7f9),
                ink: Colour::hex(0x1b2430),
                quiet: Colour::hex(0x5f6b7a),
                faint: Colour::hex(0xdde2e8),
                wall: Colour::hex(0x4a5563),
                fixed: Colour::hex(0x98a2af),
                flash: Colour::hex(0xd1495b),
                energy: [Colour::hex(0x0072b2), Colour::hex(0x56b4e9), Colour::hex(0xe69f00)],
                arrows: [Colour::hex(0x1b2430), Colour::hex(0x009e73), Colour::hex(0xd1495b)],
                palette: PALETTE_LIGHT,
            },
            Self::Dark => Theme {
                dark: true,
                paper: Colour::hex(0x0f141a),
                floor: Colour::hex(0x171d25),
                ink: Colour::hex(0xe8ecf1),
                quiet: Colour::hex(0x9aa6b4),
                faint: Colour::hex(0x2b343f),
                wall: Colour::hex(0xa9b4c1),
                fixed: Colour::hex(0x66717f),
                flash: Colour::hex(0xff6b81),
                energy: [Colour::hex(0x3d9ddb), Colour::hex(0x8fd0f5), Colour::hex(0xf0a918)],
                arrows: [Colour::hex(0xe8ecf1), Colour::hex(0x1fb78c), Colour::hex(0xff6b81)],
                palette: PALETTE_DARK,
            },
        }
    }
}

impl Theme {
    /// The colour of letters on this ground.
    pub fn letters_on(&self, ground: Colour) -> Colour {
        if ground.lightness() > 0.58 { Colour::hex(0x1b2430) } else { Colour::hex(0xffffff) }
    }
}
