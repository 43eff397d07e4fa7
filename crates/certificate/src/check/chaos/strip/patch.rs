//! Patches of states that make up a part of a strip, and the parallelograms that hold their images (Lemma V39).

use std::f64::consts::TAU;

use super::super::Law;
use super::super::beam::{FlightBundle, Landing, Quad, Spot, State};
use super::super::cones::Frame;
use super::super::guess::{Image, applied};
use super::super::span::Span;
use super::side::{Heights, Strip};

/// A part of a strip from side to side, from -1 to 1: a side has no breadth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Band {
    pub from: f64,
    pub to: f64,
}

/// States `centre + a sides[0] + b sides[1] + ab sides[2]` with `|a|, |b| <= 1`: `a` along the strip, `b` from bottom to top.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    pub centre: Spot,
    pub sides: [Spot; 3],
    /// The direction of the sides of the strip there, in doubles.
    pub upward: State,
}

/// All images of a patch, and the directions of a parallelogram that holds them: one that flights expand and one that they contract.
#[derive(Clone, Copy)]
pub(super) struct Flown {
    pub landing: Landing,
    pub directions: [State; 2],
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
        let bulge = strip.left.bulge(heights).hull(strip.right.bulge(heights));
        let place = |at: f64, height: f64| {
            let [left, right] = [&strip.left, &strip.right].map(|side| side.at(Span::point(height)));
            // exact: dyadic fractions
            (left * Span::point(0.5 * (1.0 - at)) + right * Span::point(0.5 * (1.0 + at))) + bulge
        };
        let corner = |place: f64, height: f64| {
            let offset = frame.vector(Span::point(place), Span::point(height));
            [0, 1].map(|i| Span::point(frame.centre[i]) + offset[i])
        };
        let Heights { low, high } = *heights;
        let corners = [
            corner(place(self.from, low).lo(), low),
            corner(place(self.from, high).lo(), high),
            corner(place(self.to, low).hi(), low),
            corner(place(self.to, high).hi(), high),
        ];
        let slope = (place(self.from, high).mid() - place(self.from, low).mid()) / (high - low);
        let upward = [0, 1].map(|i| slope * frame.along[i] + frame.across[i]);
        let quad = Quad { corners };
        Patch { centre: quad.centre(), sides: quad.sides(), upward }
    }
}

impl Patch {
    /// Returns both halves: left and right, or below and above.
    pub fn halves(&self, is_tall: bool) -> [Self; 2] {
        let Self { centre, sides: [g, h, k], .. } = *self;
        let (cut, other) = if is_tall { (h, g) } else { (g, h) };
        [-0.5, 0.5].map(|at| {
            let moved = |from: Spot, by: Spot| [0, 1].map(|i| from[i] + by[i].scaled(at));
            let (half, beside, twist) = (cut.map(|x| x.scaled(0.5)), moved(other, k), k.map(|x| x.scaled(0.5)));
            let sides = if is_tall { [beside, half, twist] } else { [half, beside, twist] };
            Self { centre: moved(centre, cut), sides, ..*self }
        })
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
        let bounds = [0, 1].map(|i| self.sides.iter().fold(self.centre[i], |sum, side| sum + side[i].around()));
        FlightBundle::of(law, bounds, self.centre, self.sides)
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

    /// Half the sides of a parallelogram about the middle that holds all images of both.
    fn reach(&self, other: &Self) -> Option<[f64; 2]> {
        let centre = self.middle(other).map(Span::point);
        let [g, h] = self.directions(other).map(|direction| direction.map(Span::point));
        let area = cross(g, h);
        let along = |normal: Spot| {
            let all = self.landing.along(normal, centre).hull(other.landing.along(normal, centre));
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
        Patch { centre, sides: [side(g, reach[0]), side(h, reach[1]), [Span::point(0.0); 2]], upward }
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
