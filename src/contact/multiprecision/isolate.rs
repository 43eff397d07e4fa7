//! The first contact of a set of flights, isolated in balls: Lemmas E1, C3, C4 and C5 without error bounds made by hand.

use std::cmp::Ordering;

use rug::Float;

use super::Isolated;
use crate::contact::extrema::Target;
use crate::contact::solve::inverse_smoothstep;
use crate::contact::{Reason, Undecided};
use crate::flight::Flight;
use crate::number::{Ball, Magnitude, MpBall, Number};

/// Flights of more turns are not followed: turns are counted in doubles, exactly.
const LONGEST_FLIGHT: f64 = (1_u64 << 52) as f64;

/// Where the solver looks: times since the start.
struct Piece {
    target: Target,
    /// When the extremum comes that ends the piece; `None` for a monotone flight.
    end: Option<MpBall>,
    /// The contact lies in between, and about here.
    between: (Float, Float),
    guess: Float,
}

/// Encloses the only contact that is first for every flight of the set.
pub(super) fn isolate(flight: &Flight<MpBall>) -> Result<Isolated, Undecided> {
    let rising = is_rising(flight)?;
    let zero = MpBall::from_f64(0.0);
    let speeds = [flight.drift.clone() - flight.beta.clone(), flight.drift.clone() + flight.beta.clone()];
    // Lemma C5: a start without velocity at exactly sin th0 = 0 has |c| = beta and is monotone all the same.
    let is_release = [&flight.velocity, &flight.sin].iter().all(|x| x.sign() == Some(Ordering::Equal));
    let piece = match speeds.map(|x| x.sign()) {
        _ if is_release => monotone(flight)?,
        [Some(Ordering::Less), Some(Ordering::Greater)] => first_piece(flight, rising)?,
        [Some(Ordering::Greater), _] | [_, Some(Ordering::Less)] => monotone(flight)?,
        _ => return Err(graze(flight, None, zero)),
    };
    let turns = (flight.phase.mid().to_f64() + piece.guess.to_f64()).round();
    if turns.partial_cmp(&LONGEST_FLIGHT) != Some(Ordering::Less) {
        return Err(endless(flight));
    }
    let found = solve(flight, &piece, turns)?;
    if let Some(end) = &piece.end {
        // Between the extremum before last of its kind and the last; the sign of z' says on which piece (Lemma C4).
        let time = MpBall::new(found.at.clone(), found.reach) + MpBall::from_f64(turns) - flight.phase.clone();
        let is_later = (time.clone() - (end.clone() - MpBall::from_f64(1.0))).sign() == Some(Ordering::Greater);
        if !(is_later && (time.clone() - end.clone()).sign() == Some(Ordering::Less)) {
            return Err(graze(flight, Some(piece.target), time));
        }
    }
    Ok(found)
}

/// Whether the ball rises right after the start.
fn is_rising(flight: &Flight<MpBall>) -> Result<bool, Undecided> {
    let direction = match flight.velocity.sign() {
        Some(Ordering::Equal) => flight.sin.sign(),
        sign => sign,
    };
    match direction {
        Some(Ordering::Greater) => Ok(true),
        Some(Ordering::Less) if !flight.height.mid().is_zero() => Ok(false),
        // On release the next derivative decides, which has the sign of cos th0.
        Some(Ordering::Equal) if flight.cos.sign() == Some(Ordering::Greater) => Ok(true),
        Some(_) => Err(rest(flight)),
        None => Err(graze(flight, Some(Target::Near), MpBall::from_f64(0.0))),
    }
}

/// The drift carries the ball to its wall without turning.
fn monotone(flight: &Flight<MpBall>) -> Result<Piece, Undecided> {
    let target = match flight.drift.sign() {
        Some(Ordering::Greater) => Target::Far,
        Some(Ordering::Less) => Target::Near,
        _ => return Err(endless(flight)),
    };
    let start = flight.height.clone() - MpBall::from_f64(target.height());
    let base = flight.alpha.clone().mul_add(flight.sin.clone(), start);
    let quotient =
        |x: MpBall| x.checked_div(flight.drift.clone()).map(|x| x.mid().clone()).ok_or_else(|| endless(flight));
    let mean = quotient(-base)?;
    let spread = quotient(flight.alpha.clone())?.abs();
    let guess = mean.clone().max(&Float::new(53));
    Ok(Piece { target, end: None, between: (mean.clone() - &spread, mean + spread), guess })
}

