//! The upper part of a product of two long numbers, which costs half of all of it: results are rounded to no more bits.
//!
//! Row by row, each from the first digit on that is wanted. Beyond [`LONGEST`] the big integers' own method, which
//! multiplies faster than row by row, is the better one.

use std::cell::RefCell;

use num_bigint::BigUint;

/// Digits of 64 bits below which all of a product is found faster.
const SHORTEST: u64 = 10;
/// Digits beyond which it is so again.
const LONGEST: u64 = 128;
const LIMB: u64 = 64;

thread_local! {
    static DIGITS: RefCell<[Vec<u64>; 3]> = RefCell::default();
    static HALVES: RefCell<Vec<u32>> = RefCell::default();
}

/// A whole number at or below `a b / 2^shift`, by less than `1 + 2^-50`.
///
/// **Lemma M1, products.** With `B = 2^64`, what is left out are products of digits in columns below `k`, `B^(k + 2) <= 2^shift`: fewer
/// than `2^8` of less than `B^2` in each column, so less than `2^8 (1 + 2 / B) B^(k + 1)` in all, `2^-55` of `2^shift`.
pub(super) fn upper_product(a: &BigUint, b: &BigUint, shift: u64) -> BigUint {
    let [long, short] = [a.bits().max(b.bits()), a.bits().min(b.bits())].map(|bits| bits.div_ceil(LIMB)); // M1: which method it is does not matter
    let skipped = (shift / LIMB).saturating_sub(2); // M1: nothing is left out of a whole product
    if short < SHORTEST || long > LONGEST || 2 * skipped < short {
        return (a * b) >> shift;
    }
    let skipped = skipped as usize; // exact: fewer than the digits of both
    DIGITS.with_borrow_mut(|[x, y, out]| {
        for (digits, number) in [(&mut *x, a), (&mut *y, b)] {
            digits.clear();
            digits.extend(number.iter_u64_digits());
        }
        out.clear();
        out.resize((x.len() + y.len()).saturating_sub(skipped).max(1), 0); // M1: no digit at all is 0
        for (i, &digit) in x.iter().enumerate() {
            let from = skipped.saturating_sub(i); // M1: the first one that is wanted
            if let Some(row) = y.get(from..).filter(|row| !row.is_empty()) {
                add_row(&mut out[i + from - skipped..], digit, row);
            }
        }
        HALVES.with_borrow_mut(|halves| {
            halves.clear();
            halves.extend(out.iter().flat_map(|&digit| [digit as u32, (digit >> 32) as u32])); // exact: the halves
            BigUint::from_slice(halves) >> (shift - skipped as u64 * LIMB) // exact: the columns left out
        })
    })
}

/// Adds a digit times a row of them; the digit after the row is 0.
fn add_row(out: &mut [u64], digit: u64, row: &[u64]) {
    let mut carry = 0;
    let (sums, rest) = out.split_at_mut(row.len());
    for (sum, &other) in sums.iter_mut().zip(row) {
        // At most (B - 1)^2 + 2 (B - 1) = B^2 - 1.
        let whole = u128::from(digit) * u128::from(other) + u128::from(*sum) + u128::from(carry);
        (*sum, carry) = (whole as u64, (whole >> LIMB) as u64); // exact: the halves
    }
    rest[0] = carry;
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn it_is_within_two_of_the_whole(
            [a, b] in [(); 2].map(|()| proptest::collection::vec(prop_oneof![any::<u32>(), Just(0), Just(u32::MAX)], 1..300)),
            part in 0.0..1.1f64,
        ) {
            let [a, b] = [a, b].map(|digits| BigUint::new(digits) + 1u32);
            let shift = ((a.bits() + b.bits()) as f64 * part) as u64;
            let (found, exact) = (upper_product(&a, &b, shift), (&a * &b) >> shift);
            prop_assert!(found <= exact && exact <= found + 1u32, "{a} {b} {shift}");
        }
    }
}
