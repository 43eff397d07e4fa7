//! Chatter that ends in rest, and release, under several harmonics: Lemmas H7 and H8 of `docs/proofs.md`.
//!
//! Told from the wall, `p = -z''` is the pressure. With bounds of `p'` and `p''` at all times the lemmas Z1 and Z2 need
//! no closed form: chatter is proved to end where the pressure hardly changes meanwhile, and the ball is released at
//! the first proved change of the pressure's sign.

use std::sync::Arc;

use super::flight::Instant;
use super::harmonics::{Harmonics, Phased, magnitude};
use super::spectrum::Spectrum;
use crate::exact::Enclosure;
use crate::number::interval::between;
use crate::number::{Ball, UNIT, is_positive, up};
#[cfg(feature = "multiprecision")]
use crate::number::{Magnitude, MpBall, Number};
use crate::pair::Wall;
use crate::rest::duration;
use crate::turns;

/// How long, in turns, chatter can last that begins with a bounce at `phase` after `turns` whole ones with `velocity`,
/// that after the impact, both of a whole set; as [`crate::rest::accumulation`] for one harmonic.
pub(crate) fn accumulation(
    harmonics: &Harmonics<Ball>,
    restitution: Ball,
    wall: Wall,
    turns: i64,
    phase: Ball,
    velocity: Ball,
) -> Option<f64> {
    let (speed, rebound) = (velocity.mag(), restitution.mag());
    let (least, most) = pressure(harmonics, wall, turns, &phase).bounds();
    if !is_positive(least) {
        return None;
    }
    // H7: exactly at rest
    if speed == 0.0 {
        return Some(0.0);
    }
    // Twice what the pressure now would take.
    let window = up(up(4.0 * speed) / (least * (1.0 - rebound)).next_down());
    let rates = &harmonics.rates;
    let jerk = magnitude(&harmonics.jerk(turns, &phase));
    let change = up(rates.third.min(up(jerk + up(rates.fourth * window))) * window); // H7: the smaller of two bounds
    let (least, most) = ((least - change).next_down(), up(most + change));
    if !(is_positive(1.0 - rebound) && is_positive(least)) {
        return None;
    }
    duration(speed, rebound, between(least, most), window)
}

/// `-z''`, told from the wall.
fn pressure<N: Phased>(harmonics: &Harmonics<N>, wall: Wall, turns: i64, rest: &N) -> N {
    harmonics.sums(turns, rest).swing.signed(-wall.sign())
}

/// A simple zero of the pressure: the ball is released there.
#[derive(Clone, Debug)]
pub(crate) struct Zero {
    spectrum: Arc<Spectrum>,
    pub wall: Wall,
    pub turns: i64,
    /// Exactly one zero lies within `reach` of this phase, less the whole turns, and the pressure falls at least so fast.
    near: f64,
    reach: f64,
    least: f64,
    /// Bounds the change of that slope.
    fourth: f64,
}

/// Steps of the search at most.
const STEPS: u32 = 1 << 16;
/// Bits that are tried to tell a change of sign from a touch.
#[cfg(feature = "multiprecision")]
const BITS: [u32; 3] = [128, 512, 2048];

/// The first change of the pressure's sign after a phase at which the wall is pressed, or from which on it is; `None`
/// where none is proved.
pub(crate) fn release(
    spectrum: &Arc<Spectrum>,
    harmonics: &Harmonics<Ball>,
    wall: Wall,
    turns: i64,
    phase: f64,
) -> Option<Zero> {
    if let Some(zero) = first_zero(spectrum, harmonics, wall, turns, Ball::exact(phase)) {
        return Some(zero);
    }
    #[cfg(feature = "multiprecision")]
    for bits in BITS {
        let harmonics = Harmonics::<MpBall>::new(spectrum, bits);
        if let Some(zero) = first_zero(spectrum, &harmonics, wall, turns, MpBall::from_f64_bits(phase, bits)) {
            return Some(zero);
        }
    }
    None
}

