//! A normal form of sums, in which two expressions of one number often become the same: **Lemma X2** of `docs/proofs/exact.md#X2`.
//!
//! A sum of terms `r pi^k sqrt(m) g sin(a)` or `... cos(a)`, `r` a fraction, `m` a whole number, `g` powers of roots and
//! reciprocals of sums, `a` a sum. Each rule is an identity, so a normal form without terms proves that the number is 0; the converse is not claimed.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::monomial::Monomial;
use super::{Exact, Form};

/// Longer sums are not expanded: an expression may double its terms with each operation.
const MOST_TERMS: usize = 32;
/// Fractions and roots of more bits have no normal form.
const MOST_BITS: u64 = 512;
/// Powers with a greater exponent have no normal form.
const MOST_POWERS: u32 = 16;
/// Largest square factor of a radicand that is searched for: the square of this number.
const LARGEST_FACTOR: u32 = 64;

/// Terms and their coefficients, none of them 0.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Normal(BTreeMap<Term, BigRational>);

/// The factor that a rational coefficient multiplies: `pi^pi_power sqrt(radicand)` times a wave and powers of `factors`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Term {
    wave: Option<Wave>,
    factors: BTreeMap<Factor, u32>,
    pi_power: i32,
    /// Under the square root.
    radicand: BigInt,
}

/// A factor of a term that is not expanded: the root of a sum, or the reciprocal of one.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Factor {
    Root(Normal),
    Reciprocal(Normal),
}

/// A sine or a cosine of a sum.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Wave {
    is_sine: bool,
    angle: Normal,
}

impl Term {
    fn one() -> Self {
        Self { wave: None, factors: BTreeMap::new(), pi_power: 0, radicand: BigInt::one() }
    }
}

impl Normal {
    /// The normal form of an expression of one number; `None` where it grows too long.
    pub fn of(x: &Exact) -> Option<Self> {
        x.node.normal.get_or_init(|| Self::of_form(&x.node.form).filter(Self::is_short)).clone()
    }

    fn of_form(form: &Form) -> Option<Self> {
        match form {
            Form::Monomial(Monomial { rational, pi_power }) => {
                Some(Self::from(Term { pi_power: *pi_power, ..Term::one() }).scaled(rational))
            }
            Form::Interval(..) => None,
            Form::Negative(a) => Some(Self::of(a)?.scaled(&whole(-1))),
            Form::Sum(a, b) => Some(Self::of(a)?.plus(&Self::of(b)?)),
            Form::Difference(a, b) => Some(Self::of(a)?.plus(&Self::of(b)?.scaled(&whole(-1)))),
            Form::Product(a, b) => Self::of(a)?.times(&Self::of(b)?),
            Form::Quotient(a, b, _) => Self::of(a)?.times(&Self::of(b)?.reciprocal()?),
            Form::Power(a, n) => {
                let a = Self::of(a)?;
                (*n <= MOST_POWERS).then(|| (0..*n).try_fold(Self::from(Term::one()), |power, _| power.times(&a)))?
            }
            Form::SquareRoot(a) => Self::of(a)?.root(),
            Form::Sine(a) => Self::of(a)?.wave(true),
            Form::Cosine(a) => Self::of(a)?.wave(false),
        }
    }

    /// The number `r pi^k`, if the normal form is one.
    pub fn monomial(&self) -> Option<Monomial> {
        if self.0.is_empty() {
            return Some(Monomial::new(BigRational::zero(), 0));
        }
        let (Term { wave, factors, pi_power, radicand }, rational) = self.only()?;
        let is_plain = wave.is_none() && factors.is_empty() && radicand.is_one();
        is_plain.then(|| Monomial::new(rational.clone(), *pi_power))
    }

    fn only(&self) -> Option<(&Term, &BigRational)> {
        self.0.first_key_value().filter(|_| self.0.len() == 1)
    }

    fn is_short(&self) -> bool {
        let is_short = |(term, x): (&Term, &BigRational)| {
            [x.numer(), x.denom(), &term.radicand].iter().all(|n| n.bits() <= MOST_BITS)
                && term.pi_power.unsigned_abs() <= MOST_POWERS
                && term.factors.values().all(|&power| power <= MOST_POWERS)
        };
        self.0.len() <= MOST_TERMS && self.0.iter().all(is_short)
    }

    fn scaled(mut self, factor: &BigRational) -> Self {
        if factor.is_zero() {
            return Self::default();
        }
        self.0.values_mut().for_each(|x| *x *= factor);
        self
    }

