//! The corpus: true documents of every schema that `check` reads, and false ones made from them. No false one is confirmed.
//!
//! The true ones are recorded ([`documents`]). Of each, every value is changed in each way that fits it, as it stands and with all that
//! follows told anew ([`changes`]); every value has another shape ([`shapes`]); and functions make it false where several values have to
//! be changed together, each with the sentence why ([`FORGERIES`]). Keys that a schema has and no recorded document has are added.
//! What is confirmed all the same must be named as not checked, or be true: computed anew in 320 bits ([`known`]), or by a reason in
//! `true.json`. False documents that need no code are files in `crates/certificate/tests/forged`.
//!
//! All are written to `target/corpus`, a file of JSON Lines for each kind: the verified checker judges the same list. `CORPUS_CASES` is
//! the number of changes at one place (default 2; `all`), `CORPUS_ONLY=WORDS` shows the verdict on each document whose name has the words.

mod changes;
mod documents;
mod grids;
mod known;
mod motions;
mod numbers;
mod original;
mod outcomes;
#[path = "../../crates/certificate/tests/recorded.rs"]
mod recorded;
mod scenes;
#[path = "../../crates/certificate/tests/schemas.rs"]
mod schemas;
mod shadow;
mod shadows;
mod shapes;
mod told;
mod truth;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Claims, Limits, Verdict};
use serde_json::{Value, json};

use crate::environment::number;
use changes::Vocabulary;
pub use documents::document;
use original::{Forged, Forgery, Original, are_named, changed};

/// All forgeries, by what they forge.
const FORGERIES: [&[Forgery]; 4] = [scenes::FORGERIES, outcomes::FORGERIES, shadows::FORGERIES, grids::FORGERIES];

/// Kinds of which a check takes a second or more, and of how many changes one is judged by default.
const SLOW: [(&str, u64); 6] =
    [("windows", 30), ("tangency", 8), ("global", 6), ("atlas", 6), ("chaos", 24), ("hyperbolic", 30)];

/// True documents that are not changed, as the computation of what is confirmed does not find them true: of a start that is the scene's own, of one impact, which other starts have as
/// well, up to a time, and of a harmonic that vanishes at an end. Nor does it find the start of long chaotic orbits in 320 bits.
const NOT_COMPUTED: [&str; 5] = [
    "shadow from a rest",
    "shadow of one impact",
    "shadow up to a time",
    "orbits that may be symmetric",
    "orbits of harmonics that cancel",
];

/// A document that is false, or almost certainly.
struct Entry {
    of: String,
    /// The kind of change: a row of the table.
    family: String,
    /// The path of the change, without positions in lists.
    place: String,
    what: String,
    why: &'static str,
    text: String,
    /// Whether it is false for sure, and what of it is false; of another shape it is unreadable.
    truth: Truth,
}

enum Truth {
    Unreadable,
    False(Vec<String>),
    /// With the document, of which it is computed.
    Open(Vec<String>, Value),
}

/// The verdict of `check`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Found {
    Unreadable,
    Refuted,
    Undecided,
    /// Confirmed but for the claims that are false, which are named.
    NotJudged,
    /// Confirmed, and true after all.
    True,
    /// Confirmed, but false.
    Confirmed,
}

/// Changes at one place by default.
const CASES: u64 = 2;

/// Changes at one place.
fn cases() -> usize {
    usize::try_from(number("CORPUS_CASES", CASES)).unwrap_or(usize::MAX)
}

fn is_default() -> bool {
    cases() as u64 == CASES
}

fn only() -> Option<String> {
    std::env::var("CORPUS_ONLY").ok()
}

/// The verdict, and the names of what is not judged; `None` where the document is refused.
fn verdict(text: &str) -> Option<(Verdict, Vec<String>)> {
    let claims = Claims::parse(text).ok()?;
    // All states of a pair are many boxes, words of cells are searched for, and orbits between two ends are many sets.
    let heavy = ["impact-pair/global/1", "impact-pair/chaos-cells/1", "impact-pair/windows/1"];
    let is_in_boxes = text.contains("impact-pair/tangency/1") && text.contains("\"states\"");
    let work = match heavy.iter().any(|schema| text.contains(schema)) {
        _ if is_in_boxes => Limits::default().work,
        true => 1 << 16,
        false => 1 << 12,
    };
    let limits = Limits { bits: 1 << 12, work, pieces: 16, ..Limits::default() };
    let verdict = claims.check_within(&limits, &Unwatched).ok()?;
    Some((verdict, claims.unjudged()))
}

