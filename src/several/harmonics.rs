//! Several harmonics in any arithmetic: their phases at any turn, and what bounds the motion.

use inari::Interval;

use super::spectrum::{Spectrum, Term};
use crate::Error;
use crate::exact::{Enclosure, Exact};
use crate::number::interval::between;
use crate::number::kernel::Departure;
use crate::number::{Ball, LARGEST_RATE, Wave, is_positive, up};
#[cfg(feature = "multiprecision")]
use crate::number::{MpBall, Number};
use crate::pair::{ImpactPair, too_large};

/// A number in which the box under several harmonics is computed.
pub(crate) trait Turning: Wave + std::fmt::Debug + Send {
    /// The phase of a harmonic as a function of whole turns of the fastest.
    type Counter: Clone + std::fmt::Debug + Send + Sync;
    /// `ratio n + shift`, less whole turns.
    fn phase_at(counter: &Self::Counter, turns: i64) -> Self;
    /// A number near it, to nearest.
    fn middle(&self) -> f64;
}

/// A number in which flights under several harmonics are computed.
pub(crate) trait Phased: Turning {
    /// The counter of phases `ratio n + shift`.
    fn counter(ratio: &Exact, shift: &Exact, bits: u32) -> Self::Counter;
    /// Encloses an exact number; a double takes the nearest.
    fn enclose(x: &Exact, bits: u32) -> Self;
    /// A lower and an upper bound.
    fn bounds(&self) -> (f64, f64);
    /// The same as an interval.
    fn interval(&self) -> Interval {
        let (inf, sup) = self.bounds();
        between(inf, sup)
    }
    /// Whether it is exactly 0.
    fn is_zero(&self) -> bool {
        self.bounds() == (0.0, 0.0)
    }
    /// The centre, exactly.
    fn centre_of(&self) -> Self;
    /// An exact number near `self + step`, both exact.
    fn later(&self, step: &Self) -> Self;
    /// An exact number near `self / divisor`, of the centres; `None` where that has no size.
    fn ratio_to(&self, divisor: &Self) -> Option<Self>;
    /// An exact number near the square root of the centre, which is not negative.
    fn root_of(&self) -> Self;
    /// Exactly `x`, as fine as `self`.
    fn like(&self, x: f64) -> Self;
    /// Pieces of one flight that are looked at, as fine as `self`.
    fn pieces(&self) -> u32 {
        1 << 20
    }
}

/// A fraction of a turn in units of `2^-128` turns: sums and multiples wrap around as phases do.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ticks {
    ratio: u128,
    shift: u128,
    /// Radii of both, in turns: 0 but for intervals; `2^-127` more is allowed for each turn.
    radii: (f64, f64),
}

/// A double far below every phase, above the error of as many ticks as there can be turns.
const TICK: f64 = 1.0 / (1_u64 << 63) as f64; // exact: a power of two

impl Ticks {
    fn new(ratio: &Exact, shift: &Exact) -> Self {
        let ticks = |x: &Exact| {
            let enclosure = x.enclose(320);
            let middle = enclosure.inf().to_rational() + enclosure.sup().to_rational();
            let scaled = middle * num_rational::BigRational::from_integer(num_bigint::BigInt::from(1) << 127);
            let whole = scaled.floor().to_integer(); // H1: rounded down to ticks
            let modulus = num_bigint::BigInt::from(1) << 128;
            let wrapped = num_integer::Integer::mod_floor(&whole, &modulus);
            let ticks = u128::try_from(wrapped).expect("less than the modulus");
            // Lemma H1: half the width, and nothing where that is below the ticks, as it is for all that is not an interval.
            let half = enclosure.wid().to_f64_up();
            (ticks, if half <= 2f64.powi(-130) { 0.0 } else { half })
        };
        let ((ratio, of_ratio), (shift, of_shift)) = (ticks(ratio), ticks(shift));
        Self { ratio, shift, radii: (of_ratio, of_shift) }
    }

