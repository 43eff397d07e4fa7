//! Many flights, each by itself.

use impact_pair::mapping::Mapping;
use impact_pair::orbit::Arrivals;
use impact_pair::pair::Wall;
use impact_pair::watch::Watch;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::Fault;
use crate::numbers::{bytes, read};
use crate::scene::Scene;
use crate::watched::watched;

/// Flights between two looks at whether to go on.
const FLIGHTS_PER_POLL: usize = 1024;

/// The walls by their side: -1 left, 1 right, 0 none.
pub fn side(wall: Option<Wall>) -> u8 {
    match wall {
        None => 0,
        Some(Wall::Left) => (-1i8).cast_unsigned(),
        Some(Wall::Right) => 1,
    }
}

/// The number of a mapping in the paper, 0 for none.
pub fn number(mapping: Option<Mapping>) -> u8 {
    match mapping {
        None => 0,
        Some(Mapping::P1) => 1,
        Some(Mapping::P2) => 2,
        Some(Mapping::P3) => 3,
        Some(Mapping::P4) => 4,
    }
}

/// Walls, mappings, and bounds of times and velocities; and whether Ctrl-C ended the work.
type Found<'py> = ([Bound<'py, PyBytes>; 4], bool);

/// The next impacts of states on walls: times and velocities before the impact as bytes of doubles, walls as bytes of sides.
///
/// For states that doubles do not decide, and those left after Ctrl-C, the wall is 0 and the bounds are NaN.
#[pyfunction]
pub fn flights<'py>(
    py: Python<'py>,
    scene: &Bound<'py, Scene>,
    states: (&[u8], &[u8], &[u8]),
    progress: Option<Py<PyAny>>,
) -> PyResult<Found<'py>> {
    let pair = scene.get().scene.pair().clone();
    let (times, velocities, walls) = (read(states.0), read(states.1), states.2.to_vec());
    let (found, interrupted) = watched(py, progress, move |monitor| {
        let arrivals = Arrivals::new(&pair)?;
        let mut found = Vec::with_capacity(walls.len());
        for (i, ((wall, time), velocity)) in walls.iter().zip(&times).zip(&velocities).enumerate() {
            if i % FLIGHTS_PER_POLL == 0 {
                monitor.report(i as u64);
                if !monitor.goes_on() {
                    break;
                }
            }
            let wall = if *wall == side(Some(Wall::Right)) { Wall::Right } else { Wall::Left };
            let at = |error: impact_pair::Error| {
                let (key, value) = match error.key() {
                    Some("start.time") => ("t", *time),
                    _ => ("v", *velocity),
                };
                Fault::range(&format!("{key}[{i}]"), value, "must be finite, and a velocity point at its wall")
            };
            found.push(arrivals.next(wall, *time, *velocity).map_err(at)?.ok());
        }
        let interrupted = found.len() < walls.len();
        found.resize_with(walls.len(), || None);
        Ok((found, interrupted))
    })?;
    let walls: Vec<u8> = found.iter().map(|next| side(next.map(|next| next.wall))).collect();
    let mappings: Vec<u8> = found.iter().map(|next| number(next.map(|next| next.mapping))).collect();
    let unknown = [f64::NAN; 2];
    let times = found.iter().flat_map(|next| next.map_or(unknown, |next| next.time));
    let velocities = found.iter().flat_map(|next| next.map_or(unknown, |next| next.velocity));
    let columns = [PyBytes::new(py, &walls), PyBytes::new(py, &mappings), bytes(py, times), bytes(py, velocities)];
    Ok((columns, interrupted))
}
