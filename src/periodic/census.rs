//! The proved orbits of a word, and whether they are all.

use super::orbit::{PeriodicImpact, PeriodicOrbit};
use crate::contact::Reason;

/// A part of the state space that was neither excluded nor proved.
#[derive(Clone, Debug)]
pub struct Region {
    /// The impacts that an orbit there would have; velocities that are unknown are bounded.
    pub impacts: Vec<PeriodicImpact>,
    /// The reason why it is undecided.
    pub reason: Reason,
}

/// The orbits of a word that are proved, and whether they are all.
#[derive(Clone, Debug, Default)]
pub struct Census {
    /// Proved orbits, each once, in the order of their first phases.
    pub orbits: Vec<PeriodicOrbit>,
    /// `true` if it is proved that the word has no other admissible orbit in the whole state space (Lemma T9), apart from motions with
    /// sticking (Lemma T12).
    pub exhaustive: bool,
    /// Parts of the state space where other orbits may be, if all orbits were requested.
    pub undecided: Vec<Region>,
    /// `true` if all orbits were requested.
    pub is_search: bool,
    /// Proved: orbits come in a family, none of them isolated (Lemma T11), which is listed as undecided.
    pub is_family: bool,
    /// `true` if the search was interrupted.
    pub interrupted: bool,
}

impl Census {
    /// Whether everything requested is proved: existence or absence of orbits, and all properties of each.
    pub fn is_certified(&self) -> bool {
        let answers = if self.is_search { self.exhaustive } else { !self.orbits.is_empty() };
        answers && !self.interrupted && self.orbits.iter().all(|orbit| orbit.is_decided() && orbit.is_narrow)
    }
}