    /// The phase in `[-1/2, 1/2]`, to nearest.
    #[inline]
    fn phase(&self, turns: i64) -> f64 {
        let ticks = self.ratio.wrapping_mul(turns as u128).wrapping_add(self.shift); // H1: modulo whole turns
        // H1: the upper half with its sign is within 2^-64 of it, and is rounded once
        ((ticks >> 64) as i64) as f64 * (1.0 / 18_446_744_073_709_551_616.0)
    }

    /// Bounds its error: that of the ticks, `2^-63` turns at most, a rounding, and the intervals.
    #[inline]
    fn error(&self, turns: i64) -> f64 {
        let (of_ratio, of_shift) = self.radii;
        // H1: exactly known, or times the turns
        let intervals = if of_ratio == 0.0 { of_shift } else { up(of_ratio * (turns as f64).abs() + of_shift) };
        up(intervals + (2f64.powi(-55) + TICK))
    }
}

impl Turning for f64 {
    type Counter = Ticks;

    #[inline]
    fn phase_at(counter: &Ticks, turns: i64) -> f64 {
        counter.phase(turns)
    }
    #[inline]
    fn middle(&self) -> f64 {
        *self
    }
}

impl Phased for f64 {
    fn counter(ratio: &Exact, shift: &Exact, _: u32) -> Ticks {
        Ticks::new(ratio, shift)
    }
    fn enclose(x: &Exact, _: u32) -> f64 {
        x.enclose(64).mid_rad().0
    }
    #[inline]
    fn bounds(&self) -> (f64, f64) {
        (*self, *self)
    }
    #[inline]
    fn centre_of(&self) -> f64 {
        *self
    }
    #[inline]
    fn later(&self, step: &f64) -> f64 {
        self + step
    }
    #[inline]
    fn ratio_to(&self, divisor: &f64) -> Option<f64> {
        let ratio = self / divisor;
        ratio.is_finite().then_some(ratio)
    }
    #[inline]
    fn root_of(&self) -> f64 {
        self.sqrt()
    }
    #[inline]
    fn like(&self, x: f64) -> f64 {
        x
    }
}

impl Turning for Ball {
    type Counter = Ticks;

    #[inline]
    fn phase_at(counter: &Ticks, turns: i64) -> Ball {
        Ball::new(counter.phase(turns), counter.error(turns))
    }
    #[inline]
    fn middle(&self) -> f64 {
        middle(self)
    }
}

impl Phased for Ball {
    fn counter(ratio: &Exact, shift: &Exact, _: u32) -> Ticks {
        Ticks::new(ratio, shift)
    }
    fn enclose(x: &Exact, _: u32) -> Ball {
        Ball::of(x)
    }
    #[inline]
    fn bounds(&self) -> (f64, f64) {
        // B2: a point
        if self.rad() == 0.0 {
            return (self.mid(), self.mid());
        }
        ((self.mid() - self.rad()).next_down(), (self.mid() + self.rad()).next_up())
    }
    #[inline]
    fn centre_of(&self) -> Ball {
        Ball::exact(self.mid())
    }
    #[inline]
    fn later(&self, step: &Ball) -> Ball {
        Ball::exact(self.mid() + step.mid())
    }
    #[inline]
    fn ratio_to(&self, divisor: &Ball) -> Option<Ball> {
        self.mid().ratio_to(&divisor.mid()).map(Ball::exact)
    }
    #[inline]
    fn root_of(&self) -> Ball {
        Ball::exact(self.mid().sqrt())
    }
    #[inline]
    fn like(&self, x: f64) -> Ball {
        Ball::exact(x)
    }
}

/// Bits that turns can take: phases are told with so many more.
#[cfg(feature = "multiprecision")]
const TURN_BITS: u32 = 64;

#[cfg(feature = "multiprecision")]
impl Turning for MpBall {
    type Counter = (MpBall, MpBall);

    fn phase_at((ratio, shift): &(MpBall, MpBall), turns: i64) -> MpBall {
        let turns = MpBall::exact(rug::Float::with_val(TURN_BITS, turns));
        let phase = turns.mul_add(ratio.clone(), shift.clone());
        let whole = MpBall::exact(phase.mid().clone().round()); // H1: any whole number of turns
        let bits = phase.bits() - TURN_BITS;
        (phase - whole).rounded(bits)
    }
    fn middle(&self) -> f64 {
        middle(self)
    }
}

