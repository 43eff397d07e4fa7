//! Strips across the parallelogram of an h-set, and the images of their cells (Lemma V14).

use impact_pair_document::{ConeWordDocument, Decimal};

use super::super::Law;
use super::super::allowance::{Allowance, End};
use super::super::bases::HSet;
use super::super::beam::{FlightBundle, Spot, State};
use super::super::guess::Guess;
use super::super::span::Span;
use super::super::words::Word;
use super::sides::{Sides, cross};

/// An h-set as the parallelogram of its middle and its half vectors.
#[derive(Clone, Copy, Debug)]
pub(in crate::check::chaos) struct Frame {
    pub centre: State,
    pub along: State,
    pub across: State,
}

/// Between two lines across a parallelogram: each by its place at the middle, and how far that is from there to the top.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    pub left: [f64; 2],
    pub right: [f64; 2],
}

/// A listed word with its strip.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    pub from: usize,
    pub to: usize,
    pub flights: Vec<bool>,
    pub half_cycles: i64,
    pub turns: f64,
    pub strip: Strip,
    /// True if the image goes from left to right.
    pub rises: bool,
}

/// A part of a strip: fractions of the way from left to right, from -1 to 1, and heights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub across: [f64; 2],
    pub heights: [f64; 2],
}

/// The image of the middle of a cell, and those of its half sides under the derivative, in the coordinates of the next h-set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Image {
    pub cell: Cell,
    pub middle: Spot,
    pub sides: Sides,
    /// Hold the images of the vectors `(1, 0)` and `(0, 1)` of the h-set it comes from, at each state; none where they are not known.
    units: Option<[Spot; 2]>,
}

/// The double that is nearest to a number of a witness; `None` if that is not finite.
pub(super) fn double(number: &Decimal) -> Option<f64> {
    // V14: any double will do
    number.text().parse().ok().filter(|number: &f64| number.is_finite())
}

impl Branch {
    /// Reads a listed word with its strip; `None` if numbers are not finite, or if it takes no time, or no whole number of forcing periods.
    pub fn read(word: &Word, document: &ConeWordDocument) -> Option<Self> {
        let side = |[place, lean]: &[Decimal; 2]| Some([double(place)?, double(lean)?]);
        let strip = Strip { left: side(&document.left)?, right: side(&document.right)? };
        let Word { from, to, half_cycles, ref flights } = *word;
        let far = flights.iter().filter(|&&is_far| is_far).count() as i64; // exact: a length
        let half_turns = half_cycles.checked_add(far).filter(|turns| half_cycles > 0 && turns % 2 == 0)?;
        let turns = (half_turns / 2) as f64; // V14: rounded, it is far from all images
        Some(Self { from, to, flights: flights.clone(), half_cycles, turns, strip, rises: document.rises })
    }
}

pub(super) fn spot(x: State) -> Spot {
    x.map(Span::point)
}

/// Returns whether all members are farther from 0 than `most`.
pub(super) fn is_beyond(x: Span, most: Span) -> bool {
    (x - most).is_positive() || (x + most).is_negative()
}

impl Frame {
    pub fn of(HSet { left, right }: &HSet) -> Self {
        let quarter = |f: &dyn Fn(usize) -> f64| [0, 1].map(|i| 0.25 * f(i));
        let (p, q, r, s) = (left.bottom, left.top, right.bottom, right.top);
        Self {
            centre: quarter(&|i| p[i] + q[i] + r[i] + s[i]),
            along: quarter(&|i| r[i] + s[i] - p[i] - q[i]),
            across: quarter(&|i| q[i] + s[i] - p[i] - r[i]),
        }
    }

    /// Coordinates of a vector, `None` if the sides may be parallel.
    pub fn coordinates(&self, vector: Spot) -> Option<Spot> {
        let (along, across) = (spot(self.along), spot(self.across));
        let area = cross(along, across);
        Some([cross(vector, across).over(area)?, cross(along, vector).over(area)?])
    }

    /// Coordinates of a state, a number of forcing periods earlier.
    pub fn place(&self, [u, w]: Spot, turns: f64) -> Option<Spot> {
        let [centre, speed] = spot(self.centre);
        self.coordinates([u - Span::point(turns) - centre, w - speed])
    }

    pub fn vector(&self, xi: Span, eta: Span) -> Spot {
        [0, 1].map(|i| xi.scaled(self.along[i]) + eta.scaled(self.across[i]))
    }

    /// Returns whether its speeds are positive, which those of the h-set need not imply, and its phases within 4 forcing periods of 0.
    pub fn is_near(&self) -> bool {
        let reach = |i: usize| Span::point(self.along[i]).around() + Span::point(self.across[i]).around();
        let [u, w] = [0, 1].map(|i| Span::point(self.centre[i]) + reach(i));
        w.is_positive() && !is_beyond_or_at(u, Span::point(4.0))
    }

