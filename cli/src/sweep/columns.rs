//! A sweep as a table: the columns that CSV and Parquet share, and what each row holds.

use impact_pair::certificate::document::{ExtendedBounds, SweepHead, SweepImpact, SweepRecord};

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Whole,
    Text,
    Truth,
    /// An exact number as written: text in CSV, bounds in Parquet.
    Exact,
    /// Two columns, `_lower` and `_upper`.
    Bounds,
}

/// What a row has in a column.
#[derive(Clone, Copy, Debug)]
pub enum Cell<'r> {
    Nothing,
    Whole(u64),
    Text(&'r str),
    Truth(bool),
    Exact(&'r str),
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
