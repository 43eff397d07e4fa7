//! That a strip is mapped across an h-set, set by set: Lemma D34 of `docs/proofs/chaos.md#D34`.

use super::curve::{Heights, Part};
use super::{Sides, turns};
use crate::chaos::flights::{Flights, Landing, is_positive};
use crate::chaos::frame::{Frame, cross};
use crate::chaos::guess::Guess;
use crate::chaos::law::Law;
use crate::chaos::quad::{Chord, Quad, State};
use crate::chaos::tube::{edge, left};
use crate::chaos::vector::{self, applied, length, unit};
use crate::chaos::words::{HSet, Path};
use crate::number::{Ball, Number, TINY, UNIT, up};

/// Flights of the sets of a strip at most: some tenths of a second.
const MOST_FLIGHTS: usize = 1 << 18;
/// The least half breadth of a band at the start, how often one is halved after some flights, and a set in height.
const LEAST_RADIUS: f64 = 1.0 / (1 << 20) as f64; // exact: a power of two
const LATER_HALVINGS: u32 = 10;
const HEIGHT_HALVINGS: u32 = 8;
/// Halvings of an interval of a parameter.
const PARAMETER_HALVINGS: u32 = 10;
/// In a longer row parallelograms have a side along the sides of the strip, if that makes them small: this direction is known well after few flights.
/// In a shorter one they have a side in the direction that the flights to come contract. The other one is tried next.
const LONG_ROW: usize = 64;
/// A slice bulges at most by this part of a band's breadth, or of that of a strip times `BROAD`; and there are no more slices than that.
const STRAIGHT: f64 = 1.0 / 8.0;
const BROAD: f64 = 1.0 / 16.0;
const MOST_SLICES: usize = 1 << 13;
/// Two sets in a row become one where that is not longer than the longer one times this.
const MERGED: f64 = 1.15;
/// A set is cut where its images are longer or thicker than the derivative at its centre makes them, times this; not where they are thinner than
/// this part of their length.
const LONGER: f64 = 1.5;
const THIN: f64 = 0.02;
/// How long images of parts of a side may be, those of half the strip being 1: what is tried first, and last, and one after the other.
const SIDE_ROOM: [f64; 2] = [1.0 / 64.0, 1.0 / (1 << 20) as f64]; // exact: powers of two
const LESS_ROOM: f64 = 0.25;
/// Parts of parameters that are narrower, for their size, are not halved: nothing is gained.
const NARROW: f64 = 1e-9;

/// A part of a strip from side to side: a middle and a half breadth, that of the strip being 1. A side has no breadth.
#[derive(Clone, Copy, Debug)]
struct Band {
    at: f64,
    radius: f64,
    /// How long images may be though the band is narrower, those of half the strip being 1.
    room: f64,
}

/// Where images are to be.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Goal {
    /// Between bottom and top of the h-set.
    Between,
    /// Beyond its left edge, or beyond its right one.
    Left,
    Right,
}

/// The flight of a set's centre, in floating point.
struct Step {
    /// How long images of narrower sets may be.
    room: f64,
    /// The direction of the image of the expanding direction, and one that the flights from there on contract.
    axes: [State; 2],
}

/// A word, and what it leads across.
#[derive(Clone, Copy)]
pub(super) struct Covering<'c> {
    /// The h-set that is covered.
    pub base: &'c HSet,
    /// Coordinates of the h-set it comes from, and of the one that is covered.
    pub frames: [&'c Frame; 2],
    pub path: &'c Path,
}

/// The proof of a word by a strip for some values of the parameters.
struct Cover<'c> {
    law: Law,
    guess: Guess,
    sides: Sides,
    word: Covering<'c>,
    /// Flights so far, of all values.
    flights: usize,
}

/// Sets in a row from bottom to top after some impacts of a word, to be followed on.
struct Row {
    impacts: usize,
    sets: Vec<Set>,
}

/// States, and the direction of the sides of the strip there, in floating point.
#[derive(Clone, Copy)]
struct Set {
    quad: Quad,
    /// How `e` and `D` displace the states, each by its radius.
    moved: [State; 2],
    tangent: State,
}

/// The images of a set, and directions along the strip and across.
#[derive(Clone, Copy)]
struct Flown {
    landing: Landing<2>,
    axes: [State; 2],
    moved: [State; 2],
    tangent: State,
}

