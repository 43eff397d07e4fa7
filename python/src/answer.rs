//! Verbs that answer with one document: a question in JSON in, the document and what is left undecided out.

use impact_pair::json::SceneDocument;
use impact_pair::watch::{Stage, Watch};
use impact_pair_answers::{Format, Options, Question};
use impact_pair_plot::picture::Look;
use impact_pair_plot::svg;
use pyo3::prelude::*;

use crate::errors::Fault;
use crate::scene::{Scene, json};
use crate::watched::watched;

/// The document, whether everything requested is certified, whether Ctrl-C ended the computation, the picture if requested, and what is left
/// undecided, in words.
type Answered = (Option<String>, bool, bool, Option<String>, String);

/// Answers a verb with options as JSON; commands name the scene by a path.
#[pyfunction]
pub fn answer(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    name: String,
    question: (String, String),
    picture: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Answered> {
    let (verb, options) = question;
    let scene = scene.get().scene.clone();
    let question = Question { name, is_drawn: picture, ..Question::new(verb, scene, options_of(&options)?) };
    // The progress of `cycles` is impacts, not the boxes of its region.
    let skips_region = question.verb == "cycles";
    watched(py, progress, move |monitor| {
        let counted = |at: Stage<'_>| match at {
            Stage::Region(_) if skips_region => monitor.proceed(Stage::Working),
            at => monitor.proceed(at),
        };
        let found = question.answer(&counted)?;
        let document = found.text(Format::Json).map_err(Fault::of)?;
        let status = found.status();
        let picture = if picture { found.picture() } else { None };
        let svg = picture.map(|picture| svg(picture, &Look::default())).transpose().map_err(Fault::other)?;
        let interrupted = !status.is_complete() && monitor.is_stopped();
        Ok((document, status.is_complete(), interrupted, svg, status.in_python()))
    })
}

/// The verb of a question in JSON, the document of its scene, and its options, both as JSON.
#[pyfunction]
pub fn question(text: &str) -> PyResult<(String, String, String)> {
    let Question { verb, scene, options, .. } = Question::read(text).map_err(Fault::from)?;
    Ok((verb, json(&SceneDocument::new(scene.pair(), scene.start()))?, json(&options)?))
}

/// Options as JSON.
pub fn options_of(text: &str) -> Result<Options, Fault> {
    serde_json::from_str(text).map_err(Fault::other)
}
