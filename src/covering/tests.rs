//! Chains against the figures.

use super::*;

fn scene(name: &str) -> Scene {
    let path = format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Scene::parse(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn figures() {
    for name in ["figure-14", "figure-16", "figure-17", "figure-12", "figure-13", "figure-15", "chatter", "graze", "two-tones", "square-wave", "cascade"] {
        let n = std::env::var("N").map_or(20_000, |n| n.parse().unwrap());
        let scene = scene(name);
        let time = std::time::Instant::now();
        let mut shadow = Shadow::of(&scene).unwrap();
        let mut eps: Vec<f64> = shadow.by_ref().take(n).map(|impact| impact.phase.rad()).collect();
        let time = time.elapsed();
        eps.sort_by(f64::total_cmp);
        let at = |q: f64| eps.get((eps.len() as f64 * q) as usize).or(eps.last()).copied();
        println!("{name} {} start {:?} median {:?} 99.9 {:?} max {:?} {:?} {:?}", eps.len(), shadow.start(), at(0.5), at(0.999), at(1.0), shadow.ending(), time);
    }
}
