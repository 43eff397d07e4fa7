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

/// The greatest number of bytes of a tree.
const MOST_BYTES: usize = 5_000_000;
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
        let mut tree = String::new();
        while let Some(part) = open.pop() {
            if !watch.goes_on() {
                return Err("the search was interrupted");
            }
            if tree.len() > MOST_BYTES {
                return Err("the tree of the search would be larger than 5 MB");
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
