//! Outward-rounded interval arithmetic with dyadic end points of any precision.
//!
//! Every operation takes `bits`, the mantissa length its end points are rounded to, and returns a superset: for all x in X
//! and y in Y, x op y lies in the result. Nothing here goes through a double; doubles appear only as the last conversion.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::dyadic::{Dyadic, Round, compare_rational, divide, scale_to_integer};

/// `floor` and `width` give up beyond `2^LARGEST_INTEGER` rather than fill the memory with one integer.
const LARGEST_INTEGER: i64 = 1 << 24;

/// The closed interval `[lo, hi]` of real numbers, with dyadic ends and `lo <= hi`.
///
/// ```
/// use impact_pair_exact::Enclosure;
/// let pi = Enclosure::pi(100);
/// let (lo, hi) = pi.to_f64_bounds();
/// assert_eq!(lo, std::f64::consts::PI); // the double just below pi
/// assert_eq!(hi, lo.next_up());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Enclosure {
    lo: Dyadic,
    hi: Dyadic,
}

impl Enclosure {
    /// The interval `[lo, hi]`; `None` if `lo > hi`.
    pub fn new(lo: Dyadic, hi: Dyadic) -> Option<Enclosure> {
        (lo <= hi).then_some(Enclosure { lo, hi })
    }

    /// The single point `x`.
    pub fn point(x: Dyadic) -> Enclosure {
        Enclosure { lo: x.clone(), hi: x }
    }

    /// Encloses the fraction, in ends of `bits` bits; a point if the fraction fits.
    pub fn from_rational(x: &BigRational, bits: u32) -> Enclosure {
        let end = |round| divide(x.numer(), x.denom(), bits, round).rounded(bits, round);
        Enclosure { lo: end(Round::Down), hi: end(Round::Up) }
    }

    /// The interval between two doubles, exactly; `None` for NaN, an infinity or `lo > hi`.
    pub fn from_f64_bounds(lo: f64, hi: f64) -> Option<Enclosure> {
        Enclosure::new(Dyadic::from_f64(lo)?, Dyadic::from_f64(hi)?)
    }

    /// The lower end.
    pub fn inf(&self) -> &Dyadic {
        &self.lo
    }

    /// The upper end.
    pub fn sup(&self) -> &Dyadic {
        &self.hi
    }

    /// True if both ends agree: the value is known exactly.
    pub fn is_point(&self) -> bool {
        self.lo == self.hi
    }

    /// Encloses x + y.
    pub fn add(&self, other: &Enclosure, bits: u32) -> Enclosure {
        Enclosure { lo: self.lo.plus(&other.lo, bits, Round::Down), hi: self.hi.plus(&other.hi, bits, Round::Up) }
    }

    /// Encloses x - y.
    pub fn sub(&self, other: &Enclosure, bits: u32) -> Enclosure {
        self.add(&other.negated(), bits)
    }

    /// Encloses -x, exactly.
    pub fn negated(&self) -> Enclosure {
        Enclosure { lo: self.hi.negated(), hi: self.lo.negated() }
    }

    /// Encloses x * y.
    pub fn mul(&self, other: &Enclosure, bits: u32) -> Enclosure {
        // A bilinear function takes its extrema on a box at the corners; signs tell at which.
        let ([a, b], [c, d]) = ([&self.lo, &self.hi], [&other.lo, &other.hi]);
        let [is_left, is_right] = [self, other].map(|x| x.hi.sign().is_lt());
        let (lo, hi) = match (!self.lo.sign().is_lt(), is_left, !other.lo.sign().is_lt(), is_right) {
            (true, _, true, _) => (a.times(c), b.times(d)),
            (true, _, _, true) => (b.times(c), a.times(d)),
            (true, ..) => (b.times(c), b.times(d)),
            (_, true, true, _) => (a.times(d), b.times(c)),
            (_, true, _, true) => (b.times(d), a.times(c)),
            (_, true, ..) => (a.times(d), a.times(c)),
            (_, _, true, _) => (a.times(d), b.times(d)),
            (_, _, _, true) => (b.times(c), a.times(c)),
            // X1: the least corner, the greatest corner
            _ => (a.times(d).min(b.times(c)), a.times(c).max(b.times(d))),
        };
        Enclosure { lo: lo.rounded(bits, Round::Down), hi: hi.rounded(bits, Round::Up) }
    }

