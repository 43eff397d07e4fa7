//! A neighbourhood of a periodic orbit that its period maps into itself, contracting: Lemmas Q1-Q3.
//!
//! In coordinates `x = x* + T s` around the orbit's state at one of its impacts the derivative of the period is `G = T^-1 DP T`. Over
//! the ellipse `|s| <= r` it is enclosed by the product of the Jacobians (A.7) along the tube of states that the
//! ellipse runs through, each flight's first contact proved for all of them. Where `|G| < 1` all over it, every state
//! in the ellipse tends to the orbit. Of an orbit that is its own mirror image half a period is followed, and mirrored: its
//! enclosures are as narrow as the square roots of those of the period.

use std::cmp::Ordering;

use super::chained::Chained;
use super::identity::reduced_impacts;
use super::legs::times;
use super::shaking::Shaking;
use super::{PeriodicOrbit, Problem};
use crate::mapping::jacobian_between;
use crate::number::{Ball, Enclosing, Number, up};
use crate::pair::{Inward, Wall};
use crate::shaken::under;

/// States that all tend to a periodic orbit, proved.
///
/// **Enclosure**: for all parameters of the pair, the period maps the ellipse into itself, each two of its states
/// closer by [`Basin::factor`] in the ellipse's norm, so all of them tend to the one state of the orbit inside.
#[derive(Clone, Debug)]
pub struct Basin {
    ellipse: Ellipse,
    factor: f64,
}

/// States around the orbit's at one of its impacts.
#[derive(Clone, Debug)]
struct Ellipse {
    wall: Wall,
    /// Forcing periods after which the excitation repeats.
    period: f64,
    /// The orbit's state: phase in forcing periods, less whole periods, and velocity before.
    centre: [Ball; 2],
    /// `T^-1`
    inverse: Matrix,
    radius: f64,
}

type Matrix = [[Ball; 2]; 2];
type Axes = [[f64; 2]; 2];

/// The part of an orbit that is followed: a number of impacts from the first one on, after which it is what it was, or its mirror image.
#[derive(Clone, Copy)]
struct Round {
    first: usize,
    impacts: usize,
    is_mirrored: bool,
}
/// Two vectors of phase and velocity.
type Basis = [[f64; 2]; 2];

/// The largest radius tried, in forcing periods, the number of its halvings, and the parts of it that the second axis is long.
const MAX_RADIUS: f64 = 0.125;
const HALVINGS: usize = 44;
const SECOND_AXIS_FACTORS: [f64; 3] = [1.0, 0.125, 0.015_625];
const UNIT_AXES: Axes = [[1.0, 0.0], [0.0, 1.0]];

impl Problem {
    /// Proves a neighbourhood of the state of a proved orbit at impact `first` that the orbit attracts and that holds `states`: wall, phases and
    /// velocities before the impact. `None` where none of the ellipses tried does, or `afford` refuses the flights of one. The largest come first.
    /// Lemma Q1
    ///
    /// **Cost**: a certified flight and a Jacobian for each impact of the orbit and each ellipse that holds `states`: 264 times at most. `afford` is
    /// consulted before each.
    pub fn basin_around(
        &self,
        orbit: &PeriodicOrbit,
        first: usize,
        states: (Wall, Ball, Ball),
        mut afford: impl FnMut(u64) -> bool,
    ) -> Option<Basin> {
        // Only of an orbit that is one the lemma speaks.
        (orbit.physical == Some(true)).then_some(())?;
        let round = self.round(orbit, first);
        let bases = self.bases(orbit, round)?;
        let sizes = (0..HALVINGS)
            .flat_map(|n| SECOND_AXIS_FACTORS.map(|shorter| (MAX_RADIUS * 0.5f64.powi(n as i32), shorter))); // exact: a few halvings
        let ellipses = sizes.flat_map(|size| bases.map(|basis| (basis, size)));
        let axes = |([first, second], (radius, shorter)): (Basis, (f64, f64))| {
            ([[first[0], second[0] * shorter], [first[1], second[1] * shorter]], radius)
        };
        let mut holding =
            ellipses.map(axes).filter_map(|(axes, radius)| Some((axes, self.ellipse(orbit, first, axes, radius)?)));
        holding.find_map(|(axes, ellipse)| {
            let factor =
                |radius| contraction(&times(&ellipse.inverse, &self.product_over(orbit, round, axes, radius)?));
            let is_tried = ellipse.holds(states) && afford(round.impacts as u64); // exact: a number of impacts
            is_tried.then(|| factor(ellipse.radius)).flatten().map(|factor| Basin { factor, ellipse })
        })
    }

