//! Widths and errors of any smallness, in the units to which the requested digits refer.

use std::fmt;

use crate::exact::{Dyadic, Enclosure};
use crate::units::{self, Units};
use crate::{Error, Scene};

/// Error bounds of a logarithm, absolute and relative.
///
/// Lemma U1 of `docs/proofs/printing.md#U1` bounds the error of the logarithm. The powers and quotients that decimals are made of are
/// good to `1e-12`, which is less.
const SLACK: (f64, f64) = (1e-9, 1e-14);
/// Bits that sizes are rounded to.
const BITS: u32 = 64;

/// An upper or lower bound of a size >= 0, as its decimal logarithm: sizes may be below the range of doubles.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Size(f64);

impl Size {
    /// The size 0.
    pub const ZERO: Self = Self(f64::NEG_INFINITY);

    /// `10^exponent`
    pub const fn power_of_ten(exponent: i32) -> Self {
        Self(exponent as f64) // exact: an i32
    }

    /// The greater of two sizes.
    pub fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0)) // exact: one of both
    }

    /// `-log10`: as a width, the digits it leaves. Infinite for zero.
    pub fn digits(self) -> f64 {
        -self.0
    }

    /// Three significant digits, rounded up.
    pub fn decimal_up(self) -> String {
        self.decimal(2, f64::ceil) // U1
    }

    /// Three significant digits, rounded down.
    pub fn decimal_down(self) -> String {
        self.decimal(2, f64::floor) // U1
    }

    /// Two significant digits, rounded up: for tables.
    pub fn short(self) -> String {
        self.decimal(1, f64::ceil) // U1
    }

    /// Two significant digits, to nearest: not a bound.
    pub fn rounded(self) -> String {
        self.decimal(1, f64::round) // shown
    }

    fn decimal(self, places: i32, round: fn(f64) -> f64) -> String {
        if self == Self::ZERO {
            return "0".into();
        }
        if self.0 == f64::INFINITY {
            return "inf".into();
        }
        let mut exponent = self.0.floor(); // U1: of the logarithm
        let one = 10f64.powi(places);
        let mut mantissa = round(10f64.powf(self.0 - exponent) * one) / one;
        if mantissa >= 10.0 {
            (mantissa, exponent) = (1.0, exponent + 1.0);
        }
        format!("{mantissa:.*}e{exponent}", places as usize) // exact: 1 or 2
    }
}

/// A positive unit, as bounds of its logarithm.
#[derive(Clone, Copy, Debug)]
pub struct Unit {
    low: f64,
    high: f64,
}

impl Unit {
    /// The unit of the scene itself.
    pub const ONE: Self = Self { low: 0.0, high: 0.0 };

    /// The unit that lies in `x`; `None` if it may be zero.
    fn new(x: &Enclosure) -> Option<Self> {
        let (low, high) = (outward(log10(&x.mig(), -1.0), -1.0), outward(log10(&x.mag(), 1.0), 1.0));
        low.is_finite().then_some(Self { low, high })
    }

    /// Upper bound of `x` in this unit.
    pub fn above(&self, x: &Dyadic) -> Size {
        Size(outward(log10(x, 1.0) - self.low, 1.0))
    }

    /// Lower bound of `x` in this unit.
    pub fn below(&self, x: &Dyadic) -> Size {
        Size(outward(log10(x, -1.0) - self.high, -1.0))
    }
}

/// Units of the widths of times and velocities, both greater than 0.
#[derive(Clone, Copy, Debug)]
pub struct Scales<N> {
    /// The period of the excitation, `2 pi / W` \[time\].
    pub period: N,
    /// `A W`, with several harmonics their sum; where A may be zero gap widths per forcing period, `d W / (2 pi)` \[length/time\].
    pub velocity: N,
    /// Which speed is the unit of velocities.
    pub speed: Speed,
}

/// A speed of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Speed {
    /// Greatest speed of the excitation.
    Excitation,
    /// One gap width per period.
    Gap,
}

impl fmt::Display for Speed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Excitation => "A W",
            Self::Gap => "d W/(2 pi)",
        })
    }
}