fn judged(original: &Original, entry: &Entry) -> Found {
    let (verdict, unjudged) = match (verdict(&entry.text), &entry.truth) {
        (None, _) => return Found::Unreadable,
        (Some(_), Truth::Unreadable) => return Found::Confirmed,
        (Some(found), _) => found,
    };
    match (verdict, &entry.truth) {
        (Verdict::Refuted(_), _) => Found::Refuted,
        (Verdict::Undecided(_) | Verdict::Interrupted { .. }, _) => Found::Undecided,
        (Verdict::Confirmed { .. }, Truth::False(paths) | Truth::Open(paths, _)) if are_named(paths, &unjudged) => {
            Found::NotJudged
        }
        (_, Truth::Open(_, document))
            if original::is_wider(&original.document, document)
                || is_explained(original, entry)
                || known::is_true(original.kind, document)
                // A witness claims nothing: with another one a document says the same.
                || entry.place.split('.').any(|key| key == "witness")
                // The orbit that proves a description's fate.
                || entry.place.starts_with("proof.") && known::is_true("orbit", &document["proof"]) =>
        {
            Found::True
        }
        _ => Found::Confirmed,
    }
}

/// Whether `true.json` has a reason why a document with this change is true.
fn is_explained(original: &Original, entry: &Entry) -> bool {
    let reasons: Vec<Value> = serde_json::from_str(include_str!("true.json")).unwrap();
    let list = |list: &Value, is_own: &dyn Fn(&str) -> bool| {
        list.is_null() || list.as_array().unwrap().iter().any(|one| is_own(one.as_str().unwrap()))
    };
    let is_in = |all: &Value, own: &str| list(all, &|one| one == own);
    let is_place =
        |one: &str| entry.place.strip_suffix(one).is_some_and(|outer| outer.is_empty() || outer.ends_with('.'));
    reasons.iter().any(|reason| {
        is_in(&reason["kinds"], original.kind)
            && is_in(&reason["of"], &original.name)
            && list(&reason["places"], &is_place)
            && is_in(&reason["what"], entry.what.trim_end_matches(", told anew"))
    })
}

/// A number that depends on all that is hashed, the same in every run.
fn hash(of: impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    of.hash(&mut hasher);
    hasher.finish()
}

/// Of each place some of the changes, of all documents of a kind.
fn leaves(originals: &[Original], vocabulary: &Vocabulary) -> Vec<(usize, Entry)> {
    let mut places: BTreeMap<String, Vec<(u64, usize, changes::Plan)>> = BTreeMap::new();
    for (i, original) in originals.iter().enumerate() {
        for plan in changes::plans(&original.document, vocabulary) {
            let order = hash((&original.name, plan.path(), &plan.what));
            places.entry(plan.place()).or_default().push((order, i, plan));
        }
    }
    let mut entries = Vec::new();
    for (place, mut plans) in places {
        plans.sort_by_key(|(order, ..)| *order);
        for (_, i, plan) in plans.into_iter().take(cases()) {
            let original = &originals[i];
            let is_told = told::told_anew(&original.document) == original.document;
            for (k, document) in plan.documents(&original.document, is_told).into_iter().enumerate() {
                let paths = changed(&original.document, &document).iter().map(|path| original.name_of(path)).collect();
                let told = if k > 0 { ", told anew" } else { "" };
                let entry = Entry {
                    of: original.name.clone(),
                    family: plan.what.clone(),
                    place: place.clone(),
                    what: format!("{}{told}", plan.what),
                    why: "a value is another one",
                    text: original.text(&document),
                    truth: Truth::Open(paths, document),
                };
                entries.push((i, entry));
            }
        }
    }
    entries
}

/// Of each forgery some of what it makes of the documents of a kind.
fn forgeries(originals: &[Original]) -> Vec<(usize, Entry)> {
    let mut entries = Vec::new();
    for Forgery { name, why, forge } in FORGERIES.into_iter().flatten() {
        let mut order: Vec<usize> = (0..originals.len()).collect();
        order.sort_by_key(|&i| hash((name, &originals[i].name)));
        let of = |i: usize| forge(&originals[i]).into_iter().map(move |forged| (i, forged));
        let mut all: Vec<(usize, Forged)> = Vec::new();
        for i in order {
            if all.len() < cases() {
                all.extend(of(i));
            }
        }
        all.sort_by_key(|(i, forged)| hash((i, &forged.what)));
        for (i, forged) in all.into_iter().take(cases()) {
            let original = &originals[i];
            let paths = forged.false_claims.unwrap_or_else(|| changed(&original.document, &forged.document));
            let paths = paths.iter().map(|path| original.name_of(path)).collect();
            let text = original.text(&forged.document);
            let truth = if forged.is_certain { Truth::False(paths) } else { Truth::Open(paths, forged.document) };
            let (of, family, what) = (original.name.clone(), (*name).to_owned(), forged.what);
            entries.push((i, Entry { of, family, place: String::new(), what, why, text, truth }));
        }
    }
    entries
}

