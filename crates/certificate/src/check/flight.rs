//! A flight in physical lengths and in radians, for all states of a set at once, with proofs about parts of the flight.
//!
//! With `h` the phase of the reference harmonic since the departure and `E` the forcing since then ([`Shaking`]), equations (11)
//! and (12) read `y = y0 + c h - (E(h) - E(0))`, `y' = c - E'(h)`, `y'' = -E''(h)`, `c = p + E'(0)`, `p` the velocity after the
//! impact; velocities are lengths per radian. No zeros of `y'` are used: parts of the flight are bounded by
//! mean value and Taylor forms, and halved.

use super::budget::Budget;
use super::number::Number;
use super::shaking::Shaking;
use super::span::Span;
use impact_pair_exact::Real;
use impact_pair_model::Wall;

/// All flights from a set of departures.
#[derive(Clone)]
pub(crate) struct Flight<'w, N = Real> {
    pub shaking: Shaking<N>,
    pub half_gap: N,
    /// `y0`
    pub height: N,
    /// `p`
    pub velocity: N,
    /// The work that is left.
    pub budget: Budget<'w>,
}

/// Bounds of a part of a flight.
pub(crate) enum Part {
    /// The ball is strictly between the walls throughout.
    Clear,
    /// Before the end of the part a wall is hit.
    Contact,
    /// Neither is proved.
    Open,
}

impl<N: Number> Flight<'_, N> {
    /// Bits of the arithmetic.
    pub fn bits(&self) -> u32 {
        self.velocity.bits()
    }

    /// Takes one flight evaluation off the budget.
    fn spend(&self) {
        self.budget.spend(self.bits(), self.shaking.waves.len());
    }

    /// The flights, rounded outward to fewer bits.
    pub fn rounded(&self, bits: u32) -> Self {
        let Self { shaking, half_gap, height, velocity, budget } = self;
        let [half_gap, height, velocity] = [half_gap, height, velocity].map(|x| x.rounded(bits));
        Self { shaking: shaking.rounded(bits), half_gap, height, velocity, budget: budget.clone() }
    }

    /// The same flights, with sines known at `h`.
    pub fn known_at(self, h: &N) -> Self {
        self.spend();
        Self { shaking: self.shaking.known_at(h), ..self }
    }

    /// The same flights, with the sines that are known of `one` of them.
    pub fn known_as(self, one: &Self) -> Self {
        Self { shaking: self.shaking.known_as(&one.shaking), ..self }
    }

    /// `y` at `h`. **Equation** (12)
    pub fn height(&self, h: &N) -> N {
        self.spend();
        let drift = self.velocity.clone() + &self.shaking.first_velocity();
        self.height.clone() + &(drift * h) - &self.shaking.shift(h)
    }

    /// `y'` at `h`. **Equation** (11)
    pub fn slope(&self, h: &N) -> N {
        self.spend();
        self.velocity.clone() - &self.shaking.velocity_change(h)
    }

    /// `y''` at `h`. **Equation** (10)
    pub fn curvature(&self, h: &N) -> N {
        self.spend();
        self.shaking.acceleration(h)
    }

    /// `y` of a wall.
    pub fn level(&self, wall: Wall) -> N {
        match wall {
            Wall::Left => -self.half_gap.clone(),
            Wall::Right => self.half_gap.clone(),
        }
    }

    /// Whether `y` is proved strictly between the walls, proved beyond a wall, or neither.
    pub fn place(&self, y: &N) -> Part {
        let (left, right) = (self.level(Wall::Left), self.level(Wall::Right));
        if left.is_below(y) && y.is_below(&right) {
            Part::Clear
        } else if y.is_below(&left) || right.is_below(y) {
            Part::Contact
        } else {
            Part::Open
        }
    }

    /// Whether the ball is proved clear of both walls over `(a, b]`, given that it is clear at `a` (Lemma V1).
    pub fn judge(&self, a: &N, b: &N) -> Part {
        let (part, end) = (a.hull(b), self.height(b));
        let slope = self.slope(&part);
        if slope.is_positive() || slope.is_negative() {
            return self.place(&end);
        }
        if let Part::Contact = self.place(&end) {
            return Part::Contact;
        }
        let middle = part.middle();
        let (y, x) = (self.height(&middle), part.clone() - &middle);
        let mean = y.clone() + &(slope * &x);
        let square = x.clone() * &x;
        let taylor = y + &(self.slope(&middle) * &x) + &(self.curvature(&part) * &square).half();
        match self.place(&mean.cut(&taylor)) {
            Part::Clear => Part::Clear,
            Part::Contact | Part::Open => Part::Open,
        }
    }

    /// Whether a ball that starts on `wall` is clear of both walls over `(0, b]` (Lemma V1).
    ///
    /// The departure is divided out: `(y - y0)/h = p + y''/2 h` with `y''` somewhere on the part. From a release, where `p` and
    /// `y''` are 0, `y - y0` is divided by `h^3`.
    pub fn departs(&self, wall: Wall, b: &N, is_release: bool) -> bool {
        let inward = |x: N| if wall == Wall::Left { x } else { -x };
        let part = b.hull(&(b.clone() - b));
        let (p, curvature) = (inward(self.velocity.clone()), inward(self.curvature(&part)));
        let slope = p.clone() + &(curvature.clone() * &part).half();
        let leaves = if is_release {
            inward(self.shaking.jerk(&part)).is_positive()
        } else {
            slope.is_positive() || p.is_zero() && curvature.is_positive()
        };
        leaves && (slope * &part).is_below(&(self.half_gap.clone() + &self.half_gap))
    }
}

impl<'w> Flight<'w> {
    /// The flights in doubles, with a budget of their own; `None` beyond the range of doubles.
    pub fn in_doubles(&self, work: u64) -> Option<Flight<'w, Span>> {
        let Self { shaking, half_gap, height, velocity, budget } = self;
        let of = |x: &Real| Span::of(x.enclosure());
        Some(Flight {
            shaking: shaking.in_doubles()?,
            half_gap: of(half_gap),
            height: of(height),
            velocity: of(velocity),
            budget: budget.apart(work),
        })
    }
}
