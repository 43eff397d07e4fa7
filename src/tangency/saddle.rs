//! The fixed point of the reduced map, its eigenvalues and which resonances they exclude: Lemma J8 of `docs/proofs/tangency.md#J8`.

use super::flight::{Pair, Parameter, sin_cos};
use super::series::Base;
use super::terms::Terms;
use crate::number::{Ball, Enclosing, Number, logarithm};
use crate::periodic::bifurcation::Jet;

/// A manifold of the fixed point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Unstable,
    Stable,
}

/// The fixed point in floating point. It proposes
#[derive(Clone, Copy, Debug)]
pub(super) struct Guessed {
    pub theta: f64,
    pub speed: f64,
    /// The unstable eigenvalue and the stable one.
    pub lambda: [f64; 2],
}

/// Enclosures of the fixed point and its eigenvalues, with their derivatives by one parameter.
#[derive(Clone, Debug)]
pub(super) struct Saddle<N> {
    pub theta: Jet<N>,
    pub speed: Jet<N>,
    /// The unstable eigenvalue and the stable one.
    pub lambda: [Jet<N>; 2],
    restitution: Jet<N>,
}

impl Guessed {
    /// Saddles among the fixed points of flights of half a forcing period; there are at most two fixed points.
    pub fn all(Pair { gap, restitution: e }: Pair<f64>) -> Vec<Self> {
        let kappa = std::f64::consts::PI * (1.0 + e) / (1.0 - e);
        let (middle, apart) = (2f64.atan2(kappa), (gap / 2f64.hypot(kappa)).acos()); // proposes
        let saddle = |theta: f64| {
            let trace = 2.0 * e + (1.0 - e * e) * std::f64::consts::FRAC_PI_2 * theta.tan();
            let root = (trace * trace - 4.0 * e * e).sqrt();
            let unstable = 0.5 * (trace + root.copysign(trace));
            let found = Self { theta, speed: 2.0 * theta.cos() / (1.0 - e), lambda: [unstable, e * e / unstable] };
            (found.speed > 0.0 && unstable.abs() > 1.0 && found.lambda[1].abs() < 1.0).then_some(found)
        };
        [middle - apart, middle + apart].into_iter().filter_map(saddle).collect()
    }
}

/// The zero of `f` near a guess, by an interval step of Newton's iteration. Lemma T3
pub(super) fn zero<N: Enclosing>(guess: N, f: impl Fn(&N) -> Option<N>, slope: impl Fn(&N) -> Option<N>) -> Option<N> {
    const STEPS: u32 = 10;
    let step = |x: &N, slopes: N| f(x)?.checked_div(slopes);
    let mut x = guess;
    for _ in 0..STEPS {
        x = (x.clone() - step(&x, slope(&x)?)?).centre();
    }
    let mut radius = 2.0 * step(&x, slope(&x)?)?.as_ball().mag();
    for _ in 0..STEPS {
        let domain = x.with_radius(radius);
        let image = x.clone() - step(&x, slope(&domain)?)?;
        if image.is_interior_to(&domain) {
            return Some(image);
        }
        radius *= 2.0;
    }
    None
}

impl<N: Enclosing> Saddle<N> {
    /// Encloses the fixed point near a guess for all `D` and `e` of a pair, and its derivatives by one of them.
    pub fn new(pair: &Pair<N>, by: Parameter, guess: &Guessed) -> Option<Self> {
        let Pair { gap, .. } = pair;
        let moving = pair.moving(by);
        let e = &moving.restitution;
        let fixed = Jet::constant;
        let [one, two] = [1.0, 2.0].map(N::from_f64);
        let rest = fixed(one.clone()) - e.clone();
        let half = gap.turn() * N::from_f64(0.5);
        let kappa = (fixed(half.clone()) * (fixed(one.clone()) + e.clone())).checked_div(rest.clone())?;
        // The centre has as many bits as the parameters.
        let from = |x: f64| gap.centre() - gap.centre() + N::from_f64(x);
        let value = |theta: &N| {
            let (sin, cos) = sin_cos(theta)?;
            Some(kappa.value.times_ref(&cos) + two.times_ref(&sin) - gap.clone())
        };
        let slope = |theta: &N| {
            let (sin, cos) = sin_cos(theta)?;
            Some(two.times_ref(&cos) - kappa.value.times_ref(&sin))
        };
        let theta = zero(from(guess.theta), value, slope)?;
        let by_itself = moving.gap.slope - kappa.slope.times_ref(&sin_cos(&theta)?.1);
        let theta = Jet { slope: by_itself.checked_div(slope(&theta)?)?, value: theta };
        let (sin, cos) = sin_cos(&theta)?;
        let speed = (fixed(two.clone()) * cos.clone()).checked_div(rest.clone())?;
        let tangent = sin.checked_div(cos)?;
        let across = rest * (fixed(one) + e.clone()) * fixed(half * N::from_f64(0.5));
        let trace = fixed(two.clone()) * e.clone() + across * tangent;
        let square = e.clone() * e.clone();
        let eigenvalue = |guess: f64| {
            let value = |x: &N| Some(x.times_ref(&x.minus_ref(&trace.value)).plus_ref(&square.value));
            let slope = |x: &N| Some(two.times_ref(x) - trace.value.clone());
            let lambda = zero(from(guess), value, slope)?;
            let moved = trace.slope.times_ref(&lambda) - square.slope.clone();
            Some(Jet { slope: moved.checked_div(slope(&lambda)?)?, value: lambda })
        };
        let lambda = [eigenvalue(guess.lambda[0])?, eigenvalue(guess.lambda[1])?];
        Some(Self { theta, speed, lambda, restitution: e.clone() })
    }

    /// First terms of the series of one of the manifolds.
    pub fn base(&self, side: Side) -> Option<Base<Jet<N>>> {
        let (sin, cos) = sin_cos(&self.theta)?;
        let lambda = match side {
            Side::Unstable => &self.lambda[0],
            Side::Stable => &self.lambda[1],
        };
        Some(Base {
            theta: self.theta.clone(),
            speed: self.speed.clone(),
            sin,
            cos,
            lambda: lambda.clone(),
            restitution: self.restitution.clone(),
            pi: self.theta.turn() * Jet::from_f64(0.5),
        })
    }
}

/// Order up to which no product of powers of both eigenvalues, of order 2 or more, equals one of them; `None` where `|lambda_u| > 1 > |lambda_s|`
/// is not proved. Lemma J8
pub(super) fn resonances([unstable, stable]: [Ball; 2], most: u32) -> Option<u32> {
    let log = |x: Ball| logarithm(if x.mid() < 0.0 { -x } else { x });
    let [u, s] = [log(unstable)?, log(stable)?];
    let is_apart = |x: Ball| x.mid().abs() > x.rad();
    if !(u.mid() > u.rad() && -s.mid() > s.rad()) {
        return None;
    }
    let times = |n: i64, x: Ball| Ball::exact(n as f64) * x; // exact: small whole numbers
    let excludes = |j: i64, k: i64| is_apart(times(j - 1, u) + times(k, s)) && is_apart(times(j, u) + times(k - 1, s));
    let is_free = |order: i64| (0..=order).all(|j| excludes(j, order - j));
    Some((2..=most).take_while(|order| is_free(i64::from(*order))).last().unwrap_or(1)) // J8: of order 1 there are none
}
