//! Boxes around the impacts of an orbit on grids of powers of two, and the cuts of the flights between them, as `Certificate.v`
//! checks them (`validation/coq/README.md`).

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive};

use super::flights::{Flight, Origin};
use impact_pair_exact::{Dyadic, Enclosure, Real};
use impact_pair_model::Wall;

/// A box `|th - t| <= rt`, `|v/(A W) - v| <= rv`, all in units of `2^-scale`.
#[derive(Clone, Debug)]
pub(super) struct Box {
    pub scale: u32,
    pub t: BigInt,
    pub rt: f64,
    pub v: BigInt,
    pub rv: f64,
}

/// A flight with the box of the impact that ends it.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    pub bits: u32,
    pub coarse: u32,
    pub wall: Wall,
    pub arrival: Box,
    pub depart: BigInt,
    pub approach: BigInt,
    pub tilt: BigInt,
}

/// Radius, in units of the grid, above which the grid becomes coarser, and log2 of the radius on the coarser grid.
const COARSENING_RADIUS: f64 = 4096.0;
const COARSENED_BITS: f64 = 10.0;
/// Bits of the proof's arithmetic below the grid, and of the slack of a radius.
const SPARE_BITS: u32 = 20;
/// Factor that covers terms of second order in the radii.
const MARGIN: f64 = 1.01;
/// Least number of bits by which terms of second order in a box are smaller than those of first order: [`MARGIN`] covers a part of `2^-8`.
const NEARLY_LINEAR: f64 = 8.0;

/// The box of the start on a grid of step `2^-scale`, or on the finest coarser grid that serves.
pub(super) fn start(origin: &Origin, scale: u32) -> Box {
    let known = |scale| {
        let is_exact = |x: &Real| x.enclosure().is_point() && x.mid().exponent() >= -i64::from(scale);
        let radius = |x: &Real| {
            if is_exact(x) { 0.0 } else { x.enclosure().wid().scaled(i64::from(scale) - 1).to_f64_up() + 2.0 }
        };
        (radius(&origin.phase), radius(&origin.velocity))
    };
    let scale = coarser(scale, known(scale).0.max(known(scale).1));
    let (rt, rv) = known(scale);
    Box { scale, t: grid(&origin.phase, scale), rt: rt.ceil(), v: grid(&origin.velocity, scale), rv: rv.ceil() }
}

/// The next leg after a box.
pub(super) fn leg(flight: &Flight, from: &Box) -> Leg {
    let [rt, rv] = radii(flight, from, from.scale);
    let scale = coarser(from.scale, rt.max(rv));
    let [rt, rv] = radii(flight, from, scale);
    let arrival = Box { scale, t: grid(&flight.phases[1], scale), rt, v: grid(&flight.velocity, scale), rv };
    let [bits, coarse] = precisions(flight, scale);
    let [depart, approach] = flight.cuts.map(|part| {
        let part = Dyadic::from_f64(part).unwrap_or_else(Dyadic::zero);
        let length = flight.phases[1].clone() - &flight.phases[0];
        grid(&(flight.phases[0].clone() + &(length * &Real::point(part, 64))), scale)
    });
    let depart = match flight.from {
        Some(_) => depart,
        // A start inside the gap is clear of the walls from its first phase on.
        None => grid(&flight.phases[0], scale) - radius_at(from, scale),
    };
    Leg { bits, coarse, wall: flight.wall, arrival, depart, approach, tilt: grid(&flight.tilt, scale) }
}

