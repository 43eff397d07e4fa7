//! Lemmas C3 and C4, piece by piece: what a bracket holds, and where a doubtful extremum is. That a bracket is the first
//! contact: `contact/tests.rs`.

use super::*;
use crate::contact::solve::{Judge, NoProposal, propose};
use crate::contact::tests::cases;
use crate::number::tests::Truth;
use proptest::prelude::*;

/// Keeps the bracket of a proposal, and the doubt about it.
struct Keeper<'a, const WIDE: bool>(Bounds<'a, WIDE>);

type Kept = Option<(Bracket, Result<(), Doubt>)>;

impl<const WIDE: bool> Judge for Keeper<'_, WIDE> {
    type Answer = Kept;
    fn monotone(&self, iterate: &Iterate) -> Kept {
        self.0.bracket(iterate).map(|bracket| (bracket, self.0.is_monotone(&bracket.arrival)))
    }
    fn hop(&self, iterate: &Iterate, departure: &Departure) -> Kept {
        self.0.hop_bracket(iterate, departure).map(|bracket| (bracket, self.0.is_one_hop(&bracket)))
    }
    fn piece(&self, iterate: &Iterate, extrema: &Extrema, k: f64) -> Kept {
        self.0.bracket(iterate).map(|bracket| (bracket, self.0.is_first(extrema, k, &bracket.arrival)))
    }
    fn nothing(&self, _: NoProposal) -> Kept {
        None
    }
}

proptest! {
    /// Lemma C3 claims one zero of the formula in the bracket, whether it is the first contact or not.
    #[test]
    fn a_bracket_holds_one_zero_with_its_velocity_and_sine(case in cases()) {
        let (flight, margins, truth) = (case.flight(), case.margins(), case.truth());
        let bounds = Bounds::<true>::new(&flight, &margins, case.radii);
        let Some((bracket, doubt)) = propose::<Kernel, _>(&flight, &Keeper(bounds)) else { return Ok(()) };
        let Bracket { arrival, velocity, sin, .. } = bracket;
        let target = arrival.target.height();
        let zero = truth.contact(target, &arrival.time.mid().into());
        prop_assert!(zero.is_in(&arrival.time) && (&truth.phase + &zero - arrival.turns).is_in(&arrival.phase), "{arrival:?}");
        prop_assert!(truth.velocity_at(&zero).is_in(&velocity), "velocity {velocity:?}");
        prop_assert!(truth.sin_cos(&zero).0.is_in(&sin), "sine {sin:?}");
        // At the ends of the bracket the height has opposite signs.
        let [before, after] = [-1.0, 1.0].map(|end| {
            let time = Truth::from(arrival.time.mid()) + Truth::from(arrival.time.rad()) * end;
            (truth.height_at(&time) - target) * arrival.target.direction()
        });
        prop_assert!(!before.exceeds(0.0) && !(-after).exceeds(0.0), "{arrival:?}");
        // The doubtful extremum is where it is said to be, if it exists clearly.
        if let Err(Doubt::Extremum { target, time }) = doubt {
            let place = around(&bounds, time);
            let is_clear = flight.drift.abs() < 0.999 * flight.beta && place.rad() < 0.01;
            let extremum = truth.extremum(&time.into());
            prop_assert!(!is_clear || extremum.is_in(&place), "{target:?} at {place:?}");
        }
    }
}
