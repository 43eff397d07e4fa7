//! Several harmonics in any arithmetic: their sums in any forcing period, and what bounds the motion.

use super::phased::{FlightNumber, PhaseNumber};
use super::spectrum::{Spectrum, Term};
use crate::Error;
use crate::exact::Enclosure;
use crate::number::kernel::SmallAngle;
use crate::number::{Ball, LARGEST_RATE, is_positive, up};
use crate::pair::{ImpactPair, too_large};

/// The harmonics in an arithmetic.
#[derive(Clone, Debug)]
pub(crate) struct Harmonics<N: PhaseNumber> {
    pub terms: Vec<Partial<N>>,
    pub rates: Rates,
}

/// One harmonic.
#[derive(Clone, Debug)]
pub(crate) struct Partial<N: PhaseNumber> {
    /// `A_k / d`
    pub alpha: N,
    /// `2 pi alpha W_k / W`: its greatest speed, in gap widths per forcing period.
    pub beta: N,
    /// `2 pi beta W_k / W`: its greatest acceleration.
    pub acceleration: N,
    /// `W_k / W`
    pub ratio: N,
    /// Phase of the harmonic at whole forcing periods.
    pub counter: N::Counter,
}

/// Upper bounds, at all times, of the motion under the harmonics, in gap widths and forcing periods.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rates {
    /// of `|E|/d`, `|z''|`, `|z'''|` and `|z''''|`.
    pub shift: f64,
    pub second: f64,
    pub third: f64,
    pub fourth: f64,
}

/// Sums over the harmonics at one time: `E`, `E'` and `E''` without units, up to sign.
///
/// `z = const + c h - sine`, `z' = c - cosine`, `z'' = acceleration`. **Equations** (10)-(12) under (1)
#[derive(Clone, Debug)]
pub(crate) struct Sums<N> {
    /// `sum alpha_k sin th_k`
    pub sine: N,
    /// `sum beta_k cos th_k`
    pub cosine: N,
    /// `sum swing_k sin th_k`
    pub acceleration: N,
}

/// The increments over a short time: to `z` on top of `z'(0) h`, to `z'` and to `z''`.
#[derive(Clone, Debug)]
pub(crate) struct Added<N> {
    pub height: N,
    pub velocity: N,
    pub acceleration: N,
}

impl<N: PhaseNumber> Sums<N> {
    #[inline]
    fn of<'h>(waves: impl Iterator<Item = (&'h Partial<N>, (N, N))>) -> Self
    where
        N: 'h,
    {
        let zero = N::from_f64(0.0);
        let mut sums = Self { sine: zero.clone(), cosine: zero.clone(), acceleration: zero };
        for (term, (sin, cos)) in waves {
            sums.sine = term.alpha.clone().mul_add(sin.clone(), sums.sine);
            sums.cosine = term.beta.clone().mul_add(cos, sums.cosine);
            sums.acceleration = term.acceleration.clone().mul_add(sin, sums.acceleration);
        }
        sums
    }
}

impl<N: FlightNumber> Harmonics<N> {
    /// Encloses the harmonics in `bits` bits, where the arithmetic has a choice.
    pub fn new(spectrum: &Spectrum, bits: u32) -> Self {
        let partial = |term: &Term| {
            let (alpha, ratio) = (N::enclose(&term.alpha, bits), N::enclose(&term.ratio, bits));
            Partial::new(alpha, ratio, N::counter(&term.ratio, &term.shift, bits))
        };
        Self { terms: spectrum.terms.iter().map(partial).collect(), rates: Rates::new(spectrum) }
    }
}

impl<N: PhaseNumber> Partial<N> {
    /// The harmonic of this size and these phases.
    pub fn new(alpha: N, ratio: N, counter: N::Counter) -> Self {
        let beta = alpha.clone() * ratio.clone() * alpha.turn();
        let acceleration = beta.clone() * ratio.clone() * alpha.turn();
        Self { alpha, beta, acceleration, ratio, counter }
    }
}

