//! States of a walk between two events.

use std::cmp::Ordering;

use super::affine::Affine;
use super::contact::Doubt;
use super::data::{Data, Piece};
use super::rest::Rest;
use super::step::{Landing, Launch, Parameters};
use super::still::Still;
use impact_pair_exact::Real;
use impact_pair_model::{Mapping, Wall};

/// States after an event, or at a start, with their proved properties.
///
/// A walk replaces its `WalkState` as a whole: properties of earlier states, or of the scene's own start, do not carry
/// over. Each constructor therefore sets every field.
pub(crate) struct WalkState<'d> {
    departure: Launch,
    landing: Option<Landing>,
    last: Last,
    going: Motion,
    /// The exact data, if the state is the scene's own start.
    start: Option<&'d Data<'d>>,
}

/// The motion that follows.
#[derive(Debug)]
enum Motion {
    /// The ball flies.
    Flight,
    /// The ball sticks to a wall.
    Rest(Rest),
    /// The ball has no drift, and comes near a wall in the same way in every forcing period.
    Still(Still),
}

/// The wall that the next mapping leads from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Last {
    /// This wall.
    Wall(Wall),
    /// No wall, from a start inside the gap: there is no mapping.
    Inside,
    /// Either wall: a graze may have been a touch.
    Either,
}

impl<'d> WalkState<'d> {
    /// State at the scene's own start.
    pub fn at_start(data: &'d Data<'d>, parameters: &Parameters, piece: &Piece) -> Self {
        let (phase, velocity, height) = data.state(piece, parameters.bits());
        let phase = phase.less_centre();
        let mut departure = match (data.wall, height) {
            (Some(wall), _) => Launch::rebound(parameters, &Landing::new(wall, phase, velocity)),
            (None, Some(height)) => Launch::inside(phase, height, velocity),
            (None, None) => unreachable!("a start without a wall is inside the gap"),
        };
        let is_at_rest = departure.velocity.hull().is_zero();
        departure.start.is_release = is_at_rest && data.inward_jerk() == Some(Ordering::Greater);
        let going = Still::of(data, is_at_rest).map_or(Motion::Flight, Motion::Still);
        Self { going, start: Some(data), ..Self::flying(departure, data.wall.map_or(Last::Inside, Last::Wall)) }
    }

    /// States at starts that may differ from the scene's start.
    pub fn of_starts(departure: Launch) -> Self {
        let last = departure.start.wall.map_or(Last::Inside, Last::Wall);
        Self::flying(departure, last)
    }

    /// State after an impact.
    pub fn after(parameters: &Parameters, landing: Landing) -> Self {
        let departure = Launch::rebound(parameters, &landing);
        let last = Last::Wall(landing.wall);
        Self { landing: Some(landing), ..Self::flying(departure, last) }
    }

    /// State after a release from a wall.
    pub fn released(parameters: &Parameters, wall: Wall, phase: Affine) -> Self {
        let still = Affine::fixed(Real::zero(parameters.bits()));
        let mut departure = Launch::on_wall(parameters, wall, phase, still);
        departure.start.is_release = true;
        Self::flying(departure, Last::Wall(wall))
    }

    /// State of a ball sticking to a wall; `departure` is its departure from the last impact before.
    pub fn resting(departure: Launch, rest: Rest) -> Self {
        let last = Last::Wall(rest.wall);
        Self { going: Motion::Rest(rest), ..Self::flying(departure, last) }
    }

    /// State past a graze of `wall`, which may have been a touch.
    pub fn past_graze(&self, departure: Launch, wall: Wall) -> Self {
        let last = if self.last == Last::Wall(wall) { self.last } else { Last::Either };
        Self::flying(departure, last)
    }

    fn flying(departure: Launch, last: Last) -> Self {
        Self { departure, landing: None, last, going: Motion::Flight, start: None }
    }

    /// The flights from the states.
    pub fn departure(&self) -> &Launch {
        &self.departure
    }

    /// The states just before the impact, if the event was an impact.
    pub fn landing(&self) -> Option<&Landing> {
        self.landing.as_ref()
    }

    /// Returns the wall that the next mapping leads from.
    pub fn last(&self) -> Last {
        self.last
    }

    /// The rest, if the ball sticks to a wall.
    pub fn rest(&self) -> Option<&Rest> {
        if let Motion::Rest(rest) = &self.going { Some(rest) } else { None }
    }

    /// The motion without drift, if the motion is of that kind.
    pub fn still(&self) -> Option<&Still> {
        if let Motion::Still(still) = &self.going { Some(still) } else { None }
    }

    /// Continues a motion without drift past a touch, which does not change the motion.
    pub fn touch(&mut self, still: Still) {
        self.going = Motion::Still(still);
    }

    /// The exact data, if the state is the scene's own start.
    pub fn start(&self) -> Option<&'d Data<'d>> {
        self.start
    }
}

impl Last {
    /// The mapping of a flight that ends on the wall `to`; `None` where the wall of departure is unknown.
    pub fn mapping(self, to: Wall) -> Option<Mapping> {
        match self {
            Self::Wall(from) => Some(Mapping::between(from, to)),
            Self::Inside | Self::Either => None,
        }
    }

    /// Proves that a claimed mapping is the mapping of a flight that ends on the wall `to`.
    pub fn leads(self, mapping: Option<Mapping>, to: Wall) -> Result<(), Doubt> {
        match mapping {
            _ if mapping == self.mapping(to) => Ok(()),
            // It is the one or the other.
            Some(mapping) if self == Self::Either && mapping.walls().1 == to => {
                Err(Doubt::open("the graze before is not distinguished from a touch, so no mapping is proved"))
            }
            _ => Err(Doubt::False("the mapping does not lead from the wall before to this one".into())),
        }
    }
}
