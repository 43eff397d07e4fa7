//! Check of a JSON of windows: each orbit is proved again as in a periodic JSON (Lemma V8), and both ends of its window
//! as points of a bifurcation JSON, starting from the window's orbit (Lemma V9). Then all orbits between are proved to be stable
//! ([`stable`], Lemma V30).

mod between;
mod cell;
mod image;
mod map;
mod stable;

use std::cmp::Ordering;

use super::bifurcation::ParameterFamily;
use super::budget::Budget;
use super::contact::Doubt;
use super::cycles::may_be_same;
use super::{DocumentCheck, Limits, Verdict};
use crate::bifurcation::ClaimedPoint;
use crate::windows::{ClaimedWindow, WindowsCertificate};
use impact_pair_model::Error;
use impact_pair_model::watch::{Silent, Watch};

impl WindowsCertificate {
    /// Proves each orbit and the ends of its window again, or names a window that is refuted or undecided. The watch can stop the check
    /// and receives the number of windows confirmed so far.
    ///
    /// # Errors
    /// None: a value beyond the range of exact expressions leaves a window undecided.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let over = ParameterFamily { pair: &self.pair, start: &self.start, key: self.over };
        let whole = DocumentCheck {
            contradiction: self.contradiction.as_deref(),
            alike: (!self.are_different()).then_some("two windows may be one"),
            count: self.count(),
            nothing: "there is no window to check",
        };
        let claims = self.windows.iter().enumerate();
        Ok(whole.judged(claims, limits, watch, |window, budget, watch| window.judged(&over, (limits, budget), watch)))
    }
}

impl WindowsCertificate {
    /// Whether all windows are proved to be different.
    fn are_different(&self) -> bool {
        let all = &self.windows;
        (0..all.len()).all(|i| all[..i].iter().all(|other| !all[i].may_be(other)))
    }
}

impl ClaimedWindow {
    /// Whether two windows may be the same, by their claims. Windows along the same flights differ if their orbits at one value differ, or
    /// if one window, proved between its ends, does not hold the other's value. Lemma V30
    fn may_be(&self, other: &Self) -> bool {
        if self.at.compare(&other.at) != Some(Ordering::Equal) {
            return self.has_flights_of(other) && !self.is_without(&other.at) && !other.is_without(&self.at);
        }
        let [own, others] = [self, other].map(|window| &window.orbit.orbits);
        own.iter().any(|one| others.iter().any(|other| may_be_same(&one.orbit, &other.orbit)))
    }
}

impl ClaimedWindow {
    /// Proves that the orbit and the ends are as claimed, and returns the bits used.
    fn judged(
        &self,
        over: &ParameterFamily<'_>,
        (limits, budget): (&Limits, &Budget),
        watch: &dyn Watch,
    ) -> Result<u32, Doubt> {
        if !self.is_stable() {
            return Err(Doubt::False("only stable orbits have a window".into()));
        }
        let orbit = self.orbit.check_within(limits, &Silent(watch)).map_err(|error| Doubt::Open(error.to_string()))?;
        let mut most = match orbit {
            Verdict::Confirmed { bits, .. } => bits,
            Verdict::Refuted(finding) => return Err(Doubt::False(finding.message)),
            Verdict::Undecided(finding) => return Err(Doubt::Open(finding.message)),
            Verdict::Interrupted { .. } => return Err(Doubt::open("interrupted")),
        };
        for end in &self.ends {
            budget.add(limits.work);
            most = most.max(end.judged(over, budget, ClaimedPoint::compare_parameter)?); // shown
        }
        if self.stable_between {
            budget.add(limits.work);
            most = most.max(self.is_stable_between(over, budget)?); // shown
        }
        Ok(most)
    }
}
