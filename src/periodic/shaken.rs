//! A pair whose chains are proved, whatever shakes its box.

use super::chain::{Chain, Legs};
use super::physical;
use super::shaking::Shaking;
use crate::contact::{Court, Radii, Verdict, first_contact, first_contact_f64};
use crate::exact::Exact;
use crate::flight::Flight;
#[cfg(feature = "multiprecision")]
use crate::number::MpBall;
use crate::number::{Ball, Kernel, Wave, kernel};
use crate::pair::{Reduced, Wall};
use crate::several::Phased;

/// An impact of a floating motion: wall, phase in turns, velocity before.
pub(super) type Passing = (Wall, f64, f64);

/// What an arithmetic knows of the box at a time.
pub(super) type Moment<S, N> = <<S as Shaken>::In<N> as Shaking<N>>::Moment;

/// The first contact of all flights that start in a box, and what the Jacobian (A.7) over it needs.
pub(super) struct Step {
    pub wall: Wall,
    pub time: Ball,
    /// `y'` just before it.
    pub velocity: Ball,
    /// `y''` at the start and at the contact.
    pub swings: [Ball; 2],
}

/// What proofs need of a pair.
pub(super) trait Shaken {
    /// The box in an arithmetic.
    type In<N: Phased>: Shaking<N>;

    /// The centres of the parameters.
    fn floats(&self) -> &Self::In<f64>;
    /// The parameters in doubles.
    fn balls(&self) -> &Self::In<Ball>;
    /// The parameters in so many bits.
    #[cfg(feature = "multiprecision")]
    fn precise(&self, bits: u32) -> Self::In<MpBall>;
    /// The box's greatest speed in gaps a turn, about.
    fn speed(&self) -> f64;
    /// The impact after one of a floating motion.
    fn next(&self, impact: Passing) -> Option<Passing>;
    /// The first contact of all flights that start with an impact in a box of phases, so many whole turns on, and of
    /// velocities before; `None` where it is not proved.
    fn step(&self, wall: Wall, turns: f64, phase: Ball, before: Ball) -> Option<Step>;
    /// Whether each flight is proved to end at its first contact. Lemma T5
    fn is_physical(&self, chain: &Chain, phases: &[Ball], legs: &Legs<Ball, Moment<Self, Ball>>) -> Option<bool>;
    /// The same in balls, where doubles leave it open.
    #[cfg(feature = "multiprecision")]
    fn is_physical_precisely(
        &self,
        shaking: &Self::In<MpBall>,
        chain: &Chain,
        phases: &[MpBall],
        legs: &Legs<MpBall, Moment<Self, MpBall>>,
    ) -> Option<bool>;
}

/// A pair that is shaken by one harmonic.
#[derive(Clone, Debug)]
pub(super) struct One {
    #[cfg_attr(not(feature = "multiprecision"), allow(dead_code))]
    exact: Reduced<Exact>,
    pub court: Court,
}

impl One {
    pub fn new(exact: Reduced<Exact>, pair: Reduced<Ball>) -> Self {
        Self { exact, court: Court::new(pair) }
    }

    /// Whether no parameter is an interval of values.
    #[cfg(feature = "multiprecision")]
    pub fn is_point(&self) -> bool {
        [&self.exact.alpha, &self.exact.restitution].iter().all(|x| x.is_point())
    }
}

impl Shaken for One {
    type In<N: Phased> = Reduced<N>;

    fn floats(&self) -> &Reduced<f64> {
        &self.court.centre
    }

    fn balls(&self) -> &Reduced<Ball> {
        &self.court.pair
    }

    #[cfg(feature = "multiprecision")]
    fn precise(&self, bits: u32) -> Reduced<MpBall> {
        self.exact.map(|x| <MpBall as Phased>::enclose(x, bits))
    }

    fn speed(&self) -> f64 {
        self.court.centre.beta
    }

    fn next(&self, (wall, phase, velocity): Passing) -> Option<Passing> {
        let pair = &self.court.centre;
        let after = wall.inward(pair.rebound(velocity));
        // The whole turns are kept apart: they are not shaken.
        let rest = phase - phase.floor(); // proposes
        let flight = Flight::from_wall(pair, wall, rest, after, kernel::sin_cos(rest));
        let contact = first_contact_f64::<Kernel>(&flight)?;
        Some((contact.wall, phase.floor() + contact.turns + contact.phase, contact.velocity)) // proposes
    }

    fn step(&self, wall: Wall, _: f64, phase: Ball, before: Ball) -> Option<Step> {
        let Court { pair, centre, margins } = &self.court;
        let after = wall.inward(pair.rebound_of(before));
        let flight = Flight::from_wall(centre, wall, phase.mid(), after.mid(), kernel::sin_cos(phase.mid()));
        let radii = Radii { phase: phase.rad(), velocity: after.rad(), height: 0.0 };
        let Verdict::Certified(contact) = first_contact(&flight, margins, radii) else { return None };
        let swings = [phase, contact.phase].map(|phase| pair.swing(&phase.wave()));
        Some(Step { wall: contact.wall, time: contact.time, velocity: contact.velocity, swings })
    }

    fn is_physical(&self, chain: &Chain, phases: &[Ball], legs: &Legs<Ball>) -> Option<bool> {
        physical::is_physical(&self.court, chain, phases, legs)
    }

    #[cfg(feature = "multiprecision")]
    fn is_physical_precisely(
        &self,
        pair: &Reduced<MpBall>,
        chain: &Chain,
        phases: &[MpBall],
        legs: &Legs<MpBall>,
    ) -> Option<bool> {
        physical::is_physical_precisely(&self.court, pair, chain, phases, legs)
    }
}
