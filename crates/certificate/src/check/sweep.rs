//! Check of the impacts of a sweep's points: each orbit is followed from its exact start, and compared after the transient.

use super::budget::Budget;
use super::contact::Doubt;
use super::data::{Data, Piece};
use super::points::{Found, Tally, is_placed};
use super::rest::Rest;
use super::step::Landing;
use super::unlisted::Unlisted;
use super::walk::{Walk, compare};
use super::{FIRST_BITS, Limits, Verdict};
use crate::Certificate;
use crate::attraction::Bounds;
use crate::sweep::{ClaimedOrbit, SweepCertificate};
use impact_pair_document::SweepImpact;
use impact_pair_exact::Real;
use impact_pair_model::Error;
use impact_pair_model::watch::{Latched, Watch};

impl SweepCertificate {
    /// Proves the impacts of every point again, or names a point where they are refuted or undecided. The watch can stop the check and
    /// receives the number of points checked so far.
    ///
    /// # Errors
    /// Returns an error if a scene's values are beyond the range of exact expressions.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        Ok(self.judge_within(limits, watch)?.0)
    }

    /// The verdict, and how many points are confirmed without a gap from the first point on.
    pub(crate) fn judge_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Found, Error> {
        let watch = Latched::new(watch);
        let mut tally = Tally::default();
        for (event, point) in self.points.iter().enumerate() {
            let budget = Budget::new(limits.work, limits.parts, &watch);
            let certificate = Certificate::of_start(point.pair.clone(), point.start.clone());
            let data = Data { budget: budget.clone(), ..Data::new(&point.pair, &point.start)? };
            let verdict = match point.judged(&certificate, &data, limits.bits) {
                Ok(bits) => Verdict::Confirmed { bits, pieces: 1 },
                Err(Doubt::Open(_)) if budget.is_stopped() => Verdict::Interrupted { events: 0 },
                Err(doubt) => doubt.on(event),
            };
            if let Err(found) = tally.note(event, verdict) {
                return Ok(found);
            }
            tally.end(event, &watch);
        }
        Ok(tally.verdict((self.count(), "points"), self.count(), self.missing))
    }
}

impl ClaimedOrbit {
    /// Proves that the impacts are as claimed, and returns the bits used, at most `most`.
    fn judged(&self, certificate: &Certificate, data: &Data, most: u32) -> Result<u32, Doubt> {
        is_placed(self.contradiction, self.is_of_grid)?;
        if self.is_shadowed {
            return Err(Doubt::open("only orbits from their exact starts are checked in sweeps"));
        }
        if !data.is_point() {
            return Err(Doubt::open("only points whose data are numbers are checked"));
        }
        let (mut bits, mut before) = (FIRST_BITS, None);
        loop {
            let mut motion = Unlisted::new(Walk::new(certificate, data, &Piece::default(), bits));
            match self.follow(&mut motion) {
                Ok(()) => return Ok(bits),
                // More bits have not helped.
                Err(doubt @ Doubt::Open(_))
                    if before == Some(motion.walk.impacts) || bits >= most || data.budget.is_spent() =>
                {
                    return Err(doubt);
                }
                Err(Doubt::Open(_)) => (before, bits) = (Some(motion.walk.impacts), (2 * bits).min(most)), // proposes: the bits to try
                Err(doubt) => return Err(doubt),
            }
        }
    }

    /// Follows the motion until all listed impacts are found, one after another. Lemma V42
    fn follow(&self, motion: &mut Unlisted<'_>) -> Result<(), Doubt> {
        if motion.walk.standing.still().is_some() && self.impacts > 0 {
            return Err(Doubt::open("the ball has no drift"));
        }
        if self.states.is_empty() {
            return self.counts(motion);
        }
        let mut found = 0;
        while let Some(state) = self.states.get(found) {
            match self.find(motion, state, found > 0) {
                Ok(()) => found += 1,
                // V42: the list may begin later, where as many bounces as it takes came before
                Err(Doubt::False(_)) if motion.is_free() => found = 0,
                Err(doubt) => return Err(doubt),
            }
        }
        Ok(())
    }

    /// Follows the motion until a list may have as many impacts as claimed.
    fn counts(&self, motion: &mut Unlisted<'_>) -> Result<(), Doubt> {
        while !motion.may_count(self.impacts) {
            match motion.rest().cloned() {
                Some(rest) => motion.leave(&rest)?,
                None => {
                    let landing = next_impact(motion, self.impacts)?;
                    motion.go_on(landing);
                }
            }
        }
        Ok(())
    }

