//! What an orbit is handed on as: the orbit JSON, schema `impact-pair/orbit/1`, and its lines.
//!
//! Bounds are decimal strings rounded outward: the truth lies in `[lower, upper]`. A document is one object: the [`head`], the
//! `outcome` and the `events`. As JSON Lines it is the head alone, one event a line, and at last `{"outcome": ...}`, which is
//! not known before. Runs in `float` have `"certified": false`, and both bounds are the double itself.

use std::fmt;
use std::io::{self, Write};

use serde_json::{Map, Value, json};

use crate::contact::Reason;
use crate::exact::{Enclosure, Exact, decimal_bounds, decimal_digits, decimal_f64};
use crate::mapping::Mapping;
use crate::orbit::{Arithmetic, Impact, Orbit, Outcome, Place, Start};
use crate::pair::{ImpactPair, Wall};

/// The schema of the orbit JSON.
pub const ORBIT_SCHEMA: &str = "impact-pair/orbit/1";
/// The program that certifies.
pub const PROGRAM: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// The orbit JSON without its outcome and its events: whose orbit it is, and what certifies it.
pub fn head(pair: &ImpactPair, start: &Start, arithmetic: Arithmetic) -> Map<String, Value> {
    let entries = [
        ("schema", json!(ORBIT_SCHEMA)),
        ("program", json!(PROGRAM)),
        ("scene", scene(pair, start)),
        ("certified", json!(is_certified(arithmetic))),
        ("arithmetic", json!({"kind": kind(arithmetic), "bits": f64::MANTISSA_DIGITS})),
    ];
    entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
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
        Arithmetic::Auto | Arithmetic::Interval => true,
    }
}

/// The arithmetic that in the end computes.
fn kind(arithmetic: Arithmetic) -> &'static str {
    match arithmetic {
        Arithmetic::Float => "float",
        Arithmetic::Auto | Arithmetic::Interval => "interval",
    }
}

/// An event of an orbit with its bounds in the units of the scene. Its `Display` is the JSON of one line.
#[derive(Clone, Debug)]
pub struct Event {
    /// Counts the impacts from 1.
    pub index: u64,
    /// The mapping that led here; `None` for the first contact of a start inside the gap.
    pub mapping: Option<Mapping>,
    /// The wall.
    pub wall: Wall,
    /// When \[time\].
    pub time: Bounds,
    /// The relative velocity `y'` just before the impact \[length/time\].
    pub velocity: Bounds,
}

impl Event {
    /// The event of an impact of `orbit`.
    pub fn new(orbit: &Orbit, impact: &Impact) -> Self {
        let (time, velocity) = orbit.bounds(impact);
        let bounds = |x| if is_certified(orbit.arithmetic()) { Bounds::Certified(x) } else { Bounds::Float(x) };
        let Impact { index, mapping, wall, .. } = *impact;
        Self { index, mapping, wall, time: bounds(time), velocity: bounds(velocity) }
    }