    /// Encloses x / y; `None` if y may be zero.
    pub fn div(&self, other: &Enclosure, bits: u32) -> Option<Enclosure> {
        match other.sign()? {
            Ordering::Equal => None,
            Ordering::Less => self.negated().div(&other.negated(), bits),
            Ordering::Greater => {
                // y > 0: each end of x is divided by the end of y that pulls it outward.
                let low_divisor = if self.lo.sign().is_lt() { &other.lo } else { &other.hi };
                let high_divisor = if self.hi.sign().is_lt() { &other.hi } else { &other.lo };
                Some(Enclosure {
                    lo: self.lo.over(low_divisor, bits, Round::Down),
                    hi: self.hi.over(high_divisor, bits, Round::Up),
                })
            }
        }
    }

    /// Encloses x^n (with x^0 = 1); `None` if n < 0 and x may be zero.
    pub fn powi(&self, n: i32, bits: u32) -> Option<Enclosure> {
        // Each of the at most 2 * 32 roundings below costs less than an ulp relative, and squaring doubles what is
        // there: n ulps in all, so log2 n + 3 guard bits keep the result within a few ulps.
        let guarded = bits.saturating_add(3 + n.unsigned_abs().max(1).ilog2()); // X1: any number of bits encloses
        if n < 0 {
            let power = self.powi_unsigned(n.unsigned_abs(), guarded);
            return Enclosure::point(Dyadic::power_of_two(0)).div(&power, bits);
        }
        Some(self.powi_unsigned(n.unsigned_abs(), guarded).rounded(bits))
    }

    /// Encloses x^n by the monotone pieces of the power.
    fn powi_unsigned(&self, n: u32, bits: u32) -> Enclosure {
        let power = |x: &Dyadic, round| power_of_magnitude(&x.magnitude(), n, bits, round);
        let even = n.is_multiple_of(2);
        match (self.lo.sign().is_lt(), self.hi.sign().is_lt()) {
            (false, _) => Enclosure { lo: power(&self.lo, Round::Down), hi: power(&self.hi, Round::Up) },
            (true, true) if even => Enclosure { lo: power(&self.hi, Round::Down), hi: power(&self.lo, Round::Up) },
            (true, true) => self.negated().powi_unsigned(n, bits).negated(),
            (true, false) if n == 0 => Enclosure::point(Dyadic::power_of_two(0)),
            (true, false) if even => {
                let hi = power(&self.lo, Round::Up).max(power(&self.hi, Round::Up)); // X1: the greater end
                Enclosure { lo: Dyadic::zero(), hi }
            }
            (true, false) => Enclosure { lo: power(&self.lo, Round::Up).negated(), hi: power(&self.hi, Round::Up) },
        }
    }

    /// Superset with ends of at most `bits` mantissa bits.
    pub fn rounded(&self, bits: u32) -> Enclosure {
        Enclosure { lo: self.lo.clone().rounded(bits, Round::Down), hi: self.hi.clone().rounded(bits, Round::Up) }
    }

    /// The smallest interval that holds both intervals.
    pub fn hull(&self, other: &Enclosure) -> Enclosure {
        Enclosure { lo: (&self.lo).min(&other.lo).clone(), hi: (&self.hi).max(&other.hi).clone() } // X1: the outer ends
    }

    /// The common part of both intervals; `None` if they are disjoint.
    pub fn intersection(&self, other: &Enclosure) -> Option<Enclosure> {
        Enclosure::new((&self.lo).max(&other.lo).clone(), (&self.hi).min(&other.hi).clone()) // X1: the inner ends
    }

    /// True if the fraction lies inside, endpoints included.
    pub fn contains(&self, x: &BigRational) -> bool {
        compare_rational(&self.lo, x).is_le() && compare_rational(&self.hi, x).is_ge()
    }

