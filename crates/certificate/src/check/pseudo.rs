//! States near an orbit, from the middles of claimed bounds, and nodes around them that may cover one another. Newton's iteration treats
//! all impacts at once: expanding parts backward from the last impact, contracting parts forward from the start.
//!
//! Labels: proposes throughout.

use super::affine::Affine;
use super::chain::{Course, Node, Pair};
use super::contact::{Doubt, newton};
use super::data::Piece;
use super::frame::ClaimedImpact;
use impact_pair_exact::{Dyadic, Real};

/// Bits for the flight time between two middles.
const GUESS_BITS: u32 = 64;
/// log2 of the accepted ratio of a jump to the claimed bounds; nodes make room for jumps of that size.
const JUMP_EXPONENT: i32 = -40;
/// Ratio of a node's width to the least width that covers the next node, and of the room for a jump to the jump.
const MARGIN: f64 = 1.05;
const JUMP_MARGIN: f64 = 2.0;
/// Approximate relative error of products of doubles.
const ROUNDING: f64 = 1.0 / (1_u64 << 44) as f64;

/// A state near an orbit: before an impact, or at the start.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub node: Node,
    /// Half widths of the claimed bounds.
    size: Pair,
    /// The Jacobian of the flight to the next point, by rows.
    jacobian: [Pair; 2],
    /// Factors by which the flight multiplies `u` and `s`.
    growth: Pair,
    /// Difference between the end of the flight from the point before and this point.
    jump: Pair,
}

/// A flight from a state.
pub(super) struct Shot {
    pub lasting: Real,
    jacobian: [Pair; 2],
    /// Difference between the end of the flight and the next state.
    jump: Pair,
}

impl Course<'_> {
    /// The start and the middles of the claimed bounds.
    pub fn middles(&self) -> Vec<Point> {
        let bits = self.frame.turn.bits();
        let (phase, velocity, _) = self.data.state(&Piece::default(), bits);
        let start = [phase.less_centre().hull(), velocity.hull()];
        let bounds = |hit: &ClaimedImpact<'_>| self.frame.hulls([hit.time, hit.velocity]);
        let along = if self.is_of_times { [[1.0, 0.0], [0.0, 1.0]] } else { [[0.0, 1.0], [1.0, 0.0]] };
        let point = |states: [Real; 2]| {
            let size = states.each_ref().map(|x| (x.clone() - &x.middle()).enclosure().mag().to_f64_up());
            let node = Node { centre: states.map(|x| Real::point(x.mid(), bits)), axes: along, sides: [0.0; 2] };
            Point { node, size, jacobian: [[0.0; 2]; 2], growth: [1.0; 2], jump: [0.0; 2] }
        };
        [start].into_iter().chain(self.hits.iter().map(bounds)).map(point).collect()
    }

    /// The flight from point `k` to the next point.
    pub fn shot(&self, k: usize, [point, next]: [&Point; 2], guess: Option<&Real>) -> Result<Shot, Doubt> {
        let (bits, wall) = (self.frame.turn.bits(), self.hits[k].wall);
        let departure = self.departure(k, point.node.centre.clone().map(Affine::fixed));
        let flight = departure.flights(&self.frame.parameters.middle());
        let ahead = || Real::point((next.node.centre[0].clone() - &point.node.centre[0]).mid(), GUESS_BITS);
        let guess = guess.cloned().unwrap_or_else(ahead);
        if !guess.is_positive() {
            return Err(Doubt::open("the time is too near"));
        }
        let h = newton(&flight, wall, &guess).at(bits);
        let flight = flight.known_at(&h);
        let arrival = flight.slope(&h);
        let ends = [point.node.centre[0].clone() + &h, arrival.clone()];
        let jump = [0, 1].map(|i| (ends[i].clone() - &next.node.centre[i]).to_f64());
        let e = match departure.start.wall {
            Some(_) => self.frame.parameters.restitution.centre.to_f64(),
            None => -1.0,
        };
        let accelerations = [flight.shaking.first_acceleration(), flight.curvature(&h)].map(|x| x.to_f64());
        let [after, v, lasting] = [&flight.velocity, &arrival, &h].map(Real::to_f64);
        // (A.7)
        let (by_phase, by_velocity) = ((accelerations[0] * lasting + after) / v, e * lasting / v);
        let of_velocity = [accelerations[1] * by_phase - accelerations[0], accelerations[1] * by_velocity - e];
        Ok(Shot { lasting: Real::point(h.mid(), bits), jacobian: [[by_phase, by_velocity], of_velocity], jump })
    }
}

