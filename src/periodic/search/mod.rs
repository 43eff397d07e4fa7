//! All the orbits of a word: the compact state space (Lemma T8), cell by cell of the first phase; in each the chains that grow
//! from it letter by letter (Lemma T10), cut and halved until nothing is left open (Lemma T9).

mod cell;
mod cut;
mod grow;
pub(crate) mod newton;
mod tree;
mod waves;

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::census::{Census, Region};
use super::chained::Chained;
use super::identity::{Identity, is_one_orbit};
use super::orbit::PeriodicOrbit;
use super::{Precision, Problem};
use crate::contact::Reason;
use crate::number::interval::Interval;
use crate::shaken::under;
use crate::threads;
use crate::watch::{Stage, Unwatched, Watch};
use cell::{Cell, Task};
use cut::Terms;
use impact_pair_model::Start;

/// The budget of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Boxes to look at.
    pub boxes: u64,
    /// `-log2` of the width below which a box is not halved, in forcing periods.
    pub halvings: u32,
}

impl Default for Budget {
    fn default() -> Self {
        Self { boxes: 2_000_000, halvings: 36 }
    }
}

/// Cells of the first phase in each forcing period of the common period, in which searches go on side by side.
const CELLS: u32 = 16;
/// Greatest number of forcing periods with `CELLS` cells each; a longer common period has wider cells.
const MOST_PERIODS: u32 = 1 << 10;

impl Problem {
    /// Proves all orbits of the word, and that there are no other admissible ones, apart from motions with sticking. Lemmas T3, T8-T10, T12
    ///
    /// Starts from the orbits that [`Problem::find`] finds. If the budget ends, the remaining parts of the state space are listed as undecided.
    pub fn find_all(&self, start: &Start, precision: Precision, budget: Budget) -> Census {
        self.find_all_while(start, precision, budget, &Unwatched)
    }

    /// Searches until the watch stops it, which receives the progress and is called between parts, by any thread.
    ///
    /// The parts not searched are listed as undecided.
    pub fn find_all_while(&self, start: &Start, precision: Precision, budget: Budget, watch: &dyn Watch) -> Census {
        let of = self.cells() as usize; // exact: small
        let guessing = |_: Stage<'_>| watch.proceed(Stage::Cells { done: 0, of });
        let found = self.find_while(start, precision, &guessing);
        if found.exhaustive || found.is_family {
            return found;
        }
        under!(&self.shaken, shaken => self.search(&**shaken, found.orbits, precision, budget, watch))
    }

    /// Number of cells that the first phase is searched in.
    fn cells(&self) -> u32 {
        CELLS * self.chain.period().min(MOST_PERIODS) // T10: any number of cells
    }

    /// Searches for orbits beside those known.
    fn search<S: Chained>(
        &self,
        shaken: &S,
        known: Vec<PeriodicOrbit>,
        precision: Precision,
        budget: Budget,
        watch: &dyn Watch,
    ) -> Census {
        let terms = Terms::new(&self.chain, shaken.pair(), shaken.rates());
        let narrowest = narrowest(&terms, budget);
        let done = AtomicUsize::new(0);
        let of = self.cells() as usize; // exact: small
        let watch = |_: Stage<'_>| watch.proceed(Stage::Cells { done: done.load(Ordering::Relaxed), of });
        let task = Task { problem: self, shaken, terms, precision, narrowest, known: &known, watch: &watch };
        // T10: any lines from 0 to the period
        let line = |n: u32| f64::from(n) * f64::from(self.chain.period()) / f64::from(self.cells());
        let mut cells: Vec<_> =
            (0..self.cells()).map(|n| Cell::new(&task, Interval::new(line(n), line(n + 1)))).collect();
        // The budget that cells leave is shared among those that have not done.
        let mut left = budget.boxes;
        loop {
            let mut busy: Vec<_> = cells.iter_mut().filter(|cell| !cell.is_done()).collect();
            let share = left.checked_div(busy.len() as u64); // exact: a length
            let Some(share) = share.filter(|share| *share > 0 && watch.goes_on()) else { break };
            left -= share * busy.len() as u64; // exact: small
            busy.iter_mut().for_each(|cell| cell.left = share);
            let busy: Vec<_> = busy.into_iter().map(Mutex::new).collect();
            threads::run(threads::available(), busy.len(), &|number| {
                let mut cell = busy[number].lock().expect("no thread has panicked");
                cell.search();
                done.fetch_add(usize::from(cell.is_done()), Ordering::Relaxed);
                true
            });
            drop(busy);
            left += cells.iter().map(|cell| cell.left).sum::<u64>();
        }
        let mut census = self.gathered(&cells, &known, precision);
        census.interrupted = !census.exhaustive && !watch.goes_on();
        census
    }