    /// True if every point of `other` lies inside, endpoints included.
    pub fn contains_enclosure(&self, other: &Enclosure) -> bool {
        self.lo <= other.lo && other.hi <= self.hi
    }

    /// Upper bound of `hi - lo`, at most `2^-63` too large in relative terms; zero for a point.
    pub fn wid(&self) -> Dyadic {
        self.hi.plus(&self.lo.negated(), 64, Round::Up)
    }

    /// The sign that all points share; `None` if their signs differ.
    pub fn sign(&self) -> Option<Ordering> {
        (self.lo.sign() == self.hi.sign()).then(|| self.lo.sign())
    }

    /// The smallest absolute value of a point inside.
    pub fn mig(&self) -> Dyadic {
        match (self.lo.sign(), self.hi.sign()) {
            (Ordering::Greater, _) => self.lo.clone(),
            (_, Ordering::Less) => self.hi.negated(),
            _ => Dyadic::zero(),
        }
    }

    /// The largest absolute value of a point inside.
    pub fn mag(&self) -> Dyadic {
        self.lo.magnitude().max(self.hi.magnitude()) // X1: the farther end
    }

    /// The largest double not above and the smallest double not below; infinite beyond the finite doubles.
    pub fn to_f64_bounds(&self) -> (f64, f64) {
        (self.lo.to_f64_down(), self.hi.to_f64_up())
    }

    /// A finite double near the middle, and an upper bound of its distance to every point inside (infinite if the ends are too far
    /// beyond the doubles).
    pub fn mid_rad(&self) -> (f64, f64) {
        let sum = self.lo.plus(&self.hi, 64, Round::Down).scaled(-1);
        // Either neighbour serves, since the radius is measured from the one chosen; this one is always finite.
        let mid = if sum.sign().is_lt() { sum.to_f64_up() } else { sum.to_f64_down() };
        let middle = Dyadic::from_f64(mid).unwrap_or_else(Dyadic::zero);
        let left = middle.plus(&self.lo.negated(), 64, Round::Up);
        let right = self.hi.plus(&middle.negated(), 64, Round::Up);
        (mid, left.max(right).to_f64_up().max(0.0)) // X1: the farther end; 0 has no sign
    }

    /// The integer part (rounded down) that all points share; `None` if their integer parts differ, or beyond `2^(2^24)`.
    pub fn floor(&self) -> Option<BigInt> {
        if self.mag().top().is_some_and(|top| top > LARGEST_INTEGER) {
            return None;
        }
        let floor = |x: &Dyadic| scale_to_integer(x.mantissa(), x.exponent(), Round::Down);
        let (lo, hi) = (floor(&self.lo), floor(&self.hi));
        (lo == hi).then_some(lo)
    }
}

