//! Sweeps: points are pure functions of the exact scene and their number.

use std::path::PathBuf;

use impact_pair::exact::Exact;
use impact_pair::json::{SweepHead, SweepRecord};
use impact_pair::orbit::{self, Settings};
use impact_pair::scene::{DIGITS, Key, Over, Range};
use impact_pair::sweep::{self, Cell, Grid, PointSettings, Table, axis, columns, csv_head, csv_rows, follow};
use impact_pair::watch::Silent;
use impact_pair_plot::picture::{Look, hex};
use impact_pair_plot::sweep::{Outcomes, Show, svg};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::errors::{Fault, accepted};
use crate::grid::{Journal, computed, dictionary};
use crate::lines::{Lines, records};
use crate::pictures::drawn;
use crate::scene::{Scene, json};
use crate::watched::{Monitor, watched_whole};

/// The axes that texts say, for a scene.
pub fn ranged(over: &[String], scene: &impact_pair::Scene) -> Result<Vec<Range>, Fault> {
    let named = |text: &String| axis(text).map_err(|error| Fault::keyed(error, "over", text));
    let axes: Vec<Over> = over.iter().map(named).collect::<Result<_, _>>()?;
    Over::all(&axes, scene.pair()).map_err(|error| Fault::keyed(error, "over", &over.join(" ")))
}

/// A sweep over a grid, and the settings of its points.
#[pyclass(frozen, module = "impact_pair._core")]
pub struct Sweep {
    scene: impact_pair::Scene,
    grid: Grid,
    requested: PointSettings,
    pub head: SweepHead,
}

impl Sweep {
    /// The line of a point; `None` where it was stopped.
    fn line(&self, point: u64, monitor: &Monitor) -> Result<Option<String>, Fault> {
        let values = self.grid.values(point)?;
        let scene = self.grid.scene(&self.scene, &values).map_err(|error| named(point, &values, &error))?;
        let found = follow(&scene, &self.requested, &Silent(monitor)).map_err(|error| named(point, &values, &error))?;
        monitor.add_one();
        let line = |found| serde_json::to_string(&sweep::record(point, &values, &found)).expect("plain data");
        Ok(found.map(line))
    }
}

/// The error of a point, which is named.
pub fn named(point: u64, values: &[(Key, Exact)], error: &impact_pair::Error) -> Fault {
    let values: Vec<String> = values.iter().map(|(key, value)| format!("{key} = {value}")).collect();
    let (key, value) = (error.key().map(str::to_owned), error.value().map(str::to_owned));
    Fault::Said { class: "RangeError", message: format!("point {point} ({}): {error}", values.join(", ")), key, value }
}

#[pymethods]
impl Sweep {
    /// A sweep over axes, `KEY=LO..HI:COUNT`, with transient and impacts, digits, arithmetic, bits, and whether states are left out.
    #[new]
    fn new(
        scene: &Bound<'_, Scene>,
        over: Vec<String>,
        impacts: (u64, u64),
        requested: (u32, String, u32),
        summary: bool,
    ) -> PyResult<Self> {
        let scene = scene.get().scene.clone();
        let axes = ranged(&over, &scene)?;
        let grid = Grid::new(axes).map_err(|error| Fault::keyed(error, "over", &over.join(" ")))?;
        let settings = Settings {
            digits: accepted("digits", requested.0, DIGITS)?,
            arithmetic: requested.1.parse().map_err(|error| Fault::keyed(error, "arithmetic", &requested.1))?,
            max_bits: accepted("max_bits", requested.2, orbit::BITS)?,
            ..Settings::default()
        };
        let transient = accepted("transient", impacts.0, 0..=sweep::MOST_IMPACTS)?;
        let impacts = accepted("impacts", impacts.1, 1..=sweep::MOST_IMPACTS)?;
        let reference = grid.reference(&scene).map_err(Fault::from)?;
        let requested = PointSettings { transient, impacts, summary, reference, settings };
        let head = sweep::head(&scene, &grid, &requested, None);
        Ok(Self { scene, grid, requested, head })
    }

    /// Asks that the corners of the grid are scenes: then all points are.
    fn check(&self) -> PyResult<()> {
        for point in self.grid.corners() {
            let values = self.grid.values(point).map_err(Fault::from)?;
            let scene = self.grid.scene(&self.scene, &values).map_err(Fault::from)?;
            orbit::Orbit::of(&scene, self.requested.settings.clone()).map_err(Fault::from)?;
        }
        Ok(())
    }

