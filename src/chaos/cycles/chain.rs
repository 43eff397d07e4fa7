//! A chain of impacts in the reduced map, each in a box, and how it is cut.

use super::relation::{Leg, Relation};
use crate::chaos::flights::Side;
use crate::periodic::Interval;
use crate::periodic::krawczyk::Jacobian;
use crate::periodic::precondition::Preconditioner;

/// Boxes of consecutive impacts; a closed chain goes on with its first impact, whole turns later.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub phases: Vec<Interval>,
    pub speeds: Vec<Interval>,
    /// The wall each flight ends on.
    pub sides: Vec<Side>,
    /// Of a closed chain: the turns until it is closed.
    pub turns: Option<f64>,
}

/// The least part of a chain that a pass takes off for another one to be made.
const WORTH: f64 = 0.2;

/// The derivatives of some equations by some phases, in doubles.
struct Square(Vec<(usize, usize, f64)>, usize);

impl Jacobian<f64> for Square {
    fn size(&self) -> usize {
        self.1
    }

    fn entries(&self) -> impl Iterator<Item = (usize, usize, &f64)> {
        self.0.iter().map(|(i, j, x)| (*i, *j, x))
    }
}

impl Chain {
    /// How many phases it has.
    pub fn len(&self) -> usize {
        self.phases.len()
    }

    /// The impact after one, and the turns that are added to its phase.
    fn next(&self, i: usize) -> (usize, f64) {
        match self.turns {
            Some(turns) if i + 1 == self.len() => (0, turns),
            _ => (i + 1, 0.0),
        }
    }

    /// The sum of the widths from an impact on.
    pub fn size(&self, from: usize) -> f64 {
        self.phases[from..].iter().chain(&self.speeds[from..]).map(|x| x.wid()).sum()
    }

    /// The width of the widest phase.
    pub fn wid(&self) -> f64 {
        self.phases.iter().map(|x| x.wid()).fold(0.0, f64::max) // proposes: when to stop
    }

    /// Cuts it from a flight on by all that is known; whether Newton's equation determined all its phases. `None` when nothing is left.
    pub fn narrow(&mut self, relation: &Relation, times: Interval, first: usize) -> Option<bool> {
        loop {
            let before = self.size(first);
            let is_regular = self.narrow_once(relation, times, first)?;
            if self.size(first) > (1.0 - WORTH) * before {
                return Some(is_regular);
            }
        }
    }

    fn narrow_once(&mut self, relation: &Relation, times: Interval, first: usize) -> Option<bool> {
        let middles: Vec<f64> = self.phases.iter().map(|x| x.middle()).collect();
        let mut legs = Vec::with_capacity(self.sides.len() - first);
        for i in first..self.sides.len() {
            self.cut_time(times, i)?;
        }
        let middles: Vec<f64> = middles.iter().zip(&self.phases).map(|(&x, part)| x.clamp(part.lo, part.hi)).collect(); // D21: inside
        for i in first..self.sides.len() {
            let (next, turns) = self.next(i);
            let to = [self.phases[next], Interval::point(middles[next])].map(|x| x + Interval::point(turns));
            let from = [self.phases[i], Interval::point(middles[i])];
            let leg = relation.leg(self.sides[i], [from[0], to[0]], [from[1], to[1]]);
            if let Some(leg) = leg {
                self.cut_flight(relation, i, &leg, &middles)?;
            }
            legs.push(leg);
        }
        let Some(legs) = legs.into_iter().collect::<Option<Vec<Leg>>>() else { return Some(false) };
        self.newton(relation, first, &legs, &middles)
    }

    /// How long the flight may take.
    fn cut_time(&mut self, times: Interval, i: usize) -> Option<()> {
        let (next, turns) = self.next(i);
        let there = Interval::point(turns) - Interval::point(super::relation::shift(self.sides[i]));
        let arrival = self.phases[next] + there;
        let time = (arrival - self.phases[i]).cut(times)?;
        self.phases[i] = self.phases[i].cut(arrival - time)?;
        self.phases[next] = self.phases[next].cut(self.phases[i] + time - there)?;
        Some(())
    }

