//! Motions that never touch a wall again, proved from the exact data.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_traits::ToPrimitive;

use super::origin::{Location, Origin};
use crate::exact::{Exact, ExactError};
use crate::pair::Reduced;

/// Whether a start inside the gap is proved to stay there for ever (Lemma Z4).
///
/// Where there is a drift a wall is reached in the end, so the drift has to be 0, exactly: that is decided where the
/// box stands still, and at quarter turns, where sine and cosine are exact.
pub(super) fn never_impacts(pair: &Reduced<Exact>, origin: &Origin<Exact>) -> bool {
    let Location::Inside(height) = &origin.place else { return false };
    stays_inside(pair, height, origin).unwrap_or(false)
}

fn stays_inside(pair: &Reduced<Exact>, height: &Exact, origin: &Origin<Exact>) -> Result<bool, ExactError> {
    if pair.beta.sign() == Some(Ordering::Equal) {
        return Ok(origin.velocity.sign() == Some(Ordering::Equal));
    }
    let Some((sin, cos)) = quarter_turn(&origin.phase) else { return Ok(false) };
    let drift = origin.velocity.checked_add(&pair.beta.checked_mul(&cos)?)?;
    if drift.sign() != Some(Ordering::Equal) {
        return Ok(false);
    }
    // z = z0 + alpha sin th0 - alpha sin th
    let middle = height.checked_add(&pair.alpha.checked_mul(&sin)?)?;
    let room_below = middle.checked_sub(&pair.alpha)?;
    let room_above = Exact::from(1).checked_sub(&middle.checked_add(&pair.alpha)?)?;
    Ok([room_below, room_above].iter().all(|room| room.sign() == Some(Ordering::Greater)))
}

/// Sine and cosine of a phase that is exactly a number of quarter turns.
fn quarter_turn(phase: &Exact) -> Option<(Exact, Exact)> {
    let quarters = phase.as_rational()? * BigInt::from(4);
    let quarter = quarters.is_integer().then(|| quarters.to_integer())?;
    let quarter = (quarter % BigInt::from(4)).to_i64()?.rem_euclid(4) as usize;
    let at = |shift: usize| Exact::from([0, 1, 0, -1][(quarter + shift) % 4]);
    Some((at(0), at(1)))
}
