//! The enclosure disposes: what a floating proposal is worth, proved.
//!
//! Here stand the a-priori error bounds of the hot path (Lemmas C1-C6 of `docs/proofs.md`, same labels). A
//! flight is certified for every start and every parameter within [`Radii`] of the doubles it was computed
//! with; a point flight has radii that only cover the rounding of its parameters.

use super::extrema::{Extrema, Target};
use super::solve::{Course, Iterate, Proposal};
use crate::flight::Flight;
use crate::number::kernel::{ACOS_ERROR, DEPARTURE_ERROR, SIN_COS_ERROR};
use crate::number::{Ball, Kernel, UNIT, up};

/// An upper bound of `2 pi`.
const TAU: f64 = std::f64::consts::TAU.next_up();
/// More than what the additions that make an error bound lose themselves (Lemma C1).
const SLACK: f64 = 1.0 + 64.0 * UNIT;

/// How far the true start and parameters may lie from the doubles of a [`Flight`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Radii {
    /// of the phase of the start, in turns
    pub phase: f64,
    /// of `z'` at the start
    pub velocity: f64,
    /// of `z` at the start; for a start inside the gap at least `2^-53` (Lemma C1)
    pub height: f64,
    /// of `alpha`
    pub alpha: f64,
    /// of `beta`
    pub beta: f64,
}

/// Bounds of one flight's errors that hold all along it.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    radii: Radii,
    /// upper bounds of `alpha` and `beta`
    alpha: f64,
    beta: f64,
    /// of `|c - computed c|` for a fixed start (C1)
    drift: f64,
    /// of `|d c / d phase0|` over the start
    swing: f64,
    /// of `|z'(0)|`
    speed: f64,
}

/// A proved arrival: exactly one root of the piece lies in `at`, for each start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arrival {
    pub target: Target,
    /// Whole turns.
    pub turns: f64,
    /// Phase of arrival less the whole turns.
    pub phase: Ball,
    /// Time since the start, in turns.
    pub time: Ball,
    /// `z'` on arrival.
    pub velocity: Ball,
    /// Mirrored sine on arrival.
    pub sin: Ball,
    /// The unknown of the proposal: the phase, or the time of a hop.
    at: Ball,
    /// Bound of the error of `z - target` near the contact.
    error: f64,
}

impl Bounds {
    #[inline(always)]
    fn new(flight: &Flight<f64>, radii: Radii) -> Self {
        let alpha = flight.alpha + radii.alpha;
        let beta = flight.beta + radii.beta;
        let swing = TAU * beta * (flight.sin.abs() + SIN_COS_ERROR + TAU * radii.phase);
        let drift = beta * SIN_COS_ERROR + UNIT * flight.drift.abs() + radii.beta + f64::MIN_POSITIVE;
        let speed = flight.velocity.abs() + radii.velocity;
        Self { radii, alpha, beta, drift, swing, speed }
    }

    /// Lemma C1: `|z - z_computed|` at fixed phase, up to `time` turns after the start.
    #[inline(always)]
    fn height(&self, flight: &Flight<f64>, time: f64, residual: f64) -> f64 {
        let span = time.abs() + self.radii.phase;
        let rounding = self.drift * span
            + UNIT * (2.0 * (flight.drift * time).abs() + 2.0 * residual.abs() + 1.0)
            + self.alpha * (2.0 * SIN_COS_ERROR + 4.0 * UNIT)
            + 2.0 * self.radii.alpha
            + self.radii.height;
        let start = self.radii.velocity * span + self.radii.phase * (self.speed + self.swing * span);
        SLACK * (rounding + start)
    }

    /// Lemma C2: `|z' - z'_computed|` at fixed phase.
    #[inline(always)]
    fn velocity(&self, flight: &Flight<f64>, velocity: f64) -> f64 {
        SLACK
            * (2.0 * self.beta * SIN_COS_ERROR
                + 2.0 * self.radii.beta
                + self.radii.velocity
                + self.swing * self.radii.phase
                + UNIT * (flight.drift.abs() + velocity.abs())
                + f64::MIN_POSITIVE)
    }

    /// Lemma C1 for a hop: `terms` is versine plus excess.
    #[inline(always)]
    fn hop_height(&self, h: f64, terms: f64, residual: f64) -> f64 {
        let per_term = self.alpha * (SIN_COS_ERROR + DEPARTURE_ERROR + 4.0 * UNIT)
            + self.radii.alpha
            + self.beta * self.radii.phase;
        let rounding = UNIT * (3.0 * self.speed * h + 2.0 * residual.abs());
        SLACK * (terms * per_term + rounding + self.radii.velocity * h + f64::MIN_POSITIVE)
    }

    /// Lemma C2 for a hop: `terms` is versine plus sine.
    #[inline(always)]
    fn hop_velocity(&self, terms: f64, velocity: f64) -> f64 {
        let per_term =
            self.beta * (SIN_COS_ERROR + DEPARTURE_ERROR + 4.0 * UNIT + TAU * self.radii.phase) + self.radii.beta;
        SLACK * (terms * per_term + self.radii.velocity + UNIT * (self.speed + 2.0 * velocity.abs()))
    }

