//! `periodic`: the periodic orbits of a word, proved.

use std::fmt::{self, Write};

use anyhow::Result;
use clap::Args;
use impact_pair::Scene;
use impact_pair::exact::{Enclosure, Exact, decimal_digits};
use impact_pair::json::{PeriodicDocument, SearchWitness, counted};
use impact_pair::mapping::Word;
use impact_pair::periodic::chain::MOST_CYCLES;
use impact_pair::periodic::{Budget, Census, Eigenvalue, PeriodicOrbit, Problem, Stability};
use impact_pair::units::Units;
use impact_pair::watch::Watch;

use crate::values::{PrecisionArguments, whole};
use crate::{Answer, Asked, Counts, Failure, Format, Status, Step, TABLE_OR_JSON, Verb, WitnessOptions, heading, line};

/// Options of `periodic`.
#[derive(Args, Clone, Debug)]
#[command(mut_arg("digits", |digits| digits.help("Requested width of enclosures, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W [default: that of the scene, or 9]")))]
pub struct PeriodicOptions {
    /// The word, a sequence of mappings, the first one right-most ("P2 P4 P1 P3"), or of walls in time order (RRLL)
    #[arg(long, value_name = "WORD")]
    pub word: Word,
    /// The number of forcing periods 2 pi/W that the orbit takes; W is that of the fastest harmonic
    #[arg(long, value_name = "N", value_parser = whole(1..=MOST_CYCLES))]
    pub cycles: u32,
    /// Search the whole state space, so that the list is complete up to orbits with sticking
    #[arg(long)]
    pub all: bool,
    /// Width of the enclosures.
    #[command(flatten)]
    pub precision: PrecisionArguments,
    /// Whether the tree of a search is part of its document.
    #[command(flatten)]
    pub witness: WitnessOptions,
}

/// The proved orbits of a word.
pub struct Periodic<'s> {
    scene: &'s Scene,
    problem: Problem,
    units: Units<Exact>,
    census: Census,
    witness: Option<SearchWitness>,
}

impl Verb for PeriodicOptions {
    const NAME: &'static str = "periodic";
    const FORMATS: &'static [(Format, &'static str)] = TABLE_OR_JSON;
    const SCHEMA: &'static str = "impact-pair/periodic/1";
    type Answer<'s> = Periodic<'s>;

    fn counts(&self, _: &Scene) -> Counts {
        if self.all { Counts::Cells } else { Counts::Nothing("searching for orbits") }
    }

    fn answer<'s>(&self, asked: &Asked<'s>, watch: &dyn Watch) -> Result<Periodic<'s>, Failure> {
        let Asked { scene, is_document, .. } = asked;
        let problem = Problem::new(scene.pair(), &self.word, self.cycles)?;
        let units = Units::gaps(problem.pair())?;
        let (start, precision) = (scene.start(), self.precision.of(scene));
        let census = match self.all {
            true => problem.find_all_while(start, precision, Budget::default(), watch),
            false => problem.find_while(start, precision, watch),
        };
        let has_witness = *is_document && !self.witness.no_witness;
        let witness = has_witness.then(|| problem.search_witness(&census, precision, watch));
        Ok(Periodic { scene, problem, units, census, witness: witness.flatten() })
    }
}

impl Answer for Periodic<'_> {
    fn status(&self) -> Status {
        let census = &self.census;
        let is_certified = census.is_certified();
        if census.exhaustive && census.orbits.is_empty() {
            return Status::new(is_certified, "certified: there is no orbit without sticking");
        }
        if !census.exhaustive && census.is_search && census.is_family {
            let family = "with A = 0 and e = 1 the orbits are a family, one at each phase, and none is isolated";
            return Status::new(is_certified, format!("not certified: {family}"));
        }
        let said = if is_certified { "certified" } else { "not all certified" };
        let interrupted = if census.interrupted { "interrupted, " } else { "" };
        let mut status =
            Status::new(is_certified, format!("{said}: {} proved; {interrupted}", orbits(census.orbits.len())));
        status = match (census.exhaustive, census.is_search) {
            (true, _) => status.say("there is no other admissible one without sticking"),
            (false, true) => {
                status.say(format!("{} of the state space may hold others", counted(census.undecided.len(), "part")))
            }
            (false, false) => status.say("others are not excluded (try ").step(Step::Set("all")).say(")"),
        };
        let open = census.orbits.iter().filter(|orbit| !orbit.is_decided()).count();
        let wide = census.orbits.iter().filter(|orbit| !orbit.is_narrow).count();
        if open > 0 {
            status = status.say(format!("; {open} partly undecided"));
        }
        if wide > 0 {
            status = status.say(format!("; {wide} wider than requested (try ")).step(Step::Fewer("digits"));
            if self.problem.pair().is_point() {
                status = status.say(" or ").step(Step::More("max-bits"));
            }
            status = status.say(")");
        }
        status
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        Ok(Some(match format {
            Format::Json => {
                let document = self.units.document(&self.problem, self.scene.start(), &self.census);
                line(&PeriodicDocument { witness: self.witness.clone(), ..document })?
            }
            _ => self.table()?,
        }))
    }
}

