//! Precision control: from the requested `bits` to an enclosure that is as narrow as promised.

use std::cmp::Ordering;

use num_rational::BigRational;
use num_traits::Zero;

use super::dyadic::Dyadic;
use super::enclosure::Enclosure;
use super::{Exact, ExactError, Form, Operation, SIGN_BITS};

/// The accuracy that every expression must reach when it is built, and the internal precision allowed for it.
const CONSTRUCTION_BITS: u32 = 32;
const CONSTRUCTION_PRECISION: u32 = 1 << 16;
/// Number of recent enclosures that a node keeps.
const CACHED_ENCLOSURES: usize = 4;
/// Longest numerator or denominator, in bits, for which a sign is decided by exact fractions.
const LONGEST_FRACTION: u64 = 1 << 18;

impl Exact {
    /// Encloses the value: the true number, or every number of the set, lies inside.
    ///
    /// **Enclosure** of a point x: at most `2^-bits |x|` wide, if x is proved nonzero with an internal precision of at most
    /// `16 bits + 4096`; otherwise (a zero in disguise, such as `cos(pi/5) - cos(2*pi/5) - 1/2`, or nearly so) that or at most
    /// `2^-(8 bits + 2048)` wide, whichever is reached first. A rational that fits is a point. With intervals, the width of the
    /// interval evaluation comes on top; for `[a, b]` itself the ends are enclosed as points are.
    ///
    /// The result depends on the expression and `bits` only, not on what was computed before.
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// let (lo, hi) = Exact::parse("sqrt(2)").unwrap().enclose(60).to_f64_bounds();
    /// assert_eq!((lo, hi), (std::f64::consts::SQRT_2.next_down(), std::f64::consts::SQRT_2));
    /// ```
    pub fn enclose(&self, bits: u32) -> Enclosure {
        if let Form::Interval(lower, upper) = &self.node.form {
            return lower.enclose(bits).hull(&upper.enclose(bits));
        }
        // Construction proved that 65536 bits reach the linear regime, in which every further bit pays; so the budget is not met.
        // X1: any number of bits encloses
        let budget = bits.saturating_mul(32).saturating_add(4 * CONSTRUCTION_PRECISION);
        let (enclosure, _) = self.settle(bits, budget);
        enclosure.rounded(bits.saturating_add(3)) // X1
    }

    /// The first enclosure of a new expression, or the reason for refusing it.
    pub(super) fn settle_at_construction(&self) -> Result<Enclosure, ExactError> {
        match self.settle(CONSTRUCTION_BITS, CONSTRUCTION_PRECISION) {
            (enclosure, true) => Ok(enclosure),
            (_, false) => Err(ExactError::TooIllConditioned),
        }
    }

    /// Raises the internal precision until an enclosure is narrow enough for `bits`; the flag is whether `budget` bits sufficed.
    fn settle(&self, bits: u32, budget: u32) -> (Enclosure, bool) {
        if !self.is_point() {
            return (self.settle_set(bits, budget), true);
        }
        let doubtful = bits.saturating_mul(16).saturating_add(4096); // X1: any number of bits encloses
        let mut precision = bits.saturating_add(32); // X1
        let mut nonzero_in_time = false;
        loop {
            let enclosure = self.evaluate(precision);
            nonzero_in_time |= precision <= doubtful && !enclosure.mig().is_zero();
            let width = enclosure.wid();
            // One bit better than promised, which pays for the final rounding to bits + 3 bits.
            let relative = width <= enclosure.mig().scaled(-i64::from(bits) - 1);
            let absolute = width <= Dyadic::power_of_two(-8 * i64::from(bits) - 2049);
            if relative || (absolute && !nonzero_in_time && precision >= doubtful) {
                return (enclosure, true);
            }
            if precision >= budget {
                return (enclosure, false);
            }
            let next = precision.saturating_mul(2); // X1
            precision = if precision < doubtful { next.min(doubtful) } else { next }.min(budget); // X1
        }
    }

