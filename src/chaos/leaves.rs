//! H-sets about clusters of leaves, measured from a floating-point orbit. Where an attractor consists of bundles of leaves with gaps
//! between, each bundle has one h-set.
//!
//! Labels: proposes throughout.

use super::entropy::entropy;
use super::guess::Guess;
use super::index::Indexed;
use super::law::Side;
use super::quad::State;
use super::seen::AttractorOrbit;
use super::vector::{cross, unit};
use super::words::{HSet, Path};

/// The widest gaps, which may part them.
pub(super) const MAX_GAPS: usize = 6;
/// Half lengths, and how far beside the middle leaf others are looked at, in radians.
pub(super) const HALF_LENGTHS: [f64; 5] = [0.3, 0.2, 0.13, 0.08, 0.05];
pub(super) const LEAF_OFFSETS: [f64; 3] = [0.06, 0.02, 0.006];
/// The greatest of these that a window sees.
const WINDOW_SIZE: [f64; 2] = [1.2 * HALF_LENGTHS[0], 2.0 * LEAF_OFFSETS[0]];
/// Impacts ahead that the contracting direction is determined from.
const DIRECTION_IMPACTS: usize = 12;
/// Number of points of the orbit whose leaves and words are counted, of impacts after each, and the fewest leaves that are enough.
const COUNTED_POINTS: usize = 60_000;
const WORD_IMPACTS: usize = 64;
const MIN_LEAVES: usize = 100;
/// Leaves are distinguished in this central part of an h-set, where their slopes are at most `MAX_SLOPE`, and then followed to its ends.
const CENTRAL_PART: f64 = 0.3;
const MAX_SLOPE: f64 = 0.3;
const FOLLOWED_PARTS: [f64; 3] = [0.3, 0.6, 1.05];
/// Parts of the gaps beside a bundle in which leaves are followed with it, and into which its h-set reaches.
const GAP_PART: f64 = 0.2;
const H_SET_GAP_PART: f64 = 0.1;
/// Number of points that are looked at in each h-set; the number in a row above which they make a crossing, if images of neighbours are
/// nearer than `MAX_IMAGE_DISTANCE`; images farther than `MAX_IMAGE_OFFSET` make none. A half length is 1.
const SAMPLED_POINTS: usize = 1200;
const MIN_CROSSING_POINTS: usize = 4;
const MAX_IMAGE_DISTANCE: f64 = 0.6;
const MAX_IMAGE_OFFSET: f64 = 8.0;

/// Coordinates along a leaf and across, lengths in radians.
pub(super) struct Window<'s> {
    seen: &'s AttractorOrbit,
    centre: State,
    along: State,
    across: State,
    /// The points of the orbit in reach, from left to right: their number and, with the slopes of their leaves, their coordinates.
    near: Vec<(usize, [f64; 3])>,
}

/// A cluster of leaves: its half length, and the slope, middle and half width of its band, in a window's coordinates.
pub(super) struct Cluster {
    long: f64,
    slope: f64,
    middle: f64,
    width: f64,
}

/// Leaves beside the middle one, from the lowest on: heights and slopes in the midst of a place of this half length, and how far beside.
pub(super) struct Leaves {
    long: f64,
    beside: f64,
    sorted: Vec<[f64; 2]>,
    /// The numbers of those above the widest gaps, the widest first.
    widest: Vec<usize>,
}

/// Heights and slope of some neighbouring leaves in the middle, and the distances to the leaves below and above.
struct Bunch {
    heights: [f64; 2],
    slope: f64,
    free: [f64; 2],
}

/// Means of the two numbers that `of` gives for each element.
fn means<T>(all: &[T], of: impl Fn(&T) -> [f64; 2]) -> [f64; 2] {
    let sums = all.iter().map(of).fold([0.0; 2], |[a, b], [x, y]| [a + x, b + y]);
    sums.map(|sum| sum / all.len() as f64)
}

/// The members among some points, in the same order; without branches, which are hard to predict.
fn members(points: &[(usize, [f64; 3])], is_member: impl Fn(&[f64; 3]) -> bool) -> Vec<[f64; 3]> {
    let (mut found, mut count) = (vec![[0.0; 3]; points.len()], 0);
    for (_, at) in points {
        found[count] = *at;
        count += usize::from(is_member(at));
    }
    found.truncate(count);
    found
}

impl Cluster {
    /// Coordinates in which it is from -1 to 1.
    fn in_coordinates(&self, [xi, eta]: [f64; 2]) -> [f64; 2] {
        [xi / self.long, (eta - self.middle - self.slope * xi) / self.width]
    }
}

