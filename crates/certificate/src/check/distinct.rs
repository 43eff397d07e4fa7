//! Proofs that the orbits of a list are different motions: Lemma V13.
//!
//! Confirmed bounds decide this: two periodic motions are the same only where all impacts agree, from some impact of one of them
//! on.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;

use super::data::Data;
use crate::attraction::{Bounds, ClaimedOrbit, Passage};
use impact_pair_exact::{Exact, Real};
use impact_pair_model::Wall;

/// Bits of `2 pi`: bounds that only an enclosure of `2 pi` separates are not narrower.
const BITS: u32 = 1 << 10;
/// Greatest number of common periods between two claimed phases.
const MAX_PERIODS: i64 = 4;

/// Recurrence of the forcing: its common period and its symmetry.
pub(super) struct Recurrence {
    /// The periods of the reference in a common period.
    turns: BigInt,
    /// True if the forcing may change sign after half a common period.
    may_have_mirror: bool,
    /// 2 pi
    turn: Real,
}

/// The comparison of the impacts of two motions.
#[derive(Clone, Copy)]
struct View {
    /// Number of impacts by which the second motion is shifted.
    shift: usize,
    is_mirrored: bool,
}

impl Recurrence {
    /// The recurrence of the data; `None` where no common period is proved.
    pub fn of(data: &Data) -> Option<Self> {
        let turn = Real::of(&(Exact::pi() * Exact::from(2)), BITS);
        Some(Self { turns: data.common_turns()?, may_have_mirror: data.has_mirror() != Some(false), turn })
    }

    /// Whether the bounds of two orbits share no motion; with `mirrors_are_one`, mirror images count as the same.
    pub fn are_apart(&self, one: &ClaimedOrbit, other: &ClaimedOrbit, mirrors_are_one: bool) -> bool {
        let mirrored = if mirrors_are_one && self.may_have_mirror { &[false, true][..] } else { &[false] };
        let shifts = 0..other.impacts.len();
        let mut views = shifts.flat_map(|shift| mirrored.iter().map(move |&is_mirrored| View { shift, is_mirrored }));
        views.all(|view| self.are_apart_in(view, &one.impacts, &other.impacts))
    }

    /// Whether some impact of one orbit differs from the corresponding impact of the other in this view.
    fn are_apart_in(&self, view: View, one: &[Passage], other: &[Passage]) -> bool {
        let all = one.len().lcm(&other.len());
        let other = other.iter().cycle().skip(view.shift);
        one.iter().cycle().zip(other).take(all).any(|(one, other)| self.is_another(view.is_mirrored, one, other))
    }

    /// Whether the bounds of two impacts share no state.
    fn is_another(&self, is_mirrored: bool, one: &Passage, other: &Passage) -> bool {
        let [low, high] = other.velocity.each_ref();
        let (wall, velocity) = match is_mirrored {
            false => (other.wall, [low.clone(), high.clone()]),
            true => (other.wall.other(), [-high.clone(), -low.clone()]),
        };
        one.wall != wall || are_disjoint(&one.velocity, &velocity) || self.are_phases_apart(is_mirrored, one, other)
    }

    /// Whether no two phases differ by whole common periods, each `q` forcing periods long. Phases have lower bounds in `[0, 2 pi)` and
    /// numbers of forcing periods in `[0, q)`.
    fn are_phases_apart(&self, is_mirrored: bool, one: &Passage, other: &Passage) -> bool {
        let least = &one.phase[0] - &other.phase[1];
        let greatest = &one.phase[1] - &other.phase[0];
        let turn = |impact: &Passage| BigInt::from(impact.turn.unwrap_or(0)); // exact: without a forcing period, the common period is one
        let half = BigRational::new(self.turns.clone(), 2.into());
        let later = BigRational::from(turn(one) - turn(other));
        let later = if is_mirrored { later - half } else { later };
        let is_missed = |period: i64| {
            let turns = BigRational::from(&self.turns * period) - &later;
            let at = self.turn.clone() * &Real::rational(&turns, BITS);
            let [least, greatest] = [&least, &greatest].map(|x| Real::rational(x, BITS));
            at.is_below(&least) || greatest.is_below(&at)
        };
        // T13, V13: with widths below a forcing period no other multiple lies between.
        (-MAX_PERIODS..=MAX_PERIODS).all(is_missed)
    }
}

/// Whether the first impact of `one` is claimed within the bounds of the first impact of `other`, with equal wall and forcing period.
pub(super) fn begins_within(one: &ClaimedOrbit, other: &ClaimedOrbit) -> bool {
    let (Some(one), Some(other)) = (one.impacts.first(), other.impacts.first()) else { return false };
    let place = |impact: &Passage| -> (Wall, Option<u32>) { (impact.wall, impact.turn) };
    place(one) == place(other) && is_within(&one.phase, &other.phase) && is_within(&one.velocity, &other.velocity)
}

fn are_disjoint(one: &Bounds, other: &Bounds) -> bool {
    one[1] < other[0] || other[1] < one[0]
}

fn is_within(one: &Bounds, other: &Bounds) -> bool {
    other[0] <= one[0] && one[1] <= other[1]
}
