//! Flights under several harmonics in balls of any precision.

use super::harmonics::{Harmonics, Partial};
use super::phased::{FlightNumber, PhaseNumber, middle};
use crate::exact::Exact;
use crate::number::{Float, MpBall, Number};

/// Bits that a count of forcing periods can take: phases are computed with as many bits more.
const PERIOD_COUNT_BITS: u32 = 64;

impl PhaseNumber for MpBall {
    type Counter = (MpBall, MpBall);

    fn phase_at((ratio, shift): &(MpBall, MpBall), turns: i64) -> MpBall {
        let turns = MpBall::exact(Float::whole(turns));
        let phase = turns.mul_add(ratio.clone(), shift.clone());
        let whole = MpBall::exact(phase.mid().round()); // H1: any whole number of forcing periods
        let bits = phase.bits() - PERIOD_COUNT_BITS;
        (phase - whole).rounded(bits)
    }
    fn middle(&self) -> f64 {
        middle(self)
    }
}

impl FlightNumber for MpBall {
    fn counter(ratio: &Exact, shift: &Exact, bits: u32) -> (MpBall, MpBall) {
        let wide = |x: &Exact| enclosing(x, bits + PERIOD_COUNT_BITS);
        (wide(ratio), wide(shift))
    }
    fn enclose(x: &Exact, bits: u32) -> MpBall {
        enclosing(x, bits)
    }
    fn bounds(&self) -> (f64, f64) {
        self.to_ball().bounds()
    }
    fn centre_of(&self) -> MpBall {
        MpBall::exact(self.mid().clone())
    }
    fn later(&self, step: &MpBall) -> MpBall {
        let bits = self.bits().max(step.bits()); // exact: any time; it is an exact number
        MpBall::exact(self.mid().plus(step.mid(), bits))
    }
    fn ratio_to(&self, divisor: &MpBall) -> Option<MpBall> {
        let bits = self.bits().max(divisor.bits()); // exact: any number; it is an exact one
        let ratio = self.mid().over(divisor.mid(), bits);
        ratio.is_number().then(|| MpBall::exact(ratio))
    }
    fn root_of(&self) -> MpBall {
        MpBall::exact(self.mid().sqrt(self.bits()))
    }
    fn like(&self, x: f64) -> MpBall {
        MpBall::from_f64_bits(x, self.bits())
    }
    fn pieces(&self) -> u32 {
        ((1 << 22) / self.bits()).max(1 << 9) // proposes: about a second
    }
}

fn enclosing(x: &Exact, bits: u32) -> MpBall {
    MpBall::enclosing(&x.enclose(bits + 8), bits)
}

impl Harmonics<MpBall> {
    /// Harmonics with centres rounded to `bits` bits.
    pub fn rounded(&self, bits: u32) -> Self {
        let term = |term: &Partial<MpBall>| {
            let (ratio, shift) = &term.counter;
            Partial {
                alpha: term.alpha.rounded(bits),
                beta: term.beta.rounded(bits),
                acceleration: term.acceleration.rounded(bits),
                ratio: term.ratio.rounded(bits),
                counter: (ratio.rounded(bits + PERIOD_COUNT_BITS), shift.rounded(bits + PERIOD_COUNT_BITS)),
            }
        };
        Self { terms: self.terms.iter().map(term).collect(), rates: self.rates }
    }
}
