//! Approximate strips of listed words, in doubles: nothing rests on them.
//!
//! Labels: proposes throughout.

use super::super::beam::State;
use super::super::guess::Guess;
use super::super::words::Word;
use super::strip::{Branch, Frame, Strip};

/// Neighbours are parted until their images are this near, or they are so near themselves.
const MAX_IMAGE_DISTANCE: f64 = 0.01;
const MIN_DISTANCE: f64 = 1e-9;
const FIRST_PARTS: i32 = 256;
/// Places beyond the edges that strips are mapped to, in the order tried, and a part of the width added, as their sides are straight.
const SIDE_IMAGES: [f64; 4] = [1.004, 1.0015, 1.008, 1.0004];
const WIDTH_MARGIN: f64 = 1e-4;
const STEPS: usize = 40;
const HEIGHTS: [f64; 3] = [-1.0, 0.0, 1.0];

/// A place on the middle line, and the images of its state.
struct LineSample {
    place: f64,
    images: Vec<(State, bool)>,
}

fn coordinates(frame: &Frame, [u, w]: State, turns: f64) -> State {
    let ([a, b], [c, d]) = (frame.along, frame.across);
    let (u, w, area) = (u - turns - frame.centre[0], w - frame.centre[1], a * d - b * c);
    [(u * d - w * c) / area, (a * w - b * u) / area]
}

fn state(frame: &Frame, xi: f64, eta: f64) -> State {
    [0, 1].map(|i| frame.centre[i] + xi * frame.along[i] + eta * frame.across[i])
}

fn seen(guess: &Guess, frame: &Frame, place: f64, flights: usize) -> LineSample {
    let (mut at, mut images) = (state(frame, place, 0.0), Vec::new());
    while images.len() < flights {
        let Some(image) = guess.map(at) else { break };
        at = image.state;
        images.push((at, image.is_far));
    }
    LineSample { place, images }
}

fn line(guess: &Guess, frame: &Frame, flights: usize) -> Vec<LineSample> {
    let see = |place: f64| seen(guess, frame, place, flights);
    let mut done = vec![see(-1.0)];
    let mut open: Vec<LineSample> =
        (1..=FIRST_PARTS).rev().map(|k| see(2.0 * f64::from(k) / f64::from(FIRST_PARTS) - 1.0)).collect();
    while let Some(next) = open.pop() {
        let last = &done[done.len() - 1];
        let mut alike = last.images.iter().zip(&next.images).take_while(|(a, b)| a.1 == b.1);
        let is_coarse = alike.any(|(a, b)| (a.0[0] - b.0[0]).abs() + (a.0[1] - b.0[1]).abs() > MAX_IMAGE_DISTANCE);
        if is_coarse && next.place - last.place > MIN_DISTANCE {
            let between = see(0.5 * (last.place + next.place));
            open.extend([next, between]);
        } else {
            done.push(next);
        }
    }
    done
}

/// The whole forcing periods after which a word comes to its h-set.
fn turns(word: &Word) -> f64 {
    let far = word.flights.iter().filter(|&&is_far| is_far).count() as f64;
    0.5 * (word.half_cycles as f64 + far)
}

/// The crossings of images and an h-set, and whether they run from left to right.
fn crossings(line: &[LineSample], word: &Word, frame: &Frame) -> Vec<([f64; 2], bool)> {
    let (mut found, mut last) = (Vec::new(), None);
    let (turns, flights) = (turns(word), word.flights.len());
    for LineSample { place, images } in line {
        let flown = images.get(..flights).filter(|images| images.iter().zip(&word.flights).all(|(a, b)| a.1 == *b));
        let at = flown.map(|images| coordinates(frame, images[flights - 1].0, turns)).filter(|at| at[1].abs() < 1.0);
        let Some([xi, _]) = at else {
            last = None;
            continue;
        };
        if xi.abs() > 1.0 {
            if let Some((was_right, from)) = last
                && was_right != (xi > 1.0)
            {
                found.push(([from, *place], xi > 1.0));
            }
            last = Some((xi > 1.0, *place));
        }
    }
    found
}

/// The place along height `eta`, found near a guess, whose image has the wanted place.
fn solved(guess: &Guess, frames: &[Frame], word: &Word, eta: f64, (near, target): (f64, f64)) -> Option<f64> {
    let miss = |xi: f64| {
        let mut at = state(&frames[word.from], xi, eta);
        for &is_far in &word.flights {
            at = guess.map(at).filter(|image| image.is_far == is_far)?.state;
        }
        Some(coordinates(&frames[word.to], at, turns(word))[0] - target)
    };
    let (mut a, mut b) = (near, near + 1e-6);
    let mut before = miss(a)?;
    for _ in 0..STEPS {
        let now = miss(b)?;
        if now.abs() < 1e-7 {
            return Some(b);
        }
        (a, b, before) = (b, b - now * (b - a) / (now - before), now);
    }
    None
}

fn strips(guess: &Guess, frames: &[Frame], word: &Word, ends: [f64; 2], rises: bool) -> Vec<Strip> {
    let strip = |beyond: &f64| {
        let side = |end: usize, sign: f64| {
            let target = if rises { sign * beyond } else { -sign * beyond };
            let row = |&eta: &f64| solved(guess, frames, word, eta, (ends[end], target));
            let rows: Vec<f64> = HEIGHTS.iter().map(row).collect::<Option<_>>()?;
            let lean = 0.5 * (rows[2] - rows[0]);
            let outer = HEIGHTS.iter().zip(&rows).map(|(eta, xi)| sign * (xi - lean * eta)).fold(f64::MIN, f64::max);
            Some([sign * outer, lean])
        };
        let ([left, lean], [right, other]) = (side(0, -1.0)?, side(1, 1.0)?);
        let spare = WIDTH_MARGIN * (right - left);
        Some(Strip { left: [left - spare, lean], right: [right + spare, other] }).filter(Strip::is_sound)
    };
    SIDE_IMAGES.iter().filter_map(strip).collect()
}

/// Strips of words, as far as they are seen, by the number of the word: of each some that differ in how far beyond the edges they are mapped.
pub(super) fn branches(guess: &Guess, frames: &[Frame], words: &[(usize, Word)]) -> Vec<(usize, Vec<Branch>)> {
    let mut found = Vec::new();
    let mut ordered: Vec<&(usize, Word)> = words.iter().collect();
    ordered.sort_by_key(|(_, word)| word.flights.len());
    for (from, frame) in frames.iter().enumerate() {
        let own: Vec<&&(usize, Word)> = ordered.iter().filter(|(_, word)| word.from == from).collect();
        let Some(flights) = own.iter().map(|(_, word)| word.flights.len()).max() else { continue };
        let line = line(guess, frame, flights);
        let mut taken: Vec<[f64; 2]> = Vec::new();
        for (number, word) in own {
            let free = crossings(&line, word, &frames[word.to]).into_iter().find_map(|(ends, rises)| {
                let is_free = taken.iter().all(|other| ends[1] <= other[0] || other[1] <= ends[0]);
                let strips = if is_free { strips(guess, frames, word, ends, rises) } else { Vec::new() };
                (!strips.is_empty()).then_some((ends, rises, strips))
            });
            let Some((ends, rises, strips)) = free else { continue };
            taken.push(ends);
            let Word { to, half_cycles, ref flights, .. } = *word;
            let (flights, turns) = (flights.clone(), turns(word));
            let branch = |strip| Branch { from, to, flights: flights.clone(), half_cycles, turns, strip, rises };
            found.push((*number, strips.into_iter().map(branch).collect()));
        }
    }
    found
}