    /// The impacts after which the orbit is proved to be what it was, or its mirror image, from impact `first` on. Lemmas Q1, T6
    fn round(&self, orbit: &PeriodicOrbit, first: usize) -> Round {
        let (walls, all) = (self.chain().walls(), self.chain().impacts());
        let impacts = reduced_impacts(self.chain(), &orbit.proved).unwrap_or(all); // Q1: of the period it is true
        Round { first, impacts, is_mirrored: walls[impacts % all] != walls[0] }
    }

    /// The ellipse of this radius around the orbit's state at an impact, in the coordinates of these columns.
    fn ellipse(&self, orbit: &PeriodicOrbit, first: usize, axes: Axes, radius: f64) -> Option<Ellipse> {
        let inverse = inverse(axes)?;
        let (turns, phase) = in_turn(orbit.phases()[first]);
        let period = f64::from(self.period());
        let phase = if period > 1.0 { phase + Ball::exact(turns.rem_euclid(period)) } else { phase };
        let centre = [phase, orbit.velocity(first)];
        Some(Ellipse { wall: self.chain().walls()[first], period, centre, inverse, radius })
    }

    /// Encloses `DP T` over the ellipse, `P` the round; `None` where a flight's first contact is not proved for all of it.
    fn product_over(&self, orbit: &PeriodicOrbit, round: Round, axes: Axes, radius: f64) -> Option<Matrix> {
        let [phases, velocities] =
            under!(&self.shaken, shaken => self.product_under(&**shaken, orbit, round, (axes, radius)))?;
        Some(if round.is_mirrored { [phases, velocities.map(|x| -x)] } else { [phases, velocities] })
    }

    /// Encloses `DP T` over the impacts of the round, in one arithmetic's excitation.
    fn product_under<S: Chained>(
        &self,
        shaken: &S,
        orbit: &PeriodicOrbit,
        Round { first, impacts, .. }: Round,
        (axes, radius): (Axes, f64),
    ) -> Option<Matrix> {
        let chain = &self.chain;
        let mut product = axes.map(|row| row.map(Ball::exact));
        for i in (first..first + impacts).map(|i| i % chain.impacts()) {
            let wall = chain.walls()[i];
            // The tube: what the mean value theorem makes of the ellipse so far, around the orbit.
            let reach = |row: [Ball; 2]| up(length(row.map(Ball::mag)) * radius);
            let (turns, phase) = in_turn(orbit.phases()[i]);
            let phase = phase.widened(reach(product[0]));
            let before = orbit.velocity(i).widened(reach(product[1]));
            if wall.inward(before).certain_sign() != Some(Ordering::Less) {
                return None;
            }
            let (contact, accelerations) = shaken.step(wall, turns, phase, before)?;
            if contact.wall != chain.walls()[chain.next(i)] {
                return None;
            }
            let restitution = *shaken.balls().restitution();
            product = times(
                &jacobian_between(restitution, contact.time, accelerations, [before, contact.velocity])?,
                &product,
            );
        }
        Some(product)
    }

    /// Two bases of floating-point vectors, of which any invertible one is sound. First the eigenvectors of the orbit's round, larger
    /// eigenvalue first, or the two parts of a complex one. Then the first eigenvector with its perpendicular, for eigenvectors that are nearly
    /// parallel.
    fn bases(&self, orbit: &PeriodicOrbit, round: Round) -> Option<[Basis; 2]> {
        // proposes
        let speed = (0..self.chain().impacts()).map(|i| orbit.velocity(i).mag()).fold(0.0, f64::max);
        // Velocities in units of the orbit's greatest, so that both coordinates are of one order.
        let [[a, b], [c, d]] = self.product_over(orbit, round, UNIT_AXES, 0.0)?.map(|row| row.map(Ball::mid));
        let (b, c) = (b * speed, c / speed);
        let half = (a + d) / 2.0;
        let under = half * half - (a * d - b * c);
        let root = under.abs().sqrt();
        let unit = |v: [f64; 2]| {
            let size = length(v);
            if size > 1e-150 { v.map(|x| x / size) } else { [1.0, 0.0] }
        };
        // Of (M - lambda) x = 0 the row that says more.
        let vector = |lambda: f64| {
            let (first, second) = ([b, lambda - a], [lambda - d, c]);
            unit(if length(first) >= length(second) { first } else { second })
        };
        let (first, second) = if under > 0.0 {
            let (one, other) = (half + root, half - root);
            let (large, small) = if one.abs() >= other.abs() { (one, other) } else { (other, one) };
            (vector(large), vector(small))
        } else {
            // x + i y with M (x + i y) = (half + i root)(x + i y), one factor for both.
            let size = length([b, length([half - a, root])]);
            ([b, half - a].map(|x| x / size), [0.0, root / size])
        };
        let perpendicular = [-first[1], first[0]];
        Some([[first, second], [first, perpendicular]].map(|basis| basis.map(|[x, y]| [x, y * speed])))
    }
}

