//! Curves across an h-set that a word maps beyond the ends of another one, found in doubles.
//!
//! Labels: proposes throughout.

use std::f64::consts::PI;

use super::{Strip, TALL, turns};
use crate::chaos::frame::Frame;
use crate::chaos::guess::Guess;
use crate::chaos::quad::State;
use crate::chaos::vector::{applied, cross, minus, radians};
use crate::chaos::words::Path;

/// Places, a half length being 1, to which the sides of a strip are mapped beyond the ends of the h-set that is covered. Farther ones leave room for
/// parts that are longer, nearer ones for other strips.
const SIDE_IMAGES: [f64; 6] = [1.2, 1.06, 1.02, 1.006, 1.002, 1.0005];
/// A polynomial is as far from the states that are mapped to one place as this part of what it has beyond an end.
const NEAR: f64 = 0.2;
/// Coefficients have as many decimals as make this part of a strip's breadth.
const FINE: f64 = 1e-4;
/// Heights at which a curve is found, less 1, and the most coefficients of its polynomial.
const HEIGHTS: usize = 32;
const MOST_COEFFICIENTS: usize = 18;
/// Steps of Newton's method, how exactly its result is mapped to the place, and steps towards each state of a motion.
const STEPS: usize = 12;
const MISS: f64 = 1e-6;
const GOOD_MISS: f64 = 1e-4;
const SHOTS: usize = 3;
/// Steps up or down a curve at most, and the least one.
const MOST_CLIMBS: usize = 200;
const LEAST_CLIMB: f64 = 1e-6;

/// The image of a state of an h-set in the coordinates of another one, and its derivatives along the h-set and across.
struct Image {
    at: State,
    along: State,
    across: State,
}

/// A curve across an h-set: the coefficients of its places, and its place in the middle.
struct Curve {
    coefficients: Vec<f64>,
    middle: f64,
}

/// A state of a curve: its place, how the curve leans there, and how the image moves with the place.
#[derive(Clone, Copy)]
struct Node {
    place: f64,
    slope: f64,
    rate: f64,
}

/// The search for the strips of a word.
pub(super) struct Finder<'f> {
    pub guess: &'f Guess,
    /// Coordinates of the h-set it comes from, and of the one it leads to.
    pub frames: [&'f Frame; 2],
    pub path: &'f Path,
}

impl Frame {
    /// Coordinates of a vector, about.
    pub(super) fn seen(&self, vector: State) -> State {
        let area = cross(self.along, self.across);
        [cross(vector, self.across) / area, cross(self.along, vector) / area]
    }
}

