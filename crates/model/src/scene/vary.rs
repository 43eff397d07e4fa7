//! A scene with another value of one of its parameters or initial data.

use super::Scene;
use super::key::{Key, Term};
use crate::error::{Error, within};
use crate::excitation::{Excitation, Harmonic};
use crate::pair::ImpactPair;
use crate::start::{Place, Start};
use impact_pair_exact::Exact;

const STARTS_ON_WALL: &str = "the scene starts on a wall (give it a start.position instead)";

impl Scene {
    /// The scene with these values in place of its own; the settings of its run are kept.
    ///
    /// # Errors
    /// Returns an error if a value is out of range, if the excitation has several harmonics but the key names no term, or a term that
    /// does not exist, if the start becomes impossible (a position beyond the gap), or if a position is given for a start on a wall.
    pub fn with(&self, values: &[(Key, Exact)]) -> Result<Self, Error> {
        let mut values: Vec<_> = values.to_vec();
        values.sort_by_key(|(key, _)| *key);
        let mut scene = self.clone();
        for (key, value) in values {
            scene.set(key, value)?;
        }
        scene.start = scene.checked_start()?;
        Ok(scene)
    }

    fn set(&mut self, key: Key, value: Exact) -> Result<(), Error> {
        match key {
            Key::StartTime => self.start.time = value,
            Key::StartPhase => {
                let time = self.pair.excitation().reference().time_at(&value);
                self.start.time = within("start.phase", &value, time)?;
            }
            Key::StartVelocity => self.start.velocity = value,
            Key::StartPosition => match &mut self.start.place {
                Place::Inside(position) => *position = value,
                Place::Wall(_) => return Err(Error::range("start.position", &value, STARTS_ON_WALL)),
            },
            _ => self.pair = self.pair.with(key, value)?,
        }
        Ok(())
    }

    /// The start, checked again against the varied pair.
    fn checked_start(&self) -> Result<Start, Error> {
        let Start { time, velocity, place } = self.start.clone();
        match place {
            Place::Wall(wall) => Start::on_wall(time, wall, velocity),
            Place::Inside(position) => Start::inside(&self.pair, time, position, velocity),
        }
    }
}

impl ImpactPair {
    /// The pair with another value of one of its parameters.
    ///
    /// # Errors
    /// Returns an error if the key is one of the start, if the value is out of range, or if the excitation has several harmonics but the key
    /// names no term, or a term that does not exist.
    pub fn with(&self, key: Key, value: Exact) -> Result<Self, Error> {
        let (mut excitation, mut gap, mut restitution) =
            (self.excitation().clone(), self.gap().clone(), self.restitution().clone());
        match key {
            Key::Amplitude(term) | Key::Frequency(term) | Key::Phase(term) => {
                excitation = varied(&excitation, key, term, value)?;
            }
            Key::Gap => gap = value,
            Key::Restitution => restitution = value,
            Key::StartTime | Key::StartPhase | Key::StartPosition | Key::StartVelocity => {
                let accepted = "a pair has amplitude, frequency, phase, gap, restitution";
                return Err(Error::out_of_range(None, format!("the key is \"{key}\", but {accepted}")));
            }
        }
        Self::new(excitation, gap, restitution)
    }

    /// For a pair with an amplitude that moves the box: index of the key's harmonic, and the amplitude that other terms
    /// add to this harmonic; see [`Excitation::harmonic_of`].
    ///
    /// # Errors
    /// Returns an error if intervals leave the harmonic undecided, or if the amplitude exceeds the range of exact expressions.
    pub fn harmonic_of(&self, key: Key) -> Result<(usize, Option<Exact>), Error> {
        let excitation = self.excitation();
        let number = key.term().map_or(0, |number| usize::from(number.get()) - 1);
        let harmonic = excitation.terms().get(number).and_then(|term| excitation.harmonic_of(term));
        let accepted = "accepted is that of a term whose frequency and phase are not intervals";
        harmonic.ok_or_else(|| Error::out_of_range(None, format!("the key is \"{key}\", but {accepted}")))
    }
}

/// The excitation with another value of its only harmonic, or of one of its terms.
fn varied(excitation: &Excitation, key: Key, term: Option<Term>, value: Exact) -> Result<Excitation, Error> {
    let Some(number) = term else {
        return Ok(with(excitation.only().ok_or_else(|| no_term(excitation, key))?, key, value)?.into());
    };
    let mut terms = excitation.terms().to_vec();
    let term = terms.get_mut(usize::from(number.get()) - 1).ok_or_else(|| no_term(excitation, key))?;
    *term = with(term, key, value)?;
    Excitation::new(terms)
}

/// The harmonic with another value.
fn with(old: &Harmonic, key: Key, value: Exact) -> Result<Harmonic, Error> {
    let [amplitude, frequency, phase] = [old.amplitude(), old.frequency(), old.phase()].map(Exact::clone);
    match key {
        Key::Amplitude(_) => Harmonic::new(value, frequency, phase),
        Key::Frequency(_) => Harmonic::new(amplitude, value, phase),
        _ => Harmonic::new(amplitude, frequency, value),
    }
}

