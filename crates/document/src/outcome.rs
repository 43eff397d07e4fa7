//! Outcome of an orbit: the claims beyond the events, as fields, and in words that follow from the fields.

use std::cmp::Ordering;
use std::fmt::Display;

use impact_pair_exact::{Enclosure, Exact, decimal_digits};
use impact_pair_model::vocabulary::{OutcomeKind, Reason};
use impact_pair_model::{Period, Wall, Word};
use num_rational::BigRational;
use serde::{Deserialize, Serialize};

use super::number::{Between, Bounds, Decimal, Written};
use super::periodic::PeriodicOrbitDocument;

/// Outcome of an orbit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OutcomeDocument {
    /// Kind.
    pub kind: OutcomeKind,
    /// Reason why the motion is undecided.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<Reason>,
    /// One line in words, which follows from the other fields.
    #[serde(default)]
    pub message: String,
    /// Number of impacts listed; absent in older documents.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub impacts: Option<u64>,
    /// All events up to this time are listed \[time\]; present if the requested time ended the list.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub until: Option<Written>,
    /// Number of the listed impacts whose bounds reach past `until`: they may come after that time. Absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub may_be_later: Option<u64>,
    /// Bounds of the start of a shadowed orbit.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub start: Option<NearDocument>,
    /// Distances of a shadowed orbit from the middles of the listed bounds.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub epsilon: Option<EpsilonDocument>,
    /// The wall of the undecided event, or the wall on which the ball rests for ever.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub wall: Option<Wall>,
    /// No wall is touched after the last event listed and before the first of these \[time\]. The second is `null` unless the next
    /// contact is proved, but wider than requested: then the contact lies between the two.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub time: Option<Between<Option<Decimal>>>,
    /// The motion repeats itself exactly.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub period: Option<Period>,
    /// The word of the orbit that it converges to.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub word: Option<String>,
    /// Forcing periods in which the orbit repeats.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub cycles: Option<u32>,
    /// From this impact on the motion is in a neighbourhood that the map of a period contracts.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub from: Option<u64>,
    /// Periodic orbit to which the motion converges.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub orbit: Option<PeriodicOrbitDocument>,
}

/// A start near that of the scene; either its time or its velocity is the scene's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct NearDocument {
    /// Bounds of the time of the start \[time\].
    pub time: Bounds,
    /// Bounds of the velocity of the start \[length/time\].
    pub velocity: Bounds,
}

/// Upper bounds of the distances of impacts from the middles of their bounds, in forcing periods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EpsilonDocument {
    /// Median distance.
    pub median: Decimal,
    /// Maximum distance.
    pub maximum: Decimal,
}

impl OutcomeDocument {
    /// Returns the outcome with its message, which follows from its fields.
    ///
    /// # Panics
    /// If a field required by the kind is missing: never for outcomes that this project writes.
    pub fn with_message(self) -> Self {
        let message = self.words().expect("an outcome has the fields of its kind");
        Self { message, ..self }
    }

