//! A world's materials and its table of pairs.
use alloc::{vec, vec::Vec};

use crate::codec::{Codec, Hash, Reader, codec};

use super::{Coefficient, Coefficients, Law, Material, UNSAID, combine};

/// A material of a [`Materials`] table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MaterialId(pub(crate) u32);

impl Codec for MaterialId {
    fn layout(hash: &mut Hash) {
        u32::layout(hash);
    }
    fn write(&self, to: &mut Vec<u8>) {
        self.0.write(to);
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        u32::read(from).map(Self)
    }
}

/// A line of the table of pairs: what holds where two materials meet, whatever each of them says.
///
/// ```
/// use carom::{Material, material::{Law, Pair}};
/// let cushion = Pair::from(Material::new().restitution(0.85).friction(0.2)).law(Law::Stronge);
/// assert_eq!(cushion.law, Some(Law::Stronge));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pair {
    /// The coefficients; one that is left out is combined as usual.
    pub says: Material,
    /// The law of their impacts; left out it is the world's.
    pub law: Option<Law>,
}

codec!(Pair { says, law });

impl Pair {
    /// This line with a law of its own.
    pub fn law(self, law: Law) -> Self {
        Self { law: Some(law), ..self }
    }
}

impl From<Material> for Pair {
    fn from(says: Material) -> Self {
        Self { says, law: None }
    }
}

/// A world's materials and its table of pairs. Material 0 is the default: whatever names none has it.
#[derive(Clone, Debug)]
pub struct Materials {
    all: Vec<Material>,
    /// Whose lines of the pair table each material reads: its own, or those of the material that it is a variant of.
    base: Vec<MaterialId>,
    /// (first, second, what the pair says), first <= second, at most one line a pair.
    pairs: Vec<(MaterialId, MaterialId, Pair)>,
    /// The one answer for every impact, if no speed and no pair can change it: gases ask a billion times.
    constant: Option<Coefficients>,
}

codec!(Materials { all, base, pairs, constant });

impl Default for Materials {
    fn default() -> Self {
        Self {
            all: vec![Material::default()],
            base: vec![MaterialId::default()],
            pairs: Vec::new(),
            constant: Some(UNSAID),
        }
    }
}

impl Materials {
    /// Adds a material.
    pub fn add(&mut self, material: Material) -> MaterialId {
        let id = MaterialId(self.all.len() as u32);
        self.push(material, id)
    }

    /// A material that differs from `base` in what it says itself, and reads the lines of the pair table that `base` reads:
    /// a ball that says a coefficient of its own is still a ball of its material. Equal variants share their id.
    pub fn variant(&mut self, base: MaterialId, material: Material) -> MaterialId {
        let base = self.base.get(base.0 as usize).copied().unwrap_or(base);
        let known = self.all.iter().zip(&self.base).position(|(m, b)| *b == base && *m == material);
        match known {
            Some(k) => MaterialId(k as u32),
            None => self.push(material, base),
        }
    }

    fn push(&mut self, material: Material, base: MaterialId) -> MaterialId {
        self.all.push(material);
        self.base.push(base);
        self.refresh();
        MaterialId((self.all.len() - 1) as u32)
    }

    /// Replaces the material of whatever names none.
    pub fn set_default(&mut self, material: Material) {
        self.all[0] = material;
        self.refresh();
    }

    /// Sets the line of the pair table for two materials, whatever their order. A coefficient that the line leaves out is
    /// combined as usual.
    pub fn set_pair(&mut self, a: MaterialId, b: MaterialId, line: impl Into<Pair>) {
        let ((a, b), line) = (self.key(a, b), line.into());
        match self.pairs.iter_mut().find(|p| (p.0, p.1) == (a, b)) {
            Some(old) => old.2 = line,
            None => self.pairs.push((a, b, line)),
        }
        self.refresh();
    }

    /// The line of the pair table for two materials, if there is one.
    pub fn pair(&self, a: MaterialId, b: MaterialId) -> Option<&Pair> {
        if self.pairs.is_empty() {
            return None;
        }
        let (a, b) = self.key(a, b);
        self.pairs.iter().find(|p| (p.0, p.1) == (a, b)).map(|p| &p.2)
    }

    /// The law that two materials ask for in the pair table; `None` leaves it to the world.
    pub fn law(&self, a: MaterialId, b: MaterialId) -> Option<Law> {
        self.pair(a, b).and_then(|line| line.law)
    }

