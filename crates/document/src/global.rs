//! The JSON of a global analysis, schema `impact-pair/global/1`.

use impact_pair_model::vocabulary::{Class, ComponentKind, OpenReason};
use serde::{Deserialize, Serialize};

#[cfg(feature = "schemas")]
use super::chaos::MOST_WORDS;
use super::chaos::{BaseDocument, Depth, EntropyDocument, StripDocument, WordDocument};
use super::number::{Bounds, Decimal};
use super::outcome::counted;
use super::periodic::PeriodicOrbitDocument;
use super::scene::SceneDocument;

/// The schema of a global analysis.
pub const GLOBAL_SCHEMA: &str = "impact-pair/global/1";

/// Where every motion of a scene's pair goes, whatever its start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct GlobalDocument {
    /// Schema of the document: [`GLOBAL_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Whether the class is `one-rest-cycle` or `one-attractor`.
    pub certified: bool,
    /// The scene; its start is not used.
    pub scene: SceneDocument,
    /// `one-rest-cycle`, `one-attractor`, `attractors`, `closed` or `undecided`.
    pub class: Class,
    /// The class in a sentence, which follows from the components.
    pub statement: String,
    /// The speed over `A W` that each motion exceeds finitely often.
    pub greatest_speed: Decimal,
    /// Boxes of the first partition.
    pub boxes: u32,
    /// How often the boxes of a component were halved at most.
    pub halvings: u32,
    /// Whether the run was interrupted: components may not be refined.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// The sets of states that motions may stay in for ever; every motion that touches a wall is in one of them in the end.
    pub components: Vec<ComponentDocument>,
    /// Pairs of components, by their positions: motions may go from the first to the second.
    pub order: Vec<[u32; 2]>,
    /// Basins of attraction, as far as they are proved, of attractors that are proved.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub basins: Option<BasinsDocument>,
}

/// Which parts of the state space have motions that are proved to end in one attractor; the state space is the phases of one forcing period
/// and the speeds up to the greatest one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct BasinsDocument {
    /// By how many boxes they are proved, about.
    pub boxes: u32,
    /// One for each attractor.
    pub areas: Vec<BasinDocument>,
    /// The part of the state space whose motions are not proved to end in one of them, rounded up to six digits.
    pub undecided: Decimal,
}

/// What is proved of a basin of attraction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct BasinDocument {
    /// The attractor, by its position among the components.
    pub component: u32,
    /// The part of the state space whose motions are proved to end in it, rounded down to six digits.
    pub area: Decimal,
}

/// A set of states that motions may stay in for ever.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ComponentDocument {
    /// `attracting`, `rest-cycle`, `saddle`, `grazing` or `undecided`. A saddle without an orbit is a set of saddle type: its states whose
    /// motions stay in it have no area.
    pub kind: ComponentKind,
    /// Of a periodic motion without rests: its least period under the reduced map, which mirrors every impact to the left wall.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reduced_impacts: Option<u32>,
    /// Its mappings, the first one right-most.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub word: Option<String>,
    /// Forcing periods of its period; of a cycle with rests absent where it is not proved, as it may be another one for other values.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub cycles: Option<u32>,
    /// Of the derivative of a period of the reduced map: the greatest modulus of its eigenvalues.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub spectral_radius: Option<Bounds>,
    /// Of a cycle with rests whose period is proved: whether the ball rests on both walls in turn.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub alternates: Option<bool>,
    /// Number of its boxes; 0 of the motion from the release alone, and of an attractor that is proved to be in an undecided component.
    pub boxes: u64,
    /// The part of the state space that they cover, to six digits.
    pub area: Decimal,
    /// Whether all motions with an impact in it are in it in the end, or at an attractor inside it.
    pub closed: bool,
    /// Of an undecided one the limit that leaves it so: `most`, `halvings` or `work`, or `interrupted`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<OpenReason>,
    /// Of an undecided one a horseshoe that is proved to be in it, if one was looked for.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub horseshoe: Option<ProvedHorseshoeDocument>,
    /// The periodic motion without rests.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub orbit: Option<PeriodicOrbitDocument>,
}

/// A horseshoe of the impact map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ProvedHorseshoeDocument {
    /// Maximum number of impacts of a word.
    pub depth: Depth,
    /// Lower bounds of the topological entropy.
    pub entropy: EntropyDocument,
    /// The h-sets of its words, as `chaos --bases` reads them.
    pub bases: Vec<BaseDocument>,
    /// What `check` proves it with; it claims nothing.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub witness: Option<HorseshoeWitness>,
}

/// Words of a horseshoe, and a strip for each of them, in their order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct HorseshoeWitness {
    /// The words.
    #[cfg_attr(feature = "schemas", schemars(length(max = MOST_WORDS)))]
    pub words: Vec<WordDocument>,
    /// The strips.
    #[cfg_attr(feature = "schemas", schemars(length(max = MOST_WORDS)))]
    pub strips: Vec<StripDocument>,
}

/// Whom a statement is about.
const EVERY_MOTION: &str = "every motion that touches a wall";

