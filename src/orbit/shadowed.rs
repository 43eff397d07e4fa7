//! An orbit near the given one, for any number of chaotic impacts: a chain of nodes, and where nothing expands the set from its last one.
//!
//! Statements proved of all orbits from a box that holds the last node are true of the chain's orbit: Lemma F5 of
//! `docs/proofs/covering.md#F5`. The state at a release no longer depends on the start: from there on the orbit is followed in exact data.

use std::sync::Arc;
use std::vec::IntoIter;

use super::motion::{IntervalMotion, Motion, StartBounds};
use super::splice::Splice;
use super::{Arithmetic, Impact, Orbit, Outcome, Settings, Start};
use crate::clock::Clock;
use crate::contact::{Contact, Grazed, Undecided};
use crate::covering::chain::{Chain, Covering, LOOKAHEAD};
use crate::covering::node::Node;
use crate::covering::start::Beginning;
use crate::covering::start::{Segment, Starts, Varied};
use crate::exact::Enclosure;
use crate::impact::finite;
use crate::number::Ball;
use crate::pair::{ImpactPair, Wall};
use crate::shaken::{Flying, Location, Origin, State};

/// Bits in which a start near by is printed: enough to tell it from the given start.
pub(super) const START_BITS: u32 = 160;

/// One impact after another of a shadowed orbit.
#[derive(Debug)]
pub(super) struct ShadowMotion<S: Flying, B> {
    shaken: Arc<S>,
    /// The impacts before the first node, where they are proved by precision, and the bounds of the last one handed out.
    before: IntoIter<Impact>,
    precise: Option<Box<(Enclosure, Enclosure)>>,
    start_bounds: Option<StartBounds>,
    chain: Chain<S, B>,
    nodes: IntoIter<Node>,
    /// The last node handed out; its whole forcing periods and phase, or those of the starts.
    last: Option<Node>,
    at: (i64, Ball),
    /// The motion after the last node.
    set: Option<IntervalMotion<S>>,
}

/// Claims about a shadowed orbit.
#[derive(Clone, Debug, PartialEq)]
pub struct Shadowing {
    /// **Enclosure**: holds the time of the start that has the orbit \[time\].
    pub time: Enclosure,
    /// **Enclosure**: holds the velocity of that start \[length/time\]; either the time or the velocity is the scene's.
    pub velocity: Enclosure,
    /// Bounds of the distances of impacts from the middles of their enclosures, in forcing periods: of half of them, and of all; `None`
    /// without impacts.
    pub nearness: Option<[f64; 2]>,
}

impl Orbit {
    /// Whether sets from the exact start decide the motion, which then does not expand. If so, the exact orbit is followed: its claims are
    /// stronger.
    pub(super) fn is_regular(pair: &ImpactPair, start: &Start, settings: &Settings, impacts: u64) -> bool {
        let impacts = settings.impacts.map_or(impacts, |requested| requested.min(impacts)); // proposes: what to claim
        let until = settings.until.clone();
        let interval = Arithmetic::Interval;
        let settings = Settings { impacts: Some(impacts), until, arithmetic: interval, ..Settings::default() };
        let Ok(mut orbit) = Self::new(pair, start, settings) else { return false };
        orbit.by_ref().for_each(drop);
        !matches!(orbit.outcome(), Some(Outcome::Undecided { .. }))
    }

    /// Counts a listed impact of a shadowed orbit.
    #[inline]
    pub(super) fn note_nearness(&mut self, phase: Ball) {
        if let Some(near) = &mut self.pending.near {
            near.nearness.keep(phase.rad());
        }
    }

    /// Claims about the start of an orbit near the given one; `None` where the orbit is that of the given start.
    pub fn shadow(&self) -> Option<Shadowing> {
        let NearbyStart { time, velocity, nearness } = self.pending.near.as_ref()?;
        Some(Shadowing { time: time.clone(), velocity: velocity.clone(), nearness: nearness.median_and_most() })
    }
}

/// A start near the given one, and how near the impacts of its orbit are.
#[derive(Debug)]
pub(super) struct NearbyStart {
    time: Enclosure,
    velocity: Enclosure,
    nearness: Nearness,
}

impl NearbyStart {
    /// Starts of a motion near the one from `start`; either their time or their velocity is that of the requested start.
    pub fn new(clock: &Clock, start: &Start, motion: &dyn Motion) -> Option<Self> {
        let Starts { varied, bounds: State { turns, phase, velocity, .. } } = motion.starts()?;
        let in_doubles = || match varied {
            Varied::Time => (clock.time(turns, &finite(phase)), start.velocity().enclose(START_BITS)),
            Varied::Velocity => (start.time().enclose(START_BITS), clock.velocity(&finite(velocity))),
        };
        let (time, velocity) = motion.start_bounds().unwrap_or_else(in_doubles);
        Some(Self { time, velocity, nearness: Nearness::default() })
    }
}