    /// Raises the internal precision until the enclosure of a set stops shrinking by a noticeable part of its magnitude.
    fn settle_set(&self, bits: u32, budget: u32) -> Enclosure {
        let mut precision = bits.saturating_add(64).min(budget); // X1: any number of bits encloses
        let mut enclosure = self.evaluate(precision);
        while precision < budget {
            precision = precision.saturating_mul(2).min(budget); // X1
            let finer = self.evaluate(precision);
            let noticeable = finer.mag().scaled(-i64::from(bits) - 1);
            let shrinks = enclosure.wid() > finer.wid().plus(&noticeable, 64, super::dyadic::Round::Up);
            enclosure = finer;
            if !shrinks {
                break;
            }
        }
        enclosure
    }

    /// Encloses the value with every operation carried out at `bits` mantissa bits; the width is what comes out.
    pub(super) fn evaluate(&self, bits: u32) -> Enclosure {
        // NOTE: the lock is not held during the evaluation below, so no order of locks can deadlock.
        let recent = || self.node.recent.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if let Some((_, known)) = recent().iter().find(|(known_bits, _)| *known_bits == bits) {
            return known.clone();
        }
        let fresh = self.evaluate_form(bits);
        let enclosure = match self.node.base.get() {
            Some(base) => fresh.intersection(base).expect("two enclosures of one value have a point in common"),
            None => fresh,
        };
        let mut recent = recent();
        if recent.len() == CACHED_ENCLOSURES {
            recent.remove(0);
        }
        recent.push((bits, enclosure.clone()));
        enclosure
    }

    /// One level of the evaluation.
    fn evaluate_form(&self, bits: u32) -> Enclosure {
        match &self.node.form {
            Form::Monomial(monomial) => monomial.enclose(bits),
            Form::Interval(a, b) => a.evaluate(bits).hull(&b.evaluate(bits)),
            Form::Negative(x) => x.evaluate(bits).negated(),
            Form::Sum(a, b) => a.evaluate(bits).add(&b.evaluate(bits), bits),
            Form::Difference(a, b) => a.evaluate(bits).sub(&b.evaluate(bits), bits),
            Form::Product(a, b) => a.evaluate(bits).mul(&b.evaluate(bits), bits),
            Form::Quotient(a, b, away_from_zero) => {
                let divisor = b.evaluate(bits).intersection(away_from_zero).expect("both hold the divisor");
                a.evaluate(bits).div(&divisor, bits).expect("proved nonzero at construction")
            }
            // exact: at most 10000
            Form::Power(x, n) => x.evaluate(bits).powi(*n as i32, bits).expect("the exponent is positive"),
            Form::SquareRoot(x) => {
                // Proved nonnegative at construction, so a part below zero at this precision can be cut off.
                let x = x.evaluate(bits);
                let lo = x.inf().max(&Dyadic::zero()).clone(); // X1: nothing of it lies below 0
                let radicand = Enclosure::new(lo, x.sup().clone()).expect("the radicand is not negative");
                radicand.sqrt(bits).expect("cut off at zero")
            }
            Form::Sine(x) => x.evaluate(bits).sin(bits),
            Form::Cosine(x) => x.evaluate(bits).cos(bits),
        }
    }

    /// The proved sign of the number, or of every number of the set; `None` if it cannot be decided at up to 4096 bits.
    ///
    /// `Equal` is answered only where a normal form shows a zero (Lemma X2).
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// use std::cmp::Ordering;
    /// assert_eq!(Exact::parse("pi - 355/113").unwrap().sign(), Some(Ordering::Less));
    /// assert_eq!(Exact::parse("sin(7*pi)").unwrap().sign(), Some(Ordering::Equal));
    /// assert_eq!(Exact::parse("[-1, 2]").unwrap().sign(), None);
    /// ```
    pub fn sign(&self) -> Option<Ordering> {
        match &self.node.form {
            Form::Monomial(monomial) => return Some(monomial.sign()),
            Form::Interval(lower, upper) => {
                return match (lower.sign(), upper.sign()) {
                    (Some(Ordering::Greater), _) => Some(Ordering::Greater),
                    (_, Some(Ordering::Less)) => Some(Ordering::Less),
                    _ => None,
                };
            }
            _ => {}
        }
        let mut bits = 64;
        while bits <= SIGN_BITS {
            match self.evaluate(bits).sign() {
                Some(Ordering::Equal) | None => bits *= 2,
                decided => return decided,
            }
        }
        self.fraction().map(|x| x.cmp(&BigRational::zero()))
    }

