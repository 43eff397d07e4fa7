//! What an orbit is handed on as: the orbit JSON, schema `impact-pair/orbit/1`, and its lines.
//!
//! Bounds are decimal strings rounded outward: the truth lies in `[lower, upper]`. A document is one object: the [`head`], the
//! `outcome` and the `events`. As JSON Lines it is the head alone, one event a line, and at last `{"outcome": ..., "arithmetic":
//! ...}`, which are not known before. Runs in `float` have `"certified": false`, and both bounds are the double itself.

use std::fmt;
use std::io::{self, Write};

use serde_json::{Map, Value, json};

use crate::contact::Reason;
use crate::exact::{Enclosure, Exact, decimal_bounds, decimal_digits, decimal_f64};
use crate::mapping::Mapping;
use crate::orbit::{Arithmetic, Impact, Orbit, Outcome, Period, Place, Progress, Settings, Start};
use crate::pair::{ImpactPair, Wall};

/// The schema of the orbit JSON.
pub const ORBIT_SCHEMA: &str = "impact-pair/orbit/1";
/// The program that certifies.
pub const PROGRAM: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// The orbit JSON without its outcome and its events: whose orbit it is, and what certifies it.
///
/// `computed` is what [`arithmetic`] says of it when it has ended, or [`asked_arithmetic`] before.
pub fn head(pair: &ImpactPair, start: &Start, arithmetic: Arithmetic, computed: Value) -> Map<String, Value> {
    let entries = [
        ("schema", json!(ORBIT_SCHEMA)),
        ("program", json!(PROGRAM)),
        ("scene", scene(pair, start)),
        ("certified", json!(is_certified(arithmetic))),
        ("arithmetic", computed),
    ];
    entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

/// What computed an orbit: `float` or `interval` with 53 bits, or `multiprecision` with those of its first impact.
pub fn arithmetic(orbit: &Orbit) -> Value {
    let kind = match (orbit.arithmetic(), orbit.bits()) {
        (Arithmetic::Float, _) => "float",
        (_, f64::MANTISSA_DIGITS) => "interval",
        _ => "multiprecision",
    };
    json!({"kind": kind, "bits": orbit.bits()})
}

/// The same before the orbit is computed: `auto` does not know yet.
pub fn asked_arithmetic(settings: &Settings) -> Value {
    match settings.arithmetic {
        Arithmetic::Auto => json!({"kind": "auto", "max_bits": settings.max_bits}),
        Arithmetic::Float => json!({"kind": "float", "bits": f64::MANTISSA_DIGITS}),
        Arithmetic::Interval => json!({"kind": "interval", "bits": f64::MANTISSA_DIGITS}),
        Arithmetic::Bits(bits) => json!({"kind": "multiprecision", "bits": bits}),
    }
}

/// The exact parameters and initial data, each in its own words.
pub fn scene(pair: &ImpactPair, start: &Start) -> Value {
    let excitation = pair.excitation();
    let [amplitude, frequency, phase] =
        [excitation.amplitude(), excitation.frequency(), excitation.phase()].map(|term| json!([term.text()]));
    let (place, at) = match start.place() {
        Place::Wall(wall) => ("wall", wall.name().to_owned()),
        Place::Inside(position) => ("position", position.text()),
    };
    json!({
        "excitation": {"amplitude": amplitude, "frequency": frequency, "phase": phase},
        "gap": pair.gap().text(),
        "restitution": pair.restitution().text(),
        "start": {"time": start.time().text(), place: at, "velocity": start.velocity().text()},
    })
}

/// Whether the arithmetic proves what it computes.
pub fn is_certified(arithmetic: Arithmetic) -> bool {
    match arithmetic {
        Arithmetic::Float => false,
        Arithmetic::Auto | Arithmetic::Interval | Arithmetic::Bits(_) => true,
    }
}

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
        /// The mapping that led here; `None` for the first contact of a start inside the gap.
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

/// How an orbit ended, in words: the `outcome` of the orbit JSON.
#[derive(Clone, Debug)]
pub struct Conclusion {
    kind: &'static str,
    message: String,
    doubt: Option<Doubt>,
    period: Option<Period>,
}

/// What is known of the event that was not decided.
#[derive(Clone, Debug)]
struct Doubt {
    reason: Reason,
    wall: Option<Wall>,
    time: (Enclosure, Option<Enclosure>),
}

impl Conclusion {
    /// The conclusion of an orbit that has ended; that of an interrupted one otherwise. `last` is its last event.
    pub fn of(orbit: &Orbit, start: &Start, last: Option<&Event>) -> Self {
        let index = last.map_or(0, |event| event.index);
        let after = if index == 0 { "before the first impact".into() } else { format!("after impact {index}") };
        let kind = orbit.outcome().map_or("undecided", Outcome::kind);
        let said = |message: String| Self { kind, message, doubt: None, period: None };
        match orbit.outcome() {
            Some(Outcome::ImpactsReached) => said(counted(index)),
            Some(Outcome::TimeReached) => said(format!("{} up to the time asked for", counted(index))),
            Some(Outcome::Periodic(period)) => {
                let Period { cycles, impacts } = *period;
                let every = format!("{} every {cycles} cycle{}", counted(impacts), if cycles == 1 { "" } else { "s" });
                let message = format!("{}; proved to repeat exactly for ever, {every}", counted(index));
                Self { period: Some(*period), ..said(message) }
            }
            Some(Outcome::RestsForever(wall)) => said(format!("{after} at rest on the {} wall for ever", wall.name())),
            Some(Outcome::NeverImpacts) => said(format!("{after} no wall is ever touched again")),
            Some(Outcome::Undecided { reason, wall, time }) => {
                let doubt = Doubt { reason: *reason, wall: *wall, time: time.clone() };
                let message = format!("undecided {after}: {} ({doubt})", explanation(*reason));
                Self { doubt: Some(doubt), ..said(message) }
            }
            None => {
                let time = match last.map(|event| &event.time) {
                    Some(Bounds::Certified(time) | Bounds::Float(time)) => time.clone(),
                    None => enclosed(start.time()),
                };
                let doubt = Doubt { reason: Reason::Budget, wall: None, time: (time, None) };
                Self { doubt: Some(doubt), ..said(format!("interrupted {after}")) }
            }
        }
    }

    /// The word of the orbit JSON.
    pub fn kind(&self) -> &'static str {
        self.kind
    }

    /// One line in words.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Why it is undecided, if it is.
    pub fn reason(&self) -> Option<Reason> {
        self.doubt.as_ref().map(|doubt| doubt.reason)
    }

    /// The `outcome` of the orbit JSON.
    pub fn json(&self) -> Value {
        let Some(doubt) = &self.doubt else {
            let mut outcome = json!({"kind": self.kind, "message": self.message});
            if let Some(Period { cycles, impacts }) = self.period {
                outcome["period"] = json!({"cycles": cycles, "impacts": impacts});
            }
            return outcome;
        };
        let mut outcome = json!({"kind": self.kind, "reason": doubt.reason.name(), "message": self.message});
        if let Some(wall) = doubt.wall {
            outcome["wall"] = json!(wall.name());
        }
        let [from, to] = doubt.bounds();
        outcome["time"] = json!([from, to]);
        outcome
    }
}

