//! Costs of proofs in multiprecision: certified orbits against plain MPFR with the same precision plan, as ratios.
//!
//! `cargo bench --bench multiprecision`. The plain program does what a competent user of MPFR would: the wall and a
//! first guess from doubles, steps of the fourth order that quadruple the bits, one sine and cosine at full precision
//! an impact. It proves nothing, has no radii and never looks back at the residual.

use std::hint::black_box;
use std::time::Instant;

use impact_pair::contact::first_contact_f64;
use impact_pair::exact::Exact;
use impact_pair::flight::Flight;
use impact_pair::number::{Kernel, MpBall, kernel};
use impact_pair::orbit::{Orbit, Plan, Settings};
use impact_pair::pair::{Reduced, Wall};
use impact_pair_benches::{Figure, figures, median};
use rug::Float;
use rug::float::Constant;

const ROUNDS: usize = 5;

fn main() {
    // `cargo test --benches` only checks that it runs.
    let full = std::env::args().any(|argument| argument == "--bench");
    let (rounds, lengths) = if full { (ROUNDS, &[300, 1000, 3000, 10_000][..]) } else { (1, &[300][..]) };
    println!("median of {rounds} interleaved rounds, microseconds an impact, 9 digits");
    println!("{:<7}{:>9}{:>8}{:>12}{:>9}{:>8}{:>9}", "", "impacts", "bits", "certified", "plain", "ratio", "walls");
    for figure in figures().into_iter().filter(|figure| ["fig14", "fig16", "fig17"].contains(&figure.name)) {
        for &impacts in lengths {
            row(&figure, impacts, rounds);
        }
    }
}

fn row(figure: &Figure, impacts: u64, rounds: usize) {
    let settings = Settings { impacts: Some(impacts), ..Settings::default() };
    let certified = || Orbit::new(&figure.pair, &figure.start, settings.clone()).expect("printed data");
    let mut orbit = certified();
    let walls: Vec<Wall> = orbit.by_ref().map(|impact| impact.wall).collect();
    let plan = orbit.plan().expect("chaos is beyond doubles").clone();
    let plain = || Plain::new(figure, &plan).take(impacts as usize);
    let agree = walls.iter().zip(plain()).take_while(|(a, b)| **a == *b).count();
    let (mut proved, mut unproved, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..rounds {
        proved.push(time(impacts, || certified().for_each(|impact| _ = black_box(impact))));
        unproved.push(time(impacts, || plain().for_each(|wall| _ = black_box(wall))));
        ratios.push(proved[proved.len() - 1] / unproved[unproved.len() - 1]);
    }
    println!(
        "{:<7}{:>9}{:>8}{:>12.1}{:>9.1}{:>8.2}{agree:>9}",
        figure.name,
        walls.len(),
        plan.bits(0),
        median(proved),
        median(unproved),
        median(ratios)
    );
}

/// Microseconds an impact.
fn time(impacts: u64, run: impl FnOnce()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_secs_f64() * 1e6 / impacts as f64
}

/// An orbit in plain MPFR numbers.
struct Plain<'p> {
    plan: &'p Plan,
    pair: Reduced<Float>,
    doubles: Reduced<f64>,
    index: u64,
    wall: Wall,
    phase: Float,
    velocity: Float,
    /// Sine and cosine of the phase.
    sin_cos: (Float, Float),
}

/// A flight in plain MPFR numbers, mirrored as in the library.
struct PlainFlight {
    alpha: Float,
    beta: Float,
    phase: Float,
    sin: Float,
    drift: Float,
    height: f64,
    turns: f64,
    wall: Wall,
}

impl<'p> Plain<'p> {
    fn new(figure: &Figure, plan: &'p Plan) -> Self {
        let bits = plan.bits(0);
        let float = |x: &Exact| MpBall::enclosing(&x.enclose(bits), bits).mid().clone();
        let exact = Reduced::exact(&figure.pair).expect("printed data");
        let frequency = figure.pair.excitation().reference().frequency();
        let turn = Exact::pi() * Exact::from(2);
        let phase = figure.pair.excitation().reference().phase().checked_div(&turn).expect("printed data");
        let slowness = (turn.checked_div(frequency)).and_then(|x| x.checked_div(figure.pair.gap()));
        let velocity = figure.start.velocity().checked_mul(&slowness.expect("printed data")).expect("printed data");
        let phase = float(&phase);
        let doubles = Reduced::exact(&figure.pair).and_then(|exact| exact.enclosed()).expect("printed data").centre();
        let sin_cos = sin_cos(&phase, bits);
        let (pair, velocity) = (exact.map(float), float(&velocity));
        Self { plan, pair, doubles, index: 0, wall: Wall::Left, phase, velocity, sin_cos }
    }
}

