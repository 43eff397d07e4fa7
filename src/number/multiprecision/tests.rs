//! Lemmas M1 and M2, against intervals of 320 bits, which share nothing with balls but their integers.

use super::*;
use crate::number::tests::{Truth, balls, doubles, member, places, powers};
use proptest::prelude::*;

/// Radii from nothing to far beyond the centre, and far below doubles.
fn magnitudes() -> impl Strategy<Value = Magnitude> {
    prop_oneof![
        1 => Just(Magnitude::ZERO),
        4 => (1.0..2.0f64, -250..2i64).prop_map(|(x, e)| Magnitude::new(x, e)),
        1 => (1.0..2.0f64, -3000..40i64).prop_map(|(x, e)| Magnitude::new(x, e)),
    ]
}

/// Balls whose centres use all their bits, often whole numbers of eighths.
fn mp_balls() -> impl Strategy<Value = MpBall> {
    let bits = prop_oneof![Just(53u32), Just(64), Just(65), Just(113), Just(200)];
    (doubles(), 1..=3i64, bits, magnitudes())
        .prop_map(|(x, n, bits, rad)| MpBall::new(Float::new(x).over(&Float::whole(n), bits), rad))
}

/// The same, often of the order of 2^+-40 or 2^+-2000, often a few units in the last place wide.
fn far_balls() -> impl Strategy<Value = MpBall> {
    let exponent = prop_oneof![3 => Just(0), 2 => -40..40i64, 1 => -2000..2000i64];
    (mp_balls(), exponent, prop_oneof![Just(None), (1.0..2.0f64, -2..4i64).prop_map(Some)]).prop_map(
        |(x, by, units)| {
            let rad = match (units, x.mid.top()) {
                (Some((fraction, units)), Some(top)) => Magnitude::new(fraction, top - i64::from(x.bits()) + units),
                _ => x.rad,
            };
            MpBall { mid: x.mid.scaled(by), rad: rad * Magnitude::power_of_two(by) }
        },
    )
}

/// The same within a few periods, or near quarter periods.
fn angles() -> impl Strategy<Value = MpBall> {
    let near = (-9..9i32, prop_oneof![Just(0.0), powers(-60.0, -1.0)]);
    prop_oneof![
        (mp_balls(), near).prop_map(|(x, (k, off))| {
            let mid = Float::new(f64::from(k) / 4.0).plus(&Float::new(off), x.bits());
            MpBall { mid, rad: x.rad }
        }),
        mp_balls(),
    ]
}

