//! A pair whose chains are proved, for any excitation.

mod precise;

use super::chain::Chain;
use super::legs::Legs;
use super::physical;
use super::quarters;
use super::shaking::Shaking;
use crate::contact::Contact;
use crate::flight::Launch;
use crate::number::Ball;
use crate::pair::{Wall, rebound};
pub(super) use crate::shaken::OneHarmonic;
use crate::shaken::{Flying, Parameters};
pub(super) use precise::ChainedPrecisely;

/// Impact of a floating-point motion: wall, phase in forcing periods, velocity before.
pub(super) type FloatImpact = (Wall, f64, f64);

/// The state of the box at a time, in an arithmetic.
pub(super) type Moment<S, N> = <<S as Parameters>::In<N> as Shaking<N>>::Moment;

/// A harmonic as searches see it.
pub(super) struct Rate {
    /// Greatest speed of the harmonic, in gap widths per forcing period.
    pub beta: Ball,
    /// `W_k/W` and the phase at forcing period 0; `None` for the harmonic whose periods are the forcing periods.
    pub own: Option<[Ball; 2]>,
}

/// The operations on a pair that proofs of its chains need.
pub(super) trait Chained: Flying + ChainedPrecisely {
    /// Approximate greatest speed of the box, in gap widths per forcing period.
    fn speed(&self) -> f64 {
        self.pair().beta.mid()
    }

    /// All harmonics, the fastest first.
    fn rates(&self) -> Vec<Rate>;

    /// The impact after an impact of a floating-point motion.
    fn next(&self, (wall, phase, velocity): FloatImpact) -> Option<FloatImpact> {
        let after = rebound(&self.pair().restitution.mid(), velocity);
        // The whole forcing periods are kept apart.
        let (whole, rest) = (phase.floor(), phase - phase.floor()); // proposes
        let contact = self.propose(&Launch::from_wall(wall, whole as i64, rest, after, false)).ok()?; // proposes
        Some((contact.wall, whole + contact.turns + contact.phase, contact.velocity))
    }

    /// Encloses the first contact of all flights that start with an impact `turns` forcing periods after a box of phases, with velocities in a
    /// ball before it. Also `y''` at the start and at the contact; `None` where the contact is not proved.
    fn step(&self, wall: Wall, turns: f64, phase: Ball, before: Ball) -> Option<(Contact<Ball>, [Ball; 2])> {
        // H11: whole, polished phases are below 2^40
        let launch = Launch::from_wall(wall, turns as i64, phase, self.pair().rebound_of(before), false);
        self.first_contact(launch, None).ok()
    }

    /// Whether each flight is proved to end at its first contact; `None` if undecided. Lemma T5
    fn is_physical(&self, chain: &Chain, phases: &[Ball], legs: &Legs<Ball, Moment<Self, Ball>>) -> Option<bool>;

    /// As `is_physical`, for the one orbit in bounds of its phases, if it is proved to be at whole quarters of a forcing period. Lemma T14
    fn is_physical_at_quarters(&self, _: &Chain, _: &[Ball]) -> Option<bool> {
        None
    }
}

impl Chained for OneHarmonic {
    fn rates(&self) -> Vec<Rate> {
        vec![Rate { beta: self.bounds_of_pair.pair.beta, own: None }]
    }

    fn is_physical(&self, chain: &Chain, phases: &[Ball], legs: &Legs<Ball>) -> Option<bool> {
        physical::is_physical(&self.bounds_of_pair, chain, phases, legs)
    }

    fn is_physical_at_quarters(&self, chain: &Chain, phases: &[Ball]) -> Option<bool> {
        physical::is_physical_at(&self.bounds_of_pair, chain, &quarters::of(&self.exact, chain, phases)?)
    }
}
