//! Motions that repeat exactly: a second release from the same wall (Lemma Z3).

use super::event::{Period, Progress};
use crate::pair::Wall;

/// Events that are kept to be repeated; longer periods are computed anew each time.
const KEPT: usize = 1 << 16;

/// What has happened since the first release from a wall.
#[derive(Clone, Debug, Default)]
pub(super) struct Recurrence {
    /// The first release from each wall: its turns, the impacts listed before it, and the events kept up to it.
    first: [Option<(i64, u64, usize)>; 2],
    /// Since the first release from any wall.
    events: Vec<Progress>,
    period: Option<Period>,
    /// The next event to repeat, and how many periods after it was computed.
    next: usize,
    rounds: u64,
}

impl Recurrence {
    /// The period, once it is proved.
    pub fn period(&self) -> Option<Period> {
        self.period
    }

    /// Keeps an event that was computed.
    pub fn keep(&mut self, event: &Progress) {
        if self.first != [None; 2] && self.period.is_none() && self.events.len() <= KEPT {
            self.events.push(event.clone());
        }
    }

    /// Notes a release after `impacts` impacts, which was kept.
    pub fn release(&mut self, wall: Wall, turns: i64, impacts: u64) {
        let first = &mut self.first[usize::from(wall == Wall::Right)];
        match *first {
            None => *first = Some((turns, impacts, self.events.len())),
            Some((since, before, kept)) if self.period.is_none() => {
                self.period = Some(Period { cycles: turns.abs_diff(since), impacts: impacts - before });
                self.events.drain(..kept.min(self.events.len()));
                self.rounds = 1;
            }
            Some(_) => {}
        }
    }

    /// The next event, repeated, when all of a period were kept.
    pub fn repeat(&mut self) -> Option<Progress> {
        let period = self.period.filter(|_| self.events.len() < KEPT)?;
        let event = self.events[self.next].after(period, self.rounds);
        self.next += 1;
        if self.next == self.events.len() {
            (self.next, self.rounds) = (0, self.rounds + 1);
        }
        Some(event)
    }
}
