//! Whether the points of an atlas are right: the global analysis of each is proved again (Lemma V25).

use super::{Effort, Finding, Verdict};
use crate::atlas::{AtlasCertificate, ClaimedPoint};
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
            if point.claims_something() {
                match point.judged(effort, &watch)? {
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
                undecided(event, format!("{message}; {confirmed} of {} points confirmed", self.count()))
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
    /// Where every motion goes is as claimed.
    fn judged(&self, effort: &Effort, watch: &dyn Watch) -> Result<Verdict, Error> {
        let finding = |message: &str| Finding { event: 0, message: message.to_owned() };
        if let Some(message) = self.contradiction {
            return Ok(Verdict::Refuted(finding(message)));
        }
        match self.is_of_grid {
            Some(true) => self.global.check_within(effort, &Silent(watch)),
            Some(false) => Ok(Verdict::Refuted(finding("its values are not those of the grid"))),
            None => Ok(Verdict::Undecided(finding("its values are not proved to be those of the grid"))),
        }
    }
}
