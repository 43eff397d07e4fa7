//! The shaken box, its walls and the states a flight starts from.

use crate::number::Number;
use rug::Float;

/// One of the two walls; also a direction along y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wall {
    /// y = -d/2.
    Left,
    /// y = +d/2.
    Right,
}

impl Wall {
    /// -1 for the left wall, +1 for the right one.
    pub fn sign(self) -> i32 {
        match self {
            Wall::Left => -1,
            Wall::Right => 1,
        }
    }

    /// The other wall.
    pub fn opposite(self) -> Wall {
        match self {
            Wall::Left => Wall::Right,
            Wall::Right => Wall::Left,
        }
    }

    /// The direction in which `value` points, `None` for zero.
    pub(crate) fn of_sign(value: &Float) -> Option<Wall> {
        if value.is_zero() {
            None
        } else if value.is_sign_negative() {
            Some(Wall::Left)
        } else {
            Some(Wall::Right)
        }
    }
}

/// The box E(t) = A sin(W t + tau) and the gap in it.
#[derive(Clone, Debug)]
pub struct Problem {
    /// A >= 0, unit of length.
    pub amplitude: Float,
    /// W > 0, radians per unit of time.
    pub omega: Float,
    /// tau, radians.
    pub tau: Float,
    /// d > 0, unit of length; the walls stand at y = -d/2 and +d/2.
    pub gap: Float,
    /// e in [0, 1], dimensionless.
    pub restitution: Float,
}

impl Problem {
    /// Rounds each parameter to nearest at `precision` bits.
    ///
    /// **Panics**: A < 0, W <= 0, d <= 0, e outside [0, 1], or fewer than 128 bits.
    pub fn new(
        precision: u32,
        amplitude: impl Into<Number>,
        omega: impl Into<Number>,
        tau: impl Into<Number>,
        gap: impl Into<Number>,
        restitution: impl Into<Number>,
    ) -> Problem {
        let problem = Problem {
            amplitude: amplitude.into().to_float(precision),
            omega: omega.into().to_float(precision),
            tau: tau.into().to_float(precision),
            gap: gap.into().to_float(precision),
            restitution: restitution.into().to_float(precision),
        };
        problem.check();
        problem
    }

    /// P: the smallest precision of the five parameters, in bits.
    pub fn precision(&self) -> u32 {
        let all = [&self.amplitude, &self.omega, &self.tau, &self.gap, &self.restitution];
        all.map(Float::prec).into_iter().min().expect("five parameters")
    }

    /// The wall's place, -d/2 or +d/2, exactly.
    pub fn wall_at(&self, wall: Wall) -> Float {
        Float::with_val(self.gap.prec(), &self.gap * wall.sign()) / 2
    }

    pub(crate) fn check(&self) {
        assert!(self.precision() >= 128, "precision must be at least 128 bits, got {}", self.precision());
        assert!(self.amplitude >= 0 && self.amplitude.is_finite(), "amplitude {} < 0", self.amplitude);
        assert!(self.omega > 0 && self.omega.is_finite(), "omega {} <= 0", self.omega);
        assert!(self.tau.is_finite(), "tau {} is not finite", self.tau);
        assert!(self.gap > 0 && self.gap.is_finite(), "gap {} <= 0", self.gap);
        assert!(self.restitution >= 0 && self.restitution <= 1, "restitution {}", self.restitution);
    }
}

/// The state a free flight starts from.
#[derive(Clone, Debug)]
pub struct Start {
    /// t_i, unit of time.
    pub time: Float,
    /// y_i, unit of length, |y_i| <= d/2. Not read when `on` says which wall: then it is that wall's place, exactly.
    pub position: Float,
    /// y' just after t_i (after the impact, on a wall), length per time.
    pub velocity_after: Float,
    /// The wall the ball leaves from, or `None` strictly inside the gap.
    pub on: Option<Wall>,
}

impl Start {
    /// Just after an impact on `wall`: `velocity_after` points inward or is zero. Rounds to the problem's precision.
    pub fn on_wall(problem: &Problem, wall: Wall, time: impl Into<Number>, velocity_after: impl Into<Number>) -> Start {
        Start {
            time: time.into().to_float(problem.precision()),
            position: problem.wall_at(wall),
            velocity_after: velocity_after.into().to_float(problem.precision()),
            on: Some(wall),
        }
    }

    /// Strictly between the walls. Rounds to the problem's precision.
    pub fn inside(
        problem: &Problem,
        time: impl Into<Number>,
        position: impl Into<Number>,
        velocity: impl Into<Number>,
    ) -> Start {
        Start {
            time: time.into().to_float(problem.precision()),
            position: position.into().to_float(problem.precision()),
            velocity_after: velocity.into().to_float(problem.precision()),
            on: None,
        }
    }

    pub(crate) fn check(&self, problem: &Problem) {
        assert!(self.time.is_finite() && self.velocity_after.is_finite(), "state is not finite: {self:?}");
        match self.on {
            Some(wall) => assert!(
                Wall::of_sign(&self.velocity_after) != Some(wall),
                "velocity_after {} points into the {wall:?} wall",
                self.velocity_after
            ),
            None => assert!(
                self.position.cmp_abs(&problem.wall_at(Wall::Right)) == Some(std::cmp::Ordering::Less),
                "position {} is not strictly between the walls; say which wall it is on",
                self.position
            ),
        }
    }

    /// y_i, exactly.
    pub(crate) fn place(&self, problem: &Problem) -> Float {
        self.on.map_or_else(|| self.position.clone(), |wall| problem.wall_at(wall))
    }
}
