//! Atlases: points and tiles are pure functions of the exact scene and their number.

use std::path::PathBuf;

use impact_pair::atlas::{self, Plane, columns, csv_head, csv_rows};
use impact_pair::chaos::{Global, GlobalSettings, MOST_DEPTH};
use impact_pair::json::{AtlasHead, AtlasRecord};
use impact_pair::scene::DIGITS;
use impact_pair::watch::Silent;
use impact_pair_plot::atlas::{html, svg};
use impact_pair_plot::picture::Look;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::errors::{Fault, accepted, effort_of};
use crate::grid::{Journal, computed, dictionary};
use crate::lines::{Lines, records};
use crate::pictures::drawn;
use crate::scene::{Scene, json};
use crate::sweep::{named, ranged};
use crate::watched::{Monitor, watched_whole};

/// The most impacts of words of horseshoes, if these are looked for in components.
fn depth(horseshoes: Option<u32>) -> Result<Option<usize>, Fault> {
    Ok(horseshoes.map(|depth| accepted("horseshoes", depth, 1..=MOST_DEPTH)).transpose()?.map(|depth| depth as usize))
}

/// An atlas over the plane of two parameters, and the settings of its points or cells.
#[pyclass(frozen, module = "impact_pair._core")]
pub struct Atlas {
    scene: impact_pair::Scene,
    plane: Plane,
    settings: GlobalSettings,
    head: AtlasHead,
}

impl Atlas {
    /// The line of a point or a tile; `None` where it was stopped.
    fn line(&self, point: u64, monitor: &Monitor) -> Result<Option<String>, Fault> {
        let found = atlas::record(&self.scene, &self.plane, &self.settings, point, &Silent(monitor));
        let found = match found {
            Ok(found) => found,
            Err(error) => return Err(named(point, &self.plane.values(point)?, &error)),
        };
        monitor.add_one();
        Ok(found.map(|record| serde_json::to_string(&record).expect("plain data")))
    }
}

#[pymethods]
impl Atlas {
    /// An atlas over two axes, `KEY=LO..HI:COUNT`, of points or cells, with the effort for each, the impacts of words of horseshoes, and digits.
    #[new]
    fn new(
        scene: &Bound<'_, Scene>,
        over: Vec<String>,
        cells: bool,
        requested: (&str, Option<u32>, u32),
    ) -> PyResult<Self> {
        let scene = scene.get().scene.clone();
        let axes = ranged(&over, &scene)?;
        let plane = Plane::new(axes, cells).map_err(|error| Fault::keyed(error, "over", &over.join(" ")))?;
        let (effort, horseshoes, digits) = requested;
        let usual = if cells { GlobalSettings::of_cell() } else { GlobalSettings::of_point() };
        let mut settings = GlobalSettings { horseshoes: depth(horseshoes)?, ..usual }.with_effort(effort_of(effort)?);
        settings.precision.digits = accepted("digits", digits, DIGITS)?;
        let head = atlas::head(&scene, &plane, &settings, None);
        Ok(Self { scene, plane, settings, head })
    }

    /// Asks that the corners of the plane are scenes that are analysed: then all others are.
    fn check(&self) -> PyResult<()> {
        for corner in self.plane.corners(&self.scene).map_err(Fault::from)? {
            Global::accepts(corner.pair()).map_err(Fault::from)?;
        }
        Ok(())
    }

    /// The first line: all that the points depend on, but their numbers.
    fn head(&self) -> PyResult<String> {
        json(&self.head)
    }

    /// Number of points, or of tiles.
    #[getter]
    fn points(&self) -> u64 {
        self.plane.points()
    }

    /// The lines of the points from the first up to the last, as a worker computes them; after Ctrl-C those that are finished.
    fn compute<'py>(&self, py: Python<'py>, first: u64, last: u64) -> PyResult<Bound<'py, PyBytes>> {
        computed(py, (first, last.min(self.plane.points())), &|point, monitor| self.line(point, monitor))
    }

    /// The journal in a file, a new one where there is none; without a path in a file that is gone with the program.
    #[pyo3(signature = (path=None))]
    fn journal(&self, path: Option<PathBuf>) -> PyResult<Journal> {
        Journal::open(self.head.clone(), path)
    }

    /// Computes what a journal lacks, by all processors; after Ctrl-C what is finished is there.
    fn complete(&self, py: Python<'_>, journal: &Bound<'_, Journal>, progress: Option<Py<PyAny>>) -> PyResult<()> {
        journal.get().complete(py, self.plane.points(), progress, &|point, monitor| self.line(point, monitor))
    }

    /// Lines as a table of CSV, without the names of columns, which are there as a line of their own.
    fn csv<'py>(&self, py: Python<'py>, lines: &[u8]) -> PyResult<Bound<'py, PyBytes>> {
        let rows = watched_whole(py, None, |_| {
            records(lines).map(|record| Ok(csv_rows(&self.head, &record?))).collect::<Result<String, Fault>>()
        })?;
        Ok(PyBytes::new(py, rows.as_bytes()))
    }

    /// The names of the columns as a line of CSV.
    fn csv_head(&self) -> String {
        csv_head(&self.head)
    }

    /// The plane in the colours of the classes, as SVG.
    fn svg(&self, py: Python<'_>, lines: &[u8]) -> PyResult<String> {
        watched_whole(py, None, |_| drawn(svg(&mut Lines { head: &self.head, lines }, &Look::default())))
    }

    /// The page, as HTML.
    fn html(&self, py: Python<'_>, lines: &[u8]) -> PyResult<String> {
        watched_whole(py, None, |_| drawn(html(&mut Lines { head: &self.head, lines })))
    }

    /// The columns of the table by name.
    fn table<'py>(&self, py: Python<'py>, lines: &[u8]) -> PyResult<Bound<'py, PyDict>> {
        let records: Vec<AtlasRecord> = records(lines).collect::<Result<_, _>>()?;
        let rows: Vec<_> = records.iter().flat_map(|record| atlas::rows(&self.head, record)).collect();
        dictionary(py, &columns(&self.head), &rows)
    }
}