impl Doubt {
    /// From when to when it may happen; open when there is no latest time.
    fn bounds(&self) -> [Option<String>; 2] {
        let (from, to) = &self.time;
        match to {
            Some(to) => decimal_bounds(&from.hull(to)).map(Some),
            None => [Some(decimal_bounds(from)[0].clone()), None],
        }
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(wall) = self.wall {
            write!(f, "{} wall, ", wall.name())?;
        }
        let (from, to) = &self.time;
        match to {
            Some(to) => write!(f, "t = {}", decimal_digits(&from.hull(to))),
            None => write!(f, "t from {}", decimal_digits(from)),
        }
    }
}

/// Bits that show the time of a start.
const START_BITS: u32 = 160;

fn enclosed(x: &Exact) -> Enclosure {
    x.enclose(START_BITS)
}

fn counted(impacts: u64) -> String {
    if impacts == 1 { "1 impact".into() } else { format!("{impacts} impacts") }
}

fn explanation(reason: Reason) -> &'static str {
    match reason {
        Reason::Graze => "a wall may be touched with no velocity",
        Reason::Width => "the set of states has become too wide for one answer",
        Reason::Precision => "the next impact cannot be enclosed to the digits asked for",
        Reason::Budget => "the flight is too long to follow, or has no provable end",
    }
}

/// Writes the orbit JSON, an event a line.
///
/// # Errors
/// Those of `out`.
pub fn write_json(
    out: &mut impl Write,
    head: &Map<String, Value>,
    conclusion: &Conclusion,
    events: &[Event],
) -> io::Result<()> {
    out.write_all(b"{")?;
    for (key, value) in head {
        writeln!(out, "{}:{value},", json!(key))?;
        out.write_all(b" ")?;
    }
    write!(out, "\"outcome\":{},\n \"events\":[", conclusion.json())?;
    for (i, event) in events.iter().enumerate() {
        write!(out, "{}\n  {event}", if i == 0 { "" } else { "," })?;
    }
    out.write_all(b"]}\n")
}

#[cfg(test)]
mod tests;
