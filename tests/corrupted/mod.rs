//! Every field of every certificate, changed in every way: nothing that is false is confirmed.
//!
//! The tree of each document is walked, and each leaf changed by each kind of change that fits it ([`changes`]), once as it stands
//! and once with the message, the count and the numbers told anew, so that what is wrong stands alone. What is confirmed all the same
//! must be true: the motion computed anew from the changed document, by the library and in 320 bits, says so ([`truth`]).
//! `PROPTEST_CASES` scales how many changes of a document are tried; from 100,000 on, as in `validation/run --full`, all are, for half an hour.

mod changes;
pub mod documents;
pub mod others;
mod recorded;
pub mod shadow;
pub mod truth;

use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Claims, Effort, Verdict};
use serde_json::Value;

/// Changes of a document that are tried by default, each with the counts and messages as they were and made consistent.
const DEFAULT_CHANGES: usize = 2;

fn tried() -> usize {
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(256);
    if cases >= 100_000 { usize::MAX } else { (DEFAULT_CHANGES * cases).div_ceil(256) }
}

/// The verdict of `check` and the keys not checked; `None` where the document is refused.
fn verdict(document: &Value) -> Option<(Verdict, Vec<String>)> {
    let claims = Claims::parse(&document.to_string()).ok()?;
    let effort = Effort { bits: 1 << 12, work: 1 << 12, pieces: 16, ..Effort::default() };
    let verdict = claims.check_within(&effort, &Unwatched).ok()?;
    Some((verdict, claims.unjudged()))
}

fn is_confirmed(document: &Value) -> bool {
    matches!(verdict(document), Some((Verdict::Confirmed { .. }, _)))
}

/// A step of a generator of numbers (Knuth's).
fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *state >> 33
}

/// The changes of all plans for a document, or of `most` randomly chosen plans.
fn some(document: &Value, most: usize, seed: u64) -> Vec<changes::Change> {
    let mut plans = changes::plans(document);
    let mut state = seed;
    while plans.len() > most {
        let at = next(&mut state) as usize % plans.len();
        plans.swap_remove(at);
    }
    plans.into_iter().flat_map(|plan| plan.changes(document)).collect()
}

#[test]
fn nothing_that_is_false_is_confirmed() {
    let (mut confirmed, mut refused, mut false_ones) = (0, 0, Vec::new());
    for (seed, (name, document)) in documents::all().into_iter().enumerate() {
        assert!(is_confirmed(&document), "{name}: {:?}", verdict(&document));
        for change in some(&document, tried(), seed as u64) {
            match verdict(&change.document) {
                Some((Verdict::Confirmed { .. }, unjudged)) => {
                    let is_named = unjudged.iter().any(|key| change.is_at(key));
                    if !is_named && !truth::is_true(&change.document) {
                        false_ones.push(format!("{name}: {} {}: {}", change.path, change.what, change.document));
                    }
                    confirmed += 1;
                }
                _ => refused += 1,
            }
        }
    }
    assert!(false_ones.is_empty(), "{} confirmed that are false:\n{}", false_ones.len(), false_ones.join("\n"));
    println!("{refused} changes refused, {confirmed} confirmed that are true");
    assert!(refused > confirmed && confirmed > 0, "{refused} {confirmed}");
}

/// The independent computation that the exemption rests on confirms the documents as they are, and no false ones.
#[test]
fn the_independent_computation_confirms_true_documents_and_no_false_ones() {
    let documents = documents::all();
    let wrong: Vec<_> = documents.iter().filter(|(_, document)| !truth::is_true(document)).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
    for (name, document) in documents {
        let lists = ["/events/0/time", "/orbits/0/impacts/0/velocity"];
        for bounds in lists {
            let mut copy = document.clone();
            let Some(place) = copy.pointer_mut(bounds) else { continue };
            let [lower, _] = [0, 1].map(|end| place[end].as_str().unwrap().to_owned());
            place[1] = Value::String(changes::moved(&lower, -1));
            place[0] = Value::String(changes::moved(&lower, -2));
            assert!(!truth::is_true(&copy), "{name}: {bounds}");
        }
    }
}