    /// Returns whether it has no state in common with another one, a number of forcing periods earlier.
    pub fn is_apart(&self, other: &Self, turns: f64) -> bool {
        let parts = |one: &Self, two: &Self, turns: f64| {
            let (Some(centre), Some(a), Some(b)) = (
                one.place(spot(two.centre), turns),
                one.coordinates(spot(two.along)),
                one.coordinates(spot(two.across)),
            ) else {
                return false;
            };
            (0..2).any(|i| is_beyond(centre[i], Span::point(1.0) + a[i].around() + b[i].around()))
        };
        parts(self, other, turns) || parts(other, self, -turns)
    }
}

impl Strip {
    /// The place and the lean of the line at a fraction of the way from left to right.
    pub fn line(&self, at: Span) -> Spot {
        let ends = |i: usize| [self.left, self.right].map(|side| Span::point(side[i]).scaled(0.5));
        [0, 1].map(|i| {
            let [left, right] = ends(i);
            left + right + at * (right - left)
        })
    }

    /// Half of the way from left to right at some heights.
    pub fn half(&self, heights: Span) -> Span {
        let [place, lean] = [0, 1].map(|i| (Span::point(self.right[i]) - Span::point(self.left[i])).scaled(0.5));
        place + lean * heights
    }

    /// Returns whether it lies in its parallelogram and is nowhere empty.
    pub fn is_sound(&self) -> bool {
        let one = Span::point(1.0);
        let is_in = |[place, lean]: [f64; 2]| !is_beyond_or_at(Span::point(place), one - Span::point(lean).around());
        is_in(self.left) && is_in(self.right) && self.half(Span::new(-1.0, 1.0)).is_positive()
    }

    /// Returns whether it has no state in common with another one: at both ends it is on the same side of that one.
    pub fn is_apart(&self, other: &Self) -> bool {
        let at = |[place, lean]: [f64; 2], end: f64| Span::point(place) + Span::point(lean).scaled(end);
        let is_before = |one: &Self, two: &Self| {
            [-1.0, 1.0].iter().all(|&end| (at(two.left, end) - at(one.right, end)).is_positive())
        };
        is_before(self, other) || is_before(other, self)
    }
}

/// Returns whether a member may be `most` or farther from 0.
fn is_beyond_or_at(x: Span, most: Span) -> bool {
    !((most - x).is_positive() && (most + x).is_positive())
}

impl Cell {
    pub const WHOLE: Self = Self { across: [-1.0, 1.0], heights: [-1.0, 1.0] };

    pub fn halves(&self, is_height: bool) -> [Self; 2] {
        let cut = |[a, b]: [f64; 2]| {
            let middle = 0.5 * (a + b);
            [[a, middle], [middle, b]]
        };
        if is_height {
            cut(self.heights).map(|heights| Self { heights, ..*self })
        } else {
            cut(self.across).map(|across| Self { across, ..*self })
        }
    }

    /// Some middle, and half sides that hold what is left of it on both sides.
    pub fn centred([a, b]: [f64; 2]) -> [Span; 2] {
        let middle = Span::point(0.5 * (a + b));
        let half = (Span::point(b) - middle).hull(middle - Span::point(a));
        [middle, Span::point(half.hi())]
    }

    /// The half breadth and the half height of a cell, and the changes of its place with both at all its states.
    fn rates(&self, strip: &Strip) -> [Spot; 2] {
        let ([_, across], [_, height]) = (Self::centred(self.across), Self::centred(self.heights));
        let [a, b] = [self.across, self.heights].map(|[low, high]| Span::new(low, high));
        [[across, height], [strip.half(b), strip.line(a)[1]]]
    }

    /// Holds the images of the vectors `(1, 0)` and `(0, 1)` of the h-set, given those of the half sides.
    fn units(&self, strip: &Strip, sides: &Sides) -> Option<[Spot; 2]> {
        let ([[a, b], [breadth, lean]], one) = (self.rates(strip), Span::point(1.0));
        let (a, b) = (one.over(breadth * a)?, one.over(b)?);
        Some([sides.combined(a, Span::point(0.0)), sides.combined(-(lean * a), b)])
    }
}

/// The law, the h-sets and the work allowed, with which flights are followed.
pub(super) struct Map<'m> {
    pub law: &'m Law,
    pub guess: &'m Guess,
    pub frames: &'m [Frame],
    pub work: &'m Allowance<'m>,
}

/// A condition on the states after some flights, from their number, centre and half sides; an image that fails it is given up.
pub(super) type Passed<'p> = &'p dyn Fn(usize, Spot, &Sides) -> bool;

