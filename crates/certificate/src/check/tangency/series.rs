//! A manifold of the saddle as a power series with a proved remainder (Lemmas V17, V18).

use super::jet::{self, Jet};
use super::local::{Domain, PARAMETER_RADIUS_EXPONENT, Side};
use super::saddle::{Law, Saddle};
use crate::check::affine::Affine;
use impact_pair_exact::{Dyadic, Real};

/// Greatest number of coefficients.
const MAX_COEFFICIENTS: usize = 256;
/// Bits of the bound of the remainder.
const SHORT_BITS: u32 = 64;

/// `theta(sigma)` with `theta' = 1` at the saddle.
pub(super) struct Series {
    side: Side,
    /// The factor by which the map multiplies `sigma`.
    ratio: Jet,
    phases: Vec<Jet>,
    domain: Domain,
}

/// A point of a manifold, as a jet in the manifold's parameter and the law's parameter.
#[derive(Clone, Debug)]
pub(in crate::check) struct State {
    /// `theta` \[rad\]
    pub phase: Jet,
    /// `w = abs(v)/(A W)`, before the impact.
    pub speed: Jet,
}

impl Series {
    /// As many coefficients as make the remainder for `abs(sigma) <= most` less than `2^-bits`; `None` if this
    /// is not proved.
    pub fn new(law: &Law, saddle: &Saddle, (side, domain): (Side, Domain), most: &Real) -> Option<Self> {
        let (bits, gap) = (law.bits(), &law.gap);
        let ratio = if side == Side::Unstable { &saddle.unstable } else { &saddle.stable }.clone();
        let count = domain.count(most, bits)?;
        let mut phases = vec![saddle.phase.clone()];
        let (s, c) = saddle.phase.sin_cos(bits);
        let (pi, e) = (Jet::constant(law.pi.clone()), &law.e);
        let twice = s.times_integer(2);
        let mut slopes = vec![gap.minus(&twice).over(&pi, bits)?];
        let (mut sines, mut cosines) = (vec![s.clone()], vec![c.clone()]);
        let (mut power, one) = (Jet::constant(Real::int(1, bits)), Jet::constant(Real::int(1, bits)));
        let more = one.plus(e);
        let mut times: Vec<Jet> = vec![pi.clone()];
        for n in 1..=count {
            power = power.times(&ratio);
            let of = |list: &[Jet]| {
                let terms = (1..n).map(|j| phases[j].times(&list[n - j]).times_integer(j as i64)); // exact: a count
                terms.reduce(|sum, x| sum.plus(&x))
            };
            let divided = |x: Option<Jet>| x.map(|x| x.times_real(&reciprocal(n, bits)));
            let (sine, cosine) = (divided(of(&cosines)), divided(of(&sines).map(|x| x.times_integer(-1))));
            // k_n = (1 + e) L^n c_n/(L^n - e)
            let factor = power.times(&more).over(&power.minus(e), bits)?;
            let next = if n == 1 {
                one.clone()
            } else {
                let products = (1..n).map(|j| slopes[j].times(&times[n - j])).reduce(|sum, x| sum.plus(&x))?;
                let one_more = power.plus(&one);
                let known =
                    products.plus(&factor.times(&pi).times(&cosine.clone()?)).plus(&one_more.times(&sine.clone()?));
                let by_phase =
                    slopes[0].times(&power.minus(&one)).plus(&one_more.times(&c)).minus(&factor.times(&pi).times(&s));
                known.times_integer(-1).over(&by_phase, bits)?
            };
            let with = |own: Jet, known: Option<Jet>| known.map_or(own.clone(), |known| own.plus(&known)); // exact: it is 0
            sines.push(with(c.times(&next), sine));
            cosines.push(with(s.times(&next).times_integer(-1), cosine));
            slopes.push(factor.times(&cosines[n]));
            times.push(power.minus(&one).times(&next));
            phases.push(next);
        }
        Some(Self { side, ratio, phases, domain })
    }

    /// The phase at a parameter with values of size at most `most`, with the remainder.
    fn phase(&self, sigma: &Jet, most: &Real, bits: u32) -> Option<Jet> {
        let sum = self.phases.iter().rev().fold(None, |sum: Option<Jet>, coefficient| {
            Some(sum.map_or_else(|| coefficient.clone(), |sum| sum.times(sigma).plus(coefficient)))
        })?;
        Some(sum.plus(&self.domain.rest(self.phases.len() - 1, most, bits)?))
    }

