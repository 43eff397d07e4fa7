//! A dense scan in double precision: slow, blind to short contacts, and free of any theory of pieces.

use crate::problem::{Problem, Start};
use rug::Float;
use rug::float::Constant;

/// The flight (11) in doubles, relative to its start so that a huge start time spoils nothing.
struct Sampled {
    amplitude: f64,
    omega: f64,
    theta0: f64,
    position: f64,
    /// c = v+ + A W cos(theta0).
    drift: f64,
}

impl Sampled {
    fn new(problem: &Problem, start: &Start) -> Sampled {
        // MPFR reduces any argument by itself; arg(cos + i sin) brings the phase back into (-pi, pi].
        let bits = 2 * problem.precision() + start.time.get_exp().unwrap_or(0).unsigned_abs();
        let phase = Float::with_val(bits, &problem.omega * &start.time) + &problem.tau;
        let (sine, cosine) = phase.sin_cos(Float::new(bits));
        let speed = Float::with_val(bits, &problem.amplitude * &problem.omega) * &cosine;
        let pi = Float::with_val(bits, Constant::Pi).to_f64();
        let theta0 = sine.atan2(&cosine).to_f64().clamp(-pi, pi);
        Sampled {
            amplitude: problem.amplitude.to_f64(),
            omega: problem.omega.to_f64(),
            theta0,
            position: start.place(problem).to_f64(),
            drift: (speed + &start.velocity_after).to_f64(),
        }
    }

    fn displacement(&self, elapsed: f64) -> f64 {
        let swing = (self.theta0 + self.omega * elapsed).sin() - self.theta0.sin();
        self.position + self.drift * elapsed - self.amplitude * swing
    }
}

/// y at `elapsed` after the start, ignoring walls, in doubles: off by some 2^-50 (d + A + |c| elapsed) and, through the
/// sine, 2^-50 A W elapsed.
pub fn displacement_f64(problem: &Problem, start: &Start, elapsed: f64) -> f64 {
    Sampled::new(problem, start).displacement(elapsed)
}

/// The first of `points` equally spaced times, strictly between the start and `until`, at which |y| is clearly beyond
/// d/2; `None` if there is none.
///
/// **Units**: `until` and the answer are times *elapsed since the start*. "Clearly" is 1e-9 d/2 plus 1e-13 A, above the
/// rounding of [`displacement_f64`] for flights up to some 1e3 forcing periods.
pub fn scan(problem: &Problem, start: &Start, until: f64, points: usize) -> Option<f64> {
    let flight = Sampled::new(problem, start);
    let limit = problem.gap.to_f64() / 2.0 * (1.0 + 1e-9) + 1e-13 * flight.amplitude;
    let step = until / (points + 1) as f64;
    (1..=points).map(|index| index as f64 * step).find(|&elapsed| flight.displacement(elapsed).abs() > limit)
}
