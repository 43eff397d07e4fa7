//! Check of the impacts of a sweep's points: each orbit is followed from its exact start, and compared after the transient.

use super::budget::Budget;
use super::contact::Doubt;
use super::data::{Data, Piece};
use super::points::{Found, Tally, is_placed};
use super::standing::Last;
use super::step::Landing;
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
            let mut walk = Walk::new(certificate, data, &Piece::default(), bits);
            match self.follow(&mut walk) {
                Ok(()) => return Ok(bits),
                // More bits have not helped.
                Err(doubt @ Doubt::Open(_))
                    if before == Some(walk.impacts) || bits >= most || data.budget.is_spent() =>
                {
                    return Err(doubt);
                }
                Err(Doubt::Open(_)) => (before, bits) = (Some(walk.impacts), (2 * bits).min(most)), // proposes: the bits to try
                Err(doubt) => return Err(doubt),
            }
        }
    }

    fn follow(&self, walk: &mut Walk<'_>) -> Result<(), Doubt> {
        let mut states = self.states.iter().peekable();
        if walk.standing.still().is_some() && self.impacts > 0 {
            return Err(Doubt::open("the ball has no drift"));
        }
        let mut may_rest = false;
        while walk.impacts < self.impacts {
            let next = walk.impacts + 1;
            let open = || Doubt::Open(format!("impact {next} is not found: a graze, a rest, or it takes more bits"));
            let landing = walk.next_landing().ok_or_else(open)?;
            // Unlisted bounces of a chatter that ends in a rest have no number: all later impacts are counted wrongly here.
            may_rest |= walk.standing.last() == Last::Wall(landing.wall);
            if let Some(state) = states.next_if(|state| state.index == next) {
                let phase = self.phase_of(walk, &landing)?;
                compare_state(state, walk, &landing, phase).map_err(|doubt| match doubt {
                    Doubt::False(message) if may_rest => {
                        Doubt::Open(format!("{message}, or a rest comes before, whose bounces are not counted"))
                    }
                    doubt => doubt,
                })?;
            }
            walk.go_on(landing);
            walk.data.budget.allow(walk.bits, walk.data.tones.len());
        }
        Ok(())
    }
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
