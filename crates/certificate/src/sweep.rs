//! The sweep JSON Lines, read back: the scene of each point and the claims about its impacts.

use std::collections::HashSet;

use super::attraction::Bounds;
use super::grid::{Axes, Placed, varied};
use super::marks::{self, LINES, Listed, Mark};
use impact_pair_document::{
    ClaimName, Decimal, ExtendedBounds, Place, SWEEP_SCHEMA, SweepHead, SweepImpact, SweepRecord,
};
use impact_pair_model::vocabulary::PointOutcome;
use impact_pair_model::{Error, Harmonic, ImpactPair, Start};
use serde_json::Value;

/// The claims of a sweep about the impacts of its points.
#[derive(Clone, Debug)]
pub(crate) struct SweepCertificate {
    pub(super) points: Vec<ClaimedOrbit>,
    /// Number of points of the grid, or of the shard, that are missing.
    pub(super) missing: u64,
}

/// A point of the sweep.
#[derive(Clone, Debug)]
pub(super) struct ClaimedOrbit {
    pub pair: ImpactPair,
    pub start: Start,
    /// The harmonic that phases are relative to, if it is not the fastest harmonic that moves the box.
    pub reference: Option<Harmonic>,
    /// Number of certified impacts.
    pub impacts: u64,
    /// The listed impacts, after a transient.
    pub states: Vec<SweepImpact<Bounds>>,
    /// The position of the point on each axis, from 0.
    pub places: Vec<Option<u64>>,
    /// True if the parameters are values of the grid; `None` if undecided.
    pub is_of_grid: Option<bool>,
    /// True for an orbit that starts near the scene's start.
    pub is_shadowed: bool,
    /// A contradiction to the head of the sweep, or within the point.
    pub contradiction: Option<&'static str>,
}

impl SweepCertificate {
    /// Reads a sweep: the head, then one point per line.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let (place, records) = (Place::of_schema(&values[0], SWEEP_SCHEMA)?, &values[1..]);
        let head: SweepHead = place.read()?;
        if !head.certified {
            return Err(place.get("certified")?.refused("only a certified sweep claims anything: accepted is true"));
        }
        let axes = Axes::of(&place, &head.over, head.points, head.shard)?;
        let reference = axes.reference(&head.scene)?;
        let listed = reference.map(|term| term as u64 + 1); // exact: a number of terms
        if head.reference != listed {
            let accepted = listed.map_or("nothing, of a single term".to_owned(), |term| term.to_string());
            let accepted = format!("accepted is the fastest term where all axes are at their upper ends: {accepted}");
            return Err(place.get("reference").map_or_else(|missing| missing, |given| given.refused(&accepted)));
        }
        let (mut seen, mut lines) = (HashSet::new(), None);
        let point = |(i, value)| {
            let place = Place::at(format!("points[{i}]"), value);
            let record: SweepRecord = place.read()?;
            lines.get_or_insert_with(|| marks::each(std::slice::from_ref(&record), marks::point));
            let mut claimed = ClaimedOrbit::of(&head, (&axes, reference), &record, &place)?;
            if !seen.insert(record.point) {
                claimed.contradiction = Some("its point is listed before as well");
            }
            Ok(claimed)
        };
        let points: Vec<ClaimedOrbit> = records.iter().enumerate().map(point).collect::<Result<_, Error>>()?;
        let places: Vec<&[Option<u64>]> = points.iter().map(|point| &point.places[..]).collect();
        let listed = Listed {
            has_states: points.iter().any(|point| !point.states.is_empty()),
            is_long: points.iter().any(|point| point.impacts > head.transient),
        };
        let marks =
            marks::sweep(&head, &axes.pinned(&places), &listed).with(LINES, lines.unwrap_or(marks::checked("")));
        let missing = axes.own_points().saturating_sub(seen.len() as u64); // exact: points that are not of it are refuted
        Ok((Self { points, missing }, marks))
    }

    /// Number of points.
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// Number of points that claim impacts.
    pub(super) fn claimed(&self) -> usize {
        self.points.iter().filter(|point| point.impacts > 0).count()
    }
}

impl ClaimedOrbit {
    fn of(
        head: &SweepHead,
        (axes, reference): (&Axes<'_>, Option<usize>),
        record: &SweepRecord,
        place: &Place<'_>,
    ) -> Result<Self, Error> {
        let Placed { values, places, is_of_grid } = axes.placed(record.point, &record.values, place)?;
        let mut scene = head.scene.clone();
        for (key, value) in values {
            varied(&mut scene, key, reference, value)
                .ok_or_else(|| place.refused("its axis is not one of the scene"))?;
        }
        let (pair, start) = scene.model()?;
        let states: Vec<SweepImpact<Bounds>> =
            record.states.iter().map(|state| claimed(state, place)).collect::<Result<_, _>>()?;
        let all = head.transient.checked_add(head.impacts);
        let follow = states.iter().zip(1..).all(|(state, n)| head.transient.checked_add(n) == Some(state.index));
        let listed = states.last().map(|state| state.index);
        let is_cut = match listed {
            Some(listed) => listed != record.impacts,
            None => !head.summary && record.impacts > head.transient,
        };
        let contradiction = if !axes.has(record.point) {
            Some("its point is not one of the grid, or of the shard")
        } else if head.summary && !states.is_empty() {
            Some("it lists impacts, which a summary has not")
        } else if !axes.are_all() {
            Some("the axes have another number of points than given")
        } else if !follow || is_cut {
            Some("its impacts are not all those after the transient")
        } else if all.is_none_or(|all| {
            record.impacts > all || record.outcome == PointOutcome::UndecidedLimit && record.impacts < all
        }) {
            Some("it has another number of impacts than requested")
        } else {
            None
        };
        let is_shadowed = record.claim == Some(ClaimName::Shadowed);
        let reference = reference.filter(|term| *term != pair.excitation().reference_term());
        let reference = reference.map(|term| pair.excitation().terms()[term].clone());
        let impacts = record.impacts;
        Ok(Self { pair, start, reference, impacts, states, places, is_of_grid, is_shadowed, contradiction })
    }
}

/// A listed impact with its bounds as fractions.
fn claimed(state: &SweepImpact, place: &Place<'_>) -> Result<SweepImpact<Bounds>, Error> {
    let values = |bounds: &ExtendedBounds| -> Result<Bounds, Error> {
        let [lower, upper] = (**bounds).clone().map(|bound| Decimal::try_from(bound).map(|bound| bound.value()));
        let refused =
            |_| place.get("states").map_or_else(|error| error, |states| states.refused("bounds must be decimals"));
        Ok([lower.map_err(refused)?, upper.map_err(refused)?])
    };
    let SweepImpact { index, wall, phase, velocity } = state.map(values);
    Ok(SweepImpact { index, wall, phase: phase?, velocity: velocity? })
}
