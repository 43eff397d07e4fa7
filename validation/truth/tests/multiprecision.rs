//! Every operation on numbers of many bits and their balls against MPFR's: values, bounds, and whether a result is exact.
//!
//! `MULTIPRECISION_CASES` sets how many operands are tried with all operations.

use std::cmp::Ordering;

use impact_pair::exact::{Dyadic, Enclosure};
use impact_pair::number::{Ball, Magnitude, MpBall, Number, logarithm};
use num_bigint::{BigInt, Sign};
use rug::float::Constant;
use rug::integer::Order;
use rug::ops::{AddAssignRound, DivAssignRound, MulAssignRound, SubAssignRound};
use rug::{Float, Integer};

use crate::random::Random;

/// A number of MPFR as the centre of a ball.
fn ours(x: &Float) -> MpBall {
    let Some((mantissa, exponent)) = x.to_integer_exp() else { return MpBall::from_f64_bits(0.0, x.prec()) };
    let sign = if mantissa.cmp0() == Ordering::Less { Sign::Minus } else { Sign::Plus };
    let halves = mantissa.to_digits::<u32>(Order::Lsf);
    let point = Enclosure::point(Dyadic::new(BigInt::new(sign, halves), exponent.into()));
    MpBall::enclosing(&point, x.prec())
}

/// The centre of a ball as a number of MPFR, exactly.
fn theirs(x: &MpBall) -> Float {
    let point = MpBall::exact(x.mid().clone()).enclosure().expect("a number");
    let (sign, digits) = point.inf().mantissa().to_u64_digits();
    let size = Integer::from_digits(&digits, Order::Lsf);
    let exact =
        Float::with_val(size.significant_bits().max(1), &size) << i32::try_from(point.inf().exponent()).unwrap();
    if sign == Sign::Minus { -exact } else { exact }
}

/// A radius as a number of MPFR.
fn radius(x: Magnitude) -> Float {
    let Some(exponent) = x.exponent() else { return Float::new(53) };
    Float::with_val(53, x.in_units_of(exponent)) << i32::try_from(exponent).expect("a finite radius")
}

/// Asserts that a ball holds the number that `rounded` is near to, is exact where MPFR's rounding is, and hardly wider.
fn judge(name: &str, found: &MpBall, near: &Float, (rounded, ordering): (Float, Ordering), is_tight: bool) {
    let (mid, rad) = (theirs(found), radius(found.rad()));
    let off = Float::with_val(near.prec(), &mid - near).abs();
    assert!(off <= Float::with_val(64, &rad * 1.000001), "{name}: {mid:?} +- {rad:?} is not {near:?}");
    assert!(is_tight || ordering == Ordering::Equal || !found.rad().is_zero(), "{name}: {near:?} is not exact");
    if is_tight {
        assert_eq!(found.rad().is_zero(), ordering == Ordering::Equal, "{name}: {near:?}");
        // Half a unit in the last place, or twice that beside a power of two.
        let most =
            rounded.get_exp().map_or(Float::new(53), |top| Float::with_val(53, 1) << (top - rounded.prec() as i32));
        assert!(rad <= most, "{name}: {rad:?} is wider than {most:?}");
    }
}

/// Random numbers, often short, of nearby or far exponents, or nearly equal.
struct Operands(Random);

impl Operands {
    fn below(&mut self, n: u32) -> u32 {
        self.0.below(u64::from(n)) as u32
    }

    fn number(&mut self, bits: u32, reach: i32) -> Float {
        let own = [bits, bits, bits / 2, 8, 64.min(bits), 1][self.below(6) as usize];
        let random: Vec<u64> = (0..own.div_ceil(64)).map(|_| self.0.bits()).collect();
        let mut digits = Integer::from_digits(&random, Order::Lsf).keep_bits(own);
        digits.set_bit(own - 1, true);
        // Runs of ones and zeros find what carries.
        if self.below(3) == 0 && own > 8 {
            let run = Integer::from(Integer::u_pow_u(2, self.below(own - 4) + 2)) - 1u32;
            digits = if self.below(2) == 0 { digits | run } else { digits.clone() - (&digits & run) };
        }
        let exponent = match self.below(8) {
            0 => self.below(2 * reach as u32) as i32 - reach,
            1..4 => 0,
            _ => self.below(2 * bits) as i32 - bits as i32,
        };
        let x = Float::with_val(bits, digits) >> (own as i32) << exponent;
        if self.below(2) == 0 { -x } else { x }
    }
}

fn cases() -> u32 {
    std::env::var("MULTIPRECISION_CASES").map_or(2_000, |text| text.parse().expect("a number of cases"))
}

