//! A number with its derivative in one direction: what the formulas are evaluated in for Jacobians.

use std::ops::{Add, Mul, Neg, Sub};

use crate::number::kernel::SmallAngle;
use crate::number::{Number, Wave};
use crate::several::PhaseNumber;

/// `x` and `dx`; over balls, of every member, by the rules of differentiation.
#[derive(Clone, Copy, Debug)]
pub struct Jet<N> {
    /// `x`
    pub value: N,
    /// `dx`
    pub slope: N,
}

impl<N: Number> Jet<N> {
    /// Jet of a constant: slope 0.
    pub fn constant(value: N) -> Self {
        Self { value, slope: N::from_f64(0.0) }
    }

    /// Jet of the variable: slope 1.
    pub fn variable(value: N) -> Self {
        Self { value, slope: N::from_f64(1.0) }
    }
}

impl<N: Number> Add for Jet<N> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self { value: self.value + b.value, slope: self.slope + b.slope }
    }
}

impl<N: Number> Sub for Jet<N> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self { value: self.value - b.value, slope: self.slope - b.slope }
    }
}

impl<N: Number> Neg for Jet<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl<N: Number> Mul for Jet<N> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let slope = self.value.clone().mul_add(b.slope, self.slope * b.value.clone());
        Self { value: self.value * b.value, slope }
    }
}

impl<N: Number> Number for Jet<N> {
    fn from_f64(x: f64) -> Self {
        Self::constant(N::from_f64(x))
    }

    fn mul_add(self, b: Self, c: Self) -> Self {
        let slope = self.value.clone().mul_add(b.slope, self.slope.mul_add(b.value.clone(), c.slope));
        Self { value: self.value.mul_add(b.value, c.value), slope }
    }

    fn checked_div(self, b: Self) -> Option<Self> {
        let value = self.value.checked_div(b.value.clone())?;
        // (a/b)' = (a' - (a/b) b')/b
        let slope = (-value.clone()).mul_add(b.slope, self.slope).checked_div(b.value)?;
        Some(Self { value, slope })
    }

    fn turn(&self) -> Self {
        Self::constant(self.value.turn())
    }

    fn signed(self, sign: f64) -> Self {
        Self { value: self.value.signed(sign), slope: self.slope.signed(sign) }
    }
}

impl<N: Wave> Wave for Jet<N> {
    fn wave(&self) -> (Self, Self) {
        let (sin, cos) = self.value.wave();
        let turned = self.value.turn() * self.slope.clone();
        let slopes = (turned.clone() * cos.clone(), -(turned * sin.clone()));
        (Self { value: sin, slope: slopes.0 }, Self { value: cos, slope: slopes.1 })
    }

    fn short(&self) -> Option<SmallAngle<Self>> {
        let SmallAngle { versine, excess, sine } = self.value.short()?;
        let turned = self.value.turn() * self.slope.clone();
        // With x = 2 pi h: (1 - cos x)' = sin x, (x - sin x)' = 1 - cos x, (sin x)' = cos x.
        let slopes = [
            turned.clone() * sine.clone(),
            turned.clone() * versine.clone(),
            (-turned.clone()).mul_add(versine.clone(), turned),
        ];
        let [by_versine, by_excess, by_sine] = slopes;
        Some(SmallAngle {
            versine: Self { value: versine, slope: by_versine },
            excess: Self { value: excess, slope: by_excess },
            sine: Self { value: sine, slope: by_sine },
        })
    }
}

impl<N: PhaseNumber> PhaseNumber for Jet<N> {
    type Counter = N::Counter;

    fn phase_at(counter: &N::Counter, turns: i64) -> Self {
        Self::constant(N::phase_at(counter, turns))
    }

    fn middle(&self) -> f64 {
        self.value.middle()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerances::DIFFERENCE_OF_JETS;
    use approx::assert_abs_diff_eq;

    /// Slopes against central differences.
    #[test]
    fn slopes_are_those_of_differences() {
        let of = |x: Jet<f64>| {
            let (sin, cos) = x.wave();
            let short = (x * Jet::from_f64(0.1)).short().unwrap();
            sin.mul_add(cos, short.versine + short.excess * short.sine).checked_div(x * x + Jet::from_f64(1.0)).unwrap()
        };
        for x in [0.03, 0.2, 0.7, 1.1] {
            let step = 1e-6;
            let difference = (of(Jet::constant(x + step)).value - of(Jet::constant(x - step)).value) / (2.0 * step);
            assert_abs_diff_eq!(of(Jet::variable(x)).slope, difference, epsilon = DIFFERENCE_OF_JETS);
        }
    }
}
