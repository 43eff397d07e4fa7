//! Patches of states that make up a part of a strip, and the parallelograms that hold their images (Lemma V39).

use std::f64::consts::TAU;

use super::super::Law;
use super::super::beam::{FlightBundle, Landing, Spot, State};
use super::super::cones::Frame;
use super::super::guess::{Image, applied};
use super::super::span::Span;
use super::curve::Heights;
use super::side::Strip;

/// A part of a strip from side to side, from -1 to 1: a side has no breadth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Band {
    pub from: f64,
    pub to: f64,
}

/// States `centre + a sides[0] + b sides[1] + c moved[0] + d moved[1]` with `|a|, |b| <= 1`: `a` along the strip, `b` from bottom to top, `c` and `d` from -1
/// to 1 for `e` and `D`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    pub centre: Spot,
    pub sides: [Spot; 2],
    pub moved: [State; 2],
    /// The direction of the sides of the strip there, in doubles.
    pub upward: State,
}

/// All images of a patch, and the directions of a parallelogram that holds them: one that flights expand and one that they contract.
#[derive(Clone, Copy)]
pub(super) struct Flown {
    pub landing: Landing,
    pub directions: [State; 2],
    pub moved: [State; 2],
    pub upward: State,
}

/// Where images are longer, or thicker, than the derivative in the middle makes them times this, their patch is cut; not where they are thin.
const MAX_EXCESS: f64 = 1.5;
const THIN: f64 = 0.02;
/// Images of neighbours share a parallelogram that is not longer than this times the longer one of theirs.
const MAX_GROWTH: f64 = 1.15;

/// The length of a vector, phases in radians.
pub(super) fn length([u, w]: State) -> f64 {
    (TAU * u).hypot(w)
}

pub(super) fn unit(vector: State) -> State {
    let length = length(vector);
    vector.map(|x| x / length)
}

fn cross<T: Copy + std::ops::Mul<Output = T> + std::ops::Sub<Output = T>>([a, b]: [T; 2], [c, d]: [T; 2]) -> T {
    a * d - b * c
}

impl Band {
    pub fn halves(&self) -> [Self; 2] {
        let middle = 0.5 * (self.from + self.to); // V39: exact
        [Self { to: middle, ..*self }, Self { from: middle, ..*self }]
    }

    /// The states of the strip there at some heights. A line between both sides bulges at most as the one that bulges more.
    pub fn states(&self, frame: &Frame, strip: &Strip, heights: &Heights) -> Patch {
        let Strip { left, right } = strip;
        let bulge = left.bulge(heights).hull(right.bulge(heights));
        let weights = |at: f64| [0.5 * (1.0 - at), 0.5 * (1.0 + at)]; // exact: dyadic fractions
        let [p, q] = weights(0.5 * (self.from + self.to));
        let [a, b] = [left, right].map(|side| side.moves(0.5 * (heights.low + heights.high)));
        let moves = [0, 1].map(|k| p * a[k] + q * b[k]);
        let place = |at: f64, height: f64| {
            let [p, q] = weights(at).map(Span::point);
            let [a, b] = [left, right].map(|side| side.at(Span::point(height)) + side.rest(height, moves));
            p * a + q * b + bulge
        };
        // At both heights half of the way between the outer ends, and the middle.
        let at = |height: f64| {
            let [a, b] = [place(self.from, height).lo(), place(self.to, height).hi()].map(Span::point);
            [(b - a).scaled(0.5), (a + b).scaled(0.5)]
        };
        let [[half, low], [other, high]] = [heights.low, heights.high].map(at);
        let [middle, rise] = [(low + high).scaled(0.5), (high - low).scaled(0.5)];
        let [bottom, top] = [heights.low, heights.high].map(Span::point);
        let offset = frame.vector(middle, (bottom + top).scaled(0.5));
        let moved = [moves[1], moves[0]].map(|by| frame.along.map(|x| by * x));
        // What the moves are rounded by.
        let rounded =
            |k: usize, i: usize| Span::point(moves[1 - k]) * Span::point(frame.along[i]) - Span::point(moved[k][i]);
        let error = |i: usize| rounded(0, i).around() + rounded(1, i).around();
        let centre = [0, 1].map(|i| Span::point(frame.centre[i]) + offset[i] + error(i));
        let longest = Span::point(half.hull(other).hi());
        let sides = [frame.vector(longest, Span::point(0.0)), frame.vector(rise, (top - bottom).scaled(0.5))];
        let slope = rise.mid() / (0.5 * (heights.high - heights.low));
        let upward = [0, 1].map(|i| slope * frame.along[i] + frame.across[i]);
        Patch { centre, sides, moved, upward }
    }
}