proptest! {
    #[test]
    fn operations_hold_the_results_of_their_members(
        [x, y, z] in [far_balls(), far_balls(), far_balls()], [i, j, k] in [places(), places(), places()], n in 1..40u32,
    ) {
        let (a, b, c) = (member(&x, i), member(&y, j), member(&z, k));
        prop_assert!((&a + &b).is_in(&(x.clone() + y.clone())), "{x:?} + {y:?}");
        prop_assert!((&a - &b).is_in(&(x.clone() - y.clone())), "{x:?} - {y:?}");
        prop_assert!((&a * &b).is_in(&(x.clone() * y.clone())), "{x:?} * {y:?}");
        prop_assert!((&a * &b + &c).is_in(&x.clone().mul_add(y.clone(), z.clone())), "{x:?} * {y:?} + {z:?}");
        prop_assert!((&a * &b + &c).is_in(&x.mul_add_ref(&y, z.clone())), "{x:?} * {y:?} + {z:?}");
        prop_assert!((&c - &a * &b).is_in(&x.mul_sub_ref(&y, z.clone())), "{z:?} - {x:?} * {y:?}");
        prop_assert!((&a - &b).is_in(&x.clone().minus(&y)) && (&a * &b).is_in(&x.clone().times(&y)));
        prop_assert!((-a.clone()).is_in(&-x.clone()) && (-a.clone()).is_in(&x.clone().signed(-1.0)));
        match x.clone().checked_div(y.clone()) {
            Some(quotient) => prop_assert!(a.over(&b).unwrap().is_in(&quotient), "{x:?} / {y:?}"),
            None => prop_assert!(y.mig().is_none()),
        }
        prop_assert!(a.over(&f64::from(n).into()).unwrap().is_in(&x.clone().divided(n)), "{x:?} / {n}");
        prop_assert!((Truth::turn() * &a).is_in(&(x.turn() * x.clone())), "a turn of {x:?}");
        prop_assert!((&a + member(&y.spread(), j)).is_in(&x.clone().widened(y.rad())), "{x:?}");
    }

    #[test]
    fn conversions_hold_all_members([x, y] in [far_balls(), far_balls()], d in balls(), i in places(), bits in 53..220u32) {
        let a = member(&x, i);
        prop_assert!(a.is_in(&x.to_ball()), "{x:?}: {:?}", x.to_ball());
        prop_assert!(a.is_in(&x.rounded(bits)), "{x:?} at {bits} bits");
        prop_assert!(member(&d, i).is_in(&MpBall::from_ball(d)), "{d:?}");
        // An interval of which nothing is known but its ends: those of two balls.
        let ends = x.enclosure().unwrap().hull(&y.enclosure().unwrap());
        let found = MpBall::enclosing(&ends, bits);
        for end in [&ends, &Enclosure::point(ends.inf().clone()), &Enclosure::point(ends.sup().clone())] {
            prop_assert!(found.enclosure().unwrap().contains_enclosure(end), "{x:?}, {y:?}: {found:?}");
        }
        // There and back makes it no wider than a quarter more, its own rounding apart.
        let back = MpBall::enclosing(&x.enclosure().unwrap(), bits);
        let rounding = back.mid.top().map_or(Magnitude::ZERO, |top| Magnitude::power_of_two(top - i64::from(bits)));
        prop_assert!(back.bits() == bits && back.rad <= (x.rad + rounding) * Magnitude::new(1.25, 0), "{x:?}: {back:?}");
        // Numbers that doubles hold have the same enclosure in both arithmetics.
        if d.rad() == 0.0 || d.rad() > 1e-300 {
            let [here, there] = [d.enclosure().unwrap(), MpBall::from_ball(d).enclosure().unwrap()];
            prop_assert!(here.contains_enclosure(&there) , "{d:?}");
        }
    }

    #[test]
    fn decisions_hold_for_all_members([x, y] in [mp_balls(), mp_balls()], [i, j] in [places(), places()], by in -2.0..2.0f64) {
        let a = member(&x, i);
        match x.sign() {
            Some(Ordering::Greater) => prop_assert!(a.0.sup().sign().is_gt(), "{x:?}"),
            Some(Ordering::Less) => prop_assert!(a.0.inf().sign().is_lt(), "{x:?}"),
            Some(Ordering::Equal) => prop_assert!(x.mid.is_zero() && x.rad.is_zero()),
            None => prop_assert!(!x.rad.is_zero()),
        }
        let bound = |x: Magnitude| member(&MpBall::new(Float::zero(53), x), 1.0);
        prop_assert!(!a.abs().exceeds(bound(x.mag())), "{x:?}");
        if let Some(least) = x.mig() {
            prop_assert!(!bound(least).exceeds(a.abs()), "{x:?}");
        }
        // One whose centre is N radii away and whose end is next to the end.
        let shift = Float::new(by).times(&Float::new(x.rad.to_f64()), 60);
        let rest = Magnitude::new((1.0 - by.abs()).abs(), 0) * x.rad;
        let other = MpBall::new(x.mid.plus(&shift, 260), rest);
        for inner in [&y, &other] {
            let end = member(inner, j);
            let away = (&end - member(&x, 0.0)).abs();
            if x.contains(inner) {
                prop_assert!(!away.exceeds(bound(x.rad)), "{inner:?} in {x:?}");
            }
            if inner.is_interior_to(&x) {
                prop_assert!(away.0.inf() < bound(x.rad).0.inf(), "{inner:?} in {x:?}");
            }
        }
    }

    #[test]
    fn sine_and_cosine_hold_those_of_every_phase(x in angles(), i in places()) {
        let ((s, c), (sin, cos)) = (x.sin_cos(), member(&x, i).sin_cos());
        prop_assert!(sin.is_in(&s) && cos.is_in(&c), "{x:?}: {s:?} {c:?}");
    }

    /// By the cosine of what is found, as the cosine falls on half a period.
    #[test]
    fn the_arc_cosine_holds_those_of_every_member(x in mp_balls(), edge in prop_oneof![Just(0.0), powers(-60.0, 0.0)], i in places()) {
        // As it is, and next to 1 and -1.
        let near = |one: f64| MpBall { mid: Float::new(one).minus(&Float::new(edge * one), x.bits()), rad: x.rad };
        for x in [x.clone(), near(1.0), near(-1.0)] {
            let q = member(&x, i);
            if q.abs().exceeds(1.0) {
                continue;
            }
            let found = x.acos().enclosure().expect("a finite ball");
            let half = Enclosure::from_f64_bounds(0.0, 0.5).unwrap();
            let inside = found.intersection(&half).expect("an angle from 0 to half a turn");
            let [most, least] = [inside.inf(), inside.sup()].map(|end| Truth(Enclosure::point(end.clone())).sin_cos().1);
            prop_assert!(!q.exceeds(most) && !least.exceeds(&q), "{x:?}: {found:?}");
        }
    }

    #[test]
    fn short_departures_hold_those_of_every_time(x in mp_balls(), size in powers(-30.0, -1.8), i in places()) {
        let bits = x.bits();
        let mid = if x.mid.clone().abs() > 1.0 { Float::new(1.0) } else { x.mid }.times(&Float::new(size), bits);
        let x = MpBall { mid, rad: x.rad };
        let Some(found) = x.short_departure() else {
            prop_assert!(x.mag() > Magnitude::power_of_two(-6));
            return Ok(());
        };
        let h = member(&x, i);
        let (sin, cos) = h.sin_cos();
        prop_assert!((-cos + 1.0).is_in(&found.versine), "{x:?}: {found:?}");
        prop_assert!((h * Truth::turn() - &sin).is_in(&found.excess), "{x:?}: {found:?}");
        prop_assert!(sin.is_in(&found.sine), "{x:?}: {found:?}");
    }
}

