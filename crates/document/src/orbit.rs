//! The orbit JSON, schema `impact-pair/orbit/1`: one object, or JSON Lines: the head, one event per line, and last the outcome.

use std::fmt;

use impact_pair_model::vocabulary::ArithmeticKind;
use impact_pair_model::{Arithmetic, Mapping, Settings, Wall};
use serde::{Deserialize, Deserializer, Serialize};

use super::number::{Bounds, NotNegative};
use super::outcome::OutcomeDocument;
use super::scene::SceneDocument;

/// The schema of the orbit JSON.
pub const ORBIT_SCHEMA: &str = "impact-pair/orbit/1";

/// An orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OrbitDocument {
    /// Schema of the document: [`ORBIT_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    #[serde(default)]
    pub program: String,
    /// Scene that everything here is about: excitation, gap, restitution coefficient and start, as exact expressions.
    pub scene: SceneDocument,
    /// Whether the bounds are certified; with `float` they are not, and both bounds are the double itself.
    pub certified: bool,
    /// The start that the claims are about; absent in older documents.
    #[serde(default)]
    pub claim: ClaimName,
    /// Arithmetic in which the orbit was computed.
    #[serde(default)]
    pub arithmetic: ArithmeticDocument,
    /// How the list ends: outcome of the orbit.
    pub outcome: OutcomeDocument,
    /// Events in time order.
    pub events: Vec<EventDocument>,
}

impl OrbitDocument {
    /// Returns the document of which these are the lines.
    pub fn of(head: OrbitHead, events: Vec<EventDocument>, outcome: OutcomeDocument) -> Self {
        let OrbitHead { schema, program, scene, certified, claim, arithmetic } = head;
        Self { schema, program, scene, certified, claim, arithmetic, outcome, events }
    }

    /// Returns its lines.
    pub fn lines(self) -> (OrbitHead, Vec<EventDocument>, OutcomeDocument) {
        let Self { schema, program, scene, certified, claim, arithmetic, outcome, events } = self;
        (OrbitHead { schema, program, scene, certified, claim, arithmetic }, events, outcome)
    }
}

/// An orbit without its outcome and its events: the first of the JSON Lines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OrbitHead {
    /// Schema of the document: [`ORBIT_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    #[serde(default)]
    pub program: String,
    /// Scene that everything here is about: excitation, gap, restitution coefficient and start, as exact expressions.
    pub scene: SceneDocument,
    /// Whether the bounds are certified; with `float` they are not, and both bounds are the double itself.
    pub certified: bool,
    /// The start that the claims are about; absent in older documents.
    #[serde(default)]
    pub claim: ClaimName,
    /// Arithmetic in which the orbit was computed.
    #[serde(default)]
    pub arithmetic: ArithmeticDocument,
}

/// The start that an orbit belongs to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub enum ClaimName {
    /// Every start that the scene allows.
    #[default]
    #[serde(rename = "exact start")]
    ExactStart,
    /// One start within the bounds of the outcome.
    #[serde(rename = "shadowed")]
    Shadowed,
}

impl fmt::Display for ClaimName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// The last of the JSON Lines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OrbitEnd {
    /// How the list ends: outcome of the orbit.
    pub outcome: OutcomeDocument,
    /// Arithmetic in which the orbit was computed.
    #[serde(default)]
    pub arithmetic: ArithmeticDocument,
}

/// The arithmetic: `float`, `interval` or `inari` in 53 bits, `multiprecision` with the bits of the first impact, `auto` with its maximum number
/// of bits, `shadow` without bits.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ArithmeticDocument {
    /// Name of the arithmetic.
    pub kind: ArithmeticKind,
    /// Precision of the arithmetic in bits.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub bits: Option<u32>,
    /// Maximum precision in bits, before the computation.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub max_bits: Option<u32>,
}

impl ArithmeticDocument {
    /// Returns the requested arithmetic: `auto` does not know its precision yet.
    pub fn requested(settings: &Settings) -> Self {
        match settings.arithmetic {
            Arithmetic::Auto => Self { kind: ArithmeticKind::Auto, bits: None, max_bits: Some(settings.max_bits) },
            Arithmetic::Float => Self::computed(ArithmeticKind::Float, f64::MANTISSA_DIGITS),
            Arithmetic::Interval => Self::computed(ArithmeticKind::Interval, f64::MANTISSA_DIGITS),
            Arithmetic::Inari => Self::computed(ArithmeticKind::Inari, f64::MANTISSA_DIGITS),
            Arithmetic::Shadow => Self::shadow(),
            Arithmetic::Bits(bits) => Self::computed(ArithmeticKind::Multiprecision, bits),
        }
    }

    /// Returns the arithmetic of a shadowed orbit.
    pub fn shadow() -> Self {
        Self { kind: ArithmeticKind::Shadow, bits: None, max_bits: None }
    }

    /// Returns the arithmetic of an orbit.
    pub fn computed(kind: ArithmeticKind, bits: u32) -> Self {
        Self { kind, bits: Some(bits), max_bits: None }
    }
}

/// Kind of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum EventName {
    /// The ball hits the wall.
    Impact,
    /// The wall is touched, or nearly touched, with zero or nearly zero velocity.
    Graze,
    /// The ball comes to rest on a wall (sticking).
    Rest,
    /// The ball leaves the wall on which it rested.
    Release,
}

impl fmt::Display for EventName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// Impacts omitted from a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Skipped {
    /// Infinitely many impacts.
    Infinite,
}

/// An event of an orbit. An impact has an index, a mapping or null, and a velocity; a graze has a distance and a speed; other events have
/// none of these.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EventDocument {
    /// Kind of an event.
    pub event: EventName,
    /// Number of the impact, from 1.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub index: Option<u64>,
    /// The mapping that ends here; null if there is none, or more than one is possible.
    #[serde(skip_serializing_if = "Option::is_none", default, deserialize_with = "present_or_null")]
    pub mapping: Option<Option<Mapping>>,
    /// Wall that the ball touches.
    pub wall: Wall,
    /// Time of the event \[time\].
    pub time: Bounds,
    /// The relative velocity `y'` just before the impact \[length/time\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub velocity: Option<Bounds>,
    /// The impacts before a rest that are omitted.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub skipped: Option<Skipped>,
    /// Distance by which a graze misses the wall at the extremum of the flight \[length\], negative where the extremum lies beyond the
    /// wall; 0 is one of the values. Absent in older documents.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub distance: Option<Bounds>,
    /// Upper bound of the speed at which a graze touches the wall, if it does \[length/time\]; present beside `distance`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub speed: Option<NotNegative>,
}

/// Tells null from nothing.
fn present_or_null<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}