impl GlobalDocument {
    /// Returns the same with the statement that follows from the class and the components.
    pub fn with_statement(self) -> Self {
        Self { statement: self.statement_of_class() + &self.horseshoes(), ..self }
    }

    /// The components that hold a horseshoe, by their numbers from 1.
    fn horseshoes(&self) -> String {
        let of = |(i, own): (usize, &ComponentDocument)| {
            let entropy = own.horseshoe.as_ref()?.entropy.per_impact.canonical();
            Some(format!(
                "; component {} holds a horseshoe, of topological entropy at least {entropy} per impact",
                i + 1
            ))
        };
        self.components.iter().enumerate().filter_map(of).collect()
    }

    /// Returns the behaviour of all motions, in one sentence.
    fn statement_of_class(&self) -> String {
        let beside = self.beside("to");
        let undecided = self.count(ComponentKind::Undecided);
        let attractors: Vec<String> = self.components.iter().filter_map(ComponentDocument::attractor).collect();
        if self.interrupted {
            return format!("undecided: motions that stay in {}", counted(undecided, "component"));
        }
        match self.class {
            Class::OneRestCycle => format!("{EVERY_MOTION} ends in {}", attractors.concat()),
            Class::OneAttractor => format!("{EVERY_MOTION} tends to {}{beside}", attractors.concat()),
            Class::Attractors if undecided == 0 => {
                format!("{EVERY_MOTION} tends to {}{beside}", attractors.join(", or to "))
            }
            Class::Attractors => format!(
                "{} proved: {}; undecided: {}motions that stay in {}",
                counted(attractors.len() as u32, "attractor"), // shown
                attractors.join("; "),
                if self.has_attractors_within() { "other " } else { "" },
                counted(undecided, "component"),
            ),
            Class::Closed => {
                let closed = counted(undecided, "closed component");
                format!(
                    "{EVERY_MOTION} is in the end in {closed} of which nothing else is decided{}",
                    self.beside("tends to")
                )
            }
            Class::Undecided => format!("undecided: motions that stay in {}", counted(undecided, "component")),
        }
    }

    fn count(&self, kind: ComponentKind) -> u32 {
        self.components.iter().filter(|component| component.kind == kind).count() as u32 // shown
    }

    /// Returns whether an attractor is proved to lie in an undecided component.
    fn has_attractors_within(&self) -> bool {
        self.components.iter().any(|own| own.kind == ComponentKind::Attracting && own.boxes == 0)
    }

    /// Returns the clause on the exceptional motions: those that tend to saddles, stay in sets of saddle type, or graze a wall for ever. What
    /// it says of saddles begins with `to`: "to" where the clause before it has the verb.
    fn beside(&self, to: &str) -> String {
        let saddles = || self.components.iter().filter(|component| component.kind == ComponentKind::Saddle);
        let sets = saddles().filter(|saddle| saddle.orbit.is_none()).count();
        let are_symmetric =
            saddles().filter(|saddle| saddle.orbit.is_some()).all(ComponentDocument::is_its_mirror_image);
        let mut clause = match (saddles().count() - sets, are_symmetric) {
            (0, _) => String::new(),
            (1, true) => format!(", or {to} one saddle"),
            (1, false) => format!(", or {to} one saddle or its mirror image"),
            (saddles, true) => format!(", or {to} one of {saddles} saddles"),
            (saddles, false) => format!(", or {to} one of {saddles} saddles or of their mirror images"),
        };
        match sets {
            0 => {}
            1 => clause.push_str(", or stays for ever in one set of saddle type, at states without area"),
            _ => clause
                .push_str(&format!(", or stays for ever in one of {sets} sets of saddle type, at states without area")),
        }
        if self.count(ComponentKind::Grazing) > 0 {
            clause.push_str(", or grazes one wall for ever");
        }
        clause
    }
}

impl ComponentDocument {
    /// Returns whether it is claimed to be a set of saddle type, not one periodic motion.
    pub fn is_saddle_set(&self) -> bool {
        self.kind == ComponentKind::Saddle && self.orbit.is_none()
    }

    /// Returns whether its motion is known to be its own mirror image, half a period later: else one motion of the reduced map stands for two.
    fn is_its_mirror_image(&self) -> bool {
        self.alternates == Some(true) || self.orbit.as_ref().is_some_and(|orbit| orbit.symmetric == Some(true))
    }

    /// An attractor in words; `None` of all else.
    fn attractor(&self) -> Option<String> {
        let cycles = counted(self.cycles.unwrap_or_default(), "forcing period");
        let mirror = if self.is_its_mirror_image() { "" } else { " or its mirror image" };
        match self.kind {
            ComponentKind::RestCycle if self.cycles.is_none() => {
                Some(format!("one cycle with rests{mirror}, of a period that is not proved"))
            }
            ComponentKind::RestCycle => Some(format!("one cycle with rests{mirror}, of {cycles}")),
            ComponentKind::Attracting => {
                let impacts = counted(self.orbit.as_ref().map_or(0, |orbit| orbit.impacts.len()) as u32, "impact"); // shown
                Some(format!("one periodic motion{mirror}, of {impacts} in {cycles}"))
            }
            ComponentKind::Saddle | ComponentKind::Grazing | ComponentKind::Undecided => None,
        }
    }
}
