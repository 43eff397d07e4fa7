//! The atlas JSON Lines, read back: the claimed global analysis of each point.

use std::collections::HashSet;

use super::marks::{self, LINES, Mark, Proved};
use impact_pair_document::{ATLAS_SCHEMA, AtlasHead, AtlasRecord, PeriodDocument, Place};
use impact_pair_model::vocabulary::ComponentKind;
use impact_pair_model::{Error, ImpactPair, Start};
use serde_json::Value;

use super::global::GlobalCertificate;
use super::grid::{Axes, Placed, and};
use super::tiles::Tile;

/// The claims of an atlas of points, or of cells.
#[derive(Clone, Debug)]
pub(crate) struct AtlasCertificate {
    pub(super) points: Vec<ClaimedPoint>,
    pub(super) has_cells: bool,
    /// Number of points of the grid, or of the shard, that are missing.
    pub(super) missing: u64,
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
}

impl AtlasCertificate {
    /// Reads an atlas: the head, then one point or tile per line.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let (place, records) = (Place::of_schema(&values[0], ATLAS_SCHEMA)?, &values[1..]);
        let head: AtlasHead = place.read()?;
        let axes = Axes::of(&place, &head.over, head.points, head.shard)?;
        let (mut seen, mut lines) = (HashSet::new(), Vec::new());
        let point = |(i, value)| {
            let place = Place::at(format!("points[{i}]"), value);
            let record: AtlasRecord = place.read()?;
            let mut claimed = ClaimedPoint::of(&head, &axes, &record, &place)?;
            lines.push(marks::record(&record, &mut claimed.parts.iter().map(Part::proved)));
            if !seen.insert(record.point) {
                claimed.contradiction = Some("its point is listed before as well");
            }
            Ok(claimed)
        };
        let points: Vec<ClaimedPoint> = records.iter().enumerate().map(point).collect::<Result<_, Error>>()?;
        let places: Vec<&[Option<u64>]> = points.iter().map(|point| &point.places[..]).collect();
        let has_orbits = points.iter().flat_map(|point| &point.parts).any(|part| part.global.orbits.is_some());
        let marks = marks::atlas(&head, &axes.pinned(&places), has_orbits).with(LINES, marks::list(lines));
        let missing = axes.own_points().saturating_sub(seen.len() as u64); // exact: points that are not of it are refuted
        Ok((Self { points, has_cells: head.cells, missing }, marks))
    }

    /// Number of points or tiles.
    pub fn count(&self) -> usize {
        self.points.len()
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
}

impl Part {
    /// The parts of a record: the record itself, then the cells into which it is cut.
    fn all(head: &AtlasHead, record: &AtlasRecord, place: &Place<'_>) -> Result<Vec<Self>, Error> {
        let refused = || place.refused("its axes are not parameters of the scene");
        let document = record.global(head).ok_or_else(refused)?;
        let (pair, start) = document.scene.clone().model()?;
        let global = GlobalCertificate::of(&document, place)?;
        let mut parts = vec![Self { global, pair, start, stable: record.stable.clone() }];
        let places = if record.quarters.is_empty() { Vec::new() } else { place.get("quarters")?.list()? };
        for (quarter, place) in record.quarters.iter().zip(&places) {
            parts.extend(Self::all(head, quarter, place)?);
        }
        Ok(parts)
    }

    /// What is said of its values depends on this.
    fn proved(&self) -> Proved {
        let has_sets = self.global.claimed.iter().any(|claim| claim.is_saddle_set);
        Proved {
            is_said: self.claims_something(),
            counts_sets: self.global.says_there_are_no_others || !has_sets,
            components: self.global.components(),
        }
    }

    /// Whether there is a claim to prove.
    pub fn claims_something(&self) -> bool {
        self.global.claims_something() || !self.stable.is_empty()
    }
}

impl ClaimedPoint {
    fn of(head: &AtlasHead, axes: &Axes<'_>, record: &AtlasRecord, place: &Place<'_>) -> Result<Self, Error> {
        let parts = Part::all(head, record, place)?;
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
