//! Complete chatter, which ends in sticking, and release: beyond the paper.
//!
//! Measured from the wall (mirrored, as a flight is), `z'' = 2 pi beta sin th`: the contact force acts while `sin th < 0`, on
//! phases between 1/2 and 1. Lemmas Z1-Z3 of `docs/proofs/chatter.md#Z1`.

use std::cmp::Ordering;

use num_bigint::BigInt;

use crate::exact::{Dyadic, Enclosure};
use crate::number::interval::Interval;
use crate::number::{Ball, Enclosing};
use crate::pair::{Reduced, Wall};

/// The least time that [`accumulation`] needs, in forcing periods, for each unit of the velocity before an impact (gap widths per forcing
/// period).
pub(crate) fn min_chatter_time_per_speed(pair: &Reduced<Ball>) -> f64 {
    let (beta, rebound) = (pair.beta.mid(), pair.restitution.mid());
    let least = 4.0 * rebound / (std::f64::consts::TAU * beta * (1.0 - rebound));
    // Without excitation any bounce may end in rest; without loss only a ball without velocity.
    if beta == 0.0 { 0.0 } else { least.min(f64::MAX) } // proposes: Z1 is proved where it says so
}

/// The place of a set of phases in the half period during which the contact force on a wall acts.
#[derive(Debug)]
pub(crate) struct Pressed {
    /// Forcing periods since the contact force began, and until it ends, of all members.
    since: Interval,
    left: Interval,
    /// Whole forcing periods from phase 0 to the forcing period in which the contact force began.
    turns: BigInt,
}

/// A sum of no more bits than this is exact.
const EXACT_SUM_BITS: u32 = 1 << 30;

impl Pressed {
    /// `None` unless it is certain that the contact force acts at all phases, during the same half of a forcing period.
    ///
    /// Nothing is rounded before the half period is taken off: a phase `10^-300` inside is inside (Lemma Z1).
    pub fn on(wall: Wall, phase: &Enclosure) -> Option<Self> {
        let point = |x: Dyadic| Enclosure::point(x);
        let half = || point(Dyadic::power_of_two(-1));
        let begin = match wall {
            Wall::Left => half(),
            Wall::Right => point(Dyadic::zero()),
        };
        let since = phase.sub(&begin, EXACT_SUM_BITS);
        let turns = since.floor()?; // Z1: shared by all
        let since = since.sub(&point(Dyadic::new(turns.clone(), 0)), EXACT_SUM_BITS);
        let left = half().sub(&since, EXACT_SUM_BITS);
        let is_inside = since.sign().is_some_and(Ordering::is_ge) && left.sign() == Some(Ordering::Greater);
        is_inside.then(|| Self { since: Interval::enclosing(&since), left: Interval::enclosing(&left), turns })
    }

    /// Whether the contact force begins exactly at the phase: then it is 0.
    ///
    /// Lemma Z2: a ball at rest sticks from then on; any earlier, however little, the ball still leaves.
    pub fn is_at_its_begin(&self) -> bool {
        self.since == Interval::ZERO // Z2: exactly there
    }

    /// Whole forcing periods from phase 0 to the release, and the rest, exactly: 0 on the left wall, -1/2 on the right wall, where the mirrored
    /// sine becomes positive (Lemma Z2).
    pub fn release(&self, wall: Wall) -> Option<(i64, f64)> {
        Some((i64::try_from(&self.turns).ok()?.checked_add(1)?, -wall.mirror_phase())) // Z2: refused beyond
    }

    /// `|sin|` on all phases of the set and `window` forcing periods after each; `None` where the contact force may end before.
    fn sine(&self, window: f64) -> Option<Interval> {
        let window = Interval::new(0.0, window);
        let (since, left) = (self.since + window, self.left - window);
        if left.inf().partial_cmp(&0.0) != Some(Ordering::Greater) {
            return None;
        }
        // It rises for a quarter of a forcing period and falls after it: computed from the nearer end.
        let at = |since: f64, left: f64| sine(if since <= 0.25 { since } else { left });
        let ends = at(since.inf(), left.sup()).hull(at(since.sup(), left.inf()));
        // Z1: the top between both
        Some(if since.inf() <= 0.25 && left.inf() <= 0.25 { ends.hull(Interval::ONE) } else { ends })
    }
}

