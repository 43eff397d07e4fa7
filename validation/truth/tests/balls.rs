//! Multiprecision balls: every operation holds the exact result for members at the centre and at both ends.
//!
//! The judge is rational arithmetic, or MPFR at four times the precision and more. Corners: no radius, centres of other
//! precisions, exponents of 2^+-2000, quarter turns, |q| next to 1 in the arc cosine, angles of 1e-3 where the rounding of
//! the result is all the error there is.

mod common;
#[path = "common/scene.rs"]
mod scene;

use common::{Random, cases};
use impact_pair::exact::{Dyadic, Enclosure};
use impact_pair::number::kernel::Departure;
use impact_pair::number::{Ball, Magnitude, MpBall, Number};
use rug::float::Constant;
use rug::ops::Pow;
use rug::{Float, Rational};
use scene::float;
use std::cmp::Ordering;
use std::ops::RangeInclusive;

const PRECISIONS: [u32; 6] = [64, 65, 100, 128, 200, 521];
const BITS: u32 = 521;
/// Bits of the judge: differences of numbers at 2^+-60 keep four times the precision.
const WIDE: u32 = 4 * BITS + 256;

/// A number of `bits` random bits, of the order of a power of two in the range.
fn mantissa(random: &mut Random, bits: u32, exponents: RangeInclusive<i32>) -> Float {
    let choices = exponents.end() - exponents.start() + 1;
    let exponent = exponents.start() + random.below(choices as u64) as i32;
    let mut x = Float::with_val(bits, 1u32);
    for word in 1..=bits / 53 + 1 {
        let part: Float = Float::with_val(bits, random.bits() >> 11) >> (53 * word);
        x += part;
    }
    let signed = if random.below(2) == 0 { x } else { -x };
    signed << exponent
}

fn centre(random: &mut Random, range: i32) -> Float {
    let bits = PRECISIONS[random.below(6) as usize];
    let range = [4, 40.min(range), range][random.below(3) as usize];
    match random.below(12) {
        0 => Float::new(bits),
        1 => Float::with_val(bits, [1.0, -1.0, 0.5, 3.0][random.below(4) as usize]),
        _ => mantissa(random, bits, -range..=range),
    }
}

/// None, a few units in the last place, or a good part of the centre.
fn radius(random: &mut Random, mid: &Float) -> Magnitude {
    let fraction = random.uniform(1.0, 2.0);
    let exponent = mid.get_exp().map_or(-30, i64::from);
    match random.below(4) {
        0 => Magnitude::ZERO,
        1 => Magnitude::new(fraction, exponent - i64::from(mid.prec()) - 2 + random.below(6) as i64),
        2 => Magnitude::new(fraction, exponent - random.below(70) as i64),
        _ => Magnitude::new(fraction, exponent - 2),
    }
}

fn ball(random: &mut Random, range: i32) -> MpBall {
    let mid = centre(random, range);
    let rad = radius(random, &mid);
    MpBall::new(mid, rad)
}

/// The magnitude, exactly.
fn exact(x: Magnitude) -> Rational {
    let Some(exponent) = x.exponent() else { return Rational::new() };
    let fraction = Rational::from_f64(x.in_units_of(exponent)).expect("a finite magnitude");
    fraction * Rational::from(2).pow(i32::try_from(exponent).expect("an exponent of the test's"))
}

fn rational(x: &Float) -> Rational {
    x.to_rational().expect("a finite number")
}

/// Centre and both ends.
fn members(x: &MpBall) -> [Rational; 3] {
    let (mid, rad) = (rational(x.mid()), exact(x.rad()));
    [mid.clone(), mid.clone() - &rad, mid + rad]
}

fn assert_holds(ball: &MpBall, value: &Rational, what: &str, of: &[&MpBall]) {
    let distance = (rational(ball.mid()) - value).abs();
    assert!(!ball.rad().is_finite() || distance <= exact(ball.rad()), "{what} of {of:?}: {ball:?}");
}

