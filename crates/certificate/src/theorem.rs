//! Theorems in words: what a confirmed document proves of its scene.
//!
//! *For the scene* means for every start and all parameters that the scene allows; claims that the first line of `check` lists as not
//! checked are not part of the theorem.

use impact_pair_document::{ClaimName, TrapDocument, counted};
use impact_pair_model::EventKind;
use impact_pair_model::vocabulary::OutcomeKind;

use crate::claims::Of;
use crate::global::GlobalCertificate;
use crate::{Certificate, Claims};

impl Claims {
    /// The theorem that a confirmation proves, a line for each document; empty for a document that is not checked.
    pub fn theorem(&self) -> String {
        let fixed = match &self.of {
            Of::Orbit(certificate) => return certificate.theorem(),
            Of::Global(certificate) => certificate.theorem(),
            Of::Periodic(certificate) => {
                let listed = "for all parameters of the scene each listed orbit exists within its bounds, in the listed forcing periods, once in the list; \
                 where `unique` is true no other orbit of its word and cycles has its first impact there; where `physical` is true its impacts \
                 are the first contacts one after the other, where false a wall is touched earlier, and it solves the equations of its word \
                 alone; it runs `times` through a shorter orbit, once if there is no such key; symmetry, trace, determinant, eigenvalues, \
                 stability, spacing and sine are as listed";
                let complete = certificate.search.as_ref().map_or("", |_| {
                    "; its word has no other admissible orbit in these forcing periods, apart from motions that rest"
                });
                return format!("{listed}{complete}");
            }
            Of::Cycles(_) => {
                "for all parameters of the scene each listed cycle of the map mirrored to one wall exists within its bounds, with first \
                 contacts alone where `physical` is true, once in the list, with this least period, symmetry, eigenvalues and stability"
            }
            Of::Bifurcations(_) => {
                "within the bounds of each listed fold, pitchfork and period doubling an orbit of its word, within the listed bounds, admissible \
                 as `physical` says, has the eigenvalue 1 or -1, and the branch turns back, or another one leaves it"
            }
            Of::Windows(_) => {
                "at each value `at` the listed orbit exists, with the listed flights and numbers, stable, with first contacts alone where \
                 `physical` is true; within the bounds of each end an orbit of its word near it has the eigenvalue 1 or -1; where \
                 `stable_between` is true one curve of stable orbits leads from end to end through it"
            }
            Of::Tangencies(_) => {
                "for exactly one value of the parameter within each pair of bounds the stable and the unstable manifold of the saddle have a \
                 common point along these flights at which they are tangent; the tangency is quadratic and unfolds, with the listed numbers; \
                 `beside` it there are two common points or none in the listed boxes; with `states` all this holds for each value of the datum \
                 that is an interval"
            }
            Of::Sweep(_) => {
                "at each listed point the motion from the scene's start has the listed impacts, each the first contact after the one before, \
                 with these numbers, within these bounds"
            }
            Of::Cells(_) => {
                "for all values of the parameter in each listed subinterval its verdict holds: a horseshoe of the listed h-sets with at least \
                 this entropy, a stable periodic orbit, or that the scene's motion converges to it"
            }
            Of::Atlas(certificate) => {
                let everywhere =
                    if certificate.has_cells { "for all parameters of each cell" } else { "at each listed point" };
                return format!(
                    "{everywhere} of which something is claimed, every motion that touches a wall is in the end in one of the listed \
                     components; where one of these is undecided, each listed periodic motion, horseshoe and stable orbit exists, with its kind"
                );
            }
            Of::Chaos(certificate) => {
                let entropy = &certificate.document.entropy;
                let hyperbolic = certificate.document.hyperbolic.iter().flatten().next().map_or("", |_| {
                    "; the words of `hyperbolic` make a uniformly hyperbolic set with the listed slope, entropies, exponents and dimension"
                });
                return format!(
                    "for every sequence of the {} that fit together, between the listed h-sets and from either wall, a motion follows it, each \
                     impact the first contact after the one before, in the listed half cycles; so the topological entropy is at least {} per \
                     impact and {} per forcing period; the two blocks of `horseshoe` follow one another in any order, and no blocks of fewer \
                     impacts do{hyperbolic}",
                    counted(certificate.count(), "word"),
                    entropy.per_impact.text(),
                    entropy.per_cycle.text()
                );
            }
            Of::Trap(certificate) => {
                let TrapDocument { entered_at_impact, no_rest, words, .. } = &certificate.document;
                let rests = if *no_rest { "; no rest and no complete chatter comes after one" } else { "" };
                let enters = entered_at_impact.map_or(String::new(), |n| {
                    format!("; all impacts of the scene's motion from number {n} on are in it")
                });
                let words = words.as_ref().map_or(String::new(), |words| {
                    let (count, impacts) = (words.count.text(), words.impacts);
                    format!(
                        "; motions in it make at most {count} words of {impacts} flights, of the listed entropy at most"
                    )
                });
                return format!(
                    "for all parameters of the scene, after any impact in the region of {} boxes all impacts are in it, and flights and speeds \
                     lie within the listed bounds{rests}{enters}{words}",
                    certificate.count()
                );
            }
            Of::Description(_) | Of::List(_) => {
                let documents = self.documents().unwrap_or_default();
                let theorems = documents.iter().map(|(at, document)| format!("{at}: {}", document.theorem()));
                let fate = match &self.of {
                    Of::Description(certificate) if certificate.is_fate_judged() => "; so `fate` is as listed",
                    _ => "",
                };
                return theorems.collect::<Vec<_>>().join("\n  ") + fate;
            }
            Of::Unchecked(_) => "",
        };
        fixed.to_owned()
    }
}

