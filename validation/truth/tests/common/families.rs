//! Families of first flights that are hard for one reason each.
#![allow(dead_code)] // each test crate uses a part

use super::Random;
use super::aim::{Aim, BITS, Target, Touch, decimal};
use super::scene::{At, Scene, Value};
use super::verdicts::{Graze, Question};
use impact_pair_truth::{Number, Wall, pi_times};
use rug::Float;
use std::f64::consts::TAU;

const SIDES: [Wall; 2] = [Wall::Left, Wall::Right];

/// A number of a few digits near `value`, as a decimal.
pub fn short(value: f64) -> Value {
    Value(format!("{value:.6e}"), None)
}

/// 10 to the `exponent`, in high precision.
fn power(exponent: i32) -> Float {
    Number::from(format!("1e{exponent}").as_str()).to_float(BITS)
}

fn float<T>(value: T) -> Float
where
    Float: rug::Assign<T>,
{
    Float::with_val(BITS, value)
}

/// The data of a flight before its velocity is known.
#[derive(Clone, Debug)]
pub struct Draft {
    /// A/d
    pub alpha: f64,
    /// W t + tau less whole forcing periods, in forcing periods.
    pub phase: Float,
    /// The whole forcing periods.
    pub periods: f64,
    pub restitution: &'static str,
    /// The wall left, or the height above the middle in gaps.
    pub from: Result<Wall, f64>,
}

impl Draft {
    /// The scene in units at random; its velocity is 0.
    pub fn scene(&self, random: &mut Random) -> Scene {
        let gap = ["1", "9.42497", "0.02", "1/3"][random.below(4) as usize];
        let omega = ["2*pi", "pi", "200*pi", "3.7"][random.below(4) as usize];
        let tau = ["0", "pi/2", "-1.3"][random.below(3) as usize];
        let [gap_value, omega_value, tau_value] = [gap, omega, tau].map(|text| Number::from(text).to_float(BITS));
        let theta = (float(&self.phase) + self.periods) * pi_times(BITS, 2);
        Scene {
            amplitude: short(gap_value.to_f64() * self.alpha),
            omega: omega.into(),
            tau: tau.into(),
            gap: gap.into(),
            restitution: self.restitution.into(),
            time: decimal(&((theta - tau_value) / omega_value)),
            velocity: "0".into(),
            at: match self.from {
                Ok(wall) => At::Wall(wall),
                Err(height) => At::Inside(short(gap_value.to_f64() * height)),
            },
        }
    }
}

/// The order of an extremum after the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Order {
    First,
    Second,
    Later,
}

/// The way of a flight to its graze: from where, with which first move, at which extremum.
#[derive(Clone, Copy, Debug)]
pub struct Approach {
    pub from_wall: bool,
    pub heading: Wall,
    pub order: Order,
}

impl Approach {
    /// All twelve: the far wall at the first or a later extremum, the near wall at the second, and all from inside.
    pub fn all() -> Vec<Approach> {
        let of = |from_wall, heading| {
            [Order::First, Order::Second, Order::Later].map(move |order| Approach { from_wall, heading, order })
        };
        [(true, Wall::Left), (true, Wall::Right), (false, Wall::Left), (false, Wall::Right)]
            .into_iter()
            .flat_map(|(from_wall, heading)| of(from_wall, heading))
            .collect()
    }

    /// A start of this kind that can be made to touch; weak shaking needs `1/(2 pi alpha)` forcing periods to cross the gap.
    fn touch(self, random: &mut Random, draft: impl Fn(&mut Random) -> Draft) -> Option<Touch> {
        let mut draft = draft(random);
        draft.from = if self.from_wall {
            Ok(self.heading.opposite())
        } else if random.below(2) == 0 {
            Err(random.uniform(-0.499, 0.499))
        } else {
            Err([-1.0, 1.0][random.below(2) as usize] * (0.5 - random.magnitude(-3.0, -0.31)))
        };
        let wall = match self.order {
            Order::First => self.heading,
            Order::Second => self.heading.opposite(),
            Order::Later if self.from_wall || random.below(2) == 0 => self.heading,
            Order::Later => self.heading.opposite(),
        };
        let crossing = random.uniform(0.0, 1.5) / (TAU * draft.alpha);
        let turn = if self.order == Order::Later { 1 + random.below(6) + crossing as u64 } else { 0 };
        Touch::search(draft.scene(random), self.heading, Target { wall, turn })
    }
}