    /// Collects the results of all cells, each orbit once, whatever the order in which they were searched.
    fn gathered<S: Chained>(&self, cells: &[Cell<S>], known: &[PeriodicOrbit], precision: Precision) -> Census {
        let mut undecided: Vec<Region> = cells.iter().flat_map(Cell::undecided).collect();
        let mut orbits = known.to_vec();
        for orbit in cells.iter().flat_map(|cell| &cell.found) {
            // A chain that is proved to be no motion is listed where a guess led to it only.
            if orbit.physical == Some(false) {
                continue;
            }
            match self.prove_again(orbit, precision, &orbits) {
                Some((orbit, Identity::New)) => orbits.push(orbit),
                Some((_, Identity::Known)) => {}
                _ => undecided.push(Region { impacts: orbit.impacts.clone(), reason: Reason::Precision }),
            }
        }
        orbits.sort_by(|a, b| a.phases()[0].mid().total_cmp(&b.phases()[0].mid()));
        Census { orbits, exhaustive: undecided.is_empty(), undecided, is_search: true, ..Census::default() }
    }

    /// Proves the orbit of a cell anew, to as many digits as decide whether it is a known one. `None` where Newton's iteration, from the
    /// middles of its phases, leads to another orbit or to none that is proved. Lemma T6
    fn prove_again(
        &self,
        orbit: &PeriodicOrbit,
        precision: Precision,
        known: &[PeriodicOrbit],
    ) -> Option<(PeriodicOrbit, Identity)> {
        let guess: Vec<f64> = orbit.phases().iter().map(|phase| phase.mid()).collect();
        let (again, identity) = self.prove_beside(&guess, precision, known.iter())?;
        let is_in = |one: &PeriodicOrbit, other: &PeriodicOrbit| {
            is_one_orbit(&self.chain, &one.proved, &other.proved) == Some(true)
        };
        (is_in(&again, orbit) || is_in(orbit, &again)).then_some((again, identity))
    }
}

/// Width below which a box is not halved, in forcing periods.
fn narrowest(terms: &Terms<'_>, budget: Budget) -> f64 {
    2f64.powi(-(budget.halvings as i32)).max(terms.spread() / 16.0) // proposes: when to stop
}

#[cfg(test)]
mod tests {
    use super::super::krawczyk::Proved;
    use super::*;
    use crate::number::Ball;
    use crate::periodic::Chain;
    use crate::shaken::{Either, Shaken};
    use crate::tests::{pair, pair_of, start};
    use crate::watch::proceed_if;

    fn is_physical(orbit: &PeriodicOrbit) -> bool {
        orbit.physical == Some(true)
    }

    /// Without any orbit known at first the search comes upon the same motions as the guesses.
    #[test]
    fn the_search_alone_finds_what_the_guesses_find() {
        let start = start();
        for (word, cycles, ratio, restitution, count) in [
            ("LR", 3, "1/9.42497", "0.5", 8),
            ("LLR", 3, "1/9.42497", "0.5", 5),
            ("LRLR", 3, "2/9.42497", "0.5", 4),
            ("LLR", 1, "8/9.42497", "0.5", 1),
            ("LLRR", 1, "2", "0.8", 4),
            ("LRLR", 2, "2", "0.8", 1),
            ("LRLRLR", 3, "0.498", "0.8", 8),
            ("LR", 2, "1/20", "1", 4),
        ] {
            let problem = problem(ratio, restitution, word, cycles);
            let precision = Precision::default();
            let guessed = problem.find(&start, precision).orbits;
            let Either::One(one) = &problem.shaken else { panic!("one harmonic") };
            let census = problem.search(&**one, Vec::new(), precision, Budget::default(), &Unwatched);
            assert!(census.exhaustive, "{word}");
            let is_found = |orbit: &PeriodicOrbit| {
                let is_it = |other: &PeriodicOrbit| is_one_orbit(&problem.chain, &orbit.proved, &other.proved);
                census.orbits.iter().any(|other| is_it(other) == Some(true))
            };
            assert!(guessed.iter().filter(|orbit| is_physical(orbit)).all(is_found), "{word}");
            let found = census.orbits.iter().filter(|orbit| is_physical(orbit)).count();
            // Guesses may miss some.
            assert_eq!(found, count, "{word}, of which {} were guessed", guessed.len());
        }
    }

    fn problem(ratio: &str, restitution: &str, word: &str, cycles: u32) -> Problem {
        Problem::new(&pair(ratio, restitution), &word.parse().unwrap(), cycles).unwrap()
    }

