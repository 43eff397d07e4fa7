//! Scenes, pairs and starts that unit tests set up.

use crate::exact::Exact;
use crate::orbit::Start;
use crate::pair::Wall;
use crate::{Excitation, Harmonic, ImpactPair, Scene};

/// The scene of the repository with this name.
pub(crate) fn scene(name: &str) -> Scene {
    let path = format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Scene::parse(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// The scene with these entries in its tables.
pub(crate) fn scene_of(excitation: &str, pair: &str, start: &str) -> Scene {
    Scene::parse(&format!("excitation = {{ {excitation} }}\npair = {{ {pair} }}\nstart = {{ {start} }}")).unwrap()
}

/// The exact number.
pub(crate) fn exact(text: &str) -> Exact {
    text.parse().unwrap()
}

/// The pair of harmonics, each an amplitude, a frequency and a phase, with this gap and restitution.
pub(crate) fn pair_of(harmonics: &[[&str; 3]], gap: &str, restitution: &str) -> ImpactPair {
    let harmonic = |[a, w, tau]: &[&str; 3]| Harmonic::new(exact(a), exact(w), exact(tau)).unwrap();
    let excitation = Excitation::new(harmonics.iter().map(harmonic).collect()).unwrap();
    ImpactPair::new(excitation, exact(gap), exact(restitution)).unwrap()
}

/// The pair of this `A/d` and `e`, whose gap and forcing period are 1.
pub(crate) fn pair(ratio: &str, restitution: &str) -> ImpactPair {
    pair_of(&[[ratio, "2*pi", "0"]], "1", restitution)
}

/// A start on the left wall.
pub(crate) fn start() -> Start {
    Start::on_wall(exact("0"), Wall::Left, exact("-1")).unwrap()
}
