//! Proof that each flight of a chain ends at its first contact, equation (14): Lemma T5.

use std::cmp::Ordering;

use super::chain::Chain;
use super::legs::{Leg, Legs};
use super::shaking::Shaking;
use crate::contact::{PairBounds, Radii, Verdict, first_contact};
use crate::flight::Flight;
use crate::number::{Ball, Enclosing, kernel};
use crate::pair::Inward;
use crate::pair::Wall;

/// A flight of a proved chain over its box, with its start moved into the first forcing period.
#[derive(Clone, Debug)]
pub(super) struct Claim<N> {
    pub from: Wall,
    to: Wall,
    /// Whole forcing periods and the rest of the phase, and velocity before the impact at the start.
    pub turns: f64,
    pub start: N,
    pub before: N,
    /// Phase at the end of the flight.
    end: N,
    leg: Leg<N>,
}

/// `Some(true)` when every flight is proved to touch no wall before it ends, `Some(false)` when one is proved to.
pub(super) fn is_physical(
    bounds_of_pair: &PairBounds,
    chain: &Chain,
    phases: &[Ball],
    legs: &Legs<Ball>,
) -> Option<bool> {
    all_first(chain, split(phases), &legs.legs, |claim| first_in_doubles(bounds_of_pair, claim))
}

/// As [`is_physical`], at phases that are known exactly: whole quarters of a forcing period. Lemma T14
pub(super) fn is_physical_at(bounds_of_pair: &PairBounds, chain: &Chain, quarters: &[f64]) -> Option<bool> {
    let phases: Vec<Ball> = quarters.iter().map(|&phase| Ball::exact(phase)).collect();
    let legs = chain.legs(&bounds_of_pair.pair, &phases)?;
    let starts = quarters.iter().map(|phase| (phase.floor(), Ball::exact(phase - phase.floor()))).collect(); // T14: exact
    all_first(chain, starts, &legs.legs, |claim| first_in_doubles(bounds_of_pair, claim))
}

/// The whole forcing periods of phases, and the rest of each.
pub(super) fn split<N: Enclosing>(phases: &[N]) -> Vec<(f64, N)> {
    let split = |phase: &N| {
        let turns = phase.as_ball().mid().floor(); // T5: any whole number of forcing periods
        (turns, phase.clone() - N::from_f64(turns))
    };
    phases.iter().map(split).collect()
}

/// The conjunction over all flights, given the whole forcing periods of the phases that they start at, and the rest.
pub(super) fn all_first<N: Enclosing>(
    chain: &Chain,
    starts: Vec<(f64, N)>,
    legs: &[Leg<N>],
    is_first: impl Fn(&Claim<N>) -> Option<bool>,
) -> Option<bool> {
    let walls = chain.walls();
    let mut all = Some(true);
    for (i, ((turns, start), leg)) in starts.into_iter().zip(legs).enumerate() {
        let end = start.clone() + leg.time.clone();
        let before = chain.before(legs, i).clone();
        let claim = Claim { from: walls[i], to: walls[chain.next(i)], turns, start, before, end, leg: leg.clone() };
        match is_first(&claim) {
            Some(true) => {}
            Some(false) => return Some(false),
            None => all = None,
        }
    }
    all
}

impl<N: Enclosing> Claim<N> {
    /// Whether the ball comes to the first impact from inside the gap; `None` if undecided.
    pub fn arrives(&self) -> Option<bool> {
        match self.from.inward(self.before.clone()).certain_sign()? {
            Ordering::Less => Some(true),
            Ordering::Greater => Some(false),
            Ordering::Equal => None,
        }
    }

    /// Whether the ball, after a perfectly plastic impact, is held on the wall by the contact force: Lemma Z2.
    pub fn sticks(&self, after: &N) -> bool {
        let sin = self.from.inward(self.start.wave().0);
        after.certain_sign() == Some(Ordering::Equal) && sin.certain_sign() == Some(Ordering::Less)
    }

    /// Whether a proved first contact is the end of the flight. Given: its wall, its whole forcing periods after the start's, and the rest
    /// of its phase. Lemma T5
    pub fn is_at<S: Shaking<N>>(&self, shaking: &S, wall: Wall, (turns, phase): (f64, N)) -> Option<bool> {
        if wall != self.to {
            return Some(false);
        }
        let end = self.end.clone() - N::from_f64(turns);
        let later = end - phase.clone();
        // All phases between the contact and the end.
        let between = N::from_f64(0.5).with_radius(0.5).mul_add(later.clone(), phase);
        let velocity = shaking.relative(&self.leg.drift, &shaking.moment(self.turns + turns, &between));
        if velocity.certain_sign().is_some_and(|sign| sign != Ordering::Equal) {
            return Some(true);
        }
        (later.certain_sign() == Some(Ordering::Greater)).then_some(false)
    }
}

fn first_in_doubles(bounds_of_pair: &PairBounds, claim: &Claim<Ball>) -> Option<bool> {
    if !claim.arrives()? {
        return Some(false);
    }
    let after = claim.from.inward(bounds_of_pair.pair.rebound_of(claim.before));
    if claim.sticks(&after) {
        return Some(false);
    }
    let phase = claim.start.mid();
    let flight = Flight::from_wall(&bounds_of_pair.centre, claim.from, phase, after.mid(), kernel::sin_cos(phase));
    let radii = Radii { phase: claim.start.rad(), velocity: after.rad(), height: 0.0 };
    match first_contact(&flight, &bounds_of_pair.margins, radii) {
        Verdict::Certified(contact) => claim.is_at(&bounds_of_pair.pair, contact.wall, (contact.turns, contact.phase)),
        Verdict::Undecided(_) => None,
    }
}
