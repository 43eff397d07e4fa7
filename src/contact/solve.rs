//! Floating point proposes: the first contact of a flight, by monotone pieces and safeguarded Halley steps.
//!
//! Nothing here is proved. This is the `float` arithmetic, the baseline of the benches (with the standard
//! library's trigonometry), and what [`super::certify`] verifies. It works in plain doubles and allocates
//! nothing.

// Labels: proposes throughout.

use std::ops::RangeInclusive;

use super::extrema::{Extrema, Piece, Target};
use crate::flight::Flight;
use crate::number::Trigonometry;
use crate::number::kernel::SmallAngle;
use crate::pair::Inward;

/// Steps to a root within a monotone piece: halving alone takes one a bit of a double.
const MOST_STEPS: u32 = 64;
/// Newton steps to the end of a hop: each doubles the digits of a guess that is right for short ones.
const MOST_HOP_STEPS: u32 = 8;

/// Longest flight that is followed, in forcing periods: the domain of the phase kernel ends there.
pub(crate) const LONGEST_FLIGHT: f64 = (1_u64 << 39) as f64;

/// Whether a phase is within 2 forcing periods of 0.
///
/// Lemma C4: then mirroring rounds the phase by at most 2 UNIT; orbits count whole forcing periods apart.
#[inline(always)]
pub(super) fn is_phase(phase: f64) -> bool {
    phase.abs() < 2.0
}

/// Last iterate of the solver: its place, the values there, and the step that leads to the root.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Iterate {
    pub target: Target,
    /// Whole forcing periods since the phase of the start.
    pub turns: f64,
    /// Phase of arrival less the whole forcing periods; for a hop the time since the start.
    pub at: f64,
    /// `z - target` there.
    pub residual: f64,
    /// `z'` there.
    pub velocity: f64,
    /// Mirrored sine and cosine there.
    pub sin: f64,
    pub cos: f64,
    /// The step that leads from here to the root: Halley's, for a hop Newton's.
    pub step: f64,
}

/// The treatment of a proposed first contact; each kind of flight has its own proof.
///
/// A trait and not an enum: each kind is compiled with its judge, and nothing passes through memory.
pub(crate) trait Verifier {
    type Answer;
    /// `|c| >= beta`: `z` is monotone for ever.
    fn monotone(&self, iterate: &Iterate) -> Self::Answer;
    /// A short flight back to the wall under wall-ward acceleration all along; the unknown is the time.
    fn hop(&self, iterate: &Iterate, departure: &SmallAngle) -> Self::Answer;
    /// The contact lies on a monotone piece, before extremum `k` of its kind.
    fn piece(&self, iterate: &Iterate, extrema: &Extrema, k: f64) -> Self::Answer;
    /// There is no contact to propose.
    fn nothing(&self, why: NoProposal) -> Self::Answer;
}

/// The reason why the solver proposes no contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoProposal {
    /// The drift is 0: the motion repeats inside the gap for ever.
    NoDrift,
    /// The ball starts with zero velocity and sticks to its wall, by the contact force.
    Rest,
    /// The flight would last longer than [`LONGEST_FLIGHT`].
    TooLong,
}

/// The first contact of `flight`, as far as doubles can tell, passed to `judge`.
#[inline(always)]
pub(crate) fn propose<T: Trigonometry, J: Verifier>(flight: &Flight<f64>, judge: &J) -> J::Answer {
    if flight.is_monotone() {
        if flight.drift == 0.0 {
            return judge.nothing(NoProposal::NoDrift);
        }
        let (search, guess) = on_monotone(flight);
        if guess > LONGEST_FLIGHT {
            return judge.nothing(NoProposal::TooLong);
        }
        return judge.monotone(&refine::<T>(flight, search));
    }
    if flight.height == 0.0 && flight.sin <= 0.0 {
        if flight.velocity <= 0.0 {
            return judge.nothing(NoProposal::Rest);
        }
        if let Some((iterate, departure)) = hop::<T>(flight) {
            return judge.hop(&iterate, &departure);
        }
    }
    let mut extrema = Extrema::new::<T>(flight);
    let margin = T::ACOS_ERROR * flight.beta;
    let mut piece = extrema.first_piece(flight.drift);
    if piece.is_none_or(|found| extrema.is_close(&found, flight.drift, margin)) {
        extrema.refine::<T>(flight);
        piece = extrema.first_piece(flight.drift);
    }
    match piece {
        Some(piece) if piece.k <= LONGEST_FLIGHT => {
            judge.piece(&refine::<T>(flight, on_piece(flight, &extrema, piece)), &extrema, piece.k)
        }
        Some(_) => judge.nothing(NoProposal::TooLong),
        None => judge.nothing(NoProposal::NoDrift),
    }
}

