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

/// The exact orbit, and the earlier attempts at it.
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

    /// Starts the motion again in more precision; `None` when that would not help.
    ///
    /// The motion fell short on the way to the impact after `index`, with a set of `accuracy` bits. This is the set before that impact where a
    /// verdict is missing, and the set after the impact where it is too wide.
    pub fn again(&mut self, shortfall: Shortfall, index: u64, accuracy: f64) -> Option<Box<dyn Motion>> {
        let accuracy = accuracy.min(self.finest);
        // More precision that did not make the set narrower is not what is missing.
        let in_width = matches!(shortfall, Shortfall::Width(_));
        let stuck =
            self.before.is_some_and(|(at, kind, bits)| (at, kind) == (index, in_width) && accuracy < bits + 1.0);
        // Doubles may be lucky: only what multiprecision did before counts.
        self.before = self.plan.is_some().then_some((index, in_width, accuracy));
        let Some(before) = self.plan.take() else { return Some(self.follow(self.look_ahead(0))) };
        if index >= before.horizon() {
            let further = self.look_ahead(index);
            // The impacts beyond the horizon of the plan before may expand no more than those within it.
            if further.bits(0) > before.bits(0) {
                self.verdict_bits = f64::from(VERDICT_BITS);
                return Some(self.follow(further));
            }
        }
        let mut plan = before;
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
        if stuck || self.verdict_bits < 0.0 || !plan.raise(missing) {
            self.plan = Some(plan);
            return None;
        }
        Some(self.follow(plan))
    }

    /// The motion from the start by a plan.
    fn follow(&mut self, plan: Plan) -> Box<dyn Motion> {
        self.plan = Some(plan.clone());
        self.given.precise(plan)
    }

    /// Plans for impacts beyond number `index`, from a floating-point run.
    ///
    /// The run ends at the requested time, or after the requested impacts if these come first. The true orbit may have more impacts up to
    /// that time than the run: where it has come to impact `index`, the run goes on for at least a quarter more.
    fn look_ahead(&self, index: u64) -> Plan {
        let mut horizon = self.impacts.unwrap_or(MAX_PLAN).min(MAX_PLAN);
        while horizon > FIRST_PLAN && horizon / 4 > index {
            horizon /= 4;
        }
        // An orbit that goes on beyond the longest plan.
        let horizon = if horizon > index { horizon } else { index.saturating_mul(2) };
        let least = index + index / 4 + 1;
        let (mut growth, mut left, mut seen) = (Growth::new(&self.given), self.turns, 0);
        let run: Vec<f64> = std::iter::from_fn(|| {
            if seen >= horizon || left <= 0.0 && seen >= least {
                return None;
            }
            let (bits, turns) = growth.as_mut()?.next_impact()?;
            (left, seen) = (left - turns, seen + 1);
            Some(bits)
        })
        .collect();
        let horizon = if left > 0.0 { horizon } else { seen };
        Plan::new(run.into_iter(), horizon, self.requested, self.most)
    }
}

/// Bits of the least accurate data of the excitation: infinitely many without intervals.
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
