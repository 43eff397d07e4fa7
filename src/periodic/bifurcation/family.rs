//! The boxes that a branch runs through: one for each value of what varies.

use std::f64::consts::{PI, TAU};

use num_bigint::BigInt;

use super::super::chained::{Chained, Moment, OneHarmonic};
use super::super::legs::Leg;
use super::super::shaking::Shaking;
use super::jet::Jet;
use crate::pair::{ImpactPair, Reduced};
use crate::several::{Harmonics, Partial, PhaseNumber, Rates};
use crate::shaken::{SeveralHarmonics, Sum};

/// The quantity that varies along a branch, without units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unknown {
    /// `A_k/d` of one harmonic.
    Ratio(usize),
    /// `A/d` of the largest harmonic, and with it, in proportion, those of all.
    Ratios,
    /// `e`
    Restitution,
}

/// The excitation, as a parameter of it varies.
pub(super) trait Varied: Chained {
    /// Excitation of a pair; `None` for an excitation of another kind, or beyond the range of exact expressions or doubles.
    fn of(pair: &ImpactPair) -> Option<Self>;

    /// Whether none of the fixed parameters is an interval of values.
    fn is_point(&self, unknown: Unknown) -> bool;

    /// Parameters at a value of the unknown. For [`Unknown::Ratios`], `base` holds the amplitudes relative to the largest one.
    fn at<N: PhaseNumber>(base: &Self::In<N>, unknown: Unknown, value: N) -> Self::In<N>;

    /// The parameters as constants of jets.
    fn jets<N: PhaseNumber>(base: &Self::In<N>) -> Self::In<Jet<N>>;

    /// Phases inside a flight, which starts at one, at which it is as fast as the box, and how far that has moved by then, in order. By rounding
    /// the start may be one of them: where `e` is small, every flight starts about as fast as the box. It proposes.
    fn summits(floats: &Self::In<f64>, flight: &Leg<f64>, from: &Moment<Self, f64>, start: f64) -> Vec<(f64, f64)>;
}

/// The parameters that do not vary, in one arithmetic.
pub(super) struct Family<S: Varied, N: PhaseNumber> {
    pub unknown: Unknown,
    /// See [`Varied::at`].
    pub base: S::In<N>,
}

impl<S: Varied, N: PhaseNumber> Family<S, N> {
    /// Parameters of the pair at a value of the unknown.
    pub fn pair(&self, value: N) -> S::In<N> {
        S::at(&self.base, self.unknown, value)
    }

    /// The family with its fixed parameters as constants of jets.
    pub fn jets(&self) -> Family<S, Jet<N>> {
        Family { unknown: self.unknown, base: S::jets(&self.base) }
    }
}

/// Forcing periods of a flight in which extrema are looked for.
const MAX_PERIODS: f64 = 64.0; // proposes
/// Pieces of a forcing period of the fastest of several harmonics, and halvings of one in which the velocity changes its sign.
const PIECES: f64 = 16.0; // proposes
const HALVINGS: u32 = 40; // proposes

impl Varied for OneHarmonic {
    fn of(pair: &ImpactPair) -> Option<Self> {
        Self::of(pair).ok()
    }

    fn is_point(&self, unknown: Unknown) -> bool {
        match unknown {
            Unknown::Ratio(_) | Unknown::Ratios => self.exact.restitution.is_point(),
            Unknown::Restitution => self.exact.alpha.is_point(),
        }
    }

    fn at<N: PhaseNumber>(base: &Reduced<N>, unknown: Unknown, value: N) -> Reduced<N> {
        let (alpha, restitution) = match unknown {
            Unknown::Ratio(_) | Unknown::Ratios => (value, base.restitution.clone()),
            Unknown::Restitution => (base.alpha.clone(), value),
        };
        Reduced::new(alpha, restitution)
    }

    fn jets<N: PhaseNumber>(base: &Reduced<N>) -> Reduced<Jet<N>> {
        base.map(|x| Jet::constant(x.clone()))
    }

