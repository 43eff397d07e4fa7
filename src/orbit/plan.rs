//! The number of bits for each impact of an orbit.
//!
//! Chaos costs bits: an error made at impact `i` is `2^(g_k - g_i)` times as large at impact `k`, `g` the logarithm of the length of a tangent
//! vector that the Jacobians (A.7) carry along. A floating-point run finds this growth. The run leaves the true orbit after a hundred impacts of
//! a chaotic one. But the growth along a neighbour differs from the true one as sums of weakly dependent numbers do: by a few times the root of
//! the number of impacts left. So impact `i` gets the requested bits, those that the rest of the orbit will lose, and this margin; precision
//! falls as the orbit goes on. A plan proves nothing. A plan that falls short is raised, by the missing bits.

// Labels: proposes throughout.

use std::sync::Arc;

use super::Arithmetic;
use super::given::{Given, Motions};
use super::motion::Motion;
use crate::mapping::jacobian_between;
use crate::number::LEAST_BITS;
use crate::turns;

/// Bits that are lost to constant factors.
const GUARD_BITS: f64 = 24.0;
/// Standard deviations of the growth that are allowed for.
const DEVIATIONS: f64 = 3.0;
/// Impacts whose growth is one of the weakly dependent numbers.
const BLOCK: usize = 32;

/// The bits of each impact.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Bits lost after impact `i` in the rest of the orbit, by the floating-point run; 0 beyond its end.
    rest: Arc<[f32]>,
    /// Number of impacts that the plan looks ahead; the floating-point run may have ended before.
    horizon: u64,
    /// Bits at the last impact.
    last: f64,
    /// The growth's standard deviation over `n` impacts is this times the root of `n`.
    deviation: f64,
    most: u32,
}

impl Plan {
    /// The same bits for every impact.
    pub fn constant(bits: u32) -> Self {
        let bits = bits.max(LEAST_BITS);
        Self { rest: Arc::default(), horizon: u64::MAX, last: f64::from(bits), deviation: 0.0, most: bits }
    }

    /// The bits that the first `horizon` impacts of `run` need for relative widths of `2^-requested`; at most `most` bits.
    ///
    /// The run yields the bits that each impact loses.
    pub(super) fn new(run: impl Iterator<Item = f64>, horizon: u64, requested: f64, most: u32) -> Self {
        let mut sum = 0.0;
        let total = |grown| {
            sum += grown;
            sum as f32
        };
        let mut growth: Vec<f32> = run.take(horizon as usize).map(total).collect();
        let deviation = deviation(&growth);
        // The largest growth still to come, backwards.
        let mut highest = f32::NEG_INFINITY;
        for grown in growth.iter_mut().rev() {
            highest = highest.max(*grown);
            *grown = highest - *grown;
        }
        let last = requested + GUARD_BITS + (growth.len().max(1) as f64).log2();
        Self { rest: growth.into(), horizon, last, deviation, most: most.max(LEAST_BITS) }
    }

    /// Bits of the state after `index` impacts.
    pub fn bits(&self, index: u64) -> u32 {
        let index = usize::try_from(index).unwrap_or(usize::MAX).saturating_sub(1);
        let left = self.rest.len().saturating_sub(index);
        let eaten = self.rest.get(index).map_or(0.0, |&bits| f64::from(bits));
        let bits = self.last + eaten + DEVIATIONS * self.deviation * (left as f64).sqrt();
        (bits as u32).clamp(LEAST_BITS.min(self.most), self.most)
    }

    /// Number of impacts that the plan covers.
    pub(super) fn horizon(&self) -> u64 {
        self.horizon
    }

    /// Raises all impacts by `missing` bits; true if that was possible.
    pub(super) fn raise(&mut self, missing: f64) -> bool {
        let before = self.bits(0);
        self.last += missing.max(f64::from(LEAST_BITS));
        self.bits(0) > before
    }
}

/// The standard deviation of the growth over an impact, from the sums over blocks.
fn deviation(growth: &[f32]) -> f64 {
    let ends: Vec<f64> = growth.iter().step_by(BLOCK).map(|&sum| f64::from(sum)).collect();
    let blocks: Vec<f64> = ends.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if blocks.len() < 2 {
        return 0.0;
    }
    let mean = blocks.iter().sum::<f64>() / blocks.len() as f64;
    let square = blocks.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (blocks.len() - 1) as f64;
    (square / BLOCK as f64).sqrt()
}

/// A floating-point run that carries a tangent vector along, and so yields the bits that each impact loses.
#[derive(Debug)]
pub(super) struct Growth {
    shaken: Arc<dyn Motions>,
    run: Box<dyn Motion>,
    turns: i64,
    /// Velocity before the last impact, and the acceleration there; `None` inside the gap.
    last: Option<(f64, f64)>,
    /// Tangent vector: phase in forcing periods, velocity in units of the scale.
    tangent: [f64; 2],
    scale: f64,
}

impl Growth {
    /// `None` for a start beyond doubles.
    pub fn new(given: &Given) -> Option<Self> {
        let (run, origin) = (given.motion(Arithmetic::Float).ok()?, given.origin_ball().ok()?);
        let (shaken, turns, velocity) = (given.shaken.clone(), origin.state.turns, origin.state.velocity);
        let scale = shaken.pair().scale(velocity);
        let last =
            origin.state.place.wall().map(|_| (velocity.mid(), shaken.acceleration(turns, origin.state.phase.mid())));
        Some(Self { shaken, run, turns, last, tangent: [1.0, 1.0], scale })
    }

    /// Goes on to the next impact. Returns the bits that the impact loses, and the forcing periods that passed.
    pub fn next_impact(&mut self) -> Option<(f64, f64)> {
        let contact = self.run.next_contact().ok()?;
        self.turns = turns::after(self.turns, contact.turns)?;
        let (time, velocity1) = (contact.time.mid(), contact.velocity.mid());
        let acceleration1 = self.shaken.acceleration(self.turns, contact.phase.mid());
        let last = self.last.replace((velocity1, acceleration1));
        let Some((velocity0, swing0)) = last else { return Some((0.0, time)) };
        let restitution = self.shaken.pair().restitution.mid();
        let [[a, b], [c, d]] = jacobian_between(restitution, time, [swing0, acceleration1], [velocity0, velocity1])?;
        let [x, y] = self.tangent;
        let image = [a * x + b * self.scale * y, c / self.scale * x + d * y];
        let (before, after) = (x.hypot(y), image[0].hypot(image[1]));
        // A perfectly plastic impact forgets all.
        let usable = after.is_normal();
        self.tangent = if usable { image.map(|x| x / after) } else { [1.0, 1.0] };
        Some((if usable { (after / before).log2() } else { 0.0 }, time))
    }
}
