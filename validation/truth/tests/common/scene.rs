//! Orbits in physical units asked of the library and of the truth: the same exact data, texts in both.
#![allow(dead_code)] // each test crate uses a part

use impact_pair::exact::{Dyadic, Enclosure, Exact};
use impact_pair::orbit::{Arithmetic, Impact, Orbit, Outcome, Progress, Settings, Start as LibraryStart};
use impact_pair::pair::Wall as LibraryWall;
use impact_pair::{Error, Harmonic, ImpactPair};
use impact_pair_truth::{Contact, Number, Problem, Start, Wall, orbit};
use rug::ops::Pow;
use rug::{Float, Integer};

/// An exact number, or a box of them: both ends.
#[derive(Clone, Debug)]
pub struct Value(pub String, pub Option<String>);

impl From<&str> for Value {
    fn from(text: &str) -> Value {
        Value(text.into(), None)
    }
}

impl Value {
    /// The double, as the shortest decimal that reads back as it: the scene's data are decimals.
    pub fn decimal(value: f64) -> Value {
        Value(format!("{value:e}"), None)
    }

    /// The decimals at `value` and `value + width`.
    pub fn between(value: f64, width: f64) -> Value {
        let (low, high) = (value.min(value + width), value.max(value + width));
        if low < high { Value(format!("{low:e}"), Some(format!("{high:e}"))) } else { Value::decimal(value) }
    }

    pub fn exact(&self) -> Exact {
        let text = match &self.1 {
            None => self.0.clone(),
            Some(high) => format!("[{}, {high}]", self.0),
        };
        Exact::parse(&text).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    /// The member at `part` in [0, 1] of the way.
    pub fn member(&self, bits: u32, part: f64) -> Float {
        let low = Number::from(self.0.as_str()).to_float(bits);
        let Some(high) = &self.1 else { return low };
        let high = Number::from(high.as_str()).to_float(bits);
        if part == 0.0 {
            low
        } else if part == 1.0 {
            high
        } else {
            Float::with_val(bits, &high - &low) * part + low
        }
    }
}

/// The place of the ball at the start.
#[derive(Clone, Debug)]
pub enum At {
    Wall(Wall),
    Inside(Value),
}

/// All the data of an orbit.
#[derive(Clone, Debug)]
pub struct Scene {
    pub amplitude: Value,
    pub omega: Value,
    pub tau: Value,
    pub gap: Value,
    pub restitution: Value,
    pub time: Value,
    /// Velocity before the impact, for a start on a wall.
    pub velocity: Value,
    pub at: At,
}

impl Scene {
    /// The printed data of figures 12-17.
    pub fn figure(number: u32) -> Scene {
        let [omega, amplitude, gap, restitution, velocity, tau] = match number {
            12 => ["pi", "1", "9.42497", "0.5", "-12.56636", "0"],
            13 => ["pi", "2", "9.42497", "0.5", "-12.56636", "0"],
            14 => ["pi", "8", "9.42497", "0.5", "-12.56636", "0"],
            15 => ["10*pi", "2", "1", "0.8", "-14.48", "0"],
            16 => ["20*pi", "10", "1", "0.8", "-2", "0"],
            17 => ["200*pi", "10", "10", "0.8", "0", "1.047196"],
            _ => panic!("no figure {number}"),
        };
        Scene {
            amplitude: amplitude.into(),
            omega: omega.into(),
            tau: tau.into(),
            gap: gap.into(),
            restitution: restitution.into(),
            time: "0".into(),
            velocity: velocity.into(),
            at: At::Wall(Wall::Left),
        }
    }

    /// The pair and the start as the library takes them.
    pub fn library(&self) -> Result<(ImpactPair, LibraryStart), Error> {
        let harmonic = Harmonic::new(self.amplitude.exact(), self.omega.exact(), self.tau.exact())?;
        let pair = ImpactPair::new(harmonic, self.gap.exact(), self.restitution.exact())?;
        let (time, velocity) = (self.time.exact(), self.velocity.exact());
        let start = match &self.at {
            At::Wall(Wall::Left) => LibraryStart::on_wall(time, LibraryWall::Left, velocity)?,
            At::Wall(Wall::Right) => LibraryStart::on_wall(time, LibraryWall::Right, velocity)?,
            At::Inside(position) => LibraryStart::inside(&pair, time, position.exact(), velocity)?,
        };
        Ok((pair, start))
    }

    /// The library's orbit in certified double precision.
    pub fn orbit(&self, impacts: u64) -> Result<Orbit, Error> {
        let (pair, start) = self.library()?;
        let settings = Settings { impacts: Some(impacts), arithmetic: Arithmetic::Interval, ..Settings::default() };
        Orbit::new(&pair, &start, settings)
    }

