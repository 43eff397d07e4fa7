//! Periodic orbits: of a word, of a region, at bifurcations and in windows.

use impact_pair_document::{
    BifurcationDocument, BifurcationPointDocument, CycleDocument, CyclesDocument, EigenvalueDocument, MeasuredImpact,
    PeriodicDocument, PeriodicOrbitDocument, TwoImpactDocument, WindowDocument, WindowsDocument,
};
use impact_pair_model::scene::Key;
use impact_pair_model::vocabulary::{Bifurcation, Stability};

use super::scene::{PROGRAM, READ, Unused, range, scene};
use super::{Mark, checked, claimed, each, fields, items, optional, setting, witness};

const EXHAUSTIVE: &str = "no lemma of the check covers a search";
const NO_TREE: &str = "it has no tree of the search";
const OPEN: &str = "what the search leaves open";
const CUT: &str = "the search was cut short";
const LEFT_OUT: &str = "what an exhaustive list leaves out";

/// Where a periodic orbit stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum InPlace {
    /// In a list of orbits, of which some may be virtual.
    List,
    /// At a bifurcation, where it is not alone.
    Point,
    /// By itself: an orbit that is admissible.
    Whole,
}

/// An orbit, whose numbers these lemmas check.
pub(super) fn periodic_orbit(document: &PeriodicOrbitDocument, place: InPlace, by: &'static str) -> Mark {
    let (own, each_impact) = (|| checked(by), |impact: &_| impact_of(impact, by));
    let both = |both: &[EigenvalueDocument; 2]| each(both, |own| eigenvalue(own, by));
    let is_virtual = place == InPlace::List && document.physical != Some(true);
    let is_repeated = is_virtual && document.times.is_some_and(|times| times > 1);
    let alone = "an orbit that is not admissible: its mirror image need not be a solution";
    let repeated = "an orbit that is not admissible need not repeat when the state of its first impact recurs";
    let unique = match place {
        InPlace::Point => claimed("at a bifurcation an orbit is not alone"),
        InPlace::List | InPlace::Whole => own().only_here(!is_virtual, alone),
    };
    fields!(
        document,
        PeriodicOrbitDocument {
            impacts: each(&document.impacts, each_impact),
            unique: unique,
            physical: own(),
            symmetric: own().only_here(!is_virtual, alone),
            times: own().only_here(!is_repeated, repeated),
            trace: own(),
            determinant: own(),
            eigenvalues: optional(document.eigenvalues.as_ref(), both),
            stability: own().flag(document.stability != Stability::Undecided),
            spacing: own(),
            sine: own(),
            amplitude: checked(READ),
            gap: checked(READ),
        }
    )
}

fn impact_of(document: &MeasuredImpact, by: &'static str) -> Mark {
    let own = || checked(by);
    fields!(document, MeasuredImpact { wall: own(), phase: own(), velocity: own(), turn: own(), cycle: own() })
}

fn eigenvalue(document: &EigenvalueDocument, by: &'static str) -> Mark {
    fields!(document, EigenvalueDocument { re: checked(by), im: checked(by) })
}

fn orbits(all: &[PeriodicOrbitDocument]) -> Mark {
    items(all, |orbit| periodic_orbit(orbit, InPlace::List, "V8, V13"))
}

/// That all is proved, which of an exhaustive list includes that there are no others.
fn is_certified(certified: bool, is_unchecked: bool) -> Mark {
    checked("V8").used(!is_unchecked, EXHAUSTIVE).flag(certified)
}

/// A periodic JSON.
pub(crate) fn periodic(document: &PeriodicDocument) -> Mark {
    let has_tree = document.witness.as_ref().is_some_and(|witness| witness.tree.is_some());
    fields!(
        document,
        PeriodicDocument {
            schema: checked(READ),
            scene: scene(&document.scene, &Unused::start()),
            word: checked("V8"),
            cycles: checked("V8"),
            exhaustive: checked("V41").only(has_tree, NO_TREE).flag(document.exhaustive),
            excludes: setting(LEFT_OUT),
            certified: is_certified(document.certified, document.exhaustive && !has_tree),
            orbits: orbits(&document.orbits),
            undecided: setting(OPEN),
            witness: witness("V41"),
        }
    )
}

/// A JSON of two-impact motions, solved for the velocity.
pub(crate) fn two_impact(document: &TwoImpactDocument) -> Mark {
    fields!(
        document,
        TwoImpactDocument {
            schema: checked(READ),
            program: setting(PROGRAM),
            scene: scene(&document.scene, &Unused::start()),
            word: checked("V8"),
            cycles: checked("V8"),
            solved_for: checked(READ),
            exhaustive: claimed(EXHAUSTIVE).flag(document.exhaustive),
            excludes: setting(LEFT_OUT),
            certified: is_certified(document.certified, document.exhaustive),
            undecided: setting(OPEN),
            orbits: orbits(&document.orbits),
        }
    )
}

