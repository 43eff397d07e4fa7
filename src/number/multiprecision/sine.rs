//! Sine and cosine in fixed point: a table of the circle, a short series, a rotation.
//!
//! MPFR finds each of them from nothing. An orbit asks for thousands, so a table pays: what it leaves of the angle is
//! below `2^-8`, and later terms of the series need fewer limbs. Lemma M5 of `docs/proofs/multiprecision.md#M5` has the bound.

use std::cell::RefCell;
use std::mem::swap;

use rug::float::{Constant, Round};
use rug::{Assign, Float, Integer};

use super::arithmetic::SHORT_PRODUCT_BITS;
use crate::number::Magnitude;

/// Number of bits beyond which MPFR is faster.
const MOST_BITS: u32 = 1 << 15;
/// Periods that are reduced, as a power of two.
const MAX_PHASE_EXPONENT: i32 = 8;
/// Bound of the error of both results, as a power of two, in units of the last bit (Lemma M5).
const ERROR_EXPONENT: i64 = 4;
/// Parts of a period in the table; it holds those of an eighth.
const TABLE_PARTS: i32 = 1 << 10;
const QUARTER: i32 = TABLE_PARTS / 4;
const LIMB: u32 = 64;
/// Bits beyond the requested ones, at least.
const GUARD: u32 = 16;

thread_local! {
    static CIRCLE: RefCell<Circle> = RefCell::default();
}

/// Sines and cosines in units of `2^-bits`.
#[derive(Default)]
struct Circle {
    bits: u32,
    turn: Integer,
    parts: Vec<[Integer; 2]>,
    series: Series,
}

/// The workspace of the series of a sine, in units of `2^-bits`.
#[derive(Default)]
struct Series {
    x: Integer,
    powers: Vec<Integer>,
    sum: Integer,
    spare: Integer,
    /// Sine and cosine of `x`.
    waves: [Integer; 2],
}

/// `[sin 2 pi u, cos 2 pi u]` in N bits and what each may be off by; `None` where MPFR has to do it.
///
/// **Enclosure** (Lemma M5): each lies within its magnitude of the number found.
pub(super) fn sin_cos(u: &Float, bits: u32) -> Option<[(Float, Magnitude); 2]> {
    let is_near = u.is_zero() || u.get_exp().is_some_and(|exponent| exponent <= MAX_PHASE_EXPONENT);
    if bits > MOST_BITS || !is_near {
        return None;
    }
    let fine = (bits + GUARD).next_multiple_of(LIMB);
    CIRCLE.with_borrow_mut(|circle| {
        circle.reach(fine);
        let error = Magnitude::power_of_two(ERROR_EXPONENT - i64::from(fine));
        Some(circle.turned(u, fine).map(|wave| {
            let (mid, rounding) = super::rounding(Float::with_val_round(bits, wave, Round::Nearest));
            let rounding = rounding * Magnitude::power_of_two(-i64::from(fine));
            (mid >> fine, rounding + error)
        }))
    })
}

impl Circle {
    /// Has the table in N bits or more.
    fn reach(&mut self, fine: u32) {
        if self.bits >= fine {
            return;
        }
        self.bits = (fine + fine / 8).next_multiple_of(LIMB);
        let bits = self.bits + LIMB;
        let whole = |x: Float| (x << bits).to_integer_round(Round::Down).expect("a finite number").0;
        let turn: Float = Float::with_val_round(bits + LIMB, Constant::Pi, Round::Down).0 << 1;
        let angle = turn.clone() / TABLE_PARTS;
        self.turn = whole(turn) >> LIMB;
        let (sin, cos) = angle.sin_cos(Float::new(bits + LIMB));
        let step = [sin, cos].map(whole);
        let mut waves = [Integer::new(), Integer::from(1) << bits];
        self.parts.clear();
        for _ in 0..=QUARTER / 2 {
            self.parts.push(waves.clone().map(|wave| wave >> LIMB));
            waves = rotated(&waves, &step, bits);
        }
    }

