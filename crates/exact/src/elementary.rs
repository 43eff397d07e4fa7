//! Pi, square roots, sines and cosines of dyadic points, in integer fixed point with every rounding counted.
//!
//! A fixed-point number at scale `w` is an integer `a` that stands for `a / 2^w`; one unit is `2^-w`.
//!
//! **Lemma (sine).** Let `0 <= t <= 1` be a fixed-point number and `u` its square rounded down. Then the terms
//! `a_0 = t`, `a_(k+1) = floor(floor(a_k u) / ((2k + 2)(2k + 3)))` are each within 2 units of `A_k = t^(2k+1) / (2k+1)!`:
//! if `a_k` is off by `e_k`, then `a_k u` is off by at most `e_k + 1` (as `t, u <= 1` and `u` is off by 1), its floor by `e_k + 2`, and
//! `e_(k+1) <= (e_k + 2) / 6 + 1 <= 2` by induction from `e_0 = 0`. The true terms alternate and fall, so what is left out after the first
//! computed zero is at most that true term, 2 units. With `n` terms summed, the error is at most `2 n + 2` units.
//!
//! **Lemma (tripling).** For `|s| <= 1/2` off by `e` units, `3 s - 4 s^3` with two floors is off by at most `3 e + 5`: the derivative
//! `3 - 12 s^2` is at most 3 in size, the floor of `s^2` costs `4 |s| <= 4` units and the last floor one.
//!
//! **Lemma (cofactor).** If `|r| <= pi/4 + 2^-20` and `s = sin r` is off by `e` units, `sqrt(1 - s^2)` is off by at most `2 e + 3` units:
//! its slope `s / c` stays below 2 as long as `s^2 <= 4/5`; the square and the root cost a floor each.

use std::sync::Mutex;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::dyadic::{Dyadic, Round, divide_to_integer, scale_to_integer};
use super::enclosure::Enclosure;

/// The best `(w, floor(pi * 2^w))` so far. Lower scales are its leading bits, so results never depend on history.
static BEST_PI: Mutex<Option<(u64, BigInt)>> = Mutex::new(None);

impl Enclosure {
    /// Encloses pi, at most `2^(3 - bits)` wide.
    pub fn pi(bits: u32) -> Enclosure {
        pi(bits)
    }

    /// Encloses the square root; `None` if x may be negative.
    pub fn sqrt(&self, bits: u32) -> Option<Enclosure> {
        if self.inf().sign().is_lt() {
            return None;
        }
        Enclosure::new(sqrt(self.inf(), bits, Round::Down), sqrt(self.sup(), bits, Round::Up))
    }

    /// Encloses sin x. **Cost**: grows with the logarithm of |x|, for the reduction modulo pi/2.
    pub fn sin(&self, bits: u32) -> Enclosure {
        let [sine] = self.lipschitz(bits, |x, bits| [sin(x, bits)]);
        sine
    }

    /// Encloses cos x. **Cost**: as [`sin`](Enclosure::sin).
    pub fn cos(&self, bits: u32) -> Enclosure {
        let [cosine] = self.lipschitz(bits, |x, bits| [cos(x, bits)]);
        cosine
    }

    /// Encloses sin x and cos x. **Cost**: little more than that of one of them.
    pub fn sin_cos(&self, bits: u32) -> [Enclosure; 2] {
        self.lipschitz(bits, sin_cos)
    }

    /// Encloses each f over the interval for f = sin or cos: both are 1-Lipschitz, so f([m - r, m + r]) lies in f(m) +- r.
    fn lipschitz<const N: usize>(&self, bits: u32, f: fn(&Dyadic, u32) -> [Enclosure; N]) -> [Enclosure; N] {
        let one = Dyadic::power_of_two(0);
        let whole = Enclosure::new(one.negated(), one).expect("-1 < 1");
        let within = |value: Enclosure| value.intersection(&whole).unwrap_or_else(|| whole.clone()); // X1: both hold it
        if self.is_point() {
            return f(self.inf(), bits).map(within);
        }
        let radius_bits = 32;
        let width = self.wid();
        if width >= Dyadic::power_of_two(3) {
            return std::array::from_fn(|_| whole.clone()); // longer than a period
        }
        let middle = self.inf().plus(self.sup(), bits.saturating_add(4), Round::Down).scaled(-1); // X1: any middle
        let left = middle.plus(&self.inf().negated(), radius_bits, Round::Up);
        let right = self.sup().plus(&middle.negated(), radius_bits, Round::Up);
        let radius = left.max(right); // X1: the farther end
        f(&middle, bits).map(|value| {
            let lo = value.inf().plus(&radius.negated(), bits, Round::Down);
            let hi = value.sup().plus(&radius, bits, Round::Up);
            within(Enclosure::new(lo, hi).expect("a radius is not negative"))
        })
    }
}

