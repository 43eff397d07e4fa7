//! The proposed chain: a pseudo-orbit, its directions and the sides of its nodes. Nothing here proves anything.
//!
//! Labels: proposes throughout.

use super::node::{Axes, Landing, Node};
use crate::contact::{Contact, Undecided};
use crate::flight::Launch;
use crate::mapping::jacobian_between;
use crate::number::Ball;
use crate::shaken::Flying;
use crate::turns;

/// Factor by which a node is wider than the least that covers the next one, and multiple of the noise that it makes room for.
const MARGIN: f64 = 1.05;
const NOISE_MARGIN: f64 = 2.0;

/// A state near an orbit, with what leads to it and away from it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub node: Node,
    /// Bounds of its distance from the image of the point before: radii of phase and velocity, and the slope that shears them, scaled.
    noise: [f64; 3],
    /// The derivative of the flight to the next one, scaled, and the factor by which it multiplies the unstable direction.
    jacobian: [[f64; 2]; 2],
    growth: f64,
}

impl Point {
    /// Point where flights land, the centre's flight coming from a point with this image of its unstable direction.
    pub fn at(landing: &Landing, scale: f64, unstable: [f64; 2]) -> Self {
        let Landing { wall, turns, phase, velocity, slope, .. } = *landing;
        let [u1, u2] = normalised(unstable);
        let axes = Axes { unstable: [u1, u2], stable: [-u2, u1], scale };
        let (phase, velocity) = ((phase.mid(), phase.rad()), (velocity.mid(), velocity.rad()));
        let node = Node { wall, turns, phase: phase.0, velocity: velocity.0, axes, sides: [0.0; 2] };
        let noise = [phase.1, velocity.1 / scale, slope.mid() / scale];
        Self { node, noise, jacobian: [[0.0; 2]; 2], growth: 1.0 }
    }

    /// Flies on to the next one: from the centre alone, certified.
    #[inline(always)]
    pub fn next<S: Flying>(&mut self, shaken: &S) -> Result<Self, Undecided> {
        let Node { wall, turns: from, phase, velocity, axes: Axes { scale, unstable, .. }, .. } = self.node;
        let restitution = shaken.pair().restitution;
        let after = shaken.pair().rebound_of(Ball::exact(velocity));
        let launch = Launch::from_wall(wall, from, Ball::exact(phase), after, false);
        let (contact, swings) = shaken.first_contact(launch, None)?;
        let swings = swings.map(Ball::mid);
        let Contact { wall, turns, phase, time, velocity: arrival } = contact;
        let jacobian = jacobian_between(restitution.mid(), time.mid(), swings, [velocity, arrival.mid()]);
        let [[a, b], [c, d]] = jacobian.ok_or(Undecided::width(&contact))?;
        self.jacobian = [[a, b * scale], [c / scale, d]];
        let image = applied(self.jacobian, unstable);
        self.growth = length(image);
        let (turns, middle) = turns::carry(turns, phase.mid());
        let turns = turns::after(from, turns).ok_or(Undecided::endless())?;
        let [u1, u2] = normalised(image);
        let axes = Axes { unstable: [u1, u2], stable: [-u2, u1], scale };
        let node = Node { wall, turns, phase: middle, velocity: arrival.mid(), axes, sides: [0.0; 2] };
        // Of the velocity's radius that which the phase's does not explain.
        let rest = (arrival.rad() - swings[1].abs() * phase.rad()).max(4.0 * f64::EPSILON * arrival.mid().abs());
        let noise = [phase.rad(), rest / scale, swings[1] / scale];
        Ok(Self { node, noise, jacobian: [[0.0; 2]; 2], growth: 1.0 })
    }

    /// The point one unit in the last place faster: the move counts as noise.
    pub fn moved(&self) -> Self {
        let Node { velocity, axes, .. } = self.node;
        let moved = velocity * (1.0 + f64::EPSILON);
        let [phase, rest, slope] = self.noise;
        let noise = [phase, rest + (moved - velocity).abs() / axes.scale, slope];
        Self { node: Node { velocity: moved, ..self.node }, noise, ..*self }
    }

    /// The noise along the unstable axis.
    fn unstable_noise(&self) -> f64 {
        let Axes { unstable: [u1, u2], stable: [s1, s2], .. } = self.node.axes;
        let [phase, velocity, slope] = self.noise;
        ((s2 - s1 * slope).abs() * phase + s1.abs() * velocity) / (u1 * s2 - u2 * s1).abs()
    }

    /// Half the unstable side of a node before, stretched by `growth`, that covers this node.
    pub fn covering_side(&self, growth: f64) -> f64 {
        MARGIN * (self.node.sides[0] + NOISE_MARGIN * self.unstable_noise()) / growth
    }
}

/// The directions that contract and the sides that cover, from the last point backward down to number `first`.
pub(crate) fn plan(points: &mut [Point], first: usize) {
    let Some(last) = points.get_mut(first..).and_then(<[Point]>::last_mut) else { return };
    let [u1, u2] = last.node.axes.unstable;
    last.node.axes.stable = [-u2, u1];
    last.node.sides[0] = last.unstable_noise();
    for k in (first..points.len() - 1).rev() {
        let next = points[k + 1];
        let [[a, b], [c, d]] = points[k].jacobian;
        // The adjugate: the inverse but for a factor, and right where a perfectly plastic impact leaves none.
        points[k].node.axes.stable = normalised(applied([[d, -b], [-c, a]], next.node.axes.stable));
        points[k].node.sides[0] = next.covering_side(points[k].growth);
    }
}

/// The number of the point up to which the unstable direction has grown most, from the first one.
pub(crate) fn farthest(points: &[Point]) -> usize {
    let Some((_, flown)) = points.split_last() else { return 0 };
    let (mut grown, mut most, mut farthest) = (0.0, 0.0, 0);
    for (number, point) in flown.iter().enumerate() {
        grown += point.growth.ln();
        if grown > most {
            (most, farthest) = (grown, number + 1);
        }
    }
    farthest
}

fn applied([[a, b], [c, d]]: [[f64; 2]; 2], [x, y]: [f64; 2]) -> [f64; 2] {
    [a * x + b * y, c * x + d * y]
}

pub(crate) fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

fn normalised([x, y]: [f64; 2]) -> [f64; 2] {
    let length = length([x, y]);
    [x / length, y / length]
}
