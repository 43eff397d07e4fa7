//! Events and outcomes of an orbit.

use impact_pair_model::vocabulary::OutcomeKind;

use super::Period;
use crate::contact::Reason;
use crate::exact::Enclosure;
use crate::impact::{Graze, Impact, Touch};
use crate::pair::Wall;
use crate::periodic::Attractor;
use crate::turns;

/// The ball has come to rest on a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Rest {
    /// The wall and the time.
    pub at: Touch,
    /// Infinitely many impacts, each slower than the one before, come between the last one listed and the rest.
    pub is_accumulation: bool,
}

/// Result of [`Orbit::advance`](super::Orbit::advance).
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// The next impact is certified.
    Impact(Impact),
    /// A wall is touched with zero velocity, or not touched: undecided at any precision. The orbit continues with both continuations enclosed.
    Graze(Box<Graze>),
    /// The ball has come to rest, proved.
    Rest(Rest),
    /// The ball leaves the wall on which it rested, where the contact force vanishes, proved; with one harmonic its phase is exactly 0 on the
    /// left wall, -1/2 on the right one.
    Release(Touch),
    /// The precision has risen and an impact that was listed before was computed anew.
    Retraced(u64),
    /// The orbit has ended.
    Ended,
}

impl Progress {
    /// The event `rounds` periods later; `None` where forcing periods are not counted any more.
    pub(super) fn after(&self, period: Period, rounds: u64) -> Option<Self> {
        let cycles = i64::try_from(period.cycles.checked_mul(rounds)?).ok()?;
        let mut event = self.clone();
        match &mut event {
            Self::Impact(impact) => {
                impact.turns = turns::later(impact.turns, cycles)?;
                impact.index += period.impacts * rounds;
            }
            Self::Graze(graze) => graze.at.turns = turns::later(graze.at.turns, cycles)?,
            Self::Rest(Rest { at: touch, .. }) | Self::Release(touch) => {
                touch.turns = turns::later(touch.turns, cycles)?;
            }
            Self::Retraced(_) | Self::Ended => {}
        }
        Some(event)
    }
}

/// The reason why an orbit ended.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Outcome {
    /// All requested impacts are listed.
    ImpactsReached,
    /// All events up to the requested time are listed, and those whose bounds contain it.
    TimeReached,
    /// All that was requested is listed, and from a release on the motion is proved to repeat exactly, for ever.
    Periodic(Period),
    /// All that was requested is listed, and the motion is proved to converge to a stable periodic orbit (Lemma Q3); only if
    /// [`Settings::attractor`](super::Settings::attractor) is set.
    Attracted(Box<Attractor>),
    /// The ball rests on its wall for ever: there is no excitation.
    RestsForever(Wall),
    /// No wall is ever touched again.
    NeverImpacts,
    /// The next impact could not be proved.
    Undecided {
        /// The reason.
        reason: Reason,
        /// The wall concerned, if there is one.
        wall: Option<Wall>,
        /// No wall is touched after the last event and before the first of these \[time\] (Lemma C7). The second encloses the next contact, where
        /// it is proved but not narrowly enough.
        time: (Enclosure, Option<Enclosure>),
    },
}

impl Outcome {
    /// Kind of the outcome in the orbit JSON.
    pub fn kind(&self) -> OutcomeKind {
        match self {
            Self::ImpactsReached => OutcomeKind::ImpactsReached,
            Self::TimeReached => OutcomeKind::TimeReached,
            Self::Periodic(_) => OutcomeKind::Periodic,
            Self::Attracted(_) => OutcomeKind::Attracted,
            Self::RestsForever(_) => OutcomeKind::RestsForever,
            Self::NeverImpacts => OutcomeKind::NeverImpacts,
            Self::Undecided { .. } => OutcomeKind::Undecided,
        }
    }
}
