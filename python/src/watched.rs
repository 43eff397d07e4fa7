//! Long computations without the GIL, on a separate thread, while the calling one handles Ctrl-C and progress.

use std::ops::ControlFlow;
use std::panic;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use impact_pair::watch::{Stage, Watch, proceed_if};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::errors::Fault;

/// Between two looks at signals and progress.
const POLL_INTERVAL: Duration = Duration::from_millis(50);
/// Bytes of the thread's stack: as a program's own.
const STACK_BYTES: usize = 8 << 20;

/// The progress of a computation, and a flag that stops it.
#[derive(Debug, Default)]
pub struct Monitor {
    stopped: AtomicBool,
    done: AtomicU64,
}

impl Monitor {
    /// Notes the number of items done.
    pub fn report(&self, done: u64) {
        self.done.store(done, Ordering::Relaxed);
    }

    /// Notes that one more is done.
    pub fn add_one(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }
}

impl Monitor {
    /// Returns whether it was stopped: by Ctrl-C, or because `progress` raised.
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

impl Watch for Monitor {
    /// Continues until Ctrl-C comes, or `progress` raises.
    fn proceed(&self, at: Stage<'_>) -> ControlFlow<()> {
        match at {
            Stage::Impact(done) | Stage::Searched(done) | Stage::Cones(done) | Stage::Horseshoe { boxes: done, .. } => {
                self.report(done)
            }
            Stage::Parameter(done) => self.report(done.into()),
            Stage::Cells { done, .. } | Stage::Region(done) | Stage::Sets(done) | Stage::Claims(done) => {
                self.report(done as u64)
            }
            Stage::Cycles { impacts, .. } => self.report(impacts as u64),
            _ => {}
        }
        proceed_if(!self.is_stopped())
    }
}

/// Does the work; `progress` is called at intervals with the amount done. Ctrl-C stops the work, and its result is what is
/// certified until then; a second one, or a `progress` that raises, drops it.
pub fn watched<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&Monitor) -> Result<T, Fault> + Send,
) -> PyResult<T> {
    watch(py, progress, true, work)
}

/// The same for work of which a part is of no use: Ctrl-C drops it.
pub fn watched_whole<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&Monitor) -> Result<T, Fault> + Send,
) -> PyResult<T> {
    watch(py, progress, false, work)
}

fn watch<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    keeps_parts: bool,
    work: impl FnOnce(&Monitor) -> Result<T, Fault> + Send,
) -> PyResult<T> {
    let monitor = Monitor::default();
    py.detach(|| {
        thread::scope(|scope| {
            let (send, receive) = channel();
            let at_work = || {
                // The receiver is gone only if no result is wanted any more.
                let _ = send.send(work(&monitor));
                drop(send);
            };
            let thread = thread::Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, at_work)?;
            let mut interruption = None;
            loop {
                match receive.recv_timeout(POLL_INTERVAL) {
                    Ok(found) => return found.map_err(|fault| interruption.unwrap_or_else(|| fault.into())),
                    Err(RecvTimeoutError::Disconnected) => {
                        let Err(panicked) = thread.join() else { unreachable!("it sends what it found") };
                        panic::resume_unwind(panicked)
                    }
                    Err(RecvTimeoutError::Timeout) => {
                        let outcome = Python::attach(|py| {
                            py.check_signals()?;
                            let done = monitor.done.load(Ordering::Relaxed);
                            progress.as_ref().map_or(Ok(()), |progress| progress.call1(py, (done,)).map(drop))
                        });
                        let Err(error) = outcome else { continue };
                        monitor.stopped.store(true, Ordering::Relaxed);
                        if !keeps_parts || interruption.is_some() || !is_interruption(&error) {
                            return Err(error);
                        }
                        interruption = Some(error);
                    }
                }
            }
        })
    })
}

/// Returns whether an error is Ctrl-C.
fn is_interruption(error: &PyErr) -> bool {
    Python::attach(|py| error.is_instance_of::<PyKeyboardInterrupt>(py))
}
