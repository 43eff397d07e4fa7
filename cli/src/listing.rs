//! The events of an orbit as a table, JSON, JSON Lines or CSV.

use std::io::{self, BufWriter, Write};

use impact_pair::Scene;
use impact_pair::certificate::{Event, Kind, asked_arithmetic, head, write_json};
use impact_pair::mapping::Mapping;
use impact_pair::orbit::Settings;
use serde_json::{Map, Value, json};

use crate::arguments::Format;
use crate::ending::Ending;
use crate::table;

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

    fn head(&self, computed: Value) -> Map<String, Value> {
        head(self.scene.pair(), self.scene.start(), self.settings.arithmetic, computed)
    }

    /// What comes before the events.
    pub fn begin(&mut self) -> io::Result<()> {
        match self.format {
            Format::Table => table::begin(&mut self.out, self.scene, self.settings),
            Format::Json => Ok(()),
            Format::Jsonl => {
                let head = self.head(asked_arithmetic(self.settings));
                writeln!(self.out, "{}", Value::Object(head))
            }
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
            Format::Jsonl => writeln!(self.out, "{event}"),
            Format::Csv => {
                let (name, wall, [t0, t1]) = (event.name(), event.wall.name(), event.time.decimals());
                match &event.kind {
                    Kind::Impact { mapping, velocity } => {
                        let mapping = mapping.as_ref().map(Mapping::to_string).unwrap_or_default();
                        let (index, [v0, v1]) = (event.index, velocity.decimals());
                        writeln!(self.out, "{name},{index},{mapping},{wall},{t0},{t1},{v0},{v1}")
                    }
                    Kind::Graze | Kind::Rest { .. } | Kind::Release => {
                        writeln!(self.out, "{name},,,{wall},{t0},{t1},,")
                    }
                }
            }
        }
    }

    /// What comes after the events; hands back what was written to.
    pub fn end(mut self, ending: &Ending<'_>) -> io::Result<W> {
        match self.format {
            Format::Table => table::end(&mut self.out, ending)?,
            Format::Json => {
                let head = self.head(ending.computed.clone());
                let mut out = BufWriter::new(&mut self.out);
                write_json(&mut out, &head, &ending.conclusion, &self.held_back)?;
                out.flush()?;
            }
            Format::Jsonl => {
                writeln!(self.out, "{}", json!({"outcome": ending.conclusion.json(), "arithmetic": ending.computed}))?
            }
            Format::Csv => {}
        }
        Ok(self.out)
    }
}
