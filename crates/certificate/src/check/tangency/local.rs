//! Discs in which the manifolds of the saddle are analytic, for complex parameters and a complex `D` or `e` (Lemmas V18, V29).
//!
//! With `x`, `y`, `z` the phases of three consecutive impacts, all flights to the far wall, the motion is
//! `E(x, y, z) = c(y, z) - e c(x, y) - (1 + e) cos y = 0`, `c(x, y) = (D - sin x - sin y)/(y + pi - x)` the slope of the flight.

use super::disc::{Disc, most};
use impact_pair_exact::{Dyadic, Real};

/// Bits of the arithmetic of the suprema.
const BITS: u32 = 128;
/// Radii of the disc of the manifold's parameter that are tried, as powers of 2.
const RADIUS_EXPONENTS: std::ops::RangeInclusive<i64> = 3..=12;
/// Number of doublings of the bound of the remainder.
const REMAINDER_DOUBLINGS: u32 = 4;
/// The radius of the disc of the parameter of the tangency, `D` or `e`, as a power of 2.
pub(super) const PARAMETER_RADIUS_EXPONENT: i64 = -16;

/// A manifold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Unstable,
    Stable,
}

/// `theta(sigma) = theta_p + sigma + h(sigma)` is analytic for `abs(sigma) <= radius` and all complex `D`, or `e`, at
/// most `2^PARAMETER_RADIUS_EXPONENT` from a real one, with `abs(h) <= bound (abs(sigma)/radius)^2`.
#[derive(Clone, Debug)]
pub(super) struct Domain {
    pub radius: Real,
    pub bound: Real,
}

/// The data, the phases of the saddle and its eigenvalues for all values of the disc.
struct DiscData {
    gap: Disc,
    e: Disc,
    pi: Real,
    phase: Disc,
    /// Upper bound of the absolute value of the factor that multiplies `sigma` towards the saddle.
    ratio: Real,
    side: Side,
}

/// The derivatives of `E`; the derivative by the phase with the largest deviation comes first.
type Slopes = [Disc; 3];

impl DiscData {
    /// Lemma V18: Newton's iteration maps each disc into itself, for each complex value of the parameter.
    fn new([gap, e, phase, unstable, stable]: [&Real; 5], is_restitution: bool, side: Side) -> Option<Self> {
        let bits = BITS;
        let (one, two, pi) = (Real::int(1, bits), Real::int(2, bits), Real::pi(bits));
        let real = |x: Real| Disc::new(x, Real::zero(bits));
        let radius = Real::point(Dyadic::power_of_two(PARAMETER_RADIUS_EXPONENT), bits);
        let around = Disc::new(if is_restitution { e } else { gap }.clone(), radius);
        let [gap_disc, e_disc] = if is_restitution { [real(gap.clone()), around] } else { [around, real(e.clone())] };
        let kappa = |e: &Disc| Some(real(one.clone()).plus(e).times(&real(one.clone()).minus(e).inverse()?));
        let pi_kappa = kappa(&e_disc)?.times_real(&pi);
        let at_middle = kappa(&real(e.clone()))?.times_real(&pi);
        let slope = |pi_kappa: &Disc, (s, c): &(Disc, Disc)| c.times_real(&two).minus(&s.times(pi_kappa));
        let waves = real(phase.clone()).sin_cos()?;
        let steep = slope(&at_middle, &waves);
        // The first step of Newton's iteration from the real phase, doubled.
        let miss = pi_kappa.minus(&at_middle).times(&waves.1).minus(&gap_disc.minus(&real(gap.clone())));
        let first = miss.mag().over(&Real::point(steep.mig().enclosure().mig(), bits))?;
        let phase = Disc::new(phase.clone(), first * 2);
        let (s, c) = phase.sin_cos()?;
        let change = slope(&pi_kappa, &(s.clone(), c.clone())).times(&steep.inverse()?).minus(&real(one.clone()));
        if !(change.mag() * 2).is_below(&one) {
            return None;
        }
        let square = e_disc.times(&e_disc);
        let factor = real(one.clone()).minus(&square).times_real(&pi.half());
        let trace = s.times(&c.inverse()?).times(&factor).plus(&e_disc.times_real(&two));
        // Trace and determinant of the disc, compared with those of the real value in its middle.
        let off = trace.minus(&real(unstable.clone() + stable)).mag();
        let off_square = square.minus(&real(e.square())).mag();
        let size = |x: &Real| Real::point(x.enclosure().mig(), bits);
        let (own, apart) = (if side == Side::Unstable { unstable } else { stable }, size(&(unstable.clone() - stable)));
        let reach = ((most(own) * &off + &off_square) * 2).over(&apart)?;
        if !((reach.clone() * 2 + &off) * 2).is_below(&apart) {
            return None;
        }
        let ratio = match side {
            Side::Unstable => one.over(&(size(own) - &reach))?,
            Side::Stable => most(own) + &reach,
        };
        let ratio = most(&ratio);
        ratio.is_below(&one).then_some(Self { gap: gap_disc, e: e_disc, pi, phase, ratio, side })
    }

    /// The derivatives of `E` where the phases deviate from the saddle by at most `deviations`, the largest deviation first.
    fn slopes(&self, deviations: [Real; 3]) -> Option<Slopes> {
        let Self { e, pi, .. } = self;
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
            // The phases belong to one fixed point, whose own deviations cancel.
            let time = to.minus(from).plus(&Disc::new(pi.clone(), zero.clone())).inverse()?;
            let slope = self.gap.minus(s0).minus(s1).times(&time);
            Some([slope.minus(c0).times(&time), slope.plus(c1).times(&time).times_real(&Real::int(-1, BITS))])
        };
        let ([first_x, first_y], [second_y, second_z]) = (of_flight(&x, &y)?, of_flight(&y, &z)?);
        let by_x = first_x.times(e).times_real(&Real::int(-1, BITS));
        let more = e.plus(&Disc::new(Real::int(1, BITS), zero));
        let by_y = second_y.minus(&first_y.times(e)).plus(&y.0.0.times(&more));
        Some(if self.side == Side::Stable { [by_x, by_y, second_z] } else { [second_z, by_y, by_x] })
    }

    /// The deviations of three consecutive phases where `abs(sigma) <= radius` and `h` is bounded by `bound`.
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
        for _ in 0..REMAINDER_DOUBLINGS {
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
    /// The largest of the tried discs that is proved, from the real `D`, `e`, phase and eigenvalues (unstable, stable) at the middle.
    pub fn new(real: [&Real; 5], is_restitution: bool, side: Side) -> Option<Self> {
        let real = real.map(|x| x.rounded(BITS));
        let around = DiscData::new(real.each_ref(), is_restitution, side)?;
        RADIUS_EXPONENTS.into_iter().find_map(|size| around.domain(&Real::point(Dyadic::power_of_two(-size), BITS)))
    }
}
