//! The components that all motions end in.

use impact_pair_document::{BasinDocument, BasinsDocument, ComponentDocument, GlobalDocument, ProvedHorseshoeDocument};
use impact_pair_model::vocabulary::{Class, ComponentKind};

use super::chaos::{REQUEST, base, entropies};
use super::periodic::{InPlace, periodic_orbit};
use super::scene::{PROGRAM, READ, Unused, scene};
use super::{Mark, checked, claimed, each, fields, items, optional, setting, witness};

/// What is said of components depends on this. Lemmas V20, V27, V28, V37
#[derive(Clone, Copy)]
pub(crate) struct Components {
    /// Every motion is claimed to end in one of the components with a claim.
    pub are_all: bool,
    /// A motion of the pair is proved to graze one wall for ever.
    pub has_grazing_motion: bool,
}

pub(super) const AREA: &str = "boxes are not in a document";
pub(super) const SPEED: &str = "it is used where basins are checked, with all components";
pub(super) const ORDER: &str = "boxes are not in a document: which components motions go to is not checked";
const CLOSED: &str = "closed components are checked where every motion is claimed to end in one of them";
const WHICH: &str = "which component holds a horseshoe, or has a mirror image, is not checked";

/// A JSON of a global analysis.
pub(crate) fn global(document: &GlobalDocument, of: Components) -> Mark {
    let components = &document.components;
    let has_orbits = components.iter().any(|own| own.orbit.is_some());
    let unused = Unused { frequency: !has_orbits, phase: true, start: true, ..Unused::default() };
    let is_unsaid = |own: &ComponentDocument| lacks_symmetry(own) || own.horseshoe.is_some();
    let is_said = document.class != Class::Closed && !components.iter().any(is_unsaid);
    let has_basins = document.basins.is_some();
    fields!(
        document,
        GlobalDocument {
            schema: checked(READ),
            program: setting(PROGRAM),
            certified: checked("V20").flag(document.certified),
            scene: scene(&document.scene, &unused),
            class: class_of(document.class),
            statement: checked("V20: the words follow from the fields").only(is_said, WHICH),
            greatest_speed: checked("V27").only(of.are_all && has_basins, SPEED),
            boxes: setting(REQUEST),
            halvings: setting(REQUEST),
            interrupted: setting("the analysis was cut short"),
            components: items(components, |own| component(own, of)),
            order: claimed(ORDER),
            basins: optional(document.basins.as_ref(), basins).only(of.are_all, CLOSED),
        }
    )
}

/// The class, which is not checked where it rests on closed components.
pub(super) fn class_of(class: Class) -> Mark {
    checked("V20").only(class != Class::Closed, "that components are closed is not checked, nor what follows from it")
}

fn basins(document: &BasinsDocument) -> Mark {
    let own = || checked("V27");
    let basin = |basin: &BasinDocument| fields!(basin, BasinDocument { component: own(), area: own() });
    let areas = each(&document.areas, basin);
    fields!(document, BasinsDocument { boxes: setting(REQUEST), areas: areas, undecided: own() })
}

pub(super) fn component(document: &ComponentDocument, of: Components) -> Mark {
    let is_grazing = document.kind == ComponentKind::Grazing;
    let may_be_none = document.is_saddle_set() || is_grazing && !of.has_grazing_motion;
    let of_period = || checked("V20").only_here(!lacks_symmetry(document), "its symmetry is undecided");
    fields!(
        document,
        ComponentDocument {
            kind: checked("V20, V28").only_here(of.are_all || !may_be_none, "that there is one is not checked"),
            reduced_impacts: of_period(),
            word: checked("V20"),
            cycles: checked("V20"),
            spectral_radius: of_period(),
            alternates: checked("V20"),
            boxes: setting(AREA),
            area: claimed(AREA),
            closed: checked("V27").only(of.are_all, CLOSED),
            reason: setting("why it is left undecided"),
            horseshoe: optional(document.horseshoe.as_ref(), horseshoe),
            orbit: optional(document.orbit.as_ref(), |orbit| periodic_orbit(orbit, InPlace::Whole, "V8")),
        }
    )
}

fn horseshoe(document: &ProvedHorseshoeDocument) -> Mark {
    let (entropy, bases) = (entropies(&document.entropy, "V37"), each(&document.bases, |own| base(own, "V37")));
    fields!(
        document,
        ProvedHorseshoeDocument { depth: checked("V37"), entropy: entropy, bases: bases, witness: witness("V39") }
    )
}

/// Whether the symmetry of a periodic motion is undecided in the document: then its period under the reduced map is not checked.
fn lacks_symmetry(own: &ComponentDocument) -> bool {
    own.orbit.as_ref().is_some_and(|orbit| orbit.symmetric.is_none())
}