impl Ellipse {
    fn holds(&self, (wall, phase, velocity): (Wall, Ball, Ball)) -> bool {
        let [phase0, velocity0] = self.centre;
        let ahead = phase - phase0;
        let periods = (ahead.mid() / self.period).round() * self.period; // Q3: any whole number of periods, exact
        let x = [ahead - Ball::exact(periods), velocity - velocity0];
        let s = self.inverse.map(|row| row[0] * x[0] + row[1] * x[1]);
        wall == self.wall && length(s.map(Ball::mag)) < self.radius
    }
}

impl Basin {
    /// Whether all these states, phases up to whole periods of the excitation, are proved to lie inside the ellipse.
    pub fn holds(&self, states: (Wall, Ball, Ball)) -> bool {
        self.ellipse.holds(states)
    }

    /// Factor, less than 1, that bounds what a period multiplies distances by.
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// Radius of the ellipse along the eigenvector of the larger eigenvalue: in forcing periods, in units of that eigenvector.
    pub fn radius(&self) -> f64 {
        self.ellipse.radius
    }
}

/// Whole forcing periods of the middle of a phase, and the rest of the phase.
fn in_turn(phase: Ball) -> (f64, Ball) {
    let turns = phase.mid().floor(); // exact: any whole number is taken off
    (turns, phase - Ball::exact(turns))
}

/// An upper bound of the Euclidean length of a vector of non-negative numbers.
fn length([x, y]: [f64; 2]) -> f64 {
    // The smallest normal double covers underflow of both squares; the root is rounded correctly.
    up((x * x + y * y + f64::MIN_POSITIVE).sqrt())
}

/// The inverse of a matrix of doubles.
fn inverse([[a, b], [c, d]]: Axes) -> Option<Matrix> {
    let [a, b, c, d] = [a, b, c, d].map(Ball::exact);
    let determinant = a * d - b * c;
    let over = |x: Ball| x.checked_div(determinant);
    Some([[over(d)?, over(-b)?], [over(-c)?, over(a)?]])
}

/// An upper bound, less than 1, of the Euclidean norm of all matrices in the balls. Lemma Q2
fn contraction(g: &Matrix) -> Option<f64> {
    let [[a, b], [c, d]] = *g;
    let sum = a * a + b * b + c * c + d * d;
    let determinant = a * d - b * c;
    let product = determinant * determinant;
    // Both singular values are below q: (q^2 - s1^2)(q^2 - s2^2) > 0 and s1^2 s2^2 < q^4.
    let is_below = |q: f64| {
        let square = Ball::exact(q) * Ball::exact(q);
        let ends = [square * square - sum * square + product, square * square - product];
        ends.iter().all(|x| x.certain_sign() == Some(Ordering::Greater))
    };
    // Guesses a little above the largest one, where both may nearly be one double root; the signs decide.
    let (sum, product) = (sum.mid() + sum.rad(), product.mid() - product.rad());
    // proposes: the signs decide (Lemma Q2)
    let guess = (0.5 * (sum + (sum * sum - 4.0 * product).max(0.0).sqrt())).sqrt();
    [1e-9, 1e-6, 1e-3]
        .map(|more| guess * (1.0 + more) + more)
        .into_iter()
        .chain([1.0])
        .find(|&q| q <= 1.0 && is_below(q))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(g: [[f64; 2]; 2]) -> Matrix {
        g.map(|row| row.map(Ball::exact))
    }

    #[test]
    fn a_rotation_that_shrinks_is_a_contraction_and_a_shear_is_not() {
        let factor = contraction(&exact([[0.3, -0.4], [0.4, 0.3]])).unwrap();
        assert!(factor > 0.5 && factor < 0.502, "{factor}");
        assert!(contraction(&exact([[0.5, 0.9], [0.0, 0.5]])).is_none(), "eigenvalues say nothing of one step");
        assert!(contraction(&exact([[1.0, 0.0], [0.0, 0.5]])).is_none(), "a norm of 1 proves nothing");
        assert!(contraction(&exact([[2.0, 0.0], [0.0, 2.0]])).is_none(), "both beyond 1");
        assert!(contraction(&[[Ball::new(0.0, 0.8), Ball::new(0.0, 0.8)], [Ball::exact(0.0); 2]]).is_none());
        assert!(contraction(&[[Ball::exact(f64::NAN); 2]; 2]).is_none());
    }

    #[test]
    fn lengths_are_upper_bounds_even_where_squares_underflow() {
        assert!(length([3e-200, 4e-200]) >= 5e-200);
        assert!(length([3.0, 4.0]) >= 5.0 && length([3.0, 4.0]) < 5.000_001);
    }
}
