//! The next chain of boxes: images of chords, more of them where they are stretched or bent, wrapped anew.
//!
//! Labels: proposes throughout.

use std::f64::consts::TAU;

use super::allowance::{Allowance, End};
use super::beam::State;
use super::guess::{Guess, Image, MAX_PERIODS, applied};
use super::tube::{BoxChain, Chord, Part};

/// A way to make chains of boxes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Making {
    /// Cells are about as long at most, phases in radians.
    pub longest: f64,
    /// Excess of a chord over the image that it holds: a factor, and `pad` beyond that.
    pub margin: f64,
    pub pad: f64,
    /// Parts are not cut below this length.
    pub shortest: f64,
    /// Flights ahead that the contracting direction is measured from.
    pub ahead: usize,
}

/// A chain of boxes where the image of a stretch may lie.
pub(super) struct Proposal {
    pub parts: Vec<Part>,
    pub is_far: bool,
    pub next: BoxChain,
}

#[derive(Clone, Copy)]
struct Sample {
    cell: usize,
    at: f64,
    middle: State,
    half: State,
    image: Option<Image>,
}

/// A part of a cell between two samples, both of which have images.
type Pair = [Sample; 2];

/// Fewer parts than that are not worth a chain of boxes.
const MIN_PARTS: usize = 12;
/// Factor by which cells at the ends are shorter.
const END_GRADING: f64 = 0.001;

/// Radians and speeds.
fn vector(from: State, to: State) -> State {
    in_radians([to[0] - from[0], to[1] - from[1]])
}

fn cross([a, b]: State, [c, d]: State) -> f64 {
    a * d - b * c
}

fn length([x, y]: State) -> f64 {
    x.hypot(y)
}

fn distance(from: &Sample, to: &Sample) -> f64 {
    match (from.image, to.image) {
        (Some(a), Some(b)) => length(vector(a.state, b.state)),
        _ => f64::INFINITY,
    }
}

fn sample(guess: &Guess, tube: &BoxChain, cell: usize, at: f64) -> Sample {
    let (left, right) = (&tube.chords()[cell], &tube.chords()[cell + 1]);
    let mix = |a: State, b: State| [0, 1].map(|i| (1.0 - at) * a[i] + at * b[i]);
    let (bottom, top) = (mix(left.bottom, right.bottom), mix(left.top, right.top));
    let middle = [0, 1].map(|i| 0.5 * (bottom[i] + top[i]));
    let half = [0, 1].map(|i| 0.5 * (top[i] - bottom[i]));
    Sample { cell, at, middle, half, image: guess.map(middle) }
}

impl Sample {
    /// Duration of the flight that is followed \[forcing periods\].
    fn turns(&self) -> f64 {
        self.image.map_or(MAX_PERIODS, |image| image.time)
    }

    fn image(&self) -> &Image {
        self.image.as_ref().expect("it is kept only with an image")
    }

    /// The image of the half chord, in radians and speeds.
    fn half_chord_image(&self) -> State {
        in_radians(applied(self.image().jacobian, self.half))
    }
}

impl Making {
    /// Returns the chains of boxes that hold the images of a chain of boxes, about.
    pub fn images(&self, guess: &Guess, tube: &BoxChain, work: &Allowance) -> Result<Vec<Proposal>, End> {
        let mut segments: Vec<Vec<Pair>> = vec![Vec::new()];
        let last = tube.cells() - 1;
        for cell in 0..=last {
            let ends = [0.0, 1.0].map(|at| sample(guess, tube, cell, at));
            self.refine((guess, work), tube, ends, [cell == 0, cell == last], &mut segments)?;
        }
        let mut proposals = Vec::new();
        for segment in segments.iter().filter(|segment| segment.len() >= MIN_PARTS) {
            proposals.extend(self.proposal((guess, work), segment)?);
        }
        Ok(proposals)
    }

    fn refine(
        &self,
        (guess, work): (&Guess, &Allowance),
        tube: &BoxChain,
        [from, to]: Pair,
        [first, last]: [bool; 2],
        segments: &mut Vec<Vec<Pair>>,
    ) -> Result<(), End> {
        let between = sample(guess, tube, from.cell, 0.5 * (from.at + to.at));
        work.spend(1, between.turns())?;
        let is_fine = self.is_fine([&from, &between, &to], first || last);
        let is_halved = from.at < between.at && between.at < to.at;
        if is_fine == Some(true) || length(vector(from.middle, to.middle)) < self.shortest || !is_halved {
            match is_fine {
                Some(_) if distance(&from, &to) <= self.longest => {
                    segments.last_mut().expect("one at least").push([from, to]);
                }
                _ => segments.push(Vec::new()),
            }
            return Ok(());
        }
        self.refine((guess, work), tube, [from, between], [first, false], segments)?;
        self.refine((guess, work), tube, [between, to], [false, last], segments)
    }

