//! True documents made false by construction: no false claim is confirmed, unless `check` names it as not judged.
//!
//! Beside `tests/corrupted`, which changes one leaf after another without knowing what it changes, each forgery here is a function from
//! a true document to false ones, with the sentence why they are false ([`FORGERIES`]): the claims of a neighbouring scene under this
//! scene's name, each outcome in the place of each other, events dropped, inserted and exchanged, an orbit twice or left out, bounds at
//! the edge 0. The true ones are of every schema that `check` reads, in several states of their flags ([`originals`]). Where a
//! forgery is only almost certain to be false and is confirmed, the claims are computed anew, in 320 bits ([`known`]).
//!
//! `FORGER_CASES` limits the forgeries of one kind that are made of one document (1, of one document of each schema; `all` for all of them), `FORGER_ONLY=WORDS` asks for
//! those alone whose names have these words, and shows each verdict; `--nocapture` shows the table. `FORGER_FOLDER` names a folder into
//! which all are written, for the verified checker (`validation/coq/verified/run --forged`).

mod atlases;
mod cells;
mod descriptions;
mod edges;
mod events;
mod forged;
mod futures;
mod globals;
mod known;
mod orbits;
mod originals;
mod outcomes;
mod regions;
mod scenes;
mod shadows;
mod sweeps;
mod tangencies;
mod windows;

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

use crate::environment::number;
use forged::{Forged, Forgery, Original, are_named, changed};
use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Claims, Effort, Verdict};

/// Forgeries of one kind of one document by default.
const CASES: u64 = 1;

/// All forgeries, by what they forge.
const FORGERIES: [&[Forgery]; 14] = [
    scenes::FORGERIES,
    outcomes::FORGERIES,
    events::FORGERIES,
    shadows::FORGERIES,
    orbits::FORGERIES,
    edges::FORGERIES,
    regions::FORGERIES,
    descriptions::FORGERIES,
    sweeps::FORGERIES,
    atlases::FORGERIES,
    tangencies::FORGERIES,
    windows::FORGERIES,
    globals::FORGERIES,
    cells::FORGERIES,
];

fn cases() -> usize {
    usize::try_from(number("FORGER_CASES", CASES)).unwrap_or(usize::MAX)
}

/// The folder into which forgeries are written, for another checker to judge.
fn folder() -> Option<PathBuf> {
    let folder = PathBuf::from(std::env::var_os("FORGER_FOLDER")?);
    fs::create_dir_all(&folder).expect("the folder of FORGER_FOLDER");
    Some(folder)
}

/// The requested forgeries.
fn selected() -> Vec<&'static Forgery> {
    let words = only().unwrap_or_default();
    let is_selected = |forgery: &&Forgery| forgery.name.contains(&words);
    FORGERIES.into_iter().flatten().filter(is_selected).collect()
}

fn only() -> Option<String> {
    std::env::var("FORGER_ONLY").ok()
}

/// The verdict of `check` on a forgery.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum ForgeryVerdict {
    /// Refuted as it is read or afterwards.
    Refuted,
    Undecided,
    /// Confirmed but for the claims that are false, which are named.
    NotJudged,
    /// Confirmed, and true after all.
    True,
    /// Confirmed, but false.
    Confirmed,
}

/// The verdict, and the names of what is not judged; `None` where the document is refused.
fn verdict(text: &str) -> Option<(Verdict, Vec<String>)> {
    let claims = Claims::parse(text).ok()?;
    // All states of a pair are many boxes, words of cells are searched for, and orbits between two ends are many sets.
    let heavy = ["impact-pair/global/1", "impact-pair/chaos-cells/1", "impact-pair/windows/1"];
    // So are boxes between two manifolds.
    let is_in_boxes = text.contains("impact-pair/tangency/1") && text.contains("\"states\"");
    let is_heavy = heavy.iter().any(|schema| text.contains(schema));
    let work = if is_in_boxes {
        Effort::default().work
    } else if is_heavy {
        1 << 16
    } else {
        1 << 12
    };
    let effort = Effort { bits: 1 << 11, work, pieces: 16, ..Effort::default() };
    let verdict = claims.check_within(&effort, &Unwatched).ok()?;
    Some((verdict, claims.unjudged()))
}

fn judged(original: &Original, forged: &Forged) -> ForgeryVerdict {
    match verdict(&original.text(&forged.document)) {
        None | Some((Verdict::Refuted(_), _)) => ForgeryVerdict::Refuted,
        Some((Verdict::Undecided(_) | Verdict::Interrupted { .. }, _)) => ForgeryVerdict::Undecided,
        Some((Verdict::Confirmed { .. }, unjudged)) => {
            let false_claims = forged.false_claims.clone().unwrap_or_else(|| changed(&forged.of, &forged.document));
            let false_claims: Vec<_> = false_claims.iter().map(|path| original.name_of(path)).collect();
            if are_named(&false_claims, &unjudged) {
                ForgeryVerdict::NotJudged
            } else if !forged.is_certain && known::is_true(original.kind, &forged.document) {
                ForgeryVerdict::True
            } else {
                ForgeryVerdict::Confirmed
            }
        }
    }
}