    fn add(&mut self, term: Term, x: BigRational) {
        let sum = self.0.remove(&term).unwrap_or_default() + x; // X2: an absent term is 0
        if !sum.is_zero() {
            self.0.insert(term, sum);
        }
    }

    fn plus(mut self, other: &Self) -> Self {
        other.0.iter().for_each(|(term, x)| self.add(term.clone(), x.clone()));
        self
    }

    fn times(&self, other: &Self) -> Option<Self> {
        let mut product = Self::default();
        for (a, x) in &self.0 {
            for (b, y) in &other.0 {
                product = product.plus(&a.times(b)?.scaled(&(x * y)));
            }
            if !product.is_short() {
                return None;
            }
        }
        Some(product)
    }

    /// `1/x` of a number that is not 0: the reciprocal of a single term without a wave and factors is again such a term.
    fn reciprocal(&self) -> Option<Self> {
        match self.only() {
            // 1/sqrt(m) = sqrt(m)/m
            Some((Term { wave: None, factors, pi_power, radicand }, x)) if factors.is_empty() => {
                let term = Term { pi_power: -pi_power, radicand: radicand.clone(), ..Term::one() };
                Some(Self::from(term).scaled(&(x * BigRational::from(radicand.clone())).recip()))
            }
            _ => {
                let first = self.0.first_key_value()?.1.clone();
                let sum = self.clone().scaled(&first.recip());
                Some(Self::from(Factor::Reciprocal(sum)).scaled(&first.recip()))
            }
        }
    }

    /// The square root of a number that is not negative.
    fn root(&self) -> Option<Self> {
        match self.only() {
            // sqrt(p/q) = sqrt(p q)/q
            Some((Term { wave: None, factors, pi_power, radicand }, x))
                if factors.is_empty() && pi_power % 2 == 0 && radicand.is_one() =>
            {
                let (outside, radicand) = without_squares(x.numer() * x.denom());
                let term = Term { pi_power: pi_power / 2, radicand, ..Term::one() };
                Some(Self::from(term).scaled(&BigRational::new(outside, x.denom().clone())))
            }
            None if self.0.is_empty() => Some(Self::default()),
            _ => Some(Self::from(Factor::Root(self.clone()))),
        }
    }

    /// The sine or cosine of an angle: whole quarter periods are removed, and the first other coefficient is made positive.
    fn wave(&self, is_sine: bool) -> Option<Self> {
        let half_turn = Term { pi_power: 1, ..Term::one() };
        let mut angle = self.clone();
        let turned = angle.0.remove(&half_turn).unwrap_or_default(); // X2: an absent term is 0
        // sin(-a) = -sin(a), cos(-a) = cos(a): the first coefficient beside pi's is positive.
        let is_mirrored = angle.0.values().next().is_some_and(Signed::is_negative);
        let (angle, turned) = if is_mirrored { (angle.scaled(&whole(-1)), -turned) } else { (angle, turned) };
        let sign = whole(if is_mirrored && is_sine { -1 } else { 1 });
        let quarters = (&turned * whole(2)).floor(); // X2: any whole number of quarters
        let rest = turned - &quarters / whole(2);
        let quarters = quarters.to_integer().mod_floor(&4.into()).to_u8()?;
        // sin(a + pi/2) = cos(a), cos(a + pi/2) = -sin(a)
        let (is_sine, turns_sign) = match (is_sine, quarters) {
            (true, 0) | (false, 3) => (true, 1),
            (true, 1) | (false, 0) => (false, 1),
            (true, 2) | (false, 1) => (true, -1),
            _ => (false, -1),
        };
        let sign = sign * whole(turns_sign);
        if angle.0.is_empty() {
            return Some(special(is_sine, rest).scaled(&sign));
        }
        let mut angle = angle;
        angle.add(half_turn, rest);
        Some(Self::from(Term { wave: Some(Wave { is_sine, angle }), ..Term::one() }).scaled(&sign))
    }
}

impl Term {
    /// The product: `sqrt(a) sqrt(b) = g sqrt(a/g b/g)`, `sqrt(s)^2 = s`, and waves by their sums and differences.
    fn times(&self, other: &Self) -> Option<Normal> {
        let common = self.radicand.gcd(&other.radicand);
        let (outside, radicand) = without_squares((&self.radicand / &common) * (&other.radicand / &common));
        let mut factors = self.factors.clone();
        other.factors.iter().for_each(|(factor, power)| *factors.entry(factor.clone()).or_default() += power);
        let mut squares = Vec::new();
        factors.retain(|factor, power| {
            if let Factor::Root(sum) = factor {
                squares.extend(std::iter::repeat_n(sum.clone(), (*power / 2) as usize)); // exact: at most 32
                *power %= 2;
            }
            *power > 0
        });
        let term = Self { wave: None, factors, pi_power: self.pi_power.checked_add(other.pi_power)?, radicand };
        let mut product = Normal::from(term).scaled(&BigRational::from(common * outside));
        product = match (&self.wave, &other.wave) {
            (None, None) => product,
            (Some(wave), None) | (None, Some(wave)) => product.waved(&Normal::from(wave.clone()))?,
            (Some(a), Some(b)) => product.waved(&a.times(b)?)?,
        };
        squares.iter().try_fold(product, |product, square| product.times(square))
    }
}

