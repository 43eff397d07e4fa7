//! Check of an atlas: the global analysis of each point (Lemma V25) or cell is proved again, and so are its stable orbits
//! (Lemma V38).

use super::chaos::{are_distinct, has_stable_orbit};
use super::points::{Found, Tally, is_placed};
use super::{Limits, Verdict};
use crate::atlas::{AtlasCertificate, Part};
use impact_pair_model::Error;
use impact_pair_model::watch::{Latched, Silent, Watch};

impl AtlasCertificate {
    /// Proves the claims of every point again, or names a point where they are refuted or undecided. The watch can stop the check and
    /// receives the number of points checked so far.
    ///
    /// # Errors
    /// Returns an error if a scene's values are beyond the range of exact expressions, or if it has several harmonics.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        Ok(self.judge_within(limits, watch)?.0)
    }

    /// The verdict, and how many points are confirmed without a gap from the first point on.
    pub(crate) fn judge_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Found, Error> {
        let watch = Latched::new(watch);
        let mut tally = Tally::default();
        for (event, point) in self.points.iter().enumerate() {
            let placed = is_placed(point.contradiction, point.is_of_grid).map_err(|doubt| doubt.on(event));
            let is_there = placed.is_ok();
            let parts = point.parts.iter().filter(|part| is_there && part.claims_something());
            for verdict in placed.err().map(Ok).into_iter().chain(parts.map(|part| part.judged(limits, &watch))) {
                if let Err(found) = tally.note(event, verdict?) {
                    return Ok(found);
                }
            }
            tally.end(event, &watch);
        }
        let claims = if self.has_cells { (self.claimed(), "cells") } else { (self.count(), "points") };
        Ok(tally.verdict(claims, self.count(), self.missing))
    }
}

impl Part {
    /// Proves again that every motion goes where the point claims, and that the stable orbits exist.
    fn judged(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let mut confirmed = Verdict::Confirmed { bits: f64::MANTISSA_DIGITS, pieces: 1 };
        if self.global.claims_something() {
            match self.global.check_within(limits, &Silent(watch))? {
                Verdict::Confirmed { bits, pieces } => confirmed = Verdict::Confirmed { bits, pieces },
                verdict => return Ok(verdict),
            }
        }
        for claimed in &self.stable {
            if let Err(doubt) = has_stable_orbit((&self.pair, &self.start), claimed, limits, watch)? {
                return Ok(if watch.goes_on() { doubt.on(0) } else { Verdict::Interrupted { events: 0 } });
            }
        }
        Ok(are_distinct(&self.stable).map_or_else(|doubt| doubt.on(0), |()| confirmed))
    }
}