impl Scales<Enclosure> {
    /// Encloses the scales of a scene.
    ///
    /// # Errors
    /// If a scale exceeds the range of exact expressions.
    pub fn of(scene: &Scene) -> Result<Self, Error> {
        let (pair, excitation) = (scene.pair(), scene.pair().excitation());
        let period = units::period(excitation.reference())?.enclose(BITS);
        let fastest = excitation.harmonics().iter().try_fold(Enclosure::point(Dyadic::zero()), |sum, harmonic| {
            Ok::<_, Error>(sum.add(&Units::amplitudes(harmonic)?.velocity.enclose(BITS), BITS))
        })?;
        Ok(if fastest.mig().is_zero() {
            Self { period, velocity: Units::gaps(pair)?.velocity.enclose(BITS), speed: Speed::Gap }
        } else {
            Self { period, velocity: fastest, speed: Speed::Excitation }
        })
    }

    /// The scales as units of sizes.
    ///
    /// # Panics
    /// Never: scales are greater than 0.
    pub fn units(&self) -> Scales<Unit> {
        let unit = |scale: &Enclosure| Unit::new(scale).expect("scales are positive");
        Scales { period: unit(&self.period), velocity: unit(&self.velocity), speed: self.speed }
    }
}

/// Approximate decimal logarithm of `x >= 0`, on the given side but for the roundings of doubles.
fn log10(x: &Dyadic, side: f64) -> f64 {
    if x.is_zero() {
        return f64::NEG_INFINITY;
    }
    let x = Enclosure::point(x.clone()).rounded(BITS);
    let x = if side > 0.0 { x.sup() } else { x.inf() };
    let mantissa = Dyadic::new(x.mantissa().clone(), 0).to_f64_up();
    (mantissa.log2() + x.exponent() as f64) * 2f64.log10() // U1
}

/// The logarithm with its slack.
fn outward(log: f64, side: f64) -> f64 {
    if log.is_finite() { log + side * SLACK.1.mul_add(log.abs(), SLACK.0) } else { log }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(x: f64) -> Unit {
        Unit::new(&Enclosure::from_f64_bounds(x, x).unwrap()).unwrap()
    }

    #[test]
    fn sizes_are_rounded_outward() {
        let third = Dyadic::from_f64(1.0 / 3.0).unwrap();
        assert_eq!(unit(1.0).above(&third).decimal_up(), "3.34e-1");
        assert_eq!(unit(1.0).below(&third).decimal_down(), "3.33e-1");
        assert_eq!(unit(2.0).above(&third).short(), "1.7e-1");
        // The slack leads beyond a number that three digits hold.
        let ten = Dyadic::from_f64(10.0).unwrap();
        assert_eq!(unit(1.0).above(&ten).decimal_up(), "1.01e1");
        assert_eq!(unit(1.0).below(&ten).decimal_down(), "9.99e0");
        assert_eq!(Size::power_of_ten(-9).short(), "1.0e-9");
    }

    #[test]
    fn sizes_far_below_doubles_have_digits() {
        let tiny = unit(1.0).above(&Dyadic::power_of_two(-10_000));
        assert_eq!(tiny.decimal_up(), "5.02e-3011");
        assert!((3010.29..3010.3).contains(&tiny.digits()));
        assert!(tiny > Size::ZERO && tiny < Size::power_of_ten(-3000));
        assert_eq!(unit(1.0).above(&Dyadic::zero()).short(), "0");
    }

    #[test]
    fn without_an_amplitude_velocities_are_gaps_per_period() {
        let scene = |amplitude: &str| {
            let text = format!(
                "excitation = {{ amplitude = {amplitude}, frequency = \"2*pi\", phase = 0 }}\n\
                 pair = {{ gap = 4, restitution = 0.5 }}\n\
                 start = {{ time = 0, wall = \"left\", velocity = -1 }}"
            );
            Scales::of(&Scene::parse(&text).unwrap()).unwrap().units()
        };
        let eight = Dyadic::from_f64(8.0).unwrap();
        assert_eq!(scene("0").velocity.above(&eight).short(), "2.1e0");
        assert_eq!(scene("\"1/pi\"").velocity.below(&eight).decimal_down(), "3.99e0");
        assert_eq!(scene("1").period.below(&eight).decimal_down(), "7.99e0");
    }
}
