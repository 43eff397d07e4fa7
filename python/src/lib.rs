//! The compiled module of the Python package `impact_pair`: scenes as TOML and exact texts in, documents as JSON and bounds as
//! bytes of doubles out. Arguments are checked as by the command line; the library computes. All types and
//! the documentation for people are in the package above it.

mod answer;
mod box_map;
mod describe;
mod errors;
mod flights;
mod grid;
mod numbers;
mod orbit;
mod pictures;
mod scene;
mod surveys;
mod verbs;
mod watched;

use pyo3::prelude::*;

/// The compiled part of `impact_pair`.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::answer::{answer, question};
    #[pymodule_export]
    use super::box_map::box_map;
    #[pymodule_export]
    use super::describe::description_lines;
    #[pymodule_export]
    use super::flights::flights;
    #[pymodule_export]
    use super::grid::Grid;
    #[pymodule_export]
    use super::numbers::{bracket, outward};
    #[pymodule_export]
    use super::orbit::{Orbit, read_orbit, run};
    #[pymodule_export]
    use super::pictures::plot;
    #[pymodule_export]
    use super::scene::{Scene, paper};
    #[pymodule_export]
    use super::verbs::{check, prove};

    #[pymodule_init]
    fn init(module: &super::Bound<'_, super::PyModule>) -> super::PyResult<()> {
        use super::PyModuleMethods;
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("SCENES", super::scene::names())?;
        module.add("PANELS", super::pictures::captions())?;
        module.add("PROGRAM", impact_pair::json::PROGRAM)
    }
}
