//! Times at which the contact force is exactly 0 and does not change its sign: Lemma H15 of `docs/proofs/harmonics.md#H15`.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::spectrum::Spectrum;
use crate::exact::{Exact, ExactError};
use crate::number::is_positive;
use crate::pair::Wall;
use crate::units::{turn, wave};

/// Parts of a period of the fastest harmonic at whose ends a touch is looked for: sine and cosine are known as roots there.
const PARTS: f64 = 24.0;
/// Far more than the rounding of a phase within 2 of 0.
const ROUNDING: f64 = 1.0 / (1_u64 << 48) as f64; // exact: a power of two

/// Phase up to which the contact force is not negative from `phase` on, less the same `turns`, where the force touches 0 near by. Lemma H15
pub(super) fn past_touch(spectrum: &Spectrum, wall: Wall, turns: i64, phase: f64) -> Option<f64> {
    let parts = (PARTS * phase).round(); // proposes: the touch is proved
    let near = Exact::from_rational(BigRational::new(BigInt::from(parts as i64), BigInt::from(PARTS as i64))); // exact: whole numbers
    let at = near.checked_add(&Exact::from(turns)).ok()?;
    let phases = spectrum.terms.iter().map(|term| term.ratio.checked_mul(&at)?.checked_add(&term.shift));
    let phases: Vec<Exact> = phases.collect::<Result<_, _>>().ok()?;
    let reach = touch(spectrum, wall, &phases).ok().flatten()?;
    let middle = parts / PARTS;
    let end = middle + 0.5 * reach;
    let is_near = (phase - middle).abs() < 0.5 * reach && is_positive(0.25 * reach - ROUNDING);
    (is_near && is_positive(end - phase)).then_some(end)
}

/// Whether the contact force is exactly 0 where the harmonics have these phases, and positive before and after. Lemma H15
pub(crate) fn is_touch(spectrum: &Spectrum, wall: Wall, phases: &[Exact]) -> bool {
    touch(spectrum, wall, phases).is_ok_and(|reach| reach.is_some())
}

/// Forcing periods before and after a touch of the contact force for which the force is positive; `None` where these phases are not proved to be
/// a touch. Lemma H15
fn touch(spectrum: &Spectrum, wall: Wall, phases: &[Exact]) -> Result<Option<f64>, ExactError> {
    let zero = Exact::from(0);
    // The force and its first and second derivatives, each up to a positive factor, and a bound of the third.
    let (mut force, mut slope, mut bend, mut change) = (zero.clone(), zero.clone(), zero.clone(), zero);
    for (term, phase) in spectrum.terms.iter().zip(phases) {
        let (sin, cos) = wave(phase)?;
        let rate = turn().checked_mul(&term.ratio)?;
        let square = term.alpha.checked_mul(&rate)?.checked_mul(&rate)?;
        let [third, fourth] = [square.checked_mul(&rate)?, square.checked_mul(&rate)?.checked_mul(&rate)?];
        force = force.checked_add(&square.checked_mul(&sin)?)?;
        slope = slope.checked_add(&third.checked_mul(&cos)?)?;
        bend = bend.checked_add(&fourth.checked_mul(&sin)?)?;
        change = change.checked_add(&fourth.checked_mul(&rate)?)?;
    }
    if [force, slope].iter().any(|x| x.sign() != Some(Ordering::Equal)) {
        return Ok(None);
    }
    let bend = if wall == Wall::Left { bend } else { bend.checked_neg()? };
    let (least, most) = (bend.enclose(64).inf().to_f64_down(), change.enclose(64).mag().to_f64_up());
    let reach = (3.0 * least / most).next_down().next_down();
    Ok((is_positive(least) && is_positive(reach)).then_some(reach))
}
