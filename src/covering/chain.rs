//! A chain of nodes, each of which covers the next: proposed block by block, and proved link by link: Lemmas F1-F4.

use std::sync::Arc;

use super::Ending;
use super::node::{Axes, Landing, Link, Node};
use super::proposal::{Point, farthest, length, plan};
use super::start::{Beginning, OnWall, Segment, Starts};
use crate::contact::Undecided;
use crate::exact::Exact;
use crate::number::Ball;
use crate::pair::Inward;
use crate::shaken::{Flying, Origin};

/// Nodes that are handed out at a time.
const BLOCK_SIZE: usize = 4096;
/// Impacts that are proposed anew where a link is not proved: another orbit is then far enough from the one that fails there.
const REPROPOSED_IMPACTS: usize = 60;
/// Impacts that are looked ahead: contracting directions and sides have forgotten their beginning by then.
pub(crate) const LOOKAHEAD: usize = 512;
/// Number of times in a block that a link is avoided by moving the orbit before it.
const MAX_TRIES: u32 = 2;

/// A chain under any excitation.
pub(crate) trait Covering: std::fmt::Debug + Send {
    /// Starts, one of which has the orbit.
    fn starts(&self) -> Starts;

    /// The next nodes, proved; empty at the end.
    fn advance(&mut self) -> Vec<Node>;

    /// Reason why there are no more nodes; `None` while there are.
    fn ending(&self) -> Option<&Ending>;

    /// Whether the motion was seen to expand beyond the last node.
    fn expands(&self) -> bool;
}

#[derive(Debug)]
pub(crate) struct Chain<S: Flying, B> {
    shaken: Arc<S>,
    beginning: B,
    /// Half the length of the curve of starts.
    reach: f64,
    /// Points of the chain; the first one has been handed out, except in a chain that has not begun.
    points: Vec<Point>,
    is_begun: bool,
    /// Number of nodes that are still requested.
    left: usize,
    /// Directions were seen to expand as far as was looked ahead, more or less.
    expands: bool,
    ending: Option<Ending>,
}

impl<S: Flying> Chain<S, Segment<S::Waves<Ball>>> {
    /// Chain from an origin, of `nodes` nodes; endless for `None`.
    pub fn from_origin(shaken: Arc<S>, origin: Origin<Ball>, nodes: Option<u64>) -> Self {
        let segment = Segment::new(&*shaken, origin);
        Self::new(shaken, segment, nodes)
    }
}

impl<S: Flying, B: Beginning<S>> Chain<S, B> {
    /// Chain from any beginning.
    pub fn new(shaken: Arc<S>, beginning: B, nodes: Option<u64>) -> Self {
        let left = nodes.and_then(|nodes| usize::try_from(nodes).ok()).unwrap_or(usize::MAX); // exact: more are not counted
        let mut chain = Self {
            shaken,
            beginning,
            reach: 0.0,
            points: Vec::new(),
            is_begun: false,
            left,
            expands: false,
            ending: None,
        };
        match chain.first() {
            Ok(first) => chain.points.push(first),
            Err(undecided) => {
                let start = chain.beginning.on_wall();
                let is_rest = start.is_some_and(|(state, phases)| chain.comes_to_rest(state, phases));
                chain.ending = Some(if is_rest { Ending::Rest } else { Ending::Undecided(undecided) });
            }
        }
        chain
    }

    /// Whether a state is proved to come to rest on its wall, after infinitely many impacts or none. `phases` are those of several harmonics,
    /// where they are known exactly. Lemmas Z1, H7
    fn comes_to_rest(&self, (wall, turns, phase, before): OnWall, phases: &[Exact]) -> bool {
        let after = wall.inward(self.shaken.pair().rebound_of(before));
        let time = |phase| self.shaken.accumulation(wall, turns, &phase, after, phases);
        phase.enclosure().and_then(time).is_some()
    }

    /// The first impact of the given start itself.
    fn first(&mut self) -> Result<Point, Undecided> {
        let landing = self.beginning.land(&self.shaken, 0.0)?;
        Ok(Point::at(&landing, self.beginning.scale(), self.stretched(&landing)))
    }

    /// The beginning of the chain.
    pub fn beginning(&self) -> &B {
        &self.beginning
    }

    /// The image of the curve's direction, scaled.
    fn stretched(&self, landing: &Landing) -> [f64; 2] {
        let [phase, velocity] = landing.jacobian.jacobian().map(|row| row[0].mid());
        [phase, velocity / self.beginning.scale()]
    }

    /// Numbers of the last point that this block hands out, and of the last one that it proves: of all requested points, or of a block.
    fn goals(&self) -> (usize, usize) {
        // The first point has been handed out, but for a chain that has not begun.
        let last = self.left.saturating_sub(usize::from(!self.is_begun)); // proposes: how far
        if last <= BLOCK_SIZE { (last, last) } else { (BLOCK_SIZE, BLOCK_SIZE + REPROPOSED_IMPACTS) }
    }

