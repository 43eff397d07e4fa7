//! Discs of complex numbers around real numbers, for suprema of analytic functions.

use impact_pair_exact::Real;

/// All complex numbers within `radius` of a member of `centre`.
#[derive(Clone, Debug)]
pub(super) struct Disc {
    centre: Real,
    radius: Real,
}

/// An upper bound of the absolute values.
pub(super) fn most(x: &Real) -> Real {
    Real::point(x.enclosure().mag(), x.bits())
}

impl Disc {
    pub fn new(centre: Real, radius: Real) -> Self {
        Self { centre, radius: most(&radius) }
    }

    /// Upper bound of the absolute values.
    pub fn mag(&self) -> Real {
        most(&(most(&self.centre) + &self.radius))
    }

    /// Lower bound of the absolute values; not positive where 0 may be a member.
    pub fn mig(&self) -> Real {
        let least = Real::point(self.centre.enclosure().mig(), self.centre.bits()) - &self.radius;
        least.ends()[0].clone()
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self::new(self.centre.clone() + &other.centre, self.radius.clone() + &other.radius)
    }

    pub fn minus(&self, other: &Self) -> Self {
        Self::new(self.centre.clone() - &other.centre, self.radius.clone() + &other.radius)
    }

    /// `ab - a0 b0 = a0 (b - b0) + b0 (a - a0) + (a - a0)(b - b0)`
    pub fn times(&self, other: &Self) -> Self {
        let [a, b] = [&self.centre, &other.centre].map(most);
        let radius = a * &other.radius + &(b * &self.radius) + &(self.radius.clone() * &other.radius);
        Self::new(self.centre.clone() * &other.centre, radius)
    }

    pub fn times_real(&self, factor: &Real) -> Self {
        Self::new(self.centre.clone() * factor, self.radius.clone() * &most(factor))
    }

    /// The reciprocals: `1/b - 1/b0 = (b0 - b)/(b b0)`; `None` where 0 may be a member.
    pub fn inverse(&self) -> Option<Self> {
        let (least, bits) = (self.mig(), self.centre.bits());
        if !least.is_positive() {
            return None;
        }
        let one = Real::int(1, bits);
        let nearest = Real::point(self.centre.enclosure().mig(), bits);
        Some(Self::new(one.over(&self.centre)?, self.radius.over(&(nearest * &least))?))
    }

    /// Sine and cosine, for a radius of at most 1 (Lemma V18): `abs(sin d) <= sinh r <= r + r^3/5`,
    /// `abs(cos d - 1) <= cosh r - 1 <= r^2/2 + r^4/20`.
    pub fn sin_cos(&self) -> Option<(Self, Self)> {
        let (r, bits) = (&self.radius, self.centre.bits());
        let one = Real::int(1, bits);
        if one.is_below(r) {
            return None;
        }
        let square = r.square();
        let odd = r.clone() + &(square.clone() * r).over(&Real::int(5, bits))?;
        let even = square.half() + &square.square().over(&Real::int(20, bits))?;
        let (s, c) = self.centre.sin_cos();
        let [abs_s, abs_c] = [&s, &c].map(most);
        let of_sine = abs_c.clone() * &odd + &(abs_s.clone() * &even);
        let of_cosine = abs_s * &odd + &(abs_c * &even);
        Some((Self::new(s, of_sine), Self::new(c, of_cosine)))
    }
}
