//! Scenes of the repository, as they are and changed.

use impact_pair::Scene;

/// The scene of this name.
pub fn scene(name: &str) -> Scene {
    changed(name, ["", ""])
}

/// The scene of this name with one text in the place of another.
pub fn changed(name: &str, [from, to]: [&str; 2]) -> Scene {
    let text = std::fs::read_to_string(format!("{}/scenes/{name}.toml", impact_pair_tests::ROOT)).unwrap();
    assert!(text.contains(from), "{from} in {name}");
    Scene::parse(&text.replacen(from, to, 1)).unwrap()
}
