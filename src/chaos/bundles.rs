//! Where clusters of leaves make good h-sets: tried all over a floating-point orbit, moved as long as more is seen, parted further.
//!
//! Labels: proposes throughout.

use super::bases::{Seen, apart};
use super::guess::{Guess, length};
use super::index::Indexed;
use super::leaves::{BESIDE, GAPS, LENGTHS, Window};
use super::quad::State;
use super::trials::each;
use super::words::Base;

/// Points of the orbit that are that far apart, and at most so many.
const APART: f64 = 0.004;
const MIDDLES: usize = 80;
/// The widest gap parts, or the widest two, or three, or none.
const NESTED: [u32; 4] = [0b0, 0b1, 0b11, 0b111];
/// At most so many h-sets.
const MOST: u32 = 4;
/// If they are not apart from one another they are made shorter.
const SHORTER: [f64; 5] = [1.0, 0.93, 0.86, 0.8, 0.7];
/// So many places, that far apart, relative to what is there, are moved; and so many of these are parted further.
const STARTS: usize = 16;
const ELSEWHERE: f64 = 0.25;
const FURTHER: usize = 5;
/// Moves, relative: the first ones, and those that are small enough.
const MOVES: [f64; 2] = [0.3, 0.01];

/// Where clusters of leaves are looked for: about a point of the orbit, so far along its leaf and beside it, in radians; bit `n` of
/// `cuts` says whether the gap that is the widest but `n` parts them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub middle: (State, State),
    pub long: f64,
    pub beside: f64,
    pub cuts: u32,
}

/// H-sets of one place, and how much entropy is seen of them.
#[derive(Clone, Debug)]
pub(super) struct Bundle {
    pub bases: Vec<Base>,
    seen: f64,
    place: Place,
}

/// An orbit, and how many impacts of its words are looked at.
struct Sight<'s> {
    orbit: Indexed<'s>,
    guess: &'s Guess,
    impacts: usize,
}

impl Seen {
    /// H-sets about clusters of leaves, those first that most entropy is seen of. `goes_on` says whether to look further.
    pub(super) fn bundles(&self, guess: &Guess, impacts: usize, goes_on: &(dyn Fn() -> bool + Sync)) -> Vec<Bundle> {
        let sight = Sight { orbit: Indexed::new(self), guess, impacts };
        let of_one = |&middle: &(State, State)| if goes_on() { sight.about(middle) } else { Vec::new() };
        let mut starts: Vec<Bundle> = Vec::new();
        for one in sorted(each(&self.middles(), &of_one).concat()) {
            let from = |other: &Bundle| apart(one.place.middle.0, other.place.middle.0);
            if starts.len() < STARTS && starts.iter().all(|other| from(other) > ELSEWHERE * one.place.long) {
                starts.push(one);
            }
        }
        let climbed = sorted(each(&starts, &|start| sight.climbed(start.clone(), (true, goes_on))));
        // Less is seen of thin bases, but more is proved.
        let best = climbed.iter().take(FURTHER).map(|bundle| bundle.place);
        let places = best.flat_map(|place| NESTED.map(|cuts| Place { cuts: cuts | place.cuts, ..place }));
        let parted: Vec<Bundle> = places.filter_map(|place| sight.at(place)).collect();
        let parted = each(&parted, &|start| sight.climbed(start.clone(), (false, goes_on)));
        distinct(parted.into_iter().chain(climbed))
    }

    /// The same place with one gap more that parts it, or one less.
    pub(super) fn parted(&self, guess: &Guess, bundle: &Bundle, impacts: usize) -> Vec<Bundle> {
        let sight = Sight { orbit: Indexed::new(self), guess, impacts };
        bundle.place.parted().into_iter().filter_map(|place| sight.at(place)).collect()
    }

