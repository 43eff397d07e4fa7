//! The scene of a document: the values that its claims are about, and those that only name it.

use impact_pair_document::{ExcitationDocument, ParameterRange, SceneDocument, StartDocument, Written};
use impact_pair_model::scene::Key;

use super::{Mark, checked, fields, items};

/// The values of a scene that no claim of a document depends on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Unused {
    /// The parameters that vary: their own values only name the scene.
    pub varied: Vec<Key>,
    pub frequency: bool,
    pub phase: bool,
    pub start: bool,
    /// Whether the parameters are the axes of a grid, which name terms by their numbers.
    pub is_grid: bool,
}

/// What the checker takes in a document, and the program that wrote it.
pub(super) const READ: &str = "read: no other is checked";
pub(super) const PROGRAM: &str = "the program that wrote it";
/// What the data of claims are checked by.
const DATA: &str = "the data of all claims";
const VARIED: &str = "a parameter that varies: its own value only names the scene";
const UNIT: &str = "the reduced map has no unit of time";
const ORIGIN: &str = "the claims do not depend on where phases are counted from";
const START: &str = "the claims are not about one start";

impl Unused {
    /// The start, and the own value of a parameter.
    pub fn over(key: Key) -> Self {
        Self { varied: vec![key], ..Self::start() }
    }

    /// The start.
    pub fn start() -> Self {
        Self { start: true, ..Self::default() }
    }

    fn own(&self, is: fn(&Key) -> bool) -> Mark {
        unless(self.varied.iter().any(is), VARIED)
    }

    /// A list of the terms: of one parameter, which has a number where there are several.
    fn terms(&self, all: &[Written], is: fn(&Key) -> bool) -> Mark {
        let varied: Vec<&Key> = self.varied.iter().filter(|key| is(key)).collect();
        if !self.is_grid && varied.iter().any(|key| key.term().is_none()) {
            return checked(DATA).used(false, VARIED);
        }
        let number = |key: &Key| key.term().map_or(0, |term| usize::from(term.get()) - 1);
        let is_varied = |term: usize| varied.iter().any(|key| number(key) == term);
        let used: Vec<bool> = (0..all.len()).map(|term| !is_varied(term)).collect();
        items(&used, |&is_used| unless(!is_used, VARIED).here())
    }
}

/// A value of the scene, which claims nothing where it is not used.
fn unless(is_unused: bool, why: &'static str) -> Mark {
    if is_unused { checked(DATA).used(false, why) } else { checked(DATA) }
}

/// The scene of a document.
pub(crate) fn scene(document: &SceneDocument, unused: &Unused) -> Mark {
    let terms = &document.excitation;
    let frequency = unused.terms(&terms.frequency, |key| matches!(key, Key::Frequency(_)));
    let phase = unused.terms(&terms.phase, |key| matches!(key, Key::Phase(_)));
    let excitation = fields!(
        terms,
        ExcitationDocument {
            amplitude: unused.terms(&terms.amplitude, |key| matches!(key, Key::Amplitude(_))),
            frequency: if unused.frequency { unless(true, UNIT) } else { frequency },
            phase: if unused.phase { unless(true, ORIGIN) } else { phase },
        }
    );
    let start = fields!(
        &document.start,
        StartDocument {
            time: unused.own(|key| matches!(key, Key::StartTime | Key::StartPhase)),
            wall: checked(DATA),
            position: unused.own(|key| *key == Key::StartPosition),
            velocity: unused.own(|key| *key == Key::StartVelocity),
        }
    );
    fields!(
        document,
        SceneDocument {
            excitation: excitation,
            gap: unused.own(|key| *key == Key::Gap),
            restitution: unused.own(|key| *key == Key::Restitution),
            start: if unused.start { unless(true, START) } else { start },
        }
    )
}

/// A range of a parameter.
pub(crate) fn range(document: &ParameterRange, are_ends_checked: bool) -> Mark {
    let end = || unless(!are_ends_checked, "the request: nothing says that all of it is covered");
    fields!(document, ParameterRange { key: checked(DATA), low: end(), high: end() })
}
