//! The next cell chain, proposed in doubles: the images of chords, refined where they are stretched and cut where the map jumps.
//!
//! Labels: proposes throughout.

use super::guess::{Guess, Image};
use super::law::Side;
use super::quad::{Chord, State};
use super::tube::{BoxChain, Part};
use super::vector::{applied, cross, length, minus, radians};

/// Settings by which cell chains are made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Making {
    /// Cells are about as long at most, phases in radians.
    pub longest: f64,
    /// Factor by which a chord is longer than the image that it holds, and a length beyond that.
    pub margin: f64,
    pub pad: f64,
    /// Parts are not cut below this length.
    pub shortest: f64,
    /// Impacts ahead that the contracting direction is determined from.
    pub ahead: usize,
}

/// Proposed cell chain for the image of a stretch of another cell chain.
pub(crate) struct Proposal {
    pub parts: Vec<Part>,
    pub side: Side,
    pub next: BoxChain,
}

#[derive(Clone, Copy)]
struct Sample {
    cell: usize,
    at: f64,
    half: State,
    image: Option<Image>,
}

/// Factor by which parts at the ends of a cell chain are shorter: some cells are lost there with each impact, and words begin near grazes.
const END_GRADING: f64 = 0.001;
/// Least number of parts of a proposed cell chain.
const MIN_PARTS: usize = 12;
/// Parts of one image that are looked at: where the map contracts to a line (e = 0), none is short enough to be straight.
const MAX_PARTS: usize = 1 << 18;

/// The parts of an image, cut where the map jumps, and how many were looked at.
struct Parts {
    segments: Vec<Vec<(Sample, Sample)>>,
    seen: usize,
}

impl Making {
    /// Proposes the cell chains that hold the images of a cell chain.
    pub fn images(&self, guess: &Guess, tube: &BoxChain) -> Vec<Proposal> {
        let mut parts = Parts { segments: vec![Vec::new()], seen: 0 };
        for cell in 0..tube.cells() {
            let (from, to) = (sample(guess, tube, cell, -1.0), sample(guess, tube, cell, 1.0));
            self.refine(guess, tube, from, to, (cell == 0, cell + 1 == tube.cells()), &mut parts);
        }
        if parts.seen > MAX_PARTS {
            return Vec::new();
        }
        parts
            .segments
            .iter()
            .filter(|segment| segment.len() >= MIN_PARTS)
            .filter_map(|segment| self.proposal(guess, segment))
            .collect()
    }

    fn refine(
        &self,
        guess: &Guess,
        tube: &BoxChain,
        from: Sample,
        to: Sample,
        (first, last): (bool, bool),
        parts: &mut Parts,
    ) {
        parts.seen += 1;
        if parts.seen > MAX_PARTS {
            return;
        }
        let chords = &tube.chords()[from.cell..=from.cell + 1];
        let width = 0.5 * (to.at - from.at) * length(minus(middle(&chords[1]), middle(&chords[0])));
        let between = sample(guess, tube, from.cell, 0.5 * (from.at + to.at));
        let is_fine = self.is_fine(&from, &between, &to, first || last);
        if is_fine == Some(true) || width < self.shortest {
            match is_fine {
                None => parts.segments.push(Vec::new()),
                Some(_) if self.jumps(&from, &to) => parts.segments.push(Vec::new()),
                Some(_) => parts.segments.last_mut().expect("one at least").push((from, to)),
            }
            return;
        }
        self.refine(guess, tube, from, between, (first, false), parts);
        self.refine(guess, tube, between, to, (false, last), parts);
    }

    fn jumps(&self, from: &Sample, to: &Sample) -> bool {
        let (Some(a), Some(b)) = (from.image, to.image) else { return true };
        length(minus(a.state, b.state)) > self.longest
    }

    /// Whether a part is short and straight enough; `None` where the map jumps in it.
    fn is_fine(&self, from: &Sample, between: &Sample, to: &Sample, is_end: bool) -> Option<bool> {
        let (a, m, b) = (from.image?, between.image?, to.image?);
        if a.side != b.side || a.side != m.side {
            return None;
        }
        let along = radians(minus(b.state, a.state));
        let long = along[0].hypot(along[1]);
        let bulge = (cross(along, radians(minus(m.state, a.state))) / long).abs();
        let thick = (cross(along, radians(applied(m.jacobian, between.half))) / long).abs();
        let longest = if is_end { END_GRADING * self.longest } else { self.longest };
        Some(long <= longest && bulge <= 0.3 * ((self.margin - 1.0) * thick + self.pad))
    }

