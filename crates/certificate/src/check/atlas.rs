//! Whether the points of an atlas are right: the global analysis of each is proved again (Lemma V25), or of each cell, and its stable orbits
//! (Lemma V38).

use super::chaos::has_stable_orbit;
use super::contact::Doubt;
use super::{Effort, Finding, Verdict};
use crate::atlas::{AtlasCertificate, ClaimedPoint, Part};
use impact_pair_model::Error;
use impact_pair_model::watch::{Latched, Silent, Stage, Watch};

impl AtlasCertificate {
    /// Proves what is claimed of every point again, or says of which it is not true or not proved, until the watch stops it, which
    /// receives the points checked so far.
    ///
    /// # Errors
    /// When a scene's values are beyond the range of exact expressions, and with several harmonics.
    pub fn check_within(&self, effort: &Effort, watch: &dyn Watch) -> Result<Verdict, Error> {
        Ok(self.judge_within(effort, watch)?.0)
    }

    /// Returns the verdict, and how many points are confirmed one after another from the first one on.
    pub(crate) fn judge_within(&self, effort: &Effort, watch: &dyn Watch) -> Result<(Verdict, usize), Error> {
        let watch = Latched::new(watch);
        let (mut most, mut open, mut confirmed, mut certain) = (0, None, 0, 0);
        for (event, point) in self.points().iter().enumerate() {
            let parts = match point.placed() {
                Ok(()) => &point.parts[..],
                Err(Doubt::False(message)) => return Ok((Verdict::Refuted(Finding { event, message }), certain)),
                Err(Doubt::Open(message)) => {
                    open = open.or(Some(Finding { event, message }));
                    &[]
                }
            };
            for part in parts.iter().filter(|part| part.claims_something()) {
                match part.judged(effort, &watch)? {
                    Verdict::Interrupted { .. } => return Ok((Verdict::Interrupted { events: confirmed }, certain)),
                    Verdict::Refuted(finding) => {
                        return Ok((Verdict::Refuted(Finding { event, ..finding }), certain));
                    }
                    Verdict::Undecided(finding) => open = open.or(Some(Finding { event, ..finding })),
                    Verdict::Confirmed { bits, .. } => {
                        most = most.max(bits); // exact: what is shown
                        confirmed += 1;
                    }
                }
            }
            certain += usize::from(open.is_none()); // exact: a count
            watch.note(Stage::Claims(event + 1));
        }
        let undecided = |event, message: String| Verdict::Undecided(Finding { event, message });
        let verdict = match open {
            Some(Finding { event, message }) => {
                let (all, what) = if self.has_cells() { (self.claimed(), "cells") } else { (self.count(), "points") };
                undecided(event, format!("{message}; {confirmed} of {all} {what} confirmed"))
            }
            None if confirmed == 0 => undecided(0, "there is no point to check".to_owned()),
            // An interrupted atlas, or lines are lost.
            None if self.missing() > 0 => {
                let missing = self.missing();
                let message = format!("points missing: {missing}; the {confirmed} that are there are confirmed");
                undecided(self.count(), message)
            }
            None => Verdict::Confirmed { bits: most, pieces: 1 },
        };
        Ok((verdict, certain))
    }
}

impl ClaimedPoint {
    /// It is the point of the grid that it is said to be, or the tile.
    fn placed(&self) -> Result<(), Doubt> {
        if let Some(message) = self.contradiction {
            return Err(Doubt::False(message.to_owned()));
        }
        match self.is_of_grid {
            Some(true) => Ok(()),
            Some(false) => Err(Doubt::False("its values are not those of the grid".to_owned())),
            None => Err(Doubt::Open("its values are not proved to be those of the grid".into())),
        }
    }
}

impl Part {
    /// Where every motion goes is as claimed, and the stable orbits are there.
    fn judged(&self, effort: &Effort, watch: &dyn Watch) -> Result<Verdict, Error> {
        let mut confirmed = Verdict::Confirmed { bits: f64::MANTISSA_DIGITS, pieces: 1 };
        if self.global.claims_something() {
            match self.global.check_within(effort, &Silent(watch))? {
                Verdict::Confirmed { bits, pieces } => confirmed = Verdict::Confirmed { bits, pieces },
                verdict => return Ok(verdict),
            }
        }
        for claimed in &self.stable {
            if let Err(doubt) = has_stable_orbit((&self.pair, &self.start), claimed, effort, watch)? {
                return Ok(if watch.goes_on() { doubt.on(0) } else { Verdict::Interrupted { events: 0 } });
            }
        }
        Ok(confirmed)
    }
}
