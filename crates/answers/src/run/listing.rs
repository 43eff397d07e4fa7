//! The events of an orbit as a table, JSON, JSON Lines or CSV.

use std::io::{self, BufWriter, Write};
use std::ops::ControlFlow;

use impact_pair::Scene;
use impact_pair::json::{Bounds, EventDocument, OrbitEnd, write_orbit};
use impact_pair::orbit::{Conclusion, Ending, Event, Orbit, Settings};
use impact_pair::watch::Watch;
use serde::Serialize;

use super::table;
use crate::{Format, Status};

/// The first line of CSV.
pub const CSV_HEADER: &str = "event,index,mapping,wall,time_lower,time_upper,velocity_lower,velocity_upper";

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
    /// A listing of the orbit of a scene in a format: table, JSON, JSON Lines, or else CSV.
    pub fn new(format: Format, scene: &'s Scene, settings: &'s Settings, out: W) -> Self {
        Self { format, scene, settings, out, held_back: Vec::new() }
    }

    /// Writes the events of the orbit as they are certified, until the watch stops it; returns the writer, and how much is certified.
    ///
    /// # Errors
    /// If the writer fails.
    pub fn follow(mut self, mut orbit: Orbit, watch: &dyn Watch) -> io::Result<(W, Status)> {
        self.begin(&orbit)?;
        let mut last = None;
        let written = orbit.follow(watch, |orbit, step| {
            let Some(event) = Event::of(orbit, &step) else { return ControlFlow::Continue(()) };
            if let Err(error) = self.event(&event) {
                return ControlFlow::Break(error);
            }
            last = Some(event);
            ControlFlow::Continue(())
        });
        if let ControlFlow::Break(error) = written {
            return Err(error);
        }
        let ending = Ending::of(&orbit, Conclusion::of(&orbit, last.as_ref()), self.settings);
        Ok((self.end(&ending)?, Status::from(&ending)))
    }

    /// Writes the part of the output before the events.
    pub(super) fn begin(&mut self, orbit: &Orbit) -> io::Result<()> {
        match self.format {
            Format::Table => table::begin(&mut self.out, self.scene, self.settings),
            Format::Json => Ok(()),
            Format::Jsonl => line(&mut self.out, &orbit.head_at_first()),
            _ => writeln!(self.out, "{CSV_HEADER}"),
        }
    }

    /// Writes an event, or holds it back.
    pub(super) fn event(&mut self, event: &Event) -> io::Result<()> {
        match self.format {
            Format::Table => table::event(&mut self.out, event),
            Format::Json => {
                self.held_back.push(event.clone());
                Ok(())
            }
            Format::Jsonl => line(&mut self.out, &EventDocument::from(event)),
            _ => writeln!(self.out, "{}", csv_row(&EventDocument::from(event))),
        }
    }

    /// Writes the part of the output after the events, and returns the writer.
    pub(super) fn end(mut self, ending: &Ending<'_>) -> io::Result<W> {
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
            _ => {}
        }
        Ok(self.out)
    }
}

/// An event as a row of CSV, bounds in columns.
pub fn csv_row(event: &EventDocument) -> String {
    let ends = |bounds: &Bounds| format!("{},{}", bounds[0].text(), bounds[1].text());
    let index = event.index.map_or(String::new(), |index| index.to_string());
    let mapping = event.mapping.flatten().map_or(String::new(), |mapping| mapping.to_string());
    let velocity = event.velocity.as_ref().map_or(",".to_owned(), ends);
    format!("{},{index},{mapping},{},{},{velocity}", event.event, event.wall.name(), ends(&event.time))
}

fn line(out: &mut impl Write, document: &impl Serialize) -> io::Result<()> {
    writeln!(out, "{}", serde_json::to_string(document)?)
}
