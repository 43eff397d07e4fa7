//! How an orbit ended: what is claimed beyond the events, in fields, and in words that follow from the fields.

use std::fmt::Display;

use impact_pair_exact::{Enclosure, Exact, decimal_digits};
use impact_pair_model::{Period, Wall, Word};
use serde::{Deserialize, Serialize};

use super::number::{Bounds, Decimal, Written};
use super::periodic::PeriodicOrbitDocument;

/// How an orbit ended.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OutcomeDocument {
    /// A word, such as `impacts-reached`.
    pub kind: String,
    /// Why it is undecided.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
    /// One line in words, which follows from the other fields.
    #[serde(default)]
    pub message: String,
    /// How many impacts are listed, in every outcome; older documents do not say.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub impacts: Option<u64>,
    /// All events up to this time are listed \[time\]; where the time asked for ended the list.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub until: Option<Written>,
    /// Where the start is that has a shadowed orbit.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub start: Option<NearDocument>,
    /// How near a shadowed orbit is to where its impacts are listed.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub epsilon: Option<EpsilonDocument>,
    /// The wall of what is undecided, or that the ball rests on for ever.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub wall: Option<Wall>,
    /// No wall is touched after the last event listed and before the first of these \[time\]. The second is `null`; where the next
    /// contact is proved, but not as narrowly as asked, the contact lies between the two.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub time: Option<[Option<Decimal>; 2]>,
    /// The motion repeats itself exactly.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub period: Option<Period>,
    /// The word of the orbit that it converges to.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub word: Option<String>,
    /// The cycles of that orbit.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub cycles: Option<u32>,
    /// From this impact on the motion is in a neighbourhood that the period contracts.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub from: Option<u64>,
    /// The orbit itself.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub orbit: Option<PeriodicOrbitDocument>,
}

/// Where a start is, at the place of the scene's; either its time or its velocity is the scene's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct NearDocument {
    /// Bounds of its time \[time\].
    pub time: Bounds,
    /// Bounds of its velocity \[length/time\].
    pub velocity: Bounds,
}

/// How far impacts are at most from the middles of their bounds, in turns of the excitation's phase.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EpsilonDocument {
    /// Half of them are so near.
    pub median: Decimal,
    /// All of them are so near.
    pub maximum: Decimal,
}

impl OutcomeDocument {
    /// The same with the line in words that its fields make.
    ///
    /// # Panics
    /// When a field is missing that the kind has: never for those that this project writes.
    pub fn told(self) -> Self {
        let message = self.words().expect("an outcome has the fields of its kind");
        Self { message, ..self }
    }

    /// The line in words; `None` where the kind is not known, or a field is missing.
    pub fn words(&self) -> Option<String> {
        let impacts = self.impacts?;
        let (so_far, after) = (format!("{}{}", counted(impacts, "impact"), self.shadowed()), after(impacts));
        Some(match self.kind.as_str() {
            "impacts-reached" => so_far,
            "time-reached" => {
                self.until.as_ref()?;
                format!("{so_far} up to the time asked for")
            }
            "periodic" => {
                let Period { cycles, impacts } = self.period?;
                format!("{so_far}; proved to repeat exactly for ever, {}", every(impacts, cycles))
            }
            "attracted" => {
                let (word, from) = (self.word.as_ref()?, self.from?);
                let impacts = word.parse::<Word>().ok()?.mappings().len() as u64; // exact: a length
                let every = every(impacts, self.cycles?.into());
                format!("{so_far}; proved to converge to a stable orbit of {every} ({word}), from impact {from} on")
            }
            "rests-forever" => format!("{after} at rest on the {} wall for ever", self.wall?.name()),
            "never-impacts" => format!("{after} no wall is ever touched again"),
            "undecided" => {
                let why = explanation(self.reason.as_deref()?)?;
                let wall = self.wall.map_or(String::new(), |wall| format!("{} wall, ", wall.name()));
                let time = match self.time.as_ref()? {
                    [Some(from), Some(to)] => format!("t = {}", shown(from, to)),
                    [Some(from), None] => format!("t from {}", from.text()),
                    [None, _] => return None,
                };
                format!("undecided {after}: {why} ({wall}{time})")
            }
            _ => return None,
        })
    }

    /// What a shadowed orbit adds to the number of its impacts.
    fn shadowed(&self) -> String {
        let Some(EpsilonDocument { median, maximum }) = &self.epsilon else { return String::new() };
        let (median, maximum) = (median.text(), maximum.text());
        format!(
            " of one true orbit that starts near (shadowed), half of them within {median} turns, all within {maximum}"
        )
    }

    /// The line in words of an orbit that its user has interrupted, which ends undecided as well.
    pub fn interruption(&self) -> Option<String> {
        let is_one = self.kind == "undecided" && self.reason.as_deref() == Some("budget") && self.wall.is_none();
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

/// So many of a thing, in words.
pub fn counted<N: Display + PartialEq + From<u8>>(count: N, what: &str) -> String {
    let plural = if count == N::from(1) { "" } else { "s" };
    format!("{count} {what}{plural}")
}

fn after(impacts: u64) -> String {
    if impacts == 0 { "before the first impact".into() } else { format!("after impact {impacts}") }
}

fn every(impacts: u64, cycles: u64) -> String {
    let cycles = if cycles == 1 { "cycle".into() } else { format!("{cycles} cycles") };
    format!("{} every {cycles}", counted(impacts, "impact"))
}

/// What a reason means.
fn explanation(reason: &str) -> Option<&'static str> {
    Some(match reason {
        "graze" => "a wall may be touched with no velocity",
        "width" => "the set of states has become too wide for one answer",
        "precision" => "the next impact cannot be enclosed to the digits asked for",
        "budget" => "the flight is too long to follow, or has no provable end",
        _ => return None,
    })
}