#[test]
fn quarter_periods_are_exact() {
    for (k, bits) in (-8..=8).flat_map(|k| [53, 64, 65, 521].map(|bits| (k, bits))) {
        let (sin, cos) = MpBall::exact(Float::whole(k).scaled(-2).rounded(bits)).sin_cos();
        let at = |shift: i32| [0.0, 1.0, 0.0, -1.0][(k as i32 + shift).rem_euclid(4) as usize];
        assert!(sin.rad.is_zero() && cos.rad.is_zero() && sin.mid == at(0) && cos.mid == at(1), "{k}/4");
    }
}

#[test]
fn a_divisor_that_may_vanish_is_refused() {
    let one = || Float::with_bits(1.0, 200);
    for (mid, rad) in [
        (Float::zero(200), Magnitude::ZERO),
        (one(), Magnitude::new(1.0, 0)),
        (one().scaled(-3000), Magnitude::power_of_two(-2999)),
        (one(), Magnitude::INFINITE),
    ] {
        let divisor = MpBall::new(mid, rad);
        assert!(divisor.mig().is_none() && MpBall::exact(one()).checked_div(divisor).is_none());
    }
}

#[test]
fn a_ball_without_a_bound_decides_nothing() {
    for x in [
        MpBall::new(Float::with_bits(3.0, 100), Magnitude::INFINITE),
        MpBall::exact(Float::new(1.0).over(&Float::new(0.0), 100)),
        MpBall::from_ball(Ball::new(f64::NAN, 0.0)),
        MpBall::from_ball(Ball::new(f64::INFINITY, 1.0)),
        MpBall::from_ball(Ball::new(1.0, f64::NAN)),
    ] {
        assert!(x.sign().is_none() && x.mig().is_none() && x.enclosure().is_none(), "{x:?}");
        assert!(!x.acos().rad.is_finite() && x.short_departure().is_none());
        assert!(!x.to_ball().rad().is_finite() && !x.sin_cos().0.rad.is_finite());
        assert!((x.clone() * x.clone()).sign() != Some(Ordering::Greater));
        assert!(!(x.clone() - x).rad.is_finite());
    }
}