impl Periodic<'_> {
    fn table(&self) -> Result<String, fmt::Error> {
        let Self { scene, problem, units, census, .. } = self;
        let mut out = heading(scene);
        let cycles = problem.chain().cycles();
        writeln!(out, "word {} in {}", problem.word(), counted(cycles, "cycle"))?;
        for (i, found) in census.orbits.iter().enumerate() {
            writeln!(out, "\norbit {}: {}", i + 1, described(found))?;
            let [large, small] = found.eigenvalues.each_ref().map(shown);
            let and = if large.len() + small.len() > 80 { "\n          and " } else { " and " };
            writeln!(out, "  eigenvalues {large}{and}{small}")?;
            writeln!(
                out,
                "  trace {}, determinant {}",
                decimal_digits(&found.trace),
                decimal_digits(&found.determinant)
            )?;
            // The forcing period, and the period of the reduced orbit, in which each impact comes; printed where there is more than one.
            let cycle = |said: &str| if cycles > found.period { format!("{said:>5}  ") } else { String::new() };
            let turn = |said: &str| if found.period > 1 { format!("{said:>4}  ") } else { String::new() };
            writeln!(
                out,
                "  {:5}  {}{}{:31}  velocity before",
                "wall",
                cycle("cycle"),
                turn("turn"),
                "phase W t + tau"
            )?;
            for (impact, turns) in units.measured(found).impacts.iter().zip(&found.impacts) {
                let (cycle, turn) = (
                    cycle(&(turns.cycle() - found.impacts[0].cycle()).to_string()),
                    turn(&impact.turn.unwrap_or_default().to_string()),
                );
                let [phase, velocity] = [&impact.phase, &impact.velocity].map(decimal_digits);
                writeln!(out, "  {:5}  {cycle}{turn}{phase:31}  {velocity}", impact.wall.name())?;
            }
        }
        writeln!(out, "\n{}", self.status())?;
        Ok(out)
    }
}

/// Whether an orbit is admissible, in words.
pub fn physical(known: Option<bool>) -> &'static str {
    match known {
        Some(true) => "admissible",
        Some(false) => "virtual: a wall is touched earlier",
        None => "undecided whether admissible",
    }
}

/// Whether an orbit is its own mirror image, in words.
pub fn symmetric(known: Option<bool>) -> &'static str {
    match known {
        Some(true) => "symmetric",
        Some(false) => "not symmetric",
        None => "undecided whether symmetric",
    }
}

/// The properties of an orbit, in words.
fn described(orbit: &PeriodicOrbit) -> String {
    let (physical, symmetric) = (physical(orbit.physical), symmetric(orbit.symmetric));
    let repeats = match orbit.repeats {
        Some(1) => String::new(),
        Some(times) => format!(", a shorter orbit traversed {times} times"),
        None => ", or a shorter one traversed more than once".into(),
    };
    let stability = match orbit.stability {
        Stability::Undecided => "undecided whether stable".to_owned(),
        proved => proved.to_string(),
    };
    format!("{stability}, {physical}, {symmetric}{repeats}")
}

/// A real or complex number with the digits that are certain.
fn shown(value: &Eigenvalue) -> String {
    let is_zero = |x: &Enclosure| x.is_point() && x.inf().is_zero();
    let re = decimal_digits(&value.re);
    if is_zero(&value.im) { re } else { format!("{re} + {} i", decimal_digits(&value.im)) }
}

/// The number of orbits, in words.
pub(crate) fn orbits(count: usize) -> String {
    if count == 0 { "no orbit".to_owned() } else { counted(count, "orbit") }
}
