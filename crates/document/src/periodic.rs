//! The periodic JSON, schema `impact-pair/periodic/1`, that of two-impact motions, and the parameter manifolds of figures 10 and 11.

use impact_pair_model::Wall;
use impact_pair_model::vocabulary::{Excludes, ManifoldAxis, Mark, Reason, Sign, SolvedFor, Stability};
use serde::{Deserialize, Serialize};

use super::number::Bounds;
use super::scene::SceneDocument;
use super::witness::SearchWitness;

/// The schema of the periodic JSON.
pub const PERIODIC_SCHEMA: &str = "impact-pair/periodic/1";
/// The schema of the parameter manifolds.
pub const MANIFOLD_SCHEMA: &str = "impact-pair/manifold/1";

/// Periodic orbits of a word.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct PeriodicDocument {
    /// Schema of the document: [`PERIODIC_SCHEMA`].
    pub schema: String,
    /// Scene that everything here is about: excitation, gap, restitution coefficient and start, as exact expressions.
    pub scene: SceneDocument,
    /// Mappings, the first one right-most.
    pub word: String,
    /// Forcing periods of the orbits.
    pub cycles: u32,
    /// Whether the list is complete, apart from what it `excludes`.
    pub exhaustive: bool,
    /// The motions not covered if the list is exhaustive: `motions that rest` (with sticking).
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub excludes: Option<Excludes>,
    /// Whether everything requested is proved.
    pub certified: bool,
    /// The orbits.
    pub orbits: Vec<PeriodicOrbitDocument>,
    /// Where others are not excluded.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub undecided: Option<Vec<RegionDocument>>,
    /// What `check` proves with that the list is complete; it claims nothing.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub witness: Option<SearchWitness>,
}

/// A part of the state space that may contain an orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct RegionDocument {
    /// Bounds of its impacts.
    pub impacts: Vec<MeasuredImpact>,
    /// Reason why the orbit is not proved.
    pub reason: Reason,
}

/// A periodic orbit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct PeriodicOrbitDocument {
    /// Impacts of the orbit in time order.
    pub impacts: Vec<MeasuredImpact>,
    /// Whether it is unique within these bounds.
    pub unique: bool,
    /// Whether it is admissible: no wall is touched earlier; null if undecided.
    pub physical: Option<bool>,
    /// Whether it is its own mirror image.
    pub symmetric: Option<bool>,
    /// Number of times that the impacts run through a shorter orbit: absent at 1, null if undecided.
    #[serde(skip_serializing_if = "is_once", default = "once")]
    pub times: Option<u32>,
    /// The trace of the Jacobian of the period; null where an impact is a graze.
    pub trace: Option<Bounds>,
    /// Determinant of the derivative of the orbit's map.
    pub determinant: Option<Bounds>,
    /// Eigenvalues of the derivative of the orbit's map.
    pub eigenvalues: Option<[EigenvalueDocument; 2]>,
    /// `stable`, `unstable`, `elliptic` (with `e = 1`: both eigenvalues lie on the unit circle, apart and not real) or `undecided`.
    pub stability: Stability,
    /// For a two-impact motion: `th1 - th0` from left to right \[rad\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub spacing: Option<Bounds>,
    /// For a two-impact motion: the sign of `sin th0` on the left wall.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub sine: Option<Option<Sign>>,
    /// `A`, if solved for \[length\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub amplitude: Option<Bounds>,
    /// `d`, if solved for \[length\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub gap: Option<Bounds>,
}

/// Number of times that an orbit of its least period runs through itself.
pub(super) fn once() -> Option<u32> {
    Some(1)
}

pub(super) fn is_once(times: &Option<u32>) -> bool {
    *times == once()
}

/// An impact of a periodic orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema), schemars(rename = "PeriodicImpactDocument"))]
pub struct MeasuredImpact<B = Bounds> {
    /// Wall that is hit.
    pub wall: Wall,
    /// `W t + tau` \[rad\] of the fastest harmonic, less whole forcing periods: the lower bound lies in `[0, 2 pi)`, and the bounds are less
    /// than `2 pi` apart. Where they straddle `2 pi`, the forcing period is that of the lower bound.
    pub phase: B,
    /// `y'` before the impact \[length/time\].
    pub velocity: B,
    /// The forcing period of the phase, counted within the common period; present if the common period is longer than one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub turn: Option<u32>,
    /// The forcing period of the phase, counted from that of the first impact, which has 0; present if the period of the orbit is several
    /// common periods. `W t + tau` is greater than that of the first impact by `2 pi cycle` and the difference of their phases.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub cycle: Option<i64>,
}

impl<B> MeasuredImpact<B> {
    /// Returns the impact with other bounds.
    pub fn map<C>(&self, f: impl Fn(&B) -> C) -> MeasuredImpact<C> {
        let Self { wall, turn, cycle, .. } = *self;
        MeasuredImpact { wall, phase: f(&self.phase), velocity: f(&self.velocity), turn, cycle }
    }
}

/// A real or complex number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EigenvalueDocument {
    /// Real part.
    pub re: Bounds,
    /// Imaginary part.
    pub im: Bounds,
}

/// Two-impact motions of N cycles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TwoImpactDocument {
    /// Schema of the document: [`PERIODIC_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Scene that everything here is about: excitation, gap, restitution coefficient and start, as exact expressions.
    pub scene: SceneDocument,
    /// `P1 P2` or `P2 P1`, the right-most mapping starts at the impact listed first: both are the same motion.
    pub word: String,
    /// `N`
    pub cycles: u32,
    /// `velocity`, `amplitude` or `gap`.
    pub solved_for: SolvedFor,
    /// Whether the list is complete, apart from what it `excludes`.
    pub exhaustive: bool,
    /// The motions not covered if the list is exhaustive: `motions that rest` (with sticking).
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub excludes: Option<Excludes>,
    /// Whether all that was requested is proved: of each motion that there is no other one in its bounds, whether it is admissible, and its
    /// stability; and of a search that there are no other ones.
    pub certified: bool,
    /// The spacings at which others are not excluded.
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

/// Parameter manifolds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ManifoldDocument {
    /// Schema of the document: [`MANIFOLD_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Scene that everything here is about: excitation, gap, restitution coefficient and start, as exact expressions.
    pub scene: SceneDocument,
    /// The parameter that varies.
    pub over: ManifoldAxis,
    /// Whether everything requested is present; everything present is proved.
    pub certified: bool,
    /// Whether it was interrupted: points at the end of the last curve, or later curves, are missing.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// A curve for each number of cycles.
    pub curves: Vec<CurveDocument>,
}

/// The parameter manifold of N cycles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CurveDocument {
    /// `N`
    pub cycles: u32,
    /// Its points, in order of the parameter.
    pub points: Vec<ManifoldPointDocument>,
}

/// A point of a parameter manifold: bounds of the parameter that varies, under its own name, and of the amplitude there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ManifoldPointDocument {
    /// Frequency `W` at the point \[rad/time\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub frequency: Option<Bounds>,
    /// `v` \[length/time\]
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub velocity: Option<Bounds>,
    /// Amplitude `A` at the point \[length\].
    pub amplitude: Bounds,
    /// The change at this point: a bifurcation, an end.
    pub mark: Option<Mark>,
    /// What is proved from here to the next point.
    pub after: Option<PartDocument>,
}

/// The part of a parameter manifold between two points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct PartDocument {
    /// The sign of `sin th0` on the left wall.
    pub sine: Sign,
    /// Whether the motion is admissible: no wall is touched earlier.
    pub physical: bool,
    /// `stable`, `unstable` or `undecided`.
    pub stability: Stability,
}
