//! Where a flight leaves the gap: in doubles, as a guess, and proved of flights that no motion has (Lemma V8, motions).

use super::flight::{Flight, Part};
use super::number::Number;
use super::span::Span;
use impact_pair_exact::{Dyadic, Real};
use impact_pair_model::Wall;

/// Parts of a radian of the fastest harmonic in which a change of direction is sought.
const PARTS_OF_A_RADIAN: f64 = 10.0;
/// Most parts of a flight: flights of more than 1,000 forcing periods are looked at less closely.
const MAX_PARTS: f64 = 65_536.0;
/// First part of a flight that leaves its wall without a velocity [rad].
const SHORTEST_PART: f64 = 1e-3;
/// Growth of the parts of a flight after its departure.
const GROWTH: f64 = 1.25;
/// Halvings of a part for the phase at which the direction changes: as many as a double has bits.
const HALVINGS: u32 = 53;

/// Whether all flights are proved to lie beyond a wall at some phase before `end`. Any phase proves it; those at which the flight turns
/// around are tried.
pub(super) fn leaves_the_gap(flight: &Flight, end: &Real) -> bool {
    let Some(doubles) = flight.in_doubles(u64::MAX) else { return false };
    let length = end.to_f64();
    let parts = (length * PARTS_OF_A_RADIAN).ceil().clamp(1.0, MAX_PARTS); // proposes: where it is looked
    let at = |k: u32| length * f64::from(k) / parts;
    // proposes: whole numbers, small
    (0..parts as u32).filter_map(|k| turning(&doubles, at(k), at(k + 1))).any(|h| {
        let near = Span::point(h);
        if matches!(doubles.place(&doubles.height(&near)), Part::Clear) {
            return false; // exact: not proved there
        }
        Dyadic::from_f64(h).map(|h| Real::point(h, flight.bits())).is_some_and(|h| {
            let is_before = h.is_positive() && h.is_below(end);
            is_before && matches!(flight.place(&flight.height(&h)), Part::Contact)
        })
    })
}

/// The wall that a flight touches first, and its approximate phase; `None` where doubles do not tell. Non-rigorous.
pub(super) fn first_exit(flight: &Flight) -> Option<(Wall, Real)> {
    let doubles = flight.in_doubles(u64::MAX)?;
    let size = |x: Span| x.to_f64().abs();
    // The first parts are those of a short bounce.
    let bounce = size(doubles.velocity) / size(doubles.curvature(&Span::point(0.0)));
    let longest = 1.0 / PARTS_OF_A_RADIAN;
    // proposes
    let (mut from, mut part) = (0.0, if bounce > 0.0 { bounce.min(longest) } else { SHORTEST_PART });
    let mut clear = from;
    // proposes: a whole number, small
    for _ in 0..MAX_PARTS as u32 {
        let to = from + part;
        for h in turning(&doubles, from, to).into_iter().chain([to]) {
            match doubles.place(&doubles.height(&Span::point(h))) {
                Part::Clear => clear = h,
                Part::Contact => return contact(&doubles, clear, h, flight.bits()),
                Part::Open => return None,
            }
        }
        (from, part) = (to, (GROWTH * part).min(longest)); // proposes
    }
    None
}

/// The wall between a phase at which the flight is in the gap and a phase at which the flight is beyond, and the phase of the contact.
/// Non-rigorous.
fn contact(flight: &Flight<'_, Span>, mut clear: f64, mut beyond: f64, bits: u32) -> Option<(Wall, Real)> {
    let height = |h: f64| flight.height(&Span::point(h)).to_f64();
    let wall = if height(beyond) > 0.0 { Wall::Right } else { Wall::Left };
    let is_beyond = |h: f64| (height(h) > 0.0) == (wall == Wall::Right) && height(h).abs() > flight.half_gap.to_f64();
    for _ in 0..HALVINGS {
        let middle = 0.5 * (clear + beyond);
        *if is_beyond(middle) { &mut beyond } else { &mut clear } = middle;
    }
    Dyadic::from_f64(clear).map(|h| (wall, Real::point(h, bits)))
}

/// A phase between two others at which the middle of the flights turns around, if the directions at both differ. Non-rigorous.
fn turning(flight: &Flight<'_, Span>, from: f64, to: f64) -> Option<f64> {
    let slope = |h: f64| flight.slope(&Span::point(h)).to_f64();
    let is_forward = slope(from) > 0.0;
    if is_forward == (slope(to) > 0.0) {
        return None;
    }
    let (mut from, mut to) = (from, to);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        *if (slope(middle) > 0.0) == is_forward { &mut from } else { &mut to } = middle;
    }
    Some(from)
}
