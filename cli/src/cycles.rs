//! `impact-pair cycles SCENE --impacts LO..HI`: all periodic orbits of a trapping region, proved.

use std::fmt::{self, Write};
use std::ops::RangeInclusive;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use impact_pair::chaos::{Cycle, Cycles, MOST_IMPACTS, NoTrap};
use impact_pair::exact::decimal_digits;
use impact_pair::json::counted;
use impact_pair::pair::Wall;
use impact_pair::periodic::{Precision, Stability};
use impact_pair::watch::Watch;
use impact_pair::{Effort, Scene};

use crate::Answer;
use crate::destination::{Destination, OpenOutput};
use crate::output::note;
use crate::periodic::PeriodicFormat;
use crate::progress::Progress;
use crate::scene;
use crate::trap;
use impact_pair_answers::heading;
use impact_pair_answers::values::{digits, numbers};

pub const HELP: &str = "\
Examples:
  impact-pair cycles scenes/figure-14.toml --impacts 1..7
  impact-pair cycles scenes/figure-14.toml --impacts 1..5 --format json --output cycles.json

In the trapping region of the verb trap, with every impact mirrored to the left wall, a periodic orbit and its \
mirror image are one cycle. All periodic orbits of period n of the impact map are found: chains of boxes that the \
region allows are contracted by Newton's impact law until each is excluded or holds one proved cycle. The output \
counts the fixed points of the n-th iterate, including those of shorter cycles, and the cycles of least period n. \
Cycles on a single wall, or with an odd number of crossings, are counted as well. Outside the region there may be \
others. One harmonic only.

Exit code: 0 the list is proved complete, with the stability of each cycle; 1 something is undecided, or the run was \
interrupted (the proved part is written); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
pub struct CyclesArguments {
    /// Scene file (TOML), or - for stdin
    scene: PathBuf,
    /// Number of impacts of the cycles, a range 1..N or a single number; each further impact takes up to twice as long
    #[arg(long, value_name = "LO..HI", value_parser = numbers(1..=MOST_IMPACTS), allow_hyphen_values = true)]
    impacts: RangeInclusive<u32>,
    /// Requested width of enclosures, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W [default: that of the scene, or 9]
    #[arg(long, value_name = "D", value_parser = digits())]
    digits: Option<u32>,
    /// Multiply the work by X, to decide more: 2, 4, .., 64 bisect the boxes of the coarsest region once, twice, .., 6 times
    #[arg(long, value_name = "X", default_value_t)]
    effort: Effort,
    /// Output format; json is schema impact-pair/cycles/1
    /// [default: by the extension of --output, else table]
    #[arg(long, value_enum)]
    format: Option<PeriodicFormat>,
    #[command(flatten)]
    destination: Destination,
}

pub fn cycles(arguments: &CyclesArguments) -> Result<Answer> {
    let format = arguments.destination.format(arguments.format)?;
    let OpenOutput { scene, files, path } = arguments.destination.begin(&arguments.scene, None)?;
    let named = || scene::name(path);
    let usual = Precision::default();
    let digits = arguments.digits.or(scene.run().digits).unwrap_or(usual.digits);
    let progress = Progress::stages(!files.quiet);
    let precision = Precision { digits, ..usual };
    let found = Cycles::of(&scene, arguments.effort, &arguments.impacts, precision, &progress).with_context(named)?;
    progress.clear();
    let found = found.as_ref().map_err(|why| *why);
    if let Some(why) = found.ok().and_then(|found| found.trap().coarser()) {
        note(files.quiet, &trap::not_finer(why));
    }
    let text = match format {
        PeriodicFormat::Table => table(&scene, found, &progress)?,
        PeriodicFormat::Json => {
            serde_json::to_string(&Cycles::document(&scene, &arguments.impacts, found).with_context(named)?)? + "\n"
        }
    };
    let is_certified = found.is_ok_and(Cycles::is_certified);
    let open = (!is_certified).then(|| conclusion(found, &progress));
    files.answer(&text, open, format == PeriodicFormat::Table)
}

