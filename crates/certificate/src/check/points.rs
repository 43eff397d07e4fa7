//! Verdicts on the points of a grid, one after another: of a sweep or an atlas.

use super::contact::Doubt;
use super::{Finding, Verdict};
use impact_pair_model::watch::{Stage, Watch};

/// The verdicts on the points so far.
#[derive(Default)]
pub(super) struct Tally {
    most: u32,
    open: Option<Finding>,
    confirmed: usize,
    /// Number of points that are confirmed without a gap from the first point on.
    certain: usize,
}

/// The verdict on all points, and how many points are confirmed without a gap from the first point on.
pub(super) type Found = (Verdict, usize);

impl Tally {
    /// Records the verdict on a claim of a point.
    ///
    /// # Errors
    /// The verdict on all points, if no more points are to be checked.
    pub fn note(&mut self, event: usize, verdict: Verdict) -> Result<(), Found> {
        match verdict {
            Verdict::Confirmed { bits, .. } => {
                self.most = self.most.max(bits); // exact: what is shown
                self.confirmed += 1;
                Ok(())
            }
            Verdict::Undecided(finding) => {
                self.open.get_or_insert(Finding { event, ..finding });
                Ok(())
            }
            Verdict::Refuted(finding) => Err((Verdict::Refuted(Finding { event, ..finding }), self.certain)),
            Verdict::Interrupted { .. } => Err((Verdict::Interrupted { events: self.confirmed }, self.certain)),
        }
    }

    /// Ends a point.
    pub fn end(&mut self, event: usize, watch: &dyn Watch) {
        self.certain += usize::from(self.open.is_none()); // exact: a count
        watch.note(Stage::Claims(event + 1));
    }

    /// The verdict on all claims: `claims` claims of the kind `what` at `points` points, of which `missing` may be missing.
    pub fn verdict(self, (claims, what): (usize, &str), points: usize, missing: u64) -> Found {
        let Self { most, open, confirmed, certain } = self;
        let undecided = |event, message: String| Verdict::Undecided(Finding { event, message });
        let verdict = match open {
            Some(Finding { event, message }) => {
                undecided(event, format!("{message}; {confirmed} of {claims} {what} confirmed"))
            }
            None if confirmed == 0 => undecided(0, "there is no point to check".to_owned()),
            // An interrupted computation, or lines are lost.
            None if missing > 0 => {
                undecided(points, format!("points missing: {missing}; the {confirmed} that are there are confirmed"))
            }
            None => Verdict::Confirmed { bits: most, pieces: 1 },
        };
        (verdict, certain)
    }
}

/// Proves that a point has its place in the grid: its document does not contradict itself, and its values are values of the grid.
pub(super) fn is_placed(contradiction: Option<&str>, is_of_grid: Option<bool>) -> Result<(), Doubt> {
    match (contradiction, is_of_grid) {
        (Some(message), _) => Err(Doubt::False(message.to_owned())),
        (None, Some(true)) => Ok(()),
        (None, Some(false)) => Err(Doubt::False("its values are not those of the grid".to_owned())),
        (None, None) => Err(Doubt::open("its values are not proved to be those of the grid")),
    }
}
