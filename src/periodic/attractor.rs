//! The periodic orbit that a motion is proved to converge to, from its last impacts: Lemma Q3.

use super::krawczyk::is_inside;
use super::{Basin, Finding, PeriodicOrbit, Precision, Problem, Stability};
use crate::impact::Impact;
use crate::mapping::{Mapping, Word};
use crate::number::Ball;
use crate::watch::Watch;

/// A stable periodic orbit that a motion is proved to converge to.
#[derive(Clone, Debug, PartialEq)]
pub struct Attractor {
    /// The word of the period.
    pub word: Word,
    /// Number of forcing periods that it takes.
    pub cycles: u32,
    /// The orbit.
    pub orbit: PeriodicOrbit,
    /// The first impact examined whose states are proved to lie in a neighbourhood that the map of a period contracts.
    pub from: u64,
    /// Upper bound of the contraction rate of a period in that neighbourhood, in its norm.
    pub factor: f64,
}

/// The longest period that is looked for, in impacts.
pub(crate) const MAX_PERIOD: usize = 128;
/// Relative distances of states within which they make a guess, at the end and before it, and the number of guesses that are tried:
/// nothing rests on them.
const GUESS_DISTANCE: f64 = 0.02;
const EARLIER_GUESS_DISTANCE: f64 = 0.2;
const MAX_GUESSES: usize = 8;
/// Number of its impacts from which a period is tried: in doubles the contraction is seen from some and not from others.
const LAST_IMPACTS: usize = 32;
/// Distance of repeating states below which the orbit itself may be found from some of them only: in doubles the orbit of a narrow window
/// can hardly be distinguished from the unstable one beside it.
const REPEATING_DISTANCE: f64 = 1e-9;
/// Bits that its orbit is enclosed in at most, and digits that its basin is looked for with.
const BITS: u32 = 1024;
const FEW_DIGITS: u32 = 9;

/// A guess of the period of a motion: the impacts that may make it, with all before them and the one after, and the cycles.
struct Guess<'s> {
    all: &'s [Impact],
    impacts: usize,
    cycles: u32,
}

/// A bound of the trace of a stable orbit of a period that contracts areas.
const MOST_TRACE: f64 = 2.0;

/// The reason why an orbit is not proved to attract a motion.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Open {
    /// The ball has no such orbit, or it is unstable.
    Never,
    /// It may be proved from another impact of the period.
    Here,
}

/// The periods that the end of a motion nearly repeats after, the shortest first.
fn guesses(states: &[Impact]) -> impl Iterator<Item = Guess<'_>> {
    let count = states.len();
    // proposes
    (1..count.min(MAX_PERIOD + 1)).filter_map(move |period| {
        let (last, before) = (&states[count - 1], &states[count - 1 - period]);
        let is_near = last.apart(before).is_some_and(|apart| apart < GUESS_DISTANCE);
        // So does the period before it, as far as there is one: chaos that has only come near a state once does not.
        let earlier = states[..count - 1].iter().rev().zip(states[..count - 1 - period].iter().rev()).take(period);
        let repeats =
            |(now, then): (&Impact, &Impact)| now.apart(then).is_some_and(|apart| apart < EARLIER_GUESS_DISTANCE);
        let cycles = last.since(before).round(); // proposes
        (is_near && (1.0..=1e6).contains(&cycles) && earlier.clone().all(repeats))
            // proposes: at most 10^6
            .then_some(Guess { all: states, impacts: period, cycles: cycles as u32 })
    })
}

impl Impact {
    /// Forcing periods since another one.
    fn since(&self, before: &Self) -> f64 {
        (self.turns - before.turns) as f64 + (self.phase.mid() - before.phase.mid()) // proposes
    }

    /// Distance of two states on one wall: of the phases, in forcing periods less whole ones, plus that of the velocities relative to their sizes.
    fn apart(&self, before: &Self) -> Option<f64> {
        let since = self.since(before);
        let (now, then) = (self.velocity.mid(), before.velocity.mid());
        let apart = (now - then).abs() / (now.abs() + then.abs() + f64::MIN_POSITIVE);
        (self.wall == before.wall).then(|| (since - since.round()).abs() + apart) // proposes
    }
}