fn other_shapes(originals: &[Original]) -> Vec<(usize, Entry)> {
    let mut seen = BTreeSet::new();
    let mut entries = Vec::new();
    for (i, original) in originals.iter().enumerate() {
        for shapes::Shape { place, what, text } in shapes::shapes(original) {
            if !is_default() || seen.insert((place.clone(), what)) {
                let (of, family) = (original.name.clone(), what.to_owned());
                let (what, why, truth) = (family.clone(), "no schema has it", Truth::Unreadable);
                entries.push((i, Entry { of, family, place, what, why, text, truth }));
            }
        }
    }
    entries
}

/// Names of the schemas of a kind of document, of JSON Lines those of the lines.
fn schemas_of(kind: &str) -> Vec<String> {
    let parts: &[&str] = match kind {
        "lines" => &["orbit-lines-head", "orbit-lines-event", "orbit-lines-end"],
        "sweep" => &["sweep-head", "sweep-point"],
        "atlas" => &["atlas-head", "atlas-point"],
        "shadow" => &["orbit"],
        "hyperbolic" => &["chaos"],
        "list" => &[],
        kind => return vec![kind.to_owned()],
    };
    parts.iter().map(|part| (*part).to_owned()).collect()
}

/// The keys that lead to a property.
fn place_of(property: &[schemas::Step]) -> String {
    let key = |step: &schemas::Step| if let schemas::Step::Key(key) = step { Some(key.clone()) } else { None };
    property.iter().filter_map(key).collect::<Vec<_>>().join(".")
}

/// Keys of the schemas of a kind that none of its documents has, each added to one.
fn added(originals: &[Original], places: &BTreeSet<String>) -> Vec<(usize, Entry)> {
    let original = &originals[0];
    let count = original.document.as_array().map_or(0, Vec::len);
    let mut entries = Vec::new();
    for (k, name) in schemas_of(original.kind).iter().enumerate() {
        let schema = schemas::read(name);
        for property in schemas::properties(&schema) {
            let place = place_of(&property);
            if places.contains(&place) || is_of_another_kind(original.kind, &place) {
                continue;
            }
            let mut document = original.document.clone();
            let line =
                if original.is_lines { &mut document[if k == 2 { count - 1 } else { k }] } else { &mut document };
            schemas::ensure(line, &property, &schema);
            let paths = changed(&original.document, &document).iter().map(|path| original.name_of(path)).collect();
            let entry = Entry {
                of: original.name.clone(),
                family: "a key added".to_owned(),
                place,
                what: "a key added".to_owned(),
                why: "nothing of the kind is there",
                text: original.text(&document),
                truth: Truth::Open(paths, document),
            };
            entries.push((0, entry));
        }
    }
    entries
}

/// All that is made of the documents of a kind.
fn made(originals: &[Original]) -> Vec<(usize, Entry)> {
    let mut vocabulary = Vocabulary::new();
    originals.iter().for_each(|original| changes::learn(&original.document, &mut vocabulary));
    let mut entries = leaves(originals, &vocabulary);
    let places: BTreeSet<String> = entries.iter().map(|(_, entry)| entry.place.clone()).collect();
    entries.extend(forgeries(originals));
    entries.extend(other_shapes(originals));
    entries.extend(added(originals, &places));
    assert_complete(originals[0].kind, &entries);
    let is_wanted = |entry: &Entry| {
        only().is_none_or(|words| format!("{} {} {}", entry.of, entry.family, entry.place).contains(&words))
    };
    entries.retain(|(_, entry)| is_wanted(entry));
    entries
}

/// Documents with a hyperbolic set are a kind of their own.
fn is_of_another_kind(kind: &str, place: &str) -> bool {
    kind == "chaos" && place.starts_with("hyperbolic")
}

/// Of every schema of a kind each key is changed, or added where no document has it.
fn assert_complete(kind: &str, entries: &[(usize, Entry)]) {
    let places: BTreeSet<&str> = entries.iter().map(|(_, entry)| entry.place.as_str()).collect();
    for name in schemas_of(kind) {
        let properties = schemas::properties(&schemas::read(&name));
        assert!(properties.len() > 3, "{name}");
        let missed = properties
            .iter()
            .map(|property| place_of(property))
            .find(|place| !places.contains(place.as_str()) && !is_of_another_kind(kind, place));
        assert_eq!(missed, None, "{name}");
    }
}

