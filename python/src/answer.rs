//! Verbs that answer with one document: a question in JSON in, the document and what is left undecided out.

use impact_pair::watch::{Stage, Watch};
use impact_pair_answers::{
    Answer, Asked, AuditOptions, BifurcationOptions, ChaosOptions, CyclesOptions, DescribeOptions, Format,
    GlobalOptions, PeriodicOptions, TangencyOptions, TradeOptions, TrapOptions, TwoImpactOptions, Verb, WindowsOptions,
    read_options,
};
use impact_pair_plot::Pictured;
use impact_pair_plot::picture::Look;
use pyo3::prelude::*;
use serde_json::{Map, Value};

use crate::errors::Fault;
use crate::scene::Scene;
use crate::watched::watched;

/// The document, whether everything requested is certified, the picture if requested, and what is left undecided, in words.
type Found = (Option<String>, bool, Option<String>, String);
/// The same with whether Ctrl-C ended the computation, before the picture.
type Answered = (Option<String>, bool, bool, Option<String>, String);
/// Answers one verb with these options, and with a picture if requested.
type Ask = fn(&Asked<'_>, &Map<String, Value>, &dyn Watch) -> Result<Found, Fault>;

/// The verbs.
const VERBS: [(&str, Ask); 12] = [
    (PeriodicOptions::NAME, ask::<PeriodicOptions>),
    (BifurcationOptions::NAME, ask::<BifurcationOptions>),
    (TwoImpactOptions::NAME, ask::<TwoImpactOptions>),
    (DescribeOptions::NAME, ask::<DescribeOptions>),
    (TradeOptions::NAME, ask::<TradeOptions>),
    (AuditOptions::NAME, ask::<AuditOptions>),
    (TrapOptions::NAME, ask::<TrapOptions>),
    (ChaosOptions::NAME, ask::<ChaosOptions>),
    (CyclesOptions::NAME, cycles),
    (WindowsOptions::NAME, ask::<WindowsOptions>),
    (GlobalOptions::NAME, ask::<GlobalOptions>),
    (TangencyOptions::NAME, ask::<TangencyOptions>),
];

fn ask<V: Verb>(asked: &Asked<'_>, options: &Map<String, Value>, watch: &dyn Watch) -> Result<Found, Fault>
where
    for<'s> V::Answer<'s>: Pictured,
{
    let found = read_options::<V>(V::NAME, options)?.answer(asked, watch)?;
    let document = found.text(Format::Json).map_err(Fault::of)?;
    let svg = if asked.is_drawn { found.svg(&Look::default()).transpose().map_err(Fault::other)? } else { None };
    let status = found.status();
    Ok((document, status.is_complete(), svg, status.in_python()))
}

/// Answers `cycles`, whose progress counts impacts: not the boxes of the region.
fn cycles(asked: &Asked<'_>, options: &Map<String, Value>, watch: &dyn Watch) -> Result<Found, Fault> {
    let counted = |at: Stage<'_>| match at {
        Stage::Region(_) => watch.proceed(Stage::Working),
        at => watch.proceed(at),
    };
    ask::<CyclesOptions>(asked, options, &counted)
}

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
    let options: Map<String, Value> = serde_json::from_str(&options).map_err(Fault::other)?;
    let known = VERBS.iter().find(|(name, _)| *name == verb);
    let (_, ask) = known.ok_or_else(|| Fault::other(format!("{verb} is no verb")))?;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let asked = Asked { scene: &scene, name: &name, is_drawn: picture };
        let (document, is_complete, svg, status) = ask(&asked, &options, monitor)?;
        Ok((document, is_complete, !is_complete && monitor.is_stopped(), svg, status))
    })
}
