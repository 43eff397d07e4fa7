//! Stable cycles near a chaotic orbit, searched in floating point: an orbit that nearly comes back, whose product of Jacobians has a small
//! trace, and Newton's iteration for a cycle of trace 0, the parameter being one of the unknowns.
//!
//! Labels: proposes throughout.

use std::collections::HashMap;

use nalgebra::{Matrix3, Vector3};

use crate::chaos::guess::Guess;
use crate::chaos::law::{Law, Side};
use crate::chaos::quad::State;
use crate::chaos::vector::{apart, in_period, times};
use crate::number::Ball;
use crate::watch::Watch;

/// The parameter of the reduced map that varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum VariedParameter {
    /// `D = d/A`
    Gap,
    /// `e`
    Restitution,
}

/// The family of reduced maps, and which part of it is searched.
#[derive(Clone, Copy, Debug)]
pub(super) struct Family {
    pub varies: VariedParameter,
    /// The parameter that does not vary: `e`, or `D`.
    pub fixed: f64,
    /// The range of `D`, or `e`.
    pub range: [f64; 2],
    /// The longest cycle that is looked for, at most [`MAX_CYCLE`].
    pub longest: usize,
}

/// A cycle of trace 0 in floating point.
#[derive(Clone, Debug)]
pub(super) struct Superstable {
    /// `D`, or `e`.
    pub parameter: f64,
    /// Phase and speed of an impact.
    pub state: State,
    /// The wall that each flight ends on.
    pub flights: Vec<Side>,
}

/// The longest cycle that can be looked for, in impacts of the reduced map.
pub const MAX_CYCLE: usize = 64;
/// Impacts before an orbit is looked at.
const TRANSIENT: usize = 500;
/// Distance, in forcing periods and in `A W`, within which an orbit counts as having come back.
const RETURN_DISTANCE: State = [0.0016, 0.01];
/// The greatest trace of a product of Jacobians that is tried, the factor by which it grows per impact, and the impacts beyond which it does.
const MAX_TRACE: f64 = 10.0;
const TRACE_GROWTH: f64 = 1.25;
const TRACE_FROM: i32 = 23;
/// Number of times that a word is tried along one orbit.
const MAX_TRIES: u8 = 3;
/// Steps of Newton's iteration, the distance at which its differences are taken, and when it has ended.
const STEPS: usize = 14;
const DIFFERENCE_STEP: f64 = 1e-8;
const STEP_TOLERANCE: f64 = 1e-9;
/// The longest step of the parameter, relative, and of the state.
const MAX_PARAMETER_STEP: f64 = 2e-4;
const MAX_STATE_STEP: f64 = 0.02;
/// Distance within which two parts of a cycle count as one: it runs through a shorter cycle, or has doubled it.
const SHORTER_CYCLE_DISTANCE: f64 = 1e-3;

/// A state with the derivative of the map from it and the wall that its flight ends on.
#[derive(Clone, Copy)]
struct Step {
    state: State,
    jacobian: [[f64; 2]; 2],
    side: Side,
}

impl Family {
    /// The reduced map at a value of the parameter.
    pub fn map(&self, parameter: f64) -> Guess {
        let [gap, restitution] = match self.varies {
            VariedParameter::Gap => [parameter, self.fixed],
            VariedParameter::Restitution => [self.fixed, parameter],
        };
        Guess::new(&Law { gap: Ball::exact(gap), restitution: Ball::exact(restitution) })
    }

    /// Follows an orbit for `impacts` impacts and returns the stable cycles it comes near to, each of them perhaps several times.
    pub fn search(&self, (parameter, start): (f64, State), impacts: usize, watch: &dyn Watch) -> Vec<Superstable> {
        let map = self.map(parameter);
        let mut found: Vec<Superstable> = Vec::new();
        let mut tried = HashMap::new();
        let mut state = start;
        let mut past: Vec<Step> = Vec::with_capacity(impacts.min(1 << 16) + MAX_CYCLE);
        for i in 0..TRANSIENT + impacts {
            let Some(image) = map.map(state) else { break };
            let next = in_period(image.state);
            if i >= TRANSIENT {
                past.push(Step { state, jacobian: image.jacobian, side: image.side });
                self.close(&past, next, parameter, (&mut tried, &mut found));
            }
            state = next;
            if past.len() == past.capacity() {
                past.drain(..past.len() - MAX_CYCLE);
                if !watch.goes_on() {
                    break;
                }
            }
        }
        found
    }

    /// Tries the cycles that the last impacts nearly close, each word at most `MAX_TRIES` times.
    fn close(
        &self,
        past: &[Step],
        next: State,
        parameter: f64,
        (tried, found): (&mut HashMap<(usize, u64), u8>, &mut Vec<Superstable>),
    ) {
        let mut product = [[1.0, 0.0], [0.0, 1.0]];
        let (mut multiplied, mut word) = (0, 0);
        for n in 1..=self.longest.min(past.len()) {
            let step = &past[past.len() - n];
            let apart = step.state[0] - next[0];
            if !((apart - apart.round()).abs() < RETURN_DISTANCE[0]
                && (step.state[1] - next[1]).abs() < RETURN_DISTANCE[1])
            {
                continue;
            }
            for step in past[past.len() - n..past.len() - multiplied].iter().rev() {
                product = times(product, step.jacobian);
                word = word << 1 | u64::from(step.side == Side::Far);
            }
            multiplied = n;
            let most = MAX_TRACE * TRACE_GROWTH.powi((n as i32 - TRACE_FROM).max(0));
            if (product[0][0] + product[1][1]).abs() > most {
                continue;
            }
            let count = tried.entry((n, word)).or_insert(0);
            if *count >= MAX_TRIES {
                continue;
            }
            *count += 1;
            let flights: Vec<Side> = past[past.len() - n..].iter().map(|step| step.side).collect();
            let cycle = self.newton(parameter, step.state, flights);
            found.extend(cycle.filter(|cycle| found.iter().all(|other| !cycle.is_near(other))));
        }
    }

