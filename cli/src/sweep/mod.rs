//! `impact-pair sweep SCENE --over KEY=LO..HI:COUNT`: bifurcation diagrams, exponents and basins over a grid.

pub mod arguments;
mod formats;
mod write;

use std::path::Path;

use anyhow::{Context, Result, bail};
use impact_pair::Scene;
use impact_pair::json::SweepHead;
use impact_pair::json::counted;
use impact_pair::json::vocabulary::PointOutcome;
use impact_pair::orbit::{Orbit, Settings};
use impact_pair::sweep::{self, Grid, PointSettings, Table, follow};
use impact_pair_plot::records::Records;

use crate::Answer;
use crate::grid::{Gathered, Tally, Work, answered, named, open_once};
use crate::output::{Output, note};
use crate::progress::Interruption;
use crate::scene::{self, ranged};
use arguments::SweepArguments;
use formats::Formats;
use impact_pair_answers::grid::beside;
use impact_pair_answers::grid::line;
use write::write;

pub fn sweep(arguments: &SweepArguments) -> Result<Answer> {
    keep_files_apart(arguments)?;
    match &arguments.scene {
        Some(path) => compute(arguments, path),
        None => merge(arguments),
    }
}

/// Refuses to write one file over another one.
fn keep_files_apart(arguments: &SweepArguments) -> Result<()> {
    let inputs: Vec<_> = arguments.scene.iter().chain(&arguments.grid.merge).collect();
    let (output, plot) = (arguments.destination.output.as_deref(), arguments.plot.as_deref());
    scene::keep_apart(&inputs, output, plot)?;
    let Some(states) = arguments.states.as_deref() else { return Ok(()) };
    inputs.iter().try_for_each(|input| scene::keep(input, Some(states)))?;
    let named = ("--states", Some(states));
    scene::differ(("--output", output), named)?;
    scene::differ(("--plot", plot), named)?;
    if scene::is_stdio(states) && output.is_none_or(scene::is_stdio) {
        bail!("--output and --states are both stdout, but are separate tables");
    }
    if output.and_then(beside).is_some_and(|partial| scene::is_same_file(&partial, states)) {
        bail!("cannot write {}: finished points are kept there until --output appears", states.display());
    }
    Ok(())
}

fn compute(arguments: &SweepArguments, path: &Path) -> Result<Answer> {
    let formats = Formats::of(arguments)?;
    formats.keep_states(arguments, arguments.summary)?;
    let scene: Scene = scene::read(path)?;
    let grid = Grid::new(ranged(&arguments.over, &scene, path)?)?;
    let SweepArguments { digits, arithmetic, max_bits, .. } = *arguments;
    let settings = Settings { digits, arithmetic, max_bits, ..Settings::default() };
    let SweepArguments { transient, impacts, summary, .. } = *arguments;
    let ranges: Vec<_> = grid.axes().iter().map(|axis| (axis.key(), axis.to_string())).collect();
    let reference = grid.reference(&scene).map_err(|error| scene::about(error, &ranges, path))?;
    let requested = PointSettings { transient, impacts, summary, reference, settings };
    let head = sweep::head(&scene, &grid, &requested, arguments.grid.shard());
    // All corners of the grid are scenes, before anything is computed.
    let is_scene =
        |point: u64| Orbit::of(&grid.scene(&scene, &grid.values(point)?)?, requested.settings.clone()).map(drop);
    grid.corners().into_iter().try_for_each(is_scene).map_err(|error| scene::about(error, &ranges, path))?;
    let outputs = [&arguments.destination.output, &arguments.states, &arguments.plot].map(Option::as_deref);
    open_once(&outputs)?;
    let point = |point: u64| {
        let values = grid.values(point)?;
        let at = || named(point, &values);
        let scene = grid.scene(&scene, &values).with_context(at)?;
        let found = follow(&scene, &requested, &Interruption).with_context(at)?;
        Ok(found.map(|found| line(&sweep::record(point, &values, &found))))
    };
    let (grid, destination) = (&arguments.grid, &arguments.destination);
    let work = Work { head, point: &point, grid, destination };
    work.answer(&scene::name(path), |sweep| finish(arguments, sweep, formats))
}

/// Puts the shards of a sweep together.
fn merge(arguments: &SweepArguments) -> Result<Answer> {
    let formats = Formats::of(arguments)?;
    let mut sweep = Gathered::<SweepHead>::merged(&arguments.grid.merge)?;
    formats.keep_states(arguments, sweep.head.summary)?;
    let tally = finish(arguments, &mut sweep, formats)?;
    note(arguments.destination.quiet, &tally.to_string());
    Ok(answered(&tally))
}

/// Writes states, output and plot.
fn finish(arguments: &SweepArguments, sweep: &mut Gathered<SweepHead>, formats: Formats) -> Result<Outcomes> {
    let mut tally = Outcomes::default();
    let certified = sweep.head.certified;
    sweep.each_record(|record| {
        tally.add(record.outcome, record.complete);
        Ok(())
    })?;
    tally.certified = certified;
    let mut out = Output::open(arguments.destination.output.as_deref())?;
    if let Some(path) = &arguments.states {
        let mut states = Output::open(Some(path))?;
        write(sweep, &mut states, formats.states, Table::States).context("cannot write the states")?;
        states.commit()?;
    }
    let table = if arguments.states.is_some() { Table::Points } else { Table::Mixed };
    // With a picture alone thousands of rows would run over the terminal.
    if arguments.plot.is_none() || arguments.destination.output.is_some() || arguments.format.is_some() {
        write(sweep, &mut out, formats.output, table).context("cannot write the output")?;
    }
    out.commit()?;
    if let Some(path) = &arguments.plot {
        Output::open(Some(path))?.draw(
            path,
            &arguments.look,
            impact_pair_plot::sweep::svg(sweep, arguments.show, arguments.within, &arguments.look),
        )?;
    }
    Ok(tally)
}

/// The numbers of points by outcome.
#[derive(Default)]
struct Outcomes {
    outcomes: Vec<(PointOutcome, u64)>,
    incomplete: u64,
    certified: bool,
}

impl Outcomes {
    fn add(&mut self, outcome: PointOutcome, complete: bool) {
        match self.outcomes.iter_mut().find(|(known, _)| *known == outcome) {
            Some((_, count)) => *count += 1,
            None => self.outcomes.push((outcome, 1)),
        }
        self.incomplete += u64::from(!complete);
    }
}

impl Tally for Outcomes {
    fn is_complete(&self) -> bool {
        self.incomplete == 0
    }
}

impl std::fmt::Display for Outcomes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let points: u64 = self.outcomes.iter().map(|(_, count)| count).sum();
        let mut outcomes = self.outcomes.clone();
        outcomes.sort();
        let outcomes: Vec<String> = outcomes.iter().map(|(outcome, count)| format!("{count} {outcome}")).collect();
        let word = match (self.certified, self.incomplete) {
            (false, _) => "computed, not certified".to_owned(),
            (true, 0) => "certified".to_owned(),
            (true, some) => format!("not all certified, {some} incomplete"),
        };
        write!(f, "{word}: {}, {}", counted(points, "point"), outcomes.join(", "))
    }
}
