//! Upper bounds in doubles with wide exponents: the radii of multiprecision balls.
//!
//! A chaotic orbit of 10,000 impacts starts with errors of `2^-5800`, far below the range of doubles, but two digits
//! of a radius are plenty. Every operation rounds up (Lemma M0).

use std::cmp::Ordering;
use std::ops::{Add, Mul};

use super::up;

/// A non-negative number `fraction * 2^exponent`, rounded up in every operation.
///
/// The fraction is 0 or in `[1, 2)`; infinity says that nothing is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Magnitude {
    fraction: f64,
    exponent: i64,
}

/// The binary exponent of a positive normal double: it is in `[2^e, 2^(e + 1))`.
fn exponent_of(x: f64) -> i64 {
    ((x.to_bits() >> 52) & 0x7ff) as i64 - 1023 // M0: 11 bits
}

/// `2^n` for a normal result.
fn power_of_two(n: i64) -> f64 {
    f64::from_bits(((n + 1023) as u64) << 52) // M0: from 1 to 2046
}

impl Magnitude {
    /// Nothing.
    pub const ZERO: Self = Self { fraction: 0.0, exponent: 0 };
    /// No bound.
    pub const INFINITE: Self = Self { fraction: f64::INFINITY, exponent: 0 };

    /// `|x| * 2^exponent`, rounded up below the normal range; a NaN is no bound.
    pub fn new(x: f64, exponent: i64) -> Self {
        // M0: exactly nothing
        if x == 0.0 {
            return Self::ZERO;
        }
        if !x.is_finite() {
            return Self::INFINITE;
        }
        let x = x.abs().max(f64::MIN_POSITIVE); // M0: the smallest normal double stands for less
        let own = exponent_of(x);
        Self { fraction: x * power_of_two(-own / 2) * power_of_two(-own - -own / 2), exponent: own + exponent }
    }

    /// `2^exponent`
    pub fn power_of_two(exponent: i64) -> Self {
        Self { fraction: 1.0, exponent }
    }

    /// Returns whether it is exactly 0.
    pub fn is_zero(self) -> bool {
        self.fraction == 0.0 // M0: exactly nothing
    }

    /// Returns whether it is finite, and so bounds something.
    pub fn is_finite(self) -> bool {
        self.fraction.is_finite()
    }

    /// `e` such that it is in `[2^e, 2^(e + 1))`; `None` for 0, the greatest number without a bound.
    pub fn exponent(self) -> Option<i64> {
        if self.is_finite() { (!self.is_zero()).then_some(self.exponent) } else { Some(i64::MAX / 4) }
    }

    /// `log2`, to nearest; minus infinity for 0.
    pub fn log2(self) -> f64 {
        self.fraction.log2() + self.exponent as f64 // shown
    }

    /// Returns it in units of `2^unit`, rounded up; at least the smallest normal double unless it is 0.
    pub fn in_units_of(self, unit: i64) -> f64 {
        if self.is_zero() || !self.is_finite() {
            return self.fraction;
        }
        match self.exponent - unit {
            shift @ -1022..=1022 => self.fraction * power_of_two(shift),
            ..-1022 => f64::MIN_POSITIVE,
            _ => f64::INFINITY,
        }
    }

    /// Returns it as a double, rounded up.
    pub fn to_f64(self) -> f64 {
        self.in_units_of(0)
    }

    /// `self / least` for a positive lower bound `least`, rounded up.
    pub fn over(self, least: Self) -> Self {
        if least.is_zero() {
            return Self::INFINITE;
        }
        Self::new(up(self.fraction / least.fraction), self.exponent - least.exponent)
    }

    /// The square root, rounded up.
    pub fn sqrt(self) -> Self {
        let odd = self.exponent.rem_euclid(2);
        let even = self.fraction * if odd == 1 { 2.0 } else { 1.0 };
        Self::new(up(even.sqrt()), (self.exponent - odd) / 2)
    }

