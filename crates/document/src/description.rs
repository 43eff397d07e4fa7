//! The JSON of what becomes of a motion, schema `impact-pair/description/1`.

use std::fmt;

use impact_pair_model::vocabulary::OutcomeKind;
use impact_pair_model::{Period, Wall};
use serde::{Deserialize, Serialize};

use super::chaos::{EntropyDocument, TrapDocument};
use super::orbit::OrbitDocument;
use super::outcome::counted;
use super::periodic::PeriodicOrbitDocument;
use super::scene::SceneDocument;
use super::sweep::ExtendedBounds;

/// The schema of a description.
pub const DESCRIPTION_SCHEMA: &str = "impact-pair/description/1";

/// What is proved of the motion from the start of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct DescriptionDocument {
    /// Schema of the document: [`DESCRIPTION_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Whether the fate is decided.
    pub certified: bool,
    /// Scene that everything here is about: excitation, gap, restitution coefficient and start, as exact expressions.
    pub scene: SceneDocument,
    /// What becomes of the motion.
    pub fate: FateDocument,
    /// Growth rate of small disturbances per impact.
    pub exponent: DescribedExponent,
    /// The trapping region around what attracts the motion, as `trap` writes it; `null` where none is proved, or none was looked for.
    pub region: Option<TrapDocument>,
    /// Lower bounds of the topological entropy of the impact map; `null` where no horseshoe is proved, or none was looked for.
    pub entropy: Option<EntropyDocument>,
    /// The horseshoe that the entropy follows from.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub horseshoe: Option<HorseshoeDocument>,
    /// Questions that are left undecided, each with a command that goes on.
    pub undecided: Vec<QuestionDocument>,
    /// Questions that were not examined, each with the reason.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub not_examined: Vec<NotExaminedDocument>,
    /// Whether it was stopped: the proved part is kept.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// The orbit whose outcome is the fate, as `run` writes it; absent where it has thousands of impacts, and where the region is the proof.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub proof: Option<Box<OrbitDocument>>,
}

/// What becomes of a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct FateDocument {
    /// Its kind.
    pub kind: FateName,
    /// One line in words, which follows from the other fields.
    pub message: String,
    /// Impacts of the motion that are certified.
    pub impacts: u64,
    /// The impact from which on the motion is in a neighbourhood that the map of a period contracts, or in the region; 0 is the start.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub from: Option<u64>,
    /// The period of the orbit that it converges to, or of the motion.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub period: Option<Period>,
    /// The word of the orbit that it converges to, the right-most mapping first in time.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub word: Option<String>,
    /// The wall on which the ball rests for ever.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub wall: Option<Wall>,
    /// The orbit that it converges to.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub orbit: Option<PeriodicOrbitDocument>,
}

/// Kind of what becomes of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum FateName {
    /// It converges to a stable periodic orbit.
    Attracted,
    /// It repeats exactly.
    Periodic,
    /// The ball rests on a wall for ever.
    RestsForever,
    /// No wall is ever touched again.
    NeverImpacts,
    /// All its impacts from one on lie in a trapping region.
    StaysInRegion,
    /// None of these is proved.
    Undecided,
}

impl fmt::Display for FateName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl FateName {
    /// Returns the kind that the outcome of an orbit decides, if it decides one.
    pub fn of_outcome(kind: OutcomeKind) -> Option<Self> {
        match kind {
            OutcomeKind::Attracted => Some(Self::Attracted),
            OutcomeKind::Periodic => Some(Self::Periodic),
            OutcomeKind::RestsForever => Some(Self::RestsForever),
            OutcomeKind::NeverImpacts => Some(Self::NeverImpacts),
            OutcomeKind::ImpactsReached | OutcomeKind::TimeReached | OutcomeKind::Undecided => None,
        }
    }
}

/// Bounds of the growth rate of small disturbances per impact: natural logarithms.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct DescribedExponent {
    /// The limit of an attracted motion: the logarithm of the spectral radius of the period's Jacobian, per impact; where `e` may be 0, or after a rest, only an upper bound. `null` for all others, and after a graze, where there is no derivative.
    pub limit: Option<ExtendedBounds>,
    /// Over the certified impacts; `-inf` where the ball comes to rest, `null` where it is not known.
    pub finite_time: Option<ExtendedBounds>,
}

/// A horseshoe.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct HorseshoeDocument {
    /// Two blocks of mappings that can follow one another in any order in the map mirrored to one wall; `null` if no two are free.
    pub words: Option<[String; 2]>,
    /// The maximum number of impacts of a word.
    pub depth: u32,
    /// Whether it is proved to lie in the region.
    pub in_region: bool,
}

/// A question that is undecided.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct QuestionDocument {
    /// Question that was not decided, or not examined.
    pub question: String,
    /// A command that goes on.
    pub command: String,
}

/// A question that was not examined.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct NotExaminedDocument {
    /// Question that was not decided, or not examined.
    pub question: String,
    /// Reason why it was not examined.
    pub reason: String,
}

impl FateDocument {
    /// Returns the fate with its message, which follows from its fields.
    ///
    /// # Panics
    /// If a field required by the kind is missing: never for fates that this project writes.
    pub fn with_message(self) -> Self {
        let message = self.words().expect("a fate has the fields of its kind");
        Self { message, ..self }
    }

    /// Returns the message; `None` if a field is missing.
    pub fn words(&self) -> Option<String> {
        let since = |from: u64| if from == 0 { "the start".to_owned() } else { format!("impact {from}") };
        Some(match self.kind {
            FateName::Attracted => format!(
                "converges to a stable periodic orbit of {} ({}), from {} on",
                every(self.period?, "impact"),
                self.word.as_ref()?,
                since(self.from?)
            ),
            FateName::Periodic => format!("repeats exactly for ever, {}", every(self.period?, "listed impact")),
            FateName::RestsForever => format!("the ball rests on the {} wall for ever", self.wall?.name()),
            FateName::NeverImpacts => format!("no wall is ever touched after {}", since(self.impacts)),
            FateName::StaysInRegion => {
                format!(
                    "stays in a trapping region from {} on, without sticking and complete chatter",
                    since(self.from?)
                )
            }
            FateName::Undecided => {
                format!("undecided after {}", counted(self.impacts, "certified impact"))
            }
        })
    }
}

/// A period in words.
fn every(Period { impacts, cycles }: Period, what: &str) -> String {
    format!("{} in {}", counted(impacts, what), counted(cycles, "forcing period"))
}
