//! The atlas JSON Lines, read back: the claimed global analysis of each point.

use std::collections::HashSet;

use impact_pair_document::{ATLAS_SCHEMA, AtlasHead, AtlasRecord, PeriodDocument, Place, values};
use impact_pair_model::vocabulary::ComponentKind;
use impact_pair_model::{Error, ImpactPair, Start};

use super::GlobalCertificate;
use super::grid::{Axes, Placed, and};
use super::tiles::Tile;

/// The claims of an atlas of points, or of cells.
#[derive(Clone, Debug)]
pub struct AtlasCertificate {
    points: Vec<ClaimedPoint>,
    has_cells: bool,
    /// Number of points of the grid, or of the shard, that are missing.
    missing: u64,
    unjudged: Vec<String>,
}

/// A point of the atlas, or a tile.
#[derive(Clone, Debug)]
pub(super) struct ClaimedPoint {
    /// Claims about the point, or about all parameters of the tile and of each cell into which the tile is cut.
    pub parts: Vec<Part>,
    /// The position of the point on each axis, from 0.
    places: Vec<Option<u64>>,
    /// True if the parameters are values of the grid; `None` if undecided.
    pub is_of_grid: Option<bool>,
    /// A contradiction to the head of the atlas, or within the point.
    pub contradiction: Option<&'static str>,
}

/// A global analysis: of a point, or for all parameters of a cell.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// The global analysis.
    pub global: GlobalCertificate,
    /// The pair, with intervals for a cell, and the start from which orbits are sought.
    pub pair: ImpactPair,
    pub start: Start,
    /// Further stable periodic orbits.
    pub stable: Vec<PeriodDocument>,
    /// Path of the part in the document, and whether it is cut no further.
    path: String,
    is_leaf: bool,
}

/// Keys that no lemma of `check` covers.
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

/// Result keys of a cell: none is checked where the cell claims nothing, though the cells into which it is cut may claim something.
const RESULT_KEYS: [&str; 6] = ["class", "components", "n_attracting", "n_rest", "n_saddle", "n_undecided"];

impl AtlasCertificate {
    /// Reads an atlas: the head, then one point or tile per line.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let values = values(text)?;
        let (place, records) = (Place::of_schema(&values[0], ATLAS_SCHEMA)?, &values[1..]);
        let head: AtlasHead = place.read()?;
        let axes = Axes::of(&place, &head.over, head.points, head.shard)?;
        let (mut seen, mut unjudged) = (HashSet::new(), Vec::new());
        let point = |(i, value)| {
            let path = format!("points[{i}]");
            let place = Place::at(path.clone(), value);
            let record: AtlasRecord = place.read()?;
            let mut claimed = ClaimedPoint::of(&head, &axes, &record, (&place, path))?;
            if !seen.insert(record.point) {
                claimed.contradiction = Some("its point is listed before as well");
            }
            Ok(claimed)
        };
        let points: Vec<ClaimedPoint> = records.iter().enumerate().map(point).collect::<Result<_, Error>>()?;
        unjudged.extend(UNJUDGED.map(str::to_owned));
        unjudged.extend(axes.own_values());
        unjudged.extend(head.horseshoes.map(|_| "horseshoes".to_owned()));
        let places: Vec<&[Option<u64>]> = points.iter().map(|point| &point.places[..]).collect();
        unjudged.extend(axes.unpinned(&places));
        unjudged.extend((points.len() < 2).then(|| "shard".to_owned()));
        let has_orbits = points.iter().flat_map(|point| &point.parts).any(|part| part.global.orbits().is_some());
        unjudged.extend((!has_orbits).then(|| "scene.excitation.frequency".to_owned()));
        let parts = || points.iter().flat_map(|point| &point.parts);
        let deepest = parts().map(Part::depth).max().unwrap_or(0); // exact: no cell is cut
        unjudged.extend(of_cells(deepest));
        unjudged.extend(parts().flat_map(Part::unjudged));
        unjudged.sort();
        unjudged.dedup();
        let missing = axes.own_points().saturating_sub(seen.len() as u64); // exact: points that are not of it are refuted
        Ok(Self { points, has_cells: head.cells, missing, unjudged })
    }

    /// Number of points of the grid, or of the shard, that are missing.
    pub(super) fn missing(&self) -> u64 {
        self.missing
    }

    pub(super) fn points(&self) -> &[ClaimedPoint] {
        &self.points
    }

    /// Number of points or tiles.
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// Whether the atlas has cells of the parameter plane instead of points.
    pub(super) fn has_cells(&self) -> bool {
        self.has_cells
    }

    /// Whether a component is claimed to hold a horseshoe.
    pub(super) fn has_horseshoes(&self) -> bool {
        self.points.iter().flat_map(|point| &point.parts).any(|part| part.global.has_horseshoes())
    }

    /// Number of points, or cells, with a claim.
    pub(super) fn claimed(&self) -> usize {
        let parts = self.points.iter().flat_map(|point| &point.parts);
        parts.filter(|part| part.claims_something()).count()
    }

    /// Whether a path leads to a point or a cell without a proved result, or to one of its own values.
    pub(super) fn is_silent(&self, path: &str) -> bool {
        let is_own = |rest: &str| rest.is_empty() || rest.starts_with('.') && !rest.starts_with(".quarters");
        let mut parts = self.points.iter().flat_map(|point| &point.parts);
        parts.any(|part| !part.claims_something() && path.strip_prefix(&part.path).is_some_and(is_own))
    }

    /// Keys of the document whose values [`check_within`](Self::check_within) does not check.
    pub fn unjudged(&self) -> &[String] {
        &self.unjudged
    }
}

