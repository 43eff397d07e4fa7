//! The periodic orbit that a motion is proved to converge to, from its last impacts: Lemma Q3.

use super::krawczyk::is_inside;
use super::{Basin, Finding, PeriodicOrbit, Precision, Problem, Stability};
use crate::impact::Impact;
use crate::mapping::{Mapping, Word};
use crate::number::Ball;
use crate::pair::Wall;
use crate::watch::Watch;

/// A stable periodic orbit that a motion is proved to converge to.
#[derive(Clone, Debug, PartialEq)]
pub struct Attractor {
    /// Word of the period, from the impact on that makes it the first word in the alphabet of L and R. Of several such impacts it begins
    /// with the earliest in its forcing period: all motions that converge to one orbit have one word.
    pub word: Word,
    /// Number of forcing periods of the orbit's period.
    pub cycles: u32,
    /// The orbit.
    pub orbit: PeriodicOrbit,
    /// Index of the first examined impact, of those that the word begins with, from which on the motion is proved to lie in a neighbourhood
    /// that the map of a period contracts.
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
/// Number of impacts of a period at which a neighbourhood is sought, or from which its orbit is: in doubles the contraction is seen from some and
/// not from others.
const LAST_IMPACTS: usize = 32;
/// Distance of repeating states below which the orbit itself may be found from some of them only: in doubles the orbit of a narrow window
/// can hardly be distinguished from the unstable one beside it.
const REPEATING_DISTANCE: f64 = 1e-9;
/// Bits that its orbit is enclosed in at most, and digits that its basin is looked for with.
const BITS: u32 = 1024;
const FEW_DIGITS: u32 = 9;

/// Work of a search in flights in doubles, for each impact of the motion and for any motion. Lemma Q5
const WORK_PER_IMPACT: u64 = 256;
const FREE_WORK: u64 = 1 << 19;
/// Work of the proof of an orbit in doubles, and in more bits, for each pair of its impacts: its preconditioner is dense. Measured on orbits of 35 to
/// 120 impacts: 1.5 to 2, and 100 to 300.
const DOUBLES_WORK: u64 = 4;
const PRECISE_WORK: u64 = 256;
/// Work of a flight in more bits.
const PRECISE_FLIGHT_WORK: u64 = 256;

/// The work that a search may still take, in flights in doubles.
struct Work(u64);

impl Work {
    /// Takes `work` off the budget, if there is as much.
    fn afford(&mut self, work: u64) -> bool {
        let left = self.0.checked_sub(work);
        self.0 = left.unwrap_or(self.0); // proposes: what is tried
        left.is_some()
    }
}

/// Guess of the period of a motion: the number of its impacts, with all impacts so far, and the cycles. The period begins with the impact that
/// its word begins with.
struct Guess<'s> {
    all: &'s [Impact],
    impacts: usize,
    cycles: u32,
}

/// A bound of the trace of a stable orbit of a period that contracts areas.
const MOST_TRACE: f64 = 2.0;

/// The reason why no stable orbit is proved near a guess.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Open {
    /// Newton's iteration leads to no orbit, or to an unstable or virtual one: from other states of the motion it may lead to the stable one beside it.
    Another,
    /// The orbit is a shorter one run several times, its properties are undecided in any bits, or the work is spent.
    Undecided,
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
    /// Forcing periods since the impact `before`.
    fn since(&self, before: &Self) -> f64 {
        (self.turns - before.turns) as f64 + (self.phase.mid() - before.phase.mid()) // proposes
    }

    /// Distance of two states on one wall: difference of the phases, in forcing periods modulo 1, plus relative difference of the velocities.
    fn apart(&self, before: &Self) -> Option<f64> {
        let since = self.since(before);
        let (now, then) = (self.velocity.mid(), before.velocity.mid());
        let apart = (now - then).abs() / (now.abs() + then.abs() + f64::MIN_POSITIVE);
        (self.wall == before.wall).then(|| (since - since.round()).abs() + apart) // proposes
    }
}

/// Index of the impact that the word of a period begins with.
fn first_of_word(walls: &[Wall], phase: impl Fn(usize) -> f64) -> usize {
    let is_right = |shift: usize| walls.iter().cycle().skip(shift).take(walls.len()).map(|wall| *wall == Wall::Right);
    let earlier = |a: &usize, b: &usize| is_right(*a).cmp(is_right(*b)).then_with(|| phase(*a).total_cmp(&phase(*b)));
    (0..walls.len()).min_by(earlier).unwrap_or(0) // exact: an index
}

