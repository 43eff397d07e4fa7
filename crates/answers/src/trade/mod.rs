//! The cost of accuracy on a scene: the speed, the reach and the widths of each arithmetic, and the true errors of floating point.

mod document;
mod judge;
mod measure;
mod schedule;
mod table;
mod verb;

pub use judge::{Crossing, Divergence, ErrorBounds, Largest};
pub use measure::{Extent, Measured, Times, Widths};
pub use schedule::TradeArithmetic;
pub use verb::TradeOptions;

use impact_pair::json::counted;
use impact_pair::orbit::{INARI, Settings};
use impact_pair::scales::{Scales, Unit};
use impact_pair::watch::{Stage, Watch};
use impact_pair::{Error, Scene};
use measure::measure;
use schedule::TradeSchedule;

/// The measurements on a scene.
#[derive(Clone, Debug)]
pub struct Trade<'s> {
    /// The scene.
    pub scene: &'s Scene,
    /// The requested length of the orbit for each arithmetic.
    pub requested: Settings,
    /// Units of widths and errors.
    pub units: Scales<Unit>,
    /// The measured arithmetics, in order.
    pub rows: Vec<Measured>,
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
    pub fn of(scene: &'s Scene, requested: Settings, watch: &dyn Watch) -> Result<Self, Error> {
        let units = Scales::of(scene)?.units();
        let one_harmonic = scene.pair().excitation().only().is_some();
        let mut schedule = TradeSchedule::new(requested.max_bits, one_harmonic && INARI);
        let mut trade = Self { scene, requested, units, rows: Vec::new(), judgement: None, interrupted: None };
        while let Some(arithmetic) = schedule.arithmetic() {
            watch.note(Stage::Part(&arithmetic.to_string()));
            let Some(measured) = measure(scene, arithmetic, &trade.requested, &units, watch)? else {
                trade.interrupted = Some(arithmetic);
                break;
            };
            schedule.advance(measured.impacts, measured.is_complete());
            trade.rows.push(measured);
            if arithmetic == TradeArithmetic::Float {
                watch.note(Stage::Part("true errors of float"));
                trade.judgement = Some(judge::judge_float(scene, &trade.requested, &units, watch)?);
            }
        }
        Ok(trade)
    }

    /// The reference for `float`, in words.
    pub fn judge(&self) -> String {
        judge::name(&judge::truth(&self.requested))
    }

    /// The requested length of the orbits, in words.
    ///
    /// # Panics
    /// If neither impacts nor a time are requested: no orbit goes on for ever.
    pub fn goal(&self) -> String {
        let impacts = self.requested.impacts.map(|impacts| counted(impacts, "impact"));
        let until = self.requested.until.as_ref().map(|until| format!("t = {until}"));
        match (impacts, until) {
            (Some(impacts), Some(until)) => format!("{impacts}, or up to {until}"),
            (Some(goal), None) | (None, Some(goal)) => goal,
            (None, None) => unreachable!("there is a default"),
        }
    }
}
