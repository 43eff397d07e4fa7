//! A chain that begins after impacts which are proved by precision: so its start is much nearer to the given one.
//!
//! The product of the Jacobians along these impacts is the column of the chain's first segment: Lemma F6 of
//! `docs/proofs/covering.md#F6`.

use num_rational::BigRational;

use super::motion::StartBounds;
use super::shadowed::START_BITS;
use super::{Arithmetic, Impact, Orbit, Progress, Settings, Start};
use crate::Error;
use crate::clock::Clock;
use crate::contact::Undecided;
use crate::covering::node::Landing;
use crate::covering::start::{Beginning, OnWall};
use crate::covering::start::{Starts, Varied};
use crate::exact::{Enclosure, Exact};
use crate::mapping::Sheared;
use crate::number::{Ball, Number, TINY, up};
use crate::pair::{ImpactPair, Reduced};
use crate::shaken::{Flying, State};
use impact_pair_model::Place;

/// Digits to which the given start's own impacts are proved: those of doubles.
const DIGITS: u32 = 17;
/// Bits of the curve's first impacts beyond those of the given start.
const MORE_BITS: u32 = 64;

/// The first impacts of the starts on a curve through the given start.
#[derive(Debug)]
pub(super) struct Splice {
    pair: ImpactPair,
    start: Start,
    clock: Clock,
    /// The requested start in doubles.
    initial: State<Ball>,
    varied: Varied,
    bits: u32,
    impacts: u64,
    given: Flown,
    scale: f64,
    curve: Option<(Flown, StartBounds)>,
}

/// The proved first impacts of some starts.
#[derive(Clone, Debug)]
struct Flown {
    impacts: Vec<Impact>,
    /// The last of the impacts, with the derivative along the curve in the first column, times `2^exponent`.
    landing: Landing,
    exponent: i32,
}

impl Splice {
    /// Proves the first `impacts` impacts of the orbit of `pair` from `start`.
    ///
    /// # Errors
    /// If these impacts are not all proved.
    pub fn new(
        (pair, start, clock): (&ImpactPair, &Start, &Clock),
        (reduced, initial): (&Reduced<Ball>, State<Ball>),
        impacts: u64,
        max_bits: u32,
    ) -> Result<Self, Error> {
        let varied = Varied::of(reduced, &initial);
        let settings = Settings { digits: DIGITS, max_bits, impacts: Some(impacts), ..Settings::default() };
        let mut orbit = Orbit::new(pair, start, settings)?;
        let given = fly(&mut orbit, impacts, varied).ok_or_else(|| Self::refused(impacts))?;
        let (pair, start, clock, bits) = (pair.clone(), start.clone(), clock.clone(), orbit.bits());
        let scale = reduced.scale(given.landing.velocity);
        Ok(Self { pair, start, clock, initial, varied, bits, impacts, given, scale, curve: None })
    }

    /// Error for a number of impacts that cannot be spliced.
    pub fn refused(impacts: u64) -> Error {
        let accepted = "but it must be a number of first impacts that are proved by precision, before a rest or a graze, and after \
                        which the motion goes on to expand";
        Error::out_of_range(Some("splice"), format!("splice is {impacts}, {accepted}"))
    }

    /// First impacts, without the last one, of all starts on the curve, and bounds of these starts; `None` before a chain has begun.
    pub fn proved(&self) -> Option<(&[Impact], &StartBounds)> {
        let (Flown { impacts, .. }, near) = self.curve.as_ref()?;
        let (_, before) = impacts.split_last()?;
        Some((before, near))
    }

