//! The contact on one monotone piece.

use rug::Float;
use std::cmp::Ordering;

/// D(phi) = base + drift phi - A sin(theta0 + phi), the distance past a wall (towards the outside is positive), on a
/// piece [from, to] on which it rises from inside (< 0) to outside (> 0). phi = W (t - t_i) less whole forcing periods, radians;
/// lengths in the problem's unit.
pub(crate) struct Piece {
    /// D less its drift and sine.
    pub base: Float,
    /// c / W, signed towards the wall.
    pub drift: Float,
    /// A, signed towards the wall.
    pub amplitude: Float,
    /// Phase at the flight's start, radians.
    pub theta0: Float,
    /// Start of the piece, radians.
    pub from: Float,
    /// End of the piece, radians.
    pub to: Float,
    /// The size of a difference in D that rounding cannot make.
    pub noise: Float,
}

impl Piece {
    /// D and dD/dphi at `phi`.
    fn value_and_slope(&self, phi: &Float) -> (Float, Float) {
        let bits = self.theta0.prec();
        let theta = Float::with_val(bits, &self.theta0 + phi);
        let (sine, cosine) = theta.sin_cos(Float::new(bits));
        let value = Float::with_val(bits, &self.drift * phi) + &self.base - sine * &self.amplitude;
        let slope = -(cosine * &self.amplitude) + &self.drift;
        (value, slope)
    }

    /// The root by plain bisection in double precision: a guess, no more.
    fn guess(&self) -> Float {
        let scale = Float::with_val(64, self.amplitude.abs_ref()).max(&Float::with_val(64, self.drift.abs_ref()));
        let in_scale = |x: &Float| Float::with_val(64, x / &scale).to_f64();
        let (base, drift, amplitude) = (in_scale(&self.base), in_scale(&self.drift), in_scale(&self.amplitude));
        let (theta0, mut from, mut to) = (self.theta0.to_f64(), self.from.to_f64(), self.to.to_f64());
        loop {
            let middle = from + 0.5 * (to - from);
            if !(from < middle && middle < to) {
                return Float::with_val(self.theta0.prec(), middle);
            }
            if base + drift * middle - amplitude * (theta0 + middle).sin() < 0.0 {
                from = middle;
            } else {
                to = middle;
            }
        }
    }

    /// The root, within 2^-`accuracy_bits` radians and proved so up to `noise` by the signs of D on both sides of it;
    /// otherwise `Err` with the best guess: this precision is too small, or the root is nearly double.
    ///
    /// **Cost**: 3 + 2 sines when the double-precision guess is good, at most a few hundred when it is not.
    pub fn root(&self, accuracy_bits: u32) -> Result<Float, Float> {
        let bits = self.theta0.prec();
        let (mut from, mut to) = (self.from.clone(), self.to.clone());
        let mut phi = self.guess();
        if !(phi > from && phi < to) {
            phi = Float::with_val(bits, &from + &to) / 2;
        }
        let mut last_step = Float::with_val(bits, &to - &from);
        // Newton's step is taken only where it at least halves the last one, else the bracket is halved: 3 * bits ends.
        for _ in 0..3 * bits {
            let (value, slope) = self.value_and_slope(&phi);
            match value.cmp0() {
                Some(Ordering::Less) => from.clone_from(&phi),
                Some(Ordering::Greater) => to.clone_from(&phi),
                _ => break,
            }
            let step = -(value / &slope);
            let newton = Float::with_val(bits, &phi + &step);
            let halves = Float::with_val(bits, &step * 2u32).cmp_abs(&last_step) == Some(Ordering::Less);
            let trusted = slope > 0 && newton >= from && newton <= to && halves;
            (phi, last_step) = if trusted {
                (newton, step)
            } else {
                (Float::with_val(bits, &from + &to) / 2, Float::with_val(bits, &to - &from))
            };
            if last_step.is_zero() {
                break;
            }
            // Newton leaves about step^2 |D''| / (2 D'), |D''| <= A (the sign check below has the last word); a bisection
            // leaves the bracket.
            let left =
                if trusted { 2 * log2(&last_step) + log2(&self.amplitude) - log2(&slope) } else { log2(&last_step) };
            if left < -i64::from(accuracy_bits + 4) {
                break;
            }
        }
        if self.changes_sign_around(&phi, accuracy_bits) { Ok(phi) } else { Err(phi) }
    }

    /// Whether D is clearly negative 2^-`accuracy_bits` before `phi` and clearly positive as much after `phi`.
    fn changes_sign_around(&self, phi: &Float, accuracy_bits: u32) -> bool {
        let bits = self.theta0.prec();
        let margin = Float::with_val(bits, Float::u_exp(1, -(accuracy_bits as i32)));
        let (before, _) = self.value_and_slope(&Float::with_val(bits, phi - &margin));
        let (after, _) = self.value_and_slope(&Float::with_val(bits, phi + &margin));
        before < -self.noise.clone() && after > self.noise
    }
}

/// log2 |x|, rounded up; hugely negative for zero.
fn log2(x: &Float) -> i64 {
    x.get_exp().map_or(i64::from(i32::MIN), i64::from)
}
