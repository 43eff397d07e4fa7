//! Motions that repeat exactly: a second release of one kind (Lemmas Z3, H9).

use super::Period;
use super::event::Progress;
use crate::contact::Undecided;
use crate::shaken::Released;

/// Events that are kept to be repeated; longer periods are computed anew each time.
const KEPT_EVENTS: usize = 1 << 16;

/// The events since the first release from a wall.
#[derive(Clone, Debug, Default)]
pub(super) struct Recurrence {
    /// The first release of each kind, the impacts listed before it, and the events kept up to it.
    first: Vec<(Released, u64, usize)>,
    /// Events since the first release from any wall.
    events: Vec<Progress>,
    period: Option<Period>,
    /// The next event to repeat, and how many periods after it was computed.
    next: usize,
    rounds: u64,
}

impl Recurrence {
    /// Period, once proved.
    pub fn period(&self) -> Option<Period> {
        self.period
    }

    /// Events that are repeated.
    pub fn kept(&self) -> &[Progress] {
        &self.events
    }

    /// Repeats nothing: the motion is computed anew, with the same period.
    pub fn forget(&mut self) {
        self.events.clear();
    }

    /// Keeps an event that was computed.
    pub fn keep(&mut self, event: &Progress) {
        if !self.first.is_empty() && self.period.is_none() && self.events.len() <= KEPT_EVENTS {
            self.events.push(event.clone());
        }
    }

    /// Notes a release after `impacts` impacts, which was kept; after two of one kind the motion is the same.
    pub fn release(&mut self, release: &Released, impacts: u64) {
        let same = |(first, before, kept): &(Released, u64, usize)| {
            Some((first.turns_of_same(release)?.abs_diff(first.at.turns), impacts - before, *kept))
        };
        match self.first.iter().find_map(same) {
            None => self.first.push((release.clone(), impacts, self.events.len())),
            Some((cycles, impacts, kept)) if self.period.is_none() => {
                self.period = Some(Period { cycles, impacts });
                self.rounds = 1;
                // Lemma Z3: what was not kept cannot be repeated.
                match self.events.len() <= KEPT_EVENTS {
                    true => drop(self.events.drain(..kept)),
                    false => self.events.clear(),
                }
            }
            Some(_) => {}
        }
    }

    /// The next event, repeated, when all events of a period were kept.
    pub fn repeat(&mut self) -> Option<Result<Progress, Undecided>> {
        let period = self.period.filter(|_| !self.events.is_empty())?;
        let event = self.events[self.next].after(period, self.rounds).ok_or(Undecided::endless());
        self.next += 1;
        if self.next == self.events.len() {
            (self.next, self.rounds) = (0, self.rounds + 1);
        }
        Some(event)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Enclosure;
    use crate::impact::Touch;
    use crate::pair::Wall;

    fn release(wall: Wall, turns: i64) -> Released {
        let phase = Enclosure::from_f64_bounds(0.0, 0.0).unwrap();
        Released { at: Touch { wall, turns, phase }, zero: None }
    }

    /// Two kinds of releases; the kind that recurs was first seen after `before` other events.
    fn repeated(before: u64, between: u64) -> Option<Result<Progress, Undecided>> {
        let mut recurrence = Recurrence::default();
        recurrence.release(&release(Wall::Left, 0), 0);
        (0..before).for_each(|index| recurrence.keep(&Progress::Retraced(index)));
        recurrence.release(&release(Wall::Right, 1), before);
        (0..between).for_each(|index| recurrence.keep(&Progress::Retraced(index)));
        recurrence.release(&release(Wall::Right, 2), before + between);
        assert_eq!(recurrence.period(), Some(Period { cycles: 1, impacts: between }));
        recurrence.repeat()
    }

    #[test]
    fn a_period_is_repeated_only_if_all_of_it_was_kept() {
        let kept = KEPT_EVENTS as u64;
        assert_eq!(repeated(5, 7), Some(Ok(Progress::Retraced(0))));
        assert_eq!(repeated(4, kept - 4), Some(Ok(Progress::Retraced(0))));
        for (before, between) in [(4, kept - 3), (5, kept), (kept, 9), (0, kept + 1)] {
            assert_eq!(repeated(before, between), None, "{before} and {between}");
        }
    }
}
