//! True flights under any number of harmonics, by steps that no contact can come within.
//!
//! ```text
//!   y(t) = y_i + E(t_i) + c (t - t_i) - E(t),   E(t) = sum of A sin(W t + tau),   c = v+ + E'(t_i)    (11)
//! ```
//!
//! A step is as long as the bound `M` of `|y''|` lets it be: with `D > 0` the way to a wall and `D'` its rate, `D + D' h - M h^2/2 > 0` up
//! to `h = (D' + sqrt(D'^2 + 2 M D)) / M`. Before a contact these are Newton's steps from the side that is safe.

use rug::Float;
use rug::float::Constant;

/// Bits of all data and states.
pub const BITS: u32 = 640;
/// A height that is taken for none: `2^-this` of the gap, or of what the box moves by.
const TOUCH_BITS: u32 = 480;
/// A speed that is taken for none, before a height that is: `2^-this` of the box's.
const ZERO_SPEED_BITS: u32 = 220;
/// A drift or a force that is taken for none: `2^-this` of its bound.
const ZERO_BITS: u32 = 420;
/// A pressure that is taken for none: `2^-this` of its bound.
const ZERO_FORCE_BITS: u32 = BITS / 2;
/// A rate of the pressure that is taken for none, where the pressure is: `2^-this` of its bound; the way beyond such a touch, of the time in
/// which the rate changes.
const TOUCHED_FORCE_BITS: u32 = 150;
const BEYOND_BITS: u32 = 100;
/// Steps in MPFR, and in doubles, after which a flight is given up.
const STEPS: [u32; 2] = [3_000, 60_000];
/// In doubles a step is taken where both walls are so far, in gaps, and rounding is so little, in parts of that.
const FAR: f64 = 1e-6;
const NOISE: f64 = 1e-13;

/// A number of `BITS` bits.
pub fn float<T>(value: T) -> Float
where
    Float: rug::Assign<T>,
{
    Float::with_val(BITS, value)
}

/// One of the two walls.
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
        if self == Wall::Left { -1 } else { 1 }
    }
}

/// A harmonic.
#[derive(Clone, Debug)]
pub struct Tone {
    /// A, of any sign.
    pub amplitude: Float,
    /// W > 0, radians per unit of time.
    pub frequency: Float,
    /// tau, radians.
    pub phase: Float,
}

/// The pair: its harmonics that are not 0.
#[derive(Clone, Debug)]
pub struct Shaken {
    /// The excitation.
    pub tones: Vec<Tone>,
    /// d > 0.
    pub gap: Float,
    /// e in [0, 1].
    pub restitution: Float,
}

/// The state of the ball after an impact, inside, or at rest.
#[derive(Clone, Debug)]
pub struct State {
    /// Absolute time.
    pub time: Float,
    /// The wall it is on.
    pub on: Option<Wall>,
    /// y, from the middle of the gap.
    pub position: Float,
    /// y' from now on.
    pub velocity_after: Float,
    /// So long after `time` nothing comes: the flight was followed until then.
    pub clear: Float,
}

/// One impact.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Absolute time.
    pub time: Float,
    /// The wall met.
    pub wall: Wall,
    /// y' just before; it points into the wall.
    pub velocity_before: Float,
}

/// The next event of a motion.
#[derive(Clone, Debug)]
pub enum Next {
    /// The first impact.
    Contact(Contact),
    /// An extremum on a wall; the flight goes on, and is clear of it after the second time, from the start of the flight.
    Touch(Float, Wall, Float),
    /// The contact force holds the ball.
    Rests,
    /// No impact comes.
    Never,
    /// More than this simulator follows.
    Open,
}

impl State {
    /// The state after an impact, by (15).
    pub fn after(shaken: &Shaken, contact: &Contact) -> Self {
        let velocity_after = -float(&shaken.restitution * &contact.velocity_before);
        Self::on_wall(shaken, contact.wall, contact.time.clone(), velocity_after)
    }

    /// The state on a wall.
    pub fn on_wall(shaken: &Shaken, wall: Wall, time: Float, velocity_after: Float) -> Self {
        let position = float(&shaken.gap / 2) * wall.sign();
        Self { time, on: Some(wall), position, velocity_after, clear: float(0) }
    }

    /// The state at a place between the walls.
    pub fn inside(time: Float, position: Float, velocity_after: Float) -> Self {
        Self { time, on: None, position, velocity_after, clear: float(0) }
    }
}

impl Tone {
    /// Sine and cosine of the phase at a time.
    fn wave(&self, time: &Float) -> (Float, Float) {
        (float(&self.frequency * time) + &self.phase).sin_cos(float(0))
    }

    /// `A W^power`.
    fn weight(&self, power: u32) -> Float {
        (0..power).fold(self.amplitude.clone(), |weight, _| weight * &self.frequency)
    }
}

impl Shaken {
    /// The sum of `A W^power` times the sine or the cosine of each phase at a time.
    fn sum(&self, time: &Float, power: u32, is_sine: bool) -> Float {
        self.tones.iter().fold(float(0), |sum, tone| {
            let (sine, cosine) = tone.wave(time);
            sum + tone.weight(power) * if is_sine { sine } else { cosine }
        })
    }

