//! Proved properties of components: cycles with their periods, the cycle with rests, and the grazing state. Lemmas A7-A9 of
//! `docs/proofs/global.md#A7`.

use impact_pair_model::vocabulary::ComponentKind;

use super::cycle::Limit;
use super::graph::{Component, Release};
use super::image::{Next, Space, ends};
use crate::chaos::flights::Flights;
use crate::chaos::guess::Guess;
use crate::chaos::law::{Law, Side};
use crate::chaos::quad::Quad;
use crate::exact::{Enclosure, Exact};
use crate::number::{Ball, Number};
use crate::orbit::{Orbit, Progress, Settings, Start};
use crate::pair::{ImpactPair, Wall};
use crate::periodic::{PeriodicImpact, PeriodicOrbit, Precision, Problem};
use crate::{Error, Harmonic};

/// The behaviour of the motions that stay in a component.
#[derive(Clone, Debug)]
pub enum Kind {
    /// They tend to a periodic motion that attracts all motions near it.
    Attracting(Box<LimitCycle>),
    /// They tend to a periodic motion that does not.
    Saddle(Box<LimitCycle>),
    /// The states that stay in it have no area, and nearby ones are stretched apart: a set of saddle type, if there are any.
    SaddleSet,
    /// They are released again and again in the same state; `None` where the period is not proved: it may be another one for each member
    /// of the data.
    RestCycle(Option<RestCycle>),
    /// They graze one wall once in every forcing period, for ever.
    Grazing,
    /// Nothing is proved.
    Undecided,
}

impl Kind {
    /// The kind in the JSON output.
    pub fn kind(&self) -> ComponentKind {
        match self {
            Self::Attracting(_) => ComponentKind::Attracting,
            Self::Saddle(_) | Self::SaddleSet => ComponentKind::Saddle,
            Self::RestCycle(_) => ComponentKind::RestCycle,
            Self::Grazing => ComponentKind::Grazing,
            Self::Undecided => ComponentKind::Undecided,
        }
    }

    /// Whether motions near the component are proved to tend to it.
    pub fn is_attractor(&self) -> bool {
        matches!(self, Self::Attracting(_) | Self::RestCycle(_))
    }

    /// Whether nothing is proved.
    pub fn is_undecided(&self) -> bool {
        matches!(self, Self::Undecided)
    }

    /// The periodic motion without rests.
    pub fn limit(&self) -> Option<&LimitCycle> {
        match self {
            Self::Attracting(limit) | Self::Saddle(limit) => Some(limit),
            _ => None,
        }
    }
}

/// A periodic motion without rests, proved.
#[derive(Clone, Debug)]
pub struct LimitCycle {
    /// Least period of the motion under the reduced map.
    pub impacts: usize,
    /// Word and period of the motion on both walls.
    pub problem: Problem,
    /// The orbit.
    pub orbit: PeriodicOrbit,
    /// Bounds of the spectral radius of a period of the reduced map.
    pub spectral_radius: Enclosure,
}

/// A motion that rests again and again, and is released in the same state, or its mirror image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestCycle {
    /// Forcing periods from a release to the next one on the same wall.
    pub cycles: u32,
    /// `true` if the ball rests on both walls in turn.
    pub alternates: bool,
}

/// The motion of a ball after its release.
#[derive(Clone, Debug)]
pub(super) struct Released {
    pub next: Release,
    /// The cycle, where it is released in the same state again.
    pub cycle: Option<RestCycle>,
}

/// Impacts of the released ball that are followed.
const IMPACTS: u64 = 200;
/// Width below which a rectangle of states may stand for the released ball, in forcing periods and over `A W`: the last such one does.
const MAX_STATE_WIDTH: f64 = 0.01;
/// Bits of a spectral radius.
const BITS: u32 = 80;
/// Greatest distance from the state that grazes for ever at which Lemma A9 is used, in radians and over `A W`.
const MAX_GRAZING_DISTANCE: f64 = 0.25;

impl Released {
    /// Follows the ball from the release: as an orbit, and where that is not proved to rest, by rectangles. Lemma A7
    pub fn of(pair: &ImpactPair, space: &Space) -> Result<Self, Error> {
        if let Some(cycle) = Self::orbit(pair)? {
            return Ok(Self { next: Release::Repeats, cycle: Some(cycle) });
        }
        Ok(Self::followed(space, landing(space.law())))
    }

