//! The sweep JSON Lines, read back: the scene of each point and what is claimed of its impacts.

use std::cmp::Ordering;

use super::attraction::Bounds;
use crate::document::{
    ClaimName, Decimal, ExtendedBounds, Place, SWEEP_SCHEMA, SceneDocument, SweepAxis, SweepHead, SweepImpact,
    SweepRecord, Written, values,
};
use impact_pair_exact::{Exact, ExactError};
use impact_pair_model::{Error, ImpactPair, Start, Wall};

/// What a sweep claims of the impacts of its points.
#[derive(Clone, Debug)]
pub struct SweepCertificate {
    points: Vec<ClaimedOrbit>,
    unjudged: Vec<String>,
}

/// A point of it.
#[derive(Clone, Debug)]
pub(super) struct ClaimedOrbit {
    pub pair: ImpactPair,
    pub start: Start,
    /// How many impacts are certified.
    pub impacts: u64,
    /// Those that are listed, after a transient.
    pub states: Vec<ClaimedState>,
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
    "bits",
    "complete",
    "digits",
    "exponent",
    "impacts_per_cycle",
    "message",
    "outcome",
    "period",
    "points",
    "program",
    "reason",
    "shard",
    "summary",
    "title",
    "wide_from",
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
        let point = |(i, value)| {
            let place = Place::at(format!("points[{i}]"), value);
            ClaimedOrbit::of(&head, &place.read()?, &place)
        };
        let points = records.iter().enumerate().map(point).collect::<Result<_, _>>()?;
        Ok(Self { points, unjudged: UNJUDGED.map(str::to_owned).to_vec() })
    }

    pub(super) fn points(&self) -> &[ClaimedOrbit] {
        &self.points
    }

    /// How many points it has.
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// The keys of the document that claim nothing which [`check_until`](Self::check_until) judges.
    pub fn unjudged(&self) -> &[String] {
        &self.unjudged
    }
}

impl ClaimedOrbit {
    fn of(head: &SweepHead, record: &SweepRecord, place: &Place<'_>) -> Result<Self, Error> {
        if record.values.len() != head.over.len() {
            return Err(place.get("values")?.refused("there must be one of each axis"));
        }
        let (mut scene, mut is_of_grid) = (head.scene.clone(), Some(true));
        // The last axis runs through first.
        let mut rest = record.point;
        let mut values = Vec::new();
        for (axis, value) in head.over.iter().zip(&record.values).rev() {
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
            values.push((axis.key.as_str(), value));
        }
        // The phase of the start depends on the other parameters.
        values.sort_by_key(|(key, _)| *key == "start.phase");
        for (key, value) in values {
            varied(&mut scene, key, value).ok_or_else(|| place.refused("its axis is not one of the scene"))?;
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
        let contradiction = if !follow || is_cut {
            Some("its impacts are not all those after the transient")
        } else if all
            .is_none_or(|all| record.impacts > all || record.outcome == "not-attracted" && record.impacts < all)
        {
            Some("it has another number of impacts than asked for")
        } else {
            None
        };
        let is_shadowed = record.claim == Some(ClaimName::Shadowed);
        Ok(Self { pair, start, impacts: record.impacts, states, is_of_grid, is_shadowed, contradiction })
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
fn varied(scene: &mut SceneDocument, key: &str, value: Exact) -> Option<()> {
    let excitation = &mut scene.excitation;
    let is_one = excitation.amplitude.len() == 1;
    let place = match key {
        "amplitude" => excitation.amplitude.first_mut().filter(|_| is_one)?,
        "frequency" => excitation.frequency.first_mut().filter(|_| is_one)?,
        "phase" => excitation.phase.first_mut().filter(|_| is_one)?,
        "gap" => &mut scene.gap,
        "restitution" => &mut scene.restitution,
        "start.time" => &mut scene.start.time,
        "start.velocity" => &mut scene.start.velocity,
        "start.position" => scene.start.position.as_mut()?,
        "start.phase" => {
            let (pair, _) = scene.clone().model().ok()?;
            let fastest = pair.excitation().reference();
            let time =
                value.checked_sub(fastest.phase()).and_then(|since| since.checked_div(fastest.frequency())).ok()?;
            scene.start.time = Written(time);
            return Some(());
        }
        _ => return None,
    };
    *place = Written(value);
    Some(())
}
