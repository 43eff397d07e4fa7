//! Shared parts of sweeps and atlases: points computed by threads, and tables as columns.

use impact_pair::sweep::{Cell, Kind, doubles};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use rayon::prelude::*;

use crate::errors::Fault;
use crate::numbers::bytes;
use crate::watched::{Monitor, watched};

/// The lines of the points from the first up to the last, by this number of threads; after Ctrl-C those that are finished.
pub fn computed<'py>(
    py: Python<'py>,
    (first, last): (u64, u64),
    threads: usize,
    progress: Option<Py<PyAny>>,
    line: impl Fn(u64, &Monitor) -> Result<Option<String>, Fault> + Sync,
) -> PyResult<Bound<'py, PyBytes>> {
    let points: Vec<u64> = (first..last).collect();
    let lines: Vec<Option<String>> = watched(py, progress, |monitor| {
        if threads == 1 {
            return points.into_iter().map(|point| line(point, monitor)).collect();
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|error| Fault::other(format!("cannot start the threads: {error}")))?;
        // A point at a time, so that no thread is left with the slow ones.
        pool.install(|| points.into_par_iter().with_max_len(1).map(|point| line(point, monitor)).collect())
    })?;
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
