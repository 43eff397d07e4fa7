//! The motion of the box, equations (1) and (9): `E(t) = sum A_k sin(W_k t + tau_k)`.

use crate::number::Number;
pub use impact_pair_model::{Excitation, Harmonic};

/// `E/d`, `E'/d` and `E''/d` at the phase of the given sine and cosine, per forcing period and per forcing period squared.
///
/// **Equation** (9) and its derivatives; `alpha = A/d`.
pub fn displacement_velocity_acceleration<N: Number + Copy>(alpha: N, (sin, cos): (N, N)) -> (N, N, N) {
    let turn = alpha.turn();
    let displacement = alpha * sin;
    (displacement, turn * alpha * cos, -(turn * turn * displacement))
}