impl Wave {
    /// `2 sin a sin b = cos(a - b) - cos(a + b)`, `2 cos a cos b = cos(a - b) + cos(a + b)`, `2 sin a cos b = sin(a + b) + sin(a - b)`
    fn times(&self, other: &Self) -> Option<Normal> {
        let (a, b) = if self.is_sine { (self, other) } else { (other, self) };
        let sum = a.angle.clone().plus(&b.angle);
        let difference = a.angle.clone().plus(&b.angle.clone().scaled(&whole(-1)));
        let is_sine = a.is_sine && !b.is_sine;
        let sign = if a.is_sine && b.is_sine { -1 } else { 1 };
        let waves = difference.wave(is_sine)?.plus(&sum.wave(is_sine)?.scaled(&whole(sign)));
        Some(waves.scaled(&half()))
    }
}

impl Normal {
    /// The product of a term without a wave and of waves alone.
    fn waved(&self, waves: &Self) -> Option<Self> {
        let (term, x) = self.only()?;
        let mut product = Self::default();
        for (wave, y) in &waves.0 {
            // A special angle leaves a root.
            let is_wave = wave.wave.is_some();
            let times =
                if is_wave { Self::from(Term { wave: wave.wave.clone(), ..term.clone() }) } else { term.times(wave)? };
            product = product.plus(&times.scaled(&(x * y)));
        }
        Some(product)
    }
}

impl From<Term> for Normal {
    fn from(term: Term) -> Self {
        Self(BTreeMap::from([(term, BigRational::one())]))
    }
}

impl From<Factor> for Normal {
    fn from(factor: Factor) -> Self {
        Self::from(Term { factors: BTreeMap::from([(factor, 1)]), ..Term::one() })
    }
}

impl From<Wave> for Normal {
    fn from(wave: Wave) -> Self {
        Self::from(Term { wave: Some(wave), ..Term::one() })
    }
}

/// The sine or cosine of `part` times pi, `0 <= part < 1/2`; roots for twelfths.
fn special(is_sine: bool, part: BigRational) -> Normal {
    // sin(pi/2 - a) = cos(a): at most a quarter is left.
    let is_beyond = part > BigRational::new(1.into(), 4.into());
    let (is_sine, part) = if is_beyond { (!is_sine, half() - part) } else { (is_sine, part) };
    let twelfths = &part * whole(12);
    let root = |m: i64| Normal::from(Term { radicand: m.into(), ..Term::one() });
    let quarter = || BigRational::new(1.into(), 4.into());
    match twelfths.is_integer().then(|| twelfths.to_integer().to_u8()).flatten() {
        Some(0) if is_sine => Normal::default(),
        Some(0) => root(1),
        Some(1) => root(6).plus(&root(2).scaled(&whole(if is_sine { -1 } else { 1 }))).scaled(&quarter()),
        Some(2) if is_sine => root(1).scaled(&half()),
        Some(2) => root(3).scaled(&half()),
        Some(3) => root(2).scaled(&half()),
        _ => {
            let angle = Normal::from(Term { pi_power: 1, ..Term::one() }).scaled(&part);
            Normal::from(Wave { is_sine, angle })
        }
    }
}

/// `(a, b)` with `n = a^2 b`.
fn without_squares(n: BigInt) -> (BigInt, BigInt) {
    let root = n.sqrt();
    if &root * &root == n {
        return (root, BigInt::one());
    }
    let (mut outside, mut inside) = (BigInt::one(), n);
    for factor in 2..=LARGEST_FACTOR {
        while (&inside % (factor * factor)).is_zero() {
            inside /= factor * factor;
            outside *= factor;
        }
    }
    (outside, inside)
}

fn whole(n: i64) -> BigRational {
    BigRational::from_integer(n.into())
}

