//! Boxes around the impacts of an orbit on grids of powers of two, and where the flights between them are cut: what
//! `Certificate.v` checks (`validation/coq/README.md`).

use std::f64::consts::{PI, TAU};

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive};

use super::flights::{Flight, Origin};
use crate::certificate::check::Real;
use crate::exact::{Dyadic, Enclosure};
use crate::pair::Wall;

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

/// Radii, in units of the grid, above which the grid becomes coarser, and what is left of them then.
const WIDE: f64 = 4096.0;
const FEW_BITS: f64 = 10.0;
/// Bits of the proof's arithmetic below the grid, and of the slack of a radius.
const SPARE_BITS: u32 = 20;
/// Covers what is of second order in the radii.
const MARGIN: f64 = 1.01;
/// Shorter flights turn at most once: their zeros of y' follow from the velocities at their ends.
const SHORT: f64 = 1e-3;

/// Zeros as near the ends of a flight as this are those of a departure or an arrival without velocity.
const ENDS: f64 = 1e-9;

/// The box of the start, with the finest grid, `2^-scale` or coarser.
pub(super) fn start(origin: &Origin, scale: u32) -> Box {
    let known = |scale| {
        let is_exact = |x: &Real| x.set().is_point() && x.middle().exponent() >= -i64::from(scale);
        let radius =
            |x: &Real| if is_exact(x) { 0.0 } else { x.set().width().scaled(i64::from(scale) - 1).to_f64_up() + 2.0 };
        (radius(&origin.phase), radius(&origin.velocity))
    };
    let scale = coarser(scale, known(scale).0.max(known(scale).1));
    let (rt, rv) = known(scale);
    Box { scale, t: grid(&origin.phase, scale), rt: rt.ceil(), v: grid(&origin.velocity, scale), rv: rv.ceil() }
}

/// The next leg from a box: radii by the mean value theorem, as far as doubles tell; the proof does not trust them.
pub(super) fn leg(flight: &Flight, from: &Box) -> Leg {
    let &Flight { sin, u, h, rate, restitution, .. } = flight;
    let tilt = sin[1] / rate;
    // d(th1, v1) by (A.7) in units without A and W; a tilted velocity hardly depends on the phase of arrival.
    let turned = sin[0] * h + u;
    let by_phase = [turned.abs() / rate.abs(), (tilt * turned - sin[0]).abs()];
    let by_speed = [(restitution * h / rate).abs(), (restitution * (1.0 - tilt * h)).abs()];
    let radii = |scale: u32| {
        let unit = f64::from(from.scale - scale);
        let (rt, rv) = ((from.rt + 1.0) * (-unit).exp2(), (from.rv + 1.0) * (-unit).exp2());
        let slack = 16.0 * f64::from(SPARE_BITS).exp2().recip();
        let [e, gap] = flight.spread.map(|spread| spread * f64::from(scale).exp2());
        let parameters = [
            (e * flight.before.abs() * h + gap) / rate.abs(),
            e * (flight.before * (1.0 - tilt * h)).abs() + gap * tilt.abs(),
        ];
        let spare = [4.0 + slack / rate.abs(), 4.0 + slack * tilt.abs()];
        let radius =
            |i: usize| (MARGIN * (by_phase[i] * rt + by_speed[i] * rv + non_negative(parameters[i])) + spare[i]).ceil();
        [radius(0), radius(1)]
    };
    let [rt, rv] = radii(from.scale);
    let scale = coarser(from.scale, rt.max(rv));
    let [rt, rv] = radii(scale);
    let arrival = Box { scale, t: grid(&flight.phases[1], scale), rt, v: grid(&flight.velocity, scale), rv };
    let size = f64::from(magnitude(&flight.phases[1])).max((u * h).abs().log2()).max(1.0).ceil() as u32;
    let bits = scale + SPARE_BITS + size;
    let coarse = 40 + size + (6.0 * (-rate.abs().log2()).max(0.0)).ceil() as u32 + nearness(flight);
    let [depart, approach] = cuts(flight);
    let at = |part: f64| {
        let part = Dyadic::from_f64(part).unwrap_or_else(Dyadic::zero);
        let length = flight.phases[1].clone() - &flight.phases[0];
        flight.phases[0].clone() + &(length * &Real::point(part, 64))
    };
    let depart = match flight.from {
        Some(_) => grid(&at(depart), scale),
        None => grid(&flight.phases[0], scale) - radius_at(from, scale),
    };
    let tilt = grid(&flight.tilt, scale);
    Leg {
        bits,
        coarse: coarse.min(bits),
        wall: flight.wall,
        arrival,
        depart,
        approach: grid(&at(approach), scale),
        tilt,
    }
}

/// NaN (an infinite unit times nothing) is nothing.
fn non_negative(x: f64) -> f64 {
    if x > 0.0 { x } else { 0.0 }
}

