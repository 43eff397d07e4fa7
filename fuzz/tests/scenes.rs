//! Scene files: read, or refused with a message; what is read is followed for a few impacts, by little work, in each arithmetic.

use impact_pair::Scene;
use impact_pair::orbit::{Arithmetic, Orbit, Progress, Settings};
use impact_pair_fuzz::{config, edited, share};
use proptest::prelude::*;

/// The scenes of the project, and some that are short.
fn seeds() -> Vec<String> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let scenes = files.iter().map(|path| std::fs::read_to_string(path).unwrap());
    let excitation = [
        "{ amplitude = 1, frequency = \"pi\", phase = 0 }",
        "{ amplitude = [1, \"1/3\"], frequency = [1, \"sqrt(2)\"], phase = [0, 1] }",
    ];
    let start = ["{ time = 0, wall = \"left\", velocity = -1 }", "{ time = \"1/3\", position = 0.2, velocity = 0 }"];
    let short = excitation.iter().flat_map(|excitation| {
        start.map(|start| {
            format!("excitation = {excitation}\npair = {{ gap = 10, restitution = 0.5 }}\nstart = {start}\n")
        })
    });
    scenes.chain(short).collect()
}

/// Impacts and other events that are followed.
const MAX_EVENTS: usize = 60;

proptest! {
    #![proptest_config(config())]

    #[test]
    fn scenes_are_read_and_followed_or_refused(text in edited(seeds()), which in 0_usize..3) {
        let scene = match Scene::parse(&text) {
            Ok(scene) => scene,
            Err(error) => {
                prop_assert!(!error.to_string().is_empty());
                return Ok(());
            }
        };
        let arithmetic = [Arithmetic::Auto, Arithmetic::Interval, Arithmetic::Float][which];
        let settings = Settings { arithmetic, impacts: Some(6), max_bits: 1024, ..scene.settings() };
        match Orbit::of(&scene, settings) {
            Ok(mut orbit) => {
                let end = (0..MAX_EVENTS).map(|_| orbit.advance()).find(|event| matches!(event, Progress::Ended));
                prop_assert!(end.is_some() || orbit.outcome().is_none());
            }
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }
}

#[test]
fn many_are_read_and_many_refused() {
    let share = share(seeds(), |text| Scene::parse(text).is_ok());
    assert!((0.25..0.75).contains(&share), "{share}");
}
