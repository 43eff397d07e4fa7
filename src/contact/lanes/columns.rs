//! Structs of arrays: a column for each field, all of doubles, so that vectors of one width run through them.

use super::LANES;
use crate::contact::bounds::Radii;
use crate::contact::certify::{Arrival, Bracket};
use crate::contact::extrema::{Extrema, Target};
use crate::contact::solve::{Iterate, Search};
use crate::flight::Flight;
use crate::number::Ball;
use crate::number::kernel::SmallAngle;
use crate::pair::Wall;

/// A value in a lane, stored as a double, so that all vectors have one width.
pub(super) trait LaneValue {
    fn held(self) -> f64;
    fn of(held: f64) -> Self;
}

impl LaneValue for f64 {
    #[inline(always)]
    fn held(self) -> f64 {
        self
    }
    #[inline(always)]
    fn of(held: f64) -> Self {
        held
    }
}

/// One of two.
macro_rules! held {
    ($type:ty: $one:expr, $zero:expr) => {
        impl LaneValue for $type {
            #[inline(always)]
            fn held(self) -> f64 {
                if self == $one { 1.0 } else { 0.0 }
            }
            #[inline(always)]
            fn of(held: f64) -> Self {
                // exact: 1 or 0
                if held == 1.0 { $one } else { $zero }
            }
        }
    };
}

held!(bool: true, false);
held!(Wall: Self::Right, Self::Left);
held!(Target: Self::Far, Self::Near);

/// A struct of arrays whose lanes are values of a type.
macro_rules! lanes {
    ($name:ident: $type:ty = $constructor:ident { $($field:ident),* }) => {
        #[derive(Clone, Copy)]
        pub(super) struct $name { $(pub $field: [f64; LANES]),* }

        impl $name {
            pub const EMPTY: Self = Self { $($field: [0.0; LANES]),* };

            #[inline(always)]
            pub fn get(&self, lane: usize) -> $type {
                $constructor { $($field: LaneValue::of(self.$field[lane])),* }
            }

            #[inline(always)]
            pub fn set(&mut self, lane: usize, value: $type) {
                let $constructor { $($field),* } = value;
                $(self.$field[lane] = $field.held();)*
            }
        }
    };
}

lanes!(Flights: Flight<f64> = Flight { alpha, beta, phase, sin, cos, height, velocity, drift, wall });
lanes!(Spreads: Radii = Radii { phase, velocity, height });
lanes!(Searches: Search = Search { target, turns, at, low, high });
lanes!(Iterates: Iterate = Iterate { target, turns, at, residual, velocity, sin, cos, step });
lanes!(Turnings: Extrema = Extrema { p, sine, rising, first_max, first_min, max, min });
lanes!(Departures: SmallAngle = SmallAngle { versine, excess, sine });
lanes!(Balls: Parts = Parts { mid, rad });
lanes!(States: State = State { k, time, is_hop, is_near, is_decided });

/// A ball.
pub(super) struct Parts {
    pub mid: f64,
    pub rad: f64,
}

impl Balls {
    #[inline(always)]
    pub fn ball(&self, lane: usize) -> Ball {
        let Parts { mid, rad } = self.get(lane);
        Ball::new(mid, rad)
    }

    #[inline(always)]
    pub fn put(&mut self, lane: usize, ball: Ball) {
        self.set(lane, Parts { mid: ball.mid(), rad: ball.rad() });
    }
}

/// The progress of the solution of a flight.
#[derive(Clone, Copy)]
pub(super) struct State {
    /// The number of the extremum that ends the piece.
    pub k: f64,
    /// The time of the next look, for a flight that is near.
    pub time: f64,
    /// True if it may be a hop.
    pub is_hop: bool,
    /// The departure root is divided out: a hop, or a short flight.
    pub is_near: bool,
    /// Nothing is in the way of a proof so far.
    pub is_decided: bool,
}

/// Brackets of contacts; target and whole forcing periods are those of the search.
#[derive(Clone, Copy)]
pub(super) struct Brackets {
    phase: Balls,
    time: Balls,
    velocity: Balls,
    sin: Balls,
    rest: [f64; LANES],
}

impl Brackets {
    pub const EMPTY: Self =
        Self { phase: Balls::EMPTY, time: Balls::EMPTY, velocity: Balls::EMPTY, sin: Balls::EMPTY, rest: [0.0; LANES] };

    #[inline(always)]
    pub fn get(&self, lane: usize, Search { target, turns, .. }: Search) -> Bracket {
        let arrival = Arrival { target, turns, phase: self.phase.ball(lane), time: self.time.ball(lane) };
        Bracket { arrival, velocity: self.velocity.ball(lane), sin: self.sin.ball(lane), rest: self.rest[lane] }
    }

    #[inline(always)]
    pub fn set(&mut self, lane: usize, Bracket { arrival, velocity, sin, rest }: Bracket) {
        self.phase.put(lane, arrival.phase);
        self.time.put(lane, arrival.time);
        self.velocity.put(lane, velocity);
        self.sin.put(lane, sin);
        self.rest[lane] = rest;
    }
}
