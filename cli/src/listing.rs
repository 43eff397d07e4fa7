//! The events of an orbit as a table, JSON, JSON Lines or CSV.

use std::io::{self, BufWriter, Write};

use clap::ValueEnum;
use impact_pair::Scene;
use impact_pair::json::{EventDocument, OrbitEnd, write_orbit};
use impact_pair::mapping::Mapping;
use impact_pair::orbit::{Ending, Event, EventKind};
use impact_pair::orbit::{Orbit, Settings};
use serde::Serialize;

use crate::table;

/// Output formats of the events of an orbit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Human-readable: the certain digits, then the last digits of both bounds
    #[default]
    Table,
    /// One document, schema impact-pair/orbit/1
    Json,
    /// JSON Lines as they are certified: the head, one event per line, the outcome
    Jsonl,
    /// One event per line, bounds in columns
    Csv,
}

const CSV_HEADER: &str = "event,index,mapping,wall,time_lower,time_upper,velocity_lower,velocity_upper";

/// Writes the events of one orbit as they come; `out` should pass on whole lines at once.
pub struct Listing<'s, W> {
    format: Format,
    scene: &'s Scene,
    settings: &'s Settings,
    out: W,
    /// The JSON document names the outcome before the events.
    held_back: Vec<Event>,
}

impl<'s, W: Write> Listing<'s, W> {
    pub fn new(format: Format, scene: &'s Scene, settings: &'s Settings, out: W) -> Self {
        Self { format, scene, settings, out, held_back: Vec::new() }
    }

    /// Writes the part of the output before the events.
    pub fn begin(&mut self, orbit: &Orbit) -> io::Result<()> {
        match self.format {
            Format::Table => table::begin(&mut self.out, self.scene, self.settings),
            Format::Json => Ok(()),
            Format::Jsonl => line(&mut self.out, &orbit.head_at_first()),
            Format::Csv => writeln!(self.out, "{CSV_HEADER}"),
        }
    }

    pub fn event(&mut self, event: &Event) -> io::Result<()> {
        match self.format {
            Format::Table => table::event(&mut self.out, event),
            Format::Json => {
                self.held_back.push(event.clone());
                Ok(())
            }
            Format::Jsonl => line(&mut self.out, &EventDocument::from(event)),
            Format::Csv => {
                let (name, wall, [t0, t1]) = (event.name().text(), event.wall.name(), event.time.decimals());
                match &event.kind {
                    EventKind::Impact { index, mapping, velocity } => {
                        let mapping = mapping.as_ref().map(Mapping::to_string).unwrap_or_default();
                        let [v0, v1] = velocity.decimals();
                        writeln!(self.out, "{name},{index},{mapping},{wall},{t0},{t1},{v0},{v1}")
                    }
                    EventKind::Graze { .. } | EventKind::Rest { .. } | EventKind::Release => {
                        writeln!(self.out, "{name},,,{wall},{t0},{t1},,")
                    }
                }
            }
        }
    }

    /// Writes the part of the output after the events, and returns the writer.
    pub fn end(mut self, ending: &Ending<'_>) -> io::Result<W> {
        match self.format {
            Format::Table => table::end(&mut self.out, ending)?,
            Format::Json => {
                let mut out = BufWriter::new(&mut self.out);
                let events = self.held_back.iter().map(EventDocument::from);
                write_orbit(&mut out, &ending.head, &ending.conclusion.document(), events)?;
                out.flush()?;
            }
            Format::Jsonl => {
                let (outcome, arithmetic) = (ending.conclusion.document(), ending.head.arithmetic.clone());
                line(&mut self.out, &OrbitEnd { outcome, arithmetic })?;
            }
            Format::Csv => {}
        }
        Ok(self.out)
    }
}

fn line(out: &mut impl Write, document: &impl Serialize) -> io::Result<()> {
    writeln!(out, "{}", serde_json::to_string(document)?)
}