/// x^n for x >= 0, on the side that `round` says: a product of nonnegative bounds bounds the product.
fn power_of_magnitude(x: &Dyadic, n: u32, bits: u32, round: Round) -> Dyadic {
    let mut power = Dyadic::power_of_two(0);
    for position in (0..u32::BITS - n.leading_zeros()).rev() {
        power = power.times(&power).rounded(bits, round);
        if n >> position & 1 == 1 {
            power = power.times(x).rounded(bits, round);
        }
    }
    power
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Intervals biased to corners: points, ends at zero, tiny and large magnitudes.
    fn intervals() -> impl Strategy<Value = Enclosure> {
        let end = prop_oneof![Just(0i64), -9i64..9, any::<i64>()];
        (end.clone(), end, -80i64..20, any::<bool>()).prop_map(|(a, b, e, point)| {
            let b = if point { a } else { b };
            Enclosure { lo: Dyadic::new(a.min(b).into(), e), hi: Dyadic::new(a.max(b).into(), e) }
        })
    }

    /// The point at a fraction `part` / 256 of the way from lo to hi.
    fn inside(x: &Enclosure, part: u8) -> BigRational {
        let (lo, hi) = (x.lo.to_rational(), x.hi.to_rational());
        &lo + (hi - &lo) * BigRational::new(part.into(), 255.into())
    }

    #[test]
    fn a_product_is_between_its_extreme_corners() {
        let all = || (-2..=2).flat_map(|low| (low..=2).map(move |high| [low, high]));
        let of = |[low, high]: [i32; 2]| Enclosure { lo: Dyadic::new(low.into(), 0), hi: Dyadic::new(high.into(), 0) };
        for (a, b) in all().flat_map(|a| all().map(move |b| (a, b))) {
            let corners = a.map(|x| b.map(|y| x * y)).concat();
            let ends = [corners.iter().min(), corners.iter().max()].map(|end| *end.unwrap());
            assert_eq!(of(a).mul(&of(b), 9), of(ends), "{a:?} {b:?}");
        }
    }

    proptest! {
        #[test]
        fn field_operations_contain_the_exact_results(x in intervals(), y in intervals(), s: u8, t: u8, bits in 2u32..80, n in -9i32..10) {
            let (a, b) = (inside(&x, s), inside(&y, t));
            prop_assert!(x.contains(&a) && y.contains(&b));
            prop_assert!(x.add(&y, bits).contains(&(&a + &b)));
            prop_assert!(x.sub(&y, bits).contains(&(&a - &b)));
            prop_assert!(x.mul(&y, bits).contains(&(&a * &b)));
            prop_assert!(x.hull(&y).contains_enclosure(&x) && x.hull(&y).contains(&b));
            match x.div(&y, bits) {
                Some(quotient) => prop_assert!(quotient.contains(&(&a / &b))),
                None => prop_assert!(y.sign().is_none_or(|sign| sign.is_eq())),
            }
            match x.powi(n, bits) {
                Some(power) => prop_assert!(power.contains(&a.pow(n))),
                None => prop_assert!(n < 0 && x.sign().is_none_or(|sign| sign.is_eq())),
            }
            if let Some(root) = x.sqrt(bits) {
                prop_assert!(root.mul(&root, 300).contains(&a));
            }
            prop_assert!(Enclosure::from_rational(&a, bits).contains(&a));
        }

        #[test]
        fn conversions_to_doubles_bracket(x in intervals(), s: u8) {
            let a = inside(&x, s);
            let (lo, hi) = x.to_f64_bounds();
            prop_assert!(Enclosure::from_f64_bounds(lo, hi).unwrap().contains_enclosure(&x));
            let (mid, rad) = x.mid_rad();
            let (mid, rad) = (Dyadic::from_f64(mid).unwrap().to_rational(), Dyadic::from_f64(rad).unwrap().to_rational());
            prop_assert!(&mid - &rad <= a && a <= mid + rad);
            if let Some(floor) = x.floor() {
                prop_assert_eq!(BigRational::from_integer(floor), a.floor());
            }
        }

        #[test]
        fn sine_of_an_interval_contains_the_sine_of_its_points(x in intervals(), s: u8, bits in 8u32..80) {
            let point = Enclosure::from_rational(&inside(&x, s), 200);
            prop_assert!(x.sin(bits).contains_enclosure(&point.sin(200).rounded(190)) || x.is_point());
            prop_assert!(x.cos(bits).contains_enclosure(&point.cos(200).rounded(190)) || x.is_point());
        }
    }

    #[test]
    fn overflow_to_doubles_is_infinite_and_outward() {
        let huge = Enclosure::point(Dyadic::power_of_two(5000));
        assert_eq!(huge.to_f64_bounds(), (f64::MAX, f64::INFINITY));
        assert_eq!(huge.mid_rad(), (f64::MAX, f64::INFINITY));
        assert_eq!(Enclosure::point(Dyadic::power_of_two(-5000)).mid_rad(), (0.0, 5e-324));
    }

    #[test]
    fn powers_are_tight() {
        let x = Enclosure::point(Dyadic::from_f64(1.1).unwrap());
        let power = x.powi(10_000, 100).unwrap();
        assert!(power.wid() <= power.inf().scaled(-97));
    }
}
