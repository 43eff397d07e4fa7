//! The points of two parameters, or the cells: Lemma A20 of `docs/proofs/global.md#A20`.

use impact_pair::Error;
use impact_pair::Scene;
use impact_pair::exact::Exact;
use impact_pair::scene::{Key, Range};

use crate::grid::Grid;

/// Greatest number of tiles along an axis: each is cut into cells by itself.
const MAX_TILES: u64 = 8;

/// Two axes of parameters.
#[derive(Clone, Debug)]
pub struct Plane {
    grid: Grid,
    cells: bool,
}

/// A cell, by the positions of its ends on each axis: the smallest cells are from one position to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rectangle {
    /// The lower ends.
    pub from: [u64; 2],
    /// The upper ends.
    pub to: [u64; 2],
}

impl Plane {
    /// Plane of these axes; each axis gives its number of points, or with `cells` of cells.
    ///
    /// # Errors
    /// If there are not exactly two axes, if one of them is no parameter of the pair, or as [`Grid::new`] does.
    ///
    /// ```
    /// use impact_pair_answers::atlas::Plane;
    /// let axes = || vec!["amplitude=1..2:3".parse().unwrap(), "restitution=0..0.5:2".parse().unwrap()];
    /// assert_eq!(Plane::new(axes(), false)?.points(), 6);
    /// assert!(Plane::new(axes()[..1].to_vec(), false).is_err());
    /// # Ok::<(), impact_pair::Error>(())
    /// ```
    pub fn new(axes: Vec<Range>, cells: bool) -> Result<Self, Error> {
        let text = || axes.iter().map(Range::to_string).collect::<Vec<_>>().join(" ");
        let refused =
            |accepted: &str| Error::out_of_range(None, format!("the plane is \"{}\", but {accepted}", text()));
        if axes.len() != 2 {
            return Err(refused("accepted are two axes"));
        }
        if axes.iter().any(|axis| axis.key() >= Key::StartTime) {
            return Err(refused("the start is not used: accepted are amplitude, frequency, phase, gap, restitution"));
        }
        Ok(Self { grid: Grid::new(axes)?, cells })
    }

    /// The axes.
    pub fn axes(&self) -> &[Range] {
        self.grid.axes()
    }

    /// Whether the plane is one of cells.
    pub fn has_cells(&self) -> bool {
        self.cells
    }

    /// Number of points, or of tiles that cells are cut from.
    pub fn points(&self) -> u64 {
        if self.cells { self.tiles().iter().product() } else { self.grid.points() }
    }

    /// Number of points, or of the smallest cells, along each axis.
    pub fn counts(&self) -> [u64; 2] {
        [0, 1].map(|axis: usize| self.axes()[axis].points())
    }

    /// Tiles along each axis.
    fn tiles(&self) -> [u64; 2] {
        self.counts().map(|count| count.min(MAX_TILES)) // A20: any tiles
    }

    /// Tile of this number, from 0.
    pub fn tile(&self, point: u64) -> Rectangle {
        let (tiles, counts) = (self.tiles(), self.counts());
        let at = [(point / tiles[1]) % tiles[0], point % tiles[1]];
        let end = |after: u64| [0, 1].map(|axis| (at[axis] + after) * counts[axis] / tiles[axis]);
        Rectangle { from: end(0), to: end(1) }
    }

    /// Intervals of a cell, one per axis.
    ///
    /// # Errors
    /// If an end is beyond the range of exact expressions.
    pub fn intervals(&self, cell: &Rectangle) -> Result<Vec<(Key, Exact)>, Error> {
        let interval = |(axis, (from, to)): (&Range, (&u64, &u64))| {
            let end = |place: &u64| axis.value(*place, axis.points());
            let interval = end(from).and_then(|low| Exact::interval(&low, &end(to)?));
            let refused = |error: impact_pair::exact::ExactError| {
                Error::out_of_range(None, format!("the axis is \"{axis}\": {error}")).because(error)
            };
            Ok((axis.key(), interval.map_err(refused)?))
        };
        self.axes().iter().zip(cell.from.iter().zip(&cell.to)).map(interval).collect()
    }

    /// Values of a point, or intervals of a tile.
    ///
    /// # Errors
    /// If a value is beyond the range of exact expressions.
    pub fn values(&self, point: u64) -> Result<Vec<(Key, Exact)>, Error> {
        if self.cells { self.intervals(&self.tile(point)) } else { self.grid.values(point) }
    }

    /// Scenes at the four corners; all other scenes of the plane are between them.
    ///
    /// # Errors
    /// If one of them is not a valid scene.
    pub fn corners(&self, scene: &Scene) -> Result<Vec<Scene>, Error> {
        let corners = self.grid.corners().into_iter();
        corners.map(|point| scene.with(&self.grid.values(point)?)).collect()
    }
}

impl Rectangle {
    /// Cells that this cell is cut into, two or four; none where it is one of the smallest.
    pub fn quarters(&self) -> Vec<Self> {
        let halves = [0, 1].map(|axis| {
            let (from, to) = (self.from[axis], self.to[axis]);
            let middle = from + (to - from) / 2;
            if middle == from { vec![(from, to)] } else { vec![(from, middle), (middle, to)] }
        });
        if halves.iter().all(|parts| parts.len() == 1) {
            return Vec::new();
        }
        let all = halves[0].iter().flat_map(|x| halves[1].iter().map(move |y| (*x, *y)));
        all.map(|((x0, x1), (y0, y1))| Self { from: [x0, y0], to: [x1, y1] }).collect()
    }

    /// Number of the smallest cells that it holds.
    pub fn smallest(&self) -> u64 {
        (self.to[0] - self.from[0]) * (self.to[1] - self.from[1])
    }
}
