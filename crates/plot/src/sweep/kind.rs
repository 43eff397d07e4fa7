//! Outcomes of a map: attractors, and others.

use std::f64::consts::TAU;
use std::fmt::Write;

use impact_pair::json::vocabulary::PointOutcome;
use impact_pair::mapping::Word;
use impact_pair::pair::Wall;
use plotters::prelude::*;

use super::{double, middle};
use crate::picture::{BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION, YELLOW};
use impact_pair::json::{ExtendedBounds, SweepPeriod, SweepRecord};

/// Greatest number of letters of a word in a legend.
const MAX_LETTERS: usize = 10;
/// Colours of the attractors with the most points.
const COLOURS: [RGBColor; 5] = [BLUE, ORANGE, GREEN, PURPLE, SKY];
/// Colour of the other attractors.
pub const OTHER_COLOUR: RGBColor = GREY;
pub const UNDECIDED_COLOUR: RGBColor = VERMILION;
const SETTLED_COLOUR: RGBColor = YELLOW;

/// An outcome of a map: an attractor, or another one.
pub struct Kind {
    pub outcome: PointOutcome,
    pub period: Option<SweepPeriod>,
    pub points: u64,
}

impl Kind {
    /// Whether a point has this outcome. Attractors of one pair are distinguished by their first impacts, of several pairs by their words.
    pub fn is_of(&self, record: &SweepRecord, is_one_pair: bool) -> bool {
        let alike = |a: &SweepPeriod, b: &SweepPeriod| {
            let near = match (&a.first, &b.first) {
                (Some(a), Some(b)) => overlap(&a.phase, &b.phase, TAU) && overlap(&a.velocity, &b.velocity, 0.0),
                _ => true,
            };
            (a.impacts, a.cycles, &a.word) == (b.impacts, b.cycles, &b.word) && (near || !is_one_pair)
        };
        let same_period = match (&self.period, &record.period) {
            (Some(a), Some(b)) => alike(a, b),
            (None, None) => true,
            _ => false,
        };
        self.outcome == record.outcome && same_period
    }

    pub fn name(&self, is_one_pair: bool) -> String {
        let word = |period: &SweepPeriod| period.word.as_deref().and_then(|word| word.parse::<Word>().ok());
        let Some((period, word)) = self.period.as_ref().and_then(|period| Some((period, word(period)?))) else {
            return match self.outcome {
                PointOutcome::Periodic => "exactly periodic through rest".to_owned(),
                PointOutcome::UndecidedLimit => "undecided convergence".to_owned(),
                other => other.to_string().replace('-', " "),
            };
        };
        let lasting = match period.cycles {
            Some(1) => "1 cycle".to_owned(),
            Some(cycles) => format!("{cycles} cycles"),
            None => "no whole cycles".to_owned(),
        };
        let letter = |wall| if wall == Wall::Left { 'L' } else { 'R' };
        let mut walls: String =
            word.mappings().iter().take(MAX_LETTERS).map(|mapping| letter(mapping.walls().0)).collect();
        if word.mappings().len() > MAX_LETTERS {
            let _ = write!(walls, "… ({} impacts)", word.mappings().len());
        }
        let place = period.first.as_ref().filter(|_| is_one_pair).and_then(|first| middle(&first.phase).ok());
        let place = place.map_or_else(String::new, |phase| format!(", L at {phase:.2} rad"));
        format!("{walls} in {lasting}{place}")
    }
}

/// Whether two pairs of bounds may hold numbers that are equal or differ by `period`; in doubles, as for labels.
fn overlap(a: &ExtendedBounds, b: &ExtendedBounds, period: f64) -> bool {
    let ends = |bounds: &ExtendedBounds| Some((double(&bounds[0]).ok()?, double(&bounds[1]).ok()?));
    let Some(((a0, a1), (b0, b1))) = ends(a).zip(ends(b)) else { return false };
    // Bound of the rounding errors of reading and shifting.
    let slack = 4.0 * f64::EPSILON * (a1.abs() + b1.abs() + period);
    [-period, 0.0, period].iter().any(|shift| a0 + shift <= b1 + slack && b0 <= a1 + shift + slack)
}

/// A colour for each kind.
pub fn colours(kinds: &[Kind]) -> Vec<RGBColor> {
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
