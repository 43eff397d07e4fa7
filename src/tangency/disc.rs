//! Complex discs with real centres: Lemma J1 of `docs/proofs/tangency.md#J1`.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use crate::number::{ABOVE_TWO_PI, Ball, Number, Wave, up};

/// All complex numbers within the radius of a ball's centre.
///
/// **Enclosure**: the result of an operation on discs holds the result for every choice of their members.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc(Ball);

impl Disc {
    /// The disc with the centre and the radius of a ball.
    pub fn new(x: Ball) -> Self {
        Self(x)
    }

    /// The ball with the same centre and radius.
    pub fn ball(self) -> Ball {
        self.0
    }

    /// An upper bound of the absolute values inside.
    pub fn mag(self) -> f64 {
        self.0.mag()
    }
}

impl Add for Disc {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self(self.0 + b.0)
    }
}

impl Sub for Disc {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self(self.0 - b.0)
    }
}

impl Mul for Disc {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self(self.0 * b.0)
    }
}

impl Neg for Disc {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Number for Disc {
    fn from_f64(x: f64) -> Self {
        Self(Ball::exact(x))
    }

    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    fn checked_div(self, b: Self) -> Option<Self> {
        self.0.checked_div(b.0).map(Self)
    }

    fn turn(&self) -> Self {
        Self(self.0.turn())
    }

    fn signed(self, sign: f64) -> Self {
        Self(self.0.signed(sign))
    }
}

impl Wave for Disc {
    /// Lemma J1; no bound where the radius is greater than 1 in radians.
    fn wave(&self) -> (Self, Self) {
        let (sin, cos) = Ball::exact(self.0.mid()).sin_cos();
        let radius = up(ABOVE_TWO_PI * self.0.rad());
        // A NaN is refused as well.
        if radius.partial_cmp(&1.0).is_none_or(Ordering::is_gt) {
            let unbounded = Self(Ball::new(0.0, f64::INFINITY));
            return (unbounded, unbounded);
        }
        let square = up(radius * radius);
        let (along, across) = (up(radius * (1.0 + 0.2 * square)), up(0.55 * square));
        let moved = |x: Ball, slope: Ball| Self(x.widened(up(slope.mag() * along + x.mag() * across)));
        (moved(sin, cos), moved(cos, sin))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Complex;

    /// Against the sines of complex numbers on the rims of discs.
    #[test]
    fn sines_of_discs_hold_those_of_complex_numbers() {
        for i in 0..400 {
            let [mid, rad] = [0.037 * f64::from(i) - 3.0, 0.159 * f64::from(i % 37) / 37.0];
            let (sin, cos) = Disc(Ball::new(mid, rad)).wave();
            for k in 0..16 {
                let z =
                    Complex::from_polar(rad * std::f64::consts::TAU, f64::from(k) * 0.4) + mid * std::f64::consts::TAU;
                for (found, value) in [(sin, z.sin()), (cos, z.cos())] {
                    assert!((value - found.0.mid()).norm() <= found.0.rad() + 1e-13, "{mid} {rad}");
                }
            }
        }
    }
}