impl<S: Flying> ShadowMotion<S, Segment<S::Waves<Ball>>> {
    /// A motion from near an origin, for `impacts` impacts; also the number of impacts after which nothing expands any more, if so. `None` where
    /// no chain begins.
    pub fn from(shaken: Arc<S>, origin: &Origin<Ball>, impacts: Option<u64>) -> Option<(Box<dyn Motion>, Option<u64>)> {
        let mut chain = Chain::from_origin(shaken.clone(), origin.clone(), impacts);
        let nodes = chain.advance();
        let regular = (!chain.expands()).then_some((nodes.len() + LOOKAHEAD) as u64); // proposes: what to claim
        Some((Box::new(Self::of(shaken, chain, nodes)?), regular))
    }
}

impl<S: Flying> ShadowMotion<S, Splice> {
    /// A motion along a chain that begins after impacts proved by precision.
    pub fn spliced(shaken: Arc<S>, splice: Splice, left: Option<u64>) -> Option<Box<dyn Motion>> {
        let mut chain = Chain::new(shaken.clone(), splice, left);
        let nodes = chain.advance();
        let (before, near) = chain.beginning().proved()?;
        let (before, start_bounds) = (Vec::from(before).into_iter(), Some(near.clone()));
        Some(Box::new(Self { before, start_bounds, ..Self::of(shaken, chain, nodes)? }))
    }
}

impl<S: Flying, B: Beginning<S>> ShadowMotion<S, B> {
    /// The motion along a chain that has begun; `None` where it has not.
    fn of(shaken: Arc<S>, chain: Chain<S, B>, nodes: Vec<Node>) -> Option<Self> {
        let State { turns, phase, .. } = chain.starts().bounds;
        let (at, is_begun) = ((turns, phase), !nodes.is_empty());
        let (before, nodes) = (Vec::new().into_iter(), nodes.into_iter());
        is_begun.then_some(Self {
            shaken,
            before,
            precise: None,
            start_bounds: None,
            chain,
            nodes,
            last: None,
            at,
            set: None,
        })
    }

    /// Goes on to a state; returns the contact seen from the state before.
    #[inline(always)]
    fn passed(&mut self, wall: Wall, turns: i64, phase: Ball, velocity: Ball) -> Contact<Ball> {
        let passed = (turns - self.at.0) as f64; // N1: a flight is shorter than 2^53 forcing periods
        let time = Ball::exact(passed) + (phase - self.at.1);
        self.at = (turns, phase);
        Contact { wall, turns: passed, phase, time, velocity }
    }

    /// The set of the last node's box. Lemma F5
    #[cold]
    fn last_node_set(&self) -> Option<IntervalMotion<S>> {
        let node = self.last?;
        let (place, turns) = (Location::Wall(node.wall), node.turns);
        let state = State { place, turns, phase: node.phases(), velocity: node.velocities() };
        Some(IntervalMotion::new(self.shaken.clone(), &Origin::of(state)))
    }
}

impl<S: Flying, B: Beginning<S>> Motion for ShadowMotion<S, B> {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        if let Some(set) = &mut self.set {
            return set.next_contact();
        }
        if let Some(Impact { wall, turns, phase, velocity, precise, .. }) = self.before.next() {
            self.precise = precise;
            return Ok(self.passed(wall, turns, phase, velocity));
        }
        self.precise = None;
        if self.nodes.as_slice().is_empty() {
            self.nodes = self.chain.advance().into_iter();
        }
        let Some(node) = self.nodes.next() else {
            self.set = self.last_node_set();
            return self.set.as_mut().ok_or(Undecided::endless())?.next_contact();
        };
        self.last = Some(node);
        Ok(self.passed(node.wall, node.turns, node.phases(), node.velocities()))
    }

    fn starts(&self) -> Option<Starts> {
        Some(self.chain.starts())
    }

    fn start_bounds(&self) -> Option<StartBounds> {
        self.start_bounds.clone()
    }

    fn enclosures(&self, bits: u32) -> Option<(Enclosure, Enclosure)> {
        self.precise.as_deref().map(|(phase, velocity)| (phase.rounded(bits), velocity.rounded(bits)))
    }

    fn accuracy(&self) -> f64 {
        self.set.as_ref().map_or(0.0, Motion::accuracy)
    }

    fn pass_graze(&mut self) -> Option<Grazed> {
        self.set.as_mut()?.pass_graze()
    }
}

/// Distances within which impacts are proved to lie from their listed values: radii of phases in forcing periods, counted by their size.
#[derive(Debug)]
pub(super) struct Nearness {
    counts: Vec<u64>,
    impacts: u64,
    most: f64,
}

/// Bits of a double's fraction that sizes keep: they are exact to 1/32.
const FRACTION: u32 = 5;
const SHIFT: u32 = f64::MANTISSA_DIGITS - 1 - FRACTION;

impl Default for Nearness {
    fn default() -> Self {
        Self { counts: vec![0; (f64::INFINITY.to_bits() >> SHIFT) as usize + 1], impacts: 0, most: 0.0 } // exact: below 2^16
    }
}