    /// Two odd harmonics, two that are not, three, a hop of every length; lengths in gaps, the fastest harmonic has `W = 2 pi`.
    fn under_several() -> Vec<Problem> {
        let questions: [(&[[&str; 3]], &str, &str, u32); 4] = [
            (&[["1/9.42497", "2*pi/3", "0"], ["0.5/9.42497", "2*pi", "0"]], "0.5", "LR", 3),
            (&[["0.1", "pi", "0.3"], ["1/10", "2*pi", "0"]], "0.5", "LR", 2),
            (&[["1/5", "4*pi/3", "0"], ["1/15", "2*pi/3", "1"], ["1/25", "2*pi", "0"]], "0.6", "LR", 3),
            (&[["1/100", "pi", "0"], ["2", "2*pi", "0.7"]], "0.8", "RRLLLRRLLL", 2),
        ];
        let problem = |(terms, restitution, word, cycles): (&[[&str; 3]], &str, &str, u32)| {
            Problem::new(&pair_of(terms, "1", restitution), &word.parse().unwrap(), cycles).unwrap()
        };
        questions.map(problem).to_vec()
    }

    /// Lemma T10: whatever else is cut away, the chains that grow hold each orbit that is proved elsewhere.
    #[test]
    fn chains_hold_the_orbits_that_guesses_lead_to() {
        let questions = [
            ("LR", 3, "1/9.42497", "0.5"),
            ("LLR", 1, "8/9.42497", "0.5"),
            ("RRLLL", 1, "2", "0.8"),
            ("RRLLLRRLLL", 2, "2", "0.8"),
            ("RRRRRLLLLL", 1, "7.5", "0.8"),
            ("LRLRLR", 3, "0.498", "0.8"),
            ("LRLRLRLRLR", 5, "0.36", "0.8"),
            ("RLRLRL", 3, "0.36", "1"),
        ];
        let under_one = questions.map(|(word, cycles, ratio, restitution)| problem(ratio, restitution, word, cycles));
        let held = |problem: &Problem| under!(&problem.shaken, shaken => held_by_chains(problem, &**shaken));
        let (one, several): (usize, usize) = (under_one.iter().map(held).sum(), under_several().iter().map(held).sum());
        assert!(one >= 30 && several >= 8, "{one} {several}");
    }

    /// Number of admissible orbits that guesses lead to, each of which the chains are asserted to hold.
    fn held_by_chains<S: Chained>(problem: &Problem, shaken: &S) -> usize {
        let start = start();
        let (word, period) = (&problem.word, f64::from(problem.period()));
        let found = problem.find(&start, Precision::default()).orbits;
        for orbit in found.iter().filter(|orbit| is_physical(orbit)) {
            // Counted from the period of the first impact.
            let at = |i: usize| {
                let first = (orbit.phases()[0].mid() / period).floor() * period;
                orbit.phases()[i].mid() - first
            };
            let cell = (at(0) * f64::from(CELLS)).floor() / f64::from(CELLS);
            let task = Task {
                problem,
                shaken,
                terms: Terms::new(&problem.chain, shaken.pair(), shaken.rates()),
                precision: Precision::default(),
                narrowest: 0.0,
                known: &[],
                watch: &Unwatched,
            };
            let mut cell = Cell::new(&task, Interval::new(cell, cell + 1.0 / f64::from(CELLS)));
            cell.left = u64::MAX;
            let chains = cell.chains().unwrap();
            let is_in = |part: &&cut::Part| {
                part.phases.iter().enumerate().all(|(i, x)| x.inf() - 1e-9 <= at(i) && at(i) <= x.sup() + 1e-9)
            };
            let holding: Vec<_> = chains.iter().filter(is_in).collect();
            assert!(!holding.is_empty(), "{word} at {:?}", orbit.phases());
            // They are not just everything.
            let before = cell.all().size();
            assert!(holding.iter().all(|part| part.size() < 0.5 * before), "{word}: {holding:?}");
        }
        found.iter().filter(|orbit| is_physical(orbit)).count()
    }

