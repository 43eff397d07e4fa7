//! `run`: an orbit with all its events, and where the ball is between them.

use std::iter;
use std::sync::Mutex;

use impact_pair::json::{
    self, ArithmeticDocument, EventDocument, EventName, OrbitDocument, OrbitEnd, OrbitHead, OutcomeDocument,
    write_orbit,
};
use impact_pair::orbit::{self, Bounds, Conclusion, Dense, Ending, Event, EventKind};
use impact_pair::watch::Watch;
use impact_pair_answers::grid::doubles;
use impact_pair_answers::{CSV_HEADER, RunOptions, Status, Verb, csv_row, read_options};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::answer::options_of;
use crate::errors::Fault;
use crate::flights::{number, side};
use crate::numbers::{bytes, read};
use crate::scene::{Scene, json};
use crate::watched::watched;

/// Events as they were computed, or read of a document.
enum Events {
    Computed(Vec<Event>),
    Read(Vec<EventDocument>),
}

/// An orbit that has been followed to its end, or read.
#[pyclass(frozen, module = "impact_pair._core")]
pub struct Orbit {
    head: OrbitHead,
    /// The arithmetic with which its JSON Lines begin; of an orbit that was read that of its head.
    at_first: ArithmeticDocument,
    outcome: OutcomeDocument,
    events: Events,
    /// Everything requested is certified; unknown for a document.
    complete: Option<bool>,
    said: String,
    bits: Option<u32>,
    motion: Option<Mutex<Dense>>,
}

/// The fields of an event that arrays have.
struct Row {
    name: EventName,
    wall: u8,
    mapping: u8,
    time: [f64; 2],
    velocity: Option<[f64; 2]>,
}

impl Orbit {
    fn rows(&self) -> PyResult<Vec<Row>> {
        let of_double = |ends: &json::Bounds| -> PyResult<[f64; 2]> {
            let end = |i: usize| doubles(ends[i].text()).map_err(Fault::certificate);
            Ok([end(0)?[0], end(1)?[1]])
        };
        match &self.events {
            Events::Computed(events) => Ok(events.iter().map(row).collect()),
            Events::Read(events) => {
                let read = |event: &EventDocument| {
                    Ok(Row {
                        name: event.event,
                        wall: side(Some(event.wall)),
                        mapping: number(event.mapping.flatten()),
                        time: of_double(&event.time)?,
                        velocity: event.velocity.as_ref().map(of_double).transpose()?,
                    })
                };
                events.iter().map(read).collect()
            }
        }
    }

    fn document(&self, event: usize) -> Option<EventDocument> {
        match &self.events {
            Events::Computed(events) => events.get(event).map(EventDocument::from),
            Events::Read(events) => events.get(event).cloned(),
        }
    }

    fn count(&self) -> usize {
        match &self.events {
            Events::Computed(events) => events.len(),
            Events::Read(events) => events.len(),
        }
    }
}

fn row(event: &Event) -> Row {
    // A float is the double itself.
    let ends = |bounds: &Bounds| match bounds {
        Bounds::Certified(x) => x.to_f64_bounds().into(),
        Bounds::Float(x) => [x.mid_rad().0; 2],
    };
    let (mapping, velocity) = match &event.kind {
        EventKind::Impact { mapping, velocity, .. } => (*mapping, Some(ends(velocity))),
        EventKind::Graze { .. } | EventKind::Rest { .. } | EventKind::Release => (None, None),
    };
    let (name, wall) = (event.name(), side(Some(event.wall)));
    Row { name, wall, mapping: number(mapping), time: ends(&event.time), velocity }
}

#[pymethods]
impl Orbit {
    /// The orbit as the command line writes it: `json`, `jsonl` or `csv`.
    fn text(&self, format: &str) -> PyResult<String> {
        let events = (0..self.count()).filter_map(|event| self.document(event));
        match format {
            "csv" => Ok(iter::once(CSV_HEADER.to_owned())
                .chain(events.map(|event| csv_row(&event)))
                .fold(String::new(), line)),
            "jsonl" => {
                let first = json(&OrbitHead { arithmetic: self.at_first.clone(), ..self.head.clone() });
                let end = OrbitEnd { outcome: self.outcome.clone(), arithmetic: self.head.arithmetic.clone() };
                let lines = iter::once(first).chain(events.map(|event| json(&event))).chain(iter::once(json(&end)));
                lines.collect::<PyResult<Vec<_>>>().map(|lines| lines.into_iter().fold(String::new(), line))
            }
            _ => {
                let mut out = Vec::new();
                write_orbit(&mut out, &self.head, &self.outcome, events)?;
                Ok(String::from_utf8(out)?)
            }
        }
    }

