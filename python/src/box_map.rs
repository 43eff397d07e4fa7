//! Images of many rectangles, each by itself: the reduced impact map for searches on grids.

use impact_pair::chaos::{BoxMap, Rectangle, Unmapped};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rayon::prelude::*;

use crate::errors::Fault;
use crate::numbers::{bytes, read};
use crate::scene::Scene;
use crate::watched::watched;
use impact_pair::watch::Watch;

/// Rectangles around the landings on the near wall, on the far one and on both, and what is undecided: 0 nothing, 1 a rest,
/// 2 a long flight, 3 not examined before Ctrl-C.
type Images<'py> = [Bound<'py, PyBytes>; 4];

/// The images of rectangles: least phase and speed, greatest phase and speed; NaN where there is none.
#[pyfunction]
pub fn box_map<'py>(
    py: Python<'py>,
    scene: &Bound<'py, Scene>,
    rects: &[u8],
    columns: i64,
    progress: Option<Py<PyAny>>,
) -> PyResult<Images<'py>> {
    let pair = scene.get().scene.pair().clone();
    let rects = read(rects);
    let found = watched(py, progress, move |monitor| {
        let map = BoxMap::new(&pair, columns)?;
        let image = |(i, rect): (usize, &[f64; 4])| {
            monitor.add_one();
            if !monitor.goes_on() {
                return Ok(None);
            }
            let [u, w, v, x] = *rect;
            let accepted = "must have finite ends in order, speeds of at least 0, and none beyond 1024";
            let image = map.image(&Rectangle { phase: [u, v], speed: [w, x] });
            image.map(Some).ok_or_else(|| Fault::range(&format!("rects[{i}]"), format!("{rect:?}"), accepted))
        };
        rects.as_chunks().0.par_iter().enumerate().map(image).collect::<Result<Vec<_>, _>>()
    })?;
    let ends = |rect: Option<Rectangle>| {
        rect.map_or([f64::NAN; 4], |Rectangle { phase, speed }| [phase[0], speed[0], phase[1], speed[1]])
    };
    let parts = found.iter().map(|image| match image {
        Some(Ok(image)) => [image.near, image.far, image.hull],
        Some(Err(_)) | None => [None; 3],
    });
    let parts: Vec<_> = parts.collect();
    let part = |k: usize| bytes(py, parts.iter().flat_map(|part| ends(part[k])));
    let reason = |image: &Option<Result<_, Unmapped>>| match image {
        Some(Ok(_)) => 0,
        Some(Err(Unmapped::Rest)) => 1,
        Some(Err(Unmapped::Long)) => 2,
        None => 3,
    };
    let reasons: Vec<u8> = found.iter().map(reason).collect();
    Ok([part(0), part(1), part(2), PyBytes::new(py, &reasons)])
}
