//! Flights aimed at a wall: the start velocity, or the gap, at which a chosen extremum touches it, in MPFR.
//!
//! With phi = W (t - t_i) and b = c / W, y = y_i + A sin(theta0) + b phi - A sin(theta0 + phi). The extrema are at
//! cos(theta) = b / A; the height H(b) of a chosen one obeys dH/db = phi > 0 (the other terms cancel, for y' = 0
//! there): it rises with b, and one b at most meets a given height.
#![allow(dead_code)] // each test crate uses a part

use super::scene::{At, Scene};
use impact_pair_truth::Wall;
use rug::float::Constant;
use rug::{Assign, Float};

/// Bits of a construction's last steps: depths of 1e-40 after flights of 1e11 forcing periods leave 250 digits to spare.
pub const BITS: u32 = 1024;
/// Bits of the search before.
const SEARCH: u32 = 192;

/// The extremum aimed at: the maxima point to the right wall, the minima to the left one.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    pub wall: Wall,
    /// Forcing periods from the first extremum of this kind to the aimed extremum.
    pub turn: u64,
}

/// A start without its velocity, at a precision.
#[derive(Clone, Debug)]
pub struct Aim {
    bits: u32,
    amplitude: Float,
    omega: Float,
    /// Phase at the start, in [0, 2 pi).
    theta0: Float,
    /// y_i + A sin(theta0)
    base: Float,
    pub half_gap: Float,
    time: Float,
}

/// The place of an extremum.
pub struct Extremum {
    /// W (t - t_i)
    pub phi: Float,
    /// y, whatever the walls.
    pub height: Float,
}

impl Aim {
    pub fn new(scene: &Scene, bits: u32) -> Aim {
        // Whole forcing periods of the start time take their bits here and nowhere else.
        let wide = bits + 128;
        let (problem, start) = scene.question(wide, [0.0; 5]);
        let two_pi = Float::with_val(wide, Constant::Pi) * 2;
        let phase = Float::with_val(wide, &problem.omega * &start.time) + &problem.tau;
        let turns = Float::with_val(wide, &phase / &two_pi).floor();
        let theta0: Float = phase - turns * two_pi;
        let swing = Float::with_val(wide, theta0.sin_ref()) * &problem.amplitude;
        Aim {
            bits,
            amplitude: Float::with_val(bits, &problem.amplitude),
            omega: Float::with_val(bits, &problem.omega),
            theta0: Float::with_val(bits, theta0),
            base: Float::with_val(bits, swing + &start.position),
            half_gap: Float::with_val(bits, &problem.gap / 2),
            time: start.time,
        }
    }

    pub fn float<T>(&self, value: T) -> Float
    where
        Float: Assign<T>,
    {
        Float::with_val(self.bits, value)
    }

    fn two_pi(&self) -> Float {
        self.float(Constant::Pi) * 2
    }

    /// The extremum of the flight of drift `b`, |b| < A.
    pub fn extremum(&self, b: &Float, target: Target) -> Extremum {
        let critical = self.float(b / &self.amplitude).acos();
        let theta = if target.wall == Wall::Right { self.two_pi() - critical } else { critical };
        let mut phi = self.float(&theta - &self.theta0);
        if phi <= 0 {
            phi += self.two_pi();
        }
        phi += self.two_pi() * target.turn;
        let height = self.float(b * &phi) + &self.base - theta.sin() * &self.amplitude;
        Extremum { phi, height }
    }

    /// v+ = W (b - A cos(theta0)).
    pub fn velocity(&self, b: &Float) -> Float {
        let shaken = self.float(self.theta0.cos_ref()) * &self.amplitude;
        self.float(b - shaken) * &self.omega
    }

    /// b of the velocity v+.
    pub fn drift(&self, velocity: &Float) -> Float {
        self.float(self.theta0.cos_ref()) * &self.amplitude + self.float(velocity / &self.omega)
    }

    /// The increase of the heights by b in a forcing period.
    pub fn drift_per_turn(&self, b: &Float) -> Float {
        self.two_pi() * b
    }

    pub fn wall_at(&self, wall: Wall) -> Float {
        self.float(&self.half_gap * wall.sign())
    }

    /// The absolute time of an extremum.
    pub fn time_of(&self, extremum: &Extremum) -> Float {
        Float::with_val(self.time.prec(), &extremum.phi / &self.omega) + &self.time
    }