    fn proposal(&self, guess: &Guess, segment: &[(Sample, Sample)]) -> Option<Proposal> {
        let samples = || segment.iter().map(|(from, _)| from).chain(segment.last().map(|(_, to)| to));
        let images: Vec<Image> = samples().map(|sample| sample.image.expect("an image")).collect();
        let halves: Vec<State> = samples().map(|sample| sample.half).collect();
        let origins: Vec<f64> = samples().map(|sample| sample.cell as f64 + 0.5 * (1.0 + sample.at)).collect();
        let mut lengths = vec![0.0];
        for pair in images.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + length(minus(pair[1].state, pair[0].state)));
        }
        let all = lengths[lengths.len() - 1];
        // The chords that are kept: all but where cells would be shorter than need be.
        let mut kept = vec![0];
        for k in 1..images.len() {
            let start = kept[kept.len() - 1];
            let is_last = k + 1 == images.len();
            let room = lengths[start].min(all - lengths[(k + 1).min(images.len() - 1)]);
            // As long at least as intervals of parameters move images to and fro.
            let moved = images[k].moved.map(length);
            let most = (0.4 * self.longest).min(0.3 * room).max(moved[0] + moved[1]);
            let would = if is_last { f64::INFINITY } else { lengths[k + 1] - lengths[start] };
            if would > most || !self.is_straight(&images, &halves, start, (k + 1).min(images.len() - 1)) {
                kept.push(k);
            }
        }
        let mut chords = Vec::with_capacity(kept.len());
        for (n, &k) in kept.iter().enumerate() {
            let before = images[kept[n.saturating_sub(1)]].state;
            let after = images[kept[(n + 1).min(kept.len() - 1)]].state;
            chords.push(self.chord(guess, &images[k], halves[k], minus(after, before))?);
        }
        let mut parts = Vec::with_capacity(segment.len());
        let mut place = 0;
        for (k, (from, to)) in segment.iter().enumerate() {
            while kept[place + 1] <= k {
                place += 1;
            }
            parts.push(Part { cell: from.cell, from: from.at, to: to.at, place });
        }
        Some(Proposal {
            parts,
            side: images[0].side,
            next: BoxChain::new(chords, kept.iter().map(|&k| origins[k]).collect()),
        })
    }

    fn is_straight(&self, images: &[Image], halves: &[State], from: usize, to: usize) -> bool {
        let along = radians(minus(images[to].state, images[from].state));
        let long = along[0].hypot(along[1]);
        let half = (from + to) / 2;
        let thick = (cross(along, radians(applied(images[half].jacobian, halves[half]))) / long).abs();
        let room = 0.3 * ((self.margin - 1.0) * thick + self.pad);
        (from + 1..to).all(|k| (cross(along, radians(minus(images[k].state, images[from].state))) / long).abs() <= room)
    }

    /// The chord at an image, along the direction that is contracted most from there on.
    fn chord(&self, guess: &Guess, image: &Image, half: State, tangent: State) -> Option<Chord> {
        let half = applied(image.jacobian, half);
        let tangent = radians(tangent);
        let long = tangent[0].hypot(tangent[1]);
        let lean = |direction: State| cross(tangent, radians(direction)) / (long * length(direction));
        let direction = guess
            .contracting(image.state, self.ahead)
            .filter(|&direction| lean(direction).abs() > 0.05)
            .unwrap_or(half);
        let size = length(direction);
        let unit = direction.map(|x| x / size);
        let sine = lean(direction);
        let across = |direction: State| (cross(tangent, radians(direction)) / (long * sine)).abs();
        let moved = image.moved.map(across);
        let reach = (self.margin * (across(half) + moved[0] + moved[1]) + self.pad) * sine.signum();
        let [u, w] = image.state;
        let at = |sign: f64| [u + sign * reach * unit[0], w + sign * reach * unit[1]];
        (reach.is_finite() && sine != 0.0).then(|| Chord { bottom: at(-1.0), top: at(1.0) })
    }
}

fn middle(chord: &Chord) -> State {
    [0.5 * (chord.bottom[0] + chord.top[0]), 0.5 * (chord.bottom[1] + chord.top[1])]
}

fn sample(guess: &Guess, tube: &BoxChain, cell: usize, at: f64) -> Sample {
    let (from, to) = (&tube.chords()[cell], &tube.chords()[cell + 1]);
    let mix = |a: State, b: State| [0, 1].map(|i| 0.5 * ((1.0 - at) * a[i] + (1.0 + at) * b[i]));
    let chord = Chord { bottom: mix(from.bottom, to.bottom), top: mix(from.top, to.top) };
    let half = [0, 1].map(|i| 0.5 * (chord.top[i] - chord.bottom[i]));
    Sample { cell, at, half, image: guess.map(middle(&chord)) }
}
