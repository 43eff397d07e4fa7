//! Past a contact that may be a graze: both continuations at once, Lemma G1 of `docs/proofs/chatter.md#G1`.
//!
//! If no precision distinguishes a touch from a miss, the flight may go on as it is or, after an impact too slow to be
//! seen, with a velocity changed by as little. Either way it turns back, and a little later one box holds both.

use std::cmp::Ordering;

use super::isolate::{PhaseNumber, is_rising};
use crate::contact::Grazed;
use crate::contact::extrema::Target;
use crate::exact::{Dyadic, Enclosure};
use crate::flight::Flight;
use crate::number::{ABOVE_TWO_PI, Float, Magnitude, MpBall, Number};
use crate::pair::{Inward, Wall};

/// Greatest number of ways on from a touch that are tried, each half as long as the one before: the first is half of the piece.
const MOST_STEPS: u32 = 8;

/// A graze that was passed, and where to go on from.
#[derive(Debug)]
pub(crate) struct Passed {
    /// The wall that may have been touched.
    pub wall: Wall,
    /// Phase of the graze, in forcing periods counted on from that of the start.
    pub at: MpBall,
    /// Whole forcing periods to the phase to go on from, and this phase, exactly.
    pub turns: f64,
    pub phase: Float,
    /// Height above the left wall and velocity there, of both continuations.
    pub height: MpBall,
    pub velocity: MpBall,
    /// Distance by which the wall is missed at the extremum.
    pub distance: MpBall,
    /// Upper bound of the acceleration.
    pub acceleration: Magnitude,
}

impl Passed {
    /// The passed graze in doubles; `None` where the doubles overflow.
    pub fn in_doubles(&self) -> Option<Grazed> {
        let whole = self.at.mid().to_f64().round(); // exact: any whole number is taken off
        let at = self.at.clone() - MpBall::from_f64(whole);
        // G1: the wall may be touched, so that 0 is a distance to allow for
        let distance = self.distance.enclosure()?.hull(&Enclosure::point(Dyadic::zero()));
        let acceleration = self.acceleration.to_f64();
        let (farthest, _) = distance.to_f64_bounds();
        if !(farthest * acceleration).is_finite() {
            return None;
        }
        Some(Grazed {
            wall: self.wall,
            touch: (whole, at.to_ball(), at.enclosure()?),
            turns: self.turns,
            phase: MpBall::exact(self.phase.clone()).to_ball(),
            height: self.height.to_ball(),
            velocity: self.velocity.to_ball(),
            distance,
            acceleration,
        })
    }
}

/// Goes past the first extremum of the flights of a set that may touch its wall; `None` where that is not proved.
pub(crate) fn pass(flight: &Flight<MpBall>) -> Option<Passed> {
    let rising = is_rising(flight).ok()?;
    let turns_back = [flight.drift.clone().minus(&flight.beta), flight.drift.clone().plus(&flight.beta)];
    if turns_back.map(|x| x.sign()) != [Some(Ordering::Less), Some(Ordering::Greater)] {
        return None;
    }
    let turning = PhaseNumber::new(flight, rising)?;
    let (target, time, room) = turning.doubtful(flight)?;
    // Bounds of the height of the extremum beyond the wall, of the time that the flight may be there, and of its speed.
    let excess = room.mag();
    let double = excess + excess;
    let acceleration = flight.steepest();
    let sine = turning.sine.clone();
    let press = |window: Magnitude| {
        let turned = Magnitude::new(ABOVE_TWO_PI, 0) * (time.rad() + window);
        (flight.beta.turn() * flight.beta.clone() * sine.clone().widened(turned)).mig()
    };
    let window = double.over(press(Magnitude::ZERO)?).sqrt();
    let window = window + window;
    if double.over(press(window)?).sqrt() > window {
        return None;
    }
    let speed = (double * acceleration).sqrt();
    // The impact takes away the speed and adds at most as much.
    let change = speed + speed;
    let along = match target {
        Target::Far => &turning.near.span,
        Target::Near => &turning.far.span,
    };
    let mut step = along.mid().clone().scaled(-1);
    for _ in 0..MOST_STEPS {
        if let Some((turns, phase, height, velocity)) = go_on(flight, target, &time, &step, window, change) {
            let at = flight.phase.clone() + time.clone().widened(window);
            let left = |z: MpBall| match flight.wall {
                Wall::Left => z,
                Wall::Right => MpBall::from_f64(1.0) - z,
            };
            let (height, velocity) = (left(height), flight.wall.inward(velocity));
            let wall = target.wall(flight.wall);
            return Some(Passed { wall, at, turns, phase, height, velocity, distance: room, acceleration });
        }
        step = step.scaled(-1);
    }
    None
}

/// The box of both continuations `step` after the extremum, if both are on their way across the gap there.
fn go_on(
    flight: &Flight<MpBall>,
    target: Target,
    time: &MpBall,
    step: &Float,
    window: Magnitude,
    change: Magnitude,
) -> Option<(f64, Float, MpBall, MpBall)> {
    let bits = flight.drift.bits();
    let at = time.mid().plus(step, bits + 64).plus(flight.phase.mid(), bits + 64);
    let turns = at.to_f64().round(); // exact: any whole number is taken off
    let phase = at.minus(&Float::new(turns), bits);
    let point = MpBall::exact(phase.clone());
    let (sin, cos) = flight.wall.mirror(point.sin_cos());
    let since = MpBall::exact(step.clone()).mag() + time.rad() + time.rad() + window + window;
    let whole = MpBall::from_f64(turns);
    let height = flight.height_above(MpBall::from_f64(0.0), whole, point, sin).widened(change * since);
    let velocity = flight.velocity_at(cos).widened(change);
    let inside = [height.clone(), MpBall::from_f64(1.0) - height.clone()];
    let is_inside = inside.iter().all(|room| room.sign() == Some(Ordering::Greater));
    let leaves = velocity.clone().signed(-target.direction()).sign() == Some(Ordering::Greater);
    (is_inside && leaves).then_some((turns, phase, height, velocity))
}
