//! `impact-pair sweep SCENE --over KEY=LO..HI:COUNT`: bifurcation diagrams, exponents and basins over a grid.

pub mod arguments;

use anyhow::{Context, Result, bail};
use impact_pair::json::SweepHead;
use impact_pair_answers::grid::{Points, Survey, beside};
use impact_pair_answers::sweep::Table;

use crate::Answer;
use crate::grid::{self, GridFormat, compute, merge, open_once};
use crate::output::Output;
use crate::scene;
use crate::verb::placed;
use arguments::{FORMATS, SweepArguments};

pub fn sweep(arguments: &SweepArguments) -> Result<Answer> {
    keep_files_apart(arguments)?;
    let SweepArguments { grid, destination, states, plot, .. } = arguments;
    let output = grid::format(arguments.format, destination, grid.shard.is_some(), FORMATS)?;
    let formats = (output, grid::format_of_states(states.as_deref(), output)?);
    let finish = |sweep: &mut Points<SweepHead>| finish(arguments, sweep, formats);
    let Some(path) = &arguments.scene else {
        let sweep = Points::<SweepHead>::merged(&grid.merge)?;
        keep_states(arguments, output, sweep.head.summary)?;
        return merge(sweep, destination.quiet, finish);
    };
    keep_states(arguments, output, arguments.options.summary)?;
    let about = |failure| placed(failure, path);
    let sweep = arguments.options.of(&scene::read(path)?, grid.shard()).map_err(about)?;
    sweep.check().map_err(about)?;
    open_once(&[&destination.output, states, plot].map(Option::as_deref))?;
    compute(&sweep, &scene::name(path), (grid, destination), finish)
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

/// Refuses to write states where there are none, or no table of them.
///
/// # Errors
/// Returns an error if the sweep is a shard, a summary, or written as JSON Lines, whose lines hold the states.
fn keep_states(arguments: &SweepArguments, output: GridFormat, is_summary: bool) -> Result<()> {
    if arguments.states.is_none() {
        return Ok(());
    }
    if arguments.grid.shard.is_some() {
        bail!("--states writes a table, but a shard is written as jsonl: ask --merge for the states");
    }
    if output == GridFormat::Jsonl {
        bail!("--states writes a table, but a line of jsonl holds a point with its states: use csv or parquet");
    }
    if is_summary {
        bail!("--states writes the impacts, but a sweep with --summary has none");
    }
    Ok(())
}

/// Writes states, output and plot.
fn finish(
    arguments: &SweepArguments,
    sweep: &mut Points<SweepHead>,
    (output, states): (GridFormat, GridFormat),
) -> Result<()> {
    let mut out = Output::open(arguments.destination.output.as_deref())?;
    if let Some(path) = &arguments.states {
        let mut file = Output::open(Some(path))?;
        grid::write(sweep, &mut file, states, Table::States).context("cannot write the states")?;
        file.commit()?;
    }
    let table = if arguments.states.is_some() { Table::Points } else { Table::Mixed };
    // With a picture alone thousands of rows would run over the terminal.
    if arguments.plot.is_none() || arguments.destination.output.is_some() || arguments.format.is_some() {
        grid::write(sweep, &mut out, output, table).context("cannot write the output")?;
    }
    out.commit()?;
    let Some(path) = &arguments.plot else { return Ok(()) };
    let svg = impact_pair_plot::sweep::svg(sweep, arguments.show, arguments.within, &arguments.look);
    Output::open(Some(path))?.draw(path, &arguments.look, svg)
}