/// Encloses pi in ends of `bits` mantissa bits.
fn pi(bits: u32) -> Enclosure {
    let scale = u64::from(bits);
    let floor = pi_floor(scale);
    let unit = -(scale as i64); // exact: of 33 bits at most
    let wide = (Dyadic::new(floor.clone(), unit), Dyadic::new(floor + 1, unit));
    let lo = wide.0.rounded(bits, Round::Down);
    let hi = wide.1.rounded(bits, Round::Up);
    Enclosure::new(lo, hi).expect("floor(x) < floor(x) + 1")
}

/// Exactly `floor(pi * 2^scale)`.
fn pi_floor(scale: u64) -> BigInt {
    let mut best = BEST_PI.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    if let Some((have, floor)) = best.as_ref()
        && *have >= scale
    {
        return floor >> (have - scale);
    }
    let mut guard = 64;
    let floor = loop {
        let (lo, hi) = machin(scale + guard);
        let (lo, hi): (BigInt, BigInt) = (lo >> guard, hi >> guard);
        if lo == hi {
            break lo;
        }
        guard *= 2; // pi has a long run of equal binary digits here
    };
    *best = Some((scale, floor.clone()));
    floor
}

/// Bounds of `pi * 2^scale` by Machin's formula, pi = 16 atan(1/5) - 4 atan(1/239) (J. Machin, 1706).
fn machin(scale: u64) -> (BigInt, BigInt) {
    let (five, five_error) = inverse_tangent(5, scale);
    let (large, large_error) = inverse_tangent(239, scale);
    let value: BigInt = five * 16 - large * 4;
    let error = five_error * 16 + large_error * 4;
    (&value - error, &value + error)
}

/// `atan(1 / q) * 2^scale` and a bound of its error.
///
/// Nested floors are exact (floor(floor(a / b) / c) = floor(a / (b c))), so each of the n summed terms is short by less than one
/// unit, and the alternating rest by less than the first true term left out, itself below one: less than n + 1 in all.
fn inverse_tangent(q: u32, scale: u64) -> (BigInt, u64) {
    let mut power: BigInt = (BigInt::one() << scale) / q;
    let mut sum = BigInt::zero();
    let mut n = 0u64;
    while !power.is_zero() {
        let term = &power / (2 * n + 1);
        if n.is_multiple_of(2) {
            sum += term
        } else {
            sum -= term
        }
        power /= q * q;
        n += 1;
    }
    (sum, n + 1)
}

/// The square root of x >= 0 in `bits` mantissa bits, on the side that `round` says.
fn sqrt(x: &Dyadic, bits: u32, round: Round) -> Dyadic {
    // Shift to an even exponent and at least 2 bits + 2 digits, so that the integer root has bits + 1.
    let missing = (2 * i64::from(bits) + 2 - x.mantissa().bits() as i64).max(0); // exact: any shift that leaves it even
    let shift = missing + (x.exponent() - missing).rem_euclid(2);
    let square: BigInt = x.mantissa() << shift;
    let floor = square.sqrt();
    let root = if round == Round::Up && &floor * &floor != square { floor + 1 } else { floor };
    Dyadic::new(root, (x.exponent() - shift) / 2).rounded(bits, round)
}

/// Encloses sin x: absolute error below `2^(3 - bits)`, and relative error as small for |x| <= 1.
fn sin(x: &Dyadic, bits: u32) -> Enclosure {
    if is_tiny(x, bits) {
        return sin_of_tiny(x, bits);
    }
    Reduced::new(x, bits).sin_of_quadrant(0).rounded(bits)
}

