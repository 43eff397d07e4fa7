//! All the orbits of a word: the compact state space (Lemma T8) cut and halved until nothing is left open (Lemma T9).

mod cut;
mod interval;
mod newton;

use super::census::{Census, Region};
use super::chain::Slopes;
use super::identity::{Identity, is_one_orbit};
use super::krawczyk::Proved;
use super::newton::is_plausible;
use super::orbit::{PeriodicImpact, PeriodicOrbit};
use super::{Pair, Precision, Problem, newton::polish};
use crate::Error;
use crate::contact::{Court, Reason};
use crate::exact::Enclosure;
use crate::number::Ball;
use cut::{Part, Terms};
use impact_pair_model::Start;
use interval::Interval;

/// How far a search goes before it gives up on what is left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Boxes to look at.
    pub boxes: u64,
    /// `-log2` of the width below which a box is not halved, in turns.
    pub halvings: u32,
}

impl Default for Budget {
    fn default() -> Self {
        Self { boxes: 5_000_000, halvings: 36 }
    }
}

/// Parts left undecided at which a search is given up: there is a continuum of orbits, or nearly one.
const MOST_UNDECIDED: usize = 1000;

/// A search under way.
struct Search<'p> {
    problem: &'p Problem,
    court: &'p Court,
    terms: Terms<'p>,
    precision: Precision,
    /// All orbits found, those that belong to no motion included: their domains are done with.
    known: Vec<PeriodicOrbit>,
    undecided: Vec<Region>,
}

/// Boxes as narrow as that, in turns, are asked whether an orbit is near.
const NEAR: f64 = 1.0 / 16.0;

impl Problem {
    /// Proves all the orbits of the word, and that there are no other physical ones. Lemmas T3, T8, T9
    ///
    /// Starts from what [`Problem::find`] finds. Where the budget ends, what is left is listed as undecided.
    ///
    /// # Errors
    /// When there are several harmonics, except for words on one wall.
    pub fn find_all(&self, start: &Start, precision: Precision, budget: Budget) -> Result<Census, Error> {
        if self.chain.crosses() {
            self.impact_pair.harmonic("the search for all periodic orbits")?;
        }
        let found = self.find(start, precision);
        let Pair::One(one) = &self.pair else { return Ok(found) };
        if found.exhaustive {
            return Ok(found);
        }
        let terms = Terms::new(&self.chain, &one.court.pair);
        let known = found.orbits;
        let mut search = Search { problem: self, court: &one.court, terms, precision, known, undecided: Vec::new() };
        search.run(budget);
        let mut orbits = search.known;
        // Only motions are looked for; a chain that is proved to be none is listed where a guess led to it.
        orbits.sort_by(|a, b| a.phases()[0].mid().total_cmp(&b.phases()[0].mid()));
        Ok(Census { orbits, exhaustive: search.undecided.is_empty(), undecided: search.undecided, is_search: true })
    }
}

impl Search<'_> {
    /// Depth first, so that little is kept.
    fn run(&mut self, budget: Budget) {
        let narrowest = 2f64.powi(-(budget.halvings as i32)).max(self.terms.spread() / 16.0); // proposes: when to stop
        let mut open = vec![self.terms.all()];
        let mut looked = 0;
        while let Some(part) = open.pop() {
            looked += 1;
            if looked > budget.boxes || self.undecided.len() >= MOST_UNDECIDED {
                open.push(part);
                break;
            }
            let Some((part, slopes)) = self.narrow(part) else { continue };
            if part.width() <= NEAR && self.is_done(&part) {
                continue;
            }
            if part.width() <= narrowest {
                self.undecided.push(self.region(&part, Reason::Precision));
                continue;
            }
            open.extend(halves(part, &slopes));
        }
        for part in open {
            self.undecided.push(self.region(&part, Reason::Budget));
        }
    }

    /// Cuts a part by all that is known; `None` when nothing is left.
    fn narrow(&self, part: Part) -> Option<(Part, Slopes<Interval>)> {
        let mut part = self.terms.cut(part)?;
        loop {
            let slopes = self.terms.slopes(&part);
            let before = part.size();
            part = self.terms.newton(&self.court.pair, part, &slopes)?;
            if part.size() > 0.7 * before {
                return Some((part, slopes));
            }
            part = self.terms.cut(part)?;
        }
    }

    /// Whether the part lies where a known orbit is the only one; looks for the orbit if it is not known yet.
    fn is_done(&mut self, part: &Part) -> bool {
        let balls: Vec<Ball> = part.phases.iter().map(|x| x.ball()).collect();
        let whole = Proved { domain: balls.clone(), at: balls };
        let chain = &self.problem.chain;
        let is_inside = |known: &PeriodicOrbit| is_one_orbit(chain, &whole, &known.proved) == Some(true);
        if self.known.iter().any(is_inside) {
            return true;
        }
        let Some((orbit, identity)) = self.orbit_near(part) else { return false };
        // An orbit that may be a known one stays a question.
        let is_done = identity != Identity::Open && is_inside(&orbit);
        if identity == Identity::New {
            self.known.push(orbit);
        }
        is_done
    }

    /// An orbit in or beside the part that Newton's iteration leads to, proved, and whether it is known.
    fn orbit_near(&self, part: &Part) -> Option<(PeriodicOrbit, Identity)> {
        let (chain, pair) = (&self.problem.chain, &self.court.centre);
        let phases = polish(chain, pair, part.centre())?;
        let is_near = |(x, part): (&f64, &Interval)| (x - part.middle()).abs() <= part.width();
        if !(phases.iter().zip(&part.phases).all(is_near) && is_plausible(chain, pair, &phases)) {
            return None;
        }
        self.problem.prove_beside(&phases, self.precision, &self.known)
    }

    /// What is said of a part that stays open.
    fn region(&self, part: &Part, reason: Reason) -> Region {
        let chain = &self.problem.chain;
        let enclosure = |x: Interval| Enclosure::from_f64_bounds(x.lo, x.hi).expect("finite intervals");
        let impact = |i: usize| PeriodicImpact {
            wall: chain.walls()[i],
            phase: enclosure(part.phases[i]),
            velocity: enclosure(part.drifts[chain.previous(i)] - self.terms.speed(part.phases[i])),
        };
        Region { impacts: (0..part.phases.len()).map(impact).collect(), reason }
    }
}

