//! Grids of points: computed here or by workers, kept, and read as tables and pictures.

use std::path::PathBuf;

use impact_pair::scene::Over;
use impact_pair_answers::grid::{Cell, Kind, doubles};
use impact_pair_answers::{AtlasOptions, Failure, SweepOptions, read_options};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};

use crate::answer::options_of;
use crate::errors::Fault;
use crate::numbers::bytes;
use crate::scene::Scene;
use crate::surveys::{Kept, MapOutcomes, kept};
use crate::watched::{watched, watched_whole};

/// A sweep or an atlas: each point is a function of the exact scene and its number.
#[pyclass(frozen, module = "impact_pair._core")]
pub struct Grid(Box<dyn Kept>);

#[pymethods]
impl Grid {
    /// The `sweep` or the `atlas` of a scene with options as JSON. Its points are kept in a file, a new one where there is none, or in one that is
    /// gone with the program.
    #[new]
    #[pyo3(signature = (scene, verb, options, path=None))]
    fn new(scene: &Bound<'_, Scene>, verb: &str, options: &str, path: Option<PathBuf>) -> PyResult<Self> {
        let (scene, options) = (&scene.get().scene, options_of(options)?);
        let found = if verb == "sweep" {
            let options: SweepOptions = read_options("sweep", &options).map_err(Fault::from)?;
            kept(options.of(scene, None).map_err(|failure| refused(failure, &options.over))?, path)
        } else {
            let options: AtlasOptions = read_options("atlas", &options).map_err(Fault::from)?;
            kept(options.of(scene, None).map_err(|failure| refused(failure, &options.over))?, path)
        };
        Ok(Self(found?))
    }

    /// Asks that the corners of the grid are accepted: then all points are.
    fn check(&self) -> PyResult<()> {
        Ok(self.0.check().map_err(Fault::from)?)
    }

    /// The first line: all that the points depend on, but their numbers.
    fn head(&self) -> String {
        self.0.head()
    }

    /// The lines of the points from the first up to the last, as a worker computes them; after Ctrl-C those that are finished.
    fn compute<'py>(&self, py: Python<'py>, first: u64, last: u64) -> PyResult<Bound<'py, PyBytes>> {
        let lines: Vec<Option<String>> =
            watched(py, None, |monitor| (first..last).map(|point| self.0.line(point, monitor)).collect())?;
        let text: String = lines.into_iter().flatten().map(|line| line + "\n").collect();
        Ok(PyBytes::new(py, text.as_bytes()))
    }

    /// Computes what is missing, by all processors; after Ctrl-C what is finished is there.
    fn complete(&self, py: Python<'_>, progress: Option<Py<PyAny>>) -> PyResult<()> {
        watched(py, progress, |monitor| self.0.complete(monitor))
    }

    /// The ranges of missing points: the first, and the one after the last.
    fn missing(&self) -> Vec<(u64, u64)> {
        let points = self.0.missing();
        let ranges = points.chunk_by(|point, next| point + 1 == *next);
        ranges.map(|range| (range[0], range[range.len() - 1] + 1)).collect()
    }

    /// Adds the lines of points that a worker has computed; from now on a crash does not lose them.
    fn add(&self, lines: &str) -> PyResult<()> {
        Ok(self.0.add_lines(lines)?)
    }

    /// The lines of the points from the first up to the last that are there.
    fn lines<'py>(&self, py: Python<'py>, first: u64, last: u64) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, self.0.lines(first..last)?.as_bytes()))
    }

    /// True if everything requested is proved at the points that are there, and what is proved, in words.
    fn status(&self, py: Python<'_>) -> PyResult<(bool, String)> {
        let status = watched_whole(py, None, |_| self.0.status())?;
        Ok((status.is_complete(), status.in_python()))
    }

    /// The points from the first up to the last as rows of CSV; before point 0 the names of the columns.
    fn csv<'py>(&self, py: Python<'py>, first: u64, last: u64, rows: &str) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, watched_whole(py, None, |_| self.0.csv(first..last, rows))?.as_bytes()))
    }

    /// A picture as SVG: of a sweep the diagram of `phase` or `velocity`, or of two keys the map of outcomes; of an atlas its plane, or the page
    /// as `html`.
    fn picture(&self, py: Python<'_>, name: &str) -> PyResult<String> {
        watched_whole(py, None, |_| self.0.picture(name))
    }

    /// The outcomes of a map, attractors of one pair told apart unless `by_word`: for each point that is there the number of its kind, the colours of
    /// kinds, the legend, and where attractors hit the left wall first, with their colours.
    fn outcomes(&self, py: Python<'_>, by_word: bool) -> PyResult<MapOutcomes> {
        watched_whole(py, None, |_| self.0.outcomes(by_word))
    }

    /// The columns of a table by name: lists, and of bounds bytes of doubles rounded outward, NaN where there are none.
    fn table<'py>(&self, py: Python<'py>, rows: &str) -> PyResult<Bound<'py, PyDict>> {
        let mut found = Err(Fault::other("no table").into());
        self.0.table(rows, &mut |columns, rows| found = dictionary(py, columns, rows))?;
        found
    }
}

/// The failure of a grid, of the keyword where it names no key of the scene.
fn refused(failure: Failure, over: &[Over]) -> Fault {
    let over: Vec<String> = over.iter().map(Over::to_string).collect();
    Fault::from(failure).about("over", &over.join(" "))
}

/// The columns of a table by name: lists, and of bounds bytes of doubles rounded outward, NaN where there are none.
fn dictionary<'py>(
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