    /// Sine and cosine in units of `2^-fine`.
    fn turned(&mut self, u: &Float, fine: u32) -> [Integer; 2] {
        let Self { bits, turn, parts, series } = self;
        let coarser = *bits - fine;
        let part = (u.to_f64() * f64::from(TABLE_PARTS)).round(); // M5: any whole number near
        // Exact: no bit of it is below the last one of `u`, and none above a part.
        let rest = Float::with_val(fine, u - part / f64::from(TABLE_PARTS));
        let Series { x, sum, spare, .. } = series;
        let (whole, exponent) = rest.to_integer_exp().expect("a finite number");
        *spare = whole;
        sum.assign(&*turn >> coarser);
        product(x, sum, spare, exponent.unsigned_abs()); // M5: of a number below 1 it is negative
        series.sum(fine);
        let part = part as i32; // exact: at most 2^18 in size
        let quarters = (part + QUARTER / 2).div_euclid(QUARTER);
        let part = part - quarters * QUARTER;
        let [mut sin, cos] = parts[part.unsigned_abs() as usize].each_ref().map(|wave| Integer::from(wave >> coarser)); // exact: an index
        if part < 0 {
            sin = -sin;
        }
        let [sin, cos] = rotated(&[sin, cos], &series.waves, fine);
        match quarters.rem_euclid(4) {
            0 => [sin, cos],
            1 => [cos, -sin],
            2 => [-sin, -cos],
            _ => [-cos, sin],
        }
    }
}

impl Series {
    /// The sine of `x`, by Taylor's formula, and the cosine by Pythagoras.
    ///
    /// Rectangular splitting: terms in rows of as many as there are powers, so that few products are of two long
    /// numbers; a row is summed in as many bits as are left of it. Coefficients are whole numbers over a factorial,
    /// divided out when they are about to be longer than a limb.
    fn sum(&mut self, fine: u32) {
        let Self { x, powers, sum, spare, waves: [sin, cos] } = self;
        spare.assign(x.square_ref());
        *spare >>= fine;
        let small = fine - spare.significant_bits();
        let (terms, columns) = shape(small, fine);
        let last = columns as usize; // exact: an index
        powers.resize_with(powers.len().max(last + 1), Integer::new); // M5: no fewer
        powers[0].assign(Integer::u_pow_u(2, fine));
        powers[1].assign(&*spare);
        for i in 2..=last {
            let (below, above) = powers.split_at_mut(i);
            product(&mut above[0], &below[i / 2], &below[i - i / 2], fine);
        }
        // Bits that a row is not worth.
        let drowned = |row: u32| small * columns * row / LIMB * LIMB;
        let (mut row, mut factor) = ((terms - 1) / columns, 1u64);
        let mut lost = drowned(row);
        sum.assign(0);
        for k in (0..terms).rev() {
            let column = k - row * columns;
            let mut power = &powers[column as usize]; // exact: an index
            if lost > 0 {
                spare.assign(power >> lost);
                power = spare;
            }
            if k.is_multiple_of(2) {
                *sum += power * factor;
            } else {
                *sum -= power * factor;
            }
            if column == 0 && row > 0 {
                row -= 1;
                let less = drowned(row);
                spare.assign(&powers[last] >> less);
                product(cos, sum, spare, fine - lost);
                swap(sum, cos);
                lost = less;
            }
            factor = match factor.checked_mul(step(k)) {
                Some(factor) => factor,
                None => {
                    *sum /= factor;
                    step(k)
                }
            };
        }
        *sum /= factor;
        product(sin, x, sum, fine);
        sum.assign(&powers[0] + &*sin);
        spare.assign(&powers[0] - &*sin);
        cos.assign(&*sum * &*spare);
        cos.sqrt_mut();
    }
}

/// The product in units of `2^shift`, within two of them.
fn product(out: &mut Integer, a: &Integer, b: &Integer, shift: u32) {
    let sizes = [a, b].map(Integer::significant_bits);
    if sizes.iter().any(|&bits| bits < SHORT_PRODUCT_BITS) {
        out.assign(a * b);
        *out >>= shift;
        return;
    }
    // MPFR finds the upper half of a long product only.
    let bits = (sizes[0] + sizes[1]).saturating_sub(shift) + 8; // M5: at least the bits of the result
    let mut float = Float::with_val(bits, a);
    float *= Float::with_val(bits, b);
    let (whole, exponent) = float.to_integer_exp().expect("a finite number");
    *out = whole >> (shift as i32 - exponent); // exact: at most 2^16 in size
}

