//! Isolation, refinement and the way past a graze, against single flights in 320 bits: flights whose first maximum is
//! `10^-1` to `10^-40` from the far wall, on either side, and those of the tests in doubles.

use super::*;
use crate::contact::PairBounds;
use crate::contact::tests::{TrueFlight, assert_first, cases};
use crate::number::Number;
use crate::number::tests::{Truth, member, places, powers};
use crate::pair::Reduced;
use proptest::prelude::*;
use std::cmp::Ordering;

/// A flight in balls: a member's, with these bits and this radius of the velocity.
fn flight_of(truth: &TrueFlight, bits: u32, radius: Magnitude) -> Flight<MpBall> {
    let ball = |x: &Truth| MpBall::enclosing(&x.0, bits);
    let alpha = ball(&truth.alpha);
    let pair = Reduced::new(alpha, MpBall::from_f64(0.5));
    let (phase, velocity) = (ball(&truth.phase), ball(&truth.velocity).widened(radius));
    let sin_cos = phase.sin_cos();
    // A height of 0 is the wall.
    if truth.height.0.is_point() && truth.height.0.inf().is_zero() {
        Flight::from_wall(&pair, truth.wall, phase, velocity, sin_cos)
    } else {
        Flight::from_inside(&pair, ball(&truth.height), phase, velocity, sin_cos)
    }
}

/// A flight from a wall whose first maximum is `room` below the other one, and when it comes.
#[derive(Clone, Debug)]
struct Grazing {
    truth: TrueFlight,
    time: Truth,
    room: f64,
}

/// All is proportional to `A/d` when the graze is to be at `cos th = cos 2 pi p`, a maximum.
fn grazing() -> impl Strategy<Value = Grazing> {
    let wall = prop_oneof![Just(Wall::Left), Just(Wall::Right)];
    // Multiples of 2^-20 below and above a quarter period; the start is on the rising piece.
    let room = (powers(-40.0, -1.0), any::<bool>()).prop_map(|(x, beyond)| if beyond { -x } else { x });
    (wall, 40_000..480_000u32, 0.02..0.98f64, room).prop_map(|(wall, p, part, room)| {
        let unit = 0.5f64.powi(20);
        let p = f64::from(p) * unit;
        let time = (part * (1.0 - 2.0 * p) / unit).ceil() * unit;
        let start = 1.0 - p - time;
        let [(sin, cos), (sin_start, cos_start)] = [p, start].map(|u| Truth::from(u).sin_cos());
        // z = c h - alpha (sin th1 - sin th0) with c = beta cos 2 pi p and sin th1 = -sin 2 pi p.
        let rise = Truth::turn() * &cos * time + &sin + sin_start;
        let alpha = (Truth::from(1.0) - room).over(&rise).expect("a rise");
        let velocity = Truth::turn() * &alpha * (cos - cos_start);
        let phase = Truth::from(start - wall.mirror_phase());
        let truth = TrueFlight { alpha: alpha.point(), wall, phase, velocity: velocity.point(), height: 0.0.into() };
        Grazing { truth, time: time.into(), room }
    })
}

/// Asserts that the contact of the member is isolated here.
fn assert_isolated(found: &Isolated, truth: &TrueFlight) -> Result<Truth, TestCaseError> {
    let at = |place: f64| member(&MpBall::new(found.at.clone(), found.reach), place) + found.turns - &truth.phase;
    let target = found.target.height();
    let time = truth.contact(target, &at(0.0));
    let phase = &truth.phase + &time - found.turns;
    prop_assert!(phase.is_in(&MpBall::new(found.at.clone(), found.reach)), "{found:?}");
    prop_assert!(time.is_in(&found.time) && truth.velocity_at(&time).is_in(&found.velocity), "{found:?}");
    prop_assert!(truth.sin_cos(&time).0.is_in(&found.sin), "{found:?}");
    let least = member(&MpBall::new(Float::zero(53), found.least), 1.0);
    for place in [-1.0, -0.3, 0.0, 1.0] {
        prop_assert!(!least.exceeds(truth.velocity_at(&at(place)).abs()), "{found:?}");
    }
    Ok(time)
}

