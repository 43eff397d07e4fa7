//! The root in an isolated bracket, to the requested bits.
//!
//! **Lemma M3.** Let the contact of a flight lie within `reach` of `a`, and `|z'| >= m > 0` there. Then it lies within
//! `|z(b)| / m` of any `b` within `reach` of `a`. *Proof.* The mean value theorem between `b` and the contact. []
//!
//! So one evaluation in balls proves a root to full precision, wherever `b` comes from: plain Halley-like steps that
//! quadruple the bits. Each needs one sine and cosine; the last one rotates them by its own small step.

use super::Isolated;
use crate::contact::extrema::Target;
use crate::flight::{Flight, turned, velocity_after};
use crate::number::kernel::SmallAngle;
use crate::number::{Float, LEAST_BITS, Magnitude, MpBall, Number};
use crate::pair::Inward;

/// The contact of one flight, in the frame of its start.
#[derive(Debug)]
pub(crate) struct Refined {
    /// Approximate phase of the contact, less the whole forcing periods: the error is at most `error`.
    pub at: Float,
    pub error: Magnitude,
    /// Mirrored `z'`, sine and cosine *at this phase*.
    pub velocity: MpBall,
    pub sin_cos: (MpBall, MpBall),
}

/// The values of the formulas at a phase, mirrored: height above the target, `z'`, sine and cosine.
struct PhaseValues {
    residual: MpBall,
    velocity: MpBall,
    sin_cos: (MpBall, MpBall),
}

/// Greatest number of terms with which a series costs less than a sine and cosine.
const MOST_TERMS: f64 = 48.0;
/// Steps at full precision: Newton's takes more than a bit off even near a double root, and none that takes nothing is followed.
const MOST_STEPS: u32 = 1 << 22;

impl PhaseValues {
    /// Values a time `h` later: by the addition theorems, each product in as many bits as it is worth.
    fn later(self, flight: &Flight<MpBall>, h: &MpBall) -> Option<Self> {
        let Self { residual, velocity, sin_cos: (sin, cos) } = self;
        let SmallAngle { versine, sine, .. } =
            h.departure_within(Magnitude::power_of_two(-i64::from(sin.bits()) - 8))?;
        let product = |x: &MpBall, small: &MpBall| x.product(small, small.bits());
        let rise = product(&cos, &sine).minus(&product(&sin, &versine));
        let fall = product(&cos, &versine).plus(&product(&sin, &sine));
        Some(Self {
            residual: residual.plus(&flight.drift.product(h, sine.bits())).minus(&product(&flight.alpha, &rise)),
            velocity: velocity.plus(&product(&flight.beta, &fall)),
            sin_cos: (sin.plus(&rise), cos.minus(&fall)),
        })
    }

    /// Whether the height is as near to 0 as the precision can distinguish.
    fn is_noise(&self) -> bool {
        let noise = self.residual.rad();
        self.residual.mid().magnitude() <= noise + noise
    }
}

/// Values of the formulas at `time` after the departure from a wall, without cancellation.
fn see_hop(flight: &Flight<MpBall>, time: &Float) -> Option<PhaseValues> {
    let time = MpBall::exact(time.clone());
    let departure = time.short_departure()?;
    let sin_cos = turned((&flight.sin, &flight.cos), &departure);
    let SmallAngle { versine, excess, sine } = departure;
    let residual = flight.hop_height(time, versine.clone(), excess);
    Some(PhaseValues { residual, velocity: flight.hop_velocity(versine, sine), sin_cos })
}

impl Isolated {
    /// Encloses the contact of `flight`, a part of the set, around a phase of `bits` bits.
    ///
    /// `None` when the steps do not stay in the bracket: the precision is too low.
    pub fn refine(&self, flight: &Flight<MpBall>, bits: u32) -> Option<Refined> {
        if self.is_hop(flight, bits) {
            return self.refine_hop(flight, bits);
        }
        let mut at = self.at.clone();
        for level in self.precisions(flight, bits) {
            let coarse = flight.map(|x| x.rounded(level));
            at = at.rounded(level);
            let sight = self.look(&coarse, &at);
            at = at.plus(&step(&coarse, &sight)?, level);
        }
        at = at.rounded(bits);
        let mut sight = self.look(flight, &at);
        let mut before = Magnitude::INFINITE;
        for _ in 0..MOST_STEPS {
            let next = at.plus(&step(flight, &sight)?, bits);
            let moved = MpBall::exact(next.clone()) - MpBall::exact(at);
            sight = sight.later(flight, &moved)?;
            let left = sight.residual.mid().magnitude();
            if sight.is_noise() || left >= before {
                let error = self.error(&next, Magnitude::ZERO, &sight)?;
                return Some(Refined { at: next, error, velocity: sight.velocity, sin_cos: sight.sin_cos });
            }
            (at, before) = (next, left);
        }
        None
    }

    /// Whether the departure root is better divided out: a short flight back to its wall.
    fn is_hop(&self, flight: &Flight<MpBall>, bits: u32) -> bool {
        // A series of at most `MOST_TERMS` terms costs less than a sine.
        let terms = -f64::from(bits) / self.time.mid().log2();
        let is_short = self.time.mid() <= 2f64.powi(-8) && terms <= MOST_TERMS;
        is_short && self.target == Target::Near && flight.height.mid().is_zero()
    }