impl Finder<'_> {
    fn state(&self, xi: f64, eta: f64) -> State {
        let Frame { centre, along, across, .. } = self.frames[0];
        [0, 1].map(|i| centre[i] + xi * along[i] + eta * across[i])
    }

    /// A state after some flights of the word, and the images of both directions of the h-set.
    fn flown(&self, xi: f64, eta: f64, flights: usize) -> Option<(State, [State; 2])> {
        let Frame { along, across, .. } = *self.frames[0];
        let (mut state, mut directions) = (self.state(xi, eta), [along, across]);
        for side in &self.path.sides[..flights] {
            let image = self.guess.map(state).filter(|image| image.side == *side)?;
            directions = directions.map(|direction| applied(image.jacobian, direction));
            state = image.state;
        }
        Some((state, directions))
    }

    fn image(&self, xi: f64, eta: f64) -> Option<Image> {
        let (state, directions) = self.flown(xi, eta, self.path.sides.len())?;
        let to = self.frames[1];
        let at = to.seen(minus(state, [to.centre[0] + turns(self.path), to.centre[1]]));
        let [along, across] = directions.map(|direction| to.seen(direction));
        Some(Image { at, along, across })
    }

    /// The place on the middle line of the h-set whose motion comes near some states one after the other.
    fn shot(&self, motion: &[State]) -> Option<f64> {
        let mut place = self.frames[0].seen(minus(motion[0], self.frames[0].centre))[0];
        for (flights, goal) in motion.iter().enumerate().skip(1) {
            for _ in 0..SHOTS {
                let (state, [along, _]) = self.flown(place, 0.0, flights)?;
                let [[a, b], [c, d]] = [radians(minus(*goal, state)), radians(along)];
                place += (a * c + b * d) / (c * c + d * d);
            }
        }
        Some(place)
    }

    /// The state at a height whose image is at this place along the h-set, from near it.
    fn solve(&self, target: f64, near: f64, eta: f64) -> Option<Node> {
        let mut place = near;
        for step in 0..STEPS {
            let Image { at, along, across } = self.image(place, eta)?;
            let miss = at[0] - target;
            place -= miss / along[0];
            if miss.abs() < MISS || step > STEPS / 2 && miss.abs() < GOOD_MISS {
                let is_between = at[1].abs() < 1.0;
                return is_between.then_some(Node { place, slope: -across[0] / along[0], rate: along[0] });
            }
        }
        None
    }

    /// The curve of the states whose images are at one place along the h-set, followed up and down from near a place in the middle.
    fn curve(&self, target: f64, near: f64) -> Option<Curve> {
        let middle = self.solve(target, near, 0.0)?;
        let height = |number: usize| TALL * (PI * number as f64 / HEIGHTS as f64).cos();
        let mut places = [middle.place; HEIGHTS + 1];
        for numbers in [(0..HEIGHTS / 2).rev().collect::<Vec<_>>(), (HEIGHTS / 2 + 1..=HEIGHTS).collect()] {
            let (mut node, mut eta) = (middle, 0.0);
            // The slope one step before, and how far it is away.
            let mut before: Option<(f64, f64)> = None;
            for number in numbers {
                let goal = height(number);
                let mut step = goal - eta;
                let mut climbs = 0;
                while eta != goal {
                    let next = if (goal - eta).abs() <= step.abs() { goal } else { eta + step };
                    let climb = next - eta;
                    let bend = before.map_or(0.0, |(at, slope)| (node.slope - slope) / (eta - at));
                    let near = node.place + climb * (node.slope + 0.5 * bend * climb);
                    if let Some(found) = self.solve(target, near, next) {
                        before = Some((eta, node.slope));
                        (node, eta) = (found, next);
                        step *= 2.0;
                    } else {
                        step *= 0.5;
                    }
                    climbs += 1;
                    if climbs > MOST_CLIMBS || step.abs() < LEAST_CLIMB {
                        return None;
                    }
                }
                places[number] = node.place;
            }
        }
        let coefficients = polynomial(&places, NEAR * (target.abs() - 1.0) / middle.rate.abs())?;
        Some(Curve { coefficients, middle: middle.place })
    }

    /// About the places on the middle line of the h-set from and to which its stretch is, from left to right.
    pub fn ends(&self) -> Option<[f64; 2]> {
        let [a, b] = self.path.ends.each_ref().map(|motion| self.shot(motion));
        let (a, b) = (a?, b?);
        Some([a.min(b), a.max(b)])
    }

    /// The strip whose sides are mapped this far beyond the ends of the h-set, from its stretch on, and between two places on the middle line.
    fn strip(&self, [low, high]: [f64; 2], sign: f64, beyond: f64, [least, most]: [f64; 2]) -> Option<Strip> {
        let (left, right) = (self.curve(-sign * beyond, low)?, self.curve(sign * beyond, high)?);
        if left.middle < least || right.middle > most {
            return None;
        }
        let digits = (FINE * (right.middle - left.middle)).log10().floor().abs() as usize;
        // Decimals, so that the strip that is proved is the one that a document has.
        let short = |part: &f64| format!("{part:.digits$}").parse().ok();
        let [left, right]: [Option<_>; 2] = [left, right].map(|curve| curve.coefficients.iter().map(short).collect());
        Some(Strip { left: left?, right: right? })
    }

    /// Strips to be tried, between two places on the middle line, and whether their images move forward along the h-set, as the states do.
    pub fn strips(&self, ends: [f64; 2], between: [f64; 2]) -> Option<(bool, impl Iterator<Item = Strip>)> {
        let rises = self.image(0.5 * (ends[0] + ends[1]), 0.0)?.along[0] > 0.0;
        let sign = if rises { 1.0 } else { -1.0 };
        let strips = SIDE_IMAGES.into_iter().filter_map(move |beyond| self.strip(ends, sign, beyond, between));
        Some((rises, strips))
    }
}

/// The coefficients of a polynomial through values at the extrema of a Chebyshev polynomial, from the upper end on, or of one that is as near.
fn polynomial(places: &[f64; HEIGHTS + 1], near: f64) -> Option<Vec<f64>> {
    let half = |k: usize| if k == 0 || k == HEIGHTS { 0.5 } else { 1.0 };
    let part = |k: usize| {
        let wave = |j: usize| half(j) * places[j] * (PI * (j * k) as f64 / HEIGHTS as f64).cos();
        half(k) * (0..=HEIGHTS).map(wave).sum::<f64>() * 2.0 / HEIGHTS as f64
    };
    let parts: Vec<f64> = (0..=HEIGHTS).map(part).collect();
    let mut count = parts.len();
    let mut left = near;
    while count > 1 && parts[count - 1].abs() < left {
        left -= parts[count - 1].abs();
        count -= 1;
    }
    if count > MOST_COEFFICIENTS {
        return None;
    }
    // The Chebyshev polynomials, in powers of the height.
    let (mut one, mut next) = (vec![1.0], vec![0.0, 1.0 / TALL]);
    let mut coefficients = vec![0.0; count];
    for part in &parts[..count] {
        one.iter().zip(&mut coefficients).for_each(|(power, sum)| *sum += part * power);
        let mut after: Vec<f64> = [0.0].into_iter().chain(next.iter().map(|x| 2.0 / TALL * x)).collect();
        one.iter().zip(&mut after).for_each(|(power, sum)| *sum -= power);
        (one, next) = (next, after);
    }
    Some(coefficients)
}