impl<'s> Guess<'s> {
    /// The guess itself, and guesses with the same period that end with earlier impacts.
    fn windows(&self) -> impl Iterator<Item = Guess<'s>> {
        let Self { all, impacts, cycles } = *self;
        let earliest = impacts.min(all.len() - impacts); // proposes: a period before each
        let ends = (0..earliest).step_by(impacts.div_ceil(LAST_IMPACTS));
        ends.map(move |earlier| Guess { all: &all[..all.len() - earlier], impacts, cycles })
    }

    /// Whether the motion repeats to within `REPEATING_DISTANCE`.
    fn is_settled(&self) -> bool {
        let last = self.all.len() - 1;
        self.all[last].apart(&self.all[last - self.impacts]).is_some_and(|apart| apart < REPEATING_DISTANCE)
    }

    /// Position of the impact that the period begins with, among all.
    fn first(&self) -> usize {
        let last = self.all.len() - 1;
        let states = &self.all[last - self.impacts..last];
        let walls: Vec<Wall> = states.iter().map(|state| state.wall).collect();
        last - self.impacts + first_of_word(&walls, |i| states[i].phase.mid().rem_euclid(1.0))
    }

    /// The impacts of the period, and the cycles after which each comes again where it has to come after the others.
    fn states(&self) -> impl Iterator<Item = (&'s Impact, u32)> {
        let (first, end) = (self.first(), self.all.len() - 1);
        let later = self.all[end - self.impacts..first].iter().map(|state| (state, self.cycles));
        self.all[first..end].iter().map(|state| (state, 0)).chain(later)
    }

    /// The mappings from each of the impacts to the next.
    fn word(&self) -> Option<Word> {
        let walls: Vec<Wall> = self.states().map(|(state, _)| state.wall).collect();
        let next = walls.iter().cycle().skip(1);
        Word::new(walls.iter().zip(next).map(|(from, to)| Mapping::between(*from, *to)).collect()).ok()
    }

    /// Phases in forcing periods, counted from the beginning of the common period that holds the first impact.
    fn phases(&self, period: i64) -> Vec<f64> {
        let first = self.all[self.first()].turns;
        let base = first - first.rem_euclid(period);
        let phase = |(state, later): (&Impact, u32)| (state.turns - base) as f64 + f64::from(later) + state.phase.mid(); // proposes
        self.states().map(phase).collect()
    }
}

/// Recognises the attractor of a motion at its end and proves that the motion converges to it. Lemma Q3
///
/// `states` are certified states of the motion, in order of time, all of its impacts between the first and the last;
/// `problem` makes the problem of a word, for the same pair; `narrower` gives at most as many of the last states as its argument says, more
/// narrowly; the watch is consulted before each proof.
///
/// **Cost**: at most that of [`FREE_WORK`] flights in doubles and of [`WORK_PER_IMPACT`] for each of the `impacts` of the motion; and of one proof of
/// the orbit to the digits requested, where there is one. Lemma Q5
pub(crate) fn find(
    states: &[Impact],
    (digits, impacts): (u32, u64),
    watch: &dyn Watch,
    problem: impl Fn(&Word, u32) -> Option<Problem>,
    mut narrower: impl FnMut(usize) -> Vec<Impact>,
) -> Option<Attractor> {
    let mut work = Work(FREE_WORK.saturating_add(WORK_PER_IMPACT.saturating_mul(impacts))); // proposes: what is tried
    // Under several harmonics not all cycles make a problem.
    let problems =
        guesses(states).filter(|guess| guess.word().is_some_and(|word| problem(&word, guess.cycles).is_some()));
    let tried: Vec<Guess<'_>> = problems.take(MAX_GUESSES).collect();
    tried.iter().find_map(|guess| {
        for window in guess.windows() {
            if !watch.goes_on() {
                return None;
            }
            let problem = problem(&window.word()?, window.cycles)?;
            match problem.stable_orbit(&window.phases(problem.period().into()), digits, &mut work) {
                Err(Open::Another) if window.is_settled() => {}
                Err(_) => return None,
                Ok(near) => {
                    let last = states.len() - 1 - window.first();
                    return problem.attracts(&near, (states, last), digits, &mut work).or_else(|| {
                        let most = usize::try_from(work.0 / PRECISE_FLIGHT_WORK).unwrap_or(usize::MAX); // exact: a number of states
                        let narrow = narrower(most);
                        let flown = PRECISE_FLIGHT_WORK * narrow.len() as u64; // proposes: what is tried
                        work.afford(flown).then(|| problem.attracts(&near, (&narrow, last), digits, &mut work))?
                    });
                }
            }
        }
        None
    })
}

