//! Scenes of unit tests.

use impact_pair::Scene;

/// The scene of the repository with this name.
pub(crate) fn scene(name: &str) -> Scene {
    let path = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Scene::parse(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// The scene with these entries in its tables.
pub(crate) fn scene_of(excitation: &str, pair: &str, start: &str) -> Scene {
    Scene::parse(&format!("excitation = {{ {excitation} }}\npair = {{ {pair} }}\nstart = {{ {start} }}")).unwrap()
}
