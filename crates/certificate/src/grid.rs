//! The grid of a sweep or an atlas, read back: varied parameters, points, and positions of their values.

use std::cmp::Ordering;

use super::marks::Pinned;
use impact_pair_document::{Place, SceneDocument, SweepAxis, Written};
use impact_pair_exact::{Exact, ExactError};
use impact_pair_model::Error;
use impact_pair_model::scene::Key;

/// The parameters that vary, and the part of their grid that belongs to the document.
pub(super) struct Axes<'a> {
    pub keys: Vec<Key>,
    over: &'a [SweepAxis],
    /// The first and the last value of each axis.
    ends: Vec<[Exact; 2]>,
    points: u64,
    shard: Option<[u64; 2]>,
}

/// A point in the grid.
pub(super) struct Placed {
    /// The values with their keys, in an order in which they can be set.
    pub values: Vec<(Key, Exact)>,
    /// The position of the point on each axis, from 0.
    pub places: Vec<Option<u64>>,
    /// True if the values are those of the grid; `None` if undecided.
    pub is_of_grid: Option<bool>,
}

impl<'a> Axes<'a> {
    /// Reads the axes of a head.
    ///
    /// # Errors
    /// Name the key of an axis, the axes or the shard, and what is accepted.
    pub fn of(head: &Place<'_>, over: &'a [SweepAxis], points: u64, shard: Option<[u64; 2]>) -> Result<Self, Error> {
        if shard.is_some_and(|[number, of]| !(1..=of).contains(&number)) {
            return Err(head
                .get("shard")?
                .refused("accepted is the number of a shard, from 1 on, and how many there are"));
        }
        let key = |(axis, place): (&SweepAxis, &Place<'_>)| {
            let key = axis.key.parse().or_else(|error: Error| Err(place.get("key")?.refused(&error.to_string())));
            let is_in_full = |key: &Key| axis.key == key.to_string() || axis.key == key.place();
            key.and_then(|key| {
                if is_in_full(&key) { Ok(key) } else { Err(place.get("key")?.refused("accepted is a name in full")) }
            })
        };
        let ends = |(axis, place): (&SweepAxis, &Place<'_>)| -> Result<[Exact; 2], Error> {
            let end = |name: &str, text: &str| {
                Exact::parse(text).or_else(|error| Err(place.get(name)?.refused(&error.to_string())))
            };
            Ok([end("from", &axis.from)?, end("to", &axis.to)?])
        };
        let places = head.get("over")?.list()?;
        let keys: Vec<Key> = over.iter().zip(&places).map(key).collect::<Result<_, _>>()?;
        let ends = over.iter().zip(&places).map(ends).collect::<Result<_, _>>()?;
        if (0..keys.len()).any(|i| keys[..i].iter().any(|other| keys[i].is_one_with(*other))) {
            return Err(head.get("over")?.refused("accepted are axes of which no two set the same"));
        }
        Ok(Self { keys, over, ends, points, shard })
    }

    /// Whether the product of the axes' counts is the given number of points.
    pub fn are_all(&self) -> bool {
        let all = self.over.iter().try_fold(1u64, |all, axis| all.checked_mul(axis.count));
        all == Some(self.points)
    }

    /// Index of the harmonic that phases are relative to, if there are several harmonics: the fastest that moves the box when all axes are at
    /// their upper ends.
    ///
    /// # Errors
    /// Returns an error if an upper end is not an accepted value of the scene.
    pub fn reference(&self, scene: &SceneDocument) -> Result<Option<usize>, Error> {
        let mut scene = scene.clone();
        for (key, [_, upper]) in self.keys.iter().zip(&self.ends).filter(|(key, _)| **key != Key::StartPhase) {
            let refused = || Error::certificate(format!("over: {} is no value of the scene", key.place()));
            scene.set(*key, upper.clone()).ok_or_else(refused)?;
        }
        let (pair, _) = scene.model()?;
        let excitation = pair.excitation();
        Ok((excitation.terms().len() > 1).then(|| excitation.reference_term()))
    }

    /// Number of points, or smallest cells, along each axis.
    pub fn counts(&self) -> Vec<u64> {
        self.over.iter().map(|axis| axis.count).collect()
    }

