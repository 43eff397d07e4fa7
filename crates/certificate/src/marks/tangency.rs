//! Tangencies.

use impact_pair_document::{
    BesideDocument, HomoclinicTangencyDocument, SaddleDocument, StateBoundsDocument, TangencyDocument,
};
use impact_pair_model::scene::Key;

use super::scene::{PROGRAM, READ, Unused, scene};
use super::{Mark, checked, each, fields, items, optional, setting};

const SADDLE: &str = "V17, V29";
const TANGENCY: &str = "V18, V19, V31; of data that are intervals V32";
const SIDES: &str = "V21, V31";

/// A JSON of tangencies over these parameters.
pub(crate) fn tangency(document: &TangencyDocument, varied: Vec<Key>) -> Mark {
    let unused = Unused { varied, frequency: true, phase: true, start: true, is_grid: false };
    fields!(
        document,
        TangencyDocument {
            schema: checked(READ),
            program: setting(PROGRAM),
            certified: checked(TANGENCY).flag(document.certified),
            scene: scene(&document.scene, &unused),
            interrupted: setting("the search was cut short"),
            limited: setting("the search was cut short"),
            tangencies: items(&document.tangencies, one),
            undecided: setting("what the search leaves open"),
        }
    )
}

fn one(document: &HomoclinicTangencyDocument) -> Mark {
    let (own, of_saddle) = (|| checked(TANGENCY), || checked(SADDLE));
    let saddle = &document.saddle;
    fields!(
        document,
        HomoclinicTangencyDocument {
            key: own(),
            parameter: own(),
            flights: own(),
            saddle: fields!(
                saddle,
                SaddleDocument { phase: of_saddle(), speed: of_saddle(), eigenvalues: of_saddle() }
            ),
            unstable: own(),
            stable: own(),
            quadratic: own(),
            unfolding: own(),
            least_speed: own(),
            least_flight: own(),
            resonances_excluded_to: own(),
            states: optional(document.states.as_ref(), |states| each(states, |state| state_of(state, TANGENCY))),
            beside: optional(document.beside.as_ref(), sides),
        }
    )
}

fn state_of(document: &StateBoundsDocument, by: &'static str) -> Mark {
    fields!(document, StateBoundsDocument { phase: checked(by), speed: checked(by) })
}

fn sides(document: &BesideDocument) -> Mark {
    let (own, states) = (|| checked(SIDES), each(&document.states, |state| state_of(state, SIDES)));
    fields!(document, BesideDocument { two: own(), none: own(), unstable: own(), stable: own(), states: states })
}
