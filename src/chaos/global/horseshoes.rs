//! Horseshoes in components of which nothing else is decided. Lemma A13 of `docs/proofs/global.md#A13`.

use super::graph::Component;
use super::image::Space;
use crate::chaos::flights::is_positive;
use crate::chaos::guess::Guess;
use crate::chaos::horseshoe::{Horseshoe, bases};
use crate::chaos::quad::State;
use crate::chaos::seen::{AttractorOrbit, step};
use crate::chaos::trap::{Cell, Grid};
use crate::chaos::trials::ANY;
use crate::chaos::tube::side_of;
use crate::chaos::vector::GENERIC;
use crate::chaos::words::HSet;
use crate::watch::Watch;

/// The most boxes in whose middles floating-point orbits begin, the most impacts of each, and the number of all at which no more begin.
const MAX_SEEDS: usize = 8192;
const IMPACTS_PER_SEED: usize = 2000;
const MAX_IMPACTS: usize = 100_000;
/// Impacts of each after which it has come to where motions stay.
const TRANSIENT: usize = 4;
/// H-sets have phases, in forcing periods, from -1 to 2.
const PHASE_RANGE: std::ops::RangeInclusive<i64> = -2..=2;

/// Proves a horseshoe whose motions end in this component, not in another one, by words of at most `depth` impacts. `None` where no horseshoe is
/// proved. Lemma A13
pub(super) fn within(
    space: &Space,
    component: &Component,
    others: &[&Component],
    depth: usize,
    watch: &dyn Watch,
) -> Option<Horseshoe> {
    let seen = staying(&Guess::new(space.law()), component)?;
    let found = bases(&seen, space.law(), depth, ANY, watch);
    let horseshoe = Horseshoe::of(space.law(), found, depth, watch)?;
    others.iter().all(|other| is_apart(other, &horseshoe.bases)).then_some(horseshoe)
}

/// The floating-point orbits from a component's boxes, as long as they are near these; `None` where they leave at once.
fn staying(guess: &Guess, component: &Component) -> Option<AttractorOrbit> {
    let mut points: Vec<(State, State)> = Vec::new();
    let mut sum = 0.0;
    let every = component.cells.len().div_ceil(MAX_SEEDS).max(1); // proposes: where h-sets are looked for
    for &cell in component.cells.iter().step_by(every) {
        let (mut state, mut direction) = (component.grid.quad(cell).centre, GENERIC);
        for k in 0..IMPACTS_PER_SEED {
            let Some(growth) = step(guess, &mut state, &mut direction) else { break };
            if !component.is_near(state) {
                break;
            }
            if k >= TRANSIENT {
                points.push((state, direction));
                sum += growth.ln();
            }
        }
        if points.len() >= MAX_IMPACTS {
            break;
        }
    }
    let exponent = sum / points.len() as f64; // proposes: where h-sets are looked for
    (!points.is_empty()).then_some(AttractorOrbit { points, exponent })
}

/// Whether no box of a component meets an h-set, modulo whole forcing periods. Lemma A13
fn is_apart(component: &Component, bases: &[HSet]) -> bool {
    let Grid { columns, rows } = component.grid;
    let meets = |base: &HSet, (column, row): Cell| {
        let round = [base.left.bottom, base.right.bottom, base.right.top, base.left.top];
        PHASE_RANGE.clone().any(|periods| {
            let column = i64::from(column) + periods * columns;
            let at = |i: i64, j: i32| [(column + i) as f64 / columns as f64, f64::from(row + j) / rows]; // exact: powers of two
            let corners = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
            let is_beside = |i: usize| {
                let (low, high) = (corners[0][i], corners[2][i]);
                round.iter().all(|state| state[i] < low) || round.iter().all(|state| state[i] > high) // A13: strictly beside it
            };
            let is_beyond = |k: usize| {
                let beyond = |&corner: &State| is_positive(-side_of(round[k], round[(k + 1) % 4], corner, 0.0));
                corners.iter().all(beyond)
            };
            !((0..2).any(is_beside) || (0..4).any(is_beyond))
        })
    };
    !component.cells.iter().any(|&cell| bases.iter().any(|base| meets(base, cell)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An h-set about the middle of the boxes of the fourth column, and one that reaches over the end of a forcing period.
    #[test]
    fn a13_a_box_meets_an_h_set_or_is_apart_from_it() {
        let of = |cells: &[Cell]| Component {
            grid: Grid { columns: 8, rows: 8.0 },
            cells: cells.to_vec(),
            has_release: false,
            is_closed: false,
        };
        let base = |phase: f64| HSet::new([phase, 0.5625], [0.05, 0.01], [-0.01, 0.05]);
        assert!(!is_apart(&of(&[(3, 4)]), &[base(0.4375)]));
        assert!(!is_apart(&of(&[(3, 4)]), &[base(1.4375)]) && !is_apart(&of(&[(3, 4)]), &[base(-0.5625)]));
        assert!(is_apart(&of(&[(3, 3), (3, 5), (2, 4), (4, 4)]), &[base(0.4375)]));
        assert!(!is_apart(&of(&[(7, 4)]), &[base(1.0)]) && !is_apart(&of(&[(0, 4)]), &[base(1.0)]));
        // The box is within the hull of the h-set, but beyond its edge.
        let slanted = HSet::new([0.5, 0.5], [0.2, 0.2], [-0.02, 0.02]);
        assert!(is_apart(&of(&[(3, 5)]), &[slanted]) && !is_apart(&of(&[(3, 3)]), &[slanted]));
    }
}
