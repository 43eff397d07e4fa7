//! Where two features meet: traits of a scene times all that can be asked, each answer judged by `check` and by a truth that shares no code.
//!
//! All pairs of traits, and all triples of start, excitation and question, by a covering array ([`traits`]). `CROSSINGS_CASES` answers (3,000)
//! from `CROSSINGS_SEED`, a number or `fresh` (printed, so that it can be given again); `CROSSINGS_ONLY` asks one of that number and prints
//! it; `--nocapture` shows the tables of counts.

#[path = "../common/mod.rs"]
mod common;
mod flight;
mod judge;
mod members;
mod motion;
mod orbits;
mod questions;
mod scenes;
mod shadow;
mod sweeps;
mod traits;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use common::Random;
use judge::{Finding, judge};
use traits::{Coverage, Crossing, Question, array, crossing};

/// The default seed.
const SEED: u64 = 1995;
/// More than an answer takes: one that does is shown.
const SLOW: Duration = Duration::from_secs(1);

/// A number from the environment, or the default; other words are refused.
fn asked(name: &str, default: u64) -> u64 {
    match std::env::var(name) {
        Ok(text) if text == "fresh" => {
            SystemTime::now().duration_since(UNIX_EPOCH).expect("after 1970").as_nanos() as u64
        }
        Ok(text) => text.parse().unwrap_or_else(|_| panic!("{name} must be a number, got {text:?}")),
        Err(_) => default,
    }
}

/// All that is counted.
#[derive(Default)]
struct Tally {
    /// By question: findings of `check`, and of the truth; how long it took.
    questions: BTreeMap<Question, ([[u64; 4]; 2], Duration)>,
    outcomes: BTreeMap<String, u64>,
    coverage: Coverage,
    no_scenes: u64,
    wrong: Vec<String>,
    open: BTreeMap<String, u64>,
}

impl Tally {
    fn print(&self) {
        println!("| question | asked | check: confirmed | undecided | nothing | refuted | truth: right | open | nothing | wrong | ms |");
        println!("|---|{}", "---|".repeat(10));
        for (question, ([check, truth], time)) in &self.questions {
            let asked: u64 = check.iter().sum();
            let counts: Vec<_> = check.iter().chain(truth).map(u64::to_string).collect();
            let each = time.as_secs_f64() * 1e3 / asked as f64;
            println!("| {} | {asked} | {} | {each:.1} |", question.words(), counts.join(" | "));
        }
        println!("\n| outcome | answers |\n|---|---|");
        for (outcome, count) in &self.outcomes {
            println!("| {outcome} | {count} |");
        }
        let [pairs, all_pairs, triples, all_triples] = self.coverage.counts();
        println!("\n{pairs} of {all_pairs} pairs and {triples} of {all_triples} triples are asked; {} are no scenes", self.no_scenes);
        for (why, count) in &self.open {
            println!("open: {count} {why}");
        }
    }
}

/// One answer and what is found of it.
fn answer(seed: u64, number: u64, crossing: Crossing, is_shown: bool, tally: &Mutex<Tally>) {
    let clock = Instant::now();
    let random = Random::new(seed ^ number << 24);
    let Some(mut case) = scenes::case(crossing, random) else {
        tally.lock().unwrap().no_scenes += 1;
        return;
    };
    let text = case.text.clone();
    let made = catch_unwind(AssertUnwindSafe(|| {
        let answer = case.ask();
        if is_shown {
            println!("{crossing:?}\n{text}{}\nasked in {:.1?}", answer.shown(), clock.elapsed());
        }
        let judgement = judge(&mut case, &answer);
        if is_shown {
            println!("judged after {:.1?}", clock.elapsed());
        }
        (answer, judgement)
    }));
    let elapsed = clock.elapsed();
    let mut tally = tally.lock().unwrap();
    let named = format!("answer {number}, {}, {crossing:?}", crossing.question.words());
    let Ok((answer, judgement)) = made else {
        tally.wrong.push(format!("{named}: a panic\n{text}"));
        return;
    };
    tally.coverage.add(&crossing);
    *tally.outcomes.entry(judgement.outcome.clone()).or_default() += 1;
    let entry = tally.questions.entry(crossing.question).or_default();
    entry.0[0][judgement.check as usize] += 1;
    entry.0[1][judgement.truth as usize] += 1;
    entry.1 += elapsed;
    for (judge, finding, words) in
        [("check", judgement.check, &judgement.words[0]), ("the truth", judgement.truth, &judgement.words[1])]
    {
        if is_shown {
            println!("{judge}: {finding:?} {words}");
        }
        if finding == Finding::Wrong {
            let shown: String = answer.shown().chars().take(1500).collect();
            tally.wrong.push(format!("{named}, by {judge}: {words}\n{text}{shown}\n"));
        } else if finding == Finding::Open && judge == "the truth" {
            *tally.open.entry(words.clone()).or_default() += 1;
        }
    }
    if elapsed > SLOW {
        println!("slow, {elapsed:.1?}: {named}\n{text}");
    }
}

#[test]
fn no_answer_of_a_crossing_is_false() {
    let (cases, seed) = (asked("CROSSINGS_CASES", 3_000), asked("CROSSINGS_SEED", SEED));
    println!("{cases} answers from seed {seed}");
    let (array, tally, next) = (array(seed), Mutex::new(Tally::default()), AtomicU64::new(0));
    if let Ok(only) = std::env::var("CROSSINGS_ONLY") {
        let number = only.parse().expect("CROSSINGS_ONLY is a number");
        answer(seed, number, crossing(&array, number), true, &tally);
    } else {
        let work = || loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= cases {
                return;
            }
            answer(seed, number, crossing(&array, number), false, &tally);
        };
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(work);
            }
        });
    }
    let tally = tally.into_inner().unwrap();
    tally.print();
    let shown = if asked("CROSSINGS_ALL", 0) > 0 { usize::MAX } else { 8 };
    let first = &tally.wrong[..tally.wrong.len().min(shown)];
    assert!(tally.wrong.is_empty(), "{} answers are false (seed {seed}):\n{}", tally.wrong.len(), first.join("\n"));
}