    /// The bound of the sum.
    pub fn bound(&self, power: u32) -> Float {
        self.tones.iter().fold(float(0), |sum, tone| sum + tone.weight(power).abs())
    }

    /// The next event after a state.
    pub fn next(&self, state: &State) -> Next {
        Course::new(self, state).next()
    }

    /// The time at which the contact force on a wall ends, at or after a time; `None` where it is not found.
    pub fn release(&self, wall: Wall, time: &Float) -> Option<Float> {
        let [force, rate, most] = [2, 3, 4].map(|power| self.bound(power));
        let mut now = time.clone();
        for _ in 0..STEPS[0] {
            let pressure = self.sum(&now, 2, true) * wall.sign();
            let slope = self.sum(&now, 3, false) * wall.sign();
            if pressure < float(&force >> ZERO_FORCE_BITS) && slope < 0 {
                if -slope.clone() > float(&rate >> TOUCHED_FORCE_BITS) {
                    // A last step, of Newton's.
                    return Some(now - pressure / slope);
                }
                // The force touches 0, and the ball stays.
                now += float(&rate / &most) >> BEYOND_BITS;
                continue;
            }
            let least = float(now.abs_ref()).max(&float(&rate / &most)) >> (BITS - 8);
            now += safe(&pressure, &slope, &most).max(&least);
        }
        None
    }

    /// The common period of the harmonics, where it is one of a few of the first.
    fn period(&self) -> Option<Float> {
        let first = &self.tones.first()?.frequency;
        let is_whole = |x: Float| -> bool {
            let off: Float = x.clone() - x.round();
            off.abs() < float(Float::u_exp(1, -(ZERO_BITS as i32)))
        };
        let of = |turns: u32| self.tones.iter().all(|tone| is_whole(float(&tone.frequency / first) * turns));
        let turns = (1..=12).find(|&turns| of(turns))?;
        Some(float(Constant::Pi) * 2 * turns / first)
    }
}

/// The longest step from a height with a slope that is sure to stay above 0.
fn safe(height: &Float, slope: &Float, most: &Float) -> Float {
    let height: Float = float(height).max(&float(0));
    let root = float(float(slope.square_ref()) + float(most * &height) * 2u32).sqrt();
    // Without cancellation where the wall comes nearer.
    if *slope >= 0 { (root + slope) / most } else { height * 2 / (root - slope) }
}

/// A flight, from its start on.
struct Course<'a> {
    shaken: &'a Shaken,
    state: &'a State,
    /// `c`, and `y + E` at the start.
    drift: Float,
    base: Float,
    half: Float,
    /// The bounds of `|y''|` and `|y'''|`.
    most: Float,
    jerk: Float,
    /// Phases at the start, in doubles, with amplitude and frequency.
    doubles: Vec<[f64; 3]>,
}

impl<'a> Course<'a> {
    fn new(shaken: &'a Shaken, state: &'a State) -> Self {
        let (mut drift, mut base, mut doubles) = (state.velocity_after.clone(), state.position.clone(), Vec::new());
        for tone in &shaken.tones {
            let (sine, cosine) = tone.wave(&state.time);
            drift += tone.weight(1) * &cosine;
            base += float(&tone.amplitude * &sine);
            let phase = Float::with_val(64, sine).atan2(&Float::with_val(64, cosine));
            doubles.push([phase.to_f64(), tone.amplitude.to_f64(), tone.frequency.to_f64()]);
        }
        let [most, jerk] = [2, 3].map(|power| shaken.bound(power));
        Self { shaken, state, drift, base, half: float(&shaken.gap / 2), most, jerk, doubles }
    }

    /// The way to each wall, its rate, and the size of `y''`.
    fn heights(&self, elapsed: &Float) -> ([(Wall, Float, Float); 2], Float) {
        let time = float(&self.state.time + elapsed);
        let (mut y, mut rate) = (float(&self.drift * elapsed) + &self.base, self.drift.clone());
        let mut acceleration = float(0);
        for tone in &self.shaken.tones {
            let (sine, cosine) = tone.wave(&time);
            acceleration += tone.weight(2) * &sine;
            y -= sine * &tone.amplitude;
            rate -= cosine * tone.weight(1);
        }
        let heights = [Wall::Left, Wall::Right].map(|wall| {
            let sign = wall.sign();
            (wall, float(&self.half - float(&y * sign)), float(&rate * -sign))
        });
        (heights, acceleration.abs())
    }

    /// A safe step: by the bound of `|y''|`, or by twice its own size, up to where it may have grown to that.
    fn step(&self, height: &Float, slope: &Float, acceleration: &Float) -> Float {
        let grown = float(acceleration / &self.jerk);
        safe(height, slope, &self.most).max(&safe(height, slope, &float(acceleration * 2)).min(&grown))
    }

