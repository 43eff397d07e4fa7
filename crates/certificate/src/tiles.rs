//! The cells of an atlas, read back: the tiles into which a rectangle of two parameters is cut, and the quarters of each. Lemma V38

use impact_pair_document::AtlasRecord;
use impact_pair_exact::Exact;
use impact_pair_model::Error;

use super::grid::{Axes, and, is_one, on_axis};

/// Greatest number of tiles along an axis.
const MAX_TILES: u64 = 8;

/// A cell, by the positions of its ends on each axis; the ends of smallest cells are adjacent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tile {
    from: [u64; 2],
    to: [u64; 2],
}

impl Tile {
    /// The tile number `point` of the tiles that group `counts` smallest cells along the axes; `None` where there is no such tile.
    pub fn of(point: u64, counts: [u64; 2]) -> Option<Self> {
        let tiles = tiles(counts);
        let at = [point.checked_div(tiles[1])?, point.checked_rem(tiles[1])?];
        let end = |axis: usize, place: u64| -> Option<u64> {
            let end = u128::from(place) * u128::from(counts[axis]) / u128::from(tiles[axis]);
            u64::try_from(end).ok()
        };
        let ends = |after: u64| Some([end(0, at[0] + after)?, end(1, at[1] + after)?]);
        (at[0] < tiles[0]).then_some(())?;
        Some(Self { from: ends(0)?, to: ends(1)? })
    }

    /// The two or four cells into which the cell is cut; none for a smallest cell.
    pub fn quarters(&self) -> Vec<Self> {
        let parts = |axis: usize| {
            let (from, to) = (self.from[axis], self.to[axis]);
            let middle = from + (to - from) / 2;
            if middle > from { vec![[from, middle], [middle, to]] } else { vec![[from, to]] }
        };
        let all: Vec<Self> = parts(0)
            .iter()
            .flat_map(|x| parts(1).into_iter().map(|y| Self { from: [x[0], y[0]], to: [x[1], y[1]] }))
            .collect();
        if all.len() == 1 { Vec::new() } else { all }
    }

    /// Position of the cell on each axis.
    pub fn places(&self) -> Vec<Option<u64>> {
        self.from.map(Some).to_vec()
    }
}

impl Axes<'_> {
    /// The numbers of smallest cells along two axes; `None` unless there are two axes.
    pub fn cells(&self) -> Option<[u64; 2]> {
        <[u64; 2]>::try_from(self.counts()).ok()
    }

    /// Whether the given number of tiles is right.
    pub fn are_all_tiles(&self) -> bool {
        self.cells().map(tiles).is_some_and(|[one, other]| one * other == self.points())
    }

    /// Whether the values of a record are the intervals of a cell; `None` if undecided.
    ///
    /// # Errors
    /// Returns an error unless there is one number for each axis.
    pub fn are_of_cell(&self, cell: &Tile, record: &AtlasRecord) -> Result<Option<bool>, Error> {
        let wrong = |message: String| Error::certificate(format!("values: {message}"));
        if record.values.len() != 2 {
            return Err(wrong("there must be one of each axis".to_owned()));
        }
        let mut are = Some(true);
        for (axis, text) in record.values.iter().enumerate() {
            let value = Exact::parse(text).map_err(|error| wrong(error.to_string()).because(error))?;
            let Some((low, high)) = value.ends() else { return Ok(None) };
            for (place, end) in [(cell.from[axis], low), (cell.to[axis], high)] {
                let places = self.counts()[axis].checked_add(1);
                let grid = places.and_then(|places| on_axis(self.ends(axis), places, place).ok());
                are = and(are, is_one(grid, &end));
            }
        }
        Ok(are)
    }
}

/// The numbers of tiles along the axes for these numbers of smallest cells.
fn tiles(counts: [u64; 2]) -> [u64; 2] {
    counts.map(|count| count.min(MAX_TILES)) // V38: no more tiles than cells
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each smallest cell is in exactly one tile, and in exactly one cell that is not cut.
    #[test]
    fn v38_tiles_and_quarters_cover_the_rectangle_once() {
        for counts in [[2, 2], [3, 5], [8, 8], [13, 20], [2, 40]] {
            let tiles: u64 = counts.map(|count| count.min(MAX_TILES)).iter().product();
            let mut cells: Vec<Tile> = (0..tiles).map(|point| Tile::of(point, counts).unwrap()).collect();
            let mut seen = std::collections::HashSet::new();
            while let Some(cell) = cells.pop() {
                let quarters = cell.quarters();
                let is_smallest = (0..2).all(|axis| cell.to[axis] == cell.from[axis] + 1);
                assert!(quarters.is_empty() == is_smallest && (!is_smallest || seen.insert(cell.from)), "{cell:?}");
                cells.extend(quarters);
            }
            assert_eq!(seen.len() as u64, counts[0] * counts[1]);
            assert_eq!(Tile::of(tiles, counts), None);
        }
        assert_eq!(Tile::of(0, [0, 3]), None);
        assert_eq!(Tile::of(0, [3, 0]), None);
        assert!(Tile::of(63, [u64::MAX, u64::MAX]).is_some_and(|last| last.to == [u64::MAX; 2]));
    }
}
