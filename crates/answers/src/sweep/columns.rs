//! A sweep as one table or as two: the columns that CSV, Parquet and arrays share, and what each row holds.

use std::fmt;

use impact_pair::json::{ClaimName, ExtendedBounds, SweepHead, SweepImpact, SweepRecord};

use crate::grid::{Cell, Kind};

/// Rows of a table of a sweep. The table has the columns that such rows may fill.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// Impacts and points, distinguished by the column `record`.
    Mixed,
    /// The points, with the first impacts of their attractors.
    Points,
    /// The impacts after the transients.
    States,
}

/// An impact, of the orbit or the first one of its attractor.
const IMPACT_COLUMNS: [(&str, Kind); 3] = [("wall", Kind::Text), ("phase", Kind::Bounds), ("velocity", Kind::Bounds)];

/// Columns on a point, with their types.
const RESULT_COLUMNS: [(&str, Kind); 15] = [
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
    ("exponent_limit", Kind::Bounds),
];

/// Columns of a table, in order.
pub(super) fn columns(head: &SweepHead, table: Table) -> Vec<(String, Kind)> {
    let named = |&(name, kind): &(&str, Kind)| (name.to_owned(), kind);
    let mut columns = vec![("point".to_owned(), Kind::Whole)];
    // A dot would be a path in Parquet.
    columns.extend(head.over.iter().map(|over| (over.key.replace('.', "_"), Kind::Exact)));
    columns.extend((table == Table::Mixed).then(|| ("record".to_owned(), Kind::Text)));
    columns.extend((table != Table::Points).then(|| ("index".to_owned(), Kind::Whole)));
    columns.extend(IMPACT_COLUMNS.iter().map(named));
    if table != Table::States {
        columns.extend(RESULT_COLUMNS.iter().map(named));
        columns.extend(head.reference.map(|_| ("period_duration".to_owned(), Kind::Bounds)));
        columns.extend(head.claim.map(|_| ("claim".to_owned(), Kind::Text)));
    }
    columns
}

/// Rows of a point in a table: its states, then its results.
pub(super) fn rows<'r>(
    head: &SweepHead,
    table: Table,
    record: &'r SweepRecord,
) -> impl Iterator<Item = Vec<Cell<'r>>> + use<'r> {
    let has = (head.reference.is_some(), head.claim.is_some());
    let states = if table == Table::Points { &[] } else { &record.states[..] };
    let point = (table != Table::States).then_some(None);
    states.iter().map(Some).chain(point).map(move |state| row(record, state, table, has))
}

/// Row of a state, or of a point's results, with a duration and a claim where the table has columns for them.
fn row<'r>(
    record: &'r SweepRecord,
    state: Option<&'r SweepImpact>,
    table: Table,
    (has_durations, has_claims): (bool, bool),
) -> Vec<Cell<'r>> {
    let place = state.or(record.period.as_ref().and_then(|period| period.first.as_ref()));
    let impact = |of: fn(&'r SweepImpact) -> Cell<'r>| place.map_or(Cell::Nothing, of);
    let mut cells = vec![Cell::Whole(record.point)];
    cells.extend(record.values.iter().map(|value| Cell::Exact(value)));
    cells.extend((table == Table::Mixed).then_some(Cell::Text(if state.is_some() { &"state" } else { &"point" })));
    cells.extend((table != Table::Points).then(|| state.map_or(Cell::Nothing, |state| Cell::Whole(state.index))));
    cells.push(impact(|impact| Cell::Text(&impact.wall)));
    cells.push(impact(|impact| Cell::Bounds(&impact.phase)));
    cells.push(impact(|impact| Cell::Bounds(&impact.velocity)));
    if table != Table::States {
        cells.extend(if state.is_some() { [Cell::Nothing; RESULT_COLUMNS.len()] } else { cells_of(record) });
        let period = record.period.as_ref().filter(|_| state.is_none());
        let duration = period.and_then(|period| period.duration.as_ref());
        cells.extend(has_durations.then(|| duration.map_or(Cell::Nothing, Cell::Bounds)));
        let claim = if state.is_some() {
            Cell::Nothing
        } else {
            Cell::Text(record.claim.as_ref().unwrap_or(&ClaimName::ExactStart))
        };
        cells.extend(has_claims.then_some(claim));
    }
    cells
}

fn cells_of(record: &SweepRecord) -> [Cell<'_>; RESULT_COLUMNS.len()] {
    fn text<T: fmt::Display>(text: Option<&T>) -> Cell<'_> {
        text.map_or(Cell::Nothing, |text| Cell::Text(text))
    }
    fn bounds(bounds: Option<&ExtendedBounds>) -> Cell<'_> {
        bounds.map_or(Cell::Nothing, Cell::Bounds)
    }
    let whole = |number: Option<u64>| number.map_or(Cell::Nothing, Cell::Whole);
    let period = record.period.as_ref();
    [
        Cell::Text(&record.outcome),
        text(record.reason.as_ref()),
        Cell::Truth(record.complete),
        Cell::Whole(record.bits.into()),
        Cell::Whole(record.impacts),
        whole(record.wide_from),
        bounds(record.impacts_per_cycle.as_ref()),
        bounds(record.exponent.per_impact.as_ref()),
        bounds(record.exponent.per_cycle.as_ref()),
        text(record.exponent.reason.as_ref()),
        text(period.and_then(|period| period.word.as_ref())),
        whole(period.map(|period| period.impacts)),
        whole(period.and_then(|period| period.cycles)),
        whole(period.and_then(|period| period.from)),
        bounds(record.exponent_limit.as_ref()),
    ]
}
