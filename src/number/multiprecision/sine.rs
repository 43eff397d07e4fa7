//! Sine and cosine in fixed point: a table of the circle, two short series, a rotation; and pi.
//!
//! An orbit asks for thousands of them, so a table pays: what it leaves of the angle is below `2^-8`, and later terms
//! of the series need fewer digits. Lemma M5 of `docs/proofs/multiprecision.md#M5` has the bound.

use std::cell::RefCell;

use num_bigint::BigInt;
use num_integer::Roots;
use num_traits::{One, ToPrimitive, Zero};

use super::float::{Float, Round};
use super::upper::upper_product;
use crate::exact::Enclosure;
use crate::number::Magnitude;

/// Bound of the error of both results, as a power of two, in units of the last bit (Lemma M5).
const ERROR_EXPONENT: i64 = 5;
const LIMB: u32 = 64;
/// Bits beyond the requested ones, at least.
const GUARD: u32 = 16;
/// Bits of the units of the table beyond those of its entries.
const TABLE_GUARD: u32 = 64;
/// Number of bits beyond which a table of 1,024 parts of a period takes longer to make than a few sines.
const MOST_TABLE_BITS: u32 = 1 << 15;

thread_local! {
    static CIRCLE: RefCell<Circle> = RefCell::default();
    static TURN: RefCell<Turn> = RefCell::default();
}

/// `2 pi` in units of `2^-bits`, rounded down.
#[derive(Default)]
struct Turn {
    bits: u32,
    whole: BigInt,
}

impl Turn {
    /// Makes `2 pi` in `bits` bits or more.
    fn reach(&mut self, bits: u32) {
        if self.bits >= bits && !self.whole.is_zero() {
            return;
        }
        self.bits = (bits + bits / 8).next_multiple_of(LIMB);
        // Its lower end, in eight bits more, is within 2^-5 of a unit below pi.
        let pi = Enclosure::pi(self.bits + 8).inf().clone();
        let shift = (pi.exponent() + 1 + i64::from(self.bits)).unsigned_abs(); // M5: to the right, of one with more bits
        self.whole = pi.mantissa() >> shift;
    }
}

/// `2 pi`, to `bits` bits, and a bound of its error (Lemma M5).
pub(super) fn turn(bits: u32) -> (Float, Magnitude) {
    TURN.with_borrow_mut(|turn| {
        let fine = bits + GUARD;
        turn.reach(fine);
        // Cut off twice: within two units of the last bit.
        let whole = &turn.whole >> (turn.bits - fine);
        let (found, rounding) = super::rounding(Float::rounding(whole, -i64::from(fine), bits, Round::Nearest));
        (found, rounding + Magnitude::power_of_two(1 - i64::from(fine)))
    })
}

/// Sines and cosines of parts of a period, in units of `2^-bits`.
#[derive(Default)]
struct Circle {
    bits: u32,
    turn: BigInt,
    /// Parts of a period; a power of two.
    parts: i32,
    /// Of those of an eighth of it.
    waves: Vec<[BigInt; 2]>,
    series: Series,
}

/// `[sin 2 pi u, cos 2 pi u]` in `bits` bits, each with a bound of its error; `None` if `u` is no number.
///
/// **Enclosure** (Lemma M5): each lies within its magnitude of the number found.
pub(super) fn sin_cos(u: &Float, bits: u32) -> Option<[(Float, Magnitude); 2]> {
    if !u.is_number() {
        return None;
    }
    let fine = (bits + GUARD).next_multiple_of(LIMB);
    let whole = u.round(); // M5: any whole number near
    let rest = u.minus(&whole, bits.max(u.bits())); // exact: whole periods taken off leave no more bits
    CIRCLE.with_borrow_mut(|circle| {
        circle.reach(fine);
        let error = Magnitude::power_of_two(ERROR_EXPONENT - i64::from(fine));
        Some(circle.turned(&rest, fine).map(|wave| {
            let (mid, rounding) = super::rounding(Float::rounding(wave, -i64::from(fine), bits, Round::Nearest));
            (mid, rounding + error)
        }))
    })
}

impl Circle {
    /// Makes the table in `fine` bits or more.
    fn reach(&mut self, fine: u32) {
        if self.bits >= fine {
            return;
        }
        self.bits = (fine + fine / 8).next_multiple_of(LIMB);
        self.parts = if self.bits <= MOST_TABLE_BITS { 1 << 10 } else { 1 << 4 };
        let bits = self.bits + TABLE_GUARD;
        let turn = TURN.with_borrow_mut(|turn| {
            turn.reach(bits);
            &turn.whole >> (turn.bits - bits)
        });
        self.series.sum(&(&turn / self.parts), bits);
        let step = self.series.waves.clone();
        self.turn = turn >> TABLE_GUARD;
        let mut waves = [BigInt::ZERO, BigInt::one() << bits];
        self.waves.clear();
        for _ in 0..=self.parts / 8 {
            self.waves.push(waves.clone().map(|wave| wave >> TABLE_GUARD));
            waves = rotated(&waves, &step, bits);
        }
    }

