//! Crossings of features: traits of a scene times all questions, each answer compared with `check` and with a truth that shares no code.
//!
//! All pairs of traits, and all triples of start, excitation and question, by a covering array ([`traits`]): `CROSSINGS_CASES` answers
//! from `CROSSINGS_SEED`, a number or `fresh` (printed, so that it can be given again), by default those rows of the array that cross a pair
//! which none before does; `CROSSINGS_ONLY` asks one of that number and prints it; `--nocapture` shows the tables of counts.

mod attractors;
mod boxes;
mod cells;
mod judge;
pub mod members;
pub mod motion;
mod orbits;
mod questions;
pub mod scenes;
mod shadow;
mod sweeps;
pub mod traits;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use crate::environment::number;
use crate::random::{Random, on_all_cores};
use judge::{AnswerVerdict, Finding, judge};
use traits::{Coverage, Crossing, Question, array, crossing};

/// Outcomes that must occur. A run of a few impacts is hardly ever proved to be attracted: what `describe` follows longer is.
const OUTCOMES: &str = "impacts-reached; time-reached; rests-forever; never-impacts; periodic; undecided (graze); undecided (width); \
    undecided (budget); shadowed: impacts-reached; shadowed: time-reached; orbits, and no others; \
    no orbit, and no others; bifurcations; a horseshoe; a hyperbolic set; global: one-rest-cycle; \
    global: an attractor of one impact in an undecided component; \
    global: an attractor of some impacts in an undecided component; atlas: decided points; images of boxes; \
    described: attracted; described: periodic; described: undecided; agreed; refused";

/// Number of answers that ask all pairs and all triples, and some more.
const CASES: u64 = 1_700;
/// The default seed: one whose answers have all the outcomes that must occur.
const SEED: u64 = 2026;

/// Findings of `check` and of the truth, and how long they took.
#[derive(Default)]
struct Counts {
    findings: [[u64; 4]; 2],
    time: Duration,
}

/// All that is counted.
#[derive(Default)]
struct Tally {
    questions: BTreeMap<Question, Counts>,
    outcomes: BTreeMap<String, u64>,
    coverage: Coverage,
    no_scenes: u64,
    wrong: Vec<String>,
    open: BTreeMap<String, u64>,
}

impl Counts {
    fn add(&mut self, judgement: &AnswerVerdict, time: Duration) {
        for (counts, finding) in self.findings.iter_mut().zip(&judgement.findings) {
            counts[*finding as usize] += 1;
        }
        self.time += time;
    }

    fn row(&self, name: &str) -> String {
        let requested: u64 = self.findings[0].iter().sum();
        let counts: Vec<_> = self.findings.iter().flatten().map(u64::to_string).collect();
        let each = self.time.as_secs_f64() * 1e3 / requested as f64;
        format!("| {name} | {requested} | {} | {each:.1} |", counts.join(" | "))
    }
}

impl Tally {
    fn add(&mut self, crossing: &Crossing, judgement: &AnswerVerdict, time: Duration) {
        self.coverage.add(crossing);
        *self.outcomes.entry(judgement.outcome.clone()).or_default() += 1;
        self.questions.entry(crossing.question).or_default().add(judgement, time);
    }

    fn print(&self) {
        let head =
            "asked | check: confirmed | undecided | nothing | refuted | truth: right | open | nothing | wrong | ms |";
        println!("\n| question | {head}\n|---|{}", "---|".repeat(10));
        for (question, counts) in &self.questions {
            println!("{}", counts.row(&format!("{question:?}")));
        }
        println!("\n{:#?}", self.outcomes);
        let [pairs, all_pairs, triples, all_triples] = self.coverage.counts();
        println!(
            "\n{pairs} of {all_pairs} pairs and {triples} of {all_triples} triples are asked; {} are no scenes",
            self.no_scenes
        );
        println!("open: {:#?}", self.open);
    }