    /// The word of the orbit JSON.
    pub fn name(&self) -> &'static str {
        "impact"
    }
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Names and decimals need no escapes. Written by hand, since an orbit has millions of these.
        write!(f, r#"{{"event":"{}","index":{},"mapping":"#, self.name(), self.index)?;
        match self.mapping {
            Some(mapping) => write!(f, r#""{mapping}""#)?,
            None => f.write_str("null")?,
        }
        let ([t0, t1], [v0, v1]) = (self.time.decimals(), self.velocity.decimals());
        write!(f, r#","wall":"{}","time":["{t0}","{t1}"],"velocity":["{v0}","{v1}"]}}"#, self.wall.name())
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
        match orbit.outcome() {
            Some(Outcome::ImpactsReached) => Self { kind, message: counted(index), doubt: None },
            Some(Outcome::TimeReached) => {
                Self { kind, message: format!("{} up to the time asked for", counted(index)), doubt: None }
            }
            Some(Outcome::Undecided { reason, wall, time }) => {
                let doubt = Doubt { reason: *reason, wall: *wall, time: time.clone() };
                let message = format!("undecided {after}: {} ({doubt})", explanation(*reason));
                Self { kind, message, doubt: Some(doubt) }
            }
            None => {
                let time = match last.map(|event| &event.time) {
                    Some(Bounds::Certified(time) | Bounds::Float(time)) => time.clone(),
                    None => enclosed(start.time()),
                };
                let doubt = Doubt { reason: Reason::Budget, wall: None, time: (time, None) };
                Self { kind, message: format!("interrupted {after}"), doubt: Some(doubt) }
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
        let Some(doubt) = &self.doubt else { return json!({"kind": self.kind, "message": self.message}) };
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
mod tests {
    use super::*;
    use crate::Scene;
    use crate::number::Ball;
    use crate::orbit::Settings;
    use num_rational::BigRational;
    use proptest::prelude::*;

    fn scene(amplitude: &str, start: &str) -> Scene {
        let text = format!(
            "excitation = {{ amplitude = {amplitude}, frequency = \"pi\", phase = 0 }}\n\
             pair = {{ gap = 9.42497, restitution = 0.5 }}\nstart = {{ time = 0, {start} }}"
        );
        Scene::parse(&text).unwrap()
    }

    fn value(decimal: &Value) -> BigRational {
        decimal.as_str().unwrap().parse::<Exact>().unwrap().as_rational().unwrap().clone()
    }

    fn rational(text: &str) -> BigRational {
        text.parse::<Exact>().unwrap().as_rational().unwrap().clone()
    }

    fn exact(x: f64) -> BigRational {
        BigRational::from_float(x).unwrap()
    }

    /// The document and the impacts it was made of.
    fn document(scene: &Scene, arithmetic: Arithmetic) -> (Value, Vec<Impact>) {
        let mut orbit = scene.orbit(Settings { arithmetic, ..scene.settings() }).unwrap();
        let impacts: Vec<Impact> = orbit.by_ref().collect();
        let events: Vec<Event> = impacts.iter().map(|impact| Event::new(&orbit, impact)).collect();
        let conclusion = Conclusion::of(&orbit, scene.start(), events.last());
        let mut text = Vec::new();
        write_json(&mut text, &head(scene.pair(), scene.start(), arithmetic), &conclusion, &events).unwrap();
        (serde_json::from_slice(&text).unwrap(), impacts)
    }

    fn brackets(bounds: &Value, ball: Ball, map: impl Fn(BigRational) -> BigRational) -> bool {
        let (low, high) = (exact(ball.mid()) - exact(ball.rad()), exact(ball.mid()) + exact(ball.rad()));
        value(&bounds[0]) <= map(low) && map(high) <= value(&bounds[1])
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        /// With W = pi a time is 2 (turns + phase) and a velocity d/2 of a reduced one: rational, so exactly comparable.
        #[test]
        fn printed_bounds_hold_the_balls_they_come_from(amplitude in 0.0..12.0f64, velocity in -20.0..0.0f64, inside in any::<bool>()) {
            let start = if inside { "position = 0.3" } else { "wall = \"left\"" };
            let scene = scene(&format!("{amplitude:?}"), &format!("{start}, velocity = {velocity:?}"));
            let (document, impacts) = document(&scene, Arithmetic::Interval);
            let events = document["events"].as_array().unwrap();
            prop_assert_eq!(events.len(), impacts.len());
            for (event, impact) in events.iter().zip(&impacts) {
                let turns = BigRational::from_integer(impact.turns.into());
                prop_assert!(brackets(&event["time"], impact.phase, |u| (u + &turns) * rational("2")));
                prop_assert!(brackets(&event["velocity"], impact.velocity, |v| v * rational("9.42497/2")));
                prop_assert_eq!(&event["index"], &json!(impact.index));
                prop_assert_eq!(&event["wall"], &json!(impact.wall.name()));
            }
        }
    }

    #[test]
    fn the_document_has_the_words_of_the_schema_in_their_order() {
        let (document, _) = document(&scene("1", "wall = \"left\", velocity = -12.56636"), Arithmetic::Auto);
        let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>().join(" ");
        assert_eq!(keys(&document), "schema program scene certified arithmetic outcome events");
        assert_eq!(keys(&document["events"][0]), "event index mapping wall time velocity");
        assert_eq!(document["schema"], "impact-pair/orbit/1");
        assert_eq!(document["outcome"], json!({"kind": "impacts-reached", "message": "100 impacts"}));
        assert_eq!(document["arithmetic"], json!({"kind": "interval", "bits": 53}));
        assert_eq!(
            document["scene"],
            json!({
                "excitation": {"amplitude": ["1"], "frequency": ["pi"], "phase": ["0"]},
                "gap": "9.42497", "restitution": "0.5",
                "start": {"time": "0", "wall": "left", "velocity": "-12.56636"},
            })
        );
    }

    #[test]
    fn the_first_contact_of_a_start_inside_has_no_mapping() {
        let (document, _) = document(&scene("1", "position = 0.25, velocity = -3"), Arithmetic::Auto);
        assert_eq!(document["events"][0]["mapping"], Value::Null);
        assert_eq!(document["scene"]["start"], json!({"time": "0", "position": "0.25", "velocity": "-3"}));
    }

    #[test]
    fn an_undecided_outcome_carries_its_reason_and_enclosure() {
        let (document, impacts) = document(&scene("8", "wall = \"left\", velocity = -12.56636"), Arithmetic::Auto);
        let outcome = &document["outcome"];
        assert_eq!((&outcome["kind"], &outcome["reason"]), (&json!("undecided"), &json!("precision")));
        assert_eq!(outcome["wall"], "right");
        let last = document["events"].as_array().unwrap().last().unwrap();
        assert!(value(&last["time"][1]) < value(&outcome["time"][0]));
        assert!(value(&outcome["time"][0]) < value(&outcome["time"][1]));
        let expected = format!("undecided after impact {}: ", impacts.len());
        assert!(outcome["message"].as_str().unwrap().starts_with(&expected));
        // Nothing is said of what would end it: the time is open.
        let (still, _) = self::document(&scene("0", "wall = \"left\", velocity = 0"), Arithmetic::Auto);
        assert_eq!(still["outcome"]["time"][1], Value::Null);
        assert_eq!(still["events"], json!([]));
    }

    #[test]
    fn an_orbit_that_did_not_end_was_interrupted() {
        let scene = scene("1", "wall = \"left\", velocity = -12.56636");
        let mut orbit = scene.orbit(scene.settings()).unwrap();
        let before = Conclusion::of(&orbit, scene.start(), None).json();
        assert_eq!(
            before,
            json!({"kind": "undecided", "reason": "budget", "message": "interrupted before the first impact", "time": ["0", null]})
        );
        let event = orbit.next().map(|impact| Event::new(&orbit, &impact));
        let after = Conclusion::of(&orbit, scene.start(), event.as_ref()).json();
        assert_eq!(after["message"], "interrupted after impact 1");
        assert!(value(&after["time"][0]) > rational("1") && after["time"][1].is_null());
    }

    #[test]
    fn floats_claim_nothing() {
        let (document, impacts) = document(&scene("1", "wall = \"left\", velocity = -12.56636"), Arithmetic::Float);
        assert_eq!(document["certified"], false);
        assert_eq!(document["arithmetic"], json!({"kind": "float", "bits": 53}));
        for (event, impact) in document["events"].as_array().unwrap().iter().zip(impacts) {
            let time: f64 = event["time"][0].as_str().unwrap().parse().unwrap();
            assert_eq!(event["time"][0], event["time"][1]);
            let expected = 2.0 * (impact.turns as f64 + impact.phase.mid());
            assert!((time - expected).abs() <= 2.0 * f64::EPSILON * expected);
        }
    }
}