    /// Lemma C4: how far a critical phase may lie from the computed one, in turns.
    #[inline(always)]
    fn critical_phase(&self, flight: &Flight<f64>) -> f64 {
        let drift = self.drift + self.radii.velocity + self.swing * self.radii.phase + self.radii.beta;
        let ratio = SLACK * drift / (flight.beta - self.radii.beta) + UNIT;
        // acos is Hoelder continuous with exponent 1/2: |acos x - acos y| <= pi sqrt(|x - y|/2).
        if ratio >= 0.0 { ACOS_ERROR + 0.354 * ratio.sqrt() + 16.0 * UNIT } else { f64::INFINITY }
    }
}

/// Lemma C3: a bracket around the proposed contact with exactly one root inside for every start.
///
/// `None` when the velocity's sign on the bracket, or the root's existence, cannot be proved.
#[inline(always)]
pub(crate) fn bracket(flight: &Flight<f64>, proposal: &Proposal, radii: Radii) -> Option<Arrival> {
    let bounds = Bounds::new(flight, radii);
    let Iterate { turns, at, residual, velocity, sin, hop } = proposal.iterate;
    let is_hop = matches!(proposal.course, Course::Hop);
    let elapsed = if is_hop { at } else { turns + (at - flight.phase) };
    let (error, velocity_error) = if is_hop {
        (bounds.hop_height(at, hop.0, residual), bounds.hop_velocity(hop.0 + hop.1, velocity))
    } else {
        (bounds.height(flight, elapsed, residual), bounds.velocity(flight, velocity))
    };

    // A Newton inclusion: within `reach` the velocity keeps its sign, and the root is closer than `reach`.
    let speed = velocity.abs();
    let step = residual / velocity;
    let reach = 2.0 * (step.abs() + error / speed);
    let sine_error = 3.0 * SIN_COS_ERROR + DEPARTURE_ERROR + 4.0 * UNIT + TAU * if is_hop { radii.phase } else { 0.0 };
    let local_sine = (sin.abs() + sine_error + TAU * reach).min(1.0);
    let curvature = SLACK * TAU * bounds.beta * local_sine;
    let least = (speed - velocity_error - curvature * reach) * (1.0 - 8.0 * UNIT);
    let inside = least > 0.0 && SLACK * (residual.abs() + error) <= least * reach;
    if !(inside && velocity * proposal.target.direction() > 0.0) {
        return None;
    }

    let root = at - step;
    let tail = (error + step.abs() * (velocity_error + curvature * reach)) / least;
    let radius = SLACK * (tail + UNIT * (root.abs() + 3.0 * step.abs()));
    let distance = step.abs() + radius;
    let bend = flight.acceleration_at(sin);
    let arrival_velocity = (-bend).mul_add(step, velocity);
    let velocity_radius = SLACK
        * (velocity_error
            + curvature * radius
            + bounds.beta * step.abs() * TAU * (sine_error + 4.0 * UNIT)
            + radii.beta * TAU * step.abs()
            + 0.5 * TAU * TAU * bounds.beta * distance * distance
            + 2.0 * UNIT * arrival_velocity.abs());

    let at = Ball::new(root, radius);
    let (phase, time) = if is_hop {
        let phase = flight.phase + root;
        (Ball::new(phase, up(radius + radii.phase + UNIT * phase.abs())), at)
    } else {
        let rest = root - flight.phase;
        let time = turns + rest;
        (at, Ball::new(time, up(radius + radii.phase + UNIT * (rest.abs() + time.abs()))))
    };
    Some(Arrival {
        target: proposal.target,
        turns,
        phase,
        time,
        velocity: Ball::new(arrival_velocity, velocity_radius),
        sin: Ball::new(sin, SLACK * (sine_error + TAU * distance)),
        at,
        error,
    })
}

/// What [`is_first`] could not prove.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Doubt {
    /// The direction of departure is not certain.
    Departure,
    /// The named extremum, so many turns after the start, may touch the wall.
    Extremum { target: Target, time: f64 },
    /// The contact may lie at an extremum.
    Location,
}

/// Lemmas C4-C6: no wall is touched between the start and `arrival`, for every start and parameter.
#[inline(always)]
pub(crate) fn is_first(
    flight: &Flight<f64>,
    proposal: &Proposal,
    arrival: &Arrival,
    radii: Radii,
) -> Result<(), Doubt> {
    let bounds = Bounds::new(flight, radii);
    match &proposal.course {
        Course::Monotone => {
            let margin = flight.drift.abs() - flight.beta;
            let slope = bounds.drift + radii.velocity + bounds.swing * radii.phase + radii.beta;
            // Lemma C5: z' keeps its sign for ever.
            if margin > SLACK * (slope + UNIT * flight.drift.abs()) {
                return Ok(());
            }
            near_monotone(flight, arrival, &bounds)
        }
        Course::Hop => hop_is_first(flight, proposal, arrival, &bounds),
        Course::Piece(extrema, piece) => piece_is_first(flight, extrema, piece.k, arrival, &bounds, 0.0),
    }
}

