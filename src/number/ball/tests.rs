//! Lemma B2 and the kernel on balls, against intervals of 320 bits.

use super::*;
use crate::number::tests::{Truth, balls, member, places, powers};
use proptest::prelude::*;

/// Phases within and beyond the kernel's domain, often quarter periods.
fn phases() -> impl Strategy<Value = f64> {
    let far = powers(0.0, 12.6).prop_map(f64::round);
    let near = prop_oneof![Just(0.0), -1.0..1.0f64, powers(-300.0, -1.0), (-8..8i32).prop_map(|k| f64::from(k) / 8.0)];
    (near, prop_oneof![3 => Just(0.0), 1 => far]).prop_map(|(near, far)| near + far)
}

#[test]
fn a_radius_is_a_size() {
    let one = |rad| Ball::new(0.0, rad);
    assert!((one(1.0) + one(-1.0)).rad() >= 2.0 && one(-1.0).certain_sign().is_none());
    assert!(one(1.0).widened(-1.0).rad() >= 2.0 && one(1.0).with_radius(-3.0).rad() >= 3.0);
    assert_eq!(super::super::Magnitude::new(-1.0, 3), super::super::Magnitude::new(1.0, 3));
}

proptest! {
    #[test]
    fn operations_hold_the_results_of_their_members(
        [x, y, z] in [balls(), balls(), balls()], [i, j, k] in [places(), places(), places()], by in powers(-330.0, 5.0),
    ) {
        let (a, b, c) = (member(&x, i), member(&y, j), member(&z, k));
        prop_assert!((&a + &b).is_in(&(x + y)), "{x:?} + {y:?}");
        prop_assert!((&a - &b).is_in(&(x - y)), "{x:?} - {y:?}");
        prop_assert!((&a * &b).is_in(&(x * y)), "{x:?} * {y:?}");
        prop_assert!((&a * &b + &c).is_in(&x.mul_add(y, z)), "{x:?} * {y:?} + {z:?}");
        prop_assert!((&c - &a * &b).is_in(&x.mul_sub_ref(&y, z)), "{z:?} - {x:?} * {y:?}");
        prop_assert!((-a.clone()).is_in(&-x) && (-a.clone()).is_in(&x.signed(-1.0)) && a.is_in(&x.signed(1.0)));
        match x.checked_div(y) {
            Some(quotient) => prop_assert!(a.over(&b).unwrap().is_in(&quotient), "{x:?} / {y:?}"),
            None => prop_assert!(y.mid().abs() <= y.rad() * (1.0 + 1e-15) + 2.0 * TINY, "{y:?} is not 0"),
        }
        prop_assert!((&a + Truth::from(by) * j).is_in(&x.widened(by)), "{x:?} with {by:e} around");
        prop_assert!(!a.abs().exceeds(x.mag().min(f64::MAX)) || x.mag().is_infinite(), "{x:?}");
        prop_assert!(Truth::turn().is_in(&x.turn()) && (Truth::turn() * &a).is_in(&(x.turn() * x)));
    }

    /// Lemma B1: where products and quotients, of centres or in a radius, leave the normal doubles.
    #[test]
    fn underflow_is_enclosed(
        [a, b] in [powers(-170.0, -150.0), powers(-170.0, -150.0)], small in powers(-322.0, -250.0), divisor in powers(-250.0, -150.0),
        [r, s] in [prop_oneof![Just(0.0), powers(-323.0, -160.0)], prop_oneof![Just(0.0), powers(-323.0, -250.0)]], [i, j] in [places(), places()],
    ) {
        let (x, y) = (Ball::new(a, r), Ball::new(b, s));
        prop_assert!((member(&x, i) * member(&y, j)).is_in(&(x * y)), "{x:?} * {y:?}");
        for (x, y) in [(Ball::exact(small), Ball::new(divisor, s)), (Ball::exact(small), Ball::exact(1.0 / a))] {
            let Some(quotient) = x.checked_div(y) else { continue };
            prop_assert!(member(&x, i).over(&member(&y, j)).unwrap().is_in(&quotient), "{x:?} / {y:?}");
        }
    }

    #[test]
    fn decisions_hold_for_all_members([x, y] in [balls(), balls()], [i, j] in [places(), places()], by in -2.0..2.0f64) {
        let a = member(&x, i);
        match x.certain_sign() {
            Some(Ordering::Greater) => prop_assert!(!Truth::from(0.0).exceeds(&a) && a.0.sup().sign().is_gt()),
            Some(Ordering::Less) => prop_assert!(!a.exceeds(0.0) && a.0.inf().sign().is_lt()),
            Some(Ordering::Equal) => prop_assert!(x == Ball::exact(x.mid()) && x.mid() == 0.0),
            None => prop_assert!(x.rad() >= x.mid().abs()),
        }
        // One whose centre is N radii away and whose end is next to the end.
        let other = Ball::new(x.mid() + by * x.rad(), (1.0 - by.abs()).abs() * x.rad());
        for inner in [y, other] {
            if inner.is_interior_to(&x) {
                let end = member(&inner, j);
                prop_assert!(!(&end - member(&x, 0.0)).abs().exceeds(x.rad()), "{inner:?} in {x:?}");
                prop_assert!((&end - member(&x, 0.0)).abs().0.inf().to_f64_down() < x.rad(), "{inner:?} in {x:?}");
            }
        }
    }

    #[test]
    fn sine_and_cosine_hold_those_of_every_phase(mid in phases(), rad in prop_oneof![Just(0.0), powers(-323.0, 1.0)], i in places()) {
        let x = Ball::new(mid, rad);
        let ((s, c), (sin, cos)) = (x.sin_cos(), member(&x, i).sin_cos());
        prop_assert!(sin.is_in(&s) && cos.is_in(&c), "{x:?}: {s:?} {c:?}");
        prop_assert!(s.rad() <= 1e-15 + 6.4 * rad || mid.abs() > 1e12, "{x:?}: {s:?}");
    }

    /// Versine, excess and sine: nothing cancels, down to the flights that 320 bits can judge.
    #[test]
    fn short_departures_hold_those_of_every_time(mid in powers(-35.0, -0.9), rad in prop_oneof![Just(0.0), powers(-30.0, 0.5)], i in places()) {
        let x = Ball::new(mid, rad * mid);
        let Some(found) = x.short() else {
            prop_assert!(x.mag() > 0.1249);
            return Ok(());
        };
        let h = member(&x, i);
        let (sin, cos) = h.sin_cos();
        prop_assert!((-cos + 1.0).is_in(&found.versine), "{x:?}");
        prop_assert!((h * Truth::turn() - &sin).is_in(&found.excess), "{x:?}");
        prop_assert!(sin.is_in(&found.sine), "{x:?}");
    }
}

