//! Newton's equation over a box: Lemma T9, the mean value theorem with a preconditioner.

use super::cut::{Part, Terms};
use super::interval::Interval;
use crate::number::Ball;
use crate::pair::Reduced;
use crate::periodic::chain::Slopes;
use crate::periodic::precondition::Preconditioner;

impl Terms<'_> {
    /// The derivatives of Lemma T2 over a convex set that holds the middle of the part and all its orbits.
    ///
    /// The mean value theorem looks at what lies between both, where nothing holds that only orbits obey: of all that was
    /// cut, only phases and times are used, and times together with those at the middle.
    pub fn slopes(&self, part: &Part) -> Slopes<Interval> {
        let centre = part.centre();
        let ratios = |i: usize| {
            let [from, to] = [i, self.chain.next(i)].map(|impact| Interval::point(centre[impact]));
            let time = part.times[i].hull(to + self.shift(i) - from);
            self.ratios(&part.phases, i, time)
        };
        let ratios: Vec<_> = (0..centre.len()).map(ratios).collect();
        let row = |i: usize| {
            let ([after, before], [after_before, before_own]) = (ratios[i], ratios[self.chain.previous(i)]);
            let e = self.restitution;
            [e * after_before, after - e * before_own + self.swing * part.phases[i].sin(), -before]
        };
        Slopes((0..centre.len()).map(row).collect())
    }

    /// Cuts a part by Newton's equation; `None` when nothing is left. What has no middle is left as it is.
    pub fn newton(&self, pair: &Reduced<Ball>, part: Part, slopes: &Slopes<Interval>) -> Option<Part> {
        let middles = slopes.0.iter().map(|row| row.map(Interval::middle)).collect();
        let Some(inverse) = Preconditioner::new(&Slopes(middles)) else { return Some(part) };
        let centre = part.centre();
        let balls: Vec<Ball> = centre.iter().map(|&x| Ball::exact(x)).collect();
        let Some(legs) = self.chain.legs(pair, &balls) else { return Some(part) };
        let misses: Vec<Interval> = self.chain.residual(pair, &legs).into_iter().map(Interval::of).collect();
        self.solve(part, &inverse, &centre, &misses, slopes)
    }

    /// `(Y J)(x - m) = -Y F(m)`, solved for each phase in turn.
    fn solve(
        &self,
        mut part: Part,
        inverse: &Preconditioner,
        centre: &[f64],
        misses: &[Interval],
        slopes: &Slopes<Interval>,
    ) -> Option<Part> {
        let zero = Interval::point(0.0);
        for i in 0..centre.len() {
            let row = inverse.row(i);
            let mut along = vec![zero; row.len()];
            for (l, j, slope) in slopes.entries() {
                along[j] = along[j] + slope.times(row[l]);
            }
            let offset = |j: usize, part: &Part| part.phases[j] - Interval::point(centre[j]);
            let mut rest = row.iter().zip(misses).fold(zero, |sum, (&y, miss)| sum - miss.times(y));
            for j in (0..row.len()).filter(|&j| j != i) {
                rest = rest - along[j] * offset(j, &part);
            }
            // Derivatives without a bound, or sums that overflow, say nothing.
            if !(rest.is_finite() && along[i].is_finite()) {
                continue;
            }
            match rest.over(along[i]) {
                Some(step) => part.phases[i] = part.phases[i].cut(Interval::point(centre[i]) + step)?,
                // Not even the equation may hold.
                None => _ = (along[i] * offset(i, &part)).cut(rest)?,
            }
        }
        Some(part)
    }
}
