//! Exact texts and their bounds as doubles.

use impact_pair::exact::{Enclosure, Exact, decimal_digits};
use impact_pair_answers::grid::doubles;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::Fault;

/// Doubles as bytes, for `numpy.frombuffer`.
pub fn bytes<'py>(py: Python<'py>, doubles: impl Iterator<Item = f64>) -> Bound<'py, PyBytes> {
    let bytes: Vec<u8> = doubles.flat_map(f64::to_ne_bytes).collect();
    PyBytes::new(py, &bytes)
}

/// The doubles of bytes.
pub fn read(bytes: &[u8]) -> Vec<f64> {
    bytes.as_chunks::<8>().0.iter().map(|bytes| f64::from_ne_bytes(*bytes)).collect()
}

/// A number that a keyword gives.
pub fn exact(key: &str, text: &str) -> Result<Exact, Fault> {
    Exact::parse(text).map_err(|error| Fault::range(key, text, &format!("does not read as a number: {error}")))
}

/// Pairs of texts, lower and upper bounds, as bytes of doubles rounded outward.
#[pyfunction]
pub fn outward<'py>(py: Python<'py>, bounds: Vec<(String, String)>) -> PyResult<Bound<'py, PyBytes>> {
    let mut found = Vec::with_capacity(2 * bounds.len());
    for (lower, upper) in &bounds {
        let end = |text: &str| doubles(text).map_err(|error| Fault::range("bounds", text, &error.to_string()));
        found.extend([end(lower)?[0], end(upper)?[1]]);
    }
    Ok(bytes(py, found.into_iter()))
}

/// Bounds in bracket notation: the digits that are certain, then the ends of the rest.
#[pyfunction]
pub fn bracket(lower: &str, upper: &str) -> PyResult<String> {
    let [low, high] = [exact("lower", lower)?, exact("upper", upper)?].map(|end| end.enclose(BITS));
    let ends = low.inf() <= high.sup();
    let found = Enclosure::new(low.inf().clone(), high.sup().clone()).filter(|_| ends);
    Ok(decimal_digits(&found.ok_or_else(|| Fault::range("lower", lower, "must be at most the upper bound"))?))
}

/// Bits in which decimals are shown: 400 digits and more.
const BITS: u32 = 2048;
