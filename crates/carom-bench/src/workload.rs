//! What is measured, by name.

/// What makes a workload differ from equal, elastic balls in a periodic box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// Equal balls, e = 1, a periodic box.
    Equal,
    /// Radii 1 : 1.4, masses 1 : 100.
    Poly,
    /// e = 0.9.
    E09,
    /// Gravity, in a box with walls.
    Gravity,
    /// Perfectly rough: e = 1, e_t = 1 and as much friction as it takes, so that surfaces rebound along the contact as well and no energy
    /// is lost.
    Rough,
}

impl Variant {
    const ALL: [Self; 5] = [Self::Equal, Self::Poly, Self::E09, Self::Gravity, Self::Rough];

    /// The end of a name.
    fn suffix(self) -> &'static str {
        match self {
            Self::Equal => "",
            Self::Poly => "-poly",
            Self::E09 => "-e09",
            Self::Gravity => "-gravity",
            Self::Rough => "-rough",
        }
    }
}

/// A gas: of discs or spheres, at some fraction of the box, in some variant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Workload {
    /// 2 for discs, 3 for spheres.
    pub dim: usize,
    /// The part of the box that the balls fill.
    pub fraction: f64,
    /// What is unlike equal, elastic balls.
    pub variant: Variant,
}

/// The gases that have names; each also with `-poly`, `-e09`, `-gravity` or `-rough` behind it.
pub const NAMES: [(&str, usize, f64); 5] = [
    ("spheres-0.10", 3, 0.10),
    ("spheres-0.30", 3, 0.30),
    ("spheres-0.49", 3, 0.49),
    ("discs-0.30", 2, 0.30),
    ("discs-0.70", 2, 0.70),
];

impl Workload {
    /// The workload of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|w| w.name() == name)
    }

    /// Every workload: the plain ones first.
    pub fn all() -> impl Iterator<Item = Self> {
        Variant::ALL.into_iter().flat_map(|variant| NAMES.map(|(_, dim, fraction)| Self { dim, fraction, variant }))
    }

    /// Its name.
    pub fn name(&self) -> String {
        let plain = NAMES.iter().find(|n| n.1 == self.dim && n.2 == self.fraction).map_or("gas", |n| n.0);
        format!("{plain}{}", self.variant.suffix())
    }

    /// The compressibility factor p V / (N kT) that the equation of state gives, where one is good enough: Kolafa's for spheres,
    /// Henderson's for discs up to one half.
    pub fn expected_z(&self) -> Option<f64> {
        let phi = self.fraction;
        // Where balls may be does not depend on how they turn.
        if !matches!(self.variant, Variant::Equal | Variant::Rough) {
            return None;
        }
        if self.dim == 3 {
            let high = 2.0 / 3.0 * phi * phi * phi * (1.0 + phi);
            return Some((1.0 + phi + phi * phi - high) / ((1.0 - phi) * (1.0 - phi) * (1.0 - phi)));
        }
        (phi <= 0.5).then(|| 1.0 + 2.0 * phi * (1.0 - 7.0 * phi / 16.0) / ((1.0 - phi) * (1.0 - phi)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back() {
        let all: Vec<Workload> = Workload::all().collect();
        assert_eq!(all.len(), 25);
        for w in all {
            assert_eq!(Workload::named(&w.name()), Some(w));
        }
        assert_eq!(Workload::named("spheres-0.5"), None);
    }

    /// Kolafa's and Henderson's values as they are tabulated.
    #[test]
    fn equations_of_state() {
        for (name, z) in
            [("spheres-0.10", 1.52163), ("spheres-0.30", 3.98426), ("spheres-0.49", 12.1615), ("discs-0.30", 2.06378)]
        {
            let found = Workload::named(name).unwrap().expected_z().unwrap();
            assert!((found / z - 1.0).abs() < 1e-5, "{name}: {found} {z}");
        }
    }
}
