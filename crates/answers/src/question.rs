//! Questions in JSON: a verb, a scene as in documents, and options as on the command line.

use impact_pair::json::{Place, SceneDocument, value};
use impact_pair::watch::Watch;
use impact_pair::{Error, ErrorKind, Scene};
use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::{
    Answer, Asked, AuditOptions, BifurcationOptions, ChaosOptions, CyclesOptions, DescribeOptions, Failure,
    GlobalOptions, Options, PeriodicOptions, RunOptions, TangencyOptions, TradeOptions, TrapOptions, TwoImpactOptions,
    Verb, WindowsOptions, read_options,
};

/// A question: what a verb is asked about a scene.
#[derive(Clone, Debug)]
pub struct Question {
    /// Name of the verb.
    pub verb: String,
    /// The scene.
    pub scene: Scene,
    /// Path of the scene, by which commands name it.
    pub name: String,
    /// True if a picture is requested as well.
    pub is_drawn: bool,
    /// The options, those that are not given by default.
    pub options: Options,
}

/// A question as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct QuestionDocument {
    verb: String,
    #[serde(rename = "scene")]
    _scene: IgnoredAny,
    #[serde(default)]
    options: Options,
}

/// Answers a question with the options of one verb.
type Ask = for<'q> fn(&'q Question, &dyn Watch) -> Result<Box<dyn Answer + 'q>, Failure>;

/// The verbs that answer a question about a scene, by name.
const VERBS: [(&str, Ask); 13] = [
    verb::<RunOptions>(),
    verb::<DescribeOptions>(),
    verb::<PeriodicOptions>(),
    verb::<BifurcationOptions>(),
    verb::<TrapOptions>(),
    verb::<ChaosOptions>(),
    verb::<CyclesOptions>(),
    verb::<WindowsOptions>(),
    verb::<GlobalOptions>(),
    verb::<TangencyOptions>(),
    verb::<TradeOptions>(),
    verb::<TwoImpactOptions>(),
    verb::<AuditOptions>(),
];

/// The row of a verb in [`VERBS`].
const fn verb<V: Verb>() -> (&'static str, Ask) {
    (V::NAME, ask::<V>)
}

fn ask<'q, V: Verb>(question: &'q Question, watch: &dyn Watch) -> Result<Box<dyn Answer + 'q>, Failure> {
    let options: V = read_options(V::NAME, &question.options)?;
    let Question { scene, name, is_drawn, .. } = question;
    let asked = Asked { scene, name, is_drawn: *is_drawn, is_document: true };
    Ok(Box::new(options.answer(&asked, watch)?))
}

impl Question {
    /// Question about a scene that stands in no file, without a picture.
    pub fn new(verb: impl Into<String>, scene: Scene, options: Options) -> Self {
        Self { verb: verb.into(), scene, name: "scene.toml".to_owned(), is_drawn: false, options }
    }

    /// Reads `{"verb": .., "scene": {..}, "options": {..}}`.
    ///
    /// # Errors
    /// If it is malformed, or a value of the scene is not accepted.
    pub fn read(text: &str) -> Result<Self, Failure> {
        // No key is there twice.
        let whole = value(text).map_err(Failure::malformed)?;
        let QuestionDocument { verb, options, .. } = serde_json::from_str(text).map_err(Failure::malformed)?;
        let scene = Place::whole(&whole).get("scene").and_then(|scene| scene.read::<SceneDocument>());
        let (pair, start) = scene.and_then(SceneDocument::model).map_err(as_scene)?;
        Ok(Self::new(verb, Scene::new(pair, start), options))
    }

    /// Answers the question, until the watch stops it; what is certified so far is kept.
    ///
    /// # Errors
    /// If there is no such verb, an option is unknown, missing or not accepted, or a value of the scene is not accepted.
    pub fn answer(&self, watch: &dyn Watch) -> Result<Box<dyn Answer + '_>, Failure> {
        let Some((_, ask)) = VERBS.iter().find(|(name, _)| *name == self.verb) else {
            let names = VERBS.map(|(name, _)| name).join(", ");
            let (option, value) = ("verb".to_owned(), self.verb.clone());
            return Err(Failure::Value { option, value, accepted: format!("accepted are {names}") });
        };
        ask(self, watch)
    }
}

/// The error of a scene within a question: no document is at fault.
fn as_scene(error: Error) -> Error {
    if error.kind() == ErrorKind::Certificate { Error::scene(error.to_string()).because(error) } else { error }
}

#[cfg(test)]
mod tests {
    use impact_pair::watch::Unwatched;

    use super::{Question, VERBS};
    use crate::{Failure, Format};

    const SCENE: &str = r#"{"excitation": {"amplitude": ["1"], "frequency": ["pi"], "phase": ["0"]}, "gap": "9.42497",
        "restitution": "0.5", "start": {"time": "0", "wall": "left", "velocity": "-12.56636"}}"#;

    fn question(verb: &str, options: &str) -> Question {
        Question::read(&format!(r#"{{"verb": "{verb}", "scene": {SCENE}, "options": {options}}}"#)).unwrap()
    }

    fn refusal(text: &str) -> Failure {
        let question = Question::read(text);
        question.and_then(|question| question.answer(&Unwatched).map(drop)).unwrap_err()
    }

    #[test]
    fn a_verb_is_found_by_its_name() {
        let question = question("run", r#"{"until": 1.00000000000000000001}"#);
        let answer = question.answer(&Unwatched).unwrap();
        assert!(answer.status().is_complete());
        let text = |format| answer.text(format).unwrap().unwrap();
        assert!(text(Format::Json).starts_with("{\"schema\":\"impact-pair/orbit/1\""));
        // All the digits that are written.
        assert!(text(Format::Json).contains("\"until\":\"1.00000000000000000001\""));
        assert_eq!(text(Format::Csv).lines().next(), Some(crate::CSV_HEADER));
        let names = VERBS.map(|(name, _)| name);
        assert!(names.iter().enumerate().all(|(i, name)| !names[..i].contains(name)));
    }

    #[test]
    fn a_malformed_question_is_refused_and_a_malformed_scene_as_a_scene() {
        let asked = |scene: &str| format!(r#"{{"verb": "trap", "scene": {scene}}}"#);
        let lacks = refusal(&asked(&SCENE.replace("\"gap\"", "\"gaps\"")));
        assert!(
            matches!(&lacks, Failure::Scene(error) if error.to_string() == "scene.gaps is \"9.42497\", but there is no such key")
        );
        assert!(matches!(refusal("[]"), Failure::Question(_)));
        assert!(
            refusal(&asked(SCENE).replace("trap", "tarp"))
                .to_string()
                .starts_with("verb is tarp, but accepted are run")
        );
        let twice = asked(SCENE).replace("\"scene\"", r#""options": {"words": 2, "words": 3}, "scene""#);
        assert!(refusal(&twice).to_string().starts_with("the key \"words\" is there twice"));
    }
}