impl Iterator for Plain<'_> {
    type Item = Wall;

    fn next(&mut self) -> Option<Wall> {
        let (bits, next) = (self.plan.bits(self.index), self.plan.bits(self.index + 1));
        let sign = self.wall.sign();
        let float = |x: &Float| Float::with_val(bits, x);
        let after = -Float::with_val(bits, &self.pair.restitution * &self.velocity) * sign;
        let phase = self.phase.to_f64();
        let flight = Flight::from_wall(&self.doubles, self.wall, phase, after.to_f64(), kernel::sin_cos(phase));
        let contact = first_contact_f64::<Kernel>(&flight)?;
        let drift = Float::with_val(bits, &self.pair.beta * &self.sin_cos.1) * sign + after;
        let flight = PlainFlight {
            alpha: float(&self.pair.alpha),
            beta: float(&self.pair.beta),
            phase: float(&self.phase),
            sin: float(&self.sin_cos.0) * sign,
            drift,
            height: if contact.wall == self.wall { 0.0 } else { 1.0 },
            turns: contact.turns,
            wall: self.wall,
        };
        let mut at = Float::with_val(53, contact.phase);
        for level in precisions(next, contact.velocity.abs()) {
            at.set_prec(level);
            at += flight.at(level).step(&sin_cos(&at, level), &at).0;
        }
        at.set_prec(next);
        let base = sin_cos(&at, bits);
        let (step, _) = flight.step(&base, &at);
        self.sin_cos = turned(&base, &step, bits);
        at += step;
        let (_, velocity) = flight.see(&self.sin_cos, &at);
        self.velocity = Float::with_val(next, velocity * sign);
        let whole = at.to_f64().round();
        self.phase = at - whole;
        self.wall = contact.wall;
        self.index += 1;
        Some(self.wall)
    }
}

impl PlainFlight {
    /// The same in fewer bits.
    fn at(&self, bits: u32) -> Self {
        let float = |x: &Float| Float::with_val(bits, x);
        Self {
            alpha: float(&self.alpha),
            beta: float(&self.beta),
            phase: float(&self.phase),
            sin: float(&self.sin),
            drift: float(&self.drift),
            ..*self
        }
    }

    /// Height above the target, and velocity.
    fn see(&self, (sin, cos): &(Float, Float), at: &Float) -> (Float, Float) {
        let (bits, sign) = (self.drift.prec(), self.wall.sign());
        let wave = Float::with_val(bits, sin * sign) - &self.sin;
        let since = Float::with_val(bits, at - &self.phase) + self.turns;
        let height =
            Float::with_val(bits, &self.drift * since) - Float::with_val(bits, &self.alpha * wave) - self.height;
        let velocity = &self.drift - Float::with_val(bits, &self.beta * cos) * sign;
        (height, velocity)
    }

    /// The step of the fourth order to the root, and the velocity.
    fn step(&self, sin_cos: &(Float, Float), at: &Float) -> (Float, Float) {
        let (bits, sign) = (self.drift.prec(), self.wall.sign());
        let (height, velocity) = self.see(sin_cos, at);
        let half = bits / 2 + 64;
        let turn = Float::with_val(half, Constant::Pi) * 2u32;
        let swing = Float::with_val(half, &turn * &self.beta);
        let newton = Float::with_val(bits, &height / &velocity);
        let n = Float::with_val(half, &newton);
        let slope = Float::with_val(half, &velocity);
        let bend = Float::with_val(half, &swing * &sin_cos.0) * sign / &slope / 2u32;
        let jerk = Float::with_val(half, swing * turn) * Float::with_val(half, &sin_cos.1) * sign / slope / 6u32;
        let square = Float::with_val(half, &n * &n);
        let cubic = (jerk - Float::with_val(half, &bend * &bend) * 2u32) * n;
        (-(newton - (cubic - bend) * square), velocity)
    }
}

/// The precisions of the steps before the last.
fn precisions(bits: u32, velocity: f64) -> Vec<u32> {
    let lost = (8.0 - velocity.log2().min(0.0)).ceil() as u32;
    let mut levels = Vec::new();
    let mut needed = bits / 4 + lost;
    while needed > 45 && needed > 2 * lost {
        levels.push((needed + lost).max(64));
        needed = needed / 4 + lost;
    }
    levels.reverse();
    levels
}

fn sin_cos(phase: &Float, bits: u32) -> (Float, Float) {
    let angle = Float::with_val(bits, Constant::Pi) * 2u32 * phase;
    let cos = Float::new(bits);
    angle.sin_cos(cos)
}

/// Sine and cosine a short step later, by Taylor's formula.
fn turned((sin, cos): &(Float, Float), step: &Float, bits: u32) -> (Float, Float) {
    let x = Float::with_val(bits, Constant::Pi) * 2u32 * step;
    let (mut sine, mut versine, mut term) = (x.clone(), Float::new(bits), x.clone());
    for n in 2u32.. {
        term = term * &x / n;
        let sum = if n % 2 == 0 { &mut versine } else { &mut sine };
        if matches!(n % 4, 1 | 2) {
            *sum += &term
        } else {
            *sum -= &term
        }
        if term.is_zero() || term.get_exp() < x.get_exp().map(|e| e - bits as i32) {
            break;
        }
    }
    let turned_sin =
        Float::with_val(bits, sin - Float::with_val(bits, sin * &versine)) + Float::with_val(bits, cos * &sine);
    let turned_cos =
        Float::with_val(bits, cos - Float::with_val(bits, cos * &versine)) - Float::with_val(bits, sin * &sine);
    (turned_sin, turned_cos)
}
