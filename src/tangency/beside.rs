//! The two sides of a tangency: two common points of the manifolds, and none. Lemma J13 of `docs/proofs/tangency.md#J13`.

use super::begin::InDoubles;
use super::boxes::{self, StateBounds, between, high, low};
use super::chain::{Chain, FIRST_STATE};
use super::flights::least;
use super::unfolding::{Linear, solved};
use crate::exact::Enclosure;
use crate::number::{Ball, Enclosing};
use crate::periodic::entries::Entries;
use crate::periodic::krawczyk::{Equations, Limits, Proved, is_inside, polish, prove_inflating};
use crate::periodic::precondition::Preconditioner;

/// The numbers of common points of the manifolds on either side of a tangency, their `sigma` and states in these boxes.
#[derive(Clone, Debug)]
pub(super) struct Sides {
    /// Values of the parameter with two common points.
    pub two: Enclosure,
    /// Values with none.
    pub none: Enclosure,
    pub sigma: [Enclosure; 2],
    pub states: Vec<StateBounds>,
}

/// The unknowns before the states: `sigma_u`, `sigma_s`, the parameter.
const OWN_UNKNOWNS: usize = 3;
const PARAMETER: usize = 2;
const LIMITS: Limits = Limits { largest: 0.0, domains: 12, images: 30, slow: 3 };
/// The largest half-length of the curve that is tried, in its coordinate, and how often it is halved.
const MAX_HALF_LENGTH: f64 = 1.0 / 64.0;
const MAX_HALVINGS: i32 = 16;
/// Parts of it: where the tangency is the only one, what is shown of it, and where its two points are at the least.
const ONLY_TANGENCY_PART: f64 = 0.875;
const SHOWN_PART: f64 = 0.75;
const TWO_POINTS_PART: f64 = 0.625;
/// The shortest piece on which the parameter's derivative is looked at, in parts of the curve.
const MIN_PIECE: f64 = 1e-9;

/// The common points of both manifolds as a curve: the equations of a chain without its tangents, and one coordinate of a state in a ball.
struct Curve<'c> {
    chain: &'c Chain<Ball>,
    coordinate: usize,
    at: Ball,
}

/// The place of an unknown of a chain; `None` for tangents.
fn place(unknown: usize) -> Option<usize> {
    match unknown.checked_sub(FIRST_STATE) {
        Some(i) => (i % 4 < 2).then_some(OWN_UNKNOWNS + i / 4 * 2 + i % 4),
        None => (unknown < OWN_UNKNOWNS).then_some(unknown),
    }
}

impl Curve<'_> {
    /// Unknowns of the chain, with all tangents 0.
    fn all(&self, x: &[Ball]) -> Vec<Ball> {
        let value = |i: usize| place(i).map_or(Ball::exact(0.0), |i| x[i]);
        (0..self.chain.unknowns()).map(value).collect()
    }

    fn approximate(&self, x: &[Ball]) -> Option<Preconditioner> {
        Preconditioner::new(&self.jacobian(x)?.map(|x| x.mid()))
    }

    /// Piece of the curve next to a guess, and the preconditioner of its derivatives.
    fn piece(&self, guess: &[Ball]) -> Option<(Proved<Ball>, Preconditioner)> {
        const STEPS: u32 = 8;
        let inverse = self.approximate(guess)?;
        let own = Curve { at: self.at.centre(), ..*self };
        let guess = polish(&own, &inverse, guess.to_vec(), STEPS);
        let inverse = self.approximate(&guess)?;
        Some((prove_inflating(self, &inverse, &guess, LIMITS)?, inverse))
    }

    /// Derivative of the parameter by the coordinate along a piece.
    fn slope(&self, x: &[Ball], inverse: &Preconditioner) -> Option<Ball> {
        let mut right = vec![Ball::exact(0.0); x.len()];
        right[x.len() - 1] = Ball::exact(1.0);
        Some(solved(&Linear { matrix: self.jacobian(x)?, right }, inverse)?[PARAMETER])
    }
}

impl Equations<Ball> for Curve<'_> {
    fn values(&self, x: &[Ball]) -> Option<Vec<Ball>> {
        let all = self.chain.values(&self.all(x))?;
        let own = all.chunks(4).flat_map(|row| [row[0], row[1]]);
        Some(own.chain([x[self.coordinate] - self.at]).collect())
    }

    fn jacobian(&self, x: &[Ball]) -> Option<Entries<Ball>> {
        let row = |i: usize| (i % 4 < 2).then_some(i / 4 * 2 + i % 4);
        let own = self.chain.jacobian(&self.all(x))?.part(x.len(), row, place);
        Some(own.with_row(x.len() - 1, [(self.coordinate, Ball::exact(1.0))]))
    }
}

/// The curve of common points near a tangency, proved as a whole.
struct Whole<'c> {
    found: &'c InDoubles,
    coordinate: usize,
    start: Vec<Ball>,
    half: f64,
    zero: Proved<Ball>,
}

impl<'c> Whole<'c> {
    fn new(found: &'c InDoubles, coordinate: usize, half: f64) -> Option<Self> {
        let unknowns = (0..found.x.len()).filter(|i| place(*i).is_some());
        let start: Vec<Ball> = unknowns.map(|i| Ball::exact(found.x[i])).collect();
        let at = start[coordinate].widened(half);
        let curve = Curve { chain: &found.chain, coordinate, at };
        let (zero, _) = curve.piece(&start)?;
        // All flights from the states of the box are first contacts.
        least(&found.chain, &curve.all(&zero.domain))?;
        Some(Self { found, coordinate, start, half, zero })
    }

