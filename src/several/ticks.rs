//! Phases of a harmonic at any number of whole periods, in integers that wrap around as phases do.

use crate::exact::Exact;
use crate::number::up;

/// A fraction of a period in units of `2^-128` periods: sums and multiples wrap around as phases do.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ticks {
    ratio: u128,
    shift: u128,
    /// Radii of both, in periods: 0 but for intervals; `2^-127` more is allowed for each period.
    radii: (f64, f64),
}

/// A double far below every phase, above the error of as many ticks as there can be periods.
const TICK: f64 = 1.0 / (1_u64 << 63) as f64; // exact: a power of two

impl Ticks {
    /// `ratio n + shift`.
    pub fn new(ratio: &Exact, shift: &Exact) -> Self {
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
    pub fn phase(&self, turns: i64) -> f64 {
        let ticks = self.ratio.wrapping_mul(turns as u128).wrapping_add(self.shift); // H1: modulo whole periods
        // H1: the upper half with its sign is within 2^-64 of it, and is rounded once
        ((ticks >> 64) as i64) as f64 * (1.0 / 18_446_744_073_709_551_616.0)
    }

    /// Bounds its error: that of the ticks, `2^-63` periods at most, a rounding, and the intervals.
    #[inline]
    pub fn error(&self, turns: i64) -> f64 {
        let (of_ratio, of_shift) = self.radii;
        // H1: exactly known, or times the periods
        let intervals = if of_ratio == 0.0 { of_shift } else { up(of_ratio * (turns as f64).abs() + of_shift) };
        up(intervals + (2f64.powi(-55) + TICK))
    }
}