    /// The first line: all that the points depend on, but their numbers.
    fn head(&self) -> PyResult<String> {
        json(&self.head)
    }

    /// Number of points.
    #[getter]
    fn points(&self) -> u64 {
        self.grid.points()
    }

    /// The lines of the points from the first up to the last, as a worker computes them; after Ctrl-C those that are finished.
    fn compute<'py>(&self, py: Python<'py>, first: u64, last: u64) -> PyResult<Bound<'py, PyBytes>> {
        computed(py, (first, last.min(self.grid.points())), &|point, monitor| self.line(point, monitor))
    }

    /// The journal in a file, a new one where there is none; without a path in a file that is gone with the program.
    #[pyo3(signature = (path=None))]
    fn journal(&self, path: Option<PathBuf>) -> PyResult<Journal> {
        Journal::open(self.head.clone(), path)
    }

    /// Computes what a journal lacks, by all processors; after Ctrl-C what is finished is there.
    fn complete(&self, py: Python<'_>, journal: &Bound<'_, Journal>, progress: Option<Py<PyAny>>) -> PyResult<()> {
        journal.get().complete(py, self.grid.points(), progress, &|point, monitor| self.line(point, monitor))
    }

    /// Lines as a table of CSV, without the names of columns, which are there as a line of their own.
    fn csv<'py>(&self, py: Python<'py>, lines: &[u8], rows: &str) -> PyResult<Bound<'py, PyBytes>> {
        let table = table(rows)?;
        let rows = watched_whole(py, None, |_| {
            records(lines).map(|record| Ok(csv_rows(&self.head, table, &record?))).collect::<Result<String, Fault>>()
        })?;
        Ok(PyBytes::new(py, rows.as_bytes()))
    }

    /// The names of a table's columns as a line of CSV.
    fn csv_head(&self, rows: &str) -> PyResult<String> {
        Ok(csv_head(&self.head, table(rows)?))
    }

    /// The bifurcation diagram, or of two keys the map of outcomes, as SVG; `show` is phase or velocity.
    fn svg(&self, py: Python<'_>, lines: &[u8], show: &str) -> PyResult<String> {
        let show = match show {
            "phase" => Show::Phase,
            "velocity" => Show::Velocity,
            other => return Err(Fault::range("show", other, "must be phase or velocity").into()),
        };
        watched_whole(py, None, |_| drawn(svg(&mut Lines { head: &self.head, lines }, show, None, &Look::default())))
    }

    /// The outcomes of a map, attractors of one pair told apart unless `by_word`: for each point that is there the number of its kind, the colours of kinds, the
    /// legend, and where attractors hit the left wall first, with their colours.
    fn outcomes(&self, py: Python<'_>, lines: &[u8], by_word: bool) -> PyResult<MapOutcomes> {
        watched_whole(py, None, |_| {
            let found = drawn(Outcomes::of(&mut Lines { head: &self.head, lines }, by_word))?;
            let legend = found.legend().into_iter().map(|(colour, name)| (hex(colour), name)).collect();
            let rings =
                found.rings().into_iter().map(|([phase, velocity], colour)| (phase, velocity, hex(colour))).collect();
            Ok((
                found.points.into_iter().flatten().collect(),
                found.colours.into_iter().map(hex).collect(),
                legend,
                rings,
            ))
        })
    }

    /// The columns of a table by name: lists, and of bounds bytes of doubles rounded outward, NaN where there are none.
    fn table<'py>(&self, py: Python<'py>, lines: &[u8], rows: &str) -> PyResult<Bound<'py, PyDict>> {
        let table = table(rows)?;
        let records: Vec<SweepRecord> = records(lines).collect::<Result<_, _>>()?;
        let rows: Vec<Vec<Cell<'_>>> =
            records.iter().flat_map(|record| sweep::rows(&self.head, table, record)).collect();
        dictionary(py, &columns(&self.head, table), &rows)
    }
}

/// The kind of each point, colours of kinds, the legend, and rings.
type MapOutcomes = (Vec<usize>, Vec<String>, Vec<(String, String)>, Vec<(f64, f64, String)>);

/// The table of these rows.
fn table(rows: &str) -> Result<Table, Fault> {
    match rows {
        "mixed" => Ok(Table::Mixed),
        "points" => Ok(Table::Points),
        "states" => Ok(Table::States),
        other => Err(Fault::range("rows", other, "must be mixed, points or states")),
    }
}
