//! Past a contact that may be a graze, under several harmonics: Lemma H13 of `docs/proofs/harmonics.md#H13`.

use super::flight::{Instant, SumFlight};
use super::harmonics::{Harmonics, Rates};
use super::phased::FlightNumber;
use super::reach::{Band, Reach};
use super::scan::{Doubt, Scan};
use super::view::Side;
use crate::contact::multiprecision::Passed;
use crate::flight::Launch;
use crate::number::{Ball, Float, Magnitude, MpBall, Number, is_positive};
use crate::pair::Wall;

/// Greatest number of steps past a touch that are tried, each half of the one before; the first is half of the step that `z'''` allows.
const MOST_STEPS: u32 = 8;

/// Goes past the first extremum of the flights of a set that may touch its wall; `None` where that is not proved.
pub(crate) fn pass(
    harmonics: &Harmonics<MpBall>,
    (band, balls): (&Band, &Harmonics<Ball>),
    launch: Launch<MpBall>,
) -> Option<Passed> {
    let all = SumFlight::new(harmonics, launch.clone(), None);
    let centre = SumFlight::new(harmonics, launch.map(FlightNumber::centre_of), None);
    let scan = Scan::new(&all, &centre);
    let Err(Doubt::Graze { wall, free, at }) = scan.first(&mut Reach::new(band, balls)) else { return None };
    let bottom = scan.bottom(at);
    let rates = &harmonics.rates;
    let state = all.state(&bottom);
    let side = state.side(wall);
    let touch = Touch::new(state.room(wall).clone(), &side, rates, [&free, &bottom])?;
    let mut step = 0.25 * side.bend.0 / rates.third;
    for _ in 0..MOST_STEPS {
        if let Some(passed) = touch.go_on(&all, wall, &bottom, &side, step) {
            return Some(passed);
        }
        step *= 0.5;
    }
    None
}

/// A possible touch: bounds of its duration, and of the change of velocity by its impact.
struct Touch {
    window: Magnitude,
    /// of the velocity
    change: Magnitude,
    /// Distance by which the wall is missed at the extremum.
    distance: MpBall,
}

impl Touch {
    /// Touch of a flight that meets no wall before the time `free` and is convex from there to its bottom, `room` from the wall.
    fn new(room: MpBall, side: &Side, rates: &Rates, [free, bottom]: [&Instant<MpBall>; 2]) -> Option<Self> {
        let bend = side.least_bend(rates, bottom.since(free));
        // Lemma H13: `b >= f`, for the bounds of both, and convex between them.
        if free.since(bottom) > 0.0 || !is_positive(bend) {
            return None;
        }
        let bound = |x: f64| Magnitude::new(x, 0);
        let rate = bound(side.rate.0.abs().max(side.rate.1.abs())); // B2: the farther end
        // The lowest height, and when: the bottom is not exactly where the velocity vanishes.
        let lower = (rate * rate).over(bound(bend));
        let excess = room.mag() + lower;
        let double = excess + excess;
        let window = double.over(bound(bend)).sqrt() + rate.over(bound(bend));
        let speed = (double * bound(rates.second)).sqrt();
        // The impact takes away the speed and adds at most as much.
        // H13: the extremum is lower by at most that
        Some(Self { window: window + window, change: speed + speed, distance: room.widened(lower) })
    }

    /// The box of both continuations `step` after the bottom, if both are on their way across the gap there.
    fn go_on(
        &self,
        all: &SumFlight<'_, MpBall>,
        wall: Wall,
        bottom: &Instant<MpBall>,
        side: &Side,
        step: f64,
    ) -> Option<Passed> {
        let rates = &all.harmonics.rates;
        if !is_positive(side.least_bend(rates, step)) || Magnitude::new(step, 0) < self.window {
            return None;
        }
        let bits = all.launch.phase.bits();
        let at = bottom.later(&bottom.rest.like(step));
        let state = all.state(&at);
        let start = &all.launch.phase;
        let sum = start.clone() + at.rest.clone();
        let phase = sum.mid().rounded(bits);
        // The time from the start of each flight to that phase differs from `at` by so much.
        let apart = start.rad() + (MpBall::exact(phase.clone()) - sum).mag();
        let second = Magnitude::new(rates.second, 0);
        let since = Magnitude::new(step, 0) + self.window + self.window;
        let velocity = state.velocity.widened(self.change + second * apart);
        let height = state.left.widened(self.change * since + velocity.mag() * apart);
        let room = |x: &MpBall| x.bounds().0 > 0.0;
        let is_inside = room(&height) && room(&(MpBall::from_f64_bits(1.0, bits) - height.clone()));
        if !(is_inside && room(&velocity.clone().signed(wall.sign()))) {
            return None;
        }
        let whole = phase.round().to_f64(); // exact: within a few forcing periods
        let touched = start.clone() + bottom.time().widened(self.window);
        // N1: below 2^52
        let turns = at.turns as f64 + whole;
        let (distance, acceleration) = (self.distance.clone(), second);
        Some(Passed {
            wall,
            at: touched,
            turns,
            phase: phase.minus(&Float::new(whole), bits),
            height,
            velocity,
            distance,
            acceleration,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lemma H13 needs `b >= f` and `a_0 > S_3 (b - f)`: the flight is convex from the free time on to its bottom.
    #[test]
    fn a_touch_needs_a_bottom_that_is_not_before_what_is_free() {
        let rates = Rates { shift: 1.0, second: 40.0, third: 250.0, fourth: 1600.0 };
        let side = Side { room: (1e-20, 1e-20), rate: (-1e-15, 1e-15), bend: (30.0, 30.0) };
        let number = |x: f64| MpBall::from_f64_bits(x, 200);
        let touch = |free: f64, bottom: f64| {
            let [free, bottom] = [free, bottom].map(|time| Instant::new(time, &number(0.0)));
            Touch::new(number(1e-20), &side, &rates, [&free, &bottom]).is_some()
        };
        assert!(touch(4.0, 4.1) && touch(4.0, 4.0 + 1e-15));
        // 250 (b - f) is 27.5, and 32.5.
        assert!(touch(4.0, 4.11) && !touch(4.0, 4.13));
        assert!(!touch(4.1, 4.0) && !touch(4.0, 4.0 - f64::EPSILON * 4.0) && !touch(5.0, 4.0));
    }
}
