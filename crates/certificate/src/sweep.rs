//! The sweep JSON Lines, read back: the scene of each point and what is claimed of its impacts.

use std::cmp::Ordering;
use std::collections::HashSet;

use super::attraction::Bounds;
use impact_pair_document::{
    ClaimName, Decimal, ExtendedBounds, Place, SWEEP_SCHEMA, SceneDocument, SweepAxis, SweepHead, SweepImpact,
    SweepRecord, values,
};
use impact_pair_exact::{Exact, ExactError};
use impact_pair_model::scene::Key;
use impact_pair_model::{Error, Harmonic, ImpactPair, Start, Wall};

/// What a sweep claims of the impacts of its points.
#[derive(Clone, Debug)]
pub struct SweepCertificate {
    points: Vec<ClaimedOrbit>,
    /// How many points of the grid, or of the shard, are not there.
    missing: u64,
    unjudged: Vec<String>,
}

/// A point of it.
#[derive(Clone, Debug)]
pub(super) struct ClaimedOrbit {
    pub pair: ImpactPair,
    pub start: Start,
    /// The term that phases are relative to, where that is not the fastest one that moves the box.
    pub reference: Option<Harmonic>,
    /// How many impacts are certified.
    pub impacts: u64,
    /// Those that are listed, after a transient.
    pub states: Vec<ClaimedState>,
    /// Its place on each axis, from 0.
    pub places: Vec<Option<u64>>,
    /// Whether its values are those of the grid; `None` where that is not decided.
    pub is_of_grid: Option<bool>,
    /// It is of an orbit that starts near.
    pub is_shadowed: bool,
    /// Why it contradicts the head of the sweep, or itself.
    pub contradiction: Option<&'static str>,
}

/// An impact of it.
#[derive(Clone, Debug)]
pub(super) struct ClaimedState {
    pub index: u64,
    pub wall: Wall,
    pub phase: Bounds,
    pub velocity: Bounds,
}

/// What no lemma of `check` is about.
const UNJUDGED: [&str; 16] = [
    "arithmetic",
    "claim",
    "digits",
    "impacts",
    "points.bits",
    "points.complete",
    "points.exponent",
    "points.exponent_limit",
    "points.impacts_per_cycle",
    "points.message",
    "points.outcome",
    "points.period",
    "points.reason",
    "points.wide_from",
    "program",
    "title",
];

impl SweepCertificate {
    /// Reads a sweep, its head first, then a point a line.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let values = values(text)?;
        let (place, records) = (Place::of_schema(&values[0], SWEEP_SCHEMA)?, &values[1..]);
        let head: SweepHead = place.read()?;
        if !head.certified {
            return Err(place.get("certified")?.refused("only a certified sweep claims anything: accepted is true"));
        }
        let axes = Axes::of(&head, &place)?;
        if head.shard.is_some_and(|[number, of]| !(1..=of).contains(&number)) {
            return Err(place
                .get("shard")?
                .refused("accepted is the number of a shard, from 1 on, and how many there are"));
        }
        let mut seen = HashSet::new();
        let point = |(i, value)| {
            let place = Place::at(format!("points[{i}]"), value);
            let record: SweepRecord = place.read()?;
            let mut claimed = ClaimedOrbit::of(&head, &axes, &record, &place)?;
            if !seen.insert(record.point) {
                claimed.contradiction = Some("its point is listed before as well");
            }
            Ok(claimed)
        };
        let points: Vec<ClaimedOrbit> = records.iter().enumerate().map(point).collect::<Result<_, Error>>()?;
        let mut unjudged = UNJUDGED.map(str::to_owned).to_vec();
        unjudged.extend(place.unread::<SweepHead>()?);
        unjudged.extend(axes.own_values());
        unjudged.extend(axes.unpinned(&points));
        if points.iter().all(|point| point.states.is_empty()) {
            unjudged.push("transient".to_owned());
            unjudged.extend((!axes.keys.contains(&Key::StartPhase)).then(|| "reference".to_owned()));
        }
        // Of points without impacts after the transient a summary says as much, and one point is that of several shards.
        let is_short = points.iter().all(|point| point.impacts <= head.transient);
        unjudged.extend(is_short.then(|| "summary".to_owned()));
        unjudged.extend((points.len() < 2).then(|| "shard".to_owned()));
        unjudged.sort();
        unjudged.dedup();
        let missing = own_points(&head).saturating_sub(seen.len() as u64); // exact: points that are not of it are refuted
        Ok(Self { points, missing, unjudged })
    }

    /// How many points of the grid, or of the shard, are not there.
    pub(super) fn missing(&self) -> u64 {
        self.missing
    }

    pub(super) fn points(&self) -> &[ClaimedOrbit] {
        &self.points
    }

    /// Returns how many points it has.
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// Returns the keys of the document that claim nothing which [`check_within`](Self::check_within) judges.
    pub fn unjudged(&self) -> &[String] {
        &self.unjudged
    }
}