    /// Starts within `a` along the curve: as the start of an orbit, and as bounds.
    fn starts_within(&self, a: f64) -> Option<(Start, StartBounds)> {
        let apart = BigRational::from_float(a)? * two_to(-self.given.exponent);
        let apart = Enclosure::from_rational(&apart, START_BITS);
        let spread = |value: &Exact, apart: &Enclosure| {
            let apart = Exact::from_rational(apart.sup().to_rational());
            Exact::interval(&value.checked_sub(&apart).ok()?, &value.checked_add(&apart).ok()?).ok()
        };
        let (mut time, mut velocity) = (self.start.time().clone(), self.start.velocity().clone());
        match self.varied {
            Varied::Time => time = spread(&time, &self.clock.duration(&apart))?,
            Varied::Velocity => velocity = spread(&velocity, &self.clock.velocity(&apart))?,
        }
        let bits = START_BITS.saturating_add(self.bits); // X1: any number of bits encloses
        let near = (time.enclose(bits), velocity.enclose(bits));
        let start = match self.start.place() {
            Place::Wall(wall) => Start::on_wall(time, *wall, velocity),
            Place::Inside(position) => Start::inside(&self.pair, time, position.clone(), velocity),
        };
        Some((start.ok()?, near))
    }

    /// Follows the orbits of a box of starts through the first impacts.
    fn fly_from(&self, start: &Start) -> Option<Flown> {
        let bits = Arithmetic::Bits(self.bits.saturating_add(MORE_BITS)); // proposes: any number of bits encloses
        let settings = Settings { arithmetic: bits, impacts: Some(self.impacts), ..Settings::default() };
        let mut orbit = Orbit::new(&self.pair, start, settings).ok()?;
        // Forcing periods are counted from one origin.
        (orbit.clock.origin() == self.clock.origin()).then_some(())?;
        fly(&mut orbit, self.impacts, self.varied)
    }
}

/// Follows an orbit through `count` impacts and no other event. Lemma F6
fn fly(orbit: &mut Orbit, count: u64, varied: Varied) -> Option<Flown> {
    let mut impacts: Vec<Impact> = Vec::new();
    let mut column = Column::along(varied.direction());
    let mut last = None;
    loop {
        let impact = match orbit.advance() {
            Progress::Impact(impact) => impact,
            Progress::Retraced(_) => continue,
            Progress::Ended => break,
            Progress::Graze(_) | Progress::Rest(_) | Progress::Release(_) => return None,
        };
        if let Some(sheared) = last {
            column = column.image(Sheared::jacobian(sheared))?;
        }
        last = Some(orbit.sheared(impacts.last(), &impact)?);
        impacts.push(impact);
    }
    let jacobian = last?.along(|row| column.times(row));
    let Impact { wall, turns, phase, velocity, .. } = *impacts.last()?;
    let landing = Landing { wall, turns, phase, velocity, slope: Ball::exact(0.0), jacobian };
    // exact: a length
    (impacts.len() as u64 == count).then_some(Flown { impacts, landing, exponent: column.exponent })
}

/// A derivative along a curve, times a power of two: parts along an axis and across it, both balls.
///
/// The axis follows the middle of the image. So the error of the direction is squeezed as the direction is, and not wrapped in a box at each
/// impact.
#[derive(Clone, Copy, Debug)]
struct Column {
    axis: [f64; 2],
    parts: [Ball; 2],
    exponent: i32,
}

impl Column {
    fn along(axis: [f64; 2]) -> Self {
        Self { axis, parts: [1.0, 0.0].map(Ball::exact), exponent: 0 }
    }

    /// Product of a row with the column.
    fn times(&self, row: [Ball; 2]) -> Ball {
        let [[c, s], [along, across]] = [self.axis.map(Ball::exact), self.parts];
        along * dot(row, [c, s]) + across * dot(row, [-s, c])
    }

    /// Image of the column under a matrix; `None` where doubles do not hold the image.
    fn image(&self, matrix: [[Ball; 2]; 2]) -> Option<Self> {
        let [x, y] = matrix.map(|row| self.times(row).mid());
        let length = x.hypot(y);
        let axis = [x / length, y / length];
        let [c, s] = axis.map(Ball::exact);
        let [first, second] = matrix;
        // Rows of the rotated matrix, before they are multiplied with the column: so nothing is lost between its parts.
        let rotated = |[p, q]: [Ball; 2]| [p * first[0] + q * second[0], p * first[1] + q * second[1]];
        let size = length.log2() as i32; // exact: any power of two
        let norm = (c * c + s * s) * Ball::exact(2f64.powi(size));
        let part = |row| self.times(rotated(row)).checked_div(norm);
        Some(Self { axis, parts: [part([c, s])?, part([-s, c])?], exponent: self.exponent + size })
    }
}

