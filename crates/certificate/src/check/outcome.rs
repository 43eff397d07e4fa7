//! Claims about the end of an orbit: fields, which are proved, and words, which must agree with the fields.

use super::clock::Clock;
use super::contact::{Doubt, clear_throughout};
use super::flight::Part;
use super::rest::Rest;
use super::walk::Walk;
use crate::{Certificate, Claim};
use impact_pair_document::{ClaimName, OutcomeDocument};
use impact_pair_exact::Real;
use impact_pair_model::Period;
use impact_pair_model::vocabulary::OutcomeKind;

impl Certificate {
    /// Proves that the words of the outcome agree with its fields, that no field of another kind is set, and the count of listed impacts.
    pub(crate) fn says_one_thing(&self) -> Result<(), Doubt> {
        let ended = self.ended();
        let others = [
            ("reason", ended.reason.is_some(), &[OutcomeKind::Undecided][..]),
            (
                "until",
                ended.until.is_some(),
                &[OutcomeKind::TimeReached, OutcomeKind::Periodic, OutcomeKind::Attracted],
            ),
            (
                "may_be_later",
                ended.may_be_later.is_some(),
                &[OutcomeKind::TimeReached, OutcomeKind::Periodic, OutcomeKind::Attracted],
            ),
            ("wall", ended.wall.is_some(), &[OutcomeKind::Undecided, OutcomeKind::RestsForever]),
            ("time", ended.time.is_some(), &[OutcomeKind::Undecided]),
            ("period", ended.period.is_some(), &[OutcomeKind::Periodic]),
            ("word", ended.word.is_some(), &[OutcomeKind::Attracted]),
            ("cycles", ended.cycles.is_some(), &[OutcomeKind::Attracted]),
            ("from", ended.from.is_some(), &[OutcomeKind::Attracted]),
            ("orbit", ended.orbit.is_some(), &[OutcomeKind::Attracted]),
        ];
        if let Some((key, ..)) =
            others.iter().find(|(_, is_there, kinds)| *is_there && !kinds.contains(&self.outcome()))
        {
            return Err(Doubt::False(format!("{} has no {key}", self.outcome())));
        }
        if self.claim() == ClaimName::ExactStart && (ended.start.is_some() || ended.epsilon.is_some()) {
            return Err(Doubt::False("an orbit from its exact start is near no other".into()));
        }
        let listed = self.events().iter().filter(|claim| claim.kind.is_impact()).count() as u64; // exact: a length
        if ended.impacts != Some(listed) {
            return Err(Doubt::False(format!("{listed} impacts are listed")));
        }
        let impacts = self.events().iter().filter(|claim| claim.kind.is_impact()).map(|claim| &claim.time[1]);
        let later = ended.until.as_ref().and_then(|until| OutcomeDocument::later_than(&until.0, impacts));
        if ended.may_be_later != later {
            let later = later.unwrap_or(0); // shown
            return Err(Doubt::False(format!("{later} of the listed impacts may come after the time `until`")));
        }
        let words = ended.words().ok_or_else(|| Doubt::False("this version does not check the outcome".into()))?;
        if !ended.message.is_empty() && ended.message != words && Some(&ended.message) != ended.interruption().as_ref()
        {
            return Err(Doubt::False(format!("the message is not what the fields say: {words}")));
        }
        Ok(())
    }
}

