//! Floating point proposes: the first contact of a flight, by monotone pieces and safeguarded Halley steps.
//!
//! Nothing here is proved. This is the `float` arithmetic, the baseline of the benches (with the standard
//! library's trigonometry), and what [`super::certify`] verifies. It works in plain doubles and allocates
//! nothing.

use super::extrema::{Extrema, Piece, Target};
use crate::flight::Flight;
use crate::number::Trigonometry;

/// Flights longer than this many turns are not followed: the phase kernel ends there.
pub(crate) const LONGEST_FLIGHT: f64 = (1_u64 << 39) as f64;

/// How the contact was found, and so what has to be proved about it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Course {
    /// `|c| >= beta`: `z` is monotone for ever.
    Monotone,
    /// A short flight back to the wall under wall-ward acceleration all along; the unknown is `h`.
    Hop,
    /// The contact lies on a monotone piece between two extrema.
    Piece(Extrema, Piece),
}

/// The last iterate of the solver: where it stood, what it saw, and where one more Newton step leads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Iterate {
    /// Whole turns since the phase of the start (0 for a hop).
    pub turns: f64,
    /// The phase of arrival less the whole turns; for a hop the time `h` since the start.
    pub at: f64,
    /// `z - target` there.
    pub residual: f64,
    /// `z'` there.
    pub velocity: f64,
    /// Mirrored sine there.
    pub sin: f64,
    /// Size of the terms whose rounding the residual of a hop carries: versine plus excess, and the sine.
    pub hop: (f64, f64),
}

/// A proposed first contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Proposal {
    pub target: Target,
    pub course: Course,
    pub iterate: Iterate,
}

/// Why the solver proposes no contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoProposal {
    /// The drift is 0: the motion repeats inside the gap for ever.
    NoDrift,
    /// The ball starts with no velocity and is pressed against its wall.
    Rest,
    /// The flight would last longer than [`LONGEST_FLIGHT`].
    TooLong,
}

/// The first contact of `flight`, as far as doubles can tell.
#[inline(always)]
pub(crate) fn propose<T: Trigonometry>(flight: &Flight<f64>) -> Result<Proposal, NoProposal> {
    // `>=` fails for NaN (no excitation, no velocity), which then shows as a missing drift below.
    if flight.drift.abs() >= flight.beta {
        return monotone::<T>(flight);
    }
    if flight.height == 0.0 && flight.sin <= 0.0 {
        if flight.velocity <= 0.0 {
            return Err(NoProposal::Rest);
        }
        if let Some(proposal) = hop::<T>(flight) {
            return Ok(proposal);
        }
    }
    let mut extrema = Extrema::new::<T>(flight);
    let margin = T::ACOS_ERROR * flight.beta;
    let mut piece = extrema.first_piece(flight.drift);
    if piece.is_none_or(|found| extrema.is_close(&found, flight.drift, margin)) {
        extrema.refine::<T>(flight);
        piece = extrema.first_piece(flight.drift);
    }
    on_piece::<T>(flight, extrema, piece.ok_or(NoProposal::NoDrift)?)
}

/// The contact on a given piece of a flight that has extrema.
#[inline(always)]
pub(crate) fn on_piece<T: Trigonometry>(
    flight: &Flight<f64>,
    extrema: Extrema,
    piece: Piece,
) -> Result<Proposal, NoProposal> {
    if piece.k > LONGEST_FLIGHT {
        return Err(NoProposal::TooLong);
    }
    let target = piece.target;
    let (first, span) = extrema.before(target);
    // How far the extremum lies beyond the target, as a fraction of the rise or fall of the piece.
    let (beyond, rise) = match target {
        Target::Far => ((extrema.max - 1.0) + piece.k * flight.drift, flight.drift * span),
        Target::Near => (-extrema.min - piece.k * flight.drift, -flight.drift * span),
    };
    let fraction = beyond / (2.0 * flight.alpha).mul_add(extrema.sine, rise);
    let end = flight.phase + first;
    let guess = (-span).mul_add(inverse_smoothstep(fraction), end);
    let whole = guess.round();
    let bracket = (end - span - whole, end - whole);
    let iterate = refine::<T>(flight, target, piece.k + whole, guess - whole, bracket);
    Ok(Proposal { target, course: Course::Piece(extrema, piece), iterate })
}

