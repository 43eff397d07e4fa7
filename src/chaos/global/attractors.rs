//! Attracting cycles in components of which nothing else is decided. Lemma A14 of `docs/proofs/global.md#A14`.

use super::cycle::{Limit, closed};
use super::graph::Component;
use super::image::Space;
use super::known::LimitCycle;
use crate::chaos::guess::Guess;
use crate::chaos::law::Law;
use crate::chaos::quad::State;
use crate::chaos::stable::settled_orbits;
use crate::pair::ImpactPair;
use crate::periodic::{PeriodicOrbit, Precision, Stability};

/// Half sides of the rectangles about the states of a cycle, in forcing periods and over `A W`: each is tried.
const HALF_SIDES: [f64; 2] = [1e-3, 1e-6];
/// The widest intervals of `D` and `e` over which cycles are looked for.
const MAX_DATA_WIDTH: f64 = 1e-6;

/// A rectangle of states: bounds of phases, not farther than a forcing period from those of a period, and of speeds.
type Hull = [[f64; 2]; 2];

/// Proves attracting cycles in the open components, each with the place of its component. Lemma A14
pub(super) fn within(
    pair: &ImpactPair,
    space: &Space,
    components: &[&Component],
    is_open: &[bool],
    precision: Precision,
) -> Vec<(usize, Box<LimitCycle>)> {
    let law = space.law();
    let wide = law.gap.rad().max(law.restitution.rad()); // proposes: where cycles are looked for
    if wide > MAX_DATA_WIDTH {
        return Vec::new(); // exact: given up, nothing is certified
    }
    among(&settled_orbits(law), (pair, law), components, is_open, precision)
}

/// Proves the attracting cycles among these approximate cycles, each with the place of its component.
fn among(
    cycles: &[Vec<State>],
    (pair, law): (&ImpactPair, &Law),
    components: &[&Component],
    is_open: &[bool],
    precision: Precision,
) -> Vec<(usize, Box<LimitCycle>)> {
    let guess = Guess::new(law);
    let (mut found, mut taken): (Vec<_>, Vec<Hull>) = (Vec::new(), Vec::new());
    for cycle in cycles {
        let Some(states) = closed(&guess, cycle[0], cycle.len()) else { continue };
        let proved = HALF_SIDES.into_iter().find_map(|room| {
            let hulls: Vec<Hull> = states.iter().map(|state| state.map(|x| [x - room, x + room])).collect(); // A14: any rectangles
            let place = place(components, &hulls).filter(|&place| is_open[place] && are_apart(&taken, &hulls))?;
            let sides = states.iter().map(|&state| Some(guess.map(state)?.side)).collect::<Option<_>>()?;
            let limit = Limit { states: states.clone(), sides, hulls, attracts: true };
            let own = LimitCycle::of(pair, law, &limit, precision)?;
            attracts_after(&own.orbit, states.len()).then_some((place, own, limit.hulls))
        });
        if let Some((place, limit, hulls)) = proved {
            found.push((place, limit));
            taken.extend(hulls);
        }
    }
    found
}

/// Whether an orbit is stable, and closes after `impacts` impacts of the reduced map. Lemma A14
fn attracts_after(orbit: &PeriodicOrbit, impacts: usize) -> bool {
    // A14: where it closes after two rounds, they are one under the reduced map
    let is_round = orbit.impacts.len() == impacts || orbit.symmetric == Some(true);
    is_round && orbit.stability == Stability::Stable
}

/// Index of the only component with boxes that meet one of the rectangles; `None` where there are several, or none.
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

/// Whether rectangles have no state in common with one another, nor with those that are taken.
fn are_apart(taken: &[Hull], own: &[Hull]) -> bool {
    (0..own.len()).all(|i| taken.iter().chain(&own[..i]).all(|other| is_apart(other, &own[i])))
}