impl Finding<Ball> {
    /// Whether the orbit is unstable or virtual, or likely to be one of the many unstable ones that chaos comes near.
    fn is_refused(&self) -> bool {
        // proposes: chaos near an orbit whose trace is beyond what a stable one has is not asked again
        let is_wild = self.stability == Stability::Undecided && self.trace.mid().abs() >= MOST_TRACE;
        matches!(self.stability, Stability::Unstable | Stability::Elliptic) || self.physical == Some(false) || is_wild
    }

    /// Whether the orbit is proved to be stable and admissible: then no more bits are needed.
    fn is_stable(&self) -> bool {
        self.stability == Stability::Stable && self.physical == Some(true)
    }
}

/// `Ok` if an orbit is proved to be stable, admissible, and run through once.
fn is_attracting(orbit: &PeriodicOrbit) -> Result<(), Open> {
    match (orbit.stability, orbit.physical, orbit.repeats) {
        (Stability::Stable, Some(true), Some(1)) => Ok(()),
        (.., Some(2..)) => Err(Open::Undecided),
        (Stability::Unstable | Stability::Elliptic, ..) | (_, Some(false), _) => Err(Open::Another),
        _ => Err(Open::Undecided),
    }
}

impl Problem {
    /// Proves a stable, admissible orbit near these phases, as narrow as its basin requires.
    fn stable_orbit(&self, guess: &[f64], digits: u32, work: &mut Work) -> Result<PeriodicOrbit, Open> {
        let pairs = (guess.len() * guess.len()) as u64; // proposes: what is tried
        if !self.chain().crosses() || !work.afford(DOUBLES_WORK * pairs) {
            return Err(Open::Undecided);
        }
        let guess = self.polished(guess).ok_or(Open::Another)?;
        // A guess that doubles refute is not tried in more bits.
        let finding = self.prove_in_doubles(&guess);
        if finding.as_ref().is_some_and(|finding| finding.is_refused()) {
            return Err(Open::Another);
        }
        let is_decided = finding.is_some_and(|finding| finding.is_stable());
        if !is_decided && !work.afford(PRECISE_WORK * pairs) {
            return Err(Open::Undecided);
        }
        let digits = digits.min(FEW_DIGITS); // proposes: how narrow a basin's centre is
        let near = self.prove(&guess, Precision { digits, max_bits: BITS }).ok_or(Open::Another)?;
        is_attracting(&near).map(|()| near)
    }

    /// Proves that a stable orbit attracts a motion from one of `states` on; the last of them comes `ahead` impacts after one that is near the
    /// first of the orbit.
    fn attracts(
        &self,
        near: &PeriodicOrbit,
        (states, ahead): (&[Impact], usize),
        digits: u32,
        work: &mut Work,
    ) -> Option<Attractor> {
        let all = near.impacts.len();
        let at = |state: &Impact| (state.wall, self.in_period(state), state.velocity);
        // The last state near the first of the orbit, and those of the period before it.
        let last = states.len().checked_sub(1 + ahead % all)?;
        let places = (0..all)
            .step_by(all.div_ceil(LAST_IMPACTS))
            .filter_map(|earlier| Some(((all - earlier) % all, states.get(last.checked_sub(earlier)?)?)));
        let around = |(place, state): (usize, &Impact)| -> Option<(usize, Basin)> {
            Some((place, self.basin_around(near, place, at(state), |flights| work.afford(flights))?))
        };
        let (place, basin) = { places }.find_map(around)?;
        let orbit = match digits <= FEW_DIGITS {
            true => near.clone(),
            false => self.prove_from(near, digits)?,
        };
        let inside = states.iter().find(|state| basin.holds(at(state)))?;
        let from = inside.index + ((all - place) % all) as u64; // exact: less than a period
        // V6 (from): this impact is listed, and the flights of a round are, from whichever impact on
        let last = states[states.len() - 1].index;
        (from <= last && last > all as u64).then_some(())?; // exact: a length
        let (word, cycles) = (self.word().clone(), self.chain().cycles());
        Some(Attractor { word, cycles, orbit, from, factor: basin.factor() })
    }

    /// Proves the orbit to the requested digits.
    fn prove_from(&self, near: &PeriodicOrbit, digits: u32) -> Option<PeriodicOrbit> {
        let guess: Vec<f64> = near.phases().iter().map(|phase| phase.mid()).collect();
        let orbit = self.prove(&guess, Precision { digits, max_bits: BITS })?;
        is_attracting(&orbit).ok()?;
        is_inside(orbit.phases(), near.domain()).then_some(orbit)
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
