//! The arc cosine of balls: Newton's method for the sine of half the angle, proved by its slope.

use super::float::{Float, Round};
use super::{MpBall, float_of_magnitude};
use crate::number::{Magnitude, Number};

/// Bits beyond the requested ones.
const GUARD: u32 = 32;

impl MpBall {
    /// Encloses `acos(q) / (2 pi)` for all `q` in the ball that lie in `[-1, 1]`.
    ///
    /// It falls: each end of the ball bounds the other side (Lemma M6, `docs/proofs/multiprecision.md#M6`).
    pub fn acos(&self) -> Self {
        let bits = self.bits();
        let unknown = || Self { mid: Float::zero(bits), rad: Magnitude::INFINITE };
        let Some(rad) = float_of_magnitude(self.rad).filter(|_| self.mid.is_number()) else { return unknown() };
        let low = arc(&self.mid.clone().add(&rad, bits, Round::Up).0, bits);
        if rad.is_zero() {
            return low;
        }
        let high = arc(&self.mid.clone().sub(&rad, bits, Round::Down).0, bits);
        let mid = low.mid.plus(&high.mid, bits).scaled(-1);
        // Either is below the other but for its error: the farther end of both.
        let reach = |end: &Self| end.mid.distance(&mid) + end.rad;
        let (below, above) = (reach(&low), reach(&high));
        let rad = if below < above { above } else { below };
        Self { mid, rad }
    }
}

/// Encloses `acos(q) / (2 pi)`, `q` cut with `[-1, 1]`, to `bits` significant bits, also for angles near 0.
///
/// **Lemma M6.** For `0 <= q <= 1` it is `2 y` with `sin 2 pi y = s = sqrt((1 - q) / 2)`, `0 <= y <= 1/8`. Where a `y'` with
/// `0 <= y' <= 1/7` has `|sin 2 pi y' - s| <= r`, it is within `r / 3` of `y`: the slope of the sine is at least
/// `2 pi cos(2 pi / 7) > 3.9` in between. For `q < 0` it is half a period less that of `-q`.
fn arc(q: &Float, bits: u32) -> MpBall {
    let (one, half) = (Float::new(1.0), Float::new(0.5));
    let size = q.clone().abs();
    if size >= one {
        return MpBall::exact(if *q > 0.0 { Float::zero(bits) } else { half.rounded(bits) });
    }
    // An angle near 0 has as many bits as others.
    let small = one.minus(&size, bits).top().map_or(0, i64::unsigned_abs) / 2 + 2;
    let bits_of = |x: u64| u32::try_from(x).expect("1 - q has at most twice the bits");
    let fine = bits + GUARD + bits_of(small);
    let (versine, is_exact) = one.sub(&size, fine + bits, Round::Nearest);
    let versine = versine.scaled(-1);
    let root = versine.sqrt(fine);
    let sine = MpBall { rad: root.half_unit(), mid: root };
    // The slope of the square root, between the exact number and this one.
    let error = if is_exact { Magnitude::ZERO } else { versine.half_unit().over(sine.mid.least()) };
    let sine = sine.widened(error + error);
    let y = inverse_sine(&sine.mid, fine);
    let inside = y.sign().is_some_and(|sign| sign.is_ge()) && y <= 1.0 / 7.0;
    let found = MpBall::exact(y.clone()).sin_cos().0;
    let off = found.mid.distance(&sine.mid) + found.rad + sine.rad;
    let rad = if inside { off.over(Magnitude::new(3.0, 0)) } else { Magnitude::INFINITE };
    let angle = MpBall { mid: y.scaled(1), rad: rad + rad };
    let angle = if *q < 0.0 { MpBall::exact(half) - angle } else { angle };
    angle.rounded(bits)
}

/// `asin(s) / (2 pi)` for `0 <= s <= 3/4`, about as many bits of it: Newton's method, each step twice those of the one before.
fn inverse_sine(s: &Float, bits: u32) -> Float {
    let mut levels = vec![bits];
    while let Some(&level) = levels.last().filter(|&&level| level > 40) {
        levels.push(level / 2 + 4);
    }
    let (near, turn) = (s.to_f64(), MpBall::exact(Float::zero(bits)).turn());
    // Proposes: what is found is proved.
    let mut y = if near < 1e-6 { s.over(&turn.mid, 64) } else { Float::new(near.asin() / std::f64::consts::TAU) };
    for level in levels.into_iter().rev().skip(1) {
        let (sin, cos) = MpBall::exact(y.rounded(level + 8)).sin_cos();
        let step = s.minus(&sin.mid, level).over(&cos.mid.times(&turn.mid, level), level);
        y = y.rounded(level + 8).plus(&step, level + 8);
    }
    y.rounded(bits)
}
