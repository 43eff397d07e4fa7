//! `audit`: another simulator's list of impacts, compared with the certified orbit.

mod table;

use anyhow::Result;
use clap::Args;
use impact_pair::audit::{Audit, AuditSettings, Column, Columns, Hint, read};
use impact_pair::exact::Exact;
use impact_pair::json::one_a_line;
use impact_pair::orbit::MAX_BITS;
use impact_pair::watch::Watch;
use impact_pair::{ErrorKind, Scene};

use crate::values::{bits, digits, point};
use crate::{Answer, Asked, Counts, Failure, Format, Input, Status, Step, Verb};

/// Options of `audit`.
#[derive(Args, Clone, Debug)]
pub struct AuditOptions {
    /// The list to compare (CSV, TSV, other text, or JSON), or - for stdin
    pub events: Input,
    /// Accepted difference of a time, in periods 2 pi/W, and of a velocity, in A W; from 0 to 1
    #[arg(long, value_name = "X", default_value = "1e-9", value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: Exact,
    /// Compare up to this time: the list must contain every certified impact before T, later rows are ignored. Impacts within the tolerance
    /// of T may be missing where a later row is ignored [default: the last time listed]
    #[arg(long, value_name = "T", value_parser = point, allow_hyphen_values = true)]
    until: Option<Exact>,
    /// The column of times, by its name or its number from 1 [default: time or t, or the first one]
    #[arg(long, value_name = "NAME|N")]
    time_column: Option<String>,
    /// The column of walls [default: wall or side, or the second one]
    #[arg(long, value_name = "NAME|N")]
    wall_column: Option<String>,
    /// The column of velocities [default: v_minus, v_before, velocity, v, vel and
    /// the like, or the third one of a list without a header]
    #[arg(long, value_name = "NAME|N")]
    velocity_column: Option<String>,
    /// Compare times and walls only
    #[arg(long, conflicts_with = "velocity_column")]
    no_velocity: bool,
    /// Digits of the certified orbit, relative as --tolerance [default: three more than the tolerance has]
    #[arg(long, value_name = "D", value_parser = digits())]
    digits: Option<u32>,
    /// Maximum precision of the certified orbit, in bits
    #[arg(long, default_value_t = MAX_BITS, value_name = "BITS", value_parser = bits())]
    max_bits: u32,
    /// List every event in the table, not only the first ones that disagree
    #[arg(long)]
    all: bool,
}

/// Reads a tolerance.
fn tolerance(text: &str) -> Result<Exact, String> {
    let tolerance = point(text)?;
    let (low, high) = tolerance.enclose(64).to_f64_bounds();
    if low >= 0.0 && high <= 1.0 { Ok(tolerance) } else { Err("accepted is a number from 0 to 1".into()) }
}

/// A list that is compared, and how the command line lists it.
pub struct Audited<'s> {
    audit: Audit<'s>,
    name: String,
    all: bool,
}

impl Verb for AuditOptions {
    const NAME: &'static str = "audit";
    const FORMATS: &'static [(Format, &'static str)] = &[
        (Format::Table, "Human-readable: the first disagreements, and a summary"),
        (Format::Json, "One document with every event, schema impact-pair/audit/1"),
    ];
    const SCHEMA: &'static str = "";
    type Answer<'s> = Audited<'s>;

    fn counts(&self, _: &Scene) -> Counts {
        Counts::Impacts(Some(self.events.text().lines().count() as u64))
    }

    fn inputs(&mut self) -> Vec<&mut Input> {
        vec![&mut self.events]
    }

    fn answer<'s>(&self, Asked { scene, .. }: &Asked<'s>, watch: &dyn Watch) -> Result<Audited<'s>, Failure> {
        let columns = Columns {
            time: Column::time(self.time_column.clone()),
            wall: Column::wall(self.wall_column.clone()),
            velocity: (!self.no_velocity).then(|| Column::velocity(self.velocity_column.clone())),
        };
        let requested = AuditSettings {
            tolerance: self.tolerance.clone(),
            until: self.until.clone(),
            digits: self.digits,
            max_bits: self.max_bits,
        };
        let of_input = |error| Failure::Input { input: self.events.name(), error: Box::new(error) };
        let list = read(self.events.text(), &columns, scene.pair()).map_err(of_input)?;
        let audit = Audit::of(scene, list, &requested, watch).map_err(|error| match error.key() {
            Some("until") => Failure::Named(error),
            _ if error.kind() == ErrorKind::List => of_input(error),
            _ => Failure::Scene(error),
        })?;
        Ok(Audited { audit, name: self.events.name(), all: self.all })
    }
}

impl Answer for Audited<'_> {
    fn status(&self) -> Status {
        let audit = &self.audit;
        let mut status = Status::new(audit.is_agreed(), audit.verdict());
        status = match audit.hint() {
            Some(Hint::Precision) => {
                status.say("; try ").step(Step::More("max-bits")).say(" or ").step(Step::Fewer("digits"))
            }
            Some(Hint::Velocity) => status
                .say("; velocities are expected just before the impact; ")
                .step(Step::Set("no-velocity"))
                .say(" compares times and walls only"),
            None => status,
        };
        if !audit.unused.is_empty() {
            status = status.say(format!("; not read: {}", audit.unused.join(", ")));
            if audit.lacks_velocities() {
                let names = " (velocities are read from the column that ";
                status = status.say(names).step(Step::Name("velocity-column")).say(" names)");
            }
        }
        status
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        Ok(Some(match format {
            Format::Json => format!("{}\n", one_a_line(&self.audit.document(), &["events"])),
            _ => table::table(&self.audit, &self.name, self.all, &self.status()),
        }))
    }
}
