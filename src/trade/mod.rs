//! What accuracy costs on a scene: the speed, the reach and the widths of each arithmetic, and the true errors of floats.

mod document;
mod judge;
mod ladder;
mod measure;

pub use judge::{Crossing, Departure, Judgement, Largest};
pub use ladder::Rung;
pub use measure::{Extent, Measured, Times, Widths};

use crate::document::counted;
use crate::orbit::{Settings, Watch};
use crate::scales::Units;
use crate::{Error, Scene};
use ladder::Ladder;
use measure::measure;

/// What has been measured on a scene.
#[derive(Clone, Debug)]
pub struct Trade<'s> {
    /// The scene.
    pub scene: &'s Scene,
    /// How far each rung is asked to go.
    pub asked: Settings,
    /// What widths and errors are measured in.
    pub units: Units,
    /// The rungs, in the order in which they were measured.
    pub rungs: Vec<Measured>,
    /// The true errors of `float`.
    pub judgement: Option<Judgement>,
    /// The rung that the watch ended.
    pub interrupted: Option<Rung>,
}

impl<'s> Trade<'s> {
    /// Measures rung after rung, and judges the first one.
    ///
    /// # Errors
    /// When the scene's values are beyond what an orbit takes.
    pub fn of(scene: &'s Scene, asked: Settings, watch: &dyn Watch) -> Result<Self, Error> {
        let units = Units::of(scene);
        let one_harmonic = scene.pair().excitation().only().is_some();
        let mut ladder = Ladder::new(asked.max_bits, one_harmonic && cfg!(feature = "inari"));
        let mut trade = Self { scene, asked, units, rungs: Vec::new(), judgement: None, interrupted: None };
        while let Some(rung) = ladder.rung() {
            watch.stage(&rung.to_string());
            let Some(measured) = measure(scene, rung, &trade.asked, &units, watch)? else {
                trade.interrupted = Some(rung);
                break;
            };
            ladder.climb(measured.impacts, measured.is_complete());
            trade.rungs.push(measured);
            if rung == Rung::Float {
                watch.stage("true errors of float");
                trade.judgement = Some(judge::judge_float(scene, &trade.asked, &units, watch)?);
            }
        }
        Ok(trade)
    }

    /// What judges `float`, in words.
    pub fn judge(&self) -> String {
        judge::name(&judge::truth(&self.asked))
    }

    /// How far each rung is asked to go, in words.
    ///
    /// # Panics
    /// When neither impacts nor a time are asked for: no orbit goes on for ever.
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