    /// b at which the target is at `height`, for a start towards the wall `heading`; `None` if there is none.
    fn bisect(&self, heading: Wall, target: Target, height: &Float) -> Option<Float> {
        let at_rest = self.float(self.theta0.cos_ref()) * &self.amplitude;
        let steepest = self.float(&self.amplitude * heading.sign());
        // A little off the ends: at rest the start is itself an extremum, and beyond +-A there are none.
        let inset = self.float(&steepest - &at_rest) >> 60;
        let (resting, steep) = (self.float(&at_rest + &inset), self.float(&steepest - &inset));
        let (mut low, mut high) = if heading == Wall::Right { (resting, steep) } else { (steep, resting) };
        if self.extremum(&low, target).height > *height || self.extremum(&high, target).height < *height {
            return None;
        }
        for _ in 0..SEARCH - 64 {
            let middle = self.float(&low + &high) / 2;
            if self.extremum(&middle, target).height < *height { low = middle } else { high = middle }
        }
        Some(high)
    }

    /// Newton's steps from `b` to the root near it; `None` unless they converge.
    fn polish(&self, b: &Float, target: Target, height: &Float) -> Option<Float> {
        let mut b = self.float(b);
        for _ in 0..40 {
            let extremum = self.extremum(&b, target);
            let step = self.float(&extremum.height - height) / extremum.phi;
            b -= &step;
            if self.float(b.abs_ref()) >= self.amplitude {
                return None;
            }
            if step.abs() < self.float(&self.amplitude >> (self.bits - 100)) {
                return Some(b);
            }
        }
        None
    }

    /// Whether every extremum before the target stays off its wall by more than `margin`: the first of each kind and the last before the
    /// target bound an arithmetic progression.
    pub fn is_clear(&self, b: &Float, target: Target, margin: &Float) -> bool {
        let other = Target { wall: target.wall.opposite(), turn: 0 };
        let comes_first = self.extremum(b, other).phi < self.extremum(b, Target { turn: 0, ..target }).phi;
        let others = target.turn + u64::from(comes_first);
        let of_kind = |wall, count: u64| (count > 0).then(|| [0, count - 1].map(|turn| Target { wall, turn }));
        let earlier = of_kind(target.wall, target.turn).into_iter().chain(of_kind(other.wall, others)).flatten();
        earlier.into_iter().all(|earlier| {
            let height = self.extremum(b, earlier).height * earlier.wall.sign();
            height + margin < self.half_gap
        })
    }
}

/// A start, all but its velocity, and the drift at which the target touches its wall exactly.
pub struct Touch {
    pub scene: Scene,
    pub aim: Aim,
    pub target: Target,
    pub drift: Float,
}

impl Touch {
    /// `None` when no velocity towards `heading` makes the target touch.
    pub fn search(scene: Scene, heading: Wall, target: Target) -> Option<Touch> {
        let aim = Aim::new(&scene, SEARCH);
        let drift = aim.bisect(heading, target, &aim.wall_at(target.wall))?;
        let leaves = aim.velocity(&drift) * heading.sign() > 0;
        (leaves && aim.is_clear(&drift, target, &Float::new(SEARCH))).then_some(Touch { scene, aim, target, drift })
    }

    /// The flight whose target lies `past` beyond its wall (short of it if negative), and when it is there.
    pub fn shoot(&self, past: &Float) -> Option<(Scene, Float)> {
        let aim = Aim::new(&self.scene, BITS);
        let height = (aim.float(&aim.half_gap) + past) * self.target.wall.sign();
        let drift = aim.polish(&self.drift, self.target, &height)?;
        if !aim.is_clear(&drift, self.target, &(aim.float(past.abs_ref()) * 10)) {
            return None;
        }
        let velocity = aim.velocity(&drift);
        let mut scene = self.scene.clone();
        scene.velocity = match &scene.at {
            At::Inside(_) => decimal(&velocity),
            At::Wall(wall) if velocity.clone() * wall.sign() < 0 => {
                decimal(&-(velocity / scene.restitution.member(BITS, 0.0)))
            }
            At::Wall(_) => return None,
        };
        Some((scene, aim.time_of(&aim.extremum(&drift, self.target))))
    }
}

/// The number as a decimal of 90 digits.
pub fn decimal(value: &Float) -> super::scene::Value {
    super::scene::Value(value.to_string_radix(10, Some(90)), None)
}