/// Whether two rectangles have no state in common, modulo whole forcing periods. Lemma A14
fn is_apart([phases, speeds]: &Hull, [others, their_speeds]: &Hull) -> bool {
    let are_beside = |[low, high]: [f64; 2], other: &[f64; 2]| low > other[1] || high < other[0];
    are_beside(*speeds, their_speeds)
        || [-2.0, -1.0, 0.0, 1.0, 2.0].into_iter().all(|periods| {
            let [low, high] = phases.map(|phase| phase + periods);
            are_beside([low, high], others) // A14: rounding to nearest keeps the order of a sum and a double
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chaos::global::known::is_motion_in_turn;
    use crate::chaos::trap::Grid;

    const GRID: Grid = Grid { columns: 64, rows: 16.0 };

    fn component(cells: Vec<(i32, i32)>) -> Component {
        Component { grid: GRID, cells, has_release: false, is_closed: false }
    }

    /// Beyond its pitchfork the equispaced motion (66)-(69) of `A/d = 0.45`, `e = 1/2` is a saddle; what is stable has two states of the reduced map,
    /// that of an orbit of two impacts and its mirror image.
    fn beyond_the_pitchfork() -> (ImpactPair, Law, Vec<State>) {
        let pair = crate::tests::pair("0.45", "0.5");
        let law = Law::of(&pair).unwrap();
        // Other orbits settle at a rest.
        let cycle = settled_orbits(&law).into_iter().find(|states| states.iter().all(|[_, speed]| *speed > 0.1));
        (pair, law, cycle.unwrap())
    }

    #[test]
    fn a14_a_stable_cycle_is_listed_once_with_its_open_component() {
        let (pair, law, own) = beyond_the_pitchfork();
        let mut cells: Vec<_> = own.iter().map(|[phase, speed]| GRID.cell(*phase, *speed)).collect();
        cells.sort_unstable();
        let [at, elsewhere] = [component(cells), component(vec![(0, 0), (1, 0)])];
        let found = |cycles: &[&[State]], components: &[&Component], is_open: [bool; 2]| -> Vec<usize> {
            let cycles: Vec<_> = cycles.iter().map(|cycle| cycle.to_vec()).collect();
            let all = among(&cycles, (&pair, &law), components, &is_open, Precision::default());
            all.into_iter().map(|(place, limit)| (limit.impacts == 2).then_some(place).unwrap()).collect()
        };
        let both = [&elsewhere, &at];
        assert_eq!(found(&[&own], &both, [true; 2]), [1]);
        let later = [own[1], own[0]];
        assert_eq!(found(&[&own, &own, &later], &both, [true; 2]), [1]);
        assert!(found(&[&own], &both, [true, false]).is_empty(), "what is decided has attractors of its own");
        assert!(found(&[&own], &[&at, &at], [true; 2]).is_empty(), "it is in one of them");
        assert!(found(&[&own.repeat(2)], &both, [true; 2]).is_empty(), "two rounds are no period");
        assert_eq!(closed(&Guess::new(&law), own[0], 4), None);
        let kappa = 3.0 * std::f64::consts::PI;
        let angle = 2_f64.atan2(kappa) - (1.0 / 0.45 / 2_f64.hypot(kappa)).acos();
        let saddle = [angle / std::f64::consts::TAU + 1.0, 4.0 * angle.cos()];
        let all = component((0..64).flat_map(|column| (0..64).map(move |row| (column, row))).collect());
        assert_eq!(closed(&Guess::new(&law), saddle, 1).map(|states| states.len()), Some(1));
        assert!(found(&[&[saddle]], &[&all], [true; 2]).is_empty(), "the saddle attracts nothing");
    }

    /// Two rounds are one where the orbit is proved to be its own mirror image; one that may have an earlier contact is no motion.
    #[test]
    fn a14_what_is_left_open_of_an_orbit_is_not_taken_for_proved() {
        let (pair, law, own) = beyond_the_pitchfork();
        let hulls: Vec<Hull> = own.iter().map(|state| state.map(|x| [x - 1e-3, x + 1e-3])).collect();
        let sides = own.iter().map(|&state| Guess::new(&law).map(state).unwrap().side).collect();
        let limit = Limit { states: own, sides, hulls: hulls.clone(), attracts: true };
        let orbit = LimitCycle::of(&pair, &law, &limit, Precision::default()).unwrap().orbit;
        assert!(orbit.impacts.len() == 2 && attracts_after(&orbit, 2) && !attracts_after(&orbit, 1));
        let with = |change: &dyn Fn(&mut PeriodicOrbit)| {
            let mut other = orbit.clone();
            change(&mut other);
            other
        };
        for (symmetric, is_round) in [(Some(true), true), (Some(false), false), (None, false)] {
            assert_eq!(attracts_after(&with(&|own| own.symmetric = symmetric), 1), is_round, "{symmetric:?}");
        }
        assert!(!attracts_after(&with(&|own| own.stability = Stability::Unstable), 2));
        for (physical, is_motion) in [(Some(true), true), (Some(false), false), (None, false)] {
            let found = is_motion_in_turn(&with(&|own| own.physical = physical), &law, &hulls);
            assert_eq!(found, is_motion, "{physical:?}");
        }
    }

    /// A cycle that is proved elsewhere than in the rectangles is not one in them.
    #[test]
    fn a14_a_cycle_is_in_its_rectangles() {
        let (pair, law, own) = beyond_the_pitchfork();
        let guess = Guess::new(&law);
        let states = closed(&guess, own[0], 2).unwrap();
        let is_within = |phases: [f64; 2], speeds: [f64; 2]| {
            let hulls =
                states.iter().map(|[u, w]| [phases.map(|away| u + away), speeds.map(|away| w + away)]).collect();
            let sides = states.iter().map(|&state| guess.map(state).unwrap().side).collect();
            let limit = Limit { states: states.clone(), sides, hulls, attracts: true };
            LimitCycle::of(&pair, &law, &limit, Precision::default()).is_some()
        };
        let about = |middle: f64| [middle - 1e-3, middle + 1e-3];
        assert!(is_within(about(0.0), about(0.0)) && is_within(about(1.0), about(0.0)));
        assert!(!is_within(about(0.01), about(0.0)) && !is_within(about(0.0), about(0.01)));
        // Rectangles that end within the bounds of the impacts may not hold them.
        for end in [[-1e-3, 0.0], [0.0, 1e-3]] {
            assert!(!is_within(end, about(0.0)) && !is_within(about(0.0), end));
        }
    }

    /// Rectangles beside one another, across the end of a forcing period too, and boxes that share an edge with one.
    #[test]
    fn a14_rectangles_are_apart_modulo_forcing_periods() {
        let hull = |phase: f64, speed: f64| [[phase - 0.01, phase + 0.01], [speed - 0.01, speed + 0.01]];
        assert!(is_apart(&hull(0.3, 1.0), &hull(0.33, 1.0)) && is_apart(&hull(0.3, 1.0), &hull(0.3, 1.03)));
        assert!(!is_apart(&hull(0.3, 1.0), &hull(0.31, 1.01)));
        assert!(!is_apart(&hull(0.0, 1.0), &hull(0.99, 1.0)) && !is_apart(&hull(0.99, 1.0), &hull(0.0, 1.0)));
        assert!(!is_apart(&hull(0.0, 1.0), &hull(2.01, 1.0)) && !is_apart(&hull(2.0, 1.0), &hull(0.01, 1.0)));
        let [lower, upper] = [[[0.25, 0.5], [0.5, 1.0]], [[0.25, 0.5], [1.0, 1.5]]];
        let beside = [[0.5, 0.75], [0.5, 1.0]];
        assert!(!is_apart(&lower, &upper) && !is_apart(&lower, &beside), "they have an edge in common");
        assert!(are_apart(&[hull(0.1, 1.0)], &[hull(0.2, 1.0), hull(0.3, 1.0)]));
        assert!(!are_apart(&[hull(0.2, 1.0)], &[hull(0.2, 1.0)]) && !are_apart(&[], &[hull(0.3, 1.0), hull(0.3, 1.0)]));
        let of = |cells: &[(i32, i32)]| Component { grid: Grid { columns: 8, rows: 8.0 }, ..component(cells.to_vec()) };
        let [one, beside, other] = [of(&[(3, 4), (5, 5)]), of(&[(4, 4)]), of(&[(0, 0)])];
        let at = [[[0.45, 0.5], [0.55, 0.56]]];
        assert_eq!(place(&[&other, &one], &at), Some(1));
        assert_eq!(place(&[&one, &beside], &at), None);
        let elsewhere = [[0.01, 0.02], [0.05, 0.06]];
        assert_eq!(place(&[&one, &other], &[at[0], elsewhere]), None, "each rectangle may meet a component");
        assert_eq!(place(&[&other], &at), None);
        assert_eq!(place(&[&other], &[[[0.99, 1.01], [0.05, 0.06]]]), Some(0));
    }
}
