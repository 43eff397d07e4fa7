//! A-priori error bounds of a flight in doubles (Lemmas C1, C2 and C4 of `docs/proofs/flights.md#C1`, same labels).
//!
//! The bounds hold for every start and every parameter within the radii of the doubles that a [`Flight`] was
//! computed with. What depends on the pair alone is computed once, in [`Margins`].

use crate::flight::Flight;
use crate::number::kernel::{ACOS_ERROR, DEPARTURE_ERROR, SIN_COS_ERROR};
use crate::number::{Ball, UNIT, binade};
use crate::pair::Reduced;

/// An upper bound of `2 pi`.
pub(super) const TAU: f64 = std::f64::consts::TAU.next_up();
/// More than the rounding errors of the at most sixty operations that make an error bound (Lemma C1).
///
/// The bounds of [`Bounds`] that the hot path takes are computed without it; what is decided with them has it.
pub(super) const SLACK: f64 = 1.0 + 128.0 * UNIT;

/// The error of the sine on arrival of a hop, by the addition theorem: the least accurate sine in use.
pub(super) const HOP_SINE_ERROR: f64 = 2.0 * SIN_COS_ERROR + DEPARTURE_ERROR + 4.0 * UNIT;

/// Bounds of the distance of the true start from the doubles of a [`Flight`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Radii {
    /// of the phase of the start, in forcing periods
    pub phase: f64,
    /// of `z'` at the start
    pub velocity: f64,
    /// of `z` at the start; for a start inside the gap at least `2^-53` (Lemma C1)
    pub height: f64,
}

/// The parts of the error bounds that depend on the parameters of the pair alone.
#[derive(Clone, Copy, Debug)]
pub struct Margins {
    /// Upper bounds of `alpha`, of `beta`, and a lower bound of `beta`.
    pub(super) alpha: f64,
    pub(super) beta: f64,
    pub(super) least_beta: f64,
    /// An upper bound of `2 pi beta`: `z''` is nowhere larger.
    pub(super) acceleration: f64,
    /// Error of `z''` for a computed sine: kernel errors, roundings, the radius of `beta`.
    pub(super) bend: f64,
    /// Half the greatest `z'''`.
    pub(super) jerk: f64,
    /// Error of the sine terms of `z`: kernel errors and the radius of `alpha`.
    waves: f64,
    /// Error of the drift: kernel error and the radius of `beta`.
    drift: f64,
    /// Error of `z'`: the same for two cosines.
    velocity: f64,
    /// Error of a hop's height for each unit of versine plus excess, and of its velocity.
    hop_height: f64,
    hop_velocity: f64,
}

impl Margins {
    /// Margins of a pair.
    pub fn new(pair: &Reduced<Ball>) -> Self {
        let (alpha, beta) = (pair.alpha.mag(), pair.beta.mag());
        let hop = SIN_COS_ERROR + DEPARTURE_ERROR + 4.0 * UNIT;
        Self {
            alpha,
            beta,
            least_beta: (pair.beta.mid() - pair.beta.rad()).next_down(),
            acceleration: SLACK * TAU * beta,
            bend: SLACK * TAU * (beta * (HOP_SINE_ERROR + 8.0 * UNIT) + pair.beta.rad()),
            jerk: SLACK * TAU * TAU * beta / 2.0,
            waves: SLACK * (2.0 * alpha * SIN_COS_ERROR + 2.0 * pair.alpha.rad()),
            drift: SLACK * (beta * SIN_COS_ERROR + pair.beta.rad() + f64::MIN_POSITIVE),
            velocity: SLACK * (2.0 * beta * SIN_COS_ERROR + 2.0 * pair.beta.rad() + f64::MIN_POSITIVE),
            hop_height: SLACK * (alpha * hop + pair.alpha.rad()),
            hop_velocity: SLACK * (beta * hop + pair.beta.rad()),
        }
    }

    /// An upper bound of the radius of `beta` around its centre.
    #[inline(always)]
    pub(super) fn beta_radius(&self, centre: f64) -> f64 {
        (self.beta - centre).next_up()
    }
}

/// The error bounds of one flight. `WIDE` is false when the phase of the start is exact, which saves its terms.
#[derive(Clone, Copy)]
pub(super) struct Bounds<'a, const WIDE: bool> {
    pub flight: &'a Flight<f64>,
    pub pair: &'a Margins,
    pub radii: Radii,
    /// Bound of `|c - computed c|` for the start at the centre.
    drift: f64,
    /// Bound of `|d c / d phase0|` over the starts.
    tilt: f64,
}

impl<'a, const WIDE: bool> Bounds<'a, WIDE> {
    #[inline(always)]
    pub fn new(flight: &'a Flight<f64>, pair: &'a Margins, radii: Radii) -> Self {
        let drift = UNIT.mul_add(binade(flight.drift), pair.drift);
        let tilt = if WIDE { pair.acceleration * (flight.sin.abs() + SIN_COS_ERROR + TAU * radii.phase) } else { 0.0 };
        Self { flight, pair, radii, drift, tilt }
    }

