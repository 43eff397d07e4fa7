//! Words proved by the strips that a document has for them: nothing is searched for (Lemma V39).

mod curve;
mod patch;
mod side;
#[cfg(test)]
mod tests;
mod witness;

use super::Law;
use super::allowance::{Allowance, End};
use super::bases::HSet;
use super::beam::{Landing, State};
use super::cones::Frame;
use super::guess::{Guess, MAX_PERIODS, applied};
use super::span::Span;
use super::words::Word;
use curve::{Heights, Values};
use patch::{Band, Flown, Patch, length, onward, unit};
use side::Strip;
pub(super) use witness::left_open;

/// The map and the h-sets that words are proved for.
struct Cover<'c> {
    law: &'c Law,
    bases: &'c [HSet],
    frames: Vec<Frame>,
}

/// Flights of patches that are followed for a word at most.
const MAX_FLIGHTS: usize = 1 << 20;
/// The flight of a patch counts as N looks at it.
const WORK_PER_PATCH: usize = 4;
/// Least part of a strip from side to side at the start, halvings of a part after some flights, and of a patch in height.
const LEAST_BAND: f64 = 1.0 / (1 << 20) as f64; // exact: a power of two
const LATER_HALVINGS: u32 = 12;
const HEIGHT_HALVINGS: u32 = 9;
/// Cuts of the parameters, and how wide those that are cut have to be, for their size.
const MAX_CUTS: u32 = 12;
const LEAST_WIDTH: f64 = 1e-9;
/// A slice bulges by less than this part of its band, or of the strip, and there are no more slices than that.
const BULGES: [f64; 2] = [1.0 / 16.0, 1.0 / 128.0];
const MAX_SLICES: usize = 1 << 13;
/// How long images of parts of a side may be, those of half of the strip being 1: what is tried first, and last, and one after the other.
const SIDE_LENGTHS: [f64; 2] = [1.0 / 64.0, 1.0 / (1 << 20) as f64]; // exact: powers of two
const SHORTER: f64 = 0.25;
/// In a row of more patches parallelograms have a side along the sides of the strip, if that makes them small: this direction is known well after few
/// flights. In a row of fewer they have one that the flights to come contract. The other one is tried next.
const MANY: usize = 64;

/// An h-set some forcing periods later, which a word ends at.
struct Target<'c> {
    base: &'c HSet,
    turns: f64,
}

/// Where images have to land.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Goal {
    /// Between the lines of bottom and top.
    Between,
    /// Beyond the line of the left edge, or of the right one.
    Beyond { is_right: bool },
}

/// A word with its strip, for some of the parameters, and how much of its work is left.
struct Proof<'p> {
    cover: &'p Cover<'p>,
    law: Law,
    guess: Guess,
    word: &'p Word,
    strip: Strip,
    target: &'p Target<'p>,
    work: &'p Allowance<'p>,
    left: usize,
}

/// Patches of a band, one above the other, after some flights.
struct Row {
    flown: usize,
    patches: Vec<Patch>,
}

/// A flight of the middle of a row, in doubles: the directions that flights so far expand and those to come contract where it lands, and how long
/// images of parts of a side may be there.
struct Leg {
    directions: [State; 2],
    allowed: f64,
}

impl Word {
    /// The forcing periods after which it comes to its last h-set; `None` where its half cycles are of another parity than its far flights.
    fn turns(&self) -> Option<f64> {
        let far = self.flights.iter().filter(|&&is_far| is_far).count() as i64; // exact: a length
        let half_periods = self.half_cycles.checked_add(far)?;
        let is_whole = half_periods % 2 == 0 && half_periods.unsigned_abs() < 1 << 32;
        is_whole.then_some(half_periods as f64 / 2.0) // exact: a whole number of 32 bits
    }
}

impl Target<'_> {
    /// Holds how far all images are to the left of the way from one corner to another: positive or negative where all or none of them are.
    fn beside(&self, landing: &Landing, from: State, to: State) -> Span {
        let [[u, w], [v, x]] = [from, to].map(|corner| corner.map(Span::point));
        landing.beside([w - x, v - u], [u + Span::point(self.turns), w], [[Span::point(0.0); 2]; 2])
    }

    fn is_met(&self, landing: &Landing, goal: Goal) -> bool {
        let HSet { left, right } = self.base;
        match goal {
            Goal::Between => {
                self.beside(landing, left.bottom, right.bottom).is_positive()
                    && self.beside(landing, left.top, right.top).is_negative()
            }
            Goal::Beyond { is_right: false } => self.beside(landing, left.bottom, left.top).is_positive(),
            Goal::Beyond { is_right: true } => self.beside(landing, right.bottom, right.top).is_negative(),
        }
    }
}

impl<'c> Cover<'c> {
    fn new(law: &'c Law, bases: &'c [HSet]) -> Self {
        Self { law, bases, frames: bases.iter().map(Frame::of).collect() }
    }