/// The bracket in which a root is searched, which [`refine`] narrows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search {
    pub target: Target,
    pub turns: f64,
    pub at: f64,
    pub low: f64,
    pub high: f64,
}

/// Bracket of the contact on a given piece of a flight that has extrema.
#[inline(always)]
pub(super) fn on_piece(flight: &Flight<f64>, extrema: &Extrema, piece: Piece) -> Search {
    let target = piece.target;
    let (first, span) = extrema.before(target);
    // The distance of the extremum beyond the target, as a fraction of the rise or fall of the piece.
    let (beyond, rise) = match target {
        Target::Far => ((extrema.max - 1.0) + piece.k * flight.drift, flight.drift * span),
        Target::Near => (-extrema.min - piece.k * flight.drift, -flight.drift * span),
    };
    let fraction = beyond / (2.0 * flight.alpha).mul_add(extrema.sine, rise);
    let end = flight.phase + first;
    let guess = (-span).mul_add(inverse_smoothstep(fraction), end);
    let whole = whole_turns(guess);
    Search { target, turns: piece.k + whole, at: guess - whole, low: end - span - whole, high: end - whole }
}

/// `z` is monotone: solve Kepler's equation, starting at the mean anomaly; with it comes the guess of the time.
#[inline(always)]
pub(super) fn on_monotone(flight: &Flight<f64>) -> (Search, f64) {
    let target = if flight.drift > 0.0 { Target::Far } else { Target::Near };
    // The time if sin th1 were 0; the true one is at most alpha/|c| forcing periods away, and not before the start.
    let base = flight.alpha.mul_add(flight.sin, flight.height - target.height());
    let mean = -base / flight.drift;
    let spread = flight.alpha / flight.drift.abs();
    let guess = mean.max(0.0);
    let long = whole_turns(guess);
    let near = flight.phase + (guess - long);
    let whole = whole_turns(near);
    let at = near - whole;
    let centre = at + (mean - guess);
    (Search { target, turns: long + whole, at, low: centre - spread, high: centre + spread }, guess)
}

impl Search {
    /// Values at the current place, and whether the next step is as good as exact.
    #[inline(always)]
    pub fn look<T: Trigonometry>(&self, flight: &Flight<f64>) -> (Iterate, bool) {
        let Self { target, turns, at, .. } = *self;
        let (sin, cos) = flight.wall.mirror(T::sin_cos(at));
        let residual = flight.height_above(target.height(), turns, at, sin);
        let velocity = flight.velocity_at(cos);
        let bend = 0.5 * flight.acceleration_at(sin);
        let square = velocity * velocity;
        let step = residual * velocity / bend.mul_add(-residual, square);
        // More than a quarter of the third derivative, 4 pi^2 beta at most.
        let jerk = 10.0 * flight.beta;
        // The next error is about (bend^2/velocity^2 + jerk/velocity) step^3 at most: is that below 2^-57 forcing periods?
        let cube = (step * step * step).abs();
        let error = cube * bend.mul_add(bend, jerk * velocity.abs());
        (Iterate { target, turns, at, residual, velocity, sin, cos, step }, error <= 2f64.powi(-57) * square)
    }

    /// The step from here, or half the bracket.
    #[inline(always)]
    pub fn advance(&mut self, iterate: &Iterate) {
        let direction = self.target.direction();
        if (iterate.residual > 0.0) == (direction > 0.0) {
            self.high = self.at;
        } else {
            self.low = self.at;
        }
        let next = self.at - iterate.step;
        let is_inside = iterate.velocity * direction > 0.0 && self.low < next && next < self.high;
        self.at = if is_inside { next } else { 0.5 * (self.low + self.high) };
    }
}

