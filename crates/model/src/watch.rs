//! Progress of long computations, and their interruption: [`Watch`].

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// The progress of a computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage<'s> {
    /// Work between two steps, with no new count.
    Working,
    /// A part of the computation begins, of this name.
    Part(&'s str),
    /// Impact `.0` of an orbit is computed.
    Impact(u64),
    /// An impact computed before is computed again, in higher precision.
    Retraced {
        /// The index of the impact.
        index: u64,
        /// The precision of the first impact, in bits.
        bits: u32,
    },
    /// Cells of the state space are searched for periodic orbits.
    Cells {
        /// Number of cells that are done.
        done: usize,
        /// Number of all cells.
        of: usize,
    },
    /// A trapping region has `.0` boxes so far.
    Region(usize),
    /// The words of walls in a trapping region have led to `.0` sets of its boxes.
    Sets(usize),
    /// Periodic orbits of one period of the impact map are searched for in a trapping region.
    Cycles {
        /// The period: the number of impacts.
        impacts: usize,
        /// Number of blocks of the region that are done.
        blocks: usize,
        /// Number of all blocks.
        of: usize,
    },
    /// Covering relations are proved.
    Horseshoe {
        /// Impacts of the words; 0 during the search for h-sets.
        depth: usize,
        /// Boxes.
        boxes: u64,
    },
    /// `.0` cells of a hyperbolic set, with cones, are cut.
    Cones(u64),
    /// `.0` cells of a parameter's range are done.
    Parameter(u32),
    /// `.0` impacts of floating-point orbits are searched for stable periodic orbits.
    Searched(u64),
    /// Windows of stable periodic orbits are proved.
    Windows {
        /// Number of orbits that are done.
        proved: usize,
        /// Number of all orbits.
        of: usize,
    },
    /// `.0` pieces of unstable manifolds are searched for homoclinic tangencies.
    Folds(u64),
    /// Homoclinic tangencies are proved.
    Tangencies {
        /// Number of tangencies that are done.
        proved: usize,
        /// Number of all tangencies.
        of: usize,
    },
    /// `.0` claims of a document are confirmed.
    Claims(usize),
}

/// Observes a computation, and decides whether it continues.
///
/// Any thread of the computation may call it, often. A computation that was stopped returns what it has certified until then.
///
/// ```
/// use std::ops::ControlFlow;
/// use impact_pair_model::watch::{Stage, Watch, proceed_if};
/// let watch = |at: Stage<'_>| proceed_if(!matches!(at, Stage::Region(boxes) if boxes > 1000));
/// assert_eq!(watch.proceed(Stage::Region(10)), ControlFlow::Continue(()));
/// assert_eq!(watch.proceed(Stage::Region(2000)), ControlFlow::Break(()));
/// ```
pub trait Watch: Sync {
    /// Reports progress; returns whether the computation continues.
    fn proceed(&self, at: Stage<'_>) -> ControlFlow<()>;

    /// Whether the computation continues, without a report of progress.
    fn goes_on(&self) -> bool {
        self.proceed(Stage::Working).is_continue()
    }

    /// Reports progress; the decision whether to continue comes later.
    fn note(&self, at: Stage<'_>) {
        let _ = self.proceed(at);
    }
}

impl<F: Fn(Stage<'_>) -> ControlFlow<()> + Sync> Watch for F {
    fn proceed(&self, at: Stage<'_>) -> ControlFlow<()> {
        self(at)
    }
}

/// The answer of a [`Watch`], from whether the computation continues.
pub fn proceed_if(goes_on: bool) -> ControlFlow<()> {
    if goes_on { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
}

/// A watch that never stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn proceed(&self, _: Stage<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// A watch that hides progress and only decides whether to continue.
pub struct Silent<'w>(pub &'w dyn Watch);

impl Watch for Silent<'_> {
    fn proceed(&self, _: Stage<'_>) -> ControlFlow<()> {
        self.0.proceed(Stage::Working)
    }
}

/// A watch that stays stopped once it has stopped.
pub struct Latched<'w> {
    watch: &'w dyn Watch,
    is_stopped: AtomicBool,
}

impl<'w> Latched<'w> {
    /// Latches a watch.
    pub fn new(watch: &'w dyn Watch) -> Self {
        Self { watch, is_stopped: AtomicBool::new(false) }
    }

    /// Whether the watch has stopped, without calling it.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }
}

impl Watch for Latched<'_> {
    fn proceed(&self, at: Stage<'_>) -> ControlFlow<()> {
        if self.is_stopped() {
            return ControlFlow::Break(());
        }
        let answer = self.watch.proceed(at);
        self.is_stopped.fetch_or(answer.is_break(), Ordering::Relaxed);
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stopped_watch_stays_stopped() {
        let watch = |at: Stage<'_>| proceed_if(at != Stage::Claims(3));
        let latched = Latched::new(&watch);
        assert!(latched.goes_on() && !latched.is_stopped());
        assert!(latched.proceed(Stage::Claims(3)).is_break() && latched.is_stopped());
        assert!(!latched.goes_on() && watch.goes_on());
        assert!(Silent(&watch).proceed(Stage::Claims(3)).is_continue());
    }
}
