//! Shared parts of sweeps and atlases: points computed and kept, and tables as columns.

use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};

use anyhow::Result;
use impact_pair::sweep::{Cell, Head, Kind, doubles};
use impact_pair::watch::Watch;
use impact_pair_answers::grid::{self, Task};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};

use crate::errors::Fault;
use crate::numbers::bytes;
use crate::watched::{Monitor, watched};

/// Computes the line of a point; `None` where it was stopped.
type Line<'l> = &'l (dyn Fn(u64, &Monitor) -> Result<Option<String>, Fault> + Sync);

/// The finished points of a grid, as the command line keeps them.
#[pyclass(frozen, module = "impact_pair._core")]
pub struct Journal(Mutex<Box<dyn Kept>>);

/// A journal of a sweep or of an atlas.
trait Kept: Send {
    fn missing(&self) -> Vec<u64>;
    fn add_lines(&mut self, lines: &str) -> Result<()>;
    fn lines(&mut self, first: u64, last: u64) -> Result<String>;
    fn complete(&mut self, task: Task<'_>, watch: &dyn Watch) -> Result<()>;
}

impl<H: Head + Send> Kept for grid::Journal<H> {
    fn missing(&self) -> Vec<u64> {
        self.missing()
    }

    fn add_lines(&mut self, lines: &str) -> Result<()> {
        self.add_lines(lines)
    }

    fn lines(&mut self, first: u64, last: u64) -> Result<String> {
        let mut text = String::new();
        for point in first..last {
            if self.holds(point) {
                text += &self.line(point)?;
                text.push('\n');
            }
        }
        Ok(text)
    }

    fn complete(&mut self, task: Task<'_>, watch: &dyn Watch) -> Result<()> {
        grid::complete(self, None, task, (watch, &|| ()))
    }
}

impl Journal {
    /// The journal in a file, or in one that is gone with the program.
    pub fn open<H: Head + Send + 'static>(head: H, path: Option<PathBuf>) -> PyResult<Self> {
        let kept = grid::Journal::kept(head, path).map_err(said)?;
        Ok(Self(Mutex::new(Box::new(kept))))
    }

    fn kept(&self) -> MutexGuard<'_, Box<dyn Kept>> {
        self.0.lock().expect("no thread has panicked")
    }

    /// Computes the points that are missing, by all processors; after Ctrl-C those that are finished are there.
    pub fn complete(&self, py: Python<'_>, points: u64, progress: Option<Py<PyAny>>, line: Line<'_>) -> PyResult<()> {
        watched(py, progress, |monitor| {
            let mut kept = self.kept();
            monitor.report(points - kept.missing().len() as u64);
            // The first fault keeps its class.
            let fault = Mutex::new(None);
            let task = |point: u64| {
                line(point, monitor).map_err(|own| {
                    fault.lock().expect("no thread has panicked").get_or_insert(own);
                    anyhow::anyhow!("a point is refused")
                })
            };
            let done = kept.complete(&task, monitor);
            match fault.into_inner().expect("no thread has panicked") {
                Some(fault) => Err(fault),
                None => done.map_err(said),
            }
        })
    }
}

#[pymethods]
impl Journal {
    /// The ranges of missing points: the first, and the one after the last.
    fn missing(&self) -> Vec<(u64, u64)> {
        let points = self.kept().missing();
        let ranges = points.chunk_by(|point, next| point + 1 == *next);
        ranges.map(|range| (range[0], range[range.len() - 1] + 1)).collect()
    }

    /// Adds the lines of points that a worker has computed; from now on a crash does not lose them.
    fn add(&self, lines: &str) -> PyResult<()> {
        Ok(self.kept().add_lines(lines).map_err(said)?)
    }

    /// The lines of the points from the first up to the last that are there.
    fn lines<'py>(&self, py: Python<'py>, first: u64, last: u64) -> PyResult<Bound<'py, PyBytes>> {
        let lines = self.kept().lines(first, last).map_err(said)?;
        Ok(PyBytes::new(py, lines.as_bytes()))
    }
}

/// An error of a journal with its causes.
fn said(error: anyhow::Error) -> Fault {
    Fault::other(format!("{error:#}"))
}

/// The lines of the points from the first up to the last, as a worker computes them; after Ctrl-C those that are finished.
pub fn computed<'py>(py: Python<'py>, (first, last): (u64, u64), line: Line<'_>) -> PyResult<Bound<'py, PyBytes>> {
    let lines: Vec<Option<String>> =
        watched(py, None, |monitor| (first..last).map(|point| line(point, monitor)).collect())?;
    let mut text = String::new();
    for line in lines.iter().flatten() {
        text.push_str(line);
        text.push('\n');
    }
    Ok(PyBytes::new(py, text.as_bytes()))
}

/// The columns of a table by name: lists, and of bounds bytes of doubles rounded outward, NaN where there are none.
pub fn dictionary<'py>(
    py: Python<'py>,
    columns: &[(String, Kind)],
    rows: &[Vec<Cell<'_>>],
) -> PyResult<Bound<'py, PyDict>> {
    let named = PyDict::new(py);
    for (column, (name, kind)) in columns.iter().enumerate() {
        if matches!(kind, Kind::Bounds | Kind::Exact) {
            let ends = rows.iter().map(|row| match row[column] {
                Cell::Bounds(bounds) => Some([end(&bounds[0])?[0], end(&bounds[1])?[1]]),
                Cell::Exact(text) => end(text),
                _ => Some([f64::NAN; 2]),
            });
            let ends = ends.collect::<Option<Vec<_>>>().ok_or_else(|| Fault::other("a bound is no number"))?;
            named.set_item(name, bytes(py, ends.into_iter().flatten()))?;
            continue;
        }
        let list = PyList::empty(py);
        for row in rows {
            match row[column] {
                Cell::Whole(number) => list.append(number)?,
                Cell::Text(text) => list.append(text.to_string())?,
                Cell::Truth(truth) => list.append(truth)?,
                Cell::Number(number) => list.append(number)?,
                // Of the ends of a cell the double that is inside: what is said of it is proved there.
                Cell::Exact(text) => list.append(end(text).map(|ends| ends[usize::from(*kind == Kind::Low)]))?,
                _ => list.append(py.None())?,
            }
        }
        named.set_item(name, list)?;
    }
    Ok(named)
}

fn end(text: &str) -> Option<[f64; 2]> {
    doubles(text).ok()
}
