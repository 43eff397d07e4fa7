//! Curves across an h-set that a word maps beyond the ends of another one, found in doubles.
//!
//! Labels: proposes throughout.

use std::f64::consts::PI;

use super::{Moved, Strip, turns};
use crate::chaos::frame::Frame;
use crate::chaos::guess::Guess;
use crate::chaos::law::{Law, POINT};
use crate::chaos::quad::State;
use crate::chaos::vector::{applied, cross, minus, radians};
use crate::chaos::words::Path;
use crate::number::Ball;

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
/// Values of a parameter at which a curve is found, less 1; steps to one of them at most, and the least one.
const VALUES: usize = 4;
const MOST_WALKS: usize = 64;
const LEAST_WALK: f64 = 1.0 / 64.0;
/// The middle value of a parameter is 0, but for rounding.
const MIDDLE: f64 = 1e-12;

/// The image of a state of an h-set in the coordinates of another one, and its derivatives along the h-set and across.
struct Image {
    at: State,
    along: State,
    across: State,
}

/// A curve across an h-set: its places at the heights, and the state in the middle.
struct Curve {
    places: [f64; HEIGHTS + 1],
    middle: Node,
}

/// A state of a curve: its place, how the curve leans there, and how the image moves with the place.
#[derive(Clone, Copy)]
struct Node {
    place: f64,
    slope: f64,
    rate: f64,
}

/// The search for the strips of a word.
#[derive(Clone, Copy)]
pub(super) struct Finder<'f> {
    pub law: &'f Law,
    /// The map at some pair of the law's.
    pub guess: Guess,
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
        let height = |number: usize| self.frames[0].tall * (PI * number as f64 / HEIGHTS as f64).cos();
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
        Some(Curve { places, middle })
    }

    /// The same map at a pair of the law's, each parameter from -1 to 1.
    fn with(&self, at: [f64; 2]) -> Self {
        let [gap, restitution] =
            [0, 1].map(|k| Ball::exact([self.law.gap, self.law.restitution][k].mid() + at[k] * self.radius(k)));
        Self { guess: Guess::new(&Law { gap, restitution }), ..*self }
    }

    fn radius(&self, parameter: usize) -> f64 {
        let all = [self.law.gap, self.law.restitution][parameter];
        if all.rad() <= POINT * all.mid() { 0.0 } else { all.rad() }
    }

    /// The curve at a pair of the law's, followed from the middle one on.
    fn curve_at(&self, target: f64, middle: &Curve, at: [f64; 2]) -> Option<Curve> {
        let (mut place, mut part, mut slope, mut step) = (middle.middle.place, 0.0, 0.0, 1.0_f64);
        for _ in 0..MOST_WALKS {
            let next = (part + step).min(1.0);
            let finder = self.with(at.map(|x| next * x));
            if let Some(node) = finder.solve(target, place + slope * (next - part), 0.0) {
                slope = (node.place - place) / (next - part);
                (place, part) = (node.place, next);
                step *= 2.0;
                if part == 1.0 {
                    return finder.curve(target, place);
                }
            } else {
                step *= 0.5;
                if step < LEAST_WALK {
                    return None;
                }
            }
        }
        None
    }

    /// The coefficients of a curve by the powers of the parameters, those that all have to say at first.
    fn terms(&self, target: f64, middle: &Curve) -> Option<Vec<([usize; 2], Vec<f64>)>> {
        let values = [0, 1].map(|k| if self.radius(k) > 0.0 { VALUES } else { 0 });
        let value = |k: usize, number: usize| match values[k] {
            0 => 0.0,
            all => (PI * number as f64 / all as f64).cos(),
        };
        let mut all = Vec::new();
        for i in 0..=values[0] {
            for j in 0..=values[1] {
                let at = [value(0, i), value(1, j)];
                let is_middle = at.iter().all(|x| x.abs() < MIDDLE);
                all.push(if is_middle { middle.places } else { self.curve_at(target, middle, at)?.places });
            }
        }
        let near = NEAR * (target.abs() - 1.0) / middle.middle.rate.abs();
        // Each is given away once: by the powers of the parameters, and then by those of the height.
        let moves = values.iter().any(|&count| count > 0);
        let near = if moves { 0.5 * near } else { near };
        let row = |i: usize| &all[i * (values[1] + 1)..(i + 1) * (values[1] + 1)];
        let by_second: Vec<Vec<[f64; HEIGHTS + 1]>> = (0..=values[0]).map(|i| powers(row(i))).collect();
        let columns = (0..=values[1]).map(|j| powers(&by_second.iter().map(|row| row[j]).collect::<Vec<_>>()));
        let tall = self.frames[0].tall;
        let mut terms = Vec::new();
        for (j, column) in columns.enumerate() {
            for (i, places) in column.iter().enumerate() {
                let size = places.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                let is_small = i + j > 0 && size < near / (VALUES * VALUES) as f64;
                if !is_small {
                    terms
                        .push(([i, j], polynomial(places, if i + j > 0 { near / VALUES as f64 } else { near }, tall)?));
                }
            }
        }
        Some(terms)
    }

    /// About the places on the middle line of the h-set from and to which its stretch is, from left to right.
    pub fn ends(&self) -> Option<[f64; 2]> {
        let [a, b] = self.path.ends.each_ref().map(|motion| self.shot(motion));
        let (a, b) = (a?, b?);
        Some([a.min(b), a.max(b)])
    }

    /// The strip whose sides are mapped this far beyond the ends of the h-set, from its stretch on, and between two places on the middle line.
    fn strip(&self, [low, high]: [f64; 2], sign: f64, beyond: f64, [least, most]: [f64; 2]) -> Option<Strip> {
        let targets = [-sign * beyond, sign * beyond];
        let (left, right) = (self.curve(targets[0], low)?, self.curve(targets[1], high)?);
        let [a, b] = [&left, &right].map(|curve| curve.middle.place);
        if a < least || b > most {
            return None;
        }
        let digits = (FINE * (b - a)).log10().floor().abs() as usize;
        // Decimals, so that the strip that is proved is the one that a document has.
        let short = |parts: Vec<f64>| -> Option<Vec<f64>> {
            parts.iter().map(|part| format!("{part:.digits$}").parse().ok()).collect()
        };
        let mut strip = Strip { left: Vec::new(), right: Vec::new(), moved: Vec::new() };
        for (is_right, target, curve) in [(false, targets[0], &left), (true, targets[1], &right)] {
            for (by, parts) in self.terms(target, curve)? {
                let parts = short(parts)?;
                *strip.side(by, is_right) = parts;
            }
        }
        Some(strip)
    }

    /// Strips to be tried, between two places on the middle line, and whether their images move forward along the h-set, as the states do.
    pub fn strips(&self, ends: [f64; 2], between: [f64; 2]) -> Option<(bool, impl Iterator<Item = Strip>)> {
        let rises = self.image(0.5 * (ends[0] + ends[1]), 0.0)?.along[0] > 0.0;
        let sign = if rises { 1.0 } else { -1.0 };
        let strips = SIDE_IMAGES.into_iter().filter_map(move |beyond| self.strip(ends, sign, beyond, between));
        Some((rises, strips))
    }
}

