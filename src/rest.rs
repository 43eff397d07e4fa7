//! Chatter that ends in rest, and release: beyond the paper.
//!
//! Told from the wall (mirrored, as a flight is), `z'' = 2 pi beta sin th`: the wall is pressed while `sin th < 0`, on
//! phases between 1/2 and 1. Lemmas Z1-Z3 of `docs/proofs.md`.

use std::cmp::Ordering;

use crate::number::{Ball, Enclosing, Number, kernel, up};
use crate::pair::{Reduced, Wall};

/// What [`accumulation`] wants of time at least, in turns, for each unit of the velocity before an impact.
pub(crate) fn haste(pair: &Reduced<Ball>) -> f64 {
    let (beta, rebound) = (pair.beta.mid(), pair.restitution.mid());
    let haste = 4.0 * rebound / (std::f64::consts::TAU * beta * (1.0 - rebound));
    // Where nothing shakes anything may rest; where nothing is lost only what is at rest.
    if beta == 0.0 { 0.0 } else { haste.min(f64::MAX) } // proposes: Z1 is proved where it says so
}

/// How long, in turns, chatter can last that begins with a bounce at `phase` and `velocity`, both of a whole set, the
/// velocity that after the impact.
///
/// `Some(t)`: within `t` turns infinitely many impacts follow, all on this wall, each slower than the one before, and
/// the ball is at rest from their accumulation on until its release (Lemma Z1). 0 for a ball that does not leave.
/// `None`: not proved.
pub fn accumulation(pair: &Reduced<Ball>, wall: Wall, phase: Ball, velocity: Ball) -> Option<f64> {
    // Lemmas Z1, Z2: what is not certainly shaken is not certainly pressed, nor released.
    if pair.beta.certain_sign() != Some(Ordering::Greater) {
        return None;
    }
    let (speed, rebound) = (velocity.mag(), pair.restitution.mag());
    let swing = pair.beta.turn() * pair.beta;
    // Twice what the greatest pressure would take if it were constant: most bounces are too fast for any window.
    let shortest = 4.0 * speed / (swing.mid() * (1.0 - rebound));
    if speed > 0.0 && (rebound >= 1.0 || shortest.partial_cmp(&0.5) != Some(Ordering::Less)) {
        return None;
    }
    // Z2: exactly at rest, exactly there
    if speed == 0.0 && phase.rad() == 0.0 && is_pressed_from(wall, phase.mid()) {
        return Some(0.0);
    }
    // Both roundings, of 2^-54 at most each, are taken in by the edges (Lemma Z1).
    let at = phase.mid() + wall.mirror_phase();
    let at = at - at.floor(); // Z1: rounding is in the edges
    let edge = up(phase.rad() + 2f64.powi(-52));
    let (first, last) = ((at - edge).next_down(), (at + edge).next_up());
    let press = -kernel::sin_cos(at).0;
    if !(first > 0.5 && last < 1.0 && press > 0.0) {
        return None;
    }
    // Z1: exactly at rest
    if speed == 0.0 {
        return Some(0.0);
    }
    // Any window will do that the sum fits into.
    let window = shortest / press;
    let end = (last + window).next_up();
    if end.partial_cmp(&1.0) != Some(Ordering::Less) {
        return None;
    }
    // |sin| rises to phase 3/4 and falls after it.
    let size = |phase: f64| Ball::new(-kernel::sin_cos(phase).0, kernel::SIN_COS_ERROR);
    let (one, two) = (size(first), size(end));
    let least = swing * if one.mid() < two.mid() { one } else { two };
    // Z1: the greater end
    let most = swing.mag() * if first <= 0.75 && end >= 0.75 { 1.0 } else { one.mag().max(two.mag()) };
    let least = (least.mid() - least.rad()).next_down();
    if least.partial_cmp(&0.0) != Some(Ordering::Greater) {
        return None;
    }
    duration(speed, rebound, (least, up(most)), window)
}

