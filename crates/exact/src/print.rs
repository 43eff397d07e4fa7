//! Expressions as text: what the user wrote, or a canonical spelling that reads back to the same value.

use std::fmt::{self, Display, Formatter, Write as _};

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::decimal::DecimalDigits;
use super::monomial::Monomial;
use super::{Exact, Form};

/// Fractions with longer decimals are written as `n/d`.
const LONGEST_DECIMAL: usize = 40;

/// The precedence of an expression as it is written; an operand of lower precedence is put into parentheses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    /// `a + b`, `a - b`, and everything that starts with a minus.
    Sum,
    /// `a * b`, `a / b`.
    Product,
    /// `a ^ n`.
    Power,
    /// A number, `pi`, a function call or parentheses.
    Atom,
}

impl Exact {
    /// The text as the user wrote it, if the expression was read from a text; else a canonical spelling that
    /// [`parse`](Exact::parse) reads back to the same value.
    ///
    /// (An interval inside an expression, which only arithmetic can make, is written but not read back.)
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// let x = Exact::parse("0.10").unwrap();
    /// assert_eq!(x.text(), "0.10");
    /// assert_eq!((x * Exact::pi()).text(), "0.1*pi");
    /// ```
    pub fn text(&self) -> String {
        self.to_string()
    }

    /// The canonical spelling, whatever the user wrote.
    pub(super) fn canonical(&self) -> String {
        let mut text = String::new();
        // Writing to a String cannot fail.
        let _ = self.write_canonical(&mut text);
        text
    }

    fn write_canonical(&self, out: &mut String) -> fmt::Result {
        match &self.node.form {
            Form::Monomial(monomial) => out.write_str(&spell_monomial(monomial).0),
            Form::Interval(lower, upper) => {
                out.write_str("[")?;
                lower.write_canonical(out)?;
                out.write_str(", ")?;
                upper.write_canonical(out)?;
                out.write_str("]")
            }
            Form::Negative(x) => {
                out.write_str("-")?;
                x.write_bound(out, Binding::Power)
            }
            Form::Sum(a, b) => write_pair(out, a, " + ", b, Binding::Sum),
            Form::Difference(a, b) => write_pair(out, a, " - ", b, Binding::Sum),
            Form::Product(a, b) => write_pair(out, a, "*", b, Binding::Product),
            Form::Quotient(a, b, _) => write_pair(out, a, "/", b, Binding::Product),
            Form::Power(x, n) => {
                x.write_bound(out, Binding::Atom)?;
                write!(out, "^{n}")
            }
            Form::SquareRoot(x) => write_call(out, "sqrt", x),
            Form::Sine(x) => write_call(out, "sin", x),
            Form::Cosine(x) => write_call(out, "cos", x),
        }
    }

    /// The spelling, in parentheses if it binds more loosely than `least`.
    fn write_bound(&self, out: &mut String, least: Binding) -> fmt::Result {
        if self.binding() >= least {
            return self.write_canonical(out);
        }
        out.write_str("(")?;
        self.write_canonical(out)?;
        out.write_str(")")
    }

    fn binding(&self) -> Binding {
        match &self.node.form {
            Form::Monomial(monomial) => spell_monomial(monomial).1,
            Form::Negative(_) | Form::Sum(..) | Form::Difference(..) => Binding::Sum,
            Form::Product(..) | Form::Quotient(..) => Binding::Product,
            Form::Power(..) => Binding::Power,
            Form::Interval(..) | Form::SquareRoot(_) | Form::Sine(_) | Form::Cosine(_) => Binding::Atom,
        }
    }
}

/// `a op b`, read from left to right: the right operand must bind more tightly than the operator.
fn write_pair(out: &mut String, a: &Exact, operator: &str, b: &Exact, binding: Binding) -> fmt::Result {
    a.write_bound(out, binding)?;
    out.write_str(operator)?;
    b.write_bound(out, if binding == Binding::Sum { Binding::Product } else { Binding::Power })
}

fn write_call(out: &mut String, name: &str, x: &Exact) -> fmt::Result {
    out.write_str(name)?;
    out.write_str("(")?;
    x.write_canonical(out)?;
    out.write_str(")")
}

