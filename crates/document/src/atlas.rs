//! The atlas JSON Lines, schema `impact-pair/atlas/1`: a head, and one global analysis per point or cell of two parameters.

use impact_pair_exact::Exact;
use impact_pair_model::scene::Key;
use impact_pair_model::vocabulary::Class;
use serde::{Deserialize, Serialize};

use super::PROGRAM;
use super::chaos::PeriodDocument;
use super::global::{ComponentDocument, GLOBAL_SCHEMA, GlobalDocument};
use super::number::Decimal;
use super::scene::SceneDocument;
use super::sweep::SweepAxis;

/// The schema of an atlas.
pub const ATLAS_SCHEMA: &str = "impact-pair/atlas/1";

/// The head of an atlas: everything that its points or cells depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct AtlasHead {
    /// Schema of the document: [`ATLAS_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// The title of the scene.
    pub title: Option<String>,
    /// The scene; its own values of what varies, and its start, are not used.
    pub scene: SceneDocument,
    /// The two axes; `count` is the number of points, or of the smallest cells, along an axis.
    pub over: Vec<SweepAxis>,
    /// Number of points, or of tiles, of the whole grid.
    pub points: u64,
    /// Whether each record is of all parameters of a cell.
    pub cells: bool,
    /// Boxes of the first partition of the state space.
    pub boxes: u32,
    /// How often the boxes of a component are halved at most.
    pub halvings: u32,
    /// Boxes that are mapped in all, about, for each point or cell.
    pub most: u64,
    /// The work of their images, about, for each point or cell.
    pub work: u64,
    /// Requested digits of periodic orbits.
    pub digits: u32,
    /// The most impacts of words of horseshoes, if these are looked for: at points, and for the smallest cells.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub horseshoes: Option<u32>,
    /// Number of the shard, and number of shards.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shard: Option<[u64; 2]>,
}

/// Where every motion goes at a point, or at all parameters of a cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct AtlasRecord {
    /// Its number in the grid; of a cell that of its tile.
    pub point: u64,
    /// The exact values, one per axis; of a cell intervals, `[LOW, HIGH]`.
    pub values: Vec<String>,
    /// `one-rest-cycle`, `one-attractor`, `attractors`, `closed` or `undecided`.
    pub class: Class,
    /// Attracting periodic motions without rests.
    pub n_attracting: u64,
    /// Cycles with rests.
    pub n_rest: u64,
    /// Periodic motions without rests that do not attract, and sets of saddle type.
    pub n_saddle: u64,
    /// Components of which nothing is decided.
    pub n_undecided: u64,
    /// The part of the state space that these cover, to six digits.
    pub undecided_area: Decimal,
    /// Time that the analysis took \[s\]; the only value that depends on the machine.
    pub seconds: f64,
    /// The speed over `A W` that each motion exceeds finitely often.
    pub greatest_speed: Decimal,
    /// The sets of states that motions may stay in for ever.
    pub components: Vec<ComponentDocument>,
    /// Pairs of components, by their positions: motions may go from the first to the second.
    pub order: Vec<[u32; 2]>,
    /// Of a smallest cell that is not decided: stable periodic orbits that each of its parameters is proved to have, or their mirror images.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub stable: Vec<PeriodDocument>,
    /// The cells that a cell was cut into, as nothing was decided for all of it.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub quarters: Vec<AtlasRecord>,
}

impl AtlasRecord {
    /// Returns whether every motion is proved to end in one cycle with rests, or to tend to one attractor, apart from saddles and
    /// grazes.
    pub fn is_decided(&self) -> bool {
        matches!(self.class, Class::OneRestCycle | Class::OneAttractor)
    }

    /// Returns the greatest lower bound of the topological entropy per impact of the horseshoes of its components; 0 where none is proved.
    pub fn entropy(&self) -> f64 {
        let horseshoes = self.components.iter().filter_map(|own| own.horseshoe.as_ref());
        let entropies = horseshoes.filter_map(|horseshoe| horseshoe.entropy.per_impact.text().parse().ok());
        entropies.fold(0.0, f64::max)
    }

    /// Returns the points or cells that are not cut: itself, or those within.
    pub fn leaves(&self) -> Vec<&Self> {
        if self.quarters.is_empty() { vec![self] } else { self.quarters.iter().flat_map(Self::leaves).collect() }
    }

    /// Returns the JSON of the same global analysis; `None` if an axis is not one of the scene's parameters.
    pub fn global(&self, head: &AtlasHead) -> Option<GlobalDocument> {
        let mut scene = head.scene.clone();
        for (axis, value) in head.over.iter().zip(&self.values) {
            scene.set(axis.key.parse::<Key>().ok()?, Exact::parse(value).ok()?)?;
        }
        let document = GlobalDocument {
            schema: GLOBAL_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            certified: self.is_decided(),
            scene,
            class: self.class,
            statement: String::new(),
            greatest_speed: self.greatest_speed.clone(),
            boxes: head.boxes,
            halvings: head.halvings,
            interrupted: false,
            components: self.components.clone(),
            order: self.order.clone(),
            basins: None,
        };
        Some(document.with_statement())
    }
}
