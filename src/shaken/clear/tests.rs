//! Lemma C7: no flight of the set touches a wall before the time that is returned, and a lone flight not long after it.
//!
//! The truth comes from another theorem: the first contact of a member by the closed form of [`crate::contact`], with several harmonics by the
//! scan of [`crate::several`].

use std::sync::Arc;

use super::*;
use crate::clock::Clock;
use crate::exact::Exact;
use crate::pair::ImpactPair;
use crate::shaken::{Either, Flying, Shaken, under};
use impact_pair_model::{Excitation, Harmonic};
use proptest::prelude::*;

fn exact(x: f64) -> Exact {
    Exact::from_f64(x).unwrap()
}

/// A pair with a gap of 1 under harmonics of these amplitudes, the first one with period 1.
fn shaken(amplitudes: &[f64], restitution: f64) -> Either {
    let turn = Exact::pi() * Exact::from(2);
    let frequencies =
        [Exact::from(1), Exact::from(1).checked_div(&Exact::from(2)).unwrap(), Exact::from(2).checked_sqrt().unwrap()];
    let terms = amplitudes.iter().zip(frequencies).map(|(amplitude, ratio)| {
        Harmonic::new(exact(*amplitude), turn.checked_mul(&ratio).unwrap(), Exact::from(0)).unwrap()
    });
    let excitation = Excitation::new(terms.collect()).unwrap();
    let pair = ImpactPair::new(excitation, Exact::from(1), exact(restitution)).unwrap();
    let clock = Clock::new(&pair, &Exact::from(0), 64).unwrap();
    Either::new(&pair, &clock).unwrap()
}

/// First contact of a member after its start, in forcing periods from below, and the time up to which the set is clear.
fn of<S: Flying>(shaken: &Arc<S>, member: &Launch<Ball>, all: &Launch<Ball>) -> Option<(f64, f64)> {
    let (contact, _) = shaken.first_contact(member.clone(), None).ok()?;
    let Since { whole, rest } = clear(&**shaken, all);
    Some((contact.time.mid() + contact.time.rad(), whole + rest))
}

fn compared(shaken: &Either, member: &Launch<Ball>, all: &Launch<Ball>) -> Option<(f64, f64)> {
    under!(shaken, shaken => of(shaken, member, all))
}

fn launch(place: Option<Wall>, height: Ball, phase: Ball, velocity: Ball) -> Launch<Ball> {
    match place {
        Some(wall) => Launch::from_wall(wall, 0, phase, wall.inward(velocity), false),
        None => Launch::from_inside(height, 0, phase, velocity),
    }
}

fn places() -> impl Strategy<Value = Option<Wall>> {
    prop_oneof![Just(None), Just(Some(Wall::Left)), Just(Some(Wall::Right))]
}

/// Speeds from 1e-12 to 10.
fn sizes() -> impl Strategy<Value = f64> {
    (-12.0..1.0f64).prop_map(|power| 10f64.powf(power))
}

proptest! {
    #[test]
    fn nothing_is_touched_before(
        amplitudes in prop::collection::vec(sizes(), 1..4),
        (place, height, phase) in (places(), 0.01..0.99f64, -0.5..0.5f64),
        (speed, sign, width) in (sizes(), prop_oneof![Just(1.0), Just(-1.0)], -16.0..-1.0f64),
        member in [-1.0..1.0f64, -1.0..1.0, -1.0..1.0],
    ) {
        let shaken = shaken(&amplitudes, 0.5);
        let velocity = if place.is_some() { speed } else { sign * speed };
        let width = 10f64.powf(width);
        let radii = [width * height.min(1.0 - height), width, width * speed];
        let middles = [height, phase, velocity];
        let [all, one] = [0.0, 1.0].map(|of_member| {
            let at = |i: usize| Ball::new(middles[i] + 0.9 * of_member * member[i] * radii[i], (1.0 - of_member) * radii[i]);
            launch(place, at(0), at(1), at(2))
        });
        if let Some((contact, clear)) = compared(&shaken, &one, &all) {
            prop_assert!(clear <= contact, "clear to {clear}, contact at {contact}");
        }
    }

    /// A lone flight with one harmonic: what is clear ends where the distance is as small as doubles tell it, however slow the drift.
    #[test]
    fn the_bound_is_near_the_contact(amplitude in 0.01..0.4f64, phase in -0.5..0.5f64, drift in sizes(), sign in prop_oneof![Just(1.0), Just(-1.0)]) {
        let shaken = shaken(&[amplitude], 0.5);
        let phase = Ball::exact(phase);
        let (_, cos) = phase.sin_cos();
        let velocity = sign * drift - std::f64::consts::TAU * amplitude * cos.mid();
        let flight = launch(None, Ball::exact(0.5 - amplitude * phase.sin_cos().0.mid()), phase, Ball::exact(velocity));
        if let Some((contact, clear)) = compared(&shaken, &flight, &flight) {
            // The double that is the velocity holds the drift to 1e-16 of the box's.
            let lost = 1e-15 / drift + 1e-3;
            prop_assert!(clear <= contact && (1.0 - lost) * contact - 1.5 <= clear, "clear to {clear}, contact at {contact}");
        }
    }
}

#[test]
fn flights_without_contact_are_clear_for_the_longest_time() {
    let still = launch(None, Ball::exact(0.3), Ball::exact(0.25), Ball::exact(0.0));
    let Either::One(one) = shaken(&[0.25], 0.5) else { panic!("one harmonic") };
    let drifts = 1e-10 * one.pair().beta.mid();
    assert!(clear(&*one, &still).whole > 0.1 / drifts, "{:?}", clear(&*one, &still));
    assert_eq!(
        clear(&*one, &launch(Some(Wall::Left), Ball::exact(0.0), Ball::exact(0.1), Ball::exact(0.0))),
        Since::START
    );
}
