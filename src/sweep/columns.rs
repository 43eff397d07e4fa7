//! A sweep as a table: the columns that CSV, Parquet and arrays share, what each row holds, and CSV.

use impact_pair_certificate::document::{ExtendedBounds, SweepHead, SweepImpact, SweepRecord};

use crate::exact::{Exact, ParseError};

/// What a column holds.
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
    /// Two columns, `_lower` and `_upper`.
    Bounds,
}

/// What a row has in a column.
#[derive(Clone, Copy, Debug)]
pub enum Cell<'r> {
    /// It has none.
    Nothing,
    /// A whole number.
    Whole(u64),
    /// A word.
    Text(&'r str),
    /// True or false.
    Truth(bool),
    /// An exact number as written.
    Exact(&'r str),
    /// Decimals, rounded outward.
    Bounds(&'r ExtendedBounds),
}

/// The columns of a sweep, in order.
pub fn columns(head: &SweepHead) -> Vec<(String, Kind)> {
    let rest = [
        ("record", Kind::Text),
        ("index", Kind::Whole),
        ("wall", Kind::Text),
        ("phase", Kind::Bounds),
        ("velocity", Kind::Bounds),
        ("outcome", Kind::Text),
        ("reason", Kind::Text),
        ("complete", Kind::Truth),
        ("bits", Kind::Whole),
        ("impacts", Kind::Whole),
        ("wide_from", Kind::Whole),
        ("impacts_per_cycle", Kind::Bounds),
        ("exponent", Kind::Bounds),
        ("exponent_per_cycle", Kind::Bounds),
        ("exponent_reason", Kind::Text),
        ("word", Kind::Text),
        ("period_impacts", Kind::Whole),
        ("period_cycles", Kind::Whole),
        ("attracted_from", Kind::Whole),
    ];
    let claim = head.claim.map(|_| ("claim", Kind::Text));
    // A dot would be a path in Parquet.
    let keys = head.over.iter().map(|over| (over.key.replace('.', "_"), Kind::Exact));
    let rest = rest.into_iter().chain(claim).map(|(name, kind)| (name.to_owned(), kind));
    [("point".to_owned(), Kind::Whole)].into_iter().chain(keys).chain(rest).collect()
}

/// The rows of a point, with claims if the head has one: its states, then what is said of it all, with the first impact of its
/// attractor.
pub fn rows(record: &SweepRecord, has_claims: bool) -> impl Iterator<Item = Vec<Cell<'_>>> {
    let states = record.states.iter().map(move |state| row(record, Some(state), has_claims));
    states.chain([row(record, None, has_claims)])
}

fn row<'r>(record: &'r SweepRecord, state: Option<&'r SweepImpact>, has_claims: bool) -> Vec<Cell<'r>> {
    let text = |text: &'r Option<String>| text.as_deref().map_or(Cell::Nothing, Cell::Text);
    let whole = |number: Option<u64>| number.map_or(Cell::Nothing, Cell::Whole);
    let bounds = |bounds: &'r Option<ExtendedBounds>| bounds.as_ref().map_or(Cell::Nothing, Cell::Bounds);
    let mut cells = vec![Cell::Whole(record.point)];
    cells.extend(record.values.iter().map(|value| Cell::Exact(value)));
    let period = record.period.as_ref();
    let place = state.or(period.and_then(|period| period.first.as_ref()));
    let impact = |of: fn(&'r SweepImpact) -> Cell<'r>| place.map_or(Cell::Nothing, of);
    cells.push(Cell::Text(if state.is_some() { "state" } else { "point" }));
    cells.push(whole(state.map(|state| state.index)));
    cells.push(impact(|impact| Cell::Text(impact.wall.name())));
    cells.push(impact(|impact| Cell::Bounds(&impact.phase)));
    cells.push(impact(|impact| Cell::Bounds(&impact.velocity)));
    if state.is_some() {
        cells.extend([Cell::Nothing; 14]);
        cells.extend(has_claims.then_some(Cell::Nothing));
        return cells;
    }
    cells.extend([
        Cell::Text(&record.outcome),
        text(&record.reason),
        Cell::Truth(record.complete),
        Cell::Whole(record.bits.into()),
        Cell::Whole(record.impacts),
        whole(record.wide_from),
        bounds(&record.impacts_per_cycle),
        bounds(&record.exponent.per_impact),
        bounds(&record.exponent.per_cycle),
        text(&record.exponent.reason),
        period.map_or(Cell::Nothing, |period| text(&period.word)),
        whole(period.map(|period| period.impacts)),
        whole(period.map(|period| period.cycles)),
        whole(period.and_then(|period| period.from)),
    ]);
    cells.extend(has_claims.then(|| Cell::Text(record.claim.unwrap_or_default().text())));
    cells
}

/// The names of the columns as a line of CSV.
pub fn csv_head(head: &SweepHead) -> String {
    let names = columns(head).into_iter().map(|(name, kind)| match kind {
        Kind::Bounds => format!("{name}_lower,{name}_upper"),
        Kind::Whole | Kind::Text | Kind::Truth | Kind::Exact => name,
    });
    names.collect::<Vec<_>>().join(",") + "\n"
}

/// The rows of a point as lines of CSV.
pub fn csv_rows(head: &SweepHead, record: &SweepRecord) -> String {
    let kinds: Vec<Kind> = columns(head).into_iter().map(|(_, kind)| kind).collect();
    let line = |row: Vec<Cell<'_>>| {
        let cells = row.iter().zip(&kinds).map(|(cell, kind)| match cell {
            Cell::Nothing if *kind == Kind::Bounds => ",".to_owned(),
            Cell::Nothing => String::new(),
            Cell::Whole(number) => number.to_string(),
            Cell::Text(text) | Cell::Exact(text) => (*text).to_owned(),
            Cell::Truth(truth) => truth.to_string(),
            Cell::Bounds([low, high]) => format!("{low},{high}"),
        });
        cells.collect::<Vec<_>>().join(",") + "\n"
    };
    rows(record, head.claim.is_some()).map(line).collect()
}

/// The doubles next to an exact number as written, below and above it.
///
/// # Errors
/// When it is none.
pub fn doubles(text: &str) -> Result<[f64; 2], ParseError> {
    Ok(match text {
        "inf" => [f64::INFINITY; 2],
        "-inf" => [f64::NEG_INFINITY; 2],
        text => Exact::parse(text)?.enclose(64).to_f64_bounds().into(),
    })
}