/// Halley steps, kept inside the bracket, until the next one is as good as exact.
#[inline(always)]
fn refine<T: Trigonometry>(flight: &Flight<f64>, mut search: Search) -> Iterate {
    let mut left = MOST_STEPS;
    loop {
        let (iterate, is_last) = search.look::<T>(flight);
        left -= 1;
        if is_last || left == 0 {
            return iterate;
        }
        search.advance(&iterate);
        if search.at == iterate.at {
            left = 1;
        }
    }
}

/// Durations of hops, in forcing periods, that Newton's steps find from the guess, which is right for short hops.
const HOPS: RangeInclusive<f64> = 4.909093465297727e-91..=0.0625;

/// Duration of a hop under constant acceleration, if Newton steps from there lead to its end.
#[inline(always)]
pub(super) fn hop_guess(flight: &Flight<f64>) -> Option<f64> {
    let guess = -2.0 * flight.velocity / flight.acceleration_at(flight.sin);
    HOPS.contains(&guess).then_some(guess)
}

/// State `at` forcing periods after the start on a wall, at most an eighth: the departure root divided out.
#[inline(always)]
pub(super) fn look_near<T: Trigonometry>(flight: &Flight<f64>, target: Target, at: f64) -> (Iterate, SmallAngle) {
    let departure = T::departure(at);
    let (sin, cos) = flight.hop_sin_cos(&departure);
    let residual = flight.hop_height(at, departure.versine, departure.excess) - target.height();
    let velocity = flight.hop_velocity(departure.versine, departure.sine);
    let step = residual / velocity;
    (Iterate { target, turns: 0.0, at, residual, velocity, sin, cos, step }, departure)
}

impl Iterate {
    /// Whether the iterate is on a hop: falling, with acceleration towards the wall.
    #[inline(always)]
    pub fn is_on_hop(&self) -> bool {
        (self.velocity < 0.0) & (self.sin < 0.0)
    }

    /// Whether a hop's next Newton step is as good as exact: its error, relative to the time, is about `(step/time)^2`.
    #[inline(always)]
    pub fn is_last_of_hop(&self) -> bool {
        self.step.abs() <= 2f64.powi(-28) * self.at
    }
}

/// A return to the wall within an eighth of a forcing period, while the wall-ward acceleration lasts.
#[inline(always)]
fn hop<T: Trigonometry>(flight: &Flight<f64>) -> Option<(Iterate, SmallAngle)> {
    let mut at = hop_guess(flight)?;
    for _ in 0..MOST_HOP_STEPS {
        let (iterate, departure) = look_near::<T>(flight, Target::Near, at);
        if !iterate.is_on_hop() {
            return None;
        }
        if iterate.is_last_of_hop() {
            return (!reaches_far(flight, at)).then_some((iterate, departure));
        }
        at -= iterate.step;
        if !(0.0..=0.125).contains(&at) {
            return None;
        }
    }
    None
}

/// Whether the far wall may be reached within `time` forcing periods.
#[inline(always)]
pub(super) fn reaches_far(flight: &Flight<f64>, time: f64) -> bool {
    flight.velocity * time >= 1.0
}

/// Forcing periods to take off a phase: none up to one forcing period, where the phase itself is as fine.
#[inline(always)]
fn whole_turns(phase: f64) -> f64 {
    if phase.abs() <= 1.0 { 0.0 } else { phase.round() }
}

/// The `x` in `[0, 1]` at which `3 x^2 - 2 x^3` is `v`, to within 0.004: a guess for a piece with flat ends.
#[inline(always)]
pub(super) fn inverse_smoothstep(v: f64) -> f64 {
    let v = v.clamp(0.0, 1.0);
    let s = v.min(1.0 - v).sqrt();
    let x = s * 0.1024f64.mul_add(s, 0.1111).mul_add(s, 0.57735);
    if v > 0.5 { 1.0 - x } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_guess_on_a_piece_with_flat_ends_is_as_good_as_it_says() {
        for x in (0..=1000).map(|i| f64::from(i) / 1000.0) {
            assert!((inverse_smoothstep((3.0 - 2.0 * x) * x * x) - x).abs() < 4e-3, "{x}");
        }
        assert_eq!([-1.0, 0.0, 1.0, 7.0].map(inverse_smoothstep), [0.0, 0.0, 1.0, 1.0]);
    }
}
