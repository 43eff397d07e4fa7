//! A flight in physical lengths and in radians, for all states of a set at once, and what can be proved of its parts.
//!
//! With `h` the phase since the departure at phase `th0`, equations (11) and (12) read
//! `y = y0 + c h - A (sin(th0 + h) - sin th0)`, `y' = c - A cos(th0 + h)`, `y'' = A sin(th0 + h)`, `c = p + A cos th0`,
//! `p` the velocity after the impact; velocities are lengths a radian. Nothing is known here of where `y'` vanishes: parts of
//! the flight are judged by their mean value and Taylor forms, and halved.

use crate::exact::Real;
use crate::pair::Wall;

/// All flights from a set of departures.
#[derive(Clone, Debug)]
pub(in crate::certificate) struct Flight {
    pub amplitude: Real,
    pub half_gap: Real,
    /// `th0`
    pub phase: Real,
    /// `y0`
    pub height: Real,
    /// `p`
    pub velocity: Real,
    /// `sin th0`, `cos th0`
    pub departure: (Real, Real),
}

/// What is known of a part of a flight.
pub(in crate::certificate) enum Part {
    /// The ball is strictly between the walls throughout.
    Clear,
    /// Before the end of the part a wall is hit.
    Contact,
    /// Neither is proved.
    Open,
}

impl Flight {
    /// Rounded outward to fewer bits.
    pub fn rounded(&self, bits: u32) -> Self {
        let Self { amplitude, half_gap, phase, height, velocity, departure: (sin, cos) } = self;
        let [amplitude, half_gap, phase, height, velocity, sin, cos] =
            [amplitude, half_gap, phase, height, velocity, sin, cos].map(|x| x.rounded(bits));
        Self { amplitude, half_gap, phase, height, velocity, departure: (sin, cos) }
    }

    /// `(sin, cos)` of the phase at `h`.
    pub fn sin_cos(&self, h: &Real) -> (Real, Real) {
        (self.phase.clone() + h).sin_cos()
    }

    /// The sine of the phase at `h`.
    pub fn sin(&self, h: &Real) -> Real {
        (self.phase.clone() + h).sin()
    }

    /// The cosine of the phase at `h`.
    pub fn cos(&self, h: &Real) -> Real {
        (self.phase.clone() + h).cos()
    }

    /// `y` at `h`. **Equation** (12)
    pub fn height(&self, h: &Real, sin: &Real) -> Real {
        let swing = (sin.clone() - &self.departure.0) * &self.amplitude;
        self.height.clone() + &(self.drift() * h) - &swing
    }

    /// `y'` where the cosine of the phase is `cos`. **Equation** (11)
    pub fn slope(&self, cos: &Real) -> Real {
        // Grouped so that a flight that hardly turns loses nothing.
        self.velocity.clone() - &((cos.clone() - &self.departure.1) * &self.amplitude)
    }

    /// `y''` where the sine of the phase is `sin`. **Equation** (10)
    pub fn curvature(&self, sin: &Real) -> Real {
        sin.clone() * &self.amplitude
    }

    /// `c`
    fn drift(&self) -> Real {
        self.velocity.clone() + &(self.departure.1.clone() * &self.amplitude)
    }

    /// `y` of a wall.
    pub fn level(&self, wall: Wall) -> Real {
        match wall {
            Wall::Left => -self.half_gap.clone(),
            Wall::Right => self.half_gap.clone(),
        }
    }

    /// Whether `y` is strictly between the walls, on the walls' side or neither: proved or not.
    pub fn place(&self, y: &Real) -> Part {
        let (left, right) = (self.level(Wall::Left), self.level(Wall::Right));
        if left.is_below(y) && y.is_below(&right) {
            Part::Clear
        } else if y.is_below(&left) || right.is_below(y) {
            Part::Contact
        } else {
            Part::Open
        }
    }

    /// Whether the ball is clear of both walls over all of `(a, b]`, given that it is at `a` (Lemma V1).
    pub fn judge(&self, a: &Real, b: &Real) -> Part {
        let (part, end) = (a.hull(b), self.height(b, &self.sin(b)));
        let slope = self.slope(&self.cos(&part));
        if slope.is_positive() || slope.is_negative() {
            return self.place(&end);
        }
        if let Part::Contact = self.place(&end) {
            return Part::Contact;
        }
        let middle = Real::point(part.mid(), part.bits());
        let (middle_sin, middle_cos) = self.sin_cos(&middle);
        let (y, x) = (self.height(&middle, &middle_sin), part.clone() - &middle);
        let mean = y.clone() + &(slope * &x);
        let square = x.clone() * &x;
        let taylor = y + &(self.slope(&middle_cos) * &x) + &(self.curvature(&self.sin(&part)) * &square).half();
        match self.place(&mean.cut(&taylor)) {
            Part::Clear => Part::Clear,
            Part::Contact | Part::Open => Part::Open,
        }
    }

    /// Whether a ball that starts on `wall` is clear of both walls over `(0, b]` (Lemma V1).
    ///
    /// The departure is divided out: `(y - y0)/h = p + y''/2 h` with `y''` somewhere on the part. From a release, where `p` and
    /// `y''` are 0, it is divided out three times.
    pub fn departs(&self, wall: Wall, b: &Real, is_release: bool) -> bool {
        let inward = |x: Real| if wall == Wall::Left { x } else { -x };
        let part = b.hull(&(b.clone() - b));
        let (p, curvature) = (inward(self.velocity.clone()), inward(self.curvature(&self.sin(&part))));
        let slope = p.clone() + &(curvature.clone() * &part).half();
        let leaves = if is_release {
            inward(self.cos(&part) * &self.amplitude).is_positive()
        } else {
            slope.is_positive() || p.is_zero() && curvature.is_positive()
        };
        leaves && (slope * &part).is_below(&(self.half_gap.clone() + &self.half_gap))
    }
}
