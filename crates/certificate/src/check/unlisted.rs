//! Motions that are followed without a list of their events, past rests (Lemma V42).

use std::cmp::Ordering;

use super::chatter::{accumulation, is_held};
use super::contact::Doubt;
use super::data::Data;
use super::rest::Rest;
use super::standing::Last;
use super::step::Landing;
use super::walk::Walk;

/// A motion at an impact, a release or its start, and the numbers that a list may give to its impacts: of each complete chatter a list has
/// as many bounces as its maker chose.
pub(super) struct Unlisted<'c> {
    pub walk: Walk<'c>,
    /// The rest that the ball comes to without meeting another wall.
    rest: Option<Rest>,
    /// Number of impacts without any bounce that a list may leave out.
    least: u64,
    /// True after a complete chatter: a list may count more than `least` impacts.
    is_free: bool,
    /// Whether the last impact was on the wall of the impact before, and whether any impact was.
    is_bouncing: bool,
    has_bounced: bool,
    /// Number of impacts before the chatter, if the ball is in a chatter that is proved to be complete.
    before_chatter: Option<u64>,
}

impl<'c> Unlisted<'c> {
    /// The motion from the start of the walk.
    pub fn new(walk: Walk<'c>) -> Self {
        let mut motion = Self {
            walk,
            rest: None,
            least: 0,
            is_free: false,
            is_bouncing: true,
            has_bounced: false,
            before_chatter: None,
        };
        motion.look_for_rest();
        motion
    }

    /// The rest that the ball comes to: at once, or after infinitely many bounces.
    pub fn rest(&self) -> Option<&Rest> {
        self.rest.as_ref()
    }

    /// Whether infinitely many bounces come before the rest.
    pub fn is_chatter(&self) -> bool {
        self.before_chatter.is_some()
    }

    /// Whether a complete chatter came before: a list may have any number of its bounces.
    pub fn is_free(&self) -> bool {
        self.is_free
    }

    /// Whether a wall was hit twice in a row: there may have been a chatter whose bounces a list has not.
    pub fn has_bounced(&self) -> bool {
        self.has_bounced
    }

    /// Whether a list may number the next impact so.
    pub fn may_be_next(&self, index: u64) -> bool {
        let next = self.least + 1;
        if self.is_free { next <= index } else { next == index }
    }

    /// Whether a list may have this number of impacts up to here, with as many of the bounces of a complete chatter as it takes.
    pub fn may_count(&self, impacts: u64) -> bool {
        self.least == impacts || (self.is_free || self.is_chatter()) && self.least <= impacts
    }

    /// The least number of impacts that a list may have up to here.
    pub fn least(&self) -> u64 {
        self.least
    }

    /// Encloses the next impact: in a chatter the next bounce.
    pub fn next_landing(&self) -> Option<Landing> {
        match self.rest() {
            Some(rest) if self.is_chatter() => self.walk.bounce(self.walk.standing.departure(), rest.wall).ok(),
            _ => self.walk.next_landing(),
        }
    }

    /// Goes on with the next impact.
    pub fn go_on(&mut self, landing: Landing) {
        self.is_bouncing = self.walk.standing.last() == Last::Wall(landing.wall);
        self.has_bounced |= self.is_bouncing;
        self.walk.go_on(landing);
        self.least += 1;
        self.look_for_rest();
    }

    /// Goes on with the release after the rest.
    pub fn leave(&mut self, rest: &Rest) -> Result<(), Doubt> {
        self.walk.leave(rest)?;
        if let Some(before) = self.before_chatter.take() {
            (self.least, self.is_free) = (before, true);
        }
        self.is_bouncing = false;
        self.rest = None;
        Ok(())
    }

    /// Looks whether the ball is held where it is, or in a complete chatter. Lemma V3
    fn look_for_rest(&mut self) {
        let Walk { standing, parameters, .. } = &self.walk;
        let departure = standing.departure();
        let Some(wall) = departure.start.wall else { return };
        let since = departure.phase.hull();
        if departure.velocity.hull().is_zero() {
            let begins = standing.start().and_then(Data::inward_jerk) == Some(Ordering::Less);
            self.rest = is_held(departure, parameters, begins).then_some(Rest { wall, since, begins });
        } else if self.is_bouncing && self.walk.bounces() {
            let Some(lasting) = accumulation(departure, parameters) else { return };
            self.rest = Some(Rest { wall, since: since + &lasting, begins: false });
            self.before_chatter.get_or_insert(self.least);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Certificate;
    use crate::check::{Data, Piece};
    use impact_pair_model::Wall;
    use serde_json::json;

    fn certificate(restitution: &str, velocity: &str) -> Certificate {
        let document = json!({
            "schema": "impact-pair/orbit/1", "certified": true, "events": [], "outcome": {"kind": "impacts-reached", "impacts": 0},
            "scene": {
                "excitation": {"amplitude": ["0.812"], "frequency": ["7.26"], "phase": ["0"]},
                "gap": "6", "restitution": restitution, "start": {"time": "0.1", "wall": "right", "velocity": velocity},
            },
        });
        Certificate::parse(&document.to_string()).unwrap()
    }

    /// From its start the ball is in a chatter: its bounces have their numbers until the release, and none after it.
    #[test]
    fn v42_numbers_are_free_after_a_chatter() {
        let certificate = certificate("0.3", "0.02");
        let data = Data::new(certificate.pair(), certificate.start()).unwrap();
        let mut motion = Unlisted::new(Walk::new(&certificate, &data, &Piece::default(), 192));
        assert!(motion.is_chatter() && !motion.is_free() && motion.may_count(0) && motion.may_count(100));
        for bounce in 1..=3 {
            assert!(motion.may_be_next(bounce) && !motion.may_be_next(bounce + 1) && !motion.may_be_next(bounce - 1));
            let landing = motion.next_landing().unwrap();
            assert_eq!(landing.wall, Wall::Right);
            motion.go_on(landing);
        }
        assert!(!motion.may_count(2) && motion.may_count(3) && motion.has_bounced());
        let rest = motion.rest().unwrap().clone();
        motion.leave(&rest).unwrap();
        assert!(motion.is_free() && !motion.is_chatter() && motion.least() == 0 && motion.rest().is_none());
        assert!(!motion.may_be_next(0) && motion.may_be_next(1) && motion.may_be_next(17) && motion.may_count(5));
        let landing = motion.next_landing().unwrap();
        assert_eq!(landing.wall, Wall::Left);
        motion.go_on(landing);
        assert!(!motion.may_be_next(1) && motion.may_be_next(2) && !motion.may_count(0));
    }

    /// A ball that is held without any bounce leaves the numbers as they are.
    #[test]
    fn v42_a_ball_that_is_held_hides_no_bounce() {
        let certificate = certificate("0", "1.74");
        let data = Data::new(certificate.pair(), certificate.start()).unwrap();
        let mut motion = Unlisted::new(Walk::new(&certificate, &data, &Piece::default(), 192));
        let rest = motion.rest().unwrap().clone();
        assert!(!motion.is_chatter() && motion.may_count(0) && !motion.may_count(1));
        motion.leave(&rest).unwrap();
        assert!(!motion.is_free() && motion.may_be_next(1) && !motion.may_be_next(2));
    }
}
