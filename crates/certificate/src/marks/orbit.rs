//! Orbits, and descriptions with an orbit in them.

use impact_pair_document::{
    ArithmeticDocument, DescriptionDocument, EpsilonDocument, EventDocument, FateDocument, NearDocument, OrbitHead,
    OutcomeDocument,
};
use impact_pair_model::Period;
use impact_pair_model::vocabulary::OutcomeKind;

use super::periodic::{InPlace, periodic_orbit};
use super::scene::{PROGRAM, READ, Unused, scene};
use super::{Mark, checked, claimed, each, fields, list, optional, setting};

const METHOD: &str = "the method: the check has its own";
const EVENTS: &str = "V1, V2; rests V3, grazes V4; shadowed V10";

/// An orbit: all its events have one mark.
pub(crate) fn orbit(head: &OrbitHead, events: &[EventDocument], ended: &OutcomeDocument) -> Mark {
    fields!(
        head,
        OrbitHead {
            schema: checked(READ),
            program: setting(PROGRAM),
            scene: scene(&head.scene, &Unused::default()),
            certified: checked(READ),
            claim: checked(EVENTS),
            arithmetic: arithmetic(&head.arithmetic),
        }
    )
    .with("outcome", outcome(ended))
    .with("events", each(events, event))
}

pub(super) fn arithmetic(_: &ArithmeticDocument) -> Mark {
    setting(METHOD)
}

fn event(document: &EventDocument) -> Mark {
    fields!(
        document,
        EventDocument {
            event: checked(EVENTS),
            index: checked(EVENTS),
            mapping: checked(EVENTS).or_null(),
            wall: checked(EVENTS),
            time: checked(EVENTS),
            velocity: checked(EVENTS),
            skipped: checked("V3"),
            distance: checked("V4"),
            speed: checked("V4"),
        }
    )
}

fn outcome(document: &OutcomeDocument) -> Mark {
    let near = |near: &NearDocument| fields!(near, NearDocument { time: checked("V10"), velocity: checked("V10") });
    let distances =
        |own: &EpsilonDocument| fields!(own, EpsilonDocument { median: checked("V10"), maximum: checked("V10") });
    let is_decided = document.kind != OutcomeKind::Undecided;
    let why = "of an undecided end: it only says where the orbit stopped";
    let ends = || vec![checked("V7"), setting("the next contact, where it is too wide to be listed")];
    fields!(
        document,
        OutcomeDocument {
            kind: checked("V5, V6, V7"),
            reason: setting(why),
            message: checked("V7: the words follow from the fields"),
            impacts: checked("V7"),
            until: checked("V7"),
            may_be_later: checked("V7"),
            start: optional(document.start.as_ref(), near),
            epsilon: optional(document.epsilon.as_ref(), distances),
            wall: checked("V5").used(is_decided, why),
            time: optional(document.time.as_ref(), |_| list(ends())),
            period: optional(document.period.as_ref(), repeated),
            word: checked("V6"),
            cycles: checked("V6"),
            from: checked("V6"),
            orbit: optional(document.orbit.as_ref(), |orbit| periodic_orbit(orbit, InPlace::Whole, "V6")),
        }
    )
}

fn repeated(document: &Period) -> Mark {
    fields!(document, Period { cycles: checked("V5, V7"), impacts: checked("V5, V7") })
}

/// A description, but for the documents in it, which have marks of their own.
pub(crate) fn description(document: &DescriptionDocument, is_fate_checked: bool) -> Mark {
    let has_parts = document.region.is_some() || document.proof.is_some();
    let (open, alone) = ("no document in it proves its fate", "there is no document in it that is checked");
    let words = "words are not in a description: the document of `chaos` has them";
    fields!(
        document,
        DescriptionDocument {
            schema: checked(READ).used(has_parts, alone),
            program: setting(PROGRAM),
            certified: checked("it follows from the fate").used(is_fate_checked, open).flag(document.certified),
            scene: scene(&document.scene, &Unused::default()).used(has_parts, alone),
            fate: fate(&document.fate, document.proof.is_some()).only(is_fate_checked, open),
            exponent: claimed("no lemma of the check bounds exponents"),
            region: checked("as a document of `trap`"),
            entropy: claimed(words),
            horseshoe: claimed(words),
            undecided: setting("a question that is left open"),
            not_examined: setting("a question that is left open"),
            interrupted: setting("the request"),
            proof: checked("as a document of `run`"),
        }
    )
}

fn fate(document: &FateDocument, has_proof: bool) -> Mark {
    let same = "it is that of the orbit or the region in it";
    fields!(
        document,
        FateDocument {
            kind: checked(same),
            message: checked(same),
            impacts: checked(same).only(has_proof, "the orbit is not in it"),
            from: checked(same),
            period: optional(document.period.as_ref(), repeated),
            word: checked(same),
            wall: checked(same),
            orbit: optional(document.orbit.as_ref(), |orbit| periodic_orbit(orbit, InPlace::Whole, "V6")),
        }
    )
}
