//! Scenes, read from their text.

use impact_pair::exact::Exact;
use impact_pair::json::SceneDocument;
use impact_pair::scene::{Key, Run};
use pyo3::prelude::*;

use crate::errors::Fault;

/// A scene: one impact pair, one start, and how far to follow the orbit.
#[pyclass(frozen, module = "impact_pair._core")]
pub struct Scene {
    pub scene: impact_pair::Scene,
}

#[pymethods]
impl Scene {
    /// Reads a scene file's text.
    #[new]
    fn new(text: &str) -> PyResult<Self> {
        Ok(Self { scene: impact_pair::Scene::parse(text).map_err(Fault::from)? })
    }

    /// The title, if there is one.
    #[getter]
    fn title(&self) -> Option<&str> {
        self.scene.title()
    }

    /// Parameters and start in exact words, as JSON.
    fn document(&self) -> PyResult<String> {
        json(&SceneDocument::new(self.scene.pair(), self.scene.start()))
    }

    /// The parameters and the start in the words of the paper, a line each.
    fn words(&self) -> (String, String) {
        (self.scene.pair().in_words(), self.scene.start().in_words())
    }

    /// The table `[run]`: impacts, until, digits.
    fn run(&self) -> (Option<u64>, Option<String>, Option<u32>) {
        let Run { impacts, until, digits } = self.scene.run();
        (*impacts, until.as_ref().map(Exact::text), *digits)
    }

    /// The scene with other exact values of some keys, as the document of its parameters and start.
    fn varied(&self, keys: Vec<(String, String)>) -> PyResult<String> {
        let mut values: Vec<(Key, Exact)> = Vec::new();
        for (name, text) in &keys {
            let key = name.parse().map_err(|error| Fault::keyed(error, "values", name))?;
            if let Some(other) = values.iter().position(|(known, _)| *known == key) {
                let both = format!("must not be given beside {}: they are one key", keys[other].0);
                return Err(Fault::range(name, text, &both).into());
            }
            values.push((key, crate::numbers::exact(name, text)?));
        }
        let scene = self.scene.with(&values).map_err(Fault::from)?;
        json(&SceneDocument::new(scene.pair(), scene.start()))
    }
}

/// A document as JSON.
pub fn json(document: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_string(document).map_err(|error| Fault::other(error).into())
}

/// The scenes of the repository, by name.
const PAPER_SCENES: [(&str, &str); 18] = [
    ("cascade", include_str!("../../scenes/cascade.toml")),
    ("chatter", include_str!("../../scenes/chatter.toml")),
    ("doublings", include_str!("../../scenes/doublings.toml")),
    ("even-cycles", include_str!("../../scenes/even-cycles.toml")),
    ("figure-10", include_str!("../../scenes/figure-10.toml")),
    ("figure-11", include_str!("../../scenes/figure-11.toml")),
    ("figure-12-exact", include_str!("../../scenes/figure-12-exact.toml")),
    ("figure-12", include_str!("../../scenes/figure-12.toml")),
    ("figure-13", include_str!("../../scenes/figure-13.toml")),
    ("figure-14", include_str!("../../scenes/figure-14.toml")),
    ("figure-14-sink", include_str!("../../scenes/figure-14-sink.toml")),
    ("figure-14-sink-35", include_str!("../../scenes/figure-14-sink-35.toml")),
    ("figure-15", include_str!("../../scenes/figure-15.toml")),
    ("figure-16", include_str!("../../scenes/figure-16.toml")),
    ("figure-17", include_str!("../../scenes/figure-17.toml")),
    ("graze", include_str!("../../scenes/graze.toml")),
    ("square-wave", include_str!("../../scenes/square-wave.toml")),
    ("two-tones", include_str!("../../scenes/two-tones.toml")),
];

/// The names of the scenes that the package has.
pub fn names() -> Vec<&'static str> {
    PAPER_SCENES.iter().map(|(name, _)| *name).collect()
}

/// The text of a scene of the paper's figures, or of the other examples, by its name.
#[pyfunction]
pub fn paper(name: &str) -> Option<&'static str> {
    PAPER_SCENES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}
