//! Shared parts of the tests: a seeded generator and problems biased to corners.
#![allow(dead_code)] // each test crate uses a part

pub mod aim;
pub mod arithmetics;
pub mod families;
pub mod judge;
pub mod scene;
pub mod short_flights;
pub mod starts;
pub mod straddling;
pub mod verdicts;

use impact_pair_truth::{Problem, Start, Truth, Wall, first_contact, pi_times};
use rug::Float;

/// splitmix64 (Steele, Lea & Flood 2014): tiny, deterministic, enough for picking test cases.
#[derive(Clone)]
pub struct Random(u64);

impl Random {
    /// The generator of this seed, whatever the environment says.
    pub fn new(seed: u64) -> Random {
        Random(seed)
    }

    /// Seeded by `IMPACT_PAIR_SEED`, or `fallback`; the seed is printed, so a failure shows it.
    pub fn seeded(fallback: u64) -> Random {
        let seed = std::env::var("IMPACT_PAIR_SEED").map_or(fallback, |text| text.parse().unwrap());
        println!("IMPACT_PAIR_SEED={seed}");
        Random(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, count: u64) -> u64 {
        self.bits() % count
    }

    /// Uniform in [low, high).
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// 10 to a uniform power.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.uniform(low, high))
    }
}

/// An eighth of `base` cases, times `IMPACT_PAIR_MULTIPLIER`.
pub fn cases(base: usize) -> usize {
    let multiplier: usize = std::env::var("IMPACT_PAIR_MULTIPLIER").map_or(1, |text| text.parse().unwrap());
    (base * multiplier).div_ceil(8)
}

/// A/d in 0.01..100, any W, e in [0, 1]; starts on a wall or inside, v = 0 or tiny, now or at a huge time.
pub fn random_case(random: &mut Random, precision: u32) -> (Problem, Start) {
    let gap = random.magnitude(-2.0, 2.0);
    let amplitude = gap * random.magnitude(-2.0, 2.0);
    let omega = random.magnitude(-1.0, 3.0);
    let tau = random.uniform(-4.0, 4.0);
    let restitution = match random.below(4) {
        0 => 0.0,
        1 => 1.0,
        _ => random.uniform(0.0, 1.0),
    };
    let problem = Problem::new(precision, amplitude, omega, tau, gap, restitution);
    let time = match random.below(4) {
        0 => 0.0,
        1 => random.magnitude(6.0, 300.0),
        2 => -random.magnitude(0.0, 12.0),
        _ => random.uniform(0.0, 100.0 / omega),
    };
    let speed = amplitude
        * omega
        * match random.below(6) {
            0 => 0.0,
            1 => random.magnitude(-6.0, 0.0),
            2 => random.magnitude(0.0, 1.0),
            _ => random.uniform(0.0, 2.0),
        };
    let start = match random.below(3) {
        0 => Start::on_wall(&problem, Wall::Left, time, speed),
        1 => Start::on_wall(&problem, Wall::Right, time, -speed),
        _ => {
            let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
            let place = match random.below(3) {
                0 => 0.0,
                1 => 0.5 - random.magnitude(-9.0, -1.0),
                _ => random.uniform(-0.499, 0.499),
            };
            Start::inside(&problem, time, gap * place, sign * speed)
        }
    };
    (problem, start)
}

/// y (ignoring walls) at an absolute time, straight from eq. (11): whole phase, four times the precision.
pub fn displacement(problem: &Problem, start: &Start, time: &Float) -> Float {
    let bits = 4 * problem.precision() + 1100;
    let theta = |t: &Float| Float::with_val(bits, &problem.omega * t) + &problem.tau;
    let swing0 = theta(&start.time).sin_cos(Float::new(bits));
    let drift = Float::with_val(bits, &problem.amplitude * &problem.omega) * swing0.1 + &start.velocity_after;
    let elapsed = Float::with_val(bits, time - &start.time);
    (swing0.0 - theta(time).sin()) * &problem.amplitude + drift * elapsed + &start.position
}

/// The contact's time, wall and velocity, or a panic with the case.
pub fn contact(problem: &Problem, start: &Start) -> (Float, Wall, Float) {
    match first_contact(problem, start) {
        Truth::Contact { time, wall, velocity_before } => (time, wall, velocity_before),
        other => panic!("no contact but {other:?} for {problem:?} {start:?}"),
    }
}

/// The paper's figures 12-17: problem and the state after the impact at t = 0 on the left wall.
pub fn figure(number: u32, precision: u32) -> (Problem, Start) {
    let (pi_omega, amplitude, gap, restitution, before, tau) = match number {
        12 => (1, 1, "9.42497", "0.5", "12.56636", "0"),
        13 => (1, 2, "9.42497", "0.5", "12.56636", "0"),
        14 => (1, 8, "9.42497", "0.5", "12.56636", "0"),
        15 => (10, 2, "1", "0.8", "14.48", "0"),
        16 => (20, 10, "1", "0.8", "2", "0"),
        17 => (200, 10, "10", "0.8", "0", "1.047196"),
        _ => panic!("no figure {number}"),
    };
    let omega = pi_times(precision, pi_omega);
    let problem = Problem::new(precision, amplitude, &omega, tau, gap, restitution);
    let after = Float::with_val(precision, Float::parse(before).unwrap()) * &problem.restitution;
    let start = Start::on_wall(&problem, Wall::Left, 0, &after);
    (problem, start)
}