/// The radius of a box's phase and a little more, on a coarser grid.
fn radius_at(from: &Box, scale: u32) -> BigInt {
    let radius = (from.rt * (-f64::from(from.scale - scale)).exp2()).ceil() + 2.0;
    BigInt::from(radius as u64)
}

/// The scale that leaves a few bits of a radius that has become wide.
fn coarser(scale: u32, radius: f64) -> u32 {
    if radius > WIDE { scale - ((radius.log2() - FEW_BITS) as u32).min(scale) } else { scale }
}

/// By how many bits a box is too wide for what is printed of it; 0 for one that fits.
pub(super) fn excess(flight: &Flight, arrival: &Box) -> u32 {
    let room = |middle: &BigInt, [low, high]: &[Real; 2]| {
        let scaled = |end: &Dyadic| Enclosure::point(end.scaled(arrival.scale.into())).floor().unwrap_or_default();
        let (low, high) = (scaled(low.set().hi()) + 1, scaled(high.set().lo()));
        let below: BigInt = middle - low;
        below.min(high - middle)
    };
    let wanting = |room: BigInt, radius: f64| {
        let room = room.to_f64().unwrap_or(f64::MAX) - 2.0;
        if room >= radius { 0 } else { (radius / room.max(1.0)).log2().ceil().max(1.0) as u32 }
    };
    let [time, velocity] = &flight.printed;
    wanting(room(&arrival.t, time), arrival.rt).max(wanting(room(&arrival.v, velocity), arrival.rv))
}

/// The nearest point of a grid.
fn grid(x: &Real, scale: u32) -> BigInt {
    let doubled = x.middle().scaled(i64::from(scale) + 1);
    let floor = Enclosure::point(doubled).floor().unwrap_or_default();
    (floor + 1) >> 1
}

/// `log2 |x|`, rounded up.
fn magnitude(x: &Real) -> u32 {
    u32::try_from(x.set().mag().top().unwrap_or(0) + 1).unwrap_or(0)
}

/// Where the flight is cut, as parts of its length: 3/4 of the way to the first zero of `y'`, and as much before the last one;
/// in the middle if there is none. A flight from rest has departed while `y''` keeps its sign.
fn cuts(flight: &Flight) -> [f64; 2] {
    let zeros = zeros(flight);
    let depart = zeros.first().map_or(0.5, |first| 0.75 * first);
    let approach = zeros.last().map_or(0.5, |last| 1.0 - 0.75 * (1.0 - last));
    if flight.u == 0.0 {
        let bend = (PI - flight.turn.rem_euclid(PI)) / flight.h;
        let depart = depart.min(0.75 * bend);
        return [depart, approach.max(depart)];
    }
    [depart, approach]
}

/// The first and the last zero of `y'` strictly inside the flight, as parts of its length.
fn zeros(flight: &Flight) -> Vec<f64> {
    let &Flight { u, h, rate, .. } = flight;
    if h < SHORT {
        return if u * rate < 0.0 { vec![u / (u - rate)] } else { Vec::new() };
    }
    let begin = flight.turn;
    let level = u + begin.cos();
    if level.abs() > 1.0 {
        return Vec::new();
    }
    // cos th = c at +-a and whole turns.
    let a = level.acos();
    let mut zeros = Vec::new();
    for branch in [a, -a] {
        let first = branch + TAU * ((begin - branch) / TAU + ENDS).ceil();
        let last = branch + TAU * ((begin + h - branch) / TAU - ENDS).floor();
        zeros.extend(
            [first, last].into_iter().map(|zero| (zero - begin) / h).filter(|z| (ENDS..1.0 - ENDS).contains(z)),
        );
    }
    zeros.sort_by(f64::total_cmp);
    zeros
}

/// Bits that extrema near a wall take beyond those of ordinary flights.
fn nearness(flight: &Flight) -> u32 {
    let Flight { u, h, turn, height, half_gap, .. } = *flight;
    if h < SHORT {
        return 0;
    }
    let rise = |part: f64| {
        let x = part * h;
        height + turn.sin() - (turn + x).sin() + (u + turn.cos()) * x
    };
    let nearest = zeros(flight).into_iter().map(|zero| (half_gap - rise(zero).abs()).abs()).fold(1.0, f64::min);
    let turns = h / (2.0 * PI);
    // Beyond what doubles tell.
    if nearest < 1e-9 || turns > 2.0 { u32::MAX / 4 } else { (2.0 * -nearest.log2()).ceil() as u32 }
}

/// Whether a radius is an integer that can be written.
pub(super) fn is_sound(leg: &Leg) -> bool {
    let Box { rt, rv, t, v, .. } = &leg.arrival;
    rt.is_finite() && rv.is_finite() && !rt.is_negative() && !rv.is_negative() && t.bits() + v.bits() < 1 << 24
}
