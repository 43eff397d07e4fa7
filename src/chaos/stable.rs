//! Stable periodic orbits for all values of a parameter, whatever becomes of the scene's own orbit: Lemma D15 of
//! `docs/proofs/chaos.md#D15`, with sets that begin where a floating-point orbit has settled.

use super::attracted::{StablePeriod, attracted};
use super::guess::Guess;
use super::itinerary::word_of_both;
use super::law::Law;
use super::quad::State;
use super::scene::Visited;
use super::vector::apart;
use crate::Error;
use crate::mapping::Word;
use crate::number::Ball;
use crate::pair::{ImpactPair, Wall};
use crate::watch::Watch;

/// Impacts after which a floating-point orbit is looked at, the most after which it closes, and the distance within which it does.
const TRANSIENT: usize = 20_000;
const MAX_PERIOD: usize = 128;
const RETURN_DISTANCE: f64 = 1e-7;
/// Distance below which two orbits are taken for one.
const SAME_ORBIT_DISTANCE: f64 = 1e-4;

/// Numbers of phases and of speeds, up to half of the greatest one that motions have in the end, at which orbits of a pair begin.
const START_GRID: [usize; 2] = [4, 3];

/// Proves the period of a stable orbit of each pair of a law, near the orbit that `start` settles on in floating point. `None` where none is
/// proved. Lemma D15
pub(super) fn stable(law: &Law, start: State, watch: &dyn Watch) -> Option<StablePeriod> {
    if law.restitution.mid() >= 1.0 {
        return None; // exact: nothing is contracted without a loss of speed
    }
    around(law, settled(&Guess::new(law), start)?[0], watch)
}

/// Proves words and forcing periods of stable periodic orbits that a pair has for all its parameters, no two of one orbit. Candidates are the
/// orbits that floating-point orbits from several states settle on. Of the words of an orbit and its mirror image, the first in the alphabet of
/// L and R. Lemmas D15, A21
///
/// # Errors
/// With several harmonics, and when a value is beyond the range of flights.
pub fn stable_orbits(pair: &ImpactPair, watch: &dyn Watch) -> Result<Vec<(Word, u32)>, Error> {
    let law = Law::of(pair)?;
    let mut found: Vec<StablePeriod> = Vec::new();
    for cycle in settled_orbits(&law) {
        if let Some(own) = around(&law, cycle[0], watch) {
            found.push(StablePeriod { word: word_of_both(&own.word), ..own });
        }
    }
    Ok(distinct(found))
}

/// Words and forcing periods of orbits, the shortest first, without those that may be of an orbit that is listed. Lemma A21
fn distinct(mut periods: Vec<StablePeriod>) -> Vec<(Word, u32)> {
    periods.sort_by_key(|own| (own.word.mappings().len(), own.cycles, own.word.to_string(), !own.is_least));
    let mut found: Vec<(Word, u32)> = Vec::new();
    for StablePeriod { word, cycles, is_least } in periods {
        let may_be = |(other, its_cycles): &(Word, u32)| {
            let [own, others] = [&word, other].map(Word::mappings);
            own.repeat(others.len()) == others.repeat(own.len())
                && u64::from(cycles) * others.len() as u64 == u64::from(*its_cycles) * own.len() as u64 // exact: small counts
        };
        let is_new = |known: &(Word, u32)| !may_be(known) || is_least && known.0 != word;
        if found.iter().all(is_new) {
            found.push((word, cycles));
        }
    }
    found
}

/// Cycles that floating-point orbits from several states settle on, each once, as states.
pub(super) fn settled_orbits(law: &Law) -> Vec<Vec<State>> {
    let guess = Guess::new(law);
    let fastest = 1.0 / (1.0 - law.restitution.mid()); // proposes: where orbits begin
    let mut found: Vec<Vec<State>> = Vec::new();
    for start in 0..START_GRID[0] * START_GRID[1] {
        let at = |place: usize, of: usize| (place as f64 + 0.5) / of as f64; // proposes: where orbits begin
        let [phase, speed] = [at(start % START_GRID[0], START_GRID[0]), at(start / START_GRID[0], START_GRID[1])];
        let Some(cycle) = settled(&guess, [phase, fastest * speed]) else { continue };
        let is_new = !found.iter().flatten().any(|&state| apart(state, cycle[0]) < SAME_ORBIT_DISTANCE);
        found.extend(is_new.then_some(cycle));
    }
    found
}