    /// A safe step in doubles, where both walls are far.
    fn quick(&self, elapsed: f64) -> Option<f64> {
        let (half, drift, most) = (self.half.to_f64(), self.drift.to_f64(), self.most.to_f64());
        if half < 1e-280 || most < f64::MIN_POSITIVE && !self.doubles.is_empty() {
            return None;
        }
        let (mut y, mut rate) = (self.base.to_f64() + drift * elapsed, drift);
        let mut noise = half + self.base.to_f64().abs() + (drift * elapsed).abs();
        for [phase, amplitude, frequency] in &self.doubles {
            let angle = phase + frequency * elapsed;
            y -= amplitude * angle.sin();
            rate -= amplitude * frequency * angle.cos();
            noise += amplitude.abs() * (1.0 + angle.abs());
        }
        let margin = NOISE * noise;
        let step = |sign: f64| {
            let (height, slope) = (half - sign * y - margin, -sign * rate);
            // Neither underflows where lengths are as small as doubles.
            let root = slope.hypot((2.0 * most).sqrt() * height.sqrt());
            let step = if slope < 0.0 { 2.0 * height / (root - slope) } else { (root + slope) / most };
            (height > FAR * half).then_some(0.999 * step)
        };
        let step = step(1.0)?.min(step(-1.0)?);
        (step > 0.0 && step.is_finite() && margin < FAR * half).then_some(step)
    }

    /// The time, after a period without contact, before which no extremum reaches the wall that the drift leads to: from period to period
    /// all heights move as it does, so the wall behind is left for ever.
    fn carried(&self) -> Float {
        let way = float(&self.half - self.shaken.bound(0)) - float(&self.base * if self.drift < 0 { -1 } else { 1 });
        way / float(self.drift.abs_ref()) * (1u32 - float(Float::u_exp(1, -600)))
    }

    /// The first step from a wall without velocity: by the first derivative that is not 0; `None` where it points outward.
    fn leave(&self, wall: Wall) -> Option<Float> {
        let [acceleration, jerk] =
            [2, 3].map(|power| self.shaken.sum(&self.state.time, power, power == 2) * -wall.sign());
        let bounds = [2, 3, 4].map(|power| self.shaken.bound(power));
        if is_none(&acceleration, &bounds[0]) {
            return (jerk > 0).then(|| jerk * 4 / &bounds[2]);
        }
        (acceleration > 0).then(|| acceleration * 3 / &bounds[1])
    }

    fn next(&self) -> Next {
        let State { on, velocity_after, clear, .. } = self.state;
        let mut elapsed = clear.clone();
        if let (Some(wall), true, true) = (on, velocity_after.is_zero(), elapsed.is_zero()) {
            match self.leave(*wall) {
                None => return Next::Rests,
                // The other wall may be nearer.
                Some(step) => {
                    let others = self.heights(&elapsed).0.into_iter().filter(|(other, ..)| other != wall);
                    let most = |step: Float, (_, height, slope)| step.min(&safe(&height, &slope, &self.most));
                    elapsed = others.fold(step, most);
                }
            }
        }
        let swing = self.shaken.bound(0);
        let scale = if swing.is_zero() { self.shaken.gap.clone() } else { swing.min(&self.shaken.gap) } >> TOUCH_BITS;
        let speed = self.shaken.bound(1) >> ZERO_SPEED_BITS;
        let is_still = is_none(&self.drift, &self.shaken.bound(1));
        let is_inside = float(self.base.abs_ref()) + self.shaken.bound(0) < self.half;
        if is_still && is_inside {
            return Next::Never;
        }
        let mut end = self.shaken.period().map(|period| period + clear);
        let (mut precise, mut quick) = (0, 0);
        while precise < STEPS[0] && quick < STEPS[1] {
            if end.as_ref().is_some_and(|end| elapsed > *end) {
                if is_still {
                    return Next::Never;
                }
                (elapsed, end) = (elapsed.max(&self.carried()), None);
            }
            if let Some(step) = self.quick(elapsed.to_f64()).filter(|_| !elapsed.is_zero()) {
                (elapsed, quick) = (elapsed + step, quick + 1);
                continue;
            }
            let (heights, acceleration) = self.heights(&elapsed);
            let met = heights.iter().find(|(_, height, slope)| *height <= scale && *slope <= 0);
            if let Some((wall, _, slope)) = met.filter(|_| !elapsed.is_zero()) {
                let time = float(&self.state.time + &elapsed);
                if float(slope.abs_ref()) > speed {
                    let velocity_before = float(-slope) * wall.sign();
                    return Next::Contact(Contact { time, wall: *wall, velocity_before });
                }
                let beyond = float(Float::u_exp(1, -160)) * (float(&self.half / &self.most)).sqrt();
                return Next::Touch(time, *wall, elapsed + beyond);
            }
            let [left, right] = heights.map(|(_, height, slope)| self.step(&height, &slope, &acceleration));
            (elapsed, precise) = (elapsed + left.min(&right), precise + 1);
        }
        Next::Open
    }
}

/// Whether a sum is taken for none.
fn is_none(sum: &Float, bound: &Float) -> bool {
    float(sum.abs_ref()) <= float(bound >> ZERO_BITS)
}