/// The same for a judge that is itself rounded, by less than `2^-(4 bits)` relative to 1.
fn assert_near(ball: &MpBall, value: &Float, what: &str, of: &MpBall) {
    if !ball.rad().is_finite() {
        return;
    }
    let slack = Rational::from(2).pow(-(4 * BITS as i32));
    let distance = (rational(ball.mid()) - rational(value)).abs();
    assert!(distance <= exact(ball.rad()) + slack, "{what} of {of:?}: {ball:?}, but {value:.60}");
}

#[test]
fn field_operations_hold_the_results_of_their_members() {
    let mut random = Random::seeded(601);
    let (mut quotients, mut signs) = (0, 0);
    for _ in 0..cases(3000) {
        let [a, b, c] = [0; 3].map(|_| ball(&mut random, 2000));
        let of = [&a, &b, &c];
        let [sum, difference, product] = [a.clone() + b.clone(), a.clone() - b.clone(), a.clone() * b.clone()];
        let fused = a.clone().mul_add(b.clone(), c.clone());
        let quotient = a.clone().checked_div(b.clone());
        let bits = PRECISIONS[random.below(6) as usize];
        let rounded = a.rounded(bits);
        assert_eq!(rounded.bits(), bits);
        for p in members(&a) {
            assert_holds(&rounded, &p, "rounding", &of);
            assert_holds(&-a.clone(), &(-p.clone()), "negative", &of);
            assert_holds(&a.clone().signed(-1.0), &(-p.clone()), "negative", &of);
            assert!(exact(a.mag()) >= p.clone().abs(), "mag of {a:?}");
            assert!(a.mig().is_none_or(|mig| exact(mig) <= p.clone().abs()), "mig of {a:?}");
            if let Some(sign) = a.sign() {
                assert_eq!(sign, p.cmp0(), "{a:?}");
                signs += 1;
            }
            for q in members(&b) {
                assert_holds(&sum, &(p.clone() + &q), "sum", &of);
                assert_holds(&difference, &(p.clone() - &q), "difference", &of);
                assert_holds(&product, &(p.clone() * &q), "product", &of);
                if let Some(quotient) = &quotient {
                    assert_holds(quotient, &(p.clone() / &q), "quotient", &of);
                    quotients += 1;
                }
                for r in members(&c) {
                    assert_holds(&fused, &(p.clone() * &q + r), "fused product and sum", &of);
                }
            }
        }
    }
    println!("{quotients} quotients, {signs} signs");
    assert!(quotients > 9000 * cases(1) && signs > 4000 * cases(1));
}

#[test]
fn a_divisor_that_may_vanish_is_refused() {
    let one = MpBall::exact(Float::with_val(200, 1));
    for divisor in [
        MpBall::exact(Float::new(200)),
        MpBall::new(Float::with_val(200, 1), Magnitude::new(1.0, 0)),
        MpBall::new(Float::with_val(200, 1) >> 3000, Magnitude::power_of_two(-2999)),
        MpBall::new(Float::with_val(200, 1), Magnitude::INFINITE),
    ] {
        assert!(divisor.mig().is_none() && one.clone().checked_div(divisor).is_none());
    }
}

/// `f` of each member at the judge's precision.
fn seen(ball: &MpBall, f: impl Fn(Float) -> Float) -> [Float; 3] {
    members(ball).map(|member| f(Float::with_val(WIDE, member)))
}

fn two_pi() -> Float {
    Float::with_val(WIDE, Constant::Pi) * 2
}

/// Phases: small ones, quarter turns exactly or nearly, large ones.
fn phase(random: &mut Random) -> MpBall {
    let bits = PRECISIONS[random.below(6) as usize];
    let mid = match random.below(5) {
        0 => Float::with_val(bits, random.below(17) as f64 / 4.0 - 2.0),
        1 => {
            let off = mantissa(random, bits, -(bits as i32)..=0);
            Float::with_val(bits, random.below(9) as f64 / 4.0 - 1.0) + off
        }
        2 => mantissa(random, bits, -208..=-8),
        3 => mantissa(random, bits, 0..=39),
        _ => mantissa(random, bits, -2..=-2),
    };
    let rad = radius(random, &mid);
    MpBall::new(mid, rad)
}