impl Strip {
    /// The coefficients of one side for a power of the parameters.
    fn side(&mut self, by: [usize; 2], is_right: bool) -> &mut Vec<f64> {
        let number = self.moved.iter().position(|moved| moved.by == by).unwrap_or(self.moved.len());
        let (left, right) = if by == [0, 0] {
            (&mut self.left, &mut self.right)
        } else {
            if number == self.moved.len() {
                self.moved.push(Moved { by, left: vec![0.0], right: vec![0.0] });
            }
            let moved = &mut self.moved[number];
            (&mut moved.left, &mut moved.right)
        };
        if is_right { right } else { left }
    }
}

/// The parts of Chebyshev polynomials in one through values at the extrema of the last of them, from the upper end on.
fn waves(values: &[f64]) -> Vec<f64> {
    let last = values.len() - 1;
    if last == 0 {
        return values.to_vec();
    }
    let half = |k: usize| if k == 0 || k == last { 0.5 } else { 1.0 };
    let part = |k: usize| {
        let wave = |j: usize| half(j) * values[j] * (PI * (j * k) as f64 / last as f64).cos();
        half(k) * (0..=last).map(wave).sum::<f64>() * 2.0 / last as f64
    };
    (0..=last).map(part).collect()
}

/// Coefficients of the powers of `x` of a sum of Chebyshev polynomials in `x / size`.
fn coefficients(parts: &[f64], size: f64) -> Vec<f64> {
    let (mut one, mut next) = (vec![1.0], vec![0.0, 1.0 / size]);
    let mut coefficients = vec![0.0; parts.len()];
    for part in parts {
        one.iter().zip(&mut coefficients).for_each(|(power, sum)| *sum += part * power);
        let mut after: Vec<f64> = [0.0].into_iter().chain(next.iter().map(|x| 2.0 / size * x)).collect();
        one.iter().zip(&mut after).for_each(|(power, sum)| *sum -= power);
        (one, next) = (next, after);
    }
    coefficients
}

/// What each power of a parameter is multiplied by at each height, by the places at the values of the parameter.
fn powers(places: &[[f64; HEIGHTS + 1]]) -> Vec<[f64; HEIGHTS + 1]> {
    let mut powers = vec![[0.0; HEIGHTS + 1]; places.len()];
    for height in 0..=HEIGHTS {
        let values: Vec<f64> = places.iter().map(|places| places[height]).collect();
        for (power, x) in powers.iter_mut().zip(coefficients(&waves(&values), 1.0)) {
            power[height] = x;
        }
    }
    powers
}

/// The coefficients of a polynomial through places at the heights, or of one that is as near; `None` if there are too many.
fn polynomial(places: &[f64; HEIGHTS + 1], near: f64, tall: f64) -> Option<Vec<f64>> {
    let parts = waves(places);
    let mut count = parts.len();
    let mut left = near;
    while count > 1 && parts[count - 1].abs() < left {
        left -= parts[count - 1].abs();
        count -= 1;
    }
    (count <= MOST_COEFFICIENTS).then(|| coefficients(&parts[..count], tall))
}