    /// Number of points, or tiles, that the document gives for the whole grid.
    pub fn points(&self) -> u64 {
        self.points
    }

    /// The first and the last value of an axis.
    pub fn ends(&self, axis: usize) -> &[Exact; 2] {
        &self.ends[axis]
    }

    /// Whether a point is in the grid, and in the shard, which holds every `of`-th point.
    pub fn has(&self, point: u64) -> bool {
        point < self.points && self.shard.is_none_or(|[number, of]| point % of == number - 1)
    }

    /// Number of points of the grid, or of the shard.
    pub fn own_points(&self) -> u64 {
        let [number, of] = self.shard.unwrap_or([1, 1]); // exact: all of them
        self.points / of + u64::from(number <= self.points % of)
    }

    /// Compares the values of a point with the values of the grid.
    ///
    /// # Errors
    /// Returns an error unless there is one number for each axis.
    pub fn placed(&self, point: u64, written: &[String], place: &Place<'_>) -> Result<Placed, Error> {
        if written.len() != self.over.len() {
            return Err(place.get("values")?.refused("there must be one of each axis"));
        }
        // The last axis varies fastest.
        let (mut rest, mut is_of_grid) = (point, Some(true));
        let (mut values, mut places) = (Vec::new(), Vec::new());
        for (((axis, ends), key), value) in self.over.iter().zip(&self.ends).zip(&self.keys).zip(written).rev() {
            let value =
                Exact::parse(value).map_err(|error| Error::certificate(format!("values: {error}")).because(error))?;
            let at = (axis.count > 1).then(|| rest % axis.count);
            let grid = at.and_then(|at| on_axis(ends, axis.count, at).ok());
            is_of_grid = and(is_of_grid, is_one(grid, &value));
            rest = rest.checked_div(axis.count).unwrap_or(1);
            values.push((*key, value));
            places.insert(0, at);
        }
        if rest != 0 {
            is_of_grid = Some(false);
        }
        // The phase of the start depends on the other parameters.
        values.sort_by_key(|(key, _)| *key == Key::StartPhase);
        Ok(Placed { values, places, is_of_grid })
    }

    /// The part of the grid that these points determine: both ends and the count of an axis, where they have several values on it.
    pub fn pinned(&self, points: &[&[Option<u64>]]) -> Pinned {
        let is_pinned = |axis: usize| points.iter().any(|places| places.get(axis) != points[0].get(axis));
        Pinned {
            keys: self.keys.clone(),
            axes: (0..self.keys.len()).map(is_pinned).collect(),
            has_several: points.len() > 1,
        }
    }
}

/// Three-valued conjunction; `None` is undecided.
pub(super) fn and(one: Option<bool>, other: Option<bool>) -> Option<bool> {
    match (one, other) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (None, _) | (_, None) => None,
        (Some(true), Some(true)) => Some(true),
    }
}

/// Whether a value of the grid equals `value`; `None` if undecided, or if there is no value of the grid.
pub(super) fn is_one(grid: Option<Exact>, value: &Exact) -> Option<bool> {
    grid?.compare(value).map(Ordering::is_eq)
}

/// The value number `at` of `count` equidistant values from `from` to `to`.
pub(super) fn on_axis([from, to]: &[Exact; 2], count: u64, at: u64) -> Result<Exact, ExactError> {
    let whole = |n: u64| Exact::from_rational(num_rational::BigRational::from_integer(n.into()));
    if at + 1 == count {
        return Ok(to.clone());
    }
    let part = whole(at).checked_div(&whole(count - 1))?;
    from.checked_add(&to.checked_sub(from)?.checked_mul(&part)?)
}

/// Replaces the scene's own value; `None` where the key has no value in the scene. `reference`: index of the harmonic of phases.
pub(super) fn varied(scene: &mut SceneDocument, key: Key, reference: Option<usize>, value: Exact) -> Option<()> {
    if key != Key::StartPhase {
        return scene.set(key, value);
    }
    let (pair, _) = scene.clone().model().ok()?;
    let excitation = pair.excitation();
    let term = reference.map_or(excitation.reference(), |term| &excitation.terms()[term]);
    let time = value.checked_sub(term.phase()).and_then(|since| since.checked_div(term.frequency())).ok()?;
    scene.start.time = Written(time);
    Some(())
}