/// The flight that touches by `depth` and its twin that misses by as much; `None` if something else comes first.
fn twins(family: [&'static str; 2], exponent: i32, touch: &Touch, depth: &Float) -> Option<[Question; 2]> {
    let question = |family, past: Float| {
        let (scene, time) = touch.shoot(&past)?;
        let graze = Some(Graze { wall: touch.target.wall, time, past });
        Some(Question { family, exponent, scene, graze })
    };
    Some([question(family[0], float(depth))?, question(family[1], -float(depth))?])
}

/// Draws until something comes of it.
fn draw<T>(random: &mut Random, what: impl Fn(&mut Random) -> Option<T>) -> T {
    (0..20_000).find_map(|_| what(random)).expect("one draw in 20 000 succeeds")
}

fn restitution(random: &mut Random) -> &'static str {
    ["1", "0.5", "0.8", "1/3", "0.999999", "1e-3"][random.below(6) as usize]
}

fn any_draft(random: &mut Random) -> Draft {
    Draft {
        alpha: random.magnitude(-3.0, 3.0),
        phase: float(random.uniform(0.0, 1.0)),
        periods: 0.0,
        restitution: restitution(random),
        from: Err(0.0),
    }
}

/// An extremum 1e-2 to 1e-40 of the gap beyond a wall or short of it, for all twelve approaches: to tell touch from
/// miss takes the height to that depth, and the contact then is as slow as the depth's square root.
pub fn grazes(random: &mut Random) -> Vec<Question> {
    let mut questions = Vec::new();
    for exponent in (-40..=-2).rev() {
        for approach in Approach::all() {
            questions.extend(draw(random, |random| {
                let touch = approach.touch(random, any_draft)?;
                let depth = float(&touch.aim.half_gap) * 2 * power(exponent);
                twins(["graze", "near miss"], exponent, &touch, &depth)
            }));
        }
    }
    questions
}

/// Grazes at A/d = 1e-3 ... 1e3 and e = 1 that start 1e15 periods from t = 0: the phase takes 16 digits more.
/// Depths are parts of the gap, or of A where it is smaller: an extremum cannot reach beyond what moves it.
pub fn late_grazes(random: &mut Random) -> Vec<Question> {
    let mut questions = Vec::new();
    for ratio in -3..=3 {
        for exponent in [-2, -5, -9, -14, -20, -40] {
            for periods in [1e15, -987_654_321_012_345.0] {
                questions.extend(draw(random, |random| {
                    let approaches = Approach::all();
                    let approach = approaches[random.below(approaches.len() as u64) as usize];
                    let touch = approach.touch(random, |random| Draft {
                        alpha: 10f64.powi(ratio),
                        periods,
                        restitution: "1",
                        ..any_draft(random)
                    })?;
                    let depth = float(&touch.aim.half_gap) * 2 * power(exponent) * 10f64.powi(ratio).min(1.0);
                    twins(["late graze", "late near miss"], exponent, &touch, &depth)
                }));
            }
        }
    }
    questions
}

/// A hop from a wall just before the box's acceleration turns inward, so slow that the ball comes back to the same wall
/// by a part in 10^n of the hop's height, or misses it: the hop itself is as low as 1e-18 gaps, the depth lower.
pub fn small_hops(random: &mut Random) -> Vec<Question> {
    let mut questions = Vec::new();
    for exponent in -20..=-2 {
        for wall in SIDES {
            questions.extend(draw(random, |random| {
                let release = if wall == Wall::Left { 1.0 } else { 0.5 };
                let draft = Draft {
                    alpha: random.magnitude(-2.0, 2.0),
                    phase: float(release - random.magnitude(-6.0, -1.0)),
                    from: Ok(wall),
                    ..any_draft(random)
                };
                let (heading, target) = (wall.opposite(), Target { wall, turn: 0 });
                let touch = Touch::search(draft.scene(random), heading, target)?;
                let top = touch.aim.extremum(&touch.drift, Target { wall: heading, turn: 0 });
                let height = (top.height - touch.aim.wall_at(wall)).abs();
                let depth = float(height) * power(exponent);
                twins(["hop graze", "hop near miss"], exponent, &touch, &depth)
            }));
        }
    }
    questions
}