    /// The question put to the truth for the member at `parts` (of amplitude, restitution, time, velocity, position).
    pub fn question(&self, bits: u32, parts: [f64; 5]) -> (Problem, Start) {
        let problem = Problem::new(
            bits,
            &self.amplitude.member(bits, parts[0]),
            &self.omega.member(bits, 0.0),
            &self.tau.member(bits, 0.0),
            &self.gap.member(bits, 0.0),
            &self.restitution.member(bits, parts[1]),
        );
        let (time, velocity) = (self.time.member(bits, parts[2]), self.velocity.member(bits, parts[3]));
        let start = match &self.at {
            At::Wall(wall) => {
                Start::on_wall(&problem, *wall, &time, &-Float::with_val(bits, &problem.restitution * &velocity))
            }
            At::Inside(position) => Start::inside(&problem, &time, &position.member(bits, parts[4]), &velocity),
        };
        (problem, start)
    }

    /// The true orbit of the member at `parts`.
    pub fn truth(&self, bits: u32, parts: [f64; 5], impacts: usize) -> Vec<Contact> {
        let (problem, start) = self.question(bits, parts);
        orbit(&problem, &start, impacts)
    }
}

/// The dyadic number, exactly.
pub fn float(x: &Dyadic) -> Float {
    let mantissa: Integer = x.mantissa().to_string().parse().expect("an integer");
    let bits = mantissa.significant_bits().max(64);
    Float::with_val(bits, mantissa) * Float::with_val(64, 2).pow(x.exponent() as i32)
}

pub fn holds(bounds: &Enclosure, value: &Float) -> bool {
    float(bounds.inf()) <= *value && *value <= float(bounds.sup())
}

/// The first contradiction of the library's impacts to one true orbit, in words, or `None`.
pub fn objection(orbit: &Orbit, impacts: &[Impact], truth: &[Contact]) -> Option<String> {
    for (index, impact) in impacts.iter().enumerate() {
        let Some(contact) = truth.get(index) else {
            return Some(format!("impact {} is certified, but the truth ends at {}", impact.index, truth.len()));
        };
        if (impact.wall == LibraryWall::Left) != (contact.wall == Wall::Left) || impact.index != index as u64 + 1 {
            return Some(format!("impact {index} + 1: {impact:?}, but the truth is {contact:?}"));
        }
        let (time, velocity) = orbit.bounds(impact);
        let names = [("time", &time, &contact.time), ("velocity", &velocity, &contact.velocity_before)];
        if let Some((name, bounds, value)) = names.into_iter().find(|(_, bounds, value)| !holds(bounds, value)) {
            let (low, high) = bounds.to_f64_bounds();
            return Some(format!("{name} of impact {}: {:.40} is not in [{low:e}, {high:e}]", impact.index, value));
        }
    }
    None
}

/// Runs the library's orbit and compares it with the truth of each member; a failure is repeated at thrice the bits.
pub fn judge(scene: &Scene, bits: u32, impacts: usize, members: &[[f64; 5]]) -> (usize, Option<Outcome>) {
    let mut orbit = scene.orbit(impacts as u64).unwrap_or_else(|error| panic!("{error}: {scene:?}"));
    let found = impacts_before_rest(&mut orbit);
    for parts in members {
        let truth = scene.truth(bits, *parts, found.len());
        if objection(&orbit, &found, &truth).is_some() {
            let truth = scene.truth(3 * bits, *parts, found.len());
            if let Some(objection) = objection(&orbit, &found, &truth) {
                panic!("{objection}; member {parts:?} of {scene:?}");
            }
        }
    }
    // Through rests, which `validation/arb` judges.
    orbit.by_ref().for_each(drop);
    (found.len(), orbit.outcome().cloned())
}

/// The impacts up to the first graze or rest, where the truth ends.
pub fn impacts_before_rest(orbit: &mut Orbit) -> Vec<Impact> {
    let mut found = Vec::new();
    loop {
        match orbit.advance() {
            Progress::Impact(impact) => found.push(impact),
            Progress::Retraced(_) => {}
            Progress::Graze(_) | Progress::Rest(_) | Progress::Release(_) | Progress::Ended => return found,
        }
    }
}

/// Whether the true orbit from the first member ends (it rests, or never meets a wall again) after `impacts`.
pub fn truth_ends(scene: &Scene, bits: u32, impacts: usize) -> bool {
    scene.truth(bits, [0.0; 5], impacts + 1).len() == impacts
}