/// Periodic orbit to which sets around a state are proved to contract. Lemma D15
fn around(law: &Law, state: State, watch: &dyn Watch) -> Option<StablePeriod> {
    let [phase, speed] = state.map(Ball::exact);
    attracted(law, &Visited { index: 1, wall: Wall::Left, phase, speed }, watch)
}

/// States of the floating-point cycle that the orbit from `start` settles on, if it closes.
fn settled(guess: &Guess, start: State) -> Option<Vec<State>> {
    // proposes: where sets begin
    let next = |state: State| Some(guess.map(state)?.state).map(|[phase, speed]| [phase.rem_euclid(1.0), speed]);
    let first = (0..TRANSIENT).try_fold(start, |state, _| next(state))?;
    let mut states = vec![first];
    for k in 0..MAX_PERIOD {
        let state = next(states[k])?;
        if apart(state, first) < RETURN_DISTANCE {
            return Some(states);
        }
        states.push(state);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::pair;
    use crate::watch::Unwatched;

    fn orbits([ratio, restitution]: [&str; 2]) -> Vec<(String, u32)> {
        let found = stable_orbits(&pair(ratio, restitution), &Unwatched).unwrap();
        found.into_iter().map(|(word, cycles)| (word.to_string(), cycles)).collect()
    }

    /// The equispaced motion of (66)-(69) between its fold and its pitchfork is stable, for all values of both parameters; where it is past the
    /// pitchfork it is not.
    #[test]
    fn a21_a_cell_has_the_stable_equispaced_motion() {
        let equispaced = ("P1 P2".to_owned(), 1);
        assert!(orbits(["[0.3, 0.3001]", "[0.5, 0.5001]"]).contains(&equispaced));
        assert!(!orbits(["0.6", "0.5"]).contains(&equispaced));
    }

    /// `P1 P2` in one forcing period run two or three times is that orbit again, unless that is proved to be the least period; in three forcing
    /// periods `P1 P2 P1 P2` is another orbit.
    #[test]
    fn a21_listed_words_are_of_different_orbits() {
        let period = |times: usize, cycles: u32, is_least: bool| {
            let word = vec!["P1 P2"; times].join(" ").parse::<Word>().unwrap();
            StablePeriod { word, cycles, is_least }
        };
        let kept = |periods: Vec<StablePeriod>| -> Vec<(usize, u32)> {
            distinct(periods).into_iter().map(|(word, cycles)| (word.mappings().len() / 2, cycles)).collect()
        };
        assert_eq!(kept(vec![period(3, 3, false), period(1, 1, false), period(2, 2, false)]), [(1, 1)]);
        assert_eq!(kept(vec![period(3, 3, true), period(1, 1, false), period(2, 2, false)]), [(1, 1), (3, 3)]);
        assert_eq!(kept(vec![period(3, 3, false), period(2, 2, false)]), [(2, 2)]);
        assert_eq!(kept(vec![period(2, 2, true), period(2, 2, false), period(2, 3, false)]), [(2, 2), (2, 3)]);
    }

    /// Two attractors beside one another, of reduced periods 1 and 3, and 2 and 6, as a search in floating point from a grid of starts found
    /// them; the other impacts of the latter ones are on the other wall or twice as many.
    #[test]
    fn a21_orbits_beside_one_another_are_found() {
        for (values, periods) in [(["0.257176", "0.868182"], [1, 3]), (["0.443933", "0.786364"], [2, 6])] {
            let found = orbits(values);
            let impacts: Vec<usize> = found.iter().map(|(word, _)| word.split(' ').count()).collect();
            let is_there = |period: &usize| impacts.contains(period) || impacts.contains(&(2 * period));
            assert!(periods.iter().all(is_there), "{values:?}: {found:?}");
        }
    }
}
