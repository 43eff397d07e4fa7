//! `impact-pair periodic SCENE --word WORD --cycles N`: the periodic orbits of a word, proved.

use std::fmt::{self, Write};
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use impact_pair::Scene;
use impact_pair::exact::{Enclosure, Exact, decimal_digits};
use impact_pair::json::counted;
use impact_pair::mapping::Word;
use impact_pair::periodic::chain::MOST_CYCLES;
use impact_pair::periodic::{Budget, Census, Eigenvalue, PeriodicOrbit, Problem};
use impact_pair::units::Units;

use crate::Answer;
use crate::destination::{Destination, OpenOutput};
use crate::heading::heading;
use crate::progress::Progress;
use crate::scene;
use crate::values::{PrecisionArguments, whole};

pub const HELP: &str = "\
Examples:
  impact-pair periodic scenes/figure-15.toml --word RRLLL --cycles 1
  impact-pair periodic scenes/figure-13.toml --word \"P2 P1\" --cycles 1 --digits 30 --format json
  impact-pair periodic scenes/figure-13.toml --word RL --cycles 1 --all

Each orbit listed is proved to be the only one within its bounds. Admissible: no flight touches a wall before it \
ends; otherwise the orbit is virtual. Stable: both eigenvalues of the Jacobian of a period lie inside the unit \
circle; unstable: one lies outside; elliptic: e = 1, and both lie on it, apart and not real. Without --all the search starts from the scene's own motion and from a grid of \
initial conditions, and there may be other orbits. Motions with sticking are not searched for, not even with --all: \
for e > 0 they have infinitely many impacts per period, or meet a wall with zero velocity exactly where the contact \
force sets in; for e = 0 each follows from a release, and run proves it from there.

Exit code: 0 everything requested is certified; 1 some of it is not: no orbit was found, or part of one is undecided \
or wider than --digits (the output still has the certified part); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("digits", |digits| digits.help("Requested width of enclosures, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W [default: that of the scene, or 9]")))]
pub struct PeriodicArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// The word, a sequence of mappings, the first one right-most ("P2 P4 P1 P3"), or of walls in time order (RRLL)
    #[arg(long, value_name = "WORD")]
    pub word: Word,
    /// The number of forcing periods 2 pi/W that the orbit takes; W is that of the fastest harmonic
    #[arg(long, value_name = "N", value_parser = whole(1..=MOST_CYCLES))]
    pub cycles: u32,
    /// Search the whole state space, so that the list is complete up to orbits with sticking
    #[arg(long)]
    pub all: bool,
    #[command(flatten)]
    precision: PrecisionArguments,
    /// Output format; json is schema impact-pair/periodic/1 [default: by the extension of --output, else
    /// table]
    #[arg(long, value_enum)]
    pub format: Option<PeriodicFormat>,
    #[command(flatten)]
    pub destination: Destination,
}

/// Output formats of periodic orbits and bifurcations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum PeriodicFormat {
    /// Human-readable: the certain digits, then the last digits of both bounds
    #[default]
    Table,
    /// One document of the schema named above
    Json,
}

pub fn periodic(arguments: &PeriodicArguments) -> Result<Answer> {
    let format = arguments.destination.format(arguments.format)?;
    let OpenOutput { scene, files, path } = arguments.destination.begin(&arguments.scene, None)?;
    let named = || scene::name(path);
    let problem = Problem::new(scene.pair(), &arguments.word, arguments.cycles).with_context(named)?;
    let units = Units::gaps(problem.pair()).with_context(named)?;
    let (start, precision) = (scene.start(), arguments.precision.of(&scene));
    let progress = match arguments.all {
        true => Progress::search(!files.quiet),
        false => Progress::of("searching for orbits", !files.quiet),
    };
    let census = match arguments.all {
        true => problem.find_all_while(start, precision, Budget::default(), &progress),
        false => problem.find_while(start, precision, &progress),
    };
    progress.clear();
    let text = match format {
        PeriodicFormat::Table => table(&scene, &problem, &units, &census)?,
        PeriodicFormat::Json => serde_json::to_string(&units.document(&problem, start, &census))? + "\n",
    };
    let open = (!census.is_certified()).then(|| conclusion(&census, problem.pair().is_point()));
    files.answer(&text, open, format == PeriodicFormat::Table)
}

