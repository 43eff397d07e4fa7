//! Fractions between exact numbers, as their expressions show them: `3*sqrt(2)` is three times `sqrt(2)`.

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::{Exact, Form};

/// A number as a fraction times powers of factors that are not products themselves, in a fixed order.
struct Product {
    fraction: BigRational,
    pi_power: i64,
    /// The expressions of the factors and their powers.
    factors: Vec<(String, i64)>,
}

impl Exact {
    /// `self / other` as a fraction, where the expressions show that it is one.
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// let ratio = |a: &str, b: &str| Exact::parse(a).unwrap().fraction_of(&Exact::parse(b).unwrap());
    /// assert_eq!(ratio("3*pi", "2*pi").unwrap().to_string(), "3/2");
    /// assert_eq!(ratio("sqrt(2)*pi/5", "pi*sqrt(2)").unwrap().to_string(), "1/5");
    /// assert_eq!(ratio("pi", "1"), None);
    /// ```
    pub fn fraction_of(&self, other: &Exact) -> Option<BigRational> {
        // An interval stands for another value at each place.
        if !(self.is_point() && other.is_point()) {
            return None;
        }
        let (a, b) = (Product::of(self), Product::of(other));
        let is_same = a.pi_power == b.pi_power && a.factors == b.factors;
        (is_same && !b.fraction.is_zero()).then(|| a.fraction / b.fraction)
    }
}

impl Product {
    fn of(x: &Exact) -> Self {
        let mut product = Self { fraction: BigRational::one(), pi_power: 0, factors: Vec::new() };
        product.multiply(x, 1);
        product.factors.retain(|(_, power)| *power != 0);
        product.factors.sort();
        product
    }

    /// Multiplies by `x^power`.
    fn multiply(&mut self, x: &Exact, power: i64) {
        match &x.node.form {
            Form::Monomial(monomial) => {
                let fraction = if power > 0 { monomial.rational.clone() } else { monomial.rational.recip() };
                for _ in 0..power.unsigned_abs() {
                    self.fraction *= &fraction;
                }
                self.pi_power += power * i64::from(monomial.pi_power);
            }
            Form::Negative(a) => {
                self.multiply(a, power);
                if power % 2 != 0 {
                    self.fraction = -&self.fraction;
                }
            }
            Form::Product(a, b) => {
                self.multiply(a, power);
                self.multiply(b, power);
            }
            Form::Quotient(a, b, _) => {
                self.multiply(a, power);
                self.multiply(b, -power);
            }
            _ => {
                // Of one value written in two ways, `1*sqrt(2)` and `sqrt(2)`, the expression.
                let text = Exact { node: x.node.clone(), written: None }.text();
                match self.factors.iter_mut().find(|(factor, _)| *factor == text) {
                    Some((_, known)) => *known += power,
                    None => self.factors.push((text, power)),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_found_where_they_show_and_nowhere_else() {
        let ratio = |a: &str, b: &str| {
            let value = |text: &str| Exact::parse(text).unwrap();
            value(a).fraction_of(&value(b)).map(|x| x.to_string())
        };
        let some = |text: &str| Some(text.to_owned());
        assert_eq!(ratio("-sqrt(5)/pi", "2*sqrt(5)/pi"), some("-1/2"));
        assert_eq!(ratio("6*(1 + sqrt(2))", "(1 + sqrt(2))*4"), some("3/2"));
        assert_eq!(ratio("sqrt(2)*sqrt(3)", "sqrt(3)*sqrt(2)*7"), some("1/7"));
        assert_eq!(ratio("(1/2)*sqrt(2)", "(1)*sqrt(2)"), some("1/2"));
        assert_eq!(ratio("sqrt(2)*sqrt(2)", "sqrt(2)"), None);
        assert_eq!(ratio("[1, 2]", "[1, 2]"), None);
        assert_eq!(ratio("0", "3"), some("0"));
        assert_eq!(ratio("3", "0"), None);
    }
}
