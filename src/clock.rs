//! Exact conversion between the units of the scene and reduced units.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use crate::Error;
use crate::exact::{Dyadic, Enclosure, Exact};
use crate::number::Ball;
use crate::pair::{ImpactPair, ball, within};
use crate::turns;
use crate::units::{self, Phases, Units};

/// Bits kept beyond those of the largest number of forcing periods and of the widths to be shown.
const BITS: u32 = 160;

/// A phase as whole forcing periods and the rest in `[-1/2, 1/2]` (about).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Phase {
    pub turns: i64,
    pub rest: Ball,
}

/// Converts phases to times and reduced velocities to velocities, and back, by enclosures of the exact factors.
#[derive(Clone, Debug)]
pub struct Clock {
    phases: Phases,
    /// Whole forcing periods that phases are counted from.
    origin: BigInt,
    bits: u32,
    /// Maximum precision of printed values, in bits.
    shown: u32,
    /// Enclosures of `2 pi / W` and `tau / W`.
    period: Enclosure,
    delay: Enclosure,
    gaps: Units<Enclosure>,
    /// `2 pi / (W d)`
    slowness: Exact,
    /// Widths that intervals of W, tau and d add: to a time, in periods, for each forcing period since `t = -tau/W`, and once; to a
    /// velocity, as a fraction of it. `None` for exact data.
    spread: Option<[f64; 3]>,
}

impl Clock {
    /// The clock of `pair` whose forcing period 0 is the one nearest to `time`; it shows widths down to about `2^-shown`.
    pub(crate) fn new(pair: &ImpactPair, time: &Exact, shown: u32) -> Result<Self, Error> {
        let reference = pair.excitation().reference();
        let phases = Phases::of(reference)?;
        let period = units::period(reference)?;
        let delay =
            within("excitation.phase", reference.phase(), reference.phase().checked_div(reference.frequency()))?;
        let gaps = Units::gaps(pair)?;
        let slowness = within("pair.gap", pair.gap(), period.checked_div(pair.gap()))?;
        let start = within("start.time", time, phases.at(time))?;
        let origin = nearest(&start);
        let shown = BITS.saturating_add(shown); // X1: any number of bits encloses
        let bits = shown.saturating_add(u32::try_from(origin.bits()).unwrap_or(u32::MAX / 2)); // X1
        let (period, delay, gaps) = (period.enclose(bits), delay.enclose(bits), gaps.map(|x| x.enclose(shown)));
        let relative = |of: &Enclosure, to: &Enclosure| of.wid().to_f64_up() / to.mig().to_f64_down();
        Ok(Self {
            bits,
            shown,
            spread: (!pair.is_point()).then(|| {
                [relative(&period, &period), relative(&delay, &period), relative(&gaps.velocity, &gaps.velocity)]
            }),
            period,
            delay,
            gaps,
            slowness,
            phases,
            origin,
        })
    }

    /// Encloses `W / (2 pi)`, `tau / (2 pi)` less the whole forcing periods of the origin, and `2 pi / (W d)`, in `bits` bits.
    pub(crate) fn factors(&self, bits: u32) -> [Enclosure; 3] {
        let origin = Enclosure::from_rational(&BigRational::from(self.origin.clone()), bits);
        [
            self.phases.rate.enclose(bits),
            self.phases.shift.enclose(bits).sub(&origin, bits),
            self.slowness.enclose(bits),
        ]
    }

    /// Whole forcing periods from the start of a period of `period` forcing periods to the origin of phases.
    pub(crate) fn turns_into(&self, period: u32) -> i64 {
        self.origin.mod_floor(&BigInt::from(period)).to_i64().unwrap_or(0) // exact: below 2^32
    }

    /// Whole forcing periods that phases are counted from.
    pub(crate) fn origin(&self) -> &BigInt {
        &self.origin
    }

    /// The phase `(W t + tau) / (2 pi)` of a time, in whole forcing periods after the origin and the rest.
    pub(crate) fn split(&self, key: &'static str, time: &Exact) -> Result<(i64, Exact), Error> {
        let origin = Exact::from(self.origin.clone());
        let since = self.phases.at(time).and_then(|phase| phase.checked_sub(&origin));
        let since = within(key, time, since)?;
        let whole = nearest(&since);
        let turns = whole.to_i64().and_then(|whole| turns::later(0, whole)).ok_or_else(|| too_late(key, time))?;
        let rest = within(key, time, since.checked_sub(&Exact::from(turns)))?;
        Ok((turns, rest))
    }

    /// Phase of a time, with the rest in a ball.
    pub(crate) fn phase_of(&self, key: &'static str, time: &Exact) -> Result<Phase, Error> {
        let (turns, rest) = self.split(key, time)?;
        Ok(Phase { turns, rest: ball(key, &rest)? })
    }

