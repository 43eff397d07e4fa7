//! The motion between two impacts in closed form, equations (10)-(13).
//!
//! # Units
//! Time is counted in forcing periods (`theta = W t + tau = 2 pi u`), lengths in gap widths `d`. Only
//! `alpha = A/d` and `e` are left; `beta = 2 pi alpha` is the box's greatest speed. A velocity is in gap widths per forcing period.
//!
//! # The frame of a flight
//! Motion is measured from the wall the ball left (from the left wall for a start inside the gap): the height
//! `z` is the distance from it, 0 there and 1 at the far wall, and the sines and cosines carry the sign
//! that mirrors the right wall's flights onto the left wall's (`y -> -y`, `theta -> theta + pi`). With
//! `c = z'(0) + beta cos th0` (the drift) and `h` forcing periods after the start, at phase `th1`:
//!
//! ```text
//! z  = z0 + c h - alpha (sin th1 - sin th0)     (11), (A.2), (A.4), (A.6)
//! z' = c - beta cos th1                         (12), (A.1), (A.3), (A.5)
//! ```
//!
//! **The departure root divided out.** For a flight that left the wall `h <= 1/8` forcing periods ago, with the versine,
//! excess and sine of `2 pi h` ([`SmallAngle`]), the addition theorems turn this into
//! `z = z'(0) h + alpha (cos th0 excess + sin th0 versine)`, where nothing cancels as `h -> 0`: `z/h` keeps
//! its sign information down to flights of a billionth of a forcing period ([`Flight::hop_height`]).

use crate::number::kernel::SmallAngle;
use crate::number::{Number, UNIT};
use crate::pair::{Inward, Reduced, Wall};

/// Sine and cosine of a phase later by a departure: the addition theorems.
#[inline(always)]
pub(crate) fn turned<N: Number>((sin, cos): (&N, &N), d: &SmallAngle<N>) -> (N, N) {
    let base = sin.mul_sub_ref(&d.versine, sin.clone());
    let turned_sin = cos.mul_add_ref(&d.sine, base);
    let base = cos.mul_sub_ref(&d.versine, cos.clone());
    (turned_sin, sin.mul_sub_ref(&d.sine, base))
}

/// `z'` after a departure, given `z'`, sine and cosine before, without cancellation. **Equation** (12)
#[inline(always)]
pub(crate) fn velocity_after<N: Number>(beta: N, velocity: N, (sin, cos): (N, N), versine: N, sine: N) -> N {
    let wave = cos.mul_add_ref(&versine, sin * sine);
    beta.mul_add_ref(&wave, velocity)
}

/// Start of a flight, not mirrored: after the impact, for a start on a wall.
#[derive(Clone, Debug)]
pub(crate) struct Launch<N> {
    /// `None` inside the gap.
    pub wall: Option<Wall>,
    /// Height above the left wall, for a start inside the gap.
    pub height: N,
    /// Whole forcing periods and the rest of the phase.
    pub turns: i64,
    pub phase: N,
    /// `z'`
    pub velocity: N,
    /// True if the ball was sticking before: the acceleration of each flight is exactly 0 at the start.
    pub is_release: bool,
}

impl<N: Number> Launch<N> {
    /// Start of a flight from a wall.
    #[inline(always)]
    pub fn from_wall(wall: Wall, turns: i64, phase: N, velocity: N, is_release: bool) -> Self {
        Self { wall: Some(wall), height: N::from_f64(0.0), turns, phase, velocity, is_release }
    }

    /// Start of a flight from inside the gap.
    pub fn from_inside(height: N, turns: i64, phase: N, velocity: N) -> Self {
        Self { wall: None, height, turns, phase, velocity, is_release: false }
    }
}

impl<N> Launch<N> {
    /// The start in another arithmetic.
    pub fn map<M>(&self, f: impl Fn(&N) -> M) -> Launch<M> {
        Launch {
            wall: self.wall,
            height: f(&self.height),
            turns: self.turns,
            phase: f(&self.phase),
            velocity: f(&self.velocity),
            is_release: self.is_release,
        }
    }
}

/// One flight: its start, in the frame described above, and its drift.
#[derive(Clone, Copy, Debug)]
pub struct Flight<N> {
    /// `A/d`
    pub alpha: N,
    /// `2 pi A/d`
    pub beta: N,
    /// Phase of the start in forcing periods, not mirrored.
    pub phase: N,
    /// Mirrored `sin th0`.
    pub sin: N,
    /// Mirrored `cos th0`.
    pub cos: N,
    /// `z` at the start.
    pub height: N,
    /// `z'` at the start, after the impact.
    pub velocity: N,
    /// The drift `c`: the increase of `z` per forcing period.
    pub drift: N,
    /// The wall that heights are measured from.
    pub wall: Wall,
}

impl<N> Flight<N> {
    /// The flight in another arithmetic.
    pub fn map<M>(&self, f: impl Fn(&N) -> M) -> Flight<M> {
        Flight {
            alpha: f(&self.alpha),
            beta: f(&self.beta),
            phase: f(&self.phase),
            sin: f(&self.sin),
            cos: f(&self.cos),
            height: f(&self.height),
            velocity: f(&self.velocity),
            drift: f(&self.drift),
            wall: self.wall,
        }
    }
}

