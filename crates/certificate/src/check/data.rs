//! The exact data of an orbit in physical lengths and radians, and pieces of the interval data.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;

use super::Limits;
use super::affine::Affine;
use super::budget::Budget;
use super::shaking::Term;
use super::step::Parameters;
use impact_pair_exact::{Dyadic, Enclosure, Exact, ExactError, Real};
use impact_pair_model::Error;
use impact_pair_model::Harmonic;
use impact_pair_model::watch::Unwatched;
use impact_pair_model::{ImpactPair, Wall, within};
use impact_pair_model::{Place, Start};

/// The exact data.
#[derive(Clone)]
pub(crate) struct Data<'w> {
    /// The harmonics, the reference first.
    pub tones: Vec<HarmonicData>,
    pub half_gap: Exact,
    pub restitution: Exact,
    /// `W` of the reference.
    pub frequency: Exact,
    /// `tau` of the reference.
    pub delay: Exact,
    /// `t0`
    pub time: Exact,
    /// Whole forcing periods of the reference before the start.
    pub turns: BigInt,
    /// The work that is left.
    pub budget: Budget<'w>,
    /// `y' / W`, before the impact for a start on a wall.
    pub velocity: Exact,
    pub wall: Option<Wall>,
    /// `y` of a start inside the gap.
    pub height: Option<Exact>,
}

/// One harmonic.
#[derive(Clone, Debug)]
pub(crate) struct HarmonicData {
    /// `A_k`
    pub amplitude: Exact,
    /// `W_k t0 + tau_k` without whole forcing periods.
    pub phase: Exact,
    /// `W_k/W`; `None` for the reference.
    pub rate: Option<Exact>,
}

/// The part of each datum that is an interval, by bisection.
#[derive(Clone, Debug, Default)]
pub(crate) struct Piece {
    /// Parts `k` of `2^n` of the data, by the index of each datum; data that are not listed are whole.
    parts: Vec<(BigInt, u32)>,
}

/// Bits of the quotient that counts quarter periods.
const QUARTER_BITS: u32 = 192;

/// Indices of the data that can be intervals.
const HALF_GAP: usize = 0;
const RESTITUTION: usize = 1;
const VELOCITY: usize = 2;
const HEIGHT: usize = 3;
/// Indices of the data of the first harmonic; each further harmonic adds three.
const AMPLITUDE: usize = 4;
const PHASE: usize = 5;
const RATE: usize = 6;