    /// The point with the parameter `sigma + x`.
    pub fn at(&self, law: &Law, sigma: &Affine) -> Option<State> {
        let bits = law.bits();
        let most = Real::point(sigma.hull().enclosure().mag(), bits);
        let one = Affine::fixed(Real::int(1, bits));
        let here = Jet::new([Some(sigma.clone()), Some(one), None, None, None]);
        let phase = self.phase(&here, &most, bits)?;
        let (s, c) = phase.sin_cos(bits);
        let pi = Jet::constant(law.pi.clone());
        let flown = |from: &Jet, to: &Jet, sines: Jet| law.gap.minus(&sines).over(&to.minus(from).plus(&pi), bits);
        let speed = match self.side {
            Side::Unstable => {
                let before = self.phase(&here.over(&self.ratio, bits)?, &most, bits)?;
                let (sine, _) = before.sin_cos(bits);
                flown(&before, &phase, sine.plus(&s))?.plus(&c)
            }
            Side::Stable => {
                let after = self.phase(&here.times(&self.ratio), &most, bits)?;
                let (sine, _) = after.sin_cos(bits);
                flown(&phase, &after, sine.plus(&s))?.minus(&c).over(&law.e, bits)?
            }
        };
        Some(State { phase, speed })
    }

    /// Bounds of the phases of the local manifold for `abs(sigma) <= most`, relative to the saddle's phase.
    pub fn deviation(&self, most: &Real) -> Option<Real> {
        Some(most.clone() + &(self.domain.bound.clone() * &most.over(&self.domain.radius)?.square()))
    }
}

fn reciprocal(n: usize, bits: u32) -> Real {
    let n = i64::try_from(n).expect("an order is small"); // exact: a count
    Real::int(1, bits).over(&Real::int(n, bits)).expect("an order is positive")
}

impl Domain {
    /// The order after which the remainder is less than `2^-bits`.
    fn count(&self, most: &Real, bits: u32) -> Option<usize> {
        let ratio = most.rounded(SHORT_BITS).over(&self.radius)?;
        if !ratio.is_below(&Real::int(1, SHORT_BITS).half()) {
            return None;
        }
        let mut power = ratio.clone();
        for n in 2..MAX_COEFFICIENTS {
            power = power * &ratio;
            // proposes: the remainder is bounded for every order
            if power.enclosure().mag().top().is_none_or(|top| top < -i64::from(bits)) {
                return Some(n);
            }
        }
        None
    }

    /// The terms after order `n`, for real `abs(sigma) <= most`. Lemma V18
    fn rest(&self, n: usize, most: &Real, bits: u32) -> Option<Jet> {
        let one = Real::int(1, SHORT_BITS);
        let x = most.rounded(SHORT_BITS).over(&self.radius)?;
        let room = one.clone() - &x;
        if !room.is_positive() {
            return None;
        }
        let power = |n: usize| (0..n).fold(one.clone(), |product, _| product * &x);
        let order = i64::try_from(n + 1).ok()?;
        let below = self.bound.clone() * &power(n - 1);
        let value = (below.clone() * &x.square()).over(&room)?;
        let first = (below.clone() * &x * order).over(&(self.radius.clone() * &room.square()))?;
        let second = (below * (order * (order - 1))).half().over(&(self.radius.square() * &room.square() * &room))?;
        // Cauchy's estimate on half of the disc of the parameter.
        let by_parameter = Real::point(Dyadic::power_of_two(1 - PARAMETER_RADIUS_EXPONENT), bits);
        let ball = |x: Real| Some(Affine::fixed(Real::within(&x.enclosure().mag(), bits)).recentred());
        let [of_parameter, of_both] = [&value, &first].map(|x| ball(x.clone() * &by_parameter));
        let mut terms = [ball(value), ball(first), None, None, None];
        (terms[jet::XX], terms[jet::D], terms[jet::XD]) = (ball(second), of_parameter, of_both);
        Some(Jet::new(terms))
    }
}