/// Encloses cos x: absolute error below `2^(3 - bits)`.
fn cos(x: &Dyadic, bits: u32) -> Enclosure {
    if is_tiny(x, bits) {
        return cos_of_tiny(x, bits);
    }
    Reduced::new(x, bits).sin_of_quadrant(1).rounded(bits)
}

/// Encloses sin x and cos x, each as near as alone.
fn sin_cos(x: &Dyadic, bits: u32) -> [Enclosure; 2] {
    if is_tiny(x, bits) {
        return [sin_of_tiny(x, bits), cos_of_tiny(x, bits)];
    }
    let reduced = Reduced::new(x, bits);
    let sine = reduced.sine();
    [0, 1].map(|quarter_turns| reduced.of_quadrant(quarter_turns, &sine).rounded(bits))
}

/// True where x^2 is below `2^-bits`, so that one term of the series is enough.
fn is_tiny(x: &Dyadic, bits: u32) -> bool {
    x.top().is_none_or(|top| 2 * (top + 1) < -i64::from(bits))
}

/// Encloses sin x for |x| <= 1: it lies between x - x^3 / 6 and x (alternating series with falling terms).
fn sin_of_tiny(x: &Dyadic, bits: u32) -> Enclosure {
    let cube = Enclosure::point(x.times(x).times(x));
    let six = Enclosure::point(Dyadic::new(6.into(), 0));
    let sixth = cube.div(&six, bits).expect("six is not zero");
    let x = Enclosure::point(x.clone());
    x.sub(&sixth, bits).hull(&x.rounded(bits))
}

/// Encloses cos x for |x| <= 1: it lies between 1 - x^2 / 2 and 1.
fn cos_of_tiny(x: &Dyadic, bits: u32) -> Enclosure {
    let one = Dyadic::power_of_two(0);
    let lo = one.plus(&x.times(x).scaled(-1).negated(), bits, Round::Down);
    Enclosure::point(lo).hull(&Enclosure::point(one))
}

/// x = quadrant * pi/2 + r, with r known in fixed point to within `error` units and |r| <= pi/4 + 2^-20.
struct Reduced {
    scale: u64,
    quadrant: u8,
    remainder: BigInt,
    error: BigInt,
}

impl Reduced {
    /// Reduces x modulo pi/2, with enough digits of pi for its size and enough digits of r for `bits` correct ones.
    fn new(x: &Dyadic, bits: u32) -> Reduced {
        let top = x.top().unwrap_or(0); // exact: 0 has no top bit
        let (small, large) = ((-top).max(0) as u64, (top + 1).max(0) as u64); // exact: not negative
        let needed = u64::from(bits) + small;
        // Guard: tripling loses log2(3) bits a step (`halvings` steps), summing a few times log2(number of terms).
        // X1: any guard is sound
        let scale = needed + 2 * tripling_steps(needed) + 2 * u64::from(needed.max(2).ilog2()) + 16;

        let shift = x.exponent() + scale as i64; // exact: a length in bits
        let fixed = scale_to_integer(x.mantissa(), shift, Round::Down);
        let input_error = u8::from(shift < 0);

        // pi / 2 in units of 2^-(scale + large), exact to one unit there.
        let half_pi = pi_floor(scale + large - 1);
        // n = round(x / (pi/2)). Any integer n would be sound; a good one keeps r within a hair of pi/4.
        let wide = &fixed << large;
        let n = ((&wide << 1u8) + &half_pi).div_floor(&(&half_pi << 1u8));
        // n * pi/2 is off by |n| <= 2^(large + 1) units of 2^-(scale + large): 2 of ours, and one for the floor.
        let remainder = (wide - &n * half_pi) >> large;
        // exact: 0 to 3, no digits for 0
        let quadrant = n.mod_floor(&BigInt::from(4)).iter_u32_digits().next().unwrap_or(0) as u8;
        Reduced { scale, quadrant, remainder, error: BigInt::from(input_error) + 3 }
    }

    /// Encloses sin(x + quarter_turns * pi/2), with all guard digits.
    fn sin_of_quadrant(&self, quarter_turns: u8) -> Enclosure {
        self.of_quadrant(quarter_turns, &self.sine())
    }

    /// sin r, and a bound of its error in units.
    fn sine(&self) -> (BigInt, BigInt) {
        sine_fixed(&self.remainder, self.scale)
    }

