//! Jets: functions of a parameter `x` of a manifold and of `D = d/A` (or of `e`, if the tangency's parameter is `e`), up to the required
//! derivatives. Both `D` and `e` are called `D` here.

use crate::check::affine::Affine;
use impact_pair_exact::Real;

/// The powers of `x` and `D` in the order of a jet's coefficients.
pub(in crate::check) const ONE: usize = 0;
pub(in crate::check) const X: usize = 1;
pub(in crate::check) const D: usize = 2;
pub(super) const XX: usize = 3;
pub(super) const XD: usize = 4;

/// Taylor coefficients of 1, `x`, `D`, `x^2` and `x D`, each over a set of values of both; `None` is 0.
///
/// Sums, products and functions omit all other powers (Lemma V17).
#[derive(Clone, Debug)]
pub(in crate::check) struct Jet {
    coefficients: [Option<Affine>; 5],
}

impl Jet {
    /// The jet with these coefficients.
    pub fn new(coefficients: [Option<Affine>; 5]) -> Self {
        Self { coefficients }
    }

    /// A number that depends on neither `x` nor `D`.
    pub fn constant(x: Real) -> Self {
        Self::constant_of(Affine::fixed(x))
    }

    /// A value that is taken as independent of `x` and `D`.
    pub fn constant_of(x: Affine) -> Self {
        Self::new([Some(x), None, None, None, None])
    }

    /// A value with its derivative by `D`.
    pub fn with_slope(value: Affine, slope: Affine) -> Self {
        Self::new([Some(value), None, Some(slope), None, None])
    }

    /// The coefficient of a power.
    pub fn at(&self, power: usize, bits: u32) -> Affine {
        self.coefficients[power].clone().unwrap_or_else(|| Affine::fixed(Real::zero(bits))) // exact: it is 0
    }

    /// The value; 0 if the coefficient is `None`.
    pub fn value(&self, bits: u32) -> Affine {
        self.at(ONE, bits)
    }

    /// The jet with the coefficients of these powers taken from `from`.
    pub fn with(mut self, powers: [usize; 2], from: &Self) -> Self {
        for power in powers {
            self.coefficients[power].clone_from(&from.coefficients[power]);
        }
        self
    }

    pub fn plus(&self, other: &Self) -> Self {
        let sum = |i: usize| match (&self.coefficients[i], &other.coefficients[i]) {
            (Some(a), Some(b)) => Some(sum(a, b)),
            (a, b) => a.clone().or_else(|| b.clone()),
        };
        Self::new([0, 1, 2, 3, 4].map(sum))
    }

    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.times_integer(-1))
    }

    pub fn times(&self, other: &Self) -> Self {
        let product =
            |i: usize, j: usize| Some(product(self.coefficients[i].as_ref()?, other.coefficients[j].as_ref()?));
        let of = |pairs: &[(usize, usize)]| pairs.iter().filter_map(|&(i, j)| product(i, j)).reduce(|a, b| sum(&a, &b));
        Self::new([
            of(&[(ONE, ONE)]),
            of(&[(ONE, X), (X, ONE)]),
            of(&[(ONE, D), (D, ONE)]),
            of(&[(ONE, XX), (X, X), (XX, ONE)]),
            of(&[(ONE, XD), (X, D), (D, X), (XD, ONE)]),
        ])
    }

    pub fn times_integer(&self, n: i64) -> Self {
        let bits = |x: &Affine| x.centre.bits();
        Self::new(self.coefficients.clone().map(|x| x.map(|x| scaled(&x, &Real::int(n, bits(&x))))))
    }

    pub fn times_real(&self, factor: &Real) -> Self {
        Self::new(self.coefficients.clone().map(|x| x.map(|x| scaled(&x, factor))))
    }

    /// A function of the jet, by the function's value and its first two derivatives.
    fn of(&self, [f, first, second]: [Affine; 3]) -> Self {
        let rest = Self { coefficients: { [None, self.part(X), self.part(D), self.part(XX), self.part(XD)] } };
        let bits = f.centre.bits();
        let halved = scaled(&second, &Real::int(1, bits).half());
        let first = Self::constant_of(first).times(&rest);
        let second = Self::constant_of(halved).times(&rest.times(&rest));
        Self::constant_of(f).plus(&first).plus(&second)
    }

    fn part(&self, power: usize) -> Option<Affine> {
        self.coefficients[power].clone()
    }

    /// Sine and cosine.
    pub fn sin_cos(&self, bits: u32) -> (Self, Self) {
        let (s, c) = sin_cos(&self.value(bits));
        let [minus_s, minus_c] = [&s, &c].map(|x| scaled(x, &Real::int(-1, bits)));
        (self.of([s.clone(), c.clone(), minus_s.clone()]), self.of([c, minus_s, minus_c]))
    }

    /// The quotient; `None` where the divisor may be 0.
    pub fn over(&self, divisor: &Self, bits: u32) -> Option<Self> {
        let inverse = inverse(&divisor.value(bits))?;
        let square = product(&inverse, &inverse);
        let cube = product(&square, &inverse);
        let [first, second] = [(&square, -1), (&cube, 2)].map(|(x, n)| scaled(x, &Real::int(n, bits)));
        Some(self.times(&divisor.of([inverse, first, second])))
    }

    /// The square root; `None` where the value may not be positive.
    pub fn sqrt(&self, bits: u32) -> Option<Self> {
        let value = self.value(bits);
        let hull = value.hull();
        if !hull.is_positive() {
            return None;
        }
        let half = Real::int(1, bits).half();
        let slope = half.over(&hull.sqrt()?)?;
        let root = Affine::of(value.centre.sqrt()?, &[(&slope, &value)]);
        let first = scaled(&inverse(&root)?, &half);
        let second = scaled(&product(&first, &inverse(&value)?), &-half);
        Some(self.of([root, first, second]))
    }
}

/// The sum of two quantities.
pub(in crate::check) fn sum(a: &Affine, b: &Affine) -> Affine {
    if a.is_fixed() && b.is_fixed() {
        return Affine::fixed(a.centre.clone() + &b.centre);
    }
    let one = Real::int(1, a.centre.bits());
    Affine::of(a.centre.clone() + &b.centre, &[(&one, a), (&one, b)])
}

/// The product of two quantities.
pub(in crate::check) fn product(a: &Affine, b: &Affine) -> Affine {
    if a.is_fixed() && b.is_fixed() {
        return Affine::fixed(a.centre.clone() * &b.centre);
    }
    let (of_a, of_b) = (b.hull(), a.hull());
    Affine::of(a.centre.clone() * &b.centre, &[(&of_a, a), (&of_b, b)])
}

/// The product of `x` and a number.
pub(in crate::check) fn scaled(x: &Affine, factor: &Real) -> Affine {
    Affine::of(x.centre.clone() * factor, &[(factor, x)])
}

fn sin_cos(x: &Affine) -> (Affine, Affine) {
    let ((s, c), (slope_of_c, slope_of_s)) = (x.centre.sin_cos(), x.hull().sin_cos());
    (Affine::of(s, &[(&slope_of_s, x)]), Affine::of(c, &[(&-slope_of_c, x)]))
}

/// The reciprocal; `None` where `x` may be 0.
fn inverse(x: &Affine) -> Option<Affine> {
    let one = Real::int(1, x.centre.bits());
    let slope = one.over(&x.hull().square())?;
    Some(Affine::of(one.over(&x.centre)?, &[(&-slope, x)]))
}