impl Map<'_> {
    /// Returns the image of a cell of a word's strip; or else its half sides as far as they were known.
    pub fn image(&self, branch: &Branch, cell: Cell, passed: Passed<'_>) -> Result<Result<Image, Sides>, End> {
        let (frame, strip) = (&self.frames[branch.from], &branch.strip);
        let ([at, _], [height, _]) = (Cell::centred(cell.across), Cell::centred(cell.heights));
        let [place, lean] = strip.line(at);
        let offset = frame.vector(place + lean * height, height);
        let mut centre = [0, 1].map(|i| Span::point(frame.centre[i]) + offset[i]);
        let [[a, b], [breadth, lean]] = cell.rates(strip);
        let mut sides = Sides::new(frame.vector(breadth * a, Span::point(0.0)), frame.vector(lean * b, b));
        for (k, &is_far) in branch.flights.iter().enumerate() {
            let middle = centre.map(Span::mid);
            let Some(image) = self.guess.map(middle).filter(|image| image.is_far == is_far) else {
                return Ok(Err(sides));
            };
            self.work.spend(4, image.time)?;
            let around = [0, 1].map(|i| (centre[i] - Span::point(middle[i])).around());
            let [phase, speed] = [0, 1].map(|i| Span::point(middle[i]) + around[i] + sides.spread(i));
            // V14: they have landed, so no speed is negative
            let speed = if speed.lo() < 0.0 { Span::new(0.0, speed.hi()) } else { speed };
            let beam = FlightBundle::of(self.law, [phase, speed], spot(middle), [sides.first, sides.second(), around]);
            let Some(landing) = beam.land(is_far, image.time) else { return Ok(Err(sides)) };
            let (moved, by) = (landing.image(), landing.derivative(around));
            centre = [0, 1].map(|i| moved[i] + by[i]);
            sides = sides.landed(&landing, (self.law.restitution, speed), centre);
            if k + 1 < branch.flights.len() && !passed(k + 1, centre, &sides) {
                return Ok(Err(sides));
            }
        }
        let frame = &self.frames[branch.to];
        let seen = frame.place(centre, branch.turns).zip(sides.seen(|vector| frame.coordinates(vector)));
        Ok(seen.map(|(middle, sides)| Image { cell, middle, sides, units: cell.units(strip, &sides) }).ok_or(sides))
    }
}

impl Image {
    /// Holds a coordinate of all images.
    pub fn all(&self, i: usize) -> Span {
        self.middle[i] + self.sides.spread(i)
    }

    pub fn is_outside(&self) -> bool {
        is_beyond(self.all(0), Span::point(1.0))
    }

    /// Holds the images of `(1, slope)` at each state of the cell.
    pub fn direction(&self, slope: f64) -> Option<Spot> {
        let [along, across] = self.units?;
        Some([0, 1].map(|i| along[i] + across[i].scaled(slope)))
    }
}

/// Returns whether a cell is better halved in its height: any answer will do.
pub(super) fn is_tall(sides: &Sides) -> bool {
    let [most, width] = [sides.first.map(Span::most), sides.second().map(|x| 0.5 * (x.hi() - x.lo()))];
    4.0 * (width[0] + width[1]) > most[0] + most[1]
}

#[cfg(test)]
mod tests {
    use super::super::super::bases::Chord;
    use super::*;

    /// Speeds from 0.01 on, but the parallelogram has a corner at -0.09.
    #[test]
    fn r39_a_parallelogram_has_positive_speeds_only() {
        let base = |top: f64| HSet {
            left: Chord { bottom: [0.0, 0.01], top: [0.0, top] },
            right: Chord { bottom: [0.1, 0.01], top: [0.1, 0.1] },
        };
        let (steep, even) = (base(0.5), base(0.1));
        assert!(steep.is_sound() && even.is_sound());
        assert!(Frame::of(&even).is_near() && !Frame::of(&steep).is_near());
    }

    /// `N F` from an h-set to itself within `half_cycles` and a half: a whole number of forcing periods, or not.
    #[test]
    fn a_word_takes_whole_forcing_periods_and_its_strip_has_numbers() {
        let number = |text: &str| serde_json::from_str::<Decimal>(&format!("\"{text}\"")).expect("a decimal");
        let read = |half_cycles: i64, place: &str| {
            let word = Word { from: 0, to: 0, half_cycles, flights: vec![false, true] };
            let [left, right] = [place, "0.5"].map(|place| [number(place), number("0.001")]);
            Branch::read(&word, &ConeWordDocument { left, right, rises: true, counts: true })
        };
        assert_eq!(read(3, "0.25").map(|branch| (branch.turns, branch.strip.left)), Some((2.0, [0.25, 0.001])));
        assert!(read(4, "0.25").is_none() && read(-1, "0.25").is_none() && read(i64::MAX, "0.25").is_none());
        assert!(read(3, "1e400").is_none());
    }

    #[test]
    fn strips_are_apart_or_not_and_in_their_parallelogram_or_not() {
        let strip = |middle: f64, lean: f64| Strip { left: [middle - 0.1, lean], right: [middle + 0.1, lean] };
        assert!(strip(0.0, 0.0).is_apart(&strip(0.21, 0.005)) && strip(0.21, 0.005).is_apart(&strip(0.0, 0.0)));
        assert!(!strip(0.0, 0.0).is_apart(&strip(0.21, 0.02)) && !strip(0.0, 0.0).is_apart(&strip(0.0, 0.0)));
        assert!(strip(0.5, 0.3).is_sound() && !strip(0.8, 0.15).is_sound() && !strip(-0.8, 0.15).is_sound());
        let crossed = Strip { left: [0.0, 0.2], right: [0.1, 0.0] };
        assert!(!crossed.is_sound() && !Strip { left: [0.2, 0.0], right: [0.1, 0.0] }.is_sound());
    }
}