#[cfg(feature = "multiprecision")]
impl Phased for MpBall {
    fn counter(ratio: &Exact, shift: &Exact, bits: u32) -> (MpBall, MpBall) {
        let wide = |x: &Exact| enclosing(x, bits + TURN_BITS);
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
        MpBall::exact(rug::Float::with_val(bits, self.mid() + step.mid()))
    }
    fn ratio_to(&self, divisor: &MpBall) -> Option<MpBall> {
        let bits = self.bits().max(divisor.bits()); // exact: any number; it is an exact one
        let ratio = rug::Float::with_val(bits, self.mid() / divisor.mid());
        ratio.is_finite().then(|| MpBall::exact(ratio))
    }
    fn root_of(&self) -> MpBall {
        MpBall::exact(rug::Float::with_val(self.bits(), self.mid().sqrt_ref()))
    }
    fn like(&self, x: f64) -> MpBall {
        MpBall::from_f64_bits(x, self.bits())
    }
    fn pieces(&self) -> u32 {
        ((1 << 22) / self.bits()).max(1 << 9) // proposes: about a second
    }
}

#[cfg(feature = "multiprecision")]
pub(super) fn enclosing(x: &Exact, bits: u32) -> MpBall {
    MpBall::enclosing(&x.enclose(bits + 8), bits)
}

/// Half way between the bounds, to nearest.
fn middle<N: Phased>(x: &N) -> f64 {
    let (low, high) = x.bounds();
    0.5 * (low + high)
}

/// An upper bound of the absolute values.
pub(super) fn magnitude<N: Phased>(x: &N) -> f64 {
    let (low, high) = x.bounds();
    low.abs().max(high.abs()) // B2: the farther end; next to a NaN is infinity
}

/// The harmonics in an arithmetic.
#[derive(Clone, Debug)]
pub(crate) struct Harmonics<N: Turning> {
    pub terms: Vec<Partial<N>>,
    pub rates: Rates,
}

/// One of them.
#[derive(Clone, Debug)]
pub(crate) struct Partial<N: Turning> {
    /// `A_k / d`
    pub alpha: N,
    /// `2 pi alpha W_k / W`: its greatest speed, in gaps a turn.
    pub beta: N,
    /// `2 pi beta W_k / W`: its greatest acceleration.
    pub swing: N,
    /// `W_k / W`
    pub ratio: N,
    /// Its phase at whole turns.
    pub counter: N::Counter,
}

/// Upper bounds, at all times, of what the harmonics do, in gaps and turns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rates {
    /// of `|E|/d`, `|z''|`, `|z'''|` and `|z''''|`.
    pub shift: f64,
    pub second: f64,
    pub third: f64,
    pub fourth: f64,
}

/// Sums over the harmonics at one time: what is left of `E`, `E'` and `E''` without units.
///
/// `z = const + c h - sine`, `z' = c - cosine`, `z'' = swing`. **Equations** (10)-(12) under (1)
#[derive(Clone, Debug)]
pub(crate) struct Sums<N> {
    /// `sum alpha_k sin th_k`
    pub sine: N,
    /// `sum beta_k cos th_k`
    pub cosine: N,
    /// `sum swing_k sin th_k`
    pub swing: N,
}

/// What a departure adds: to `z` on top of `z'(0) h`, to `z'` and to `z''`.
#[derive(Clone, Debug)]
pub(crate) struct Added<N> {
    pub height: N,
    pub velocity: N,
    pub acceleration: N,
}

impl<N: Turning> Sums<N> {
    #[inline]
    fn of<'h>(waves: impl Iterator<Item = (&'h Partial<N>, (N, N))>) -> Self
    where
        N: 'h,
    {
        let zero = N::from_f64(0.0);
        let mut sums = Self { sine: zero.clone(), cosine: zero.clone(), swing: zero };
        for (term, (sin, cos)) in waves {
            sums.sine = term.alpha.clone().mul_add(sin.clone(), sums.sine);
            sums.cosine = term.beta.clone().mul_add(cos, sums.cosine);
            sums.swing = term.swing.clone().mul_add(sin, sums.swing);
        }
        sums
    }
}