    /// Returns whether all curves across the first h-set of a word are proved to be mapped across its last one, within the strip, for all parameters.
    fn is_proved(&self, word: &Word, strip: &Strip, work: &Allowance) -> Result<bool, End> {
        let Some(turns) = word.turns() else { return Ok(false) };
        if !strip.parts(&self.frames[word.from], &self.bases[word.from]) {
            return Ok(false);
        }
        let target = Target { base: &self.bases[word.to], turns };
        let mut open = vec![(Values::ALL, 0)];
        let mut left = MAX_FLIGHTS;
        while let Some((values, cuts)) = open.pop() {
            let (law, shift) = values.of(self.law);
            let (guess, strip) = (Guess::new(&law), strip.of(shift));
            let mut proof = Proof { cover: self, law, guess, word, strip, target: &target, work, left };
            let is_there = proof.is_there()?;
            left = proof.left;
            if is_there {
                continue;
            }
            let widths = [law.gap, law.restitution].map(|all| (all.hi() - all.lo()) / all.mid());
            let wider = usize::from(widths[1] > widths[0]); // V39: any of both
            let is_narrow = widths[wider] < LEAST_WIDTH; // proposes: when to give up
            if is_narrow || cuts == MAX_CUTS || left == 0 {
                return Ok(false);
            }
            open.extend(values.halves(wider).map(|half| (half, cuts + 1)));
        }
        Ok(true)
    }
}

