//! The exact parameters and initial data, as the user wrote them.

use impact_pair_exact::Exact;
use impact_pair_model::scene::Key;
use impact_pair_model::{Error, Excitation, Harmonic, ImpactPair, Place, Start, Wall};
use serde::{Deserialize, Serialize};

use super::number::Written;

/// A scene as exact expressions or intervals of them: excitation, gap, restitution coefficient and start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct SceneDocument {
    /// Harmonics of the excitation `E(t)`, the sum of all `A sin(W t + tau)`: amplitudes, frequencies and phases in one order.
    pub excitation: ExcitationDocument,
    /// Gap `d` between the walls, less the diameter of the ball \[length\].
    pub gap: Written,
    /// Restitution coefficient `e`, from 0 to 1.
    pub restitution: Written,
    /// State at which the motion starts.
    pub start: StartDocument,
}

/// The terms of an excitation: lists of one length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ExcitationDocument {
    /// Amplitudes `A` \[length\].
    pub amplitude: Vec<Written>,
    /// Angular frequencies `W` \[rad/time\].
    pub frequency: Vec<Written>,
    /// Phases `tau` \[rad\].
    pub phase: Vec<Written>,
}

/// A start on a wall or at a position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct StartDocument {
    /// Time of the start \[time\].
    pub time: Written,
    /// Wall on which the ball starts; absent where it starts inside the gap.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub wall: Option<Wall>,
    /// The relative displacement inside the gap \[length\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub position: Option<Written>,
    /// The relative velocity, on a wall before the impact \[length/time\].
    pub velocity: Written,
}

impl SceneDocument {
    /// Returns the scene of a pair and a start.
    pub fn new(pair: &ImpactPair, start: &Start) -> Self {
        let of_terms =
            |of: fn(&Harmonic) -> &Exact| pair.excitation().terms().iter().map(|term| of(term).into()).collect();
        let [amplitude, frequency, phase] = [Harmonic::amplitude, Harmonic::frequency, Harmonic::phase].map(of_terms);
        let (wall, position) = match start.place() {
            Place::Wall(wall) => (Some(*wall), None),
            Place::Inside(position) => (None, Some(position.into())),
        };
        Self {
            excitation: ExcitationDocument { amplitude, frequency, phase },
            gap: pair.gap().into(),
            restitution: pair.restitution().into(),
            start: StartDocument { time: start.time().into(), wall, position, velocity: start.velocity().into() },
        }
    }

    /// Returns the pair and the start.
    ///
    /// # Errors
    /// If the lists of the excitation differ in length, neither a wall nor a position is given, or a value is out of range.
    pub fn model(self) -> Result<(ImpactPair, Start), Error> {
        let ExcitationDocument { amplitude, frequency, phase } = self.excitation;
        if frequency.len() != amplitude.len() || phase.len() != amplitude.len() {
            let message = "scene.excitation must have as many frequencies and phases as amplitudes";
            return Err(Error::certificate(message.to_owned()));
        }
        let terms = amplitude.into_iter().zip(frequency).zip(phase).map(|((a, w), tau)| Harmonic::new(a.0, w.0, tau.0));
        let excitation = Excitation::new(terms.collect::<Result<_, _>>()?)?;
        let pair = ImpactPair::new(excitation, self.gap.0, self.restitution.0)?;
        let StartDocument { time, wall, position, velocity } = self.start;
        let start = match (position, wall) {
            (Some(_), Some(_)) => {
                let message = "scene.start has a wall and a position, but one of them is accepted";
                return Err(Error::certificate(message.to_owned()));
            }
            (Some(position), None) => Start::inside(&pair, time.0, position.0, velocity.0)?,
            (None, Some(wall)) => Start::on_wall(time.0, wall, velocity.0)?,
            (None, None) => return Err(Error::certificate("scene.start.wall is missing".to_owned())),
        };
        Ok((pair, start))
    }

    /// Puts a value in the place of that of a key, other than the phase of the start; `None` where the scene has no such value.
    pub fn set(&mut self, key: Key, value: Exact) -> Option<()> {
        let excitation = &mut self.excitation;
        // Without a number it is that of the only term.
        let number = key.term().map_or(0, |term| usize::from(term.get()) - 1); // exact: from 1 on
        let is_unambiguous = key.term().is_some() || excitation.amplitude.len() == 1;
        let place = match key {
            Key::Amplitude(_) => excitation.amplitude.get_mut(number).filter(|_| is_unambiguous)?,
            Key::Frequency(_) => excitation.frequency.get_mut(number).filter(|_| is_unambiguous)?,
            Key::Phase(_) => excitation.phase.get_mut(number).filter(|_| is_unambiguous)?,
            Key::Gap => &mut self.gap,
            Key::Restitution => &mut self.restitution,
            Key::StartTime => &mut self.start.time,
            Key::StartVelocity => &mut self.start.velocity,
            Key::StartPosition => self.start.position.as_mut()?,
            Key::StartPhase => return None,
        };
        *place = Written(value);
        Some(())
    }
}
