//! Exact real numbers as expressions, enclosed at any requested precision, never through a rounded double.
//!
//! An [`Exact`] is read from a text such as `9.42497`, `10*pi` or `sqrt(2)/3`, or built by arithmetic, and encloses its
//! value in an [`Enclosure`] as narrow as requested. Numbers of the form `r * pi^k` with a rational `r` are kept in normal form, so
//! `(pi/2)/(2*pi)` *is* the fraction 1/4; everything else is a tree. `"[a, b]"` stands for every real number from a to b.
//!
//! In reading order: `monomial` (the normal form), `normal` (the normal form of sums), `dyadic`, `elementary` and `enclosure`
//! (outward-rounded arithmetic), `evaluate` (precision control), `literal`, `parse` and `print` (text), `decimal` (outward decimal
//! printing), `digits` (short decimals), `ratio` (fractions between numbers), `fold` (for other languages), `error`.
//!
//! ```
//! use impact_pair_exact::Exact;
//! let quarter = Exact::parse("(10*pi*0 + pi/2) / (2*pi)")?;
//! assert_eq!(quarter.as_rational().unwrap().to_string(), "1/4");
//! let gap = Exact::parse("9.42497")?; // not the double 9.42497, which is another number
//! assert!(gap.compare(&Exact::from_f64(9.42497).unwrap()).unwrap().is_ne());
//! # Ok::<(), impact_pair_exact::ParseError>(())
//! ```

mod approx;
mod decimal;
mod digits;
mod dyadic;
mod elementary;
mod enclosure;
mod error;
mod evaluate;
mod fold;
mod literal;
mod monomial;
mod normal;
mod operators;
mod parse;
mod print;
mod ratio;
mod real;

use std::sync::{Arc, Mutex, OnceLock};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

pub use decimal::{decimal_bounds, decimal_bounds_f64, decimal_f64};
pub use digits::{decimal_digits, log2_of_digits, whole_bits, working_bits};
use dyadic::Round;
pub use dyadic::{Dyadic, compare_rational};
pub use enclosure::Enclosure;
pub use error::{ExactError, ParseError};
pub use fold::Operation;
use monomial::Monomial;
use normal::Normal;
pub use real::Real;

/// Expressions of more nested operations are refused, so recursion over a tree cannot exhaust the stack.
const MAX_DEPTH: u32 = 256;
/// Expressions beyond `2^MAX_SIZE_EXPONENT` in size are refused, so no argument reduction can exhaust the memory.
const MAX_SIZE_EXPONENT: i64 = 40_000;
/// The largest accepted exponent of `^`, in size.
const LARGEST_POWER: i64 = 10_000;
/// Precision up to which signs are decided.
const SIGN_BITS: u32 = 4096;

/// An exact real number, or a set of real numbers given by intervals; cheap to clone.
///
/// An expression that contains intervals stands for all values that arise when each occurrence of an interval takes each of its
/// values independently. Every expression is defined: divisors are proved nonzero and radicands nonnegative when it is built.
///
/// The operators `+ - *` (on values and references) **panic** where their `checked_` forms return an error: an expression of more
/// than 256 nested operations, or a value beyond `2^40000`.
#[derive(Clone)]
pub struct Exact {
    node: Arc<Node>,
    /// The user's text, if the expression was read from one.
    written: Option<Arc<str>>,
}

/// Node of an expression tree, with enclosures of its value that are already known.
struct Node {
    form: Form,
    depth: u32,
    is_point: bool,
    /// Enclosure from the time of construction. Later enclosures are intersected with it: coarse precision can never make an
    /// intermediate value larger than it was when the expression was accepted.
    base: OnceLock<Enclosure>,
    /// A few recent enclosures by precision, so shared subexpressions are evaluated once.
    recent: Mutex<Vec<(u32, Enclosure)>>,
    /// Normal form as a sum of terms; `None` inside where it grows too long.
    normal: OnceLock<Option<Normal>>,
}

/// The outermost operation of an expression, with its operands.
enum Form {
    /// `r * pi^k`.
    Monomial(Monomial),
    /// All numbers between two points, which are proved to be in order.
    Interval(Exact, Exact),
    Negative(Exact),
    Sum(Exact, Exact),
    Difference(Exact, Exact),
    Product(Exact, Exact),
    /// A quotient, with an enclosure of the divisor that does not hold zero.
    Quotient(Exact, Exact, Enclosure),
    /// A power with an exponent >= 2.
    Power(Exact, u32),
    SquareRoot(Exact),
    Sine(Exact),
    Cosine(Exact),
}