impl Proof<'_> {
    fn is_there(&mut self) -> Result<bool, End> {
        let Some(is_right) = self.leads_right() else { return Ok(false) };
        Ok(self.is_side_beyond(-1.0, is_right)? && self.is_side_beyond(1.0, !is_right)? && self.is_between()?)
    }

    /// Which edge of the last h-set the left side of the strip is mapped beyond, in doubles.
    fn leads_right(&self) -> Option<bool> {
        let [from, to] = [self.word.from, self.word.to].map(|base| &self.cover.frames[base]);
        let place = self.strip.left.at(Span::point(0.0)).mid();
        let mut state = [0, 1].map(|i| from.centre[i] + place * from.along[i]);
        for &is_far in &self.word.flights {
            state = self.guess.map(state).filter(|image| image.is_far == is_far)?.state;
        }
        Some(to.place(state.map(Span::point), self.target.turns)?[0].mid() > 0.0)
    }

    /// Returns whether all images of a side of the strip are beyond an edge.
    fn is_side_beyond(&mut self, at: f64, is_right: bool) -> Result<bool, End> {
        let side = Band { from: at, to: at };
        let mut allowed = SIDE_LENGTHS[0];
        while allowed >= SIDE_LENGTHS[1] {
            if let Some(row) = self.row(side, allowed)
                && self.follow(row, Goal::Beyond { is_right }, allowed)?.is_none()
            {
                return Ok(true);
            }
            allowed *= SHORTER;
        }
        Ok(false)
    }

    /// Returns whether all images of the strip are between bottom and top.
    fn is_between(&mut self) -> Result<bool, End> {
        let mut bands = vec![Band { from: -1.0, to: 1.0 }];
        while let Some(band) = bands.pop() {
            if self.is_band_between(band)? {
                continue;
            }
            if self.left == 0 || band.to - band.from < LEAST_BAND {
                return Ok(false);
            }
            bands.extend(band.halves());
        }
        Ok(true)
    }

    /// The same of a band. Its rows are halved after some flights where they have to be; not before the first one.
    fn is_band_between(&mut self, band: Band) -> Result<bool, End> {
        let mut open: Vec<(Row, u32)> = self.row(band, 0.0).map(|row| (row, 0)).into_iter().collect();
        if open.is_empty() {
            return Ok(false);
        }
        while let Some((row, halvings)) = open.pop() {
            let Some(row) = self.follow(row, Goal::Between, 0.0)? else { continue };
            if row.flown == 0 || halvings == LATER_HALVINGS || self.left == 0 {
                return Ok(false);
            }
            let halves: Vec<[Patch; 2]> = row.patches.iter().map(|patch| patch.halves(false)).collect();
            open.extend([0, 1].map(|k| {
                let patches = halves.iter().map(|half| half[k]).collect();
                (Row { flown: row.flown, patches }, halvings + 1)
            }));
        }
        Ok(true)
    }

    /// The states of a band in equally high slices; `None` if there would be too many.
    fn row(&self, band: Band, allowed: f64) -> Option<Row> {
        let Strip { left, right } = &self.strip;
        // proposes: any number of slices will do
        let part = (BULGES[0] * (band.to - band.from)).max(2.0 * BULGES[0] * allowed).min(BULGES[1]);
        let mut slices = vec![Heights::of(&self.cover.frames[self.word.from], &self.cover.bases[self.word.from])?];
        let is_straight = |heights: &Heights| {
            let breadth = right.at(heights.all()).mid() - left.at(heights.all()).mid();
            left.bulge(heights).hull(right.bulge(heights)).most() <= part * breadth
        };
        while !slices.iter().all(is_straight) {
            if slices.len() == MAX_SLICES {
                return None;
            }
            slices = slices.iter().flat_map(Heights::halves).collect();
        }
        let frame = &self.cover.frames[self.word.from];
        let patches = slices.iter().map(|heights| band.states(frame, &self.strip, heights)).collect();
        Some(Row { flown: 0, patches })
    }

    /// Follows a row to the end of the word: `None` if all images are where they have to be, else the row that has to be cut.
    fn follow(&mut self, mut row: Row, goal: Goal, allowed: f64) -> Result<Option<Row>, End> {
        let legs = self.legs(&row, allowed)?;
        if row.flown + legs.len() < self.word.flights.len() {
            return Ok(Some(row));
        }
        for leg in &legs {
            let goal = (row.flown + 1 == self.word.flights.len()).then_some(goal);
            let mut images = Vec::with_capacity(row.patches.len());
            let are_many = row.patches.len() > MANY;
            for patch in &row.patches {
                let Some(flown) = self.flown(row.flown, patch, (leg, are_many), goal)? else {
                    return Ok(Some(row));
                };
                images.extend(flown);
            }
            if goal.is_some() {
                return Ok(None);
            }
            let Some(patches) = onward(&images, leg.allowed) else { return Ok(Some(row)) };
            row = Row { flown: row.flown + 1, patches };
        }
        Ok(Some(row))
    }

    /// The images of a patch, in parts from bottom to top; `None` where they are not known or too long, so that it has to be cut from side to side.
    fn flown(
        &mut self,
        number: usize,
        patch: &Patch,
        (leg, are_many): (&Leg, bool),
        goal: Option<Goal>,
    ) -> Result<Option<Vec<Flown>>, End> {
        let Self { law, guess, .. } = *self;
        let is_far = self.word.flights[number];
        let mut images = Vec::new();
        let mut open = vec![(*patch, 0)];
        while let Some((patch, halvings)) = open.pop() {
            let image = guess.map(patch.middle());
            self.work.spend(WORK_PER_PATCH, image.map_or(MAX_PERIODS, |image| image.time))?;
            self.left = self.left.saturating_sub(1); // exact: none is left
            let flown = image.filter(|image| image.is_far == is_far).and_then(|image| {
                let landing = patch.flights(&law).land(is_far, image.time)?;
                let upward = unit(applied(image.jacobian, patch.upward));
                let [expanded, contracted] = leg.directions;
                let [by_gap, by_restitution] = image.moved;
                let moved = [0, 1].map(|k| {
                    let ([u, w], [v, x]) = (applied(image.jacobian, patch.moved[k]), [by_restitution, by_gap][k]);
                    [u + v, w + x]
                });
                let along = |across: State| Flown { landing, directions: [expanded, across], moved, upward };
                let known = if are_many { [upward, contracted] } else { [contracted, upward] };
                let is_good = |flown: &Flown| match goal {
                    Some(goal) => self.target.is_met(&landing, goal),
                    None => patch.is_small(&image, flown, leg.allowed),
                };
                known.map(along).into_iter().find(is_good)
            });
            if let Some(flown) = flown {
                images.push(flown);
                continue;
            }
            let is_tall = length(patch.half(1)) > 0.25 * length(patch.half(0));
            if halvings == HEIGHT_HALVINGS || !is_tall || self.left == 0 {
                return Ok(None);
            }
            let [below, above] = patch.halves(true);
            open.extend([above, below].map(|half| (half, halvings + 1)));
        }
        Ok(Some(images))
    }

    /// The flights of the middle of a row on, as far as they are those of the word, in doubles.
    fn legs(&self, row: &Row, allowed: f64) -> Result<Vec<Leg>, End> {
        let Self { cover: Cover { frames, .. }, guess, word, strip, .. } = self;
        let middle = &row.patches[row.patches.len() / 2];
        let breadth = 0.5 * (strip.right.at(Span::point(0.0)).mid() - strip.left.at(Span::point(0.0)).mid());
        let mut short = frames[word.from].along.map(|x| allowed * breadth * x);
        let own = middle.half(0);
        let mut expanded = if length(own) > length(short) { own } else { short };
        let mut state = middle.middle();
        let (mut legs, mut jacobians) = (Vec::new(), Vec::new());
        for &is_far in &word.flights[row.flown..] {
            let image = guess.map(state);
            self.work.spend(1, image.map_or(MAX_PERIODS, |image| image.time))?;
            let Some(image) = image.filter(|image| image.is_far == is_far) else { break };
            state = image.state;
            expanded = unit(applied(image.jacobian, expanded));
            short = applied(image.jacobian, short);
            jacobians.push(image.jacobian);
            legs.push(Leg { directions: [expanded; 2], allowed: length(short) });
        }
        let mut contracted = unit(frames[word.to].across);
        for (leg, [[a, b], [c, d]]) in legs.iter_mut().zip(jacobians).rev() {
            leg.directions[1] = contracted;
            // The inverse but for its size; where the map contracts to a line any direction will do.
            let before = unit(applied([[d, -b], [-c, a]], contracted));
            contracted = if before.iter().all(|x| x.is_finite()) { before } else { contracted };
        }
        Ok(legs)
    }
}
