//! A floating-point orbit on what attracts it.
//!
//! Labels: proposes throughout.

use super::guess::Guess;
use super::quad::State;
use super::vector::{GENERIC, applied, length};

/// Impacts before the orbit is looked at, and number of impacts that are looked at.
const TRANSIENT: usize = 2000;
const OBSERVED_IMPACTS: usize = 100_000;
/// An orbit that expands less, an impact, is regular.
const MIN_EXPONENT: f64 = 1e-3;

/// Floating-point orbit on the attractor, phases modulo 1, with its expanding directions.
#[derive(Debug)]
pub(crate) struct AttractorOrbit {
    pub points: Vec<(State, State)>,
    /// Lyapunov exponent per impact.
    pub exponent: f64,
}

/// Floating-point orbit from a state; `None` where it ends.
pub(crate) fn seen(guess: &Guess, start: State) -> Option<AttractorOrbit> {
    let (mut state, mut direction, mut sum) = (start, GENERIC, 0.0);
    let mut points = Vec::with_capacity(OBSERVED_IMPACTS);
    for k in 0..TRANSIENT + OBSERVED_IMPACTS {
        let growth = step(guess, &mut state, &mut direction)?;
        if k >= TRANSIENT {
            sum += growth.ln();
            points.push((state, direction));
        }
    }
    Some(AttractorOrbit { points, exponent: sum / OBSERVED_IMPACTS as f64 })
}

/// Maps a state and its expanding direction over one impact; returns the growth.
pub(super) fn step(guess: &Guess, state: &mut State, direction: &mut State) -> Option<f64> {
    let image = guess.map(*state)?;
    let image_of = applied(image.jacobian, *direction);
    let growth = length(image_of);
    *direction = image_of.map(|x| x / growth);
    *state = [image.state[0].rem_euclid(1.0), image.state[1]];
    Some(growth)
}

impl AttractorOrbit {
    /// States of the orbit.
    pub fn states(self) -> Vec<State> {
        self.points.into_iter().map(|(state, _)| state).collect()
    }

    /// Whether neighbouring orbits separate exponentially: the exponent exceeds `MIN_EXPONENT`.
    pub fn is_chaotic(&self) -> bool {
        self.exponent > MIN_EXPONENT
    }
}
