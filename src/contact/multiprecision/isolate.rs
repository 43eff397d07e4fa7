//! The first contact of a set of flights, isolated in balls: Lemmas E1, C3, C4, C5 and C8 without error bounds made by hand.

use std::cmp::Ordering;

use super::Isolated;
use crate::contact::Undecided;
use crate::contact::extrema::Target;
use crate::contact::solve::inverse_smoothstep;
use crate::flight::Flight;
use crate::number::{ABOVE_TWO_PI, Enclosing, Float, Magnitude, MpBall, Number};
use crate::pair::Inward;
use crate::turns::LONGEST_FLIGHT;

/// Steps of [`solve`]: halving alone takes one a bit, and as many as the root is near phase 0.
const MOST_STEPS: u32 = 1 << 22;

/// The piece of a flight that the solver searches: times since the start.
struct Piece {
    target: Target,
    /// Time of the extremum that ends the piece; `None` for a monotone flight.
    end: Option<MpBall>,
    /// The contact lies in between, and about here.
    between: (Float, Float),
    guess: Float,
}

/// Encloses the only contact that is first for every flight of the set.
pub(super) fn isolate(flight: &Flight<MpBall>) -> Result<Isolated, Undecided> {
    let rising = is_rising(flight)?;
    let [beyond, short] = [flight.drift.clone().minus(&flight.beta), flight.drift.clone().plus(&flight.beta)];
    let signs = [beyond.sign(), short.sign()];
    // Lemma C5: a start without velocity at exactly sin th0 = 0 has |c| = beta and is monotone all the same.
    let is_release = [&flight.velocity, &flight.sin].iter().all(|x| x.sign() == Some(Ordering::Equal));
    let is_monotone = matches!(signs, [Some(Ordering::Greater), _] | [_, Some(Ordering::Less)]) || is_release;
    let piece = match signs {
        [Some(Ordering::Less), Some(Ordering::Greater)] if !is_release => first_piece(flight, rising)?,
        _ if is_monotone => monotone(flight)?,
        _ => monotone(flight).map_err(|_| graze(flight, None))?,
    };
    let turns = (flight.phase.mid().to_f64() + piece.guess.to_f64()).round(); // exact: any whole number is taken off
    if turns.partial_cmp(&LONGEST_FLIGHT) != Some(Ordering::Less) {
        return Err(endless(flight));
    }
    let found = solve(flight, &piece, turns)?;
    if let Some(end) = &piece.end {
        let time = MpBall::new(found.at.clone(), found.reach) + MpBall::from_f64(turns) - flight.phase.clone();
        if !is_on_last_piece(&time, end) {
            return Err(graze(flight, Some(piece.target)));
        }
    } else if !is_monotone {
        let back = if piece.target == Target::Far { beyond } else { short };
        if !is_first_of_nearly_monotone(flight, &found, back.mag()) {
            return Err(graze(flight, None));
        }
    }
    Ok(found)
}

/// Whether a contact at any of these times is on the piece that ends with the extremum at `end`: all are between it and the extremum of its kind
/// one forcing period earlier, and the sign of z' is that of this piece (Lemma C4).
fn is_on_last_piece(time: &MpBall, end: &MpBall) -> bool {
    let is_later = (time.clone() - (end.clone() - MpBall::from_f64(1.0))).sign() == Some(Ordering::Greater);
    is_later && time.clone().minus(end).sign() == Some(Ordering::Less)
}

/// Lemma C8: the drift is so near to `beta` that extrema may or may not exist; between them no flight moves away from the target
/// faster than `back`.
fn is_first_of_nearly_monotone(flight: &Flight<MpBall>, found: &Isolated, back: Magnitude) -> bool {
    let lost = back * Magnitude::new(found.time.mag(), 0);
    // A greater speed carries a ball farther than it can lose, whatever the shaking does.
    let speed = (Magnitude::new(4.0, 0) * flight.steepest() * lost).sqrt();
    let is_beyond = |least: Option<Magnitude>, most: Magnitude| least.is_some_and(|least| least > most);
    let leaves = match found.target {
        Target::Far if flight.height.sign() == Some(Ordering::Equal) => is_beyond(flight.velocity.mig(), speed),
        Target::Far => is_beyond(flight.height.mig(), lost),
        Target::Near => is_beyond((MpBall::from_f64(1.0) - flight.height.clone()).mig(), lost),
    };
    leaves && found.least > speed && found.time.certain_sign() == Some(Ordering::Greater)
}

