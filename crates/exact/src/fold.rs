//! Structure of an expression, for writing it in another language.

use num_rational::BigRational;

use super::{Exact, Form};

/// One operation of an expression; `T` is the result of the fold over an operand.
#[derive(Clone, Copy, Debug)]
pub enum Operation<'x, T> {
    /// A fraction.
    Rational(&'x BigRational),
    /// A fraction times a power of pi whose exponent is not 0.
    PiPower(&'x BigRational, i32),
    /// All numbers between two numbers.
    Interval(T, T),
    /// `-a`
    Negative(T),
    /// `a + b`
    Sum(T, T),
    /// `a - b`
    Difference(T, T),
    /// `a * b`
    Product(T, T),
    /// `a / b`
    Quotient(T, T),
    /// `a^n`, `n >= 2`
    Power(T, u32),
    /// `sqrt(a)`
    SquareRoot(T),
    /// `sin(a)`
    Sine(T),
    /// `cos(a)`
    Cosine(T),
}

impl Exact {
    /// Replaces each operation, innermost first, by its value under `f`.
    ///
    /// ```
    /// # use impact_pair_exact::{Exact, Operation};
    /// let x = Exact::parse("sqrt(2) + 3*pi").unwrap();
    /// let operations = x.fold(&mut |operation| match operation {
    ///     Operation::Sum(a, b) => a + b + 1,
    ///     Operation::SquareRoot(a) => a + 1,
    ///     _ => 0,
    /// });
    /// assert_eq!(operations, 2);
    /// ```
    pub fn fold<T>(&self, f: &mut impl FnMut(Operation<'_, T>) -> T) -> T {
        let operation = match &self.node.form {
            Form::Monomial(monomial) => match monomial.as_rational() {
                Some(rational) => Operation::Rational(rational),
                None => Operation::PiPower(&monomial.rational, monomial.pi_power),
            },
            Form::Interval(a, b) => Operation::Interval(a.fold(f), b.fold(f)),
            Form::Negative(a) => Operation::Negative(a.fold(f)),
            Form::Sum(a, b) => Operation::Sum(a.fold(f), b.fold(f)),
            Form::Difference(a, b) => Operation::Difference(a.fold(f), b.fold(f)),
            Form::Product(a, b) => Operation::Product(a.fold(f), b.fold(f)),
            Form::Quotient(a, b, _) => Operation::Quotient(a.fold(f), b.fold(f)),
            Form::Power(a, n) => Operation::Power(a.fold(f), *n),
            Form::SquareRoot(a) => Operation::SquareRoot(a.fold(f)),
            Form::Sine(a) => Operation::Sine(a.fold(f)),
            Form::Cosine(a) => Operation::Cosine(a.fold(f)),
        };
        f(operation)
    }
}
