//! The Taylor series of an invariant manifold of the fixed point, in any arithmetic: Lemma J4 of `docs/proofs/tangency.md#J4`.

use super::terms::Terms;
use crate::number::Number;

/// The fixed point and one of its eigenvalues; `pi`, `D` and `e` in the same arithmetic.
#[derive(Clone, Debug)]
pub(super) struct Base<T> {
    pub theta: T,
    pub speed: T,
    pub sin: T,
    pub cos: T,
    pub lambda: T,
    pub restitution: T,
    pub pi: T,
}

/// The coefficients of phase and speed over the parameter of a manifold, of order 0 first.
#[derive(Clone, Debug)]
pub(super) struct Series<T> {
    pub phase: Vec<T>,
    pub speed: Vec<T>,
}

/// The sum over `i`, `0 < i < n`, of `f(i) g(n - i)`.
fn product<T: Number>(f: &[T], g: &[T], n: usize) -> T {
    (1..n).fold(T::from_f64(0.0), |sum, i| f[i].mul_add_ref(&g[n - i], sum))
}

impl<T: Number> Base<T> {
    /// Speed of the eigenvector whose phase is 1.
    pub fn direction(&self) -> Option<T> {
        let one = T::from_f64(1.0);
        let lambda = &self.lambda;
        (-(self.sin.times_ref(&lambda.clone().plus_ref(&one)))).checked_div(lambda.minus_ref(&self.restitution))
    }
}

impl<T: Number> Series<T> {
    /// The series up to an order; `None` where one of its coefficients is not determined.
    pub fn new(base: &Base<T>, order: usize) -> Option<Self> {
        let Base { theta, speed, sin, cos, lambda, restitution, pi } = base;
        let one = T::from_f64(1.0);
        let direction = base.direction()?;
        let mut phase = vec![theta.clone(), one.clone()];
        let mut speeds = vec![speed.clone(), direction.clone()];
        let (mut sines, mut cosines) = (vec![sin.clone(), cos.clone()], vec![cos.clone(), -sin.clone()]);
        let drift = |w: &T, cos: &T| restitution.mul_add_ref(w, cos.clone());
        let mut drifts = vec![drift(speed, cos), drift(&direction, &cosines[1])];
        let mut times = vec![pi.clone(), lambda.minus_ref(&one)];
        // j theta_j
        let mut slopes = vec![T::from_f64(0.0), one.clone()];
        let mut power = lambda.clone();
        for n in 2..=order {
            power = power * lambda.clone();
            let count = T::from_f64(n as f64); // J4: a small whole number
            let next = power.clone().plus_ref(&one);
            let sine = product(&slopes, &cosines, n).checked_div(count.clone())?;
            let cosine = (-product(&slopes, &sines, n)).checked_div(count.clone())?;
            let miss = -(pi.times_ref(&cosine) + product(&drifts, &times, n) + next.times_ref(&sine));
            let turned = next.times_ref(&cosine);
            let longer = power.minus_ref(&one);
            let a = drifts[0].times_ref(&longer) + next.times_ref(cos) - pi.times_ref(sin);
            let b = pi.times_ref(restitution);
            let c = next.times_ref(sin);
            let d = power.minus_ref(restitution);
            let determinant = a.times_ref(&d) - b.times_ref(&c);
            let theta = (miss.times_ref(&d) - b.times_ref(&turned)).checked_div(determinant.clone())?;
            let speed = (a.times_ref(&turned) - c.times_ref(&miss)).checked_div(determinant)?;
            sines.push(cos.mul_add_ref(&theta, sine));
            cosines.push(sin.mul_sub_ref(&theta, cosine));
            drifts.push(drift(&speed, &cosines[n]));
            times.push(longer * theta.clone());
            slopes.push(count * theta.clone());
            phase.push(theta);
            speeds.push(speed);
        }
        Some(Self { phase, speed: speeds })
    }

    /// The state at a parameter, its first derivative, and its second one.
    pub fn at(&self, sigma: &T) -> [[T; 2]; 3] {
        let of = |coefficients: &[T], derivative: usize| {
            let factor = |n: usize| (n + 1 - derivative..=n).product::<usize>() as f64; // J4: a small whole number
            (derivative..coefficients.len()).rev().fold(T::from_f64(0.0), |sum, n| {
                sum.mul_add(sigma.clone(), coefficients[n].times_ref(&T::from_f64(factor(n))))
            })
        };
        [0, 1, 2].map(|k| [of(&self.phase, k), of(&self.speed, k)])
    }
}