/// Radii of the box of arrival in units of `2^-scale`, by (A.7) in units without A and W, in doubles: not trusted by the proof. Velocities
/// are taken minus the tilt times the height, and so hardly depend on the phase of arrival.
fn radii(flight: &Flight, from: &Box, scale: u32) -> [f64; 2] {
    let &Flight { bend, u, h, rate, restitution, before, spread, unknown: [place, speed], .. } = flight;
    let tilt = bend[1] / rate;
    let turned = bend[0] * h + u;
    let by_phase = [turned.abs() / rate.abs(), (tilt * turned - bend[0]).abs()];
    let by_speed = [(restitution * h / rate).abs(), (restitution * (1.0 - tilt * h)).abs()];
    let shrunk = (-f64::from(from.scale - scale)).exp2();
    let (rt, rv) = ((from.rt + 1.0) * shrunk, (from.rv + 1.0) * shrunk);
    // The parts of the radii from intervals of e, d/A and the other harmonics; 0 for data that are points, however fine the grid.
    let [e, gap, place, speed] = [spread[0], spread[1], place, speed]
        .map(|spread| if spread > 0.0 { spread * f64::from(scale).exp2() } else { 0.0 });
    let off = gap + 2.0 * place + speed * h;
    let by_data = [
        (e * before.abs() * h + off) / rate.abs(),
        e * (before * (1.0 - tilt * h)).abs() + 2.0 * speed + off * tilt.abs(),
    ];
    let slack = 16.0 * (-f64::from(SPARE_BITS)).exp2();
    let spare = [4.0 + slack / rate.abs(), 4.0 + slack * tilt.abs()];
    [0, 1].map(|i| (MARGIN * (by_phase[i] * rt + by_speed[i] * rv + by_data[i]) + spare[i]).ceil())
}

/// The precision of the proof, and a lower precision that suffices for its coarse parts.
fn precisions(flight: &Flight, scale: u32) -> [u32; 2] {
    let &Flight { u, h, rate, reach, nearness, .. } = flight;
    let size = f64::from(magnitude(&flight.phases[1])).max((u * h).abs().log2()).max(1.0);
    let size = (size + reach.log2().max(0.0)).ceil() as u32;
    let bits = scale + SPARE_BITS + size;
    let coarse = 40 + size + (6.0 * (-rate.abs().log2()).max(0.0)).ceil() as u32 + nearness;
    [bits, coarse.min(bits)]
}

/// The radius of a box's phase plus a small margin, on a coarser grid.
fn radius_at(from: &Box, scale: u32) -> BigInt {
    let radius = (from.rt * (-f64::from(from.scale - scale)).exp2()).ceil() + 2.0;
    BigInt::from(radius as u64)
}

/// The scale of a coarser grid on which a large radius has about `COARSENED_BITS` bits.
fn coarser(scale: u32, radius: f64) -> u32 {
    if radius > COARSENING_RADIUS { scale - ((radius.log2() - COARSENED_BITS) as u32).min(scale) } else { scale }
}

/// Bits by which a box is too wide, for the printed bounds or for terms of second order; 0 for a box that fits.
pub(super) fn excess(flight: &Flight, arrival: &Box) -> u32 {
    let room = |middle: &BigInt, [low, high]: &[Real; 2]| {
        let scaled = |end: &Dyadic| Enclosure::point(end.scaled(arrival.scale.into())).floor().unwrap_or_default();
        let (low, high) = (scaled(low.enclosure().sup()) + 1, scaled(high.enclosure().inf()));
        let below: BigInt = middle - low;
        below.min(high - middle)
    };
    let wanting = |room: BigInt, radius: f64| {
        let room = room.to_f64().unwrap_or(f64::MAX) - 2.0;
        if room >= radius { 0 } else { (radius / room.max(1.0)).log2().ceil().max(1.0) as u32 }
    };
    let [time, velocity] = &flight.printed;
    let curved = (2.0 * arrival.rt * (1.0 + (flight.bend[1] / flight.rate).abs()) / flight.rate.abs()).log2();
    let curved = (curved - f64::from(arrival.scale) + NEARLY_LINEAR).ceil().max(0.0) as u32;
    curved.max(wanting(room(&arrival.t, time), arrival.rt)).max(wanting(room(&arrival.v, velocity), arrival.rv))
}

/// The nearest point of a grid.
fn grid(x: &Real, scale: u32) -> BigInt {
    let doubled = x.mid().scaled(i64::from(scale) + 1);
    let floor = Enclosure::point(doubled).floor().unwrap_or_default();
    (floor + 1) >> 1
}

/// `log2 |x|`, rounded up.
fn magnitude(x: &Real) -> u32 {
    u32::try_from(x.enclosure().mag().top().unwrap_or(0) + 1).unwrap_or(0)
}

/// Whether the radii are nonnegative numbers, and the box is short enough to be written.
pub(super) fn is_sound(leg: &Leg) -> bool {
    let Box { rt, rv, t, v, .. } = &leg.arrival;
    rt.is_finite() && rv.is_finite() && !rt.is_negative() && !rv.is_negative() && t.bits() + v.bits() < 1 << 24
}