/// `z` is monotone: solve Kepler's equation, starting at the mean anomaly.
#[inline(always)]
fn monotone<T: Trigonometry>(flight: &Flight<f64>) -> Result<Proposal, NoProposal> {
    if flight.drift == 0.0 || flight.drift.is_nan() {
        return Err(NoProposal::NoDrift);
    }
    let target = if flight.drift > 0.0 { Target::Far } else { Target::Near };
    // Where sin th1 = 0 would have it; the truth is at most alpha/|c| turns away, and not before the start.
    let base = flight.alpha.mul_add(flight.sin, flight.height - target.height());
    let mean = -base / flight.drift;
    let spread = flight.alpha / flight.drift.abs();
    let guess = mean.max(0.0);
    if guess > LONGEST_FLIGHT {
        return Err(NoProposal::TooLong);
    }
    let long = guess.floor();
    let near = flight.phase + (guess - long);
    let whole = near.round();
    let at = near - whole;
    let shift = mean - guess;
    let bracket = (at + shift - spread, at + shift + spread);
    let iterate = refine::<T>(flight, target, long + whole, at, bracket);
    Ok(Proposal { target, course: Course::Monotone, iterate })
}

/// Halley steps from `at`, kept inside `bracket`, until one more Newton step is as good as exact.
#[inline(always)]
fn refine<T: Trigonometry>(
    flight: &Flight<f64>,
    target: Target,
    turns: f64,
    mut at: f64,
    bracket: (f64, f64),
) -> Iterate {
    let (mut low, mut high) = bracket;
    let (height, direction) = (target.height(), target.direction());
    let mut left = 64;
    loop {
        let (sin, cos) = flight.wall.mirror(T::sin_cos(at));
        let residual = flight.height_above(height, turns, at, sin);
        let velocity = flight.velocity_at(cos);
        let bend = 0.5 * flight.acceleration_at(sin);
        // Newton's next error is (bend/velocity) step^2, step = residual/velocity: below 2^-57 turns?
        let square = velocity * velocity;
        left -= 1;
        if (bend * residual * residual).abs() <= 2f64.powi(-57) * square * velocity.abs() || left == 0 {
            return Iterate { turns, at, residual, velocity, sin, hop: (0.0, 0.0) };
        }
        if (residual > 0.0) == (direction > 0.0) {
            high = at;
        } else {
            low = at;
        }
        let next = at - residual * velocity / bend.mul_add(-residual, square);
        let next = if velocity * direction > 0.0 && low < next && next < high { next } else { 0.5 * (low + high) };
        if next == at {
            left = 1;
        }
        at = next;
    }
}

/// A return to the wall within an eighth of a turn, while the wall-ward acceleration lasts.
#[inline(always)]
fn hop<T: Trigonometry>(flight: &Flight<f64>) -> Option<Proposal> {
    let guess = -2.0 * flight.velocity / flight.acceleration_at(flight.sin);
    // A hop of an eighth of a turn would lose its way to the end of the wall-ward half turn.
    if !(2f64.powi(-300)..=0.0625).contains(&guess) {
        return None;
    }
    let mut h = guess;
    for _ in 0..8 {
        let d = T::departure(h);
        let (sin, _) = flight.hop_sin_cos(&d);
        let residual = flight.hop_height(h, d.versine, d.excess);
        let velocity = flight.hop_velocity(d.versine, d.sine);
        if velocity >= 0.0 || sin >= 0.0 {
            return None;
        }
        let step = residual / velocity;
        // The next error, relative to h, is about (step/h)^2.
        if step.abs() <= 2f64.powi(-28) * h {
            let hop = (d.versine + d.excess, d.sine);
            let iterate = Iterate { turns: 0.0, at: h, residual, velocity, sin, hop };
            let reaches_far = flight.velocity * h >= 1.0;
            return (!reaches_far).then_some(Proposal { target: Target::Near, course: Course::Hop, iterate });
        }
        h -= step;
        if !(0.0..=0.125).contains(&h) {
            return None;
        }
    }
    None
}

/// Where `3 x^2 - 2 x^3` takes the value `v`, to a thousandth: a guess for a piece with flat ends.
#[inline(always)]
fn inverse_smoothstep(v: f64) -> f64 {
    let v = v.clamp(0.0, 1.0);
    let s = v.min(1.0 - v).sqrt();
    let x = s * 0.1024f64.mul_add(s, 0.1111).mul_add(s, 0.57735);
    if v > 0.5 { 1.0 - x } else { x }
}
