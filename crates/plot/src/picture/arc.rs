//! The part of a forcing period that a picture shows: phases in a small part of it leave the rest out.

use std::f64::consts::TAU;

use super::Axis;

/// Parts of a forcing period: phases are sorted into eighths to find the part that a picture shows.
const PARTS_PER_PERIOD: usize = 8;

/// An arc of whole eighths of a forcing period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arc {
    from: i32,
    to: i32,
}

impl Arc {
    /// The least arc that holds these ranges of phases, in forcing periods: at least half a forcing period, and a whole forcing period
    /// if less than a quarter would be left out.
    pub fn holding(phases: impl Iterator<Item = [f64; 2]>) -> Self {
        let mut is_met = [false; PARTS_PER_PERIOD];
        for [low, high] in phases {
            let (first, last) = ((low * 8.0).floor() as i64, (high * 8.0).ceil() as i64);
            (first..last.max(first + 1)).for_each(|eighth| is_met[eighth.rem_euclid(8) as usize] = true);
        }
        let blank = |from: usize| (0..PARTS_PER_PERIOD).take_while(|k| !is_met[(from + k) % PARTS_PER_PERIOD]).count();
        let (from, blank) =
            (0..PARTS_PER_PERIOD).map(|from| (from, blank(from))).max_by_key(|found| found.1).unwrap_or((0, 0));
        if blank < 2 || blank == PARTS_PER_PERIOD {
            return Self { from: 0, to: 8 };
        }
        let (from, length) = (((from + blank) % PARTS_PER_PERIOD) as i32, (PARTS_PER_PERIOD - blank) as i32);
        let more = (4 - length).max(0);
        let (from, length) = (from - (more + 1) / 2, length + more);
        let from = if from + length > 8 { from - 8 } else { from };
        Self { from, to: from + length }
    }

    /// The axis of the arc, in radians.
    pub fn axis(self) -> Axis {
        Axis::eighths(self.from, self.to)
    }

    /// The place of a phase, in forcing periods, on the axis of the arc.
    pub fn place(self, phase: f64) -> f64 {
        let from = f64::from(self.from) / 8.0;
        TAU * ((phase - from).rem_euclid(1.0) + from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blank_values_are_left_out() {
        let arc = |phases: &[[f64; 2]]| Arc::holding(phases.iter().copied());
        assert_eq!(arc(&[[0.0, 0.1], [0.65, 0.7], [0.9, 1.02]]), Arc { from: -3, to: 1 });
        assert_eq!(arc(&[[0.3, 0.3], [0.7, 0.7]]), Arc { from: 2, to: 6 });
        assert_eq!(arc(&[[0.25, 0.5]]), Arc { from: 1, to: 5 });
        assert_eq!(arc(&[[0.0, 0.0]]), Arc { from: -2, to: 2 });
        assert_eq!(arc(&[[0.0, 0.9]]), Arc { from: 0, to: 8 });
        assert_eq!(arc(&[]), Arc { from: 0, to: 8 });
        let from = -3.0 * TAU / 8.0;
        assert!((arc(&[[0.65, 1.05]]).place(0.65) - 0.65 * TAU + TAU).abs() < 1e-12);
        assert!(arc(&[[0.65, 1.05]]).place(0.05) > from);
    }
}
