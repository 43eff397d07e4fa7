//! Members of a scene: of each interval of data one value.

use std::cell::RefCell;
use std::collections::HashMap;

use impact_pair::Scene;
use impact_pair::exact::{Dyadic, Exact};
use impact_pair::orbit::Place;
use impact_pair::pair::Wall as LibraryWall;
use impact_pair_truth::{BITS, Shaken, State, Tone, Wall, float};
use rug::ops::Pow;
use rug::{Float, Integer};
use serde_json::Value;

use crate::random::Random;

/// A pair and the state just after its start.
#[derive(Clone, Debug)]
pub struct Member {
    pub shaken: Shaken,
    pub start: State,
    /// All harmonics, those that are 0 among them.
    pub tones: Vec<Tone>,
    /// Velocity before an impact, for a start on a wall.
    pub velocity: Float,
}

fn dyadic(x: &Dyadic) -> Float {
    let mantissa: Integer = x.mantissa().to_string().parse().expect("an integer");
    float(mantissa) * float(2).pow(x.exponent() as i32)
}

thread_local! {
    /// Values by their expressions: a 0 in disguise takes a second, and all points of a sweep have it.
    static CACHED_VALUES: RefCell<HashMap<String, Float>> = RefCell::default();
}

/// The value, rounded; exactly 0 where an enclosure of `BITS` bits does not decide the sign.
pub fn value(exact: &Exact) -> Float {
    let computed = || {
        let enclosure = exact.enclose(BITS);
        if enclosure.sign().is_none() { float(0) } else { dyadic(enclosure.inf()) }
    };
    CACHED_VALUES.with_borrow_mut(|known| known.entry(exact.to_string()).or_insert_with(computed).clone())
}

/// The value that is so far on the way from the lower to the upper end.
fn member(exact: &Exact, part: f64) -> Float {
    let Some((low, high)) = exact.ends() else { return value(exact) };
    let (low, high) = (value(&low), value(&high));
    if part == 1.0 { high } else { float(&high - &low) * part + low }
}

fn wall(wall: LibraryWall) -> Wall {
    if wall == LibraryWall::Left { Wall::Left } else { Wall::Right }
}

impl Member {
    /// The one that `part` chooses of each datum.
    pub fn new(scene: &Scene, mut part: impl FnMut() -> f64) -> Self {
        let mut of = |exact: &Exact| member(exact, part());
        let (pair, start) = (scene.pair(), scene.start());
        let tones: Vec<Tone> = pair
            .excitation()
            .terms()
            .iter()
            .map(|term| Tone {
                amplitude: of(term.amplitude()),
                frequency: of(term.frequency()),
                phase: of(term.phase()),
            })
            .collect();
        let moving = tones.iter().filter(|tone| !tone.amplitude.is_zero()).cloned().collect();
        let shaken = Shaken { tones: moving, gap: of(pair.gap()), restitution: of(pair.restitution()) };
        let (time, velocity) = (of(start.time()), of(start.velocity()));
        let start = match start.place() {
            Place::Wall(on) => State::on_wall(&shaken, wall(*on), time, -float(&shaken.restitution * &velocity)),
            Place::Inside(position) => {
                let position = of(position);
                State::inside(time, position, velocity.clone())
            }
        };
        Self { shaken, start, tones, velocity }
    }

    /// Both ends and a corner or one between, or the only one.
    pub fn all(scene: &Scene, random: &mut Random) -> Vec<Self> {
        if scene.pair().is_point() && scene.start().is_point() {
            return vec![Self::new(scene, || 0.0)];
        }
        let ends = [0.0, 1.0].map(|part| Self::new(scene, || part));
        let other = match random.below(2) {
            0 => Self::new(scene, || random.below(2) as f64),
            _ => Self::new(scene, || random.uniform(0.0, 1.0)),
        };
        ends.into_iter().chain([other]).collect()
    }

    /// A period of each of the harmonics.
    pub fn turns(&self) -> Vec<Float> {
        let turn = float(rug::float::Constant::Pi) * 2;
        self.tones.iter().map(|tone| float(&turn / &tone.frequency)).collect()
    }
}

/// A decimal of a document.
pub fn decimal(text: &Value) -> Option<Float> {
    Some(Float::with_val(2 * BITS, Float::parse(text.as_str()?).ok()?))
}

/// Bounds of a document.
#[derive(Clone, Debug)]
pub struct Bounds(pub Float, pub Float);

/// Error allowed in the simulator, as a power of 2: `2^-SLACK` and this part of the value.
const TOLERANCE_BITS: u32 = 300;

impl Bounds {
    pub fn read(pair: &Value) -> Option<Self> {
        Some(Self(decimal(&pair[0])?, decimal(&pair[1])?))
    }

    fn slack(x: &Float) -> Float {
        (float(x.abs_ref()) + 1) >> TOLERANCE_BITS
    }

    /// The place of a value: before the bounds, within or after them.
    pub fn place(&self, x: &Float) -> std::cmp::Ordering {
        let slack = Self::slack(x);
        if float(x + &slack) < self.0 {
            std::cmp::Ordering::Less
        } else if float(x - &slack) > self.1 {
            std::cmp::Ordering::Greater
        } else {
            std::cmp::Ordering::Equal
        }
    }

    pub fn holds(&self, x: &Float) -> bool {
        self.place(x).is_eq()
    }

    pub fn middle(&self) -> Float {
        float(float(&self.0 + &self.1) / 2)
    }
}

/// The wall that a document names.
pub fn named(wall: &Value) -> Option<Wall> {
    match wall.as_str()? {
        "left" => Some(Wall::Left),
        "right" => Some(Wall::Right),
        _ => None,
    }
}