/// A slow drift for 10 to 1e11 forcing periods, until an extremum is beyond the wall, or short of it so that the next one is the
/// first to touch, by 1e-2 to 1e-20 of the drift in a forcing period: heights to 1e-31 of the gap determine the forcing period.
pub fn long_flights(random: &mut Random) -> Vec<Question> {
    let mut questions = Vec::new();
    for decade in 1..=11 {
        for exponent in (-20..=-2).rev().step_by(3) {
            for heading in SIDES {
                let from_wall = exponent % 2 == 0;
                questions.extend(draw(random, |random| {
                    let turn = (10f64.powi(decade) * random.uniform(1.0, 4.0)) as u64;
                    let touch = if from_wall { slow_start(random, heading, turn) } else { floating(random, turn) }?;
                    let depth = float(touch.aim.drift_per_turn(&touch.drift)).abs() * power(exponent);
                    twins(["long flight", "long flight, a turn more"], exponent, &touch, &depth)
                }));
            }
        }
    }
    questions
}

/// A start from the wall behind, just about where the box is outermost: only there a slow drift clears it in the first forcing period.
fn slow_start(random: &mut Random, heading: Wall, turn: u64) -> Option<Touch> {
    let alpha = random.magnitude(-2.0, -0.4);
    // A (1 - sin theta0) must stay below 2 pi b, and b is about d over 2 pi forcing periods.
    let window = (2.0 / (alpha * turn as f64)).sqrt() / TAU;
    let outermost = if heading == Wall::Right { 0.25 } else { 0.75 };
    let phase = float(outermost + random.uniform(-1.0, 1.0) * window.min(0.2));
    let draft = Draft { alpha, phase, from: Ok(heading.opposite()), ..any_draft(random) };
    Touch::search(draft.scene(random), heading, Target { wall: heading, turn })
}

/// A start from inside the gap, with either first move and either drift.
fn floating(random: &mut Random, turn: u64) -> Option<Touch> {
    let [heading, wall] = [(); 2].map(|()| SIDES[random.below(2) as usize]);
    let alpha = random.magnitude(-2.0, -0.4);
    let draft = Draft { alpha, from: Err(random.uniform(-0.4, 0.4)), ..any_draft(random) };
    Touch::search(draft.scene(random), heading, Target { wall, turn })
}

/// Grazes with e = 0 or any other, the far wall placed by the gap instead of the velocity: the flight is the same for both
/// twins, and only the gap, a number of 90 digits, distinguishes them.
pub fn gap_grazes(random: &mut Random) -> Vec<Question> {
    let mut questions = Vec::new();
    for exponent in (-40..=-2).rev() {
        for wall in SIDES {
            let e = if exponent % 3 == 0 { restitution(random) } else { "0" };
            questions.extend(draw(random, |random| gap_twins(random, exponent, wall, e)));
        }
    }
    questions
}

fn gap_twins(random: &mut Random, exponent: i32, from: Wall, e: &'static str) -> Option<[Question; 2]> {
    // sin(theta0) inward: with no velocity the ball leaves.
    let turned = if from == Wall::Left { 0.0 } else { 0.5 };
    let phase = float(turned + random.uniform(0.01, 0.49));
    let draft = Draft { alpha: 1.0, phase, restitution: e, from: Ok(from), ..any_draft(random) };
    let mut scene = draft.scene(random);
    let omega = scene.omega.member(64, 0.0).to_f64();
    let amplitude = scene.amplitude.member(64, 0.0).to_f64();
    scene.velocity = short(f64::from(from.sign()) * amplitude * omega * random.magnitude(-3.0, -0.3));
    let target = Target { wall: from.opposite(), turn: random.below(4) };
    let aim = Aim::new(&scene, BITS);
    let drift = aim.drift(&-(scene.velocity.member(BITS, 0.0) * scene.restitution.member(BITS, 0.0)));
    if float(drift.abs_ref()) >= scene.amplitude.member(BITS, 0.0) {
        return None;
    }
    let top = aim.extremum(&drift, target);
    let reach = float(&top.height - aim.wall_at(from)) * target.wall.sign();
    let twin = |family, past: Float| {
        let mut scene = scene.clone();
        scene.gap = decimal(&float(&reach - &past));
        let gap = scene.gap.member(BITS, 0.0);
        let margin = float(past.abs_ref()) * 10;
        let clear = gap > 0 && Aim::new(&scene, BITS).is_clear(&drift, target, &margin);
        let graze = Some(Graze { wall: target.wall, time: aim.time_of(&top), past });
        clear.then_some(Question { family, exponent, scene, graze })
    };
    let depth = float(&reach * &power(exponent));
    Some([twin("graze by gap", float(&depth))?, twin("near miss by gap", -depth)?])
}