    /// Returns the message; `None` if a field is missing.
    pub fn words(&self) -> Option<String> {
        let impacts = self.impacts?;
        // An impact whose bounds contain the requested time is listed as well.
        let later = self.may_be_later.map_or(String::new(), |later| format!(", of which {later} may come later"));
        let (shadowed, after) = (self.shadowed(), after(impacts));
        let so_far = format!("{}{shadowed}{later}", counted(impacts, "impact"));
        Some(match self.kind {
            OutcomeKind::ImpactsReached => so_far,
            OutcomeKind::TimeReached => {
                self.until.as_ref()?;
                let listed = counted(impacts, "impact");
                format!("{listed} listed{shadowed}{later}; no other event up to the requested time")
            }
            OutcomeKind::Periodic => {
                let Period { cycles, impacts } = self.period?;
                format!("{so_far}; proved to repeat exactly for ever, {}", every(impacts, "listed impact", cycles))
            }
            OutcomeKind::Attracted => {
                let (word, from) = (self.word.as_ref()?, self.from?);
                let impacts = word.parse::<Word>().ok()?.mappings().len() as u64; // exact: a length
                let every = every(impacts, "impact", self.cycles?.into());
                format!("{so_far}; proved to converge to a stable orbit of {every} ({word}), from impact {from} on")
            }
            OutcomeKind::RestsForever => {
                let at_rest = format!("at rest on the {} wall for ever", self.wall?.name());
                if impacts == 0 { at_rest } else { format!("{after} {at_rest}") }
            }
            OutcomeKind::NeverImpacts if impacts == 0 => "no wall is ever touched".into(),
            OutcomeKind::NeverImpacts => format!("{after} no wall is ever touched again"),
            OutcomeKind::Undecided => {
                let why = self.explanation()?;
                let wall = self.wall.map_or(String::new(), |wall| format!("{} wall, ", wall.name()));
                let time = match &**self.time.as_ref()? {
                    [Some(from), Some(to)] => format!("t = {}", shown(from, to)),
                    [Some(from), None] => format!("t from {}", from.canonical()),
                    [None, _] => return None,
                };
                format!("undecided {after}: {why} ({wall}{time})")
            }
        })
    }

    /// Returns the number of these upper bounds of times that reach past `until`, which [`may_be_later`](Self::may_be_later) holds; `None`
    /// for none.
    pub fn later_than<'b>(until: &Exact, times: impl IntoIterator<Item = &'b BigRational>) -> Option<u64> {
        let may_be =
            |time: &&BigRational| Exact::from_rational((*time).clone()).compare(until).is_none_or(Ordering::is_gt);
        Some(times.into_iter().filter(may_be).count() as u64).filter(|later| *later > 0) // exact: a length
    }

    /// Returns what its reason means, if it is undecided.
    pub fn explanation(&self) -> Option<&'static str> {
        Some(match self.reason? {
            Reason::Graze => "a wall may be touched with zero velocity",
            Reason::Width => "the set of states has become too wide to decide",
            Reason::Precision => "the next impact cannot be enclosed to the requested digits",
            Reason::Budget => "the flight is too long to follow, or has no provable end",
        })
    }

    /// Returns whether it is undecided because the next flight has no end that is found: neither more impacts nor more bits help.
    pub fn is_endless(&self) -> bool {
        self.reason == Some(Reason::Budget)
    }

    /// Returns the distances of the impacts of a shadowed orbit from the listed ones, in words that follow their number; else an empty text.
    fn shadowed(&self) -> String {
        let Some(EpsilonDocument { median, maximum }) = &self.epsilon else { return String::new() };
        let (median, maximum) = (median.canonical(), maximum.canonical());
        format!(
            " of one true orbit that starts near (shadowed), half of them within {median} forcing periods, all within {maximum}"
        )
    }

    /// Returns the message of an interrupted orbit, which ends undecided as well.
    pub fn interruption(&self) -> Option<String> {
        let is_one = self.kind == OutcomeKind::Undecided && self.is_endless() && self.wall.is_none();
        Some(format!("interrupted {}", after(self.impacts.filter(|_| is_one)?)))
    }
}

/// Bits that show bounds.
const BITS: u32 = 160;

/// For the eye: the bounds with the digits that they have in common.
fn shown(from: &Decimal, to: &Decimal) -> String {
    let [from, to] = [from, to].map(|bound| Exact::from_rational(bound.value()).enclose(BITS));
    decimal_digits(&Enclosure::hull(&from, &to))
}

/// Returns a count with its noun.
pub fn counted<N: Display + PartialEq + From<u8>>(count: N, what: &str) -> String {
    let plural = if count == N::from(1) { "" } else { "s" };
    format!("{count} {what}{plural}")
}

fn after(impacts: u64) -> String {
    if impacts == 0 { "before the first impact".into() } else { format!("after impact {impacts}") }
}

fn every(impacts: u64, what: &str, cycles: u64) -> String {
    let cycles = if cycles == 1 { "cycle".into() } else { format!("{cycles} cycles") };
    format!("{} every {cycles}", counted(impacts, what))
}