impl Nearness {
    pub fn keep(&mut self, radius: f64) {
        self.counts[(radius.to_bits() >> SHIFT) as usize] += 1; // exact: radii are not negative
        self.impacts += 1;
        self.most = self.most.max(radius); // exact: one of the two
    }

    /// The median and the greatest radius, rounded up; `None` without impacts.
    pub fn median_and_most(&self) -> Option<[f64; 2]> {
        let mut left = self.impacts.div_ceil(2);
        let size = self.counts.iter().position(|count| {
            left = left.saturating_sub(*count); // exact: what is left of it
            left == 0
        })?;
        let median = f64::from_bits((size as u64 + 1) << SHIFT); // exact: the size above this one
        (self.impacts > 0).then_some([median.min(self.most), self.most]) // exact: no impact is farther
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use crate::tests::{scene, scene_of};
    use proptest::prelude::*;

    fn shadow(scene: &Scene, impacts: u64) -> Orbit {
        let settings = Settings { arithmetic: Arithmetic::Shadow, impacts: Some(impacts), ..Settings::default() };
        Orbit::of(scene, Settings { attractor: true, ..settings }).unwrap()
    }

    /// Blocks are handed out without a gap, the last one as far as requested; what is listed is what the chain proves.
    #[test]
    fn an_orbit_lists_the_nodes_of_its_chain() {
        let scene = scene("figure-14");
        for impacts in [1, 2, 4095, 4096, 4097, 4098, 9000] {
            let mut orbit = shadow(&scene, impacts);
            let chain = crate::covering::Shadow::of(&scene).unwrap();
            let mut listed = 0;
            for (impact, node) in orbit.by_ref().zip(chain) {
                listed += 1;
                assert_eq!((impact.index, impact.wall, impact.turns), (node.index, node.wall, node.turns));
                // The two chains are planned from different ends.
                assert!((impact.phase.mid() - node.phase.mid()).abs() <= impact.phase.rad() + node.phase.rad());
            }
            assert_eq!((listed, orbit.outcome()), (impacts, Some(&Outcome::ImpactsReached)));
        }
    }

    #[test]
    fn a_regular_orbit_is_that_of_the_exact_start() {
        for (name, impacts) in
            [("figure-12", 5), ("figure-12", 500), ("figure-13", 500), ("figure-15", 30), ("figure-15", 5000)]
        {
            let mut orbit = shadow(&scene(name), impacts);
            assert_eq!((orbit.by_ref().count() as u64, orbit.shadow()), (impacts, None), "{name}");
            assert!(matches!(orbit.outcome(), Some(Outcome::Attracted(_) | Outcome::ImpactsReached)), "{name}");
        }
    }

    /// A chaotic transient that comes to rest: what follows the release is that of every orbit that rests there.
    #[test]
    fn a_rest_ends_the_chain_and_forgets_the_start() {
        use crate::orbit::Progress;
        use crate::watch::Unwatched;
        use std::ops::ControlFlow;
        let start = "time = 0, wall = \"left\", velocity = -5";
        let scene = scene_of("amplitude = 4.92, frequency = \"pi\", phase = 0", "gap = 40, restitution = 0.5", start);
        let events = |mut orbit: Orbit| {
            let mut events = Vec::new();
            let _ = orbit.follow(&Unwatched, |_, event| {
                events.push(event);
                ControlFlow::<()>::Continue(())
            });
            (orbit, events)
        };
        let (orbit, shadowed) = events(shadow(&scene, 200));
        assert!(orbit.shadow().is_some() && matches!(orbit.outcome(), Some(Outcome::Periodic(_))), "{orbit:?}");
        let (_, exact) = events(Orbit::of(&scene, Settings { impacts: Some(200), ..Settings::default() }).unwrap());
        let release = |events: &[Progress]| {
            let found = events
                .iter()
                .find_map(|event| if let Progress::Release(release) = event { Some(release.clone()) } else { None });
            found.expect("a release")
        };
        // The start differs by 1e-13, which the rest forgets: the wall and the phase of the release are the same.
        let [shadowed, exact] = [release(&shadowed), release(&exact)];
        assert_eq!((shadowed.wall, shadowed.phase), (exact.wall, exact.phase));
    }

    proptest! {
        /// By sorting.
        #[test]
        fn the_median_is_that_of_the_sizes(radii in prop::collection::vec(-60..3i32, 1..200), odd in 1.0..2.0f64) {
            let mut radii: Vec<f64> = radii.into_iter().map(|size| odd * 2f64.powi(size)).collect();
            let mut nearness = Nearness::default();
            radii.iter().for_each(|radius| nearness.keep(*radius));
            radii.sort_by(f64::total_cmp);
            let ([median, most], middle) = (nearness.median_and_most().unwrap(), radii[(radii.len() - 1) / 2]);
            prop_assert_eq!(most, radii[radii.len() - 1]);
            prop_assert!(middle <= median && median <= middle * (1.0 + 1.0 / 32.0));
        }
    }
}
