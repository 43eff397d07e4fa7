//! Bounds that are printed, within those of a proof: Lemma P1 of `docs/proofs/printing.md#P1`.

use std::f64::consts::TAU;

use crate::exact::Enclosure;
use crate::number::{Ball, Enclosing, Number};

/// Bounds of a phase in radians, in the first forcing period or next to it, and of a speed over `A W`.
pub type StateBounds = [Enclosure; 2];

/// A lower bound of the members of a ball.
pub(super) fn low(x: Ball) -> f64 {
    (x.mid() - x.rad()).next_down()
}

/// An upper bound of the members of a ball.
pub(super) fn high(x: Ball) -> f64 {
    (x.mid() + x.rad()).next_up()
}

/// The ball widened by more than printing adds: a hundredth of its radius (Lemma P1).
fn printed(x: Ball) -> Ball {
    x.widened(x.rad() / 64.0)
}

/// Whether the ends of a ball are positive and differ by less than a tenth, so that a change of units changes relative widths of printed bounds
/// by less than a quarter. Lemma J13
pub(super) fn is_narrow(x: Ball) -> bool {
    low(x) > 0.0 && high(x) < 1.1 * low(x)
}

/// Whether a ball, widened as by printing, is within a domain.
pub(super) fn is_within(x: Ball, domain: Ball) -> bool {
    printed(x).is_interior_to(&domain)
}

/// A ball that is still between two numbers when widened as by printing.
pub(super) fn between(a: f64, b: f64) -> Option<Ball> {
    let ball = Ball::new(0.5 * (a + b), 31.0 / 64.0 * (b - a)); // proposes
    let wider = printed(ball);
    (ball.rad() > 0.0 && a < low(wider) && high(wider) < b && is_narrow(wider)).then_some(ball)
}

/// Bounds of states, phases less whole forcing periods; `None` where a state, widened as by printing, is not within its domain.
pub(super) fn states(all: impl Iterator<Item = [(Ball, Ball); 2]>) -> Option<Vec<StateBounds>> {
    let bounds = |[(phase, phases), (speed, speeds)]: [(Ball, Ball); 2]| {
        let turns = phase.turn() * Ball::exact((phase.mid() / TAU).floor()); // proposes: a whole number
        let own = phase - turns;
        let is_inside = (printed(own) + turns).is_interior_to(&phases) && is_within(speed, speeds);
        is_inside.then_some(())?;
        Some([own.as_enclosure()?, speed.as_enclosure()?])
    };
    all.map(bounds).collect()
}
