//! The first contact of a free flight, by walking or jumping over the monotone pieces of y(t).
//!
//! With phi = W (t - t_i), theta0 = W t_i + tau and b = c / W = v+ / W + A cos(theta0):
//!
//! ```text
//!   y(phi) = y_i + A sin(theta0) + b phi - A sin(theta0 + phi)          (11)
//!   dy/dphi = b - A cos(theta0 + phi)                                   (12)
//! ```
//!
//! |b| >= A: y is monotone. |b| < A, alpha = arccos(b / A): y falls for theta in (-alpha, alpha) and rises for theta in
//! (alpha, 2 pi - alpha), mod 2 pi; a forcing period adds 2 pi b to every extreme. So after the first two extremes the walls
//! are met, if ever, by an extreme of the kind the drift b carries outward, and a division gives the forcing period.

use crate::problem::{Problem, Start, Wall};
use crate::root::Piece;
use rug::float::Constant;
use rug::{Assign, Float};

/// The end of a free flight.
#[derive(Clone, Debug)]
pub enum Truth {
    /// The ball meets `wall` at `time` (absolute) with relative velocity `velocity_before`, for the first time.
    Contact {
        /// Absolute time.
        time: Float,
        /// The wall met.
        wall: Wall,
        /// y' just before; it points into the wall.
        velocity_before: Float,
    },
    /// A rest on a wall with v+ = 0 and a positive contact force: the ball stays for a while (how long is not this function's question).
    Rests,
    /// No contact, ever: the ball neither drifts (c = 0, or not distinguished from 0 with inputs of P bits) nor reaches.
    Never,
    /// Not decidable by this truth: near `time` (absolute) the ball comes within 2^-(3P/4) max(d, A) of touching a
    /// wall tangentially, or meets it too slowly.
    Graze {
        /// Absolute time of the extreme or of the best guess.
        time: Float,
    },
}

/// The beginning of a flight.
enum Heading {
    /// The ball first moves towards this wall.
    Towards(Wall),
    /// v+ = 0 with theta0 = 0 or pi, as far as P bits tell: released, y''' moves it monotonely towards this wall.
    Released(Wall),
    /// The ball is held on its wall.
    Rests,
    /// A = 0 and v+ = 0, inside.
    Floats,
}

/// A root or extreme that `bits` did not decide.
pub(crate) struct Unresolved {
    pub time: Float,
    /// log2 of the number of forcing periods flown: as many bits are lost.
    pub turn_bits: u32,
}

/// Finds the first contact |y| = d/2 after the start; a wall the ball starts from counts from when it has left it.
///
/// From a wall with v+ = 0 the first derivative that does not vanish decides: y'' inward leaves, outward rests; with
/// |sin(theta0)| below 2^-(P-16) (more for a huge W t) y'' counts as 0, theta0 as exactly 0 or pi, and y''' decides.
///
/// **Equation** (11), (12), (14). **Units** those of the problem. **Accuracy** see the crate's page.
/// **Panics**: parameters or state outside the domains of [`Problem`] and [`Start`], such as v+ pointing into the wall.
/// **Cost**: 40 microseconds or so at 256 bits, whatever the number of forcing periods.
pub fn first_contact(problem: &Problem, start: &Start) -> Truth {
    problem.check();
    start.check(problem);
    // A hop of speed u is about u high to the second power: both digits of u are lost against A W and A.
    let mut bits = problem.precision() + 64 + 2 * slowness(problem, start);
    let mut unresolved = None;
    for _ in 0..3 {
        match Flight::new(problem, start, bits).resolve() {
            Ok(truth) => return truth,
            Err(failure) => {
                bits = bits + problem.precision() + failure.turn_bits;
                unresolved = Some(failure.time);
            }
        }
    }
    Truth::Graze { time: unresolved.expect("three attempts failed") }
}

/// log2(A W / v+) for a start on a wall, at least 0, at most 2 P.
fn slowness(problem: &Problem, start: &Start) -> u32 {
    let scale = Float::with_val(64, &problem.amplitude * &problem.omega);
    match (start.on, scale.get_exp(), start.velocity_after.get_exp()) {
        (Some(_), Some(large), Some(small)) => (large.saturating_sub(small).max(0) as u32).min(2 * problem.precision()),
        _ => 0,
    }
}

