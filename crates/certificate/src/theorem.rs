//! Theorems in words: what a confirmed document proves of its scene.
//!
//! *For the scene* means for every start and all parameters that the scene allows; claims that the first line of `check` names as not
//! checked are no part of the theorem.

use impact_pair_document::{ClaimName, counted};
use impact_pair_model::EventKind;

use crate::{Certificate, Claims, GlobalCertificate};

impl Claims {
    /// Returns the theorem that a confirmation proves, a line for each document; an empty text of a document that is not checked.
    pub fn theorem(&self) -> String {
        match self {
            Self::Orbit(certificate) => certificate.theorem(),
            Self::Periodic(_) => "for the scene each listed orbit exists within its bounds, once in the list; where `unique` is true no other \
                 orbit of its word and cycles is there; where `physical` is true its impacts are the first contacts one after the \
                 other, where false a wall is touched earlier; symmetry, trace, determinant, eigenvalues and stability are as listed"
                .to_owned(),
            Self::Cycles(_) => "for the scene each listed cycle of the map mirrored to one wall exists within its bounds, with first \
                 contacts alone, once in the list, with this least period, symmetry, eigenvalues and stability"
                .to_owned(),
            Self::Bifurcations(_) => "within the bounds of each listed fold, pitchfork and period doubling an orbit of its word, within the listed \
                 bounds, has the eigenvalue 1 or -1, and the branch turns back, or another one leaves it"
                .to_owned(),
            Self::Windows(_) => "at each value `at` the listed orbit exists, with first contacts alone, and is stable; within the bounds of \
                 each end an orbit of its word near it has the eigenvalue 1 or -1; where `stable_between` is true one curve of stable \
                 orbits leads from end to end through it"
                .to_owned(),
            Self::Global(certificate) => certificate.theorem(),
            Self::Tangencies(_) => "for exactly one value of the parameter within each pair of bounds the stable and the unstable manifold of the \
                 saddle have a common point along these flights at which they are tangent; the tangency is quadratic and unfolds, with the \
                 listed numbers"
                .to_owned(),
            Self::Sweep(_) => "at each point of the grid the motion from the scene's start has the listed impacts, each the first contact after \
                 the one before, with these numbers, within these bounds"
                .to_owned(),
            Self::Atlas(certificate) => {
                let everywhere = if certificate.has_cells() { "for all parameters of each cell" } else { "at each point" };
                format!("{everywhere} of which something is claimed: every motion is in the end in one of the listed components, or where that is \
                     undecided, each listed periodic motion exists, with its kind")
            }
            Self::Chaos(certificate) => {
                let entropy = &certificate.document().entropy;
                format!(
                    "for every sequence of the {} that fit together, and from either wall, a motion follows it, each impact the first \
                     contact after the one before; so the topological entropy is at least {} per impact and {} per forcing period",
                    counted(certificate.count(), "word"),
                    entropy.per_impact.text(),
                    entropy.per_cycle.text()
                )
            }
            Self::Cells(_) => "for all values of the parameter in each listed subinterval its verdict holds: a horseshoe of the listed h-sets \
                 with at least this entropy, a stable periodic orbit, or that the scene's motion converges to it"
                .to_owned(),
            Self::Trap(certificate) => {
                let enters = certificate.document().entered_at_impact;
                let enters = enters.map_or(String::new(), |n| format!("; all impacts of the scene's motion from number {n} on are in it"));
                format!("after any impact in the region of {} all impacts are in it, and flights and speeds lie within the listed bounds{enters}",
                    counted(certificate.count(), "box").replace("boxs", "boxes"))
            }
            Self::Description(_) | Self::List(_) => {
                let documents = self.documents().unwrap_or_default();
                let theorems = documents.iter().map(|(at, document)| format!("{at}: {}", document.theorem()));
                theorems.collect::<Vec<_>>().join("\n  ")
            }
            Self::Unchecked(_) => String::new(),
        }
    }
}

impl Certificate {
    fn theorem(&self) -> String {
        let impacts = self.events().iter().filter(|claim| claim.kind.is_impact()).count();
        let others = self.events().len() - impacts;
        let contacts = match others {
            0 => counted(impacts, "first contact"),
            others => format!("{} and {}", counted(impacts, "impact"), counted(others, "other event")),
        };
        let start = match self.claim() {
            ClaimName::ExactStart => "for every start and all parameters of the scene there is exactly one sequence of",
            ClaimName::Shadowed => "one start within the bounds of `outcome.start` has exactly one sequence of",
        };
        let next = if others == 0 { "" } else { ", each impact the first contact after the event before" };
        // V4: past a graze the flights that touch the wall and those that miss it have what follows
        let has_grazes = self.events().iter().any(|claim| matches!(claim.kind, EventKind::Graze { .. }));
        let grazes = if has_grazes { "; at a graze the wall is missed or touched, within its distance" } else { "" };
        format!("{start} {contacts}{next}, within the listed bounds of time and velocity{grazes}{}", self.ending())
    }

    /// What the outcome says of the time after the events.
    fn ending(&self) -> String {
        let ended = self.ended();
        let until = ended
            .until
            .as_ref()
            .map_or(String::new(), |until| format!("; up to t = {} there is no other event", until.0));
        let future = match self.outcome() {
            "periodic" => ended.period.map(|period| {
                let cycles = counted(period.cycles, "forcing period");
                format!("; the motion repeats itself every {cycles}, for ever")
            }),
            "attracted" => ended.from.map(|from| {
                format!("; from impact {from} on the motion converges to the orbit of `outcome.orbit`, which is stable and alone in its bounds")
            }),
            "rests-forever" => ended.wall.map(|wall| format!("; then the ball rests on the {} wall for ever", wall.name())),
            "never-impacts" => Some("; after them no wall is ever touched".to_owned()),
            "undecided" => {
                let from = ended.time.as_ref().and_then(|time| time[0].as_ref());
                from.map(|from| format!("; after them no wall is touched before t = {}", from.text()))
            }
            _ => None,
        };
        until + &future.unwrap_or_default()
    }
}

impl GlobalCertificate {
    fn theorem(&self) -> String {
        let theorem = match self.says_there_are_no_others() {
            true => {
                "for all parameters of the scene every motion that touches a wall is in the end in one of the listed components; each \
                 periodic motion and each cycle with rests exists, with its kind, within its bounds"
            }
            false => {
                "for all parameters of the scene each listed periodic motion and each cycle with rests exists, with its kind, within its \
                 bounds"
            }
        };
        theorem.to_owned()
    }
}
