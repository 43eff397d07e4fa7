//! Proof, at the end of an orbit, that it converges to a periodic orbit. Lemmas Q1-Q5

use std::cmp::Ordering;

use super::given::Given;
use super::plan::Plan;
use super::{Arithmetic, Orbit};
use crate::contact::Contact;
use crate::exact::Exact;
use crate::impact::Impact;
use crate::mapping::Word;
use crate::periodic::{Attractor, MAX_PERIOD, Problem, find_attractor};
use crate::shaken::{Location, Origin, State};
use crate::turns;
use crate::watch::Watch;

/// Number of the last impacts that are kept.
const KEPT_IMPACTS: usize = 4096;
/// Greatest number of digits of the enclosure of an attractor's orbit.
const DIGITS: u32 = 100;
/// Bits in which the last impacts are followed again, where they are too wide in doubles.
const NARROW_BITS: u32 = 128;
const _: () = assert!(KEPT_IMPACTS > MAX_PERIOD, "a period and the state after it");

/// The last impacts of an orbit.
#[derive(Clone, Debug, Default)]
pub(super) struct Recent {
    impacts: Vec<Impact>,
    /// Position of the next one, once [`KEPT_IMPACTS`] are kept.
    next: usize,
}

impl Recent {
    /// Keeps an impact, in the place of the one [`KEPT_IMPACTS`] impacts before.
    #[inline(always)]
    pub fn keep(&mut self, impact: Impact) {
        match self.impacts.get_mut(self.next) {
            Some(oldest) => *oldest = impact,
            None => self.impacts.push(impact),
        }
        self.next = (self.next + 1) % KEPT_IMPACTS;
    }

    /// The kept impacts in order of time.
    fn in_order(&self) -> Vec<Impact> {
        let (late, early) = self.impacts.split_at(self.next.min(self.impacts.len())); // exact: an index
        [early, late].concat()
    }
}

impl Orbit {
    /// Proves the stable periodic orbit that the motion converges to, once all that was requested is listed; else `None`. Lemma Q3
    ///
    /// **Cost**: none to speak of for an orbit that has not come near one of its last 128 states, as most chaotic ones
    /// have not; milliseconds otherwise.
    #[cold]
    pub(super) fn attractor(&self, watch: &dyn Watch) -> Option<Attractor> {
        // The grazes of a motion without impacts end here as well; floats prove nothing.
        if !self.requested.settings.attractor
            || self.followed.still.is_some()
            || self.requested.settings.arithmetic == Arithmetic::Float
            || !self.may_attract()
        {
            return None;
        }
        let (impacts, digits) = (self.pending.recent.in_order(), self.requested.settings.digits.min(DIGITS)); // shown
        // Without a common period nothing is periodic.
        let origin = self.clock.turns_into(self.engine.given.shaken.period()?);
        // Lemma N1: less than a period, of 32 bits.
        let counted = |impacts: Vec<Impact>| -> Vec<Impact> {
            impacts.into_iter().map(|impact| Impact { turns: impact.turns + origin, ..impact }).collect()
        };
        let problem = |word: &Word, cycles| Problem::new(&self.engine.given.pair, word, cycles).ok();
        let narrower = |count| counted(self.narrower(&impacts, count));
        find_attractor(&counted(impacts.clone()), (digits, self.listed), watch, problem, narrower)
    }

    /// The last `count` listed impacts, or fewer, enclosed more narrowly: the motion starts from the bounds of the first of them and is followed
    /// in more bits than doubles have. Where the motion contracts, only roundings then remain of these bounds.
    fn narrower(&self, impacts: &[Impact], count: usize) -> Vec<Impact> {
        // Q3: without a rest or a graze between them
        let is_flown = |impact: &Impact| impact.index > self.followed.from.index;
        let flown = &impacts[impacts.partition_point(|impact| !is_flown(impact))..];
        let Some((first, rest)) = flown[flown.len().saturating_sub(count)..].split_first() else { return Vec::new() }; // exact: an index
        let (phase, velocity) = first.enclosures();
        let [phase, velocity] = [phase, velocity].map(|bounds| {
            let [low, high] = [bounds.inf(), bounds.sup()].map(|end| Exact::from_rational(end.to_rational()));
            Exact::interval(&low, &high).expect("bounds are in order")
        });
        let state = State { place: Location::Wall(first.wall), turns: first.turns, phase, velocity };
        let given = Given { origin: Origin::of(state), ..self.engine.given.clone() };
        let (mut motion, mut turns) = (given.precise(Plan::constant(NARROW_BITS)), first.turns);
        let next = |listed: &Impact| {
            let Contact { wall, turns: since, phase, velocity, .. } = motion.next_contact().ok()?;
            turns = turns::after(turns, since).filter(|_| wall == listed.wall)?;
            Some(Impact { turns, phase, velocity, precise: None, ..*listed })
        };
        let narrow: Vec<Impact> = rest.iter().map_while(next).collect();
        if narrow.len() == rest.len() { narrow } else { Vec::new() }
    }

    /// Whether some periodic orbit with impacts may attract, for each member of the data: none does if `e = 1`, nor if nothing moves the box.
    /// Lemma Q4
    fn may_attract(&self) -> bool {
        let pair = &self.engine.given.pair;
        let loses = pair.restitution().compare(&Exact::from(1)) == Some(Ordering::Less);
        let harmonics = pair.excitation().harmonics();
        loses && harmonics.iter().any(|harmonic| harmonic.amplitude().sign() == Some(Ordering::Greater))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Ball;
    use crate::pair::Wall;

    #[test]
    fn the_last_impacts_are_kept_in_order() {
        for count in [0, 1, 5, KEPT_IMPACTS - 1, KEPT_IMPACTS, KEPT_IMPACTS + 1, 3 * KEPT_IMPACTS + 7] {
            let mut recent = Recent::default();
            for index in 1..=count as u64 {
                let ball = Ball::exact(index as f64);
                let (mapping, precise, wall) = (None, None, Wall::Left);
                recent.keep(Impact { index, mapping, wall, turns: 0, phase: ball, velocity: ball, precise });
            }
            let kept: Vec<u64> = recent.in_order().iter().map(|impact| impact.index).collect();
            let first = count.saturating_sub(KEPT_IMPACTS) as u64 + 1;
            assert!(kept.iter().copied().eq(first..=count as u64), "{count}: {kept:?}");
        }
    }
}
