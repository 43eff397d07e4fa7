//! A picture of a scene: the length of the orbit for the requested panels, and the drawing.

use std::ops::ControlFlow;

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::orbit::{Conclusion, Ending, Event};
use impact_pair::orbit::{Orbit, Settings};
use impact_pair::watch::Watch;
use impact_pair_answers::{RunOptions, Status};

use super::{Panel, Recorder, Sheet, Style, end_of};
use crate::picture::Look;

/// Number of impacts followed for sections if none is given: sections need many points.
const SECTION_IMPACTS: u64 = 4000;

/// A request for a picture.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The panels, in their order on the sheet.
    pub panels: Vec<Panel>,
    /// Cycles that the time panels show.
    pub cycles: u32,
    /// Cycles that the phase planes show.
    pub orbit_cycles: u32,
    /// Impacts of the transient, which is drawn grey.
    pub transient: usize,
    /// The range of time that is magnified in the time panels \[time\].
    pub zoom: Option<[f64; 2]>,
    /// The orbit: of the table `[run]` only the digits are used.
    pub run: RunOptions,
    /// The look of the picture.
    pub look: Look,
}

impl Figure {
    /// Cycles over which curves are drawn: in phase planes more than in time panels.
    fn curve_cycles(&self) -> u32 {
        let most = self.panels.iter().map(|panel| match panel {
            Panel::Displacement | Panel::Velocity => self.cycles,
            Panel::PhasePlane | Panel::AbsolutePhasePlane => self.orbit_cycles,
            _ => 0,
        });
        most.max().unwrap_or(0)
    }

    /// The settings of the scene's orbit; without a requested length, as long as the panels need.
    pub fn settings(&self, scene: &Scene) -> Settings {
        let requested = self.run.impacts.is_some() || self.run.until.is_some();
        let many = self.panels.iter().any(|panel| panel.is_section());
        let (impacts, until) = match (requested, many) {
            (true, _) => (self.run.impacts, self.run.until.clone()),
            (false, true) => (Some(SECTION_IMPACTS), None),
            (false, false) => match end_of(scene, self.curve_cycles()) {
                Some(end) => (None, Some(end)),
                None => (Some(SECTION_IMPACTS), None),
            },
        };
        Settings { impacts, until, ..self.run.settings(scene) }
    }

    /// Follows the orbit of a scene from its start, and draws it as SVG; also returns how much of it is certified.
    pub fn draw(
        &self,
        scene: &Scene,
        (mut orbit, settings): (Orbit, &Settings),
        watch: &dyn Watch,
    ) -> (Result<String>, Status) {
        let mut recorder = Recorder::new(&orbit, self.curve_cycles());
        let mut last: Option<Event> = None;
        let _ = orbit.follow(watch, |orbit, step| {
            recorder.record(orbit, &step);
            last = Event::of(orbit, &step).or(last.take());
            ControlFlow::<()>::Continue(())
        });
        let impacts = orbit.listed();
        let conclusion = Conclusion::of(&orbit, last.as_ref());
        let status = Status::from(&Ending::of(&orbit, conclusion, settings));
        let trace = recorder.finish(&orbit, settings, impacts);
        let sheet = Sheet {
            scene,
            trace: &trace,
            panels: self.panels.clone(),
            cycles: self.cycles,
            orbit_cycles: self.orbit_cycles,
            zoom: self.zoom,
            style: Style { is_certified: settings.arithmetic.is_certified(), transient: self.transient },
            verdict: status.to_string(),
            look: &self.look,
        };
        (sheet.svg(), status)
    }
}
