//! Strips across an h-set, and what the composed map does to their parts: Lemmas D24-D26 of `docs/proofs/hyperbolic.md#D24`.

use super::sides::Sides;
use crate::chaos::flights::{Flights, is_positive};
use crate::chaos::frame::{Frame, least};
use crate::chaos::guess::Guess;
use crate::chaos::law::{Law, Side};
use crate::chaos::quad::Quad;
use crate::number::{Ball, Number, UNIT, up};

/// The states of an h-set between two straight sides: each is `xi = place + slope eta`, `|eta| <= 1`, both numbers exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StraightStrip {
    /// Place at the middle height and slope of the left side, in the coordinates of the h-set.
    pub left: [f64; 2],
    /// Those of the right side.
    pub right: [f64; 2],
}

/// A word with its strip: where it comes from and leads to, its flights, its whole forcing periods, and whether `xi` grows along it.
#[derive(Clone, Debug)]
pub(crate) struct Branch {
    pub from: usize,
    pub to: usize,
    pub sides: Vec<Side>,
    pub half_turns: i64,
    pub turns: f64,
    pub strip: StraightStrip,
    pub rises: bool,
}

/// The part of a strip with `a` and `eta` within `radii` of `at`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell {
    pub at: [f64; 2],
    pub radii: [f64; 2],
}

/// The image of a cell in the coordinates of the h-set it is mapped to: that of its middle, and what its two half sides become
/// under the derivative at any of its states.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Image {
    pub cell: Cell,
    pub middle: [Ball; 2],
    pub sides: Sides,
    /// Hold the images of the vectors `(1, 0)` and `(0, 1)` of the h-set of the cell, at each state; `None` where they are not known.
    units: Option<[[Ball; 2]; 2]>,
}

/// A cell that has no image: its half sides after the last flight that is enclosed, in forcing periods and over `A W`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lost {
    sides: Sides,
}

impl StraightStrip {
    /// Whether the strip lies in its h-set, and has some breadth everywhere. Lemma D25
    pub fn is_inside(&self) -> bool {
        let is_in = |[place, slope]: [f64; 2]| up(place.abs() + slope.abs()) < 1.0;
        let is_broad = |eta: f64| is_positive(self.breadth(Ball::exact(eta)));
        is_in(self.left) && is_in(self.right) && is_broad(-1.0) && is_broad(1.0)
    }

    /// Whether the strip has no state in common with another strip of the h-set: it is on one side at both ends. Lemma D25
    pub fn is_apart(&self, other: &Self) -> bool {
        let at = |[place, slope]: [f64; 2], eta: f64| Ball::exact(place) + Ball::exact(slope) * Ball::exact(eta);
        let is_right =
            |one: &Self, two: &Self| [-1.0, 1.0].iter().all(|&eta| is_positive(at(one.left, eta) - at(two.right, eta)));
        is_right(self, other) || is_right(other, self)
    }

    /// Approximate places of the left and the right side, at the bottom and at the top.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        [self.left, self.right].map(|[place, slope]| [place - slope, place + slope])
    }

    /// Holds place and slope of the line in the middle, or half of what they change from there to the right side.
    fn halves(&self, sign: f64) -> [Ball; 2] {
        [0, 1].map(|i| Ball::exact(0.5) * (Ball::exact(self.right[i]) + Ball::exact(sign) * Ball::exact(self.left[i])))
    }

    /// Holds the place at `eta = 0` and the slope of the lines with these `a`, from -1 on the left side to 1 on the right one.
    pub fn line(&self, a: Ball) -> [Ball; 2] {
        let ([place, slope], [half, taper]) = (self.halves(1.0), self.halves(-1.0));
        [place + a * half, slope + a * taper]
    }

    /// Holds half of the breadth at heights.
    pub fn breadth(&self, eta: Ball) -> Ball {
        let [half, taper] = self.halves(-1.0);
        half + taper * eta
    }
}

/// `xi - slope eta`
pub(crate) fn beside([xi, eta]: [Ball; 2], slope: Ball) -> Ball {
    xi - slope * eta
}

impl Cell {
    pub const WHOLE: Self = Self { at: [0.0; 2], radii: [1.0; 2] };

    /// Holds the derivatives of `xi` by `a` and by `eta`, at each state of the cell.
    fn slopes(&self, strip: &StraightStrip) -> [Ball; 2] {
        let [a, eta] = [0, 1].map(|i| Ball::new(self.at[i], self.radii[i]));
        [strip.breadth(eta), strip.line(a)[1]]
    }

    /// Holds the images of the vectors `(1, 0)` and `(0, 1)` of the h-set, given those of the half sides. Lemma D26
    fn units(&self, strip: &StraightStrip, sides: &Sides) -> Option<[[Ball; 2]; 2]> {
        let ([breadth, slope], [a, height]) = (self.slopes(strip), self.radii.map(Ball::exact));
        let (a, height) = (Ball::exact(1.0).checked_div(breadth * a)?, Ball::exact(1.0).checked_div(height)?);
        Some([sides.combined(a, Ball::exact(0.0)), sides.combined(-(slope * a), height)])
    }

