//! Flights next to a wall: the contact comes after a tiny part of a period, or the ball leaves with no velocity.
#![allow(dead_code)] // each test crate uses a part

use super::Random;
use super::aim::{BITS, decimal};
use super::families::{Draft, short};
use super::scene::{At, Scene, Value};
use super::verdicts::Question;
use impact_pair_truth::{Number, Wall, pi_times};
use rug::Float;
use std::f64::consts::TAU;

/// The motion of a ball that is about to touch a wall.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// A hop: a slow start from the wall, against an acceleration towards it.
    Hop,
    /// The same, slow because e is tiny.
    DeadHop,
    /// A throw at the wall from next to it.
    Thrown,
    /// A start at rest next to the wall, accelerated towards it.
    Pressed,
    /// A throw away from next to the wall, against an acceleration towards it.
    Back,
}

/// A phase at which the acceleration points clearly at `wall`, in forcing periods.
fn pressing(random: &mut Random, wall: Wall) -> f64 {
    random.uniform(0.05, 0.45) + if wall == Wall::Left { 0.5 } else { 0.0 }
}

fn float(value: f64) -> Float {
    Float::with_val(BITS, value)
}

/// Contacts 1e-3 to 1e-9 periods after the start: how far the ball has gone by then is the square of that.
pub fn early_contacts(random: &mut Random) -> Vec<Question> {
    let mut questions = Vec::new();
    for exponent in (-9..=-3).rev() {
        for travel in [Way::Hop, Way::DeadHop, Way::Thrown, Way::Pressed, Way::Back] {
            for wall in [Wall::Left, Wall::Right] {
                for _ in 0..2 {
                    let scene = early_contact(random, exponent, travel, wall);
                    questions.push(Question { family: "early contact", exponent, scene, graze: None });
                }
            }
        }
    }
    questions
}

fn early_contact(random: &mut Random, exponent: i32, travel: Way, wall: Wall) -> Scene {
    let on_wall = matches!(travel, Way::Hop | Way::DeadHop);
    let draft = Draft {
        alpha: random.magnitude(-3.0, 3.0),
        phase: float(pressing(random, wall)),
        periods: [0.0, 3.0, -1e9, 1e15][random.below(4) as usize],
        restitution: if on_wall { "0.5" } else { "1" },
        from: if on_wall { Ok(wall) } else { Err(0.0) },
    };
    let mut scene = draft.scene(random);
    let amplitude = scene.amplitude.member(64, 0.0).to_f64();
    let omega = scene.omega.member(64, 0.0).to_f64();
    let gap = scene.gap.member(64, 0.0).to_f64();
    let phi = TAU * random.uniform(0.8, 1.2) * 10f64.powi(exponent);
    let press = amplitude * (TAU * draft.phase.to_f64()).sin().abs();
    // Units: velocities over W, accelerations over W^2; in phi the height is u phi - press phi^2 / 2.
    let outward = f64::from(wall.sign());
    let hop = press * phi / 2.0;
    let throw = gap + press * phi;
    let (velocity, height) = match travel {
        Way::Hop => (outward * 2.0 * hop, 0.0),
        Way::DeadHop => {
            let ratio = 10f64.powi(exponent);
            scene.restitution = Value(format!("1e{exponent}"), None);
            (outward * hop / ratio, 0.0)
        }
        Way::Thrown => (outward * throw, throw * phi),
        Way::Pressed => (0.0, press * phi * phi / 2.0),
        Way::Back => (-outward * hop / 2.0, press * phi * phi / 4.0),
    };
    scene.velocity = short(velocity * omega);
    if !on_wall {
        let half = Number::from(scene.gap.0.as_str()).to_float(BITS) / 2;
        scene.at = At::Inside(decimal(&((half - height) * wall.sign())));
    }
    scene
}

/// e = 0: the ball leaves its wall with no velocity, 1e-1 to 1e-30 of a forcing period after the phase of release; the sign of a
/// sine as small decides whether it goes or rests, and the next contact is like that of a start at release.
pub fn dead_starts(random: &mut Random) -> Vec<Question> {
    let mut questions = Vec::new();
    for exponent in (-30..=-1).rev() {
        for wall in [Wall::Left, Wall::Right] {
            let release = if wall == Wall::Left { 0 } else { 1 };
            let after = Number::from(format!("1e{exponent}").as_str()).to_float(BITS) * random.uniform(1.0, 4.0);
            let draft = Draft {
                alpha: random.magnitude(-3.0, 3.0),
                phase: float(f64::from(release) / 2.0) + after,
                periods: [0.0, 1e15][random.below(2) as usize],
                restitution: "0",
                from: Ok(wall),
            };
            let mut scene = draft.scene(random);
            scene.velocity = short(f64::from(wall.sign()) * random.magnitude(-3.0, 3.0));
            questions.push(Question { family: "dead start", exponent, scene, graze: None });
        }
    }
    questions
}

/// Exactly at release, with no velocity: sin(theta0) = 0, and only the third derivative moves the ball.
pub fn releases(random: &mut Random) -> Vec<Question> {
    let mut questions = Vec::new();
    for exponent in -3..=3 {
        for wall in [Wall::Left, Wall::Right] {
            for periods in [0, 1_000_000_000_000_000i64] {
                let scene = Scene {
                    amplitude: Value(format!("1e{exponent}"), None),
                    omega: "2*pi".into(),
                    tau: if wall == Wall::Left { "0" } else { "pi" }.into(),
                    gap: "1".into(),
                    restitution: ["0", "1"][random.below(2) as usize].into(),
                    time: Value(periods.to_string(), None),
                    velocity: "0".into(),
                    at: At::Wall(wall),
                };
                questions.push(Question { family: "release", exponent, scene, graze: None });
            }
        }
    }
    questions
}

/// Asserts that an early contact is as early as its exponent says.
pub fn assert_early(question: &Question) {
    let bits = BITS;
    let elapsed = question.truth().time - question.scene.time.member(bits, 0.0);
    let turns = elapsed * question.scene.omega.member(bits, 0.0) / pi_times(bits, 2);
    let ratio = turns.to_f64() / 10f64.powi(question.exponent);
    assert!((0.5..2.0).contains(&ratio), "{ratio} of 1e{} periods: {question:?}", question.exponent);
}
