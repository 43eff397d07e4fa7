//! The JSON of homoclinic tangencies, schema `impact-pair/tangency/1`.

use serde::{Deserialize, Serialize};

use super::number::{Bounds, Decimal};
use super::scene::SceneDocument;

/// The schema of tangencies.
pub const TANGENCY_SCHEMA: &str = "impact-pair/tangency/1";

/// Values of a parameter at which the stable and the unstable manifold of a saddle of the reduced map are tangent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TangencyDocument {
    /// Schema of the document: [`TANGENCY_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Whether there are tangencies, the search was not cut short, and each found is proved.
    pub certified: bool,
    /// The scene; its own value of the parameter is not used.
    pub scene: SceneDocument,
    /// Whether the run was interrupted before the search or the proofs were done.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// Whether the search ended at the limit of its work before all words and all folds were tried.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub limited: bool,
    /// The tangencies.
    pub tangencies: Vec<HomoclinicTangencyDocument>,
    /// Tangencies of floating point of which nothing is proved.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub undecided: Vec<OpenTangencyDocument>,
}

/// A homoclinic tangency: for exactly one value of the parameter between the bounds the two invariant manifolds of the saddle have a common point along
/// these flights, with parameters of the invariant manifolds between their bounds, at which their tangents are parallel; it is quadratic, and unfolds
/// with a speed that is not zero.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct HomoclinicTangencyDocument {
    /// The parameter: `pair.gap`, `excitation.amplitude` or `pair.restitution`.
    pub key: String,
    /// Bounds of its value, in the unit of the scene.
    pub parameter: Bounds,
    /// The flights from the point of the unstable manifold to that of the stable one in time order: `F` to the far wall, `N` back to the
    /// near one.
    pub flights: String,
    /// The saddle.
    pub saddle: SaddleDocument,
    /// Bounds of the parameter `sigma_u` of the unstable manifold; the derivative of the phase in it is 1 at the saddle.
    pub unstable: Bounds,
    /// Bounds of the parameter `sigma_s` of the stable manifold; the derivative of the phase in it is 1 at the saddle.
    pub stable: Bounds,
    /// Bounds of `q = det(t, Phi_uu - a^2 P_s'')`, not 0: the tangency is quadratic.
    pub quadratic: Bounds,
    /// Bounds of `m = det(t, Phi_D - P_s,D)`, per unit of `D = d/A`, not 0: the invariant manifolds pass through each other.
    pub unfolding: Bounds,
    /// Lower bound of the speed of all impacts of the orbit, divided by `A W`.
    pub least_speed: Decimal,
    /// Lower bound of the duration of all flights of the orbit, in radians.
    pub least_flight: Decimal,
    /// The order `n` up to which there is no resonance: `lambda_u^j lambda_s^k` is neither `lambda_u` nor `lambda_s` for natural numbers
    /// `2 <= j + k <= n`.
    pub resonances_excluded_to: u32,
    /// Where a datum of the scene is an interval: bounds of the states between both points, in time order. For each value of that datum there
    /// is exactly one value of the parameter with a tangency of which `sigma_u`, `sigma_s`, the parameter and these states are between
    /// the bounds; all other bounds hold for each.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub states: Option<Vec<StateBoundsDocument>>,
    /// What is proved on either side of the tangency.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub beside: Option<BesideDocument>,
}

/// Bounds of a state of the reduced map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct StateBoundsDocument {
    /// Bounds of the phase of the impact, mirrored to the left wall, in radians, modulo 2 pi.
    pub phase: Bounds,
    /// Bounds of the speed before it, divided by `A W`.
    pub speed: Bounds,
}

/// How many common points the two invariant manifolds have on either side of a tangency, along its flights, with `sigma_u`, `sigma_s` and the
/// states between both points in these boxes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct BesideDocument {
    /// For each value of the parameter between these there are exactly two common points.
    pub two: Bounds,
    /// For each value of the parameter between these there is none.
    pub none: Bounds,
    /// The range of `sigma_u`.
    pub unstable: Bounds,
    /// The range of `sigma_s`.
    pub stable: Bounds,
    /// The boxes of the states, in time order.
    pub states: Vec<StateBoundsDocument>,
}

/// A fixed point of the reduced map with one eigenvalue outside the unit circle and one inside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct SaddleDocument {
    /// Bounds of the phase of its impacts, in radians, modulo 2 pi.
    pub phase: Bounds,
    /// Bounds of the speed before its impacts, divided by `A W`.
    pub speed: Bounds,
    /// Bounds of the eigenvalues of the Jacobian of the reduced map: the unstable one, then the stable one.
    pub eigenvalues: [Bounds; 2],
}

/// A tangency of floating point that is not proved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OpenTangencyDocument {
    /// Approximate value of the parameter.
    pub near: f64,
    /// The flights from the point of the unstable manifold to that of the stable one in time order.
    pub flights: String,
    /// Reason why the tangency is not proved.
    pub reason: String,
}
