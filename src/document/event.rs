//! An event of an orbit as it is handed on, with its bounds.

use std::fmt;

use impact_pair_certificate::document::{Decimal, EventDocument, EventName, Skipped};

use super::orbit::is_certified;
use crate::exact::{Enclosure, decimal_bounds, decimal_digits, decimal_f64};
use crate::mapping::Mapping;
use crate::orbit::{Impact, Orbit, Progress};
use crate::pair::Wall;

/// An event of an orbit with its bounds in the units of the scene.
#[derive(Clone, Debug)]
pub struct Event {
    /// Counts the impacts from 1; for other events the last impact's.
    pub index: u64,
    /// The wall.
    pub wall: Wall,
    /// When \[time\].
    pub time: Bounds,
    /// What happens.
    pub kind: Kind,
}

/// What happens at an event.
#[derive(Clone, Debug)]
pub enum Kind {
    /// The ball hits the wall.
    Impact {
        /// The mapping that led here; `None` for the first contact of a start inside the gap, and where a graze of the other
        /// wall may have been a touch.
        mapping: Option<Mapping>,
        /// The relative velocity `y'` just before the impact \[length/time\].
        velocity: Bounds,
    },
    /// The wall is touched with no velocity, or nearly so, or nearly touched.
    Graze,
    /// The ball comes to rest on the wall.
    Rest {
        /// After infinitely many impacts that are not listed.
        is_accumulation: bool,
    },
    /// The ball leaves the wall that it rested on.
    Release,
}

impl Event {
    /// The event of an impact of `orbit`.
    pub fn new(orbit: &Orbit, impact: &Impact) -> Self {
        let (time, velocity) = orbit.bounds(impact);
        let Impact { index, mapping, wall, .. } = *impact;
        let velocity = Bounds::of(orbit, velocity);
        Self { index, wall, time: Bounds::of(orbit, time), kind: Kind::Impact { mapping, velocity } }
    }

    /// The event that `progress` of `orbit` is, after `index` impacts, if it is one.
    pub fn of(orbit: &Orbit, progress: &Progress, index: u64) -> Option<Self> {
        let (wall, time, kind) = match progress {
            Progress::Impact(impact) => return Some(Self::new(orbit, impact)),
            Progress::Rest(rest) => {
                (rest.wall, orbit.rest_time(rest), Kind::Rest { is_accumulation: rest.is_accumulation })
            }
            Progress::Graze(graze) => (graze.wall, orbit.graze_time(graze), Kind::Graze),
            Progress::Release(release) => (release.wall, orbit.release_time(release), Kind::Release),
            Progress::Retraced(_) | Progress::Ended => return None,
        };
        Some(Self { index, wall, time: Bounds::of(orbit, time), kind })
    }

    /// The word of the orbit JSON.
    pub fn name(&self) -> EventName {
        match self.kind {
            Kind::Impact { .. } => EventName::Impact,
            Kind::Graze => EventName::Graze,
            Kind::Rest { .. } => EventName::Rest,
            Kind::Release => EventName::Release,
        }
    }
}

impl From<&Event> for EventDocument {
    fn from(event: &Event) -> Self {
        let plain = Self {
            event: event.name(),
            index: None,
            mapping: None,
            wall: event.wall,
            time: event.time.document(),
            velocity: None,
            skipped: None,
        };
        match &event.kind {
            Kind::Impact { mapping, velocity } => {
                let velocity = Some(velocity.document());
                Self { index: Some(event.index), mapping: Some(*mapping), velocity, ..plain }
            }
            Kind::Rest { is_accumulation: true } => Self { skipped: Some(Skipped::Infinite), ..plain },
            Kind::Rest { is_accumulation: false } | Kind::Graze | Kind::Release => plain,
        }
    }
}

/// What is known of a number.
#[derive(Clone, Debug)]
pub enum Bounds {
    /// It is proved to lie in here.
    Certified(Enclosure),
    /// It was computed to be about this; nothing is claimed.
    Float(Enclosure),
}

impl Bounds {
    /// What `orbit` knows of a number.
    fn of(orbit: &Orbit, x: Enclosure) -> Self {
        if is_certified(orbit.arithmetic()) { Self::Certified(x) } else { Self::Float(x) }
    }

    /// What it is known by.
    pub fn enclosure(&self) -> &Enclosure {
        let (Self::Certified(x) | Self::Float(x)) = self;
        x
    }

    /// The lower and the upper bound, rounded outward; of a float, the shortest decimal of the double twice.
    pub fn decimals(&self) -> [String; 2] {
        match self {
            Self::Certified(x) => decimal_bounds(x),
            Self::Float(x) => {
                let x = decimal_f64(x.mid_rad().0);
                [x.clone(), x]
            }
        }
    }

    fn document(&self) -> [Decimal; 2] {
        self.decimals().map(Decimal::printed)
    }
}

/// For the eye: [`decimal_digits`] of an enclosure, the shortest decimal of a float.
impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&match self {
            Self::Certified(x) => decimal_digits(x),
            Self::Float(x) => decimal_f64(x.mid_rad().0),
        })
    }
}
