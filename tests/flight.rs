//! Certified flights through the public API, judged by sampling and by the closed form on balls.
//!
//! The heavier judge, an independent simulator in MPFR, is `validation/truth`; these tests need no C compiler.

use impact_pair::contact::{Contact, Margins, Radii, first_contact, first_contact_f64};
use impact_pair::flight::Flight;
use impact_pair::number::{Ball, Kernel, Number, Std, kernel};
use impact_pair::pair::{Inward, Reduced, Wall};
use proptest::prelude::*;

const TAU: f64 = std::f64::consts::TAU;

fn pair(alpha: f64) -> Reduced<Ball> {
    let alpha = Ball::exact(alpha);
    Reduced { alpha, beta: alpha * alpha.turn(), restitution: Ball::exact(0.5) }
}

/// A start on a wall: A/d over six decades, speeds from the box's own down to a billionth of it, or none.
fn starts() -> impl Strategy<Value = (f64, Wall, f64, f64)> {
    let wall = prop_oneof![Just(Wall::Left), Just(Wall::Right)];
    let speed = prop_oneof![1 => Just(0.0), 4 => (-9.0..1.0f64).prop_map(|x| 10f64.powf(x))];
    let phase = prop_oneof![4 => -0.5..0.5f64, 1 => (-2..=2i32).prop_map(|k| f64::from(k) / 4.0)];
    ((-3.0..3.0f64).prop_map(|x| 10f64.powf(x)), wall, phase, speed)
}

fn flight(pair: &Reduced<Ball>, wall: Wall, phase: f64, speed: f64) -> Flight<f64> {
    Flight::from_wall(&pair.centre(), wall, phase, speed * pair.beta.mid(), kernel::sin_cos(phase))
}

/// The flight and its contact, if it is certified.
fn certified(alpha: f64, wall: Wall, phase: f64, speed: f64) -> Option<(Flight<f64>, Contact<Ball>)> {
    let pair = pair(alpha);
    let flight = flight(&pair, wall, phase, speed);
    first_contact(&flight, &Margins::new(&pair), Radii::default()).certified().map(|contact| (flight, contact))
}

/// The height above the departure wall `h` forcing periods after the start, with the standard library's sine.
fn height(flight: &Flight<f64>, h: f64) -> f64 {
    let angle = TAU * flight.phase;
    let wave = ((angle + TAU * h).sin() - angle.sin()) * flight.wall.sign();
    let drift = flight.velocity + flight.beta * angle.cos() * flight.wall.sign();
    drift * h - flight.alpha * wave
}

/// More than what a double evaluation of z is off `time` forcing periods after the start.
fn noise(alpha: f64, time: f64) -> f64 {
    1e-13 * (1.0 + alpha) * (1.0 + time)
}

/// Eight times the cases of the environment or the default, from the seed of `.cargo/config.toml`.
fn config() -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: 8 * default.cases, failure_persistence: None, ..default }
}

