//! The next impacts of many states, each by itself, with states and bounds as doubles.

use super::dense::PhaseConverter;
use super::given::Given;
use super::{Clock, Start};
use crate::Error;
use crate::contact::Undecided;
use crate::exact::Exact;
use crate::mapping::Mapping;
use crate::pair::{ImpactPair, Wall};
use crate::shaken::{Location, Origin, State};
use crate::turns;

/// Encloses the impact that follows a state on a wall, for one pair.
///
/// ```
/// use impact_pair::orbit::Arrivals;
/// use impact_pair::pair::Wall;
/// use impact_pair::{Harmonic, ImpactPair};
/// // (66)-(69): with d = 3 pi and v = -4 pi on the left wall at t = 0 the ball is on the right one at t = 1.
/// let harmonic = Harmonic::new("1".parse()?, "pi".parse()?, "0".parse()?)?;
/// let pair = ImpactPair::new(harmonic, "3*pi".parse()?, "0.5".parse()?)?;
/// let next = Arrivals::new(&pair)?.next(Wall::Left, 0.0, -12.566370614359172)?.unwrap();
/// assert!(next.wall == Wall::Right && next.time[0] < 1.0 + 1e-14 && next.time[1] > 1.0 - 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Arrivals {
    clock: Clock,
    given: Given,
    dial: PhaseConverter,
}

/// The impact that follows a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// The wall.
    pub wall: Wall,
    /// The mapping that leads there.
    pub mapping: Mapping,
    /// Bounds of the time of the impact \[time\].
    pub time: [f64; 2],
    /// Bounds of `y'` just before the impact \[length/time\].
    pub velocity: [f64; 2],
}

impl Arrivals {
    /// The impact map of a pair, with states and bounds as doubles.
    ///
    /// # Errors
    /// If a value is beyond the range of double-precision flights.
    pub fn new(pair: &ImpactPair) -> Result<Self, Error> {
        let zero = Exact::from(0);
        let clock = Clock::new(pair, &zero, f64::MANTISSA_DIGITS)?;
        let given = Given::new(pair, &Start::on_wall(zero.clone(), Wall::Left, zero)?, &clock)?;
        let dial = PhaseConverter::new(&clock);
        Ok(Self { clock, given, dial })
    }

    /// Encloses the impact after an exact state: wall, time, and velocity just before the impact on that wall.
    ///
    /// **Enclosure** (Lemmas C1-C6): for all parameters of the pair the next contact with a wall is on the returned wall and in its bounds.
    /// **Undecided when** doubles do not decide the contact, and where the ball comes to rest instead.
    ///
    /// # Errors
    /// If a number is not finite or beyond the accepted range, or if the velocity does not point at the wall.
    pub fn next(&self, wall: Wall, time: f64, velocity: f64) -> Result<Result<Arrival, Undecided>, Error> {
        let refused = |key: &str, value: f64, accepted: &str| {
            Error::out_of_range(key, format!("{key} is {value}, but {accepted}"))
        };
        let (turns, phase) = self
            .dial
            .phase(time)
            .ok_or_else(|| refused("start.time", time, "must be a number of forcing periods below 2^62"))?;
        let points = wall.sign() * velocity <= 0.0;
        let reduced = self.dial.velocity(velocity).filter(|_| points);
        let velocity =
            reduced.ok_or_else(|| refused("start.velocity", velocity, "must be finite and point at the wall"))?;
        let origin = Origin::of(State { place: Location::Wall(wall), turns, phase, velocity });
        Ok(self.given.shaken.clone().interval(&origin).next_contact().and_then(|contact| {
            let turns = turns::after(turns, contact.turns).ok_or_else(Undecided::endless)?;
            let [phase, reached] = [contact.phase, contact.velocity].map(crate::impact::finite);
            Ok(Arrival {
                wall: contact.wall,
                mapping: Mapping::between(wall, contact.wall),
                time: self.clock.time(turns, &phase).to_f64_bounds().into(),
                velocity: self.clock.velocity(&reached).to_f64_bounds().into(),
            })
        }))
    }
}