impl Exact {
    /// Exactly `x`; `None` for NaN and the infinities.
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// assert_eq!(Exact::from_f64(0.1).unwrap().as_rational().unwrap().denom(), &(1u64 << 55).into());
    /// assert!(Exact::from_f64(f64::NAN).is_none());
    /// ```
    pub fn from_f64(x: f64) -> Option<Exact> {
        Dyadic::from_f64(x).map(|x| Exact::from_rational(x.to_rational()))
    }

    /// Exactly the fraction `x`.
    pub fn from_rational(x: BigRational) -> Exact {
        Exact::from_monomial(Monomial::new(x, 0))
    }

    /// Exactly pi.
    pub fn pi() -> Exact {
        Exact::from_monomial(Monomial::new(BigRational::one(), 1))
    }

    /// The interval of all numbers from `lower` to `upper`; the point itself if both are equal.
    ///
    /// **Errors** if an end is not a point, or `lower <= upper` cannot be proved.
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// let turn = Exact::interval(&Exact::from(0), &(Exact::from(2) * Exact::pi())).unwrap();
    /// assert_eq!(turn.text(), "[0, 2*pi]");
    /// ```
    pub fn interval(lower: &Exact, upper: &Exact) -> Result<Exact, ExactError> {
        if let Some(end) = [lower, upper].into_iter().find(|end| !end.is_point()) {
            return Err(ExactError::NestedInterval { end: error::shortened(&end.text()) });
        }
        match lower.compare(upper) {
            Some(std::cmp::Ordering::Less) => Exact::from_form(Form::Interval(lower.clone(), upper.clone())),
            Some(std::cmp::Ordering::Equal) => Ok(lower.clone()),
            _ => Err(ExactError::EndsOutOfOrder {
                lower: error::shortened(&lower.text()),
                upper: error::shortened(&upper.text()),
            }),
        }
    }

    /// True if the expression is a single number: no interval is involved.
    pub fn is_point(&self) -> bool {
        self.node.is_point
    }

    /// The value, if it is known to be a fraction. (Not every rational value is known to be one: `cos(pi/5) - cos(2*pi/5)`.)
    pub fn as_rational(&self) -> Option<&BigRational> {
        self.as_monomial().and_then(Monomial::as_rational)
    }

    /// The ends of an interval `[a, b]`, twice the number itself for a point, `None` if an interval is nested inside.
    ///
    /// ```
    /// # use impact_pair_exact::Exact;
    /// let (lower, upper) = Exact::parse("[9.42, 3*pi]").unwrap().ends().unwrap();
    /// assert_eq!((lower.text(), upper.text()), ("9.42".into(), "3*pi".into()));
    /// ```
    pub fn ends(&self) -> Option<(Exact, Exact)> {
        match &self.node.form {
            Form::Interval(lower, upper) => Some((lower.clone(), upper.clone())),
            _ if self.is_point() => Some((self.clone(), self.clone())),
            _ => None,
        }
    }

    /// The lower one of the [`ends`](Exact::ends).
    pub fn lower(&self) -> Option<Exact> {
        self.ends().map(|(lower, _)| lower)
    }

    /// The upper one of the [`ends`](Exact::ends).
    pub fn upper(&self) -> Option<Exact> {
        self.ends().map(|(_, upper)| upper)
    }

    /// The number `r * pi^k`, if the expression is one.
    fn as_monomial(&self) -> Option<&Monomial> {
        match &self.node.form {
            Form::Monomial(monomial) => Some(monomial),
            _ => None,
        }
    }

    /// The number `r * pi^k` as an expression.
    fn from_monomial(monomial: Monomial) -> Exact {
        Exact::from_node(Node::new(Form::Monomial(monomial)))
    }

