//! Kinds of outcomes over a sweep: which points end in one attractor.

use std::f64::consts::TAU;
use std::fmt::Write;

use impact_pair::json::vocabulary::PointOutcome;
use impact_pair::json::{ExtendedBounds, SweepPeriod, SweepRecord};

use crate::grid::doubles;
use impact_pair::mapping::Word;
use impact_pair::pair::Wall;

/// Greatest number of letters of a word in a name.
const MAX_LETTERS: usize = 10;

/// A kind of outcome: an attractor, or another one.
#[derive(Clone, Debug)]
pub struct PointKind {
    /// The outcome.
    pub outcome: PointOutcome,
    /// The period of the attractor.
    pub period: Option<SweepPeriod>,
    /// Number of points of this kind.
    pub points: u64,
}

/// The kinds of outcomes of a sweep, in the order of their first points.
///
/// Two attractors of one pair count as one where they have the same word and the bounds of their first impacts overlap; where these bounds are apart,
/// the attractors are proved to differ. Attractors of several pairs count as one where they have the same word. Only the records decide, so that a
/// sweep has the same kinds in the command line and in Python.
#[derive(Clone, Debug)]
pub struct Kinds {
    all: Vec<PointKind>,
    by_place: bool,
}

impl Kinds {
    /// No kinds yet; `by_place` tells attractors of one pair apart by their first impacts.
    pub fn new(by_place: bool) -> Self {
        Self { all: Vec::new(), by_place }
    }

    /// The kinds so far.
    pub fn all(&self) -> &[PointKind] {
        &self.all
    }

    /// Counts a point, and returns the number of its kind.
    pub fn add(&mut self, record: &SweepRecord) -> usize {
        // Exact periods through a rest are one kind.
        let period = record.period.as_ref().filter(|period| period.word.is_some());
        let is_alike = |a: &SweepPeriod, b: &SweepPeriod| {
            let near = match (&a.first, &b.first) {
                (Some(a), Some(b)) => overlap(&a.phase, &b.phase, TAU) && overlap(&a.velocity, &b.velocity, 0.0),
                _ => true,
            };
            (a.impacts, a.cycles, &a.word) == (b.impacts, b.cycles, &b.word) && (near || !self.by_place)
        };
        let is_one = |kind: &PointKind| {
            let same_period = match (&kind.period, period) {
                (Some(a), Some(b)) => is_alike(a, b),
                (None, None) => true,
                _ => false,
            };
            kind.outcome == record.outcome && same_period
        };
        let number = self.all.iter().position(is_one).unwrap_or_else(|| {
            self.all.push(PointKind { outcome: record.outcome, period: period.cloned(), points: 0 });
            self.all.len() - 1
        });
        self.all[number].points += 1;
        number
    }

    /// The name of a kind in legends.
    pub fn name(&self, kind: &PointKind) -> String {
        let word = |period: &SweepPeriod| period.word.as_deref().and_then(|word| word.parse::<Word>().ok());
        let Some((period, word)) = kind.period.as_ref().and_then(|period| Some((period, word(period)?))) else {
            return match kind.outcome {
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
            // Writing to a String cannot fail.
            let _ = write!(walls, "… ({} impacts)", word.mappings().len());
        }
        let phase = period.first.as_ref().filter(|_| self.by_place).and_then(|first| middle(&first.phase));
        let place = phase.map_or_else(String::new, |phase| format!(", L at {phase:.2} rad"));
        format!("{walls} in {lasting}{place}")
    }
}

impl PointKind {
    /// About the phase and the velocity at which the attractor hits the left wall first, if it does so and that is known.
    pub fn place(&self) -> Option<[f64; 2]> {
        let period = self.period.as_ref()?;
        let word: Word = period.word.as_deref()?.parse().ok()?;
        let first = period.first.as_ref().filter(|_| word.mappings()[0].walls().0 == Wall::Left)?;
        Some([middle(&first.phase)?, middle(&first.velocity)?])
    }
}

/// The middle of a pair of bounds, about.
fn middle(bounds: &ExtendedBounds) -> Option<f64> {
    let [low, high] = ends(bounds)?;
    Some(0.5 * (low + high))
}

/// Whether two pairs of bounds may hold numbers that are equal or differ by `period`.
fn overlap(a: &ExtendedBounds, b: &ExtendedBounds, period: f64) -> bool {
    let Some(([a0, a1], [b0, b1])) = ends(a).zip(ends(b)) else { return false };
    // Bound of the rounding errors of shifting.
    let slack = 4.0 * f64::EPSILON * (a1.abs() + b1.abs() + period);
    [-period, 0.0, period].iter().any(|shift| a0 + shift <= b1 + slack && b0 <= a1 + shift + slack)
}

/// The bounds as doubles, rounded outward.
fn ends(bounds: &ExtendedBounds) -> Option<[f64; 2]> {
    Some([doubles(&bounds[0]).ok()?[0], doubles(&bounds[1]).ok()?[1]])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point that is attracted to a period of two impacts with these bounds of its first phase.
    fn attracted(phase: [&str; 2]) -> SweepRecord {
        let text = format!(
            r#"{{"point": 0, "values": ["1"], "outcome": "attracted", "reason": null, "message": "", "complete": true, "bits": 53, "impacts": 9,
            "wide_from": null, "impacts_per_cycle": null, "exponent": {{"per_impact": null, "per_cycle": null, "reason": null}},
            "period": {{"word": "P1 P2", "impacts": 2, "cycles": 1, "first": {{"index": 7, "wall": "left", "phase": ["{}", "{}"], "velocity": ["-2", "-1.9"]}}}}}}"#,
            phase[0], phase[1]
        );
        serde_json::from_str(&text).unwrap()
    }

    /// Attractors whose bounds are apart are two, however near they are; at a forcing period's end they are next to those at its beginning.
    #[test]
    fn attractors_are_one_where_their_bounds_overlap() {
        let numbers = |by_place: bool, phases: &[[&'static str; 2]]| {
            let mut kinds = Kinds::new(by_place);
            let numbers: Vec<usize> = phases.iter().map(|phase| kinds.add(&attracted(*phase))).collect();
            (numbers, kinds)
        };
        let phases = [["1", "1.00001"], ["1.000009", "1.00002"], ["1.00003", "1.00004"]];
        let (found, kinds) = numbers(true, &phases);
        assert_eq!(found, [0, 0, 1]);
        assert_eq!(kinds.all().iter().map(|kind| kind.points).collect::<Vec<_>>(), [2, 1]);
        assert_eq!(kinds.name(&kinds.all()[0]), "LR in 1 cycle, L at 1.00 rad");
        assert_eq!(numbers(true, &[["6.2831", "6.2832"], ["0", "0.0001"]]).0, [0, 0]);
        let (found, kinds) = numbers(false, &phases);
        assert_eq!((found, kinds.name(&kinds.all()[0])), (vec![0, 0, 0], "LR in 1 cycle".to_owned()));
        assert!(kinds.all()[0].place().is_some_and(|[_, velocity]| (velocity + 1.95).abs() < 1e-12));
    }
}
