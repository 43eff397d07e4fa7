//! Approximate strips of words, found in doubles. Their images are proved elsewhere.
//!
//! Labels: proposes throughout.

use super::strip::{Branch, StraightStrip};
use crate::chaos::blocks::Word;
use crate::chaos::frame::Frame;
use crate::chaos::guess::Guess;
use crate::chaos::law::Side;
use crate::chaos::quad::State;
use crate::pair::Wall;

/// Neighbours whose images are farther apart are parted, unless they are nearer than that themselves.
const MAX_IMAGE_DISTANCE: f64 = 0.01;
const MIN_DISTANCE: f64 = 1e-9;
/// First parts of an h-set.
const FIRST_PARTS: usize = 256;
/// Places, a half length being 1, to which the sides of a strip are mapped beyond the edges of the h-set that is covered: each is tried.
const SIDE_IMAGES: [f64; 3] = [1.006, 1.002, 1.0005];
/// Part of a strip's breadth that is added on either side, as the sides are straight, and as they are decimals.
const WIDTH_MARGIN: f64 = 2e-4;
/// Sides have as many decimals as make this part of a strip's breadth.
const FINE: f64 = 2e-5;
const STEPS: usize = 40;

/// A state on the middle line of an h-set, and its images.
struct Sample {
    xi: f64,
    images: Vec<(State, Side)>,
}

/// Middle line of an h-set, and its images after `impacts` impacts.
struct Line<'l> {
    guess: &'l Guess,
    frames: &'l [Frame],
    from: usize,
    impacts: usize,
}

fn inside(frame: &Frame, [u, w]: State, turns: f64) -> [f64; 2] {
    let [a, s] = [frame.along, frame.across];
    let [u, w] = [u - turns - frame.centre[0], w - frame.centre[1]];
    let determinant = a[0] * s[1] - a[1] * s[0];
    [(u * s[1] - w * s[0]) / determinant, (a[0] * w - a[1] * u) / determinant]
}

impl Line<'_> {
    fn state(&self, xi: f64, eta: f64) -> State {
        let Frame { centre, along, across, .. } = &self.frames[self.from];
        [0, 1].map(|i| centre[i] + xi * along[i] + eta * across[i])
    }

    fn sample(&self, xi: f64) -> Sample {
        let (mut state, mut images) = (self.state(xi, 0.0), Vec::with_capacity(self.impacts));
        while images.len() < self.impacts {
            let Some(image) = self.guess.map(state) else { break };
            state = image.state;
            images.push((state, image.side));
        }
        Sample { xi, images }
    }

    /// Samples whose images lie close together, as long as their flights are alike.
    fn samples(&self) -> Vec<Sample> {
        let place = |k: usize| 2.0 * k as f64 / FIRST_PARTS as f64 - 1.0;
        let mut done = vec![self.sample(-1.0)];
        let mut open: Vec<Sample> = (1..=FIRST_PARTS).rev().map(|k| self.sample(place(k))).collect();
        while let Some(next) = open.pop() {
            let last = &done[done.len() - 1];
            let alike = last.images.iter().zip(&next.images).take_while(|(a, b)| a.1 == b.1);
            let is_apart = alike.clone().any(|(a, b)| (a.0[0] - b.0[0]).hypot(a.0[1] - b.0[1]) > MAX_IMAGE_DISTANCE);
            if is_apart && next.xi - last.xi > MIN_DISTANCE {
                let middle = self.sample(0.5 * (last.xi + next.xi));
                open.push(next);
                open.push(middle);
            } else {
                done.push(next);
            }
        }
        done
    }

    /// `xi` in the h-set that a word leads to, of a state that flies as it says.
    fn image(&self, word: &ListedWord, xi: f64, eta: f64) -> Option<f64> {
        let mut state = self.state(xi, eta);
        for side in &word.sides {
            let image = self.guess.map(state).filter(|image| image.side == *side)?;
            state = image.state;
        }
        Some(inside(&self.frames[word.to], state, word.turns)[0])
    }

    /// Place on a row at which `xi` of the image has this value, near a guess.
    fn solve(&self, word: &ListedWord, value: f64, near: f64, eta: f64) -> Option<f64> {
        let (mut a, mut b) = (near, near + 1e-6);
        let mut at_a = self.image(word, a, eta)? - value;
        for _ in 0..STEPS {
            let at_b = self.image(word, b, eta)? - value;
            if at_b.abs() < 1e-7 {
                return Some(b);
            }
            (a, b, at_a) = (b, b - at_b * (b - a) / (at_b - at_a), at_b);
        }
        None
    }

    fn strip(&self, word: &ListedWord, ends: [f64; 2], sign: f64) -> Option<StraightStrip> {
        SIDE_IMAGES.iter().find_map(|beyond| {
            let row = |end: usize, eta: f64| self.solve(word, sign * (2.0 * end as f64 - 1.0) * beyond, ends[end], eta);
            let rows: Vec<[f64; 2]> =
                [-1.0, 0.0, 1.0].iter().map(|&eta| Some([row(0, eta)?, row(1, eta)?])).collect::<Option<_>>()?;
            let slopes = [0, 1].map(|end| 0.5 * (rows[2][end] - rows[0][end]));
            let straight =
                |end: usize| [-1.0, 0.0, 1.0].iter().zip(&rows).map(move |(eta, row)| row[end] - slopes[end] * eta);
            let spare = WIDTH_MARGIN * (rows[1][1] - rows[1][0]);
            let low = straight(0).fold(f64::INFINITY, f64::min) - spare;
            let high = straight(1).fold(f64::NEG_INFINITY, f64::max) + spare;
            let digits = (FINE * (high - low)).log10().floor().abs() as usize;
            // Decimals, so that the strip that is proved is the one that a document has.
            let short = |part: f64| format!("{part:.digits$}").parse::<f64>().ok();
            let side = |place: f64, slope: f64| Some([short(place)?, short(slope)?]);
            let strip = StraightStrip { left: side(low, slopes[0])?, right: side(high, slopes[1])? };
            strip.is_inside().then_some(strip)
        })
    }
}