/// A flight prepared at `bits` of precision.
pub(crate) struct Flight<'a> {
    pub problem: &'a Problem,
    pub start: &'a Start,
    pub bits: u32,
    pub two_pi: Float,
    /// W t_i + tau, in [-pi, pi].
    pub theta0: Float,
    pub sine0: Float,
    pub cosine0: Float,
    /// c / W.
    pub b: Float,
    /// y_i + A sin(theta0).
    pub base: Float,
    pub half_gap: Float,
    /// max(d, A).
    pub scale: Float,
    /// log2 |W t_i + tau|, at least 0: this many of P bits of the phase are whole forcing periods.
    pub phase_bits: u32,
}

impl<'a> Flight<'a> {
    fn new(problem: &'a Problem, start: &'a Start, bits: u32) -> Flight<'a> {
        let (theta0, phase_bits) = reduced_phase(problem, start, bits);
        let (sine0, cosine0) = theta0.clone().sin_cos(Float::new(bits));
        let b = Float::with_val(bits, &start.velocity_after / &problem.omega)
            + Float::with_val(bits, &problem.amplitude * &cosine0);
        let base = Float::with_val(bits, &problem.amplitude * &sine0) + start.place(problem);
        Flight {
            problem,
            start,
            bits,
            two_pi: Float::with_val(bits, Constant::Pi) * 2,
            theta0,
            sine0,
            cosine0,
            b,
            base,
            half_gap: Float::with_val(bits, &problem.gap / 2),
            scale: Float::with_val(bits, problem.gap.max_ref(&problem.amplitude)),
            phase_bits,
        }
    }

    pub(crate) fn float<T>(&self, value: T) -> Float
    where
        Float: Assign<T>,
    {
        Float::with_val(self.bits, value)
    }

    /// A sine, cosine or c / (A W) below this is taken for 0: the caller meant a release phase or c = 0, and P bits of
    /// tau, W (with its pi) and t could not say so. Whole forcing periods take bits of P; counted up to P/4, for past that nobody
    /// gets there by rounding and a huge t is meant exactly.
    pub(crate) fn input_rounding(&self) -> Float {
        let precision = self.problem.precision() as i32;
        let turn_bits = (self.phase_bits as i32).min(precision / 4);
        self.float(Float::u_exp(1, turn_bits + 16 - precision))
    }

    fn heading(&self) -> Heading {
        if let Some(direction) = Wall::of_sign(&self.start.velocity_after) {
            return Heading::Towards(direction); // Start::check: inward, if on a wall
        }
        let heading = if self.problem.amplitude.is_zero() {
            return if self.start.on.is_some() { Heading::Rests } else { Heading::Floats };
        } else if self.float(self.sine0.abs_ref()) > self.input_rounding() {
            // y'' = A W^2 sin(theta0)
            Heading::Towards(Wall::of_sign(&self.sine0).expect("not zero"))
        } else {
            // y''' = A W^3 cos(theta0)
            Heading::Released(Wall::of_sign(&self.cosine0).expect("cosine is +-1 here"))
        };
        match heading {
            Heading::Towards(wall) | Heading::Released(wall) if self.start.on == Some(wall) => Heading::Rests,
            other => other,
        }
    }

    fn resolve(mut self) -> Result<Truth, Unresolved> {
        let direction = match self.heading() {
            Heading::Rests => return Ok(Truth::Rests),
            Heading::Floats => return Ok(Truth::Never),
            Heading::Released(direction) => {
                // Exactly theta0 = 0 (rightwards) or pi, b = +-A.
                self.theta0 = if direction == Wall::Right { self.float(0) } else { self.float(&self.two_pi / 2) };
                self.b = self.float(&self.problem.amplitude * direction.sign());
                self.base = self.float(self.start.place(self.problem));
                return self.monotone(direction);
            }
            Heading::Towards(direction) => direction,
        };
        if self.problem.amplitude.is_zero() {
            return Ok(self.straight(direction));
        }
        if self.b.cmp_abs(&self.problem.amplitude).expect("numbers").is_ge() {
            let drift = Wall::of_sign(&self.b).expect("|b| >= A > 0");
            return self.monotone(drift);
        }
        self.wavy(direction)
    }

    /// A = 0: a straight line to the wall.
    fn straight(&self, direction: Wall) -> Truth {
        let travel = self.float(&self.half_gap * direction.sign()) - &self.base;
        let elapsed = travel / &self.start.velocity_after;
        let precision = self.problem.precision();
        Truth::Contact {
            time: Float::with_val(precision, elapsed + &self.start.time),
            wall: direction,
            velocity_before: Float::with_val(precision, &self.start.velocity_after),
        }
    }

    /// |b| >= A: y runs to the wall on the side of b, within 2 A of the straight line y_i + b phi.
    fn monotone(&self, direction: Wall) -> Result<Truth, Unresolved> {
        let travel = self.float(&self.half_gap * direction.sign()) - self.start.place(self.problem);
        let slack = self.float(&self.problem.amplitude * 2);
        let speed = self.float(self.b.abs_ref());
        let from = self.float((self.float(travel.abs_ref()) - &slack) / &speed).max(&Float::new(self.bits));
        let to = self.float((travel.abs() + slack) / speed);
        let turns = self.float(&from / &self.two_pi).floor();
        let whole = self.float(&turns * &self.two_pi);
        self.contact(direction, from - &whole, to - &whole, &turns)
    }

    /// t_i + (phi + 2 pi turns) / W at the problem's precision.
    pub(crate) fn time(&self, phi: &Float, turns: &Float) -> Float {
        let elapsed = (self.float(turns * &self.two_pi) + phi) / &self.problem.omega;
        Float::with_val(self.problem.precision(), elapsed + &self.start.time)
    }

    pub(crate) fn graze(&self, phi: &Float, turns: &Float) -> Truth {
        Truth::Graze { time: self.time(phi, turns) }
    }

    /// The contact with `wall` on the monotone piece `from..to` (radians, less `turns` whole ones).
    pub(crate) fn contact(&self, wall: Wall, from: Float, to: Float, turns: &Float) -> Result<Truth, Unresolved> {
        let turn_bits = turns.get_exp().unwrap_or(0).max(0) as u32;
        let carried = self.float(&self.two_pi * turns) * &self.b + &self.base;
        // Every term of D is below `largest`, and the error of b (some 2^-bits of it or of A) is carried on for
        // `turns` forcing periods; 2^10 is 2 pi, a dozen roundings and slack.
        let largest = self.float(self.scale.max_ref(&self.float(self.b.abs_ref())));
        let noise = largest >> (self.bits - 10 - turn_bits.min(self.bits - 10));
        let piece = Piece {
            base: carried * wall.sign() - &self.half_gap,
            drift: self.float(&self.b * wall.sign()),
            amplitude: self.float(&self.problem.amplitude * wall.sign()),
            theta0: self.theta0.clone(),
            from,
            to,
            noise,
        };
        // Two bits better than promised.
        match piece.root(self.problem.precision() - 38) {
            Ok(phi) => {
                let cosine = self.float(&self.theta0 + &phi).cos();
                let slope = self.float(&self.b - self.float(&self.problem.amplitude * &cosine));
                Ok(Truth::Contact {
                    time: self.time(&phi, turns),
                    wall,
                    velocity_before: Float::with_val(self.problem.precision(), slope * &self.problem.omega),
                })
            }
            Err(phi) => Err(Unresolved { time: self.time(&phi, turns), turn_bits }),
        }
    }
}

/// W t_i + tau less whole forcing periods, in [-pi, pi] up to rounding, and log2 of its size before (at least 0).
fn reduced_phase(problem: &Problem, start: &Start, bits: u32) -> (Float, u32) {
    let whole = Float::with_val(bits, &problem.omega * &start.time) + &problem.tau;
    let phase_bits = whole.get_exp().unwrap_or(0).max(0) as u32;
    // Absolute error under 2^-(bits + 8).
    let wide = bits + phase_bits + 16;
    let phase = Float::with_val(wide, &problem.omega * &start.time) + &problem.tau;
    let two_pi = Float::with_val(wide, Constant::Pi) * 2;
    let turns = Float::with_val(wide, &phase / &two_pi).round();
    let reduced = phase - turns * two_pi;
    (Float::with_val(bits, reduced), phase_bits)
}
