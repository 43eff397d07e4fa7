//! Points of an invariant manifold with their derivatives, enclosed: Lemma J4 of `docs/proofs/tangency.md#J4`.

use super::flight::{Pair, Parameter, State};
use super::local::Local;
use super::saddle::{Guessed, Saddle, Side};
use super::series::Series;
use crate::number::{Ball, Enclosing};
use crate::periodic::bifurcation::Jet;

/// Point of a manifold; slopes are derivatives by one parameter.
#[derive(Clone, Debug)]
pub(super) struct Point<N> {
    pub at: State<Jet<N>>,
    /// Derivative of the point by the parameter of the manifold.
    pub along: State<Jet<N>>,
    /// Second derivative of the point by the parameter of the manifold.
    pub bend: State<N>,
}

/// A manifold of the fixed point: its series, and bounds of the remainder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Manifold {
    pub side: Side,
    pub guess: Guessed,
    /// Terms up to this order are summed.
    pub order: usize,
    /// Domain in which the manifold is proved to be analytic; without it only the sum is returned, which proves nothing.
    pub local: Option<Local>,
}

/// Bounds of the remainder of a value, of its first and second derivative by `sigma`, of that by one parameter, and of the mixed one.
type Tail = [f64; 5];

impl Manifold {
    /// Encloses the point of a `sigma`, for all `D` and `e` of a pair, with its derivatives by one of them.
    pub fn at<N: Enclosing>(&self, pair: &Pair<N>, by: Parameter, sigma: &N) -> Option<Point<N>> {
        let base = Saddle::new(pair, by, &self.guess)?.base(self.side)?;
        let [mut at, mut along, bend] = Series::new(&base, self.order)?.at(&Jet::constant(sigma.clone()));
        let mut bend = bend.map(|x| x.value);
        if let Some(local) = &self.local {
            let [phase, eigenvalue] = [&base.theta, &base.lambda].map(|x| x.value.as_ball());
            if !local.covers(&pair.map(Enclosing::as_ball), phase, eigenvalue) {
                return None;
            }
            let tails = self.tails(local, by, sigma.as_ball().mag())?;
            let widened = |x: &mut N, by: f64| *x = x.clone() + N::from_f64(0.0).with_radius(by);
            for (i, [value, slope, second, by_parameter, by_both]) in tails.into_iter().enumerate() {
                widened(&mut at[i].value, value);
                widened(&mut at[i].slope, by_parameter);
                widened(&mut along[i].value, slope);
                widened(&mut along[i].slope, by_both);
                widened(&mut bend[i], second);
            }
        }
        Some(Point { at, along, bend })
    }

    /// Bounds of the remainders of phase and speed. Lemma J4
    fn tails(&self, local: &Local, by: Parameter, sigma: f64) -> Option<[Tail; 2]> {
        let ball = Ball::exact;
        // J4: any radius between
        let middle = (sigma * local.radius).sqrt().max(0.125 * local.radius);
        let ratio = over(ball(middle), ball(local.radius))?;
        let apart = ball(middle) - ball(sigma);
        if !(middle < local.radius && apart.mid() > apart.rad() && ratio.mag() < 1.0) {
            return None;
        }
        let mut power = ball(1.0);
        for _ in 0..=self.order {
            power = power * ratio;
        }
        let rest = over(power, ball(1.0) - ratio)?;
        let reach = ball(0.5) * ball(*local.reach.value(by));
        let tail = |size: f64| {
            let value = ball(size) * rest;
            let slope = over(value, apart)?;
            let second = over(ball(2.0) * slope, apart)?;
            Some([value, slope, second, over(value, reach)?, over(slope, reach)?].map(Ball::mag))
        };
        Some([tail(local.size[0])?, tail(local.size[1])?])
    }

    /// Order from which on the remainder is smaller than `error`; proposes.
    pub fn order_for(local: &Local, sigma: f64, error: f64) -> usize {
        let middle = (sigma * local.radius).sqrt().max(0.125 * local.radius); // proposes
        let ratio = middle / local.radius;
        let size = 2.0 * local.size[0].max(local.size[1]) / ((1.0 - ratio) * (middle - sigma).powi(2)); // proposes
        ((error / size).ln() / ratio.ln()).ceil().clamp(4.0, 400.0) as usize // proposes
    }
}

fn over(a: Ball, b: Ball) -> Option<Ball> {
    crate::number::Number::checked_div(a, b)
}