/// The sine at `phase` forcing periods, at most a quarter of one, to a few units in the last place of itself.
fn sine(phase: f64) -> Interval {
    let phase = Interval::point(phase);
    // Z1: `x (1 - x^2/6) <= sin x <= x`, and `(2 pi)^2/6 < 8`
    if phase.sup() < 2f64.powi(-20) {
        return Interval::TAU * phase * (Interval::ONE - phase.sqr().scaled(8.0)).hull(Interval::ONE);
    }
    phase.sin()
}

/// Upper bound of the duration, in forcing periods, of chatter after a bounce of a set; `velocity` is that after the impact.
///
/// `Some(t)`: within `t` forcing periods infinitely many impacts follow, all on this wall, each slower than the one before, and
/// the ball is at rest from their accumulation on until its release (Lemma Z1). 0 for a ball that does not leave.
/// `None`: not proved.
pub(crate) fn accumulation(pair: &Reduced<Ball>, pressed: &Pressed, velocity: Ball) -> Option<f64> {
    // Lemmas Z1, Z2: without certain excitation neither a contact force nor a release is certain.
    if pair.beta.certain_sign() != Some(Ordering::Greater) {
        return None;
    }
    let (speed, rebound) = (velocity.mag(), pair.restitution.mag());
    // Z1, Z2: exactly at rest, of any set with a contact force, or from there on
    if speed == 0.0 {
        return Some(0.0);
    }
    let beta = Interval::from(pair.beta);
    let amplitude = Interval::TAU * beta;
    // Twice the time under a constant contact force. Any window serves into which the sum fits.
    let now = amplitude * pressed.sine(0.0)?;
    let window = 4.0 * speed / (now.mid() * (1.0 - rebound));
    if rebound >= 1.0 || window.partial_cmp(&0.5) != Some(Ordering::Less) {
        return None;
    }
    duration(speed, rebound, amplitude * pressed.sine(window)?, window)
}

