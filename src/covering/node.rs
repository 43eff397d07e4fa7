//! Parallelograms of states on a wall, and the relation "covers" between them: Lemmas F1 and F2 of `docs/proofs/covering.md#F1`.

use crate::contact::{Contact, SetContact, Undecided};
use crate::mapping::Sheared;
use crate::number::{Ball, TINY, UNIT, up};
use crate::pair::Wall;
use crate::shaken::{Flying, Leaving};
use crate::turns;

/// The directions of a parallelogram, in (phase in forcing periods, velocity / scale).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes {
    /// The expanding direction.
    pub unstable: [f64; 2],
    /// The contracting one.
    pub stable: [f64; 2],
    /// The unit of velocities, a power of two.
    pub scale: f64,
}

impl Axes {
    /// Axes of a curve that is given by a parameter.
    pub fn of_curve(scale: f64) -> Self {
        Self { unstable: [1.0, 0.0], stable: [0.0, 1.0], scale }
    }
}

/// All states `centre + xi unstable + eta stable` on a wall with `|xi| <= a`, `|eta| <= b`, `sides = [a, b]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub wall: Wall,
    /// Whole forcing periods of the centre and the rest, in `[-1/2, 1/2]`.
    pub turns: i64,
    pub phase: f64,
    /// Velocity of the centre before the impact, in gap widths per forcing period.
    pub velocity: f64,
    pub axes: Axes,
    pub sides: [f64; 2],
}

/// The first contacts of all flights from a set: condition 1 of Lemma F1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Landing {
    pub wall: Wall,
    /// Whole forcing periods, those of a node whose image this may be.
    pub turns: i64,
    /// The image of the centre: the phase within a radius, the velocity within another after the shear by the slope (Lemma S4).
    pub phase: Ball,
    pub velocity: Ball,
    pub slope: Ball,
    /// The derivative over the set; that of a curve is by its parameter, in the first column. Lemmas F3, F6
    pub jacobian: Sheared<Ball>,
}

impl Landing {
    /// Landing of flights that left in the forcing period `from`.
    #[inline(always)]
    pub fn new(from: i64, image: &SetContact, jacobian: Sheared<Ball>) -> Result<Self, Undecided> {
        let Contact { wall, turns, .. } = image.all;
        let (turns, phase) = turns::carry(turns, image.phase.mid());
        let turns = turns::after(from, turns).ok_or(Undecided::endless())?;
        let phase = Ball::new(phase, image.phase.rad());
        Ok(Self { wall, turns, phase, velocity: image.velocity, slope: image.slope, jacobian })
    }
}

impl Node {
    /// Holds the phases of the node.
    #[inline(always)]
    pub fn phases(&self) -> Ball {
        let Axes { unstable, stable, .. } = self.axes;
        Ball::new(self.phase, up(self.extent(unstable[0], stable[0])))
    }

    /// Holds its velocities.
    #[inline(always)]
    pub fn velocities(&self) -> Ball {
        let Axes { unstable, stable, scale } = self.axes;
        Ball::new(self.velocity, up(scale * self.extent(unstable[1], stable[1]) + TINY))
    }

    /// Half the extent along a coordinate, but for rounding.
    #[inline(always)]
    fn extent(&self, unstable: f64, stable: f64) -> f64 {
        self.sides[0] * unstable.abs() + self.sides[1] * stable.abs() + TINY
    }

    /// Proves that all flights from the node land on one wall, in one forcing period, transversally.
    #[inline(always)]
    pub fn land<S: Flying>(&self, shaken: &S) -> Result<Landing, Undecided> {
        let Self { wall, turns, .. } = *self;
        let set = Leaving { wall, turns, phase: self.phases(), before: self.velocities(), is_release: false };
        let (image, jacobian) = shaken.fly(set, None)?;
        Landing::new(turns, &image, jacobian)
    }
}

/// The image of a parallelogram in the axes of another: bounds of condition 2 of Lemma F1, times the determinant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    /// `|M_11|` is at least, `|M_12|`, `|M_21|` and `|M_22|` at most this.
    stretch: f64,
    leak: f64,
    tilt: f64,
    squeeze: f64,
    /// Bounds of the centre's distance `n_1`, `n_2`.
    noise: [f64; 2],
    /// The determinant's absolute value is at least and at most this; the first is not positive where it may be 0.
    determinant: (f64, f64),
}