    /// Halves of the cell, along the strip's breadth or its height: dyadic.
    pub fn halves(&self, axis: usize) -> [Self; 2] {
        [-0.5, 0.5].map(|half| {
            let mut part = *self;
            part.at[axis] += half * self.radii[axis];
            part.radii[axis] *= 0.5;
            part
        })
    }
}

impl Lost {
    /// Axis along which a cell is better halved: the height where its image is not known well beside the breadth.
    pub fn axis(&self) -> usize {
        let size = |[u, w]: [Ball; 2], of: fn(Ball) -> f64| (6.0 * of(u)).hypot(of(w));
        let [breadth, height] = self.sides.both();
        usize::from(4.0 * size(height, Ball::rad) > size(breadth, Ball::mag)) // proposes: any part will do
    }
}

/// A condition on the states after a given number of impacts, by their middle and half sides.
pub(crate) type Passed<'p> = &'p dyn Fn(usize, [Ball; 2], &Sides) -> bool;

/// The reduced map that the flights of a cell follow, and the parallelograms of the h-sets.
pub(crate) struct Map<'m> {
    pub law: &'m Law,
    pub guess: &'m Guess,
    pub frames: &'m [Frame],
}

impl Map<'_> {
    /// Encloses the image of a cell of a word's strip, where each flight is proved to land as the word says. `passed` receives the states
    /// after each impact but the last one, as their middle and half sides, and returns whether to go on. Lemma D24
    pub fn image(&self, branch: &Branch, cell: Cell, passed: Passed<'_>) -> Result<Image, Lost> {
        let (frame, strip) = (&self.frames[branch.from], &branch.strip);
        let [place, slope] = strip.line(Ball::exact(cell.at[0]));
        let eta = Ball::exact(cell.at[1]);
        let mut centre = frame.state(place + slope * eta, eta);
        let ([breadth, slope], [a, height]) = (cell.slopes(strip), cell.radii.map(Ball::exact));
        let mut sides = Sides::new(frame.vector(breadth * a, Ball::exact(0.0)), frame.vector(slope * height, height));
        for (k, &side) in branch.sides.iter().enumerate() {
            let lost = Lost { sides };
            let landing = self.land(centre, &sides, side).ok_or(lost)?;
            let [u, w] = centre.map(|x| Ball::new(0.0, x.rad()));
            let [v, x] = landing.derivative([u, w]);
            let [phase, speed] = landing.centre();
            let before = centre[1].widened(sides.reach(1));
            centre = [phase + v, speed + x];
            sides = sides.landed(&landing, [self.law.restitution, before, centre[1]]);
            if k + 1 < branch.sides.len() && !passed(k + 1, centre, &sides) {
                return Err(Lost { sides });
            }
        }
        let frame = &self.frames[branch.to];
        let seen = frame.place(centre, branch.turns).zip(sides.seen(|vector| frame.coordinates(vector)));
        let image = |(middle, sides)| Image { cell, middle, sides, units: cell.units(strip, &sides) };
        seen.map(image).ok_or(Lost { sides })
    }

    /// All flights from the sums of `centre` and parts of both sides.
    fn land(&self, centre: [Ball; 2], sides: &Sides, side: Side) -> Option<crate::chaos::flights::Landing<2>> {
        let sides = sides.both();
        let middles = sides.map(|side| side.map(Ball::mid));
        let slack = [0, 1].map(|i| up(centre[i].rad() + sides[0][i].rad() + sides[1][i].rad()));
        let state = centre.map(Ball::mid);
        let reach = up(middles[0][1].abs() + middles[1][1].abs() + slack[1]);
        let floor = ((state[1] - reach) * (1.0 - 4.0 * UNIT)).max(0.0); // D24: no speed is negative
        let quad = Quad { centre: state, sides: middles, twist: [0.0; 2], slack, floor };
        let image = self.guess.map(state).filter(|image| image.side == side)?;
        Flights::<2>::moved(self.law, &quad, [[0.0; 2]; 2]).land(side, image.state[0] - side.shift())
    }
}

impl Image {
    /// Holds a coordinate of all images.
    pub fn spread(&self, axis: usize) -> Ball {
        self.middle[axis].widened(self.sides.reach(axis))
    }

    /// Whether no image is in the h-set.
    pub fn is_outside(&self) -> bool {
        is_positive(Ball::exact(least(self.spread(0))) - Ball::exact(1.0))
    }

    /// Holds the image of the vector `(1, slope)` of the h-set it comes from, at each state of the cell. Lemma D26
    pub fn direction(&self, slope: f64) -> Option<[Ball; 2]> {
        let [along, across] = self.units?;
        Some([0, 1].map(|i| along[i] + Ball::exact(slope) * across[i]))
    }
}

impl Image {
    /// Axis along which the cell is better halved.
    pub fn axis(&self) -> usize {
        let size = |side: [Ball; 2], of: fn(Ball) -> f64| of(side[0]).hypot(of(side[1]));
        usize::from(4.0 * size(self.sides.second(), Ball::rad) > size(self.sides.first, Ball::mag)) // proposes: any part will do
    }
}
