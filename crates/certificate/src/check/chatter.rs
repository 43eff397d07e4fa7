//! Chatter, rest and release (Lemma V3).

use super::contact::Doubt;
use super::step::{Launch, Parameters};
use impact_pair_exact::Real;
use impact_pair_model::Wall;

/// Number of windows tried: 2, 4, 8 and so on times the duration of the chatter under a constant contact force.
const WINDOWS: u32 = 8;

/// Time from the departure to the last of infinitely many impacts on the same wall \[rad\]; `None` where it is not proved.
///
/// With the contact force between `lo` and `hi` on a window, `rho = sqrt(hi/lo)`, a bounce that leaves with `u` lasts `2u/hi` to
/// `2u/lo` and lands with `u/rho` to `u rho`. If `e rho < 1` the sum of all durations lies between `2u/(hi (1 - e/rho))` and
/// `2u/(lo (1 - e rho))`; if the window holds that sum, all impacts occur, and then the ball is at rest.
pub(super) fn accumulation(departure: &Launch, parameters: &Parameters) -> Option<Real> {
    let wall = departure.start.wall?;
    let flight = departure.flights(parameters);
    let bits = flight.bits();
    let (one, e) = (Real::int(1, bits), parameters.restitution.hull());
    let inward = |x: Real| if wall == Wall::Left { x } else { -x };
    let u = inward(flight.velocity.clone());
    let twice = u.clone() + &u;
    let pressure = |h: &Real| -inward(flight.curvature(h));
    let lasting = |pressure: &Real, loss: &Real| twice.over(&((one.clone() - loss) * pressure));
    let upper = |x: &Real| Real::point(x.enclosure().sup().clone(), bits);
    let mut window = upper(&lasting(&pressure(&Real::zero(bits)), &e)?);
    for _ in 0..WINDOWS {
        window = window.clone() + &window;
        let pressure = pressure(&Real::zero(bits).hull(&window));
        let (lo, hi) = (Real::point(pressure.enclosure().inf().clone(), bits), upper(&pressure));
        if !lo.is_positive() || u.is_negative() {
            return None;
        }
        let rho = hi.over(&lo)?.sqrt()?;
        let (slowed, kept) = (e.over(&rho)?, e.clone() * &rho);
        if !kept.is_below(&one) {
            continue;
        }
        let (least, most) = (lasting(&hi, &slowed)?, lasting(&lo, &kept)?);
        let stays_low = (u.clone() * &u).over(&lo)?.half().is_below(&(flight.half_gap.clone() + &flight.half_gap));
        if most.is_below(&window) && stays_low {
            return Some(least.hull(&most));
        }
    }
    None
}

/// Whether the ball stays on its wall: its velocity is zero, and the contact force is positive.
///
/// With `is_first` a ball without velocity at a phase where the acceleration is 0 sticks from then on.
pub(super) fn is_held(departure: &Launch, parameters: &Parameters, is_first: bool) -> bool {
    let flight = departure.flights(parameters);
    let acceleration = flight.shaking.first_acceleration();
    let is_pressed = match departure.start.wall {
        Some(Wall::Left) => acceleration.is_negative(),
        Some(Wall::Right) => acceleration.is_positive(),
        None => return false,
    };
    flight.velocity.is_zero() && (is_pressed || is_first || flight.shaking.is_still())
}

/// Approximate duration of the next short bounce \[rad\]: twice the velocity over the contact force.
pub(super) fn bounce(departure: &Launch, parameters: &Parameters) -> Result<Real, Doubt> {
    let flight = departure.flights(parameters);
    let point = |x: &Real| Real::point(x.mid(), x.bits());
    let velocity = point(&flight.velocity);
    let doubled = velocity.clone() + &velocity;
    let pressure = -point(&flight.shaking.first_acceleration());
    doubled.over(&pressure).ok_or_else(|| Doubt::open("the contact force is not proved to be positive"))
}
