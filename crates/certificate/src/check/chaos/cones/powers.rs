//! Exponentials and logarithms in intervals of doubles (Lemma V14, powers).

use std::f64::consts::LN_2;

use super::super::span::Span;

/// Greater exponents are not looked at.
pub(super) const MAX_EXPONENT: f64 = 60.0;
/// Terms of the series.
const TERMS: i32 = 18;

/// Encloses `e^x`; `None` where `|x| > MAX_EXPONENT`.
pub(super) fn exponential(x: f64) -> Option<Span> {
    let is_small = x.abs() <= MAX_EXPONENT;
    if !is_small {
        return None; // exact: nothing is confirmed; so it is at NaN
    }
    let whole = (x / LN_2).round_ties_even(); // V14: any whole number
    let rest = Span::point(x) - Span::point(whole) * Span::new(LN_2, LN_2.next_up());
    let tail = Span::new(0.0, 2.0);
    let sum = (1..=TERMS).rev().try_fold(tail, |sum, n| {
        let part = rest.over(Span::point(f64::from(n)))?;
        Some(Span::point(1.0) + part * sum)
    })?;
    // exact: a power of two, its exponent a whole number below 90
    (rest.most() < 0.5).then(|| sum.scaled(2.0f64.powi(whole as i32)))
}

/// Encloses the logarithm of a double, `None` if it is not positive.
pub(super) fn logarithm(x: f64) -> Option<Span> {
    let guess = x.ln(); // proposes: NaN, or infinite, where there is none
    let ratio = Span::point(x) * exponential(-guess)?;
    let most = (ratio - Span::point(1.0)).most();
    // V14: |ln(1 + d)| <= 2 |d| for |d| < 1/2
    (most < 0.5).then(|| Span::point(guess) + Span::new(-2.0 * most, 2.0 * most))
}

#[cfg(test)]
mod tests {
    use impact_pair_exact::{Dyadic, Real};

    use super::*;
    use crate::check::chaos::entropy;

    /// The series in 256 bits, and its own logarithm.
    #[test]
    fn powers_hold_those_of_many_bits() {
        for k in -240..=240 {
            let x = f64::from(k) * 0.249_999;
            let many = entropy::exponential(&Real::point(Dyadic::from_f64(x.abs()).expect("finite"), 256));
            let many = if x < 0.0 { Real::int(1, 256).over(&many).expect("positive") } else { many };
            let many = Span::of(many.enclosure());
            let power = exponential(x).expect("a small exponent");
            assert!(power.lo() <= many.lo() && many.hi() <= power.hi(), "e^{x}");
            assert!(power.hi() - power.lo() < 1e-14 * (1.0 + x.abs()) * power.lo(), "e^{x} is wide");
            let [low, high] = [power.lo(), power.hi()].map(|y| logarithm(y).expect("positive"));
            assert!(low.lo() <= x && x <= high.hi() && high.hi() - low.lo() < 1e-12, "ln e^{x}");
        }
        assert!(exponential(60.5).is_none() && exponential(f64::NAN).is_none() && logarithm(0.0).is_none());
    }
}
