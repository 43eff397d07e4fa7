//! Chains that are one orbit: shifted by impacts, by whole common periods, or mirrored. Lemma T6

use std::cmp::Ordering;

use super::chain::Chain;
use super::krawczyk::{Proved, is_inside};
use crate::number::{Ball, Enclosing};
use crate::pair::Wall;

/// The motion counted from another impact on, or the mirrored motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct View {
    /// Impacts later.
    pub shift: usize,
    pub mirrored: bool,
}

impl View {
    /// All views of a chain that have the chain's word; mirrored ones only where the excitation has a mirror.
    pub fn of(chain: &Chain, mirrored: bool) -> impl Iterator<Item = Self> {
        let walls = chain.walls();
        let seen = move |wall: Wall| if mirrored { wall.other() } else { wall };
        let fits = move |shift: &usize| (0..walls.len()).all(|i| seen(walls[(i + shift) % walls.len()]) == walls[i]);
        let shifts = if mirrored && chain.mirror().is_none() { 0..0 } else { 0..walls.len() };
        shifts.filter(fits).map(move |shift| Self { shift, mirrored })
    }

    /// Phases of the motion in this view, shifted by the whole common periods that bring them nearest to `other`.
    fn phases<N: Enclosing>(self, chain: &Chain, phases: &[N], other: &[N]) -> Vec<N> {
        let count = phases.len();
        // T6: mirrored views are of chains that have a mirror
        let half = if self.mirrored { chain.mirror().unwrap_or(0.0) } else { 0.0 };
        let moved = |i: usize| {
            let at = i + self.shift;
            let rounds = if at >= count { f64::from(chain.cycles()) } else { 0.0 };
            phases[at % count].clone() + N::from_f64(rounds - half)
        };
        let middle = |x: &N| -> f64 { Ball::mid(x.as_ball()) };
        let period = f64::from(chain.period());
        // T6: any whole number of periods, exact
        let turns = N::from_f64(period * ((middle(&moved(0)) - middle(&other[0])) / period).round());
        (0..count).map(|i| moved(i) - turns.clone()).collect()
    }

    /// Whether `one`, in this view, is the orbit `other`; `None` if undecided. Lemma T6
    pub fn is_same<N: Enclosing>(self, chain: &Chain, one: &Proved<N>, other: &Proved<N>) -> Option<bool> {
        let seen = self.phases(chain, &one.at, &other.at);
        if is_inside(&seen, &other.domain) {
            return Some(true);
        }
        let is_apart =
            |(x, y): (&N, &N)| (x.clone() - y.clone()).certain_sign().is_some_and(|sign| sign != Ordering::Equal);
        seen.iter().zip(&other.at).any(is_apart).then_some(false)
    }
}

/// Verdict on whether an orbit is one of the known orbits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Identity {
    /// The orbit is proved to be none of them.
    New,
    /// The orbit is proved to be one of them.
    Known,
    /// Neither is proved.
    Open,
}

impl Identity {
    /// Verdict from the verdicts on each known orbit.
    pub fn of(verdicts: impl Iterator<Item = Option<bool>>) -> Self {
        match any(verdicts) {
            Some(false) => Self::New,
            Some(true) => Self::Known,
            None => Self::Open,
        }
    }
}

/// Whether `one` is the orbit `other`, from whichever impact on; `None` if undecided.
pub(super) fn is_one_orbit<N: Enclosing>(chain: &Chain, one: &Proved<N>, other: &Proved<N>) -> Option<bool> {
    any(View::of(chain, false).map(|view| view.is_same(chain, one, other)))
}

/// Whether `one` is the orbit `other` or its mirror image, from whichever impact on; `None` if undecided.
pub(super) fn is_one_reduced<N: Enclosing>(chain: &Chain, one: &Proved<N>, other: &Proved<N>) -> Option<bool> {
    any(views(chain).map(|view| view.is_same(chain, one, other)))
}

/// Least number of impacts after which an orbit repeats itself or its mirror image; `None` if undecided.
pub(super) fn reduced_impacts<N: Enclosing>(chain: &Chain, orbit: &Proved<N>) -> Option<usize> {
    let mut views: Vec<View> = views(chain).filter(|view| view.shift > 0).collect();
    views.sort_by_key(|view| view.shift);
    for view in views {
        if view.is_same(chain, orbit, orbit)? {
            return Some(view.shift);
        }
    }
    Some(chain.impacts())
}

/// All views, mirrored or not.
fn views(chain: &Chain) -> impl Iterator<Item = View> {
    View::of(chain, false).chain(View::of(chain, true))
}

/// Whether the orbit is its own mirror image; `None` if undecided.
pub(super) fn is_symmetric<N: Enclosing>(chain: &Chain, orbit: &Proved<N>) -> Option<bool> {
    if !chain.is_mirror_decided() {
        return None; // T6: it may be for the parameters of which a harmonic vanishes
    }
    any(View::of(chain, true).map(|view| view.is_same(chain, orbit, orbit)))
}

/// Number of times that the chain runs through a shorter orbit: 1 when it does not; `None` if undecided.
pub(super) fn repeats<N: Enclosing>(chain: &Chain, orbit: &Proved<N>) -> Option<usize> {
    for view in View::of(chain, false).skip(1) {
        if view.is_same(chain, orbit, orbit)? {
            return Some(chain.impacts() / view.shift);
        }
    }
    Some(1)
}

/// Whether one of the verdicts is true; `None` if undecided.
fn any(mut verdicts: impl Iterator<Item = Option<bool>>) -> Option<bool> {
    let mut all = Some(false);
    verdicts
        .find_map(|verdict| match verdict {
            Some(true) => Some(true),
            Some(false) => None,
            None => {
                all = None;
                None
            }
        })
        .or(all)
}
