//! Who looks on while an orbit is followed, and may stop it.

use std::ops::ControlFlow;

use super::{Impact, Orbit, Progress};

/// Observes the progress of an orbit, and decides whether to continue.
///
/// A closure returns only whether to continue; `&|| true` follows orbits to their ends.
pub trait Watch {
    /// Whether to go on; asked before each event.
    fn goes_on(&self) -> bool;

    /// Another orbit begins, for `what`.
    fn stage(&self, _what: &str) {}

    /// Impact `index` is there.
    fn reached(&self, _index: u64) {}

    /// Impact `index`, listed before, was computed anew, with so many bits for the first one.
    fn retraced(&self, _index: u64, _bits: u32) {}
}

impl<F: Fn() -> bool> Watch for F {
    fn goes_on(&self) -> bool {
        self()
    }
}

impl Orbit {
    /// Hands each event to `each`, until it breaks off, the orbit ends or the watch says so; in the last case the orbit has
    /// no outcome.
    pub fn follow<B>(
        &mut self,
        watch: &dyn Watch,
        mut each: impl FnMut(&Self, Progress) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        while watch.goes_on() {
            match self.advance() {
                Progress::Impact(impact) => {
                    let index = impact.index;
                    each(self, Progress::Impact(impact))?;
                    watch.reached(index);
                }
                Progress::Retraced(index) => watch.retraced(index, self.bits()),
                Progress::Ended => break,
                event @ (Progress::Graze(_) | Progress::Rest(_) | Progress::Release(_)) => each(self, event)?,
            }
        }
        ControlFlow::Continue(())
    }

    /// Returns the same for the impacts alone, to the end or the watch's.
    pub fn follow_impacts(&mut self, watch: &dyn Watch, mut each: impl FnMut(&Self, Impact) -> ControlFlow<()>) {
        let _ = self.follow(watch, |orbit, step| match step {
            Progress::Impact(impact) => each(orbit, impact),
            _ => ControlFlow::Continue(()),
        });
    }
}