impl<'s> Window<'s> {
    pub fn new(orbit: &Indexed<'s>, guess: &Guess, (centre, along): (State, State)) -> Option<Self> {
        let (along, across) = (unit(along), unit(guess.contracting(centre, DIRECTION_IMPACTS)?));
        let mut window = Self { seen: orbit.seen, centre, along, across, near: Vec::new() };
        let reach = [0, 1].map(|i| WINDOW_SIZE[0] * along[i].abs() + WINDOW_SIZE[1] * across[i].abs());
        let counted = orbit.seen.points.len().min(COUNTED_POINTS).saturating_sub(WORD_IMPACTS);
        let is_near = |&k: &usize| {
            k < counted && (orbit.seen.points[k].0[1] - centre[1]).abs() < reach[1] && {
                let [xi, eta] = window.place(k);
                xi.abs() < WINDOW_SIZE[0] && eta.abs() < WINDOW_SIZE[1]
            }
        };
        let seen = orbit.within(centre[0], reach[0]).filter(is_near);
        let mut near: Vec<_> = seen.map(|k| (k, window.point(k))).collect();
        near.sort_by(|(k, a), (n, b)| a[0].total_cmp(&b[0]).then(k.cmp(n)));
        window.near = near;
        Some(window)
    }

    fn in_coordinates(&self, at: State) -> [f64; 2] {
        let sine = cross(self.along, self.across);
        [cross(at, self.across) / sine, cross(self.along, at) / sine]
    }

    /// The place of a point of the orbit.
    fn place(&self, number: usize) -> [f64; 2] {
        let [u, w] = self.seen.points[number].0;
        let phase = u - self.centre[0];
        self.in_coordinates([phase - phase.round(), w - self.centre[1]])
    }

    /// Place of a point of the orbit, with the slope of its leaf.
    fn point(&self, number: usize) -> [f64; 3] {
        let [xi, eta] = self.place(number);
        let [run, rise] = self.in_coordinates(self.seen.points[number].1);
        [xi, eta, rise / run]
    }

    /// Points in reach that are less far along the leaf than `far`.
    fn central(&self, far: f64) -> &[(usize, [f64; 3])] {
        let first = self.near.partition_point(|(_, at)| at[0] <= -far);
        &self.near[first..first + self.near[first..].partition_point(|(_, at)| at[0] < far)]
    }

    /// The h-set of a cluster.
    pub fn base(&self, cluster: &Cluster) -> HSet {
        let at = [0, 1].map(|i| self.centre[i] + cluster.middle * self.across[i]);
        let own = [0, 1].map(|i| cluster.long * (self.along[i] + cluster.slope * self.across[i]));
        HSet::new(at, own, self.across.map(|x| x * cluster.width))
    }

    /// Entropy of the words that are seen, per impact.
    pub fn entropy(&self, clusters: &[Cluster], impacts: usize) -> f64 {
        let words: Vec<Path> = (0..clusters.len()).flat_map(|from| self.words(clusters, from, impacts)).collect();
        entropy(&words, clusters.len(), |word| word.sides.len() as i64)
    }

    /// Words that the orbit's points in cluster `from` are seen to make: consecutive points that cross a cluster at one time.
    fn words(&self, clusters: &[Cluster], from: usize, impacts: usize) -> Vec<Path> {
        let is_inside = |[xi, eta, _]: [f64; 3]| clusters[from].in_coordinates([xi, eta]).iter().all(|x| x.abs() < 1.0);
        let central = self.central(clusters[from].long).iter();
        let inside: Vec<usize> = central.filter(|(_, at)| is_inside(*at)).map(|(k, _)| *k).collect();
        let inside: Vec<usize> = inside.iter().copied().step_by(inside.len() / SAMPLED_POINTS + 1).collect();
        let mut taken = vec![false; inside.len()];
        let mut words = Vec::new();
        for time in 1..=impacts.min(WORD_IMPACTS) {
            let places: Vec<[f64; 2]> = inside.iter().map(|&k| self.place(k + time)).collect();
            for (to, cluster) in clusters.iter().enumerate() {
                let images: Vec<[f64; 2]> = places.iter().map(|&at| cluster.in_coordinates(at)).collect();
                for [first, last] in crossings(&images, &taken) {
                    taken[first..last].fill(true);
                    words.push(Path {
                        from,
                        to,
                        sides: vec![Side::Far; time],
                        half_turns: 1,
                        ends: [Vec::new(), Vec::new()],
                    });
                }
            }
        }
        words
    }

