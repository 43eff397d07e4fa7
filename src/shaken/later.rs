//! A start inside the gap, a little later: Lemma R3 of `docs/proofs/reduction.md#R3`.

use std::cmp::Ordering;

use impact_pair_model::{Place, Start};

use crate::exact::{Exact, ExactError};
use crate::number::{is_positive, up};
use crate::pair::ImpactPair;

/// Bits of the bounds that the time is chosen by.
const BITS: u32 = 64;
/// Times that are tried, each half as long as the one before.
const TRIES: u32 = 6;

/// A later state of the motion, with a certain direction, if the direction is uncertain at the start inside the gap.
///
/// First contacts are searched for along pieces that rise or fall. The sign of a velocity that is an interval around 0, or 0 in disguise, is
/// unknown; soon after, the excitation decides how the ball moves.
pub(super) fn decided(pair: &ImpactPair, start: &Start) -> Option<Start> {
    let Place::Inside(position) = start.place() else { return None };
    if start.velocity().sign().is_some() {
        return None;
    }
    let longest = longest(pair, position, start.velocity()).ok()?;
    let times = (0..TRIES).map(|n| longest * 0.5f64.powi(n as i32)); // exact: powers of two
    times
        .filter_map(|time| later(pair, start, position, &Exact::from_f64(time)?))
        .find(|start| matches!(start.velocity().sign(), Some(Ordering::Less | Ordering::Greater)))
}

/// Time for which no wall is touched, proved: a power of two, or 0.
fn longest(pair: &ImpactPair, position: &Exact, velocity: &Exact) -> Result<f64, ExactError> {
    let half = pair.gap().checked_div(&Exact::from(2))?;
    let rooms = [half.checked_sub(position)?, half.checked_add(position)?];
    let room = rooms.map(|room| room.enclose(BITS).inf().to_f64_down());
    let size = |x: &Exact| x.enclose(BITS).mag().to_f64_up();
    let harmonics = pair.excitation().harmonics().iter();
    let speed =
        harmonics.map(|term| size(term.amplitude()) * size(term.frequency())).fold(0.0, |sum, x| up(sum + up(2.0 * x)));
    let least = room[0].min(room[1]); // R3: the nearer wall
    // R3: at most a quarter of the way there
    let most = (0.25 * least / up(speed + size(velocity))).min(0.125 / size(pair.excitation().reference().frequency()));
    Ok(if is_positive(most) && most.is_finite() { 2f64.powi(most.log2().floor() as i32) } else { 0.0 }) // R3: half of it at least
}

/// The state so much later, if no wall is touched. **Equations** (11), (12)
fn later(pair: &ImpactPair, start: &Start, position: &Exact, time: &Exact) -> Option<Start> {
    let end = start.time().checked_add(time).ok()?;
    let (shift0, speed0) = shaking(pair, start.time()).ok()?;
    let (shift1, speed1) = shaking(pair, &end).ok()?;
    let drift = start.velocity().checked_add(&speed0).ok()?;
    let shift = shift0.checked_sub(&shift1).ok()?;
    let travel = drift.checked_mul(time).and_then(|travel| travel.checked_add(&shift)).ok()?;
    Start::inside(pair, end, position.checked_add(&travel).ok()?, drift.checked_sub(&speed1).ok()?).ok()
}

/// `E` and `E'`. **Equation** (1)
fn shaking(pair: &ImpactPair, time: &Exact) -> Result<(Exact, Exact), ExactError> {
    pair.excitation().harmonics().iter().try_fold((Exact::from(0), Exact::from(0)), |(shift, speed), term| {
        let phase = term.frequency().checked_mul(time)?.checked_add(term.phase())?;
        let rate = term.amplitude().checked_mul(term.frequency())?;
        Ok((
            shift.checked_add(&term.amplitude().checked_mul(&phase.checked_sin()?)?)?,
            speed.checked_add(&rate.checked_mul(&phase.checked_cos()?)?)?,
        ))
    })
}