/// A lower bound of the absolute values in a ball; none above 0 where it may hold 0 (Lemma B1).
#[inline(always)]
fn least(x: Ball) -> f64 {
    (x.mid().abs() - x.rad()) * (1.0 - 4.0 * UNIT)
}

impl Link {
    /// Link from a set with these axes and this landing to a node; `None` on another wall or in another forcing period.
    #[inline(always)]
    pub fn new(from: &Axes, landing: &Landing, to: &Node) -> Option<Self> {
        if (landing.wall, landing.turns) != (to.wall, to.turns) {
            return None;
        }
        let exact = Ball::exact;
        let Axes { unstable, stable, scale } = to.axes;
        let ([u1, u2], [s1, s2]) = (unstable.map(exact), stable.map(exact));
        // The scale is a power of two within 2^+-400 (S2).
        let unscale = exact(1.0 / scale);
        let (s1_scaled, u1_scaled) = (s1 * unscale, u1 * unscale);
        // The adjugate of the axes, applied to `(time, slope * time + velocity)`.
        let adjugate = |slope: Ball| [s2 - s1_scaled * slope, u1_scaled * slope - u2];
        let Sheared { time, slope, velocity } = landing.jacobian;
        let across = adjugate(slope);
        let column = |axis: [f64; 2]| {
            let (phase, before) = (exact(axis[0]), exact(axis[1]) * exact(from.scale));
            let time = time[0] * phase + time[1] * before;
            let velocity = velocity[0] * phase + velocity[1] * before;
            [across[0] * time - s1_scaled * velocity, across[1] * time + u1_scaled * velocity]
        };
        let (along_u, along_s) = (column(from.unstable), column(from.stable));
        // The centre's image from the node's centre: a distance of middles, and what both radii leave.
        let off = exact(landing.phase.mid()) - exact(to.phase);
        let drift = landing.velocity - exact(to.velocity);
        let spread = Ball::new(0.0, landing.phase.rad());
        let sheared = adjugate(landing.slope);
        let noise =
            [sheared[0] * spread + s2 * off - s1_scaled * drift, sheared[1] * spread + u1_scaled * drift - u2 * off];
        let determinant = u1 * s2 - u2 * s1;
        Some(Self {
            stretch: least(along_u[0]),
            leak: along_s[0].mag(),
            tilt: along_u[1].mag(),
            squeeze: along_s[1].mag(),
            noise: noise.map(Ball::mag),
            determinant: (least(determinant), determinant.mag()),
        })
    }

    /// Condition 2 of Lemma F1, for the sides of two nodes; false where the axes of the second node may be parallel.
    #[inline(always)]
    pub fn covers(&self, [a, b]: [f64; 2], [next_a, next_b]: [f64; 2]) -> bool {
        let inside = up(self.determinant.1 * next_a + self.leak * b + self.noise[0] + TINY);
        let room = self.determinant.0 * next_b * (1.0 - 8.0 * UNIT);
        // F4: axes that are not parallel, and sides that are none below 0; of two factors below 0 the product would be above
        let is_sound = self.determinant.0 > 0.0 && [a, b, next_a, next_b].iter().all(|side| *side >= 0.0);
        is_sound && next_b.is_finite() && self.stretch * a * (1.0 - 8.0 * UNIT) > inside && self.width([a, b]) <= room
    }

    /// Bounds how far the image reaches along the stable axis, times the determinant.
    #[inline(always)]
    fn width(&self, [a, b]: [f64; 2]) -> f64 {
        up(self.tilt * a + self.squeeze * b + self.noise[1] + TINY)
    }

    /// Approximate width of the narrowest covered node; infinite or negative where the axes may be parallel.
    #[inline(always)]
    pub fn narrowest(&self, sides: [f64; 2]) -> f64 {
        self.width(sides) / self.determinant.0 * (1.0 + 16.0 * UNIT)
    }
}
