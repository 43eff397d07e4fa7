//! Newton's equation over a box: Lemma T9, the mean value theorem with a preconditioner.

use std::ops::Range;

use super::cut::{Part, Terms};
use crate::number::interval::Interval;
use crate::number::{Ball, Number};
use crate::periodic::entries::Entries;
use crate::periodic::precondition::Preconditioner;
use crate::periodic::shaking::Shaking;

/// Equations of consecutive impacts over a part, for the phases of these impacts; the other phases are given.
///
/// Indices go around: `k` is impact 0 again.
pub(super) struct Rows {
    impacts: Range<usize>,
    /// Derivatives of each equation by the phases before, at and after its impact.
    pub slopes: Vec<[Interval; 3]>,
    /// Columns of these phases among the unknowns; `None` for given phases.
    columns: Vec<[Option<usize>; 3]>,
}

/// A part after Newton's equation.
pub(super) struct Step {
    pub part: Part,
    /// The phase that the equations determine least, where all of them are unknowns.
    pub weakest: usize,
    /// `true` if the equations determine all their unknowns.
    pub is_regular: bool,
}

impl Rows {
    /// The derivatives by the unknowns, in doubles.
    fn middles(&self) -> Entries<f64> {
        let rows = self.columns.iter().zip(&self.slopes).enumerate();
        let entries = rows.flat_map(|(i, (columns, slopes))| {
            columns.iter().zip(slopes).filter_map(move |(j, x)| Some((i, (*j)?, x.mid())))
        });
        Entries::new(self.columns.len(), entries.collect())
    }

    /// Weights of the phases: the sums of the moduli of the equations' derivatives by each phase.
    pub fn weights(&self, count: usize) -> Vec<f64> {
        let mut weights = vec![0.0; count];
        for (i, slopes) in self.impacts.clone().zip(&self.slopes) {
            for (j, slope) in slopes.iter().enumerate() {
                weights[(i + count + j - 1) % count] += slope.inf().abs().max(slope.sup().abs()).min(1e6); // proposes: where to halve
            }
        }
        weights
    }
}

impl Terms<'_> {
    /// Derivatives of Lemma T2 over a convex set that holds the middle of the part and all its orbits.
    ///
    /// The set also holds states between them, which are on no orbit, so bounds that hold for orbits only may not be
    /// used. Of all cuts only those of phases and times count, times together with those at the middle.
    pub fn rows(&self, part: &Part, impacts: Range<usize>) -> Rows {
        let (e, count) = (self.restitution, self.chain.impacts());
        let centre = |i: usize| Interval::point(part.phases[i].mid());
        let ratios = |i: usize| {
            let time = part.times[i].hull(centre(self.chain.next(i)) + self.shift(i) - centre(i));
            self.ratios(&part.phases, i, time)
        };
        let mut last = ratios((impacts.start + count - 1) % count);
        let row = |i: usize| {
            let i = i % count;
            let [after_before, before_own] = std::mem::replace(&mut last, ratios(i));
            let [after, before] = last;
            [e * after_before, after - e * before_own + self.acceleration(part.phases[i]), -before]
        };
        let slopes = impacts.clone().map(row).collect();
        let unknowns = impacts.len();
        let place = |i: usize| Some((i + count - impacts.start) % count).filter(|place| *place < unknowns);
        let columns = impacts.clone().map(|i| [i + count - 1, i, i + 1].map(place)).collect();
        Rows { impacts, slopes, columns }
    }

    /// Cuts a part by Newton's equation; `None` when nothing is left. Without a preconditioner the part stays as it is.
    pub fn newton<S: Shaking<Ball>>(&self, shaking: &S, part: Part, rows: &Rows) -> Option<Step> {
        let Some(inverse) = Preconditioner::new(&rows.middles()) else {
            return Some(Step { part, weakest: 0, is_regular: false });
        };
        let size = |i: usize| inverse.row(i).iter().map(|x| x.abs()).sum::<f64>();
        let weakest = (0..rows.slopes.len()).max_by(|&i, &j| size(i).total_cmp(&size(j))).unwrap_or(0); // proposes
        match self.misses(shaking, &part, rows.impacts.clone()) {
            Some(misses) => {
                self.solve(part, &inverse, &misses, rows).map(|(part, is_regular)| Step { part, weakest, is_regular })
            }
            None => Some(Step { part, weakest, is_regular: false }),
        }
    }

    /// `F` of these impacts at the middle of the part.
    fn misses<S: Shaking<Ball>>(&self, shaking: &S, part: &Part, impacts: Range<usize>) -> Option<Vec<Interval>> {
        let count = self.chain.impacts();
        let moment = |i: usize| {
            let phase = Ball::exact(part.phases[i].mid());
            (phase, shaking.moment(0.0, &phase))
        };
        let leg = |i: usize| {
            let (from, to) = (moment(i), moment(self.chain.next(i)));
            self.chain.leg(shaking, i, [&from.0, &to.0], [&from.1, &to.1])
        };
        let mut to = leg((impacts.start + count - 1) % count)?;
        let miss = |i: usize| {
            let from = leg(i % count)?;
            let before = std::mem::replace(&mut to, from).before;
            Some(Interval::from(shaking.restitution().mul_add(before, from.after)))
        };
        impacts.map(miss).collect()
    }

    /// `(Y J)(x - m) = -Y F(m)`, solved for each unknown in turn.
    fn solve(
        &self,
        mut part: Part,
        inverse: &Preconditioner,
        misses: &[Interval],
        rows: &Rows,
    ) -> Option<(Part, bool)> {
        let (zero, count) = (Interval::ZERO, self.chain.impacts());
        let centre = part.centre();
        let offset = |i: usize, part: &Part| part.phases[i] - Interval::point(centre[i]);
        let mut is_regular = true;
        for (place, i) in rows.impacts.clone().map(|i| i % count).enumerate() {
            let row = inverse.row(place);
            let mut along = vec![zero; count];
            for (l, (&y, slopes)) in row.iter().zip(&rows.slopes).enumerate() {
                for (j, slope) in slopes.iter().enumerate() {
                    let column = (rows.impacts.start + l + count + j - 1) % count;
                    along[column] = along[column] + slope.scaled(y);
                }
            }
            let misses = row.iter().zip(misses).fold(zero, |sum, (&y, miss)| sum - miss.scaled(y));
            let others = (0..count).filter(|&j| j != i && along[j] != zero);
            let rest = others.fold(misses, |rest, j| rest - along[j] * offset(j, &part));
            // Derivatives without a bound, or sums that overflow, say nothing.
            if !(rest.is_common_interval() && along[i].is_common_interval()) {
                is_regular = false;
                continue;
            }
            match rest.checked_div(along[i]) {
                Some(step) => part.phases[i] = part.phases[i].intersection(Interval::point(centre[i]) + step)?,
                // Not even the equation may hold.
                None => {
                    is_regular = false;
                    (along[i] * offset(i, &part)).intersection(rest)?;
                }
            }
        }
        Some((part, is_regular))
    }
}