fn no_term(excitation: &Excitation, key: Key) -> Error {
    let (name, count) = (key.name(), excitation.terms().len());
    let accepted = match count {
        1 => format!("the excitation has a single term: accepted are {name} and {name}.1"),
        _ => format!("the excitation has {count} terms: accepted are {name}.1 to {name}.{count}"),
    };
    Error::out_of_range(None, format!("the key is \"{key}\", but {accepted}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(start: &str) -> Scene {
        let text = format!(
            "excitation = {{ amplitude = 1, frequency = 2, phase = 1 }}\npair = {{ gap = 4, restitution = 0.5 }}\nstart = {{ {start} }}"
        );
        Scene::parse(&text).unwrap()
    }

    fn exact(text: &str) -> Exact {
        text.parse().unwrap()
    }

    #[test]
    fn each_key_sets_what_it_names() {
        let inside = scene("time = 0, position = 0.25, velocity = 1");
        let keys = Key::ALL.map(|key| (key, inside.with(&[(key, exact("0.75"))]).unwrap()));
        for (key, varied) in keys {
            let (pair, start) = (varied.pair(), varied.start());
            let Place::Inside(position) = start.place() else { panic!("inside") };
            let excitation = pair.excitation().reference();
            let found = [
                excitation.amplitude(),
                excitation.frequency(),
                excitation.phase(),
                pair.gap(),
                pair.restitution(),
                start.time(),
                position,
                start.velocity(),
            ]
            .map(Exact::text);
            let own = ["1", "2", "1", "4", "0.5", "0", "0.25", "1"];
            let changed: Vec<_> = (0..8).filter(|&i| found[i] != own[i]).map(|i| (i, found[i].as_str())).collect();
            let expected = match key {
                // (0.75 - 1)/2
                Key::StartPhase => (5, "-0.125"),
                Key::StartPosition => (6, "0.75"),
                Key::StartVelocity => (7, "0.75"),
                _ => (Key::ALL.iter().position(|other| *other == key).unwrap(), "0.75"),
            };
            assert_eq!(changed, [expected], "{key}");
            assert_eq!(key.to_string().parse::<Key>().unwrap(), key);
        }
    }

    #[test]
    fn a_number_names_a_term_of_the_scene() {
        let text = "excitation = { amplitude = [1, 2], frequency = [3, 4], phase = 5 }
            pair = { gap = 4, restitution = 0.5 }
            start = { time = 0, wall = \"left\", velocity = -1 }";
        let two = Scene::parse(text).unwrap();
        let terms = |key: &str| {
            let varied = two.with(&[(key.parse().unwrap(), exact("7"))]).unwrap();
            let all = varied.pair().excitation().terms().iter();
            all.flat_map(|term| [term.amplitude(), term.frequency(), term.phase()].map(Exact::text)).collect::<String>()
        };
        assert_eq!(["amplitude.1", "frequency.1", "phase.1"].map(terms), ["735245", "175245", "137245"]);
        assert_eq!(["amplitude.2", "frequency.2", "phase.2"].map(terms), ["135745", "135275", "135247"]);
        let message =
            |scene: &Scene, key: &str| scene.with(&[(key.parse().unwrap(), exact("7"))]).unwrap_err().to_string();
        for key in ["amplitude", "amplitude.3"] {
            let said = format!(
                "the key is \"{key}\", but the excitation has 2 terms: accepted are amplitude.1 to amplitude.2"
            );
            assert_eq!(message(&two, key), said);
        }
        let one = scene("time = 0, wall = \"left\", velocity = -1");
        assert_eq!(
            one.with(&[("phase.1".parse().unwrap(), exact("7"))])
                .unwrap()
                .pair()
                .excitation()
                .reference()
                .phase()
                .text(),
            "7"
        );
        assert!(message(&one, "phase.2").ends_with("a single term: accepted are phase and phase.1"));
        for key in ["amplitude.0", "amplitude.x", "gap.1", "start.time.1", "amplitude."] {
            assert!(key.parse::<Key>().is_err(), "{key}");
        }
    }

    #[test]
    fn parameters_take_effect_before_the_start() {
        let values = [(Key::StartPhase, exact("5")), (Key::Frequency(None), exact("4"))];
        let varied = scene("time = 0, wall = \"left\", velocity = -1").with(&values).unwrap();
        assert_eq!(varied.start().time().as_rational(), exact("1").as_rational());
    }

    #[test]
    fn values_out_of_range_are_refused() {
        let (wall, inside) =
            (scene("time = 0, wall = \"left\", velocity = -1"), scene("time = 0, position = 1.5, velocity = 1"));
        let message = |scene: &Scene, key, value| scene.with(&[(key, exact(value))]).unwrap_err().to_string();
        assert_eq!(message(&wall, Key::Restitution, "1.5"), "pair.restitution is 1.5, but must lie in [0, 1]");
        assert_eq!(
            message(&wall, Key::StartVelocity, "1"),
            "start.velocity is 1, but on the left wall it must be at most 0"
        );
        assert!(
            message(&wall, Key::StartPosition, "0").starts_with("start.position is 0, but the scene starts on a wall")
        );
        // The gap becomes smaller than the start's position allows.
        assert!(message(&inside, Key::Gap, "3").starts_with("start.position is 1.5, but must lie strictly between"));
    }
}