    /// Upper bounds of the widths of a time, in periods, and of a velocity, in gap widths per forcing period.
    ///
    /// Roundings of exact factors are not counted: the factors have 160 bits more than requested.
    pub(crate) fn widths(&self, turns: i64, rest: Ball, velocity: Ball) -> (f64, f64) {
        let (time, of_velocity) = self.spread(turns, velocity);
        (2.0f64.mul_add(rest.rad(), time), 2.0f64.mul_add(velocity.rad(), of_velocity))
    }

    /// Widths of a time and a velocity from logarithms of radii, which may be below the range of doubles.
    pub(crate) fn log2_widths(&self, turns: i64, radii: (f64, f64), velocity: Ball) -> (f64, f64) {
        let (time, of_velocity) = self.spread(turns, velocity);
        let sum =
            |radius: f64, spread: f64| if spread > 0.0 { (2.0 * radius.exp2() + spread).log2() } else { 1.0 + radius };
        (sum(radii.0, time), sum(radii.1, of_velocity))
    }

    /// Widths that intervals of W, tau and d add to a time and to a velocity.
    fn spread(&self, turns: i64, velocity: Ball) -> (f64, f64) {
        let Some([per_turn, once, per_unit]) = self.spread else { return (0.0, 0.0) };
        let turns = Dyadic::new(&self.origin + turns, 0);
        let turns = turns.to_f64_up().abs().max(turns.to_f64_down().abs()) + 2.0; // shown: widths, not bounds
        (per_turn.mul_add(turns, once), per_unit * velocity.mag())
    }

    /// A velocity in gap widths per forcing period.
    pub(crate) fn reduced_velocity(&self, velocity: &Exact) -> Result<Exact, Error> {
        within("start.velocity", velocity, velocity.checked_mul(&self.slowness))
    }

    /// Encloses the time `t = (2 pi u - tau) / W` \[time\] of the phase of `turns` and the rest.
    pub fn time(&self, turns: i64, rest: &Enclosure) -> Enclosure {
        let whole = Enclosure::from_rational(&BigRational::from(&self.origin + turns), self.bits);
        whole.add(rest, self.bits).mul(&self.period, self.bits).sub(&self.delay, self.bits)
    }

    /// Encloses the time \[time\] of an exactly known phase; the time is exact where an exact expression holds it.
    pub fn time_of(&self, turns: i64, rest: f64) -> Enclosure {
        let exact = || {
            let phase = Exact::from(&self.origin + turns).checked_add(&Exact::from_f64(rest)?).ok()?;
            phase.checked_sub(&self.phases.shift).ok()?.checked_div(&self.phases.rate).ok()
        };
        match exact() {
            Some(time) => time.enclose(self.bits),
            None => self.time(turns, &enclosure(rest)),
        }
    }

    /// Encloses `t mod 2 pi/W` \[time\]: from `[0, 2 pi/W)` on, and beyond when the phase may be a whole number of forcing periods.
    pub fn time_in_period(&self, rest: &Enclosure) -> Enclosure {
        let turns = rest.sub(&self.phases.shift.enclose(self.shown), self.shown);
        let whole = Enclosure::from_rational(&turns.inf().to_rational().floor(), self.shown); // exact: a whole number
        turns.sub(&whole, self.shown).mul(&self.period, self.shown)
    }

    /// Encloses a time \[time\] given in forcing periods.
    pub(crate) fn duration(&self, turns: &Enclosure) -> Enclosure {
        turns.mul(&self.period, self.shown)
    }

    /// Encloses a length \[length\] given in gaps.
    pub fn length(&self, length: &Enclosure) -> Enclosure {
        length.mul(&self.gaps.length, self.shown)
    }

    /// Encloses a velocity \[length/time\] given in gap widths per forcing period.
    pub fn velocity(&self, velocity: &Enclosure) -> Enclosure {
        velocity.mul(&self.gaps.velocity, self.shown)
    }

    /// Encloses an acceleration \[length/time^2\] given in gap widths per forcing period squared.
    pub fn acceleration(&self, acceleration: &Enclosure) -> Enclosure {
        self.velocity(acceleration).mul(&self.phases.rate.enclose(self.shown), self.shown)
    }
}

/// A whole number nearest to the value, or next to the nearest.
fn nearest(value: &Exact) -> BigInt {
    let whole = value.enclose(BITS).mag().top().and_then(|top| u32::try_from(top).ok()).unwrap_or(0); // X1: any number of bits encloses
    let low = value.enclose(BITS.saturating_add(whole)).inf().to_rational(); // X1: any number of bits encloses
    (low + BigRational::new(1.into(), 2.into())).floor().to_integer() // exact: any whole number is taken off
}

/// Error about a time more than 2^62 forcing periods away. Lemma N1
fn too_late(key: &str, time: &Exact) -> Error {
    Error::range(key, time, "accepted are times less than 2^62 forcing periods from the start")
}

/// The number as an enclosure.
fn enclosure(x: f64) -> Enclosure {
    Enclosure::from_f64_bounds(x, x).expect("a finite number")
}
