//! A scene with another value of one of its parameters or initial data.

use std::str::FromStr;

use super::Scene;
use crate::error::{Error, within};
use crate::excitation::Harmonic;
use crate::pair::ImpactPair;
use crate::start::{Place, Start};
use impact_pair_exact::Exact;

/// A parameter or a datum of the start, as the scene file names it.
///
/// ```
/// use impact_pair_model::scene::Key;
/// assert_eq!("amplitude".parse::<Key>()?, Key::Amplitude);
/// assert_eq!("start.velocity".parse::<Key>()?.name(), "start.velocity");
/// # Ok::<(), impact_pair_model::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Key {
    /// `A`
    Amplitude,
    /// `W`
    Frequency,
    /// `tau`
    Phase,
    /// `d`
    Gap,
    /// `e`
    Restitution,
    /// The time of the start.
    StartTime,
    /// `W t + tau` at the start, instead of its time; of the scene's own W and tau (of several harmonics those of the
    /// fastest) unless these vary as well.
    StartPhase,
    /// The relative displacement at a start inside the gap.
    StartPosition,
    /// The relative velocity at the start.
    StartVelocity,
}

impl Key {
    /// All of them, parameters first: in the order in which they take effect.
    pub const ALL: [Self; 9] = [
        Self::Amplitude,
        Self::Frequency,
        Self::Phase,
        Self::Gap,
        Self::Restitution,
        Self::StartTime,
        Self::StartPhase,
        Self::StartPosition,
        Self::StartVelocity,
    ];

    /// Its name in messages and in what is written.
    pub fn name(self) -> &'static str {
        match self {
            Self::Amplitude => "amplitude",
            Self::Frequency => "frequency",
            Self::Phase => "phase",
            Self::Gap => "gap",
            Self::Restitution => "restitution",
            Self::StartTime => "start.time",
            Self::StartPhase => "start.phase",
            Self::StartPosition => "start.position",
            Self::StartVelocity => "start.velocity",
        }
    }

    /// Its symbol in the paper, and its unit.
    pub fn symbol(self) -> (&'static str, &'static str) {
        match self {
            Self::Amplitude => ("A", "length"),
            Self::Frequency => ("Ω", "rad/time"),
            Self::Phase => ("τ", "rad"),
            Self::Gap => ("d", "length"),
            Self::Restitution => ("e", ""),
            Self::StartTime => ("t₀", "time"),
            Self::StartPhase => ("Ωt₀ + τ", "rad"),
            Self::StartPosition => ("y₀", "length"),
            Self::StartVelocity => ("v₀", "length/time"),
        }
    }
}

const ON_A_WALL: &str = "the scene starts on a wall (give it a start.position instead)";

fn not_a_key(text: &str) -> Error {
    let keys = Key::ALL.map(Key::name).join(", ");
    Error::out_of_range(None, format!("the key is \"{text}\", but accepted are {keys}"))
}

impl FromStr for Key {
    type Err = Error;

    /// The table of a parameter (`pair.gap`) may be left out, that of the start may not.
    fn from_str(text: &str) -> Result<Self, Error> {
        let short = text.strip_prefix("excitation.").or_else(|| text.strip_prefix("pair.")).unwrap_or(text);
        Self::ALL.into_iter().find(|key| key.name() == short).ok_or_else(|| not_a_key(text))
    }
}

impl Scene {
    /// The scene with these values in the place of its own; the settings of its run are kept.
    ///
    /// # Errors
    /// When a value is not in its range, it is that of a harmonic and there are several, the start then is none (a position beyond the gap), or there is a start on a
    /// wall and a position for it.
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
        let mut excitation = self.pair.excitation().clone();
        let (mut gap, mut restitution) = (self.pair.gap().clone(), self.pair.restitution().clone());
        match key {
            Key::Amplitude | Key::Frequency | Key::Phase => excitation = self.only_with(key, value)?.into(),
            Key::Gap => gap = value,
            Key::Restitution => restitution = value,
            Key::StartTime => self.start.time = value,
            Key::StartPhase => {
                let fastest = excitation.reference();
                let time = value.checked_sub(fastest.phase()).and_then(|since| since.checked_div(fastest.frequency()));
                self.start.time = within("start.phase", &value, time)?;
            }
            Key::StartVelocity => self.start.velocity = value,
            Key::StartPosition => match &mut self.start.place {
                Place::Inside(position) => *position = value,
                Place::Wall(_) => return Err(Error::range("start.position", &value, ON_A_WALL)),
            },
        }
        self.pair = ImpactPair::new(excitation, gap, restitution)?;
        Ok(())
    }

    /// The only harmonic with another value.
    fn only_with(&self, key: Key, value: Exact) -> Result<Harmonic, Error> {
        let old = self.pair.harmonic(&format!("a range of the {}", key.name()))?;
        let [amplitude, frequency, phase] = [old.amplitude(), old.frequency(), old.phase()].map(Exact::clone);
        match key {
            Key::Amplitude => Harmonic::new(value, frequency, phase),
            Key::Frequency => Harmonic::new(amplitude, value, phase),
            _ => Harmonic::new(amplitude, frequency, value),
        }
    }

    /// The start, asked again whether it is one.
    fn checked_start(&self) -> Result<Start, Error> {
        let Start { time, velocity, place } = self.start.clone();
        match place {
            Place::Wall(wall) => Start::on_wall(time, wall, velocity),
            Place::Inside(position) => Start::inside(&self.pair, time, position, velocity),
        }
    }
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
                _ => (key as usize, "0.75"),
            };
            assert_eq!(changed, [expected], "{}", key.name());
            assert_eq!(key.name().parse::<Key>().unwrap(), key);
        }
    }

    #[test]
    fn parameters_take_effect_before_the_start() {
        let values = [(Key::StartPhase, exact("5")), (Key::Frequency, exact("4"))];
        let varied = scene("time = 0, wall = \"left\", velocity = -1").with(&values).unwrap();
        assert_eq!(varied.start().time().as_rational(), exact("1").as_rational());
    }

    #[test]
    fn what_is_out_of_range_is_refused() {
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
        // The gap shrinks over the start.
        assert!(message(&inside, Key::Gap, "3").starts_with("start.position is 1.5, but must lie strictly between"));
        assert!("velocity".parse::<Key>().unwrap_err().to_string().contains("start.velocity"));
    }
}