/// A listed word.
struct ListedWord {
    number: usize,
    from: usize,
    to: usize,
    sides: Vec<Side>,
    turns: f64,
}

fn seen((number, word): (usize, &Word)) -> ListedWord {
    let before = std::iter::once(&Wall::Left).chain(&word.walls);
    let sides: Vec<Side> = before.zip(&word.walls).map(|(a, b)| if a == b { Side::Near } else { Side::Far }).collect();
    let far = sides.iter().filter(|&&side| side == Side::Far).count() as i64;
    ListedWord { number, from: word.from, to: word.to, turns: 0.5 * (word.half_cycles + far) as f64, sides }
}

/// Words whose strips are seen, with their numbers among the listed words.
pub(super) fn branches(guess: &Guess, frames: &[Frame], words: &[Word]) -> Vec<(usize, Branch)> {
    let mut found = Vec::new();
    let mut words: Vec<ListedWord> = words.iter().enumerate().map(seen).collect();
    words.sort_by_key(|word| word.sides.len());
    for from in 0..frames.len() {
        let own: Vec<&ListedWord> = words.iter().filter(|word| word.from == from).collect();
        let impacts = own.iter().map(|word| word.sides.len()).max().unwrap_or(0);
        let line = Line { guess, frames, from, impacts };
        let samples = line.samples();
        let mut taken: Vec<[f64; 2]> = Vec::new();
        for word in own {
            for ([low, high], sign) in crossings(&samples, word, &frames[word.to]) {
                if taken.iter().any(|[a, b]| low < *b && *a < high) {
                    continue;
                }
                let Some(strip) = line.strip(word, [low, high], sign) else { continue };
                taken.push([low, high]);
                let ListedWord { number, from, to, sides, turns } = word;
                let half_turns = (2.0 * turns) as i64 - sides.iter().filter(|&&side| side == Side::Far).count() as i64;
                let (sides, turns) = (sides.clone(), *turns);
                found.push((
                    *number,
                    Branch { from: *from, to: *to, sides, half_turns, turns, strip, rises: sign > 0.0 },
                ));
                break;
            }
        }
    }
    found.sort_by_key(|(number, _)| *number);
    found
}

/// Stretches along which the image crosses an h-set, and the sign it does so with.
fn crossings(samples: &[Sample], word: &ListedWord, frame: &Frame) -> Vec<([f64; 2], f64)> {
    let mut found = Vec::new();
    let mut last: Option<(bool, f64)> = None;
    for Sample { xi, images } in samples {
        let is_alike =
            images.len() >= word.sides.len() && images.iter().zip(&word.sides).all(|(image, side)| image.1 == *side);
        if !is_alike {
            last = None;
            continue;
        }
        let [to, height] = inside(frame, images[word.sides.len() - 1].0, word.turns);
        if height.abs() > 1.0 {
            last = None;
        } else if to.abs() > 1.0 {
            if let Some((was_above, from)) = last
                && was_above != (to > 1.0)
            {
                found.push(([from, *xi], if to > 1.0 { 1.0 } else { -1.0 }));
            }
            last = Some((to > 1.0, *xi));
        }
    }
    found
}
