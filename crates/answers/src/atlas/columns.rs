//! An atlas as a table: the columns that CSV, Parquet and arrays share, and what each row holds.

use impact_pair::json::{AtlasHead, AtlasRecord};

use crate::grid::{Cell, Kind};

/// Columns on a point or a cell, with their types.
const RESULT_COLUMNS: [(&str, Kind); 7] = [
    ("class", Kind::Text),
    ("n_attracting", Kind::Whole),
    ("n_rest", Kind::Whole),
    ("n_saddle", Kind::Whole),
    ("n_undecided", Kind::Whole),
    ("undecided_area", Kind::Number),
    ("seconds", Kind::Number),
];

/// Further columns of an atlas of cells, or of one that looks for horseshoes.
const FURTHER_COLUMNS: [(&str, Kind); 2] = [("n_stable", Kind::Whole), ("entropy", Kind::Number)];

/// Whether an atlas has the columns [`FURTHER_COLUMNS`].
fn has_more(head: &AtlasHead) -> bool {
    head.cells || head.horseshoes.is_some()
}

/// Columns, in order: the point or tile, the varied parameters, and the answer.
pub(super) fn columns(head: &AtlasHead) -> Vec<(String, Kind)> {
    let mut columns = vec![("point".to_owned(), Kind::Whole)];
    for over in &head.over {
        // A dot would be a path in Parquet.
        let key = over.key.replace('.', "_");
        if head.cells {
            columns.extend([(format!("{key}_low"), Kind::Low), (format!("{key}_high"), Kind::High)]);
        } else {
            columns.push((key, Kind::Exact));
        }
    }
    let besides = if has_more(head) { &FURTHER_COLUMNS[..] } else { &[] };
    columns.extend(RESULT_COLUMNS.iter().chain(besides).map(|&(name, kind)| (name.to_owned(), kind)));
    columns
}

/// Rows of a record: itself, or the cells that it is cut into.
pub(super) fn rows<'r>(head: &AtlasHead, record: &'r AtlasRecord) -> Vec<Vec<Cell<'r>>> {
    record.leaves().into_iter().map(|leaf| row(head, leaf)).collect()
}

fn row<'r>(head: &AtlasHead, record: &'r AtlasRecord) -> Vec<Cell<'r>> {
    let mut cells = vec![Cell::Whole(record.point)];
    for value in &record.values {
        if head.cells {
            let ends = value.trim_start_matches('[').trim_end_matches(']').split_once(',');
            let (low, high) = ends.unwrap_or((value, value)); // exact: a number is its own interval
            cells.extend([Cell::Exact(low.trim()), Cell::Exact(high.trim())]);
        } else {
            cells.push(Cell::Exact(value));
        }
    }
    cells.push(Cell::Text(&record.class));
    let counts = [record.n_attracting, record.n_rest, record.n_saddle, record.n_undecided];
    cells.extend(counts.map(Cell::Whole));
    let area = record.undecided_area.text().parse().unwrap_or(f64::NAN); // shown
    cells.extend([Cell::Number(area), Cell::Number(record.seconds)]);
    if has_more(head) {
        cells.extend([Cell::Whole(record.stable.len() as u64), Cell::Number(record.entropy())]); // exact: a length
    }
    cells
}
