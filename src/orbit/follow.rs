//! Following an orbit under a watch.

use std::ops::ControlFlow;

use super::{Impact, Orbit, Progress};
use crate::watch::{Stage, Watch};

impl Orbit {
    /// Passes each event to `each`, until it breaks off, the orbit ends or the watch stops it; in the last case the orbit has
    /// no outcome, and goes on where it is followed again.
    pub fn follow<B>(
        &mut self,
        watch: &dyn Watch,
        mut each: impl FnMut(&Self, Progress) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let mut at = Stage::Working;
        while watch.proceed(at).is_continue() {
            at = match self.advance_within(watch) {
                Progress::Impact(impact) => {
                    let index = impact.index;
                    each(self, Progress::Impact(impact))?;
                    Stage::Impact(index)
                }
                Progress::Retraced(index) => Stage::Retraced { index, bits: self.bits() },
                Progress::Ended => break,
                event @ (Progress::Graze(_) | Progress::Rest(_) | Progress::Release(_)) => {
                    each(self, event)?;
                    Stage::Working
                }
            };
        }
        ControlFlow::Continue(())
    }

    /// Passes the impacts alone to `each`, until it breaks off, the orbit ends or the watch stops it.
    pub fn follow_impacts(&mut self, watch: &dyn Watch, mut each: impl FnMut(&Self, Impact) -> ControlFlow<()>) {
        let _ = self.follow(watch, |orbit, step| match step {
            Progress::Impact(impact) => each(orbit, impact),
            _ => ControlFlow::Continue(()),
        });
    }
}