    /// Points of the orbit, all over it.
    fn middles(&self) -> Vec<(State, State)> {
        let mut found: Vec<(State, State)> = Vec::new();
        for &point in &self.points {
            if found.len() < MIDDLES && found.iter().all(|other| apart(point.0, other.0) > APART) {
                found.push(point);
            }
        }
        found
    }
}

impl Place {
    fn parted(self) -> Vec<Self> {
        let other = (0..GAPS).map(|gap| Self { cuts: self.cuts ^ (1 << gap), ..self });
        other.filter(|place| place.cuts.count_ones() < MOST).collect()
    }
}

impl<'s> Sight<'s> {
    fn window(&self, middle: (State, State)) -> Option<Window<'s>> {
        Window::new(&self.orbit, self.guess, middle)
    }

    /// The point of the orbit so far along the leaf.
    fn beyond(&self, Place { middle: (centre, along), long, .. }: Place, part: f64) -> (State, State) {
        let size = part * long / length(along);
        let at = [0, 1].map(|i| centre[i] + size * along[i]);
        let found = self.orbit.nearest(at).filter(|found| apart(found.0, at) < apart(centre, at));
        found.unwrap_or((centre, along))
    }

    /// The bundles about one point, of all sizes.
    fn about(&self, middle: (State, State)) -> Vec<Bundle> {
        let Some(window) = self.window(middle) else { return Vec::new() };
        let sizes = LENGTHS.into_iter().flat_map(|long| BESIDE.map(|beside| (long, beside)));
        let places = sizes.flat_map(|(long, beside)| NESTED.map(|cuts| Place { middle, long, beside, cuts }));
        let found = places.filter_map(|place| self.bundle(&window, place));
        distinct(found.filter(|bundle| bundle.seen > 0.0))
    }

    fn at(&self, place: Place) -> Option<Bundle> {
        self.bundle(&self.window(place.middle)?, place)
    }

    /// The h-sets of a place, shorter if need be to be apart.
    fn bundle(&self, window: &Window, place: Place) -> Option<Bundle> {
        let shorter = SHORTER.map(|part| Place { long: part * place.long, ..place });
        let (place, clusters, bases) = shorter.into_iter().find_map(|place| {
            let clusters = window.clusters(place)?;
            let bases: Vec<Base> = clusters.iter().map(|cluster| window.base(cluster)).collect();
            are_good(&bases).then_some((place, clusters, bases))
        })?;
        Some(Bundle { bases, seen: window.entropy(&clusters, self.impacts), place })
    }

    /// A little to all sides, as long as more entropy is seen.
    fn climbed(&self, mut best: Bundle, (parts, goes_on): (bool, &dyn Fn() -> bool)) -> Bundle {
        let [mut step, least] = MOVES;
        while step > least && goes_on() {
            let place = best.place;
            let here = self.window(place.middle);
            let of_parts = if parts { place.parted() } else { Vec::new() };
            let mut tried: Vec<Option<Bundle>> =
                of_parts.into_iter().map(|place| self.bundle(here.as_ref()?, place)).collect();
            for sign in [-1.0, 1.0] {
                let middle = self.beyond(place, sign * step);
                let beyond = self.window(middle);
                let longer = [-1.0, 0.0, 1.0].map(|to| place.long * (1.0 + to * step));
                tried.extend(longer.map(|long| self.bundle(beyond.as_ref()?, Place { middle, long, ..place })));
                let sizes = [(sign, 0.0), (0.0, sign)].map(|(long, beside)| Place {
                    long: place.long * (1.0 + long * step),
                    beside: place.beside * (1.0 + beside * step),
                    ..place
                });
                tried.extend(sizes.map(|place| self.bundle(here.as_ref()?, place)));
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

/// Whether they may be h-sets.
fn are_good(bases: &[Base]) -> bool {
    let is_apart = |(k, base): (usize, &Base)| bases[..k].iter().all(|other| base.is_apart(other));
    bases.iter().all(|base| base.is_convex() && base.is_near()) && bases.iter().enumerate().all(is_apart)
}
