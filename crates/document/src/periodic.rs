//! The periodic JSON, schema `impact-pair/periodic/1`, that of two-impact motions, and the manifolds of figures 10 and 11.

use impact_pair_model::Wall;
use serde::{Deserialize, Serialize};

use super::number::Bounds;
use super::scene::SceneDocument;

/// The schema of the periodic JSON.
pub const PERIODIC_SCHEMA: &str = "impact-pair/periodic/1";
/// What no search for orbits with finitely many impacts looks for: motions in which the ball rests on a wall between two of them.
pub const RESTING: &str = "motions that rest";
/// The schema of the manifolds.
pub const MANIFOLD_SCHEMA: &str = "impact-pair/manifold/1";

/// Periodic orbits of a word.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct PeriodicDocument {
    /// [`PERIODIC_SCHEMA`]
    pub schema: String,
    /// Whose orbits they are.
    pub scene: SceneDocument,
    /// Mappings, the first one right-most.
    pub word: String,
    /// The cycles of the word.
    pub cycles: u32,
    /// Whether there are no others, but for what it `excludes`.
    pub exhaustive: bool,
    /// Of what others nothing is claimed, where it is exhaustive: `motions that rest`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub excludes: Option<String>,
    /// Whether all that was asked is proved.
    pub certified: bool,
    /// The orbits.
    pub orbits: Vec<PeriodicOrbitDocument>,
    /// Where there may be others.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub undecided: Option<Vec<RegionDocument>>,
}

/// A part of the state space that may hold an orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct RegionDocument {
    /// Bounds of its impacts.
    pub impacts: Vec<PeriodicImpactDocument>,
    /// Why it is undecided.
    pub reason: String,
}

/// A periodic orbit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct PeriodicOrbitDocument {
    /// Its impacts, in order of time.
    pub impacts: Vec<PeriodicImpactDocument>,
    /// Whether it is the only one in these bounds.
    pub unique: bool,
    /// Whether no wall is touched earlier; null where that is undecided.
    pub physical: Option<bool>,
    /// Whether it is its own mirror image.
    pub symmetric: Option<bool>,
    /// The trace of the Jacobian of the period; null where an impact is a graze.
    pub trace: Option<Bounds>,
    /// Its determinant.
    pub determinant: Option<Bounds>,
    /// Its eigenvalues.
    pub eigenvalues: Option<[EigenvalueDocument; 2]>,
    /// `stable`, `unstable` or `undecided`.
    pub stability: String,
    /// Of a two-impact motion: `th1 - th0` from left to right \[rad\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub spacing: Option<Bounds>,
    /// Of a two-impact motion: the sign of `sin th0` on the left wall.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub sine: Option<Option<String>>,
    /// `A`, where it is solved for \[length\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub amplitude: Option<Bounds>,
    /// `d`, where it is solved for \[length\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub gap: Option<Bounds>,
}

/// An impact of a periodic orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct PeriodicImpactDocument {
    /// The wall.
    pub wall: Wall,
    /// `W t + tau` \[rad\], of the fastest harmonic; the lower bound in `[0, 2 pi)`.
    pub phase: Bounds,
    /// `y'` before the impact \[length/time\].
    pub velocity: Bounds,
    /// The turn of the common period that the phase is in, where that is longer than one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub turn: Option<u32>,
    /// The turn that the phase is in, from that of the first impact on, where a period takes several common ones.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub cycle: Option<i64>,
}

/// A real or complex number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EigenvalueDocument {
    /// Its real part.
    pub re: Bounds,
    /// Its imaginary part.
    pub im: Bounds,
}

/// Two-impact motions of N cycles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TwoImpactDocument {
    /// [`PERIODIC_SCHEMA`]
    pub schema: String,
    /// What proved them.
    pub program: String,
    /// Whose motions they are.
    pub scene: SceneDocument,
    /// `P2 P1` or `P1 P2`: both are the same motion.
    pub word: String,
    /// N
    pub cycles: u32,
    /// `velocity`, `amplitude` or `gap`.
    pub solved_for: String,
    /// Whether there are no others, but for what it `excludes`.
    pub exhaustive: bool,
    /// Of what others nothing is claimed, where it is exhaustive: `motions that rest`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub excludes: Option<String>,
    /// Always: what is not proved is `undecided`.
    pub certified: bool,
    /// The spacings at which there may be others.
    pub undecided: Vec<SpacingDocument>,
    /// The motions.
    pub orbits: Vec<PeriodicOrbitDocument>,
}

/// A spacing of two impacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct SpacingDocument {
    /// `th1 - th0` \[rad\]
    pub spacing: Bounds,
}

/// Manifolds over one parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ManifoldDocument {
    /// [`MANIFOLD_SCHEMA`]
    pub schema: String,
    /// What proved them.
    pub program: String,
    /// Whose manifolds they are.
    pub scene: SceneDocument,
    /// The parameter that varies.
    pub over: String,
    /// Whether all that was asked is there; all that is there is proved.
    pub certified: bool,
    /// Whether it ended before all was there: points at the end of the last curve, or curves after it, are left.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// A curve for each number of cycles.
    pub curves: Vec<CurveDocument>,
}

/// A manifold of N cycles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CurveDocument {
    /// N
    pub cycles: u32,
    /// Its points, in order of the parameter.
    pub points: Vec<ManifoldPointDocument>,
}

/// A point of a manifold: bounds of the parameter that varies, under its own name, and of the amplitude there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ManifoldPointDocument {
    /// `W` \[rad/time\]
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub frequency: Option<Bounds>,
    /// `v` \[length/time\]
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub velocity: Option<Bounds>,
    /// `A` \[length\]
    pub amplitude: Bounds,
    /// What happens here: a bifurcation, an end.
    pub mark: Option<String>,
    /// What is known from here to the next point.
    pub after: Option<PartDocument>,
}

/// A part of a manifold between two points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct PartDocument {
    /// The sign of `sin th0` on the left wall.
    pub sine: String,
    /// Whether no wall is touched earlier.
    pub physical: bool,
    /// `stable`, `unstable` or `undecided`.
    pub stability: String,
}