impl Set {
    fn part(&self, at: State, radii: State) -> Self {
        Self { quad: self.quad.part(at, radii), ..*self }
    }
}

impl Band {
    fn halves(&self) -> [Self; 2] {
        [0.5, -0.5].map(|half| Self { at: self.at + half * self.radius, radius: 0.5 * self.radius, ..*self }) // exact: dyadic
    }
}

impl Covering<'_> {
    /// Whether for all parameters all states of the strip have the word's flights and land between bottom and top of the h-set, and its sides beyond its
    /// edges: the left one beyond the left edge if the image `rises`, else beyond the right one. Lemma D34
    pub fn is_proved(&self, law: &Law, strip: &Sides, rises: bool) -> bool {
        let mut flights = 0;
        let mut open = vec![(Part::ALL, 0)];
        while let Some((part, halvings)) = open.pop() {
            let (own, shift) = part.of(law);
            let sides = Sides { left: strip.left.on(shift), right: strip.right.on(shift) };
            let mut cover = Cover { law: own, guess: Guess::new(&own), sides, word: *self, flights };
            let is_there = cover.is_proved(rises);
            flights = cover.flights;
            if is_there {
                continue;
            }
            let widths = [own.gap, own.restitution].map(|all| all.rad() / all.mid());
            let widest = usize::from(widths[1] > widths[0]); // proposes: any parts will do
            let is_narrow = widths[widest] < NARROW || halvings == PARAMETER_HALVINGS;
            // proposes: when to give up, nothing is certified
            if is_narrow || flights > MOST_FLIGHTS {
                return false;
            }
            open.extend(part.halves(widest).map(|half| (half, halvings + 1)));
        }
        true
    }
}

