//! Periodic orbits through the public API: known ones, and those that a search finds.

#![cfg(feature = "multiprecision")]

use impact_pair::Scene;
use impact_pair::periodic::{PeriodicOrbit, Precision, Problem};

fn scene(amplitude: &str, frequency: &str, gap: &str, restitution: &str, velocity: &str) -> Scene {
    let text = format!(
        "excitation = {{ amplitude = \"{amplitude}\", frequency = \"{frequency}\", phase = 0 }}\n\
         pair = {{ gap = \"{gap}\", restitution = \"{restitution}\" }}\n\
         start = {{ time = 0, wall = \"left\", velocity = \"{velocity}\" }}"
    );
    Scene::parse(&text).unwrap()
}

fn orbits(scene: &Scene, word: &str, cycles: u32) -> Vec<PeriodicOrbit> {
    let problem = Problem::new(scene.pair(), &word.parse().unwrap(), cycles).unwrap();
    problem.find(scene.pair(), scene.start(), Precision::default()).orbits
}

#[test]
fn show() {
    let figure_12 = scene("1", "pi", "9.42497", "0.5", "-12.56636");
    let figure_13 = scene("2", "pi", "9.42497", "0.5", "-12.56636");
    let figure_14 = scene("8", "pi", "9.42497", "0.5", "-12.56636");
    let figure_15 = scene("2", "10*pi", "1", "0.8", "-14.48");
    for (name, scene, word, cycles) in [
        ("12", &figure_12, "LR", 1),
        ("12", &figure_12, "LR", 3),
        ("13", &figure_13, "LR", 1),
        ("14", &figure_14, "LR", 1),
        ("14", &figure_14, "RRLL", 1),
        ("15", &figure_15, "RRLLL", 1),
        ("15", &figure_15, "RRLLLRRLLL", 2),
        ("r5", &scene("7.5", "1", "1", "0.8", "-1"), "RRRRRLLLLL", 1),
        ("LLR", &scene("0.498", "1", "1", "0.8", "-1"), "LLR", 1),
        ("RRL", &scene("0.498", "1", "1", "0.8", "-1"), "RRL", 1),
        ("RRLL", &scene("1", "1", "0.619", "0.8", "-1"), "RRLL", 1),
        ("n2", &scene("1", "1", "10.82", "0.5", "-1"), "LR", 2),
        ("n4", &scene("1", "1", "14.21", "0.5", "-1"), "LR", 4),
    ] {
        let t = std::time::Instant::now();
        let found = orbits(scene, word, cycles);
        println!("{name} {word} {cycles}: {} orbits {:?}", found.len(), t.elapsed());
        for orbit in found {
            let e = |x: &impact_pair::exact::Enclosure| x.mid_rad();
            println!(
                "   {:?} sym {:?} rep {:?} {:?} {} tr {:?} ev {:?} {:?} u0 {:?} v0 {:?} dom {}",
                orbit.physical,
                orbit.symmetric,
                orbit.repeats,
                orbit.stability,
                orbit.bits,
                e(&orbit.trace),
                [e(&orbit.eigenvalues[0].re).0, e(&orbit.eigenvalues[0].im).0],
                [e(&orbit.eigenvalues[1].re).0, e(&orbit.eigenvalues[1].im).0],
                e(&orbit.impacts[0].phase),
                e(&orbit.impacts[0].velocity),
                orbit.domain()[0].rad()
            );
        }
    }
}
