//! Arithmetic on expressions: exact where the normal form allows it, a new tree node otherwise.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use super::enclosure::Enclosure;
use super::error::shortened;
use super::monomial::Monomial;
use super::{Exact, ExactError, Form, LARGEST_POWER, SIGN_BITS};

impl Exact {
    /// The sum. **Errors** if too deep or too large.
    pub fn checked_add(&self, other: &Exact) -> Result<Exact, ExactError> {
        match (self.as_monomial(), other.as_monomial()) {
            (Some(a), _) if a.is_zero() => return Ok(other.clone()),
            (_, Some(b)) if b.is_zero() => return Ok(self.clone()),
            (Some(a), Some(b)) => {
                if let Some(sum) = a.plus(b) {
                    return Ok(Exact::from_monomial(sum));
                }
            }
            _ => {}
        }
        Exact::from_form(Form::Sum(self.clone(), other.clone()))
    }

    /// The difference. **Errors** if too deep or too large.
    pub fn checked_sub(&self, other: &Exact) -> Result<Exact, ExactError> {
        match (self.as_monomial(), other.as_monomial()) {
            (Some(a), _) if a.is_zero() => return other.checked_neg(),
            (_, Some(b)) if b.is_zero() => return Ok(self.clone()),
            (Some(a), Some(b)) => {
                if let Some(difference) = a.plus(&b.negated()) {
                    return Ok(Exact::from_monomial(difference));
                }
            }
            _ => {}
        }
        Exact::from_form(Form::Difference(self.clone(), other.clone()))
    }

    /// The negative. **Errors** if too deep.
    pub fn checked_neg(&self) -> Result<Exact, ExactError> {
        match &self.node.form {
            Form::Monomial(monomial) => Ok(Exact::from_monomial(monomial.negated())),
            Form::Negative(x) => Ok(x.clone()),
            Form::Interval(lower, upper) => Exact::interval(&upper.checked_neg()?, &lower.checked_neg()?),
            _ => Exact::from_form(Form::Negative(self.clone())),
        }
    }

    /// The product. **Errors** if too deep or too large.
    pub fn checked_mul(&self, other: &Exact) -> Result<Exact, ExactError> {
        if let (Some(a), Some(b)) = (self.as_monomial(), other.as_monomial())
            && let Some(product) = a.times(b)
        {
            return Ok(Exact::from_monomial(product));
        }
        for (factor, rest) in [(self, other), (other, self)] {
            match factor.unit() {
                Some(Ordering::Equal) => return Ok(Exact::from(0)),
                Some(Ordering::Greater) => return Ok(rest.clone()),
                Some(Ordering::Less) => return rest.checked_neg(),
                None => {}
            }
        }
        Exact::from_form(Form::Product(self.clone(), other.clone()))
    }

    /// The quotient. **Errors** if the divisor cannot be proved nonzero at up to 4096 bits, or too deep or too large.
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// let third = Exact::from(1).checked_div(&Exact::from(3)).unwrap();
    /// assert_eq!(third.text(), "1/3");
    /// assert!(third.checked_div(&Exact::from(0)).is_err());
    /// ```
    pub fn checked_div(&self, divisor: &Exact) -> Result<Exact, ExactError> {
        let away_from_zero = prove(divisor, |x| matches!(x.sign(), Some(Ordering::Less | Ordering::Greater)))
            .ok_or_else(|| ExactError::DivisorMayBeZero { divisor: shortened(&divisor.text()) })?;
        if let (Some(a), Some(b)) = (self.as_monomial(), divisor.as_monomial())
            && let Some(quotient) = a.over(b)
        {
            return Ok(Exact::from_monomial(quotient));
        }
        match (self.unit(), divisor.unit()) {
            (Some(Ordering::Equal), _) => Ok(Exact::from(0)),
            (_, Some(Ordering::Greater)) => Ok(self.clone()),
            (_, Some(Ordering::Less)) => self.checked_neg(),
            _ => Exact::from_form(Form::Quotient(self.clone(), divisor.clone(), away_from_zero)),
        }
    }

    /// The integer power, with x^0 = 1. **Errors** for |n| > 10000, a negative power of what may be zero, too deep, too large.
    pub fn checked_powi(&self, n: i64) -> Result<Exact, ExactError> {
        if n.unsigned_abs() > LARGEST_POWER.unsigned_abs() {
            return Err(ExactError::ExponentTooLarge { exponent: n });
        }
        if n < 0 {
            return Exact::from(1).checked_div(&self.checked_powi(-n)?);
        }
        let unsigned = n as u32; // exact: 0 to 10000
        if let Some(power) = self.as_monomial().and_then(|x| x.power(unsigned)) {
            return Ok(Exact::from_monomial(power));
        }
        match &self.node.form {
            _ if n == 0 => Ok(Exact::from(1)),
            _ if n == 1 => Ok(self.clone()),
            // The radicand is proved nonnegative, so the square of its root is the radicand itself.
            Form::SquareRoot(x) if n % 2 == 0 => x.checked_powi(n / 2),
            _ => Exact::from_form(Form::Power(self.clone(), unsigned)),
        }
    }

