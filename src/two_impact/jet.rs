//! A number and its derivative: one formula gives the enclosures of a function and of its slope.
//!
//! Not in intervals of doubles: zeros are isolated as far as half of the bits of the requested digits, near folds more (Lemma W6).

use std::ops::{Add, Mul, Sub};

use crate::exact::Dyadic;

use crate::exact::Real;

/// Values and slopes of a function over a set of arguments.
///
/// **Enclosure**: for every argument in the set, its value lies in `value`, its derivative in `slope`.
#[derive(Clone, Debug)]
pub(super) struct Jet {
    pub value: Real,
    pub slope: Real,
}

impl Jet {
    /// Jet of the argument: slope 1.
    pub fn argument(x: &Real) -> Self {
        Self { value: x.clone(), slope: Real::int(1, x.bits()) }
    }

    /// Jet of a number that does not depend on the argument.
    pub fn constant(x: &Real) -> Self {
        Self { value: x.clone(), slope: Real::int(0, x.bits()) }
    }

    pub fn square(&self) -> Self {
        Self { value: self.value.square(), slope: &self.value * &self.slope * 2 }
    }

    /// Square root; `None` where it may be 0, so that it has no slope.
    pub fn sqrt(&self) -> Option<Self> {
        let value = self.value.sqrt()?;
        let slope = self.slope.half().over(&value)?;
        Some(Self { value, slope })
    }

    pub fn sin(&self) -> Self {
        Self { value: self.value.sin(), slope: self.value.cos() * &self.slope }
    }

    pub fn cos(&self) -> Self {
        Self { value: self.value.cos(), slope: -(self.value.sin() * &self.slope) }
    }

    /// `S = sin x / x` for sets of `0 <= x <= 3`, by `S` and `T = -S'/x` at their ends (Lemma W6).
    pub fn sinc(&self) -> Self {
        let x = &self.value;
        let [low, high] = x.ends().map(|end| sinc_and_fall(&end));
        Self { value: low.0.hull(&high.0), slope: -(x * low.1.hull(&high.1)) * &self.slope }
    }

    /// `sin x / x` for sets that do not hold 0.
    pub fn sin_over(&self) -> Option<Self> {
        let x = &self.value;
        let value = x.sin().over(x)?;
        let slope = (x.cos() - &value).over(x)?;
        Some(Self { value, slope: slope * &self.slope })
    }

    /// Cuts the values over `x` by the mean value theorem, from `f` at the middle.
    pub fn cut(self, x: &Real, f: impl Fn(&Real) -> Option<Jet>) -> Self {
        let middle = x.middle();
        if x.wid() == Dyadic::zero() {
            return self;
        }
        let Some(there) = f(&middle) else { return self };
        let mean = there.value + &self.slope * (x - middle);
        let value = self.value.intersection(&mean).expect("both hold the values");
        Self { value, slope: self.slope }
    }

    /// The jet, or its negative.
    pub fn signed(&self, is_positive: bool) -> Self {
        if is_positive { self.clone() } else { Self { value: -&self.value, slope: -&self.slope } }
    }
}

/// `sin x / x` and `(sin x - x cos x)/x^3` at a point.
fn sinc_and_fall(x: &Real) -> (Real, Real) {
    let cubed = || (x.sin() - x * x.cos()).over(&(x.square() * x));
    match (x.sin().over(x), cubed()) {
        (Some(value), Some(fall)) => (value, fall),
        _ => {
            let one = Real::int(1, x.bits());
            let third = one.over(&Real::int(3, x.bits())).expect("3 is not 0");
            (one, third)
        }
    }
}

impl Add for &Jet {
    type Output = Jet;
    fn add(self, b: &Jet) -> Jet {
        Jet { value: &self.value + &b.value, slope: &self.slope + &b.slope }
    }
}

impl Sub for &Jet {
    type Output = Jet;
    fn sub(self, b: &Jet) -> Jet {
        Jet { value: &self.value - &b.value, slope: &self.slope - &b.slope }
    }
}

impl Mul for &Jet {
    type Output = Jet;
    fn mul(self, b: &Jet) -> Jet {
        Jet { value: &self.value * &b.value, slope: &self.slope * &b.value + &self.value * &b.slope }
    }
}

impl Mul<i64> for &Jet {
    type Output = Jet;
    fn mul(self, b: i64) -> Jet {
        Jet { value: &self.value * b, slope: &self.slope * b }
    }
}