/// Both halves across the phase that the equations depend on most.
fn halves(part: Part, slopes: &Slopes<Interval>) -> [Part; 2] {
    let mut weights = vec![0.0; part.phases.len()];
    for (_, j, slope) in slopes.entries() {
        weights[j] += slope.lo.abs().max(slope.hi.abs()).min(1e6); // proposes: where to halve
    }
    let weight = |j: &usize| weights[*j] * part.phases[*j].width();
    let widest = (0..weights.len()).max_by(|a, b| weight(a).total_cmp(&weight(b))).unwrap_or(0); // proposes
    let Interval { lo, hi } = part.phases[widest];
    let middle = part.phases[widest].middle();
    let mut other = part.clone();
    other.phases[widest] = Interval::new(middle, hi);
    let mut part = part;
    part.phases[widest] = Interval::new(lo, middle);
    [part, other]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::Wall;
    use crate::{Harmonic, ImpactPair};

    fn is_physical(orbit: &PeriodicOrbit) -> bool {
        orbit.physical == Some(true)
    }

    /// Without any orbit known at first the search comes upon the same motions as the guesses.
    #[test]
    fn the_search_alone_finds_what_the_guesses_find() {
        let start = Start::on_wall("0".parse().unwrap(), Wall::Left, "-1".parse().unwrap()).unwrap();
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
            let harmonic = Harmonic::new(ratio.parse().unwrap(), "1".parse().unwrap(), "0".parse().unwrap()).unwrap();
            let pair = ImpactPair::new(harmonic, "1".parse().unwrap(), restitution.parse().unwrap()).unwrap();
            let problem = Problem::new(&pair, &word.parse().unwrap(), cycles).unwrap();
            let precision = Precision::default();
            let guessed = problem.find(&start, precision).orbits;
            let Pair::One(one) = &problem.pair else { panic!("one harmonic") };
            let court = &one.court;
            let terms = Terms::new(&problem.chain, &court.pair);
            let mut search =
                Search { problem: &problem, court, terms, precision, known: Vec::new(), undecided: Vec::new() };
            search.run(Budget::default());
            assert!(search.undecided.is_empty(), "{word}");
            let is_found = |orbit: &PeriodicOrbit| {
                let is_it = |other: &PeriodicOrbit| is_one_orbit(&problem.chain, &orbit.proved, &other.proved);
                search.known.iter().any(|other| is_it(other) == Some(true))
            };
            assert!(guessed.iter().filter(|orbit| is_physical(orbit)).all(is_found), "{word}");
            let found = search.known.iter().filter(|orbit| is_physical(orbit)).count();
            // Guesses may miss some.
            assert_eq!(found, count, "{word}, of which {} were guessed", guessed.len());
        }
    }

    /// A continuum of orbits is no finite list: `A = 0`, `e = 1`.
    #[test]
    fn a_continuum_stays_undecided() {
        let start = Start::on_wall("0".parse().unwrap(), Wall::Left, "-1".parse().unwrap()).unwrap();
        let harmonic = Harmonic::new("0".parse().unwrap(), "1".parse().unwrap(), "0".parse().unwrap()).unwrap();
        let pair = ImpactPair::new(harmonic, "1".parse().unwrap(), "1".parse().unwrap()).unwrap();
        let problem = Problem::new(&pair, &"LR".parse().unwrap(), 1).unwrap();
        let census = problem.find_all(&start, Precision::default(), Budget::default()).unwrap();
        assert!(!census.exhaustive && !census.undecided.is_empty() && !census.is_certified());
    }
}
