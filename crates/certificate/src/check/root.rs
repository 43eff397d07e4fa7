//! The contact of a single flight, in all bits of the flight (Lemma V1).

use super::contact::{cut, is_halved, known_bits};
use super::flight::Flight;
use impact_pair_exact::Real;
use impact_pair_model::Wall;

/// Bits that a step of Newton's iteration loses of twice the bits before, at least.
const LEAST_LOSS: u32 = 8;

/// A contact of a flight.
pub(super) struct Root<'w> {
    /// The flight, whose sines at `near` are known.
    pub flight: Flight<'w>,
    /// A point near the contact.
    pub near: Real,
    /// Encloses the contact.
    pub contact: Real,
}

/// Encloses the contact with `wall` of a single flight, the only one in a bracket, by interval Newton. Each step doubles the known bits of
/// the contact, and takes no more bits than that. The point near it is known half as well, or as well if `is_sharp`.
pub(super) fn root<'w>(flight: &Flight<'w>, wall: Wall, bracket: &Real, is_sharp: bool) -> Root<'w> {
    let most = flight.bits();
    let (mut contact, mut known) = (bracket.clone(), known_bits(bracket));
    let (mut before, mut loss) = (0, LEAST_LOSS);
    loop {
        let bits = match step_bits(most, known, loss) {
            bits if bits <= before => most.min(2 * before), // proposes: more bits in each step
            bits => bits,
        };
        let near = Real::point(contact.mid(), bits);
        let flight = flight.rounded(bits).known_at(&near);
        let narrower = cut(&flight, wall, &contact.at(bits), &near);
        let goes_on = is_sharp && is_halved(&narrower, &contact);
        contact = narrower;
        if bits == most && !goes_on {
            return Root { flight, near, contact };
        }
        known = known_bits(&contact);
        (before, loss) = (bits, loss.max(bits.saturating_sub(known) + LEAST_LOSS)); // proposes
    }
}

/// Bits of the next step: those from which steps of twice the bits, less the loss, lead to `most`.
fn step_bits(most: u32, known: u32, loss: u32) -> u32 {
    let enough = 2 * known.max(2 * loss); // proposes
    let mut bits = most;
    while bits > enough {
        bits = bits / 2 + loss;
    }
    bits
}