/// Lemma M1 where it is easy to miss: a number far below another still decides how their sum is rounded.
#[test]
fn sums_of_far_apart_numbers_need_no_memory_and_are_never_exact() {
    let one = Float::new(1.0);
    for far in [-60, -200, -1_000_000_000i64] {
        for tiny in [Float::new(1.0).scaled(far), Float::new(-1.0).scaled(far)] {
            let (below, _) = one.clone().add(&tiny, 40, Round::Down);
            let (above, is_exact) = one.clone().add(&tiny, 40, Round::Up);
            let is_negative = tiny < 0.0;
            assert!(!is_exact && below < above && (below < 1.0) == is_negative && (above > 1.0) != is_negative);
            let (middle, is_exact) = tiny.clone().sub(&one.rounded(40), 40, Round::Nearest);
            assert!(!is_exact && middle == -1.0);
            // Half of the last bit, and less or more than that.
            let half = Float::new(1.0).plus(&one.clone().scaled(-40), 60);
            let (found, is_exact) = half.add(&tiny, 40, Round::Nearest);
            assert!(!is_exact && (found == 1.0) == is_negative, "{far} {found:?}");
        }
    }
    let huge = one.clone().scaled(1 << 39);
    assert!(!huge.times(&huge, 64).times(&huge, 64).is_number() && huge.scaled(1 << 41).top().is_none());
}

#[test]
fn results_that_fit_are_exact_and_others_say_so() {
    let [three, third] = [Float::new(3.0), Float::new(1.0).over(&Float::new(3.0), 64)];
    assert!(Float::new(6.0).div(&three, 2).1 && !Float::new(1.0).div(&three, 1000).1);
    assert!(three.mul(&three, 4).1 && !three.mul(&three, 3).1 && !third.mul(&third, 64).1 && third.mul(&third, 128).1);
    assert!(three.clone().div_whole(3, 1).1 && !three.clone().div_whole(7, 400).1);
    assert!(third.clone().sub(&third, 1, Round::Nearest) == (Float::zero(1), true));
    assert!(third.fused(&three, true, &Float::new(1.0), 200).1 && Float::new(2.25).sqrt(60) == 1.5);
    assert!(Float::new(-1.0).sqrt(60).sign().is_none() && three.div(&Float::new(0.0), 60).0.sign().is_none());
}

/// Whole numbers near one, of doubles that hold halves, and of numbers of more bits.
#[test]
fn whole_numbers_are_those_of_doubles() {
    for k in -40..=40 {
        for x in [
            f64::from(k) / 8.0,
            f64::from(k) / 8.0 + 2f64.powi(-40),
            f64::from(k) * 2f64.powi(-60),
            f64::from(k) * 1e20,
        ] {
            let number = Float::new(x);
            assert!(number.floor() == x.floor() && number.ceil() == x.ceil() && number.round() == x.round(), "{x}");
            assert!(number.to_f64() == x && number == x && number.magnitude() == Magnitude::new(x, 0), "{x}");
        }
    }
}