impl Cover<'_> {
    fn is_proved(&mut self, rises: bool) -> bool {
        let [left, right] = if rises { [Goal::Left, Goal::Right] } else { [Goal::Right, Goal::Left] };
        self.is_side_mapped(-1.0, left) && self.is_side_mapped(1.0, right) && self.is_between()
    }

    fn is_side_mapped(&mut self, at: f64, goal: Goal) -> bool {
        let mut room = SIDE_ROOM[0];
        while room >= SIDE_ROOM[1] {
            if self.is_mapped(Band { at, radius: 0.0, room }, goal) {
                return true;
            }
            room *= LESS_ROOM;
        }
        false
    }

    fn is_between(&mut self) -> bool {
        let mut bands = vec![Band { at: 0.0, radius: 1.0, room: 0.0 }];
        while let Some(band) = bands.pop() {
            if self.is_mapped(band, Goal::Between) {
                continue;
            }
            // proposes: when to give up, nothing is certified
            if self.flights > MOST_FLIGHTS || band.radius < LEAST_RADIUS {
                return false;
            }
            bands.extend(band.halves());
        }
        true
    }

    /// Equally high parts of the strip in which its sides are nearly straight; `None` if there would be too many.
    fn slices(&self, band: &Band) -> Option<Vec<Heights>> {
        let Sides { left, right } = &self.sides;
        let mut slices = vec![Heights::of(self.word.frames[0].tall)];
        loop {
            let is_straight = |slice: &Heights| {
                let [a, b] = [left, right].map(|curve| curve.at(slice.all()).mid());
                let bulge = left.bulge(slice).max(right.bulge(slice)); // proposes: how many slices
                bulge <= STRAIGHT * band.radius.max(band.room).min(BROAD) * (b - a) // proposes: how many slices
            };
            if slices.iter().all(is_straight) {
                return Some(slices);
            }
            if slices.len() == MOST_SLICES {
                return None;
            }
            slices = slices.iter().flat_map(Heights::halves).collect();
        }
    }

    /// Whether all states of a band are proved to land where they are to be. A band is halved after some flights where that is needed; a side is not, as it
    /// is not known where it lies within its sets.
    fn is_mapped(&mut self, band: Band, goal: Goal) -> bool {
        let Some(slices) = self.slices(&band) else { return false };
        let sets = slices.iter().map(|slice| self.cell(slice, &band)).collect();
        let mut open = vec![(Row { impacts: 0, sets }, 0)];
        let room = self.breadth(&slices[slices.len() / 2]).map(|x| band.room * x);
        while let Some((sets, halvings)) = open.pop() {
            let Err(Row { impacts, sets }) = self.follow(sets, (goal, room)) else { continue };
            if impacts == 0 || goal != Goal::Between || halvings == LATER_HALVINGS || self.flights > MOST_FLIGHTS {
                return false;
            }
            for half in [0.5, -0.5] {
                let sets = sets.iter().map(|set| set.part([half, 0.0], [0.5, 1.0])).collect();
                open.push((Row { impacts, sets }, halvings + 1));
            }
        }
        true
    }

    /// Proves that all states of a row have the rest of the word's flights and land where they are to be; or else returns the row after the last impact
    /// at which it is known.
    fn follow(&mut self, Row { mut impacts, mut sets }: Row, (goal, room): (Goal, State)) -> Result<(), Row> {
        let steps = self.seen(impacts, &sets[sets.len() / 2].quad, room);
        if steps.len() + impacts < self.word.path.sides.len() {
            return Err(Row { impacts, sets });
        }
        for step in &steps {
            let is_last = impacts + 1 == self.word.path.sides.len();
            let goal = is_last.then_some(goal);
            let is_long = sets.len() > LONG_ROW;
            let mut all = Vec::with_capacity(sets.len());
            for set in &sets {
                let Some(flown) = self.flown(impacts, set, (step, is_long), goal) else {
                    return Err(Row { impacts, sets });
                };
                all.extend(flown);
            }
            if is_last {
                return Ok(());
            }
            let Some(next) = merged(&all, step.room) else { return Err(Row { impacts, sets }) };
            sets = next;
            impacts += 1; // exact: a count
        }
        Err(Row { impacts, sets })
    }

    /// The landings of the parts of a set; `None` where they are not known, or their images too long or too thick, so that it is better cut from side to side.
    fn flown(
        &mut self,
        impacts: usize,
        set: &Set,
        (step, is_long): (&Step, bool),
        goal: Option<Goal>,
    ) -> Option<Vec<Flown>> {
        let side = self.word.path.sides[impacts];
        let mut all = Vec::new();
        let mut open = vec![(*set, 0)];
        while let Some((set, halvings)) = open.pop() {
            self.flights += 1; // exact: a count
            let quad = &set.quad;
            let flown = self.guess.map(quad.centre).filter(|image| image.side == side).and_then(|image| {
                let landing = Flights::moved(&self.law, quad, set.moved).land(side, image.state[0] - side.shift())?;
                let [by_gap, by_restitution] = image.moved;
                let moved = [0, 1].map(|k| {
                    let [u, w] = applied(image.jacobian, set.moved[k]);
                    let [v, x] = [by_restitution, by_gap][k];
                    [u + v, w + x]
                });
                let tangent = unit(applied(image.jacobian, set.tangent));
                let [expanding, contracted] = step.axes;
                let along = |across: State| Flown { landing, axes: [expanding, across], moved, tangent };
                let known = if is_long { [tangent, contracted] } else { [contracted, tangent] };
                let is_good = |flown: &Flown| match goal {
                    Some(goal) => self.is_at(&landing, goal),
                    None => is_linear(quad, image.jacobian, flown, step.room),
                };
                known.map(along).into_iter().find(is_good)
            });
            match flown {
                Some(flown) => all.push(flown),
                None if halvings < HEIGHT_HALVINGS
                    && length(quad.sides[1]) > 0.25 * length(quad.sides[0])
                    && self.flights <= MOST_FLIGHTS =>
                {
                    open.extend([0.5, -0.5].map(|half| (set.part([0.0, half], [1.0, 0.5]), halvings + 1)));
                }
                None => return None,
            }
        }
        Some(all)
    }

    /// About half of the strip from side to side, at some heights.
    fn breadth(&self, slice: &Heights) -> State {
        let [a, b] = [&self.sides.left, &self.sides.right].map(|curve| curve.at(slice.all()).mid());
        self.word.frames[0].along.map(|x| 0.5 * (b - a) * x)
    }

    /// Holds the states of a band at some heights, for all parameters.
    fn cell(&self, slice: &Heights, band: &Band) -> Set {
        let Sides { left, right } = &self.sides;
        let bulge = left.bulge(slice).max(right.bulge(slice)); // D34: lines between both are between these
        let parts = |at: f64| [0.5 * (1.0 - at), 0.5 * (1.0 + at)]; // exact: dyadic
        let between = |at: f64, [a, b]: [f64; 2]| parts(at)[0] * a + parts(at)[1] * b;
        let [a, b] = [left, right].map(|curve| curve.moved(0.5 * (slice.low + slice.high)));
        let by = [0, 1].map(|k| between(band.at, [a[k], b[k]]));
        let place = |at: f64, height: f64| {
            let [a, b] = [left, right].map(|curve| curve.at(Ball::exact(height)).widened(curve.rest(height, by)));
            let [p, q] = parts(at).map(Ball::exact);
            (p * a + q * b).widened(bulge)
        };
        let frame = self.word.frames[0];
        let corner = |at: f64, outward: f64, height: f64| {
            frame.state(Ball::exact(bound(place(at, height), outward)), Ball::exact(height))
        };
        let edge = |at: f64, outward: f64| [slice.low, slice.high].map(|height| corner(at, outward, height));
        let corners = [edge(band.at - band.radius, -1.0), edge(band.at + band.radius, 1.0)];
        let chord = |[bottom, top]: [[Ball; 2]; 2]| Chord { bottom: bottom.map(Ball::mid), top: top.map(Ball::mid) };
        let quad = Quad::between(&chord(corners[0]), &chord(corners[1]));
        // By `e` and by `D`.
        let moved = [by[1], by[0]].map(|by| frame.along.map(|x| by * x));
        let rounded = |axis: usize| UNIT * (moved[0][axis].abs() + moved[1][axis].abs()) + TINY;
        let error = |axis: usize| corners.as_flattened().iter().map(|corner| corner[axis].rad()).fold(0.0, f64::max); // D34: the farthest corner
        let slack = [0, 1].map(|axis| up(quad.slack[axis] + error(axis) + rounded(axis)));
        let down = up(error(1) + rounded(1) + moved[0][1].abs() + moved[1][1].abs());
        let quad = Quad { slack, floor: (quad.floor - down).next_down(), ..quad };
        let middle = |height: f64| place(band.at, height).mid();
        let slope = (middle(slice.high) - middle(slice.low)) / (slice.high - slice.low);
        Set { quad, moved, tangent: [0, 1].map(|i| slope * frame.along[i] + frame.across[i]) }
    }

    /// The flights of a set's centre from there on, as far as they are the word's, in floating point.
    fn seen(&self, impacts: usize, quad: &Quad, mut room: State) -> Vec<Step> {
        let along = if length(quad.sides[0]) > length(room) { quad.sides[0] } else { room };
        let (mut state, mut expanding) = (quad.centre, along);
        let mut jacobians = Vec::new();
        let mut steps: Vec<Step> = Vec::new();
        for side in &self.word.path.sides[impacts..] {
            let Some(image) = self.guess.map(state).filter(|image| image.side == *side) else { break };
            state = image.state;
            expanding = unit(applied(image.jacobian, expanding));
            room = applied(image.jacobian, room);
            jacobians.push(image.jacobian);
            steps.push(Step { room: length(room), axes: [expanding; 2] });
        }
        // From the last impact back.
        let mut contracted = unit(self.word.frames[1].across);
        for (step, [[a, b], [c, d]]) in steps.iter_mut().zip(jacobians).rev() {
            step.axes[1] = contracted;
            let before = unit([d * contracted[0] - b * contracted[1], a * contracted[1] - c * contracted[0]]);
            // Where the map contracts to a line any direction is contracted.
            contracted = if before.iter().all(|x| x.is_finite()) { before } else { contracted };
        }
        steps
    }

    /// Whether all images are where they are to be.
    fn is_at(&self, landing: &Landing<2>, goal: Goal) -> bool {
        let turns = turns(self.word.path);
        // Positive on the left of the way from one corner to another, whole forcing periods later.
        let beside = |from: State, to: State| {
            let corner = [Ball::exact(from[0]) + Ball::exact(turns), Ball::exact(from[1])];
            landing.beside(left(edge(from, to)), corner, [[0.0; 2]; 2])
        };
        let HSet { left, right } = self.word.base;
        match goal {
            Goal::Between => {
                is_positive(beside(left.bottom, right.bottom)) && is_positive(-beside(left.top, right.top))
            }
            Goal::Left => is_positive(beside(left.bottom, left.top)),
            Goal::Right => is_positive(-beside(right.bottom, right.top)),
        }
    }
}

