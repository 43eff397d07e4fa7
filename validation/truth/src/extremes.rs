//! The wavy flight, |b| < A: which extreme first reaches a wall.

use crate::flight::{Flight, Truth, Unresolved};
use crate::problem::Wall;
use rug::Float;

/// The place of an extreme against the wall it points to.
enum Reach {
    Inside,
    Outside,
    Unclear,
}

impl Flight<'_> {
    /// |b| < A: extremes and drift. The first move is in `direction`.
    pub(crate) fn wavy(&self, direction: Wall) -> Result<Truth, Unresolved> {
        let alpha = self.critical_phase();
        let rises = direction == Wall::Right;
        // Rising, theta0 is beyond +-alpha and the next maximum is at -alpha mod 2 pi; falling, it is between them and
        // the next minimum is at alpha. The sign of v+ (not a comparison of phases) has decided which.
        let first_phi = if rises {
            let ahead = if self.theta0 > 0 { self.two_pi.clone() } else { self.float(0) };
            ahead - &alpha - &self.theta0
        } else {
            self.float(&alpha - &self.theta0)
        };
        let half_fall = self.float(&alpha * 2);
        let next = if rises { half_fall } else { self.float(&self.two_pi - &half_fall) };
        let second_phi = self.float(&first_phi + &next);
        // y at a maximum is base + b phi + A sin(alpha), at a minimum base + b phi - A sin(alpha).
        let swing = self.swing() * direction.sign();
        let first = self.float(&self.b * &first_phi) + &self.base + &swing;
        let second = self.float(&self.b * &second_phi) + &self.base - &swing;

        let zero = self.float(0);
        match self.reach(&first, direction) {
            Reach::Outside => return self.contact(direction, zero.clone(), first_phi, &zero),
            Reach::Unclear => return Ok(self.graze(&first_phi, &zero)),
            Reach::Inside => {}
        }
        match self.reach(&second, direction.opposite()) {
            Reach::Outside => {
                return self.contact(direction.opposite(), first_phi, second_phi, &zero);
            }
            Reach::Unclear => return Ok(self.graze(&second_phi, &zero)),
            Reach::Inside => {}
        }

        let drift_rounding = self.input_rounding() * &self.problem.amplitude;
        let Some(drift) = Wall::of_sign(&self.b).filter(|_| self.float(self.b.abs_ref()) > drift_rounding) else {
            return Ok(Truth::Never);
        };
        let (extreme, extreme_phi, piece_start) = if drift == direction {
            (first, &first_phi, self.float(&second_phi - &self.two_pi))
        } else {
            (second, &second_phi, first_phi.clone())
        };
        let per_turn = self.float(&self.two_pi * &self.b);
        let travel = self.float(&self.half_gap * drift.sign()) - &extreme;
        let turns = self.float(&travel / &per_turn).ceil();
        let turn_bits = turns.get_exp().unwrap_or(0) as u32;
        if self.bits < self.problem.precision() + 64 + turn_bits {
            return Err(Unresolved { time: self.time(extreme_phi, &turns), turn_bits });
        }
        for (turn, expected_outside) in [(self.float(&turns - 1u32), false), (turns.clone(), true)] {
            let height = self.float(&per_turn * &turn) + &extreme;
            match (self.reach(&height, drift), expected_outside) {
                (Reach::Inside, false) | (Reach::Outside, true) => {}
                _ => return Ok(self.graze(extreme_phi, &turn)),
            }
        }
        self.contact(drift, piece_start, extreme_phi.clone(), &turns)
    }

    /// alpha = arccos(b / A) in (0, pi); for v+ = 0 the start is itself critical, and alpha = |theta0| without loss.
    fn critical_phase(&self) -> Float {
        if self.start.velocity_after.is_zero() {
            return self.float(self.theta0.abs_ref());
        }
        self.float(&self.b / &self.problem.amplitude).acos()
    }

    /// A sin(alpha) = sqrt((A - b) (A + b)).
    fn swing(&self) -> Float {
        (self.float(&self.problem.amplitude - &self.b) * self.float(&self.problem.amplitude + &self.b)).sqrt()
    }

    /// Compares the extreme `height` with the wall it points to, unless they are within 2^-(3P/4) max(d, A).
    fn reach(&self, height: &Float, wall: Wall) -> Reach {
        let past = self.float(height * wall.sign()) - &self.half_gap;
        let threshold = self.float(&self.scale >> (self.problem.precision() / 4 * 3));
        if past > threshold {
            Reach::Outside
        } else if past < -threshold {
            Reach::Inside
        } else {
            Reach::Unclear
        }
    }
}
