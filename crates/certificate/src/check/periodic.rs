//! Check of a periodic JSON: each orbit is enclosed again, is unique in its bounds, and has the claimed properties.
//!
//! Method (Lemma V8): Newton's iteration for a recurring state begins at the claimed state. Newton's
//! step is proved to contract an ellipse of states that holds the claimed bounds of the first impact, so there is exactly one orbit,
//! attracting or not. A narrow ellipse of the same axes then encloses the orbit, as for an attractor
//! ([`target`](super::target)).

use super::attraction::{for_all_pieces, widest_datum};
use super::basin::{basin, stepped};
use super::budget::Budget;
use super::complete::List;
use super::contact::Doubt;
use super::data::{Data, Piece};
use super::distinct::{Recurrence, begins_within};
use super::frame::{Frame, hull};
use super::round::Round;
use super::step::{Landing, Launch};
use super::target::{BITS, Target};
use super::{Limits, Verdict, one_by_one};
use crate::attraction::{ClaimedOrbit, Passage};
use crate::periodic::{OrbitOf, PeriodicCertificate, Search};
use impact_pair_exact::Real;
use impact_pair_model::watch::{Latched, Watch};
use impact_pair_model::{Error, Wall};

impl PeriodicCertificate {
    /// Proves every orbit again, or names an orbit that is refuted or undecided. The watch can stop the check and
    /// receives the number of orbits confirmed so far.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let watch = Latched::new(watch);
        let budget = Budget::new(0, limits.parts, &watch);
        let data = Data { budget: budget.clone(), ..Data::new(&self.pair, &self.start)? };
        let judge = |OrbitOf { word, cycles, orbit }: &OrbitOf| {
            let target = Target::new(&data, word, *cycles, orbit)?;
            target.is_an_orbit(limits.pieces).map(|()| BITS)
        };
        let each = one_by_one(self.orbits.iter().enumerate(), (&budget, limits.work), judge, &watch);
        let whole = |_| {
            budget.add(limits.work);
            self.whole(&data).map_err(|doubt| match budget.is_stopped() {
                true => Verdict::Interrupted { events: self.orbits.len() },
                false => doubt.on(self.orbits.len()),
            })
        };
        Ok(each.and_then(whole).map_or_else(|verdict| verdict, |()| Verdict::Confirmed { bits: BITS, pieces: 1 }))
    }

    /// Checks the claims about all orbits together.
    fn whole(&self, data: &Data) -> Result<(), Doubt> {
        if self.says_all_is_proved && !(self.orbits.iter().all(|claim| claim.orbit.is_decided()) && self.has_no_rest) {
            return Err(Doubt::False("not all requested properties of the orbits are proved".into()));
        }
        // Lemma D23: orbits of the reduced map have their least period.
        let repeated = self.orbits.iter().position(|claim| self.mirrors_are_one && claim.orbit.times != Some(1));
        if let Some(i) = repeated {
            return Err(Doubt::False(format!("orbits[{i}] is not claimed to have its least period")));
        }
        if self.orbits.is_empty() && self.search.is_none() {
            return Err(Doubt::open("there is no orbit to check"));
        }
        self.are_distinct(data)?;
        self.search.as_ref().map_or(Ok(()), |search| self.is_complete(data, search))
    }

    /// Proves that the word has no orbits that are not listed. Lemma V41
    fn is_complete(&self, data: &Data, Search { word, cycles, tree }: &Search) -> Result<(), Doubt> {
        let orbits: Vec<&ClaimedOrbit> = self.orbits.iter().map(|claim| &claim.orbit).collect();
        List::new(data, word, *cycles, &orbits)?.is_complete(tree)
    }

    /// Proves that each orbit is listed once. Lemma V13
    fn are_distinct(&self, data: &Data) -> Result<(), Doubt> {
        let Some(recurrence) = Recurrence::of(data) else {
            return Err(Doubt::open("the harmonics are not proved to have a common period"));
        };
        for (j, other) in self.orbits.iter().enumerate() {
            for (i, one) in self.orbits[..j].iter().enumerate() {
                if recurrence.are_apart(&one.orbit, &other.orbit, self.mirrors_are_one) {
                    continue;
                }
                return Err(match one.is_within(other) || other.is_within(one) {
                    true => Doubt::False(format!("orbits[{i}] and orbits[{j}] are one orbit")),
                    false => Doubt::Open(format!("orbits[{i}] and orbits[{j}] are not proved to be two")),
                });
            }
        }
        Ok(())
    }
}

impl OrbitOf {
    /// Whether the orbit is claimed within the bounds of another orbit of the same word that is unique in its bounds. Lemmas V8, V13
    fn is_within(&self, other: &Self) -> bool {
        let is_alone = other.orbit.unique && other.orbit.physical == Some(true) && self.orbit.physical == Some(true);
        is_alone && (&self.word, self.cycles) == (&other.word, other.cycles) && begins_within(&self.orbit, &other.orbit)
    }
}