fn originals(kind: &str) -> Vec<Original> {
    let is_computed = |original: &Original| {
        !NOT_COMPUTED.contains(&original.name.as_str()) && (kind != "shadow" || original.events().len() <= 60)
    };
    let all = documents::all().into_iter().filter(|original| original.kind == kind && is_computed(original));
    let all: Vec<Original> = all.collect();
    assert!(!all.is_empty(), "no document of the kind {kind}");
    all
}

/// Judges what is made of the documents of a kind, and writes it to `target/corpus`.
fn judge(kind: &str) {
    let originals = originals(kind);
    let share = SLOW.iter().find(|(slow, _)| *slow == kind && is_default()).map_or(1, |(_, share)| *share);
    let (mut counts, mut wrong, mut lines) = (BTreeMap::new(), Vec::new(), String::new());
    for (i, entry) in made(&originals) {
        let original = &originals[i];
        if !matches!(entry.truth, Truth::Unreadable) && hash((&entry.of, &entry.place, &entry.what)) % share != 0 {
            continue;
        }
        let since = std::time::Instant::now();
        let found = judged(original, &entry);
        if only().is_some() {
            println!("{:?} {} {} {}: {found:?}", since.elapsed(), entry.of, entry.place, entry.what);
        }
        *counts.entry((entry.family.clone(), found)).or_insert(0) += 1;
        let truth = match entry.truth {
            Truth::Open(..) => "open",
            Truth::False(_) => "false",
            Truth::Unreadable => "unreadable",
        };
        let Entry { of, family, place, what, why, text, .. } = &entry;
        let line = json!({
            "kind": kind, "of": of, "family": family, "place": place, "what": what, "why": why, "truth": truth,
            "check": format!("{found:?}"), "text": text,
        });
        lines += &format!("{line}\n");
        if found == Found::Confirmed {
            wrong.push(format!("{of}: {family}, {place} {what}\n  false: {why}\n  {text}"));
        }
    }
    let folder = Path::new(impact_pair_tests::ROOT).join("target/corpus");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join(format!("{kind}.jsonl")), lines).unwrap();
    counts.iter().for_each(|((family, found), count)| println!("| {family} | {kind} | {found:?} | {count} |"));
    assert!(wrong.is_empty(), "{} confirmed that are false:\n{}", wrong.len(), wrong.join("\n"));
}

/// A test for each kind of document.
macro_rules! each_kind {
    ($($name:ident: $kind:literal,)*) => {
        $(
            #[test]
            fn $name() {
                judge($kind);
            }
        )*

        #[test]
        fn each_kind_of_document_has_a_test() {
            assert_eq!([$($kind),*], original::KINDS);
        }
    };
}

each_kind! {
    no_false_orbit_is_confirmed: "orbit",
    no_false_lines_are_confirmed: "lines",
    no_false_shadow_is_confirmed: "shadow",
    no_false_periodic_orbit_is_confirmed: "periodic",
    no_false_motion_of_two_impacts_is_confirmed: "two-impact",
    no_false_bifurcation_is_confirmed: "bifurcations",
    no_false_cycle_is_confirmed: "cycles",
    no_false_window_is_confirmed: "windows",
    no_false_global_analysis_is_confirmed: "global",
    no_false_tangency_is_confirmed: "tangency",
    no_false_region_is_confirmed: "trap",
    no_false_horseshoe_is_confirmed: "chaos",
    no_false_cells_are_confirmed: "chaos-cells",
    no_false_hyperbolic_set_is_confirmed: "hyperbolic",
    no_false_description_is_confirmed: "description",
    no_false_sweep_is_confirmed: "sweep",
    no_false_atlas_is_confirmed: "atlas",
    no_false_list_is_confirmed: "list",
}

/// The computation that judges what is confirmed all the same has the documents for true as they are, and with narrower bounds elsewhere not.
#[test]
fn the_independent_computation_confirms_true_documents_and_no_false_ones() {
    for original in ["orbit", "shadow", "periodic", "two-impact"].into_iter().flat_map(originals) {
        let (name, document) = (&original.name, &original.document);
        assert!(truth::is_true(document), "{name}");
        for path in ["/events/0/time", "/orbits/0/impacts/0/velocity"] {
            let Some([lower, _]) = document.pointer(path).and_then(numbers::bounds) else { continue };
            let unit = numbers::unit(&lower);
            let below = numbers::pair(&(&lower - &unit * numbers::fraction(2, 1)), &(&lower - &unit));
            assert!(!truth::is_true(&original::with(document, &[(path, below)])), "{name}: {path}");
        }
    }
}
