//! The JSON of windows of stable periodic orbits.

use impact_pair_document::{
    OpenWindowDocument, PROGRAM, SceneDocument, WINDOWS_SCHEMA, WindowDocument, WindowsDocument, bounds,
};

use super::{FoundWindow, UnprovedWindow, WindowSettings, Windows};
use crate::periodic::bifurcation::WindowEnd;
use crate::units::Units;
use crate::{Error, Scene};

impl Windows {
    /// Returns the document of the windows near a scene.
    ///
    /// # Errors
    /// If a value exceeds the range of exact expressions.
    pub fn document(&self, scene: &Scene, settings: &WindowSettings) -> Result<WindowsDocument, Error> {
        let key = self.over.key().place();
        let window = |FoundWindow { impacts, flights, window }: &FoundWindow| -> Result<WindowDocument, Error> {
            let [from, to] = window.ends.each_ref().map(|end| end.as_ref().map(|end| bounds(&end.parameter)));
            let kind = |end: &Option<WindowEnd>| end.as_ref().map(|end| end.point.kind);
            let problem = &window.problem;
            Ok(WindowDocument {
                key: key.clone(),
                at: (&window.at).into(),
                from,
                to,
                ends: window.ends.each_ref().map(kind),
                stable_between: window.is_stable_between,
                reason: window.reason.map(str::to_owned),
                reduced_impacts: *impacts as u32,
                flights: flights.clone(),
                word: problem.word().to_string(),
                cycles: problem.chain().cycles(),
                orbit: Units::gaps(problem.pair())?.orbit(problem, &window.orbit),
            })
        };
        let open = |UnprovedWindow { impacts, flights, near, reason }: &UnprovedWindow| OpenWindowDocument {
            near: *near,
            reduced_impacts: *impacts as u32,
            flights: flights.clone(),
            reason: Some((*reason).to_owned()),
        };
        Ok(WindowsDocument {
            schema: WINDOWS_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            certified: self.is_certified(),
            scene: SceneDocument::new(scene.pair(), scene.start()),
            over: (&self.over).into(),
            exhaustive: false,
            searched_impacts: settings.impacts,
            interrupted: self.interrupted,
            windows: self.windows.iter().map(window).collect::<Result<_, _>>()?,
            undecided: self.unproved.iter().map(open).collect(),
        })
    }
}
