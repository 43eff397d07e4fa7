//! How an orbit ended, in words and in JSON.

use std::fmt;

use serde_json::{Value, json};

use super::event::{Bounds, Event};
use super::periodic::{measured, orbit_json};
use crate::contact::Reason;
use crate::exact::{Enclosure, Exact, decimal_bounds, decimal_digits};
use crate::orbit::{Orbit, Outcome, Period, Start};
use crate::pair::Wall;
use crate::periodic::Attractor;

/// How an orbit ended, in words: the `outcome` of the orbit JSON.
#[derive(Clone, Debug)]
pub struct Conclusion {
    kind: &'static str,
    message: String,
    doubt: Option<Doubt>,
    period: Option<Period>,
    attractor: Option<Value>,
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
        let said = |message: String| Self { kind, message, doubt: None, period: None, attractor: None };
        match orbit.outcome() {
            Some(Outcome::ImpactsReached) => said(counted(index)),
            Some(Outcome::TimeReached) => said(format!("{} up to the time asked for", counted(index))),
            Some(Outcome::Periodic(period)) => {
                let Period { cycles, impacts } = *period;
                let every = every(impacts, cycles);
                let message = format!("{}; proved to repeat exactly for ever, {every}", counted(index));
                Self { period: Some(*period), ..said(message) }
            }
            Some(Outcome::Attracted(attractor)) => {
                let Attractor { word, cycles, from, .. } = &**attractor;
                let every = every(word.mappings().len() as u64, u64::from(*cycles));
                let message = format!(
                    "{}; proved to converge to a stable orbit of {every} ({word}), from impact {from} on",
                    counted(index)
                );
                Self { attractor: Some(attractor_json(orbit, attractor)), ..said(message) }
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
            if let (Value::Object(outcome), Some(Value::Object(attractor))) = (&mut outcome, &self.attractor) {
                outcome.extend(attractor.clone());
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

fn every(impacts: u64, cycles: u64) -> String {
    let cycles = if cycles == 1 { "cycle".into() } else { format!("{cycles} cycles") };
    format!("{} every {cycles}", counted(impacts))
}

/// What the outcome says of the orbit that the motion converges to.
fn attractor_json(orbit: &Orbit, attractor: &Attractor) -> Value {
    json!({
        "word": attractor.word.to_string(),
        "cycles": attractor.cycles,
        "from": attractor.from,
        "orbit": orbit_json(&measured(&attractor.orbit, |velocity| orbit.clock().velocity(velocity))),
    })
}

fn explanation(reason: Reason) -> &'static str {
    match reason {
        Reason::Graze => "a wall may be touched with no velocity",
        Reason::Width => "the set of states has become too wide for one answer",
        Reason::Precision => "the next impact cannot be enclosed to the digits asked for",
        Reason::Budget => "the flight is too long to follow, or has no provable end",
    }
}
