//! Whole forcing periods, counted without loss.
//!
//! A count is an integer below `2^62` in magnitude; sums beyond are refused: Lemma N1 of `docs/proofs/clamps.md#N1`.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use crate::exact::Enclosure;

/// Bound of the magnitudes of counts.
const COUNT_LIMIT: i64 = 1 << 62;
/// Longest flight that is followed, in forcing periods: forcing periods within a flight are exact as doubles.
pub(crate) const LONGEST_FLIGHT: f64 = (1_u64 << 52) as f64; // exact: a power of two

/// `turns + more`; `None` where the count ends.
pub(crate) fn later(turns: i64, more: i64) -> Option<i64> {
    turns.checked_add(more).filter(|count| (-COUNT_LIMIT < *count) && (*count < COUNT_LIMIT))
}

/// `turns + whole`, where `whole` is the whole number of forcing periods of a flight; `None` where the count ends.
#[inline]
pub(crate) fn after(turns: i64, whole: f64) -> Option<i64> {
    // Lemma N1: the cast is exact where the comparison holds, which fails on NaN, and then the sum does not wrap.
    let count = turns.wrapping_add(whole as i64);
    // N1: exact, a power of two
    (whole.abs() < COUNT_LIMIT as f64 && count.unsigned_abs() < COUNT_LIMIT as u64).then_some(count)
}

/// Forcing period of a phase, less whole common periods of `period` forcing periods: 0 with one harmonic.
pub fn in_period(turns: &Enclosure, period: u32) -> u32 {
    let turn = turns.inf().to_rational().floor().to_integer().mod_floor(&BigInt::from(period)); // exact: a whole number
    turn.to_u32().expect("less than the period")
}

/// The sum without a check, for a motion whose follower also takes it by [`after`]: a sum refused there ends the motion.
#[inline(always)]
pub(crate) fn counted(turns: i64, whole: f64) -> i64 {
    turns.wrapping_add(whole as i64) // N1: the other count ends first, and this one with it
}

/// Shifts a phase into `[-1/2, 1/2]`, exactly (Sterbenz), and moves the forcing period to the count.
#[inline(always)]
pub(crate) fn carry(turns: f64, phase: f64) -> (f64, f64) {
    if phase > 0.5 {
        (turns + 1.0, phase - 1.0)
    } else if phase < -0.5 {
        (turns - 1.0, phase + 1.0)
    } else {
        (turns, phase)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_count_ends_before_it_could_be_wrong() {
        let most = COUNT_LIMIT - 1;
        assert_eq!((later(most, 0), later(most, 1), later(-most, -1)), (Some(most), None, None));
        assert_eq!((later(i64::MAX, 1), later(5, -7)), (None, Some(-2)));
        let double = |n: i64| n as f64;
        assert_eq!(after(3, double(1 << 61)), Some((1 << 61) + 3));
        for refused in [double(COUNT_LIMIT), -double(COUNT_LIMIT), f64::INFINITY, f64::NAN] {
            assert_eq!(after(0, refused), None);
        }
        assert_eq!(after(-1, double(COUNT_LIMIT).next_down()), Some(COUNT_LIMIT - 513));
        assert_eq!(after(1 << 61, double(1 << 61)), None);
    }
}