    /// The cycle, if the orbit from the release is proved to rest again.
    fn orbit(pair: &ImpactPair) -> Result<Option<RestCycle>, Error> {
        let turn = Exact::pi() * Exact::from(2);
        let harmonic = Harmonic::new(pair.harmonic("a global analysis")?.amplitude().clone(), turn, Exact::from(0))?;
        let pair = ImpactPair::new(harmonic, pair.gap().clone(), pair.restitution().clone())?;
        let start = Start::on_wall(Exact::from(0), Wall::Left, Exact::from(0))?;
        let mut orbit = Orbit::new(&pair, &start, Settings { impacts: Some(IMPACTS), ..Settings::default() })?;
        let mut rested = None;
        loop {
            match orbit.advance() {
                Progress::Rest(rest) => rested = Some(rest.at.wall),
                Progress::Release(release) => {
                    let alternates = release.wall == Wall::Right;
                    let cycles = if alternates { 2 * release.turns - 1 } else { release.turns };
                    // A7: it has rested, and time has passed
                    let cycles =
                        u32::try_from(cycles).ok().filter(|&cycles| rested == Some(release.wall) && cycles > 0);
                    return Ok(cycles.map(|cycles| RestCycle { cycles, alternates }));
                }
                Progress::Ended => return Ok(None),
                _ => {}
            }
        }
    }

    /// Follows rectangles that hold the states from the first impact on, to a complete chatter, or as far as they are proved to land on one
    /// wall.
    fn followed(space: &Space, [mut phases, mut speeds]: [[f64; 2]; 2]) -> Self {
        let guess = Guess::new(space.law());
        let (mut turns, mut crossings) = (0.0, 1_u32);
        let mut next = Release::Lands(phases, speeds);
        for _ in 0..IMPACTS {
            let whole = phases[0].floor(); // exact: whole forcing periods
            turns += whole; // exact: small whole numbers
            phases = phases.map(|phase| phase - whole); // exact: below 64
            if space.chatters(phases, speeds[1]) {
                let halves = 2.0 * (turns + 1.0) - f64::from(crossings); // exact: small whole numbers
                let alternates = !crossings.is_multiple_of(2);
                let cycles = if alternates { halves } else { 0.5 * halves }; // exact: small whole numbers
                if cycles > f64::from(u32::MAX) {
                    break; // exact: not proved
                }
                let cycle = RestCycle { cycles: cycles as u32, alternates }; // exact: a whole number of 32 bits
                return Self { next: Release::Repeats, cycle: Some(cycle) };
            }
            let Some((side, landed)) = landed(space, &guess, [phases, speeds]) else { break };
            crossings += u32::from(side == Side::Far);
            [phases, speeds] = landed;
            if landed.iter().all(|[low, high]| high - low < MAX_STATE_WIDTH) {
                next = Release::Lands(phases, speeds); // A7: any impact of the released ball
            }
        }
        Self { next, cycle: None }
    }
}

/// The wall that all balls of a rectangle land on next, and a rectangle that holds the phases and speeds there; `None` where that is not proved.
fn landed(space: &Space, guess: &Guess, [phases, speeds]: [[f64; 2]; 2]) -> Option<(Side, [[f64; 2]; 2])> {
    let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
    let centre = [middle(phases), middle(speeds)];
    // A7: the farther end
    let radius = |[low, high]: [f64; 2], at: f64| (high - at).max(at - low).next_up();
    let quad = Quad::rectangle(centre, [radius(phases, centre[0]), radius(speeds, centre[1])], speeds[0]);
    let image = guess.map(centre)?;
    let landing = Flights::new(space.law(), &quad).land(image.side, image.state[0] - image.side.shift())?;
    let [zero, one] = [0.0, 1.0].map(Ball::exact);
    let along = |normal: [Ball; 2]| ends(landing.along(normal, [zero, zero]));
    let next = [along([one, zero]), along([zero, one])];
    (next[1][0] > 0.0).then_some((image.side, next))
}