/// Upper bound of the duration, in forcing periods, of chatter after a bounce at `speed`, while the contact force stays within `pressure` for
/// `window` forcing periods (Lemma Z1); `None` if the chatter is not proved to end within `window`.
pub(crate) fn duration(speed: f64, rebound: f64, pressure: Interval, window: f64) -> Option<f64> {
    let [speed, rebound, least, most] = [speed, rebound, pressure.inf(), pressure.sup()].map(Interval::point);
    if least.inf().partial_cmp(&0.0) != Some(Ordering::Greater) {
        return None;
    }
    let room = Interval::ONE - rebound * most.checked_div(least)?.sqrt()?;
    let rate = least * room;
    let height = speed.sqr().checked_div(least)?;
    let time = (speed + speed).checked_div(rate)?;
    let is_proved = room.inf() > 0.0 && rate.inf() > 0.0 && height.sup() < 1.0 && time.sup() <= window;
    is_proved.then(|| time.sup())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Exact;

    fn pair(alpha: f64, restitution: f64) -> Reduced<Ball> {
        let alpha = Ball::exact(alpha);
        Reduced::new(alpha, Ball::exact(restitution))
    }

    fn enclosure(text: &str) -> Enclosure {
        Exact::parse(text).unwrap().enclose(2000)
    }

    fn rests(pair: &Reduced<Ball>, wall: Wall, phase: &str, velocity: f64) -> Option<f64> {
        accumulation(pair, &Pressed::on(wall, &enclosure(phase))?, Ball::exact(velocity))
    }

    #[test]
    fn a_slow_bounce_under_contact_force_ends_in_rest() {
        let pair = pair(0.1, 0.5);
        let bound = rests(&pair, Wall::Left, "-1/4", 1e-4).unwrap();
        // Constant acceleration a = 2 pi beta would end after 2u/(a (1 - e)).
        let constant = 2e-4 / (std::f64::consts::TAU.powi(2) * 0.1 * 0.5);
        assert!(constant <= bound && bound < 1.01 * constant);
        assert!(rests(&pair, Wall::Left, "1/4", 1e-4).is_none());
        assert!(rests(&pair, Wall::Right, "1/4", 1e-4).is_some());
        assert!(rests(&pair, Wall::Left, "-1/4", 1.0).is_none());
        assert!(rests(&pair, Wall::Left, "[-0.51, 0.01]", 1e-4).is_none());
    }

    /// The contact force is `(2 pi)^3 alpha x` if it began or ends `x` forcing periods away: the time is as long as under a constant one.
    #[test]
    fn chatter_is_proved_arbitrarily_near_to_the_ends_of_the_contact_force() {
        let pair = pair(0.1, 0.01);
        for k in (1..145).step_by(11) {
            for (wall, phase) in [
                (Wall::Left, format!("-1/2 + 1e-{k}/7")),
                (Wall::Left, format!("-1e-{k}/7")),
                (Wall::Right, format!("1e-{k}/7")),
                (Wall::Right, format!("1/2 - 1e-{k}/7")),
            ] {
                let distance = 10f64.powi(-k) / 7.0;
                let pressure = std::f64::consts::TAU.powi(2) * 0.1 * (std::f64::consts::TAU * distance).sin();
                let speed = 1e-3 * pressure * distance;
                let bound = rests(&pair, wall, &phase, speed).unwrap();
                let constant = 2.0 * speed / (pressure * 0.99);
                assert!((0.99..1.02).contains(&(bound / constant)), "{phase}: {bound} {constant}");
                // At this speed the chatter would outlast the contact force, at its end.
                let is_end = !phase.contains("+") && phase.contains("-1e") || phase.contains("1/2 - ");
                let fast = rests(&pair, wall, &phase, 2.0 * pressure * distance);
                assert!(!is_end || fast.is_none(), "{phase}");
            }
        }
    }

    /// Lemma Z1 bounds the contact force for the window only: a chatter that may last longer is not proved.
    #[test]
    fn chatter_is_proved_within_its_window_only() {
        for (speed, rebound) in [(1e-4, 0.5), (1e-3, 0.9), (1e-30, 0.0), (1e-2, 0.99)] {
            let pressure = Interval::new(7.0, 7.001);
            let long = duration(speed, rebound, pressure, f64::INFINITY).unwrap();
            // Under a constant contact force it takes 2u/(a (1 - e)).
            let [least, most] = [7.001, 7.0].map(|a| 2.0 * speed / (a * (1.0 - rebound)));
            assert!(least <= long * (1.0 + 1e-12) && long < most * 1.02, "{long} {least} {most}");
            assert_eq!(duration(speed, rebound, pressure, long), Some(long));
            assert_eq!(duration(speed, rebound, pressure, long.next_down()), None);
        }
    }

    #[test]
    fn nothing_ends_without_loss() {
        assert!(rests(&pair(0.1, 1.0), Wall::Left, "-1/4", 1e-4).is_none());
        assert_eq!(rests(&pair(0.1, 1.0), Wall::Left, "-1/4", 0.0), Some(0.0));
    }

    /// Lemma Z2: exactly at the beginning of the contact force a ball at rest stays, a little earlier it leaves.
    #[test]
    fn the_contact_force_begins_at_its_phase_and_not_before() {
        let at_rest = |wall, phase: &str| rests(&pair(0.1, 0.5), wall, phase, 0.0).is_some();
        for (wall, begin) in [(Wall::Left, "1/2"), (Wall::Left, "-1/2"), (Wall::Right, "0")] {
            assert!(at_rest(wall, begin));
            assert!(at_rest(wall, &format!("{begin} + 1e-300")) && !at_rest(wall, &format!("{begin} - 1e-300")));
        }
        for (wall, end) in [(Wall::Left, "0"), (Wall::Right, "1/2")] {
            assert!(!at_rest(wall, end));
            assert!(at_rest(wall, &format!("{end} - 1e-300")) && !at_rest(wall, &format!("{end} + 1e-300")));
        }
    }

    #[test]
    fn release_is_where_the_contact_force_vanishes() {
        let release = |wall, phase| Pressed::on(wall, &enclosure(phase)).and_then(|pressed| pressed.release(wall));
        assert_eq!(release(Wall::Left, "-1/4"), Some((0, 0.0)));
        assert_eq!(release(Wall::Left, "1/2"), Some((1, 0.0)));
        assert_eq!(release(Wall::Left, "-1/2"), Some((0, 0.0)));
        assert_eq!(release(Wall::Left, "-1e-300"), Some((0, 0.0)));
        assert_eq!(release(Wall::Right, "1/4"), Some((1, -0.5)));
        assert_eq!(release(Wall::Right, "0"), Some((1, -0.5)));
        assert_eq!(release(Wall::Right, "1/2 - 1e-300"), Some((1, -0.5)));
        assert_eq!(release(Wall::Right, "1/2"), None);
    }
}
