//! The undecided questions of a description, each with a command that continues, and the questions that were not examined.

use std::cmp::Ordering;

use impact_pair::json::{FateName, NotExaminedDocument, QuestionDocument};

use super::{Description, Horseshoe, Region};
use impact_pair::chaos::MOST_DEPTH;
use impact_pair::contact::Reason;
use impact_pair::exact::Exact;
use impact_pair::lyapunov::{Exponent, NoExponent};
use impact_pair::orbit::BITS;
use impact_pair::periodic::has_common_period;
use impact_pair::{Error, Scene};

/// The most impacts for which a description is tried next where the motion stays in a region: some seconds.
const MOST_NEXT_IMPACTS: u64 = 20_000;
/// Reasons why more impacts of an orbit are not advised.
const KEEPS_AREAS: &str = "with e = 1 the impact map preserves area, so that no orbit attracts nearby motions";
const HAS_NO_PERIOD: &str =
    "the frequencies are not proved to have a common period, and without one no motion with impacts is periodic";
/// The reason why an orbit has no finite-time exponent, where one may exist.
const TOO_COARSE: &str =
    "the impacts are enclosed too coarsely for the derivative over all of them, or it may not exist";
/// The factor of the impacts of a next attempt.
const NEXT_FACTOR: u64 = 10;

/// Reason why no motion of a scene's pair is proved to converge to a periodic orbit, if there is one.
pub(super) fn is_unattracted(scene: &Scene) -> Result<Option<&'static str>, Error> {
    let pair = scene.pair();
    if pair.restitution().compare(&Exact::from(1)) == Some(Ordering::Equal) {
        return Ok(Some(KEEPS_AREAS));
    }
    Ok((!has_common_period(pair)?).then_some(HAS_NO_PERIOD))
}

impl Description {
    /// Undecided questions, each with a command on the scene of this name.
    pub(super) fn undecided(&self, fate: FateName, name: &str) -> Vec<QuestionDocument> {
        let name = quoted(name);
        let question = |question: &str, command: String| QuestionDocument { question: question.to_owned(), command };
        let mut all = Vec::new();
        match fate {
            FateName::Undecided => {
                all.extend(self.orbit_question(&name).map(|(requested, command)| question(&requested, command)));
            }
            FateName::StaysInRegion => {
                let requested = "does the motion converge to a stable periodic orbit in the region?";
                let more = self.request.impacts.saturating_mul(NEXT_FACTOR);
                // A motion that has not converged by then may be one of many that are proved at once.
                let next = if more <= MOST_NEXT_IMPACTS {
                    format!("impact-pair describe {name} --impacts {more}")
                } else {
                    format!("impact-pair global {name}")
                };
                all.push(question(requested, next));
            }
            FateName::Attracted | FateName::Periodic | FateName::RestsForever | FateName::NeverImpacts => {}
        }
        let deeper = (2 * self.request.depth).min(MOST_DEPTH);
        let deeper = format!("impact-pair chaos {name} --depth {deeper}");
        match &self.horseshoe {
            Horseshoe::Searched(chaos) if chaos.entropy() <= 0.0 => {
                all.push(question("does the region hold a horseshoe?", deeper));
            }
            Horseshoe::Searched(chaos) if !chaos.asymptotics().region.is_some_and(|region| region.holds_bases) => {
                all.push(question("does the horseshoe lie in the region?", deeper));
            }
            Horseshoe::NotExamined(_) if self.is_interrupted && self.region().is_some() => {
                all.push(question("does the region hold a horseshoe?", deeper));
            }
            Horseshoe::Searched(_) | Horseshoe::NotExamined(_) => {}
        }
        all
    }

    /// The undecided question about the orbit, and a command that continues. `None` where none leads further: then the reason is among the
    /// questions that were not examined.
    fn orbit_question(&self, name: &str) -> Option<(String, String)> {
        let (impacts, more) = (self.orbit.impacts(), self.request.impacts.saturating_mul(NEXT_FACTOR));
        if self.is_interrupted {
            return Some(("what becomes of the motion?".to_owned(), format!("impact-pair describe {name}")));
        }
        match self.orbit.document.outcome.reason {
            None if self.is_unattracted.is_some() => None,
            None => Some((
                format!("does the motion converge to a periodic orbit after impact {impacts}?"),
                format!("impact-pair describe {name} --impacts {more}"),
            )),
            Some(Reason::Precision) if self.request.max_bits < *BITS.end() => {
                let bits = self.request.max_bits.saturating_mul(NEXT_FACTOR as u32).min(*BITS.end()); // proposes: bits to try next
                let next = format!("impact-pair describe {name} --max-bits {bits}");
                Some((format!("what happens after impact {impacts}?"), next))
            }
            Some(_) => None,
        }
    }

    /// Questions that were not examined, each with the reason.
    pub(super) fn not_examined(&self) -> Vec<NotExaminedDocument> {
        let not_examined = |question: &str, reason: &str| NotExaminedDocument {
            question: question.to_owned(),
            reason: reason.to_owned(),
        };
        let outcome = &self.orbit.document.outcome;
        let is_open = self.orbit.decides().is_none() && self.orbit_question("").is_none();
        let after = format!("what happens after impact {}", self.orbit.impacts());
        let any = if outcome.is_endless() { ", with any number of impacts or digits" } else { "" };
        let undecided = outcome.explanation().map(|why| not_examined(&after, &format!("{why}{any}")));
        let unattracted = || self.is_unattracted.map(|why| not_examined("convergence to a periodic orbit", why));
        let orbit = undecided.or_else(unattracted).filter(|_| is_open);
        let exponent = match self.orbit.exponent {
            Exponent::Unknown(NoExponent::Width) => Some(not_examined("the exponent", TOO_COARSE)),
            _ => None,
        };
        let others = match (&self.region, &self.horseshoe) {
            (Region::NotExamined(why), _) => vec![not_examined("a trapping region and a horseshoe", why)],
            (Region::Unproved(why), _) => {
                vec![not_examined("a horseshoe", &format!("no trapping region is proved: {why}"))]
            }
            (Region::Proved(_), Horseshoe::NotExamined(why)) => vec![not_examined("a horseshoe", why)],
            (Region::Proved(_), Horseshoe::Searched(_)) => Vec::new(),
        };
        orbit.into_iter().chain(exponent).chain(others).collect()
    }
}

/// Name of a file, quoted for a shell.
fn quoted(name: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "/._-+=:,@".contains(c);
    if !name.is_empty() && name.chars().all(is_plain) {
        return name.to_owned();
    }
    format!("'{}'", name.replace('\'', "'\\''"))
}