/// Stores the Jacobians and jumps of the flights. With a `share`, also removes the points after the first point at which the
/// expansion reaches that share of its maximum.
pub(super) fn take(points: &mut Vec<Point>, shots: &[Shot], share: Option<f64>) {
    for (k, shot) in shots.iter().enumerate() {
        points[k].jacobian = shot.jacobian;
        points[k + 1].jump = shot.jump;
    }
    let mut grown = vec![0.0; points.len()];
    for k in 0..shots.len() {
        let image = applied(points[k].jacobian, points[k].node.axes[0]);
        points[k].growth[0] = image[0].hypot(image[1]);
        points[k + 1].node.axes[0] = normalised(image);
        grown[k + 1] = grown[k] + points[k].growth[0].ln();
    }
    if let Some(share) = share {
        let least = grown.iter().copied().fold(0.0, f64::max) + share.ln();
        let last = grown.iter().position(|&grown| grown >= least);
        points.truncate(last.map_or(1, |last| last + 1));
    }
    let Some((last, before)) = points.split_last_mut().filter(|(_, before)| !before.is_empty()) else { return };
    let [u1, u2] = last.node.axes[0];
    last.node.axes[1] = [-u2, u1];
    let mut next = last.node.axes[1];
    for point in before.iter_mut().rev() {
        let [[a, b], [c, d]] = point.jacobian;
        let image = applied([[d, -b], [-c, a]], next);
        next = normalised(image);
        point.node.axes[1] = next;
        point.growth[1] = (a * d - b * c) / image[0].hypot(image[1]);
    }
}

/// Index of the point with the greatest jump, and that jump as a multiple of the bounds.
pub(super) fn worst(points: &[Point]) -> (usize, f64) {
    let ratio = |point: &Point| (point.jump[0] / point.size[0]).abs().max((point.jump[1] / point.size[1]).abs());
    let ratios = points.iter().enumerate().skip(1).map(|(k, point)| (k, ratio(point)));
    // proposes: the first NaN counts as the greatest
    ratios.fold((0, 0.0), |most, ratio| if ratio.1 <= most.1 || most.1.is_nan() { most } else { ratio })
}

/// Whether a jump of this ratio to the bounds is small enough.
pub(super) fn is_fine(ratio: f64) -> bool {
    ratio < 2_f64.powi(JUMP_EXPONENT)
}

/// A step of Newton's iteration: jumps are left only to second order. `None` where a correction is not finite.
pub(super) fn improve(points: &mut [Point]) -> Option<()> {
    let mut moves = vec![[0.0; 2]; points.len()];
    let kept = kept(points);
    for k in (0..kept).rev() {
        moves[k][0] = (moves[k + 1][0] - points[k + 1].split(points[k + 1].jump)[0]) / points[k].growth[0];
    }
    for k in 0..points.len() - 1 {
        let jump = points[k + 1].split(points[k + 1].jump);
        if k >= kept {
            moves[k + 1][0] = moves[k][0] * points[k].growth[0] + jump[0];
        }
        moves[k + 1][1] = moves[k][1] * points[k].growth[1] + jump[1];
    }
    for (point, [xi, eta]) in points.iter_mut().zip(moves) {
        let [u, s] = point.node.axes;
        for i in 0..2 {
            let centre = &point.node.centre[i];
            let moved = centre.clone() + &Real::point(Dyadic::from_f64(xi * u[i] + eta * s[i])?, centre.bits());
            point.node.centre[i] = Real::point(moved.mid(), moved.bits());
        }
    }
    Some(())
}