impl<'s> Guess<'s> {
    /// The same, from earlier impacts of the period on as well.
    fn ends(&self) -> impl Iterator<Item = Guess<'s>> {
        let Self { all, impacts, cycles } = *self;
        let earliest = impacts.min(all.len() - impacts); // proposes: a period before each
        let ends = (0..earliest).step_by(impacts.div_ceil(LAST_IMPACTS));
        ends.map(move |earlier| Guess { all: &all[..all.len() - earlier], impacts, cycles })
    }

    /// Returns whether the motion repeats as nearly as one that is settled.
    fn is_settled(&self) -> bool {
        let last = self.all.len() - 1;
        self.all[last].apart(&self.all[last - self.impacts]).is_some_and(|apart| apart < REPEATING_DISTANCE)
    }

    /// The impacts of the period.
    fn states(&self) -> &'s [Impact] {
        let last = self.all.len() - 1;
        &self.all[last - self.impacts..last]
    }

    /// The mappings from each of the impacts to the next.
    fn word(&self) -> Option<Word> {
        let next = self.states().iter().cycle().skip(1);
        let mappings = self.states().iter().zip(next).map(|(from, to)| Mapping::between(from.wall, to.wall));
        Word::new(mappings.collect()).ok()
    }

    /// Phases in forcing periods, from the forcing period on that began the common period of the first impact.
    fn phases(&self, period: i64) -> Vec<f64> {
        let first = self.states()[0].turns;
        let base = first - first.rem_euclid(period);
        self.states().iter().map(|state| (state.turns - base) as f64 + state.phase.mid()).collect() // proposes
    }
}

/// Recognises the attractor of a motion at its end and proves that the motion converges to it. Lemma Q3
///
/// `states` are certified states of the motion, in order of time, all of its impacts between the first and the last;
/// `problem` makes the problem of a word, for the same pair; the watch is consulted before each proof.
pub(crate) fn find(
    states: &[Impact],
    digits: u32,
    watch: &dyn Watch,
    mut problem: impl FnMut(&Word, u32) -> Option<Problem>,
) -> Option<Attractor> {
    // Under several harmonics not all cycles make a problem.
    let problems =
        guesses(states).filter(|guess| guess.word().is_some_and(|word| problem(&word, guess.cycles).is_some()));
    let tried: Vec<Guess<'_>> = problems.take(MAX_GUESSES).collect();
    tried.iter().find_map(|guess| {
        for end in guess.ends() {
            if !watch.goes_on() {
                return None;
            }
            let problem = problem(&end.word()?, end.cycles)?;
            match problem.attracts(&end.phases(problem.period().into()), end.all, digits) {
                Ok(attractor) => return Some(attractor),
                Err(Open::Never) if !end.is_settled() => return None,
                Err(_) => {}
            }
        }
        None
    })
}

impl Finding<Ball> {
    /// Returns whether the orbit is unstable or virtual, or likely to be one of the many unstable ones that chaos comes near.
    fn is_refused(&self) -> bool {
        // proposes: chaos near an orbit whose trace is beyond what a stable one has is not asked again
        let is_wild = self.stability == Stability::Undecided && self.trace.mid().abs() >= MOST_TRACE;
        matches!(self.stability, Stability::Unstable | Stability::Elliptic) || self.physical == Some(false) || is_wild
    }
}

/// Returns `Ok` if an orbit is proved to be stable, admissible, and run through once.
fn is_attracting(orbit: &PeriodicOrbit) -> Result<(), Open> {
    match (orbit.stability, orbit.physical, orbit.repeats) {
        (Stability::Stable, Some(true), Some(1)) => Ok(()),
        (Stability::Unstable | Stability::Elliptic, ..) | (_, Some(false), _) | (.., Some(2..)) => Err(Open::Never),
        _ => Err(Open::Here),
    }
}

impl Problem {
    /// Proves that the orbit near these phases is stable and attracts a motion from one of `states` on, the last at the
    /// latest.
    fn attracts(&self, guess: &[f64], states: &[Impact], digits: u32) -> Result<Attractor, Open> {
        let last = states.last().ok_or(Open::Never)?;
        if !self.chain().crosses() {
            return Err(Open::Never);
        }
        let guess = self.polished(guess).ok_or(Open::Never)?;
        // A guess that doubles refute is not tried in more bits.
        if self.prove_in_doubles(&guess).is_some_and(|finding| finding.is_refused()) {
            return Err(Open::Never);
        }
        let prove = |digits: u32| self.prove(&guess, Precision { digits, max_bits: BITS }).ok_or(Open::Never);
        let near = prove(digits.min(FEW_DIGITS))?; // proposes: how narrow a basin's centre is
        is_attracting(&near)?;
        let phase = |state: &Impact| self.in_period(state);
        let holds = |basin: &Basin, state: &Impact| basin.holds(state.wall, phase(state), state.velocity);
        let basin = self.basins(&near).find(|basin| holds(basin, last)).ok_or(Open::Here)?;
        let orbit = prove(digits)?;
        is_attracting(&orbit)?;
        if !is_inside(orbit.phases(), near.domain()) {
            return Err(Open::Never);
        }
        let from = states.iter().find(|state| holds(&basin, state)).ok_or(Open::Here)?.index;
        let (word, cycles) = (self.word().clone(), self.chain().cycles());
        Ok(Attractor { word, cycles, orbit, from, factor: basin.factor() })
    }

    /// The phase of a state less whole periods of the excitation.
    fn in_period(&self, state: &Impact) -> Ball {
        match i64::from(self.period()) {
            1 => state.phase,
            // N1: less than a period, of 32 bits
            period => state.phase + Ball::exact(state.turns.rem_euclid(period) as f64),
        }
    }
}