    /// Where the line of two materials stands: the materials that read it, in order.
    fn key(&self, a: MaterialId, b: MaterialId) -> (MaterialId, MaterialId) {
        let of = |id: MaterialId| self.base.get(id.0 as usize).copied().unwrap_or(id);
        let (a, b) = (of(a), of(b));
        if a <= b { (a, b) } else { (b, a) }
    }

    /// The material of this id, if there is one.
    pub fn get(&self, id: MaterialId) -> Option<&Material> {
        self.all.get(id.0 as usize)
    }

    /// What two surfaces say of an impact at these speeds (m/s).
    pub fn between(&self, a: MaterialId, b: MaterialId, approach: f64, slip: f64) -> Coefficients {
        if let Some(constant) = self.constant {
            return constant;
        }
        let mut combined = combine(&self.all[a.0 as usize], &self.all[b.0 as usize], approach, slip);
        if let Some(Pair { says, .. }) = self.pair(a, b) {
            if let Some(e) = &says.restitution {
                combined.restitution = e.at(approach);
            }
            if let Some(mu) = &says.friction {
                combined.friction = mu.at(slip);
            }
            combined.tangential = says.tangential.unwrap_or(combined.tangential);
            combined.rolling = says.rolling.unwrap_or(combined.rolling);
            combined.spinning = says.spinning.unwrap_or(combined.spinning);
        }
        combined
    }

    /// True if every material is valid, and variants and pairs are of materials that are there.
    pub(crate) fn is_sound(&self) -> bool {
        let known = |id: MaterialId| (id.0 as usize) < self.all.len();
        !self.all.is_empty()
            && self.all.iter().all(Material::is_valid)
            && self.base.len() == self.all.len()
            && self.base.iter().all(|&id| known(id))
            && self.pairs.iter().all(|(a, b, line)| a <= b && known(*b) && line.says.is_valid())
    }

    fn refresh(&mut self) {
        let steady = |m: &Material| {
            !matches!(m.restitution, Some(Coefficient::Curve(_))) && !matches!(m.friction, Some(Coefficient::Curve(_)))
        };
        self.constant = match &self.all[..] {
            [only] if self.pairs.is_empty() && steady(only) => Some(combine(only, only, 0.0, 0.0)),
            _ => None,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_the_table_wins() {
        let mut table = Materials::default();
        let ball = table.add(Material::new().restitution(0.9).friction(0.2));
        let cushion = table.add(Material::new().restitution(0.4));
        table.set_pair(cushion, ball, Material::new().restitution(0.85));
        let said = table.between(ball, cushion, 1.0, 0.0);
        assert_eq!((said.restitution, said.friction), (0.85, 0.2));
        assert_eq!(said, table.between(cushion, ball, 1.0, 0.0));
        assert_eq!(table.between(ball, ball, 1.0, 0.0).restitution, 0.9);
    }

    #[test]
    fn a_variant_reads_the_lines_of_its_material() {
        let mut table = Materials::default();
        let (ball, cushion) = (table.add(Material::new().restitution(0.9)), table.add(Material::new()));
        table.set_pair(ball, cushion, Pair::from(Material::new().friction(0.25)).law(Law::Newton));
        let own = table.variant(ball, Material::new().restitution(0.25));
        assert_eq!(own, table.variant(own, Material::new().restitution(0.25)), "equal variants are one");
        assert_ne!(own, table.variant(cushion, Material::new().restitution(0.25)));
        let said = table.between(cushion, own, 1.0, 0.0);
        assert_eq!((said.restitution, said.friction), (0.25, 0.25));
        assert_eq!((table.law(own, cushion), table.law(own, own)), (Some(Law::Newton), None));
        // A line said through the variant is the line of its material.
        table.set_pair(own, cushion, Material::new().restitution(0.5));
        assert_eq!(table.between(ball, cushion, 1.0, 0.0).restitution, 0.5);
        assert_eq!(table.law(ball, cushion), None);
    }

    #[test]
    fn what_lasts_combines_like_friction() {
        let mut table = Materials::default();
        let (felt, ball) =
            (table.add(Material::new().rolling(0.04)), table.add(Material::new().rolling(0.01).spinning(0.5)));
        let said = table.between(felt, ball, 1.0, 0.0);
        // sqrt(0.0004): the product and the root round once each, within 2 units in the last place.
        assert!((said.rolling - 0.02).abs() < 1e-17 && said.spinning == 0.5);
        table.set_pair(felt, ball, Material::new().spinning(0.125));
        assert_eq!(table.between(felt, ball, 1.0, 0.0).spinning, 0.125);
        assert!(!Material::new().rolling(-0.1).is_valid() && !Material::new().spinning(f64::NAN).is_valid());
    }
}
