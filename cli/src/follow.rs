//! An orbit followed to its end, or until the user has seen enough.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering;

use impact_pair::orbit::{Impact, Orbit, Progress as Step};

use crate::progress::{Progress, interruption};

/// Hands each event of the orbit to `each`, until it breaks off, the orbit ends or Ctrl-C comes; in the last case the
/// orbit has no outcome.
pub fn follow<B>(
    orbit: &mut Orbit,
    progress: &Progress,
    mut each: impl FnMut(&Orbit, Step) -> ControlFlow<B>,
) -> ControlFlow<B> {
    let interrupted = interruption();
    while !interrupted.load(Ordering::Relaxed) {
        match orbit.advance() {
            Step::Impact(impact) => {
                let index = impact.index;
                each(orbit, Step::Impact(impact))?;
                progress.reach(index);
            }
            Step::Retraced(index) => progress.retrace(index, orbit.bits()),
            Step::Ended => break,
            event @ (Step::Graze(_) | Step::Rest(_) | Step::Release(_)) => each(orbit, event)?,
        }
    }
    ControlFlow::Continue(())
}

/// The same for the impacts alone.
pub fn follow_impacts<B>(
    orbit: &mut Orbit,
    progress: &Progress,
    mut each: impl FnMut(&Orbit, Impact) -> ControlFlow<B>,
) -> ControlFlow<B> {
    follow(orbit, progress, |orbit, step| match step {
        Step::Impact(impact) => each(orbit, impact),
        _ => ControlFlow::Continue(()),
    })
}