/// A JSON of all cycles of a region.
pub(crate) fn cycles(document: &CyclesDocument) -> Mark {
    fields!(
        document,
        CyclesDocument {
            schema: checked(READ),
            program: setting(PROGRAM),
            certified: setting(EXHAUSTIVE),
            exhaustive: claimed(EXHAUSTIVE).flag(document.exhaustive),
            scene: scene(&document.scene, &Unused::start()),
            reason: claimed("why no region is proved"),
            boxes: setting("the search: the region is not in the document"),
            impacts: setting("the request"),
            fixed_points: claimed("they are compared with the orbits listed; that there are no others is not checked"),
            no_attractor: claimed(EXHAUSTIVE).flag(document.no_attractor),
            orbits: items(&document.orbits, cycle),
            undecided: setting(OPEN),
        }
    )
}

fn cycle(document: &CycleDocument) -> Mark {
    let orbit = periodic_orbit(&document.orbit(), InPlace::List, "V8, V13");
    let own = |key: &str| orbit.at(key).expect("a key of an orbit").clone();
    let is_decided = document.physical == Some(true) && document.symmetric.is_some();
    let open = "its symmetry, or that it is admissible, is undecided";
    fields!(
        document,
        CycleDocument {
            reduced_impacts: checked("V8").only_here(is_decided, open),
            word: checked("V8"),
            cycles: checked("V8"),
            impacts: own("impacts"),
            unique: own("unique"),
            physical: own("physical"),
            symmetric: own("symmetric"),
            times: own("times"),
            trace: own("trace"),
            determinant: own("determinant"),
            eigenvalues: own("eigenvalues"),
            stability: own("stability"),
        }
    )
}

/// A bifurcation JSON over a parameter.
pub(crate) fn bifurcations(document: &BifurcationDocument, over: Key) -> Mark {
    let is_graze = |point: &BifurcationPointDocument| point.kind == Bifurcation::Graze;
    let grazes = "no lemma of the check covers a graze that begins or ends a branch";
    let point = |point: &BifurcationPointDocument| {
        let orbit = periodic_orbit(&point.orbit, InPlace::Point, "V9");
        let own = || checked("V9");
        let all = fields!(
            point,
            BifurcationPointDocument {
                kind: own(),
                parameter: own(),
                word: own(),
                cycles: own(),
                doublings: own(),
                orbit: orbit
            }
        );
        all.only_here(!is_graze(point), grazes)
    };
    let has_grazes = document.points.iter().any(is_graze);
    fields!(
        document,
        BifurcationDocument {
            schema: checked(READ),
            program: setting(PROGRAM),
            scene: scene(&document.scene, &Unused::over(over)),
            word: checked("V9"),
            cycles: checked("V9"),
            over: range(&document.over, false),
            exhaustive: claimed(EXHAUSTIVE).flag(document.exhaustive),
            certified: checked("V9").used(!has_grazes, grazes).flag(document.certified),
            interrupted: setting(CUT),
            points: items(&document.points, point),
            branches: claimed("branches are followed in floating point"),
            undecided: setting(OPEN),
        }
    )
}

/// A JSON of windows over a parameter.
pub(crate) fn windows(document: &WindowsDocument, over: Key) -> Mark {
    fields!(
        document,
        WindowsDocument {
            schema: checked(READ),
            program: setting(PROGRAM),
            certified: checked("V9, V30").flag(document.certified),
            scene: scene(&document.scene, &Unused::over(over)),
            over: range(&document.over, true),
            exhaustive: claimed(EXHAUSTIVE).flag(document.exhaustive),
            searched_impacts: setting("the request"),
            interrupted: setting(CUT),
            windows: items(&document.windows, window),
            undecided: setting(OPEN),
        }
    )
}

fn window(document: &WindowDocument) -> Mark {
    let apart = "that a bifurcation near the orbit ends its window follows from the orbits between alone";
    let end = || checked("V9, V30").only_here(document.stable_between, apart);
    let of_period = || checked("V8").only_here(document.orbit.symmetric.is_some(), "its symmetry is undecided");
    fields!(
        document,
        WindowDocument {
            key: checked("V9"),
            at: checked("V8"),
            from: end(),
            to: end(),
            ends: end(),
            stable_between: checked("V30").flag(document.stable_between),
            reason: setting("why its ends are not proved"),
            reduced_impacts: of_period(),
            flights: of_period(),
            word: checked("V8"),
            cycles: checked("V8"),
            orbit: periodic_orbit(&document.orbit, InPlace::Whole, "V8"),
        }
    )
}
