//! True flights under any number of harmonics: those of one by `impact_pair_truth`, the others, and those through a touch, by steps that
//! no contact can come within.
//!
//! A step is as long as the bound `M` of `|y''|` lets it be: with `D > 0` the way to a wall and `D'` its rate, `D + D' h - M h^2/2 > 0` up
//! to `h = (D' + sqrt(D'^2 + 2 M D)) / M`. Before a contact these are Newton's steps from the side that is safe. It *proves nothing*, as
//! all of this crate; it shares neither isolation nor units nor arithmetic with the library.

use impact_pair_truth::{Contact, Problem, Start, Truth, Wall, first_contact};
use rug::Float;
use rug::float::Constant;

/// Bits of all data and states.
pub const BITS: u32 = 640;
/// A height that is taken for none: `2^-this` of the gap.
const TOUCH_BITS: u32 = 480;
/// A speed that is taken for none, before a height that is: `2^-this` of the box's.
const ZERO_SPEED_BITS: u32 = 220;
/// A pressure that is taken for none: `2^-this` of what it may change in a unit of time.
const ZERO_FORCE_BITS: u32 = BITS / 2;
/// Steps in MPFR, and in doubles, after which a flight is given up.
const STEPS: [u32; 2] = [3_000, 60_000];

pub fn float<T>(value: T) -> Float
where
    Float: rug::Assign<T>,
{
    Float::with_val(BITS, value)
}

/// A harmonic.
#[derive(Clone, Debug)]
pub struct Tone {
    pub amplitude: Float,
    pub frequency: Float,
    pub phase: Float,
}

/// The pair: its harmonics that are not 0.
#[derive(Clone, Debug)]
pub struct Shaken {
    pub tones: Vec<Tone>,
    pub gap: Float,
    pub restitution: Float,
}

/// The state of the ball after an impact, inside, or at rest.
#[derive(Clone, Debug)]
pub struct State {
    pub time: Float,
    pub on: Option<Wall>,
    pub position: Float,
    pub velocity_after: Float,
    /// So long after `time` nothing comes: the flight was followed until then.
    pub clear: Float,
}

/// The next event of a motion.
#[derive(Clone, Debug)]
pub enum Next {
    Contact(Contact),
    /// An extremum on a wall; the flight goes on, and is clear of it after the second time, from the start of the flight.
    Touch(Float, Wall, Float),
    Rests,
    Never,
    /// More than this simulator follows.
    Open,
}

impl State {
    /// The state after an impact.
    pub fn after(shaken: &Shaken, contact: &Contact) -> Self {
        let velocity_after = -float(&shaken.restitution * &contact.velocity_before);
        Self::on_wall(shaken, contact.wall, contact.time.clone(), velocity_after)
    }

    pub fn on_wall(shaken: &Shaken, wall: Wall, time: Float, velocity_after: Float) -> Self {
        let position = float(&shaken.gap / 2) * wall.sign();
        Self { time, on: Some(wall), position, velocity_after, clear: float(0) }
    }
}

impl Shaken {
    /// The sum of `A W^power` times the sine or the cosine of each phase at a time.
    fn sum(&self, time: &Float, power: u32, is_sine: bool) -> Float {
        self.tones.iter().fold(float(0), |sum, tone| {
            let (sine, cosine) = float(float(&tone.frequency * time) + &tone.phase).sin_cos(float(0));
            let wave = if is_sine { sine } else { cosine };
            let weight = (0..power).fold(tone.amplitude.clone(), |weight, _| weight * &tone.frequency);
            sum + weight * wave
        })
    }

    /// The bound of the sum.
    fn bound(&self, power: u32) -> Float {
        let one = |tone: &Tone| (0..power).fold(tone.amplitude.clone(), |weight, _| weight * &tone.frequency);
        self.tones.iter().fold(float(0), |sum, tone| sum + one(tone))
    }

    /// The next contact after a state.
    pub fn next(&self, state: &State) -> Next {
        if self.tones.len() <= 1 && state.clear.is_zero() {
            let zero = float(0);
            let [amplitude, omega, tau] = match self.tones.first() {
                Some(tone) => [&tone.amplitude, &tone.frequency, &tone.phase].map(Float::clone),
                None => [zero.clone(), float(1), zero],
            };
            let problem = Problem::new(BITS, &amplitude, &omega, &tau, &self.gap, &self.restitution);
            let State { time, on, position, velocity_after, .. } = state.clone();
            match first_contact(&problem, &Start { time, position, velocity_after, on }) {
                Truth::Contact { time, wall, velocity_before } => {
                    return Next::Contact(Contact { time, wall, velocity_before });
                }
                Truth::Rests => return Next::Rests,
                Truth::Never => return Next::Never,
                Truth::Graze { .. } => {}
            }
        }
        self.stepped(state)
    }

    /// The same by steps alone.
    pub fn stepped(&self, state: &State) -> Next {
        Course::new(self, state).next()
    }

    /// The time at which the contact force on a wall ends, at or after a time; `None` where it is not found.
    pub fn release(&self, wall: Wall, time: &Float) -> Option<Float> {
        let [rate, most] = [3, 4].map(|power| self.bound(power));
        let mut now = time.clone();
        for _ in 0..STEPS[0] {
            let pressure = self.sum(&now, 2, true) * wall.sign();
            let slope = self.sum(&now, 3, false) * wall.sign();
            if pressure < float(&rate >> ZERO_FORCE_BITS) && slope < 0 {
                // A last step, of Newton's.
                return Some(now - pressure / slope);
            }
            let least = float(float(1) / (1 + float(now.abs_ref()))) >> (BITS - 8);
            now += safe(&pressure, &slope, &most).max(&least);
        }
        None
    }

