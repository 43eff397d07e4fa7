//! `run`, then `check`: two independent routes judge each other, from starts that straddle every branch of the code.
//!
//! `check` shares no isolation, no units and no arithmetic with `run` (Lemma V1), so a wrong certificate is refuted by it,
//! wherever the fault is. `STRADDLE_CASES` starts (250) from `STRADDLE_SEED`, a number or `fresh` (printed, so that it can be
//! given again); `--nocapture` shows the counts by family.

mod judge;
pub mod starts;

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::environment::number;
use judge::{StartVerdict, judge};
use serde_json::json;
use starts::{Dice, FAMILIES, case};

/// Number of starts that Arb is given.
const RECORDED: u64 = 240;
/// The default seed.
const SEED: u64 = 1995;

/// Number of times that each verdict was found in each family.
type Counts = BTreeMap<(&'static str, &'static str), u64>;

fn table(counts: &Counts) -> String {
    let kinds = StartVerdict::NAMES;
    let mut text = format!("| family | {} |\n|---|{}\n", kinds.join(" | "), "---|".repeat(kinds.len()));
    for (family, _) in FAMILIES {
        let row = kinds.map(|kind| counts.get(&(family, kind)).copied().unwrap_or(0).to_string());
        text += &format!("| {family} | {} |\n", row.join(" | "));
    }
    text
}

#[test]
fn no_certificate_near_branch_boundaries_is_refuted() {
    let (cases, seed) = (number("STRADDLE_CASES", 250), number("STRADDLE_SEED", SEED));
    println!("{cases} starts from seed {seed}");
    let (next, counts, wrong) = (AtomicU64::new(0), Mutex::new(Counts::new()), Mutex::new(Vec::new()));
    let work = || loop {
        let number = next.fetch_add(1, Ordering::Relaxed);
        if number >= cases {
            return;
        }
        let case = case(&mut Dice(seed ^ number << 20), number);
        let (judgement, report) = judge(&case, number);
        *counts.lock().unwrap().entry((case.family, judgement.name())).or_default() += 1;
        if judgement == StartVerdict::Refuted {
            wrong.lock().unwrap().push(format!("start {number}, {}: {report}\n{}", case.family, case.text));
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(work);
        }
    });
    let (counts, wrong) = (counts.into_inner().unwrap(), wrong.into_inner().unwrap());
    println!("{}", table(&counts));
    assert!(
        wrong.is_empty(),
        "{} certificates are refuted (seed {seed}):\n{}",
        wrong.len(),
        wrong[..wrong.len().min(8)].join("\n")
    );
    // A judge that is never asked, or never decides, would pass anything.
    let sum = |kind: &str| counts.iter().filter(|((_, found), _)| *found == kind).map(|(_, count)| count).sum::<u64>();
    assert!(2 * sum("confirmed") > cases, "too few are confirmed");
    assert!(5 * sum("out of range") < cases, "too many are out of range");
}

/// What Arb is given: written to the file that `STRADDLE_RECORD` names, or compared with the one of the project.
#[test]
fn recorded_starts_are_those_of_the_families() {
    let made = |cases: u64, seed: u64| -> String {
        let case = |number| case(&mut Dice(seed ^ number << 20), number);
        let line = |case: starts::Case| json!({ "family": case.family, "scene": case.text }).to_string() + "\n";
        (0..cases).map(case).map(line).collect()
    };
    match std::env::var("STRADDLE_RECORD") {
        Ok(file) => {
            std::fs::write(file, made(number("STRADDLE_CASES", RECORDED), number("STRADDLE_SEED", SEED))).unwrap();
        }
        Err(_) => {
            let text = include_str!("../../validation/arb/straddling.jsonl");
            assert!(text == made(RECORDED, SEED), "STRADDLE_RECORD=validation/arb/straddling.jsonl records them anew");
        }
    }
}