    /// Lemmas T9, H14: over a box that is a point, the derivatives of a search are those of Lemma T2 there.
    #[test]
    fn derivatives_over_a_point_are_those_of_the_chain() {
        fn meet<S: Chained>(chain: &Chain, shaken: &S, phases: &[f64]) {
            let terms = Terms::new(chain, shaken.pair(), shaken.rates());
            let points: Vec<Interval> = phases.iter().map(|&x| Interval::point(x)).collect();
            let count = points.len();
            let time = |i: usize| points[chain.next(i)] + terms.shift(i) - points[i];
            let unknown = vec![Interval::new(f64::MIN, f64::MAX); count];
            let times = (0..count).map(time).collect();
            let part = cut::Part { phases: points, times, drifts: unknown.clone(), speeds: unknown };
            let rows = terms.rows(&part, 0..count);
            let balls: Vec<Ball> = phases.iter().map(|&x| Ball::exact(x)).collect();
            let slopes = chain.slopes(shaken.balls(), &chain.legs(shaken.balls(), &balls).unwrap()).unwrap();
            for (own, expected) in rows.slopes.iter().flatten().zip(slopes.0.iter().flatten()) {
                let expected = Interval::from(*expected);
                assert!(
                    own.intersection(expected).is_some() && own.wid() < 1e-6 * (1.0 + own.sup().abs()),
                    "{own:?} {expected:?}"
                );
            }
        }
        let mut problems = under_several();
        problems.extend([problem("2", "0.8", "RRLLL", 1), problem("1/9.42497", "0.5", "LR", 3)]);
        for problem in problems {
            let (count, cycles) = (problem.chain.impacts(), f64::from(problem.chain.cycles()));
            for n in 0..40 {
                // Flights of all lengths, from hundredths of a forcing period on.
                let part = |i: usize| (1.0 + (1.7 * i as f64 + 2.3 * f64::from(n)).sin()).powi(1 + n % 4) + 0.02;
                let whole: f64 = (0..count).map(part).sum();
                let at = |i: usize| 0.31 * f64::from(n) + (0..i).map(part).sum::<f64>() * cycles / whole;
                let phases: Vec<f64> = (0..count).map(at).collect();
                under!(&problem.shaken, shaken => meet(&problem.chain, &**shaken, &phases));
            }
        }
    }

    /// Two motions of figure 12's word: of a cell that found one of them, while the middles of its bounds are nearest to the other one, neither is
    /// taken for the other.
    #[test]
    fn r32_an_orbit_proved_anew_is_compared_with_that_of_its_cell() {
        let start = start();
        let problem = problem("1/9.42497", "0.5", "LR", 1);
        let Either::One(one) = &problem.shaken else { panic!("one harmonic") };
        let all = problem.find(&start, Precision::default()).orbits;
        let [found, other] = &all[..] else { panic!("two motions, not {}", all.len()) };
        // The bounds of the one reach as far as to the other and as far again.
        let wide = |(x, y): (&Ball, &Ball)| Ball::new(y.mid(), 2.0 * (x.mid() - y.mid()).abs() + 1e-9);
        let at = found.phases().iter().zip(other.phases()).map(wide).collect();
        let proved = Proved { at, domain: found.domain().to_vec() };
        let task = Task {
            problem: &problem,
            shaken: &**one,
            terms: Terms::new(&problem.chain, one.pair(), one.rates()),
            precision: Precision::default(),
            narrowest: 0.0,
            known: &[],
            watch: &Unwatched,
        };
        let gathered = |orbit: PeriodicOrbit| {
            let mut cell = Cell::new(&task, Interval::new(0.0, 1.0));
            cell.found.push(orbit);
            problem.gathered(&[cell], &[], Precision::default())
        };
        let census = gathered(PeriodicOrbit { proved, ..found.clone() });
        let is_found = |orbit: &PeriodicOrbit| is_one_orbit(&problem.chain, &orbit.proved, &found.proved) == Some(true);
        let undecided = census.undecided.iter().filter(|region| region.reason == Reason::Precision).count();
        assert!(census.orbits.is_empty() && undecided == 1, "{:?}", census.orbits);
        // The true one is put among the others.
        let census = gathered(found.clone());
        assert!(census.orbits.len() == 1 && census.orbits.iter().all(is_found));
    }

    /// The result of a search does not depend on the order in which threads search the cells, and a search that is ended says so and
    /// keeps what is proved.
    #[test]
    fn searches_repeat_and_may_be_ended() {
        let start = start();
        let problem = problem("1/9.42497", "0.5", "LR", 3);
        let all = |budget, ends_at: usize| {
            let calls = AtomicUsize::new(0);
            let watch = |_: Stage<'_>| proceed_if(calls.fetch_add(1, Ordering::Relaxed) < ends_at);
            problem.find_all_while(&start, Precision::default(), budget, &watch)
        };
        let (one, other) = (all(Budget::default(), usize::MAX), all(Budget::default(), usize::MAX));
        assert!(one.exhaustive && !one.interrupted && one.is_certified());
        assert_eq!(one.orbits, other.orbits);
        let guesses = problem.find(&start, Precision::default()).orbits;
        let ended = all(Budget::default(), 0);
        assert!(ended.interrupted && ended.orbits.is_empty() && !ended.is_certified() && ended.undecided.len() == 16);
        // A budget that ends is no interruption.
        let few = all(Budget { boxes: 100, ..Budget::default() }, usize::MAX);
        assert!(!few.exhaustive && !few.interrupted && few.orbits == guesses && !few.undecided.is_empty());
    }
}
