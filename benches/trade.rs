//! Costs of accuracy, by criterion: `cargo bench --bench trade`.
//!
//! Orbit steps in the arithmetics of `impact-pair trade`, for figures 12 (periodic) and 14 (chaotic). Ids are
//! `trade/FIGURE/ARITHMETIC`; throughput counts the impacts that are reached.

#![allow(missing_docs)] // the macros below make a public function

use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use impact_pair_benches::{Figure, figures};

const IMPACTS: u64 = 200;
/// 128 bits take figure 14 through all its impacts.
const BITS: [u32; 3] = [64, 128, 256];
const DIGITS: [u32; 5] = [3, 9, 15, 30, 100];

fn arithmetics() -> impl Iterator<Item = (String, Settings)> {
    let settings = |arithmetic| Settings { impacts: Some(IMPACTS), arithmetic, ..Settings::default() };
    let fixed = [Arithmetic::Float, Arithmetic::Interval, Arithmetic::Inari].map(|fixed| (fixed.to_string(), fixed));
    let bits = BITS.map(|bits| (format!("{bits}_bits"), Arithmetic::Bits(bits)));
    let auto = DIGITS.map(|digits| (format!("auto_{digits}"), Settings { digits, ..settings(Arithmetic::Auto) }));
    fixed.into_iter().chain(bits).map(move |(name, arithmetic)| (name, settings(arithmetic))).chain(auto)
}

fn orbit(figure: &Figure, settings: &Settings) -> Orbit {
    Orbit::new(&figure.pair, &figure.start, settings.clone()).expect("printed data")
}

fn trade(criterion: &mut Criterion) {
    for figure in figures().iter().filter(|figure| ["fig12", "fig14"].contains(&figure.name)) {
        let mut group = criterion.benchmark_group(format!("trade/{}", figure.name));
        group.warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(3));
        for (name, settings) in arithmetics() {
            group.throughput(Throughput::Elements(orbit(figure, &settings).count() as u64));
            group.bench_function(name, |bencher| {
                bencher.iter_batched(
                    || orbit(figure, &settings),
                    |orbit| orbit.for_each(|impact| _ = black_box(impact)),
                    BatchSize::SmallInput,
                );
            });
        }
    }
}

criterion_group!(benches, trade);
criterion_main!(benches);
