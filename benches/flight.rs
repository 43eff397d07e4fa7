//! Times of single flights and orbit steps by criterion: `cargo bench --bench flight`.
//!
//! Ids are `first_contact/TIER/FIGURE` and `orbit/TIER/FIGURE`; throughput counts impacts. For the price of proofs as
//! ratios, with widths, see `ratios`.

#![allow(missing_docs)] // the macros below make a public function

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use impact_pair::contact::{Margins, Radii, first_contact, first_contact_f64, textbook};
use impact_pair::number::{Kernel, Std, Trigonometry};
use impact_pair::orbit::Arithmetic;
use impact_pair_benches::figures;

const FLIGHTS: u64 = 1000;

fn flights(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("first_contact");
    group.throughput(Throughput::Elements(FLIGHTS));
    for figure in figures() {
        let (pair, launches) = figure.launches(FLIGHTS);
        let (margins, centre) = (Margins::new(&pair), pair.centre());
        group.bench_function(format!("plain_std/{}", figure.name), |bencher| {
            bencher.iter(|| {
                for launch in black_box(&launches) {
                    let flight = launch.flight_with(&centre, Std::sin_cos(launch.phase));
                    black_box(first_contact_f64::<Std>(&flight));
                }
            });
        });
        group.bench_function(format!("plain/{}", figure.name), |bencher| {
            bencher.iter(|| {
                for launch in black_box(&launches) {
                    black_box(first_contact_f64::<Kernel>(&launch.flight(&centre)));
                }
            });
        });
        group.bench_function(format!("certified/{}", figure.name), |bencher| {
            bencher.iter(|| {
                for launch in black_box(&launches) {
                    black_box(first_contact(&launch.flight(&centre), &margins, Radii::default()));
                }
            });
        });
        let intervals = pair.map(|&x| x.into());
        group.bench_function(format!("textbook/{}", figure.name), |bencher| {
            bencher.iter(|| {
                for launch in black_box(&launches) {
                    black_box(textbook::first_contact(&launch.intervals(&intervals)));
                }
            });
        });
    }
}

fn orbits(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("orbit");
    for figure in figures() {
        for arithmetic in [Arithmetic::Float, Arithmetic::Interval, Arithmetic::Inari] {
            let reach = figure.orbit(arithmetic, FLIGHTS).count() as u64;
            group.throughput(Throughput::Elements(reach));
            group.bench_function(format!("{arithmetic}/{}", figure.name), |bencher| {
                bencher.iter_batched(
                    || figure.orbit(arithmetic, reach),
                    |orbit| orbit.for_each(|impact| _ = black_box(impact)),
                    criterion::BatchSize::SmallInput,
                );
            });
        }
    }
}

criterion_group!(benches, flights, orbits);
criterion_main!(benches);