impl<N: PhaseNumber> Harmonics<N> {
    /// Sine and cosine of each harmonic, `rest` after a number of whole forcing periods.
    pub fn waves<'h>(&'h self, turns: i64, rest: &'h N) -> impl Iterator<Item = (&'h Partial<N>, (N, N))> {
        self.terms.iter().map(move |term| {
            let phase = term.ratio.clone().mul_add(rest.clone(), N::phase_at(&term.counter, turns));
            (term, phase.wave())
        })
    }

    /// The sums at that time.
    #[inline]
    pub fn sums(&self, turns: i64, rest: &N) -> Sums<N> {
        Sums::of(self.waves(turns, rest))
    }

    /// The sums where the sine and cosine of each harmonic are these.
    pub fn sums_of(&self, waves: &[(N, N)]) -> Sums<N> {
        Sums::of(self.terms.iter().zip(waves.iter().cloned()))
    }

    /// Increments of the harmonics over a short `time` from a phase with sines and cosines `waves`, without cancellation; `None` where
    /// [`Wave::short`] knows no departure.
    pub fn departure(&self, waves: &[(N, N)], time: &N) -> Option<Added<N>> {
        let zero = N::from_f64(0.0);
        let mut added = Added { height: zero.clone(), velocity: zero.clone(), acceleration: zero };
        for (term, (sin, cos)) in self.terms.iter().zip(waves) {
            let SmallAngle { versine, excess, sine } = (term.ratio.clone() * time.clone()).short()?;
            let of_height = cos.clone() * excess + sin.clone() * versine.clone();
            added.height = term.alpha.clone().mul_add(of_height, added.height);
            let of_velocity = cos.clone() * versine.clone() + sin.clone() * sine.clone();
            added.velocity = term.beta.clone().mul_add(of_velocity, added.velocity);
            let of_acceleration = cos.clone() * sine - sin.clone() * versine;
            added.acceleration = term.acceleration.clone().mul_add(of_acceleration, added.acceleration);
        }
        Some(added)
    }

    /// `z'''` at that time: `sum 2 pi (W_k/W) swing_k cos th_k`.
    pub fn jerk(&self, turns: i64, rest: &N) -> N {
        self.waves(turns, rest).fold(N::from_f64(0.0), |sum, (term, (_, cos))| {
            let rate = term.acceleration.clone() * term.ratio.clone() * term.ratio.turn();
            rate.mul_add(cos, sum)
        })
    }
}

impl Harmonics<Ball> {
    /// Encloses the harmonics of `pair` in doubles.
    ///
    /// # Errors
    /// If the harmonics are too large for the arithmetic of a flight.
    pub fn in_doubles(spectrum: &Spectrum, pair: &ImpactPair) -> Result<Self, Error> {
        let harmonics = Self::new(spectrum, f64::MANTISSA_DIGITS);
        if is_positive(LARGEST_RATE - harmonics.rates.fourth) {
            return Ok(harmonics);
        }
        Err(too_large("excitation.amplitude", pair.excitation().reference().amplitude()))
    }
}

impl Rates {
    /// Rates of harmonics for which none are computed.
    pub const UNKNOWN: Self =
        Self { shift: f64::INFINITY, second: f64::INFINITY, third: f64::INFINITY, fourth: f64::INFINITY };

    fn new(spectrum: &Spectrum) -> Self {
        let magnitude = |x: Enclosure| x.mag().to_f64_up();
        let mut rates = Self { shift: 0.0, second: 0.0, third: 0.0, fourth: 0.0 };
        for term in &spectrum.terms {
            let (alpha, rate) =
                (magnitude(term.alpha.enclose(64)), up(6.283_185_307_179_587 * magnitude(term.ratio.enclose(64))));
            rates.shift = up(rates.shift + alpha);
            let second = up(up(alpha * rate) * rate);
            rates.second = up(rates.second + second);
            rates.third = up(rates.third + up(second * rate));
            rates.fourth = up(rates.fourth + up(up(second * rate) * rate));
        }
        rates
    }
}
