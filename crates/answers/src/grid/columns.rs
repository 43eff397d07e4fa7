//! Tables of sweeps and atlases: the types of columns, the contents of rows, and their lines of CSV.

use std::fmt;

use impact_pair::exact::{Exact, ParseError};
use impact_pair::json::ExtendedBounds;

/// The type of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A whole number.
    Whole,
    /// A word.
    Text,
    /// True or false.
    Truth,
    /// An exact number as written: text in CSV, bounds in Parquet.
    Exact,
    /// The lower end of a cell: as written in CSV, in Parquet the least double above or equal, since results about a cell are proved in the cell
    /// alone.
    Low,
    /// The upper end of a cell: as written in CSV, in Parquet the greatest double below or equal.
    High,
    /// A double without proof.
    Number,
    /// Two columns, `_lower` and `_upper`.
    Bounds,
}

/// The content of a row in a column.
#[derive(Clone, Copy)]
pub enum Cell<'r> {
    /// The row has no content in this column.
    Nothing,
    /// A whole number.
    Whole(u64),
    /// A word.
    Text(&'r dyn fmt::Display),
    /// True or false.
    Truth(bool),
    /// An exact number as written.
    Exact(&'r str),
    /// A double.
    Number(f64),
    /// Decimals, rounded outward.
    Bounds(&'r ExtendedBounds),
}

/// Names of columns as a line of CSV.
pub(super) fn csv_names(columns: Vec<(String, Kind)>) -> String {
    let names = columns.into_iter().map(|(name, kind)| match kind {
        Kind::Bounds => format!("{name}_lower,{name}_upper"),
        _ => name,
    });
    names.collect::<Vec<_>>().join(",") + "\n"
}

/// A row as a line of CSV; the kinds are those of its columns.
pub(super) fn csv_line(row: &[Cell<'_>], kinds: &[Kind]) -> String {
    let cells = row.iter().zip(kinds).map(|(cell, kind)| match cell {
        Cell::Nothing if *kind == Kind::Bounds => ",".to_owned(),
        Cell::Nothing => String::new(),
        Cell::Whole(number) => number.to_string(),
        Cell::Text(text) => text.to_string(),
        Cell::Exact(text) => (*text).to_owned(),
        Cell::Number(number) => number.to_string(),
        Cell::Truth(truth) => truth.to_string(),
        Cell::Bounds(bounds) => bounds.join(","),
    });
    cells.collect::<Vec<_>>().join(",") + "\n"
}

/// Doubles next to an exact number as written, below and above it.
///
/// # Errors
/// If the text is no exact number.
pub fn doubles(text: &str) -> Result<[f64; 2], ParseError> {
    Ok(match text {
        "inf" => [f64::INFINITY; 2],
        "-inf" => [f64::NEG_INFINITY; 2],
        text => Exact::parse(text)?.enclose(64).to_f64_bounds().into(),
    })
}
