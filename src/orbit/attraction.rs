//! At the end of an orbit: whether it is proved to converge to a periodic one. Lemmas Q1-Q3

use super::event::Outcome;
use super::{Arithmetic, Orbit};
use crate::periodic::{Attractor, LONGEST, Passing, Problem, find_attractor};

/// How many of the last impacts are kept.
const KEPT: usize = 1024;
const _: () = assert!(KEPT > LONGEST, "a period and the state after it");

/// The last impacts of an orbit.
#[derive(Clone, Debug, Default)]
pub(super) struct Recent {
    states: Vec<Passing>,
    /// Where the next one goes, once there are so many.
    next: usize,
}

impl Recent {
    /// Keeps an impact, in the place of the one [`KEPT`] impacts before.
    #[inline(always)]
    pub fn keep(&mut self, state: Passing) {
        match self.states.get_mut(self.next) {
            Some(oldest) => *oldest = state,
            None => self.states.push(state),
        }
        self.next = (self.next + 1) % KEPT;
    }

    /// Those kept, in order of time.
    fn in_order(&self) -> Vec<Passing> {
        let (late, early) = self.states.split_at(self.next.min(self.states.len()));
        [early, late].concat()
    }
}

impl Orbit {
    /// Proves, if it can, that an orbit all of whose asked impacts are listed converges to a stable periodic orbit; then
    /// its [`outcome`](Orbit::outcome) is [`Outcome::Attracted`]. Lemma Q3
    ///
    /// Nothing else changes, and nothing is proved where it fails. **Cost**: none for an orbit that has not come near
    /// one of its last 128 states, as chaotic ones mostly have not; milliseconds otherwise.
    ///
    /// ```
    /// use impact_pair::orbit::{Outcome, Settings};
    /// use impact_pair::scene::Scene;
    /// // Figure 12 does not start on a periodic orbit, but it comes to one.
    /// let scene = Scene::parse(r#"
    ///     excitation = { amplitude = 1, frequency = "pi", phase = 0 }
    ///     pair = { gap = 9.42497, restitution = 0.5 }
    ///     start = { time = 0, wall = "left", velocity = -12.56636 }"#)?;
    /// let mut orbit = scene.orbit(Settings::default())?;
    /// while orbit.next().is_some() {}
    /// orbit.seek_attractor();
    /// let Some(Outcome::Attracted(attractor)) = orbit.outcome() else { unreachable!() };
    /// assert_eq!((attractor.word.to_string().as_str(), attractor.cycles), ("P1 P2", 1));
    /// assert_eq!(attractor.orbit.symmetric, Some(true));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn seek_attractor(&mut self) {
        let is_whole = matches!(self.outcome, Some(Outcome::ImpactsReached | Outcome::TimeReached));
        if !is_whole || self.settings.arithmetic == Arithmetic::Float {
            return;
        }
        if let Some(attractor) = self.attractor() {
            self.outcome = Some(Outcome::Attracted(Box::new(attractor)));
        }
    }

    fn attractor(&self) -> Option<Attractor> {
        let problem = |word: &_, cycles| Problem::of(self.exact.clone(), self.pair, self.is_point, word, cycles).ok();
        find_attractor(&self.recent.in_order(), self.settings.digits, problem)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Ball;
    use crate::pair::Wall;

    #[test]
    fn the_last_impacts_are_kept_in_order() {
        for count in [0, 1, 5, KEPT - 1, KEPT, KEPT + 1, 3 * KEPT + 7] {
            let mut recent = Recent::default();
            for index in 1..=count as u64 {
                let ball = Ball::exact(index as f64);
                recent.keep(Passing { index, wall: Wall::Left, turns: 0, phase: ball, velocity: ball });
            }
            let kept: Vec<u64> = recent.in_order().iter().map(|state| state.index).collect();
            let first = count.saturating_sub(KEPT) as u64 + 1;
            assert!(kept.iter().copied().eq(first..=count as u64), "{count}: {kept:?}");
        }
    }
}
