//! How far the manifolds of the saddle are analytic, proved for complex parameters and a complex `D` (Lemma V18).
//!
//! With `x`, `y`, `z` the phases of three consecutive impacts, all flights to the far wall, the motion is
//! `E(x, y, z) = c(y, z) - e c(x, y) - (1 + e) cos y = 0`, `c(x, y) = (D - sin x - sin y)/(y + pi - x)` the slope of the flight.

use super::disc::{Disc, most};
use super::saddle::Law;
use impact_pair_exact::{Dyadic, Real};

/// Bits of the arithmetic of the suprema.
const BITS: u32 = 128;
/// Radii of the disc of the parameter that are tried, as powers of 2.
const RADII: std::ops::RangeInclusive<i64> = 3..=12;
/// How often the bound of the remainder is doubled.
const DOUBLED: u32 = 4;
/// The radius of the disc of `D`, as a power of 2.
pub(super) const GAP_RADIUS: i64 = -16;

/// Which manifold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Unstable,
    Stable,
}

/// `theta(sigma) = theta_p + sigma + h(sigma)` is analytic for `abs(sigma) <= radius` and all complex `D` at most
/// `2^GAP_RADIUS` from a real one, with `abs(h) <= bound (abs(sigma)/radius)^2`.
#[derive(Clone, Debug)]
pub(super) struct Domain {
    pub radius: Real,
    pub bound: Real,
}

/// The phases of the saddle and its eigenvalues for all `D` of the disc.
struct Around<'l> {
    law: &'l Law,
    gap: Disc,
    phase: Disc,
    /// An upper bound of the absolute value of what `sigma` is multiplied with towards the saddle.
    ratio: Real,
    side: Side,
}

/// The derivatives of `E`: by the phase of the largest deviation first.
type Slopes = [Disc; 3];

impl<'l> Around<'l> {
    /// Lemma V18: Newton's iteration maps each disc into itself, for each `D`.
    fn new(law: &'l Law, [gap, phase, unstable, stable]: [&Real; 4], side: Side) -> Option<Self> {
        let bits = BITS;
        let (one, two) = (Real::int(1, bits), Real::int(2, bits));
        let radius = Real::point(Dyadic::power_of_two(GAP_RADIUS), bits);
        let steep = law.gap_slope(phase);
        let around = (radius.clone() * 2).over(&Real::point(steep.enclosure().mig(), bits))?;
        let phase = Disc::new(phase.clone(), around);
        let (s, c) = phase.sin_cos()?;
        let slope = c.times_real(&two).minus(&s.times_real(&(law.pi.clone() * &law.kappa)));
        let change = slope.times_real(&one.over(&steep)?).minus(&Disc::new(one.clone(), Real::zero(bits)));
        if !(change.mag() * 2).is_below(&one) {
            return None;
        }
        let tangent = s.times(&c.inverse()?);
        let factor = (law.pi.clone() * &(one.clone() - &law.e.square())).half();
        let trace = tangent.times_real(&factor).plus(&Disc::new(law.e.clone() * 2, Real::zero(bits)));
        // The trace of the disc, and that of the real value in its middle.
        let off = trace.minus(&Disc::new(unstable.clone() + stable, Real::zero(bits))).mag();
        let size = |x: &Real| Real::point(x.enclosure().mig(), bits);
        let (own, apart) = (if side == Side::Unstable { unstable } else { stable }, size(&(unstable.clone() - stable)));
        let reach = (most(own) * &off * 2).over(&apart)?;
        if !((reach.clone() * 2 + &off) * 2).is_below(&apart) {
            return None;
        }
        let ratio = match side {
            Side::Unstable => one.over(&(size(own) - &reach))?,
            Side::Stable => most(own) + &reach,
        };
        let ratio = most(&ratio);
        ratio.is_below(&one).then(|| Self { law, gap: Disc::new(gap.clone(), radius), phase, ratio, side })
    }