fn half() -> BigRational {
    BigRational::new(1.into(), 2.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Exact;
    use proptest::prelude::*;

    fn normal(text: &str) -> Option<Normal> {
        Normal::of(&Exact::parse(text).unwrap())
    }

    #[test]
    fn one_number_has_one_form() {
        for (one, other) in [
            ("cos(0.3)", "cos(-0.3)"),
            ("sqrt(2)*sqrt(3)", "sqrt(6)"),
            ("sqrt(8)", "2*sqrt(2)"),
            ("sqrt(1/2)", "sqrt(2)/2"),
            ("(1 + sqrt(2))*(1 - sqrt(2))", "-1"),
            ("sin(1)^2 + cos(1)^2", "1"),
            ("sin(2)", "2*sin(1)*cos(1)"),
            ("cos(1)*cos(2) - sin(1)*sin(2)", "cos(3)"),
            ("sin(pi/2 + sqrt(2)/3)", "cos(-sqrt(2)/3)"),
            ("sin(7*pi - 0.1)", "sin(0.1)"),
            ("sin(pi/4)", "1/sqrt(2)"),
            ("cos(pi/12)", "cos(pi/3)*cos(pi/4) + sin(pi/3)*sin(pi/4)"),
            ("cos(pi/5)", "sin(3*pi/10)"),
            ("sqrt(1 + pi)^2", "1 + pi"),
            ("sqrt(1 + pi)*sqrt(1 + pi)/2", "(pi + 1)/2"),
            ("3/(2 + 2*pi)", "1.5/(1 + pi)"),
            ("(pi/2 - sqrt(2)/3 + sqrt(2)*(1/3))/(2*pi)", "1/4"),
            ("(1/3 + 1e-30)*3*sqrt(5)", "sqrt(5)*(1 + 3e-30)"),
        ] {
            assert_eq!(normal(one).unwrap(), normal(other).unwrap(), "{one} = {other}");
        }
    }

    #[test]
    fn other_numbers_have_other_forms() {
        for (one, other) in [
            ("cos(0.3)", "-cos(0.3)"),
            ("sin(0.3)", "sin(-0.3)"),
            ("cos(1 + pi/2)", "sin(1)"),
            ("sin(1 + pi)", "sin(1)"),
            ("sqrt(2)*sqrt(3)", "sqrt(5)"),
            ("sin(pi/12)", "cos(pi/12)"),
            ("sqrt(1 + pi)^3", "1 + pi"),
            ("1/(1 + pi)", "1 + pi"),
        ] {
            assert_ne!(normal(one).unwrap(), normal(other).unwrap(), "{one} = {other}");
        }
        assert_eq!(normal("[1, 2]"), None);
    }

    proptest! {
        /// Lemma X2 against the enclosures (X1): a normal form encloses the same number as its expression.
        #[test]
        fn a_form_is_the_number(a in crate::evaluate::tests::texts(), b in crate::evaluate::tests::texts()) {
            let parse = |text: &str| Exact::parse(text).ok();
            for text in [format!("({a})*({b})"), format!("({a})/({b})"), format!("sin(({a}) - ({b}))*cos({a})"), format!("(({a}) + ({b}))^2")] {
                let Some((x, normal)) = parse(&text).and_then(|x| Some((Normal::of(&x)?, x))).map(|(n, x)| (x, n)) else { continue };
                let value = normal.value().unwrap();
                prop_assert!(x.enclose(200).intersection(&value.enclose(200)).is_some(), "{} is not {}", text, value);
            }
        }
    }

    impl Normal {
        /// Rebuilds the sum as an expression, by the constructors alone.
        fn value(&self) -> Option<Exact> {
            self.0.iter().try_fold(Exact::from(0), |sum, (term, x)| {
                let mut product = Exact::from_rational(x.clone());
                let radicand = Exact::from(term.radicand.clone()).checked_sqrt().ok()?;
                product = product.checked_mul(&radicand).ok()?;
                product = product.checked_mul(&Exact::pi().checked_powi(term.pi_power.into()).ok()?).ok()?;
                for (factor, power) in &term.factors {
                    let factor = match factor {
                        Factor::Root(sum) => sum.value()?.checked_sqrt().ok()?,
                        Factor::Reciprocal(sum) => Exact::from(1).checked_div(&sum.value()?).ok()?,
                    };
                    product = product.checked_mul(&factor.checked_powi((*power).into()).ok()?).ok()?;
                }
                if let Some(Wave { is_sine, angle }) = &term.wave {
                    let angle = angle.value()?;
                    let wave = if *is_sine { angle.checked_sin() } else { angle.checked_cos() };
                    product = product.checked_mul(&wave.ok()?).ok()?;
                }
                sum.checked_add(&product).ok()
            })
        }
    }
}