    /// Follows the motion until the impact that is listed as `state`: the next one if the list has the one before.
    fn find(&self, motion: &mut Unlisted<'_>, state: &SweepImpact<Bounds>, is_next: bool) -> Result<(), Doubt> {
        loop {
            if let Some(rest) = motion.rest().filter(|rest| !may_be_bounce(state, motion, rest)).cloned() {
                motion.leave(&rest)?;
                continue;
            }
            let landing = next_impact(motion, state.index)?;
            let found = (is_next || motion.may_be_next(state.index)).then(|| {
                let phase = self.phase_of(&motion.walk, &landing)?;
                compare_state(state, &motion.walk, &landing, phase)
            });
            motion.go_on(landing);
            match found {
                Some(Ok(())) => return Ok(()),
                // Bounces of a complete chatter have no number.
                Some(Err(Doubt::False(message))) if motion.has_bounced() && !motion.is_free() => {
                    let reason = "or a rest comes before, whose bounces are not counted";
                    return Err(Doubt::Open(format!("{message}, {reason}")));
                }
                Some(Err(doubt)) => return Err(doubt),
                None => {}
            }
        }
    }
}

/// The next impact, if a list may have it with a number up to `index`.
fn next_impact(motion: &Unlisted<'_>, index: u64) -> Result<Landing, Doubt> {
    let landing = if motion.least() < index { motion.next_landing() } else { None };
    let Walk { data, bits, .. } = &motion.walk;
    data.budget.allow(*bits, data.tones.len());
    landing.ok_or_else(|| {
        let next = motion.least() + 1;
        Doubt::Open(format!("impact {next} is not found: a graze, a rest, or it takes more bits"))
    })
}

/// Whether a listed impact may be one of the bounces up to a rest, which become slower. Non-rigorous.
fn may_be_bounce(state: &SweepImpact<Bounds>, motion: &Unlisted<'_>, rest: &Rest) -> bool {
    let bits = motion.walk.bits;
    let [lower, upper] = state.velocity.each_ref().map(|x| Real::rational(x, bits));
    let claimed = lower.hull(&upper).to_f64().abs(); // proposes
    let last = motion.walk.standing.landing().map(|landing| motion.walk.clock.velocity(&landing.velocity.hull()));
    let is_slower = last.is_none_or(|last| claimed < last.to_f64().abs()); // proposes
    motion.is_chatter() && state.wall == rest.wall && is_slower
}

impl ClaimedOrbit {
    /// Phase of an impact relative to the term `W', tau'`: from `W t + tau` it is `(W t + tau - tau) W'/W + tau'`.
    fn phase_of(&self, walk: &Walk<'_>, landing: &Landing) -> Result<Real, Doubt> {
        let found = walk.absolute(&landing.phase.hull());
        let Some(reference) = &self.reference else { return Ok(found) };
        let (own, bits) = (self.pair.excitation().reference(), found.bits());
        let since = found - &Real::of(own.phase(), bits);
        let rate = Real::of(reference.frequency(), bits).over(&Real::of(own.frequency(), bits));
        let rate = rate.ok_or_else(|| Doubt::open("the frequencies are too far apart"))?;
        Ok(since * &rate + &Real::of(reference.phase(), bits))
    }
}

/// Compares a claimed impact with the enclosed impact, whose phase is `found`.
fn compare_state(claimed: &SweepImpact<Bounds>, walk: &Walk<'_>, landing: &Landing, found: Real) -> Result<(), Doubt> {
    let SweepImpact { index, wall, phase, velocity } = claimed;
    if *wall != landing.wall {
        return Err(Doubt::False(format!("impact {index} is on the other wall")));
    }
    let bits = walk.bits;
    let turn = Real::pi(bits) * 2;
    let [lower, upper] = phase.each_ref().map(|phase| Real::rational(phase, bits));
    if lower.is_negative() || turn.is_below(&lower) {
        return Err(Doubt::False(format!("the phase of impact {index} is not in [0, 2 pi)")));
    }
    let ahead = (found.clone() - &lower.hull(&upper).middle()).over(&turn);
    let half = Real::int(1, bits).half();
    // V6: any whole number of periods
    let turns = ahead.and_then(|ahead| (ahead.middle() + &half).floor());
    let turns = turns.ok_or_else(|| Doubt::open("a phase is too large"))?;
    let wide = Real::pi(found.bits()) * 2;
    let named = |doubt: Doubt| match doubt {
        Doubt::Open(message) => Doubt::Open(format!("impact {index}: {message}")),
        Doubt::False(message) => Doubt::False(format!("impact {index}: {message}")),
    };
    compare("phase", &(found - &(wide * turns)), phase).map_err(named)?;
    compare("velocity", &walk.clock.velocity(&landing.velocity.hull()), velocity).map_err(named)
}