/// Asserts that the refined contact holds the member's.
fn assert_refined(
    isolated: &Isolated,
    flight: &Flight<MpBall>,
    truth: &TrueFlight,
    bits: u32,
) -> Result<(), TestCaseError> {
    let Some(found) = isolated.refine(flight, bits) else { return Ok(()) };
    let at = Truth(MpBall::exact(found.at.clone()).enclosure().expect("a finite number"));
    let time = &at + isolated.turns - &truth.phase;
    let contact = truth.contact(isolated.target.height(), &time);
    let phase = &truth.phase + contact - isolated.turns;
    prop_assert!(phase.is_in(&MpBall::new(found.at.clone(), found.error)), "{found:?}");
    prop_assert!(truth.velocity_at(&time).is_in(&found.velocity), "{found:?}");
    let (sin, cos) = truth.sin_cos(&time);
    prop_assert!(sin.is_in(&found.sin_cos.0) && cos.is_in(&found.sin_cos.1), "{found:?}");
    prop_assert!(found.at.bits() == bits);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// By doubles where they can, else by balls: with 200 bits nearly all is decided, and right.
    #[test]
    fn isolated_contacts_are_those_of_every_member(case in cases(), bits in prop_oneof![Just(64u32), Just(200)]) {
        let margins = case.margins();
        let doubles = PairBounds { pair: case.pair, centre: case.pair.centre(), margins };
        let [height, phase, velocity] = [
            Ball::new(case.inside.unwrap_or(0.0), if case.inside.is_some() { case.radii.height } else { 0.0 }),
            Ball::new(case.phase, case.radii.phase),
            Ball::new(case.velocity, case.radii.velocity),
        ];
        let wall = if case.inside.is_some() { None } else { Some(case.wall) };
        let start = match wall {
            Some(wall) => Launch::from_wall(wall, 0, phase, wall.inward(velocity), false),
            None => Launch::from_inside(height, 0, phase, velocity),
        };
        let set = case.pair.map(|x| MpBall::from_ball(*x));
        let all = || {
            let [height, phase, velocity] = [height, phase, velocity].map(|x| MpBall::from_ball(x).rounded(bits));
            let sin_cos = phase.sin_cos();
            match wall {
                Some(wall) => Flight::from_wall(&set, wall, phase, velocity, sin_cos),
                None => Flight::from_inside(&set, height, phase, velocity, sin_cos),
            }
        };
        let (truth, centre) = (case.truth(), flight_of(&case.truth_at([0.0; 4]), bits, Magnitude::ZERO));
        for found in [isolate_first(&doubles, &start, all, &centre), isolate::isolate(&all())] {
            let Ok(found) = found else { continue };
            let time = assert_isolated(&found, &truth)?;
            let contact = found.contact(truth.wall);
            prop_assert!(!time.exceeds(assert_first(&truth, &contact)?));
            assert_refined(&found, &all(), &truth, 128)?;
            assert_refined(&found, &flight_of(&truth, bits, Magnitude::ZERO), &truth, bits)?;
        }
    }

    /// Lemmas C3 and C4 where doubles tell nothing: 300 bits see on which side of the wall the maximum is.
    #[test]
    fn a_maximum_near_the_wall_is_distinguished_from_a_touch(Grazing { truth, time, room } in grazing()) {
        for bits in [64, 128, 300] {
            let found = isolate::isolate(&flight_of(&truth, bits, Magnitude::ZERO));
            let Ok(found) = found else {
                prop_assert!(bits < 300, "{found:?}");
                continue;
            };
            let contact = assert_isolated(&found, &truth)?;
            if room < 0.0 {
                prop_assert!(found.target == Target::Far && time.exceeds(&contact), "{found:?}");
            } else {
                prop_assert!(contact.exceeds(&time), "{found:?}");
                prop_assert!(!truth.is_outside(&(&contact * 0.999)), "{found:?}");
            }
            assert_refined(&found, &flight_of(&truth, 256, Magnitude::ZERO), &truth, 250)?;
        }
    }

    /// Lemma G1: after the graze one box holds what missed the wall and what bounced off it, whatever `e`.
    #[test]
    fn past_a_graze_both_continuations_are_held(
        Grazing { truth, time, room } in grazing(), spread in powers(-4.0, 4.0), place in places(), e in prop_oneof![Just(0.0), Just(1.0), 0.0..1.0f64],
    ) {
        let radius = Magnitude::new(spread * room.abs(), 0);
        let flight = flight_of(&truth, 200, radius);
        let Some(passed) = pass(&flight) else { return Ok(()) };
        let truth = TrueFlight { velocity: member(&flight.velocity, place), ..truth };
        let top = truth.extremum(&time);
        let over = truth.height_at(&top) - 1.0;
        let phase = Truth(MpBall::exact(passed.phase.clone()).enclosure().unwrap()) + passed.turns;
        let later = &phase - &truth.phase;
        let (z, v) = if over.exceeds(0.0) {
            // It hits, so long before its top as the fall from it takes; Newton's method does the rest.
            let early = (over * 2.0).over(&truth.acceleration_at(&top).abs()).expect("a bend").sqrt();
            let hit = truth.contact(1.0, &(&top - &early));
            let at = &truth.phase + &hit;
            prop_assert!(at.is_in(&passed.at), "hit {:?}", at.0.to_f64_bounds());
            let velocity = -truth.velocity_at(&hit) * e;
            let after = TrueFlight { phase: at.clone(), velocity, height: 1.0.into(), ..truth.clone() };
            (after.height_at(&(&phase - &at)), after.velocity_at(&(&phase - &at)))
        } else {
            (truth.height_at(&later), truth.velocity_at(&later))
        };
        let z = if truth.wall == Wall::Left { z } else { Truth::from(1.0) - z };
        prop_assert!(passed.wall == truth.wall.other() && later.exceeds(&top));
        prop_assert!(z.is_in(&passed.height), "height {:?}", z.0.to_f64_bounds());
        let v = v * truth.wall.sign();
        prop_assert!(v.is_in(&passed.velocity) && passed.velocity.sign() != Some(Ordering::Equal), "velocity {:?}", v.0.to_f64_bounds());
    }
}
