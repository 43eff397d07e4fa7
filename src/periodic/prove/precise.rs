//! The proof of one orbit in more bits than doubles have.

use super::super::chained::Chained;
use super::super::equations::Orbits;
use super::super::krawczyk;
use super::super::newton;
use super::super::orbit::PeriodicOrbit;
use super::super::precondition::Preconditioner;
use super::super::shaking::Shaking;
use super::super::{Precision, Problem};
use super::is_narrow;
use crate::exact::working_bits;
use crate::number::{Enclosing, MpBall};
use crate::shaken::Either;

/// Greatest number of bits for the properties that do not depend on widths: stability and first contacts.
const DECIDING_BITS: u32 = 1024;

impl Problem {
    /// Whether no parameter is an interval: then more precision narrows.
    fn is_point(&self) -> bool {
        match &self.shaken {
            Either::One(one) => one.is_point(),
            Either::Several(_) => self.impact_pair.is_point(),
        }
    }

    /// Proves an orbit in balls of rising precision; `best` is the orbit proved so far.
    pub(super) fn prove_precisely<S: Chained>(
        &self,
        shaken: &S,
        guess: &[f64],
        precision: Precision,
        mut narrow: bool,
        mut best: Option<PeriodicOrbit>,
    ) -> Option<PeriodicOrbit> {
        let inverse = newton::precondition(&self.chain, shaken.floats(), guess)?;
        let working = working_bits(precision.digits);
        let mut last = f64::INFINITY;
        let mut bits = if narrow { 128 } else { working.max(128) }; // proposes
        while bits <= precision.max_bits && (bits <= DECIDING_BITS || (best.is_some() && !narrow)) {
            let shaking = shaken.precise(bits);
            let guess =
                self.polish_precisely(&shaking, &inverse, guess, bits, bits / krawczyk::PRECONDITIONED_GAIN_BITS);
            let finding = self.attempt(&shaking, &inverse, &guess, bits, |phases, legs| {
                shaken.is_physical_precisely(&shaking, &self.chain, phases, legs)
            });
            if let Some(finding) = finding {
                let [phase, _] = finding.widths();
                narrow = is_narrow(shaken, &finding, precision);
                // If more bits do not narrow, still more will not.
                if phase >= last {
                    break;
                }
                last = phase;
                best = finding.finish(&self.chain, self.impact_pair.restitution(), bits, narrow).or(best);
                if narrow && best.as_ref().is_some_and(PeriodicOrbit::is_decided) {
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

    /// Whether a guess, polished in more than doubles, lies where a known orbit is the only one. Only asked where a known orbit near a
    /// bifurcation is not proved in doubles: Newton's iteration in floating point then ends at many points.
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

    /// Guess after `steps` steps in `bits` bits; nothing is proved.
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