#[test]
fn the_binade_times_the_unit_is_half_an_ulp() {
    for x in [1.0, 1.5, -0.7, 3.9, 1e-300, -1e300] {
        assert_eq!(UNIT * binade(x), 0.5 * (f64::abs(x).next_up() - f64::abs(x)), "{x}");
    }
    assert_eq!(binade(0.0), 0.0);
}

#[test]
fn beyond_the_kernels_domain_nothing_is_known_of_sine_and_cosine() {
    // A quarter period and half a period: cosines 0 and -1.
    for (phase, sin, cos) in [(2f64.powi(50) + 0.25, 1.0, 0.0), (2f64.powi(51) + 0.5, 0.0, -1.0), (f64::NAN, 0.0, 0.0)]
    {
        let (s, c) = Ball::exact(phase).sin_cos();
        assert!((sin - s.mid).abs() <= s.rad && (cos - c.mid).abs() <= c.rad, "{phase}: {s:?} {c:?}");
    }
}

#[test]
fn a_divisor_that_may_vanish_is_refused() {
    assert!(Ball::exact(1.0).checked_div(Ball::new(1e-3, 1e-3)).is_none());
    assert!(Ball::exact(1.0).checked_div(Ball::exact(0.0)).is_none());
}

#[test]
fn bounds_are_what_they_are_called() {
    assert_eq!(LARGEST_RATE, 2f64.powi(400));
    assert!(ABOVE_TWO_PI > std::f64::consts::TAU.next_up());
}

proptest! {
    #[test]
    fn an_exact_number_lies_in_its_ball(n in -1_000_000_000_000_000_000i64.., d in 1..i64::MAX, e in -200..200i32) {
        let number = crate::exact::Exact::parse(&format!("{n}/{d} * 2^{e}")).unwrap();
        let ball = Ball::of(&number);
        let exact = |x: f64| num_rational::BigRational::from_float(x).unwrap();
        let distance = number.as_rational().unwrap() - exact(ball.mid());
        prop_assert!(num_traits::Signed::abs(&distance) <= exact(ball.rad()));
        prop_assert!(ball.rad() <= 2.0 * UNIT * ball.mid().abs());
    }
}