#[test]
fn arithmetic_is_that_of_mpfr() {
    let mut operands = Operands(Random::new(64));
    for case in 0..cases() {
        let bits = [53, 64, 65, 127, 128, 200, 640, 704, 1000, 1536, 3000, 9000]
            [case as usize % if case % 50 == 0 { 12 } else { 10 }];
        let (a, c) = (operands.number(bits, 1 << 28), operands.number(bits, 1 << 20));
        let b = match operands.below(5) {
            0 => Float::with_val(bits, &a * (1.0 + 2f64.powi(-(operands.below(60) as i32)))),
            1 => Float::with_val(bits, -&a),
            _ => operands.number(bits, 1 << 28),
        };
        let [x, y, z] = [&a, &b, &c].map(ours);
        let wide = 2 * bits + 400;
        let rounded = |op: &dyn Fn(&mut Float) -> Ordering| {
            let mut found = a.clone();
            let ordering = op(&mut found);
            (found, ordering)
        };
        use rug::float::Round::Nearest;
        judge(
            "+",
            &(x.clone() + y.clone()),
            &Float::with_val(wide, &a + &b),
            rounded(&|f| f.add_assign_round(&b, Nearest)),
            true,
        );
        judge(
            "-",
            &x.clone().minus(&y),
            &Float::with_val(wide, &a - &b),
            rounded(&|f| f.sub_assign_round(&b, Nearest)),
            true,
        );
        judge(
            "*",
            &x.clone().times(&y),
            &Float::with_val(wide, &a * &b),
            rounded(&|f| f.mul_assign_round(&b, Nearest)),
            true,
        );
        let quotient = x.clone().checked_div(y.clone()).expect("not 0");
        judge("/", &quotient, &Float::with_val(wide, &a / &b), rounded(&|f| f.div_assign_round(&b, Nearest)), true);
        let product = Float::with_val(2 * bits, &a * &b);
        let (sum, difference) = (Float::with_val(wide, &product + &c), Float::with_val(wide, &c - &product));
        let fused = |plus: bool| {
            rounded(&|f| {
                *f = c.clone();
                if plus { f.add_assign_round(&product, Nearest) } else { f.sub_assign_round(&product, Nearest) }
            })
        };
        judge("* +", &x.mul_add_ref(&y, z.clone()), &sum, fused(true), bits < 640);
        judge("- *", &x.mul_sub_ref(&y, z), &difference, fused(false), bits < 640);
        let fewer = bits / 2 + 40;
        let (short, ordering) = Float::with_val_round(fewer, &a, Nearest);
        judge("rounded", &x.rounded(fewer), &a, (short, ordering), true);
        let (root, ordering) = Float::with_val_round(bits, a.clone().abs().sqrt_ref(), Nearest);
        let found = MpBall::exact(x.mid().clone().abs().sqrt(bits));
        let off = Float::with_val(64, theirs(&found) - &root).abs();
        assert!(
            off <= Float::with_val(53, &root) >> bits as i32 || ordering == Ordering::Equal && off == 0,
            "sqrt {a:?}"
        );
        let whole = |x: &impact_pair::number::Float| theirs(&MpBall::exact(x.clone()));
        let (mid, own) = (x.mid(), Float::with_val(bits, &a));
        assert!(whole(&mid.floor()) == own.clone().floor() && whole(&mid.ceil()) == own.clone().ceil(), "{a:?}");
        assert!(
            whole(&mid.round()) == own.round() && (mid.to_f64() == a.to_f64() || a.to_f64().abs() < f64::MIN_POSITIVE),
            "{a:?}"
        );
        assert_eq!(x.mid().partial_cmp(y.mid()), a.partial_cmp(&b));
    }
}

