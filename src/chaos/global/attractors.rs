//! Attracting cycles in components of which nothing else is decided. Lemma A14 of `docs/proofs/global.md#A14`.

use super::cycle::{Limit, closed};
use super::graph::Component;
use super::image::Space;
use super::known::LimitCycle;
use crate::chaos::guess::Guess;
use crate::chaos::stable::settled_orbits;
use crate::pair::ImpactPair;
use crate::periodic::{Precision, Stability};

/// Half sides of the rectangles about the states of a cycle, in forcing periods and over `A W`: each is tried.
const ROOMS: [f64; 2] = [1e-3, 1e-6];
/// Of wider intervals of `D` and `e` none are looked for.
const NARROW: f64 = 1e-6;

/// A rectangle of states: bounds of phases, not farther than a forcing period from those of a period, and of speeds.
type Hull = [[f64; 2]; 2];

/// Returns the attracting cycles that are proved to be in components that are open, each with the place of its component. Lemma A14
pub(super) fn within(
    pair: &ImpactPair,
    space: &Space,
    components: &[&Component],
    is_open: &[bool],
    precision: Precision,
) -> Vec<(usize, Box<LimitCycle>)> {
    let law = space.law();
    let wide = law.gap.rad().max(law.restitution.rad()); // proposes: where cycles are looked for
    if wide > NARROW {
        return Vec::new(); // exact: given up, nothing is certified
    }
    let guess = Guess::new(law);
    let (mut found, mut taken): (Vec<_>, Vec<Hull>) = (Vec::new(), Vec::new());
    for cycle in settled_orbits(law) {
        let Some(states) = closed(&guess, cycle[0], cycle.len()) else { continue };
        let proved = ROOMS.into_iter().find_map(|room| {
            let hulls: Vec<Hull> = states.iter().map(|state| state.map(|x| [x - room, x + room])).collect(); // A14: any rectangles
            let place = place(components, &hulls).filter(|&place| is_open[place] && are_apart(&taken, &hulls))?;
            let sides = states.iter().map(|&state| Some(guess.map(state)?.side)).collect::<Option<_>>()?;
            let limit = Limit { states: states.clone(), sides, hulls, attracts: true };
            let own = LimitCycle::of(pair, law, &limit, precision)?;
            // A14: where it closes after two rounds, they are one under the reduced map
            let is_round = own.orbit.impacts.len() == states.len() || own.orbit.symmetric == Some(true);
            (is_round && own.orbit.stability == Stability::Stable).then_some((place, own, limit.hulls))
        });
        if let Some((place, limit, hulls)) = proved {
            found.push((place, limit));
            taken.extend(hulls);
        }
    }
    found
}

/// The place of the one component that has boxes which meet some rectangles; `None` where there are more, or none.
fn place(components: &[&Component], hulls: &[Hull]) -> Option<usize> {
    let meets = |component: &Component| {
        let [columns, rows] = [component.grid.columns as f64, component.grid.rows]; // exact: powers of two
        component.cells.iter().any(|&(column, row)| {
            let side = |at: i32, of: f64| [f64::from(at) / of, f64::from(at + 1) / of]; // exact: powers of two
            let own = [side(column, columns), side(row, rows)];
            !hulls.iter().all(|hull| is_apart(hull, &own))
        })
    };
    let mut met = (0..components.len()).filter(|&place| meets(components[place]));
    met.next().filter(|_| met.next().is_none())
}

/// Whether some rectangles are apart from one another, and from those that are taken.
fn are_apart(taken: &[Hull], own: &[Hull]) -> bool {
    (0..own.len()).all(|i| taken.iter().chain(&own[..i]).all(|other| is_apart(other, &own[i])))
}

/// Whether two rectangles have no state in common, modulo whole forcing periods. Lemma A14
fn is_apart([phases, speeds]: &Hull, [others, their_speeds]: &Hull) -> bool {
    let are_beside = |[low, high]: [f64; 2], other: &[f64; 2]| low > other[1] || high < other[0];
    are_beside(*speeds, their_speeds)
        || [-2.0, -1.0, 0.0, 1.0, 2.0].into_iter().all(|periods| {
            let [low, high] = phases.map(|phase| phase + periods);
            are_beside([low.next_down(), high.next_up()], others) // A14: sums are rounded
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chaos::trap::Grid;

    /// Rectangles beside one another, across the end of a forcing period too, and boxes that share an edge with one.
    #[test]
    fn a14_rectangles_are_apart_modulo_forcing_periods() {
        let hull = |phase: f64, speed: f64| [[phase - 0.01, phase + 0.01], [speed - 0.01, speed + 0.01]];
        assert!(is_apart(&hull(0.3, 1.0), &hull(0.33, 1.0)) && is_apart(&hull(0.3, 1.0), &hull(0.3, 1.03)));
        assert!(!is_apart(&hull(0.3, 1.0), &hull(0.31, 1.01)));
        assert!(!is_apart(&hull(0.0, 1.0), &hull(0.99, 1.0)) && !is_apart(&hull(0.99, 1.0), &hull(0.0, 1.0)));
        assert!(are_apart(&[hull(0.1, 1.0)], &[hull(0.2, 1.0), hull(0.3, 1.0)]));
        assert!(!are_apart(&[hull(0.2, 1.0)], &[hull(0.2, 1.0)]) && !are_apart(&[], &[hull(0.3, 1.0), hull(0.3, 1.0)]));
        let of = |cells: &[(i32, i32)]| Component {
            grid: Grid { columns: 8, rows: 8.0 },
            cells: cells.to_vec(),
            has_release: false,
            is_closed: false,
        };
        let [one, beside, other] = [of(&[(3, 4), (5, 5)]), of(&[(4, 4)]), of(&[(0, 0)])];
        let at = [[[0.45, 0.5], [0.55, 0.56]]];
        assert_eq!(place(&[&other, &one], &at), Some(1));
        assert_eq!(place(&[&one, &beside], &at), None);
        assert_eq!(place(&[&other], &at), None);
        assert_eq!(place(&[&other], &[[[0.99, 1.01], [0.05, 0.06]]]), Some(0));
    }
}