impl Data<'_> {
    pub fn new(pair: &ImpactPair, start: &Start) -> Result<Self, Error> {
        let reference = pair.excitation().reference();
        let frequency = reference.frequency();
        let (mut tones, mut whole) = (Vec::new(), BigInt::ZERO);
        for (k, harmonic) in pair.excitation().harmonics().iter().enumerate() {
            let (phase, turns) = phase(harmonic, start)?;
            let rate = match (k, harmonic.frequency().fraction_of(frequency)) {
                (0, _) => None,
                (_, Some(fraction)) => Some(Exact::from_rational(fraction)),
                (_, None) => {
                    Some(within("excitation.frequency", frequency, harmonic.frequency().checked_div(frequency))?)
                }
            };
            if k == 0 {
                whole = turns;
            }
            tones.push(HarmonicData { amplitude: harmonic.amplitude().clone(), phase, rate });
        }
        let (wall, height) = match start.place() {
            Place::Wall(wall) => (Some(*wall), None),
            Place::Inside(height) => (None, Some(height.clone())),
        };
        Ok(Self {
            tones,
            half_gap: within("pair.gap", pair.gap(), pair.gap().checked_div(&Exact::from(2)))?,
            restitution: pair.restitution().clone(),
            frequency: frequency.clone(),
            delay: reference.phase().clone(),
            time: start.time().clone(),
            turns: whole,
            velocity: within("start.velocity", start.velocity(), start.velocity().checked_div(frequency))?,
            wall,
            height,
            budget: Budget::new(u64::MAX, Limits::default().parts, &Unwatched),
        })
    }

    /// `d/2`, `e` and the harmonics over a piece of the data.
    pub fn parameters(&self, piece: &Piece, bits: u32) -> Parameters<'_> {
        let (start, ..) = self.state(piece, bits);
        let term = |(k, tone): (usize, &HarmonicData)| {
            let amplitude = piece.part(&tone.amplitude, AMPLITUDE + 3 * k, bits);
            // The origin is the middle of the reference's phases at the start.
            let Some(rate) = &tone.rate else {
                return Term { amplitude, phase: Affine::fixed(start.centre.clone()), rate: None };
            };
            let rate = piece.part(rate, RATE + 3 * k, bits);
            let (phase, off) = (piece.part(&tone.phase, PHASE + 3 * k, bits), start.clone().less_centre());
            let slopes = [Real::int(1, bits), -rate.hull(), -off.hull()];
            let shifted = [(&slopes[0], &phase), (&slopes[1], &off), (&slopes[2], &rate)];
            Term { amplitude, phase: Affine::of(phase.centre.clone(), &shifted), rate: Some(rate) }
        };
        Parameters {
            half_gap: piece.part(&self.half_gap, HALF_GAP, bits),
            restitution: piece.part(&self.restitution, RESTITUTION, bits),
            terms: self.tones.iter().enumerate().map(term).collect(),
            budget: self.budget.clone(),
        }
    }

    /// The start's phase, velocity and height (if the start is inside the gap) over a piece of the data.
    pub fn state(&self, piece: &Piece, bits: u32) -> (Affine, Affine, Option<Affine>) {
        let height = self.height.as_ref().map(|height| piece.part(height, HEIGHT, bits));
        (piece.part(&self.tones[0].phase, PHASE, bits), piece.part(&self.velocity, VELOCITY, bits), height)
    }

    /// Whether none of the data is an interval.
    pub fn is_point(&self) -> bool {
        let Self { tones, half_gap, restitution, frequency, delay, time, velocity, height, .. } = self;
        let of_tones = tones.iter().flat_map(|tone| [&tone.amplitude, &tone.phase].into_iter().chain(&tone.rate));
        let others = [half_gap, restitution, frequency, delay, time, velocity];
        others.into_iter().chain(height).chain(of_tones).all(Exact::is_point)
    }

    /// Number of the deviations that are those of the data; sets of one motion have deviations of their own after these.
    pub fn deviations(&self) -> usize {
        if self.is_point() { 0 } else { AMPLITUDE + 3 * self.tones.len() }
    }

    /// A lower bound of the gap \[length\].
    pub fn least_gap(&self) -> BigRational {
        let half = Real::of(&self.half_gap, QUARTER_BITS);
        half.enclosure().inf().to_rational() * BigInt::from(2)
    }

    /// The harmonic, if there is only one.
    pub fn only(&self) -> Option<&HarmonicData> {
        match self.tones.as_slice() {
            [only] => Some(only),
            _ => None,
        }
    }

    /// Periods of the reference after which the forcing is proved to repeat; `None` if no common period is proved.
    pub fn common_turns(&self) -> Option<BigInt> {
        let rates = self.tones.iter().filter_map(|tone| tone.rate.as_ref());
        rates.map(Exact::as_rational).try_fold(BigInt::from(1), |turns, rate| Some(turns.lcm(rate?.denom())))
    }

    /// Whether the forcing is reversed half a common period later: each harmonic passes an odd number of half periods. `None` if not
    /// each does and some may vanish: an amplitude may be 0, or harmonics of one frequency may cancel.
    pub fn has_mirror(&self) -> Option<bool> {
        let Some(turns) = self.common_turns() else { return Some(false) };
        let rates = self.tones.iter().filter_map(|tone| tone.rate.as_ref()?.as_rational());
        let passed = rates.map(|rate| rate * &turns).chain([turns.clone().into()]);
        let is_odd = passed.into_iter().all(|turns| turns.to_integer().is_odd());
        let rate = |tone: &HarmonicData| {
            tone.rate.as_ref().map_or_else(|| Some(BigInt::from(1).into()), |rate| rate.as_rational().cloned())
        };
        let is_alone = |tone: &HarmonicData| self.tones.iter().filter(|other| rate(other) == rate(tone)).count() == 1;
        let is_sure = |tone: &HarmonicData| tone.amplitude.sign() == Some(Ordering::Greater) && is_alone(tone);
        let may_vanish = !self.tones.iter().all(is_sure);
        (is_odd || !may_vanish).then_some(is_odd)
    }

    /// The sign of `-E'''` towards the inside of the gap, if the acceleration at a start on a wall is exactly 0.
    pub fn inward_jerk(&self) -> Option<Ordering> {
        let wall = self.wall?;
        let acceleration = self.sum(|tone| tone.phase.checked_sin(), 2).ok()?;
        let is_zero = acceleration.sign() == Some(Ordering::Equal);
        let jerk = is_zero.then(|| self.sum(|tone| tone.phase.checked_cos(), 3).ok()?.sign()).flatten()?;
        Some(if wall == Wall::Left { jerk } else { jerk.reverse() })
    }

    /// Whether a flight with the velocity `after` the start has exactly no drift: `p + E'(0) = 0`.
    pub fn has_no_drift(&self, after: &Exact) -> bool {
        let drift = || after.checked_add(&self.sum(|tone| tone.phase.checked_cos(), 1)?);
        drift().is_ok_and(|drift| drift.sign() == Some(Ordering::Equal))
    }

    /// `sum A_k r_k^n f(phase of the start)`; a harmonic with `f = 0` is left out, so its other factors need not be known.
    fn sum(&self, f: impl Fn(&HarmonicData) -> Result<Exact, ExactError>, n: u32) -> Result<Exact, ExactError> {
        let mut sum = Exact::from(0);
        for tone in &self.tones {
            let mut part = f(tone)?;
            if part.sign() == Some(Ordering::Equal) {
                continue;
            }
            for rate in (0..n).filter_map(|_| tone.rate.as_ref()) {
                part = part.checked_mul(rate)?;
            }
            sum = sum.checked_add(&part.checked_mul(&tone.amplitude)?)?;
        }
        Ok(sum)
    }

    /// The last quarter period of the reference up to the start; `None` if undecided.
    pub fn quarter(&self) -> Option<BigInt> {
        let quarter = Exact::pi().checked_div(&Exact::from(2)).ok()?;
        let quarters = self.tones[0].phase.checked_div(&quarter).ok()?;
        match quarters.as_rational() {
            Some(quarters) => Some(quarters.floor().to_integer()), // exact: of a fraction
            None => quarters.enclose(QUARTER_BITS).floor(),        // exact: shared by all members
        }
    }
}

