//! The proof of one orbit in more bits than doubles have.

use super::super::chain::{Chain, Legs};
use super::super::chained::{Chained, Moment};
use super::super::equations::Orbits;
use super::super::krawczyk;
use super::super::newton;
use super::super::orbit::PeriodicOrbit;
use super::super::physical::{Claim, Found, all_first};
use super::super::precondition::Preconditioner;
use super::super::several::is_first;
use super::super::shaking::Shaking;
use super::super::{Precision, Problem};
use super::is_narrow;
use crate::contact::PairBounds;
use crate::contact::multiprecision::{Start, isolate_first};
use crate::exact::working_bits;
use crate::flight::Flight;
use crate::number::{Ball, Enclosing, MpBall};
use crate::pair::{Inward, Reduced};
use crate::shaken::{Either, Flying, OneHarmonic, SeveralHarmonics, Sum};

/// Bits that what is not about widths (stability, first contacts) is tried with at most.
const DECIDING_BITS: u32 = 1024;

/// What proofs of chains need of a pair in balls of any precision.
pub(in super::super) trait ChainedPrecisely: Flying {
    /// Whether each flight is proved to end at its first contact, where doubles leave it open. Lemma T5
    fn is_physical_precisely(
        &self,
        shaking: &Self::In<MpBall>,
        chain: &Chain,
        phases: &[MpBall],
        legs: &Legs<MpBall, Moment<Self, MpBall>>,
    ) -> Option<bool>;
}

impl ChainedPrecisely for OneHarmonic {
    fn is_physical_precisely(
        &self,
        pair: &Reduced<MpBall>,
        chain: &Chain,
        phases: &[MpBall],
        legs: &Legs<MpBall>,
    ) -> Option<bool> {
        all_first(chain, phases, &legs.legs, |claim| is_first_in_balls(&self.bounds_of_pair, pair, claim))
    }
}

impl ChainedPrecisely for SeveralHarmonics {
    fn is_physical_precisely(
        &self,
        sum: &Sum<MpBall>,
        chain: &Chain,
        phases: &[MpBall],
        legs: &Legs<MpBall, Moment<Self, MpBall>>,
    ) -> Option<bool> {
        all_first(chain, phases, &legs.legs, |claim| {
            is_first(self, sum, claim, -(sum.restitution.clone() * claim.before.clone()))
        })
    }
}

/// Whether the first contact of a flight is its end. Lemma T5
fn is_first_in_balls(bounds_of_pair: &PairBounds, pair: &Reduced<MpBall>, claim: &Claim<MpBall>) -> Option<bool> {
    if !claim.arrives()? {
        return Some(false);
    }
    let after = claim.from.inward(pair.rebound(claim.before.clone()));
    if claim.sticks(&after) {
        return Some(false);
    }
    let flight = |phase: MpBall, after: MpBall| {
        let sin_cos = phase.sin_cos();
        Flight::from_wall(pair, claim.from, phase, after, sin_cos)
    };
    let all = flight(claim.start.clone(), after.clone());
    let centre = flight(claim.start.centre(), after.centre());
    let start = Start {
        wall: Some(claim.from),
        height: Ball::exact(0.0),
        phase: claim.start.to_ball(),
        velocity: after.to_ball(),
    };
    let isolated = isolate_first(bounds_of_pair, &start, || all, &centre).ok()?;
    let wall = isolated.target.wall(claim.from);
    let phase = MpBall::new(isolated.at.clone(), isolated.reach).rounded(claim.start.bits());
    claim.is_at(pair, Found { wall, turns: isolated.turns, phase })
}

impl Problem {
    /// No interval among the parameters: more precision narrows.
    fn is_point(&self) -> bool {
        match &self.shaken {
            Either::One(one) => one.is_point(),
            Either::Several(_) => self.impact_pair.is_point(),
        }
    }

    /// The same in balls of rising precision; what is known already is `best`.
    pub(super) fn prove_precisely<S: Chained>(
        &self,
        shaken: &S,
        guess: &[f64],
        precision: Precision,
        mut narrow: bool,
        mut best: Option<PeriodicOrbit>,
    ) -> Option<PeriodicOrbit> {
        let inverse = newton::precondition(&self.chain, shaken.floats(), guess)?;
        let wanted = working_bits(precision.digits);
        let mut last = f64::INFINITY;
        let mut bits = if narrow { 128 } else { wanted.max(128) }; // proposes
        while bits <= precision.max_bits && (bits <= DECIDING_BITS || (best.is_some() && !narrow)) {
            let shaking = shaken.precise(bits);
            let guess = self.polish_precisely(&shaking, &inverse, guess, bits, bits / krawczyk::GAINED);
            let finding = self.attempt(&shaking, &inverse, &guess, bits, |phases, legs| {
                shaken.is_physical_precisely(&shaking, &self.chain, phases, legs)
            });
            if let Some(finding) = finding {
                let [phase, _] = finding.widths();
                narrow = is_narrow(shaken, &finding, precision);
                // Where more bits do not narrow, still more will not.
                if phase >= last {
                    break;
                }
                last = phase;
                best = finding.finish(&self.chain, self.impact_pair.restitution(), bits, narrow).or(best);
                if narrow && best.as_ref().is_some_and(PeriodicOrbit::is_settled) {
                    break;
                }
            }
            // No precision narrows what intervals among the parameters leave open.
            if !self.is_point() {
                break;
            }
            bits *= 2;
        }
        best
    }

    /// Whether a guess, polished in more than doubles, lies where a known orbit is the only one: asked where an orbit is known
    /// that doubles did not prove, near a bifurcation, to which Newton's iteration in floating point comes no nearer than to many points.
    pub(in super::super) fn settles_on_known<S: Chained>(
        &self,
        shaken: &S,
        guess: &[f64],
        known: &[PeriodicOrbit],
    ) -> bool {
        const BITS: u32 = 128;
        let is_precise = known.iter().any(|orbit| orbit.bits > f64::MANTISSA_DIGITS);
        let settled = || {
            let guess = self.polished(guess)?;
            let inverse = newton::precondition(&self.chain, shaken.floats(), &guess)?;
            // Near a bifurcation a step adds a few bits.
            let settled = self.polish_precisely(&shaken.precise(BITS), &inverse, &guess, BITS, BITS / 8);
            Some(settled.iter().map(|x| x.as_ball().mid()).collect::<Vec<f64>>())
        };
        is_precise && settled().is_some_and(|guess| self.is_known(&guess, known))
    }

    /// A guess in N bits after some steps; nothing is proved.
    fn polish_precisely<B: Shaking<MpBall>>(
        &self,
        shaking: &B,
        inverse: &Preconditioner,
        guess: &[f64],
        bits: u32,
        steps: u32,
    ) -> Vec<MpBall> {
        let guess = guess.iter().map(|&x| MpBall::from_f64_bits(x, bits)).collect();
        krawczyk::polish(&Orbits { chain: &self.chain, shaking }, inverse, guess, steps)
    }
}
