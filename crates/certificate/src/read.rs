//! The orbit JSON, read back: what it claims, as exact fractions.
//!
//! A document is one object, or JSON Lines: the head, an event a line, and at last the outcome.

use crate::document::{EventDocument, EventName, ORBIT_SCHEMA, OutcomeDocument, Place, SceneDocument};
use num_rational::BigRational;
use serde_json::{Deserializer, Value};

use super::attraction::Attraction;
use impact_pair_model::Error;
use impact_pair_model::Mapping;
use impact_pair_model::{ImpactPair, Wall};
use impact_pair_model::{Period, Start};

/// What an orbit JSON claims of an orbit.
#[derive(Clone, Debug)]
pub struct Certificate {
    pair: ImpactPair,
    start: Start,
    events: Vec<Claim>,
    outcome: String,
    period: Option<Period>,
    attraction: Option<Attraction>,
}

/// An event that an orbit JSON claims.
#[derive(Clone, Debug)]
pub struct Claim {
    /// The wall.
    pub wall: Wall,
    /// The lower and the upper bound of its time \[time\].
    pub time: [BigRational; 2],
    /// What is claimed to happen.
    pub kind: ClaimKind,
}

/// What is claimed to happen at an event.
#[derive(Clone, Debug)]
pub enum ClaimKind {
    /// The ball hits the wall.
    Impact {
        /// Its number, from 1.
        index: u64,
        /// The mapping that led here; `None` for the first contact of a start inside the gap, and where a graze of the other
        /// wall may have been a touch.
        mapping: Option<Mapping>,
        /// The bounds of `y'` just before \[length/time\].
        velocity: [BigRational; 2],
    },
    /// The wall is touched, or nearly touched, with no velocity or nearly none.
    Graze,
    /// The ball comes to rest.
    Rest {
        /// After infinitely many impacts that are not listed.
        is_accumulation: bool,
    },
    /// The ball leaves the wall that it rested on.
    Release,
}

impl Certificate {
    /// Reads an orbit JSON, or JSON Lines.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let values: Result<Vec<Value>, _> = Deserializer::from_str(text).into_iter().collect();
        let values = values.map_err(|error| Error::certificate(format!("no JSON: {error}")).because(error))?;
        let [head, rest @ ..] = values.as_slice() else {
            return Err(Error::certificate("no JSON: the text is empty".into()));
        };
        let head = Place::whole(head);
        let schema = head.get("schema")?;
        if schema.read::<String>()? != ORBIT_SCHEMA {
            return Err(schema.refused(&format!("accepted is \"{ORBIT_SCHEMA}\"")));
        }
        let certified = head.get("certified")?;
        if !certified.read::<bool>()? {
            return Err(certified.refused("only a certified orbit claims anything: accepted is true"));
        }
        let (pair, start) = head.get("scene")?.read::<SceneDocument>()?.model()?;
        let (events, outcome) = match rest {
            [] => (head.get("events")?.list()?, head.get("outcome")?),
            [events @ .., last] => {
                let event = |(i, value)| Place::at(format!("events[{i}]"), value);
                (events.iter().enumerate().map(event).collect(), Place::whole(last).get("outcome")?)
            }
        };
        let events = events.iter().map(claim).collect::<Result<_, _>>()?;
        let ended: OutcomeDocument = outcome.read()?;
        Ok(Self {
            pair,
            start,
            events,
            period: ended.period,
            attraction: Attraction::of(&ended, &outcome)?,
            outcome: ended.kind,
        })
    }

    /// The impact pair.
    pub fn pair(&self) -> &ImpactPair {
        &self.pair
    }

    /// Where the orbit starts.
    pub fn start(&self) -> &Start {
        &self.start
    }

    /// The events, in order of time.
    pub fn events(&self) -> &[Claim] {
        &self.events
    }

    /// The word for how the orbit ended, such as `impacts-reached`.
    pub fn outcome(&self) -> &str {
        &self.outcome
    }

    /// The orbit that the motion is claimed to converge to.
    pub(super) fn attraction(&self) -> Option<&Attraction> {
        self.attraction.as_ref()
    }

    /// The period of a motion that is claimed to be `periodic`.
    pub fn period(&self) -> Option<Period> {
        self.period
    }
}

fn claim(place: &Place<'_>) -> Result<Claim, Error> {
    let event: EventDocument = place.read()?;
    let kind = match event.event {
        EventName::Impact => ClaimKind::Impact {
            index: event.index.ok_or_else(|| place.missing("index"))?,
            mapping: event.mapping.ok_or_else(|| place.missing("mapping"))?,
            velocity: event.velocity.ok_or_else(|| place.missing("velocity"))?.map(|bound| bound.value()),
        },
        EventName::Graze => ClaimKind::Graze,
        EventName::Rest => ClaimKind::Rest { is_accumulation: event.skipped.is_some() },
        EventName::Release => ClaimKind::Release,
    };
    Ok(Claim { wall: event.wall, time: event.time.map(|bound| bound.value()), kind })
}
