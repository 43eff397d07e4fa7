//! The points that are left, computed by threads.

use std::sync::Mutex;
use std::thread;

use anyhow::{Context, Result};
use impact_pair::watch::Watch;
use rayon::prelude::*;

use super::journal::Points;
use super::survey::Survey;

/// Computes the points that are missing, by this number of threads or one for each processor, until all are done or the watch stops it; `done` is
/// called after each point that is kept.
///
/// # Errors
/// The first error of a point, or if a point cannot be written.
pub fn complete<S: Survey>(
    survey: &S,
    points: &mut Points<S::Head>,
    threads: Option<usize>,
    (watch, done): (&dyn Watch, &(dyn Fn() + Sync)),
) -> Result<()> {
    let left = points.missing();
    let threads = threads.unwrap_or_else(|| thread::available_parallelism().map_or(1, usize::from));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.context("cannot start the threads")?;
    let journal = Mutex::new(points);
    let each = |&point: &u64| {
        // Once it is stopped not even the first impact of another point is looked for.
        if !watch.goes_on() {
            return Ok(());
        }
        let Some(line) = survey.line(point, watch)? else { return Ok(()) };
        journal.lock().expect("no thread has panicked").add(point, &line).context("cannot write a finished point")?;
        done();
        Ok(())
    };
    // A point at a time, so that no thread is left with the slow ones.
    pool.install(|| left.par_iter().with_max_len(1).try_for_each(each))
}