impl Patch {
    /// Returns both halves: left and right, or below and above.
    pub fn halves(&self, is_tall: bool) -> [Self; 2] {
        let Self { centre, mut sides, .. } = *self;
        let cut = sides[usize::from(is_tall)].map(|x| x.scaled(0.5)); // exact: 0 or 1
        sides[usize::from(is_tall)] = cut; // exact: 0 or 1
        [-1.0, 1.0].map(|at| Self { centre: [0, 1].map(|i| centre[i] + cut[i].scaled(at)), sides, ..*self })
    }

    /// Some state about its middle.
    pub fn middle(&self) -> State {
        self.centre.map(Span::mid)
    }

    /// About its half length, and half of its height.
    pub fn half(&self, axis: usize) -> State {
        self.sides[axis].map(Span::mid)
    }

    pub fn flights(&self, law: &Law) -> FlightBundle {
        let [by_restitution, by_gap] = self.moved.map(|by| by.map(Span::point));
        let [g, h] = self.sides;
        let all = [g, h, by_restitution, by_gap];
        let bounds = [0, 1].map(|i| all.iter().fold(self.centre[i], |sum, side| sum + side[i].around()));
        FlightBundle::moved(law, bounds, self.centre, [g, h, by_gap], by_restitution)
    }

    /// Whether its images are about as long and as thick as the derivative in its middle makes them, or no longer than that is allowed.
    pub fn is_small(&self, image: &Image, flown: &Flown, allowed: f64) -> bool {
        let [g, h] = flown.directions;
        let area = cross(g, h).abs();
        let images = [0, 1].map(|axis| applied(image.jacobian, self.half(axis)));
        let long = cross(images[0], h).abs() / area;
        let thick = images.iter().map(|side| cross(g, *side).abs()).sum::<f64>() / area;
        flown.reach(flown).is_some_and(|[x, y]| {
            let is_short = x <= MAX_EXCESS * long.max(allowed); // proposes: any patches will do
            // A side may be thick: it is not cut from side to side.
            is_short && (allowed > 0.0 || y <= MAX_EXCESS * thick || y <= THIN * x)
        })
    }
}

impl Flown {
    /// The middle between the images of two patches.
    fn middle(&self, other: &Self) -> State {
        [0, 1].map(|i| 0.5 * (self.landing.centre[i].mid() + other.landing.centre[i].mid()))
    }

    /// The directions between those of two patches.
    fn directions(&self, other: &Self) -> [State; 2] {
        [0, 1].map(|k| [0, 1].map(|i| 0.5 * (self.directions[k][i] + other.directions[k][i])))
    }

    /// How parameters move what is between both.
    fn moves(&self, other: &Self) -> [State; 2] {
        [0, 1].map(|k| [0, 1].map(|i| 0.5 * (self.moved[k][i] + other.moved[k][i])))
    }

    /// Half the sides of a parallelogram about the middle, which moves with the parameters, that holds all images of both.
    fn reach(&self, other: &Self) -> Option<[f64; 2]> {
        let moved = self.moves(other).map(|by| by.map(Span::point));
        let centre = self.middle(other).map(Span::point);
        let [g, h] = self.directions(other).map(|direction| direction.map(Span::point));
        let area = cross(g, h);
        let along = |normal: Spot| {
            let all = self.landing.beside(normal, centre, moved).hull(other.landing.beside(normal, centre, moved));
            Some(all.over(area)?.most()).filter(|size| size.is_finite())
        };
        Some([along([h[1], -h[0]])?, along([-g[1], g[0]])?])
    }

    /// The parallelogram that holds all images of both.
    fn around(&self, other: &Self, reach: [f64; 2]) -> Patch {
        let [g, h] = self.directions(other);
        let side = |direction: State, size: f64| direction.map(|x| Span::point(x) * Span::point(size));
        let centre = self.middle(other).map(Span::point);
        let upward = [0, 1].map(|i| 0.5 * (self.upward[i] + other.upward[i]));
        Patch { centre, sides: [side(g, reach[0]), side(h, reach[1])], moved: self.moves(other), upward }
    }
}

/// Parallelograms that hold all images of some patches, one above the other: one for two of them where it is not much longer.
pub(super) fn onward(images: &[Flown], allowed: f64) -> Option<Vec<Patch>> {
    let mut patches = Vec::with_capacity(images.len());
    let mut rest = images;
    while let [one, others @ ..] = rest {
        let own = one.reach(one)?;
        let both = others.first().and_then(|two| Some((two, one.reach(two)?)));
        // proposes: any parallelograms will do
        match both.filter(|(_, [x, _])| *x < MAX_GROWTH * own[0].max(allowed)) {
            Some((two, reach)) => {
                patches.push(one.around(two, reach));
                rest = &others[1..];
            }
            None => {
                patches.push(one.around(one, own));
                rest = others;
            }
        }
    }
    Some(patches)
}
