//! `impact-pair sweep SCENE --over KEY=LO..HI:COUNT`: bifurcation diagrams, exponents and basins over a grid.

pub mod arguments;
mod formats;
mod journal;
#[cfg(feature = "parquet")]
mod parquet;
mod points;
mod record;
mod work;
mod write;

use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::thread;
use std::time::Instant;

use anyhow::{Context, Result, bail};
use impact_pair::Scene;
use impact_pair::json::SweepHead;
use impact_pair::orbit::{Arithmetic, Settings};
use impact_pair::sweep::{self, Grid, PointSettings, Table};
use impact_pair::watch::Watch;
use impact_pair_plot::sweep::Records;

use crate::Answer;
use crate::output::Output;

use crate::progress::{Interruption, catch_interruption};
use crate::scene;
use arguments::SweepArguments;
use formats::Formats;
use journal::{Journal, difference};
use points::Sweep;
use work::Work;
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
    let inputs: Vec<_> = arguments.scene.iter().chain(&arguments.merge).collect();
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
    if output.and_then(journal::beside).is_some_and(|partial| scene::is_same_file(&partial, states)) {
        bail!("cannot write {}: finished points are kept there until --output appears", states.display());
    }
    Ok(())
}

fn compute(arguments: &SweepArguments, path: &Path) -> Result<Answer> {
    let formats = Formats::of(arguments)?;
    formats.keep_states(arguments, arguments.summary)?;
    let scene: Scene = scene::read(path)?;
    let grid = Grid::new(arguments.over.clone())?;
    let usual = if arguments.plot.is_some() { Arithmetic::Shadow } else { Arithmetic::Auto };
    let arithmetic = arguments.arithmetic.unwrap_or(usual);
    let (digits, max_bits) = (arguments.digits, arguments.max_bits);
    let settings = Settings { digits, arithmetic, max_bits, ..Settings::default() };
    let SweepArguments { transient, impacts, summary, .. } = *arguments;
    let ranges: Vec<_> = arguments.over.iter().map(|axis| (axis.key, axis.to_string())).collect();
    let reference = grid.reference(&scene).map_err(|error| scene::about(error, &ranges, path))?;
    let asked = PointSettings { transient, impacts, summary, reference, settings };
    let head = sweep::head(&scene, &grid, &asked, arguments.shard.map(|shard| [shard.number, shard.of]));
    let threads = match arguments.threads {
        Some(threads) => threads.into(),
        None => thread::available_parallelism().map_or(1, usize::from),
    };
    let work = Work { scene: &scene, grid: &grid, asked: &asked, threads };
    work.check().map_err(|error| scene::about(error, &ranges, path))?;
    // What cannot be written is refused now and not after hours.
    for output in [&arguments.destination.output, &arguments.states, &arguments.plot].into_iter().flatten() {
        drop(Output::open(Some(output))?);
    }

    // From here on Ctrl-C keeps what is finished.
    catch_interruption();
    let mut journal = Journal::open(head.clone(), arguments.destination.output.as_deref(), arguments.resume)?;
    let (begun, before) = (Instant::now(), journal.points());
    let visible = !arguments.destination.quiet && io::stderr().is_terminal();
    work.complete(&mut journal, visible).with_context(|| scene::name(path))?;
    let computed = journal.points() - before;
    let left = journal.missing().len();
    if left > 0 && !Interruption.goes_on() && journal.path().is_some() {
        let path = journal.path().map(|path| path.display().to_string()).unwrap_or_default();
        let points = journal.points();
        note(
            arguments,
            &format!("interrupted: {points} points are kept in {path}, {left} are left (go on with --resume)"),
        );
        return Ok(Answer::Incomplete);
    }
    let seconds = begun.elapsed().as_secs_f64();
    let rate = format!("{computed} in {seconds:.1} s, {:.1} a second", computed as f64 / seconds.max(1e-9));
    let mut sweep = Sweep { head, journals: vec![journal] };
    let tally = finish(arguments, &mut sweep, formats)?;
    sweep.journals.into_iter().try_for_each(Journal::finish)?;
    let lacks = if left > 0 { format!("; interrupted, {left} points are left") } else { String::new() };
    note(arguments, &format!("{tally} ({rate}){lacks}"));
    Ok(if tally.is_complete() && left == 0 { Answer::Complete } else { Answer::Incomplete })
}

