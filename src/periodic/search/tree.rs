//! Witness of a complete search: a tree of boxes in which `check` proves that there are no other orbits.
//!
//! The search goes from impact to impact and unites what touches (Lemma T10): no tree comes out of it. With all orbits known the whole boxes of
//! Lemma T9 are halved in few steps, and where they are is all that another proof needs.

use std::fmt::Write;

use super::Task;
use super::cell::Cell;
use super::cut::{Part, Terms};
use crate::number::interval::Interval;
use crate::periodic::chained::Chained;
use crate::periodic::orbit::PeriodicOrbit;
use crate::periodic::{Census, Precision, Problem};
use crate::shaken::under;
use crate::watch::Watch;
use impact_pair_document::SearchWitness;

/// Phases of all boxes of a tree, at most: some seconds, and less than 5 MB.
const MOST_PHASES: usize = 1 << 20;
/// Names of the phases in a tree.
const LETTERS: &str = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
/// Parts of a flight at which `check` looks for a virtual orbit outside the gap.
const FINE_PARTS: u32 = 64;
/// Digits after the point, at most, of the places at which phases are halved.
const MOST_DIGITS: usize = 17;

/// Why a tree is left out.
type Omitted = &'static str;

impl Problem {
    /// Witness of the completeness of a list of all orbits; `None` if the list is not complete.
    pub fn search_witness(&self, census: &Census, precision: Precision, watch: &dyn Watch) -> Option<SearchWitness> {
        let tree = || match self.settled() {
            Some(_) => Ok("-".to_owned()),
            None => under!(&self.shaken, shaken => self.tree(&**shaken, census, precision, watch)),
        };
        census.exhaustive.then(|| match tree() {
            Ok(tree) => SearchWitness { tree: Some(tree), omitted: None },
            Err(why) => SearchWitness { tree: None, omitted: Some(why.to_owned()) },
        })
    }

    fn tree<S: Chained>(
        &self,
        shaken: &S,
        census: &Census,
        precision: Precision,
        watch: &dyn Watch,
    ) -> Result<String, Omitted> {
        if self.chain.impacts() > LETTERS.len() {
            return Err("phases have names in trees of 52 impacts or fewer");
        }
        let terms = Terms::new(&self.chain, shaken.pair(), shaken.rates());
        let narrowest = super::narrowest(&terms, super::Budget::default());
        let task = Task { problem: self, shaken, terms, precision, narrowest, known: &census.orbits, watch };
        let mut cell = Cell::new(&task, Interval::new(0.0, f64::from(self.chain.period())));
        let mut open = vec![cell.all()];
        let (mut tree, mut phases) = (String::new(), 0);
        while let Some(part) = open.pop() {
            if !watch.goes_on() {
                return Err("the search was interrupted");
            }
            phases += self.chain.impacts();
            if phases > MOST_PHASES {
                return Err("the tree of the search would be too large");
            }
            let left = cell.narrow(part, &task.terms.whole()).filter(|narrow| !cell.holds_known(narrow));
            let Some(narrow) = left else {
                tree.push('-');
                continue;
            };
            if cell.is_last(&narrow) {
                return Err("orbits are too near to one another to be told apart in whole boxes");
            }
            let across = narrow.across();
            let (text, place) = place_within(narrow.part.phases[across]);
            let letter = &LETTERS[across..=across];
            write!(tree, "{letter}{text}").expect("a text takes all");
            let [lower, upper] = narrow.part.halved(across, place);
            open.extend([upper, lower]);
        }
        match cell.found.iter().all(|orbit| task.terms.is_seen_outside(cell.all(), orbit)) {
            true => Ok(tree),
            false => Err("a virtual orbit leaves the gap too shortly"),
        }
    }
}

impl Terms<'_> {
    /// Whether an orbit is outside the gap at one of the times at which `check` looks for virtual orbits.
    fn is_seen_outside(&self, mut part: Part, orbit: &PeriodicOrbit) -> bool {
        let phases = orbit.phases();
        part.phases.iter_mut().zip(phases).for_each(|(own, phase)| *own = Interval::from(*phase));
        self.cut(part, &self.whole()).is_none_or(|part| !self.stays_in_gap(&part, FINE_PARTS))
    }
}

/// The shortest decimal in the middle half of a phase, and its value.
fn place_within(phase: Interval) -> (String, f64) {
    let (middle, quarter) = (phase.mid(), 0.25 * phase.wid());
    let short = (0..=MOST_DIGITS).find_map(|digits| {
        let text = format!("{middle:.digits$}");
        let place: f64 = text.parse().expect("a decimal");
        ((place - middle).abs() <= quarter).then_some((text, place))
    });
    let (text, place) = short.unwrap_or_else(|| (middle.to_string(), middle)); // proposes
    (text.strip_prefix("0.").map_or(text.clone(), |rest| format!(".{rest}")), place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::periodic::Budget;
    use crate::tests::{pair, start};
    use crate::watch::{Stage, Unwatched, proceed_if};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_place_is_a_short_decimal_in_the_middle_half(lo in 0.0..40.0f64, exponent in -36.0..2.0f64) {
            let phase = Interval::new(lo, lo + exponent.exp2());
            let (text, place) = place_within(phase);
            prop_assert_eq!(format!("0{text}").parse::<f64>().unwrap(), place);
            prop_assert!(phase.inf() < place && place < phase.sup(), "{text} {phase:?}");
            prop_assert!(text.chars().all(|c| c.is_ascii_digit() || c == '.'));
            prop_assert!(text.len() as f64 <= 6.0 - 0.31 * exponent.min(0.0), "{text}");
        }
    }

    /// Each box that is halved has two halves; a search that is stopped has none.
    #[test]
    fn a_complete_list_has_a_tree_or_says_why_not() {
        let precision = Precision::default();
        for (word, ratio, crosses) in [("LR", "1/9.42497", true), ("LLR", "8/9.42497", true), ("RR", "1", false)] {
            let problem = Problem::new(&pair(ratio, "0.5"), &word.parse().unwrap(), 1).unwrap();
            let census = problem.find_all(&start(), precision, Budget::default());
            let tree = problem.search_witness(&census, precision, &Unwatched).unwrap().tree.unwrap();
            let halved = tree.chars().filter(char::is_ascii_alphabetic).count();
            assert_eq!(tree.chars().filter(|c| *c == '-').count(), halved + 1, "{tree}");
            assert_eq!(halved > 0, crosses, "{tree}");
            let stopped = |_: Stage<'_>| proceed_if(false);
            let witness = problem.search_witness(&census, precision, &stopped).unwrap();
            assert_eq!(witness.omitted.is_some(), crosses);
            let open = Census { exhaustive: false, ..census };
            assert!(problem.search_witness(&open, precision, &Unwatched).is_none());
        }
    }
}
