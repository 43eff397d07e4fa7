//! From claimed times and velocities to states in radians and lengths a radian, as boxes of two deviations.

use super::affine::Affine;
use super::clock::Clock;
use super::data::{Data, Piece};
use super::step::{Landing, Parameters};
use crate::attraction::Bounds;
use impact_pair_exact::Real;
use impact_pair_model::Wall;

/// Radians and their lengths, over a piece of the data.
pub(crate) struct Frame<'w> {
    pub parameters: Parameters<'w>,
    pub clock: Clock,
    /// `2 pi`
    pub turn: Real,
}

impl<'w> Frame<'w> {
    pub fn new(data: &'w Data<'w>, piece: &Piece, bits: u32) -> Self {
        let clock = Clock::at_start(data, &data.state(piece, bits).0, bits);
        Self { parameters: data.parameters(piece, bits), clock, turn: Real::pi(bits) * 2 }
    }

    /// Returns all states of these times and velocities.
    pub fn states(&self, wall: Wall, time: &Bounds, velocity: &Bounds) -> Landing {
        let [phase, velocity] = [
            hull(&time.each_ref().map(|time| self.clock.phase(time))),
            hull(&velocity.each_ref().map(|velocity| self.clock.slowed(&Real::rational(velocity, self.turn.bits())))),
        ];
        self.spanned(wall, phase, velocity)
    }

    /// Returns a box of states in which the deviations are those of phase and velocity.
    pub fn spanned(&self, wall: Wall, phase: Real, velocity: Real) -> Landing {
        let (first, zero) = (self.parameters.columns(), Real::zero(self.turn.bits()));
        let [[phase, off], [velocity, away]] = [phase, velocity].map(|x| {
            let middle = x.middle();
            let off = Real::point((x - &middle).enclosure().mag(), middle.bits());
            [middle, off]
        });
        Landing {
            wall,
            phase: Affine::spanned(phase, first, [off, zero.clone()]),
            velocity: Affine::spanned(velocity, first, [zero, away]),
        }
    }
}

/// All numbers between two.
pub(super) fn hull([lower, upper]: &[Real; 2]) -> Real {
    lower.hull(upper)
}
