//! An event of an orbit as it is handed on, with its bounds.

use std::fmt;

use serde::{Serialize, Serializer};

use impact_pair_document::{Between, Decimal, EventDocument, EventName, NotNegative, Skipped};
use impact_pair_model::{EventKind, Miss};

use crate::exact::{Enclosure, decimal_bounds, decimal_digits, decimal_f64};
use crate::orbit::{Impact, Orbit, Progress};
use crate::pair::Wall;

/// An event of an orbit with its bounds in the units of the scene.
#[derive(Clone, Debug)]
pub struct Event {
    /// The wall.
    pub wall: Wall,
    /// Time of the event \[time\].
    pub time: Bounds,
    /// The kind of the event.
    pub kind: EventKind<Bounds>,
}

impl Event {
    /// Returns the event of an impact of `orbit`.
    pub fn new(orbit: &Orbit, impact: &Impact) -> Self {
        let (time, velocity) = orbit.bounds(impact);
        let Impact { index, mapping, wall, .. } = *impact;
        let velocity = Bounds::of(orbit, velocity);
        Self { wall, time: Bounds::of(orbit, time), kind: EventKind::Impact { index, mapping, velocity } }
    }

    /// Returns the event that `progress` of `orbit` is, if it is one.
    pub fn of(orbit: &Orbit, progress: &Progress) -> Option<Self> {
        let (wall, time, kind) = match progress {
            Progress::Impact(impact) => return Some(Self::new(orbit, impact)),
            Progress::Rest(rest) => {
                (rest.at.wall, orbit.rest_time(rest), EventKind::Rest { is_accumulation: rest.is_accumulation })
            }
            Progress::Graze(graze) => {
                let (distance, speed) = orbit.graze_bounds(graze);
                let [distance, speed] = [distance, speed].map(|x| Bounds::of(orbit, x));
                (graze.at.wall, orbit.touch_time(&graze.at), EventKind::Graze { miss: Some(Miss { distance, speed }) })
            }
            Progress::Release(release) => (release.wall, orbit.touch_time(release), EventKind::Release),
            Progress::Retraced(_) | Progress::Ended => return None,
        };
        Some(Self { wall, time: Bounds::of(orbit, time), kind })
    }

    /// Returns the relative velocity `y'` just before the impact \[length/time\], if it is one.
    pub fn velocity(&self) -> Option<&Bounds> {
        match &self.kind {
            EventKind::Impact { velocity, .. } => Some(velocity),
            EventKind::Graze { .. } | EventKind::Rest { .. } | EventKind::Release => None,
        }
    }

    /// Returns the word of the orbit JSON.
    pub fn name(&self) -> EventName {
        match self.kind {
            EventKind::Impact { .. } => EventName::Impact,
            EventKind::Graze { .. } => EventName::Graze,
            EventKind::Rest { .. } => EventName::Rest,
            EventKind::Release => EventName::Release,
        }
    }
}

/// For the eye: `impact 3 on the right wall, t = 2.487100613920(68,71), v = 28.64282411803(57,69)`.
impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name())?;
        if let EventKind::Impact { index, .. } = &self.kind {
            write!(f, " {index}")?;
        }
        write!(f, " on the {} wall, t = {}", self.wall.name(), self.time)?;
        self.velocity().map_or(Ok(()), |velocity| write!(f, ", v = {velocity}"))
    }
}

/// As in the orbit JSON.
impl Serialize for Event {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        EventDocument::from(self).serialize(serializer)
    }
}

/// The events of an orbit, one after another, each with its bounds.
#[derive(Debug)]
pub struct Events<'o> {
    orbit: &'o mut Orbit,
}

impl Orbit {
    /// Returns an iterator over the following events: impacts, grazes, rests, releases, each with its bounds in the units of the scene.
    ///
    /// Enclosures and costs are those of the orbit; afterwards [`Orbit::outcome`] has its outcome.
    ///
    /// ```
    /// use impact_pair::Scene;
    /// use impact_pair::orbit::Orbit;
    /// let scene = Scene::parse(r#"
    ///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
    ///     pair = { gap = 9.42497, restitution = 0.5 }
    ///     start = { time = 0, wall = "left", velocity = -12.56636 }
    ///     run = { impacts = 2 }
    /// "#)?;
    /// let mut orbit = Orbit::new(scene.pair(), scene.start(), scene.settings())?;
    /// for event in orbit.events() {
    ///     let (low, high) = event.time.enclosure().to_f64_bounds();
    ///     println!("{event}"); // impact 1 on the right wall, t = 0.55134802021852(08,17), v = 35.452637601234(54,65)
    ///     assert!(0.5 < low && low < high && high < 2.0);
    /// }
    /// # Ok::<(), impact_pair::Error>(())
    /// ```
    pub fn events(&mut self) -> Events<'_> {
        Events { orbit: self }
    }
}

impl Iterator for Events<'_> {
    type Item = Event;

    fn next(&mut self) -> Option<Event> {
        loop {
            let step = self.orbit.advance();
            if step == Progress::Ended {
                return None;
            }
            if let Some(event) = Event::of(self.orbit, &step) {
                return Some(event);
            }
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
            distance: None,
            speed: None,
        };
        match &event.kind {
            EventKind::Impact { index, mapping, velocity } => {
                let velocity = Some(velocity.document());
                Self { index: Some(*index), mapping: Some(*mapping), velocity, ..plain }
            }
            EventKind::Rest { is_accumulation: true } => Self { skipped: Some(Skipped::Infinite), ..plain },
            EventKind::Graze { miss: Some(Miss { distance, speed }) } => {
                let [_, speed] = &*speed.document();
                let speed = Some(NotNegative::printed(speed.text().to_owned()));
                Self { distance: Some(distance.document()), speed, ..plain }
            }
            EventKind::Rest { is_accumulation: false } | EventKind::Graze { miss: None } | EventKind::Release => plain,
        }
    }
}

/// A number: exact, enclosed, or computed.
#[derive(Clone, Debug)]
pub enum Bounds {
    /// Proved bounds.
    Certified(Enclosure),
    /// A computed approximation, not certified.
    Float(Enclosure),
}

impl Bounds {
    /// Returns the number `x` of an orbit: certified, or computed by a non-rigorous arithmetic.
    fn of(orbit: &Orbit, x: Enclosure) -> Self {
        if orbit.arithmetic().is_certified() { Self::Certified(x) } else { Self::Float(x) }
    }

    /// Returns the number.
    pub fn enclosure(&self) -> &Enclosure {
        let (Self::Certified(x) | Self::Float(x)) = self;
        x
    }

    /// Returns the lower and the upper bound, rounded outward; of a float, the shortest decimal of the double twice.
    pub fn decimals(&self) -> [String; 2] {
        match self {
            Self::Certified(x) => decimal_bounds(x),
            Self::Float(x) => {
                let x = decimal_f64(x.mid_rad().0);
                [x.clone(), x]
            }
        }
    }

    fn document(&self) -> Between<Decimal> {
        Between::computed(self.decimals().map(Decimal::printed))
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
