//! Outcomes of a map, their colours and their legend: the same in every picture of a sweep.

use anyhow::Result;
use impact_pair::json::SweepHead;
use impact_pair::json::vocabulary::PointOutcome;
use impact_pair::pair::Wall;
use impact_pair::scene::Key;
use impact_pair_answers::grid::{Head, Points};
use impact_pair_answers::sweep::{Kinds, PointKind};
use plotters::prelude::*;

use crate::picture::{BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION, YELLOW};

/// Colours of the attractors with the most points.
const COLOURS: [RGBColor; 5] = [BLUE, ORANGE, GREEN, PURPLE, SKY];
/// Colour of the other attractors.
const OTHER_COLOUR: RGBColor = GREY;
pub(super) const UNDECIDED_COLOUR: RGBColor = VERMILION;
const SETTLED_COLOUR: RGBColor = YELLOW;

/// The outcomes of all points.
pub struct Outcomes {
    kinds: Kinds,
    /// A colour for each kind.
    pub colours: Vec<RGBColor>,
    /// The kind of each point; `None` for a missing point.
    pub points: Vec<Option<usize>>,
    /// Whether the map is over phase and velocity of a start on the left wall.
    is_of_starts: bool,
}

impl Outcomes {
    /// The outcomes of a sweep over two keys; attractors of one pair are told apart, or, with `by_word`, only by their words.
    ///
    /// # Errors
    /// Returns an error if the sweep cannot be read.
    pub fn of(sweep: &mut Points<SweepHead>, by_word: bool) -> Result<Self> {
        let grid = sweep.head.grid()?;
        let keys: Vec<Key> = grid.axes().iter().map(|axis| axis.key()).collect();
        let is_one_pair = keys.iter().all(|key| *key >= Key::StartTime);
        let starts_left = sweep.head.scene.start.wall == Some(Wall::Left);
        let is_of_starts = keys == [Key::StartPhase, Key::StartVelocity] && starts_left;
        let mut kinds = Kinds::new(is_one_pair && !by_word);
        let mut points = vec![None; usize::try_from(grid.points())?];
        sweep.each_record(|record| {
            points[usize::try_from(record.point)?] = Some(kinds.add(&record));
            Ok(())
        })?;
        let colours = colours(kinds.all());
        Ok(Self { kinds, colours, points, is_of_starts: is_of_starts && !by_word })
    }

    /// The legend, the most frequent outcome first.
    pub fn legend(&self) -> Vec<(RGBColor, String)> {
        let kinds = self.kinds.all();
        let mut order: Vec<usize> = (0..kinds.len()).filter(|&i| self.colours[i] != OTHER_COLOUR).collect();
        order.sort_by_key(|&i| std::cmp::Reverse(kinds[i].points));
        let mut entries: Vec<(RGBColor, String)> =
            order.into_iter().map(|i| (self.colours[i], self.kinds.name(&kinds[i]))).collect();
        let others = self.colours.iter().filter(|colour| **colour == OTHER_COLOUR).count();
        if others > 0 {
            entries.push((OTHER_COLOUR, format!("{others} other periodic orbits")));
        }
        entries
    }

    /// Where attractors hit the left wall first (phase, velocity), on a map of such starts, and their colours.
    pub fn rings(&self) -> Vec<([f64; 2], RGBColor)> {
        let placed = self.kinds.all().iter().zip(&self.colours).filter(|_| self.is_of_starts);
        placed.filter_map(|(kind, colour)| Some((kind.place()?, *colour))).collect()
    }
}

/// A colour for each kind.
fn colours(kinds: &[PointKind]) -> Vec<RGBColor> {
    let mut attractors: Vec<usize> = (0..kinds.len()).filter(|&i| kinds[i].period.is_some()).collect();
    attractors.sort_by_key(|&i| std::cmp::Reverse(kinds[i].points));
    let colour = |i: usize| match (kinds[i].outcome, attractors.iter().position(|&j| j == i)) {
        (_, Some(rank)) => COLOURS.get(rank).copied().unwrap_or(OTHER_COLOUR),
        (PointOutcome::Undecided, _) => UNDECIDED_COLOUR,
        (PointOutcome::UndecidedLimit, _) => BLACK,
        _ => SETTLED_COLOUR,
    };
    (0..kinds.len()).map(colour).collect()
}