    /// The square root. **Errors** if the value cannot be proved nonnegative at up to 4096 bits, or too deep.
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// assert_eq!(Exact::parse("4*pi^2/9").unwrap().checked_sqrt().unwrap().text(), "2/3*pi");
    /// ```
    pub fn checked_sqrt(&self) -> Result<Exact, ExactError> {
        if let Some(root) = self.as_monomial().and_then(Monomial::square_root) {
            return Ok(Exact::from_monomial(root));
        }
        match prove(self, |x| x.inf().sign().is_ge()) {
            Some(_) => Exact::from_form(Form::SquareRoot(self.clone())),
            None => Err(ExactError::NegativeRoot { radicand: shortened(&self.text()) }),
        }
    }

    /// The sine of the angle in radians. **Errors** if too deep.
    pub fn checked_sin(&self) -> Result<Exact, ExactError> {
        match self.as_monomial().and_then(Monomial::sine) {
            Some(sine) => Ok(Exact::from_monomial(sine)),
            None => Exact::from_form(Form::Sine(self.clone())),
        }
    }

    /// The cosine of the angle in radians. **Errors** if too deep.
    pub fn checked_cos(&self) -> Result<Exact, ExactError> {
        match self.as_monomial().and_then(Monomial::cosine) {
            Some(cosine) => Ok(Exact::from_monomial(cosine)),
            None => Exact::from_form(Form::Cosine(self.clone())),
        }
    }

    /// `Less`, `Equal`, `Greater` for the numbers -1, 0 and 1, else `None`.
    fn unit(&self) -> Option<Ordering> {
        let x = self.as_rational()?;
        let is_unit = x.is_integer() && x.numer().bits() <= 1;
        is_unit.then(|| x.numer().cmp(&num_bigint::BigInt::from(0)))
    }
}

/// The first enclosure of x at 64, 128, ... up to `SIGN_BITS` bits that has the property.
fn prove(x: &Exact, property: fn(&Enclosure) -> bool) -> Option<Enclosure> {
    let precisions = std::iter::successors(Some(64), |bits| Some(2 * bits)).take_while(|bits| *bits <= SIGN_BITS);
    precisions.map(|bits| x.evaluate(bits)).find(property)
}

/// Implements the operator of a checked operation, for values and references.
macro_rules! operator {
    ($trait:ident, $method:ident, $checked:ident, $($left:ty, $right:ty);*) => {$(
        #[doc = concat!("As [`", stringify!($checked), "`](Exact::", stringify!($checked), "); **panics** where that is an error.")]
        impl $trait<$right> for $left {
            type Output = Exact;
            fn $method(self, other: $right) -> Exact {
                match self.$checked(&other) {
                    Ok(result) => result,
                    Err(error) => panic!("exact arithmetic: {error}"),
                }
            }
        }
    )*};
}

operator!(Add, add, checked_add, Exact, Exact; Exact, &Exact; &Exact, Exact; &Exact, &Exact);
operator!(Sub, sub, checked_sub, Exact, Exact; Exact, &Exact; &Exact, Exact; &Exact, &Exact);
operator!(Mul, mul, checked_mul, Exact, Exact; Exact, &Exact; &Exact, Exact; &Exact, &Exact);

/// As [`checked_neg`](Exact::checked_neg); **panics** where that is an error.
impl Neg for &Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        match self.checked_neg() {
            Ok(result) => result,
            Err(error) => panic!("exact arithmetic: {error}"),
        }
    }
}

/// As [`checked_neg`](Exact::checked_neg); **panics** where that is an error.
impl Neg for Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        -&self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(text: &str) -> Exact {
        Exact::parse(text).unwrap()
    }

    #[test]
    fn neutral_elements_leave_no_trace() {
        let x = exact("sin(1)");
        for same in [
            &x + &Exact::from(0),
            Exact::from(0) + &x,
            &x * Exact::from(1),
            -(-&x),
            x.checked_div(&Exact::from(1)).unwrap(),
        ] {
            assert_eq!(same.text(), "sin(1)");
        }
        assert_eq!((&x * Exact::from(0)).as_rational(), Exact::from(0).as_rational());
        assert_eq!((&x * Exact::from(-1)).text(), "-sin(1)");
        assert_eq!(exact("sqrt(2)^4").text(), "sqrt(2)^4");
        assert_eq!(exact("sqrt(2)^4").as_rational(), Exact::from(4).as_rational());
    }

    #[test]
    fn undefined_operations_are_refused() {
        let zero_in_disguise = exact(crate::evaluate::tests::ZERO_IN_DISGUISE);
        assert!(matches!(exact("1").checked_div(&zero_in_disguise), Err(ExactError::DivisorMayBeZero { .. })));
        assert!(matches!(zero_in_disguise.checked_sqrt(), Err(ExactError::NegativeRoot { .. })));
        assert!(matches!(exact("1 - pi").checked_sqrt(), Err(ExactError::NegativeRoot { .. })));
        assert!(exact("[-1, 1]").checked_sqrt().is_err() && exact("[0, 1]").checked_sqrt().is_ok());
        assert!(exact("2").checked_div(&exact("[0, 1]")).is_err());
        assert!(exact("2").checked_powi(i64::MIN).is_err() && exact("0").checked_powi(-1).is_err());
    }
}
