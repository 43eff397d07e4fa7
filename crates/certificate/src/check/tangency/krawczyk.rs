//! Krawczyk's operator for the equations of a chain (Lemma V31).

use super::area::Area;
use super::chain::{AreaEquations, Chain};
use crate::check::contact::Doubt;
use crate::check::legs::size;
use impact_pair_exact::{Dyadic, Enclosure, Real};

/// Bits of bounds.
const SHORT_BITS: u32 = 64;
/// Steps of Newton's iteration, and log2 of the last step and of the smallest box.
const STEPS: u32 = 16;
const LAST_STEP_EXPONENT: i64 = -30;
const MIN_BOX_EXPONENT: i64 = -60;
/// Number of times that a box is enlarged, and log2 of the share of its radii that is added each time.
const MAX_WIDENINGS: u32 = 8;
const WIDENING_EXPONENT: i64 = -4;
/// Number of improvements of the weights.
const WEIGHT_ITERATIONS: u32 = 8;

/// The system to solve: the number of equations, and the indices of the unknowns; the other values are given.
#[derive(Clone, Debug)]
pub(super) struct System {
    pub equations: usize,
    pub unknowns: Vec<usize>,
    pub given: Vec<usize>,
}

/// An area with exactly one zero for each choice of the given values, bounds of all these zeros, and the equations over the area.
pub(super) struct Found {
    pub area: Area,
    pub bounds: Vec<Real>,
    pub over: AreaEquations,
}

fn lost() -> Doubt {
    Doubt::open("no orbit is found from one invariant manifold to the other")
}

/// An approximate inverse.
struct Newton {
    rows: Vec<Vec<Real>>,
}

/// The inverse of a matrix by Gauss and Jordan. Non-rigorous.
fn inverse(mut rows: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let count = rows.len();
    // proposes: any matrix is as sound
    for (i, row) in rows.iter_mut().enumerate() {
        let unit = row.iter().fold(0.0_f64, |most, x| most.max(x.abs())); // proposes
        row.extend((0..count).map(|j| if i == j { 1.0 } else { 0.0 }));
        row.iter_mut().for_each(|x| *x /= unit);
    }
    for j in 0..count {
        let pivot = (j..count).max_by(|a, b| rows[*a][j].abs().total_cmp(&rows[*b][j].abs()))?;
        rows.swap(j, pivot);
        let own = rows[j][j];
        rows[j].iter_mut().for_each(|x| *x /= own);
        let row = rows[j].clone();
        for (_, other) in rows.iter_mut().enumerate().filter(|(i, _)| *i != j) {
            let factor = other[j];
            other.iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
        }
    }
    let inverse: Vec<Vec<f64>> = rows.into_iter().map(|row| row[count..].to_vec()).collect();
    inverse.iter().flatten().all(|x| x.is_finite()).then_some(inverse)
}

impl System {
    fn newton(&self, over: &AreaEquations) -> Result<Newton, Doubt> {
        let row = |i: usize| {
            let mut row = vec![0.0; self.unknowns.len()];
            for (place, x) in &over.rows[i] {
                if let Some(j) = self.unknowns.iter().position(|own| own == place) {
                    row[j] += x.to_f64();
                }
            }
            row
        };
        let inverse = inverse((0..self.equations).map(row).collect()).ok_or_else(lost)?;
        let real = |x: &f64| Some(Real::new(Enclosure::from_f64_bounds(*x, *x)?, SHORT_BITS));
        let rows = inverse.iter().map(|row| row.iter().map(real).collect::<Option<_>>()).collect::<Option<_>>();
        Ok(Newton { rows: rows.ok_or_else(lost)? })
    }

    /// A zero near `at` with the given values, and radii for other given values. Non-rigorous.
    fn polished(&self, chain: &mut Chain<'_>, mut at: Vec<Real>, given: &[(usize, Real)]) -> Result<Area, Doubt> {
        for _ in 0..STEPS {
            let over = chain.over(&Area::point(at.clone()))?;
            let newton = self.newton(&over)?;
            let mut most = None;
            for (i, row) in self.unknowns.iter().zip(&newton.rows) {
                let step = along(row, &over.residual[..self.equations]).middle();
                most = most.max(step.enclosure().mag().top()); // proposes: when to stop
                at[*i] = (at[*i].clone() - &step).middle();
            }
            // proposes: when to stop
            if most.is_none_or(|top| top < LAST_STEP_EXPONENT) {
                let product = self.multiplied(&newton, &over, at.len());
                let mut area = Area::point(at);
                given.iter().for_each(|(i, radius)| area.radii[*i] = radius.clone());
                for (row, i) in product.iter().zip(&self.unknowns) {
                    let reach = self.given.iter().map(|j| size(&row[*j]) * &area.radii[*j]);
                    area.radii[*i] = enlarged(reach.fold(power(MIN_BOX_EXPONENT), |sum, x| sum + &x));
                }
                return Ok(area);
            }
        }
        Err(lost())
    }

