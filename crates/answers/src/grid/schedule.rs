//! The points that are left, computed by threads.

use std::sync::Mutex;
use std::thread;

use anyhow::{Context, Result};
use impact_pair::sweep::Head;
use impact_pair::watch::Watch;
use rayon::prelude::*;

use super::journal::Journal;

/// What computes a point by its number: its record as one line; `None` if the watch stopped it before it was done.
pub type Task<'t> = &'t (dyn Fn(u64) -> Result<Option<String>> + Sync);

/// Computes the points that a journal lacks, by this number of threads or one for each processor, until all are done or the watch stops it; `done` is
/// called after each point that is kept.
///
/// # Errors
/// The first error of a point, or of the journal.
pub fn complete<H: Head + Send>(
    journal: &mut Journal<H>,
    threads: Option<usize>,
    task: Task<'_>,
    (watch, done): (&dyn Watch, &(dyn Fn() + Sync)),
) -> Result<()> {
    let left = journal.missing();
    let threads = threads.unwrap_or_else(|| thread::available_parallelism().map_or(1, usize::from));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.context("cannot start the threads")?;
    let journal = Mutex::new(journal);
    let each = |&point: &u64| {
        // Once it is stopped not even the first impact of another point is looked for.
        if !watch.goes_on() {
            return Ok(());
        }
        let Some(line) = task(point)? else { return Ok(()) };
        journal.lock().expect("no thread has panicked").add(point, &line).context("cannot write a finished point")?;
        done();
        Ok(())
    };
    // A point at a time, so that no thread is left with the slow ones.
    pool.install(|| left.par_iter().with_max_len(1).try_for_each(each))
}
