//! What is proved of all words of a document by its strips (Lemma V39).

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use impact_pair_document::StripDocument;
use impact_pair_model::watch::Watch;

use super::super::Law;
use super::super::allowance::{Allowance, End};
use super::super::bases::HSet;
use super::super::judge::shortfall;
use super::super::words::Word;
use super::curve::Heights;
use super::side::overlap;
use super::{Cover, Strip};
use crate::check::Verdict;
use crate::check::blocks::in_blocks;
use crate::check::contact::Doubt;

/// Words whose work is counted together, and the part of all work that they are allowed: so threads decide nothing.
const BLOCK_SIZE: usize = 4;
const BLOCKS_PER_WORK: u64 = 2;

/// The verdict if some words are not proved by the strips, or not to be different ones; `None` if all are. `progress` receives the number of words
/// that are proved without a gap.
pub(in crate::check::chaos) fn left_open(
    law: &Law,
    (bases, words): (&[HSet], &[Word]),
    strips: &[StripDocument],
    (allowed, watch): (u64, &dyn Watch),
    progress: &mut impl FnMut(usize),
) -> Result<Option<Verdict>, End> {
    if strips.len() != words.len() {
        let message = format!("its witness has {} strips for {} words", strips.len(), words.len());
        return Ok(Some(Doubt::Open(message).on(words.len())));
    }
    let strips: Vec<Option<Strip>> = strips.iter().map(Strip::read).collect();
    let cover = Cover::new(law, bases);
    let first = AtomicUsize::new(words.len());
    let reason = |number: usize, work: &Allowance| {
        let is_proved = |strip| cover.is_proved(&words[number], strip, work);
        match strips[number].as_ref().map_or(Ok(false), is_proved) {
            Ok(true) => Ok(None),
            Ok(false) => Ok(Some("it is not proved again")),
            Err(End::Spent) => Ok(Some("the work allowed is spent")),
            Err(End::Stopped) => Err(End::Stopped),
        }
    };
    let answer = |range: Range<usize>| {
        let work = Allowance::new(allowed / BLOCKS_PER_WORK, watch); // proposes: when to give up
        let reasons: Vec<_> = range.clone().map(|number| reason(number, &work)).collect::<Result<_, _>>()?;
        if let Some(lost) = reasons.iter().position(Option::is_some) {
            first.fetch_min(range.start + lost, Ordering::Relaxed);
        }
        Ok(reasons)
    };
    let proved_until = |end: usize| progress(end.min(first.load(Ordering::Relaxed))); // exact: of two numbers of words
    let reasons = in_blocks(0..words.len(), BLOCK_SIZE, answer, proved_until)?;
    if let Some([one, other]) = overlapping(&cover, words, &strips, &reasons) {
        let message =
            format!("words[{one}] and words[{other}]: their strips are not proved to have no state in common");
        return Ok(Some(Doubt::Open(message).on(other)));
    }
    let Some(why) = reasons.iter().flatten().next() else { return Ok(None) };
    let is_found: Vec<bool> = reasons.iter().map(Option::is_none).collect();
    Ok(Some(shortfall((&is_found, why), words, bases.len())))
}

/// Two of the proved words from one h-set whose strips are not proved to have no state in common, the first one listed first.
fn overlapping(
    cover: &Cover,
    words: &[Word],
    strips: &[Option<Strip>],
    reasons: &[Option<&str>],
) -> Option<[usize; 2]> {
    let found = (0..cover.bases.len()).find_map(|from| {
        let is_own = |number: &usize| words[*number].from == from && reasons[*number].is_none();
        let own: Vec<_> =
            (0..words.len()).filter(is_own).filter_map(|number| Some((number, strips[number].as_ref()?))).collect();
        // No strip of an h-set without such heights is proved.
        overlap(&own, &Heights::of(&cover.frames[from], &cover.bases[from])?)
    })?;
    let [a, b] = found;
    Some([a.min(b), a.max(b)]) // exact: of two numbers
}