impl Piece {
    /// The two halves of the piece along a datum.
    pub fn halves(&self, datum: usize) -> [Self; 2] {
        let (k, n) = self.parts.get(datum).cloned().unwrap_or_default(); // exact: not cut yet, the whole
        [0, 1].map(|half| &k * 2 + half).map(|k| {
            let mut half = self.clone();
            half.parts.resize(half.parts.len().max(datum + 1), (BigInt::ZERO, 0)); // exact: a length
            half.parts[datum] = (k, n + 1);
            half
        })
    }

    /// The values of `x`, the datum `j`, in this piece.
    fn part(&self, x: &Exact, j: usize, bits: u32) -> Affine {
        let whole = Real::of(x, bits);
        if x.is_point() {
            return Affine::fixed(whole);
        }
        let (k, n) = self.parts.get(j).cloned().unwrap_or_default(); // exact: not cut yet, the whole
        let [lo, hi] = [whole.enclosure().inf(), whole.enclosure().sup()].map(|end| Real::point(end.clone(), bits));
        let size = hi - &lo;
        let cut = |k: BigInt| lo.clone() + &(size.clone() * &Real::point(Dyadic::new(k, -i64::from(n)), bits));
        let part = cut(k.clone()).hull(&cut(k + 1));
        let centre = Real::point(part.mid(), bits);
        let radius = (part - &centre).enclosure().mag();
        Affine::varied(centre, radius, j)
    }
}

/// `W t0 + tau` of a harmonic without whole forcing periods, and the number of whole forcing periods.
fn phase(harmonic: &Harmonic, start: &Start) -> Result<(Exact, BigInt), Error> {
    let (time, delay) = (start.time(), harmonic.phase());
    let turned = within("start.time", time, harmonic.frequency().checked_mul(time))?;
    let phase = within("excitation.phase", delay, turned.checked_add(delay))?;
    let turn = Exact::pi() * Exact::from(2);
    let turns = nearest(&within("start.time", time, phase.checked_div(&turn))?);
    let whole = Exact::from_rational(turns.clone().into());
    let whole = within("start.time", time, whole.checked_mul(&turn))?;
    Ok((within("start.time", time, phase.checked_sub(&whole))?, turns))
}

/// A whole number within 1 of an exact value, or of a member of a set of values.
fn nearest(x: &Exact) -> BigInt {
    let top = x.enclose(64).mag().top().unwrap_or(0).max(0); // X1: any number of bits encloses
    let near = x.enclose(64 + u32::try_from(top).unwrap_or(0)); // X1
    Enclosure::point(near.inf().clone()).floor().unwrap_or_default() // exact: any whole number is taken off
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Certificate;
    use serde_json::json;

    #[test]
    fn halves_of_halves_keep_their_place_however_small() {
        let (whole, mut piece) = (Exact::parse("[0, 1]").unwrap(), Piece::default());
        for n in 1..=70 {
            // The upper half each time: from 1 - 2^-n to 1.
            piece = piece.halves(HALF_GAP)[1].clone();
            let [lower, upper] = piece.part(&whole, HALF_GAP, 192).hull().ends();
            let least = Real::int(1, 192) - &Real::point(Dyadic::power_of_two(-n), 192);
            assert!(!least.is_below(&lower) && !upper.is_below(&Real::int(1, 192)), "{n} halvings");
            let half = Real::point(Dyadic::power_of_two(-n - 1), 192);
            assert!((least - &half).is_below(&lower), "{n} halvings");
        }
    }

    #[test]
    fn only_commensurate_harmonics_have_a_common_period() {
        let common_turns = |frequencies: [&str; 3]| {
            let document = json!({
                "schema": "impact-pair/orbit/1", "certified": true, "events": [], "outcome": {"kind": "impacts-reached", "impacts": 0},
                "scene": {
                    "excitation": {"amplitude": ["1", "1", "1"], "frequency": frequencies, "phase": ["0", "0", "0"]},
                    "gap": "4", "restitution": "0.5", "start": {"time": "0", "position": "0", "velocity": "0"},
                },
            });
            let certificate = Certificate::parse(&document.to_string()).unwrap();
            Data::new(certificate.pair(), certificate.start()).unwrap().common_turns().map(|turns| turns.to_string())
        };
        assert_eq!(common_turns(["2*pi/3", "pi/2", "pi"]).as_deref(), Some("6"));
        assert_eq!(common_turns(["sqrt(2)/5", "2*sqrt(2)", "sqrt(2)"]).as_deref(), Some("10"));
        assert_eq!(common_turns(["1", "sqrt(2)", "2"]), None);
        assert_eq!(common_turns(["1", "[0.3, 0.4]", "2"]), None);
    }
}