/// Whether the ball rises right after the start.
pub(super) fn is_rising(flight: &Flight<MpBall>) -> Result<bool, Undecided> {
    let direction = match flight.velocity.sign() {
        Some(Ordering::Equal) => flight.sin.sign(),
        sign => sign,
    };
    let is_inside = !flight.height.mid().is_zero();
    match direction {
        Some(Ordering::Greater) => Ok(true),
        // On release the next derivative decides, which has the sign of cos th0.
        Some(Ordering::Equal) if flight.cos.sign() == Some(Ordering::Greater) => Ok(true),
        Some(_) if is_inside => Ok(false),
        Some(_) => Err(Undecided::rest(flight.wall)),
        None => Err(graze(flight, Some(Target::Near))),
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
    let guess = if mean > 0.0 { mean.clone() } else { Float::new(0.0) }; // proposes
    Ok(Piece { target, end: None, between: (mean.minus(&spread, mean.bits()), mean.plus(&spread, mean.bits())), guess })
}

/// The extrema of one kind, maxima or minima.
#[derive(Clone, Debug)]
pub(super) struct Kind {
    pub target: Target,
    /// Time of extremum number 0, and its distance from the wall, inside the gap.
    first: MpBall,
    room: MpBall,
    /// Duration of the piece before each extremum.
    pub span: MpBall,
}

/// The extrema of the flights of a set (Lemma E1).
#[derive(Clone, Debug)]
pub(super) struct PhaseNumber {
    /// `|sin th|` at every extremum.
    pub sine: MpBall,
    pub far: Kind,
    pub near: Kind,
    rising: bool,
}

impl PhaseNumber {
    /// The extrema of flights with `|c| < beta`.
    pub fn new(flight: &Flight<MpBall>, rising: bool) -> Option<Self> {
        let one = || MpBall::from_f64(1.0);
        let zero = || MpBall::from_f64(0.0);
        let p = flight.drift.clone().checked_div(flight.beta.clone())?.acos();
        let sine = p.sin_cos().0;
        let double = p.clone().plus(&p);
        let mirrored = flight.phase.clone() + MpBall::from_f64(flight.wall.mirror_phase());
        // M3: all starts are on its piece
        let whole = if rising { mirrored.mid().floor() } else { mirrored.mid().round() };
        let start = mirrored - MpBall::exact(whole);
        let (first_max, first_min) = if rising {
            let first_max = one() - p - start;
            (first_max.clone(), first_max + double.clone())
        } else {
            let first_min = p - start;
            (first_min.clone() + (one() - double.clone()), first_min)
        };
        let height =
            |time: &MpBall, sine: MpBall| flight.height_above(zero(), zero(), flight.phase.clone().plus(time), sine);
        let to_far = one() - height(&first_max, -sine.clone());
        let to_near = height(&first_min, sine.clone());
        let far = Kind { target: Target::Far, first: first_max, room: to_far, span: one() - double.clone() };
        let near = Kind { target: Target::Near, first: first_min, room: to_near, span: double };
        Some(Self { sine, far, near, rising })
    }

    /// The extrema in the order in which the first two come.
    fn in_order(&self) -> [&Kind; 2] {
        if self.rising { [&self.far, &self.near] } else { [&self.near, &self.far] }
    }

    /// The kind of extremum that the drift brings nearer to its wall, and the approach per forcing period.
    fn drifting(&self, flight: &Flight<MpBall>) -> Option<(&Kind, MpBall)> {
        match flight.drift.sign() {
            Some(Ordering::Greater) => Some((&self.far, flight.drift.clone())),
            Some(Ordering::Less) => Some((&self.near, -flight.drift.clone())),
            _ => None,
        }
    }

    /// The extremum that may touch its wall while no earlier one does: the wall, the time, and the distance from the wall.
    pub fn doubtful(&self, flight: &Flight<MpBall>) -> Option<(Target, MpBall, MpBall)> {
        for kind in self.in_order() {
            match kind.room.sign() {
                Some(Ordering::Greater) => {}
                Some(Ordering::Less) => return None,
                _ => return Some((kind.target, kind.first.clone(), kind.room.clone())),
            }
        }
        let (kind, step) = self.drifting(flight)?;
        let k = kind.crossing(&step)?;
        let room = |k: f64| kind.room.clone() - step.clone() * MpBall::from_f64(k);
        // The one before the first that is not certainly inside has to be.
        let k = if room(k - 1.0).sign() == Some(Ordering::Greater) { k } else { k - 1.0 };
        if room(k - 1.0).sign() != Some(Ordering::Greater) || matches!(room(k).sign(), Some(Ordering::Less)) {
            return None;
        }
        Some((kind.target, kind.first.clone() + MpBall::from_f64(k), room(k)))
    }
}

impl Kind {
    /// The number, by the middles, of the first extremum beyond the wall when each comes nearer by `step`.
    fn crossing(&self, step: &MpBall) -> Option<f64> {
        let ratio = self.room.mid().over(step.mid(), self.room.bits());
        let k = ratio.ceil().to_f64().max(1.0); // proposes: C4 is proved for this k
        (k < LONGEST_FLIGHT).then_some(k)
    }
}

/// The piece of the first contact of a flight that turns.
fn first_piece(flight: &Flight<MpBall>, rising: bool) -> Result<Piece, Undecided> {
    let turning = PhaseNumber::new(flight, rising).ok_or_else(|| endless(flight))?;
    let touches = |kind: &Kind| match kind.room.sign() {
        Some(Ordering::Greater) => Ok(false),
        Some(Ordering::Less) => Ok(true),
        _ => Err(graze(flight, Some(kind.target))),
    };
    let [soon, late] = turning.in_order();
    let (kind, k) = if touches(soon)? {
        (soon, 0.0)
    } else if touches(late)? {
        (late, 0.0)
    } else {
        let (kind, step) = turning.drifting(flight).ok_or_else(|| endless(flight))?;
        let k = kind.crossing(&step).ok_or_else(|| endless(flight))?;
        for (number, side) in [(k - 1.0, Ordering::Greater), (k, Ordering::Less)] {
            let number = MpBall::from_f64(number);
            if (kind.room.clone() - step.clone() * number.clone()).sign() != Some(side) {
                return Err(graze(flight, Some(kind.target)));
            }
        }
        (kind, k)
    };
    let Kind { target, first, room, span } = kind.clone();
    let k = MpBall::from_f64(k);
    let end = first + k.clone();
    // The distance of the extremum beyond the wall, as a fraction of the way that the piece makes.
    let approach = flight.drift.clone().signed(target.direction());
    let beyond = approach.clone().mul_add(k, -room);
    let travel = flight.alpha.clone().plus(&flight.alpha).mul_add(turning.sine.clone(), approach * span.clone());
    let fraction = beyond.mid().over(travel.mid(), beyond.bits());
    let from_end = inverse_smoothstep(fraction.to_f64());
    let (bits, part) = (end.bits(), Float::new(from_end));
    let guess = end.mid().minus(&span.mid().times(&part, bits), bits);
    let begin = end.mid().minus(span.mid(), bits);
    let guess = if target == Target::Near { hop(flight, &begin, guess) } else { guess };
    Ok(Piece { target, between: (begin, end.mid().clone()), guess, end: Some(end) })
}

/// Time of the end of a short hop, else `guess`: doubles cannot hold a hop shorter than 1e-300 of its piece.
fn hop(flight: &Flight<MpBall>, top: &Float, guess: Float) -> Float {
    // 0 = z' + z'' h/2 + z''' h^2/6: the root that is the departure is divided out.
    let bits = guess.bits();
    let velocity = flight.velocity.mid();
    let bend = -flight.acceleration_at(flight.sin.clone()).mid().clone().scaled(-1);
    let jerk = flight.acceleration_at(flight.cos.turn() * flight.cos.clone()).mid().over(&Float::new(-6.0), bits);
    let discriminant = bend.times(&bend, bits).plus(&jerk.times(velocity, bits).scaled(2), bits);
    let hop = velocity.clone().scaled(1).over(&bend.plus(&discriminant.sqrt(bits), bits), bits);
    let is_short = *top < hop && hop < 2f64.powi(-10); // proposes: no number is not taken
    if is_short { hop } else { guess }
}

/// Newton steps, kept inside the piece, until the height is as small as the balls can tell; then Lemma C3.
fn solve(flight: &Flight<MpBall>, piece: &Piece, turns: f64) -> Result<Isolated, Undecided> {
    let bits = flight.drift.bits().max(flight.phase.bits()); // M3: any number of bits
    let whole = MpBall::from_f64(turns);
    let phase_of = |time: &Float| {
        let since = time.minus(&Float::new(turns), bits + 64);
        since.plus(flight.phase.mid(), bits)
    };
    let (mut low, mut high) = (phase_of(&piece.between.0), phase_of(&piece.between.1));
    let mut at = phase_of(&piece.guess);
    let direction = piece.target.direction();
    for _ in 0..MOST_STEPS {
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
        let step = residual.mid().over(velocity.mid(), bits);
        let next = at.minus(&step, bits);
        let is_better = ahead && low < next && next < high;
        let next = if is_better { next } else { low.plus(&high, bits).scaled(-1) };
        if side.is_none() || side == Some(Ordering::Equal) || next == at {
            return prove(flight, piece.target, turns, at, &residual, &velocity, &sin);
        }
        at = next;
    }
    Err(graze(flight, Some(piece.target)))
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
    let doubtful = || graze(flight, Some(target));
    let steepest = flight.steepest();
    let least = velocity.mig().ok_or_else(doubtful)?;
    let reach = (residual.mag() + residual.mag()).over(least);
    // |z'| loses less than half within the reach.
    let left = least.less(steepest * reach).filter(|left| least <= *left + *left).ok_or_else(doubtful)?;
    if velocity.clone().signed(target.direction()).sign() != Some(Ordering::Greater) {
        return Err(doubtful());
    }
    let radius = residual.mag().over(left);
    let turned = Magnitude::new(ABOVE_TWO_PI, 0) * radius;
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

/// A wall that may be touched with zero velocity.
fn graze(flight: &Flight<MpBall>, target: Option<Target>) -> Undecided {
    Undecided::graze(target.map(|target| target.wall(flight.wall)))
}

/// The drift may be 0, or the flight is too long to follow.
fn endless(flight: &Flight<MpBall>) -> Undecided {
    // Either it is known not to be 0, and then the flight is too long in any precision, or exactly 0.
    let lasting = flight.drift.sign().is_some();
    Undecided { lasting, ..Undecided::endless() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lemma C4 needs all flights of a set between the two extrema, at a distance that may be far below the radii of doubles.
    #[test]
    fn a_contact_is_refused_on_the_pieces_beside_its_own() {
        let end = MpBall::from_f64_bits(7.25, 300);
        let tiny = Float::new(1.0).scaled(-200);
        let [before, after] = [7.25, 6.25].map(|end| {
            let end = Float::new(end);
            [end.minus(&tiny, 300), end.plus(&tiny, 300)]
        });
        let is_on =
            |time: &Float, radius: i64| is_on_last_piece(&MpBall::new(time.clone(), Magnitude::new(1.0, radius)), &end);
        // Short of the last extremum and past the one before, to less than the distance; not beyond either of them.
        assert!(is_on(&before[0], -201) && is_on(&after[1], -201));
        assert!(!is_on(&before[1], -201) && !is_on(&after[0], -201));
        assert!(!is_on(&before[0], -199) && !is_on(&after[1], -199));
        assert!(!is_on(&Float::new(8.0), -201) && !is_on(&Float::new(5.5), -201));
    }
}
