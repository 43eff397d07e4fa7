//! Starts that straddle the branches of the code: the library's first impact, in each arithmetic, against the truth.
//!
//! The scenes are those of `tests/straddle`, where `check` judges them; here MPFR does, which proves nothing but shares
//! nothing either. `--nocapture` shows the counts by family.

#[path = "../../../tests/straddle/starts.rs"]
#[allow(dead_code)]
mod starts;

use crate::common::judge::{Case, From, Tally};
use crate::common::straddling;
use crate::common::straddling::{ImpactVerdict, question};
use crate::common::{Random, cases};
use impact_pair::orbit::{Arithmetic, Settings};
use rug::Float;
use starts::{Dice, case};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

const ARITHMETICS: [Arithmetic; 5] =
    [Arithmetic::Interval, Arithmetic::Inari, Arithmetic::Bits(64), Arithmetic::Bits(256), Arithmetic::Auto];
/// Time above which a start is shown: more than `auto` takes.
const SLOW_START: Duration = Duration::from_secs(2);

/// Number of times that each verdict was found in each family.
type Counts = BTreeMap<(&'static str, ImpactVerdict), usize>;

fn print(counts: &Counts) {
    println!("| family | {} |", ImpactVerdict::ALL.map(|kind| format!("{kind:?}")).join(" | "));
    println!("|---|{}", "---|".repeat(ImpactVerdict::ALL.len()));
    for (family, _) in starts::FAMILIES {
        let row = ImpactVerdict::ALL.map(|kind| counts.get(&(family, kind)).copied().unwrap_or(0).to_string());
        println!("| {family} | {} |", row.join(" | "));
    }
}

#[test]
fn first_impacts_near_branch_boundaries_are_right() {
    let mut random = Random::seeded(1101);
    let (mut counts, mut failures, mut requested) = (Counts::new(), Vec::new(), 0);
    for number in 0.. {
        if requested == cases(2000) {
            break;
        }
        let case = case(&mut Dice(random.bits()), number);
        let Some((problem, start)) = question(&case.scene) else { continue };
        requested += 1;
        let arithmetic = ARITHMETICS[number as usize / starts::FAMILIES.len() % ARITHMETICS.len()];
        let settings = Settings { arithmetic, max_bits: 1024, ..Settings::default() };
        let clock = Instant::now();
        let (judgement, report) = straddling::judge(&case.scene, (&problem, &start), settings);
        if clock.elapsed() > SLOW_START {
            println!("slow, {:?} in {arithmetic:?}:\n{}", clock.elapsed(), case.text);
        }
        *counts.entry((case.family, judgement)).or_default() += 1;
        if judgement == ImpactVerdict::Wrong {
            failures.push(format!("{} in {arithmetic:?}: {report}\n{}", case.family, case.text));
        }
    }
    print(&counts);
    assert!(failures.is_empty(), "{} are wrong:\n{}", failures.len(), failures[..failures.len().min(8)].join("\n"));
    // A judge that is never asked, or never tells, would pass anything.
    let sum = |kind| counts.iter().filter(|((_, found), _)| *found == kind).map(|(_, count)| count).sum::<usize>();
    assert!(2 * (sum(ImpactVerdict::Right) + sum(ImpactVerdict::Released)) > requested, "too few are judged");
    assert!(10 * sum(ImpactVerdict::Open) < requested, "the truth is open too often");
    assert!(10 * sum(ImpactVerdict::NoScene) < requested, "too many are out of range");
}

/// The control: the impact of a start, judged by the truth of a gap that is a little wider.
#[test]
fn the_reference_refutes_the_impact_of_a_neighbouring_start() {
    let mut random = Random::seeded(1102);
    let (mut found, mut requested) = (0, 0);
    for number in 0..2000 {
        let case = case(&mut Dice(random.bits()), number);
        let Some((mut problem, start)) = question(&case.scene) else { continue };
        let settings = Settings { arithmetic: Arithmetic::Bits(256), ..Settings::default() };
        if straddling::judge(&case.scene, (&problem, &start), settings.clone()).0 != ImpactVerdict::Right {
            continue;
        }
        requested += 1;
        problem.gap *= Float::with_val(64, 1.0 + 1e-9);
        found += usize::from(straddling::judge(&case.scene, (&problem, &start), settings).0 == ImpactVerdict::Wrong);
    }
    println!("{found} of {requested} impacts of neighbours are found wrong");
    assert!(2 * found > requested);
}

/// A multiple of a quarter period up to 2 forcing periods away, and 2^-1 to 2^-70 before, at or after it, as far as doubles go.
fn phase(random: &mut Random) -> f64 {
    let quarter = 0.25 * (random.below(17) as f64 - 8.0);
    let off = (-1.0 - random.below(70) as f64).exp2();
    match random.below(5) {
        0 => quarter,
        1 | 2 => quarter + off,
        _ => quarter - off,
    }
}

/// A little: 10^-1 to 10^-60, or as small a power of two; now and then nothing.
fn little(random: &mut Random) -> f64 {
    match random.below(6) {
        0 => 0.0,
        1 | 2 => (-1.0 - random.below(200) as f64).exp2(),
        _ => random.magnitude(-60.0, -1.0),
    }
}

fn alpha(random: &mut Random) -> f64 {
    [1.0, 1.0, 0.1, 0.5, 10.0, 1e-3, 1e3, 1e-30][random.below(8) as usize] * [1.0, 0.9][random.below(2) as usize]
}

#[test]
fn doubles_certify_no_wrong_contact_from_a_wall_next_to_quarter_periods() {
    let mut random = Random::seeded(1103);
    let mut tally = Tally::new("walls, quarter turns");
    // The truth: a hop of about 1e-19 forcing periods, back to the same wall.
    let hop = Case { alpha: 1.0, phase: 0.5 - (-54f64).exp2(), velocity: 1e-33, from: From::Right };
    println!("{hop:?}: {:?}", tally.flight(&hop, 0));
    for _ in 0..cases(20_000) {
        let (alpha, phase) = (alpha(&mut random), phase(&mut random));
        let resting = TAU * alpha * (1.0 - (TAU * phase).cos());
        let velocity = match random.below(8) {
            0 => resting,
            1 => (resting * (1.0 + little(&mut random))).abs(),
            2 => TAU * alpha * random.magnitude(-3.0, 1.0),
            _ => little(&mut random),
        };
        let from = if random.below(2) == 0 { From::Left } else { From::Right };
        tally.flight(&Case { alpha, phase, velocity, from }, 0);
    }
    assert!(2 * tally.certified > tally.requested);
    tally.finish();
}

#[test]
fn doubles_certify_no_wrong_contact_from_next_to_a_wall() {
    let mut random = Random::seeded(1104);
    let mut tally = Tally::new("next to walls, quarter turns");
    for _ in 0..cases(20_000) {
        let (alpha, phase) = (alpha(&mut random), phase(&mut random));
        let height = match random.below(4) {
            0 => 1.0 - random.magnitude(-15.9, -1.0),
            1 => 0.5,
            2 => random.magnitude(-16.0, -1.0),
            _ => random.magnitude(-60.0, -1.0),
        };
        let sign = [1.0, -1.0][random.below(2) as usize];
        let velocity = match random.below(6) {
            0 => TAU * alpha * (sign - (TAU * phase).cos()),
            1 => -TAU * alpha * (TAU * phase).cos() + sign * little(&mut random),
            2 => sign * TAU * alpha * random.magnitude(-3.0, 1.0),
            _ => sign * little(&mut random),
        };
        tally.flight(&Case { alpha, phase, velocity, from: From::Inside(height) }, 0);
    }
    assert!(2 * tally.certified > tally.requested);
    tally.finish();
}
