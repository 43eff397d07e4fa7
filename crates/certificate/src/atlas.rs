//! The atlas JSON Lines, read back: the global analysis of each point, as a JSON of it claims it.

use std::collections::HashSet;

use impact_pair_document::{ATLAS_SCHEMA, AtlasHead, AtlasRecord, Place, values};
use impact_pair_model::Error;

use super::GlobalCertificate;
use super::grid::{Axes, Placed};

/// What an atlas of points claims.
#[derive(Clone, Debug)]
pub struct AtlasCertificate {
    points: Vec<ClaimedPoint>,
    /// How many points of the grid, or of the shard, are not there.
    missing: u64,
    unjudged: Vec<String>,
}

/// A point of it.
#[derive(Clone, Debug)]
pub(super) struct ClaimedPoint {
    /// Where every motion goes.
    pub global: GlobalCertificate,
    /// Its place on each axis, from 0.
    places: Vec<Option<u64>>,
    /// Whether its values are those of the grid; `None` where that is not decided.
    pub is_of_grid: Option<bool>,
    /// Why it contradicts the head of the atlas, or itself.
    pub contradiction: Option<&'static str>,
}

/// What no lemma of `check` is about.
const UNJUDGED: [&str; 17] = [
    "boxes",
    "digits",
    "halvings",
    "most",
    "points.components.area",
    "points.components.boxes",
    "points.components.closed",
    "points.components.reason",
    "points.greatest_speed",
    "points.order",
    "points.seconds",
    "points.undecided_area",
    "program",
    "scene.excitation.phase",
    "scene.start",
    "title",
    "work",
];

impl AtlasCertificate {
    /// Reads an atlas of points, its head first, then a point a line.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let values = values(text)?;
        let (place, records) = (Place::of_schema(&values[0], ATLAS_SCHEMA)?, &values[1..]);
        let head: AtlasHead = place.read()?;
        if head.cells {
            return Err(place.get("cells")?.refused("only points are checked: accepted is false"));
        }
        let axes = Axes::of(&place, &head.over, head.points, head.shard)?;
        let mut seen = HashSet::new();
        let point = |(i, value)| {
            let place = Place::at(format!("points[{i}]"), value);
            let record: AtlasRecord = place.read()?;
            let mut claimed = ClaimedPoint::of(&head, &axes, &record, &place)?;
            if !seen.insert(record.point) {
                claimed.contradiction = Some("its point is listed before as well");
            }
            Ok(claimed)
        };
        let points: Vec<ClaimedPoint> = records.iter().enumerate().map(point).collect::<Result<_, Error>>()?;
        let mut unjudged = UNJUDGED.map(str::to_owned).to_vec();
        unjudged.extend(place.unread::<AtlasHead>()?);
        unjudged.extend(axes.own_values());
        unjudged.extend(head.horseshoes.map(|_| "horseshoes".to_owned()));
        let places: Vec<&[Option<u64>]> = points.iter().map(|point| &point.places[..]).collect();
        unjudged.extend(axes.unpinned(&places));
        unjudged.extend((points.len() < 2).then(|| "shard".to_owned()));
        let has_orbits = points.iter().any(|point| point.global.orbits().is_some());
        unjudged.extend((!has_orbits).then(|| "scene.excitation.frequency".to_owned()));
        let empty = points.iter().enumerate().filter(|(_, point)| !point.claims_something());
        unjudged.extend(empty.map(|(i, _)| format!("points[{i}]")));
        for (i, point) in points.iter().enumerate() {
            // Keys that it does not know, and not those of every component; and a class that is not judged.
            let is_other = |key: &&String| !UNJUDGED.contains(&format!("points.{key}").as_str());
            let is_own = |key: &&String| key.starts_with("components.") || *key == "class";
            let own = point.global.unjudged().iter().filter(is_own).filter(is_other);
            unjudged.extend(own.map(|key| format!("points[{i}].{key}")));
        }
        unjudged.sort();
        unjudged.dedup();
        let missing = axes.own_points().saturating_sub(seen.len() as u64); // exact: points that are not of it are refuted
        Ok(Self { points, missing, unjudged })
    }

    /// How many points of the grid, or of the shard, are not there.
    pub(super) fn missing(&self) -> u64 {
        self.missing
    }

    pub(super) fn points(&self) -> &[ClaimedPoint] {
        &self.points
    }

    /// Returns how many points it has.
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// How many points claim something.
    pub(super) fn claimed(&self) -> usize {
        self.points.iter().filter(|point| point.claims_something()).count()
    }

    /// Returns the keys of the document that claim nothing which [`check_within`](Self::check_within) judges.
    pub fn unjudged(&self) -> &[String] {
        &self.unjudged
    }
}

impl ClaimedPoint {
    fn of(head: &AtlasHead, axes: &Axes<'_>, record: &AtlasRecord, place: &Place<'_>) -> Result<Self, Error> {
        let Placed { places, is_of_grid, .. } = axes.placed(record.point, &record.values, place)?;
        let refused = || place.refused("its axes are not parameters of the scene");
        let document = record.global(head).ok_or_else(refused)?;
        let global = serde_json::to_string(&document).map_err(|error| Error::certificate(error.to_string()))?;
        let global = GlobalCertificate::parse(&global)?;
        let count = |kind: &str| record.components.iter().filter(|component| component.kind == kind).count() as u64; // exact: a length
        let counts = [record.n_attracting, record.n_rest, record.n_saddle, record.n_undecided];
        let contradiction = if !axes.has(record.point) {
            Some("its point is not one of the grid, or of the shard")
        } else if !axes.are_all() {
            Some("the axes have another number of points than given")
        } else if counts != ["attracting", "rest-cycle", "saddle", "undecided"].map(count) {
            Some("its numbers of components are not those of its list")
        } else if !record.stable.is_empty() {
            Some("stable orbits are listed beside the components of cells alone")
        } else if !record.quarters.is_empty() {
            Some("it is cut into cells, which a point is not")
        } else {
            None
        };
        Ok(Self { global, places, is_of_grid, contradiction })
    }

    /// Whether there is anything to prove.
    pub(super) fn claims_something(&self) -> bool {
        self.contradiction.is_some() || self.is_of_grid != Some(true) || self.global.claims_something()
    }
}
