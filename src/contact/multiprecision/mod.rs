//! First contacts in multiprecision: isolated as cheaply as can be, refined to the requested bits.
//!
//! Nearly every contact of a set as narrow as 53 bits is isolated by the double-precision certificate. What it leaves open (grazes nearer than
//! `10^-13` of the gap, drifts near 0 or `beta`, flights beyond `2^39` forcing periods) is decided by the same lemmas in balls ([`isolate`]).
//! Either way one contact lies in a known bracket and [`refine`] only has to narrow the bracket: Lemma M3 of `docs/proofs/multiprecision.md#M3`.

mod graze;
mod isolate;
mod refine;
#[cfg(test)]
mod tests;

use super::bounds::{Bounds, Margins, Radii};
use super::certify::Bracket;
use super::extrema::Target;
use super::solve::propose;
use super::{Contact, PairBounds, Reason, Undecided};
use crate::flight::{Flight, Launch};
use crate::number::{ABOVE_TWO_PI, Ball, Float, Kernel, Magnitude, MpBall, UNIT, kernel};
use crate::pair::{Inward, Wall};
pub(crate) use graze::{Passed, pass};
pub(crate) use refine::Refined;

/// The first contacts of a set of flights, proved, in the frame of their start.
#[derive(Debug)]
pub(crate) struct Isolated {
    pub target: Target,
    /// Whole forcing periods between the start's phase and `at`.
    pub turns: f64,
    /// Phase, less the whole forcing periods, within `reach` of which the contact of each flight of the set lies.
    pub at: Float,
    pub reach: Magnitude,
    /// A lower bound of `|z'|` within `reach`, for each flight.
    pub least: Magnitude,
    /// Time since the start, over the set.
    pub time: Ball,
    /// Mirrored `z'` and sine on arrival, over the set.
    pub velocity: Ball,
    pub sin: Ball,
}

impl Isolated {
    /// The result of the double-precision certificate, if the certificate proves the sign of the velocity.
    fn new(Bracket { arrival, velocity, sin, .. }: Bracket, pair: &Margins) -> Option<Self> {
        // The velocity's ball holds `z'` over the bracket of the times of a hop; that of its phases is wider.
        let beyond = (arrival.phase.rad() - arrival.time.rad()).max(0.0); // M3: the phase bracket may be the narrower
        let least = velocity.mid().abs() - (velocity.rad() + 2.1 * pair.acceleration * beyond);
        (least > 0.0).then(|| Self {
            target: arrival.target,
            turns: arrival.turns,
            at: Float::new(arrival.phase.mid()),
            reach: Magnitude::new(arrival.phase.rad(), 0),
            // Three roundings.
            least: Magnitude::new(least * (1.0 - 8.0 * UNIT), 0),
            time: arrival.time,
            velocity,
            sin,
        })
    }

    /// The contacts over the set in doubles, out of the mirrored frame of flights measured from `near`.
    pub fn contact(&self, near: Wall) -> Contact<Ball> {
        Contact {
            wall: self.target.wall(near),
            turns: self.turns,
            phase: MpBall::new(self.at.clone(), self.reach).to_ball(),
            time: self.time,
            velocity: near.inward(self.velocity),
        }
    }
}

impl Flight<MpBall> {
    /// An upper bound of `2 pi beta`: `|z''|` is nowhere larger.
    pub(crate) fn steepest(&self) -> Magnitude {
        Magnitude::new(ABOVE_TWO_PI, 0) * self.beta.mag()
    }
}

/// Isolates the first contacts of all the flights of a set: `start` in doubles, `all` in balls.
///
/// A doubt that the flight of the `centre` does not share is the set's width's fault.
pub(crate) fn isolate_first(
    pair: &PairBounds,
    start: &Launch<Ball>,
    all: impl FnOnce() -> Flight<MpBall>,
    centre: &Flight<MpBall>,
) -> Result<Isolated, Undecided> {
    if let Some(isolated) = isolate_in_doubles(pair, start) {
        return Ok(isolated);
    }
    isolate::isolate(&all()).map_err(|doubt| match isolate::isolate(centre) {
        Ok(_) => Undecided { reason: Reason::Width, ..doubt },
        Err(_) => doubt,
    })
}

/// Isolates the contacts of the set in doubles; `None` where doubles do not.
fn isolate_in_doubles(pair: &PairBounds, start: &Launch<Ball>) -> Option<Isolated> {
    let flight = Flight::of(&pair.centre, start.map(|x| x.mid()), kernel::sin_cos(start.phase.mid()));
    // From inside Lemma C1 wants the rounding of the height.
    let height = if start.wall.is_some() { 0.0 } else { start.height.rad() + UNIT };
    let radii = Radii { phase: start.phase.rad(), velocity: start.velocity.rad(), height };
    let bracket = propose::<Kernel, _>(&flight, &Bounds::<true>::new(&flight, &pair.margins, radii)).ok()?;
    Isolated::new(bracket, &pair.margins)
}
