//! Check of the listed words of a chaos JSON (Lemma V39).

use impact_pair_model::Error;
use impact_pair_model::watch::{Latched, Stage, Watch};

use super::allowance::{Allowance, End};
use super::bases::HSet;
use super::entropy::at_least;
use super::strip::left_open;
use super::words::Word;
use super::{Law, STEPS_PER_PLACE, cones};
use crate::chaos::ChaosCertificate;
use crate::check::contact::Doubt;
use crate::check::{Limits, Verdict};

/// Bits of the arithmetic.
const DOUBLE_BITS: u32 = f64::MANTISSA_DIGITS;

impl ChaosCertificate {
    /// Proves every listed word again, and that the entropies and the horseshoe follow from the list, or says what is not true or not
    /// proved, until the watch stops it, which receives the words confirmed so far.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions, or if it has several harmonics.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let watch = Latched::new(watch);
        let law = Law::of(&self.pair)?;
        let mut confirmed = 0;
        let mut progress = |words: usize| {
            confirmed = confirmed.max(words); // exact: a count
            watch.note(Stage::Claims(confirmed));
        };
        let (bases, words) = match self.says_one_thing() {
            Ok(said) => said,
            Err(doubt) => return Ok(doubt.on(self.count())),
        };
        let allowed = limits.work.saturating_mul(STEPS_PER_PLACE); // proposes: when to give up
        let Some(witness) = &self.document.witness else { return Ok(Doubt::open("no witness").on(self.count())) };
        Ok(match left_open(&law, (&bases, &words), &witness.strips, (allowed, &watch), &mut progress) {
            Ok(None) => match self.hyperbolic(&law, (&bases, &words), allowed, &watch) {
                Ok(None) => Verdict::Confirmed { bits: DOUBLE_BITS, pieces: 1 },
                Ok(Some(doubt)) => doubt.on(self.count()),
                Err(_) => Verdict::Interrupted { events: confirmed },
            },
            Ok(Some(verdict)) => verdict,
            Err(_) => Verdict::Interrupted { events: confirmed },
        })
    }

    /// The doubt that is left of a hyperbolic set, if one is claimed.
    fn hyperbolic(
        &self,
        law: &Law,
        listed: (&[HSet], &[Word]),
        allowed: u64,
        watch: &dyn Watch,
    ) -> Result<Option<Doubt>, End> {
        let Some(Some(set)) = &self.document.hyperbolic else { return Ok(None) };
        let work = Allowance::new(allowed.saturating_mul(CONE_WORK_FACTOR), watch); // proposes: when to give up
        let witness = self.document.witness.as_ref().and_then(|witness| witness.cones.as_ref());
        match cones::doubt(law, listed, (set, witness), &work) {
            Err(End::Spent) => Ok(Some(Doubt::open("hyperbolic: the work allowed is spent"))),
            found => found,
        }
    }
}

/// The verdict at the first word that is not found, with the entropy of those that are: a part of a list proves what follows from that
/// part.
pub(super) fn shortfall((is_found, why): (&[bool], &str), words: &[Word], bases: usize) -> Verdict {
    let first = is_found.iter().position(|is_found| !is_found).expect("a word is missing");
    let kept: Vec<_> =
        words.iter().zip(is_found).filter(|(_, is_found)| **is_found).map(|(word, _)| word.by_impacts()).collect();
    let left = match at_least(&kept, bases) {
        Some(entropy) => format!(
            "; the {} of {} words that are proved have an entropy of at least {entropy} per impact",
            kept.len(),
            words.len()
        ),
        None => String::new(),
    };
    Doubt::Open(format!("{why}{left}")).on(first)
}

/// Cones are N times as much work.
const CONE_WORK_FACTOR: u64 = 1 << 4;
