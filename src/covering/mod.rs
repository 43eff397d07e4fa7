//! Shadowing: a true orbit near a pseudo-orbit, proved by parallelograms each of which covers the next.
//!
//! Rising precision costs half a bit for each impact of a chaotic motion, and the widths of flying sets grow. Here the question is another. Does
//! a true orbit, from a start very near the given one, have these impacts, each this near to its place in doubles? Along the expanding direction
//! the set of states is stretched over the next set instead of being followed. So widths never grow, however long the orbit. Lemmas F1-F4 of
//! `docs/proofs/covering.md#F1`.

pub(crate) mod chain;
pub(crate) mod node;
mod proposal;
pub(crate) mod start;
#[cfg(test)]
mod tests;

use chain::{Chain, Covering};
use node::Node;

use crate::Error;
use crate::Scene;
pub use crate::clock::Clock;
use crate::contact::Undecided;
use crate::impact::Impact;
use crate::mapping::Mapping;
use crate::number::Ball;
use crate::pair::{ImpactPair, Wall, ball};
use crate::shaken::{Either, State, under};
use impact_pair_model::Start;

/// The reason why a chain goes no further.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// From a point near the end the ball comes to rest on a wall, proved: nothing expands any more.
    Rest,
    /// From there on no direction is seen to expand: the motion is regular, or has become so, and then
    /// [`Arithmetic::Interval`](impact_pair_model::Arithmetic::Interval) follows it without widths that grow.
    NoExpansion,
    /// Expanding and contracting directions are nearly tangent, and orbits nearby do not avoid it.
    Uncovered,
    /// A flight is not decided: most often a graze.
    Undecided(Undecided),
}

/// An orbit near the given one, proved to exist: an iterator over its impacts, without end while the motion is chaotic.
///
/// **Enclosure**: for all parameters of the scene and every start that it allows there is a start with the same time and place
/// whose velocity lies in [`Shadow::start`] (with the same velocity and a time in there, where no velocity is left after the
/// impact) and whose true orbit has the impacts listed, as its first ones and without another contact between: impact `i` is on
/// that wall, in the listed forcing period, with phase and velocity in the balls. It is *one* start for all impacts listed, however many;
/// the orbit of the given start itself is another. Lemmas F1-F4
/// **Cost**: two certified flights an impact, and about 2 MB.
///
/// ```
/// use impact_pair::Scene;
/// use impact_pair::covering::Shadow;
/// let scene = Scene::parse(r#"
///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
///     pair = { gap = 9.42497, restitution = 0.5 }
///     start = { time = 0, wall = "left", velocity = -12.56636 }
/// "#)?;
/// let mut shadow = Shadow::of(&scene)?;
/// let (_, phase, velocity) = shadow.start();
/// assert!(phase.rad() == 0.0 && velocity.rad() < 1e-12);
/// for impact in shadow.by_ref().take(10_000) {
///     assert!(impact.phase.rad() < 1e-8 && impact.velocity.rad() < 1e-6);
/// }
/// assert_eq!(shadow.ending(), None);
/// # Ok::<(), impact_pair::Error>(())
/// ```
#[derive(Debug)]
pub struct Shadow {
    clock: Clock,
    chain: Box<dyn Covering>,
    nodes: std::vec::IntoIter<Node>,
    listed: u64,
    /// The wall of the last impact listed, or of the start; `None` inside the gap.
    wall: Option<Wall>,
}

impl Shadow {
    /// The orbit of `pair` near the one from `start`.
    ///
    /// # Errors
    /// If the start is not in the box of `pair`, or a value is beyond the range of double-precision flights.
    pub fn new(pair: &ImpactPair, start: &Start) -> Result<Self, Error> {
        let clock = Clock::new(pair, start.time(), 0)?;
        let either = Either::new(pair, &clock)?;
        let origin = either.origin(pair, start, &clock)?.map(ball)?;
        let wall = origin.state.place.wall();
        let mut chain: Box<dyn Covering> = under!(either, shaken => Box::new(Chain::from_origin(shaken, origin, None)));
        let nodes = chain.advance().into_iter();
        Ok(Self { clock, chain, nodes, listed: 0, wall })
    }

    /// The orbit near that of a scene; errors have the line in the scene file.
    ///
    /// # Errors
    /// As [`Shadow::new`].
    pub fn of(scene: &Scene) -> Result<Self, Error> {
        Self::new(scene.pair(), scene.start()).map_err(|error| scene.located(error, &scene.settings()))
    }

    /// Start of the orbit: whole forcing periods since the clock's origin, the rest of the phase, and the velocity in gap widths per forcing
    /// period, before the impact for a start on a wall.
    ///
    /// **Enclosure**: phase and velocity hold the start; whichever of them is the scene's is exact.
    pub fn start(&self) -> (i64, Ball, Ball) {
        let State { turns, phase, velocity, .. } = self.chain.starts().bounds;
        (turns, phase, velocity)
    }

    /// Clock that converts phases into times, and velocities without units into velocities of the scene.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Reason why no impact follows; `None` while there are more.
    pub fn ending(&self) -> Option<&Ending> {
        self.chain.ending().filter(|_| self.nodes.as_slice().is_empty())
    }
}

impl Iterator for Shadow {
    type Item = Impact;

    #[inline]
    fn next(&mut self) -> Option<Impact> {
        if self.nodes.as_slice().is_empty() {
            self.nodes = self.chain.advance().into_iter();
        }
        let node = self.nodes.next()?;
        self.listed += 1;
        let Node { wall, turns, .. } = node;
        let mapping = self.wall.replace(wall).map(|from| Mapping::between(from, wall));
        let (index, phase, velocity) = (self.listed, node.phases(), node.velocities());
        Some(Impact { index, mapping, wall, turns, phase, velocity, precise: None })
    }
}
