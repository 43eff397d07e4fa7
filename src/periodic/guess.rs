//! Guesses of orbits: floating-point motions that nearly close, and phases spread evenly. Non-rigorous.

// Labels: proposes throughout.

use super::chain::Chain;
use super::chained::{Chained, FloatImpact};
use super::newton::{is_plausible, polish};
use impact_pair_model::Start;

use crate::clock::Clock;
use crate::pair::{ImpactPair, ball};
use crate::shaken::Origin;

/// Impacts of the scene's own motion, and of each motion from elsewhere.
const OWN_IMPACTS: usize = 20_000;
const OTHER_IMPACTS: usize = 1_500;
/// Motions from elsewhere, and spread phases.
const OTHER_MOTIONS: usize = 48;
const SPREAD_PHASES: usize = 600;
/// Steps to the root that a sequence is made of: each gains a bit at least.
const ROOT_STEPS: u32 = 40;
/// Number of successive windows of a motion of which the best is a guess.
const BLOCK: usize = 100;

/// Phases near those of orbits of the chain; the first ones come from the motion of `start`.
pub(super) fn guesses<S: Chained>(
    chain: &Chain,
    shaken: &S,
    pair: &ImpactPair,
    start: &Start,
) -> impl Iterator<Item = Vec<f64>> {
    let own = windows(chain, &motion_of(chain, shaken, pair, start));
    let others = (0..OTHER_MOTIONS)
        .flat_map(move |n| windows(chain, &motion_from(shaken, spread_state(chain, shaken, n), OTHER_IMPACTS)));
    let spread = (0..SPREAD_PHASES).map(move |n| spread_phases(chain, n));
    let settled = move |guess| polish(chain, shaken.floats(), guess);
    own.into_iter()
        .chain(others)
        .chain(spread)
        .filter_map(settled)
        .filter(move |guess| is_plausible(chain, shaken.floats(), guess))
        .map(|guess| into_first_period(chain, guess))
}

/// Floating-point motion from a start; empty where the start is beyond doubles.
fn motion_of<S: Chained>(chain: &Chain, shaken: &S, pair: &ImpactPair, start: &Start) -> Vec<FloatImpact> {
    let first = || -> Option<FloatImpact> {
        let clock = Clock::new(pair, start.time(), f64::MANTISSA_DIGITS).ok()?;
        let origin = Origin::at(pair, start, &clock, Vec::new()).and_then(|origin| origin.map(ball)).ok()?;
        let launch = origin.launch(shaken.pair().restitution.mid());
        let contact = shaken.propose(&launch).ok()?;
        let whole = (launch.turns + clock.turns_into(chain.period())) as f64;
        Some((contact.wall, whole + contact.turns + contact.phase, contact.velocity))
    };
    first().map_or_else(Vec::new, |first| motion_from(shaken, first, OWN_IMPACTS))
}

/// Floating-point motion from a state on a wall.
fn motion_from<S: Chained>(shaken: &S, start: FloatImpact, impacts: usize) -> Vec<FloatImpact> {
    std::iter::successors(Some(start), |&impact| shaken.next(impact)).take(impacts).collect()
}

/// The windows of a motion that have the chain's walls and nearly close, the best of each block.
fn windows(chain: &Chain, motion: &[FloatImpact]) -> Vec<Vec<f64>> {
    let (count, cycles) = (chain.impacts(), f64::from(chain.cycles()));
    let misses = |window: &[FloatImpact]| {
        let (first, last) = (window[0], window[count]);
        let fits = window.iter().zip(chain.walls()).all(|(&(wall, ..), &its)| wall == its) && last.0 == first.0;
        let apart = (last.1 - first.1 - cycles).abs();
        let size = first.2.abs() + last.2.abs() + f64::MIN_POSITIVE;
        (fits && apart < 0.5).then(|| apart + (last.2 - first.2).abs() / size)
    };
    let windows: Vec<&[FloatImpact]> = motion.windows(count + 1).collect();
    let best = |block: &[&[FloatImpact]]| {
        let missing = block.iter().filter_map(|window| Some((misses(window)?, *window)));
        missing.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, window)| window.to_vec())
    };
    let phases = |window: Vec<FloatImpact>| {
        let period = f64::from(chain.period());
        let base = (window[0].1 / period).floor() * period;
        window[..count].iter().map(|(_, phase, _)| phase - base).collect()
    };
    windows.chunks(BLOCK).filter_map(best).map(phases).collect()
}

/// Point `n` of a sequence that fills the unit cube evenly, coordinate `i` of `count`.
///
/// Multiples of powers of the root of `x^(count + 1) = x + 1`, modulo 1.
fn even(n: usize, i: usize, count: usize) -> f64 {
    let power = 1.0 / (count as f64 + 1.0);
    let root = (0..ROOT_STEPS).fold(1.5f64, |x, _| (1.0 + x).powf(power));
    (0.5 + (n as f64 + 1.0) * root.powi(-(i as i32 + 1))).fract()
}

/// State on the chain's first wall: any phase; speeds up to twice the sum of the box's greatest speed and of a gap per forcing period.
fn spread_state<S: Chained>(chain: &Chain, shaken: &S, n: usize) -> FloatImpact {
    let wall = chain.walls()[0];
    let speed = 2.0 * (shaken.speed() + 1.0) * even(n, 1, 2);
    (wall, f64::from(chain.period()) * even(n, 0, 2), -wall.sign() * speed)
}

/// Phases in order, spread over the period.
fn spread_phases(chain: &Chain, n: usize) -> Vec<f64> {
    let count = chain.impacts();
    let first = f64::from(chain.period()) * even(n, 0, count);
    let mut rest: Vec<f64> = (1..count).map(|i| first + f64::from(chain.cycles()) * even(n, i, count)).collect();
    rest.sort_by(f64::total_cmp);
    std::iter::once(first).chain(rest).collect()
}

/// The phases, shifted so that the first one lies in the first common period: in `[0, 1)` with one harmonic.
fn into_first_period(chain: &Chain, mut phases: Vec<f64>) -> Vec<f64> {
    let period = f64::from(chain.period());
    let whole = (phases[0] / period).floor() * period;
    phases.iter_mut().for_each(|phase| *phase -= whole);
    phases
}