    /// Sine and cosine in units of `2^-fine`, of a phase of at most half a period.
    fn turned(&mut self, u: &Float, fine: u32) -> [BigInt; 2] {
        let Self { bits, turn, parts, waves, series } = self;
        let coarser = *bits - fine;
        let part = (u.to_f64() * f64::from(*parts)).round(); // M5: any whole number near
        // Exact: no bit of it is below the last one of `u`, and none above a part.
        let rest = u.minus(&Float::new(part / f64::from(*parts)), fine);
        let x = match rest.exponent {
            shift @ 0.. => (&*turn * rest.mantissa) << shift, // M5: only 0 has no bits below 1
            shift => ((&*turn >> coarser) * rest.mantissa) >> shift.unsigned_abs(),
        };
        series.sum(&x, fine);
        let part = part as i32; // exact: at most half the parts
        let quarter = *parts / 4;
        let quarters = (part + quarter / 2).div_euclid(quarter);
        let part = part - quarters * quarter;
        let [mut sin, cos] = waves[part.unsigned_abs() as usize].each_ref().map(|wave| wave >> coarser); // exact: an index
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

/// The workspace of the series of a sine and a cosine.
#[derive(Default)]
struct Series {
    powers: Vec<BigInt>,
    spare: BigInt,
    /// Sine and cosine of the last angle.
    waves: [BigInt; 2],
}

impl Series {
    /// The sine and the cosine of `x`, in units of `2^-fine`, by Taylor's formula.
    fn sum(&mut self, x: &BigInt, fine: u32) {
        let square = product(x, x, fine);
        let small = (u64::from(fine) - square.bits()).to_u32().expect("at most as many as the whole has");
        let (terms, columns) = shape(small, fine);
        let last = columns as usize; // exact: an index
        self.powers.clear();
        self.powers.extend([BigInt::one() << fine, square]);
        for i in 2..=last {
            self.powers.push(product(&self.powers[i / 2], &self.powers[i - i / 2], fine));
        }
        let sine = self.alternating(small, fine, (terms, columns), |k| 2 * k * (2 * k + 1));
        let cosine = self.alternating(small, fine, (terms, columns), |k| 2 * k * (2 * k - 1));
        self.waves = [product(x, &sine, fine), cosine];
    }

    /// `1 - T / step(1) + T^2 / (step(1) step(2)) - ...`
    ///
    /// Rectangular splitting: terms in rows of as many as there are powers, so that few products are of two long
    /// numbers; a row is summed in as many bits as are left of it. Coefficients are whole numbers over a factorial,
    /// divided out when they are about to be longer than a limb.
    fn alternating(&mut self, small: u32, fine: u32, (terms, columns): (u32, u32), step: fn(u64) -> u64) -> BigInt {
        let Self { powers, spare, .. } = self;
        // Bits that a row is not worth.
        let drowned = |row: u32| small * columns * row / LIMB * LIMB;
        let (mut row, mut factor) = ((terms - 1) / columns, 1u64);
        let mut lost = drowned(row);
        let mut sum = BigInt::ZERO;
        for k in (0..terms).rev() {
            let column = k - row * columns;
            let power = &powers[column as usize]; // exact: an index
            if lost > 0 {
                *spare = power >> lost;
            } else {
                spare.clone_from(power);
            }
            *spare *= factor;
            if k.is_multiple_of(2) {
                sum += &*spare;
            } else {
                sum -= &*spare;
            }
            if column == 0 && row > 0 {
                row -= 1;
                let less = drowned(row);
                sum = product(&sum, &(&powers[columns as usize] >> less), fine - lost); // exact: an index
                lost = less;
            }
            let next = if k == 0 { 1 } else { step(u64::from(k)) };
            factor = match factor.checked_mul(next) {
                Some(factor) => factor,
                None => {
                    sum /= factor;
                    next
                }
            };
        }
        sum / factor
    }
}

/// The product in units of `2^shift`, towards 0, within 1.01 of them.
fn product(a: &BigInt, b: &BigInt, shift: u32) -> BigInt {
    let size = upper_product(a.magnitude(), b.magnitude(), u64::from(shift));
    BigInt::from_biguint(a.sign() * b.sign(), size)
}

/// Terms of the series of a number whose square is below `2^-small`, and powers to split it by.
fn shape(small: u32, fine: u32) -> (u32, u32) {
    // M5: what is left out is smaller than its first term
    let (mut terms, mut tiny) = (0, 0);
    while tiny < fine {
        terms += 1;
        let k = u64::from(terms);
        tiny += small + (2 * k * (2 * k - 1)).ilog2();
    }
    // A row costs a third of a product on the average, a power all of one.
    let columns = (terms / 2).sqrt().max(1); // M5: any number of them
    (terms, columns)
}

/// Sine and cosine of the sum of two angles in units of `2^bits`, within 2.02 of them.
fn rotated([a, b]: &[BigInt; 2], [sin, cos]: &[BigInt; 2], bits: u32) -> [BigInt; 2] {
    let part = |x: &BigInt, y: &BigInt| product(x, y, bits);
    [part(a, cos) + part(b, sin), part(b, cos) - part(a, sin)]
}

#[cfg(test)]
mod tests {
    //! Lemma M5 against the sine and cosine of exact numbers, in more bits.

    use super::*;
    use crate::number::MpBall;
    use crate::number::tests::powers;
    use proptest::prelude::*;

    /// Phases in all their bits, often next to the middle or the edge of a part, an eighth or a quarter, or tiny, or far.
    fn phases(bits: u32) -> impl Strategy<Value = Float> {
        let edge = prop_oneof![
            (-2080..2080i32).prop_map(|k| f64::from(k) / 2048.0),
            (-32..32i32).prop_map(|k| f64::from(k) / 8.0)
        ];
        let off = prop_oneof![Just(0.0), powers(-300.0, -10.0), powers(-20.0, -2.0)];
        let full = (any::<i64>(), any::<i64>(), -9..8i64).prop_map(move |(m, n, shift)| {
            let m = Float::whole(m | 1).over(&Float::whole(n | 1), bits);
            let top = m.top().expect("not nothing");
            m.scaled(shift - top)
        });
        let near = (edge, off, any::<bool>()).prop_map(move |(edge, off, below)| {
            Float::new(edge).plus(&Float::new(if below { -off } else { off }), bits)
        });
        let far = full.clone().prop_map(|x| x.scaled(30));
        prop_oneof![near, full.clone(), full.prop_map(|x| x.scaled(-400)), far]
    }

    /// Sine and cosine, and the angle, in far more bits than are tested.
    fn truth(u: &Float, bits: u32) -> [MpBall; 2] {
        let u = Enclosure::point(u.dyadic().unwrap());
        let angle = Enclosure::pi(bits).mul(&u, bits);
        let angle = angle.add(&angle, bits);
        [angle.sin(bits), angle.cos(bits)].map(|x| MpBall::enclosing(&x, bits))
    }

    fn is_within(found: &Float, truth: &MpBall, error: Magnitude) -> bool {
        let least = (found.distance(truth.mid())).less(truth.rad());
        least.is_none_or(|least| least <= error)
    }

    proptest! {
        #[test]
        fn both_are_within_their_bounds((u, bits) in prop_oneof![Just(53u32), Just(64), Just(128), 53..700u32, 1000..7000u32].prop_flat_map(|bits| (phases(bits), Just(bits)))) {
            let truth = truth(&u, bits + 700);
            let fine = (bits + GUARD).next_multiple_of(LIMB);
            let raw = CIRCLE.with_borrow_mut(|circle| {
                circle.reach(fine);
                circle.turned(&u.minus(&u.round(), bits), fine)
            });
            let found = sin_cos(&u, bits).expect("a number");
            for ((mid, error), (raw, truth)) in found.iter().zip(raw.into_iter().zip(truth)) {
                prop_assert!(mid.bits() == bits && is_within(mid, &truth, *error), "{u:?}: {mid:?} {error:?}");
                let (raw, _) = Float::rounding(raw, -i64::from(fine), bits + 700, Round::Nearest);
                prop_assert!(is_within(&raw, &truth, Magnitude::power_of_two(ERROR_EXPONENT - i64::from(fine))), "{u:?}: {raw:?}");
                prop_assert!(*error <= Magnitude::new(1.01, -i64::from(bits)), "{error:?}");
            }
        }
    }

    /// Beyond the bits of the fine table, and of pi that others have asked for.
    #[test]
    fn many_bits_are_those_of_exact_numbers() {
        let bits = MOST_TABLE_BITS + 100;
        let u = Float::new(10.0).over(&Float::new(7.0), bits);
        for ((mid, error), truth) in sin_cos(&u, bits).unwrap().into_iter().zip(truth(&u, bits + 50)) {
            assert!(is_within(&mid, &truth, error) && error.log2() < 2.0 - f64::from(bits));
        }
        let (found, error) = turn(bits);
        let pi = MpBall::enclosing(&Enclosure::pi(bits + 50), bits + 40);
        assert!(is_within(&found.scaled(-1), &pi, error) && sin_cos(&Float::none(64), 64).is_none());
    }
}
