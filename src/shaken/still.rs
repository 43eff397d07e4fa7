//! Motions without drift that never hit a wall again, proved from the exact data.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_traits::ToPrimitive;

use super::{Location, Origin};
use crate::exact::{Exact, ExactError};
use crate::number::interval::Interval;
use crate::number::{Ball, is_positive};
use crate::pair::{Reduced, Wall};
use crate::several::Spectrum;
use crate::units::{turn, wave};

/// A motion without drift that stays between the walls for ever.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Still {
    /// True if it touches the left wall, with zero velocity, at phase 1/4 of every forcing period.
    pub grazes_left: bool,
    /// True if it touches the right wall, likewise, at phase 3/4.
    pub grazes_right: bool,
}

impl Still {
    /// A motion that touches no wall.
    const UNTOUCHED: Self = Self { grazes_left: false, grazes_right: false };

    /// Whether the motion from an origin is proved to stay between the walls for ever, with one harmonic (Lemma Z4).
    ///
    /// With a drift a wall is reached in the end, so the drift has to be 0, exactly. This is decided if the box stands still, and where the
    /// expressions show it, as at quarter periods, where sine and cosine are rational.
    pub fn under_one(pair: &Reduced<Exact>, origin: &Origin<Exact>) -> Result<Option<Self>, ExactError> {
        let is_zero = |x: &Exact| x.sign() == Some(Ordering::Equal);
        let (height, on_wall) = match &origin.state.place {
            Location::Inside(height) => (height.clone(), false),
            Location::Wall(wall) => (Exact::from(i64::from(*wall == Wall::Right)), true),
        };
        if is_zero(&pair.beta) {
            return Ok((!on_wall && is_zero(&origin.state.velocity)).then_some(Self::UNTOUCHED));
        }
        // From a wall at any other phase there is a drift.
        let waves = if on_wall { quarter_turn(&origin.state.phase) } else { Some(wave(&origin.state.phase)?) };
        let Some((sin, cos)) = waves else { return Ok(None) };
        // After an impact on a wall nothing is left of the velocity, or there is no such drift.
        if on_wall && !is_zero(&origin.state.velocity) && !is_zero(&pair.restitution) {
            return Ok(None);
        }
        let velocity = if on_wall { Exact::from(0) } else { origin.state.velocity.clone() };
        let drift = velocity.checked_add(&pair.beta.checked_mul(&cos)?)?;
        if !is_zero(&drift) {
            return Ok(None);
        }
        // Lemma Z4: without excitation the ball does not leave its wall.
        if on_wall && pair.alpha.sign() != Some(Ordering::Greater) {
            return Ok(None);
        }
        // z = z0 + alpha sin th0 - alpha sin th; from a wall sin th0 is -1, 0 or 1, so that a wall touched at the start has no room, exactly.
        let one = Exact::from(1);
        let amplitude = |part: Exact| if is_zero(&part) { Ok(Exact::from(0)) } else { pair.alpha.checked_mul(&part) };
        let room_below = height.checked_sub(&amplitude(one.checked_sub(&sin)?)?)?.sign();
        let room_above = one.checked_sub(&height)?.checked_sub(&amplitude(one.checked_add(&sin)?)?)?.sign();
        let inside = |room: Option<Ordering>| matches!(room, Some(Ordering::Greater | Ordering::Equal));
        let [grazes_left, grazes_right] = [room_below, room_above].map(|room| room == Some(Ordering::Equal));
        Ok((inside(room_below) && inside(room_above)).then_some(Self { grazes_left, grazes_right }))
    }

    /// As [`under_one`](Self::under_one) with several harmonics; `band` bounds their sum at all times (Lemma H16).
    pub fn under_several(
        spectrum: &Spectrum,
        origin: &Origin<Exact>,
        band: impl FnOnce() -> Interval,
    ) -> Result<Option<Self>, ExactError> {
        let Location::Inside(height) = &origin.state.place else { return Ok(None) };
        let (mut drift, mut middle, mut amplitude) = (origin.state.velocity.clone(), height.clone(), Exact::from(0));
        for (term, phase) in spectrum.terms.iter().zip(&origin.phases) {
            let (sin, cos) = wave(phase)?;
            let beta = term.alpha.checked_mul(&term.ratio)?.checked_mul(&turn())?;
            drift = drift.checked_add(&beta.checked_mul(&cos)?)?;
            middle = middle.checked_add(&term.alpha.checked_mul(&sin)?)?;
            amplitude = amplitude.checked_add(&term.alpha)?;
        }
        if drift.sign() != Some(Ordering::Equal) {
            return Ok(None);
        }
        let is_above_0 = |x: &Exact| x.sign() == Some(Ordering::Greater);
        let (below, above) =
            (middle.checked_sub(&amplitude)?, Exact::from(1).checked_sub(&middle.checked_add(&amplitude)?)?);
        let is_inside = || {
            let heights = Interval::from(Ball::of(&middle)) - band();
            is_positive(heights.inf()) && is_positive((Interval::ONE - heights).inf())
        };
        Ok((is_above_0(&below) && is_above_0(&above) || is_inside()).then_some(Self::UNTOUCHED))
    }

    /// First graze after `phase`: its wall, whole forcing periods and phase.
    pub fn graze_after(self, turns: i64, phase: f64) -> Option<(Wall, i64, f64)> {
        let candidates = [(Wall::Left, 0.25, self.grazes_left), (Wall::Right, -0.25, self.grazes_right)];
        let next = candidates.into_iter().filter(|(.., grazes)| *grazes).map(|(wall, at, _)| {
            // Lemma N1: one forcing period at a time comes nowhere near the end of the count.
            (wall, if at > phase { turns } else { turns + 1 }, at)
        });
        next.min_by(|a, b| (a.1, a.2).partial_cmp(&(b.1, b.2)).expect("phases are numbers"))
    }
}

/// Sine and cosine of a phase that is exactly a number of quarter periods.
pub(super) fn quarter_turn(phase: &Exact) -> Option<(Exact, Exact)> {
    let quarters = phase.as_rational()? * BigInt::from(4);
    let quarter = quarters.is_integer().then(|| quarters.to_integer())?;
    let quarter = (quarter % BigInt::from(4)).to_i64()?.rem_euclid(4) as usize; // exact: 0 to 3
    let at = |shift: usize| Exact::from([0, 1, 0, -1][(quarter + shift) % 4]);
    Some((at(0), at(1)))
}
