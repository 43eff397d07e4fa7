//! The normal form `r * pi^k`: where it applies, arithmetic is exact and equality is decided.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::enclosure::Enclosure;

/// Fractions with longer numerators or denominators are left to the expression tree.
const LARGEST_FRACTION: u64 = 4096;
/// Powers of pi beyond this are left to the expression tree.
const LARGEST_PI_POWER: i32 = 10_000;

/// The number `rational * pi^pi_power`; zero has `pi_power` 0, so equal numbers are equal field by field (pi is transcendental).
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Monomial {
    pub(super) rational: BigRational,
    pub(super) pi_power: i32,
}

impl Monomial {
    /// The number `rational * pi^pi_power`.
    pub(super) fn new(rational: BigRational, pi_power: i32) -> Monomial {
        let pi_power = if rational.is_zero() { 0 } else { pi_power };
        Monomial { rational, pi_power }
    }

    /// The result of an arithmetic operation; `None` if it is too long for the normal form.
    fn if_moderate(rational: BigRational, pi_power: Option<i32>) -> Option<Monomial> {
        let pi_power = pi_power.filter(|power| power.abs() <= LARGEST_PI_POWER)?;
        (length(&rational) <= LARGEST_FRACTION).then(|| Monomial::new(rational, pi_power))
    }

    /// Whether a product or sum with this number may fit the normal form.
    fn is_moderate(&self) -> bool {
        length(&self.rational) <= 2 * LARGEST_FRACTION
    }

    /// The sign of the number.
    pub(super) fn sign(&self) -> Ordering {
        self.rational.cmp(&BigRational::zero())
    }

    /// True for zero only.
    pub(super) fn is_zero(&self) -> bool {
        self.rational.is_zero()
    }

    /// The fraction, if pi is not involved.
    pub(super) fn as_rational(&self) -> Option<&BigRational> {
        (self.pi_power == 0).then_some(&self.rational)
    }

    /// Encloses the number, to nearly `bits` bits relative.
    pub(super) fn enclose(&self, bits: u32) -> Enclosure {
        if self.pi_power == 0 {
            return Enclosure::from_rational(&self.rational, bits);
        }
        let guarded = bits.saturating_add(4); // X1: any number of bits encloses
        // log2 of the power more bits of pi, since the power multiplies its relative width.
        let pi = Enclosure::pi(guarded.saturating_add(self.pi_power.unsigned_abs().ilog2() + 1)); // X1
        let power = pi.powi(self.pi_power, guarded).expect("pi is not zero");
        power.mul(&Enclosure::from_rational(&self.rational, guarded), bits)
    }

    /// The exact negative.
    pub(super) fn negated(&self) -> Monomial {
        Monomial { rational: -&self.rational, pi_power: self.pi_power }
    }

    /// The exact sum, where it is a monomial.
    pub(super) fn plus(&self, other: &Monomial) -> Option<Monomial> {
        let same = self.pi_power == other.pi_power && self.is_moderate() && other.is_moderate();
        same.then(|| &self.rational + &other.rational).and_then(|sum| Monomial::if_moderate(sum, Some(self.pi_power)))
    }

    /// The exact product.
    pub(super) fn times(&self, other: &Monomial) -> Option<Monomial> {
        let product = (self.is_moderate() && other.is_moderate()).then(|| &self.rational * &other.rational)?;
        Monomial::if_moderate(product, self.pi_power.checked_add(other.pi_power))
    }

    /// The exact quotient; `None` also for a zero divisor.
    pub(super) fn over(&self, divisor: &Monomial) -> Option<Monomial> {
        let defined = !divisor.is_zero() && self.is_moderate() && divisor.is_moderate();
        let quotient = defined.then(|| &self.rational / &divisor.rational)?;
        Monomial::if_moderate(quotient, self.pi_power.checked_sub(divisor.pi_power))
    }

