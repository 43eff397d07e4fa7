//! Regions, all periodic motions in them, and chaos: the verbs `trap`, `cycles` and `chaos`.

use impact_pair::chaos::{
    Asked, Cells, Chaos, Cycles, Hyperbolic, MOST_CELLS, MOST_DEPTH, MOST_HALVINGS, MOST_IMPACTS, Question, Stage, Trap,
};
use impact_pair::document;
use impact_pair::exact::Exact;
use impact_pair::json::{BaseDocument, one_a_line};
use impact_pair::periodic::Precision;
use impact_pair::periodic::bifurcation::Over;
use pyo3::prelude::*;

use crate::errors::{Fault, accepted};
use crate::pictures::drawn;
use crate::scene::Scene;
use crate::verbs::{Answer, Drawn, digits, text};
use crate::watched::watched;

/// A trapping region; without a document if none is proved, with the reason.
#[pyfunction]
pub fn trap(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    question: (u32, bool),
    progress: Option<Py<PyAny>>,
) -> PyResult<(Option<String>, bool, Option<String>)> {
    let (finer, picture) = question;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let watch = |boxes: usize| {
            monitor.tell(boxes as u64);
            monitor.goes_on()
        };
        match Trap::of(&scene, accepted("finer", finer, 0..=6)?, &watch)? {
            Err(why) => Ok((None, false, Some(why.words().to_owned()))),
            Ok(region) => {
                let document = document::trap(&scene, &region)?;
                let svg = picture.then(|| drawn(impact_pair_plot::chaos::trap(&scene, &region))).transpose()?;
                Ok((Some(text(&document)), document.entered_at_impact.is_some(), svg))
            }
        }
    })
}

/// All periodic orbits with given numbers of impacts in a trapping region.
#[pyfunction]
pub fn cycles(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    impacts: (u32, u32),
    question: (u32, Option<u32>),
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    let (finer, asked) = question;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let least = accepted("impacts", impacts.0, 1..=MOST_IMPACTS)?;
        let impacts = least..=accepted("impacts", impacts.1, least..=MOST_IMPACTS)?;
        let watch = |stage: Stage| {
            if let Stage::Impacts { impacts, .. } = stage {
                monitor.tell(impacts as u64);
            }
            monitor.goes_on()
        };
        let precision = Precision { digits: digits(asked, &scene)?, ..Precision::default() };
        let found = Cycles::of(&scene, accepted("finer", finer, 0..=6)?, &impacts, precision, &watch)?;
        let found = found.as_ref().map_err(|why| *why);
        let document = document::cycles(&scene, &impacts, found)?;
        Ok((text(&document), found.is_ok_and(Cycles::is_certified)))
    })
}

/// Horseshoes and a lower bound of the entropy, from given h-sets (JSON) or those found.
#[pyfunction]
pub fn chaos(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    question: (u32, Option<String>, Option<String>, bool),
    picture: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Drawn> {
    let (depth, over, bases, hyperbolic) = question;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let bases: Option<Vec<BaseDocument>> =
            bases.map(|text| serde_json::from_str(&text)).transpose().map_err(Fault::certificate)?;
        let bases = bases.map(|bases| document::bases(&bases)).unwrap_or_default();
        let question = Question { depth: accepted("depth", depth, 1..=MOST_DEPTH)? as usize, bases };
        let over: Option<Over> = over.map(|over| over.parse()).transpose()?;
        let pair = match &over {
            Some(over) => {
                let values = Exact::interval(&over.low, &over.high)
                    .map_err(|error| Fault::range("over", over.key, &error.to_string()))?;
                scene.pair().with(over.key, values)?
            }
            None => scene.pair().clone(),
        };
        let watch = |_depth: usize, boxes: u64| {
            monitor.tell(boxes);
            monitor.goes_on()
        };
        let found = Chaos::of(&pair, scene.start(), &question, &watch)?;
        let mut document = document::chaos(&scene, over.as_ref(), &question, &found);
        if hyperbolic {
            let set = Hyperbolic::of(&pair, &found, &|cells| watch(0, cells))?;
            document.hyperbolic = Some(set.as_ref().map(document::hyperbolic));
        }
        let is_proved = found.entropy() > 0.0 && !document.interrupted && document.hyperbolic != Some(None);
        let svg = picture.then(|| drawn(impact_pair_plot::chaos::chaos(&scene, over.as_ref(), &found))).transpose()?;
        Ok((text(&document), is_proved, svg))
    })
}

/// Verdicts over a range of a parameter, cell by cell.
#[pyfunction]
pub fn chaos_cells(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    over: (&str, u32),
    question: (u32, u32),
    picture: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Drawn> {
    let ((over, cells), (halvings, depth)) = (over, question);
    let asked = Asked {
        over: over.parse().map_err(Fault::from)?,
        cells: accepted("cells", cells, 1..=MOST_CELLS)?,
        halvings: accepted("halvings", halvings, 0..=MOST_HALVINGS)?,
        depth: accepted("depth", depth, 1..=MOST_DEPTH)? as usize,
    };
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let watch = |done: u32| {
            monitor.tell(done.into());
            monitor.goes_on()
        };
        let found = Cells::of(scene.pair(), scene.start(), &asked, &watch)?;
        let document = document::cells(&scene, &asked, &found);
        let svg = picture.then(|| drawn(impact_pair_plot::proved::cells(&scene, &asked, &found))).transpose()?;
        Ok((one_a_line(&document, &["stretches"]), document.certified, svg))
    })
}
