//! The orbit JSON, read back: what it claims, as exact fractions.
//!
//! A document is one object, or JSON Lines: the head, an event a line, and at last the outcome.

use impact_pair_document::{
    Bounds, ClaimName, Decimal, EventDocument, EventName, ORBIT_SCHEMA, OutcomeDocument, Place, SceneDocument, Written,
    values,
};
use num_rational::BigRational;
use num_traits::Zero;

use super::attraction::Attraction;
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
    unjudged: Vec<String>,
}

/// An event that an orbit JSON claims.
#[derive(Clone, Debug)]
pub struct Claim {
    /// The wall.
    pub wall: Wall,
    /// The lower and the upper bound of its time \[time\].
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
    ///
    /// let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/documents/count.jsonl"));
    /// let certificate = Certificate::parse(text)?;
    /// assert_eq!((certificate.outcome(), certificate.events().len()), ("impacts-reached", 6));
    /// assert!(certificate.events().iter().all(|event| event.kind.is_impact() && event.time[0] < event.time[1]));
    /// # Ok::<(), impact_pair_model::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, Error> {
        let values = values(text)?;
        let (head, rest) = (Place::of_schema(&values[0], ORBIT_SCHEMA)?, &values[1..]);
        let certified = head.get("certified")?;
        if !certified.read::<bool>()? {
            return Err(certified.refused("only a certified orbit claims anything: accepted is true"));
        }
        let (pair, start) = head.get("scene")?.read::<SceneDocument>()?.model()?;
        let of_start = head.get("claim").map_or(Ok(ClaimName::default()), |claim| claim.read())?;
        let (events, end, lists) = match rest {
            [] => (head.get("events")?.list()?, head.clone(), &["outcome", "events"][..]),
            [events @ .., last] => {
                let event = |(i, value)| Place::at(format!("events[{i}]"), value);
                (events.iter().enumerate().map(event).collect(), Place::whole(last), &[][..])
            }
        };
        let claims = events.iter().map(claim).collect::<Result<_, _>>()?;
        let outcome = end.get("outcome")?;
        let mut unjudged = head.keys_but(&[&["schema", "certified", "scene", "claim"], lists].concat());
        if !rest.is_empty() {
            unjudged.extend(end.keys_but(&["outcome"]));
        }
        unjudged.extend(head.get("scene")?.unread::<SceneDocument>()?);
        for event in &events {
            unjudged.extend(event.unread::<EventDocument>()?);
        }
        unjudged.extend(outcome.unread::<OutcomeDocument>()?);
        let ended: OutcomeDocument = outcome.read()?;
        ended.until.as_ref().map_or(Ok(()), |until| is_single(&outcome, "until", until))?;
        if ended.kind == "undecided" {
            // That something cannot be decided claims nothing; that all is listed up to a time does.
            unjudged.extend(["outcome.reason", "outcome.time[1]", "outcome.wall"].map(str::to_owned));
        }
        unjudged.sort();
        unjudged.dedup();
        // The fields that each kind requires; documents of older versions lack some.
        let required: &[&str] = match ended.kind.as_str() {
            "time-reached" => &["impacts", "until"],
            "periodic" => &["impacts", "period"],
            "rests-forever" => &["impacts", "wall"],
            "undecided" => &["impacts", "reason", "time"],
            "attracted" => &["impacts", "word", "cycles", "from", "orbit"],
            _ => &["impacts"],
        };
        let near: &[&str] = if of_start == ClaimName::Shadowed { &["start"] } else { &[] };
        required.iter().chain(near).try_for_each(|key| outcome.get(key).map(|_| ()))?;
        let attraction = Attraction::of(&ended, &outcome)?;
        Ok(Self { pair, start, claim: of_start, events: claims, attraction, ended, unjudged })
    }

    /// Returns a certificate that claims nothing but a start.
    pub(super) fn of_start(pair: ImpactPair, start: Start) -> Self {
        let (claim, events, ended) = (ClaimName::default(), Vec::new(), OutcomeDocument::default());
        Self { pair, start, claim, events, ended, attraction: None, unjudged: Vec::new() }
    }

    /// Returns the impact pair.
    pub fn pair(&self) -> &ImpactPair {
        &self.pair
    }

    /// Returns where the orbit starts.
    pub fn start(&self) -> &Start {
        &self.start
    }

    /// Returns the start that the orbit is claimed for: every one that the scene allows, or one within the bounds of the outcome.
    pub fn claim(&self) -> ClaimName {
        self.claim
    }

    /// Returns the events, in order of time.
    pub fn events(&self) -> &[Claim] {
        &self.events
    }

    /// Returns the word for how the orbit ended, such as `impacts-reached`.
    pub fn outcome(&self) -> &str {
        &self.ended.kind
    }

    /// Returns the claims about its end.
    pub(super) fn ended(&self) -> &OutcomeDocument {
        &self.ended
    }

    /// Returns the keys of the document that claim nothing which [`check`](Self::check) judges: what computed it, and all that this
    /// version does not know.
    pub fn unjudged(&self) -> &[String] {
        &self.unjudged
    }

    /// The orbit that the motion is claimed to converge to.
    pub(super) fn attraction(&self) -> Option<&Attraction> {
        self.attraction.as_ref()
    }

    /// Returns the period of a motion that is claimed to be `periodic`.
    pub fn period(&self) -> Option<Period> {
        self.ended.period
    }
}

/// Refuses an interval where one number is meant: a claim about it would have to hold for each member.
pub(super) fn is_single(place: &Place<'_>, key: &str, value: &Written) -> Result<(), Error> {
    let refused = |place: Place<'_>| Err(place.refused("accepted is a single number, not an interval"));
    if value.0.is_point() { Ok(()) } else { refused(place.get(key)?) }
}

fn claim(place: &Place<'_>) -> Result<Claim, Error> {
    let EventDocument { event, index, mapping, wall, time, velocity, skipped, distance, speed } = place.read()?;
    let has_none = |keys: &[&str]| {
        keys.iter().try_for_each(|key| match place.get(key) {
            Ok(value) => Err(value.refused(&format!("a {} has none", event.text()))),
            Err(_) => Ok(()),
        })
    };
    let kind = match event {
        EventName::Impact => {
            has_none(&["skipped", "distance", "speed"])?;
            EventKind::Impact {
                index: index.ok_or_else(|| place.missing("index"))?,
                mapping: mapping.ok_or_else(|| place.missing("mapping"))?,
                velocity: velocity.ok_or_else(|| place.missing("velocity"))?.map(|bound| bound.value()),
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
    Ok(Claim { wall, time: time.map(|bound| bound.value()), kind })
}

/// Reads the size of a graze: a distance that may be 0, and a speed.
fn miss(
    place: &Place<'_>,
    distance: Option<Bounds>,
    speed: Option<Decimal>,
) -> Result<Option<Miss<[BigRational; 2]>>, Error> {
    let (distance, speed) = match (distance, speed) {
        (Some(distance), Some(speed)) => (distance.map(|bound| bound.value()), speed.value()),
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
    if speed < zero {
        return Err(place.get("speed")?.refused("accepted is a number that is not negative"));
    }
    Ok(Some(Miss { distance, speed: [zero, speed] }))
}
