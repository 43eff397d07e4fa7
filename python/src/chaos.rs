//! Regions, all periodic motions in them, stable ones near a scene, homoclinic tangencies, where all motions go, and chaos: the
//! verbs `trap`, `cycles`, `windows`, `tangency`, `global` and `chaos`.

use impact_pair::chaos::{
    BoxGraph, Cells, Chaos, Cycles, Global, GlobalSettings, HSet, HorseshoeSettings, Hyperbolic, MOST_CELLS,
    MOST_COUNTED, MOST_DEPTH, MOST_IMPACTS, MOST_WINDOW_IMPACTS, RangeSettings, Trap, WallWords, WindowSettings,
    Windows,
};
use impact_pair::exact::Exact;
use impact_pair::json::{GivenBase, WallWordsDocument, one_a_line};
use impact_pair::orbit::MAX_BITS;
use impact_pair::periodic::Precision;
use impact_pair::periodic::bifurcation;
use impact_pair::scene::{Over, Range};
use impact_pair::tangency::{FlightWord, Tangencies, TangencySettings};
use impact_pair::watch::{Stage, Watch};
use impact_pair::{Effort, Error};
use impact_pair_plot::picture::Look;
use pyo3::prelude::*;

use crate::errors::{Fault, accepted};
use crate::pictures::drawn;
use crate::scene::Scene;
use crate::verbs::{Answer, Drawn, digits, precision, text};
use crate::watched::watched;

/// A trapping region; without a document if none is proved, with the reason.
#[pyfunction]
pub fn trap(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    question: (&str, Option<u32>, bool),
    progress: Option<Py<PyAny>>,
) -> PyResult<(Option<String>, bool, bool, Option<String>)> {
    let (effort, impacts, picture) = question;
    let effort = effort_of(effort)?;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let impacts = impacts.map(|impacts| accepted("words", impacts, 1..=MOST_COUNTED)).transpose()?;
        match Trap::of(&scene, effort, monitor)? {
            Err(why) => Ok((None, false, monitor.is_stopped(), Some(why.words().to_owned()))),
            Ok(region) => {
                let mut document = region.document(&scene)?;
                if let Some(impacts) = impacts {
                    let words = WallWords::of(&BoxGraph::of(scene.pair(), &region)?, impacts, monitor);
                    document.words = words.ok().as_ref().map(WallWordsDocument::from);
                }
                let is_counted = impacts.is_none() || document.words.is_some();
                let svg = picture
                    .then(|| drawn(impact_pair_plot::chaos::trap(&scene, &region, &Look::default())))
                    .transpose()?;
                let is_complete = is_counted && document.entered_at_impact.is_some() && region.coarser().is_none();
                Ok((Some(text(&document)), is_complete, monitor.is_stopped(), svg))
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
    question: (&str, Option<u32>),
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    let (effort, requested) = question;
    let effort = effort_of(effort)?;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let least = accepted("impacts", impacts.0, 1..=MOST_IMPACTS)?;
        let impacts = least..=accepted("impacts", impacts.1, least..=MOST_IMPACTS)?;
        let precision = Precision { digits: digits(requested, &scene)?, ..Precision::default() };
        let watch = |at: Stage<'_>| match at {
            Stage::Region(_) => monitor.proceed(Stage::Working),
            at => monitor.proceed(at),
        };
        let found = Cycles::of(&scene, effort, &impacts, precision, &watch)?;
        let found = found.as_ref().map_err(|why| *why);
        let document = Cycles::document(&scene, &impacts, found)?;
        Ok((text(&document), found.is_ok_and(Cycles::is_certified), monitor.is_stopped()))
    })
}

/// Stable periodic orbits near a scene over a parameter, and their windows.
#[pyfunction]
pub fn windows(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    over: &str,
    question: (u64, &str, u32, u32),
    requested: (Option<u32>, u32),
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    let (impacts, effort, longest, most) = question;
    let effort = effort_of(effort)?;
    let range = ranged(over, &scene.get().scene)?;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let settings = WindowSettings {
            over: range,
            impacts: effort.times(accepted("impacts", impacts, 1..=1_000_000_000_000)?),
            longest: accepted("longest", longest, 1..=MOST_WINDOW_IMPACTS as u32)? as usize,
            most: accepted("most", most, 1..=100_000)? as usize,
            precision: precision(requested, &scene)?,
        };
        let found = Windows::of(&scene, &settings, monitor).map_err(|error| range_fault(error, &settings.over))?;
        let document = found.document(&scene, &settings)?;
        Ok((text(&document), found.is_certified(), monitor.is_stopped()))
    })
}

/// The values of a key that varies, with the words that a search accepts.
fn ranged(text: &str, scene: &impact_pair::Scene) -> Result<Range, Fault> {
    let over = Over::parse(text, "KEY=LO..HI with single numbers LO < HI", |_| true);
    over.and_then(|over| over.of(scene.pair())).map_err(|error| Fault::keyed(error, "over", text))
}

/// The error of a search over a range, which is at fault where no key of the scene is.
fn range_fault(error: Error, over: &Range) -> Fault {
    Fault::keyed(error, "over", &over.to_string())
}

/// The multiple of the usual work that is given as text.
pub fn effort_of(text: &str) -> Result<Effort, Fault> {
    text.parse().map_err(|error| Fault::keyed(error, "effort", text))
}