/// `r`, `pi^k`, `-pi^k` or `r*pi^k`.
fn spell_monomial(x: &Monomial) -> (String, Binding) {
    let (number, binding) = spell_rational(&x.rational);
    let power = match x.pi_power {
        0 => return (number, binding),
        1 => "pi".to_owned(),
        k => format!("pi^{k}"),
    };
    if x.rational.is_one() {
        return (power, if x.pi_power == 1 { Binding::Atom } else { Binding::Power });
    }
    if (-&x.rational).is_one() {
        return (format!("-{power}"), Binding::Sum);
    }
    (format!("{number}*{power}"), binding.min(Binding::Product)) // exact: a rank
}

/// A decimal if it is short, else `n/d`.
fn spell_rational(x: &BigRational) -> (String, Binding) {
    let least = if x.is_negative() { Binding::Sum } else { Binding::Atom };
    match short_decimal(x) {
        Some(decimal) => (decimal, least),
        None if x.is_integer() => (x.numer().to_string(), least),
        None => (format!("{}/{}", x.numer(), x.denom()), least.min(Binding::Product)), // exact: a rank
    }
}

/// The exact decimal, if there is one of at most 40 significant digits.
fn short_decimal(x: &BigRational) -> Option<String> {
    let twos = x.denom().trailing_zeros().unwrap_or(0); // exact: a denominator is not 0
    let (fives, rest) = split_fives(x.denom() >> twos);
    if !rest.is_one() {
        return None;
    }
    // x = n / (2^twos 5^fives) = n 2^(k - twos) 5^(k - fives) / 10^k.
    let places = twos.max(fives); // exact: places for both
    let factor = BigInt::from(5u8).pow(u32::try_from(places - fives).ok()?) << (places - twos);
    let digits = DecimalDigits::new(&(x.numer() * factor), -i64::try_from(places).ok()?);
    (digits.digits.len() <= LONGEST_DECIMAL).then(|| digits.to_string())
}

/// The number of factors five of x > 0, and x without them; by repeated squaring, so that long powers are cheap.
fn split_fives(x: BigInt) -> (u64, BigInt) {
    let mut squarings = vec![BigInt::from(5u8)];
    while let Some(last) = squarings.last()
        && 2 * last.bits() <= x.bits() + 1
    {
        squarings.push(last * last);
    }
    let (mut fives, mut rest) = (0, x);
    for (level, power) in squarings.iter().enumerate().rev() {
        let (quotient, remainder) = rest.div_rem(power);
        if remainder.is_zero() {
            (fives, rest) = (fives + (1 << level), quotient);
        }
    }
    (fives, rest)
}

impl Display for Exact {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.written {
            Some(text) => f.write_str(text),
            None => f.write_str(&self.canonical()),
        }
    }
}

impl fmt::Debug for Exact {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "Exact({self})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings_are_short_and_keep_their_value() {
        let cases = [
            ("-2^2", "-4"),
            ("1_000.50", "1000.5"),
            ("1/3*pi", "1/3*pi"),
            ("-pi", "-pi"),
            ("3/4*pi^2/2", "0.375*pi^2"),
            ("1/pi", "pi^-1"),
            ("1e300", "1e300"),
            ("1.5e-300", "1.5e-300"),
            ("-(sin(1) + 2)", "-(sin(1) + 2)"),
            ("1 - (2 - sin(1))", "1 - (2 - sin(1))"),
            ("sin(1) - (-2)", "sin(1) - (-2)"),
            ("sin(1) / (2*pi) * (1/3)", "sin(1)/(2*pi)*(1/3)"),
            ("(-sin(1))^2", "(-sin(1))^2"),
            ("sqrt(2)^-3", "1/sqrt(2)^3"),
            ("[1 , pi]", "[1, pi]"),
        ];
        for (text, canonical) in cases {
            let x = Exact::parse(text).unwrap();
            assert_eq!(x.canonical(), canonical, "{text}");
            assert_eq!(x.text(), text);
            assert_eq!(Exact::parse(canonical).unwrap().canonical(), canonical);
        }
    }

    #[test]
    fn factors_of_five_are_all_found() {
        for n in [0u32, 1, 2, 3, 7, 8, 100, 1023, 1024] {
            assert_eq!(split_fives(BigInt::from(5u8).pow(n) * 6), (u64::from(n), BigInt::from(6u8)));
        }
    }
}