    /// The exact power with n >= 0, where it is of moderate size.
    pub(super) fn power(&self, n: u32) -> Option<Monomial> {
        // exact: what is cut off is refused
        let expected = length(&self.rational).saturating_sub(1).saturating_mul(u64::from(n));
        let n = i32::try_from(n).ok().filter(|_| expected <= LARGEST_FRACTION)?;
        Monomial::if_moderate(self.rational.pow(n), self.pi_power.checked_mul(n))
    }

    /// The exact square root, where it is a monomial.
    pub(super) fn square_root(&self) -> Option<Monomial> {
        let root = |x: &BigInt| {
            let root = (!x.is_negative()).then(|| x.sqrt())?;
            (&root * &root == *x).then_some(root)
        };
        if self.pi_power % 2 != 0 {
            return None;
        }
        let (numerator, denominator) = (root(self.rational.numer())?, root(self.rational.denom())?);
        // Roots of coprime squares are coprime.
        Some(Monomial::new(BigRational::new_raw(numerator, denominator), self.pi_power / 2))
    }

    /// The exact sine, where the number is a multiple of pi/6 with a rational sine (I. Niven, 1956: there are no others).
    pub(super) fn sine(&self) -> Option<Monomial> {
        sine_of_sixths(self.sixths_of_pi()?)
    }

    /// The exact cosine, as the sine of the number plus pi/2.
    pub(super) fn cosine(&self) -> Option<Monomial> {
        sine_of_sixths(self.sixths_of_pi()? + 3)
    }

    /// The integer from 0 to 11 whose multiple of pi/6 is the number modulo 2 pi; `None` if there is none.
    fn sixths_of_pi(&self) -> Option<u8> {
        if self.is_zero() {
            return Some(0);
        }
        if self.pi_power != 1 || !(BigInt::from(6u8) % self.rational.denom()).is_zero() {
            return None;
        }
        let sixths = (&self.rational * BigInt::from(6u8)).to_integer();
        sixths.mod_floor(&BigInt::from(12u8)).to_u8()
    }
}

/// sin(sixths * pi / 6), if rational.
fn sine_of_sixths(sixths: u8) -> Option<Monomial> {
    let halves = match sixths % 12 {
        0 | 6 => 0,
        1 | 5 => 1,
        3 => 2,
        7 | 11 => -1,
        9 => -2,
        _ => return None,
    };
    Some(Monomial::new(BigRational::new(halves.into(), BigInt::one() + 1), 0))
}

/// The bits of the longer of numerator and denominator.
fn length(x: &BigRational) -> u64 {
    x.numer().bits().max(x.denom().bits()) // exact: a length in bits
}

#[cfg(test)]
mod tests {
    use super::*;

    fn monomial(n: i64, d: i64, pi_power: i32) -> Monomial {
        Monomial::new(BigRational::new(n.into(), d.into()), pi_power)
    }

    #[test]
    fn sines_of_sixths_agree_with_their_enclosures() {
        for sixths in -30..30 {
            let angle = monomial(sixths, 6, 1);
            for (exact, enclosure) in
                [(angle.sine(), angle.enclose(80).sin(80)), (angle.cosine(), angle.enclose(80).cos(80))]
            {
                if let Some(exact) = exact {
                    assert!(enclosure.contains(&exact.rational), "{sixths}");
                } else {
                    assert!(!enclosure.contains(&BigRational::new(1.into(), 2.into())) && enclosure.sign().is_some());
                }
            }
        }
    }

    #[test]
    fn arithmetic_stays_in_normal_form_or_declines() {
        let (a, b) = (monomial(10, 1, 1), monomial(1, 2, 1));
        assert_eq!(a.plus(&b), Some(monomial(21, 2, 1)));
        assert_eq!(a.over(&b), Some(monomial(20, 1, 0)));
        assert_eq!(a.plus(&monomial(1, 1, 0)), None);
        assert_eq!(a.plus(&a.negated()), Some(monomial(0, 1, 0)));
        assert_eq!(monomial(9, 4, -2).square_root(), Some(monomial(3, 2, -1)));
        assert_eq!(monomial(2, 1, 0).square_root(), None);
        assert_eq!(monomial(3, 1, 0).power(10_000), None);
        assert_eq!(a.over(&monomial(0, 1, 0)), None);
    }
}
