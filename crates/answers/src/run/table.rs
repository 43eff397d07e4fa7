//! The table for people: columns of fixed widths, so that rows appear as they are certified.

use std::io::{self, Write};

use impact_pair::Scene;
use impact_pair::mapping::Mapping;
use impact_pair::orbit::{Arithmetic, Settings};
use impact_pair::orbit::{Ending, Event, EventKind};

use crate::{Status, heading};

pub fn begin(out: &mut impl Write, scene: &Scene, settings: &Settings) -> io::Result<()> {
    out.write_all(heading(scene).as_bytes())?;
    let bits = if let Arithmetic::Bits(_) = settings.arithmetic { " bits" } else { "" };
    let arithmetic = format!("{}{bits}", settings.arithmetic);
    if settings.arithmetic.is_certified() {
        writeln!(out, "arithmetic: {arithmetic}, {} digits requested\n", settings.digits)?;
    } else {
        writeln!(out, "arithmetic: {arithmetic}, nothing is certified\n")?;
    }
    writeln!(out, "{:>7}  {:7}  {:5}  {:31}  velocity before", "#", "mapping", "wall", "time")
}

pub fn event(out: &mut impl Write, event: &Event) -> io::Result<()> {
    let wall = event.wall.name();
    match &event.kind {
        EventKind::Impact { index, mapping, velocity } => {
            let mapping = mapping.as_ref().map_or("-".into(), Mapping::to_string);
            writeln!(out, "{index:>7}  {mapping:7}  {wall:5}  {:31}  {velocity}", event.time)
        }
        EventKind::Rest { is_accumulation } => {
            let note = if *is_accumulation { "after infinitely many impacts" } else { "at once" };
            writeln!(out, "{:>7}  {:7}  {wall:5}  {:31}  {note}", "", "rest", event.time)
        }
        EventKind::Graze { .. } => {
            writeln!(
                out,
                "{:>7}  {:7}  {wall:5}  {:31}  velocity zero, or too small to decide",
                "", "graze", event.time
            )
        }
        EventKind::Release => writeln!(out, "{:>7}  {:7}  {wall:5}  {}", "", "release", event.time),
    }
}

pub fn end(out: &mut impl Write, ending: &Ending<'_>) -> io::Result<()> {
    writeln!(out, "\n{}", Status::from(ending))
}