    /// The derivatives of `E` where the phases deviate from the saddle by at most this, the largest deviation first.
    fn slopes(&self, deviations: [Real; 3]) -> Option<Slopes> {
        let Law { e, pi, .. } = self.law;
        let zero = Real::zero(BITS);
        let at = deviations.map(|by| self.phase.plus(&Disc::new(zero.clone(), by)));
        let [x, y, z] = if self.side == Side::Stable {
            at
        } else {
            let [z, y, x] = at;
            [x, y, z]
        };
        let [x, y, z] = [(x.sin_cos()?, x), (y.sin_cos()?, y), (z.sin_cos()?, z)];
        let of_flight = |((s0, c0), from): &((Disc, Disc), Disc), ((s1, c1), to): &((Disc, Disc), Disc)| {
            // The phases are those of one fixed point, whose own deviations cancel.
            let time = to.minus(from).plus(&Disc::new(pi.clone(), zero.clone())).inverse()?;
            let slope = self.gap.minus(s0).minus(s1).times(&time);
            Some([slope.minus(c0).times(&time), slope.plus(c1).times(&time).times_real(&Real::int(-1, BITS))])
        };
        let ([first_x, first_y], [second_y, second_z]) = (of_flight(&x, &y)?, of_flight(&y, &z)?);
        let by_x = first_x.times_real(&-e.clone());
        let by_y = second_y.minus(&first_y.times_real(e)).plus(&y.0.0.times_real(&(e.clone() + 1)));
        Some(if self.side == Side::Stable { [by_x, by_y, second_z] } else { [second_z, by_y, by_x] })
    }

    /// The deviations of three consecutive phases where `abs(sigma) <= radius` and `h` has this bound.
    fn deviations(&self, radius: &Real, bound: &Real) -> [Real; 3] {
        let square = self.ratio.square();
        let linear = [radius.clone(), radius.clone() * &self.ratio, radius.clone() * &square];
        let rest = [bound.clone(), bound.clone() * &square, bound.clone() * &square.square()];
        let [a, b, c] = linear;
        let [d, e, f] = rest;
        [a + &d, b + &e, c + &f]
    }

    fn domain(&self, radius: &Real) -> Option<Domain> {
        let zero = Real::zero(BITS);
        let at = self.slopes([zero.clone(), zero.clone(), zero.clone()])?;
        let least = at[0].mig();
        if !least.is_positive() {
            return None;
        }
        let (ratio, square) = (&self.ratio, self.ratio.square());
        let change = |slopes: &Slopes, i: usize| slopes[i].minus(&at[i]).mag();
        let linear = self.slopes(self.deviations(radius, &zero))?;
        let defect = change(&linear, 0) + &(change(&linear, 1) * ratio) + &(change(&linear, 2) * &square);
        let defect = (defect * radius).over(&least)?;
        let mut bound = most(&(defect.clone() * 2));
        for _ in 0..DOUBLED {
            let slopes = self.slopes(self.deviations(radius, &bound))?;
            let contraction = change(&slopes, 0) + &(slopes[1].mag() * &square) + &(slopes[2].mag() * &square.square());
            let contraction = contraction.over(&least)?;
            let mapped = defect.clone() + &(contraction.clone() * &bound);
            if contraction.is_below(&Real::int(1, BITS)) && mapped.is_below(&bound) {
                return Some(Domain { radius: radius.clone(), bound });
            }
            bound = bound * 2;
        }
        None
    }
}

impl Domain {
    /// Returns the largest disc tried for which it is proved, of the saddle at a real `gap` in its middle.
    pub fn new(law: &Law, real: [&Real; 4], side: Side) -> Option<Self> {
        let law = Law { e: law.e.rounded(BITS), kappa: law.kappa.rounded(BITS), pi: law.pi.rounded(BITS) };
        let real = real.map(|x| x.rounded(BITS));
        let around = Around::new(&law, real.each_ref(), side)?;
        RADII.into_iter().find_map(|size| around.domain(&Real::point(Dyadic::power_of_two(-size), BITS)))
    }
}
