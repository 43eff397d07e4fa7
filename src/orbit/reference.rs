//! The cycles of one term of the excitation as the unit of several orbits, such as those of a sweep.
//!
//! An orbit is given in periods of the fastest harmonic that moves the box. Over the amplitude of a term from 0, or over a frequency, this is not
//! the same term at all points. `W`, `tau` belong to the point's own fastest harmonic, `W'`, `tau'` to the sweep's reference, and `r = W'/W`.
//! Then `u = (W t + tau)/(2 pi)` becomes `u' = (W' t + tau')/(2 pi) = r (u - tau/(2 pi)) + tau'/(2 pi)`. Times in forcing periods are multiplied
//! by `r`, velocities in gap widths per forcing period by `1/r`.

use num_rational::BigRational;
use num_traits::ToPrimitive;

use crate::Error;
use crate::exact::{Enclosure, Exact};
use crate::number::Ball;
use crate::orbit::{Impact, Orbit};
use crate::pair::{ImpactPair, ball, within};
use crate::units::{self, Phases, in_radians};

/// Bits of a time that is shown.
const BITS: u32 = 160;
const KEY: &str = "excitation.frequency";

/// The length of a period.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lasting {
    /// Length in cycles of the reference, if it is a whole number of them.
    pub cycles: Option<u64>,
    /// Length \[time\], if it is not.
    pub time: Option<Enclosure>,
}

/// The unit of phases and cycles of an orbit: the cycles of one term of the excitation, whichever term is the fastest.
#[derive(Clone, Debug)]
pub struct Reference {
    /// `2 pi/W` of the point's own fastest harmonic.
    period: Exact,
    /// `None` where the point's own fastest harmonic is the reference.
    other: Option<Other>,
}

/// Another harmonic as the reference.
#[derive(Clone, Debug)]
struct Other {
    /// `r`
    rate: Exact,
    /// `r`, where it is proved to be a fraction.
    fraction: Option<BigRational>,
    ball: Ball,
    /// `tau/(2 pi)` and `tau'/(2 pi)`
    delays: [Exact; 2],
    /// Number of own forcing periods after which the whole excitation recurs; `None` where it never does.
    common: Option<u32>,
}

impl Reference {
    /// The unit of a pair that the term with this number gives, from 0; for `None` its own fastest harmonic.
    ///
    /// # Errors
    /// If the ratio of two frequencies is too large for a flight.
    pub fn of(pair: &ImpactPair, reference: Option<usize>) -> Result<Self, Error> {
        let excitation = pair.excitation();
        let own = excitation.reference();
        let period = units::period(own)?;
        let term = reference.filter(|term| *term != excitation.reference_term());
        let Some(term) = term.and_then(|term| excitation.terms().get(term)) else {
            return Ok(Self { period, other: None });
        };
        let fraction = term.frequency().fraction_of(own.frequency());
        let rate = match &fraction {
            Some(fraction) => Exact::from_rational(fraction.clone()),
            None => within(KEY, term.frequency(), term.frequency().checked_div(own.frequency()))?,
        };
        let delays = [Phases::of(own)?.shift, Phases::of(term)?.shift];
        let fractions = excitation.harmonics().iter().map(|other| other.frequency().fraction_of(own.frequency()));
        let common = fractions
            .map(|fraction| Some(fraction?.denom().clone()))
            .try_fold(1.into(), |common, turns| Some(num_integer::Integer::lcm(&common, &turns?)));
        let common = common.and_then(|common: num_bigint::BigInt| common.to_u32());
        Ok(Self { period, other: Some(Other { ball: ball(KEY, &rate)?, rate, fraction, delays, common }) })
    }

    /// `r`, where it is not 1.
    pub fn rate(&self) -> Option<Ball> {
        self.other.as_ref().map(|other| other.ball)
    }

    /// Phase `W' t + tau'` of an impact \[rad\], its lower bound in `[0, 2 pi)`.
    pub fn phase(&self, orbit: &Orbit, impact: &Impact) -> Enclosure {
        match &self.other {
            None => orbit.phase(impact),
            Some(other) => in_radians(&other.turns(&orbit.turns_of(impact), orbit.shown_bits()), orbit.shown_bits()),
        }
    }

    /// Phase `W' t + tau'` of an impact that recurs after whole common periods of the excitation, given its own phase modulo that period. `None`
    /// where the phase differs each time.
    pub fn recurring(&self, turns: &Enclosure, bits: u32) -> Option<Enclosure> {
        let Some(other) = &self.other else { return Some(in_radians(turns, bits)) };
        let passed = other.fraction.as_ref()? * BigRational::from_integer(other.common?.into());
        passed.is_integer().then(|| in_radians(&other.turns(turns, bits), bits))
    }

    /// Duration of `cycles` own cycles.
    pub fn lasting(&self, cycles: u64) -> Lasting {
        let Some(other) = &self.other else { return Lasting { cycles: Some(cycles), time: None } };
        let passed = other.fraction.as_ref().map(|fraction| fraction * BigRational::from_integer(cycles.into()));
        let whole = passed.filter(BigRational::is_integer).and_then(|passed| passed.to_integer().to_u64());
        let time = || self.period.enclose(BITS).mul(&Exact::from(num_bigint::BigInt::from(cycles)).enclose(BITS), BITS);
        Lasting { cycles: whole, time: whole.is_none().then(time) }
    }
}

impl Other {
    /// `u'` of `u`.
    fn turns(&self, turns: &Enclosure, shown: u32) -> Enclosure {
        // Bits beyond those of the whole forcing periods.
        let whole = turns.mag().top().and_then(|top| u32::try_from(top).ok()).unwrap_or(0); // X1: any number of bits encloses
        let bits = shown.saturating_add(BITS).saturating_add(whole); // X1
        let [own, reference] = self.delays.each_ref().map(|delay| delay.enclose(bits));
        turns.sub(&own, bits).mul(&self.rate.enclose(bits), bits).add(&reference, bits)
    }
}
