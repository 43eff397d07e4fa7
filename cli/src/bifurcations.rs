//! `impact-pair bifurcations SCENE --word WORD --cycles N --over KEY=LO..HI`: folds, pitchforks, doublings, grazes, proved.

use std::io::{self, Write};

use anyhow::{Context, Result};
use impact_pair::Scene;
use impact_pair::document;
use impact_pair::exact::decimal_digits;
use impact_pair::periodic::bifurcation::{Diagram, End, Kind, Over, survey};
use impact_pair::scene::Key;

use crate::Answer;
use crate::arguments::{BifurcationArguments, PeriodicFormat};
use crate::heading;
use crate::output::Output;
use crate::progress::{goes_on, interruption};
use crate::scene;

pub fn bifurcations(arguments: &BifurcationArguments) -> Result<Answer> {
    let scene = scene::read(&arguments.scene)?;
    let named = || scene::name(&arguments.scene);
    let wanted = arguments.wanted(&scene);
    // From here on Ctrl-C keeps what is proved.
    interruption();
    scene::keep(&arguments.scene, arguments.output.as_deref())?;
    let mut out = Output::open(arguments.output.as_deref())?;
    let (word, cycles) = (&arguments.word, arguments.cycles);
    let diagram = survey(scene.pair(), scene.start(), (word, cycles), &wanted, goes_on).with_context(named)?;
    let write = "cannot write the output";
    match arguments.format {
        PeriodicFormat::Table => table(&mut out, &scene, &diagram).context(write)?,
        PeriodicFormat::Json => {
            let document = document::bifurcations(scene.start(), (word, cycles), &diagram).with_context(named)?;
            writeln!(out, "{}", serde_json::to_string(&document)?).context(write)?;
        }
    }
    let said_already = arguments.format == PeriodicFormat::Table && out.is_stdout();
    out.commit()?;
    if !diagram.is_certified() && !arguments.quiet && !said_already {
        // Nobody may be listening.
        let _ = writeln!(io::stderr(), "{}", conclusion(&diagram));
    }
    Ok(if diagram.is_certified() { Answer::Complete } else { Answer::Incomplete })
}

fn table(out: &mut impl Write, scene: &Scene, diagram: &Diagram) -> Result<()> {
    heading::write(out, scene)?;
    let Over { key, low, high } = diagram.over();
    writeln!(out, "over {} from {low} to {high}\n", key.place())?;
    if !diagram.points.is_empty() {
        writeln!(out, "{:16} {:>7} {:>6}  {:36} orbit", "kind", "impacts", "cycles", key.place())?;
    }
    for point in &diagram.points {
        let (parameter, _) = diagram.in_units(point)?;
        let symmetric = match point.symmetric {
            Some(true) => "symmetric",
            Some(false) => "not symmetric",
            None => "undecided whether symmetric",
        };
        let physical = match point.orbit.as_ref().and_then(|orbit| orbit.physical) {
            _ if point.kind == Kind::Graze => "",
            Some(true) => ", physical",
            Some(false) => ", not physical: a wall is touched earlier",
            None => ", undecided whether physical",
        };
        let (kind, impacts) = (point.kind.name(), point.impacts.len());
        let digits = decimal_digits(&parameter);
        writeln!(out, "{kind:16} {impacts:7} {:6}  {digits:36} {symmetric}{physical}", point.cycles)?;
    }
    for branch in &diagram.branches {
        let symmetric = if branch.symmetric { ", symmetric" } else { "" };
        let [low, high] = diagram.range_f64(branch.range);
        let [a, b] = branch.ends.map(end);
        let impacts = branch.word.mappings().len();
        let proved = if branch.is_proved { ", proved to be one curve" } else { "" };
        writeln!(
            out,
            "followed: {impacts} impacts in {}{symmetric}, {low:.4} to {high:.4}{proved}; ends: {a}, {b}",
            branch.cycles
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
    Ok(())
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
    let count = diagram.points.len();
    let points = format!("{count} bifurcation{} proved", if count == 1 { "" } else { "s" });
    if diagram.interrupted {
        return format!(
            "interrupted: {points} until then; branches are left that were not followed, or not to their ends"
        );
    }
    let certified = if diagram.is_certified() { "certified: " } else { "undecided: " };
    let hint = if diagram.is_certified() { "" } else { "; try a narrower --over, or more --max-bits" };
    format!("{certified}{points}; others are not excluded (branches are found and followed in floats){hint}")
}