/// What varies.
struct Axes {
    keys: Vec<Key>,
    /// The number, from 0, of the term whose cycles are the unit; at each point the fastest where none is given.
    reference: Option<usize>,
    /// Whether the axes have as many points together as are given.
    are_all: bool,
}

impl Axes {
    fn of(head: &SweepHead, place: &Place<'_>) -> Result<Self, Error> {
        let key = |(axis, place): (&SweepAxis, &Place<'_>)| {
            axis.key.parse::<Key>().or_else(|error| Err(place.get("key")?.refused(&error.to_string())))
        };
        let keys = head.over.iter().zip(&place.get("over")?.list()?).map(key).collect::<Result<_, _>>()?;
        let terms = head.scene.excitation.amplitude.len();
        let reference = match head.reference.map(usize::try_from) {
            None => None,
            Some(Ok(number)) if (1..=terms).contains(&number) => Some(number - 1),
            Some(_) => return Err(place.get("reference")?.refused("it must be the number of a term")),
        };
        let all = head.over.iter().try_fold(1u64, |all, axis| all.checked_mul(axis.count));
        Ok(Self { keys, reference, are_all: all == Some(head.points) })
    }

    /// The scene's own values of what varies: they only name it.
    fn own_values(&self) -> impl Iterator<Item = String> {
        let term = |key: &Key| key.term().map_or(0, |term| usize::from(term.get()) - 1); // exact: the only one
        self.keys.iter().map(move |key| match key {
            Key::Amplitude(_) => format!("scene.excitation.amplitude[{}]", term(key)),
            Key::Frequency(_) => format!("scene.excitation.frequency[{}]", term(key)),
            Key::Phase(_) => format!("scene.excitation.phase[{}]", term(key)),
            Key::Gap => "scene.gap".to_owned(),
            Key::Restitution => "scene.restitution".to_owned(),
            Key::StartTime | Key::StartPhase => "scene.start.time".to_owned(),
            Key::StartPosition => "scene.start.position".to_owned(),
            Key::StartVelocity => "scene.start.velocity".to_owned(),
        })
    }

    /// Axes of which all points have one value: it does not tell both ends and the count.
    fn unpinned(&self, points: &[ClaimedOrbit]) -> Vec<String> {
        let is_pinned = |axis: usize| points.iter().any(|point| point.places.get(axis) != points[0].places.get(axis));
        (0..self.keys.len()).filter(|axis| !is_pinned(*axis)).map(|axis| format!("over[{axis}]")).collect()
    }
}

