//! Progress of long runs on stderr, and the wish of a user to stop them.

use std::ops::ControlFlow;
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use impact_pair::json::counted;
use impact_pair::watch::{Stage, Watch, proceed_if};
use impact_pair_answers::Counts;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Impacts between two looks at the clock; in doubles these take less than a blink.
const IMPACTS_PER_POLL: u64 = 16;
/// Exit code of a program that SIGINT ends.
const SIGINT_EXIT_CODE: i32 = 130;

/// A line on stderr that counts the impacts, or nothing.
pub struct Progress(Option<ProgressBar>);

impl Progress {
    /// Counts up to `impacts`, if that is known; draws only on a terminal, and only when `is_shown`.
    pub fn new(impacts: Option<u64>, is_shown: bool) -> Self {
        Self::counting(Counts::Impacts(impacts), is_shown)
    }

    /// Counts what a verb counts; without a count shows what is done and for how long, not before a second has passed.
    pub fn counting(what: Counts, is_shown: bool) -> Self {
        if !is_shown {
            return Self(None);
        }
        match what {
            Counts::Stages => Self::drawn(None, "{prefix}{pos}").named(|bar| bar.set_prefix("orbit, impacts: ")),
            Counts::Cells => Self::drawn(Some(0), "{bar:30} {pos}/{len} cells of the state space"),
            Counts::Parameters(cells) => Self::drawn(Some(cells.into()), "{bar:30} {pos}/{len} cells, {elapsed}"),
            Counts::Impacts(None) => Self::drawn(None, "{prefix}{pos} impacts{msg}"),
            Counts::Impacts(impacts) => Self::drawn(impacts, "{prefix}{bar:30} {pos}/{len} impacts, {eta} left{msg}"),
            Counts::Nothing(what) => Self::drawn(None, "{msg}, {elapsed}").named(|bar| {
                bar.set_message(what);
                bar.enable_steady_tick(Duration::from_secs(1));
            }),
        }
    }

    /// The line with its words.
    fn named(self, name: impl FnOnce(&ProgressBar)) -> Self {
        if let Some(bar) = &self.0 {
            name(bar);
        }
        self
    }

    fn drawn(length: Option<u64>, template: &str) -> Self {
        let style = ProgressStyle::with_template(template).expect("a valid template");
        let target = ProgressDrawTarget::stderr_with_hz(5);
        Self(Some(ProgressBar::with_draw_target(length, target).with_style(style)))
    }

    /// Shows a count, after what it counts.
    fn count(&self, what: String, count: u64) {
        if let Some(bar) = self.due(0) {
            bar.set_prefix(what);
            bar.set_position(count);
        }
    }

    /// Shows the impacts, or claims, that are done.
    fn reach(&self, index: u64) {
        if let Some(bar) = self.due(index) {
            bar.set_message("");
            bar.set_position(index);
        }
    }

    /// Begins another part.
    fn begin(&self, what: &str) {
        if let Some(bar) = &self.0 {
            bar.set_prefix(format!("{what}: "));
            bar.set_message("");
            bar.reset();
        }
    }

    /// Shows how far a search has come.
    fn searched(&self, done: u64, of: u64) {
        if let Some(bar) = self.due(0).filter(|bar| bar.position() != done || bar.length() == Some(0)) {
            bar.set_length(of);
            bar.set_position(done);
        }
    }

    /// The bar, when it is time to look at it.
    fn due(&self, index: u64) -> Option<&ProgressBar> {
        let bar = self.0.as_ref().filter(|_| index.is_multiple_of(IMPACTS_PER_POLL))?;
        (bar.elapsed() > Duration::from_secs(1)).then_some(bar)
    }

    /// Leaves the terminal as it was.
    pub fn clear(&self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}

impl Watch for Progress {
    /// Continues until Ctrl-C comes.
    fn proceed(&self, at: Stage<'_>) -> ControlFlow<()> {
        match at {
            Stage::Part(what) => self.begin(what),
            Stage::Impact(index) => self.reach(index),
            Stage::Claims(claims) => self.reach(claims as u64),
            Stage::Retraced { index, bits } => {
                if let Some(bar) = self.due(index) {
                    bar.set_message(format!(", again from the start in {bits} bits: {index}"));
                }
            }
            Stage::Cells { done, of } => self.searched(done as u64, of as u64),
            Stage::Cones(cells) => self.count("cells with cones: ".to_owned(), cells),
            Stage::Sets(sets) => self.count("words of walls, sets of boxes: ".to_owned(), sets as u64),
            Stage::Region(boxes) => self.count("trapping region, boxes: ".to_owned(), boxes as u64),
            Stage::Cycles { impacts, blocks, of } => {
                let impacts = counted(impacts as u32, "impact");
                self.count(format!("cycles of {impacts}, blocks of {of}: "), blocks as u64);
            }
            Stage::Horseshoe { depth: 0, boxes } => self.count("h-sets, boxes: ".to_owned(), boxes),
            Stage::Horseshoe { depth, boxes } => self.count(format!("horseshoe, depth {depth}, boxes: "), boxes),
            Stage::Parameter(cells) => self.count(String::new(), cells.into()),
            Stage::Searched(impacts) => self.count("floating-point search, impacts: ".to_owned(), impacts),
            Stage::Windows { proved, of } => self.count(format!("proofs of windows, of {of}: "), proved as u64),
            Stage::Folds(pieces) => {
                self.count("floating-point search, pieces of unstable manifolds: ".to_owned(), pieces)
            }
            Stage::Tangencies { proved, of } => self.count(format!("proofs of tangencies, of {of}: "), proved as u64),
            _ => {}
        }
        Interruption.proceed(at)
    }
}

/// The watch that Ctrl-C stops, without progress.
pub struct Interruption;

impl Watch for Interruption {
    fn proceed(&self, _: Stage<'_>) -> ControlFlow<()> {
        proceed_if(!INTERRUPTED.load(Ordering::Relaxed))
    }
}

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on the first Ctrl-C asks to stop and the second one kills.
pub fn catch_interruption() {
    static HANDLER: OnceLock<()> = OnceLock::new();
    HANDLER.get_or_init(|| {
        let on_signal = || {
            if INTERRUPTED.swap(true, Ordering::Relaxed) {
                process::exit(SIGINT_EXIT_CODE);
            }
        };
        // Without a handler Ctrl-C kills at once: no reason to refuse to run.
        let _ = ctrlc::set_handler(on_signal);
    });
}