    /// Nothing is false; a judge that is never asked, or never decides, would pass anything.
    fn judged(&self, requested: u64, all: usize, seed: u64) {
        let first = &self.wrong[..self.wrong.len().min(8)];
        assert!(self.wrong.is_empty(), "{} answers are false (seed {seed}):\n{}", self.wrong.len(), first.join("\n"));
        assert!(all as u64 <= CASES, "a full run has to ask all {all}");
        let [pairs, all_pairs, triples, all_triples] = self.coverage.counts();
        let sum = |judge: usize, finding: usize| {
            self.questions.values().map(|counts| counts.findings[judge][finding]).sum::<u64>()
        };
        if pairs == all_pairs {
            // Of `check` a third of the answers that claim something, of the truth half of all.
            let claims = requested - sum(0, Finding::Nothing as usize);
            assert!(3 * sum(0, 0) > claims && 2 * sum(1, 0) > requested, "too few are decided");
        }
        if requested < all as u64 {
            return;
        }
        assert_eq!((pairs, triples, self.no_scenes), (all_pairs, all_triples, 0), "not all are asked");
        for outcome in OUTCOMES.split("; ") {
            assert!(self.outcomes.contains_key(outcome), "no answer is \"{outcome}\"");
        }
    }
}

/// One answer and its finding.
fn answer(seed: u64, number: u64, crossing: Crossing, is_shown: bool, tally: &Mutex<Tally>) {
    let clock = Instant::now();
    let random = Random::new(seed ^ number << 24);
    let Some(mut case) = scenes::case(crossing, random) else {
        tally.lock().unwrap().no_scenes += 1;
        return;
    };
    let text = case.text.clone();
    if is_shown {
        println!("{crossing:?}\n{text}");
    }
    let made = catch_unwind(AssertUnwindSafe(|| {
        let answer = case.ask();
        if is_shown {
            println!("{}", answer.shown());
        }
        let judgement = judge(&mut case, &answer);
        (answer, judgement)
    }));
    let elapsed = clock.elapsed();
    let mut tally = tally.lock().unwrap();
    let named = format!("answer {number}, {crossing:?}");
    let Ok((answer, judgement)) = made else {
        tally.wrong.push(format!("{named}: a panic\n{text}"));
        return;
    };
    tally.add(&crossing, &judgement, elapsed);
    for ((judge, finding), words) in ["check", "the truth"].into_iter().zip(judgement.findings).zip(&judgement.words) {
        if is_shown {
            println!("{judge}: {finding:?} {words}");
        }
        if finding == Finding::Wrong {
            let shown: String = answer.shown().chars().take(1500).collect();
            let wrong = format!("{named}, by {judge}: {words}\n{text}{shown}\n");
            // A long run shows it at once.
            println!("false: {wrong}");
            tally.wrong.push(wrong);
        } else if finding == Finding::Open && judge == "the truth" {
            *tally.open.entry(words.clone()).or_default() += 1;
        }
    }
}

/// Numbers of the rows that cross two traits which no row before them does: as few as ask all pairs.
fn of_new_pairs(array: &[Crossing]) -> Vec<u64> {
    let mut covered = Coverage::default();
    let mut is_new = |row: &Crossing| {
        let before = covered.counts()[0];
        covered.add(row);
        covered.counts()[0] > before
    };
    (0..).zip(array).filter_map(|(number, row)| is_new(row).then_some(number)).collect()
}

#[test]
fn no_answer_of_a_crossing_is_false() {
    let seed = number("CROSSINGS_SEED", SEED);
    let (array, tally, next) = (array(seed), Mutex::new(Tally::default()), AtomicUsize::new(0));
    if let Ok(only) = std::env::var("CROSSINGS_ONLY") {
        let number = only.parse().expect("CROSSINGS_ONLY is a number");
        return answer(seed, number, crossing(&array, number), true, &tally);
    }
    let is_small = std::env::var_os("CROSSINGS_CASES").is_none();
    let numbers = if is_small { of_new_pairs(&array) } else { (0..number("CROSSINGS_CASES", CASES)).collect() };
    println!("{} answers from seed {seed}", numbers.len());
    let work = || {
        while let Some(&number) = numbers.get(next.fetch_add(1, Ordering::Relaxed)) {
            answer(seed, number, crossing(&array, number), false, &tally);
        }
    };
    on_all_cores(work);
    let tally = tally.into_inner().unwrap();
    tally.print();
    let [pairs, all_pairs, ..] = tally.coverage.counts();
    assert!(!is_small || pairs == all_pairs, "{pairs} of {all_pairs} pairs are asked");
    tally.judged(numbers.len() as u64, array.len(), seed);
}
