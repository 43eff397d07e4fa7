//! The points that are left, computed by all threads, and what there is of all of them.

use std::io::{self, IsTerminal};
use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::{Context, Result};
use impact_pair::json::counted;
use impact_pair::watch::Watch;
use impact_pair_answers::grid::{Points, Survey, Tally, complete};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::shard::GridArguments;
use crate::Answer;
use crate::destination::Destination;
use crate::output::note;
use crate::progress::{Interruption, catch_interruption};

/// Computes the points of a scene, until all are done or Ctrl-C comes, writes them by `finish`, and says what there is.
pub fn compute<S: Survey>(
    survey: &S,
    scene: &str,
    (grid, destination): (&GridArguments, &Destination),
    finish: impl FnOnce(&mut Points<S::Head>) -> Result<()>,
) -> Result<Answer> {
    let Destination { output, quiet } = destination;
    let mut points = Points::open(survey.head().clone(), output.as_deref(), grid.resume)?;
    let (begun, before) = (Instant::now(), points.count());
    let bar = progress(before, points.missing().len() as u64, !quiet && io::stderr().is_terminal());
    let threads = grid.threads.map(usize::try_from).transpose()?;
    let done = complete(survey, &mut points, threads, (&Interruption, &|| bar.inc(1)));
    bar.finish_and_clear();
    done.with_context(|| scene.to_owned())?;
    let (count, left) = (points.count(), points.missing().len());
    if let Some(path) = points.path().filter(|_| left > 0 && !Interruption.goes_on()) {
        let path = path.display();
        let kept = format!("{} kept in {path}, {left} left (go on with --resume)", counted(count, "point"));
        note(*quiet, &format!("interrupted: {kept}"));
        return Ok(Answer::Incomplete);
    }
    let (computed, seconds) = (count - before, begun.elapsed().as_secs_f64());
    let rate = format!("{computed} in {seconds:.1} s, {:.1} a second", computed as f64 / seconds.max(1e-9));
    let status = Tally::tally(&mut points)?;
    finish(&mut points)?;
    points.finish()?;
    let interrupted =
        if left > 0 { format!("; interrupted, {} left", counted(left as u64, "point")) } else { String::new() };
    note(*quiet, &format!("{status} ({rate}){interrupted}"));
    Ok(if left == 0 && status.is_complete() { Answer::Complete } else { Answer::Incomplete })
}

/// Puts shards together, writes their points by `finish`, and says what there is.
pub fn merge<H: Tally>(
    mut points: Points<H>,
    quiet: bool,
    finish: impl FnOnce(&mut Points<H>) -> Result<()>,
) -> Result<Answer> {
    let status = H::tally(&mut points)?;
    finish(&mut points)?;
    note(quiet, &status.to_string());
    Ok(if status.is_complete() { Answer::Complete } else { Answer::Incomplete })
}

/// Refuses outputs that cannot be written now and not after hours.
///
/// From the first file on Ctrl-C keeps what is finished, and leaves no draft behind.
pub fn open_once(outputs: &[Option<&Path>]) -> Result<()> {
    catch_interruption();
    outputs.iter().flatten().try_for_each(|path| crate::output::Output::open(Some(path)).map(drop))
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
    // Points of an earlier run do not count for the rate.
    bar.reset_eta();
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}