/// How long, in turns, chatter lasts at most that begins with a bounce at `speed`, while the pressure stays within `[least,
/// most]` for `window` turns (Lemma Z1); `None` where it is not proved to end in them.
pub(crate) fn duration(speed: f64, rebound: f64, (least, most): (f64, f64), window: f64) -> Option<f64> {
    // Lemma B1: each rounding, underflow included, is half a unit in the last place at most, so that one unit bounds it.
    let above = f64::next_up;
    let ratio = above(rebound * above(above(most / least).sqrt()));
    let room = (1.0 - ratio).next_down();
    let rate = (least * room).next_down();
    let height = above(above(speed * speed) / least);
    let time = above(2.0 * speed / rate);
    (room > 0.0 && rate > 0.0 && height < 1.0 && time <= window).then_some(time)
}

/// Whether the pressure begins exactly at `phase`: whether that is 1/2 in the mirror, decided before it is mirrored.
///
/// Lemma Z2: a ball at rest is pressed from then on; any earlier, however little, it still leaves.
pub(crate) fn is_pressed_from(wall: Wall, phase: f64) -> bool {
    // Exact (Sterbenz).
    let rest = phase - phase.round(); // Z2: exact
    match wall {
        Wall::Left => rest.abs() == 0.5, // Z2: exactly there
        Wall::Right => rest == 0.0,      // Z2: exactly there
    }
}

/// The whole turns to come and the phase, exactly, at which a ball that rests on `wall` at `phase` is released.
///
/// The phase is 0 on the left wall and -1/2 on the right one, where the mirrored sine turns positive (Lemma Z2).
pub fn release(wall: Wall, phase: f64) -> (i64, f64) {
    let mirrored = phase + wall.mirror_phase();
    (mirrored.floor() as i64 + 1, -wall.mirror_phase()) // Z2: the turn it lies in, inside the edges of Z1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(alpha: f64, restitution: f64) -> Reduced<Ball> {
        let alpha = Ball::exact(alpha);
        Reduced { alpha, beta: alpha * alpha.turn(), restitution: Ball::exact(restitution) }
    }

    #[test]
    fn a_slow_bounce_on_a_pressed_wall_ends_in_rest() {
        let pair = pair(0.1, 0.5);
        let bound = accumulation(&pair, Wall::Left, Ball::exact(-0.25), Ball::exact(1e-4)).unwrap();
        // Constant acceleration a = 2 pi beta would end after 2u/(a (1 - e)).
        let constant = 2e-4 / (std::f64::consts::TAU.powi(2) * 0.1 * 0.5);
        assert!(constant <= bound && bound < 1.01 * constant);
        assert!(accumulation(&pair, Wall::Left, Ball::exact(0.25), Ball::exact(1e-4)).is_none());
        assert!(accumulation(&pair, Wall::Right, Ball::exact(0.25), Ball::exact(1e-4)).is_some());
        assert!(accumulation(&pair, Wall::Left, Ball::exact(-0.25), Ball::exact(1.0)).is_none());
        assert!(accumulation(&pair, Wall::Left, Ball::new(-0.25, 0.26), Ball::exact(1e-4)).is_none());
    }

    #[test]
    fn nothing_ends_without_loss() {
        assert!(accumulation(&pair(0.1, 1.0), Wall::Left, Ball::exact(-0.25), Ball::exact(1e-4)).is_none());
        assert_eq!(accumulation(&pair(0.1, 1.0), Wall::Left, Ball::exact(-0.25), Ball::exact(0.0)), Some(0.0));
    }

    #[test]
    fn release_is_where_the_pressure_ends() {
        assert_eq!(release(Wall::Left, -0.25), (0, 0.0));
        assert_eq!(release(Wall::Left, 0.5), (1, 0.0));
        assert_eq!(release(Wall::Right, 0.25), (1, -0.5));
        assert_eq!(release(Wall::Right, 0.0), (1, -0.5));
        assert_eq!(release(Wall::Left, -0.5), (0, 0.0));
    }
}