/// The piece of the first contact of a flight that turns (Lemma E1).
fn first_piece(flight: &Flight<MpBall>, rising: bool) -> Result<Piece, Undecided> {
    let one = || MpBall::from_f64(1.0);
    let zero = || MpBall::from_f64(0.0);
    let q = flight.drift.clone().checked_div(flight.beta.clone()).ok_or_else(|| endless(flight))?;
    let p = q.acos();
    let sine = p.sin_cos().0;
    let double = p.clone() + p.clone();
    let mirrored = flight.phase.clone() + MpBall::from_f64(flight.wall.mirror_phase());
    let whole = if rising { mirrored.mid().clone().floor() } else { mirrored.mid().clone().round() };
    let start = mirrored - MpBall::exact(whole);
    let (first_max, first_min) = if rising {
        let first_max = one() - p - start;
        (first_max.clone(), first_max + double.clone())
    } else {
        let first_min = p - start;
        (first_min.clone() + (one() - double.clone()), first_min)
    };
    let height =
        |time: &MpBall, sine: MpBall| flight.height_above(zero(), zero(), flight.phase.clone() + time.clone(), sine);
    // How far extremum 0 is inside the gap, and what each turn takes off.
    let to_far = one() - height(&first_max, -sine.clone());
    let to_near = height(&first_min, sine.clone());
    let far = (Target::Far, first_max, to_far, one() - double.clone());
    let near = (Target::Near, first_min, to_near, double);
    let touches = |(target, time, room, _): &(Target, MpBall, MpBall, MpBall)| match room.sign() {
        Some(Ordering::Greater) => Ok(false),
        Some(Ordering::Less) => Ok(true),
        _ => Err(graze(flight, Some(*target), time.clone())),
    };
    let (soon, late) = if rising { (&far, &near) } else { (&near, &far) };
    let ((target, first, room, span), k) = if touches(soon)? {
        (soon, 0.0)
    } else if touches(late)? {
        (late, 0.0)
    } else {
        let (kind, step) = match flight.drift.sign() {
            Some(Ordering::Greater) => (&far, flight.drift.clone()),
            Some(Ordering::Less) => (&near, -flight.drift.clone()),
            _ => return Err(endless(flight)),
        };
        (kind, crossing(flight, kind.0, &kind.1, &kind.2, &step)?)
    };
    let k = MpBall::from_f64(k);
    let end = first.clone() + k.clone();
    // How far the extremum lies beyond the wall, as a fraction of the way that the piece makes.
    let beyond = flight.drift.clone().signed(target.direction()).mul_add(k, -room.clone());
    let way = flight.drift.clone().signed(target.direction()) * span.clone();
    let way = (flight.alpha.clone() + flight.alpha.clone()).mul_add(sine, way);
    let fraction = beyond.mid().clone() / way.mid();
    let from_end = inverse_smoothstep(fraction.to_f64());
    let guess = end.mid() - span.mid().clone() * from_end;
    let begin = end.mid().clone() - span.mid();
    Ok(Piece { target: *target, between: (begin, end.mid().clone()), guess, end: Some(end) })
}

/// The number of the first extremum beyond the wall, when each comes nearer by `step` and number 0 has `room` left.
fn crossing(
    flight: &Flight<MpBall>,
    target: Target,
    first: &MpBall,
    room: &MpBall,
    step: &MpBall,
) -> Result<f64, Undecided> {
    let ratio = Float::with_val(room.bits(), room.mid() / step.mid());
    let k = ratio.ceil().to_f64().max(1.0);
    if k.partial_cmp(&LONGEST_FLIGHT) != Some(Ordering::Less) {
        return Err(endless(flight));
    }
    let left = |k: f64| (room.clone() - step.clone() * MpBall::from_f64(k)).sign();
    for (number, side) in [(k - 1.0, Ordering::Greater), (k, Ordering::Less)] {
        if left(number) != Some(side) {
            return Err(graze(flight, Some(target), first.clone() + MpBall::from_f64(number)));
        }
    }
    Ok(k)
}