/// Some of the forgeries, spread over all of them.
fn spread(all: Vec<Forged>, most: usize) -> Vec<Forged> {
    let count = all.len();
    let is_taken = |i: usize| count <= most || i == 0 || (i - 1) * most / count != i * most / count;
    all.into_iter().enumerate().filter(|(i, _)| is_taken(*i)).map(|(_, forged)| forged).collect()
}

/// Number of times that each verdict was found, by forgery and kind of document.
type Counts = BTreeMap<(&'static str, &'static str, ForgeryVerdict), usize>;

fn table(counts: &Counts, kinds: &[&'static str]) -> String {
    let mut text = format!("| forgery: refuted / undecided / not judged | {} |\n", kinds.join(" | "));
    text += &format!("|---{}|\n", "|---".repeat(kinds.len()));
    for forgery in selected() {
        let cell = |kind: &&'static str| {
            let of = |judgement| counts.get(&(forgery.name, *kind, judgement)).copied().unwrap_or(0);
            let all = [ForgeryVerdict::Refuted, ForgeryVerdict::Undecided, ForgeryVerdict::NotJudged].map(of);
            if all == [0; 3] { String::new() } else { all.map(|count| count.to_string()).join(" / ") }
        };
        text += &format!("| {} | {} |\n", forgery.name, kinds.iter().map(cell).collect::<Vec<_>>().join(" | "));
    }
    text
}

/// The originals are confirmed, so that what refuses a forgery is what is forged.
fn confirmed() -> Vec<Original> {
    let originals = originals::all();
    for original in &originals {
        let found = verdict(&original.text(&original.document));
        assert!(
            matches!(found, Some((Verdict::Confirmed { .. }, _))),
            "{}, {}: {found:?} {}",
            original.kind,
            original.name,
            original.document
        );
    }
    originals
}

/// Of some of the boxes by default.
#[test]
#[ignore = "deep: boxes are proved anew for each forgery; by default no_forgery_is_confirmed"]
fn no_forgery_of_boxes_is_confirmed() {
    for original in originals::in_boxes() {
        let found = verdict(&original.text(&original.document));
        assert!(matches!(found, Some((Verdict::Confirmed { .. }, _))), "{}: {found:?}", original.name);
        for forgery in tangencies::IN_BOXES {
            for forged in spread(forgery.of(&original), 4 * cases()) {
                let judgement = judged(&original, &forged);
                println!("{}, {}, {}: {judgement:?}", forgery.name, original.name, forged.what);
                assert_ne!(judgement, ForgeryVerdict::Confirmed, "{}, {}: {}", forgery.name, forged.what, forgery.why);
            }
        }
    }
}

#[test]
fn no_forgery_is_confirmed() {
    let (most, originals) = (cases(), confirmed());
    let mut kinds: Vec<&'static str> = originals.iter().map(|original| original.kind).collect();
    kinds.dedup();
    // Of few forgeries each once for each kind of document.
    let is_all = most > 1 || only().is_some();
    let (mut counts, mut wrong, folder, mut number) = (Counts::new(), Vec::new(), folder(), 0);
    for original in &originals {
        for forgery in selected() {
            let is_new = !counts.keys().any(|(name, of, _)| (*name, *of) == (forgery.name, original.kind));
            if !(is_all || is_new) {
                continue;
            }
            for forged in spread(forgery.of(original), most) {
                let since = Instant::now();
                let judgement = judged(original, &forged);
                if only().is_some() {
                    let (what, spent) = (&forged.what, since.elapsed());
                    let found = verdict(&original.text(&forged.document)).map(|(verdict, _)| verdict);
                    println!("{spent:?} {}, {}: {what}: {judgement:?}: {found:?}", forgery.name, original.name);
                }
                *counts.entry((forgery.name, original.kind, judgement)).or_default() += 1;
                if let Some(folder) = &folder {
                    number += 1;
                    let name = format!("{number}-{}-{judgement:?}.json", original.kind);
                    fs::write(folder.join(name), original.text(&forged.document)).expect("a file of FORGER_FOLDER");
                }
                if judgement == ForgeryVerdict::Confirmed {
                    let Forgery { name, why, .. } = forgery;
                    let Original { kind, name: of, .. } = original;
                    let text = original.text(&forged.document);
                    wrong.push(format!("{kind}, {of}: {name}, {}\n  false: {why}\n  {text}", forged.what));
                }
            }
        }
    }
    let total = |sought| counts.iter().filter(|((.., found), _)| *found == sought).map(|(_, count)| count).sum();
    let [refuted, undecided, named, true_ones]: [usize; 4] =
        [ForgeryVerdict::Refuted, ForgeryVerdict::Undecided, ForgeryVerdict::NotJudged, ForgeryVerdict::True]
            .map(total);
    println!("{}", table(&counts, &kinds));
    println!("{refuted} refuted, {undecided} undecided, {named} not judged; {true_ones} are true after all");
    assert!(wrong.is_empty(), "{} confirmed that are false:\n{}", wrong.len(), wrong.join("\n"));
    for forgery in selected() {
        let false_ones =
            counts.iter().filter(|((name, _, found), _)| *name == forgery.name && *found != ForgeryVerdict::True);
        assert!(false_ones.count() > 0, "{} forges no document", forgery.name);
    }
}
