//! Products of Jacobians, without multiplying them out.

use super::scaled::Scaled;
use crate::number::{Ball, Number, logarithm, up};

/// A tangent vector `length (c + s c')`, `c` the frame and `c'` the frame rotated by a right angle.
#[derive(Clone, Copy, Debug)]
struct Tangent {
    /// `c`, exactly.
    frame: [f64; 2],
    /// Encloses `s`.
    slope: Ball,
    length: Scaled,
}

fn dot(a: [Ball; 2], b: [Ball; 2]) -> Ball {
    a[0] * b[0] + a[1] * b[1]
}

fn turned([x, y]: [Ball; 2]) -> [Ball; 2] {
    [-y, x]
}

impl Tangent {
    fn new(frame: [f64; 2], length: Ball) -> Self {
        Self { frame, slope: Ball::exact(0.0), length: Scaled::one().times(length) }
    }

    /// The image under every matrix in the balls. Lemma L1
    ///
    /// `None` when its direction is not known to less than a right angle.
    fn image(&self, jacobian: &[[Ball; 2]; 2]) -> Option<Self> {
        let along = self.frame.map(Ball::exact);
        let map = |v: [Ball; 2]| [dot(jacobian[0], v), dot(jacobian[1], v)];
        let (first, second) = (map(along), map(turned(along)));
        // Any frame will do; this one lies in the middle of the image.
        let middle = self.slope.mid();
        let [x, y] = [0, 1].map(|i| middle.mul_add(second[i].mid(), first[i].mid()));
        let size = x.hypot(y);
        let frame = [x / size, y / size];
        let next = frame.map(Ball::exact);
        let square = dot(next, next);
        let (a0, a1) = (dot(next, first), dot(next, second));
        let (b0, b1) = (dot(turned(next), first), dot(turned(next), second));
        let stretch = a0 + self.slope * a1;
        let at = Ball::exact(middle);
        let slope_there = (b0 + at * b1).checked_div(a0 + at * a1)?;
        let derivative = (b1 * a0 - b0 * a1).checked_div(stretch * stretch)?;
        let slope = slope_there + derivative * (self.slope - at);
        Some(Self { frame, slope, length: self.length.times(stretch.checked_div(square)?) })
    }

    /// The square of its length.
    fn square(&self) -> Scaled {
        let frame = self.frame.map(Ball::exact);
        self.length.squared().times(dot(frame, frame)).times(Ball::exact(1.0) + self.slope * self.slope)
    }
}

/// The product of the Jacobians of flights in a row.
///
/// ```
/// use impact_pair::lyapunov::Growth;
/// use impact_pair::number::Ball;
/// // Twice and a third as long, a hundred times.
/// let matrix = [[Ball::exact(2.0), Ball::exact(0.0)], [Ball::exact(0.0), Ball::new(1.0 / 3.0, 1e-16)]];
/// let mut growth = Growth::new(false);
/// let determinant = Ball::new(2.0 / 3.0, 1e-15);
/// assert!((0..100).all(|_| growth.multiply(&matrix, determinant)));
/// let norm = growth.logarithm_of_norm().unwrap();
/// assert!((norm.mid() - 100.0 * 2f64.ln()).abs() <= norm.rad() && norm.rad() < 1e-12);
/// ```
#[derive(Clone, Debug)]
pub struct Growth {
    first: Tangent,
    /// `None` where every matrix maps it to 0.
    second: Option<Tangent>,
    determinant: Scaled,
    matrices: u64,
}

impl Growth {
    /// The unit matrix.
    ///
    /// If `is_dead`, `e = 0`: every Jacobian maps the direction of the velocity to 0, as its second column is a multiple of `-e`.
    pub fn new(is_dead: bool) -> Self {
        let (first, second) = if is_dead {
            (Tangent::new([1.0, 0.0], Ball::exact(1.0)), None)
        } else {
            // Orthonormal, but not along the axes: a vector along an axis that every matrix contracts more than the other
            // would lose its direction in the end.
            let fifth = Ball::new(0.2, f64::EPSILON);
            (Tangent::new([3.0, 4.0], fifth), Some(Tangent::new([-4.0, 3.0], fifth)))
        };
        Self { first, second, determinant: Scaled::one(), matrices: 0 }
    }

    /// Multiplies by a Jacobian from the left; `determinant` encloses its determinant.
    ///
    /// False when a direction is lost: from then on the product is unknown.
    #[must_use]
    pub fn multiply(&mut self, jacobian: &[[Ball; 2]; 2], determinant: Ball) -> bool {
        let image = |vector: &Tangent| vector.image(jacobian);
        let (first, second) = (image(&self.first), self.second.as_ref().map(image));
        let (Some(first), None | Some(Some(_))) = (first, second) else { return false };
        (self.first, self.second) = (first, second.flatten());
        self.determinant = self.determinant.times(determinant);
        self.matrices += 1;
        true
    }

