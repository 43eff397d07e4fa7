//! How much work a check of words may take, counted and not timed: its answer is the same on every machine.

use std::sync::atomic::{AtomicBool, AtomicI64, Ordering};

use super::guess::MOST_TURNS;

/// What ends a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// Its user stops it.
    Stopped,
    /// The work that is allowed is done.
    Spent,
}

/// The work that is left, shared by all threads and by all chains of boxes that are tried.
///
/// Whether it suffices for all that is done at one depth depends on nothing else; where it does not, nothing of that depth is kept.
pub(super) struct Allowance {
    left: AtomicI64,
    stop: Option<&'static AtomicBool>,
}

impl Allowance {
    /// So much work, until `stop` is set.
    pub fn new(work: u64, stop: Option<&'static AtomicBool>) -> Self {
        let left = i64::try_from(work).unwrap_or(i64::MAX); // proposes: when to give up
        Self { left: AtomicI64::new(left), stop }
    }

    /// Takes the work of so many looks at flights of about so many forcing periods.
    pub fn spend(&self, looks: usize, turns: f64) -> Result<(), End> {
        if self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
            return Err(End::Stopped);
        }
        // proposes: when to give up
        let each = 1 + turns.clamp(0.0, MOST_TURNS).ceil() as i64; // proposes: when to give up
        let cost = each.saturating_mul(i64::try_from(looks).unwrap_or(i64::MAX)); // proposes: when to give up
        let left = self.left.fetch_sub(cost.min(ALL), Ordering::Relaxed); // proposes: when to give up
        if left >= cost { Ok(()) } else { Err(End::Spent) }
    }

    /// Returns whether none is left.
    pub fn is_spent(&self) -> bool {
        self.left.load(Ordering::Relaxed) <= 0
    }
}

/// No more is taken at once, so that what is left cannot wrap.
const ALL: i64 = 1 << 40;
