//! The JSON of tangencies, read back: the claims about each tangency, as exact fractions.

use super::attraction::Bounds;
use super::bifurcation::parameter;
use super::marks::{self, Mark};
use impact_pair_document::{HomoclinicTangencyDocument, Place, StateBoundsDocument, TANGENCY_SCHEMA, TangencyDocument};
use impact_pair_model::scene::Key;
use impact_pair_model::{Error, ImpactPair};
use num_rational::BigRational;
use serde_json::Value;

/// The claims of a JSON of tangencies.
#[derive(Clone, Debug)]
pub(crate) struct TangencyCertificate {
    pub(super) pair: ImpactPair,
    pub(super) tangencies: Vec<ClaimedTangency>,
    pub(super) contradiction: Option<String>,
}

/// A claimed tangency.
#[derive(Clone, Debug)]
pub(super) struct ClaimedTangency {
    pub key: Key,
    pub parameter: Bounds,
    /// True for each flight to the far wall.
    pub flights: Vec<bool>,
    pub phase: Bounds,
    pub speed: Bounds,
    /// The unstable eigenvalue, then the stable eigenvalue.
    pub eigenvalues: [Bounds; 2],
    /// `sigma_u`
    pub unstable: Bounds,
    /// `sigma_s`
    pub stable: Bounds,
    /// `q`
    pub quadratic: Bounds,
    /// `m`
    pub unfolding: Bounds,
    pub least_speed: BigRational,
    pub least_flight: BigRational,
    pub resonances: u32,
    /// Bounds of phase and speed of the states between both points, if another datum is an interval.
    pub states: Option<Vec<[Bounds; 2]>>,
    /// The numbers of common points on either side of the tangency.
    pub beside: Option<ClaimedSides>,
}

/// Claimed common points of both invariant manifolds beside a tangency, along its flights.
#[derive(Clone, Debug)]
pub(super) struct ClaimedSides {
    /// Values of the parameter with two common points in the boxes.
    pub two: Bounds,
    /// Values of the parameter without common points.
    pub none: Bounds,
    /// `sigma_u`
    pub unstable: Bounds,
    /// `sigma_s`
    pub stable: Bounds,
    /// Phase and speed of the states between both points.
    pub states: Vec<[Bounds; 2]>,
}

impl TangencyCertificate {
    /// Reads a JSON of tangencies.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, TANGENCY_SCHEMA)?;
        let document: TangencyDocument = whole.read()?;
        let places = whole.get("tangencies")?.list()?;
        let read = document.tangencies.iter().zip(&places).map(|(claim, place)| ClaimedTangency::of(claim, place));
        let tangencies: Vec<ClaimedTangency> = read.collect::<Result<_, _>>()?;
        let marks = marks::tangency(&document, tangencies.iter().map(|own| own.key).collect());
        let contradiction = contradiction(&document);
        let (pair, _) = document.scene.model()?;
        Ok((Self { pair, tangencies, contradiction }, marks))
    }

    /// Whether no two tangencies over one parameter may have the same value of it. A tangency with flights of the invariant manifolds
    /// added to its word is the same orbit.
    pub(super) fn are_different(&self) -> bool {
        let meet = |one: &ClaimedTangency, other: &ClaimedTangency| {
            let ([low, high], [least, most]) = (&one.parameter, &other.parameter);
            one.key == other.key && low <= most && least <= high
        };
        let all = &self.tangencies;
        (0..all.len()).all(|i| all[..i].iter().all(|other| !meet(&all[i], other)))
    }

    /// Number of claimed tangencies.
    pub fn count(&self) -> usize {
        self.tangencies.len()
    }
}

impl ClaimedTangency {
    fn of(claim: &HomoclinicTangencyDocument, place: &Place<'_>) -> Result<Self, Error> {
        let flights = claim.flights.chars().map(|flight| match flight {
            'F' => Ok(true),
            'N' => Ok(false),
            _ => Err(place.get("flights")?.refused("accepted are the letters F and N")),
        });
        let bounds = impact_pair_document::Bounds::values;
        let states = |all: &[StateBoundsDocument]| {
            all.iter().map(|state| [bounds(&state.phase), bounds(&state.speed)]).collect::<Vec<_>>()
        };
        Ok(Self {
            key: parameter(&place.get("key")?)?,
            parameter: bounds(&claim.parameter),
            flights: flights.collect::<Result<_, _>>()?,
            phase: bounds(&claim.saddle.phase),
            speed: bounds(&claim.saddle.speed),
            eigenvalues: claim.saddle.eigenvalues.each_ref().map(bounds),
            unstable: bounds(&claim.unstable),
            stable: bounds(&claim.stable),
            quadratic: bounds(&claim.quadratic),
            unfolding: bounds(&claim.unfolding),
            least_speed: claim.least_speed.value(),
            least_flight: claim.least_flight.value(),
            resonances: claim.resonances_excluded_to,
            states: claim.states.as_deref().map(states),
            beside: claim.beside.as_ref().map(|sides| ClaimedSides {
                two: bounds(&sides.two),
                none: bounds(&sides.none),
                unstable: bounds(&sides.unstable),
                stable: bounds(&sides.stable),
                states: states(&sides.states),
            }),
        })
    }
}

/// A statement of the document that its own fields contradict.
fn contradiction(document: &TangencyDocument) -> Option<String> {
    let TangencyDocument { certified, tangencies, undecided, interrupted, limited, .. } = document;
    if *certified && (tangencies.is_empty() || *interrupted || *limited || !undecided.is_empty()) {
        return Some("certified: not everything found is proved".to_owned());
    }
    None
}

impl ClaimedTangency {
    /// A contradiction between the tangency and its own flights.
    pub(super) fn contradiction(&self) -> Option<String> {
        let between = self.flights.len().checked_sub(1);
        let Some(between) = between else { return Some("flights: there is none".to_owned()) };
        let lists = [("states", self.states.as_ref()), ("beside.states", self.beside.as_ref().map(|own| &own.states))];
        for (name, states) in lists.into_iter().filter_map(|(name, states)| Some((name, states?))) {
            if states.len() != between {
                return Some(format!("{name}: there are {}, but {between} between both points", states.len()));
            }
        }
        None
    }
}
