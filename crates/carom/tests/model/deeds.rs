//! What a user does to a world, as proptest draws it.
use proptest::prelude::*;

/// Numbers in [0, 1), that whoever uses them stretches.
pub type Unit = [f64; 3];

#[derive(Clone, Debug)]
pub enum Deed {
    Add {
        at: Unit,
        velocity: Unit,
        spin: Unit,
        mass: f64,
        radius: f64,
        kappa: f64,
        fixed: bool,
        says: Said,
    },
    Remove(usize),
    SetVelocity(usize, Unit),
    SetPosition(usize, Unit),
    SetSpin(usize, Unit),
    SetGravity(Unit),
    AddWall {
        at: Unit,
        to: Unit,
        velocity: Unit,
        thin: bool,
        says: Said,
    },
    RemoveWall(usize),
    SetWallVelocity(usize, Unit),
    Ignore(usize, usize, bool),
    SetLayers(usize, u32, u32),
    /// The world is made anew from its own bytes.
    Restore,
    Advance(f64),
}

/// What a surface says: which of the materials of the test, and a restitution of its own.
#[derive(Clone, Copy, Debug)]
pub struct Said {
    pub material: usize,
    pub restitution: Option<f64>,
}

fn unit() -> impl Strategy<Value = Unit> {
    [0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64]
}

fn says() -> impl Strategy<Value = Said> {
    let restitution = prop_oneof![2 => Just(None), 1 => (0.5..=1.0f64).prop_map(Some)];
    (any::<usize>(), restitution).prop_map(|(material, restitution)| Said { material, restitution })
}

fn add() -> impl Strategy<Value = Deed> {
    (unit(), unit(), unit(), (0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64), proptest::bool::weighted(0.15), says()).prop_map(
        |(at, velocity, spin, (mass, radius, kappa), fixed, says)| Deed::Add {
            at,
            velocity,
            spin,
            mass,
            radius,
            kappa,
            fixed,
            says,
        },
    )
}

fn deed() -> impl Strategy<Value = Deed> {
    let which = any::<usize>;
    prop_oneof![
        12 => (0.01..0.6f64).prop_map(Deed::Advance),
        3 => add(),
        1 => which().prop_map(Deed::Remove),
        2 => (which(), unit()).prop_map(|(k, v)| Deed::SetVelocity(k, v)),
        2 => (which(), unit()).prop_map(|(k, x)| Deed::SetPosition(k, x)),
        2 => (which(), unit()).prop_map(|(k, w)| Deed::SetSpin(k, w)),
        1 => unit().prop_map(Deed::SetGravity),
        2 => (unit(), unit(), unit(), any::<bool>(), says())
            .prop_map(|(at, to, velocity, thin, says)| Deed::AddWall { at, to, velocity, thin, says }),
        1 => which().prop_map(Deed::RemoveWall),
        3 => (which(), unit()).prop_map(|(k, v)| Deed::SetWallVelocity(k, v)),
        1 => (which(), which(), any::<bool>()).prop_map(|(a, b, on)| Deed::Ignore(a, b, on)),
        1 => (which(), 1..4u32, 1..4u32).prop_map(|(k, layers, meets)| Deed::SetLayers(k, layers, meets)),
        1 => Just(Deed::Restore),
    ]
}

/// A life: some bodies, then deeds.
pub fn life() -> impl Strategy<Value = Vec<Deed>> {
    (proptest::collection::vec(add(), 3..9), proptest::collection::vec(deed(), 10..60))
        .prop_map(|(first, then)| first.into_iter().chain(then).collect())
}