    /// The head and the outcome of it.
    fn about(&self) -> PyResult<(String, String)> {
        Ok((json(&self.head)?, json(&self.outcome)?))
    }

    /// True if everything requested is certified (`None` of an orbit that was read), the last line of the table, and the maximum precision in bits.
    fn ending(&self) -> (Option<bool>, &str, Option<u32>) {
        (self.complete, &self.said, self.bits)
    }

    /// Returns whether it was interrupted.
    fn interrupted(&self) -> bool {
        self.outcome.interruption().as_ref() == Some(&self.outcome.message)
    }

    /// Columns of the events: the number of the name (impact, graze, rest, release), wall, mapping, bounds of time and velocity.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyBytes>; 5]> {
        let rows = self.rows()?;
        let column = |of: fn(&Row) -> u8| PyBytes::new(py, &rows.iter().map(of).collect::<Vec<_>>());
        let name = |row: &Row| match row.name {
            EventName::Impact => 0,
            EventName::Graze => 1,
            EventName::Rest => 2,
            EventName::Release => 3,
        };
        let times = bytes(py, rows.iter().flat_map(|row| row.time));
        let velocities = bytes(py, rows.iter().flat_map(|row| row.velocity.unwrap_or([f64::NAN; 2])));
        Ok([column(name), column(|row| row.wall), column(|row| row.mapping), times, velocities])
    }

    /// An event of the orbit JSON.
    fn event(&self, event: usize) -> PyResult<Option<String>> {
        self.document(event).map(|event| json(&event)).transpose()
    }

    /// Bounds of the displacement and the velocity at times, four doubles each, NaN where nothing is proved and after Ctrl-C; and
    /// whether that came.
    fn at<'py>(
        &self,
        py: Python<'py>,
        times: &[u8],
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Bound<'py, PyBytes>, bool)> {
        let Some(dense) = &self.motion else {
            let message = "this orbit was read from a document: run the scene again for bounds between impacts";
            return Err(Fault::other(message).into());
        };
        let times = read(times);
        let (found, interrupted) = watched(py, progress, move |monitor| {
            let dense = dense.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            let all = 4 * times.len();
            let mut found = Vec::with_capacity(all);
            for (i, time) in times.into_iter().enumerate().take_while(|_| monitor.goes_on()) {
                monitor.report(i as u64);
                let [y, v] = dense.at(time).unwrap_or([[f64::NAN; 2]; 2]);
                found.extend([y[0], y[1], v[0], v[1]]);
            }
            let interrupted = found.len() < all;
            found.resize(all, f64::NAN);
            Ok((found, interrupted))
        })?;
        Ok((bytes(py, found.into_iter()), interrupted))
    }
}

/// The options of an orbit, as JSON.
pub fn read_run(options: &str) -> Result<RunOptions, Fault> {
    Ok(read_options(RunOptions::NAME, &options_of(options)?)?)
}

/// Follows the orbit of a scene.
#[pyfunction]
pub fn run(py: Python<'_>, scene: &Bound<'_, Scene>, options: String, progress: Option<Py<PyAny>>) -> PyResult<Orbit> {
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let settings = read_run(&options)?.settings(&scene);
        let orbit = orbit::Orbit::of(&scene, settings.clone())?;
        let at_first = orbit.head_at_first().arithmetic;
        let mut events: Vec<Event> = Vec::new();
        let dense = Dense::of(orbit, monitor, |orbit, step| events.extend(Event::of(orbit, step)));
        let orbit = dense.orbit();
        let conclusion = Conclusion::of(orbit, events.last());
        let ending = Ending::of(orbit, conclusion, &settings);
        Ok(Orbit {
            head: orbit.head(),
            at_first,
            outcome: ending.conclusion.document(),
            complete: Some(ending.is_complete()),
            said: Status::from(&ending).in_python(),
            bits: Some(orbit.bits()),
            events: Events::Computed(events),
            motion: Some(Mutex::new(dense)),
        })
    })
}

/// The text with one more line.
fn line(text: String, line: impl AsRef<str>) -> String {
    text + line.as_ref() + "\n"
}

/// Reads an orbit JSON.
#[pyfunction]
pub fn read_orbit(text: &str) -> PyResult<Orbit> {
    let (head, events, outcome) = json::read::<OrbitDocument>(text).map_err(Fault::from)?.lines();
    let said = outcome.message.clone();
    let at_first = head.arithmetic.clone();
    Ok(Orbit { head, at_first, outcome, events: Events::Read(events), complete: None, said, bits: None, motion: None })
}
