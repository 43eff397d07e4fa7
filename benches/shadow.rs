//! Costs of a shadowed impact, beside a certified step in doubles and a plain one in floating point: in one run, interleaved.
//!
//! `cargo bench --bench shadow`. The chaotic figures are shadowed for 100,000 impacts; the float orbit has as many, an orbit in
//! interval arithmetic as many as doubles certify. Times are nanoseconds an impact, median over the rounds; so are the ratios
//! taken round by round. `eps` are the radii of the proved phases, in forcing periods.

use std::hint::black_box;

use impact_pair::covering::Shadow;
use impact_pair::orbit::Arithmetic;
use impact_pair_benches::{Figure, figures, median, time};

const ROUNDS: usize = 21;
const IMPACTS: usize = 100_000;
/// Orbits in interval arithmetic that are timed together: each has tens of impacts.
const ORBITS_PER_TIMING: usize = 200;

fn main() {
    // `cargo test --benches` only checks that it runs.
    let is_bench = std::env::args().any(|argument| argument == "--bench");
    let (rounds, impacts) = if is_bench { (ROUNDS, IMPACTS) } else { (1, 1000) };
    println!("median of {rounds} interleaved rounds, nanoseconds an impact, {impacts} impacts");
    println!(
        "{:<7}{:>10}{:>10}{:>10}{:>12}{:>12}{:>12}{:>12}",
        "", "float", "interval", "shadow", "to float", "to interval", "median eps", "greatest"
    );
    for figure in figures().into_iter().filter(|figure| ["fig14", "fig16", "fig17"].contains(&figure.name)) {
        row(&figure, rounds, impacts);
    }
}

fn row(figure: &Figure, rounds: usize, impacts: usize) {
    let shadow = || Shadow::new(&figure.pair, &figure.start).expect("printed data");
    let reach = figure.orbit(Arithmetic::Interval, impacts as u64).count() as u64;
    let mut times: [Vec<f64>; 3] = Default::default();
    for _ in 0..rounds {
        let mut float = figure.orbit(Arithmetic::Float, impacts as u64);
        times[0].push(time(impacts, || float.by_ref().for_each(|impact| _ = black_box(impact))));
        let mut orbits: Vec<_> = (0..ORBITS_PER_TIMING).map(|_| figure.orbit(Arithmetic::Interval, reach)).collect();
        times[1].push(time(reach as usize * ORBITS_PER_TIMING, || {
            orbits.iter_mut().flatten().for_each(|impact| _ = black_box(impact));
        }));
        // With the first block, which is proved when the chain is made.
        times[2].push(time(impacts, || shadow().take(impacts).for_each(|impact| _ = black_box(impact))));
    }
    let ratio = |to: usize| median(times[2].iter().zip(&times[to]).map(|(a, b)| a / b).collect());
    let [float, interval, chain] = [0, 1, 2].map(|i| median(times[i].clone()));
    let mut radii: Vec<f64> = shadow().take(impacts).map(|impact| impact.phase.rad()).collect();
    assert_eq!(radii.len(), impacts, "no link fails");
    radii.sort_by(f64::total_cmp);
    println!(
        "{:<7}{float:>10.1}{interval:>10.1}{chain:>10.1}{:>12.2}{:>12.2}{:>12.1e}{:>12.1e}",
        figure.name,
        ratio(0),
        ratio(1),
        radii[impacts / 2],
        radii[impacts - 1],
    );
}