/// The drift is so close to `beta` that extrema may or may not exist: treated as if they did (Lemma C4).
#[cold]
fn near_monotone(flight: &Flight<f64>, arrival: &Arrival, bounds: &Bounds) -> Result<(), Doubt> {
    let extrema = Extrema::new::<Kernel>(flight);
    let (first, _) = extrema.before(arrival.target);
    let k = (arrival.time.mid() - first).ceil().max(0.0);
    // The computed height belongs to th = 0 or pi, `shift` turns at most from the true extremum if there is one.
    let shift = bounds.critical_phase(flight);
    let clamped = bounds.beta * shift * 60.0 * shift * shift;
    piece_is_first(flight, &extrema, k, arrival, bounds, SLACK * clamped)
}

/// Lemma C6: concave all along, so there is one root only, and the far wall is out of reach.
#[inline(always)]
fn hop_is_first(flight: &Flight<f64>, proposal: &Proposal, arrival: &Arrival, bounds: &Bounds) -> Result<(), Doubt> {
    let radii = &bounds.radii;
    let start = flight.sin + SLACK * (SIN_COS_ERROR + TAU * radii.phase) < 0.0;
    let end = proposal.iterate.sin + SLACK * arrival.sin.rad() < 0.0;
    let leaves = flight.velocity - radii.velocity > 0.0;
    let longest = arrival.at.mag();
    if start && end && leaves && longest < 0.25 && up(bounds.speed * longest) < 1.0 {
        Ok(())
    } else {
        Err(Doubt::Departure)
    }
}

/// Lemma C4: the extrema before the piece of the contact stay inside the gap, and the contact is on its piece.
#[inline(always)]
fn piece_is_first(
    flight: &Flight<f64>,
    extrema: &Extrema,
    k: f64,
    arrival: &Arrival,
    bounds: &Bounds,
    clamped: f64,
) -> Result<(), Doubt> {
    let radii = &bounds.radii;
    let certain = if flight.velocity == 0.0 && radii.velocity == 0.0 {
        flight.sin.abs() > SLACK * (SIN_COS_ERROR + TAU * radii.phase)
    } else {
        flight.velocity.abs() > radii.velocity
    };
    if !certain {
        return Err(Doubt::Departure);
    }

    // On its piece: later than the extremum before last, earlier than the last; z' > 0 (or < 0) is proved.
    let shift = bounds.critical_phase(flight);
    let (first, _) = extrema.before(arrival.target);
    let place = (arrival.turns - k) + ((arrival.phase.mid() - flight.phase) - first);
    let margin = SLACK * (shift + arrival.phase.rad());
    if !(place > margin - 1.0 && place < -margin) {
        return Err(Doubt::Location);
    }

    // The extrema that decide: the first of the other kind when it comes before, the last but one of this kind.
    let up_first = extrema.rising;
    let (own_first, other_first) = match arrival.target {
        Target::Far => (up_first, !up_first),
        Target::Near => (!up_first, up_first),
    };
    let other_before = !own_first || k > 0.0;
    debug_assert_eq!(own_first, !other_first);
    if !other_before {
        return Ok(());
    }
    let longest = arrival.time.mag() + shift;
    let error = SLACK * (bounds.height(flight, longest, 1.0) + flight.drift.abs() * (4.0 * UNIT))
        + bounds.alpha * 8.0 * UNIT
        + clamped;
    let coarse = error + flight.drift.abs() * ACOS_ERROR;
    let mut clear = extrema_are_inside(flight, extrema, k, arrival.target, coarse);
    if clear.is_err() {
        let mut refined = *extrema;
        refined.refine::<Kernel>(flight);
        let stationary = bounds.alpha * (SIN_COS_ERROR + 20.0 * ACOS_ERROR * ACOS_ERROR);
        clear = extrema_are_inside(flight, &refined, k, arrival.target, SLACK * (error + stationary));
    }
    clear
}

/// Whether the deciding extrema are at least `margin` inside the gap, and the drift has the sign that makes them decide.
#[inline(always)]
fn extrema_are_inside(
    flight: &Flight<f64>,
    extrema: &Extrema,
    k: f64,
    target: Target,
    margin: f64,
) -> Result<(), Doubt> {
    let last = k - 1.0;
    let (max_height, min_height) = match target {
        Target::Far => (last.mul_add(flight.drift, extrema.max), extrema.min),
        Target::Near => (extrema.max, last.mul_add(flight.drift, extrema.min)),
    };
    let max_counts = target == Target::Near || k > 0.0;
    let min_counts = target == Target::Far || k > 0.0;
    if max_counts && !(1.0 - max_height > margin) {
        let time = extrema.first_max + if target == Target::Far { last } else { 0.0 };
        return Err(Doubt::Extremum { target: Target::Far, time });
    }
    if min_counts && !(min_height > margin) {
        let time = extrema.first_min + if target == Target::Near { last } else { 0.0 };
        return Err(Doubt::Extremum { target: Target::Near, time });
    }
    Ok(())
}