proptest! {
    #![proptest_config(config())]

    /// (A.2), (A.4), (A.6): z reaches the wall in the bracket, and no sample before it is beyond a wall.
    #[test]
    fn nothing_is_touched_before_a_certified_contact((alpha, wall, phase, speed) in starts()) {
        let Some((flight, contact)) = certified(alpha, wall, phase, speed) else { return Ok(()) };
        let target = if contact.wall == wall { 0.0 } else { 1.0 };
        let time = contact.time.mid();
        let noise = noise(alpha, time);
        let slack = noise + contact.velocity.mag() * contact.time.rad();
        prop_assert!((height(&flight, time) - target).abs() <= slack, "at {time}: {}", height(&flight, time));
        for i in 1..500 {
            let z = height(&flight, time * f64::from(i) / 500.0);
            prop_assert!(z > -noise && z < 1.0 + noise, "{z} after {i}/500 of the flight");
        }
    }

    /// Lemma C3 seen from the other arithmetic: on balls the residual changes sign over a bracket slightly widened.
    #[test]
    fn the_residual_on_balls_changes_sign_across_the_bracket((alpha, wall, phase, speed) in starts()) {
        let Some((start, contact)) = certified(alpha, wall, phase, speed) else { return Ok(()) };
        let pair = pair(alpha);
        let ball = Ball::exact;
        let velocity = ball(start.velocity);
        let exact = Flight::from_wall(&pair, wall, ball(phase), velocity, ball(phase).sin_cos());
        let target = ball(if contact.wall == wall { 0.0 } else { 1.0 });
        // A wide bracket's surroundings may leave the monotone piece.
        let reach = 8.0 * contact.phase.rad() + 1e-15;
        prop_assume!(reach < 1e-6);
        let residual = |offset: f64| {
            let at = ball(contact.phase.mid() + offset);
            let (sin, _) = wall.mirror(at.sin_cos());
            exact.height_above(target, ball(contact.turns), at, sin)
        };
        let (before, after) = (residual(-reach), residual(reach));
        // Balls may be too wide to tell; they must not tell the contrary.
        let direction = wall.inward(contact.velocity.mid()).signum();
        prop_assert!(before.mid() * direction <= before.rad() && after.mid() * direction >= -after.rad());
    }

    /// The mirror (y -> -y, theta -> theta + pi) maps certified flights to certified flights.
    #[test]
    fn mirrored_flights_have_mirrored_contacts((alpha, _, phase, speed) in starts()) {
        // Multiples of 2^-20, so that half a forcing period is added exactly.
        let phase = (phase * 1_048_576.0).round() / 1_048_576.0;
        let other = if phase > 0.0 { phase - 0.5 } else { phase + 0.5 };
        let answers = [(Wall::Left, phase), (Wall::Right, other)].map(|(wall, phase)| certified(alpha, wall, phase, speed));
        if let [Some((_, a)), Some((_, b))] = answers {
            prop_assert_eq!(a.wall, b.wall.other());
            prop_assert!((a.time.mid() - b.time.mid()).abs() <= a.time.rad() + b.time.rad());
            prop_assert!((a.velocity.mid() + b.velocity.mid()).abs() <= a.velocity.rad() + b.velocity.rad());
        }
    }

    /// A larger set of starts never contradicts a smaller one: same wall, enclosures that meet.
    #[test]
    fn wider_sets_hold_narrower_ones((alpha, wall, phase, speed) in starts(), size in -14.0..-4.0f64) {
        let pair = pair(alpha);
        let margins = Margins::new(&pair);
        let flight = flight(&pair, wall, phase, speed);
        let size = 10f64.powf(size);
        let radii = Radii { phase: size, velocity: size * flight.velocity, height: 0.0 };
        let answers = [Radii::default(), radii].map(|radii| first_contact(&flight, &margins, radii).certified());
        if let [Some(point), Some(set)] = answers {
            prop_assert_eq!(point.wall, set.wall);
            prop_assert!((set.phase.mid() - point.phase.mid()).abs() <= set.phase.rad() + point.phase.rad());
        }
    }

    /// Plain doubles with either trigonometry are close to a contact that the enclosure has decided (a label, not a proof).
    #[test]
    fn plain_doubles_agree_with_wide_margin_flights((alpha, wall, phase, speed) in starts()) {
        let Some((flight, contact)) = certified(alpha, wall, phase, speed) else { return Ok(()) };
        let own = first_contact_f64::<Kernel>(&flight).expect("the proposal that was certified");
        prop_assert_eq!(own.wall, contact.wall);
        // The error of times by the rounding of heights.
        let noise = noise(alpha, own.time) / own.velocity.abs() + contact.time.rad();
        prop_assert!((own.time - contact.time.mid()).abs() <= noise);
        if let Some(std) = first_contact_f64::<Std>(&flight).filter(|std| std.wall == contact.wall) {
            // The other trigonometry may fall to the other side of a near graze, forcing periods away.
            let same_turn = (std.time - own.time).abs() < 0.1;
            prop_assert!(!same_turn || (std.time - contact.time.mid()).abs() <= noise);
        }
    }
}