impl Target<'_> {
    /// Proves that the claimed orbit exists with the claimed properties, for all data.
    fn is_an_orbit(&self, most: usize) -> Result<(), Doubt> {
        if !self.claim.unique {
            return Err(Doubt::open("only orbits that are alone in their bounds are checked"));
        }
        let widest = |piece: &Piece| {
            let frame = Frame::new(self.data, piece, BITS);
            if frame.parameters.columns() == 0 {
                return None;
            }
            widest_datum(self.period(&frame).ok()?, self.guess(&frame))
        };
        for_all_pieces(self.data, most, |piece| self.is_an_orbit_on(piece), widest)
    }

    fn is_an_orbit_on(&self, piece: &Piece) -> Result<(), Doubt> {
        let frame = Frame::new(self.data, piece, BITS);
        let mut round = self.period(&frame)?;
        let (centre, derivative) = round.polish(self.guess(&frame))?;
        let claimed = self.first(&frame);
        let phase = round.near(&claimed.phase, &centre[0]).ok_or_else(|| Doubt::open("the phase is too large"))?;
        let claimed = Landing { phase, ..claimed };
        let basin = basin(&round, &stepped(&centre, &derivative), &[&claimed])?;
        self.encloses(piece, &basin, &claimed, &centre, &round)
    }

    /// Whether the impacts are claimed to be first contacts.
    pub(super) fn is_physical(&self) -> bool {
        self.claim.physical == Some(true)
    }

    fn guess(&self, frame: &Frame) -> [Real; 2] {
        let first = self.first(frame);
        [first.phase.centre, first.velocity.centre]
    }

    /// A round near the claimed impacts.
    fn period<'p>(&'p self, frame: &'p Frame) -> Result<Round<'p>, Doubt> {
        Ok(self.round(frame, self.times(frame)?, self.is_physical()))
    }

    /// Approximate durations of the flights between the claimed impacts: from the drifts, or where these do not fit from the claimed `cycle`s.
    pub(super) fn times(&self, frame: &Frame) -> Result<Vec<Real>, Doubt> {
        let times = self.drifting_times(frame).or_else(|| self.counted_times(frame));
        let bits = frame.turn.bits();
        let exact = |time: f64| impact_pair_exact::Dyadic::from_f64(time).map(|time| Real::point(time, bits));
        let times = times.and_then(|times| times.into_iter().map(exact).collect());
        times.ok_or_else(|| {
            Doubt::open("the claimed impacts do not follow one another in this number of forcing periods")
        })
    }

    /// The durations by `cycle` and `phase` of the impacts; `None` where a `cycle` is not claimed. Lemma T13
    fn counted_times(&self, frame: &Frame) -> Option<Vec<f64>> {
        let impacts = &self.claim.impacts;
        let turn = frame.turn.to_f64();
        let at = |impact: &Passage| {
            let phase = hull(&impact.phase.each_ref().map(|phase| Real::rational(phase, frame.turn.bits())));
            Some(impact.cycle? as f64 * turn + phase.to_f64()) // proposes
        };
        let places = impacts.iter().map(at).collect::<Option<Vec<_>>>()?;
        let again = places[0] + self.cycles as f64 * turn; // proposes
        let next = places.iter().skip(1).copied().chain([again]);
        Some(places.iter().zip(next).map(|(from, to)| to - from).collect())
    }

    /// The durations by the drifts: the phases are given modulo forcing periods.
    fn drifting_times(&self, frame: &Frame) -> Option<Vec<f64>> {
        let bits = frame.turn.bits();
        let common = frame.turn.to_f64() * self.turns.to_string().parse::<f64>().ok()?; // proposes
        let float = |x: Real| Real::point(x.mid(), bits).to_f64();
        let count = self.claim.impacts.len();
        let (mut times, mut whole) = (Vec::new(), 0.0);
        for (from, to) in (0..count).map(|i| (i, (i + 1) % count)) {
            let [from, to] = [from, to].map(|i| self.state(frame, i));
            let departure = Launch::rebound(&frame.parameters, &from);
            let shaking = frame.parameters.shaking(&departure.phase.centre, |x| x.centre.clone());
            let half_gap = float(frame.parameters.half_gap.centre.clone());
            let level = |wall| if wall == Wall::Right { half_gap } else { -half_gap };
            let turned = to.phase.centre.clone() - &from.phase.centre;
            let least = float(turned.clone()).rem_euclid(common); // proposes
            let drift = float(departure.velocity.centre.clone() + &shaking.first_velocity());
            let shift = float(shaking.shift(&Real::point(turned.mid(), bits)));
            let more = ((level(to.wall) - level(from.wall) + shift) / drift - least) / common;
            // proposes: a time near a whole number of periods may be a period off
            let time = least + common * if more.is_finite() { more.round().max(-1.0) } else { 0.0 };
            whole += time;
            times.push(time);
        }
        let periods = whole / frame.turn.to_f64();
        // proposes: durations that do not fit the claimed cycles do not prove the orbit either
        ((periods - self.cycles as f64).abs() < 0.5).then_some(times)
    }
}
