//! Which parts of the state space have motions that end in one attractor (Lemma V27).

use std::collections::HashMap;

use super::graph::{Set, Split};
use crate::check::contact::Doubt;
use num_rational::BigRational;

/// Of a set: the claims that its motions may end in, and areas by the claims that the motions of its boxes may end in.
#[derive(Clone, Debug, Default)]
pub(super) struct Cover {
    /// In order.
    claims: Vec<usize>,
    /// Lower bounds, of phases in forcing periods times speeds; by the claims, and whether motions may leave the set for others.
    areas: HashMap<(Vec<usize>, bool), f64>,
}

impl Cover {
    /// That of a component that is the one claimed.
    pub fn of(claim: usize, set: &Set) -> Self {
        let claims = vec![claim];
        let mut own = Self { claims: claims.clone(), areas: HashMap::new() };
        own.add(claims, !set.is_closed, set.grid.size() * set.cells.len() as f64); // exact: a multiple of a power of two
        own
    }

    /// That of a set by those of its components.
    pub fn joined(set: &Set, split: &Split, covers: &[Self]) -> Self {
        let of = |places: &mut dyn Iterator<Item = usize>| united(places.flat_map(|place| &covers[place].claims));
        let mut all = Self { claims: of(&mut (0..covers.len())), areas: HashMap::new() };
        for (ends, &boxes) in &split.passed {
            let claims = of(&mut ends.components.iter().copied());
            all.add(claims, ends.leaves, set.grid.size() * boxes as f64); // exact: a multiple of a power of two
        }
        for (place, (component, cover)) in split.components.iter().zip(covers).enumerate() {
            let ends = &component.ends;
            let beyond = of(&mut ends.components.iter().copied().filter(|&other| other != place));
            for ((claims, leaves), &area) in &cover.areas {
                // V27: nothing leaves a closed component for good
                let may_leave = *leaves && !component.set.is_closed;
                let claims = if may_leave { united(claims.iter().chain(&beyond)) } else { claims.clone() };
                all.add(claims, may_leave && ends.leaves, area);
            }
        }
        all
    }

    fn add(&mut self, claims: Vec<usize>, leaves: bool, area: f64) {
        let sum = self.areas.entry((claims, leaves)).or_insert(0.0);
        *sum = if *sum == 0.0 { area } else { (*sum + area).next_down() }; // V27: rounded down
    }

    /// Judges the areas of basins, each of a claim, as parts of a state space with this greatest speed.
    pub fn judge(&self, basins: &[(usize, BigRational)], fastest: f64) -> Result<(), Doubt> {
        let whole = BigRational::from_integer(1.into());
        let proved = |claim: usize| {
            let area = self.areas.get(&(vec![claim], false)).copied().unwrap_or(0.0); // V27: nothing is proved
            let is_all = self.areas.keys().all(|(claims, leaves)| claims == &[claim] && !leaves);
            let part = BigRational::from_float((area / fastest).next_down()).unwrap_or_default(); // V27: rounded down
            if is_all { whole.clone() } else { part }
        };
        for (claim, area) in basins {
            let others: BigRational =
                basins.iter().filter(|(other, _)| other != claim).map(|(other, _)| proved(*other)).sum();
            if area + others > whole {
                return Err(Doubt::False(format!(
                    "the basin of component {claim} is not so large: others fill the rest"
                )));
            }
            if *area > proved(*claim) {
                return Err(Doubt::Open(format!("the basin of component {claim} is not proved to be so large")));
            }
        }
        Ok(())
    }
}

fn united<'c>(claims: impl Iterator<Item = &'c usize>) -> Vec<usize> {
    let mut all: Vec<usize> = claims.copied().collect();
    all.sort_unstable();
    all.dedup();
    all
}
