//! Sweeps and atlases: a head, and a line for each point or tile.

use impact_pair_document::{AtlasHead, AtlasRecord, SweepAxis, SweepHead, SweepImpact, SweepRecord};
use impact_pair_model::scene::Key;

use super::chaos::{REQUEST, period};
use super::global::{AREA, Components, ORDER, SPEED, class_of, component};
use super::orbit::arithmetic;
use super::scene::{PROGRAM, READ, Unused, scene};
use super::{Mark, checked, claimed, each, fields, items, list, setting};

/// The part of a grid that the points of a document determine.
pub(crate) struct Pinned {
    pub keys: Vec<Key>,
    /// For each axis, whether the points have several values on it.
    pub axes: Vec<bool>,
    /// Whether there are several points, which fit one shard alone.
    pub has_several: bool,
}

const ONE: &str = "all points have one value on the axis: they do not determine its ends";
const FEW: &str = "a single point fits several shards";
const NO_IMPACTS: &str = "no point lists impacts";
const LIMIT: &str = "no lemma of the check covers what becomes of a motion";

impl Pinned {
    fn over(&self, axes: &[SweepAxis]) -> Mark {
        let own = || checked("V25, V38");
        let axis = |(axis, is_pinned): &(&SweepAxis, bool)| {
            let all = fields!(*axis, SweepAxis { key: own(), from: own(), to: own(), count: own() });
            all.used_here(*is_pinned, ONE)
        };
        items(&axes.iter().zip(self.axes.iter().copied()).collect::<Vec<_>>(), axis)
    }

    fn shard(&self) -> Mark {
        checked("V25, V38").used(self.has_several, FEW)
    }
}

/// What the points of a sweep list.
pub(crate) struct Listed {
    /// Some point lists impacts.
    pub has_states: bool,
    /// Some point has impacts after the transient.
    pub is_long: bool,
}

/// The head of a sweep.
pub(crate) fn sweep(head: &SweepHead, pinned: &Pinned, listed: &Listed) -> Mark {
    let unused = Unused { varied: pinned.keys.clone(), is_grid: true, ..Unused::default() };
    let has_phases = listed.has_states || pinned.keys.contains(&Key::StartPhase);
    fields!(
        head,
        SweepHead {
            schema: checked(READ),
            program: setting(PROGRAM),
            title: setting("a name"),
            scene: scene(&head.scene, &unused),
            over: pinned.over(&head.over),
            points: checked("V25"),
            transient: checked("V1, V2").used(listed.has_states, NO_IMPACTS),
            impacts: setting(REQUEST),
            digits: setting(REQUEST),
            certified: checked(READ).used(listed.has_states, NO_IMPACTS),
            claim: setting("each point says it as well"),
            arithmetic: arithmetic(&head.arithmetic),
            reference: checked("V1, V2").only(has_phases, NO_IMPACTS),
            summary: checked(READ).used(listed.is_long, "no point has impacts after the transient"),
            shard: pinned.shard(),
        }
    )
}

/// A point of a sweep.
pub(crate) fn point(document: &SweepRecord) -> Mark {
    let (own, open) = (|| checked("V1, V2"), || claimed(LIMIT));
    let impact = |impact: &SweepImpact| {
        fields!(impact, SweepImpact { index: own(), wall: own(), phase: own(), velocity: own() })
    };
    fields!(
        document,
        SweepRecord {
            point: checked("V25"),
            values: checked("V25"),
            outcome: open(),
            reason: setting("why it is undecided"),
            message: open(),
            claim: checked("V10"),
            complete: open(),
            bits: setting("the method"),
            impacts: own(),
            wide_from: open(),
            impacts_per_cycle: open(),
            exponent: open(),
            exponent_limit: open(),
            period: open(),
            states: each(&document.states, impact),
        }
    )
}

/// The head of an atlas.
pub(crate) fn atlas(head: &AtlasHead, pinned: &Pinned, has_orbits: bool) -> Mark {
    let varied = pinned.keys.clone();
    let unused = Unused { varied, frequency: !has_orbits, phase: true, start: true, is_grid: true };
    fields!(
        head,
        AtlasHead {
            schema: checked(READ),
            program: setting(PROGRAM),
            title: setting("a name"),
            scene: scene(&head.scene, &unused),
            over: pinned.over(&head.over),
            points: checked("V25, V38"),
            cells: checked("V38"),
            boxes: setting(REQUEST),
            halvings: setting(REQUEST),
            most: setting(REQUEST),
            work: setting(REQUEST),
            digits: setting(REQUEST),
            horseshoes: setting(REQUEST),
            shard: pinned.shard(),
        }
    )
}

/// What is said of a point or a cell depends on this.
pub(crate) struct Proved {
    /// Something is claimed there.
    pub is_said: bool,
    /// The number of sets of saddle type is checked: the place of each is given, or there is none. Lemma V28
    pub counts_sets: bool,
    pub components: Components,
}

/// A point, or a tile with the cells into which it is cut: `parts` has what is claimed of each, in this order.
pub(crate) fn record(document: &AtlasRecord, parts: &mut impl Iterator<Item = Proved>) -> Mark {
    let Proved { is_said, counts_sets, components: of } = parts.next().expect("a part for each record");
    let nothing = "nothing is claimed there";
    let open = |mark: Mark| if is_said { mark } else { setting(nothing) };
    let unplaced = "the number of sets of saddle type, where the place of some is not given";
    let own = |own: &_| component(own, of).with("closed", claimed(AREA));
    let quarters: Vec<Mark> = document.quarters.iter().map(|quarter| record(quarter, parts)).collect();
    let result = fields!(
        document,
        AtlasRecord {
            point: checked("V25, V38"),
            values: checked("V25, V38"),
            class: open(class_of(document.class)).here(),
            n_attracting: open(checked("V25")).here(),
            n_rest: open(checked("V25")).here(),
            n_saddle: open(checked("V25, V28").only(counts_sets, unplaced)).here(),
            n_undecided: open(checked("V25")).here(),
            undecided_area: open(claimed(AREA)),
            seconds: setting("the only value that depends on the machine"),
            greatest_speed: open(claimed(SPEED)),
            components: open(items(&document.components, own)).here(),
            order: open(claimed(ORDER)),
            stable: each(&document.stable, |own| period(own, "V38")),
            quarters: Mark { by: "V38: each cell as the tile", ..list(quarters) },
        }
    );
    if !is_said && document.quarters.is_empty() { setting(nothing).here() } else { result }
}