#[test]
fn sines_and_cosines_hold_those_of_their_members() {
    let mut random = Random::seeded(602);
    let mut exact_ones = 0;
    for _ in 0..cases(4000) {
        let u = phase(&mut random);
        let (sin, cos) = u.sin_cos();
        for value in seen(&u, |x| (x * two_pi()).sin()) {
            assert_near(&sin, &value, "sine", &u);
        }
        for value in seen(&u, |x| (x * two_pi()).cos()) {
            assert_near(&cos, &value, "cosine", &u);
        }
        exact_ones += usize::from(sin.rad().is_zero());
    }
    println!("{exact_ones} exact ones");
    assert!(exact_ones > 20 * cases(1));
}

#[test]
fn quarter_turns_are_exact() {
    for bits in PRECISIONS {
        for quarter in -8..=8 {
            let (sin, cos) = MpBall::exact(Float::with_val(bits, quarter) / 4).sin_cos();
            let at = |shift: i32| [0.0, 1.0, 0.0, -1.0][(quarter + shift).rem_euclid(4) as usize];
            assert!(sin.rad().is_zero() && cos.rad().is_zero());
            assert!(*sin.mid() == at(0) && *cos.mid() == at(1), "{quarter}/4");
        }
    }
}

#[test]
fn arc_cosines_hold_those_of_their_members() {
    let mut random = Random::seeded(603);
    for _ in 0..cases(3000) {
        let bits = PRECISIONS[random.below(6) as usize];
        let mid = match random.below(4) {
            0 => Float::with_val(bits, [1.0, -1.0, 0.0, 0.5][random.below(4) as usize]),
            1 => {
                let off = mantissa(&mut random, bits, -(bits as i32)..=-2);
                Float::with_val(bits, if random.below(2) == 0 { 1 - off.abs() } else { off.abs() - 1 })
            }
            _ => mantissa(&mut random, bits, -9..=-1),
        };
        let rad = radius(&mut random, &mid);
        let q = MpBall::new(mid, rad);
        let angle = q.acos();
        for member in members(&q).into_iter().filter(|q| q.clone().abs() <= 1) {
            let value = Float::with_val(WIDE, member).acos() / two_pi();
            assert_near(&angle, &value, "arc cosine", &q);
        }
    }
}

#[test]
fn short_departures_hold_versine_excess_and_sine() {
    let mut random = Random::seeded(604);
    let mut refused = 0;
    for _ in 0..cases(3000) {
        let bits = PRECISIONS[random.below(6) as usize];
        let mid = match random.below(8) {
            0 => Float::new(bits),
            1 => Float::with_val(bits, 1) >> 6,
            2 => mantissa(&mut random, bits, -606..=-7),
            _ => mantissa(&mut random, bits, -66..=-7),
        };
        let rad = radius(&mut random, &mid);
        let h = MpBall::new(mid, rad);
        let Some(Departure { versine, excess, sine }) = h.short_departure() else {
            refused += 1;
            assert!(exact(h.mag()) > Rational::from((1, 64)), "{h:?}");
            continue;
        };
        // 1 - cos x = 2 sin^2(x/2) loses nothing.
        for value in seen(&h, |h| Float::with_val(WIDE, (h * two_pi() / 2u32).sin().square()) * 2u32) {
            assert_near(&versine, &value, "versine", &h);
            assert_relative(&versine, &value, "versine", &h);
        }
        for value in seen(&h, |h| (h * two_pi()).sin()) {
            assert_near(&sine, &value, "sine", &h);
            assert_relative(&sine, &value, "sine", &h);
        }
        for value in seen(&h, |h| {
            let angle = h * two_pi();
            angle.clone() - angle.sin()
        }) {
            assert_near(&excess, &value, "excess", &h);
        }
    }
    println!("{refused} are not short");
}

/// The same where the value is far below 1: the judge's own rounding is relative.
fn assert_relative(ball: &MpBall, value: &Float, what: &str, of: &MpBall) {
    let slack = rational(value).abs() * Rational::from(2).pow(8 - WIDE as i32);
    let distance = (rational(ball.mid()) - rational(value)).abs();
    assert!(distance <= exact(ball.rad()) + slack, "{what} of {of:?}: {ball:?}, but {value:.60}");
}