/// The same in one arithmetic: steps on which `p + p' s - S s^2/2` stays positive, `S` a bound of `|p''|`.
fn first_zero<N: Phased>(
    spectrum: &Arc<Spectrum>,
    harmonics: &Harmonics<N>,
    wall: Wall,
    turns: i64,
    phase: N,
) -> Option<Zero> {
    let fourth = harmonics.rates.fourth;
    let slope = |at: &Instant<N>| harmonics.jerk(turns + at.turns, &at.rest).signed(-wall.sign()).bounds();
    let value = |at: &Instant<N>| pressure(harmonics, wall, turns + at.turns, &at.rest);
    let mut at = Instant { turns: 0, rest: phase };
    // The pressure that begins here is growing for so long.
    let (low, _) = slope(&at);
    if value(&at).bounds().0 <= 0.0 && low > 0.0 {
        at = at.later(&at.rest.like(low / fourth));
    }
    for _ in 0..STEPS {
        let ((p, _), (low, high)) = (value(&at).bounds(), slope(&at));
        if !is_positive(p) {
            return None;
        }
        let ahead = p / -low;
        // Falling all the way to a zero a little farther than Newton's step: it is the first.
        if low < 0.0 && high + 2.0 * up(fourth * ahead) < 0.0 {
            let zero = bracket(harmonics, &value, &slope, at.later(&at.rest.like(ahead)))?;
            let (wall, from) = (wall, at.clone());
            let (instant, reach, least) = zero;
            let time = up(instant.since(&from) + reach);
            // Lemma H8 looks ahead only.
            if from.since(&instant) < reach && high + up(fourth * time) < 0.0 {
                let near = instant.rest.bounds();
                let middle = 0.5 * (near.0 + near.1);
                let reach = up(reach + (near.1 - near.0) + UNIT * middle.abs());
                let turns = turns::later(turns, instant.turns)?;
                // Lemma H8: within `reach` of the rounded place, which is within as much of the zero.
                let least = Some((least - up(2.0 * fourth * reach)).next_down()).filter(|least| is_positive(*least))?;
                let spectrum = spectrum.clone();
                return Some(Zero { spectrum, wall, turns, near: middle, reach, least, fourth });
            }
        }
        let step = 0.98 * (low + (low * low + 2.0 * fourth * p).sqrt()) / fourth;
        let next = at.later(&at.rest.like(step));
        let time = next.since(&at);
        let size = p + time * (low.abs() + time * fourth);
        if !(is_positive(time) && is_positive(p + time * (low - 0.5 * fourth * time) - 16.0 * UNIT * size)) {
            return None;
        }
        at = next;
    }
    None
}

/// A zero near a time: the time, within how much of it the zero lies, and the least slope there.
fn bracket<N: Phased>(
    harmonics: &Harmonics<N>,
    value: &impl Fn(&Instant<N>) -> N,
    slope: &impl Fn(&Instant<N>) -> (f64, f64),
    near: Instant<N>,
) -> Option<(Instant<N>, f64, f64)> {
    let mut at = near;
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let p = value(&at);
        let (low, high) = p.bounds();
        let back = p.ratio_to(&at.rest.like(0.5 * (slope(&at).0 + slope(&at).1)))?;
        let size = back.bounds().0.abs();
        if (low <= 0.0 && high >= 0.0) || !is_positive(0.75 * before - size) {
            let error = low.abs().max(high.abs()); // B2: the farther end
            let steepness = -slope(&at).1;
            let widest = up(2.0 * error / steepness);
            let least = (steepness - up(harmonics.rates.fourth * widest)).next_down();
            let reach = up(error / least);
            return (least > 0.0 && reach <= widest).then_some((at, reach, least));
        }
        (at, before) = (at.later(&-back), size);
    }
    None
}

impl Zero {
    /// Encloses the phase of the release, less the whole turns, in doubles.
    pub fn phase(&self) -> Ball {
        Ball::new(self.near, self.reach)
    }

    /// Encloses it in as many bits.
    #[cfg(feature = "multiprecision")]
    pub fn refined(&self, bits: u32) -> MpBall {
        let near = MpBall::from_f64_bits(self.near, bits);
        let limit = MpBall::from_ball(self.phase());
        let mut at = near;
        let mut known = MpBall::from_ball(self.phase());
        // Newton doubles the bits, the last steps are at full precision.
        let mut level = 64;
        for _ in 0..STEPS {
            let harmonics = Harmonics::<MpBall>::new(&self.spectrum, level + 32);
            let p = pressure(&harmonics, self.wall, self.turns, &at);
            // The mean value theorem between here and the zero.
            let error = p.mag().over(Magnitude::new(self.least, 0));
            let here = MpBall::new(at.mid().clone(), error);
            if limit.contains(&at) && here.rad() < known.rad() {
                known = here;
            } else if level > bits {
                return known.rounded(bits + 32);
            }
            let slope = harmonics.jerk(self.turns, &at).signed(-self.wall.sign());
            match p.ratio_to(&slope) {
                Some(back) => at = at.later(&-back),
                None => return known.rounded(bits + 32),
            }
            level = if level > bits { level } else { (2 * level).min(bits + 1) }; // proposes: bits
        }
        known.rounded(bits + 32)
    }

    /// Encloses it as narrowly as `bits` bits allow in this build.
    pub fn enclosure(&self, bits: u32) -> Option<Enclosure> {
        #[cfg(feature = "multiprecision")]
        return self.refined(bits).enclosure();
        #[cfg(not(feature = "multiprecision"))]
        {
            let _ = bits;
            self.phase().enclosure()
        }
    }

    /// The whole turns of `later`, told as those of `self` are, if both are proved to be whole common periods apart (Lemma H9).
    pub fn turns_of_same(&self, later: &Self) -> Option<i64> {
        let period = i64::try_from(self.spectrum.period?).ok()?;
        let apart = later.near - self.near;
        // exact: -1, 0 or 1, as half a turn is told in two ways
        let whole = apart.round();
        let turns = later.turns + whole as i64; // N1: one turn more
        let between = (apart - whole).abs() + UNIT;
        let hull = up(between + self.reach + later.reach);
        let is_one = self.least - up(2.0 * self.fourth * hull) > 0.0;
        let overlap = between <= 2.0 * UNIT + self.reach + later.reach;
        (self.wall == later.wall && (turns - self.turns) % period == 0 && overlap && is_one).then_some(turns)
    }
}
