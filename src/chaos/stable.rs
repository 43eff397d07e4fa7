//! Stable periodic orbits for all values of a parameter, whatever becomes of the scene's own orbit: Lemma D15 of
//! `docs/proofs/chaos.md#D15`, with sets that begin where a floating-point orbit has settled.

use super::attracted::attracted;
use super::cells::word_of_both;
use super::guess::Guess;
use super::law::Law;
use super::quad::State;
use super::scene::Visited;
use super::seen::apart;
use crate::Error;
use crate::mapping::Word;
use crate::number::Ball;
use crate::pair::{ImpactPair, Wall};
use crate::watch::Watch;

/// Impacts after which a floating-point orbit is looked at, the most after which it comes again, and how near it has to.
const TRANSIENT: usize = 20_000;
const LONGEST: usize = 128;
const CLOSED: f64 = 1e-7;
/// Orbits that are so near are one.
const NEAR: f64 = 1e-4;

/// Orbits of a pair begin at so many phases and speeds: the first half of those that motions have in the end, where attractors are.
const STARTS: [usize; 2] = [4, 3];

/// Returns the word of a stable periodic orbit that each pair of a law has, and how many cycles it takes, near the one that the orbit of a state
/// settles on in floating point; `None` where none is proved. Lemma D15
pub(super) fn stable(law: &Law, start: State, watch: &dyn Watch) -> Option<(Word, u32)> {
    around(law, settled(&Guess::new(law), start)?[0], watch)
}

/// Returns the words of stable periodic orbits that a pair has for all its parameters, in the alphabet of L and R, each that of the orbit or of
/// its mirror image that comes first, and how many cycles each takes: of those that floating-point orbits from several states settle on. Lemma D15
///
/// # Errors
/// With several harmonics, and when a value is beyond the range of flights.
pub fn stable_orbits(pair: &ImpactPair, watch: &dyn Watch) -> Result<Vec<(Word, u32)>, Error> {
    let law = Law::of(pair)?;
    let guess = Guess::new(&law);
    // proposes: where sets begin
    let fastest = 1.0 / (1.0 - law.restitution.mid());
    let (mut seen, mut found): (Vec<Vec<State>>, Vec<(Word, u32)>) = (Vec::new(), Vec::new());
    for start in 0..STARTS[0] * STARTS[1] {
        let at = |place: usize, of: usize| (place as f64 + 0.5) / of as f64;
        let [phase, speed] = [at(start % STARTS[0], STARTS[0]), at(start / STARTS[0], STARTS[1])];
        let Some(cycle) = settled(&guess, [phase, fastest * speed]) else { continue };
        if seen.iter().flatten().any(|&state| apart(state, cycle[0]) < NEAR) {
            continue;
        }
        if let Some((word, cycles)) = around(&law, cycle[0], watch) {
            let orbit = (word_of_both(&word), cycles);
            found.extend((!found.contains(&orbit)).then_some(orbit));
        }
        seen.push(cycle);
    }
    found.sort_by_key(|(word, cycles)| (word.mappings().len(), *cycles, word.to_string()));
    Ok(found)
}

/// The orbit that sets around a state are proved to be contracted to. Lemma D15
fn around(law: &Law, state: State, watch: &dyn Watch) -> Option<(Word, u32)> {
    let [phase, speed] = state.map(Ball::exact);
    attracted(law, &Visited { index: 1, wall: Wall::Left, phase, speed }, watch)
}

/// The states of the floating-point orbit, if it comes to one that it has again, from this one on.
fn settled(guess: &Guess, start: State) -> Option<Vec<State>> {
    // proposes: where sets begin
    let next = |state: State| Some(guess.map(state)?.state).map(|[phase, speed]| [phase.rem_euclid(1.0), speed]);
    let first = (0..TRANSIENT).try_fold(start, |state, _| next(state))?;
    let mut states = vec![first];
    for k in 0..LONGEST {
        let state = next(states[k])?;
        if apart(state, first) < CLOSED {
            return Some(states);
        }
        states.push(state);
    }
    None
}
