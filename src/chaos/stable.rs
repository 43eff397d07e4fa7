//! Stable periodic orbits for all values of a parameter, whatever becomes of the scene's own orbit: Lemma D15 of
//! `docs/proofs/chaos.md#D15`, with sets that begin where a floating-point orbit has settled.

use super::attracted::attracted;
use super::guess::Guess;
use super::law::Law;
use super::quad::State;
use super::scene::Visited;
use super::seen::apart;
use crate::mapping::Word;
use crate::number::Ball;
use crate::pair::Wall;
use crate::watch::Watch;

/// Impacts after which a floating-point orbit is looked at, the most after which it comes again, and how near it has to.
const TRANSIENT: usize = 20_000;
const LONGEST: usize = 128;
const CLOSED: f64 = 1e-7;

/// Returns the word of a stable periodic orbit that each pair of a law has, and how many cycles it takes, near the one that the orbit of a state
/// settles on in floating point; `None` where none is proved. Lemma D15
pub(super) fn stable(law: &Law, start: State, watch: &dyn Watch) -> Option<(Word, u32)> {
    let [phase, speed] = settled(&Guess::new(law), start)?.map(Ball::exact);
    attracted(law, &Visited { index: 1, wall: Wall::Left, phase, speed }, watch)
}

/// The state of the floating-point orbit, if it comes to one that it has again.
fn settled(guess: &Guess, start: State) -> Option<State> {
    // proposes: where sets begin
    let next = |state: State| Some(guess.map(state)?.state).map(|[phase, speed]| [phase.rem_euclid(1.0), speed]);
    let first = (0..TRANSIENT).try_fold(start, |state, _| next(state))?;
    let mut state = first;
    for _ in 0..LONGEST {
        state = next(state)?;
        if apart(state, first) < CLOSED {
            return Some(first);
        }
    }
    None
}