fn table(scene: &Scene, problem: &Problem, units: &Units<Exact>, census: &Census) -> Result<String, fmt::Error> {
    let mut out = heading(scene);
    let cycles = problem.chain().cycles();
    writeln!(out, "word {} in {}", problem.word(), counted(cycles, "cycle"))?;
    for (i, found) in census.orbits.iter().enumerate() {
        writeln!(out, "\norbit {}: {}", i + 1, described(found))?;
        let [large, small] = found.eigenvalues.each_ref().map(shown);
        writeln!(
            out,
            "  eigenvalues {large}{}{small}",
            if large.len() + small.len() > 80 { "\n          and " } else { " and " }
        )?;
        writeln!(out, "  trace {}, determinant {}", decimal_digits(&found.trace), decimal_digits(&found.determinant))?;
        // The forcing period, and the period of the reduced orbit, in which each impact comes; printed where there is more than one.
        let cycle = |said: &str| if cycles > found.period { format!("{said:>5}  ") } else { String::new() };
        let turn = |said: &str| if found.period > 1 { format!("{said:>4}  ") } else { String::new() };
        writeln!(out, "  {:5}  {}{}{:31}  velocity before", "wall", cycle("cycle"), turn("turn"), "phase W t + tau")?;
        for (impact, turns) in units.measured(found).impacts.iter().zip(&found.impacts) {
            let (cycle, turn) = (
                cycle(&(turns.cycle() - found.impacts[0].cycle()).to_string()),
                turn(&impact.turn.unwrap_or_default().to_string()),
            );
            let [phase, velocity] = [&impact.phase, &impact.velocity].map(decimal_digits);
            writeln!(out, "  {:5}  {cycle}{turn}{phase:31}  {velocity}", impact.wall.name())?;
        }
    }
    writeln!(out, "\n{}", conclusion(census, problem.pair().is_point()))?;
    Ok(out)
}

/// Returns in words whether an orbit is admissible.
pub fn physical(known: Option<bool>) -> &'static str {
    match known {
        Some(true) => "admissible",
        Some(false) => "virtual: a wall is touched earlier",
        None => "undecided whether admissible",
    }
}

/// Returns in words whether an orbit is its own mirror image.
pub fn symmetric(known: Option<bool>) -> &'static str {
    match known {
        Some(true) => "symmetric",
        Some(false) => "not symmetric",
        None => "undecided whether symmetric",
    }
}

/// Returns the properties of an orbit, in words.
fn described(orbit: &PeriodicOrbit) -> String {
    let (physical, symmetric) = (physical(orbit.physical), symmetric(orbit.symmetric));
    let repeats = match orbit.repeats {
        Some(1) => String::new(),
        Some(times) => format!(", a shorter orbit traversed {times} times"),
        None => ", or a shorter one traversed more than once".into(),
    };
    let stability = match orbit.stability.name() {
        "undecided" => "undecided whether stable",
        name => name,
    };
    format!("{stability}, {physical}, {symmetric}{repeats}")
}

/// A real or complex number with the digits that are certain.
fn shown(value: &Eigenvalue) -> String {
    let is_zero = |x: &Enclosure| x.is_point() && x.inf().is_zero();
    let re = decimal_digits(&value.re);
    if is_zero(&value.im) { re } else { format!("{re} + {} i", decimal_digits(&value.im)) }
}

/// Returns the number of orbits, in words.
pub fn orbits(count: usize) -> String {
    if count == 0 { "no orbit".to_owned() } else { counted(count, "orbit") }
}

/// The last line: how much of what was asked is proved, for point data or with intervals among them.
fn conclusion(census: &Census, is_point: bool) -> String {
    let orbits = orbits(census.orbits.len());
    let rest = match (census.exhaustive, census.is_search, census.undecided.len()) {
        (true, ..) if census.orbits.is_empty() => return "certified: there is no orbit without sticking".to_owned(),
        (true, ..) => "there is no other admissible one without sticking".to_owned(),
        (false, true, _) if census.is_family => {
            return "not certified: with A = 0 and e = 1 the orbits are a family, one at each phase, and none is isolated".to_owned();
        }
        (false, true, open) => format!("{} of the state space may hold others", counted(open, "part")),
        (false, false, _) => "others are not excluded (try --all)".to_owned(),
    };
    let open = census.orbits.iter().filter(|orbit| !orbit.is_decided()).count();
    let wide = census.orbits.iter().filter(|orbit| !orbit.is_narrow).count();
    let mut said = format!("{orbits} proved; {}{rest}", if census.interrupted { "interrupted, " } else { "" });
    if open > 0 {
        said += &format!("; {open} partly undecided");
    }
    if wide > 0 {
        let advice = if is_point { "try fewer --digits or more --max-bits" } else { "try fewer --digits" };
        said += &format!("; {wide} wider than requested ({advice})");
    }
    format!("{}: {said}", if census.is_certified() { "certified" } else { "not all certified" })
}
