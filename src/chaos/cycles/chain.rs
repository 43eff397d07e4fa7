//! A chain of impacts in the reduced map, each in a box, and how it is cut: Lemma D22.

use super::relation::{Leg, Relation};
use crate::chaos::law::Side;
use crate::number::interval::Interval;
use crate::periodic::entries::Entries;
use crate::periodic::precondition::Preconditioner;

/// Boxes of consecutive impacts; a closed chain goes on with its first impact, whole forcing periods later.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    /// Reduced phases of the impacts, whole forcing periods included.
    pub phases: Vec<Interval>,
    pub speeds: Vec<Interval>,
    /// The wall that each flight ends on.
    pub sides: Vec<Side>,
    /// Whole forcing periods after which a closed chain closes; `None` for open chains.
    pub turns: Option<f64>,
}

/// The relations that hold for all chains.
#[derive(Clone, Copy, Debug)]
pub(super) struct Laws {
    pub relation: Relation,
    /// Bounds of the times of flight, in forcing periods.
    pub times: Interval,
}

/// The least part of a chain that a pass takes off for another one to be made.
const MIN_GAIN: f64 = 0.2;

/// The equation of an impact: the phases in it, its derivatives by them, and its value at the middles.
struct Row {
    phases: [usize; 3],
    slopes: [Interval; 3],
    miss: Interval,
}

impl Chain {
    /// A chain of one impact.
    pub fn new([phase, speed]: [Interval; 2]) -> Self {
        Self { phases: vec![phase], speeds: vec![speed], sides: Vec::new(), turns: None }
    }

    /// Number of impacts.
    pub fn len(&self) -> usize {
        self.phases.len()
    }

    /// Index of the impact after impact `i`, and the forcing periods to add to the phase of that impact.
    fn next(&self, i: usize) -> (usize, f64) {
        match self.turns {
            Some(turns) if i + 1 == self.len() => (0, turns),
            _ => (i + 1, 0.0),
        }
    }

    /// Sum of the widths of phases and speeds from impact `from` on.
    pub fn size(&self, from: usize) -> f64 {
        self.phases[from..].iter().chain(&self.speeds[from..]).map(|x| x.wid()).sum()
    }

    /// Index and width of the widest phase.
    pub fn widest(&self) -> (usize, f64) {
        let widths = self.phases.iter().map(|x| x.wid()).enumerate();
        widths.max_by(|(_, x), (_, y)| x.total_cmp(y)).expect("an impact")
    }

    /// Halves of the chain, cut at the middle of one phase.
    pub fn halves(self, across: usize) -> [Self; 2] {
        let whole = self.phases[across];
        let mut other = self.clone();
        other.phases[across] = Interval::new(whole.mid(), whole.sup());
        let mut one = self;
        one.phases[across] = Interval::new(whole.inf(), whole.mid());
        [one, other]
    }

    /// Cuts the chain from a flight on until a pass gains little. True if Newton's equation determined all phases. `None` when
    /// no chain is left.
    pub fn narrow(&mut self, laws: &Laws, first: usize) -> Option<bool> {
        loop {
            let before = self.size(first);
            let is_regular = self.narrow_once(laws, first)?;
            if self.size(first) > (1.0 - MIN_GAIN) * before {
                return Some(is_regular);
            }
        }
    }

    fn narrow_once(&mut self, laws: &Laws, first: usize) -> Option<bool> {
        for i in first..self.sides.len() {
            self.cut_time(laws.times, i)?;
        }
        let middles: Vec<f64> = self.phases.iter().map(|x| x.mid()).collect();
        let legs: Vec<Option<Leg>> = (first..self.sides.len()).map(|i| self.leg(laws, i, &middles)).collect();
        for (i, leg) in legs.iter().enumerate() {
            if let Some(leg) = leg {
                self.cut_flight(laws, first + i, leg, &middles)?;
            }
        }
        match legs.into_iter().collect::<Option<Vec<Leg>>>() {
            Some(legs) => self.newton(laws, first, &legs, &middles),
            None => Some(false),
        }
    }

    /// Flight `i`, about these phases.
    fn leg(&self, laws: &Laws, i: usize, middles: &[f64]) -> Option<Leg> {
        let (next, turns) = self.next(i);
        let from = [self.phases[i], Interval::point(middles[i])];
        let to = [self.phases[next], Interval::point(middles[next])].map(|x| x + Interval::point(turns));
        laws.relation.leg(self.sides[i], [from[0], to[0]], [from[1], to[1]])
    }