/// The most impacts of words of horseshoes, if these are looked for in components.
pub fn depth(horseshoes: Option<u32>) -> Result<Option<usize>, Fault> {
    Ok(horseshoes.map(|depth| accepted("horseshoes", depth, 1..=MOST_DEPTH)).transpose()?.map(|depth| depth as usize))
}

/// The components that every motion ends in, for all starts.
#[pyfunction]
pub fn global_analysis(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    question: (&str, bool, Option<u32>),
    digits: Option<u32>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    let (effort, has_basins, horseshoes) = question;
    let effort = effort_of(effort)?;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let usual = GlobalSettings {
            basins: has_basins.then_some(GlobalSettings::USUAL_BASINS),
            horseshoes: depth(horseshoes)?,
            precision: precision((digits, MAX_BITS), &scene)?,
            ..GlobalSettings::default()
        };
        let settings = usual.with_effort(effort);
        let found = Global::of(scene.pair(), &settings, monitor)?;
        let document = found.document(&scene, &settings)?;
        Ok((text(&document), document.certified, monitor.is_stopped()))
    })
}

/// Homoclinic tangencies of the equispaced motion over a parameter.
#[pyfunction]
pub fn tangency(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    over: &str,
    question: (Option<&str>, u32, u32, &str),
    requested: (Option<u32>, u32),
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    let (word, longest, most, effort) = question;
    let effort = effort_of(effort)?;
    let range = ranged(over, &scene.get().scene)?;
    let word = word.map(|word| word.parse::<FlightWord>().map_err(|error| Fault::keyed(error, "word", word)));
    let word = word.transpose()?;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let settings = TangencySettings {
            over: range,
            word,
            longest: accepted("longest", longest, 1..=40)? as usize,
            most: accepted("most", most, 1..=100_000)? as usize,
            effort,
            precision: precision(requested, &scene)?,
        };
        let found = Tangencies::of(&scene, &settings, monitor).map_err(|error| range_fault(error, &settings.over))?;
        Ok((text(&found.document(&scene)), found.is_certified(), monitor.is_stopped()))
    })
}

/// The values of a parameter that periodic orbits depend on.
fn over_of(text: &str, scene: &impact_pair::Scene) -> Result<Range, Fault> {
    let over = bifurcation::over(text).and_then(|over| over.of(scene.pair()));
    over.map_err(|error| Fault::keyed(error, "over", text))
}

/// Horseshoes and a lower bound of the entropy, from given h-sets (JSON) or those found.
#[pyfunction]
pub fn chaos(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    question: (Option<u32>, &str, Option<String>, Option<String>, bool, bool),
    picture: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Drawn> {
    let (depth, effort, over, bases, hyperbolic, no_orbit) = question;
    let effort = effort_of(effort)?;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let bases: Option<Vec<GivenBase>> =
            bases.map(|text| serde_json::from_str(&text)).transpose().map_err(Fault::certificate)?;
        let bases = bases.map(|bases| bases.iter().map(HSet::from).collect()).unwrap_or_default();
        let depth = depth.map(|depth| accepted("depth", depth, 1..=MOST_DEPTH)).transpose()?;
        let question = HorseshoeSettings { depth: depth.map(|depth| depth as usize), bases, effort };
        let range = |text: String| over_of(&text, &scene);
        let over = over.map(range).transpose()?;
        let pair = match &over {
            Some(over) => {
                let values = Exact::interval(over.low(), over.high())
                    .map_err(|error| Fault::range("over", over.key(), &error.to_string()))?;
                scene.pair().with(over.key(), values)?
            }
            None => scene.pair().clone(),
        };
        let found = Chaos::of(&pair, scene.start(), &question, monitor)?;
        let set = hyperbolic.then(|| Hyperbolic::of(&pair, &found, monitor)).transpose()?;
        let mut document = found.document(&scene, over.as_ref(), set.as_ref());
        document.scene_orbit = document.scene_orbit.filter(|_| !no_orbit);
        let proved = set.and_then(Result::ok);
        let is_proved = found.entropy() > 0.0 && !document.interrupted && document.hyperbolic != Some(None);
        let picture = picture.then(|| {
            impact_pair_plot::chaos::chaos(&scene, over.as_ref(), (&found, proved.as_ref()), &Look::default())
        });
        let svg = picture.map(drawn).transpose()?;
        Ok((text(&document), is_proved, monitor.is_stopped(), svg))
    })
}

/// Verdicts over a range of a parameter, cell by cell.
#[pyfunction]
pub fn chaos_cells(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    over: (&str, u32),
    question: (&str, u32),
    picture: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Drawn> {
    let ((over, cells), (effort, depth)) = (over, question);
    let requested = RangeSettings {
        over: over_of(over, &scene.get().scene)?,
        cells: accepted("cells", cells, 1..=MOST_CELLS)?,
        halvings: RangeSettings::halvings(effort_of(effort)?),
        depth: accepted("depth", depth, 1..=MOST_DEPTH)? as usize,
    };
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let found = Cells::of(scene.pair(), scene.start(), &requested, monitor)?;
        let document = found.document(&scene, &requested);
        let svg = picture
            .then(|| drawn(impact_pair_plot::proved::cells(&scene, &requested, &found, &Look::default())))
            .transpose()?;
        Ok((one_a_line(&document, &["stretches"]), document.certified, monitor.is_stopped(), svg))
    })
}
