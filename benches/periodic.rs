//! Times of proofs of periodic orbits by criterion: `cargo bench --bench periodic`.
//!
//! `prove/WORD`: existence, uniqueness, first contacts, trace and stability of one orbit in doubles, from phases that
//! Newton's iteration has found; throughput counts impacts. `polish/WORD`: that iteration, from phases 1e-4 forcing periods off.
//! `all/FIGURE/WORD`: everything that `periodic --all` does.

#![allow(missing_docs)] // the macros below make a public function

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use impact_pair::orbit::Start;
use impact_pair::pair::Wall;
use impact_pair::periodic::{Budget, Precision, Problem, newton::polish};
use impact_pair::{Excitation, Harmonic, ImpactPair};
use impact_pair_benches::figures;

/// `A/d`, `e`, the word and its cycles: orbits of the paper and beyond, from two impacts to twenty.
const ORBITS: [(&str, &str, &str, u32); 7] = [
    ("1/9.42497", "0.5", "LR", 1),
    ("0.498", "0.8", "LLR", 1),
    ("1/0.619", "0.8", "RRLL", 1),
    ("2", "0.8", "RRLLL", 1),
    ("7.5", "0.8", "RRRRRLLLLL", 1),
    ("2", "0.8", "RRLLLRRLLL", 2),
    ("2", "0.8", "RRLLLRRLLLRRLLLRRLLL", 4),
];

fn pair(ratio: &str, restitution: &str) -> ImpactPair {
    let value = |text: &str| text.parse().expect("an exact number");
    let harmonic = Harmonic::new(value(ratio), value("1"), value("0")).expect("in range");
    ImpactPair::new(harmonic, value("1"), value(restitution)).expect("in range")
}

fn proofs(criterion: &mut Criterion) {
    for (ratio, restitution, word, cycles) in ORBITS {
        let pair = pair(ratio, restitution);
        let problem = Problem::new(&pair, &word.parse().expect("a word"), cycles).expect("a closed word");
        let velocity = "-1".parse().expect("an exact number");
        let start = Start::on_wall("0".parse().expect("an exact number"), Wall::Left, velocity).expect("a start");
        let census = problem.find(&start, Precision::default());
        let orbit = census.orbits.iter().find(|orbit| orbit.physical == Some(true)).expect("an orbit");
        let phases: Vec<f64> = orbit.phases().iter().map(|phase| phase.mid()).collect();
        let mut group = criterion.benchmark_group("prove");
        group.throughput(Throughput::Elements(phases.len() as u64));
        group.bench_function(word, |bencher| {
            bencher.iter(|| black_box(problem.prove_in_doubles(black_box(&phases)).expect("proved")));
        });
        group.finish();
        let near: Vec<f64> =
            phases.iter().enumerate().map(|(i, x)| x + if i % 2 == 0 { 1e-4 } else { -1e-4 }).collect();
        let centre = problem.reduced().expect("one harmonic").centre();
        criterion
            .benchmark_group("polish")
            .throughput(Throughput::Elements(phases.len() as u64))
            .bench_function(word, |bencher| {
                bencher.iter(|| black_box(polish(problem.chain(), &centre, black_box(near.clone()))))
            });
    }
}

/// The stable two-impact orbit of two harmonics, W and 3 W: the phases are those that `periodic` prints, in forcing periods.
fn several(criterion: &mut Criterion) {
    let value = |text: &str| text.parse().expect("an exact number");
    let harmonic = |a: &str, w: &str| Harmonic::new(value(a), value(w), value("0")).expect("in range");
    let excitation = Excitation::new(vec![harmonic("1", "1"), harmonic("1/2", "3")]).expect("two harmonics");
    let pair = ImpactPair::new(excitation, value("9.42497"), value("0.5")).expect("in range");
    let problem = Problem::new(&pair, &"LR".parse().expect("a word"), 3).expect("a closed word");
    let phases = [0.856_538_523, 2.444_887_405];
    criterion.benchmark_group("prove").throughput(Throughput::Elements(2)).bench_function(
        "LR of two harmonics",
        |bencher| {
            bencher.iter(|| black_box(problem.prove_in_doubles(black_box(&phases)).expect("proved")));
        },
    );
}

fn searches(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("all");
    group.sample_size(10);
    for figure in figures().into_iter().take(4) {
        for word in ["LR", "LLR", "LLRR"] {
            let problem = Problem::new(&figure.pair, &word.parse().expect("a word"), 1).expect("a closed word");
            group.bench_function(format!("{}/{word}", figure.name), |bencher| {
                bencher.iter(|| {
                    let census = problem.find_all(&figure.start, Precision::default(), Budget::default());
                    assert!(census.exhaustive);
                    census
                });
            });
        }
    }
}

criterion_group!(benches, proofs, several, searches);
criterion_main!(benches);