    /// Cuts the phases by the bounds of the time of flight.
    fn cut_time(&mut self, times: Interval, i: usize) -> Option<()> {
        let (next, turns) = self.next(i);
        let there = Interval::point(turns) - Interval::point(self.sides[i].shift());
        let arrival = self.phases[next] + there;
        let time = (arrival - self.phases[i]).intersection(times)?;
        self.phases[i] = self.phases[i].intersection(arrival - time)?;
        self.phases[next] = self.phases[next].intersection(self.phases[i] + time - there)?;
        Some(())
    }

    /// Cuts by the speeds at both ends of a flight.
    fn cut_flight(&mut self, laws: &Laws, i: usize, leg: &Leg, middles: &[f64]) -> Option<()> {
        let (next, e) = (self.next(i).0, laws.relation.restitution);
        let after = leg.after.intersection(e * self.speeds[i])?;
        if let Some(speed) = after.checked_div(e) {
            self.speeds[i] = self.speeds[i].intersection(speed)?;
        }
        self.speeds[next] = self.speeds[next].intersection(leg.before)?;
        if i == next {
            return Some(());
        }
        for (row, speed) in [after, self.speeds[next]].into_iter().enumerate() {
            for (end, at, other) in [(0, i, next), (1, next, i)] {
                let offset = self.phases[other] - Interval::point(middles[other]);
                let rest = speed - leg.centre[row] - leg.slopes[row][1 - end] * offset;
                if let Some(step) = rest.checked_div(leg.slopes[row][end]) {
                    self.phases[at] = self.phases[at].intersection(Interval::point(middles[at]) + step)?;
                }
            }
        }
        Some(())
    }

    /// Cuts by Newton's equation for the impacts between two of the flights from `first` on; whether it determined all their phases.
    fn newton(&mut self, laws: &Laws, first: usize, legs: &[Leg], middles: &[f64]) -> Option<bool> {
        // All impacts of a closed chain are between two flights.
        let start = if self.turns.is_some() { 0 } else { first + 1 };
        let rows: Vec<Row> = (start..self.sides.len()).map(|i| self.row(laws, i, first, legs)).collect();
        if rows.is_empty() {
            return Some(true);
        }
        let place = |phase: usize| phase.checked_sub(start).filter(|&place| place < rows.len());
        let entries = rows.iter().enumerate().flat_map(|(i, row)| {
            let entry = move |(&j, slope): (&usize, &Interval)| Some((i, place(j)?, slope.mid()));
            row.phases.iter().zip(&row.slopes).filter_map(entry)
        });
        let Some(inverse) = Preconditioner::new(&Entries::new(rows.len(), entries.collect())) else {
            return Some(false);
        };
        let mut is_regular = true;
        for own in 0..rows.len() {
            is_regular &= self.solve(start + own, inverse.row(own), &rows, middles)?;
        }
        Some(is_regular)
    }

    /// The equation of an impact between two of these flights, the first of which is flight `first`.
    fn row(&self, laws: &Laws, i: usize, first: usize, legs: &[Leg]) -> Row {
        let previous = if i == 0 { self.len() - 1 } else { i - 1 };
        let (e, into, from) = (laws.relation.restitution, &legs[previous - first], &legs[i - first]);
        Row {
            phases: [previous, i, self.next(i).0],
            slopes: [e * into.slopes[1][0], e * into.slopes[1][1] - from.slopes[0][0], -from.slopes[0][1]],
            miss: e * into.centre[1] - from.centre[0],
        }
    }

    /// Solves a combination of the equations for a phase; whether it determines it.
    fn solve(&mut self, i: usize, y: &[f64], rows: &[Row], middles: &[f64]) -> Option<bool> {
        let zero = Interval::ZERO;
        let mut along = vec![zero; self.len()];
        let mut rest = zero;
        for (&y, row) in y.iter().zip(rows) {
            for (&j, slope) in row.phases.iter().zip(&row.slopes) {
                along[j] = along[j] + slope.scaled(y);
            }
            rest = rest - row.miss.scaled(y);
        }
        let offset = |j: usize| self.phases[j] - Interval::point(middles[j]);
        for (j, &along) in along.iter().enumerate() {
            if j != i && along != zero {
                rest = rest - along * offset(j);
            }
        }
        // Where a sum overflows, nothing is known.
        if !(rest.is_common_interval() && along[i].is_common_interval()) {
            return Some(false);
        }
        match rest.checked_div(along[i]) {
            Some(step) => {
                self.phases[i] = self.phases[i].intersection(Interval::point(middles[i]) + step)?;
                Some(true)
            }
            None => (along[i] * offset(i)).intersection(rest).map(|_| false),
        }
    }
}