    fn middle(&self) -> f64 {
        self.start[self.coordinate].mid()
    }

    fn curve(&self, at: Ball) -> Curve<'c> {
        Curve { chain: &self.found.chain, coordinate: self.coordinate, at }
    }

    /// The piece of the curve over a ball of the coordinate.
    fn piece(&self, at: Ball) -> Option<(Vec<Ball>, Preconditioner)> {
        let (piece, inverse) = self.curve(at).piece(&self.start)?;
        is_inside(&piece.at, &self.zero.domain).then_some((piece.at, inverse))
    }

    /// Whether all points of a piece are in the domain where the tangency is the only one.
    fn is_about_the_tangency(&self, piece: &[Ball]) -> bool {
        let domain = &self.found.zero.domain;
        (0..domain.len()).all(|i| place(i).is_none_or(|own| piece[own].is_interior_to(&domain[i])))
    }

    /// Whether all tangencies between two values of the coordinate are proved to be the known one. Lemma J13
    fn has_one(&self, [low, high]: [f64; 2]) -> bool {
        let centre = 0.5 * (low + high);
        let at = Ball::new(centre, (centre - low).max(high - centre).next_up()); // J13: the ball holds both ends
        let is_proved = |(piece, inverse): (Vec<Ball>, Preconditioner)| {
            self.is_about_the_tangency(&piece)
                || self.curve(at).slope(&piece, &inverse).is_some_and(|slope| slope.mid().abs() > slope.rad())
        };
        self.piece(at).is_some_and(is_proved)
            || (high - low > MIN_PIECE * self.half && self.has_one([low, centre]) && self.has_one([centre, high]))
    }

    /// Whether the tangency is proved to be on the curve, with its coordinate in a ball. Lemma J13
    fn holds_the_tangency(&self, between: Ball) -> bool {
        let InDoubles { zero, .. } = self.found;
        let is_on = |i: usize, own: usize| {
            zero.at[i].is_interior_to(&self.zero.domain[own])
                && (own != self.coordinate || zero.at[i].is_interior_to(&between))
        };
        (0..zero.at.len()).all(|i| place(i).is_none_or(|own| is_on(i, own)))
    }

    /// Counts the common points. Lemma J13
    fn sides(&self) -> Option<Sides> {
        let middle = self.middle();
        if !self.holds_the_tangency(Ball::new(middle, TWO_POINTS_PART * self.half)) {
            return None;
        }
        let within = Ball::new(middle, ONLY_TANGENCY_PART * self.half);
        if !self.has_one([low(within), high(within)]) {
            return None;
        }
        let end = |sign: f64| Some(self.piece(Ball::exact(middle + sign * TWO_POINTS_PART * self.half))?.0[PARAMETER]);
        let [first, last] = [end(-1.0)?, end(1.0)?];
        let (own, all) = (self.found.zero.at[PARAMETER], self.zero.domain[PARAMETER]);
        // J13: whichever way the fold opens; the domain's ends rounded inward
        let [two, none] = if high(first) < low(own) && high(last) < low(own) {
            let [least, most] = [high(first).max(high(last)), (all.mid() + all.rad()).next_down()]; // J13
            [between(least, low(own))?, between(high(own), most)?]
        } else if low(first) > high(own) && low(last) > high(own) {
            let [least, most] = [(all.mid() - all.rad()).next_up(), low(first).min(low(last))]; // J13
            [between(high(own), most)?, between(least, low(own))?]
        } else {
            return None;
        };
        let shown = Ball::new(middle, SHOWN_PART * self.half);
        let value = |i: usize| {
            let is_along = i == self.coordinate;
            if is_along { (shown, within) } else { (self.zero.at[i], self.zero.domain[i]) }
        };
        let states = boxes::states((OWN_UNKNOWNS..self.start.len()).step_by(2).map(|i| [value(i), value(i + 1)]))?;
        if !(0..PARAMETER).all(|i| boxes::is_within(self.zero.at[i], self.zero.domain[i])) {
            return None;
        }
        let sigma = [self.zero.at[0].as_enclosure()?, self.zero.at[1].as_enclosure()?];
        Some(Sides { two: two.as_enclosure()?, none: none.as_enclosure()?, sigma, states })
    }
}

/// The coordinate in which the curve of common points runs fastest at the tangency.
fn fastest(found: &InDoubles) -> Option<usize> {
    let InDoubles { chain, x, .. } = found;
    let size = |i: usize| x[i + 2].abs() * f64::from(-chain.scales[(i - FIRST_STATE) / 4 + 1]).exp2(); // proposes
    let states = (FIRST_STATE..x.len()).filter(|i| (i - FIRST_STATE) % 4 < 2);
    states.max_by(|a, b| size(*a).total_cmp(&size(*b))).and_then(place) // proposes
}

/// Counts the common points on either side of a tangency; `None` where that is not proved. Lemma J13
pub(super) fn sides(found: &InDoubles) -> Option<Sides> {
    let coordinate = fastest(found)?;
    let halves = (0..MAX_HALVINGS).map(|k| MAX_HALF_LENGTH * f64::from(-k).exp2()); // proposes
    halves.into_iter().find_map(|half| Whole::new(found, coordinate, half)?.sides())
}