/// Keys of points that no lemma covers, and the same keys of the cells into which tiles are cut, down to `most` bisections. Lemma V38
fn of_cells(most: usize) -> impl Iterator<Item = String> {
    let of_points = UNJUDGED.iter().filter_map(|key| key.strip_prefix("points."));
    of_points.flat_map(move |key| (0..=most).map(move |times| format!("points.{}{key}", "quarters.".repeat(times))))
}

impl Part {
    /// Number of bisections from the tile to the cell.
    fn depth(&self) -> usize {
        self.path.matches(".quarters[").count()
    }

    /// The parts of a record: the record itself, then the cells into which it is cut.
    fn all(head: &AtlasHead, record: &AtlasRecord, place: &Place<'_>, path: String) -> Result<Vec<Self>, Error> {
        let refused = || place.refused("its axes are not parameters of the scene");
        let document = record.global(head).ok_or_else(refused)?;
        let (pair, start) = document.scene.clone().model()?;
        let global = serde_json::to_string(&document).map_err(|error| Error::certificate(error.to_string()))?;
        let global = GlobalCertificate::parse(&global)?;
        let (stable, is_leaf) = (record.stable.clone(), record.quarters.is_empty());
        let mut parts = vec![Self { global, pair, start, stable, path: path.clone(), is_leaf }];
        for (i, quarter) in record.quarters.iter().enumerate() {
            parts.extend(Self::all(head, quarter, place, format!("{path}.quarters[{i}]"))?);
        }
        Ok(parts)
    }

    /// Whether there is a claim to prove.
    pub fn claims_something(&self) -> bool {
        self.global.claims_something() || !self.stable.is_empty()
    }

    /// Unchecked keys of this part that are not unchecked at every point.
    fn unjudged(&self) -> Vec<String> {
        if !self.claims_something() {
            let of = |key: &&str| format!("{}.{key}", self.path);
            return if self.is_leaf { vec![self.path.clone()] } else { RESULT_KEYS.iter().map(of).collect() };
        }
        // Unknown keys, and keys that not every component has; and an unchecked class.
        let of_points = |key: &str| UNJUDGED.contains(&format!("points.{key}").as_str());
        let is_other = |key: &&String| !of_points(key);
        let is_own = |key: &&String| key.starts_with("components") || *key == "class";
        let own = self.global.unjudged().iter().filter(is_own).filter(is_other).map(String::as_str);
        // The number of sets of saddle type is checked if the place of each is given. Lemma V28
        let counts_sets = self.global.claimed().iter().any(|claim| claim.is_saddle_set);
        let count = (counts_sets && !self.global.says_there_are_no_others()).then_some("n_saddle");
        own.chain(count).map(|key| format!("{}.{key}", self.path)).collect()
    }
}

impl ClaimedPoint {
    fn of(
        head: &AtlasHead,
        axes: &Axes<'_>,
        record: &AtlasRecord,
        (place, path): (&Place<'_>, String),
    ) -> Result<Self, Error> {
        let parts = Part::all(head, record, place, path)?;
        let (places, is_of_grid, cut) = if head.cells {
            of_tile(axes, record)?
        } else {
            let Placed { places, is_of_grid, .. } = axes.placed(record.point, &record.values, place)?;
            let cut = (!record.quarters.is_empty()).then_some("it is cut into cells, which a point is not");
            (places, is_of_grid, cut)
        };
        let are_all = if head.cells { axes.are_all_tiles() } else { axes.are_all() };
        let contradiction = if !axes.has(record.point) {
            Some("its point is not one of the grid, or of the shard")
        } else if !are_all {
            Some("the axes have another number of points than given")
        } else if !has_own_counts(record) {
            Some("its numbers of components are not those of its list")
        } else if !head.cells && !record.stable.is_empty() {
            Some("stable orbits are listed beside the components of cells alone")
        } else {
            cut
        };
        Ok(Self { parts, places, is_of_grid, contradiction })
    }
}

/// Whether the counts of components of a record, and of the cells into which it is cut, agree with their lists.
fn has_own_counts(record: &AtlasRecord) -> bool {
    let count =
        |kind: ComponentKind| record.components.iter().filter(|component| component.kind == kind).count() as u64; // exact: a length
    let counts = [record.n_attracting, record.n_rest, record.n_saddle, record.n_undecided];
    counts
        == [ComponentKind::Attracting, ComponentKind::RestCycle, ComponentKind::Saddle, ComponentKind::Undecided]
            .map(count)
        && record.quarters.iter().all(has_own_counts)
}

/// The result of reading a tile: its positions on the axes, whether all intervals are those of its cells, and a contradiction.
type OfTile = (Vec<Option<u64>>, Option<bool>, Option<&'static str>);

/// The tile of a record, whose cells are the repeated quarters of the tile. Lemma V38
fn of_tile(axes: &Axes<'_>, record: &AtlasRecord) -> Result<OfTile, Error> {
    let tile = axes.cells().and_then(|counts| Tile::of(record.point, counts));
    let Some(tile) = tile else { return Ok((Vec::new(), Some(false), None)) };
    let (mut is_of_grid, mut cut, mut open) = (Some(true), None, vec![(tile, record)]);
    while let Some((cell, own)) = open.pop() {
        is_of_grid = and(is_of_grid, axes.are_of_cell(&cell, own)?);
        let quarters = cell.quarters();
        if own.point != record.point {
            cut = Some("a cell of it has the number of another tile");
        } else if !own.quarters.is_empty() && own.quarters.len() != quarters.len() {
            cut = Some("it is not cut into all of its quarters");
        }
        open.extend(quarters.into_iter().zip(&own.quarters));
    }
    Ok((tile.places(), is_of_grid, cut))
}
