//! The description of a motion in words.

use impact_pair::json::{self, DescriptionDocument};
use impact_pair_answers::describe::lines;
use pyo3::prelude::*;

use crate::errors::Fault;

/// The lines of a description in words, each with its label.
#[pyfunction]
pub fn description_lines(document: &str) -> PyResult<Vec<(&'static str, String)>> {
    let document: DescriptionDocument = json::read(document).map_err(Fault::from)?;
    Ok(lines(&document))
}
