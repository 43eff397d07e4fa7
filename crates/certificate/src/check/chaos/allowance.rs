//! The work of a check of words, counted and not timed: its answer is the same on every machine.

use std::sync::atomic::{AtomicI64, Ordering};

use impact_pair_model::watch::Watch;

use super::guess::MAX_PERIODS;

/// Why a proof ends before it is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// The user stops it.
    Stopped,
    /// The work that is allowed is done.
    Spent,
}

/// The work that is left, of one thread or of several.
pub(super) struct Allowance<'w> {
    left: AtomicI64,
    watch: &'w dyn Watch,
}

impl<'w> Allowance<'w> {
    /// Returns an allowance of `work`, until the watch stops it.
    pub fn new(work: u64, watch: &'w dyn Watch) -> Self {
        let left = i64::try_from(work).unwrap_or(i64::MAX); // proposes: when to give up
        Self { left: AtomicI64::new(left), watch }
    }

    /// Takes the work of N looks at flights of about M forcing periods.
    pub fn spend(&self, looks: usize, turns: f64) -> Result<(), End> {
        if !self.watch.goes_on() {
            return Err(End::Stopped);
        }
        // proposes: when to give up
        let each = 1 + turns.clamp(0.0, MAX_PERIODS).ceil() as i64; // proposes: when to give up
        let cost = each.saturating_mul(i64::try_from(looks).unwrap_or(i64::MAX)); // proposes: when to give up
        let left = self.left.fetch_sub(cost.min(MAX_WORK), Ordering::Relaxed); // proposes: when to give up
        if left >= cost { Ok(()) } else { Err(End::Spent) }
    }
}

/// The most work taken at once, so that what is left cannot wrap.
const MAX_WORK: i64 = 1 << 40;