#[test]
fn conversions_hold_what_they_convert() {
    let mut random = Random::seeded(605);
    for _ in 0..cases(4000) {
        let x = ball(&mut random, 2000);
        let doubles = x.to_ball();
        if doubles.mid().is_finite() && doubles.rad().is_finite() {
            let back = MpBall::from_ball(doubles);
            for member in members(&x) {
                assert_holds(&back, &member, "double ball", &[&x]);
            }
            assert!(back.contains(&x) || x.rad().is_zero(), "{back:?} does not contain {x:?}");
        } else {
            assert!(x.mid().get_exp().is_some_and(|exponent| exponent > 1000), "{x:?} as {doubles:?}");
        }
        let enclosure = x.enclosure().expect("a finite ball");
        let (low, high) = (rational(&float(enclosure.lo())), rational(&float(enclosure.hi())));
        let [_, from, to] = members(&x);
        assert!(low <= from && to <= high, "{x:?} in {enclosure:?}");
        let bits = PRECISIONS[random.below(6) as usize];
        let back = MpBall::enclosing(&enclosure, bits);
        assert_eq!(back.bits(), bits);
        for end in [low, high, from, to] {
            assert_holds(&back, &end, "enclosure", &[&x]);
        }
        // Neither way makes it much wider than it was, its own rounding apart.
        let rounding = back
            .mid()
            .get_exp()
            .map_or(Magnitude::ZERO, |exponent| Magnitude::power_of_two(i64::from(exponent) - i64::from(bits)));
        assert!(exact(back.rad()) <= (exact(x.rad()) + exact(rounding)) * Rational::from((5, 4)), "{x:?} as {back:?}");
    }
}

#[test]
fn enclosures_from_outside_are_held() {
    let mut random = Random::seeded(606);
    for _ in 0..cases(4000) {
        let mut end =
            || Dyadic::new((random.bits() as i64 >> random.below(63)).into(), random.below(4000) as i64 - 2000);
        let (a, b) = (end(), end());
        let (low, high) = if a <= b { (a, b) } else { (b, a) };
        let ends = [&low, &high].map(|end| rational(&float(end)));
        let enclosure = Enclosure::new(low, high).expect("in order");
        for bits in PRECISIONS {
            let ball = MpBall::enclosing(&enclosure, bits);
            for end in &ends {
                assert_holds(&ball, end, "enclosure", &[]);
            }
        }
    }
}

#[test]
fn containing_is_never_claimed_wrongly() {
    let mut random = Random::seeded(607);
    let (mut yes, mut no) = (0, 0);
    for _ in 0..cases(4000) {
        let outer = ball(&mut random, 60);
        let mid = match random.below(3) {
            0 => outer.mid().clone(),
            1 => Float::with_val(600, outer.mid() + Float::with_val(64, outer.mid()) * 1e-9),
            _ => centre(&mut random, 60),
        };
        let rad = radius(&mut random, &mid);
        let inner = MpBall::new(mid, rad);
        if outer.contains(&inner) {
            yes += 1;
            for member in members(&inner) {
                assert_holds(&outer, &member, "contains", &[&outer, &inner]);
            }
        } else {
            no += 1;
        }
    }
    assert!(yes > 100 && no > 100, "{yes} {no}");
}

#[test]
fn a_ball_without_a_bound_decides_nothing() {
    for x in [
        MpBall::new(Float::with_val(100, 3), Magnitude::INFINITE),
        MpBall::from_ball(Ball::new(f64::NAN, 0.0)),
        MpBall::from_ball(Ball::new(f64::INFINITY, 1.0)),
        MpBall::from_ball(Ball::new(1.0, f64::NAN)),
    ] {
        assert!(x.sign().is_none() && x.mig().is_none() && x.enclosure().is_none(), "{x:?}");
        assert!(!x.acos().rad().is_finite() && x.short_departure().is_none());
        assert!(!x.to_ball().rad().is_finite() && !x.sin_cos().0.rad().is_finite());
        assert!((x.clone() * x.clone()).sign() != Some(Ordering::Greater));
        assert!(!(x.clone() - x).rad().is_finite());
    }
}
