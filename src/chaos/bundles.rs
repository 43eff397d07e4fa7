//! Clusters of leaves that make good h-sets: tried all over a floating-point orbit, moved while more entropy is seen, and parted by more gaps.
//!
//! Labels: proposes throughout.

use std::cell::OnceCell;

use super::guess::Guess;
use super::index::Indexed;
use super::leaves::{HALF_LENGTHS, LEAF_OFFSETS, Leaves, MAX_GAPS, Window};
use super::quad::State;
use super::seen::AttractorOrbit;
use super::vector::{apart, length};
use super::words::HSet;
use crate::threads::each;
use crate::watch::Watch;

/// Least distance of points of the orbit that are tried, phases in radians, and their greatest number.
const MIN_DISTANCE: f64 = 0.004;
const MAX_POINTS: usize = 80;
/// The widest gap parts, or the widest two, or three, or none.
const GAP_SELECTIONS: [u32; 4] = [0b0, 0b1, 0b11, 0b111];
/// The most h-sets of a place.
const MAX_H_SETS: u32 = 4;
/// Factors by which h-sets are made shorter until they are apart from one another.
const LENGTH_FACTORS: [f64; 5] = [1.0, 0.93, 0.86, 0.8, 0.7];
/// Number of places that are moved, their least distance relative to their length, and the number of those that are parted further.
const MOVED_PLACES: usize = 16;
const MIN_PLACE_DISTANCE: f64 = 0.25;
const SPLIT_PLACES: usize = 5;
/// Moves, relative: the first ones, and those that are small enough.
const MOVE_SIZES: [f64; 2] = [0.3, 0.01];

/// A place where clusters of leaves are looked for: about a point of the orbit, up to `long` along its leaf and `beside` across it, in
/// radians; bit `n` of `cuts` says whether the gap with `n` wider ones parts them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub middle: (State, State),
    pub long: f64,
    pub beside: f64,
    pub cuts: u32,
}

/// H-sets of one place, and the entropy that is seen of them.
#[derive(Clone, Debug)]
pub(super) struct Bundle {
    pub bases: Vec<HSet>,
    seen: f64,
    place: Place,
}

/// Orbit, and the number of impacts of its words that are looked at.
struct WordObservation<'s> {
    orbit: Indexed<'s>,
    guess: &'s Guess,
    impacts: usize,
}

impl AttractorOrbit {
    /// H-sets about clusters of leaves, those first that most entropy is seen of. `watch` says whether to look further.
    pub(super) fn bundles(&self, guess: &Guess, impacts: usize, watch: &dyn Watch) -> Vec<Bundle> {
        let sight = WordObservation { orbit: Indexed::new(self), guess, impacts };
        let of_one = |&middle: &(State, State)| if watch.goes_on() { sight.about(middle) } else { Vec::new() };
        let mut starts: Vec<Bundle> = Vec::new();
        for one in sorted(each(&self.middles(), &of_one).concat()) {
            let from = |other: &Bundle| apart(one.place.middle.0, other.place.middle.0);
            if starts.len() < MOVED_PLACES
                && starts.iter().all(|other| from(other) > MIN_PLACE_DISTANCE * one.place.long)
            {
                starts.push(one);
            }
        }
        let improved = sorted(each(&starts, &|start| sight.improved(start.clone(), (true, watch))));
        // Less is seen of thin bases, but more is proved.
        let best = improved.iter().take(SPLIT_PLACES).map(|bundle| bundle.place);
        let places = best.flat_map(|place| GAP_SELECTIONS.map(|cuts| Place { cuts: cuts | place.cuts, ..place }));
        let with_gap_toggled: Vec<Bundle> = places.filter_map(|place| sight.at(place)).collect();
        let with_gap_toggled = each(&with_gap_toggled, &|start| sight.improved(start.clone(), (false, watch)));
        distinct(with_gap_toggled.into_iter().chain(improved))
    }

    /// Bundles of a place with one separating gap more, or one less.
    pub(super) fn with_gap_toggled(&self, guess: &Guess, bundle: &Bundle, impacts: usize) -> Vec<Bundle> {
        let sight = WordObservation { orbit: Indexed::new(self), guess, impacts };
        bundle.place.with_gap_toggled().into_iter().filter_map(|place| sight.at(place)).collect()
    }

    /// Points of the orbit, all over it.
    fn middles(&self) -> Vec<(State, State)> {
        let mut found: Vec<(State, State)> = Vec::new();
        for &point in &self.points {
            if found.len() < MAX_POINTS && found.iter().all(|other| apart(point.0, other.0) > MIN_DISTANCE) {
                found.push(point);
            }
        }
        found
    }
}

impl Place {
    fn with_gap_toggled(self) -> Vec<Self> {
        let other = (0..MAX_GAPS).map(|gap| Self { cuts: self.cuts ^ (1 << gap), ..self });
        other.filter(|place| place.cuts.count_ones() < MAX_H_SETS).collect()
    }
}

