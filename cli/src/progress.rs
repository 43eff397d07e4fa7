//! Progress of long runs on stderr, and the wish of a user to stop them.

use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use impact_pair::orbit::Watch;
use impact_pair::periodic::Searched;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Impacts between two looks at the clock; in doubles these take less than a blink.
const STRIDE: u64 = 16;
/// Exit code of a program that SIGINT ends.
const KILLED: i32 = 130;

/// A line on stderr that counts the impacts, or nothing.
pub struct Progress(Option<ProgressBar>);

impl Progress {
    /// Counts up to `impacts`, if that is known; draws only on a terminal, and only when `wanted`.
    pub fn new(impacts: Option<u64>, wanted: bool) -> Self {
        if !wanted {
            return Self(None);
        }
        let template = if impacts.is_some() {
            "{prefix}{bar:30} {pos}/{len} impacts, {eta} left{msg}"
        } else {
            "{prefix}{pos} impacts{msg}"
        };
        Self::drawn(impacts, template)
    }

    /// Counts the cells of a search.
    pub fn search(wanted: bool) -> Self {
        if wanted { Self::drawn(Some(0), "{bar:30} {pos}/{len} cells of the state space") } else { Self(None) }
    }

    /// Tells what is done and for how long, where nothing can be counted; not before a second has passed.
    pub fn of(what: &'static str, wanted: bool) -> Self {
        let progress = if wanted { Self::drawn(None, "{msg}, {elapsed}") } else { Self(None) };
        if let Some(bar) = &progress.0 {
            bar.set_message(what);
            bar.enable_steady_tick(Duration::from_secs(1));
        }
        progress
    }

    /// Counts boxes that are proved, none at first.
    pub fn boxes(wanted: bool) -> Self {
        if wanted { Self::drawn(None, "{prefix}{pos} boxes") } else { Self(None) }
    }

    /// Counts what each stage of a description counts.
    pub fn described(wanted: bool) -> Self {
        if wanted { Self::drawn(None, "{prefix}{pos}") } else { Self(None) }
    }

    /// Counts the cells of a parameter's range.
    pub fn cells(cells: u32, wanted: bool) -> Self {
        if wanted { Self::drawn(Some(cells.into()), "{bar:30} {pos}/{len} cells, {elapsed}") } else { Self(None) }
    }

    /// Notes how many boxes there are, or cells are done, and at what.
    pub fn boxed(&self, at: &str, boxes: u64) {
        if let Some(bar) = self.due(0) {
            bar.set_prefix(at.to_owned());
            bar.set_position(boxes);
        }
    }

    fn drawn(length: Option<u64>, template: &str) -> Self {
        let style = ProgressStyle::with_template(template).expect("a valid template");
        let target = ProgressDrawTarget::stderr_with_hz(5);
        Self(Some(ProgressBar::with_draw_target(length, target).with_style(style)))
    }

    /// Notes that impact `index` is done.
    pub fn reach(&self, index: u64) {
        if let Some(bar) = self.due(index) {
            bar.set_message("");
            bar.set_position(index);
        }
    }

    /// Notes how far a search has come.
    pub fn searched(&self, searched: Searched) {
        if let Some(bar) = self.due(0).filter(|bar| bar.position() != searched.cells as u64 || bar.length() == Some(0))
        {
            bar.set_length(searched.of as u64);
            bar.set_position(searched.cells as u64);
        }
    }

    /// The bar, when it is time to look at it.
    fn due(&self, index: u64) -> Option<&ProgressBar> {
        let bar = self.0.as_ref().filter(|_| index.is_multiple_of(STRIDE))?;
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
    /// Until Ctrl-C comes.
    fn goes_on(&self) -> bool {
        goes_on()
    }

    fn stage(&self, what: &str) {
        if let Some(bar) = &self.0 {
            bar.set_prefix(format!("{what}: "));
            bar.set_message("");
            bar.reset();
        }
    }

    fn reached(&self, index: u64) {
        self.reach(index);
    }

    fn retraced(&self, index: u64, bits: u32) {
        if let Some(bar) = self.due(index) {
            bar.set_message(format!(", again from the start in {bits} bits: {index}"));
        }
    }
}

/// Whether no Ctrl-C has come.
pub fn goes_on() -> bool {
    !interruption().load(Ordering::Relaxed)
}

/// From now on the first Ctrl-C asks to stop and the second one kills; says whether one has come.
pub fn interruption() -> &'static AtomicBool {
    static INTERRUPTED: AtomicBool = AtomicBool::new(false);
    static HANDLER: OnceLock<()> = OnceLock::new();
    HANDLER.get_or_init(|| {
        let on_signal = || {
            if INTERRUPTED.swap(true, Ordering::Relaxed) {
                process::exit(KILLED);
            }
        };
        // Without a handler Ctrl-C kills at once: no reason to refuse to run.
        let _ = ctrlc::set_handler(on_signal);
    });
    &INTERRUPTED
}
