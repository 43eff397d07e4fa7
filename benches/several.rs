//! Costs of several harmonics: nanoseconds per impact, over the number of terms, in one run, interleaved.
//!
//! `cargo bench --bench several`. The amplitude of a figure is shared among `n` terms whose frequencies, a few per cent
//! apart, have no common period; their sum moves the box about as the figure's harmonic does. One term is the
//! figure itself, on the path of one harmonic. Each number is the median over the rounds of the time of an orbit over
//! its impacts, as many as doubles certify; `width` is the median diameter of the enclosed phases, in forcing periods.

use std::hint::black_box;
use std::time::Instant;

use impact_pair::exact::Exact;
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use impact_pair::{Excitation, Harmonic, ImpactPair};
use impact_pair_benches::{Figure, figures, median};

const ROUNDS: usize = 101;
const TERMS: [usize; 6] = [1, 2, 3, 4, 8, 16];
/// Impacts at most: as many as every sum certifies in doubles.
const IMPACTS: u64 = 40;

fn main() {
    // `cargo test --benches` only checks that it runs.
    let rounds = if std::env::args().any(|argument| argument == "--bench") { ROUNDS } else { 1 };
    println!("median of {rounds} interleaved rounds, nanoseconds an impact; ratios to one term");
    println!(
        "{:<7}{:>6}{:>10}{:>10}{:>8}{:>10}{:>12}{:>12}",
        "", "terms", "float", "interval", "ratio", "per term", "impacts", "width"
    );
    for figure in figures().into_iter().filter(|figure| ["fig12", "fig14", "fig16"].contains(&figure.name)) {
        rows(&figure, rounds);
    }
}

fn rows(figure: &Figure, rounds: usize) {
    let pairs: Vec<_> = TERMS.iter().map(|&terms| shared(figure, terms)).collect();
    let reach: Vec<_> =
        pairs.iter().map(|pair| orbit(figure, pair, Arithmetic::Interval, IMPACTS).count() as u64).collect();
    let mut times = vec![[Vec::new(), Vec::new()]; pairs.len()];
    for _ in 0..rounds {
        for ((pair, &reach), times) in pairs.iter().zip(&reach).zip(&mut times) {
            for (arithmetic, times) in [Arithmetic::Float, Arithmetic::Interval].into_iter().zip(times) {
                let mut orbit = orbit(figure, pair, arithmetic, reach);
                let start = Instant::now();
                let impacts = orbit.by_ref().map(black_box).count();
                times.push(start.elapsed().as_secs_f64() * 1e9 / impacts as f64);
            }
        }
    }
    let one = median(times[0][1].clone());
    for ((&terms, pair), [float, interval]) in TERMS.iter().zip(&pairs).zip(times) {
        let impacts: Vec<_> = orbit(figure, pair, Arithmetic::Interval, IMPACTS).collect();
        let width = median(impacts.iter().map(|impact| 2.0 * impact.phase.rad()).collect());
        let (float, interval) = (median(float), median(interval));
        println!(
            "{:<7}{terms:>6}{float:>10.0}{interval:>10.0}{:>8.1}{:>10.0}{:>12}{width:>12.1e}",
            figure.name,
            interval / one,
            interval / terms as f64,
            impacts.len(),
        );
    }
}

/// The figure's pair with its amplitude shared equally among `terms` harmonics of nearby frequencies.
fn shared(figure: &Figure, terms: usize) -> ImpactPair {
    let harmonic = figure.pair.excitation().reference();
    let value = |text: &str| text.parse::<Exact>().expect("an expression");
    let amplitude = harmonic.amplitude() * &value(&format!("1/{terms}"));
    let term = |k: usize| {
        let frequency = harmonic.frequency() * &value(&format!("1 - {k}*sqrt(2)/100"));
        Harmonic::new(amplitude.clone(), frequency, harmonic.phase().clone()).expect("in range")
    };
    let excitation = Excitation::new((0..terms).map(term).collect()).expect("terms");
    ImpactPair::new(excitation, figure.pair.gap().clone(), figure.pair.restitution().clone()).expect("printed data")
}

fn orbit(figure: &Figure, pair: &ImpactPair, arithmetic: Arithmetic, impacts: u64) -> Orbit {
    let settings = Settings { impacts: Some(impacts), arithmetic, ..Settings::default() };
    Orbit::new(pair, &figure.start, settings).expect("printed data")
}
