//! Angles whose sine and cosine are known, and what follows for angles near by (Lemma V1, angles).

use super::number::Number;
use impact_pair_exact::Real;

/// log2 of the widths beyond which the middle of a set is worth a sine and a cosine of its own.
const WIDE_EXPONENT: i64 = -8;

/// An angle with its sine and cosine.
#[derive(Clone, Debug)]
pub(crate) struct Angle<N = Real> {
    pub at: N,
    pub sin: N,
    pub cos: N,
}

impl<N: Number> Angle<N> {
    pub fn new(at: N) -> Self {
        let (sin, cos) = at.sine_and_cosine();
        Self { at, sin, cos }
    }

    /// The angle, rounded outward to fewer bits.
    pub fn rounded(&self, bits: u32) -> Self {
        let [at, sin, cos] = [&self.at, &self.sin, &self.cos].map(|x| x.rounded(bits));
        Self { at, sin, cos }
    }

    /// All angles of a set that holds this one, with values as far from the known ones as the angles are. `None` if the set does not
    /// hold this angle, or is wide.
    pub fn widened(&self, at: &N) -> Option<Self> {
        if !at.holds(&self.at) {
            return None;
        }
        if self.at.holds(at) {
            return Some(self.clone());
        }
        let off = at.clone() - &self.at;
        if off.top().is_none_or(|top| top >= WIDE_EXPONENT) {
            return None;
        }
        let off = off.hull(&-off.clone());
        let [sin, cos] = [&self.sin, &self.cos].map(|x| x.clone() + &off);
        Some(Self { at: at.clone(), sin, cos })
    }

    /// All angles of a set that may hold this one.
    pub fn around(&self, at: N) -> Self {
        self.widened(&at).unwrap_or_else(|| Self::new(at))
    }
}

impl Angle {
    /// A near angle, by the addition theorems; `None` if it is not near enough for that, or known in fewer bits.
    pub fn turned(&self, at: &Real) -> Option<Self> {
        let x = at.clone() - &self.at;
        let is_near = x.top().is_none_or(|top| 3 * (top + 1) < -i64::from(at.bits()));
        if !is_near || self.sin.bits() < at.bits() {
            return None;
        }
        // sin x is between x and x - x^3/4, 1 - cos x between x^2/2 and x^2/2 - x^4/16.
        let (square, part) = (x.square(), Real::zero(at.bits()).hull(&Real::int(1, at.bits())));
        let sin = x.clone() - &(x * &square * &part).half().half();
        let away = (square.clone() - &(square.square() * &part).half().half().half()).half();
        Some(Self {
            at: at.clone(),
            sin: self.sin.clone() + &(self.cos.clone() * &sin - &(self.sin.clone() * &away)),
            cos: self.cos.clone() - &(self.sin.clone() * &sin + &(self.cos.clone() * &away)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_pair_exact::Dyadic;
    use proptest::prelude::*;

    proptest! {
        /// Known sines of near angles and of sets are compared with those in more bits.
        #[test]
        fn near_angles_hold_sines_of_more_bits(
            m: i64, e in -70i64..-50, off in any::<i64>(), scale in -140i64..-60, own in 0..2i64, bits in 64u32..256, less in -32i32..64
        ) {
            let point = |m: i64, e: i64, bits| Real::point(Dyadic::new(m.into(), e), bits);
            let (at, off) = (point(m, e, 256), point(off, scale, 256));
            let own = Real::within(&Dyadic::power_of_two(-300), 512) * own + &at;
            let angle = Angle::new(own.at(bits));
            let to = (at.clone() + &off).at(bits.saturating_add_signed(-less));
            let set = at.hull(&to).hull(&own).at(bits);
            let truth = |x: &Real| [x.at(600).sin(), x.at(600).cos()];
            let holds = |found: &Angle, x: &Real| {
                let [sin, cos] = truth(&Real::point(x.mid(), 600));
                found.sin.holds(&sin) && found.cos.holds(&cos)
            };
            if let Some(found) = angle.turned(&to) {
                prop_assert!(holds(&found, &to) && found.sin.wid() <= Dyadic::power_of_two(8 - i64::from(to.bits())));
            }
            if let Some(found) = angle.widened(&set) {
                prop_assert!(holds(&found, &at) && holds(&found, &to));
            }
        }
    }
}