/// Newton steps, kept inside the piece, until the height is as small as the balls can tell; then Lemma C3.
fn solve(flight: &Flight<MpBall>, piece: &Piece, turns: f64) -> Result<Isolated, Undecided> {
    let bits = flight.drift.bits().max(flight.phase.bits());
    let whole = MpBall::from_f64(turns);
    let phase_of = |time: &Float| {
        let since = Float::with_val(bits + 64, time - turns);
        Float::with_val(bits, since + flight.phase.mid())
    };
    let (mut low, mut high) = (phase_of(&piece.between.0), phase_of(&piece.between.1));
    let mut at = phase_of(&piece.guess);
    let direction = piece.target.direction();
    loop {
        let point = MpBall::exact(at.clone());
        let (sin, cos) = flight.wall.mirror(point.sin_cos());
        let height = MpBall::from_f64(piece.target.height());
        let residual = flight.height_above(height, whole.clone(), point, sin.clone());
        let velocity = flight.velocity_at(cos);
        let side = residual.sign();
        if (side == Some(Ordering::Greater)) == (direction > 0.0) {
            high.clone_from(&at);
        } else {
            low.clone_from(&at);
        }
        let ahead = velocity.clone().signed(direction).sign() == Some(Ordering::Greater);
        let step = Float::with_val(bits, residual.mid() / velocity.mid());
        let next = Float::with_val(bits, &at - &step);
        let is_better = ahead && low < next && next < high;
        let next = if is_better { next } else { Float::with_val(bits, &low + &high) / 2u32 };
        if side.is_none() || side == Some(Ordering::Equal) || next == at {
            return prove(flight, piece.target, turns, at, &residual, &velocity, &sin);
        }
        at = next;
    }
}

/// Lemma C3 in balls: `z'` keeps its sign within `reach` of `at`, and `z` vanishes there once.
fn prove(
    flight: &Flight<MpBall>,
    target: Target,
    turns: f64,
    at: Float,
    residual: &MpBall,
    velocity: &MpBall,
    sin: &MpBall,
) -> Result<Isolated, Undecided> {
    let time = MpBall::exact(at.clone()) + MpBall::from_f64(turns) - flight.phase.clone();
    let doubtful = || graze(flight, Some(target), time.clone());
    let steepest = flight.steepest();
    let least = velocity.mig().ok_or_else(doubtful)?;
    let reach = (residual.mag() + residual.mag()).over(least);
    // |z'| loses less than half within the reach.
    let left = least.less(steepest * reach).filter(|left| least <= *left + *left).ok_or_else(doubtful)?;
    if velocity.clone().signed(target.direction()).sign() != Some(Ordering::Greater) {
        return Err(doubtful());
    }
    let radius = residual.mag().over(left);
    let turned = Magnitude::new(6.3, 0) * radius;
    Ok(Isolated {
        target,
        turns,
        at,
        reach: radius,
        least: left,
        time: time.clone().widened(radius).to_ball(),
        velocity: velocity.clone().widened(steepest * radius).to_ball(),
        sin: sin.clone().widened(turned).to_ball(),
    })
}

/// A wall that may be touched with no velocity.
fn graze(flight: &Flight<MpBall>, target: Option<Target>, time: MpBall) -> Undecided {
    let wall = target.map(|target| target.wall(flight.wall));
    Undecided { reason: Reason::Graze, wall, time: Some(time.to_ball()), lasting: false }
}

/// The ball lies on its wall and is pressed against it.
fn rest(flight: &Flight<MpBall>) -> Undecided {
    Undecided { reason: Reason::Graze, wall: Some(flight.wall), time: Some(Ball::exact(0.0)), lasting: true }
}

/// The drift may be 0, or the flight is too long to follow.
fn endless(flight: &Flight<MpBall>) -> Undecided {
    let lasting = flight.drift.sign() == Some(Ordering::Equal);
    Undecided { reason: Reason::Budget, wall: None, time: None, lasting }
}
