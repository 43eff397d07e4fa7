//! Newton's equation over a box of phases, and boxes that hold one orbit at most (Lemma V41).

use super::super::span::Span;
use super::cell::{Cell, Equations};
use super::cut::both;

/// Derivatives of the equation of each impact by the phases before, at and after it.
type Rows = Vec<[Span; 3]>;

/// The derivatives multiplied by an approximate inverse: equations that each determine one phase.
struct Product {
    /// The phases that are determined, in order, by the equations of their impacts.
    unknowns: Vec<usize>,
    inverse: Vec<Vec<f64>>,
    /// Coefficients of all phases, a row for each unknown.
    rows: Vec<Vec<Span>>,
}

impl Equations {
    /// Cuts a box by Newton's equation about its middle; `None` when no orbit is left in it.
    ///
    /// Near a bifurcation the others follow from the phase that is determined least, though that follows from none: it is left out of
    /// the unknowns the second time.
    pub fn stepped(&self, cell: Cell) -> Option<Cell> {
        let all: Vec<usize> = (0..self.count()).collect();
        let Some(product) = self.product(&cell, all.clone()) else { return Some(cell) };
        let weakest = product.weakest();
        let cell = self.solved(cell, &product)?;
        let others = all.into_iter().filter(|&i| i != weakest).collect();
        match self.product(&cell, others) {
            Some(product) => self.solved(cell, &product),
            None => Some(cell),
        }
    }

    /// Cuts the unknowns of a product, whose middle is that of the box.
    fn solved(&self, mut cell: Cell, Product { unknowns, inverse, rows }: &Product) -> Option<Cell> {
        let centre = cell.centre();
        let Some(misses) = self.misses(&centre) else { return Some(cell) };
        for ((&i, weights), row) in unknowns.iter().zip(inverse).zip(rows) {
            let of_unknowns = unknowns.iter().map(|&j| misses[j]);
            let miss = weights.iter().zip(of_unknowns).fold(Span::point(0.0), |sum, (&y, miss)| sum - miss.scaled(y));
            let off = |j: usize| cell.phases[j] - Span::point(centre[j]);
            let rest = (0..row.len()).filter(|&j| j != i).fold(miss, |rest, j| rest - row[j] * off(j));
            if let Some(step) = rest.over(row[i]) {
                cell.phases[i] = both(cell.phases[i], Span::point(centre[i]) + step)?;
            } else {
                both(rest, row[i] * off(i))?;
            }
        }
        Some(cell)
    }

    /// Whether a box, whose flights take these times, holds one solution of the equations at most.
    pub fn is_injective(&self, cell: &Cell) -> bool {
        let width = |j: usize| cell.phases[j].hi() - cell.phases[j].lo();
        let widths: Vec<f64> = (0..self.count()).map(width).collect();
        let widest = widths.iter().copied().fold(f64::MIN_POSITIVE, f64::max); // V41: any weights above 0
        let weights: Vec<f64> = widths.iter().map(|width| width / widest + f64::EPSILON).collect(); // V41: the same
        let Some(product) = self.product(cell, (0..self.count()).collect()) else { return false };
        product.rows.iter().enumerate().all(|(i, row)| {
            let weighted = |j: usize| Span::point(row[j].most()) * Span::point(weights[j]);
            let others = (0..row.len()).filter(|&j| j != i).fold(Span::point(0.0), |sum, j| sum + weighted(j));
            let own = row[i] * Span::point(weights[i]);
            (own - others).is_positive() || (own + others).is_negative()
        })
    }

    /// `c_i + e c_{i-1} - (1 + e) V_i` of each impact at a point; `None` where a flight takes no time.
    fn misses(&self, centre: &[f64]) -> Option<Vec<Span>> {
        let point: Vec<Span> = centre.iter().map(|&x| Span::point(x)).collect();
        let lossy = Span::point(1.0) + self.restitution;
        let drift = |i: usize| {
            let time = self.end(&point, i) - point[i];
            time.is_positive().then_some(())?;
            Some(self.travel(i).over(time)? + self.along(&point, i, time).mean()?)
        };
        let drifts: Vec<Span> = (0..self.count()).map(drift).collect::<Option<_>>()?;
        let miss = |i: usize| {
            let speed = self.excitation.speed(point[i]);
            drifts[i] + self.restitution * drifts[self.previous(i)] - lossy * speed
        };
        Some((0..self.count()).map(miss).collect())
    }

