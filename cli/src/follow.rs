//! An orbit followed to its end, or until the user has seen enough.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering;

use impact_pair::orbit::{Impact, Orbit, Progress as Step};

use crate::progress::{Progress, interruption};

/// Hands each impact of the orbit to `each`, until it breaks off, the orbit ends or Ctrl-C comes; in the last case the
/// orbit has no outcome.
pub fn follow<B>(
    orbit: &mut Orbit,
    progress: &Progress,
    mut each: impl FnMut(&Orbit, Impact) -> ControlFlow<B>,
) -> ControlFlow<B> {
    let interrupted = interruption();
    while !interrupted.load(Ordering::Relaxed) {
        match orbit.advance() {
            Step::Impact(impact) => {
                let index = impact.index;
                each(orbit, impact)?;
                progress.reach(index);
            }
            Step::Retraced(index) => progress.retrace(index, orbit.bits()),
            Step::Ended => break,
        }
    }
    ControlFlow::Continue(())
}