impl<'s> WordObservation<'s> {
    fn window(&self, middle: (State, State)) -> Option<Window<'s>> {
        Window::new(&self.orbit, self.guess, middle)
    }

    /// The point of the orbit at this part of the length along the leaf.
    fn beyond(&self, Place { middle: (centre, along), long, .. }: Place, part: f64) -> (State, State) {
        let size = part * long / length(along);
        let at = [0, 1].map(|i| centre[i] + size * along[i]);
        let found = self.orbit.nearest(at).filter(|found| apart(found.0, at) < apart(centre, at));
        found.unwrap_or((centre, along))
    }

    /// The bundles about one point, of all sizes.
    fn about(&self, middle: (State, State)) -> Vec<Bundle> {
        let Some(window) = self.window(middle) else { return Vec::new() };
        let sizes = HALF_LENGTHS.into_iter().flat_map(|long| LEAF_OFFSETS.map(|beside| [long, beside]));
        let found = sizes.flat_map(|size| self.bundles(&window, (middle, size), &GAP_SELECTIONS));
        distinct(found.flatten().filter(|bundle| bundle.seen > 0.0))
    }

    fn at(&self, Place { middle, long, beside, cuts }: Place) -> Option<Bundle> {
        self.bundles(&self.window(middle)?, (middle, [long, beside]), &[cuts]).swap_remove(0)
    }

    /// The h-sets of a place of this half length and half width, parted by gaps in each of these ways; shorter if need be to be apart.
    fn bundles(
        &self,
        window: &Window,
        (middle, [long, beside]): ((State, State), [f64; 2]),
        neighbours: &[u32],
    ) -> Vec<Option<Bundle>> {
        let lengths = LENGTH_FACTORS.map(|part| part * long);
        let leaves: [OnceCell<Option<Leaves>>; LENGTH_FACTORS.len()] = Default::default();
        let of_one = |&cuts: &u32| {
            lengths.into_iter().zip(&leaves).find_map(|(long, leaves)| {
                let leaves = leaves.get_or_init(|| window.leaves([long, beside])).as_ref()?;
                let clusters = window.clusters(leaves, cuts);
                let bases: Vec<HSet> = clusters.iter().map(|cluster| window.base(cluster)).collect();
                let seen = are_good(&bases).then(|| window.entropy(&clusters, self.impacts))?;
                Some(Bundle { bases, seen, place: Place { middle, long, beside, cuts } })
            })
        };
        neighbours.iter().map(of_one).collect()
    }

    /// A little to all sides, as long as more entropy is seen.
    fn improved(&self, mut best: Bundle, (parts, watch): (bool, &dyn Watch)) -> Bundle {
        let [mut step, least] = MOVE_SIZES;
        while step > least && watch.goes_on() {
            let place = best.place;
            let Place { middle, long, beside, cuts } = place;
            let Some(here) = self.window(middle) else { break };
            let with_gap_toggled: Vec<u32> =
                if parts { place.with_gap_toggled().iter().map(|place| place.cuts).collect() } else { Vec::new() };
            let mut tried = self.bundles(&here, (middle, [long, beside]), &with_gap_toggled);
            for sign in [-1.0, 1.0] {
                let middle = self.beyond(place, sign * step);
                if let Some(beyond) = self.window(middle) {
                    let longer = [-1.0, 0.0, 1.0].map(|to| [long * (1.0 + to * step), beside]);
                    tried.extend(longer.into_iter().flat_map(|size| self.bundles(&beyond, (middle, size), &[cuts])));
                }
                let sizes = [[long * (1.0 + sign * step), beside], [long, beside * (1.0 + sign * step)]];
                tried.extend(sizes.into_iter().flat_map(|size| self.bundles(&here, (place.middle, size), &[cuts])));
            }
            let tried = tried.into_iter().flatten();
            match tried.max_by(|a, b| a.seen.total_cmp(&b.seen)).filter(|tried| tried.seen > best.seen) {
                Some(better) => best = better,
                None => step *= 0.5,
            }
        }
        best
    }
}

fn sorted(mut bundles: Vec<Bundle>) -> Vec<Bundle> {
    bundles.sort_by(|a, b| b.seen.total_cmp(&a.seen));
    bundles
}

fn distinct(bundles: impl Iterator<Item = Bundle>) -> Vec<Bundle> {
    let mut found: Vec<Bundle> = Vec::new();
    for bundle in bundles {
        if found.iter().all(|other| other.bases != bundle.bases) {
            found.push(bundle);
        }
    }
    found
}

/// Whether all h-sets are convex, near, and disjoint from one another.
fn are_good(bases: &[HSet]) -> bool {
    let is_apart = |(k, base): (usize, &HSet)| bases[..k].iter().all(|other| base.is_apart(other));
    bases.iter().all(|base| base.is_convex() && base.is_near()) && bases.iter().enumerate().all(is_apart)
}
