//! All combinations of a sweep, each with its number: what a shard runs is what the whole sweep runs.
use crate::document::Document;
use crate::model::{Scene, Sweep};
use crate::node::Data;
use crate::problem::Problems;

impl Scene {
    /// How many runs the sweep has: the product of the numbers of values; 1 without a sweep.
    pub fn combinations(&self) -> usize {
        self.sweep.iter().map(|s| s.values.len()).product()
    }

    /// The values of the `index`-th combination, from 0, one for each line of the sweep: the last line changes fastest.
    pub fn combination(&self, index: usize) -> Vec<(&str, Data)> {
        let mut rest = index;
        let value = |sweep: &Sweep| {
            let n = sweep.values.len().max(1);
            let k = rest % n;
            rest /= n;
            sweep.values.get(k)
        };
        let mut values: Vec<_> = self.sweep.iter().rev().map(value).collect();
        values.reverse();
        self.sweep.iter().zip(values).filter_map(|(s, value)| Some((s.path.as_str(), value?))).collect()
    }
}

impl Document {
    /// This document with the values of the `index`-th combination of its scene's sweep, from 0, and the sweep taken out.
    pub fn combination(&self, scene: &Scene, index: usize) -> Result<Self, Problems> {
        let mut changed = self.clone();
        if let crate::node::Value::Table(entries) = &mut changed.root.value {
            entries.retain(|e| e.key != "sweep");
        }
        for (path, value) in scene.combination(index) {
            changed.set_data(path, &value)?;
        }
        Ok(changed)
    }
}
