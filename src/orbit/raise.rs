//! The restart of `auto` if the motion does not suffice: the same orbit again from its start, in more precision.
//!
//! Exact data are as exact in every precision, so a chaotic orbit has to start anew with the bits that it loses later.

// Labels: proposes throughout.

use super::given::Given;
use super::motion::Motion;
use super::plan::{Growth, Plan};
use super::shortfall::Shortfall;
use super::{Settings, VERDICT_BITS};
use crate::clock::Phase;
use crate::exact::{Exact, log2_of_digits};
use crate::number::LEAST_BITS;
use crate::pair::ImpactPair;

/// Impacts that are planned for at once; of longer orbits first a quarter of a quarter, so that impacts appear soon.
///
/// A quarter of the impacts costs a sixteenth to a sixtieth of all.
const FIRST_PLAN: u64 = 1 << 14;
/// Impacts that a plan looks ahead at most: it holds a number for each.
const MAX_PLAN: u64 = 1 << 22;

/// The exact orbit, and how it was tried before.
#[derive(Debug)]
pub(super) struct PrecisionRaise {
    given: Given,
    impacts: Option<u64>,
    /// Requested length of the orbit, in forcing periods.
    turns: f64,
    /// Bits of the requested width.
    requested: f64,
    most: u32,
    /// Greatest accuracy of a flight in any precision, in bits: that of the excitation's data.
    finest: f64,
    /// Bits that are left for decisions.
    verdict_bits: f64,
    plan: Option<Plan>,
    /// The last failure in multiprecision: the impact before it, whether the width or else a decision was missing, and the accuracy of
    /// the set there, in bits.
    before: Option<(u64, bool, f64)>,
}

impl PrecisionRaise {
    pub fn new(given: Given, turns: i64, until: Option<Phase>, settings: &Settings) -> Self {
        let turns = until.map_or(f64::INFINITY, |until| (until.turns - turns) as f64 + 1.0);
        let requested = log2_of_digits(f64::from(settings.digits));
        let (impacts, most) = (settings.impacts, settings.max_bits.max(LEAST_BITS));
        let finest = finest(&given.pair);
        let verdict_bits = f64::from(VERDICT_BITS);
        Self { given, impacts, turns, requested, most, finest, verdict_bits, plan: None, before: None }
    }

    /// Returns the motion from the start in more precision; `None` when that would not help.
    ///
    /// The motion fell short on the way to the impact after `index`, with a set of `accuracy` bits: the one before
    /// that impact where a verdict is missing, the one after it where it is too wide.
    pub fn again(&mut self, shortfall: Shortfall, index: u64, accuracy: f64) -> Option<Box<dyn Motion>> {
        let accuracy = accuracy.min(self.finest);
        // More precision that did not make the set narrower is not what is missing.
        let in_width = matches!(shortfall, Shortfall::Width(_));
        let stuck =
            self.before.is_some_and(|(at, kind, bits)| (at, kind) == (index, in_width) && accuracy < bits + 1.0);
        // Doubles may be lucky: only what multiprecision did before counts.
        self.before = self.plan.is_some().then_some((index, in_width, accuracy));
        let plan = match self.plan.take() {
            None => self.look_ahead(0)?,
            Some(plan) if index >= plan.horizon() => self.look_ahead(index)?,
            Some(mut plan) => {
                let missing = match shortfall {
                    // Further bits may be missing later.
                    Shortfall::Width(bits) => 2.0 * bits,
                    // A decision near a graze takes twice the digits; a state that is exact has no end of them.
                    Shortfall::Verdict => {
                        let most = f64::from(plan.bits(0)).min(self.verdict_bits);
                        let bits = accuracy.clamp(f64::from(LEAST_BITS), most.max(f64::from(LEAST_BITS)));
                        self.verdict_bits -= bits;
                        bits
                    }
                };
                let raised = !stuck && self.verdict_bits >= 0.0 && plan.raise(missing);
                if !raised {
                    self.plan = Some(plan);
                    return None;
                }
                plan
            }
        };
        self.plan = Some(plan.clone());
        self.given.precise(plan)
    }

    /// Plans beyond impact `index` from a floating-point run.
    fn look_ahead(&mut self, index: u64) -> Option<Plan> {
        self.verdict_bits = f64::from(VERDICT_BITS);
        let run = || {
            let (mut growth, mut left) = (Growth::new(&self.given), self.turns);
            std::iter::from_fn(move || {
                let (bits, turns) = growth.as_mut()?.next_impact()?;
                left -= turns;
                (left > 0.0).then_some(bits)
            })
        };
        // A time to stop at ends the floating run too.
        let until = || self.turns.is_finite().then(|| run().take(MAX_PLAN as usize).count() as u64 + 1);
        let mut horizon = self.impacts.into_iter().chain(until()).min().unwrap_or(MAX_PLAN).min(MAX_PLAN);
        while horizon > FIRST_PLAN && horizon / 4 > index {
            horizon /= 4;
        }
        // An orbit that goes on beyond what the floating run saw.
        let horizon = if horizon > index { horizon } else { index.saturating_mul(2) };
        Some(Plan::new(run(), horizon, self.requested, self.most))
    }
}

/// Bits to which the least exact of the excitation is given: infinitely many without intervals.
fn finest(pair: &ImpactPair) -> f64 {
    let terms = pair.excitation().terms().iter();
    let shaking = terms.flat_map(|term| [term.amplitude(), term.frequency(), term.phase()]);
    let intervals = shaking.chain([pair.gap()]).filter(|x| !x.is_point());
    let bits = |x: &Exact| {
        let x = x.enclose(LEAST_BITS);
        x.mag().to_f64_up().log2() - x.wid().to_f64_up().log2()
    };
    intervals.map(bits).fold(f64::INFINITY, f64::min)
}
