//! How an orbit ended, in words and as a document.

use std::fmt;

use impact_pair_certificate::document::{Decimal, OutcomeDocument, PeriodicOrbitDocument, bounds};

use super::event::Event;
use super::periodic::{measured, periodic_orbit};
use crate::contact::Reason;
use crate::exact::{Enclosure, Exact, decimal_digits};
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
    attracted: Option<Attracted>,
}

/// What the outcome says of the orbit that the motion converges to.
#[derive(Clone, Debug)]
struct Attracted {
    word: String,
    cycles: u32,
    from: u64,
    orbit: PeriodicOrbitDocument,
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
        let said = |message: String| Self { kind, message, doubt: None, period: None, attracted: None };
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
                let found = &attractor.orbit;
                let units = |velocity: &Enclosure| orbit.clock().velocity(velocity);
                let orbit = periodic_orbit(&measured(found, units));
                let attracted = Attracted { word: word.to_string(), cycles: *cycles, from: *from, orbit };
                Self { attracted: Some(attracted), ..said(message) }
            }
            Some(Outcome::RestsForever(wall)) => said(format!("{after} at rest on the {} wall for ever", wall.name())),
            Some(Outcome::NeverImpacts) => said(format!("{after} no wall is ever touched again")),
            Some(Outcome::Undecided { reason, wall, time }) => {
                let doubt = Doubt { reason: *reason, wall: *wall, time: time.clone() };
                let message = format!("undecided {after}: {} ({doubt})", explanation(*reason));
                Self { doubt: Some(doubt), ..said(message) }
            }
            None => {
                let time = last.map_or_else(|| enclosed(start.time()), |event| event.time.enclosure().clone());
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
    pub fn document(&self) -> OutcomeDocument {
        let plain = OutcomeDocument::new(self.kind, self.message.clone());
        if let Some(doubt) = &self.doubt {
            let (reason, time) = (Some(doubt.reason.name().to_owned()), Some(doubt.bounds()));
            return OutcomeDocument { reason, wall: doubt.wall, time, ..plain };
        }
        let Some(Attracted { word, cycles, from, orbit }) = self.attracted.clone() else {
            return OutcomeDocument { period: self.period, ..plain };
        };
        OutcomeDocument { word: Some(word), cycles: Some(cycles), from: Some(from), orbit: Some(orbit), ..plain }
    }
}

impl Doubt {
    /// From when to when it may happen; open when there is no latest time.
    fn bounds(&self) -> [Option<Decimal>; 2] {
        let (from, to) = &self.time;
        match to {
            Some(to) => bounds(&from.hull(to)).map(Some),
            None => {
                let [earliest, _] = bounds(from);
                [Some(earliest), None]
            }
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

/// So many impacts, in words.
pub fn counted(impacts: u64) -> String {
    if impacts == 1 { "1 impact".into() } else { format!("{impacts} impacts") }
}

fn every(impacts: u64, cycles: u64) -> String {
    let cycles = if cycles == 1 { "cycle".into() } else { format!("{cycles} cycles") };
    format!("{} every {cycles}", counted(impacts))
}

fn explanation(reason: Reason) -> &'static str {
    match reason {
        Reason::Graze => "a wall may be touched with no velocity",
        Reason::Width => "the set of states has become too wide for one answer",
        Reason::Precision => "the next impact cannot be enclosed to the digits asked for",
        Reason::Budget => "the flight is too long to follow, or has no provable end",
    }
}
