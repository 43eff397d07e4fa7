//! The exact data of an orbit in physical lengths and radians, and pieces of those that are intervals.

use num_bigint::BigInt;

use super::affine::Affine;
use super::step::Parameters;
use crate::error::Error;
use crate::exact::{Dyadic, Enclosure, Exact, Real};
use crate::orbit::{Place, Start};
use crate::pair::{ImpactPair, Wall, within};

/// The exact data.
#[derive(Clone, Debug)]
pub(in crate::certificate) struct Data {
    pub amplitude: Exact,
    pub half_gap: Exact,
    pub restitution: Exact,
    pub frequency: Exact,
    /// `tau`
    pub delay: Exact,
    /// `t0`
    pub time: Exact,
    /// `W t0 + tau` less whole turns, and these.
    pub phase: Exact,
    pub turns: BigInt,
    /// `y' / W`, before the impact for a start on a wall.
    pub velocity: Exact,
    pub wall: Option<Wall>,
    /// `y` of a start inside the gap.
    pub height: Option<Exact>,
}

/// Which halves of halves of each datum that is an interval.
#[derive(Clone, Debug, Default)]
pub(in crate::certificate) struct Piece {
    /// By the number of the datum: part `k` of `2^n`.
    parts: [(u32, u32); DATA],
}

/// How many data can be intervals.
const DATA: usize = 6;
/// Their numbers.
const AMPLITUDE: usize = 0;
const HALF_GAP: usize = 1;
const RESTITUTION: usize = 2;
const PHASE: usize = 3;
const VELOCITY: usize = 4;
const HEIGHT: usize = 5;

impl Data {
    pub fn new(pair: &ImpactPair, start: &Start) -> Result<Self, Error> {
        let excitation = pair.harmonic("the check")?;
        let (frequency, delay) = (excitation.frequency(), excitation.phase());
        let half = |key, of: &Exact| within(key, of, of.checked_div(&Exact::from(2)));
        let turned = within("start.time", start.time(), frequency.checked_mul(start.time()))?;
        let phase = within("excitation.phase", delay, turned.checked_add(delay))?;
        let turn = Exact::pi() * Exact::from(2);
        let turns = within("start.time", start.time(), phase.checked_div(&turn))?;
        let turns = nearest(&turns);
        let whole = Exact::from_rational(turns.clone().into());
        let whole = within("start.time", start.time(), whole.checked_mul(&turn))?;
        let (wall, height) = match start.place() {
            Place::Wall(wall) => (Some(*wall), None),
            Place::Inside(height) => (None, Some(height.clone())),
        };
        Ok(Self {
            amplitude: excitation.amplitude().clone(),
            half_gap: half("pair.gap", pair.gap())?,
            restitution: pair.restitution().clone(),
            frequency: frequency.clone(),
            delay: delay.clone(),
            time: start.time().clone(),
            phase: within("start.time", start.time(), phase.checked_sub(&whole))?,
            turns,
            velocity: within("start.velocity", start.velocity(), start.velocity().checked_div(frequency))?,
            wall,
            height,
        })
    }

    /// `A`, `d/2` and `e` over a piece of the data.
    pub fn parameters(&self, piece: &Piece, bits: u32) -> Parameters {
        Parameters {
            amplitude: piece.part(&self.amplitude, AMPLITUDE, bits),
            half_gap: piece.part(&self.half_gap, HALF_GAP, bits),
            restitution: piece.part(&self.restitution, RESTITUTION, bits),
        }
    }

    /// The start's phase, velocity and height (if it is inside the gap) over a piece of the data.
    pub fn state(&self, piece: &Piece, bits: u32) -> (Affine, Affine, Option<Affine>) {
        let height = self.height.as_ref().map(|height| piece.part(height, HEIGHT, bits));
        (piece.part(&self.phase, PHASE, bits), piece.part(&self.velocity, VELOCITY, bits), height)
    }

    /// The phase of the start as a number of quarter turns, if it is exactly one.
    pub fn quarter(&self) -> Option<BigInt> {
        let quarter = Exact::pi().checked_div(&Exact::from(2)).ok()?;
        let quarters = self.phase.checked_div(&quarter).ok()?;
        let quarters = quarters.as_rational()?;
        quarters.is_integer().then(|| quarters.to_integer())
    }
}

impl Piece {
    /// The two halves along a datum.
    pub fn halves(&self, datum: usize) -> [Self; 2] {
        let (k, n) = self.parts[datum];
        [2 * k, 2 * k + 1].map(|k| {
            let mut half = self.clone();
            half.parts[datum] = (k, n + 1);
            half
        })
    }

    /// The values of `x`, datum `j`, in this piece.
    fn part(&self, x: &Exact, j: usize, bits: u32) -> Affine {
        let whole = Real::of(x, bits);
        if x.is_point() {
            return Affine::fixed(whole);
        }
        let (k, n) = self.parts[j];
        let [lo, hi] = [whole.enclosure().lo(), whole.enclosure().hi()].map(|end| Real::point(end.clone(), bits));
        let size = hi - &lo;
        let cut = |k: u32| lo.clone() + &(size.clone() * &Real::point(Dyadic::new(k.into(), -i64::from(n)), bits));
        let part = cut(k).hull(&cut(k + 1));
        let centre = Real::point(part.mid(), bits);
        let radius = (part - &centre).enclosure().mag();
        Affine::varied(centre, radius, j)
    }
}

/// A whole number within 1 of an exact value, or of one of a set of values.
fn nearest(x: &Exact) -> BigInt {
    let top = x.enclose(64).mag().top().unwrap_or(0).max(0);
    let near = x.enclose(64 + u32::try_from(top).unwrap_or(0));
    Enclosure::point(near.lo().clone()).floor().unwrap_or_default()
}
