//! A floating-point orbit's points in the order of their phases, so that few are looked at where few are near.
//!
//! Labels: proposes throughout.

use std::f64::consts::TAU;

use super::quad::State;
use super::seen::AttractorOrbit;
use super::vector::apart;

/// An orbit with its points by phase.
pub(super) struct Indexed<'s> {
    pub seen: &'s AttractorOrbit,
    /// Phase and number of each point, by phase.
    order: Vec<(f64, usize)>,
}

impl<'s> Indexed<'s> {
    pub fn new(seen: &'s AttractorOrbit) -> Self {
        let mut order: Vec<(f64, usize)> = seen.points.iter().enumerate().map(|(k, (at, _))| (at[0], k)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { seen, order }
    }

    /// Numbers of the points whose phases, modulo 1, differ from this one by at most `reach`.
    pub fn within(&self, phase: f64, reach: f64) -> impl Iterator<Item = usize> {
        let phase = phase.rem_euclid(1.0);
        let reach = reach.min(0.5);
        [-1.0, 0.0, 1.0].into_iter().flat_map(move |turn| {
            let first = self.order.partition_point(|(at, _)| *at < phase + turn - reach);
            let count = self.order[first..].partition_point(|(at, _)| *at <= phase + turn + reach);
            self.order[first..first + count].iter().map(|(_, number)| *number)
        })
    }

    /// Point that is nearest to a state, with its expanding direction; `None` of an orbit without points.
    pub fn nearest(&self, at: State) -> Option<(State, State)> {
        let mut reach = 1.0 / 256.0;
        loop {
            let near = self.within(at[0], reach).map(|k| self.seen.points[k]);
            let found = near.min_by(|a, b| apart(a.0, at).total_cmp(&apart(b.0, at)));
            // Points that are not within reach are at least this far away.
            if reach >= 0.5 || found.is_some_and(|found| apart(found.0, at) <= TAU * reach) {
                return found;
            }
            reach *= 2.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points all over the circle, from a generator of small numbers.
    fn seen() -> AttractorOrbit {
        let point = |k: u64| {
            let [a, b] = [7919, 104_729].map(|prime| (k * prime % 1000) as f64 / 1000.0);
            ([a, 2.0 * b], [1.0, 0.0])
        };
        AttractorOrbit { points: (0..500).map(point).collect(), exponent: 0.5 }
    }

    #[test]
    fn the_nearest_point_is_that_of_all() {
        let seen = seen();
        let indexed = Indexed::new(&seen);
        for k in 0..200 {
            let at = [f64::from(k % 40) / 20.0 - 0.5, f64::from(k % 7) / 3.0];
            let least = seen.points.iter().map(|point| apart(point.0, at)).fold(f64::INFINITY, f64::min);
            assert_eq!(apart(indexed.nearest(at).expect("points").0, at), least, "{at:?}");
        }
        assert!(Indexed::new(&AttractorOrbit { points: Vec::new(), exponent: 0.0 }).nearest([0.0, 0.0]).is_none());
    }

    #[test]
    fn points_within_reach_are_counted_once() {
        let seen = seen();
        let indexed = Indexed::new(&seen);
        for (phase, reach) in [(0.0, 0.1), (0.95, 0.1), (1.3, 0.2), (0.5, 0.45), (-0.2, 3.0)] {
            let is_near = |&k: &usize| {
                let away: f64 = seen.points[k].0[0] - phase;
                (away - away.round()).abs() <= reach
            };
            let mut found: Vec<usize> = indexed.within(phase, reach).collect();
            found.sort_unstable();
            found.dedup();
            assert_eq!(found, (0..500).filter(is_near).collect::<Vec<_>>(), "{phase} {reach}");
        }
    }
}
