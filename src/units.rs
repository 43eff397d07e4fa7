//! The units of lengths, velocities and phases, and the exact factors between them.
//!
//! | | lengths in | velocities in | times in |
//! |---|---|---|---|
//! | a scene | its own unit | its own unit | its own unit |
//! | flights | gaps, `d` | gap widths per forcing period, `W d/(2 pi)` | forcing periods, `2 pi/W` |
//! | the reduced impact map | amplitudes, `A` | the greatest speed of the box, `A W` | forcing periods |
//!
//! Each factor stands here once, exactly; what computes in another arithmetic encloses it.

use impact_pair_model::{Harmonic, ImpactPair, within};

use crate::Error;
use crate::exact::{Enclosure, Exact, ExactError};

/// Quotient that errors name.
pub(crate) const RATIO: &str = "pair.gap / excitation.amplitude";
const FREQUENCY: &str = "excitation.frequency";

/// The units of lengths \[length\] and of velocities \[length/time\] that dimensionless ones are multiplied by.
#[derive(Clone, Debug)]
pub struct Units<N> {
    /// `d` or `A`
    pub length: N,
    /// `W d/(2 pi)` or `A W`
    pub velocity: N,
}

impl Units<Exact> {
    /// Gap widths, and gap widths per forcing period.
    ///
    /// # Errors
    /// If `W d` exceeds the range of exact expressions.
    pub fn gaps(pair: &ImpactPair) -> Result<Self, Error> {
        let rate = Phases::of(pair.excitation().reference())?.rate;
        let velocity = within("pair.gap", pair.gap(), rate.checked_mul(pair.gap()))?;
        Ok(Self { length: pair.gap().clone(), velocity })
    }

    /// Amplitude of a harmonic, and its greatest speed.
    ///
    /// # Errors
    /// If `A W` exceeds the range of exact expressions.
    pub fn amplitudes(harmonic: &Harmonic) -> Result<Self, Error> {
        let (amplitude, frequency) = (harmonic.amplitude(), harmonic.frequency());
        let velocity = within(FREQUENCY, frequency, amplitude.checked_mul(frequency))?;
        Ok(Self { length: amplitude.clone(), velocity })
    }

    /// Encloses a velocity \[length/time\] that is given in these units, in `bits` bits and more.
    pub fn velocity(&self, velocity: &Enclosure, bits: u32) -> Enclosure {
        velocity.mul(&self.velocity.enclose(bits + 64), bits + 64)
    }
}

impl<N> Units<N> {
    /// The units in another arithmetic.
    pub fn map<M>(&self, f: impl Fn(&N) -> M) -> Units<M> {
        Units { length: f(&self.length), velocity: f(&self.velocity) }
    }
}

/// The phase of a harmonic in forcing periods: `(W t + tau)/(2 pi)`, a rate times the time and a shift.
#[derive(Clone, Debug)]
pub(crate) struct Phases {
    /// `W/(2 pi)`
    pub rate: Exact,
    /// `tau/(2 pi)`
    pub shift: Exact,
}

impl Phases {
    /// # Errors
    /// If a factor exceeds the range of exact expressions.
    pub fn of(harmonic: &Harmonic) -> Result<Self, Error> {
        let (frequency, phase) = (harmonic.frequency(), harmonic.phase());
        let shift = within("excitation.phase", phase, phase.checked_div(&turn()))?;
        Ok(Self { rate: within(FREQUENCY, frequency, frequency.checked_div(&turn()))?, shift })
    }

    /// Phase at a time.
    pub fn at(&self, time: &Exact) -> Result<Exact, ExactError> {
        self.rate.checked_mul(time)?.checked_add(&self.shift)
    }
}

/// Forcing period `2 pi/W` \[time\] of a harmonic.
pub(crate) fn period(harmonic: &Harmonic) -> Result<Exact, Error> {
    within(FREQUENCY, harmonic.frequency(), turn().checked_div(harmonic.frequency()))
}

/// `d/A`: the gap in amplitudes of the harmonic, the first where there are several.
pub(crate) fn ratio(pair: &ImpactPair) -> Result<Exact, Error> {
    within(RATIO, pair.gap(), pair.gap().checked_div(pair.excitation().reference().amplitude()))
}

/// A length in gap widths; the key names the length in errors.
pub(crate) fn in_gaps(key: &'static str, length: &Exact, pair: &ImpactPair) -> Result<Exact, Error> {
    within(key, length, length.checked_div(pair.gap()))
}

/// `2 pi`
pub(crate) fn turn() -> Exact {
    Exact::pi() * Exact::from(2)
}

/// Sine and cosine of a phase that is given in periods.
pub(crate) fn wave(phase: &Exact) -> Result<(Exact, Exact), ExactError> {
    let angle = phase.checked_mul(&turn())?;
    Ok((angle.checked_sin()?, angle.checked_cos()?))
}

/// A phase \[rad\] that is given in forcing periods, its lower bound in `[0, 2 pi)`.
pub fn in_radians(turns: &Enclosure, bits: u32) -> Enclosure {
    let bits = bits + 64;
    let whole = Enclosure::from_rational(&turns.inf().to_rational().floor(), bits); // exact: any whole number of forcing periods
    let two_pi = Enclosure::pi(bits).add(&Enclosure::pi(bits), bits);
    turns.sub(&whole, bits).mul(&two_pi, bits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    /// A = 2, W = 3 pi, tau = pi/2, d = 5: by hand.
    #[test]
    fn the_factors_between_the_units() {
        let scene = Scene::parse(
            "excitation = { amplitude = 2, frequency = \"3*pi\", phase = \"pi/2\" }\n\
             pair = { gap = 5, restitution = 0.5 }\nstart = { time = 0, wall = \"left\", velocity = -1 }",
        )
        .unwrap();
        let (pair, exact) = (scene.pair(), |text: &str| text.parse::<Exact>().unwrap().as_rational().cloned());
        let harmonic = pair.excitation().reference();
        let gaps = Units::gaps(pair).unwrap().map(|x| x.as_rational().cloned());
        assert_eq!((gaps.length, gaps.velocity), (exact("5"), exact("15/2")));
        let amplitudes = Units::amplitudes(harmonic).unwrap();
        assert_eq!(amplitudes.length.as_rational().cloned(), exact("2"));
        assert_eq!(amplitudes.velocity.checked_div(&turn()).unwrap().as_rational().cloned(), exact("3"));
        assert_eq!(Phases::of(harmonic).unwrap().at(&Exact::from(1)).unwrap().as_rational().cloned(), exact("7/4"));
        assert_eq!(period(harmonic).unwrap().as_rational().cloned(), exact("2/3"));
        assert_eq!(ratio(pair).unwrap().as_rational().cloned(), exact("5/2"));
        assert_eq!(in_gaps("pair.gap", pair.gap(), pair).unwrap().as_rational().cloned(), exact("1"));
        // 5/4 and a little more of a period: pi/2, and a little more.
        let quarter = in_radians(&Enclosure::from_f64_bounds(1.25, 1.25).unwrap(), 60).to_f64_bounds();
        assert!(quarter.0 <= std::f64::consts::FRAC_PI_2 && std::f64::consts::FRAC_PI_2 <= quarter.1);
    }
}