    /// Leaves in a place of this half length and half width beside the middle one; `None` if there are too few.
    pub fn leaves(&self, [long, beside]: [f64; 2]) -> Option<Leaves> {
        let central =
            self.central(CENTRAL_PART * long).iter().map(|(_, at)| at).filter(|[_, _, slope]| slope.abs() < MAX_SLOPE);
        let mut sorted: Vec<[f64; 2]> = central
            .map(|[xi, eta, slope]| [eta - slope * xi, *slope])
            .filter(|[height, _]| height.abs() < beside)
            .collect();
        if sorted.len() < MIN_LEAVES {
            return None;
        }
        sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let gap = |k: usize| sorted[k][0] - sorted[k - 1][0];
        let wider = |a: &usize, b: &usize| gap(*b).total_cmp(&gap(*a)).then(a.cmp(b));
        let mut widest: Vec<usize> = (1..sorted.len()).collect();
        widest.select_nth_unstable_by(MAX_GAPS, wider);
        widest.truncate(MAX_GAPS);
        widest.sort_by(wider);
        Some(Leaves { long, beside, sorted, widest })
    }

    /// Clusters of leaves between gaps: bit `n` of `cuts` says whether the gap with `n` wider ones separates clusters.
    pub fn clusters(&self, leaves: &Leaves, cuts: u32) -> Vec<Cluster> {
        leaves.bunches(cuts).iter().map(|bunch| self.cluster(leaves.long, bunch)).collect()
    }

    /// The leaves rise by `b xi + c xi^2`: followed further and further from the midst.
    fn cluster(&self, long: f64, Bunch { heights: [low, high], slope, free }: &Bunch) -> Cluster {
        let (low, high) = (low - GAP_PART * free[0], high + GAP_PART * free[1]);
        let [mut b, mut c] = [*slope, 0.0];
        let mut heights = [f64::INFINITY, f64::NEG_INFINITY];
        for part in FOLLOWED_PARTS {
            let is_member = |[xi, eta, _]: &[f64; 3]| {
                let height = eta - b * xi - c * xi * xi;
                (low < height) & (height < high)
            };
            let members = members(self.central(part * long), is_member);
            let [place, slope] = means(&members, |it| [it[0], it[2]]);
            let [spread, turn] = means(&members, |it| [(it[0] - place).powi(2), (it[0] - place) * (it[2] - slope)]);
            c = 0.5 * turn / spread;
            b = slope - 2.0 * c * place;
            let all = members.iter().map(|[xi, eta, _]| eta - b * xi);
            heights = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
        }
        let [least, most] = heights;
        let width = 0.5 * (most - least);
        let width = width + H_SET_GAP_PART * width.min(free[0]).min(free[1]);
        Cluster { long, slope: b, middle: 0.5 * (least + most), width }
    }
}

impl Leaves {
    /// The leaves parted at gaps.
    fn bunches(&self, cuts: u32) -> Vec<Bunch> {
        let Self { beside, sorted, widest, .. } = self;
        let gap = |k: usize| sorted[k][0] - sorted[k - 1][0];
        let mut ends: Vec<usize> = (0..MAX_GAPS).filter(|gap| cuts >> gap & 1 == 1).map(|gap| widest[gap]).collect();
        ends.extend([0, sorted.len()]);
        ends.sort_unstable();
        let bunch = |ends: &[usize]| {
            let bunch = &sorted[ends[0]..ends[1]];
            let free = |k: usize| if k == 0 || k == sorted.len() { *beside } else { gap(k) };
            Bunch {
                heights: [bunch[0][0], bunch[bunch.len() - 1][0]],
                slope: means(bunch, |leaf| [leaf[0], leaf[1]])[1],
                free: [free(ends[0]), free(ends[1])],
            }
        };
        ends.windows(2).map(bunch).collect()
    }
}