fn table(scene: &Scene, found: Result<&Cycles, NoTrap>, progress: &Progress) -> Result<String, fmt::Error> {
    let mut out = heading(scene);
    if let Ok(found) = found {
        writeln!(out, "region of {} boxes\n", found.trap().boxes())?;
        writeln!(out, "impacts  fixed points  cycles  stable")?;
        for impacts in found.requested().clone() {
            let count = found.fixed_points().get(&(impacts as usize)).map_or("?".to_owned(), ToString::to_string);
            let own = || found.cycles().iter().filter(|cycle| cycle.impacts == impacts as usize);
            let stable = own().filter(|cycle| cycle.orbit.stability == Stability::Stable).count();
            writeln!(out, "{impacts:>7}  {count:>12}  {:>6}  {stable:>6}", own().count())?;
        }
        if !found.cycles().is_empty() {
            writeln!(out, "\nimpacts  {:10}  {:13}  {:22}       time  walls", "stability", "", "largest eigenvalue")?;
        }
        for cycle in found.cycles() {
            writeln!(out, "{}", row(cycle))?;
        }
    }
    writeln!(out, "\n{}", conclusion(found, progress))?;
    Ok(out)
}

/// Returns the line of a cycle.
fn row(cycle: &Cycle) -> String {
    let Cycle { impacts, problem, orbit } = cycle;
    let symmetric = match orbit.symmetric {
        Some(true) => "symmetric",
        Some(false) => "not symmetric",
        None => "undecided",
    };
    let largest = &orbit.eigenvalues[0];
    let turned = if largest.im.is_point() && largest.im.inf().is_zero() {
        String::new()
    } else {
        format!(" + {} i", decimal_digits(&largest.im))
    };
    let eigenvalue = decimal_digits(&largest.re) + &turned;
    let time = counted(problem.chain().cycles(), "cycle");
    let stability = orbit.stability;
    let walls: String =
        problem.chain().walls().iter().map(|&wall| if wall == Wall::Left { 'L' } else { 'R' }).collect();
    format!("{impacts:>7}  {stability:10}  {symmetric:13}  {eigenvalue:22}  {time:>9}  {walls}")
}

/// Returns the last line of the table: whether everything requested is proved.
fn conclusion(found: Result<&Cycles, NoTrap>, progress: &Progress) -> String {
    let found = match found {
        Ok(found) => found,
        Err(why) => return format!("undecided: no region is proved; {}", why.words()),
    };
    let (low, high) = (found.requested().start(), found.requested().end());
    let requested = if low == high { counted(*low, "impact") } else { format!("{low} to {high} impacts") };
    // Those of fewer impacts are listed where they are fixed points of the same iterate.
    let own = found.cycles().iter().filter(|cycle| cycle.impacts >= *low as usize).count();
    let shorter = match found.cycles().len() - own {
        0 => String::new(),
        1 => ", and one of fewer impacts that returns after as many".to_owned(),
        count => format!(", and {count} of fewer impacts that return after as many"),
    };
    let of = |sought| found.cycles().iter().filter(|cycle| cycle.orbit.stability == sought).count();
    let (stable, open) = (of(Stability::Stable), of(Stability::Undecided));
    let attracts = match (stable, open) {
        (0, 0) => "none of them attracts".to_owned(),
        (stable, 0) => format!("{stable} of them attracting"),
        (stable, open) => format!("{stable} of them attracting, undecided for {open}"),
    };
    if found.is_exhaustive() {
        let certified = if found.is_certified() { "certified" } else { "not all certified" };
        let all = match own {
            0 => format!("the region has no cycle of {requested}"),
            1 => format!("the region has exactly one cycle of {requested}"),
            count => format!("the region has exactly {count} cycles of {requested}"),
        };
        let attracts = match (found.cycles().len(), stable) {
            (0, _) => String::new(),
            (1, 1) => "; it attracts".to_owned(),
            _ => format!("; {attracts}"),
        };
        return format!("{certified}: {all}{shorter}{attracts}");
    }
    let missing: Vec<String> = found
        .requested()
        .clone()
        .filter(|n| !found.fixed_points().contains_key(&(*n as usize)))
        .map(|n| n.to_string())
        .collect();
    format!(
        "{}: {} proved, {attracts}; there may be others of {} impacts ({} left)",
        if progress.goes_on() { "not all certified" } else { "interrupted" },
        counted(found.cycles().len() as u32, "cycle"),
        missing.join(", "),
        counted(found.undecided().len() as u32, "part"),
    )
}
