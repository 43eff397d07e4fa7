//! Vectors between states, in doubles: their lengths have phases in radians.
//!
//! Labels: proposes throughout.

use std::f64::consts::TAU;

use super::quad::State;

/// A direction at the first state of a motion: flights rotate almost any direction towards the expanding one.
pub(super) const GENERIC: State = [1.0 / TAU, 0.3];

/// Product of two matrices.
pub(super) fn times(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

/// Image of a vector.
pub(crate) fn applied([[a, b], [c, d]]: [[f64; 2]; 2], [x, y]: State) -> State {
    [a * x + b * y, c * x + d * y]
}

pub(crate) fn minus([a, b]: State, [c, d]: State) -> State {
    [a - c, b - d]
}

/// `a d - b c`: the area between two vectors.
pub(crate) fn cross([a, b]: State, [c, d]: State) -> f64 {
    a * d - b * c
}

/// Vector with its phase in radians.
pub(crate) fn radians([u, w]: State) -> State {
    [TAU * u, w]
}

/// Length of a vector, its phase in radians.
pub(crate) fn length(vector: State) -> f64 {
    let [theta, w] = radians(vector);
    theta.hypot(w)
}

/// Vector of length 1 of a direction.
pub(super) fn unit(vector: State) -> State {
    let size = length(vector);
    vector.map(|x| x / size)
}

/// The state less whole forcing periods.
pub(super) fn in_period([phase, speed]: State) -> State {
    [phase - phase.floor(), speed]
}

/// Distance of two states, less whole forcing periods.
pub(super) fn apart([u, w]: State, [v, x]: State) -> f64 {
    length([u - v - (u - v).round(), w - x])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_phases_in_radians_and_no_whole_periods() {
        assert!((length([3.0 / TAU, 4.0]) - 5.0).abs() < 1e-15 && (length(unit([0.7, -2.0])) - 1.0).abs() < 1e-15);
        assert!((apart([0.9, 1.5], [2.1, 1.5]) - 0.2 * TAU).abs() < 1e-14, "a fifth of a period");
        assert_eq!(in_period([-0.25, 2.0]), [0.75, 2.0]);
        assert_eq!(cross([1.0, 2.0], [3.0, 4.0]), -2.0);
    }
}