/// `(2k + 1)! / (2k - 1)!`, and 1 for `k = 0`.
fn step(k: u32) -> u64 {
    let k = u64::from(k);
    if k == 0 { 1 } else { 2 * k * (2 * k + 1) }
}

/// Terms of the series of the sine of a number whose square is below `2^-small`, and powers to split it by.
fn shape(small: u32, fine: u32) -> (u32, u32) {
    // M5: what is left out is smaller than its first term
    let (mut terms, mut tiny) = (0, 0);
    while tiny < fine {
        terms += 1;
        tiny += small + step(terms).ilog2();
    }
    // A row costs a third of a product on the average, a power all of one.
    let columns = (terms / 2).isqrt().max(1); // M5: any number of them
    (terms, columns)
}

/// Sine and cosine of the sum of two angles in units of `2^bits`, within four of them.
fn rotated([a, b]: &[Integer; 2], [sin, cos]: &[Integer; 2], bits: u32) -> [Integer; 2] {
    let part = |x: &Integer, y: &Integer| {
        let mut out = Integer::new();
        product(&mut out, x, y, bits);
        out
    };
    [part(a, cos) + part(b, sin), part(b, cos) - part(a, sin)]
}

#[cfg(test)]
mod tests {
    //! Lemma M5 against MPFR's own sine and cosine, in more bits.

    use super::*;
    use crate::number::tests::powers;
    use proptest::prelude::*;

    /// Phases in all their bits, often next to the middle or the edge of a part, an eighth or a quarter, or tiny.
    fn phases(bits: u32) -> impl Strategy<Value = Float> {
        let edge = prop_oneof![
            (-2080..2080i32).prop_map(|k| f64::from(k) / 2048.0),
            (-32..32i32).prop_map(|k| f64::from(k) / 8.0)
        ];
        let off = prop_oneof![Just(0.0), powers(-300.0, -10.0), powers(-20.0, -2.0)];
        let full = (any::<u64>(), any::<u64>(), -9..8i32).prop_map(move |(m, n, shift)| {
            let m = Float::with_val(bits, m | 1) / n.max(1);
            let exponent = m.get_exp().expect("not nothing");
            m >> (exponent - shift)
        });
        let near = (edge, off, any::<bool>())
            .prop_map(move |(edge, off, below)| Float::with_val(bits, edge) + if below { -off } else { off });
        prop_oneof![near, full.clone(), full.prop_map(|x| x >> 400)]
    }

    fn in_doubt(found: &Float, true_one: &Float, error: Magnitude) -> bool {
        let away = Float::with_val_round(64, found - true_one, Round::AwayZero).0;
        super::super::magnitude(&away) > error
    }

    proptest! {
        #[test]
        fn both_are_within_their_bounds((u, bits) in prop_oneof![Just(53u32), Just(64), Just(128), 53..700u32, 1000..7000u32].prop_flat_map(|bits| (phases(bits), Just(bits)))) {
            let own = bits + 700;
            let angle = Float::with_val(own, Constant::Pi) * 2u32 * &u;
            let (sin, cos) = angle.sin_cos(Float::new(own));
            let fine = (bits + GUARD).next_multiple_of(LIMB);
            let raw = CIRCLE.with_borrow_mut(|circle| {
                circle.reach(fine);
                circle.turned(&u, fine)
            });
            let found = sin_cos(&u, bits).expect("a near phase");
            for ((mid, error), (raw, truth)) in found.iter().zip(raw.into_iter().zip([sin, cos])) {
                prop_assert!(mid.prec() == bits && !in_doubt(mid, &truth, *error), "{u}: {mid} {error:?}");
                let raw = Float::with_val(own, raw) >> fine;
                prop_assert!(!in_doubt(&raw, &truth, Magnitude::power_of_two(ERROR_EXPONENT - i64::from(fine))), "{u}: {raw}");
                prop_assert!(*error <= Magnitude::new(1.01, -i64::from(bits)), "{error:?}");
            }
        }
    }

    #[test]
    fn far_or_fine_phases_are_left_to_multiprecision() {
        assert!(sin_cos(&(Float::with_val(64, 3) << 200), 64).is_none());
        assert!(sin_cos(&Float::with_val(64, 0.3), MOST_BITS + 1).is_none());
        assert!(sin_cos(&Float::with_val(64, f64::NAN), 64).is_none());
    }
}