    /// Greatest error allowed in the place of a chord: a part of its excess over the image.
    fn room(&self, half_chord_image: f64) -> f64 {
        0.3 * ((self.margin - 1.0) * half_chord_image + self.pad)
    }

    /// Returns whether a part is short and straight enough; `None` where the map jumps in it.
    fn is_fine(&self, [from, between, to]: [&Sample; 3], is_end: bool) -> Option<bool> {
        let (a, m, b) = (from.image?, between.image?, to.image?);
        if a.is_far != b.is_far || a.is_far != m.is_far {
            return None;
        }
        let along = vector(a.state, b.state);
        let long = length(along);
        let bulge = (cross(along, vector(a.state, m.state)) / long).abs();
        let half_chord_image = (cross(along, between.half_chord_image()) / long).abs();
        let longest = if is_end { END_GRADING * self.longest } else { self.longest };
        Some(long <= longest && bulge <= self.room(half_chord_image))
    }

    fn proposal(&self, (guess, work): (&Guess, &Allowance), segment: &[Pair]) -> Result<Option<Proposal>, End> {
        let samples: Vec<&Sample> = segment.iter().map(|pair| &pair[0]).chain(segment.last().map(|p| &p[1])).collect();
        let mut lengths = vec![0.0];
        for pair in samples.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + distance(pair[0], pair[1]));
        }
        let (count, all) = (samples.len(), lengths[lengths.len() - 1]);
        // Chords are left out where cells would be shorter than need be: towards the ends they are short.
        let mut kept = vec![0];
        for k in 1..count {
            let start = kept[kept.len() - 1];
            let next = (k + 1).min(count - 1);
            // As long at least as intervals of parameters move images to and fro.
            let moved = samples[k].image().moved.map(in_radians).map(length);
            let most = (0.4 * self.longest).min(0.3 * lengths[start].min(all - lengths[next])).max(moved[0] + moved[1]);
            let is_needed = k + 1 == count || lengths[next] - lengths[start] > most;
            if is_needed || !self.is_straight(&samples[start..=next]) {
                kept.push(k);
            }
        }
        for &k in &kept {
            work.spend(self.ahead, samples[k].turns())?;
        }
        let at = |n: usize| samples[kept[n]].image().state;
        let chord = |n: usize| {
            let tangent = vector(at(n.saturating_sub(1)), at((n + 1).min(kept.len() - 1)));
            self.chord(guess, samples[kept[n]], tangent)
        };
        let Some(chords) = (0..kept.len()).map(chord).collect::<Option<Vec<Chord>>>() else { return Ok(None) };
        let mut place = 0;
        let part = |(k, [from, to]): (usize, &Pair)| {
            while kept[place + 1] <= k {
                place += 1;
            }
            Part { cell: from.cell, from: from.at, to: to.at, place }
        };
        let parts = segment.iter().enumerate().map(part).collect();
        Ok(Some(Proposal { parts, is_far: samples[0].image().is_far, next: BoxChain::new(chords) }))
    }

    fn is_straight(&self, samples: &[&Sample]) -> bool {
        let from = samples[0].image().state;
        let along = vector(from, samples[samples.len() - 1].image().state);
        let long = length(along);
        let half_chord_image = (cross(along, samples[(samples.len() - 1) / 2].half_chord_image()) / long).abs();
        let off = |sample: &&Sample| (cross(along, vector(from, sample.image().state)) / long).abs();
        samples.iter().all(|sample| off(sample) <= self.room(half_chord_image))
    }

    /// The chord at an image, along the direction that is contracted most from there on.
    fn chord(&self, guess: &Guess, sample: &Sample, tangent: State) -> Option<Chord> {
        let state = sample.image().state;
        let long = length(tangent);
        let lean = |direction: State| cross(tangent, direction) / (long * length(direction));
        let contracted =
            guess.contracting(state, self.ahead).map(in_radians).filter(|&direction| lean(direction).abs() > 0.05);
        let direction = contracted.unwrap_or_else(|| sample.half_chord_image());
        let sine = lean(direction);
        let across = |direction: State| (cross(tangent, direction) / (long * sine)).abs();
        let moved = sample.image().moved.map(in_radians).map(across);
        let reach = (self.margin * (across(sample.half_chord_image()) + moved[0] + moved[1]) + self.pad)
            * sine.signum()
            / length(direction);
        let end = |sign: f64| [state[0] + sign * reach * direction[0] / TAU, state[1] + sign * reach * direction[1]];
        (reach.is_finite() && sine != 0.0).then(|| Chord { bottom: end(-1.0), top: end(1.0) })
    }
}

/// A vector with its phase in radians.
fn in_radians([u, w]: State) -> State {
    [TAU * u, w]
}
