//! Microseconds per flight at 256 bits: `cargo run --release --example speed`.

#[path = "../tests/common/mod.rs"]
mod common;

use common::{Random, figure, random_case};
use impact_pair_truth::{first_contact, orbit};
use std::time::Instant;

fn main() {
    for precision in [256, 512, 1024] {
        for number in 12..=17 {
            let (problem, start) = figure(number, precision);
            let clock = Instant::now();
            let count = orbit(&problem, &start, 2000).len();
            println!("P={precision} fig{number}: {:.1} us", clock.elapsed().as_secs_f64() * 1e6 / count as f64);
        }
        let mut random = Random::seeded(7);
        let flights: Vec<_> = (0..5000).map(|_| random_case(&mut random, precision)).collect();
        let clock = Instant::now();
        for (problem, start) in &flights {
            std::hint::black_box(first_contact(problem, start));
        }
        println!("P={precision} random: {:.1} us", clock.elapsed().as_secs_f64() * 1e6 / 5000.0);
    }
}
