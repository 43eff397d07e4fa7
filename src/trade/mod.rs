//! The cost of accuracy on a scene: the speed, the reach and the widths of each arithmetic, and the true errors of floating point.

mod document;
mod judge;
mod ladder;
mod measure;

pub use judge::{Crossing, Divergence, ErrorBounds, Largest};
pub use ladder::TradeArithmetic;
pub use measure::{Extent, Measured, Times, Widths};

use crate::document::counted;
use crate::orbit::Settings;
use crate::scales::{Scales, Unit};
use crate::watch::{Stage, Watch};
use crate::{Error, Scene};
use ladder::TradeSchedule;
use measure::measure;

/// The measurements on a scene.
#[derive(Clone, Debug)]
pub struct Trade<'s> {
    /// The scene.
    pub scene: &'s Scene,
    /// The requested length of the orbit for each arithmetic.
    pub asked: Settings,
    /// Units of widths and errors.
    pub units: Scales<Unit>,
    /// The measured arithmetics, in order.
    pub rungs: Vec<Measured>,
    /// The true errors of `float`.
    pub judgement: Option<ErrorBounds>,
    /// The arithmetic that the watch interrupted.
    pub interrupted: Option<TradeArithmetic>,
}

impl<'s> Trade<'s> {
    /// Measures each arithmetic, and compares `float` with a certified orbit.
    ///
    /// # Errors
    /// If the scene's values exceed the range of orbits.
    pub fn of(scene: &'s Scene, asked: Settings, watch: &dyn Watch) -> Result<Self, Error> {
        let units = Scales::of(scene)?.units();
        let one_harmonic = scene.pair().excitation().only().is_some();
        let mut ladder = TradeSchedule::new(asked.max_bits, one_harmonic && cfg!(feature = "inari"));
        let mut trade = Self { scene, asked, units, rungs: Vec::new(), judgement: None, interrupted: None };
        while let Some(rung) = ladder.rung() {
            watch.note(Stage::Part(&rung.to_string()));
            let Some(measured) = measure(scene, rung, &trade.asked, &units, watch)? else {
                trade.interrupted = Some(rung);
                break;
            };
            ladder.climb(measured.impacts, measured.is_complete());
            trade.rungs.push(measured);
            if rung == TradeArithmetic::Float {
                watch.note(Stage::Part("true errors of float"));
                trade.judgement = Some(judge::judge_float(scene, &trade.asked, &units, watch)?);
            }
        }
        Ok(trade)
    }

    /// Returns the reference for `float`, in words.
    pub fn judge(&self) -> String {
        judge::name(&judge::truth(&self.asked))
    }

    /// Returns the requested length of the orbits, in words.
    ///
    /// # Panics
    /// Panics if neither impacts nor a time are requested: no orbit goes on for ever.
    pub fn goal(&self) -> String {
        let impacts = self.asked.impacts.map(|impacts| counted(impacts, "impact"));
        let until = self.asked.until.as_ref().map(|until| format!("t = {until}"));
        match (impacts, until) {
            (Some(impacts), Some(until)) => format!("{impacts}, or up to {until}"),
            (Some(goal), None) | (None, Some(goal)) => goal,
            (None, None) => unreachable!("there is a default"),
        }
    }
}