    /// Proposes points up to the horizon; returns the question that stops them.
    fn propose(&mut self, goal: usize) -> Option<Undecided> {
        while self.points.len() <= goal + LOOKAHEAD {
            let last = self.points.last_mut()?;
            match last.next(&*self.shaken) {
                Ok(point) => self.points.push(point),
                Err(undecided) => return Some(undecided),
            }
        }
        None
    }

    /// Proves the links up to point number `end`, which are planned; else returns the number of the first link that fails.
    fn prove(&mut self, end: usize) -> Result<(), (usize, Option<Undecided>)> {
        if !self.is_begun {
            self.begin().map_err(|undecided| (0, undecided))?;
        }
        for k in 0..end {
            let from = self.points[k].node;
            let landing = from.land(&*self.shaken).map_err(|undecided| (k + 1, Some(undecided)))?;
            let next = &mut self.points[k + 1].node;
            link(from.sides, Link::new(&from.axes, &landing, next), next).ok_or((k + 1, None))?;
        }
        Ok(())
    }

    /// Proves the link from the curve of starts.
    fn begin(&mut self) -> Result<(), Option<Undecided>> {
        let given = self.beginning.land(&self.shaken, 0.0)?;
        let reach = self.points[0].covering_side(length(self.stretched(&given)));
        let landing = self.beginning.land(&self.shaken, reach)?;
        let next = &mut self.points[0].node;
        link([reach, 0.0], Link::new(&Axes::of_curve(self.beginning.scale()), &landing, next), next).ok_or(None)?;
        self.reach = reach;
        Ok(())
    }

    /// Plans and proves as much as is proposed and expands; the number of nodes proved after the first point.
    fn block(&mut self) -> usize {
        let mut tries = 0;
        let mut horizon = usize::MAX;
        let (last, goal) = self.goals();
        loop {
            let stopped = self.propose(goal);
            let points = self.points.len().min(horizon.saturating_add(1)); // proposes: how far
            let far = farthest(&self.points[..points]);
            self.expands = far > goal + LOOKAHEAD / 2; // proposes: what to claim
            plan(&mut self.points[..=far], usize::from(self.is_begun));
            let end = far.min(goal); // proposes: how far
            match self.prove(end) {
                Ok(()) if end == goal => return last,
                Ok(()) => {
                    if self.ending.is_none() {
                        let rests = self.points[end..].iter().any(|Point { node, .. }| {
                            let (phase, velocity) = (Ball::exact(node.phase), Ball::exact(node.velocity));
                            self.comes_to_rest((node.wall, node.turns, phase, velocity), &[])
                        });
                        let other = stopped.map_or(Ending::NoExpansion, Ending::Undecided);
                        self.ending = Some(if rests { Ending::Rest } else { other });
                    }
                    return end;
                }
                // The move has to come after what is handed out, and before the link.
                Err((at, _)) if tries < MAX_TRIES && at > 1 => {
                    let from = at.saturating_sub(REPROPOSED_IMPACTS).max(1); // proposes: any point
                    self.points.truncate(from + 1);
                    self.points[from] = self.points[from].moved();
                    tries += 1;
                }
                Err((at, undecided)) => {
                    self.ending = Some(undecided.map_or(Ending::Uncovered, Ending::Undecided));
                    if at == 0 {
                        self.points.clear();
                        return 0;
                    }
                    horizon = at - 1;
                }
            }
        }
    }
}

/// Proves a link to a node that is as narrow as can be.
#[inline(always)]
fn link(sides: [f64; 2], link: Option<Link>, next: &mut Node) -> Option<()> {
    let link = link?;
    next.sides[1] = link.narrowest(sides);
    link.covers(sides, next.sides).then_some(())
}

impl<S: Flying, B: Beginning<S>> Covering for Chain<S, B> {
    fn starts(&self) -> Starts {
        self.beginning.starts(self.reach)
    }

    fn advance(&mut self) -> Vec<Node> {
        if self.ending.is_some() || self.left == 0 {
            return Vec::new();
        }
        let last = self.block();
        let first = usize::from(self.is_begun);
        let nodes: Vec<Node> = self.points.get(first..=last).unwrap_or(&[]).iter().map(|point| point.node).collect(); // exact: nothing left
        self.left -= nodes.len();
        self.points.drain(..last.min(self.points.len())); // exact: all that is there
        self.is_begun = true;
        nodes
    }

    fn ending(&self) -> Option<&Ending> {
        self.ending.as_ref()
    }

    fn expands(&self) -> bool {
        self.expands
    }
}
