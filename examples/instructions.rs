//! Follows a figure's orbit and prints how many impacts there were: what `validation/scripts/instructions` counts.
//!
//! `instructions ARITHMETIC FIGURE IMPACTS [gap]`; `gap` starts figure 12 inside the gap instead of on the wall.

#[path = "../benches/figures.rs"]
#[allow(dead_code, reason = "the benches need more of it")]
mod figures;

use std::hint::black_box;

use impact_pair::orbit::{Orbit, Start};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [arithmetic, name, impacts, place @ ..] = arguments.as_slice() else {
        eprintln!("usage: instructions ARITHMETIC FIGURE IMPACTS [gap]");
        std::process::exit(2);
    };
    let mut figure = figures::figures().into_iter().find(|figure| figure.name == name).expect("fig12 to fig17");
    if !place.is_empty() {
        let value = |text: &str| text.parse().expect("a number");
        // Half a flight after the impact at t = 0 of figure 12.
        figure.start = Start::inside(&figure.pair, value("0.5"), value("-1"), value("3*pi")).expect("inside the gap");
    }
    let arithmetic = arithmetic.parse().expect("auto, float, interval or bits");
    let orbit: Orbit = figure.orbit(arithmetic, impacts.parse().expect("a number of impacts"));
    println!("{}", orbit.map(black_box).count());
}