    /// Encloses sin(x + quarter_turns * pi/2) by the quadrant: sin r, cos r, -sin r or -cos r; `sine` is sin r with its error.
    fn of_quadrant(&self, quarter_turns: u8, (sine, sine_error): &(BigInt, BigInt)) -> Enclosure {
        let quadrant = (self.quadrant + quarter_turns) % 4;
        let (value, error) = if quadrant.is_multiple_of(2) {
            (sine.clone(), sine_error.clone())
        } else {
            // Lemma (cofactor).
            let square = (BigInt::one() << (2 * self.scale)) - sine * sine;
            // X1: Lemma (cofactor); a square root has no negative radicand
            (square.max(BigInt::zero()).sqrt(), 2 * sine_error + 3)
        };
        // sin and cos are 1-Lipschitz, so the error of r is carried over as it is.
        let error = error + &self.error;
        let unit = -(self.scale as i64); // exact: a length in bits
        let (lo, hi) = (Dyadic::new(&value - &error, unit), Dyadic::new(&value + &error, unit));
        let enclosure = Enclosure::new(lo, hi).expect("the error is not negative");
        if quadrant >= 2 { enclosure.negated() } else { enclosure }
    }
}

/// Number of divisions of the argument by three before the series is summed: the square root balances steps against terms.
fn tripling_steps(scale: u64) -> u64 {
    scale.isqrt() / 2
}

/// sin r in fixed point for |r| <= 1, and a bound of its error in units.
fn sine_fixed(r: &BigInt, scale: u64) -> (BigInt, BigInt) {
    let steps = tripling_steps(scale);
    let parts = BigInt::from(3u8).pow(steps as u32); // exact: a root of a length
    let third = divide_to_integer(&r.abs(), &parts, Round::Down);
    let (mut sine, terms) = sine_series(&third, scale);
    // Lemma (sine), and one unit for the floor of the division by 3^steps.
    let mut error = BigInt::from(2 * terms + 3);
    for _ in 0..steps {
        // Lemma (tripling): arguments here are at most a third of pi/4 + 2^-20, so |s| <= 1/2.
        let square = (&sine * &sine) >> scale;
        let cube: BigInt = (square * &sine) >> (scale - 2);
        sine = 3 * sine - cube;
        error = 3 * error + 5;
    }
    (if r.is_negative() { -sine } else { sine }, error)
}