    /// The exact value of an expression of fractions, for any length up to the limit: `1 - 10^-4000` differs from 1.
    fn fraction(&self) -> Option<BigRational> {
        self.fold(&mut |operation: Operation<'_, Option<BigRational>>| {
            let fraction = match operation {
                Operation::Rational(x) => x.clone(),
                Operation::Negative(a) => -a?,
                Operation::Sum(a, b) => a? + b?,
                Operation::Difference(a, b) => a? - b?,
                Operation::Product(a, b) => a? * b?,
                _ => return None,
            };
            (fraction.numer().bits().max(fraction.denom().bits()) <= LONGEST_FRACTION).then_some(fraction) // exact: a length
        })
    }

    /// The proved order of two numbers, or of all numbers of one set and all of the other; `None` as for [`sign`](Exact::sign).
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// use std::cmp::Ordering;
    /// let gap = Exact::parse("[9.42, 9.43]").unwrap();
    /// assert_eq!(gap.compare(&Exact::from(9)), Some(Ordering::Greater));
    /// assert_eq!(gap.compare(&(Exact::from(3) * Exact::pi())), None); // some are smaller, some larger
    /// ```
    pub fn compare(&self, other: &Exact) -> Option<Ordering> {
        if let (Some(a), Some(b)) = (self.as_monomial(), other.as_monomial())
            && a.pi_power == b.pi_power
        {
            return Some(a.rational.cmp(&b.rational));
        }
        if self.is_point() && std::sync::Arc::ptr_eq(&self.node, &other.node) {
            return Some(Ordering::Equal);
        }
        if let (Some((a, b)), Some((c, d))) = (self.ends(), other.ends())
            && !(self.is_point() && other.is_point())
        {
            return match (b.compare(&c), a.compare(&d)) {
                (Some(Ordering::Less), _) => Some(Ordering::Less),
                (_, Some(Ordering::Greater)) => Some(Ordering::Greater),
                _ => None,
            };
        }
        self.checked_sub(other).ok()?.sign()
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The normal form knows no roots of unity but twelfths.
    pub(crate) const ZERO_IN_DISGUISE: &str = "cos(pi/5) - cos(2*pi/5) - 1/2";

    fn exact(text: &str) -> Exact {
        Exact::parse(text).unwrap()
    }

    /// Asserts the documented width for a number that is not zero.
    fn assert_relative(x: &Exact, bits: u32) {
        let enclosure = x.enclose(bits);
        assert!(enclosure.wid() <= enclosure.mig().scaled(-i64::from(bits)), "{x} at {bits} bits: {enclosure:?}");
    }

    #[test]
    fn relative_width_is_kept_through_cancellation() {
        for text in [
            "1e-300",
            "pi",
            "sin(1e22)",
            "sin(1e300)",
            "(1 + 1e-200*pi) - 1",
            "sin(pi*(1 + 1e-500))",
            "sqrt(2) - 1.41421356",
            "cos(1)^1000",
        ] {
            for bits in [1, 2, 30, 53, 64, 400] {
                assert_relative(&exact(text), bits);
            }
        }
    }

    #[test]
    fn a_zero_in_disguise_is_enclosed_absolutely() {
        let zero = exact(ZERO_IN_DISGUISE);
        for bits in [1, 64, 200] {
            let enclosure = zero.enclose(bits);
            assert!(enclosure.contains(&num_rational::BigRational::from_integer(0.into())));
            assert!(enclosure.wid() <= Dyadic::power_of_two(-8 * i64::from(bits) - 2048));
        }
        assert_eq!(zero.sign(), None);
        assert_eq!(zero.compare(&exact("1e-900")), Some(Ordering::Less));
        assert_eq!(zero.compare(&exact("1e-9000")), None);
    }

    #[test]
    fn extreme_expressions_stay_within_reason() {
        // Each of these would need or produce astronomically many bits if evaluated naively.
        let large_zero = "(1e300*cos(pi/5) - 1e300*cos(2*pi/5) - 5e299)";
        let x = exact(&format!("(((({large_zero}^10000)^10000)^10000)^10000)^10000"));
        assert!(x.enclose(64).wid() < Dyadic::power_of_two(-2000));
        assert!(Exact::parse("(((2^10000)^10000)^10000)^10000").is_err());
        let tiny = exact("(((0.5^10000)^10000)^10000)^10000");
        assert!(tiny.enclose(10).inf().sign().is_ge());
    }

    #[test]
    fn hopeless_cancellation_is_refused() {
        let refusal = Exact::parse("sin(1e9000*sin(1e9000*sin(1e9000*sin(1))))").unwrap_err();
        assert_eq!(refusal.undefined(), Some(&ExactError::TooIllConditioned));
    }

    #[test]
    fn sets_are_enclosed_with_all_their_members() {
        let x = exact("[9.42, 9.43]");
        let halves = x.checked_div(&Exact::from(2)).unwrap();
        let enclosure = halves.enclose(80);
        assert!(
            enclosure.contains(exact("4.71").as_rational().unwrap())
                && enclosure.contains(exact("4.715").as_rational().unwrap())
        );
        assert!(enclosure.wid() <= exact("0.0050000001").enclose(60).sup().clone());
        assert!((&x - &x).sign().is_none() && !(&x - &x).is_point());
        assert_eq!((-&x).sign(), Some(Ordering::Less));
    }

    #[test]
    fn order_is_decided_where_it_can_be() {
        assert_eq!(exact("1e-400").compare(&Exact::from(0)), Some(Ordering::Greater));
        assert_eq!(exact("22/7").compare(&Exact::pi()), Some(Ordering::Greater));
        assert_eq!(exact("1 - 1e-9000").compare(&exact("1")), Some(Ordering::Less));
        assert_eq!(exact("sqrt(2)").compare(&exact("sqrt(8)/2")), Some(Ordering::Equal));
        assert_eq!(exact("cos(pi/5)").compare(&exact("cos(2*pi/5) + 1/2")), None);
        assert_eq!(exact("[1, 2]").compare(&exact("[2, 3]")), None);
        assert_eq!(exact("[1, 2]").compare(&exact("[2.0001, 3]")), Some(Ordering::Less));
    }

    /// Random expressions, as text.
    pub(crate) fn texts() -> impl Strategy<Value = String> {
        let leaf = prop_oneof![Just("pi".to_owned()), "[0-9]{1,3}", "[0-9]{1,2}\\.[0-9]{1,3}(e-?[0-9])?"];
        leaf.prop_recursive(4, 24, 2, |inner| {
            prop_oneof![
                (inner.clone(), "[-+*/]", inner.clone()).prop_map(|(a, op, b)| format!("({a}){op}({b})")),
                (inner.clone(), "[-+*/]", inner.clone()).prop_map(|(a, op, b)| format!("{a} {op} {b}")),
                (inner.clone(), -3i32..4).prop_map(|(a, n)| format!("({a})^{n}")),
                (inner, "-|sin|cos|sqrt").prop_map(|(a, f)| format!("{f}({a})")),
            ]
        })
    }

    proptest! {
        #[test]
        fn coarse_enclosures_contain_fine_ones(text in texts(), bits in 1u32..80) {
            if let Ok(x) = Exact::parse(&text) {
                let coarse = x.enclose(bits);
                let fine = x.enclose(400);
                prop_assert!(coarse.contains_enclosure(&fine), "{text}: {coarse:?} {fine:?}");
                if let Some(value) = x.as_rational() {
                    prop_assert!(coarse.contains(value) && fine.contains(value));
                }
            }
        }

        #[test]
        fn printed_expressions_read_back_to_the_same_value(text in texts()) {
            if let Ok(x) = Exact::parse(&text) {
                prop_assert_eq!(x.text(), text.as_str());
                let canonical = x.canonical();
                let again = Exact::parse(&canonical).map_err(|error| TestCaseError::fail(format!("{canonical}: {error}")))?;
                prop_assert_eq!(again.canonical(), canonical);
                prop_assert_eq!(again.as_rational(), x.as_rational());
                prop_assert!(again.enclose(100).intersection(&x.enclose(100)).is_some());
            }
        }
    }
}