/// Sine and cosine within 1.01 units of `2^-bits`, and the arc cosine as many bits of the angle.
#[test]
fn functions_are_those_of_mpfr() {
    let mut operands = Operands(Random::new(64));
    for case in 0..cases() / 10 {
        let bits = [53, 64, 128, 200, 1000, 3000, 9000, 40_000][case as usize % if case % 50 == 0 { 8 } else { 5 }];
        let far = [0, 0, 2, 31, 33][case as usize % 5];
        let full = operands.number(bits, 1000);
        let u = match operands.below(3) {
            0 => {
                Float::with_val(bits, operands.below(4096)) / 1024u32
                    + Float::with_val(53, operands.number(20, 60)) * 2f64.powi(-60)
            }
            1 => full,
            _ => full.get_exp().map_or(Float::new(bits), |top| full << (far - top)),
        };
        let wide = 2 * bits + 200 + u.get_exp().map_or(0, i32::unsigned_abs);
        let turn = Float::with_val(wide, Constant::Pi) * 2u32;
        let (sin, cos) = Float::with_val(wide, &turn * &u).sin_cos(Float::new(wide));
        let (s, c) = ours(&u).sin_cos();
        let most = Float::with_val(53, 1.01) >> bits as i32;
        for (found, truth) in [(&s, &sin), (&c, &cos)] {
            let (off, rad) = (Float::with_val(64, theirs(found) - truth).abs(), radius(found.rad()));
            assert!(
                off <= Float::with_val(64, &rad + (Float::with_val(53, 1) >> (wide as i32 - 100))) && rad <= most,
                "{u:?}: {found:?}"
            );
        }
        let found = ours(&u).turn();
        assert!(
            Float::with_val(64, theirs(&found) - &turn).abs() <= radius(found.rad())
                && found.rad().log2() <= 3.0 - f64::from(bits)
        );
        if bits > 4000 {
            continue;
        }
        // Of all numbers, of those next to 1 and -1, and to 0.
        let near = Float::with_val(bits, 1)
            - (Float::with_val(53, operands.number(20, 60)).abs() >> (operands.below(bits) as i32));
        for q in [Float::with_val(bits, cos), near.clone(), -near, u] {
            if q.clone().abs() > 1u32 {
                continue;
            }
            let wide = 3 * bits + 200;
            let truth = Float::with_val(wide, Float::with_val(wide, &q).acos_ref()) / Float::with_val(wide, &turn);
            let found = ours(&q).acos();
            let (off, rad) = (Float::with_val(64, theirs(&found) - &truth).abs(), radius(found.rad()));
            let slack = Float::with_val(64, &truth) >> (bits as i32 + 100);
            assert!(off <= Float::with_val(64, &rad + &slack), "acos {q:?}: {found:?} is not {truth:?}");
            // MPFR's both ends, as they were before, are a unit of the angle and one of its quotient apart.
            assert!(rad <= Float::with_val(64, &truth) >> (bits as i32 - 2), "acos {q:?}: {rad:?}");
        }
    }
}

/// Lemma B3, at the centre and at both ends.
#[test]
fn balls_hold_the_logarithm() {
    let mut operands = Operands(Random::new(64));
    for _ in 0..cases() {
        let mid = (0.5 + 1.5 * f64::from(operands.below(1 << 31)) / 2f64.powi(31))
            * 2f64.powi(operands.below(2000) as i32 - 1000);
        let part = f64::from(operands.below(900)) / 1000.0;
        for rad in [0.0, part * mid, 1e-12 * part * mid] {
            let found = logarithm(Ball::new(mid, rad)).unwrap();
            for at in [-rad, 0.0, rad] {
                let error = ((Float::with_val(200, mid) + at).ln() - found.mid()).abs();
                assert!(error <= found.rad(), "{mid:e} {rad:e}: {error:e} > {:e}", found.rad());
            }
            assert!(rad > 0.0 || found.rad() <= 2e-15 * (1.0 + found.mid().abs()), "{found:?}");
        }
    }
}

/// Lemma M1, products: next to the middle of two numbers the upper part alone does not tell how to round.
#[test]
fn long_products_next_to_a_middle_are_rounded_as_the_whole_ones() {
    let (p, q) = (2048u32, 1024u32);
    for (base, off) in (1..20u32).flat_map(|k| [(2 * k + 1, 1), (2 * k + 1, -1)]) {
        // x of q bits and y of p bits whose product is n * 2^(q - 1) + off, n of p + 1 bits and odd.
        let power = Integer::from(Integer::u_pow_u(base, 1000));
        let shift = power.significant_bits() - q;
        let x = (power >> shift) | (Integer::from(1) << (q - 2)) | 1u32;
        let unit = Integer::from(1) << (q - 1);
        let inverse = unit.clone().invert(&x).expect("x is odd");
        let rest = if off < 0 { inverse } else { Integer::from(&x - &inverse) };
        let mut n: Integer = (Integer::from(3) << (p - q - 1)) * &x + rest;
        if n.is_even() {
            n += &x;
        }
        let y: Integer = (n * unit + off) / &x;
        assert!(y.significant_bits() <= p);
        let [x, y] = [(x, q), (y, p)].map(|(whole, bits)| Float::with_val(bits, whole));
        let found = theirs(&(ours(&x) * ours(&y)));
        assert_eq!(found, Float::with_val(p, &x * &y), "{base}, {off}");
    }
}
