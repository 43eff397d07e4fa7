//! Lanes against the scalar flights, bit by bit.

use proptest::prelude::*;

use super::columns::{Brackets, LaneValue, Spreads};
use super::*;
use crate::contact::{Contact, Radii, Undecided, Verdict, first_contact};
use crate::number::Ball;
use crate::pair::Inward;

/// A start on a wall: phase and velocity away from it.
type Start = (Wall, f64, f64);

fn pair(alpha: f64, restitution: f64, radius: f64) -> Reduced<Ball> {
    let ball = |x: f64| Ball::new(x, x * radius);
    let tau = std::f64::consts::TAU;
    Reduced {
        alpha: ball(alpha),
        beta: Ball::new(alpha * tau, alpha * tau * (radius + 1e-15)),
        restitution: ball(restitution),
    }
}

/// The velocity near `velocity` with which the first maximum, or minimum, passes its wall by `miss`, as far as halving finds it.
fn grazing(pair: &Reduced<f64>, (wall, phase, velocity): Start, miss: f64) -> f64 {
    let past = |velocity: f64| {
        let flight = Flight::from_wall(pair, wall, phase, velocity, kernel::sin_cos(phase));
        !flight.is_monotone() && {
            let extrema = Extrema::new::<Kernel>(&flight);
            extrema.max - 1.0 > miss || extrema.min < -miss
        }
    };
    let (mut low, mut high) = (0.0, velocity);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        *(if past(middle) == past(low) { &mut low } else { &mut high }) = middle;
    }
    high
}

fn sizes() -> impl Strategy<Value = f64> {
    (-40.0..3.0f64).prop_map(|exponent| 10f64.powf(exponent))
}

/// Phases, the corners among them.
fn phases() -> impl Strategy<Value = f64> {
    let corner = (-4..=4).prop_map(|quarter| f64::from(quarter) / 4.0);
    prop_oneof![
        6 => -0.5..0.5f64,
        1 => corner.clone(),
        2 => (corner, any::<bool>(), sizes()).prop_map(|(at, sign, by)| if sign { at + by.min(0.1) } else { at - by.min(0.1) }),
        1 => prop_oneof![-3.0..3.0f64, Just(2.0), Just(1e300), Just(f64::NAN)],
    ]
}

/// Strategy for the data of starts: whether on the left wall, phase, velocity, the size of a perturbation and the kind of start.
fn starts() -> impl Strategy<Value = Vec<(bool, f64, f64, f64, u8)>> {
    prop::collection::vec((any::<bool>(), phases(), 0.0..8.0f64, sizes(), 0..8u8), 1..40)
}

fn made(pair: &Reduced<f64>, (is_left, phase, velocity, size, kind): (bool, f64, f64, f64, u8)) -> Start {
    let wall = if is_left { Wall::Left } else { Wall::Right };
    let start = (wall, phase, velocity);
    let velocity = match kind {
        0 => 0.0,
        // A slow drift: many forcing periods.
        1 if phase.abs() < 2.0 => (size.min(0.1) - pair.beta * wall.inward(kernel::sin_cos(phase).1)).abs(),
        2 | 3 if phase.abs() < 2.0 => grazing(pair, start, size.min(0.1)),
        4 => size,
        // A drift near beta.
        5 if phase.abs() < 2.0 => {
            (pair.beta * (1.0 - wall.inward(kernel::sin_cos(phase).1))).abs() * (1.0 + size.min(0.1))
        }
        _ => velocity,
    };
    (wall, phase, velocity)
}

fn scalar(pair: &Reduced<Ball>, (wall, phase, velocity): (Wall, f64, Ball)) -> Verdict<Contact<Ball>> {
    if !is_phase(phase) {
        return Verdict::Undecided(Undecided::endless());
    }
    let flight = Flight::from_wall(&pair.centre(), wall, phase, velocity.mid(), kernel::sin_cos(phase));
    first_contact(&flight, &Margins::new(pair), Radii { velocity: velocity.rad(), ..Radii::default() })
}

/// Text that distinguishes doubles that differ, including zeros of either sign.
fn bits<T: std::fmt::Debug>(values: &[T]) -> Vec<String> {
    values.iter().map(|value| format!("{value:?}")).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn a_flight_in_a_lane_has_the_bits_of_the_scalar_one(
        alpha in prop_oneof![0.01..2.0f64, Just(0.0), sizes()], radius in prop_oneof![Just(0.0), 1e-17..1e-6f64],
        spread in prop_oneof![Just(0.0), sizes()], starts in starts(),
    ) {
        let pair = pair(alpha, 0.5, radius);
        let starts: Vec<_> = starts.into_iter().map(|start| {
            let (wall, phase, velocity) = made(&pair.centre(), start);
            (wall, phase, Ball::new(velocity, spread.min(0.1)))
        }).collect();
        let mut found = Vec::new();
        first_contacts_of(&pair, starts.iter().copied(), |verdict| found.push(verdict));
        let expected: Vec<_> = starts.iter().map(|start| scalar(&pair, *start)).collect();
        prop_assert_eq!(bits(&found), bits(&expected));
    }

    #[test]
    fn a_set_in_a_lane_has_the_bits_of_the_scalar_one(
        alpha in prop_oneof![0.01..2.0f64, Just(0.0), sizes()], radius in prop_oneof![Just(0.0), 1e-17..1e-6f64],
        restitution in prop_oneof![0.1..0.9f64, Just(0.0), Just(1.0)],
        spreads in [prop_oneof![Just(0.0), sizes()], prop_oneof![Just(0.0), sizes()]], starts in starts(),
    ) {
        let pair = pair(alpha, restitution, radius);
        let sets: Vec<_> = starts.into_iter().map(|start| {
            let (wall, phase, velocity) = made(&pair.centre(), start);
            let before = if restitution > 0.0 { -velocity / restitution } else { -velocity };
            let radii = spreads.map(|spread| spread.min(0.1));
            (wall, [Ball::new(phase, radii[0]), wall.inward(Ball::new(before, radii[1]))])
        }).collect();
        let mut found = Vec::new();
        images_of(&pair, sets.iter().copied(), |verdict| found.push(verdict));
        let margins = Margins::new(&pair);
        let expected: Vec<_> = sets.iter().map(|set| image_of(&pair, &margins, *set)).collect();
        prop_assert_eq!(bits(&found), bits(&expected));
    }
}

/// Of an even spread of flights nearly all are decided in lanes: else there is nothing gained.
#[test]
fn usual_flights_are_decided_in_lanes() {
    for alpha in [0.1, 0.5, 0.85, 10.0] {
        let pair = pair(alpha, 0.5, 1e-16);
        let (mut lanes, mut decided) = (Lanes::EMPTY, 0);
        for batch in 0..64 {
            for lane in 0..LANES {
                let number = (batch * LANES + lane) as f64;
                let (phase, velocity) = ((number * 0.618_034).fract() - 0.5, 0.02 + 3.0 * (number * 0.754_878).fract());
                lanes.start(lane, if lane % 2 == 0 { Wall::Left } else { Wall::Right }, phase, velocity);
            }
            lanes.solve(&pair.centre());
            lanes.certify_points(&Margins::new(&pair), &Spreads::EMPTY, &mut Brackets::EMPTY.clone());
            decided += lanes.states.is_decided.iter().filter(|&&held| bool::of(held)).count();
        }
        assert!(decided * 100 > 64 * LANES * 97, "{decided} of {} at {alpha}", 64 * LANES);
    }
}