    /// The speeds at both ends of a flight.
    fn cut_flight(&mut self, relation: &Relation, i: usize, leg: &Leg, middles: &[f64]) -> Option<()> {
        let (next, _) = self.next(i);
        let after = leg.after.cut(relation.restitution * self.speeds[i])?;
        if let Some(speed) = after.over(relation.restitution) {
            self.speeds[i] = self.speeds[i].cut(speed)?;
        }
        self.speeds[next] = self.speeds[next].cut(leg.before)?;
        if i == next {
            return Some(());
        }
        // Each phase from the other and a speed.
        for (row, speed) in [after, self.speeds[next]].into_iter().enumerate() {
            for (side, at, other) in [(0, i, next), (1, next, i)] {
                let offset = self.phases[other] - Interval::point(middles[other]);
                let rest = speed - leg.centre[row] - leg.slopes[row][1 - side] * offset;
                if let Some(step) = rest.over(leg.slopes[row][side]) {
                    self.phases[at] = self.phases[at].cut(Interval::point(middles[at]) + step)?;
                }
            }
        }
        Some(())
    }

    /// Newton's equation for the impacts between two of these flights.
    fn newton(&mut self, relation: &Relation, first: usize, legs: &[Leg], middles: &[f64]) -> Option<bool> {
        let (count, e) = (self.len(), relation.restitution);
        let is_closed = self.turns.is_some() && first == 0;
        let start = if is_closed { 0 } else { first + 1 };
        let unknowns = self.sides.len() - start;
        if unknowns == 0 {
            return Some(true);
        }
        let row = |i: usize| {
            let into = &legs[if i == 0 { legs.len() - 1 } else { i - 1 - first }];
            let from = &legs[i - first];
            let slopes = [
                e * into.slopes[1][0],
                e * into.slopes[1][1] - from.slopes[0][0],
                -from.slopes[0][1],
            ];
            let before = if i == 0 { count - 1 } else { i - 1 };
            ([before, i, self.next(i).0], slopes, e * into.centre[1] - from.centre[0])
        };
        let rows: Vec<_> = (start..start + unknowns).map(row).collect();
        let place = |j: usize| j.checked_sub(start).filter(|&place| place < unknowns);
        let mut entries = Vec::with_capacity(3 * unknowns);
        for (i, (columns, slopes, _)) in rows.iter().enumerate() {
            for (&j, slope) in columns.iter().zip(slopes) {
                if let Some(j) = place(j) {
                    entries.push((i, j, slope.middle()));
                }
            }
        }
        let Some(inverse) = Preconditioner::new(&Square(entries, unknowns)) else { return Some(false) };
        let zero = Interval::point(0.0);
        let mut is_regular = true;
        for own in 0..unknowns {
            let y = inverse.row(own);
            let mut along = vec![zero; count];
            let mut rest = zero;
            for (&y, (columns, slopes, miss)) in y.iter().zip(&rows) {
                for (&j, slope) in columns.iter().zip(slopes) {
                    along[j] = along[j] + slope.times(y);
                }
                rest = rest - miss.times(y);
            }
            let i = start + own;
            for (j, along) in along.iter().enumerate() {
                if j != i && *along != zero {
                    rest = rest - *along * (self.phases[j] - Interval::point(middles[j]));
                }
            }
            if !(rest.is_finite() && along[i].is_finite()) {
                is_regular = false;
                continue;
            }
            match rest.over(along[i]) {
                Some(step) => self.phases[i] = self.phases[i].cut(Interval::point(middles[i]) + step)?,
                None => {
                    is_regular = false;
                    (along[i] * (self.phases[i] - Interval::point(middles[i]))).cut(rest)?;
                }
            }
        }
        Some(is_regular)
    }
}
