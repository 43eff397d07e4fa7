//! Coordinates in which a period shrinks all lengths, in floating point; no proof depends on the choice (Lemma V6).
// Labels: proposes throughout.

use super::round::Matrix;
use impact_pair_exact::Real;

/// Squarings of a matrix: enough for a matrix that contracts by more than `1 - 2^-40` to vanish.
const SQUARINGS: u32 = 48;

/// Matrix `T` in whose coordinates a matrix of spectral radius less than 1 shrinks all lengths, in floating point; any `T` is sound.
///
/// With `B = M/q`, `q` between the spectral radius and 1, `X = I + B^T X B` is the square of the norm `|T^-1 x|`, `X = T^-T T^-1`:
/// `|T^-1 M x|^2 = q^2 (x^T X x - x^T x)`.
pub(super) fn axes(derivative: &Matrix, unit: f64) -> Option<[[f64; 2]; 2]> {
    let unit = if unit > 0.0 { unit } else { 1.0 };
    let [[a, b], [c, d]] = derivative.each_ref().map(|row| row.each_ref().map(Real::to_f64));
    let (b, c) = (b * unit, c / unit);
    let (half, product) = ((a + d) / 2.0, a * d - b * c);
    let under = half * half - product;
    let radius = if under > 0.0 { half.abs() + under.sqrt() } else { product.abs().sqrt() };
    if radius.is_nan() || radius >= 1.0 {
        return None;
    }
    let q = (1.0 + radius) / 2.0;
    let (mut power, mut x) = ([[a / q, b / q], [c / q, d / q]], [1.0, 0.0, 1.0]);
    for _ in 0..SQUARINGS {
        let [[a, b], [c, d]] = power;
        let [x0, x1, x2] = x;
        x = [
            x0 + a * (x0 * a + x1 * c) + c * (x1 * a + x2 * c),
            x1 + a * (x0 * b + x1 * d) + c * (x1 * b + x2 * d),
            x2 + b * (x0 * b + x1 * d) + d * (x1 * b + x2 * d),
        ];
        power = [[a * a + b * c, b * (a + d)], [c * (a + d), d * d + b * c]];
    }
    // Cholesky: X = R^T R, T = R^-1.
    let first = x[0].sqrt();
    let beside = x[1] / first;
    let second = (x[2] - beside * beside).sqrt();
    let axes = [[1.0 / first, -beside / (first * second)], [0.0, unit / second]];
    axes.iter().flatten().all(|x| x.is_finite()).then_some(axes)
}
