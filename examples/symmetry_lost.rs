//! The amplitude at which the simplest motion loses its symmetry, with proof: `cargo run --release --example symmetry_lost`.
//!
//! Two impacts a cycle: over the amplitude, all such motions, whether they exist (no wall is touched earlier) and are stable. The
//! symmetric one stops being stable at the pitchfork, A/d = 0.34588927..., and two that mirror one another take its place.

use impact_pair::two_impact::{MeasuredOrbit, Problem, Stability, Unknown};
use impact_pair::{Error, Harmonic, ImpactPair};

fn main() -> Result<(), Error> {
    println!("{:>6}  {:>9}  stable ones", "A/d", "motions");
    for percent in (30..=46).step_by(2) {
        let amplitude = impact_pair::exact::Exact::from(percent);
        let harmonic = Harmonic::new(amplitude, 1.into(), 0.into())?;
        let pair = ImpactPair::new(harmonic, 100.into(), "4/5".parse().expect("a number"))?;
        let answer = Problem::new(&pair, 1, Unknown::Velocity)?.answer(9);
        let is_stable = |orbit: &&MeasuredOrbit| orbit.physical == Some(true) && orbit.stability == Stability::Stable;
        let stable: Vec<&MeasuredOrbit> = answer.orbits.iter().map(|orbit| &orbit.measured).filter(is_stable).collect();
        let said = stable.iter().map(|orbit| match orbit.symmetric {
            Some(true) => "symmetric".to_owned(),
            _ => format!("left at W t + tau = {}", orbit.impacts[0].phase),
        });
        let all = if answer.is_exhaustive { "" } else { " or more" };
        println!(
            "0.{percent:<4}  {:>9}  {}",
            format!("{}{all}", answer.orbits.len()),
            said.collect::<Vec<_>>().join(", ")
        );
    }
    Ok(())
}
