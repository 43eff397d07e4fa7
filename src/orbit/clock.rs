//! Between the units of the scene and turns and gaps, exactly: what enters and leaves an orbit.

use num_bigint::BigInt;
use num_rational::BigRational;

use crate::error::Error;
use crate::exact::{Enclosure, Exact};
use crate::number::Ball;
use crate::pair::{ImpactPair, ball};

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
    /// Enclosures of `2 pi / W`, `tau / W` and `W d / (2 pi)`.
    period: Enclosure,
    delay: Enclosure,
    speed: Enclosure,
    /// `2 pi / (W d)`
    slowness: Exact,
}

impl Clock {
    /// The clock of `pair` whose turn 0 is the one nearest to `time`.
    pub(super) fn new(pair: &ImpactPair, time: &Exact) -> Result<Self, Error> {
        let turn = Exact::pi() * Exact::from(2);
        let frequency = pair.excitation().frequency();
        let divided = |a: &Exact, b: &Exact| {
            a.checked_div(b).map_err(|_| Error::unprovable("excitation.frequency or pair.gap", b))
        };
        let shift = divided(pair.excitation().phase(), &turn)?;
        let rate = divided(frequency, &turn)?;
        let period = divided(&turn, frequency)?;
        let start = rate.clone() * time.clone() + shift.clone();
        let half = Exact::from_rational(BigRational::new(1.into(), 2.into()));
        let origin = (start + half).enclose(BITS).lo().to_rational().floor().to_integer();
        let bits = BITS + u32::try_from(origin.bits()).unwrap_or(u32::MAX / 2);
        Ok(Self {
            bits,
            period: period.enclose(bits),
            delay: divided(pair.excitation().phase(), frequency)?.enclose(bits),
            speed: (rate.clone() * pair.gap().clone()).enclose(BITS),
            slowness: divided(&period, pair.gap())?,
            shift,
            rate,
            origin,
        })
    }

    /// The phase `(W t + tau) / (2 pi)` of a time, in turns after the origin.
    pub(super) fn phase_of(&self, key: &'static str, time: &Exact) -> Result<Phase, Error> {
        let origin = Exact::from_rational(BigRational::from(self.origin.clone()));
        let phase = self.rate.clone() * time.clone() + self.shift.clone() - origin;
        let half = Exact::from_rational(BigRational::new(1.into(), 2.into()));
        let whole = (phase.clone() + half).enclose(BITS).lo().to_rational().floor().to_integer();
        let turns = i64::try_from(&whole).map_err(|_| Error::too_large(key, time))?;
        let rest = ball(key, &(phase - Exact::from(turns)))?;
        Ok(Phase { turns, rest })
    }

    /// A velocity in gaps a turn.
    pub(super) fn reduced_velocity(&self, velocity: &Exact) -> Result<Ball, Error> {
        let key = "start.velocity";
        ball(key, &(velocity.clone() * self.slowness.clone())).map_err(|_| Error::too_large(key, velocity))
    }

    /// Encloses the time `t = (2 pi u - tau) / W` [time] of the phase of `turns` and the rest.
    pub fn time(&self, turns: i64, rest: Ball) -> Enclosure {
        let whole = Enclosure::from_rational(&BigRational::from(&self.origin + turns), self.bits);
        whole.add(&enclosure(rest), self.bits).mul(&self.period, self.bits).sub(&self.delay, self.bits)
    }

    /// Encloses a velocity [length/time] given in gaps a turn.
    pub fn velocity(&self, velocity: Ball) -> Enclosure {
        enclosure(velocity).mul(&self.speed, BITS)
    }
}

/// The ball as an interval whose ends are exact.
fn enclosure(ball: Ball) -> Enclosure {
    let point = |x: f64| Enclosure::from_f64_bounds(x, x).expect("certified balls are finite");
    let (mid, rad) = (point(ball.mid()), point(ball.rad()));
    mid.sub(&rad, BITS).hull(&mid.add(&rad, BITS))
}