    /// Multiplies the equations of these impacts over a box; `None` where a derivative has no bound, or no inverse is found.
    fn product(&self, cell: &Cell, unknowns: Vec<usize>) -> Option<Product> {
        let slopes = self.derivatives(cell)?;
        let count = self.count();
        let place = |i: usize| unknowns.iter().position(|&own| own == i);
        let mut middles = vec![vec![0.0; unknowns.len()]; unknowns.len()];
        for (&i, row) in unknowns.iter().zip(&mut middles) {
            for (j, slope) in self.columns(i).into_iter().zip(&slopes[i]) {
                place(j).into_iter().for_each(|j| row[j] += slope.mid());
            }
        }
        let inverse = inverse(middles)?;
        let row = |weights: &Vec<f64>| {
            let mut row = vec![Span::point(0.0); count];
            for (&weight, &i) in weights.iter().zip(&unknowns) {
                for (j, slope) in self.columns(i).into_iter().zip(&slopes[i]) {
                    row[j] = row[j] + slope.scaled(weight);
                }
            }
            row
        };
        let rows = inverse.iter().map(row).collect();
        Some(Product { unknowns, inverse, rows })
    }

    /// Impacts whose phases the equation of impact `i` contains.
    fn columns(&self, i: usize) -> [usize; 3] {
        [self.previous(i), i, self.next(i)]
    }

    /// Encloses the derivatives over the phases of the box whose flights take the times of the box, or those at its middle.
    fn derivatives(&self, cell: &Cell) -> Option<Rows> {
        let point: Vec<Span> = cell.centre().into_iter().map(Span::point).collect();
        let ratios = |i: usize| {
            let time = cell.times[i].hull(self.end(&point, i) - point[i]);
            self.ratios(&cell.phases, i, time)
        };
        let ratios: Vec<[Span; 2]> = (0..self.count()).map(ratios).collect::<Option<_>>()?;
        let lossy = Span::point(1.0) + self.restitution;
        let row = |i: usize| {
            let ([arrived_after, arrived], [left, left_before]) = (ratios[self.previous(i)], ratios[i]);
            let bend = lossy * self.excitation.derivatives([2], cell.phases[i])[0];
            [self.restitution * arrived_after, left - self.restitution * arrived - bend, -left_before]
        };
        let rows: Rows = (0..self.count()).map(row).collect();
        rows.iter().flatten().all(|slope| !slope.lo().is_nan()).then_some(rows)
    }

    /// Velocities after the first and before the last impact of flight `i`, over its time, at all phases of a box with these times.
    fn ratios(&self, phases: &[Span], i: usize, time: Span) -> Option<[Span; 2]> {
        let along = self.along(phases, i, time);
        let drift = self.travel(i).over(time).and_then(|straight| Some(straight + along.mean()?));
        let by_time = |speed: Span| drift.and_then(|drift| (drift - speed).over(time));
        let [after, before] = along.ends().map(by_time);
        if !self.is_hop(i) {
            return Some([after?, before?]);
        }
        let [short_after, short_before] = along.hop();
        let narrower = |short: Span, long: Option<Span>| long.map_or(Some(short), |long| both(long, short));
        Some([narrower(short_after, after)?, narrower(short_before, before)?])
    }
}

impl Product {
    /// The unknown that the equations determine least.
    fn weakest(&self) -> usize {
        let size = |row: &Vec<f64>| row.iter().map(|x| x.abs()).sum::<f64>();
        let sizes = self.unknowns.iter().zip(&self.inverse);
        sizes.max_by(|a, b| size(a.1).total_cmp(&size(b.1))).map_or(0, |(&i, _)| i)
    }
}

/// An approximate inverse, by elimination; `None` of a matrix that seems singular.
fn inverse(mut matrix: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let count = matrix.len();
    for (i, row) in matrix.iter_mut().enumerate() {
        row.extend((0..count).map(|j| f64::from(u8::from(i == j))));
    }
    for i in 0..count {
        let pivot = (i..count).max_by(|&k, &l| matrix[k][i].abs().total_cmp(&matrix[l][i].abs()))?;
        matrix.swap(i, pivot);
        let own = matrix[i][i];
        if own.abs() <= f64::MIN_POSITIVE {
            return None;
        }
        matrix[i].iter_mut().for_each(|x| *x /= own);
        let row = matrix[i].clone();
        for (k, other) in matrix.iter_mut().enumerate() {
            let factor = other[i];
            if k != i {
                other.iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    let is_finite = matrix.iter().flatten().all(|x| x.is_finite());
    is_finite.then(|| matrix.into_iter().map(|row| row[count..].to_vec()).collect())
}
