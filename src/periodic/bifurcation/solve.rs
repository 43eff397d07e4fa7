//! Approximate zeros of a [`System`]: nothing is proved.

use nalgebra::DVector;

use super::super::newton::settle;
use super::family::{Family, Varied};
use super::system::System;

/// Steps of Newton's iteration before a start is given up.
const MOST_STEPS: usize = 30;

/// An approximate zero from a guess; `None` where Newton's iteration does not settle near it.
pub(super) fn newton<S: Varied>(system: &System<'_>, family: &Family<S, f64>, guess: Vec<f64>) -> Option<Vec<f64>> {
    let mut x = guess;
    settle(MOST_STEPS, || {
        let values = system.values(family, &x)?;
        let step = system.jacobian(family, &x, false)?.dense().lu().solve(&DVector::from_vec(values))?;
        let size = step.amax();
        if !size.is_finite() || size > 1.0 {
            return None;
        }
        x.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
        Some(size)
    })?;
    Some(x)
}
