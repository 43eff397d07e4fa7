//! The points that are left, computed by all threads.

use std::io::{self, IsTerminal};
use std::sync::Mutex;
use std::time::Duration;

use anyhow::{Context, Error, Result};
use impact_pair::Scene;
use impact_pair::orbit::Orbit;
use impact_pair::sweep::{self, Grid, PointSettings, follow};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayon::prelude::*;

use super::journal::Journal;
use super::record;
use crate::progress::Interruption;

/// A sweep at work.
pub struct Work<'w> {
    pub scene: &'w Scene,
    pub grid: &'w Grid,
    pub asked: &'w PointSettings,
    pub threads: usize,
}

impl Work<'_> {
    /// Computes what the journal lacks, until it is done or Ctrl-C comes.
    pub fn complete(&self, journal: &mut Journal, visible: bool) -> Result<()> {
        let left = journal.missing();
        let bar = progress(journal.points(), left.len() as u64, visible);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.threads).build();
        let pool = pool.context("cannot start the threads")?;
        let journal = Mutex::new(journal);
        let each = |&point: &u64| {
            let Some(line) = self.point(point)? else { return Ok(()) };
            let mut journal = journal.lock().expect("no thread has panicked");
            journal.add(point, &line).context("cannot write a finished point")?;
            bar.inc(1);
            Ok(())
        };
        // A point at a time, so that no thread is left with the slow ones.
        let done: Result<(), Error> = pool.install(|| left.par_iter().with_max_len(1).try_for_each(each));
        bar.finish_and_clear();
        done
    }

    /// The record of a point; `None` when Ctrl-C has come before it was done.
    fn point(&self, point: u64) -> Result<Option<String>> {
        let values = self.grid.values(point)?;
        let named = || {
            let value =
                |(key, value): &(impact_pair::scene::Key, impact_pair::exact::Exact)| format!("{key} = {value}");
            format!("point {point} ({})", values.iter().map(value).collect::<Vec<_>>().join(", "))
        };
        let scene = self.grid.scene(self.scene, &values).with_context(named)?;
        let found = follow(&scene, self.asked, &Interruption).with_context(named)?;
        Ok(found.map(|found| record::line(&sweep::record(point, &values, &found))))
    }

    /// Asks that all corners of the grid are scenes, before anything is computed.
    pub fn check(&self) -> Result<()> {
        self.grid.corners().into_iter().try_for_each(|point| {
            Orbit::of(&self.grid.scene(self.scene, &self.grid.values(point)?)?, self.asked.settings.clone())?;
            Ok(())
        })
    }
}

/// Points done and to do, the rate, and the time left; drawn only on a terminal.
fn progress(done: u64, left: u64, visible: bool) -> ProgressBar {
    if !visible || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} points, {per_sec}, {eta} left");
    let target = ProgressDrawTarget::stderr_with_hz(5);
    let bar = ProgressBar::with_draw_target(Some(done + left), target);
    let bar = bar.with_style(style.expect("a valid template")).with_position(done);
    // What was done before does not count for the rate.
    bar.reset_eta();
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}