fn dot([a, b]: [Ball; 2], [x, y]: [Ball; 2]) -> Ball {
    a * x + b * y
}

/// `2^n`
fn two_to(n: i32) -> BigRational {
    BigRational::from_integer(2.into()).pow(n)
}

impl<S: Flying> Beginning<S> for Splice {
    fn scale(&self) -> f64 {
        self.scale
    }

    fn starts(&self, a: f64) -> Starts {
        // F6: a number below all doubles is below the smallest normal one.
        let apart = up(a * 2f64.powi(-self.given.exponent) + TINY);
        Starts::within(apart, self.varied, &self.initial)
    }

    fn land(&mut self, _: &S, a: f64) -> Result<Landing, Undecided> {
        let given = self.given.landing;
        // F6: the image of the given start itself
        if a == 0.0 {
            return Ok(given);
        }
        let flown = self.starts_within(a).and_then(|(start, near)| Some((self.fly_from(&start)?, near)));
        let (flown, near) = flown.ok_or(Undecided::endless())?;
        if (flown.landing.wall, flown.landing.turns) != (given.wall, given.turns) {
            return Err(Undecided::endless());
        }
        // Both columns in the units of the given start's.
        let unit = Ball::exact(2f64.powi(flown.exponent - self.given.exponent));
        let Sheared { time, slope, velocity } = flown.landing.jacobian;
        let jacobian = Sheared { time: time.map(|x| x * unit), slope, velocity: velocity.map(|x| x * unit) };
        self.curve = Some((flown, near));
        Ok(Landing { jacobian, ..given })
    }

    fn on_wall(&self) -> Option<(OnWall, &[Exact])> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use crate::tests::{scene, scene_of};

    fn spliced(scene: &Scene, splice: u64, impacts: u64) -> Result<Orbit, Error> {
        let settings =
            Settings { arithmetic: Arithmetic::Shadow, digits: 6, impacts: Some(impacts), ..Settings::default() };
        Orbit::of(scene, Settings { splice, ..settings })
    }

    /// The given start is on the curve: its own impacts, found by rising precision, are among those of the first ones. After them the
    /// chain goes on, and the start is nearer by as much as the orbit has stretched.
    #[test]
    fn the_first_impacts_are_those_of_the_given_start_too() {
        for (name, splice, digits) in [("figure-14", 200, 30), ("figure-16", 150, 15), ("figure-17", 200, 25)] {
            let scene = scene(name);
            let mut orbit = spliced(&scene, splice, 5000).unwrap();
            let exact =
                Orbit::of(&scene, Settings { impacts: Some(splice - 1), digits: 40, ..Settings::default() }).unwrap();
            let bounds = exact.clock().clone();
            for theirs in exact {
                let ours = orbit.next().unwrap();
                assert_eq!((ours.wall, ours.turns, ours.mapping), (theirs.wall, theirs.turns, theirs.mapping));
                let [(phase, velocity), (at, speed)] = [ours.enclosures(), theirs.enclosures()];
                assert!(phase.contains_enclosure(&at.rounded(120)) || phase.intersection(&at).is_some());
                assert!(velocity.intersection(&speed).is_some(), "{}", bounds.velocity(&speed).mid_rad().0);
            }
            assert_eq!(orbit.by_ref().count() as u64, 5000 - (splice - 1), "{name}");
            let near = orbit.shadow().unwrap();
            let width = near.time.wid().to_f64_up().max(near.velocity.wid().to_f64_up());
            assert!(width < 10f64.powi(-digits), "{name}: {width:e}");
        }
    }

    #[test]
    fn resting_and_regular_orbits_are_not_spliced() {
        let start = "time = 0, wall = \"left\", velocity = -5";
        let rests = scene_of("amplitude = 4.92, frequency = \"pi\", phase = 0", "gap = 40, restitution = 0.5", start);
        let error = spliced(&rests, 100, 200).unwrap_err();
        assert!(error.to_string().contains("splice is 100, but it must be"), "{error}");
        assert!(spliced(&scene("figure-12"), 100, 200).unwrap().shadow().is_none());
    }
}