/// The first impact after a release, on the far wall: `x - sin x = D`. Lemma A7
fn landing(law: &Law) -> [[f64; 2]; 2] {
    let height = |u: f64| Ball::exact(u).turn() * Ball::exact(u) - Ball::exact(u).sin_cos().0;
    let gap = ends(law.gap);
    // A7: the height grows
    let most = (gap[1] + 2.0).max(1.0);
    let bisected = |is_before: &dyn Fn(f64) -> bool| {
        let (mut low, mut high) = (0.0, most);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if is_before(middle) { low = middle } else { high = middle }
        }
        [low, high]
    };
    let low = bisected(&|u| ends(height(u))[1] <= gap[0])[0];
    let high = bisected(&|u| ends(height(u))[0] < gap[1])[1];
    let cos = ends(Ball::new(0.5 * (low + high), (0.5 * (high - low)).next_up()).sin_cos().1);
    let speeds = [(1.0 - cos[1]).next_down().max(0.0), (1.0 - cos[0]).next_up()]; // A7: not negative
    [[low + 0.5, high + 0.5], speeds]
}

impl LimitCycle {
    /// Proves the periodic motion that a limit is, and that its impacts are in the hulls; `None` where that fails.
    pub(super) fn of(pair: &ImpactPair, law: &Law, limit: &Limit, precision: Precision) -> Option<Box<Self>> {
        let guess = Guess::new(law);
        let count = limit.states.len();
        // The phases as they go on, from that of the first.
        let (mut state, mut phases) = (limit.states[0], Vec::with_capacity(count));
        for _ in 0..count {
            phases.push(state[0]);
            state = guess.map(state)?.state;
        }
        let turns = (state[0] - limit.states[0][0]).round(); // proposes: the orbit is proved below
        let crossings = limit.sides.iter().filter(|side| **side == Side::Far).count();
        let rounds = if crossings.is_multiple_of(2) { 1 } else { 2 };
        let (mut walls, mut guesses, mut crossed) = (String::new(), Vec::new(), 0.0);
        let mut wall = Wall::Left;
        for i in 0..rounds * count {
            walls.push(if wall == Wall::Left { 'L' } else { 'R' });
            guesses.push((i / count) as f64 * turns + phases[i % count] - 0.5 * crossed); // proposes
            let side = limit.sides[i % count];
            crossed += if side == Side::Far { 1.0 } else { 0.0 };
            wall = side.lands_on(wall);
        }
        let cycles = rounds as f64 * turns - 0.5 * crossed; // proposes
        (1.0..1e6).contains(&cycles).then_some(())?;
        let problem = Problem::new(pair, &walls.parse().ok()?, cycles as u32).ok()?; // proposes
        let orbit = problem.prove(&guesses, precision)?;
        let states: Vec<[Ball; 2]> = orbit.impacts.iter().map(|impact| mirrored(impact, law)).collect::<Option<_>>()?;
        if !is_motion_in_turn(&orbit, law, &limit.hulls) || !is_least_period(&states[..count]) {
            return None; // exact: not proved
        }
        let eigenvalues = orbit.eigenvalues.each_ref().map(|value| [&value.re, &value.im]);
        let spectral_radius = spectral_radius(eigenvalues, rounds)?;
        Some(Box::new(Self { impacts: count, problem, orbit, spectral_radius }))
    }
}

impl LimitCycle {
    /// Whether the cycle is proved to be in the boxes of a component: `true` where the bounds of one state meet no box of any other
    /// component, `false` where the bounds of one state meet no box of this component; else `None`. Lemma A8 (place)
    pub(super) fn is_in(&self, law: &Law, component: &Component, others: &[&Component]) -> Option<bool> {
        let states: Option<Vec<[Ball; 2]>> = self.orbit.impacts.iter().map(|impact| mirrored(impact, law)).collect();
        let states = states?;
        let meets = |component: &Component, [phase, speed]: [Ball; 2]| {
            let boxes = component.grid.boxes_between(ends(phase), ends(speed));
            boxes.is_none_or(|boxes| boxes.iter().any(|own| component.cells.binary_search(own).is_ok()))
        };
        if states.iter().any(|&state| !meets(component, state)) {
            return Some(false);
        }
        let is_alone = |&state: &[Ball; 2]| others.iter().all(|other| !meets(other, state));
        states.iter().any(is_alone).then_some(true)
    }
}

/// Phase, in forcing periods, and speed, over `A W`, of an impact mirrored to the left wall.
pub(super) fn mirrored(impact: &PeriodicImpact, law: &Law) -> Option<[Ball; 2]> {
    let (phase, radius) = impact.phase.mid_rad();
    let shift = if impact.wall == Wall::Right { 0.5 } else { 0.0 };
    let phase = Ball::new(phase, radius) + Ball::exact(shift);
    let (velocity, radius) = impact.velocity.mid_rad();
    Some([phase, Ball::new(velocity.abs(), radius).checked_div(law.beta()?)?])
}