/// The sum of the sine series for a fixed-point `0 <= t <= 1`, and how many terms were summed.
fn sine_series(t: &BigInt, scale: u64) -> (BigInt, u64) {
    let square: BigInt = (t * t) >> scale;
    let mut term = t.clone();
    let mut sum = BigInt::zero();
    let mut n = 0u64;
    while !term.is_zero() {
        if n.is_multiple_of(2) {
            sum += &term
        } else {
            sum -= &term
        }
        term = ((term * &square) >> scale) / ((2 * n + 2) * (2 * n + 3));
        n += 1;
    }
    (sum, n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use proptest::prelude::*;

    /// The interval between a published decimal, cut after `digits` places, and the next one.
    fn assert_matches(enclosure: &Enclosure, digits: &str) {
        let (whole, places) = digits.split_once('.').unwrap();
        let scale = BigInt::from(10u8).pow(places.len() as u32);
        let cut: BigInt = format!("{whole}{places}").parse().unwrap();
        let away = if cut.is_negative() || digits.starts_with('-') { -1 } else { 1 };
        let (a, b) = (BigRational::new(cut.clone(), scale.clone()), BigRational::new(cut + away, scale));
        let (lo, hi) = if a < b { (a, b) } else { (b, a) };
        assert!(
            enclosure.inf().to_rational() >= lo && enclosure.sup().to_rational() <= hi,
            "{enclosure:?} is not {digits}..."
        );
    }

    #[test]
    fn pi_matches_its_published_digits() {
        assert_matches(&pi(260), "3.14159265358979323846264338327950288419716939937510582097494");
        for bits in 1..300 {
            assert!(pi(bits).contains_enclosure(&pi(400)), "{bits}");
        }
        assert_eq!(pi_floor(40), pi_floor(3000) >> 2960u32);
    }

    #[test]
    fn machins_error_bound_holds_and_is_needed() {
        for scale in 1..200u64 {
            let (lo, hi) = machin(scale);
            let floor = pi_floor(scale);
            assert!(lo <= floor && floor < hi, "{scale}");
            assert!(hi - lo <= BigInt::from(40 * (scale / 4 + 8)));
        }
    }

    #[test]
    fn sines_cosines_and_roots_match_published_digits() {
        let one = Dyadic::power_of_two(0);
        assert_matches(&sin(&one, 220), "0.84147098480789650665250232163029899962256306079837");
        assert_matches(&cos(&one, 220), "0.54030230586813971740093660744297660373231042061792");
        let two = Enclosure::point(Dyadic::power_of_two(1));
        assert_matches(&two.sqrt(220).unwrap(), "1.41421356237309504880168872420969807856967187537694");
        let huge = Dyadic::new(BigInt::from(10u8).pow(22), 0);
        assert_matches(&sin(&huge, 120), "-0.8522008497671888017727");
    }

    #[test]
    fn lipschitz_of_any_huge_argument() {
        // 10^300 and the neighbouring angle 10^300 + 1 must satisfy the addition theorem.
        let (x, y) = (BigInt::from(10u8).pow(300), BigInt::from(10u8).pow(300) + 1);
        let (x, y, one) = (Dyadic::new(x, 0), Dyadic::new(y, 0), Dyadic::power_of_two(0));
        let sum = sin(&x, 200).mul(&cos(&one, 200), 200).add(&cos(&x, 200).mul(&sin(&one, 200), 200), 200);
        let direct = sin(&y, 200);
        assert!(sum.intersection(&direct).is_some() && sum.wid() < Dyadic::power_of_two(-190));
        assert!(direct.wid() < Dyadic::power_of_two(-190));
    }

    #[test]
    fn tiny_arguments_keep_relative_accuracy() {
        for exponent in [-1, -20, -34, -35, -200, -40_000] {
            let x = Dyadic::new(5.into(), exponent - 2);
            let sine = sin(&x, 64);
            assert!(sine.wid() <= x.scaled(-58), "{exponent}");
            assert!(sine.contains_enclosure(&sin(&x, 300)) && *sine.sup() <= x.scaled(0));
            assert!(cos(&x, 64).wid() <= Dyadic::power_of_two(-60));
        }
    }

    proptest! {
        #[test]
        fn low_precision_contains_high_precision(m: i64, e in -130i64..100, bits in 4u32..100) {
            let x = Dyadic::new(m.into(), e);
            prop_assert!(sin(&x, bits).contains_enclosure(&sin(&x, 400)));
            prop_assert!(cos(&x, bits).contains_enclosure(&cos(&x, 400)));
            prop_assert!(sin(&x, bits).wid() <= Dyadic::power_of_two(3 - i64::from(bits)));
            prop_assert!(cos(&x, bits).wid() <= Dyadic::power_of_two(3 - i64::from(bits)));
        }

        // Without the outward rounding to `bits`, which would hide a wrong error bound behind the guard digits.
        #[test]
        fn counted_errors_cover_the_fixed_point_roundings(m: i64, e in -70i64..40, bits in 1u32..200, turns in 0u8..4) {
            let x = Dyadic::new(m.into(), e);
            let found = Reduced::new(&x, bits).sin_of_quadrant(turns);
            let truth = Reduced::new(&x, bits + 200).sin_of_quadrant(turns);
            prop_assert!(found.contains_enclosure(&truth), "{found:?} {truth:?}");
            prop_assert!(found.wid() <= Dyadic::power_of_two(1 - i64::from(bits)));
        }

        #[test]
        fn squares_of_sine_and_cosine_add_up_to_one(m: i64, e in -90i64..400, bits in 20u32..300) {
            let x = Dyadic::new(m.into(), e);
            let (s, c) = (sin(&x, bits), cos(&x, bits));
            prop_assert_eq!(sin_cos(&x, bits), [s.clone(), c.clone()]);
            let sum = s.mul(&s, bits).add(&c.mul(&c, bits), bits);
            prop_assert!(sum.contains(&BigRational::one()));
            prop_assert!(sum.wid() <= Dyadic::power_of_two(8 - i64::from(bits)));
        }
    }
}
