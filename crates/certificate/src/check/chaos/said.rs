//! What a chaos JSON says of its bases and words, and whether one follows from the other: disjoint bases, entropies, the shortest
//! horseshoe (Lemmas D8, D10, V12).

use impact_pair_exact::Real;
use impact_pair_model::{Mapping, Wall};
use num_rational::BigRational;

use super::BITS;
use super::bases::Base;
use super::entropy::is_reached;
use super::span::Span;
use super::tube::side_of;
use super::words::Word;
use crate::chaos::ChaosCertificate;
use crate::check::contact::Doubt;
use crate::document::{BaseDocument, WordDocument};

impl ChaosCertificate {
    /// The bases and the words, if what is said of them follows from them.
    pub(super) fn says_one_thing(&self) -> Result<(Vec<Base>, Vec<Word>), Doubt> {
        let document = self.document();
        let wrong = |message: &str| Err(Doubt::False(message.to_owned()));
        let corners = self.bases().iter().filter_map(|base| base.corners.as_ref());
        let bases: Vec<Base> = corners.map(Base::of).collect();
        if !bases.iter().all(Base::is_sound) {
            return wrong("a base is no convex quadrilateral of states with its tops to the left");
        }
        if (0..bases.len()).any(|k| bases[..k].iter().any(|other| !bases[k].is_apart(other))) {
            return wrong("the bases are not proved to be disjoint");
        }
        if !self.bases().iter().zip(&bases).all(|(told, base)| is_about(told, base)) {
            return wrong("a base is told to have its middle elsewhere");
        }
        let mut words = Vec::new();
        for (k, told) in document.words.iter().enumerate() {
            let word = Word::of(told, bases.len()).filter(|_| told.impacts <= document.depth);
            words.push(word.ok_or_else(|| {
                Doubt::False(format!("words[{k}] contradicts its own flights, the depth or the number of bases"))
            })?);
        }
        let entropy = &document.entropy;
        let told = [entropy.per_impact.value(), entropy.per_cycle.value()];
        // Half cycles are weighed, two of which make a cycle.
        let halved = &told[1] / BigRational::from_integer(2.into());
        let by_impacts: Vec<_> = words.iter().map(Word::by_impacts).collect();
        let by_half_cycles: Vec<_> = words.iter().map(|word| (word.from, word.to, word.half_cycles)).collect();
        if told.iter().all(|entropy| *entropy <= BigRational::from_integer(0.into())) {
            return wrong("it says that an entropy is certified, but tells none");
        }
        for (what, weights, h) in [("per_impact", by_impacts, &told[0]), ("per_cycle", by_half_cycles, &halved)] {
            if !is_reached(&weights, bases.len(), h) {
                return Err(Doubt::Open(format!("entropy.{what} does not follow from the words")));
            }
        }
        says_the_shortest(document.horseshoe.as_deref(), &words, bases.len())?;
        Ok((bases, words))
    }
}

impl Word {
    /// `None` if it contradicts itself.
    fn of(told: &WordDocument, bases: usize) -> Option<Self> {
        let flight = |name: char| match name {
            'F' => Some(true),
            'N' => Some(false),
            _ => None,
        };
        let flights: Vec<bool> = told.flights.chars().map(flight).collect::<Option<_>>()?;
        let [from, to, impacts] = [told.from, told.to, told.impacts].map(|n| n as usize); // exact: of 32 bits
        let fits = from < bases && to < bases && impacts == flights.len() && impacts > 0;
        fits.then_some(Self { from, to, half_cycles: told.half_cycles, flights })
    }

    /// The base it comes from, the one it leads to, and its impacts.
    pub(super) fn by_impacts(&self) -> (usize, usize, i64) {
        (self.from, self.to, self.flights.len() as i64) // exact: a length
    }

    /// In mappings from the left wall, the first one right-most.
    fn in_mappings(&self) -> String {
        let mut from = Wall::Left;
        let mut names = Vec::new();
        for &is_far in &self.flights {
            let to = if is_far { from.other() } else { from };
            names.push(Mapping::between(from, to).to_string());
            from = to;
        }
        names.reverse();
        names.join(" ")
    }
}

/// Whether a base's middle is told to be in it.
fn is_about(told: &BaseDocument, base: &Base) -> bool {
    let phase = Real::rational(&told.phase.value(), BITS).over(&(Real::pi(BITS) * 2)).expect("pi is not 0");
    let ends = [&phase, &Real::rational(&told.speed.value(), BITS)].map(|x| Span::of(x.enclosure()));
    let [left, right] = [base.left, base.right];
    let round = [left.bottom, right.bottom, right.top, left.top];
    let corners = [ends.map(Span::lo), ends.map(Span::hi)];
    (0..4).all(|i| corners.iter().all(|&state| side_of(round[i], round[(i + 1) % 4], state, 0.0).is_positive()))
}

/// Whether from bases of which some are left a word of each of two blocks leads to one of these.
fn is_free(words: &[Word], bases: usize, blocks: [&[bool]; 2]) -> bool {
    let mut alive = vec![true; bases];
    loop {
        let leads = |base: usize, block: &[bool]| {
            words.iter().any(|word| word.from == base && alive[word.to] && word.flights == block)
        };
        let next: Vec<bool> =
            (0..bases).map(|base| alive[base] && blocks.iter().all(|block| leads(base, block))).collect();
        if next == alive {
            return alive.contains(&true);
        }
        alive = next;
    }
}

/// Whether the two blocks told are free, and none of fewer impacts are: the longer one counts first.
fn says_the_shortest(told: Option<&str>, words: &[Word], bases: usize) -> Result<(), Doubt> {
    let mut names: Vec<&Word> = Vec::new();
    for word in words {
        if names.iter().all(|other| other.flights != word.flights) {
            names.push(word);
        }
    }
    names.sort_by_key(|word| word.flights.len());
    // By the longer one, the second.
    let mut shortest: Option<(usize, usize)> = None;
    let mut is_told_one = told.is_none();
    for (k, b) in names.iter().enumerate() {
        for a in &names[..k] {
            let size = (b.flights.len(), a.flights.len());
            if shortest.is_some_and(|shortest| size > shortest) || !is_free(words, bases, [&a.flights, &b.flights]) {
                continue;
            }
            if shortest.is_none_or(|shortest| size < shortest) {
                (shortest, is_told_one) = (Some(size), false);
            }
            let [a, b] = [a, b].map(|word| word.in_mappings());
            is_told_one |= told == Some(&format!("each block is {a} or {b}, in any order"));
        }
    }
    if is_told_one || told.is_none() && shortest.is_none() {
        Ok(())
    } else {
        Err(Doubt::False("the horseshoe is not one of two shortest blocks in any order".into()))
    }
}