impl Walk<'_> {
    /// Proves the claims about the future, and about the time up to which nothing else happens.
    pub(super) fn outcome(&self) -> Result<(), Doubt> {
        self.certificate.says_one_thing()?;
        let (ended, bits) = (self.certificate.ended(), self.clock.bits());
        if let Some(until) = &ended.until {
            let until = Real::of(&until.0, bits);
            self.lists_none_after(&until)?;
            self.lists_all_until(&until)?;
        }
        if let Some([Some(from), _]) = ended.time.as_deref() {
            self.lists_all_until(&Real::rational(&from.value(), bits))?;
        }
        let still = self.standing.still();
        let never = still.is_some_and(|still| !still.grazes());
        let (is_true, message) = match self.certificate.outcome() {
            OutcomeKind::Periodic => {
                match (still.map(|_| Period { cycles: 1, impacts: 0 }).or(self.period), ended.period) {
                    (Some(found), claimed) if !claimed.is_some_and(|claimed| self.repeats(claimed)) => {
                        let Period { cycles, impacts } = found;
                        return Err(Doubt::False(format!(
                            "the period that is listed is {impacts} impacts in {cycles} cycles"
                        )));
                    }
                    (found, _) => (found.is_some(), "the period is not proved"),
                }
            }
            OutcomeKind::RestsForever => match self.standing.rest() {
                Some(rest) if Some(rest.wall) != ended.wall => {
                    return Err(Doubt::False(format!("the ball rests on the {} wall", rest.wall.name())));
                }
                rest => (rest.is_some() && self.parameters.is_still(), "the ball is not proved to rest for ever"),
            },
            OutcomeKind::NeverImpacts => {
                (never || self.swings_freely()?, "the ball is not proved never to touch a wall")
            }
            // `attracted` is checked once for all pieces of the data: `Certificate::attracts`.
            _ => (true, ""),
        };
        if is_true { Ok(()) } else { Err(Doubt::open(message)) }
    }

    /// Whether each listed period of the claimed number of cycles, at least one, has the claimed number of impacts; motions without drift
    /// have no impacts. Lemmas V3 (recurrence), V5
    fn repeats(&self, claimed: Period) -> bool {
        match self.standing.still() {
            Some(_) => claimed.cycles > 0 && claimed.impacts == 0,
            None => self.has_period == Some(true),
        }
    }

    /// Proves that no listed event comes after the time `until` (Lemma V7).
    fn lists_none_after(&self, until: &Real) -> Result<(), Doubt> {
        let is_later = |claim: &Claim| until.is_below(&Real::rational(&claim.time[0], until.bits()));
        match self.certificate.events().iter().any(is_later) {
            true => Err(Doubt::False("a listed event comes after the time `until`".into())),
            false => Ok(()),
        }
    }

    /// Proves that no unlisted event comes before the time `until` (Lemma V7).
    fn lists_all_until(&self, until: &Real) -> Result<(), Doubt> {
        let missing = |what: &str| Doubt::False(format!("{what} comes before the time up to which all is listed"));
        let open = || Doubt::open("it is not proved that no other event happens up to the time `until`");
        // Before, after or across the time.
        let judged = |event: &Real, what: &str| match (until.is_below(event), event.is_below(until)) {
            (true, _) => Ok(()),
            (_, true) => Err(missing(what)),
            _ => Err(open()),
        };
        if let Some(rest) = self.standing.rest() {
            // V7: the impacts of a chatter are counted at its rest
            let [_, since] = self.clock.time(&rest.since).ends();
            let has_not_begun = until.is_below(&since);
            let stays = self.parameters.is_still() || has_not_begun;
            return if stays { Ok(()) } else { judged(&self.release_time(rest)?, "a release") };
        }
        if let Some(still) = self.standing.still() {
            return match still.next() {
                None => Ok(()),
                Some((_, quarters)) => {
                    let clock = Clock::at_quarter_turns(self.data, &quarters, self.bits).ok_or_else(open)?;
                    judged(&clock.time(&Real::zero(self.bits)), "a graze")
                }
            };
        }
        let departure = self.standing.departure();
        let ahead = self.clock.phase_at(until) - &departure.phase.hull();
        let [least, end] = ahead.ends();
        if !end.is_positive() {
            return Ok(());
        }
        let flight = departure.flights(&self.parameters);
        match clear_throughout(&flight, departure.start, &end, &least) {
            Ok(()) => Ok(()),
            // A flight that would be beyond a wall has hit the wall.
            Err(Doubt::Open(doubt))
                if !(least.is_positive() && matches!(flight.place(&flight.height(&least)), Part::Contact)) =>
            {
                Err(Doubt::Open(doubt))
            }
            Err(_) => Err(missing("a contact with a wall")),
        }
    }

    /// Encloses the time at which the sticking ball is released \[time\].
    fn release_time(&self, rest: &Rest) -> Result<Real, Doubt> {
        match self.data.only() {
            Some(_) => self.released_of_one(rest).map(|(_, clock)| clock.time(&Real::zero(self.bits))),
            None => {
                self.turning(rest).map(|root| self.clock.time(&root)).ok_or_else(|| Doubt::open("no release is proved"))
            }
        }
    }
}
