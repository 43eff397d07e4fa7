//! The orbit JSON, read back: the claims, as exact fractions.
//!
//! A document is one object, or JSON Lines: the head, an event per line, and at last the outcome.

use impact_pair_document::{
    Bounds, ClaimName, EventDocument, EventName, NotNegative, ORBIT_SCHEMA, OrbitDocument, OrbitEnd, OrbitHead,
    OutcomeDocument, Place, Written, values,
};
use impact_pair_exact::Exact;
use impact_pair_model::vocabulary::OutcomeKind;
use num_rational::BigRational;
use num_traits::Zero;
use serde_json::Value;
use std::cmp::Ordering;

use super::attraction::Attraction;
use super::marks::{self, Mark};
use impact_pair_model::{Error, EventKind, ImpactPair, Miss, Period, Start, Wall};

/// The claims of an orbit JSON.
#[derive(Clone, Debug)]
pub struct Certificate {
    pair: ImpactPair,
    start: Start,
    claim: ClaimName,
    events: Vec<Claim>,
    ended: OutcomeDocument,
    attraction: Option<Attraction>,
}

/// An event that an orbit JSON claims.
#[derive(Clone, Debug)]
pub struct Claim {
    /// The wall.
    pub wall: Wall,
    /// The lower and the upper bound of the event's time \[time\].
    pub time: [BigRational; 2],
    /// The kind of the event.
    pub kind: EventKind<[BigRational; 2]>,
}