    /// Number of multiplied matrices.
    pub fn matrices(&self) -> u64 {
        self.matrices
    }

    /// Encloses the logarithm of the product's spectral norm, its larger singular value. Lemma L2
    pub fn logarithm_of_norm(&self) -> Option<Ball> {
        let half = Ball::exact(0.5);
        let Some(second) = &self.second else { return Some(half * self.first.square().logarithm()?) };
        // S and 2 D of Lemma L2.
        let squares = self.first.square().plus(second.square());
        // At most 1, where nothing better is known.
        let ratio = self.determinant.in_units_of_sum(squares).map(|determinant| Ball::exact(2.0) * determinant);
        let ratio = ratio.unwrap_or(Ball::new(0.5, 0.5)); // L2: 2 D <= S
        let room = Ball::exact(1.0) - ratio * ratio;
        // Singular values are real: what rounding leaves below 0 is none.
        let root = |x: f64| x.clamp(0.0, 1.0).sqrt(); // L2: singular values are real
        let (low, high) = (root((room.mid() - room.rad()).next_down()), root((room.mid() + room.rad()).next_up()));
        let middle = 0.5 * (low + high);
        // L2: the farther end; a NaN is in both
        let root = Ball::new(middle, up((high - middle).max(middle - low) + 4.0 * f64::EPSILON));
        let larger = half * (Ball::exact(1.0) + root);
        Some(half * (squares.logarithm()? + logarithm(larger)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerances::{NORM_OF_PRODUCT, NORM_OF_THOUSAND_FACTORS};

    /// `ln` of the norm in floating point.
    fn norm([[a, b], [c, d]]: [[f64; 2]; 2]) -> f64 {
        let (squares, determinant) = (a * a + b * b + c * c + d * d, a * d - b * c);
        (0.5 * (squares + (squares * squares - 4.0 * determinant * determinant).sqrt())).ln() / 2.0
    }

    #[test]
    fn directions_that_are_not_known_widen_the_norm() {
        // Twice a stretch of one axis, in between a turn by 75 degrees: its image is nearly along the short axis.
        let (stretch, radius) = ([[10.0, 0.0], [0.0, 0.1]], 0.05);
        let balls = |matrix: [[f64; 2]; 2], radius| matrix.map(|row| row.map(|x| Ball::new(x, radius)));
        let middle = 75f64.to_radians();
        let mut growth = Growth::new(false);
        let (sin, cos) = middle.sin_cos();
        assert!(growth.multiply(&balls(stretch, 0.0), Ball::new(1.0, 1e-15)));
        assert!(growth.multiply(&balls([[cos, -sin], [sin, cos]], radius), Ball::new(1.0, 0.1)));
        assert!(growth.multiply(&balls(stretch, 0.0), Ball::new(1.0, 1e-15)));
        let found = growth.logarithm_of_norm().unwrap();
        for turn in [-0.05f64, -0.03, 0.0, 0.03, 0.05] {
            let (sin, cos) = (middle + turn).sin_cos();
            let product = [[100.0 * cos, -sin], [sin, 0.01 * cos]];
            assert!((norm(product) - found.mid()).abs() <= found.rad() + NORM_OF_PRODUCT, "{turn}: {found:?}");
        }
        assert!(found.rad() < 1.5, "{found:?}");
    }

    #[test]
    fn a_direction_that_may_turn_by_a_right_angle_is_lost() {
        let mut growth = Growth::new(false);
        assert!(!growth.multiply(&[[Ball::new(1.0, 2.0); 2]; 2], Ball::new(1.0, 1.0)));
        assert_eq!(growth.matrices(), 0);
    }

    #[test]
    fn products_leave_the_range_of_doubles() {
        let matrix = [[Ball::exact(1e-15), Ball::exact(0.0)], [Ball::exact(0.0), Ball::exact(1e-20)]];
        let mut growth = Growth::new(false);
        for _ in 0..1000 {
            assert!(growth.multiply(&matrix, Ball::new(1e-35, 1e-50)));
        }
        let found = growth.logarithm_of_norm().unwrap();
        let exact = -15_000.0 * std::f64::consts::LN_10;
        assert!(
            (found.mid() - exact).abs() <= found.rad() + NORM_OF_THOUSAND_FACTORS && found.rad() < 1e-6,
            "{found:?} {exact}"
        );
    }
}