impl<N: Phased> Harmonics<N> {
    /// Encloses the harmonics in `bits` bits, where the arithmetic has a choice.
    pub fn new(spectrum: &Spectrum, bits: u32) -> Self {
        let partial = |term: &Term| {
            let (alpha, ratio) = (N::enclose(&term.alpha, bits), N::enclose(&term.ratio, bits));
            Partial::new(alpha, ratio, N::counter(&term.ratio, &term.shift, bits))
        };
        Self { terms: spectrum.terms.iter().map(partial).collect(), rates: Rates::new(spectrum) }
    }
}

impl<N: Turning> Partial<N> {
    /// The harmonic of this size and these phases.
    pub fn new(alpha: N, ratio: N, counter: N::Counter) -> Self {
        let beta = alpha.clone() * ratio.clone() * alpha.turn();
        let swing = beta.clone() * ratio.clone() * alpha.turn();
        Self { alpha, beta, swing, ratio, counter }
    }
}

impl<N: Turning> Harmonics<N> {
    /// Sine and cosine of each harmonic, `rest` after a number of whole turns.
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

    /// What a short `time` adds to what the harmonics do from where their sines and cosines are these, without cancellation;
    /// `None` where [`Wave::short`] knows no departure.
    pub fn departure(&self, waves: &[(N, N)], time: &N) -> Option<Added<N>> {
        let zero = N::from_f64(0.0);
        let mut added = Added { height: zero.clone(), velocity: zero.clone(), acceleration: zero };
        for (term, (sin, cos)) in self.terms.iter().zip(waves) {
            let Departure { versine, excess, sine } = (term.ratio.clone() * time.clone()).short()?;
            let of_height = cos.clone() * excess + sin.clone() * versine.clone();
            added.height = term.alpha.clone().mul_add(of_height, added.height);
            let of_velocity = cos.clone() * versine.clone() + sin.clone() * sine.clone();
            added.velocity = term.beta.clone().mul_add(of_velocity, added.velocity);
            let of_acceleration = cos.clone() * sine - sin.clone() * versine;
            added.acceleration = term.swing.clone().mul_add(of_acceleration, added.acceleration);
        }
        Some(added)
    }

    /// `z'''` at that time: `sum 2 pi (W_k/W) swing_k cos th_k`.
    pub fn jerk(&self, turns: i64, rest: &N) -> N {
        self.waves(turns, rest).fold(N::from_f64(0.0), |sum, (term, (_, cos))| {
            let rate = term.swing.clone() * term.ratio.clone() * term.ratio.turn();
            rate.mul_add(cos, sum)
        })
    }
}

impl Harmonics<Ball> {
    /// Encloses the harmonics of `pair` in doubles.
    ///
    /// # Errors
    /// When they are too large for the arithmetic of a flight.
    pub fn in_doubles(spectrum: &Spectrum, pair: &ImpactPair) -> Result<Self, Error> {
        let harmonics = Self::new(spectrum, f64::MANTISSA_DIGITS);
        if is_positive(LARGEST_RATE - harmonics.rates.fourth) {
            return Ok(harmonics);
        }
        Err(too_large("excitation.amplitude", pair.excitation().reference().amplitude()))
    }
}

#[cfg(feature = "multiprecision")]
impl Harmonics<MpBall> {
    /// The same with centres of `bits` bits.
    pub fn rounded(&self, bits: u32) -> Self {
        let term = |term: &Partial<MpBall>| {
            let (ratio, shift) = &term.counter;
            Partial {
                alpha: term.alpha.rounded(bits),
                beta: term.beta.rounded(bits),
                swing: term.swing.rounded(bits),
                ratio: term.ratio.rounded(bits),
                counter: (ratio.rounded(bits + TURN_BITS), shift.rounded(bits + TURN_BITS)),
            }
        };
        Self { terms: self.terms.iter().map(term).collect(), rates: self.rates }
    }
}

impl Rates {
    /// Of harmonics that are not asked for theirs.
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