/// A bound of all members: a lower one outward to the left, -1, or an upper one outward to the right, 1.
fn bound(x: Ball, outward: f64) -> f64 {
    outward * (outward * x.mid() + x.rad()).next_up() // D34: outward
}

/// Whether the images of a set are about as long and as thick as the derivative at its centre makes them.
fn is_linear(quad: &Quad, jacobian: [[f64; 2]; 2], flown: &Flown, room: f64) -> bool {
    let [expanding, contracted] = flown.axes;
    let area = vector::cross(expanding, contracted).abs();
    let images = quad.sides.map(|side| applied(jacobian, side));
    let long = vector::cross(images[0], contracted).abs() / area;
    let thick = images.iter().map(|image| vector::cross(expanding, *image).abs()).sum::<f64>() / area;
    around(&[*flown]).is_some_and(|(_, reach)| {
        let is_short = reach[0] <= LONGER * long.max(room); // proposes: any sets will do
        // A side may be thick: it is not cut from side to side.
        is_short && (room > 0.0 || reach[1] <= LONGER * thick || reach[1] <= THIN * reach[0])
    })
}

/// Parallelograms that hold all images of some sets in a row, one for two of them where it is not much longer.
fn merged(all: &[Flown], room: f64) -> Option<Vec<Set>> {
    let mut sets = Vec::with_capacity(all.len());
    let mut rest = all;
    while !rest.is_empty() {
        let (one, reach) = around(&rest[..1])?;
        // proposes: any sets will do
        let two = rest.get(..2).and_then(around).filter(|(_, both)| both[0] < MERGED * reach[0].max(room));
        rest = &rest[if two.is_some() { 2 } else { 1 }..];
        sets.push(two.map_or(one, |(two, _)| two));
    }
    Some(sets)
}

