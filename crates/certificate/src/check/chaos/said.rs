//! Consistency of the h-sets and words of a chaos JSON: disjoint h-sets, entropies that follow from the words, the shortest
//! horseshoe (Lemmas D8, D10, V12).

use impact_pair_exact::{Dyadic, Enclosure};
use impact_pair_model::Word as Itinerary;
use num_rational::BigRational;
use num_traits::Signed;

use super::BITS;
use super::bases::HSet;
use super::blocks::says_the_shortest;
use super::entropy::is_reached;
use super::words::Word;
use crate::chaos::ChaosCertificate;
use crate::check::contact::Doubt;
use impact_pair_document::{BaseDocument, Decimal, EntropyDocument, PeriodDocument, SceneOrbitDocument, WordDocument};

/// The entropy of words between more h-sets is not judged.
const MAX_H_SETS: usize = 64;

impl ChaosCertificate {
    /// The h-sets and the words, if what is said of them follows from them.
    pub(super) fn says_one_thing(&self) -> Result<(Vec<HSet>, Vec<Word>), Doubt> {
        let document = &self.document;
        let wrong = |message: &str| Err(Doubt::False(message.to_owned()));
        let bases = sound_bases(self.bases())?;
        let mut words = Vec::new();
        for (k, claimed) in document.words.iter().enumerate() {
            let word = Word::of(claimed, bases.len()).filter(|_| claimed.impacts <= document.depth.get());
            words.push(word.ok_or_else(|| {
                Doubt::False(format!("words[{k}] contradicts its own flights, the depth or the number of h-sets"))
            })?);
        }
        let entropy = &document.entropy;
        if is_none(entropy) {
            return wrong("it says that an entropy is certified, but gives none");
        }
        follows(&words, bases.len(), entropy)
            .map_err(|what| Doubt::Open(format!("entropy.{what} does not follow from the words")))?;
        says_the_shortest(document.horseshoe.as_deref(), &words, bases.len())?;
        says_one_orbit(document.scene_orbit.as_ref())?;
        Ok((bases, words))
    }
}

/// The h-sets that are claimed, if they are disjoint and as they are described.
pub(super) fn sound_bases(claimed: &[BaseDocument]) -> Result<Vec<HSet>, Doubt> {
    let wrong = |message: &str| Err(Doubt::False(message.to_owned()));
    let bases: Vec<HSet> = claimed.iter().map(|base| HSet::of(&base.corners)).collect();
    if bases.len() > MAX_H_SETS {
        return Err(Doubt::Open(format!("more than {MAX_H_SETS} h-sets are not checked")));
    }
    if !bases.iter().all(HSet::is_sound) {
        return wrong("an h-set is not a convex quadrilateral of states with its tops to the left");
    }
    if (0..bases.len()).any(|k| bases[..k].iter().any(|other| !bases[k].is_apart(other))) {
        return wrong("the h-sets are not proved to be disjoint");
    }
    if !bases.iter().all(HSet::is_apart_from_its_translates) {
        return wrong("an h-set is not proved to be disjoint from its own translate by a forcing period");
    }
    if !claimed.iter().zip(&bases).all(|(claimed, base)| is_about(claimed, base)) {
        return wrong("the given middle or half vectors of an h-set are not those of its corners");
    }
    Ok(bases)
}

/// Returns whether no entropy is claimed.
pub(super) fn is_none(entropy: &EntropyDocument) -> bool {
    [&entropy.per_impact, &entropy.per_cycle].iter().all(|entropy| !entropy.value().is_positive())
}

/// Proves both claimed entropies by words of flights, or names the one that does not follow; weights per period are half cycles, two to a cycle.
pub(super) fn follows(words: &[Word], bases: usize, claimed: &EntropyDocument) -> Result<(), &'static str> {
    let halved = claimed.per_cycle.value() / BigRational::from_integer(2.into());
    let by_impacts: Vec<_> = words.iter().map(Word::by_impacts).collect();
    let by_half_cycles: Vec<_> = words.iter().map(|word| (word.from, word.to, word.half_cycles)).collect();
    let both = [("per_impact", by_impacts, claimed.per_impact.value()), ("per_cycle", by_half_cycles, halved)];
    both.into_iter().try_for_each(|(what, weights, h)| is_reached(&weights, bases, &h).then_some(()).ok_or(what))
}