impl ClaimedOrbit {
    fn of(head: &SweepHead, axes: &Axes, record: &SweepRecord, place: &Place<'_>) -> Result<Self, Error> {
        if record.values.len() != head.over.len() {
            return Err(place.get("values")?.refused("there must be one of each axis"));
        }
        let (mut scene, mut is_of_grid) = (head.scene.clone(), Some(true));
        // The last axis runs through first.
        let mut rest = record.point;
        let (mut values, mut places) = (Vec::new(), Vec::new());
        for ((axis, key), value) in head.over.iter().zip(&axes.keys).zip(&record.values).rev() {
            let value =
                Exact::parse(value).map_err(|error| Error::certificate(format!("values: {error}")).because(error))?;
            let at = (axis.count > 1).then(|| rest % axis.count);
            let order = at.and_then(|at| on_axis(axis, at).ok()).and_then(|grid| grid.compare(&value));
            is_of_grid = match (is_of_grid, order) {
                (Some(false), _) | (_, Some(Ordering::Less | Ordering::Greater)) => Some(false),
                (_, None) => None,
                (so_far, Some(Ordering::Equal)) => so_far,
            };
            rest = rest.checked_div(axis.count).unwrap_or(1);
            values.push((*key, value));
            places.insert(0, at);
        }
        // The phase of the start depends on the other parameters.
        values.sort_by_key(|(key, _)| *key == Key::StartPhase);
        for (key, value) in values {
            varied(&mut scene, key, axes.reference, value)
                .ok_or_else(|| place.refused("its axis is not one of the scene"))?;
        }
        let (pair, start) = scene.model()?;
        let states: Vec<ClaimedState> =
            record.states.iter().map(|state| ClaimedState::of(state, place)).collect::<Result<_, _>>()?;
        let all = head.transient.checked_add(head.impacts);
        let follow = states.iter().zip(1..).all(|(state, n)| head.transient.checked_add(n) == Some(state.index));
        let listed = states.last().map(|state| state.index);
        if rest != 0 {
            is_of_grid = Some(false);
        }
        let is_cut = match listed {
            Some(listed) => listed != record.impacts,
            None => !head.summary && record.impacts > head.transient,
        };
        let contradiction = if !is_own(head, record.point) {
            Some("its point is not one of the grid, or of the shard")
        } else if head.summary && !states.is_empty() {
            Some("it lists impacts, which a summary has not")
        } else if !axes.are_all {
            Some("the axes have another number of points than given")
        } else if !follow || is_cut {
            Some("its impacts are not all those after the transient")
        } else if all
            .is_none_or(|all| record.impacts > all || record.outcome == "not-attracted" && record.impacts < all)
        {
            Some("it has another number of impacts than requested")
        } else {
            None
        };
        let is_shadowed = record.claim == Some(ClaimName::Shadowed);
        let reference = axes.reference.filter(|term| *term != pair.excitation().reference_term());
        let reference = reference.map(|term| pair.excitation().terms()[term].clone());
        let impacts = record.impacts;
        Ok(Self { pair, start, reference, impacts, states, places, is_of_grid, is_shadowed, contradiction })
    }
}

impl ClaimedState {
    fn of(state: &SweepImpact, place: &Place<'_>) -> Result<Self, Error> {
        let SweepImpact { index, wall, phase, velocity } = state;
        let values = |bounds: &ExtendedBounds| -> Result<Bounds, Error> {
            let [lower, upper] = bounds.clone().map(|bound| Decimal::try_from(bound).map(|bound| bound.value()));
            let refused =
                |_| place.get("states").map_or_else(|error| error, |states| states.refused("bounds must be decimals"));
            Ok([lower.map_err(refused)?, upper.map_err(refused)?])
        };
        Ok(Self { index: *index, wall: *wall, phase: values(phase)?, velocity: values(velocity)? })
    }
}

/// Whether a point is one of the grid, or of the shard: every N-th one.
fn is_own(head: &SweepHead, point: u64) -> bool {
    point < head.points && head.shard.is_none_or(|[number, of]| point % of == number - 1)
}

/// How many points the grid, or the shard, has.
fn own_points(head: &SweepHead) -> u64 {
    let [number, of] = head.shard.unwrap_or([1, 1]); // exact: all of them
    head.points / of + u64::from(number <= head.points % of)
}

/// The value number `at` of an axis.
fn on_axis(axis: &SweepAxis, at: u64) -> Result<Exact, ExactError> {
    let whole = |n: u64| Exact::from_rational(num_rational::BigRational::from_integer(n.into()));
    let [from, to] = [&axis.from, &axis.to].map(|end| Exact::parse(end).unwrap_or_else(|_| Exact::from(0)));
    if at + 1 == axis.count {
        return Ok(to);
    }
    let part = whole(at).checked_div(&whole(axis.count - 1))?;
    from.checked_add(&to.checked_sub(&from)?.checked_mul(&part)?)
}

/// Puts a value in the place of the scene's own; `None` where it has none.
fn varied(scene: &mut SceneDocument, key: Key, reference: Option<usize>, value: Exact) -> Option<()> {
    if key != Key::StartPhase {
        return scene.set(key, value);
    }
    let (pair, _) = scene.clone().model().ok()?;
    let excitation = pair.excitation();
    let term = reference.map_or(excitation.reference(), |term| &excitation.terms()[term]);
    let time = value.checked_sub(term.phase()).and_then(|since| since.checked_div(term.frequency())).ok()?;
    scene.set(Key::StartTime, time)
}