    /// The phases at which `cos th` is the drift over the greatest speed of the box.
    fn summits(pair: &Reduced<f64>, flight: &Leg<f64>, _: &(f64, f64), start: f64) -> Vec<(f64, f64)> {
        let q = flight.drift / pair.beta;
        if q.abs() > 1.0 || flight.time > MAX_PERIODS {
            return Vec::new();
        }
        let a = q.acos() / TAU;
        let end = start + flight.time;
        let first = (start - 1.0).floor() as i64; // proposes
        let last = (end + 1.0).ceil() as i64; // proposes
        let all = (first..=last).flat_map(|n| [n as f64 - a, n as f64 + a]); // proposes
        let inside = all.filter(|&s| s > start && s < end); // proposes
        // A product: soon after the start the difference of sines is little more than rounding.
        let shift = |s: f64| 2.0 * pair.alpha * (PI * (s + start)).cos() * (PI * (s - start)).sin();
        inside.map(|s| (s, shift(s))).collect()
    }
}

impl Varied for SeveralHarmonics {
    fn of(pair: &ImpactPair) -> Option<Self> {
        Self::new(pair, &BigInt::ZERO).ok()?
    }

    fn is_point(&self, _: Unknown) -> bool {
        let of_terms = self.spectrum.terms.iter().flat_map(|term| [&term.alpha, &term.ratio, &term.shift]);
        of_terms.chain([&self.spectrum.restitution]).all(|x| x.is_point())
    }

    fn at<N: PhaseNumber>(base: &Sum<N>, unknown: Unknown, value: N) -> Sum<N> {
        let Sum { harmonics: Harmonics { terms, .. }, restitution } = base;
        let with = |term: &Partial<N>, alpha: N| Partial::new(alpha, term.ratio.clone(), term.counter.clone());
        let term = |(k, term): (usize, &Partial<N>)| match unknown {
            Unknown::Ratio(harmonic) if harmonic == k => with(term, value.clone()),
            Unknown::Ratios => with(term, term.alpha.clone() * value.clone()),
            _ => term.clone(),
        };
        // Chains ask no bounds of them.
        let harmonics = Harmonics { terms: terms.iter().enumerate().map(term).collect(), rates: Rates::UNKNOWN };
        let restitution = if unknown == Unknown::Restitution { value.clone() } else { restitution.clone() };
        Sum { harmonics, restitution }
    }

    fn jets<N: PhaseNumber>(base: &Sum<N>) -> Sum<Jet<N>> {
        let constant = |x: &N| Jet::constant(x.clone());
        let term = |term: &Partial<N>| Partial {
            alpha: constant(&term.alpha),
            beta: constant(&term.beta),
            acceleration: constant(&term.acceleration),
            ratio: constant(&term.ratio),
            counter: term.counter.clone(),
        };
        let terms = base.harmonics.terms.iter().map(term).collect();
        Sum { harmonics: Harmonics { terms, rates: Rates::UNKNOWN }, restitution: constant(&base.restitution) }
    }

    /// The phases at which the velocity changes its sign, found piece by piece.
    fn summits(sum: &Sum<f64>, flight: &Leg<f64>, from: &Moment<Self, f64>, start: f64) -> Vec<(f64, f64)> {
        if flight.time > MAX_PERIODS {
            return Vec::new();
        }
        let velocity = |s: f64| sum.relative(&flight.drift, &sum.moment(0.0, &s));
        let count = (PIECES * flight.time).ceil() + 1.0; // proposes
        let ends = (0..=count as u32).map(|i| start + flight.time * f64::from(i) / count); // proposes
        let known: Vec<(f64, f64)> = ends.map(|s| (s, velocity(s))).collect();
        let halved = |ends: &[(f64, f64)]| {
            let rises = ends[0].1 < 0.0;
            let [low, high] = (0..HALVINGS).fold([ends[0].0, ends[1].0], |[low, high], _| {
                let middle = 0.5 * (low + high);
                if (velocity(middle) < 0.0) == rises { [middle, high] } else { [low, middle] }
            });
            0.5 * (low + high)
        };
        let changes = known.windows(2).filter(|ends| ends[0].1 * ends[1].1 < 0.0).map(halved);
        changes.map(|s| (s, sum.travel(from, &sum.moment(0.0, &s), 0.0))).collect()
    }
}
