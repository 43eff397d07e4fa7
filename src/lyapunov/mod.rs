//! The growth of small disturbances of an orbit: finite-time Lyapunov exponents with proved bounds.
//!
//! Along certified impacts the Jacobians (A.7) are enclosed; the product of `n` of them is the derivative `DP^n` of the
//! orbit's map. Its matrix is never multiplied out: two perpendicular vectors are carried along, each as a direction
//! known to a narrow interval and a length, since a direction on a circle cannot be wrapped and a growing one narrows
//! its own error. Their lengths and the determinant give the norm. Lemmas L1-L3 of `docs/proofs/growth.md#L1`. The limit of the
//! exponents is known for an orbit that is proved to converge to a periodic one: Lemma L4.

mod growth;
mod limit;
mod scaled;

use crate::number::{Ball, Number};
use crate::orbit::{Impact, Orbit, Progress};
pub use growth::Growth;
pub use impact_pair_model::vocabulary::NoExponent;
pub use limit::limit;

/// The greatest growth rate of a small disturbance from an impact on, over the impacts that follow: natural logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exponent {
    /// `ln |DP^n|` divided by the impacts, and by the cycles, that the `n` flights take. Lemma L3
    Finite {
        /// Per impact.
        per_impact: Ball,
        /// Per forcing period.
        per_cycle: Ball,
    },
    /// The ball comes to rest: all disturbances are forgotten, the derivative is 0, the exponent minus infinity.
    Forgets,
    /// Not known, or not defined.
    Unknown(NoExponent),
}

/// The events that a disturbance has passed, as far as its limit depends on them (Lemma L4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Passed {
    /// Flights between impacts, of which the map has a derivative.
    #[default]
    Flights,
    /// A rest with a contact force: the derivative is 0 from then on.
    Rest,
    /// A graze, or a rest or a departure without contact force: there is no derivative, or none that is proved.
    Break,
}

/// A small disturbance of an orbit, followed from one impact to the next.
#[derive(Clone, Debug)]
pub struct Disturbance {
    growth: Growth,
    restitution: Ball,
    /// The last impact; the start when it is on a wall.
    last: Option<Impact>,
    turns: Ball,
    /// The periods of another harmonic in one of the fastest, and its square, where the former are the unit of times.
    rate: Option<[Ball; 2]>,
    /// The growth is not known any more: it will not matter if a rest follows.
    is_lost: bool,
    /// The result that no longer depends on the growth, if any.
    settled: Option<Exponent>,
    passed: Passed,
}

impl Disturbance {
    /// Disturbance of the state at the orbit's start, or, in the gap, at its first impact; before the orbit is advanced.
    pub fn of(orbit: &Orbit) -> Self {
        Self::new(orbit, orbit.start_impact())
    }

    /// Disturbance of the state at an impact.
    pub fn at(orbit: &Orbit, impact: Impact) -> Self {
        Self::new(orbit, Some(impact))
    }

    fn new(orbit: &Orbit, last: Option<Impact>) -> Self {
        let restitution = orbit.restitution();
        let growth = Growth::new(restitution == Ball::exact(0.0));
        Self {
            growth,
            restitution,
            last,
            turns: Ball::exact(0.0),
            rate: None,
            is_lost: false,
            settled: None,
            passed: Passed::Flights,
        }
    }

    /// The growth in periods of another harmonic; `rate` of them are one period of the fastest harmonic. (A.7) then has times in these periods
    /// and velocities in gap widths per such period. To be called before the disturbance is followed.
    #[must_use]
    pub fn in_turns_of(self, rate: Option<Ball>) -> Self {
        Self { rate: rate.map(|rate| [rate, rate * rate]), ..self }
    }

    /// Follows the disturbance over the orbit's next event.
    pub fn follow(&mut self, orbit: &Orbit, event: &Progress) {
        self.note(orbit, event);
        match event {
            _ if self.settled.is_some() => {}
            Progress::Impact(impact) => self.pass(orbit, impact),
            Progress::Graze(_) => self.settled = Some(Exponent::Unknown(NoExponent::Graze)),
            Progress::Rest(rest) => {
                let unpressed = Exponent::Unknown(NoExponent::Unpressed);
                self.settled = Some(if orbit.forgets(rest) { Exponent::Forgets } else { unpressed });
            }
            Progress::Release(_) | Progress::Retraced(_) | Progress::Ended => {}
        }
    }

    /// Notes events that the limit depends on, from the first impact on, whether or not the growth is known.
    fn note(&mut self, orbit: &Orbit, event: &Progress) {
        let is_smooth = self.passed == Passed::Flights && self.last.is_some();
        match event {
            Progress::Rest(rest) if is_smooth && orbit.forgets(rest) => self.passed = Passed::Rest,
            Progress::Graze(_) | Progress::Rest(_) if is_smooth => self.passed = Passed::Break,
            Progress::Impact(_) if is_smooth && !self.leaves(orbit) => self.passed = Passed::Break,
            _ => {}
        }
    }

    /// Whether the flight from the last impact is proved to have a derivative, if there is such an impact. Lemma L3
    fn leaves(&self, orbit: &Orbit) -> bool {
        self.last.as_ref().is_none_or(|last| orbit.leaves(last))
    }

    /// Events that the disturbance has passed.
    pub fn passed(&self) -> Passed {
        self.passed
    }

    fn pass(&mut self, orbit: &Orbit, impact: &Impact) {
        let leaves = self.leaves(orbit);
        let Some(last) = self.last.replace(impact.clone()) else { return };
        let turns = orbit.turns_between(&last, impact);
        self.turns = self.turns + self.rate.map_or(turns, |[rate, _]| turns * rate);
        let jacobian = orbit.jacobian(&last, impact).filter(|_| leaves);
        let Some(jacobian) = jacobian.and_then(|jacobian| self.in_reference(jacobian)) else {
            // It may be a graze as far as is known.
            self.settled = Some(Exponent::Unknown(NoExponent::Width));
            return;
        };
        let square = self.restitution * self.restitution;
        let determinant = (square * last.velocity).checked_div(impact.velocity);
        let is_known = !self.is_lost && determinant.is_some_and(|it| self.growth.multiply(&jacobian, it));
        self.is_lost = !is_known;
    }

    /// (A.7) in the requested units: times are multiplied by `r` and velocities by `1/r`, so `dt/dv` by `r^2` and `dv/dt` by `1/r^2`.
    fn in_reference(&self, jacobian: [[Ball; 2]; 2]) -> Option<[[Ball; 2]; 2]> {
        let Some([_, square]) = self.rate else { return Some(jacobian) };
        let [[tt, tv], [vt, vv]] = jacobian;
        Some([[tt, tv * square], [vt.checked_div(square)?, vv]])
    }

    /// The exponent over the impacts so far. Lemma L3
    pub fn exponent(&self) -> Exponent {
        if let Some(settled) = self.settled {
            return settled;
        }
        let impacts = self.growth.matrices();
        if impacts == 0 && !self.is_lost {
            return Exponent::Unknown(NoExponent::NoImpacts);
        }
        let growth = self.growth.logarithm_of_norm().filter(|_| !self.is_lost);
        let bounds = growth.and_then(|growth| {
            let per_impact = growth.checked_div(Ball::exact(impacts as f64))?; // exact: far fewer than 2^53
            Some(Exponent::Finite { per_impact, per_cycle: growth.checked_div(self.turns)? })
        });
        bounds.unwrap_or(Exponent::Unknown(NoExponent::Width)) // exact: no bounds are none
    }
}

#[cfg(test)]
mod tests;
