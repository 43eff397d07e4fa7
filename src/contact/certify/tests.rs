//! Lemma C3: what a bracket holds. That it is the first contact: `contact/tests.rs`.

use super::*;
use crate::contact::solve::{NoProposal, Verifier, propose};
use crate::contact::tests::cases;
use crate::number::tests::Truth;
use proptest::prelude::*;

/// Keeps the bracket of a proposal.
struct Keeper<'a, const WIDE: bool>(Bounds<'a, WIDE>);

type Kept = Option<Bracket>;

impl<const WIDE: bool> Verifier for Keeper<'_, WIDE> {
    type Answer = Kept;
    fn monotone(&self, iterate: &Iterate) -> Kept {
        self.0.bracket(iterate)
    }
    fn hop(&self, iterate: &Iterate, departure: &SmallAngle) -> Kept {
        self.0.hop_bracket(iterate, departure)
    }
    fn piece(&self, iterate: &Iterate, _: &Extrema, _: f64) -> Kept {
        self.0.bracket(iterate)
    }
    fn nothing(&self, _: NoProposal) -> Kept {
        None
    }
}

/// Asks whether the bracket of a proposal is the first contact on the piece before its own, and on the piece after it.
struct Misplaced<'a, const WIDE: bool>(Bounds<'a, WIDE>);

impl<const WIDE: bool> Verifier for Misplaced<'_, WIDE> {
    type Answer = Option<[Result<(), Doubt>; 2]>;
    fn monotone(&self, _: &Iterate) -> Self::Answer {
        None
    }
    fn hop(&self, _: &Iterate, _: &SmallAngle) -> Self::Answer {
        None
    }
    fn piece(&self, iterate: &Iterate, extrema: &Extrema, k: f64) -> Self::Answer {
        let arrival = self.0.bracket(iterate)?.arrival;
        Some([k - 1.0, k + 1.0].map(|k| self.0.is_first(extrema, k, &arrival)))
    }
    fn nothing(&self, _: NoProposal) -> Self::Answer {
        None
    }
}

proptest! {
    /// Lemma C4 needs the contact between the last two extrema of its kind: with another number of the piece it is refused.
    #[test]
    fn a_contact_is_refused_on_the_pieces_beside_its_own(case in cases()) {
        let (flight, margins) = (case.flight(), case.margins());
        let verdicts = propose::<Kernel, _>(&flight, &Misplaced(Bounds::<true>::new(&flight, &margins, case.radii)));
        prop_assert!(verdicts.is_none_or(|both| both.iter().all(Result::is_err)), "{verdicts:?}");
    }

    /// Lemma C3 claims one zero of the formula in the bracket, whether it is the first contact or not.
    #[test]
    fn a_bracket_holds_one_zero_with_its_velocity_and_sine(case in cases()) {
        let (flight, margins, truth) = (case.flight(), case.margins(), case.truth());
        let bounds = Bounds::<true>::new(&flight, &margins, case.radii);
        let Some(bracket) = propose::<Kernel, _>(&flight, &Keeper(bounds)) else { return Ok(()) };
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
    }
}
