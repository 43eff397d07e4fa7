//! Numbers of points of each outcome.

use anyhow::Result;
use impact_pair::json::vocabulary::PointOutcome;
use impact_pair::json::{SweepHead, counted};

use crate::Status;
use crate::grid::{Points, Tally};

/// The numbers of points by outcome.
pub(super) struct Outcomes {
    outcomes: Vec<(PointOutcome, u64)>,
    /// Number of points at which not everything requested is proved.
    incomplete: u64,
    certified: bool,
}

impl Tally for SweepHead {
    fn tally(points: &mut Points<Self>) -> Result<Status> {
        Outcomes::of(points).map(|outcomes| outcomes.status())
    }
}

impl Outcomes {
    /// Counts the points that are there.
    pub fn of(points: &mut Points<SweepHead>) -> Result<Self> {
        let mut found = Self { outcomes: Vec::new(), incomplete: 0, certified: points.head.certified };
        points.each_record(|record| {
            match found.outcomes.iter_mut().find(|(known, _)| *known == record.outcome) {
                Some((_, count)) => *count += 1,
                None => found.outcomes.push((record.outcome, 1)),
            }
            found.incomplete += u64::from(!record.complete);
            Ok(())
        })?;
        found.outcomes.sort();
        Ok(found)
    }

    /// The counts in one line.
    pub fn status(&self) -> Status {
        let points: u64 = self.outcomes.iter().map(|(_, count)| count).sum();
        let outcomes: Vec<String> = self.outcomes.iter().map(|(outcome, count)| format!("{count} {outcome}")).collect();
        let word = match (self.certified, self.incomplete) {
            (false, _) => "computed, not certified".to_owned(),
            (true, 0) => "certified".to_owned(),
            (true, some) => format!("not all certified, {some} incomplete"),
        };
        let outcomes = outcomes.join(", ");
        Status::new(self.incomplete == 0, format!("{word}: {}, {outcomes}", counted(points, "point")))
    }
}