/// The stretches of images of points in a row that lead across, from -1 to 1 or back, none of them taken.
fn crossings(images: &[[f64; 2]], taken: &[bool]) -> Vec<[usize; 2]> {
    let mut found = Vec::new();
    // The last one beyond an end: before it all, and which one it is.
    let mut last: Option<(bool, usize)> = None;
    let mut before = 0.0;
    for (n, &[xi, eta]) in images.iter().enumerate() {
        if taken[n] || eta.abs() > 1.0 || xi.abs() > MAX_IMAGE_OFFSET {
            last = None;
            continue;
        }
        let within = xi.clamp(-1.0, 1.0);
        last = last.filter(|_| (within - before).abs() < MAX_IMAGE_DISTANCE);
        before = within;
        if xi.abs() > 1.0 {
            if let Some((was_before, first)) = last
                && was_before != (xi < 0.0)
                && n > first + MIN_CROSSING_POINTS
            {
                found.push([first, n]);
            }
            last = Some((xi < 0.0, n));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chaos::law::Law;
    use crate::number::Ball;

    /// `count` images, evenly from one place to another.
    fn row(from: f64, to: f64, count: usize) -> Vec<[f64; 2]> {
        (0..count).map(|k| [from + (to - from) * k as f64 / (count - 1) as f64, 0.0]).collect()
    }

    #[test]
    fn a_row_crosses_from_end_to_end() {
        let free = [false; 14];
        assert_eq!(crossings(&row(-1.2, 1.2, 9), &free[..9]), [[0, 8]]);
        assert_eq!(crossings(&row(1.2, -1.2, 9), &free[..9]), [[0, 8]]);
        // There and back, with the last one beyond an end and the first one beyond the other.
        let both = [row(-1.2, 1.2, 7), row(1.2, -1.2, 7)].concat();
        assert_eq!(crossings(&both, &free), [[0, 6], [7, 13]]);
    }

    #[test]
    fn no_row_crosses_that_jumps_or_leaves_or_is_short_or_taken() {
        let (whole, free) = (row(-1.2, 1.2, 9), [false; 9]);
        let no_crossing: [[usize; 2]; 0] = [];
        for (k, image) in [(4, [0.0, 1.1]), (4, [-0.9, 0.0]), (4, [9.0, 0.0])] {
            let mut images = whole.clone();
            images[k] = image;
            assert_eq!(crossings(&images, &free), no_crossing, "{image:?}");
        }
        assert_eq!(crossings(&row(-1.2, 1.2, 5), &free[..5]), no_crossing);
        let mut taken = free;
        taken[4] = true;
        assert_eq!(crossings(&whole, &taken), no_crossing);
    }

    const MIDDLE: (State, State) = ([0.78, 1.22], [0.18, 0.08]);

    /// Points on a leaf beside which two bundles of three parabolas each are seen.
    fn orbit(guess: &Guess) -> (AttractorOrbit, [Vec<[f64; 3]>; 2]) {
        let bare = AttractorOrbit { points: vec![MIDDLE], exponent: 0.5 };
        let Window { centre, along, across, .. } =
            Window::new(&Indexed::new(&bare), guess, MIDDLE).expect("a contracting direction");
        let leaf =
            |height: f64| row(-0.31, 0.31, 200).into_iter().map(move |[x, _]| [x, height + 0.02 * x * x, 0.04 * x]);
        let bundles =
            [[0.0, 0.001, 0.002], [0.007, 0.008, 0.009]].map(|heights| heights.into_iter().flat_map(leaf).collect());
        let state = |[xi, eta, slope]: [f64; 3]| {
            let mix = |a: f64, b: f64| [0, 1].map(|i| a * along[i] + b * across[i]);
            let [place, direction] = [mix(xi, eta), mix(1.0, slope)];
            ([centre[0] + place[0], centre[1] + place[1]], direction)
        };
        let mut points: Vec<(State, State)> = bundles.iter().flatten().copied().map(state).collect();
        // The last ones have no images.
        points.extend([([0.1, 0.1], along); WORD_IMPACTS]);
        (AttractorOrbit { points, exponent: 0.5 }, bundles)
    }

    #[test]
    fn clusters_hold_their_leaves_and_no_others() {
        let guess = Guess::new(&Law { gap: Ball::exact(1.178125), restitution: Ball::exact(0.5) });
        let (seen, bundles) = orbit(&guess);
        let window = Window::new(&Indexed::new(&seen), &guess, MIDDLE).expect("a contracting direction");
        let clusters = |cuts| window.clusters(&window.leaves([0.3, 0.02]).expect("leaves"), cuts);
        let holds = |cluster: &Cluster, [xi, eta, _]: [f64; 3]| {
            xi.abs() > 0.3 || cluster.in_coordinates([xi, eta]).iter().all(|x| x.abs() < 1.0)
        };
        let whole = clusters(0b0);
        assert_eq!(whole.len(), 1);
        assert!(bundles.concat().iter().all(|&point| holds(&whole[0], point)));
        // The widest gap is between the bundles.
        let parted = clusters(0b1);
        assert_eq!(parted.len(), 2);
        for (k, cluster) in parted.iter().enumerate() {
            assert!(bundles[k].iter().all(|&point| holds(cluster, point)));
            assert!(bundles[1 - k].iter().all(|&point| point[0].abs() > 0.3 || !holds(cluster, point)));
        }
        assert!(window.base(&parted[0]).is_apart(&window.base(&parted[1])));
    }
}
