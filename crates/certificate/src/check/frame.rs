//! From claimed times and velocities to states in radians and lengths per radian, as boxes of two deviations.

use super::affine::Affine;
use super::clock::Clock;
use super::data::{Data, Piece};
use super::step::{Landing, Parameters};
use crate::Claim;
use crate::attraction::Bounds;
use impact_pair_exact::Real;
use impact_pair_model::{EventKind, Wall};

/// The claims about an impact.
pub(crate) struct ClaimedImpact<'c> {
    /// The position of the impact among the events.
    pub event: usize,
    /// The number of the impact, from 1.
    pub index: u64,
    pub wall: Wall,
    pub time: &'c Bounds,
    pub velocity: &'c Bounds,
}

impl<'c> ClaimedImpact<'c> {
    /// The claim about an impact; `None` for another event.
    pub fn of((event, claim): (usize, &'c Claim)) -> Option<Self> {
        let EventKind::Impact { index, velocity, .. } = &claim.kind else { return None };
        Some(Self { event, index: *index, wall: claim.wall, time: &claim.time, velocity })
    }
}

/// Data and clock of one piece of the data, in radians and lengths.
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

    /// Encloses the phases of all times and velocities between the claimed bounds.
    pub fn hulls(&self, [time, velocity]: [&Bounds; 2]) -> [Real; 2] {
        let slowed = |velocity| self.clock.slowed(&Real::rational(velocity, self.turn.bits()));
        [hull(&time.each_ref().map(|time| self.clock.phase(time))), hull(&velocity.each_ref().map(slowed))]
    }

    /// All states before a claimed impact.
    pub fn states(&self, hit: &ClaimedImpact<'_>) -> Landing {
        self.spanned(hit.wall, self.hulls([hit.time, hit.velocity]))
    }

    /// Box of states; its two deviations are along phase and velocity.
    pub fn spanned(&self, wall: Wall, [phase, velocity]: [Real; 2]) -> Landing {
        let (first, zero) = (self.parameters.columns(), Real::zero(self.turn.bits()));
        let [[phase, off], [velocity, away]] = [phase, velocity].map(|x| {
            let middle = x.middle();
            let off = Real::point((x - &middle).enclosure().mag(), middle.bits());
            [middle, off]
        });
        let phase = Affine::spanned(phase, first, [off, zero.clone()]);
        Landing::new(wall, phase, Affine::spanned(velocity, first, [zero, away]))
    }
}

/// All numbers between two numbers.
pub(super) fn hull([lower, upper]: &[Real; 2]) -> Real {
    lower.hull(upper)
}