    /// The common period of the harmonics, where it is one of a few of the first.
    pub fn period(&self) -> Option<Float> {
        let first = &self.tones.first()?.frequency;
        let is_whole = |x: Float| -> bool {
            let off: Float = x.clone() - x.round();
            off.abs() < float(Float::u_exp(1, -420))
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
    most: Float,
    /// Phases at the start, in doubles, with amplitude and frequency.
    doubles: Vec<[f64; 3]>,
}

impl<'a> Course<'a> {
    fn new(shaken: &'a Shaken, state: &'a State) -> Self {
        let reduced = |tone: &Tone| {
            let (sine, cosine) = float(float(&tone.frequency * &state.time) + &tone.phase).sin_cos(float(0));
            [sine.atan2(&cosine).to_f64(), tone.amplitude.to_f64(), tone.frequency.to_f64()]
        };
        Self {
            shaken,
            state,
            drift: shaken.sum(&state.time, 1, false) + &state.velocity_after,
            base: shaken.sum(&state.time, 0, true) + &state.position,
            half: float(&shaken.gap / 2),
            most: shaken.bound(2),
            doubles: shaken.tones.iter().map(reduced).collect(),
        }
    }

    /// The way to each wall, and its rate.
    fn heights(&self, elapsed: &Float) -> [(Wall, Float, Float); 2] {
        let time = float(&self.state.time + elapsed);
        let (mut y, mut rate) = (float(&self.drift * elapsed) + &self.base, self.drift.clone());
        for tone in &self.shaken.tones {
            let (sine, cosine) = float(float(&tone.frequency * &time) + &tone.phase).sin_cos(float(0));
            y -= sine * &tone.amplitude;
            rate -= cosine * &tone.amplitude * &tone.frequency;
        }
        [Wall::Left, Wall::Right].map(|wall| {
            let sign = wall.sign();
            (wall, float(&self.half - float(&y * sign)), float(&rate * -sign))
        })
    }

    /// A safe step in doubles, where both walls are far.
    fn quick(&self, elapsed: f64) -> Option<f64> {
        let (half, drift, most) = (self.half.to_f64(), self.drift.to_f64(), self.most.to_f64());
        let (mut y, mut rate) = (self.base.to_f64() + drift * elapsed, drift);
        let mut noise = half + self.base.to_f64().abs() + (drift * elapsed).abs();
        for [phase, amplitude, frequency] in &self.doubles {
            let angle = phase + frequency * elapsed;
            y -= amplitude * angle.sin();
            rate -= amplitude * frequency * angle.cos();
            noise += amplitude * (1.0 + angle.abs());
        }
        let margin = 1e-13 * noise;
        let step = |sign: f64| {
            let (height, slope) = (half - sign * y - margin, -sign * rate);
            let root = (slope * slope + 2.0 * most * height).sqrt();
            let step = if slope < 0.0 { 2.0 * height / (root - slope) } else { (root + slope) / most };
            (height > 1e-3 * half).then_some(0.999 * step)
        };
        let step = step(1.0)?.min(step(-1.0)?);
        (step > 0.0 && margin < 1e-6 * half).then_some(step)
    }

    /// The first step from a wall without velocity: by the first derivative that is not 0; `None` where it points outward.
    fn leave(&self, wall: Wall) -> Option<Float> {
        let [acceleration, jerk] =
            [2, 3].map(|power| self.shaken.sum(&self.state.time, power, power == 2) * -wall.sign());
        let bounds = [2, 3, 4].map(|power| self.shaken.bound(power));
        let is_none = |sum: &Float, bound: &Float| float(sum.abs_ref()) < float(bound >> 420u32);
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
                    let others = self.heights(&elapsed).into_iter().filter(|(other, ..)| other != wall);
                    let most = |step: Float, (_, height, slope)| step.min(&safe(&height, &slope, &self.most));
                    elapsed = others.fold(step, most);
                }
            }
        }
        let (scale, speed) = (float(&self.shaken.gap >> TOUCH_BITS), self.shaken.bound(1) >> ZERO_SPEED_BITS);
        let is_still = float(self.drift.abs_ref()) < float(self.shaken.bound(1) >> 420u32);
        let is_inside = float(self.base.abs_ref()) + self.shaken.bound(0) < self.half;
        if is_still && is_inside {
            return Next::Never;
        }
        let end = self.shaken.period().filter(|_| is_still).map(|period| period + clear);
        let (mut precise, mut quick) = (0, 0);
        while precise < STEPS[0] && quick < STEPS[1] {
            if end.as_ref().is_some_and(|end| elapsed > *end) {
                return Next::Never;
            }
            if let Some(step) = self.quick(elapsed.to_f64()).filter(|_| !elapsed.is_zero()) {
                (elapsed, quick) = (elapsed + step, quick + 1);
                continue;
            }
            let heights = self.heights(&elapsed);
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
            let steps = heights.map(|(_, height, slope)| safe(&height, &slope, &self.most));
            let [left, right] = steps;
            (elapsed, precise) = (elapsed + left.min(&right), precise + 1);
        }
        Next::Open
    }
}
