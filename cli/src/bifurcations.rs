//! `impact-pair bifurcations SCENE --word WORD --cycles N --over KEY=LO..HI`: folds, pitchforks, doublings, grazes, proved.

use std::fmt::Write;

use anyhow::{Context, Result};
use impact_pair::Scene;
use impact_pair::document::{self, counted};
use impact_pair::exact::decimal_digits;
use impact_pair::periodic::bifurcation::{Diagram, End, Kind, Over, survey};
use impact_pair::scene::Key;

use crate::Answer;
use crate::arguments::{BifurcationArguments, PeriodicFormat};
use crate::heading::heading;
use crate::output::Output;
use crate::periodic::{physical, symmetric};
use crate::progress::{Progress, catch_interruption};
use crate::scene;

pub fn bifurcations(arguments: &BifurcationArguments) -> Result<Answer> {
    let format = arguments.destination.format(arguments.format)?;
    let scene = scene::read(&arguments.scene)?;
    let named = || scene::name(&arguments.scene);
    let wanted = arguments.wanted(&scene);
    // From here on Ctrl-C keeps what is proved.
    catch_interruption();
    scene::keep(&arguments.scene, arguments.destination.output.as_deref())?;
    let out = Output::open(arguments.destination.output.as_deref())?;
    let (word, cycles) = (&arguments.word, arguments.cycles);
    let progress = Progress::of("following branches", !arguments.destination.quiet);
    let diagram = survey(scene.pair(), scene.start(), (word, cycles), &wanted, &progress);
    let Over { key, low, high } = &wanted.over;
    let range = [(*key, format!("{key}={low}..{high}"))];
    let diagram = diagram.map_err(|error| scene::about(error, &range, &arguments.scene))?;
    progress.clear();
    let text = match format {
        PeriodicFormat::Table => table(&scene, &diagram)?,
        PeriodicFormat::Json => {
            let document = document::bifurcations(scene.start(), (word, cycles), &diagram).with_context(named)?;
            serde_json::to_string(&document)? + "\n"
        }
    };
    let open = (!diagram.is_certified()).then(|| conclusion(&diagram));
    out.answer(&text, open, (arguments.destination.quiet, format == PeriodicFormat::Table))
}

fn table(scene: &Scene, diagram: &Diagram) -> Result<String> {
    let mut out = heading(scene);
    let Over { key, low, high } = diagram.over();
    writeln!(out, "over {} from {low} to {high}\n", key.place())?;
    if !diagram.points.is_empty() {
        writeln!(out, "{:16} {:>7} {:>6}  {:36} orbit", "kind", "impacts", "cycles", key.place())?;
    }
    for point in &diagram.points {
        let (parameter, _) = diagram.in_units(point)?;
        let mut proved = symmetric(point.symmetric).to_owned();
        if point.kind != Kind::Graze {
            proved += ", ";
            proved += physical(point.orbit.as_ref().and_then(|orbit| orbit.physical));
        }
        let (kind, impacts) = (point.kind.name(), point.impacts.len());
        let digits = decimal_digits(&parameter);
        writeln!(out, "{kind:16} {impacts:7} {:6}  {digits:36} {proved}", point.cycles)?;
    }
    for branch in &diagram.branches {
        let symmetric = if branch.symmetric { ", symmetric" } else { "" };
        let [low, high] = diagram.range_f64(branch.range);
        let [a, b] = branch.ends.map(end);
        let impacts = branch.word.mappings().len();
        let proved = if branch.is_proved { ", one proved curve" } else { "" };
        let cycles = branch.cycles;
        writeln!(
            out,
            "followed: {impacts} impacts in {cycles}{symmetric}, {low:.4} to {high:.4}{proved}; ends: {a}, {b}"
        )?;
    }
    for unproved in &diagram.unproved {
        let [near, _] = diagram.range_f64([unproved.near; 2]);
        writeln!(
            out,
            "undecided: {} of {} impacts near {near:.9}",
            unproved.kind.name(),
            unproved.word.mappings().len()
        )?;
    }
    writeln!(out, "\n{}", conclusion(diagram))?;
    Ok(out)
}

/// Why a branch ends, in words.
fn end(end: End) -> &'static str {
    match end {
        End::Range => "the range",
        End::At(kind) => kind.name(),
        End::Closed => "none, it closes",
        End::Lost => "lost",
        End::Interrupted => "interrupted",
    }
}

/// The last line: how much of what was asked is proved.
fn conclusion(diagram: &Diagram) -> String {
    if matches!(diagram.over().key, Key::Frequency(_)) {
        return "certified: nothing bifurcates over the frequency: only A/d and e matter, W is the unit of time".into();
    }
    let points = format!("{} proved", counted(diagram.points.len(), "bifurcation"));
    if diagram.interrupted {
        return format!("interrupted: {points} so far; some branches were not followed, or not to their ends");
    }
    let certified = if diagram.is_certified() { "certified: " } else { "undecided: " };
    let hint = if diagram.is_certified() { "" } else { "; try a narrower --over, or more --max-bits" };
    format!("{certified}{points}; others are not excluded (branches are found and followed in floating point){hint}")
}
