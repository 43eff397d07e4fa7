//! First contacts in a build without multiprecision: none in more than doubles.

use crate::contact::Grazed;
use crate::flight::Launch;
use crate::number::Ball;

/// First contacts in more than doubles: none in this build.
pub(crate) trait Precise {
    /// Nothing goes past an extremum that may touch its wall.
    fn pass_graze(&self, _: Launch<Ball>) -> Option<Grazed> {
        None
    }
}

impl<S> Precise for S {}