/// Puts the shards of a sweep together.
fn merge(arguments: &SweepArguments) -> Result<Answer> {
    let formats = Formats::of(arguments)?;
    let journals: Vec<Journal> = arguments.merge.iter().map(|path| Journal::read(path)).collect::<Result<_>>()?;
    let whole = |journal: &Journal| SweepHead { shard: None, ..journal.head.clone() };
    let name = |i: usize| arguments.merge[i].display();
    let head = whole(&journals[0]);
    let mut seen = Vec::new();
    for (i, journal) in journals.iter().enumerate() {
        let Some([number, of]) = journal.head.shard else { bail!("{} is a whole sweep, not a shard", name(i)) };
        if whole(journal) != head {
            let difference = difference(&journal.head, &SweepHead { shard: journal.head.shard, ..head });
            bail!("{} and {} are of different sweeps: {difference}", name(i), name(0));
        }
        let parts = journals[0].head.shard.map_or(0, |[_, of]| of);
        if of != parts {
            bail!("{} is one of {of} shards, but {} is one of {parts}", name(i), name(0));
        }
        if seen.contains(&number) {
            bail!("{} is shard {number}/{of}, which is given twice", name(i));
        }
        if let Some(point) = journal.missing().first() {
            bail!("{} lacks point {point}: the shard is not finished", name(i));
        }
        seen.push(number);
    }
    let of = journals[0].head.shard.map_or(0, |[_, of]| of);
    if let Some(number) = (1..=of).find(|number| !seen.contains(number)) {
        bail!("shard {number}/{of} is missing");
    }
    formats.keep_states(arguments, head.summary)?;
    let mut sweep = Sweep { head, journals };
    let tally = finish(arguments, &mut sweep, formats)?;
    note(arguments, &tally.to_string());
    Ok(if tally.is_complete() { Answer::Complete } else { Answer::Incomplete })
}

/// Writes states, output and plot.
fn finish(arguments: &SweepArguments, sweep: &mut Sweep, formats: Formats) -> Result<Tally> {
    let mut tally = Tally::default();
    let certified = sweep.head.certified;
    sweep.each_record(|record| {
        tally.add(&record.outcome, record.complete);
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
    write(sweep, &mut out, formats.output, table).context("cannot write the output")?;
    out.commit()?;
    if let Some(path) = &arguments.plot {
        Output::open(Some(path))?.draw(path, &arguments.look, || {
            impact_pair_plot::sweep::svg(sweep, arguments.show, arguments.within, &arguments.look)
        })?;
    }
    Ok(tally)
}

/// How many points have which outcome.
#[derive(Default)]
struct Tally {
    outcomes: Vec<(String, u64)>,
    incomplete: u64,
    certified: bool,
}

impl Tally {
    fn add(&mut self, outcome: &str, complete: bool) {
        match self.outcomes.iter_mut().find(|(known, _)| known == outcome) {
            Some((_, count)) => *count += 1,
            None => self.outcomes.push((outcome.to_owned(), 1)),
        }
        self.incomplete += u64::from(!complete);
    }

    fn is_complete(&self) -> bool {
        self.incomplete == 0
    }
}

impl std::fmt::Display for Tally {
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
        write!(f, "{word}: {points} points, {}", outcomes.join(", "))
    }
}

fn note(arguments: &SweepArguments, text: &str) {
    if !arguments.destination.quiet {
        // Nobody may be listening.
        let _ = writeln!(io::stderr(), "{text}");
    }
}
