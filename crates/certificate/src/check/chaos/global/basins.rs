//! Parts of the state space whose motions end in one attractor (Lemma V27).

use std::collections::{BTreeSet, HashMap};

use super::graph::{Component, Set, Split};
use crate::check::contact::Doubt;
use num_rational::BigRational;

/// A component that is proved to be one of those claimed, by its place.
pub(super) type Known = (usize, Set);

/// Lower bounds of areas, of phases in forcing periods times speeds, by the claims that motions may end in.
pub(super) struct Areas(HashMap<BTreeSet<usize>, f64>);

impl Areas {
    /// Returns the areas of a set of all states, by what is known of all components. Lemma A11
    pub fn of(set: &Set, split: &Split, known: &[Known]) -> Self {
        let held = held(&split.components, known);
        let claims = |places: &[usize]| places.iter().flat_map(|&place| held[place].iter().copied()).collect();
        let mut areas = Self(HashMap::new());
        for (ends, &boxes) in &split.passed {
            areas.add(claims(&ends.components), set.grid.size() * boxes as f64); // exact: a multiple of a power of two
        }
        for own in &split.components {
            areas.add(claims(&own.ends.components), set.grid.size() * own.set.cells.len() as f64); // exact: a multiple of a power of two
        }
        areas
    }

    fn add(&mut self, claims: BTreeSet<usize>, area: f64) {
        let sum = self.0.entry(claims).or_insert(0.0);
        *sum = if *sum == 0.0 { area } else { (*sum + area).next_down() }; // V27: rounded down
    }

    /// Judges the areas of basins, each of a claim, as parts of a state space with this greatest speed.
    pub fn judge(&self, basins: &[(usize, BigRational)], fastest: f64) -> Result<(), Doubt> {
        let whole = BigRational::from_integer(1.into());
        let proved = |claim: usize| {
            let own = BTreeSet::from([claim]);
            if self.0.keys().all(|claims| *claims == own) {
                return whole.clone();
            }
            let area = self.0.get(&own).copied().unwrap_or(0.0); // V27: nothing is proved
            BigRational::from_float((area / fastest).next_down().max(0.0)).unwrap_or_default() // V27: rounded down, no area is negative
        };
        for (claim, area) in basins {
            let others = basins.iter().filter(|(other, _)| other != claim).map(|(other, _)| proved(*other));
            if area + others.sum::<BigRational>() > whole {
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

/// The claims that motions that stay in each component may be in: those whose boxes meet its own. Lemma A11
fn held(components: &[Component], known: &[Known]) -> Vec<BTreeSet<usize>> {
    let mut held = vec![BTreeSet::new(); components.len()];
    let Some(grid) = components.first().map(|own| own.set.grid) else { return held };
    let mut place_of = HashMap::new();
    for (place, own) in components.iter().enumerate() {
        place_of.extend(own.set.cells.iter().map(|&cell| (cell, place)));
    }
    let columns = grid.columns as i64; // exact: a power of two
    for (claim, set) in known {
        let scale = [grid.columns / set.grid.columns, grid.rows / set.grid.rows];
        for cell in &set.cells {
            let met = |axis: usize| {
                let [low, high] = [cell[axis], cell[axis] + 1].map(|at| at as f64 * scale[axis]); // exact: powers of two
                low.ceil() as i64 - 1..=high.floor() as i64 // V27: those with an edge in common are among them
            };
            for column in met(0) {
                for row in met(1) {
                    if let Some(&place) = place_of.get(&[column.rem_euclid(columns), row]) {
                        held[place].insert(*claim);
                    }
                }
            }
        }
        let with_release = (0..components.len()).filter(|&place| set.has_release && components[place].set.has_release);
        with_release.for_each(|place| _ = held[place].insert(*claim));
    }
    held
}