    /// Encloses the contact of a hop: the unknown is the time, and nothing cancels however short it is.
    fn refine_hop(&self, flight: &Flight<MpBall>, bits: u32) -> Option<Refined> {
        let mut time = Float::with_bits(self.time.mid(), bits);
        let mut before = Magnitude::INFINITE;
        for _ in 0..MOST_STEPS {
            let sight = see_hop(flight, &time)?;
            let left = sight.residual.mid().magnitude();
            if !sight.is_noise() && left < before {
                time = time.plus(&step(flight, &sight)?, bits);
                before = left;
                continue;
            }
            let start = flight.phase.clone() - MpBall::from_f64(self.turns);
            let time = MpBall::exact(time);
            let phase = start.clone().plus(&time);
            let error = self.error(phase.mid(), phase.rad(), &sight)? + phase.rad();
            // From the phase at that time to the phase that is kept.
            let at = phase.mid().rounded(bits);
            let rest = MpBall::exact(at.clone()).minus(&start).minus(&time);
            let departure = rest.short_departure()?;
            let sin_cos = turned((&sight.sin_cos.0, &sight.sin_cos.1), &departure);
            let SmallAngle { versine, sine, .. } = departure;
            let velocity = velocity_after(flight.beta.clone(), sight.velocity, sight.sin_cos, versine, sine);
            return Some(Refined { at, error: error + rest.mag(), velocity, sin_cos });
        }
        None
    }

    /// The precisions of the steps before the last, rising to a quarter of `bits`.
    fn precisions(&self, flight: &Flight<MpBall>, bits: u32) -> Vec<u32> {
        // Bits that a step loses: an error of the phase counts against |z'| / z''.
        let lost = (8.0 + (flight.steepest().log2() - self.least.log2()).max(0.0)).ceil() as u32; // proposes
        let known = -self.reach.log2();
        let mut levels = Vec::new();
        let mut needed = bits;
        while needed > 2 * lost {
            needed = needed / 4 + lost;
            if f64::from(needed) <= known {
                break;
            }
            levels.push((needed + lost).max(LEAST_BITS)); // proposes
        }
        levels.reverse();
        levels
    }

    fn look(&self, flight: &Flight<MpBall>, at: &Float) -> PhaseValues {
        let at = MpBall::exact(at.clone());
        let sin_cos = flight.wall.mirror(at.sin_cos());
        let (height, none) = (MpBall::from_f64(self.target.height()), MpBall::from_f64(0.0));
        let phase = at.plus(&MpBall::from_f64(self.turns));
        let residual = flight.height_above(height, none, phase, sin_cos.0.clone());
        PhaseValues { residual, velocity: flight.velocity_at(sin_cos.1.clone()), sin_cos }
    }

    /// Lemma M3, for a phase within `spread` of `at`.
    fn error(&self, at: &Float, spread: Magnitude, sight: &PhaseValues) -> Option<Magnitude> {
        (self.at.distance(at) + spread <= self.reach).then(|| sight.residual.mag().over(self.least))
    }
}

/// Step from a phase to the root beside it, with an error of the fourth order.
///
/// With `n = z/z'`, `A = z''/(2 z')` and `B = z'''/(6 z')`: `-n - (A + (2 A^2 - B) n) n^2`, the inverted Taylor series.
fn step(flight: &Flight<MpBall>, sight: &PhaseValues) -> Option<Float> {
    let (residual, slope, bits) = (sight.residual.mid(), sight.velocity.mid(), flight.drift.bits());
    let Some(size) = residual.top() else { return Some(residual.clone()) };
    let size = (size - slope.top()?) as f64; // proposes
    // Bits of a number of this size that the phase is worth.
    let worth =
        |size: f64| ((f64::from(bits) + size) as u32).saturating_add(16).clamp(LEAST_BITS, bits.max(LEAST_BITS)); // proposes
    let newton = residual.over(slope, worth(size));
    let (beta, (sin, cos)) = (&flight.beta, &sight.sin_cos);
    let rough = {
        let [slope, beta, sin, cos] = [slope, beta.mid(), sin.mid(), cos.mid()].map(Float::to_f64);
        bend(slope, beta, sin).and_then(|a| Some([a, twist(a, slope, beta, cos)?])).filter(|x| x[0].is_normal())
    };
    // Corrections of the second order need half the bits, of the third a quarter: maybe no more than doubles have.
    let order = |n: f64, x: f64| worth(n * size + x.abs().log2());
    let [half, quarter] = rough.map_or([bits, bits], |[a, b]| [order(2.0, a), order(3.0, b)]);
    let coarse = |x: &Float, bits: u32| MpBall::exact(x.rounded(bits));
    let square = newton.times(&newton, half);
    let curvature = match rough {
        Some([bend, _]) if half == LEAST_BITS => Float::with_bits(bend, half),
        _ => bend(coarse(slope, half), coarse(beta.mid(), half), coarse(sin.mid(), half))?.mid().clone(),
    };
    let more = match rough {
        Some([_, twist]) if quarter == LEAST_BITS => newton.times(&Float::new(twist), quarter),
        _ => {
            let [a, slope, beta, cos] = [&curvature, slope, beta.mid(), cos.mid()].map(|x| coarse(x, quarter));
            twist(a, slope, beta, cos)?.mid().times(&newton, quarter)
        }
    };
    let curved = curvature.plus(&more, half).times(&square, half);
    Some(-newton.plus(&curved, newton.bits()))
}

/// `A`
fn bend<N: Number>(slope: N, beta: N, sin: N) -> Option<N> {
    (beta.turn() * beta * sin).checked_div(slope * N::from_f64(2.0))
}

/// `2 A^2 - B`
fn twist<N: Number>(bend: N, slope: N, beta: N, cos: N) -> Option<N> {
    let jerk = (beta.turn() * beta.turn() * beta * cos).checked_div(slope * N::from_f64(6.0))?;
    let square = bend.clone() * bend;
    Some(square.clone() + square - jerk)
}