/// A parallelogram that holds all images of some sets, and its half sides; `None` if none is known. Lemma D34
fn around(all: &[Flown]) -> Option<(Set, [f64; 2])> {
    let (first, last) = (all.first()?, all.last()?);
    let middle = |a: Ball, b: Ball| 0.5 * (a.mid() + b.mid());
    let centre = [middle(first.landing.phase, last.landing.phase), middle(first.landing.speed, last.landing.speed)];
    let [expanding, contracted] = [0, 1].map(|k| [0, 1].map(|i| 0.5 * (first.axes[k][i] + last.axes[k][i])));
    let moved = [0, 1].map(|k| [0, 1].map(|i| 0.5 * (first.moved[k][i] + last.moved[k][i])));
    let [g, h] = [expanding, contracted].map(|direction| direction.map(Ball::exact));
    let area = cross(g, h);
    let reach = |normal: [Ball; 2]| {
        let by = |flown: &Flown| {
            let by = flown.landing.beside(normal, centre.map(Ball::exact), moved).checked_div(area)?.mag();
            by.is_finite().then_some(by)
        };
        all.iter().map(by).try_fold(0.0, |most: f64, by| Some(most.max(by?))) // D34: the farthest
    };
    let (along, across) = (reach([h[1], -h[0]])?, reach([-g[1], g[0]])?);
    let sides = [expanding.map(|x| along * x), contracted.map(|x| across * x)];
    let size = [0, 1].map(|i| up(sides[0][i].abs() + sides[1][i].abs()));
    let slack = size.map(|size| up(4.0 * UNIT * size + TINY)); // D34: two products, rounded
    let down = up(size[1] + slack[1] + moved[0][1].abs() + moved[1][1].abs());
    let floor = (centre[1] - down).next_down().max(0.0); // D24: they have landed, so no speed is negative
    let is_known = size.iter().all(|size| size.is_finite());
    let quad = Quad { centre, sides, twist: [0.0; 2], slack, floor };
    let tangent = [0, 1].map(|i| 0.5 * (first.tangent[i] + last.tangent[i]));
    is_known.then_some((Set { quad, moved, tangent }, [along, across]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On both sides of 0, where a factor would move one of them inward.
    #[test]
    fn bounds_are_outward() {
        for middle in [0.3, -0.3, 1.1, -1.1, 0.0] {
            for radius in [0.0, 1e-17, 1e-3] {
                let x = Ball::new(middle, radius);
                assert!(bound(x, -1.0) < middle - radius && bound(x, 1.0) > middle + radius, "{middle} {radius}");
            }
        }
    }
}