    /// `self - b` rounded *down*; `None` unless it is positive.
    pub fn less(self, b: Self) -> Option<Self> {
        if b.is_zero() {
            return (!self.is_zero()).then_some(self);
        }
        let taken = b.in_units_of(self.exponent);
        let left = (self.fraction - taken).next_down();
        // A NaN is no lower bound.
        (left > 0.0).then(|| Self::new(left, self.exponent))
    }
}

impl Add for Magnitude {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        let (large, small) = if self.partial_cmp(&b) == Some(Ordering::Less) { (b, self) } else { (self, b) };
        if small.is_zero() {
            return large;
        }
        Self::new(up(large.fraction + small.in_units_of(large.exponent)), large.exponent)
    }
}

impl Mul for Magnitude {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self::new(up(self.fraction * b.fraction), self.exponent + b.exponent)
    }
}

impl PartialOrd for Magnitude {
    fn partial_cmp(&self, b: &Self) -> Option<Ordering> {
        match (self.exponent(), b.exponent()) {
            (None, None) => Some(Ordering::Equal),
            (None, Some(_)) => Some(Ordering::Less),
            (Some(_), None) => Some(Ordering::Greater),
            (Some(p), Some(q)) if p == q => self.fraction.partial_cmp(&b.fraction),
            (Some(p), Some(q)) => Some(p.cmp(&q)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use num_traits::Pow;
    use proptest::prelude::*;

    fn exact(x: Magnitude) -> BigRational {
        let power = BigRational::from_integer(2.into()).pow(x.exponent as i32);
        BigRational::from_float(x.fraction).unwrap() * power
    }

    fn magnitude() -> impl Strategy<Value = Magnitude> {
        prop_oneof![
            Just(Magnitude::ZERO),
            (0.0..4.0f64, -3000..3000i64).prop_map(|(x, e)| Magnitude::new(x, e)),
            (0.0..4.0f64, -3..3i64).prop_map(|(x, e)| Magnitude::new(x, e)),
        ]
    }

    proptest! {
        #[test]
        fn operations_round_to_their_side(a in magnitude(), b in magnitude()) {
            let (x, y) = (exact(a), exact(b));
            prop_assert!(exact(a + b) >= &x + &y && exact(a * b) >= &x * &y);
            prop_assert_eq!(a.partial_cmp(&b), Some(x.cmp(&y)));
            let root = exact(a.sqrt());
            prop_assert!(&root * &root >= x && (a.is_zero() || a.sqrt() * a.sqrt() <= a * Magnitude::new(1.0 + 1e-14, 0)));
            if let Some(left) = a.less(b) {
                prop_assert!(exact(left) <= &x - &y);
            }
            if !b.is_zero() {
                let (over, quotient) = (exact(a.over(b)), x / y);
                prop_assert!(over >= quotient && over <= quotient * BigRational::from_float(1.0 + 1e-15).unwrap());
            }
        }

        #[test]
        fn units_are_powers_of_two(a in magnitude(), unit in -2000..2000i64) {
            let there = a.in_units_of(unit);
            if there.is_finite() {
                prop_assert!(exact(Magnitude::new(there, unit)) >= exact(a));
            }
            let lost = a.exponent - unit < -1022;
            prop_assert!(lost || there.is_infinite() || Magnitude::new(there, unit) == a);
        }
    }

    #[test]
    fn the_last_binade_of_normal_doubles_is_kept() {
        let smallest = Magnitude::new(1.9, -1022);
        assert_eq!(smallest.to_f64(), 1.9 * f64::MIN_POSITIVE);
        assert_eq!(Magnitude::new(1.9, -1023).to_f64(), f64::MIN_POSITIVE);
        assert_eq!(smallest.in_units_of(-1022), 1.9);
    }

    #[test]
    fn no_bound_stays_none() {
        let none = Magnitude::new(f64::NAN, 0);
        let one = Magnitude::new(1.0, 0);
        assert!(
            !none.is_finite() && !(none + one).is_finite() && !(one + none).is_finite() && !(none * one).is_finite()
        );
        assert!(one < none && one.less(none).is_none() && !one.over(Magnitude::ZERO).is_finite());
    }
}