/// Whether the states of a period of the reduced map are proved not to repeat within it. Lemma A8 (least period)
pub(super) fn is_least_period(states: &[[Ball; 2]]) -> bool {
    let count = states.len();
    let are_apart = |[[phase, speed], [other, its_speed]]: [[Ball; 2]; 2]| {
        let turned = phase - other;
        let turned = turned - Ball::exact(turned.mid().round()); // A8: whole forcing periods
        [turned, speed - its_speed].iter().any(|off| off.mid().abs() > off.rad())
    };
    let is_apart_after = |n: usize| (n..count).any(|i| are_apart([states[i], states[i - n]]));
    (1..count).filter(|&n| count.is_multiple_of(n)).all(is_apart_after)
}

/// Whether an orbit is proved to be admissible, and to have its impacts in the rectangles, one after the other. Lemma A8
pub(super) fn is_motion_in_turn(orbit: &PeriodicOrbit, law: &Law, hulls: &[[[f64; 2]; 2]]) -> bool {
    orbit.physical == Some(true) && is_in_turn(orbit, law, hulls)
}

/// Whether the impacts of a period are proved to be in the rectangles, one after the other, round after round. Impacts are mirrored to the left
/// wall, less whole forcing periods; two rounds use the same rectangles. Lemma A8
pub(super) fn is_in_turn(orbit: &PeriodicOrbit, law: &Law, hulls: &[[[f64; 2]; 2]]) -> bool {
    orbit.impacts.iter().zip(hulls.iter().cycle()).all(|(impact, hull)| {
        mirrored(impact, law).is_some_and(|[phase, speed]| {
            let turned = (phase.mid() - 0.5 * (hull[0][0] + hull[0][1])).round(); // A8: whole forcing periods
            is_within(phase - Ball::exact(turned), hull[0]) && is_within(speed, hull[1])
        })
    })
}

/// Whether all members are between two bounds.
fn is_within(x: Ball, [low, high]: [f64; 2]) -> bool {
    let [least, most] = ends(x);
    low <= least && most <= high
}

/// Bounds of the greatest modulus of two eigenvalues, real and imaginary part of each, for one period of the reduced map. The eigenvalues belong
/// to `rounds` such periods: 1 or 2. Lemma A8
pub(super) fn spectral_radius(eigenvalues: [[&Enclosure; 2]; 2], rounds: usize) -> Option<Enclosure> {
    let square = |x: &Enclosure| x.powi(2, BITS);
    let modulus = |[re, im]: [&Enclosure; 2]| Some(square(re)?.add(&square(im)?, BITS));
    let [one, other] = eigenvalues.map(modulus);
    let (one, other) = (one?, other?);
    // A8: the greater of both is between the greater ends
    let radius = Enclosure::new(one.inf().max(other.inf()).clone(), one.sup().max(other.sup()).clone())?.sqrt(BITS)?;
    if rounds == 2 { radius.sqrt(BITS) } else { Some(radius) }
}

/// Whether the motions that stay in a component are proved to be at the state that grazes for ever. Lemma A9
pub(super) fn is_grazing(space: &Space, component: &Component) -> bool {
    let (columns, rows) = (component.grid.columns as f64, component.grid.rows); // exact: a power of two
    let angle = std::f64::consts::TAU / columns * (1.0 + 1e-15);
    let is_near = |&(column, row): &(i32, i32)| {
        let away = (f64::from(column) - 0.25 * columns).abs().max((f64::from(column + 1) - 0.25 * columns).abs()); // A9: the farther edge
        away * angle <= MAX_GRAZING_DISTANCE && f64::from(row + 1) / rows <= MAX_GRAZING_DISTANCE
    };
    if component.has_release || component.cells.is_empty() || !component.cells.iter().all(is_near) {
        return false; // exact: not proved
    }
    if ends(space.law().gap)[1] < 2.0 {
        return false; // A9: there is no such motion
    }
    let columns = component.columns();
    !component.cells.iter().any(|&cell| {
        let mut crosses = false;
        _ = space.images(component.grid, cell, &columns, &mut |next| {
            if let Next::Impact { cell, is_far: true, .. } = next {
                crosses |= component.cells.binary_search(&cell).is_ok();
            }
        });
        crosses
    })
}