    /// `C J`, with a column for every value of an orbit.
    fn multiplied(&self, newton: &Newton, over: &AreaEquations, count: usize) -> Vec<Vec<Real>> {
        let product = |row: &Vec<Real>| {
            let mut sums = vec![Real::zero(SHORT_BITS); count];
            for (factor, entries) in row.iter().zip(&over.rows) {
                for (place, x) in entries {
                    sums[*place] = sums[*place].clone() + &(factor.clone() * x);
                }
            }
            sums
        };
        newton.rows.iter().map(product).collect()
    }

    /// Bounds of the operator's displacements of unknowns within these radii; `product` holds the derivatives.
    fn displacement_bounds(&self, product: &[Vec<Real>], radii: &[Real]) -> Vec<Real> {
        let stray = |(i, row): (usize, &Vec<Real>)| {
            let part = |(j, place): (usize, &usize)| size(&(row[*place].clone() - i64::from(i == j))) * &radii[*place];
            self.unknowns.iter().enumerate().map(part).fold(Real::zero(SHORT_BITS), |sum, x| sum + &x)
        };
        product.iter().enumerate().map(stray).collect()
    }

    /// Proves that an area has at most one zero for each choice of the given values. Lemma V31
    pub fn is_only(&self, chain: &mut Chain<'_>, area: &Area) -> Result<(), Doubt> {
        let over = chain.over(area)?;
        let newton = self.newton(&over)?;
        let product = self.multiplied(&newton, &over, area.centre.len());
        let mut weights = area.radii.clone();
        for _ in 0..WEIGHT_ITERATIONS {
            let displacement_bounds = self.displacement_bounds(&product, &weights);
            if self.unknowns.iter().zip(&displacement_bounds).all(|(i, stray)| stray.is_below(&weights[*i])) {
                return Ok(());
            }
            // V31: any positive weights
            for (i, stray) in self.unknowns.iter().zip(&displacement_bounds) {
                let least = weights[*i].half();
                weights[*i] = if least.is_below(stray) { stray.clone() } else { least };
            }
        }
        Err(Doubt::open("the boxes are too wide to prove that there is only one orbit in them"))
    }

    /// Proves that there is exactly one zero near a point for each choice of the given values within their radii. Lemma V31
    pub fn found(&self, chain: &mut Chain<'_>, near: Vec<Real>, given: &[(usize, Real)]) -> Result<Found, Doubt> {
        let mut area = self.polished(chain, near, given)?;
        for _ in 0..MAX_WIDENINGS {
            let over = chain.over(&area)?;
            let newton = self.newton(&over)?;
            let product = self.multiplied(&newton, &over, area.centre.len());
            let displacement_bounds = self.displacement_bounds(&product, &area.radii);
            let mut bounds = area.hulls();
            for (k, i) in self.unknowns.iter().enumerate() {
                let moved = along(&newton.rows[k], &over.residual[..self.equations]);
                let own = self.given.iter().map(|j| product[k][*j].clone() * &within(&area.radii[*j]));
                bounds[*i] =
                    own.fold(area.centre[*i].clone() - &moved + &within(&displacement_bounds[k]), |sum, x| sum + &x);
            }
            let is_inside = |i: &usize| {
                let [low, high] = area.hull(*i).ends();
                low.is_below(&bounds[*i]) && bounds[*i].is_below(&high)
            };
            if self.unknowns.iter().all(is_inside) {
                return Ok(Found { area, bounds, over });
            }
            for i in &self.unknowns {
                let reach = size(&(bounds[*i].clone() - &area.centre[*i]));
                area.radii[*i] = enlarged(reach);
            }
        }
        Err(Doubt::open("the orbits from one invariant manifold to the other are not proved to exist"))
    }
}

/// The values between `low` and `high`, in four parts.
pub(super) fn parts([low, high]: &[Real; 2]) -> Vec<[Real; 2]> {
    let at = |k: i64| {
        let part = (high.clone() - low) * k;
        (low.clone() + &part.half().half()).middle()
    };
    let inner: Vec<Real> = (1..4).map(at).collect();
    let all: Vec<Real> = [low.clone()].into_iter().chain(inner).chain([high.clone()]).collect();
    all.windows(2).map(|pair| [pair[0].clone(), pair[1].clone()]).collect()
}

fn power(n: i64) -> Real {
    Real::point(Dyadic::power_of_two(n), SHORT_BITS)
}

/// A somewhat larger radius.
fn enlarged(radius: Real) -> Real {
    size(&(radius.clone() + &(radius * &power(WIDENING_EXPONENT))))
}

fn within(radius: &Real) -> Real {
    Real::within(radius.enclosure().sup(), SHORT_BITS)
}

fn along(row: &[Real], column: &[Real]) -> Real {
    row.iter().zip(column).fold(Real::zero(SHORT_BITS), |sum, (a, b)| sum + &(a.clone() * b))
}
