//! `cycles`: all periodic orbits of a trapping region, proved.

use std::fmt::{self, Write};
use std::ops::RangeInclusive;

use anyhow::Result;
use clap::Args;
use impact_pair::chaos::{Cycle, Cycles, MOST_IMPACTS, NoTrap};
use impact_pair::exact::decimal_digits;
use impact_pair::json::{CyclesDocument, counted};
use impact_pair::pair::Wall;
use impact_pair::periodic::{Precision, Stability};
use impact_pair::watch::Watch;
use impact_pair::{Effort, Scene};

use crate::trap::not_finer;
use crate::values::{digits, numbers};
use crate::{Answer, Asked, Failure, Format, Status, TABLE_OR_JSON, Verb, heading, line};

/// Options of `cycles`.
#[derive(Args, Clone, Debug)]
pub struct CyclesOptions {
    /// Number of impacts of the cycles, a range 1..N or a single number; each further impact takes up to twice as long
    #[arg(long, value_name = "LO..HI", value_parser = numbers(1..=MOST_IMPACTS), allow_hyphen_values = true)]
    pub impacts: RangeInclusive<u32>,
    /// Requested width of enclosures, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W [default: that of the scene, or 9]
    #[arg(long, value_name = "D", value_parser = digits())]
    pub digits: Option<u32>,
    /// Multiply the work by X, to decide more: 2, 4, .., 64 bisect the boxes of the coarsest region once, twice, .., 6 times
    #[arg(long, value_name = "X", default_value_t)]
    pub effort: Effort,
}

/// The cycles of a region, or the reason why no region is proved.
pub struct AllCycles<'s> {
    scene: &'s Scene,
    found: Result<Cycles, NoTrap>,
    document: CyclesDocument,
    is_stopped: bool,
}

impl Verb for CyclesOptions {
    const NAME: &'static str = "cycles";
    const FORMATS: &'static [(Format, &'static str)] = TABLE_OR_JSON;
    const SCHEMA: &'static str = "impact-pair/cycles/1";
    type Answer<'s> = AllCycles<'s>;

    fn answer<'s>(&self, Asked { scene, .. }: &Asked<'s>, watch: &dyn Watch) -> Result<AllCycles<'s>, Failure> {
        let usual = Precision::default();
        let digits = self.digits.or(scene.run().digits).unwrap_or(usual.digits);
        let found = Cycles::of(scene, self.effort, &self.impacts, Precision { digits, ..usual }, watch)?;
        let document = Cycles::document(scene, &self.impacts, found.as_ref().map_err(|why| *why))?;
        Ok(AllCycles { scene, found, document, is_stopped: !watch.goes_on() })
    }
}

impl Answer for AllCycles<'_> {
    fn status(&self) -> Status {
        let is_certified = self.found.as_ref().is_ok_and(Cycles::is_certified);
        Status::new(is_certified, conclusion(self.found.as_ref().map_err(|why| *why), self.is_stopped))
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        Ok(Some(if format == Format::Json { line(&self.document)? } else { self.table()? }))
    }

    fn notes(&self) -> Vec<String> {
        self.found.as_ref().ok().and_then(|found| found.trap().coarser()).map(not_finer).into_iter().collect()
    }
}

impl AllCycles<'_> {
    fn table(&self) -> Result<String, fmt::Error> {
        let mut out = heading(self.scene);
        if let Ok(found) = &self.found {
            writeln!(out, "region of {} boxes\n", found.trap().boxes())?;
            writeln!(out, "impacts  fixed points  cycles  stable")?;
            for impacts in found.requested().clone() {
                let count = found.fixed_points().get(&(impacts as usize)).map_or("?".to_owned(), ToString::to_string);
                let own = || found.cycles().iter().filter(|cycle| cycle.impacts == impacts as usize);
                let stable = own().filter(|cycle| cycle.orbit.stability == Stability::Stable).count();
                writeln!(out, "{impacts:>7}  {count:>12}  {:>6}  {stable:>6}", own().count())?;
            }
            if !found.cycles().is_empty() {
                writeln!(
                    out,
                    "\nimpacts  {:10}  {:13}  {:22}       time  walls",
                    "stability", "", "largest eigenvalue"
                )?;
            }
            for cycle in found.cycles() {
                writeln!(out, "{}", row(cycle))?;
            }
        }
        writeln!(out, "\n{}", self.status())?;
        Ok(out)
    }
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
fn conclusion(found: Result<&Cycles, NoTrap>, is_stopped: bool) -> String {
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
        if is_stopped { "interrupted" } else { "not all certified" },
        counted(found.cycles().len() as u32, "cycle"),
        missing.join(", "),
        counted(found.undecided().len() as u32, "part"),
    )
}