    /// Whether all starts are on the wall: a start inside has a radius of its height, even where its double is 0.
    #[inline(always)]
    pub fn is_on_wall(&self) -> bool {
        // C6: it begins there, exactly; so do the hops of C1.
        self.flight.height == 0.0 && self.radii.height == 0.0
    }

    /// Radius of the start's phase.
    #[inline(always)]
    pub fn phase_radius(&self) -> f64 {
        if WIDE { self.radii.phase } else { 0.0 }
    }

    /// `|z'(0)|` is at most this.
    #[inline(always)]
    pub fn speed(&self) -> f64 {
        self.flight.velocity.abs() + self.radii.velocity
    }

    /// Part of the error of `z` that comes from the spread of starts, within `time` forcing periods of the start.
    #[inline(always)]
    fn spread(&self, time: f64) -> f64 {
        let Radii { phase, velocity, height } = self.radii;
        if WIDE {
            let span = time + phase;
            height + velocity * span + phase * (self.speed() + self.tilt * span)
        } else {
            velocity.mul_add(time, height)
        }
    }

    /// Lemma C1: bounds `|z - computed z|` near the contact, for fixed phase, `time` after the start, with `whole` whole forcing periods.
    #[inline(always)]
    pub fn height(&self, time: f64, whole: f64, sin: f64, residual: f64) -> f64 {
        let (flight, pair) = (self.flight, self.pair);
        let span = if WIDE { time + self.radii.phase } else { time };
        let drifted = flight.drift.abs() * (2.0 * time + 2.0 * whole.abs());
        let rounding = drifted + pair.alpha * (sin - flight.sin).abs() + 16.0 * residual.abs();
        UNIT.mul_add(rounding, self.drift.mul_add(span, pair.waves) + self.spread(time))
    }

    /// Lemma C1: bounds `|z - computed z|` at an extremum within `time` forcing periods of the start.
    #[inline(always)]
    pub fn extremum(&self, time: f64) -> f64 {
        let (flight, pair) = (self.flight, self.pair);
        let span = if WIDE { time + self.radii.phase } else { time };
        let rounding = flight.drift.abs() * (2.0 * time + 4.0) + 5.0 * pair.alpha + 4.0;
        UNIT.mul_add(rounding, self.drift.mul_add(span, pair.waves) + self.spread(time))
    }

    /// Lemma C2: bounds `|z' - computed z'|` at fixed phase.
    #[inline(always)]
    pub fn velocity(&self, velocity: f64) -> f64 {
        let rounding = binade(self.flight.drift) + binade(velocity);
        let spread = if WIDE { self.tilt.mul_add(self.radii.phase, self.radii.velocity) } else { self.radii.velocity };
        UNIT.mul_add(rounding, self.pair.velocity + spread)
    }

    /// Lemma C1 for a hop: `terms` is versine plus excess.
    #[inline(always)]
    pub fn hop_height(&self, h: f64, terms: f64, residual: f64) -> f64 {
        let per_term = self.pair.hop_height + self.pair.beta * self.radii.phase;
        let rounding = UNIT * (3.0 * self.speed() * h + 16.0 * residual.abs());
        SLACK * (terms * per_term + rounding + self.radii.velocity * h + f64::MIN_POSITIVE)
    }

    /// Lemma C2 for a hop: `terms` is versine plus sine.
    #[inline(always)]
    pub fn hop_velocity(&self, terms: f64, velocity: f64) -> f64 {
        let per_term = self.pair.hop_velocity + self.pair.acceleration * self.radii.phase;
        SLACK * (terms * per_term + self.radii.velocity + UNIT * (self.speed() + 2.0 * velocity.abs()))
    }

    /// Radius of `beta`.
    #[inline(always)]
    pub fn beta_radius(&self) -> f64 {
        self.pair.beta_radius(self.flight.beta)
    }

    /// Bounds `|c - computed c|` over all starts.
    #[inline(always)]
    pub fn slope(&self) -> f64 {
        let spread = if WIDE { self.tilt * self.radii.phase } else { 0.0 };
        SLACK * (self.drift + self.radii.velocity + spread)
    }

    /// Lemma C4: bounds the distance of a true critical phase from the computed one, in forcing periods.
    #[inline(always)]
    pub fn critical_phase(&self) -> f64 {
        // |q - computed q| with q = c/beta, |q| <= 1.
        let ratio = (self.slope() + self.beta_radius()) / self.pair.least_beta + UNIT;
        // acos is Hoelder continuous: |acos x - acos y| <= pi sqrt(|x - y|/2), in forcing periods sqrt(|x - y|/8).
        if ratio >= 0.0 { SLACK * (ACOS_ERROR + 0.354 * ratio.sqrt() + 16.0 * UNIT) } else { f64::INFINITY }
    }

    /// Whether [`Bounds::critical_phase`] is below [`NARROW`], without its root and quotient.
    #[inline(always)]
    pub fn is_narrow(&self) -> bool {
        // beta's radius is below the slope; 0.354 sqrt(2^-25) < 2^-13.99, and the rest is below 2^-30.
        self.slope() <= 2f64.powi(-26) * self.pair.least_beta
    }
}

/// A generous margin for critical phases, in forcing periods, that most flights need not undercut.
pub(super) const NARROW: f64 = 1.0 / 8192.0;

#[cfg(test)]
mod tests;
