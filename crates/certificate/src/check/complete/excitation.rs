//! Displacement of the box and its derivatives over an interval of phases, in gap widths and forcing periods (Lemma V41).

use super::super::data::{Data, HarmonicData};
use super::super::span::Span;
use super::BITS;
use impact_pair_exact::{Exact, Real};

/// Derivatives of the displacement that are enclosed, the displacement itself among them.
const DERIVATIVES: usize = 7;

/// All harmonics of the excitation.
#[derive(Clone, Debug)]
pub(super) struct Excitation {
    terms: Vec<Term>,
}

#[derive(Clone, Debug)]
struct Term {
    /// `A_k/d` times the powers of `2 pi r_k`.
    sizes: [Span; DERIVATIVES],
    /// `r_k` and `s_k`: the harmonic's phase is `r_k u + s_k`; `None` for the reference, whose periods are the forcing periods.
    own: Option<[Span; 2]>,
}

impl Excitation {
    /// The excitation of the data; `None` where its parameters are beyond the range of exact expressions.
    pub fn new(data: &Data) -> Option<Self> {
        let gap = data.half_gap.checked_mul(&Exact::from(2)).ok()?;
        Some(Self { terms: data.tones.iter().map(|tone| Term::new(data, tone, &gap)).collect::<Option<_>>()? })
    }

    /// Encloses the derivatives of these orders of the displacement at all these phases, in forcing periods of the reference.
    pub fn derivatives<const N: usize>(&self, orders: [usize; N], phases: Span) -> [Span; N] {
        let each = self.terms.iter().map(|term| {
            let waves = sine_and_cosine(term.own(phases));
            orders.map(|order| term.derivative(order, waves))
        });
        each.reduce(|sum, one| std::array::from_fn(|n| sum[n] + one[n])).expect("a harmonic")
    }

    /// Encloses the displacement.
    pub fn displacement(&self, phases: Span) -> Span {
        self.derivatives([0], phases)[0]
    }

    /// Encloses the speed of the box.
    pub fn speed(&self, phases: Span) -> Span {
        self.derivatives([1], phases)[0]
    }

    /// Encloses the change of the displacement over a time around a phase, by the addition theorem.
    pub fn change(&self, middle: Span, time: Span) -> Span {
        let each = self.terms.iter().map(|term| {
            let [_, cos] = sine_and_cosine(term.own(middle));
            let rate = term.own.map_or(Span::point(1.0), |[ratio, _]| ratio);
            let [sin, _] = sine_and_cosine((rate * time).scaled(0.5));
            (term.sizes[0] * cos * sin).scaled(2.0)
        });
        each.reduce(|sum, one| sum + one).expect("a harmonic")
    }

    /// Sums over all harmonics of the greatest displacement and of the greatest speed.
    pub fn greatest(&self) -> [Span; 2] {
        [0, 1].map(|power| {
            self.terms.iter().fold(Span::point(0.0), |sum, term| sum + Span::point(term.sizes[power].most()))
        })
    }
}

impl Term {
    fn new(data: &Data, tone: &HarmonicData, gap: &Exact) -> Option<Self> {
        let size = Span::of(&tone.amplitude.checked_div(gap).ok()?.enclose(BITS));
        let Some(rate) = &tone.rate else { return Some(Self { sizes: powers(size, Span::point(1.0)), own: None }) };
        let (ratio, turn) = (Real::of(rate, BITS), Real::pi(BITS) * 2);
        let at_start = |tone: &HarmonicData| Real::of(&tone.phase, BITS).over(&turn);
        let reference = at_start(&data.tones[0])? + &Real::rational(&data.turns.clone().into(), BITS);
        let shift = at_start(tone)? - &(ratio.clone() * &reference);
        let shift = shift.clone() - &Real::int(shift.floor()?, BITS); // V41: any whole number of periods
        let own = [ratio, shift].map(|x| Span::of(x.enclosure()));
        Some(Self { sizes: powers(size, own[0]), own: Some(own) })
    }

    /// Phases of the harmonic, in its own periods.
    fn own(&self, phases: Span) -> Span {
        self.own.map_or(phases, |[ratio, shift]| ratio * phases + shift)
    }

    /// The derivative of this order where the harmonic has this sine and cosine.
    fn derivative(&self, order: usize, [sin, cos]: [Span; 2]) -> Span {
        let wave = if order.is_multiple_of(2) { sin } else { cos };
        self.sizes[order] * if order % 4 < 2 { wave } else { -wave }
    }
}

/// A size times the powers of `2 pi ratio`.
fn powers(size: Span, ratio: Span) -> [Span; DERIVATIVES] {
    let rate = ratio.turned();
    let mut powers = [size; DERIVATIVES];
    (1..DERIVATIVES).for_each(|n| powers[n] = powers[n - 1] * rate);
    powers
}

/// Ranges of `sin 2 pi u` and `cos 2 pi u` over an interval: the values at its ends, and 1 or -1 where a crest may lie between.
pub(super) fn sine_and_cosine(phases: Span) -> [Span; 2] {
    let [(sin_lo, cos_lo), (sin_hi, cos_hi)] = [phases.lo(), phases.hi()].map(Span::waves_at);
    let over = |ends: Span, crest: f64| {
        let mut range = ends;
        for (extremum, value) in [(crest, 1.0), (crest + 0.5, -1.0)] {
            if may_hold(phases, extremum) {
                range = range.hull(Span::point(value));
            }
        }
        range
    };
    [over(sin_lo.hull(sin_hi), 0.25), over(cos_lo.hull(cos_hi), 0.0)]
}

/// Whether the interval may hold the sum of `offset` and of a whole number. Of unknown ends the values at the ends are anything already.
fn may_hold(phases: Span, offset: f64) -> bool {
    let [from, to] = [(phases.lo() - offset).next_down(), (phases.hi() - offset).next_up()];
    from.ceil() <= to // V41: both moved outward
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Sine and cosine in many bits at a member lie in the ranges; intervals begin and end near crests.
        #[test]
        fn ranges_hold_their_members(quarter in -8i32..8, off in -1e-3..1e-3f64, at in 0.0..=1.0f64,
                                     width in prop_oneof![Just(0.0), 1e-16..1e-9f64, 0.0..1.5f64]) {
            let lo = f64::from(quarter) / 4.0 + off;
            let hi = lo + width;
            let member = (lo + at * width).clamp(lo, hi);
            let angle = Real::pi(128) * 2 * &Real::point(impact_pair_exact::Dyadic::from_f64(member).unwrap(), 128);
            let ranges = sine_and_cosine(Span::new(lo, hi));
            for (range, exact) in ranges.iter().zip([angle.sin(), angle.cos()]) {
                let (low, high) = exact.enclosure().to_f64_bounds();
                prop_assert!(range.lo() <= high && low <= range.hi(), "{range:?} {member}");
            }
        }
    }
}