/// The point that stays fixed along its expanding direction: its bounds restrict the first point's direction most. It is
/// the last point where the motion expands, and a point with narrow bounds where the motion neither expands nor contracts.
fn kept(points: &[Point]) -> usize {
    let mut grown = 0.0;
    let left = points.iter().map(|point| {
        let [u, _] = point.node.axes;
        let along = (point.size[0] / u[0].abs()).min(point.size[1] / u[1].abs());
        let left = along.ln() - grown;
        grown += point.growth[0].ln();
        left
    });
    let least = left.enumerate().skip(1).min_by(|a, b| a.1.total_cmp(&b.1));
    least.map_or(points.len() - 1, |(k, _)| k)
}

/// Sides of nodes that may cover one another: expanding sides from the last node backward, the others forward.
pub(super) fn plan(points: &mut [Point]) {
    let links: Vec<_> = points.windows(2).map(|pair| pair[0].mixed(&pair[1])).collect();
    let noises: Vec<_> = points.iter().map(Point::noise).collect();
    // First as if the axes were exact, then with the errors of the axes.
    for _ in 0..2 {
        let last = points.len() - 1;
        points[last].node.sides[0] = noises[last][0];
        for k in (0..last).rev() {
            let needed =
                points[k + 1].node.sides[0] + JUMP_MARGIN * noises[k + 1][0] + links[k][0] * points[k].node.sides[1];
            points[k].node.sides[0] = MARGIN * needed / points[k].growth[0];
        }
        for k in 0..last {
            let [a, b] = points[k].node.sides;
            let needed = b * points[k].growth[1].abs() + links[k][1] * a + JUMP_MARGIN * noises[k + 1][1];
            points[k + 1].node.sides[1] = MARGIN * needed;
        }
    }
}

impl Point {
    /// The coordinates along `u` and `s`.
    fn split(&self, x: Pair) -> Pair {
        let [u, s] = self.node.axes;
        [cross(x, s) / cross(u, s), cross(u, x) / cross(u, s)]
    }

    /// Bounds of the jump and of a small part of the claimed bounds, along `u` and `s`, for which a node makes room.
    fn noise(&self) -> Pair {
        let [u, s] = self.node.axes;
        let [p, v] = [0, 1].map(|i| self.jump[i].abs() + self.size[i] * 2_f64.powi(JUMP_EXPONENT));
        [s, u].map(|axis| ((axis[1] * p).abs() + (axis[0] * v).abs()) / cross(u, s).abs())
    }

    /// Rounding errors of the axes: the part of `s` that the flight maps along the next `u`, and of `u` along the next `s`.
    fn mixed(&self, next: &Self) -> Pair {
        let absolute = |rows: [Pair; 2], [x, y]: Pair| rows.map(|[a, b]| (a * x).abs() + (b * y).abs());
        let ([u, s], determinant) = (next.node.axes, cross(next.node.axes[0], next.node.axes[1]).abs());
        let size = |image: Pair, axis: Pair| ((axis[1] * image[0]).abs() + (axis[0] * image[1]).abs()) / determinant;
        let [far, wide] = self.node.axes.map(|axis| absolute(self.jacobian, axis));
        [ROUNDING * size(wide, s), ROUNDING * size(far, u)]
    }
}

fn cross([a, b]: Pair, [x, y]: Pair) -> f64 {
    a * y - b * x
}

fn applied([[a, b], [c, d]]: [Pair; 2], [x, y]: Pair) -> Pair {
    [a * x + b * y, c * x + d * y]
}

fn normalised([x, y]: Pair) -> Pair {
    let length = x.hypot(y);
    [x / length, y / length]
}