impl Certificate {
    /// Reads an orbit JSON, or JSON Lines.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    ///
    /// # Examples
    /// ```
    /// use impact_pair_certificate::Certificate;
    /// use impact_pair_model::vocabulary::OutcomeKind;
    ///
    /// let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/documents/count.jsonl"));
    /// let certificate = Certificate::parse(text)?;
    /// assert_eq!((certificate.outcome(), certificate.events().len()), (OutcomeKind::ImpactsReached, 6));
    /// assert!(certificate.events().iter().all(|event| event.kind.is_impact() && event.time[0] < event.time[1]));
    /// # Ok::<(), impact_pair_model::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, Error> {
        Ok(Self::read(&values(text)?)?.0)
    }

    /// Reads an orbit JSON, or the values of JSON Lines.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::of_schema(&values[0], ORBIT_SCHEMA)?;
        let [head, events @ .., end] = values else { return Self::whole(&whole, whole.read()?) };
        let head = Place::whole(head).read()?;
        let places = events.iter().enumerate().map(|(i, value)| Place::at(format!("events[{i}]"), value));
        let places: Vec<Place<'_>> = places.collect();
        let events = places.iter().map(Place::read).collect::<Result<_, _>>()?;
        let end = Place::whole(end);
        let OrbitEnd { outcome, arithmetic: _ } = end.read()?;
        Self::of((head, &whole), (events, &places), (outcome, &end.get("outcome")?))
    }

    /// The claims of an orbit JSON; `place` is its place in the file.
    pub(super) fn whole(place: &Place<'_>, document: OrbitDocument) -> Result<(Self, Mark), Error> {
        let (head, events, outcome) = document.lines();
        let places = place.get("events")?.list()?;
        Self::of((head, place), (events, &places), (outcome, &place.get("outcome")?))
    }

    fn of(
        (head, place): (OrbitHead, &Place<'_>),
        (events, places): (Vec<EventDocument>, &[Place<'_>]),
        (ended, outcome): (OutcomeDocument, &Place<'_>),
    ) -> Result<(Self, Mark), Error> {
        if !head.certified {
            return Err(place.get("certified")?.refused("only a certified orbit claims anything: accepted is true"));
        }
        let marks = marks::orbit(&head, &events, &ended);
        let (pair, start) = head.scene.model()?;
        let events = events.into_iter().zip(places).map(|(event, place)| claim(event, place));
        let events = events.collect::<Result<_, _>>()?;
        ended.until.as_ref().map_or(Ok(()), |until| is_single(outcome, "until", until))?;
        // The fields that each kind of outcome requires; documents of older versions lack some.
        let required: &[&str] = match ended.kind {
            OutcomeKind::TimeReached => &["impacts", "until"],
            OutcomeKind::Periodic => &["impacts", "period"],
            OutcomeKind::RestsForever => &["impacts", "wall"],
            OutcomeKind::Undecided => &["impacts", "reason", "time"],
            OutcomeKind::Attracted => &["impacts", "word", "cycles", "from", "orbit"],
            OutcomeKind::ImpactsReached | OutcomeKind::NeverImpacts => &["impacts"],
        };
        let near: &[&str] = if head.claim == ClaimName::Shadowed { &["start"] } else { &[] };
        required.iter().chain(near).try_for_each(|key| outcome.get(key).map(|_| ()))?;
        let attraction = Attraction::of(&ended, outcome)?;
        Ok((Self { pair, start, claim: head.claim, events, attraction, ended }, marks))
    }

    /// A certificate with a start and no claims.
    pub(super) fn of_start(pair: ImpactPair, start: Start) -> Self {
        let (claim, events, ended) = (ClaimName::default(), Vec::new(), OutcomeDocument::default());
        Self { pair, start, claim, events, ended, attraction: None }
    }

    /// The impact pair.
    pub fn pair(&self) -> &ImpactPair {
        &self.pair
    }

    /// The start of the orbit.
    pub fn start(&self) -> &Start {
        &self.start
    }

    /// The starts for which the orbit is claimed: all starts of the scene, or one start within the bounds of the outcome.
    pub fn claim(&self) -> ClaimName {
        self.claim
    }

    /// The events, in order of time.
    pub fn events(&self) -> &[Claim] {
        &self.events
    }

    /// Number of events.
    pub(super) fn count(&self) -> usize {
        self.events.len()
    }

    /// The kind of the end of the orbit.
    pub fn outcome(&self) -> OutcomeKind {
        self.ended.kind
    }

    /// The claims about the end of the orbit.
    pub(super) fn ended(&self) -> &OutcomeDocument {
        &self.ended
    }

    /// Whether nothing is claimed: there is no event, and no time before which there is none.
    pub(super) fn claims_nothing(&self) -> bool {
        let is_later = |time: &Exact| time.compare(self.start.time()) == Some(Ordering::Greater);
        self.events.is_empty()
            && match self.ended.kind {
                OutcomeKind::ImpactsReached => true,
                OutcomeKind::TimeReached => !self.ended.until.as_ref().is_some_and(|until| is_later(&until.0)),
                OutcomeKind::Undecided => {
                    let from = self.ended.time.as_ref().and_then(|time| time[0].as_ref());
                    !from.is_some_and(|from| is_later(&Exact::from_rational(from.value())))
                }
                _ => false,
            }
    }

    /// The orbit that the motion is claimed to converge to.
    pub(super) fn attraction(&self) -> Option<&Attraction> {
        self.attraction.as_ref()
    }

    /// The period of a motion that is claimed to be `periodic`.
    pub fn period(&self) -> Option<Period> {
        self.ended.period
    }
}

/// Refuses an interval where a single number is required: a claim about an interval would have to hold for each member.
pub(super) fn is_single(place: &Place<'_>, key: &str, value: &Written) -> Result<(), Error> {
    let refused = |place: Place<'_>| Err(place.refused("accepted is a single number, not an interval"));
    if value.0.is_point() { Ok(()) } else { refused(place.get(key)?) }
}

fn claim(document: EventDocument, place: &Place<'_>) -> Result<Claim, Error> {
    let EventDocument { event, index, mapping, wall, time, velocity, skipped, distance, speed } = document;
    let is_there = [
        ("index", index.is_some()),
        ("mapping", mapping.is_some()),
        ("velocity", velocity.is_some()),
        ("skipped", skipped.is_some()),
        ("distance", distance.is_some()),
        ("speed", speed.is_some()),
    ];
    let has_none = |keys: &[&str]| match is_there.iter().find(|(key, is_there)| *is_there && keys.contains(key)) {
        Some((key, _)) => Err(place.get(key)?.refused(&format!("a {event} has none"))),
        None => Ok(()),
    };
    let kind = match event {
        EventName::Impact => {
            has_none(&["skipped", "distance", "speed"])?;
            EventKind::Impact {
                index: index.ok_or_else(|| place.missing("index"))?,
                mapping: mapping.ok_or_else(|| place.missing("mapping"))?,
                velocity: velocity.ok_or_else(|| place.missing("velocity"))?.values(),
            }
        }
        EventName::Rest => {
            has_none(&["index", "mapping", "velocity", "distance", "speed"])?;
            EventKind::Rest { is_accumulation: skipped.is_some() }
        }
        EventName::Graze => {
            has_none(&["index", "mapping", "velocity", "skipped"])?;
            EventKind::Graze { miss: miss(place, distance, speed)? }
        }
        EventName::Release => {
            has_none(&["index", "mapping", "velocity", "skipped", "distance", "speed"])?;
            EventKind::Release
        }
    };
    Ok(Claim { wall, time: time.values(), kind })
}

/// Reads the size of a graze: a distance that may be 0, and a speed.
fn miss(
    place: &Place<'_>,
    distance: Option<Bounds>,
    speed: Option<NotNegative>,
) -> Result<Option<Miss<[BigRational; 2]>>, Error> {
    let (distance, speed) = match (distance, speed) {
        (Some(distance), Some(speed)) => (distance.values(), speed.value()),
        (None, None) => return Ok(None),
        (None, _) => return Err(place.missing("distance")),
        (_, None) => return Err(place.missing("speed")),
    };
    let zero = BigRational::zero();
    if distance[0] > zero || distance[1] < zero {
        return Err(place
            .get("distance")?
            .refused("accepted is a lower bound of at most 0 and an upper one of at least 0"));
    }
    Ok(Some(Miss { distance, speed: [zero, speed] }))
}
