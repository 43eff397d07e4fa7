//! The JSON of homoclinic tangencies.

use impact_pair_document::{
    BesideDocument, Decimal, HomoclinicTangencyDocument, OpenTangencyDocument, PROGRAM, SaddleDocument, SceneDocument,
    StateBoundsDocument, TANGENCY_SCHEMA, TangencyDocument, bounds,
};

use super::{Beside, StateBounds, Tangencies, Tangency, UnprovedTangency};
use crate::Scene;
use crate::exact::decimal_bounds_f64;

/// Returns a lower bound of a positive number in about seven digits.
pub fn at_least(x: f64) -> Decimal {
    let [lower, _] = decimal_bounds_f64(x, x * (1.0 + 1e-6));
    Decimal::printed(lower)
}

fn states(all: &[StateBounds]) -> Vec<StateBoundsDocument> {
    all.iter().map(|[phase, speed]| StateBoundsDocument { phase: bounds(phase), speed: bounds(speed) }).collect()
}

fn beside(own: &Beside) -> BesideDocument {
    BesideDocument {
        two: bounds(&own.two),
        none: bounds(&own.none),
        unstable: bounds(&own.unstable),
        stable: bounds(&own.stable),
        states: states(&own.states),
    }
}

impl Tangencies {
    /// Returns the document of the tangencies over a parameter of a scene.
    pub fn document(&self, scene: &Scene) -> TangencyDocument {
        let one = |own: &Tangency| HomoclinicTangencyDocument {
            key: self.over.key().place(),
            parameter: bounds(&own.parameter),
            flights: own.flights.to_string(),
            saddle: SaddleDocument {
                phase: bounds(&own.phase),
                speed: bounds(&own.speed),
                eigenvalues: own.eigenvalues.each_ref().map(bounds),
            },
            unstable: bounds(&own.unstable),
            stable: bounds(&own.stable),
            quadratic: bounds(&own.quadratic),
            unfolding: bounds(&own.unfolding),
            least_speed: at_least(own.least_speed),
            least_flight: at_least(own.least_flight),
            resonances_excluded_to: own.resonances_excluded_to,
            states: own.states.as_deref().map(states),
            beside: own.beside.as_ref().map(beside),
        };
        let open = |UnprovedTangency { near, flights }: &UnprovedTangency| OpenTangencyDocument {
            near: *near,
            flights: flights.to_string(),
            reason: UnprovedTangency::REASON.to_owned(),
        };
        TangencyDocument {
            schema: TANGENCY_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            certified: self.is_certified(),
            scene: SceneDocument::new(scene.pair(), scene.start()),
            interrupted: self.interrupted,
            limited: self.limited,
            tangencies: self.tangencies.iter().map(one).collect(),
            undecided: self.unproved.iter().map(open).collect(),
        }
    }
}
