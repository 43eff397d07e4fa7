//! The orbit JSON, read back: what it claims, as exact fractions.
//!
//! A document is one object, or JSON Lines: the head, an event a line, and at last the outcome.

use num_rational::BigRational;
use serde_json::{Deserializer, Map, Value};

use super::attraction::Attraction;
use super::document::ORBIT_SCHEMA;
use crate::Error;
use crate::exact::Exact;
use crate::excitation::{Excitation, Harmonic};
use crate::mapping::Mapping;
use crate::orbit::{Period, Start};
use crate::pair::{ImpactPair, Wall};

/// What an orbit JSON claims of an orbit.
///
/// ```
/// # use impact_pair::{Scene, orbit::Arithmetic, certificate::{self, Certificate, Conclusion, Event}};
/// # let scene = Scene::parse(r#"
/// #     excitation = { amplitude = 1, frequency = "pi", phase = 0 }
/// #     pair = { gap = 9.42497, restitution = 0.5 }
/// #     start = { time = 0, wall = "left", velocity = -12.56636 }
/// #     run = { impacts = 3 }"#)?;
/// # let mut orbit = Orbit::of(&scene, scene.settings())?;
/// # let mut events = Vec::new();
/// # while let Some(impact) = orbit.next() { events.push(Event::new(&orbit, &impact)) }
/// # let head = certificate::head(scene.pair(), scene.start(), Arithmetic::Auto, certificate::arithmetic(&orbit));
/// # let mut json = Vec::new();
/// # certificate::write_json(&mut json, &head, &Conclusion::of(&orbit, scene.start(), events.last()), &events)?;
/// # let json = String::from_utf8(json)?;
/// let claimed = Certificate::parse(&json)?;
/// assert_eq!(claimed.events().len(), 3);
/// assert_eq!(claimed.outcome(), "impacts-reached");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
        /// The mapping that led here; `None` for the first contact of a start inside the gap.
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
        let values = values.map_err(|error| Error::certificate(format!("no JSON: {error}")))?;
        let [head, rest @ ..] = values.as_slice() else {
            return Err(Error::certificate("no JSON: the text is empty".into()));
        };
        let head = Entry::whole(head);
        let schema = head.get("schema")?;
        if schema.text()? != ORBIT_SCHEMA {
            return Err(schema.refused(&format!("accepted is \"{ORBIT_SCHEMA}\"")));
        }
        let certified = head.get("certified")?;
        if certified.value != &Value::Bool(true) {
            return Err(certified.refused("only a certified orbit claims anything: accepted is true"));
        }
        let (pair, start) = read_scene(&head.get("scene")?)?;
        let (events, outcome) = match rest {
            [] => (head.get("events")?.list()?, head.get("outcome")?),
            [events @ .., last] => {
                let event = |(i, value)| Entry { key: format!("events[{i}]"), value };
                (events.iter().enumerate().map(event).collect(), Entry::whole(last).get("outcome")?)
            }
        };
        Ok(Self {
            pair,
            start,
            events: events.iter().map(read_event).collect::<Result<_, _>>()?,
            outcome: outcome.get("kind")?.text()?.to_owned(),
            period: outcome.find("period")?.map(|period| read_period(&period)).transpose()?,
            attraction: outcome.find("orbit")?.map(|orbit| Attraction::read(&outcome, &orbit)).transpose()?,
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

fn read_scene(scene: &Entry<'_>) -> Result<(ImpactPair, Start), Error> {
    let excitation = scene.get("excitation")?;
    let of_terms =
        |key: &str| -> Result<Vec<Exact>, Error> { excitation.get(key)?.list()?.iter().map(Entry::exact).collect() };
    let (amplitudes, frequencies, phases) = (of_terms("amplitude")?, of_terms("frequency")?, of_terms("phase")?);
    if frequencies.len() != amplitudes.len() || phases.len() != amplitudes.len() {
        return Err(excitation.refused("must have as many frequencies and phases as amplitudes"));
    }
    let terms = amplitudes.into_iter().zip(frequencies).zip(phases).map(|((a, w), tau)| Harmonic::new(a, w, tau));
    let pair = ImpactPair::new(
        Excitation::new(terms.collect::<Result<_, _>>()?)?,
        scene.get("gap")?.exact()?,
        scene.get("restitution")?.exact()?,
    )?;
    let start = scene.get("start")?;
    let (time, velocity) = (start.get("time")?.exact()?, start.get("velocity")?.exact()?);
    let start = match start.find("position")? {
        Some(position) => Start::inside(&pair, time, position.exact()?, velocity)?,
        None => Start::on_wall(time, start.get("wall")?.wall()?, velocity)?,
    };
    Ok((pair, start))
}

fn read_event(event: &Entry<'_>) -> Result<Claim, Error> {
    let name = event.get("event")?;
    let kind = match name.text()? {
        "impact" => ClaimKind::Impact {
            index: event.get("index")?.integer()?,
            mapping: event.get("mapping")?.mapping()?,
            velocity: event.get("velocity")?.bounds()?,
        },
        "graze" => ClaimKind::Graze,
        "rest" => ClaimKind::Rest { is_accumulation: event.find("skipped")?.is_some() },
        "release" => ClaimKind::Release,
        _ => return Err(name.refused("accepted are impact, graze, rest and release")),
    };
    Ok(Claim { wall: event.get("wall")?.wall()?, time: event.get("time")?.bounds()?, kind })
}

fn read_period(period: &Entry<'_>) -> Result<Period, Error> {
    Ok(Period { cycles: period.get("cycles")?.integer()?, impacts: period.get("impacts")?.integer()? })
}

/// A value of the document that knows where it stands: `events[3].time`.
pub(super) struct Entry<'j> {
    key: String,
    pub value: &'j Value,
}

impl<'j> Entry<'j> {
    fn whole(value: &'j Value) -> Self {
        Self { key: String::new(), value }
    }

    pub fn refused(&self, but: &str) -> Error {
        let mut written = self.value.to_string();
        if written.len() > 60 {
            written = written.chars().take(57).chain("...".chars()).collect();
        }
        let key = if self.key.is_empty() { "the document" } else { &self.key };
        Error::certificate(format!("{key} is {written}, but {but}"))
    }

    fn full(&self, key: &str) -> String {
        if self.key.is_empty() { key.to_owned() } else { format!("{}.{key}", self.key) }
    }

    pub fn find(&self, key: &str) -> Result<Option<Self>, Error> {
        let map: &Map<String, Value> = self.value.as_object().ok_or_else(|| self.refused("must be an object"))?;
        Ok(map.get(key).map(|value| Self { key: self.full(key), value }))
    }

    pub fn get(&self, key: &str) -> Result<Self, Error> {
        self.find(key)?.ok_or_else(|| Error::certificate(format!("{} is missing", self.full(key))))
    }

    pub fn list(&self) -> Result<Vec<Self>, Error> {
        let list = self.value.as_array().ok_or_else(|| self.refused("must be a list"))?;
        Ok(list.iter().enumerate().map(|(i, value)| Self { key: format!("{}[{i}]", self.key), value }).collect())
    }

    pub fn text(&self) -> Result<&'j str, Error> {
        self.value.as_str().ok_or_else(|| self.refused("must be a string"))
    }

    pub fn integer(&self) -> Result<u64, Error> {
        self.value.as_u64().ok_or_else(|| self.refused("must be an integer of at least 0"))
    }

    fn exact(&self) -> Result<Exact, Error> {
        let text = self.text()?;
        Exact::parse(text).map_err(|error| self.refused(&format!("does not read as a number: {error}")))
    }

    pub fn wall(&self) -> Result<Wall, Error> {
        let name = self.text()?;
        let wall = [Wall::Left, Wall::Right].into_iter().find(|wall| wall.name() == name);
        wall.ok_or_else(|| self.refused("accepted are \"left\" and \"right\""))
    }

    fn mapping(&self) -> Result<Option<Mapping>, Error> {
        if self.value.is_null() {
            return Ok(None);
        }
        let name = self.text()?;
        let mapping = [Mapping::P1, Mapping::P2, Mapping::P3, Mapping::P4].into_iter().find(|m| m.to_string() == name);
        mapping.map(Some).ok_or_else(|| self.refused("accepted are \"P1\" to \"P4\" and null"))
    }

    pub fn bounds(&self) -> Result<[BigRational; 2], Error> {
        let bounds: Result<Vec<_>, _> = self.list()?.iter().map(Self::decimal).collect();
        bounds?.try_into().map_err(|_| self.refused("must be two bounds, the lower and the upper"))
    }

    fn decimal(&self) -> Result<BigRational, Error> {
        let accepted = "must be a decimal in a string";
        let is_decimal = self.text()?.bytes().all(|byte| byte.is_ascii_digit() || b".+-eE".contains(&byte));
        let number = if is_decimal { self.exact()?.as_rational().cloned() } else { None };
        number.ok_or_else(|| self.refused(accepted))
    }
}
