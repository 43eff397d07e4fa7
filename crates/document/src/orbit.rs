//! The orbit JSON, schema `impact-pair/orbit/1`: one object, or JSON Lines: the head, an event a line, and at last the outcome.

use impact_pair_model::{Arithmetic, Mapping, Settings, Wall};
use serde::{Deserialize, Deserializer, Serialize};

use super::number::Bounds;
use super::outcome::OutcomeDocument;
use super::scene::SceneDocument;

/// The schema of the orbit JSON.
pub const ORBIT_SCHEMA: &str = "impact-pair/orbit/1";

/// An orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OrbitDocument {
    /// Whose orbit it is, and what certifies it.
    #[serde(flatten)]
    pub head: OrbitHead,
    /// How it ended.
    pub outcome: OutcomeDocument,
    /// What happens, in order of time.
    pub events: Vec<EventDocument>,
}

/// An orbit without its outcome and its events: the first of the JSON Lines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OrbitHead {
    /// [`ORBIT_SCHEMA`]
    pub schema: String,
    /// What computed it.
    pub program: String,
    /// Whose orbit it is.
    pub scene: SceneDocument,
    /// Whether anything is claimed; in `float` nothing is, and both bounds are the double itself.
    pub certified: bool,
    /// Of which start the orbit is; older documents do not say.
    #[serde(default)]
    pub claim: ClaimName,
    /// What computes it, or has computed it.
    pub arithmetic: ArithmeticDocument,
}

/// Of which start an orbit is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub enum ClaimName {
    /// Of every start that the scene allows.
    #[default]
    #[serde(rename = "exact start")]
    ExactStart,
    /// Of one start within the bounds of the outcome.
    #[serde(rename = "shadowed")]
    Shadowed,
}

impl ClaimName {
    /// The word of the JSON.
    pub fn text(self) -> &'static str {
        match self {
            Self::ExactStart => "exact start",
            Self::Shadowed => "shadowed",
        }
    }
}

/// The last of the JSON Lines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OrbitEnd {
    /// How it ended.
    pub outcome: OutcomeDocument,
    /// What has computed it.
    pub arithmetic: ArithmeticDocument,
}

/// What computes: `float`, `interval` or `inari` in 53 bits, `multiprecision` in those of the first impact, `auto` with the most bits it may
/// take, `shadow` without bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ArithmeticDocument {
    /// Its name.
    pub kind: String,
    /// The bits.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub bits: Option<u32>,
    /// The bits at most, of what is not computed yet.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub max_bits: Option<u32>,
}

impl ArithmeticDocument {
    /// What is asked for: `auto` does not know its bits yet.
    pub fn asked(settings: &Settings) -> Self {
        match settings.arithmetic {
            Arithmetic::Auto => Self { kind: "auto".to_owned(), bits: None, max_bits: Some(settings.max_bits) },
            Arithmetic::Float => Self::computed("float", f64::MANTISSA_DIGITS),
            Arithmetic::Interval => Self::computed("interval", f64::MANTISSA_DIGITS),
            Arithmetic::Inari => Self::computed("inari", f64::MANTISSA_DIGITS),
            Arithmetic::Shadow => Self::shadow(),
            Arithmetic::Bits(bits) => Self::computed("multiprecision", bits),
        }
    }

    /// What has computed a shadowed orbit.
    pub fn shadow() -> Self {
        Self { kind: "shadow".to_owned(), bits: None, max_bits: None }
    }

    /// What has computed an orbit.
    pub fn computed(kind: &str, bits: u32) -> Self {
        Self { kind: kind.to_owned(), bits: Some(bits), max_bits: None }
    }
}

/// What happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum EventName {
    /// The ball hits the wall.
    Impact,
    /// The wall is touched, or nearly touched, with no velocity or nearly none.
    Graze,
    /// The ball comes to rest.
    Rest,
    /// The ball leaves the wall that it rested on.
    Release,
}

impl EventName {
    /// The word of the orbit JSON.
    pub fn text(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::Graze => "graze",
            Self::Rest => "rest",
            Self::Release => "release",
        }
    }
}

/// What is left out of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Skipped {
    /// Infinitely many impacts.
    Infinite,
}

/// An event of an orbit. An impact has an index, a mapping or null, and a velocity; the others have none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EventDocument {
    /// What happens.
    pub event: EventName,
    /// Counts the impacts from 1.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub index: Option<u64>,
    /// The mapping that led here; null where there is none, or more than one is possible.
    #[serde(skip_serializing_if = "Option::is_none", default, deserialize_with = "there")]
    pub mapping: Option<Option<Mapping>>,
    /// Where.
    pub wall: Wall,
    /// When \[time\].
    pub time: Bounds,
    /// The relative velocity `y'` just before the impact \[length/time\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub velocity: Option<Bounds>,
    /// The impacts before a rest that are not listed.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub skipped: Option<Skipped>,
}

/// Tells null from nothing.
fn there<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}
