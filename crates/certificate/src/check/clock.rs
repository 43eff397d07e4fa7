//! Conversion between radians since an origin and times of the scene, and comparison of found sets with claimed bounds.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::affine::Affine;
use super::data::Data;
use impact_pair_exact::{Dyadic, Exact, Real, compare_rational};

/// Times `t = base + s / W` of the phases `s` since an origin.
#[derive(Clone, Debug)]
pub(crate) struct Clock {
    /// The time of the origin; its bits also hold the whole forcing periods before the origin.
    base: Real,
    slowness: Real,
    frequency: Real,
}

/// The position of a set relative to the bounds claimed for it.
pub(super) enum SetPosition {
    Inside,
    Outside,
    Across,
}

impl Clock {
    /// The clock of phases counted from the start; `phase` encloses the start's phase.
    pub fn at_start(data: &Data, phase: &Affine, bits: u32) -> Self {
        let bits = with_turns(data, bits);
        let exact = [&data.time, &data.frequency, &data.delay].into_iter().all(Exact::is_point);
        let base = if exact {
            Real::of(&data.time, bits)
        } else {
            let turns = Real::rational(&data.turns.clone().into(), bits) * &Real::pi(bits);
            let phase = turns.clone() + &turns + &phase.centre - &Real::of(&data.delay, bits);
            phase.over(&Real::of(&data.frequency, bits)).expect("the frequency is positive")
        };
        Self::new(data, base, bits)
    }

    /// The clock of phases counted from `quarters` quarter periods; `None` beyond the range of exact expressions.
    pub fn at_quarter_turns(data: &Data, quarters: &BigInt, bits: u32) -> Option<Self> {
        // X1: any number of bits encloses
        let bits = with_turns(data, bits).saturating_add(u32::try_from(quarters.bits()).ok()?);
        let halves = Exact::from_rational(BigRational::new(quarters.clone(), 2.into()));
        let phase = halves.checked_mul(&Exact::pi()).ok()?;
        let time = phase.checked_sub(&data.delay).ok()?.checked_div(&data.frequency).ok()?;
        Some(Self::new(data, Real::of(&time, bits), bits))
    }

    fn new(data: &Data, base: Real, bits: u32) -> Self {
        let slowness = Exact::from(1).checked_div(&data.frequency).expect("the frequency is positive");
        Self { base, slowness: Real::of(&slowness, bits), frequency: Real::of(&data.frequency, bits) }
    }

    /// Encloses the time of a phase.
    pub fn time(&self, phase: &Real) -> Real {
        self.base.clone() + &(phase.clone() * &self.slowness)
    }

    /// Encloses a velocity in lengths per time.
    pub fn velocity(&self, velocity: &Real) -> Real {
        velocity.clone() * &self.frequency
    }

    /// Encloses a velocity in lengths per radian, from lengths per time.
    pub fn slowed(&self, velocity: &Real) -> Real {
        velocity.clone() * &self.slowness
    }

    /// Encloses the phase that passes in a time.
    pub fn radians(&self, lasting: &Real) -> Real {
        lasting.clone() * &self.frequency
    }

    /// Upper bound of the distance between a time and the middle of the bounds claimed for it \[rad\].
    pub fn off(&self, time: &Real, [lower, upper]: &[BigRational; 2]) -> Dyadic {
        let middle = Real::rational(&((lower + upper) / BigInt::from(2)), self.bits());
        self.radians(&(time.clone() - &middle)).enclosure().mag()
    }

    /// Bits of the times: they also hold the whole forcing periods before the origin.
    pub fn bits(&self) -> u32 {
        self.base.bits()
    }

    /// Encloses the phase of a time.
    pub fn phase_at(&self, time: &Real) -> Real {
        (time.clone() - &self.base) * &self.frequency
    }

    /// Encloses the phase of a claimed time.
    pub fn phase(&self, time: &BigRational) -> Real {
        self.phase_at(&Real::rational(time, self.bits()))
    }
}

/// Bits that also hold the whole forcing periods before the start.
fn with_turns(data: &Data, bits: u32) -> u32 {
    let time = data.time.enclose(64).mag().top().unwrap_or(0).max(0); // X1: any number of bits encloses
    let turns = u32::try_from(data.turns.bits()).unwrap_or(u32::MAX / 4); // X1
    bits.saturating_add(turns.max(u32::try_from(time).unwrap_or(0))) // X1
}

/// Position of `found` relative to the claimed bounds.
pub(super) fn beside(found: &Real, [lower, upper]: &[BigRational; 2]) -> SetPosition {
    let (lo, hi) = (found.enclosure().inf(), found.enclosure().sup());
    if compare_rational(lo, lower).is_ge() && compare_rational(hi, upper).is_le() {
        SetPosition::Inside
    } else if compare_rational(hi, lower) == Ordering::Less || compare_rational(lo, upper) == Ordering::Greater {
        SetPosition::Outside
    } else {
        SetPosition::Across
    }
}