impl<N: Number> Flight<N> {
    /// Flight from a start; `sin_cos` are the sine and cosine of the phase, not mirrored.
    #[inline(always)]
    pub(crate) fn of(pair: &Reduced<N>, launch: Launch<N>, sin_cos: (N, N)) -> Self {
        let Launch { wall, height, phase, velocity, .. } = launch;
        match wall {
            Some(wall) => Self::from_wall(pair, wall, phase, wall.inward(velocity), sin_cos),
            None => Self::from_inside(pair, height, phase, velocity, sin_cos),
        }
    }

    /// Flight that leaves `wall` with velocity `velocity >= 0` away from it.
    ///
    /// `sin_cos` are the sine and cosine of the phase, not mirrored.
    #[inline(always)]
    pub fn from_wall(pair: &Reduced<N>, wall: Wall, phase: N, velocity: N, sin_cos: (N, N)) -> Self {
        Self::new(pair, wall, N::from_f64(0.0), phase, velocity, sin_cos)
    }

    /// Flight that starts inside the gap, `height` above the left wall.
    #[inline(always)]
    pub fn from_inside(pair: &Reduced<N>, height: N, phase: N, velocity: N, sin_cos: (N, N)) -> Self {
        Self::new(pair, Wall::Left, height, phase, velocity, sin_cos)
    }

    #[inline(always)]
    fn new(pair: &Reduced<N>, wall: Wall, height: N, phase: N, velocity: N, sin_cos: (N, N)) -> Self {
        let (sin, cos) = wall.mirror(sin_cos);
        let drift = pair.beta.mul_add_ref(&cos, velocity.clone());
        Self { alpha: pair.alpha.clone(), beta: pair.beta.clone(), phase, sin, cos, height, velocity, drift, wall }
    }

    /// `z - target` at `phase1 + turns`, where `turns` is a whole number and `sin1` the mirrored sine there.
    ///
    /// **Equation** (11). Whole forcing periods and the rest are kept apart so that long flights lose no phase.
    #[inline(always)]
    pub fn height_above(&self, target: N, turns: N, phase1: N, sin1: N) -> N {
        let wave = self.alpha.mul_sub_ref(&sin1.minus(&self.sin), self.height.clone() - target);
        let rest = self.drift.mul_add_ref(&phase1.minus(&self.phase), wave);
        self.drift.mul_add_ref(&turns, rest)
    }

    /// `z'` where the mirrored cosine is `cos1`. **Equation** (12).
    #[inline(always)]
    pub fn velocity_at(&self, cos1: N) -> N {
        self.beta.mul_sub_ref(&cos1, self.drift.clone())
    }

    /// `z''` per forcing period squared where the mirrored sine is `sin1`. **Equation** (10).
    #[inline(always)]
    pub fn acceleration_at(&self, sin1: N) -> N {
        self.beta.turn().times(&self.beta) * sin1
    }

    /// `z` after a hop of `h <= 1/8` forcing periods from a wall, without cancellation; `excess` and `versine` of `h`.
    #[inline(always)]
    pub fn hop_height(&self, h: N, versine: N, excess: N) -> N {
        let wave = self.cos.mul_add_ref(&excess, self.sin.clone() * versine);
        self.velocity.mul_add_ref(&h, self.alpha.clone() * wave)
    }

    /// `z'` after a hop, without cancellation.
    #[inline(always)]
    pub fn hop_velocity(&self, versine: N, sine: N) -> N {
        let sin_cos = (self.sin.clone(), self.cos.clone());
        velocity_after(self.beta.clone(), self.velocity.clone(), sin_cos, versine, sine)
    }
}

impl Flight<f64> {
    /// Whether no extrema are expected: `|c| >= beta`.
    #[inline(always)]
    pub(crate) fn is_monotone(&self) -> bool {
        self.drift.abs() >= self.beta
    }

    /// Upper bound of the time from the start to the phase `at` after `turns` whole forcing periods.
    #[inline(always)]
    pub(crate) fn elapsed(&self, turns: f64, at: f64) -> f64 {
        // Whole forcing periods may cancel the rest, so the time's own rounding is not relative to it.
        UNIT.mul_add(turns.abs(), (turns + (at - self.phase)).abs())
    }

    /// Mirrored sine and cosine after a hop, by the addition theorems.
    #[inline(always)]
    pub fn hop_sin_cos(&self, d: &SmallAngle) -> (f64, f64) {
        turned((&self.sin, &self.cos), d)
    }

    /// `z'` and the mirrored sine a short `step` before the given `z'`, sine and cosine, by Taylor's formula.
    #[inline(always)]
    pub fn arrive(&self, velocity: f64, (sin, cos): (f64, f64), step: f64) -> (f64, f64) {
        let turned = std::f64::consts::TAU * step;
        let mean_sin = (-0.5 * turned).mul_add(cos, sin);
        ((-self.beta * turned).mul_add(mean_sin, velocity), (-turned).mul_add(cos, sin))
    }
}