impl Word {
    /// `None` if it contradicts itself.
    pub(super) fn of(claimed: &WordDocument, bases: usize) -> Option<Self> {
        let flight = |name: char| match name {
            'F' => Some(true),
            'N' => Some(false),
            _ => None,
        };
        let flights: Vec<bool> = claimed.flights.chars().map(flight).collect::<Option<_>>()?;
        let [from, to, impacts] = [claimed.from, claimed.to, claimed.impacts].map(|n| n as usize); // exact: of 32 bits
        let fits = from < bases && to < bases && impacts == flights.len() && impacts > 0;
        fits.then_some(Self { from, to, half_cycles: claimed.half_cycles, flights })
    }

    /// The h-set it comes from, the one it leads to, and its impacts.
    pub(super) fn by_impacts(&self) -> (usize, usize, i64) {
        (self.from, self.to, self.flights.len() as i64) // exact: a length
    }
}

/// Checks that the claims about the scene's own orbit, which no lemma here proves (`unjudged` names them), do not contradict themselves: the
/// word of a periodic orbit closes and has its number of impacts, a period has cycles, and a region that is entered has boxes.
fn says_one_orbit(orbit: Option<&SceneOrbitDocument>) -> Result<(), Doubt> {
    let Some(SceneOrbitDocument { attracted, region }) = orbit else { return Ok(()) };
    let wrong = |message: &str| Err(Doubt::False(format!("scene_orbit: {message}")));
    if let Some(PeriodDocument { word, impacts, cycles }) = attracted {
        let Ok(mappings) = word.parse::<Itinerary>() else { return wrong("its word is none") };
        if !mappings.is_closed() {
            return wrong("its word does not end on the wall that it starts from");
        }
        // exact: of 32 bits
        if mappings.mappings().len() != *impacts as usize || *cycles == 0 {
            return wrong("its word has another number of impacts, or it takes no forcing period");
        }
    }
    if region.as_ref().is_some_and(|region| region.boxes == 0) {
        return wrong("the region has no box");
    }
    Ok(())
}

/// Returns whether the given middle and half vectors of an h-set are those of its corners, to nine digits. Lemma V12
fn is_about(claimed: &BaseDocument, base: &HSet) -> bool {
    let Some([bottom_left, bottom_right, top_right, top_left]) = base.exact() else { return false };
    let half = BigRational::new(1.into(), 2.into());
    let between = |a: &[BigRational; 2], b: &[BigRational; 2]| [0, 1].map(|i| (&a[i] + &b[i]) * &half);
    let (right, top) = (between(&bottom_right, &top_right), between(&top_left, &top_right));
    let middle = between(&between(&bottom_left, &bottom_right), &top);
    let from_middle = |[x, y]: [BigRational; 2]| [x - &middle[0], y - &middle[1]];
    let is_near = |claimed: &Decimal, found: &BigRational| {
        (claimed.value() - found).abs() <= BigRational::new(1.into(), 1_000_000_000.into())
    };
    let pi = Enclosure::pi(BITS);
    // What is near both bounds is near all numbers between.
    let is_phase = |claimed: &Decimal, periods: &BigRational| {
        let at = |pi: &Dyadic| periods * BigRational::from_integer(2.into()) * pi.to_rational();
        is_near(claimed, &at(pi.inf())) && is_near(claimed, &at(pi.sup()))
    };
    let is_vector = |[phase, speed]: [&Decimal; 2], found: &[BigRational; 2]| {
        is_phase(phase, &found[0]) && is_near(speed, &found[1])
    };
    is_vector([&claimed.phase, &claimed.speed], &middle)
        && is_vector(claimed.expanding.each_ref(), &from_middle(right))
        && is_vector(claimed.contracting.each_ref(), &from_middle(top))
}
