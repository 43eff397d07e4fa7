//! An event of an orbit as it is handed on, with its bounds.

use std::fmt;

use super::document::is_certified;
use crate::exact::{Enclosure, decimal_bounds, decimal_digits, decimal_f64};
use crate::mapping::Mapping;
use crate::orbit::{Impact, Orbit, Progress};
use crate::pair::Wall;

/// An event of an orbit with its bounds in the units of the scene. Its `Display` is the JSON of one line.
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
    pub fn name(&self) -> &'static str {
        match self.kind {
            Kind::Impact { .. } => "impact",
            Kind::Graze => "graze",
            Kind::Rest { .. } => "rest",
            Kind::Release => "release",
        }
    }
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Names and decimals need no escapes. Written by hand, since an orbit has millions of these.
        write!(f, r#"{{"event":"{}","#, self.name())?;
        if let Kind::Impact { mapping, .. } = self.kind {
            write!(f, r#""index":{},"mapping":"#, self.index)?;
            match mapping {
                Some(mapping) => write!(f, r#""{mapping}","#)?,
                None => f.write_str("null,")?,
            }
        }
        let [t0, t1] = self.time.decimals();
        write!(f, r#""wall":"{}","time":["{t0}","{t1}"]"#, self.wall.name())?;
        match &self.kind {
            Kind::Impact { velocity, .. } => {
                let [v0, v1] = velocity.decimals();
                write!(f, r#","velocity":["{v0}","{v1}"]}}"#)
            }
            Kind::Rest { is_accumulation: true } => f.write_str(r#","skipped":"infinite"}"#),
            Kind::Rest { is_accumulation: false } | Kind::Graze | Kind::Release => f.write_str("}"),
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
