//! Trapping regions, horseshoes, and verdicts over the cells of a parameter.

use impact_pair_document::{
    BaseDocument, ChaosCellsDocument, ChaosDocument, CornersDocument, EntropyDocument, HyperbolicDocument,
    PeriodDocument, RatesDocument, SharesDocument, StretchDocument, TrapDocument, WallWordsDocument, WordDocument,
};
use impact_pair_model::scene::Key;
use impact_pair_model::vocabulary::StretchVerdict;

use super::scene::{PROGRAM, READ, Unused, range, scene};
use super::{Mark, checked, claimed, each, fields, items, optional, setting, witness};

pub(super) const REQUEST: &str = "the request";
const CUT: &str = "the search was cut short";

/// A trap JSON.
pub(crate) fn trap(document: &TrapDocument) -> Mark {
    // The region holds for every start.
    let is_of_all = document.entered_at_impact.is_none();
    let unused = Unused { phase: is_of_all, start: is_of_all, ..Unused::default() };
    let (own, of_words) = (|| checked("V11"), || checked("V16"));
    let words = |words: &WallWordsDocument| {
        fields!(words, WallWordsDocument { impacts: of_words(), count: of_words(), entropy_at_most: of_words() })
    };
    fields!(
        document,
        TrapDocument {
            schema: checked(READ),
            program: setting(PROGRAM),
            certified: checked(READ),
            scene: scene(&document.scene, &unused),
            boxes: own(),
            entered_at_impact: own(),
            no_rest: own().flag(document.no_rest),
            longest_flight: own(),
            speed: own(),
            columns: own(),
            rows: own(),
            flight: own(),
            flight_time: own(),
            speed_before: own(),
            region: own(),
            words: optional(document.words.as_ref(), words),
        }
    )
}

/// A chaos JSON, over a parameter if given.
pub(crate) fn chaos(document: &ChaosDocument, over: Option<Key>) -> Mark {
    let varied = over.into_iter().collect();
    let unused = Unused { varied, frequency: true, phase: true, start: true, is_grid: false };
    let own = || checked("V12");
    let word = |word: &WordDocument| {
        let own = || checked("V39");
        fields!(word, WordDocument { from: own(), to: own(), impacts: own(), half_cycles: own(), flights: own() })
    };
    fields!(
        document,
        ChaosDocument {
            schema: checked(READ),
            program: setting(PROGRAM),
            certified: checked(READ),
            scene: scene(&document.scene, &unused),
            over: optional(document.over.as_ref(), |over| range(over, true)),
            depth: setting(REQUEST),
            boxes: setting("the search: how many boxes were mapped"),
            entropy: entropies(&document.entropy, "V12"),
            horseshoe: own().or_null(),
            scene_orbit: claimed("no lemma of the check covers what becomes of the scene's own orbit"),
            interrupted: setting(CUT),
            bases: each(&document.bases, |own| base(own, "V12")),
            words: each(&document.words, word),
            exponent_seen: setting("computed in floating point"),
            hyperbolic: optional(document.hyperbolic.iter().flatten().next(), hyperbolic),
            left_out: setting("why words are left out"),
            witness: witness("V39"),
        }
    )
}

fn hyperbolic(document: &HyperbolicDocument) -> Mark {
    let own = || checked("V14");
    let rates = |rates: &RatesDocument| fields!(rates, RatesDocument { per_impact: own(), per_cycle: own() });
    fields!(
        document,
        HyperbolicDocument {
            kappa: own(),
            cells: setting("the search: the check has its own cells"),
            words: own(),
            entropy: rates(&document.entropy),
            exponents: rates(&document.exponents),
            second_exponent: own(),
            dimension: own(),
        }
    )
}

pub(super) fn entropies(document: &EntropyDocument, by: &'static str) -> Mark {
    fields!(document, EntropyDocument { per_impact: checked(by), per_cycle: checked(by) })
}

pub(super) fn base(document: &BaseDocument, by: &'static str) -> Mark {
    let own = || checked(by);
    let corners = fields!(&document.corners, CornersDocument { left: own(), right: own() });
    fields!(
        document,
        BaseDocument { phase: own(), speed: own(), expanding: own(), contracting: own(), corners: corners }
    )
}

pub(super) fn period(document: &PeriodDocument, by: &'static str) -> Mark {
    fields!(document, PeriodDocument { word: checked(by), impacts: checked(by), cycles: checked(by) })
}

/// A JSON of verdicts over the cells of a parameter.
pub(crate) fn cells(document: &ChaosCellsDocument, over: Key) -> Mark {
    // The scene's own motion is the one that the verdict `attracted` is about.
    let is_of_all = document.stretches.iter().all(|stretch| stretch.verdict != StretchVerdict::Attracted);
    let unused =
        Unused { varied: vec![over], frequency: is_of_all, phase: is_of_all, start: is_of_all, is_grid: false };
    let (shares, own) = (&document.shares, || checked("V35"));
    let shares = fields!(
        shares,
        SharesDocument { horseshoe: own(), attracted: own(), stable: own(), both: own(), undecided: own() }
    );
    fields!(
        document,
        ChaosCellsDocument {
            schema: checked(READ),
            program: setting(PROGRAM),
            certified: own().flag(document.certified),
            scene: scene(&document.scene, &unused),
            over: range(&document.over, true),
            cells: setting(REQUEST),
            halvings: setting(REQUEST),
            depth: setting(REQUEST),
            interrupted: setting(CUT),
            shares: shares,
            stretches: items(&document.stretches, stretch),
        }
    )
}

fn stretch(document: &StretchDocument) -> Mark {
    const BY: &str = "V35, V36; words V39";
    fields!(
        document,
        StretchDocument {
            low: checked(BY),
            high: checked(BY),
            verdict: checked(BY),
            entropy: optional(document.entropy.as_ref(), |own| entropies(own, BY)),
            bases: each(&document.bases, |own| base(own, BY)),
            period: optional(document.period.as_ref(), |own| period(own, BY)),
            witness: witness("V39"),
        }
    )
}