    /// Newton's iteration for a cycle of trace 0 with these flights.
    fn newton(&self, parameter: f64, start: State, flights: Vec<Side>) -> Option<Superstable> {
        let mut x = Vector3::new(start[0], start[1], parameter);
        let misses = |x: &Vector3<f64>| -> Option<Vector3<f64>> {
            let (end, trace, _) = self.fly(x[2], [x[0], x[1]], &flights)?;
            let apart = end[0] - x[0];
            Some(Vector3::new(apart - apart.round(), end[1] - x[1], trace))
        };
        let [low, high] = self.range;
        for _ in 0..STEPS {
            let here = misses(&x)?;
            let mut jacobian = Matrix3::zeros();
            for j in 0..3 {
                let mut there = x;
                there[j] += DIFFERENCE_STEP;
                let mut back = x;
                back[j] -= DIFFERENCE_STEP;
                jacobian.set_column(j, &((misses(&there)? - misses(&back)?) / (2.0 * DIFFERENCE_STEP)));
            }
            let mut step = -jacobian.lu().solve(&here)?;
            let size = (step[2].abs() / (MAX_PARAMETER_STEP * parameter))
                .max(step[0].abs().max(step[1].abs()) / MAX_STATE_STEP);
            if !size.is_finite() {
                return None;
            }
            if size > 1.0 {
                step /= size;
            }
            x += step;
            if !(x[1] > 0.0 && x[2] >= low && x[2] <= high) {
                return None;
            }
            if step[0].abs() + step[1].abs() + step[2].abs() < STEP_TOLERANCE {
                return self.least(Superstable { parameter: x[2], state: [x[0], x[1]], flights });
            }
        }
        None
    }

    /// The shortest cycle that one runs through several times or has doubled; `None` where it has no least one.
    fn least(&self, cycle: Superstable) -> Option<Superstable> {
        let states = self.states(&cycle)?;
        let count = cycle.flights.len();
        let is_period = |n: &usize| {
            count.is_multiple_of(*n)
                && (0..count).all(|i| {
                    let j = (i + n) % count;
                    cycle.flights[i] == cycle.flights[j] && apart(states[i], states[j]) < SHORTER_CYCLE_DISTANCE
                })
        };
        match (1..count).find(is_period) {
            Some(n) => self.newton(cycle.parameter, cycle.state, cycle.flights[..n].to_vec()),
            None => Some(cycle),
        }
    }

    /// The states of a cycle, phases less whole forcing periods.
    fn states(&self, cycle: &Superstable) -> Option<Vec<State>> {
        let map = self.map(cycle.parameter);
        let mut state = cycle.state;
        let mut all = Vec::new();
        for _ in &cycle.flights {
            all.push(in_period(state));
            state = map.map(state)?.state;
        }
        Some(all)
    }

    /// State that flights lead to, trace of the product of their Jacobians, and their phases; `None` where they end on other walls.
    fn fly(&self, parameter: f64, start: State, flights: &[Side]) -> Option<(State, f64, Vec<f64>)> {
        let map = self.map(parameter);
        let (mut state, mut product, mut phases) = (start, [[1.0, 0.0], [0.0, 1.0]], Vec::new());
        for side in flights {
            phases.push(state[0]);
            let image = map.map(state)?;
            if image.side != *side {
                return None;
            }
            product = times(image.jacobian, product);
            state = image.state;
        }
        Some((state, product[0][0] + product[1][1], phases))
    }

    /// The phases of a cycle on both walls, as they are, from the left one on, and how long it takes until it is closed, or mirrored.
    pub fn phases(&self, cycle: &Superstable) -> Option<(Vec<f64>, f64)> {
        let (end, _, mut phases) = self.fly(cycle.parameter, cycle.state, &cycle.flights)?;
        let mut halves = 0.0;
        for (phase, side) in phases.iter_mut().zip(&cycle.flights) {
            *phase -= 0.5 * halves;
            halves += if *side == Side::Far { 1.0 } else { 0.0 };
        }
        Some((phases, end[0] - cycle.state[0] - 0.5 * halves))
    }
}

impl Superstable {
    /// Whether both may be one cycle, from whichever impact on.
    pub fn is_near(&self, other: &Self) -> bool {
        let count = self.flights.len();
        count == other.flights.len()
            && (self.parameter - other.parameter).abs() < 1e-11 * self.parameter
            && (0..count).any(|shift| (0..count).all(|i| self.flights[i] == other.flights[(i + shift) % count]))
    }
}