    /// An expression, once it is proved to have a value of reasonable size that can be enclosed.
    fn from_form(form: Form) -> Result<Exact, ExactError> {
        let exact = Exact::from_node(Node::new(form));
        if exact.node.depth > MAX_DEPTH {
            return Err(ExactError::TooDeep);
        }
        if let Some(monomial) = Normal::of(&exact).and_then(|normal| normal.monomial()) {
            return Ok(Exact::from_monomial(monomial));
        }
        let base = exact.settle_at_construction()?;
        if base.mag().top().is_some_and(|top| top > MAX_SIZE_EXPONENT) {
            return Err(ExactError::TooLarge);
        }
        // A fresh node: nobody else can have set it.
        let _ = exact.node.base.set(base);
        Ok(exact)
    }

    fn from_node(node: Node) -> Exact {
        Exact { node: Arc::new(node), written: None }
    }
}

impl Node {
    fn new(form: Form) -> Node {
        let (depth, is_point) = match &form {
            Form::Monomial(_) => (0, true),
            Form::Interval(a, b) => (1 + a.node.depth.max(b.node.depth), false), // exact: a depth
            Form::Sum(a, b) | Form::Difference(a, b) | Form::Product(a, b) | Form::Quotient(a, b, _) => {
                (1 + a.node.depth.max(b.node.depth), a.is_point() && b.is_point()) // exact: a depth
            }
            Form::Negative(x) | Form::Power(x, _) | Form::SquareRoot(x) | Form::Sine(x) | Form::Cosine(x) => {
                (1 + x.node.depth, x.is_point())
            }
        };
        Node { form, depth, is_point, base: OnceLock::new(), recent: Mutex::new(Vec::new()), normal: OnceLock::new() }
    }
}

/// Exactly the integer.
impl From<i64> for Exact {
    fn from(x: i64) -> Exact {
        Exact::from_rational(BigRational::from_integer(x.into()))
    }
}

/// Exactly the double: 0.1 is 3602879701896397/36028797018963968.
///
/// ```
/// use impact_pair_exact::Exact;
/// assert_eq!(Exact::try_from(0.1)?.as_rational().unwrap().to_string(), "3602879701896397/36028797018963968");
/// assert!(Exact::try_from(f64::NAN).is_err());
/// # Ok::<(), impact_pair_exact::ExactError>(())
/// ```
impl TryFrom<f64> for Exact {
    type Error = ExactError;

    fn try_from(x: f64) -> Result<Exact, ExactError> {
        let exact = Dyadic::from_f64(x).ok_or_else(|| ExactError::NotFinite { value: x.to_string() })?;
        Ok(Exact::from_rational(exact.to_rational()))
    }
}

/// Exactly the integer.
impl From<BigInt> for Exact {
    fn from(x: BigInt) -> Exact {
        Exact::from_rational(BigRational::from_integer(x))
    }
}

/// Exactly the fraction.
impl From<BigRational> for Exact {
    fn from(x: BigRational) -> Exact {
        Exact::from_rational(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_may_be_shared_between_threads() {
        fn assert_send_sync<T: Send + Sync>() {}
        assert_send_sync::<(Exact, Enclosure, ExactError, ParseError)>();
    }

    #[test]
    fn equal_ends_are_a_point_and_disordered_ends_an_error() {
        let two = Exact::from(2);
        assert!(Exact::interval(&two, &two).unwrap().is_point());
        assert!(Exact::interval(&two, &Exact::from(1)).is_err());
        let inner = Exact::interval(&Exact::from(1), &two).unwrap();
        assert!(!inner.is_point());
        assert!(matches!(Exact::interval(&inner, &two), Err(ExactError::NestedInterval { .. })));
        assert!((&inner + &two).ends().is_none());
    }

    #[test]
    fn unreasonable_trees_are_refused() {
        let mut deep = Exact::parse("sin(1)").unwrap();
        let refusal = loop {
            match deep.checked_add(&Exact::pi()) {
                Ok(next) => deep = next,
                Err(refusal) => break refusal,
            }
        };
        assert_eq!(refusal, ExactError::TooDeep);
        let mut large = Exact::parse("1e9000").unwrap();
        let refusal = loop {
            match large.checked_powi(2) {
                Ok(next) => large = next,
                Err(refusal) => break refusal,
            }
        };
        assert_eq!(refusal, ExactError::TooLarge);
    }

    #[test]
    fn shared_subexpressions_are_evaluated_once() {
        let mut x = Exact::parse("sin(1)").unwrap();
        for _ in 0..200 {
            x = &x + &x; // 2^200 leaves as a tree
        }
        assert!(x.enclose(300).inf().top() == Some(199));
    }
}
