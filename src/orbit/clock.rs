//! Between the units of the scene and turns and gaps, exactly: what enters and leaves an orbit.

use num_bigint::BigInt;
use num_rational::BigRational;

use crate::error::Error;
use crate::exact::{Dyadic, Enclosure, Exact, ExactError};
use crate::number::Ball;
use crate::pair::{ImpactPair, ball, within};

/// Bits kept beyond those of the largest number of turns.
const BITS: u32 = 160;

/// A phase as whole turns and the rest in `[-1/2, 1/2]` (about).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Phase {
    pub turns: i64,
    pub rest: Ball,
}

/// Converts phases to times and reduced velocities to velocities, and back, by enclosures of the exact factors.
#[derive(Clone, Debug)]
pub struct Clock {
    /// `tau / (2 pi)` and `W / (2 pi)`
    shift: Exact,
    rate: Exact,
    /// The whole turns that phases are counted from.
    origin: BigInt,
    bits: u32,
    /// Enclosures of `2 pi / W`, `tau / W`, `W d / (2 pi)` and `d`.
    period: Enclosure,
    delay: Enclosure,
    speed: Enclosure,
    gap: Enclosure,
    /// `2 pi / (W d)`
    slowness: Exact,
    /// What intervals of W, tau and d add to widths: to a time for each turn since `t = -tau/W` and once, in periods;
    /// to a velocity for each unit of it.
    spread: [f64; 3],
}

impl Clock {
    /// The clock of `pair` whose turn 0 is the one nearest to `time`.
    pub(super) fn new(pair: &ImpactPair, time: &Exact) -> Result<Self, Error> {
        let turn = Exact::pi() * Exact::from(2);
        let (frequency, delay) = (pair.excitation().frequency(), pair.excitation().phase());
        let shift = within("excitation.phase", delay, delay.checked_div(&turn))?;
        let rate = within("excitation.frequency", frequency, frequency.checked_div(&turn))?;
        let period = within("excitation.frequency", frequency, turn.checked_div(frequency))?;
        let delay = within("excitation.phase", delay, delay.checked_div(frequency))?;
        let speed = within("pair.gap", pair.gap(), rate.checked_mul(pair.gap()))?;
        let slowness = within("pair.gap", pair.gap(), period.checked_div(pair.gap()))?;
        let start = within("start.time", time, phase(&rate, &shift, time))?;
        let origin = nearest(&start);
        let bits = BITS + u32::try_from(origin.bits()).unwrap_or(u32::MAX / 2);
        let (period, delay, speed) = (period.enclose(bits), delay.enclose(bits), speed.enclose(BITS));
        let relative = |of: &Enclosure, to: &Enclosure| of.width().to_f64_up() / to.mig().to_f64_down();
        Ok(Self {
            bits,
            spread: [relative(&period, &period), relative(&delay, &period), relative(&speed, &speed)],
            period,
            delay,
            speed,
            gap: pair.gap().enclose(BITS),
            slowness,
            shift,
            rate,
            origin,
        })
    }

    /// The phase `(W t + tau) / (2 pi)` of a time, in turns after the origin.
    pub(super) fn phase_of(&self, key: &'static str, time: &Exact) -> Result<Phase, Error> {
        let origin = Exact::from(self.origin.clone());
        let since = phase(&self.rate, &self.shift, time).and_then(|phase| phase.checked_sub(&origin));
        let since = within(key, time, since)?;
        let whole = nearest(&since);
        let turns = i64::try_from(&whole).map_err(|_| Error::too_large(key, time))?;
        let rest = within(key, time, since.checked_sub(&Exact::from(turns)))?;
        Ok(Phase { turns, rest: ball(key, &rest)? })
    }

    /// Bounds how wide the bounds of a time are, in periods, and those of a velocity, in gaps a turn.
    pub(super) fn widths(&self, turns: i64, rest: Ball, velocity: Ball) -> (f64, f64) {
        let [per_turn, once, per_unit] = self.spread;
        let mut time = 2.0 * rest.rad() + once;
        // Points add 2^-160 of themselves: not worth the conversion of the turns.
        if per_turn > 1e-40 {
            let turns = Dyadic::new(&self.origin + turns, 0);
            time += per_turn * (turns.to_f64_up().abs().max(turns.to_f64_down().abs()) + 2.0);
        }
        (time, per_unit.mul_add(velocity.mag(), 2.0 * velocity.rad()))
    }

    /// A velocity in gaps a turn.
    pub(super) fn reduced_velocity(&self, velocity: &Exact) -> Result<Ball, Error> {
        let key = "start.velocity";
        let reduced = within(key, velocity, velocity.checked_mul(&self.slowness))?;
        ball(key, &reduced).map_err(|_| Error::too_large(key, velocity))
    }

    /// Encloses the time `t = (2 pi u - tau) / W` \[time\] of the phase of `turns` and the rest.
    pub fn time(&self, turns: i64, rest: Ball) -> Enclosure {
        let whole = Enclosure::from_rational(&BigRational::from(&self.origin + turns), self.bits);
        whole.add(&enclosure(rest), self.bits).mul(&self.period, self.bits).sub(&self.delay, self.bits)
    }

    /// Encloses `t mod 2 pi/W` \[time\]: from `[0, 2 pi/W)` on, and beyond when the phase may be a whole number of turns.
    pub fn time_in_period(&self, rest: Ball) -> Enclosure {
        let turns = enclosure(rest).sub(&self.shift.enclose(BITS), BITS);
        let whole = Enclosure::from_rational(&turns.lo().to_rational().floor(), BITS);
        turns.sub(&whole, BITS).mul(&self.period, BITS)
    }

    /// Encloses a length \[length\] given in gaps.
    pub fn length(&self, length: Ball) -> Enclosure {
        enclosure(length).mul(&self.gap, BITS)
    }

    /// Encloses a velocity \[length/time\] given in gaps a turn.
    pub fn velocity(&self, velocity: Ball) -> Enclosure {
        enclosure(velocity).mul(&self.speed, BITS)
    }
}

/// `rate * time + shift`
fn phase(rate: &Exact, shift: &Exact, time: &Exact) -> Result<Exact, ExactError> {
    rate.checked_mul(time)?.checked_add(shift)
}

/// A whole number nearest to the value, or next to it.
fn nearest(value: &Exact) -> BigInt {
    let low = value.enclose(BITS).lo().to_rational();
    (low + BigRational::new(1.into(), 2.into())).floor().to_integer()
}

/// The ball as an interval whose ends are exact.
fn enclosure(ball: Ball) -> Enclosure {
    let point = |x: f64| Enclosure::from_f64_bounds(x, x).expect("certified balls are finite");
    let (mid, rad) = (point(ball.mid()), point(ball.rad()));
    mid.sub(&rad, BITS).hull(&mid.add(&rad, BITS))
}
