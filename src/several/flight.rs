//! A flight under several harmonics: equations (10)-(13) with the sum (1).
//!
//! As in [`crate::flight`], but not mirrored: `z` is the height above the left wall, in gaps, and a flight may start on
//! either. `h` forcing periods after the start, `c = z'(0) + sum beta_k cos th_k0`:
//!
//! ```text
//! z = z0 + c h - sum alpha_k (sin th_k1 - sin th_k0),  z' = c - sum beta_k cos th_k1,  z'' = sum swing_k sin th_k1
//! ```
//!
//! Near a departure from a wall the same without cancellation: each harmonic's versine, excess and sine of its own phase
//! `2 pi (W_k/W) h` add up to `z - z0 = z'(0) h + sum alpha_k (cos th_k0 excess_k + sin th_k0 versine_k)`.

use super::harmonics::{Harmonics, Sums};
use super::phased::FlightNumber;
use crate::flight::Launch;
use crate::pair::Wall;

/// A time since the start of a flight: whole forcing periods and the rest, an exact number.
#[derive(Clone, Debug)]
pub(crate) struct Instant<N> {
    pub turns: i64,
    pub rest: N,
}

/// Forcing periods that one step adds at most: 64 of Newton's stay below `2^60` (Lemma N1).
const LONGEST_STEP: f64 = (1_u64 << 53) as f64;

impl<N: FlightNumber> Instant<N> {
    /// A number of forcing periods after the start, as fine as `like`.
    pub fn new(turns: f64, like: &N) -> Self {
        let whole = turns.round(); // N1: any whole number; the rest is kept
        Self { turns: whole as i64, rest: like.like(turns - whole) } // N1: below 2^52
    }

    /// A time later by about `step`: an exact time.
    pub fn later(&self, step: &N) -> Self {
        let rest = self.rest.later(step);
        // Lemma N1: a time of any length is one; what is not taken for whole forcing periods stays with the rest.
        let whole = rest.bounds().0.round().clamp(-LONGEST_STEP, LONGEST_STEP);
        // N1: nothing to take off
        if whole == 0.0 {
            return Self { turns: self.turns, rest };
        }
        // Exact, up to the rounding that makes it another exact time.
        Self { turns: self.turns + whole as i64, rest: rest.later(&rest.like(-whole)) } // N1: below 2^53 a step
    }

    /// An upper bound of the time from `earlier` to here.
    pub fn since(&self, earlier: &Self) -> f64 {
        let rest = (self.rest.clone() - earlier.rest.clone()).bounds().1;
        ((self.turns - earlier.turns) as f64 + rest).next_up() // N1: exact before the horizon, 2^52
    }

    /// The time as one number.
    pub fn time(&self) -> N {
        match self.turns {
            0 => self.rest.clone(),
            turns => N::from_f64(turns as f64) + self.rest.clone(), // N1: exact up to the horizon; more is refused
        }
    }
}

/// One flight, or all the flights of a set.
#[derive(Clone, Debug)]
pub(crate) struct SumFlight<'h, N: FlightNumber> {
    pub harmonics: &'h Harmonics<N>,
    pub launch: Launch<N>,
    /// Sines and cosines at the start.
    waves: Vec<(N, N)>,
    /// `c`
    pub drift: N,
    /// `z0 + sum alpha_k sin th_k0`: the value of `z + sum alpha_k sin th_k - c h` at all times.
    pub offset: N,
    /// `z''` and `z'''` at the start, over the hull of the set: at a release `z''` of each flight is 0.
    pub acceleration: N,
    pub jerk: N,
}

/// The values of the formulas at a time: distances from both walls, `z'` and `z''`.
#[derive(Clone, Debug)]
pub(crate) struct Kinematics<N> {
    pub left: N,
    pub right: N,
    pub velocity: N,
    pub acceleration: N,
}

/// Longest departure, in forcing periods.
const SHORT_FLIGHT: f64 = 0.124;

impl<'h, N: FlightNumber> SumFlight<'h, N> {
    /// Flight from a start; `waves` are the sines and cosines of the harmonics where they are known better than from the phase.
    pub fn new(harmonics: &'h Harmonics<N>, launch: Launch<N>, waves: Option<&Vec<(N, N)>>) -> Self {
        let zero = N::from_f64(0.0);
        let waves = waves
            .cloned()
            .unwrap_or_else(|| harmonics.waves(launch.turns, &launch.phase).map(|(_, wave)| wave).collect());
        let (mut sine, mut cosine, mut acceleration, mut jerk) = (zero.clone(), zero.clone(), zero.clone(), zero);
        for (term, (sin, cos)) in harmonics.terms.iter().zip(&waves) {
            sine = term.alpha.clone().mul_add(sin.clone(), sine);
            cosine = term.beta.clone().mul_add(cos.clone(), cosine);
            // A term that is exactly 0 adds exactly 0, so that a start at a release is recognised.
            if !sin.is_zero() {
                acceleration = term.acceleration.clone().mul_add(sin.clone(), acceleration);
            }
            let rate = term.acceleration.clone() * term.ratio.clone() * term.ratio.turn();
            jerk = rate.mul_add(cos.clone(), jerk);
        }
        let height = match launch.wall {
            None => launch.height.clone(),
            Some(Wall::Left) => N::from_f64(0.0),
            Some(Wall::Right) => N::from_f64(1.0),
        };
        let (drift, offset) = (launch.velocity.clone() + cosine, height + sine);
        Self { harmonics, waves, drift, offset, acceleration, jerk, launch }
    }

    /// The state at a time after the start.
    #[inline]
    pub fn state(&self, at: &Instant<N>) -> Kinematics<N> {
        if let Some(wall) = self.launch.wall
            && at.turns == 0
            && at.rest.bounds().1 <= SHORT_FLIGHT
            && let Some(state) = self.departure(wall, &at.rest)
        {
            return state;
        }
        let rest = self.launch.phase.clone() + at.rest.clone();
        let Sums { sine, cosine, acceleration } = self.harmonics.sums(self.launch.turns + at.turns, &rest);
        let left = self.drift.clone().mul_add(at.time(), self.offset.clone()) - sine;
        Kinematics { right: N::from_f64(1.0) - left.clone(), left, velocity: self.drift.clone() - cosine, acceleration }
    }

    /// State `time` forcing periods after the departure from a wall, without cancellation.
    fn departure(&self, wall: Wall, time: &N) -> Option<Kinematics<N>> {
        let added = self.harmonics.departure(&self.waves, time)?;
        let moved = self.launch.velocity.clone().mul_add(time.clone(), added.height);
        let (left, right) = match wall {
            Wall::Left => (moved.clone(), N::from_f64(1.0) - moved),
            Wall::Right => (N::from_f64(1.0) + moved.clone(), -moved),
        };
        Some(Kinematics {
            left,
            right,
            velocity: self.launch.velocity.clone() + added.velocity,
            acceleration: self.acceleration.clone() + added.acceleration,
        })
    }
}