impl Certificate {
    fn theorem(&self) -> String {
        let start = match self.claim() {
            ClaimName::ExactStart => "for every start and all parameters of the scene",
            ClaimName::Shadowed => {
                "for one start within the bounds of `outcome.start`, which has the scene's time or its velocity, and as near to the middles of the \
                 listed times as `outcome.epsilon` says,"
            }
        };
        let is = |is_it: fn(&EventKind<_>) -> bool| self.events().iter().any(|claim| is_it(&claim.kind));
        let impacts = self.events().iter().filter(|claim| claim.kind.is_impact()).count();
        let others = self.events().len() - impacts;
        let listed = match (impacts, others) {
            (0, 0) => String::new(),
            (_, 0) => format!(
                " there is exactly one sequence of {}, with the listed indices, mappings and walls, within the listed bounds of time and velocity",
                counted(impacts, "first contact")
            ),
            _ => format!(
                " there is exactly one sequence of {} and {}, with the listed indices, mappings and walls, each impact the first contact after the \
                 event before, within the listed bounds of time and velocity",
                counted(impacts, "impact"),
                counted(others, "other event")
            ),
        };
        // V3: the impacts before an accumulation that are not listed
        let rests = if is(|kind| matches!(kind, EventKind::Rest { is_accumulation: true })) {
            "; a rest with `skipped` stands for infinitely many more impacts on its wall before it, each the first contact after the one before"
        } else {
            ""
        };
        // V4: past a graze the statements hold for flights that touch the wall and for flights that miss the wall
        let grazes = if is(|kind| matches!(kind, EventKind::Graze { .. })) {
            "; at a graze the flight misses or crosses the wall by `distance`, and a touch is no faster than `speed`"
        } else {
            ""
        };
        let end = self.ending();
        let end = if listed.is_empty() { end.trim_start_matches("; ").trim_start_matches("after them ") } else { &end };
        let gap = if listed.is_empty() { " " } else { "" };
        format!("{start}{listed}{rests}{grazes}{gap}{end}")
    }

    /// The statement of the outcome about the time after the events.
    fn ending(&self) -> String {
        let ended = self.ended();
        let until = ended
            .until
            .as_ref()
            .map_or(String::new(), |until| format!("; up to t = {} there is no other event", until.0));
        let future = match self.outcome() {
            OutcomeKind::Periodic => ended.period.map(|period| {
                let cycles = counted(period.cycles, "forcing period");
                format!(
                    "; from a listed release on, or without drift from the start on, the motion repeats itself every {cycles}, with {} listed each \
                     time, for ever",
                    counted(period.impacts, "impact")
                )
            }),
            OutcomeKind::Attracted => ended.from.map(|from| {
                format!(
                    "; from impact {from} on the motion converges to the orbit of `outcome.orbit`, which is stable and alone in its bounds"
                )
            }),
            OutcomeKind::RestsForever => ended.wall.map(|wall| format!("; after them the ball rests on the {} wall for ever", wall.name())),
            OutcomeKind::NeverImpacts => Some("; after them no wall is ever touched".to_owned()),
            OutcomeKind::Undecided => {
                let from = ended.time.as_ref().and_then(|time| time[0].as_ref());
                from.map(|from| format!("; after them no wall is touched before t = {}", from.text()))
            }
            OutcomeKind::ImpactsReached | OutcomeKind::TimeReached => None,
        };
        until + &future.unwrap_or_default()
    }
}

impl GlobalCertificate {
    fn theorem(&self) -> &'static str {
        match self.says_there_are_no_others {
            true => {
                "for all parameters of the scene every motion that touches a wall is in the end in one of the listed components; each periodic \
                 motion and each cycle with rests exists, with its kind, within its bounds"
            }
            false => {
                "for all parameters of the scene each listed periodic motion, cycle with rests and horseshoe exists, with its kind, within its \
                 bounds"
            }
        }
    }
}
