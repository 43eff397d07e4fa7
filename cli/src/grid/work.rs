//! The points that are left, computed by all threads.

use std::fmt::Display;
use std::io::{self, IsTerminal};
use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::{Context, Result};
use impact_pair::exact::Exact;
use impact_pair::json::counted;
use impact_pair::scene::Key;
use impact_pair::sweep::Head;
use impact_pair_answers::grid::{Journal, Task, complete};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::points::Gathered;
use super::shard::GridArguments;
use crate::Answer;
use crate::destination::Destination;
use crate::output::note;
use crate::progress::{Interruption, catch_interruption};
use impact_pair::watch::Watch;

/// A sweep or an atlas at work.
pub struct Work<'w, H> {
    pub head: H,
    pub point: Task<'w>,
    pub grid: &'w GridArguments,
    pub destination: &'w Destination,
}

/// The summary of all points.
pub trait Tally: Display {
    /// Returns whether everything requested is proved at the points that are present.
    fn is_complete(&self) -> bool;
}

impl<H: Head + Sync + Send> Work<'_, H> {
    /// Computes the points, until all are done or Ctrl-C comes, writes them by `finish`, and says what there is.
    pub fn answer<T: Tally>(self, scene: &str, finish: impl FnOnce(&mut Gathered<H>) -> Result<T>) -> Result<Answer> {
        let Destination { output, quiet } = self.destination;
        let mut journal = Journal::open(self.head.clone(), output.as_deref(), self.grid.resume)?;
        let (begun, before) = (Instant::now(), journal.points());
        self.complete(&mut journal, !quiet && io::stderr().is_terminal()).with_context(|| scene.to_owned())?;
        let (points, left) = (journal.points(), journal.missing().len());
        if let Some(path) = journal.path().filter(|_| left > 0 && !Interruption.goes_on()) {
            let path = path.display();
            let kept = format!("{} kept in {path}, {left} left (go on with --resume)", counted(points, "point"));
            note(*quiet, &format!("interrupted: {kept}"));
            return Ok(Answer::Incomplete);
        }
        let (computed, seconds) = (points - before, begun.elapsed().as_secs_f64());
        let rate = format!("{computed} in {seconds:.1} s, {:.1} a second", computed as f64 / seconds.max(1e-9));
        let mut gathered = Gathered { head: self.head, journals: vec![journal] };
        let tally = finish(&mut gathered)?;
        gathered.journals.into_iter().try_for_each(Journal::finish)?;
        let interrupted =
            if left > 0 { format!("; interrupted, {} left", counted(left as u64, "point")) } else { String::new() };
        note(*quiet, &format!("{tally} ({rate}){interrupted}"));
        Ok(if left == 0 { answered(&tally) } else { Answer::Incomplete })
    }

    /// Computes what the journal lacks.
    fn complete(&self, journal: &mut Journal<H>, visible: bool) -> Result<()> {
        let bar = progress(journal.points(), journal.missing().len() as u64, visible);
        let threads = self.grid.threads.map(usize::try_from).transpose()?;
        let done = complete(journal, threads, self.point, (&Interruption, &|| bar.inc(1)));
        bar.finish_and_clear();
        done
    }
}

/// Returns the answer of the program: complete if everything requested is proved at the points that are present.
pub fn answered(tally: &impl Tally) -> Answer {
    if tally.is_complete() { Answer::Complete } else { Answer::Incomplete }
}

/// Names a point and its values.
pub fn named(point: u64, values: &[(Key, Exact)]) -> String {
    let value = |(key, value): &(Key, Exact)| format!("{key} = {value}");
    format!("point {point} ({})", values.iter().map(value).collect::<Vec<_>>().join(", "))
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
