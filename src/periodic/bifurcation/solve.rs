//! Zeros of a [`System`]: floats find, Krawczyk's operator proves. Lemma T3, for any equations

use nalgebra::DMatrix;

use super::super::krawczyk::{is_inside, widest};
use super::system::{Family, System};
use crate::number::Enclosing;

/// A zero proved: exactly one lies in `domain`, and it lies in `at`.
#[derive(Clone, Debug)]
pub(super) struct Zero<N> {
    pub at: Vec<N>,
    pub domain: Vec<N>,
}

/// Steps of Newton's iteration before a start is given up.
const MOST_STEPS: usize = 30;
/// The largest radius of a domain that is tried, `2^-5`, the factor from one to the next, and how many are tried.
pub(super) const LARGEST: f64 = 0.031_25;
const FINER: f64 = 0.125;
const MOST_DOMAINS: u32 = 14;
/// Images that narrow a zero: where nothing is rounded (at quarter turns) they would do so for ever.
const MOST_IMAGES: u32 = 40;

/// The Jacobian in floats.
pub(super) fn jacobian<S: System>(system: &S, family: &Family<f64>, x: &[f64]) -> Option<DMatrix<f64>> {
    let columns = system.columns(family, x)?;
    let rows = columns.first()?.len();
    Some(DMatrix::from_fn(rows, columns.len(), |i, j| columns[j][i]))
}

/// An approximate zero from a guess; `None` where Newton's iteration does not settle near it.
pub(super) fn newton<S: System>(system: &S, family: &Family<f64>, guess: Vec<f64>) -> Option<Vec<f64>> {
    let mut x = guess;
    let mut last = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let values = system.values(family, &x)?;
        let step = jacobian(system, family, &x)?.lu().solve(&DMatrix::from_column_slice(values.len(), 1, &values))?;
        let size = step.amax();
        if !size.is_finite() || size > 1.0 {
            return None;
        }
        x.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
        // As far as doubles go: a step that is tiny and no longer shrinks.
        if size < 1e-9 && size >= 0.5 * last {
            return Some(x);
        }
        last = size;
    }
    (last < 1e-9).then_some(x)
}

/// An approximate inverse of the Jacobian, in doubles.
pub(super) fn inverse<S: System>(system: &S, family: &Family<f64>, x: &[f64]) -> Option<DMatrix<f64>> {
    jacobian(system, family, x)?.try_inverse().filter(|y| y.iter().all(|x| x.is_finite()))
}

/// `m - Y F(m)` at a centre.
pub(super) fn step<S: System, N: Enclosing>(
    system: &S,
    family: &Family<N>,
    inverse: &DMatrix<f64>,
    centre: &[N],
) -> Option<Vec<N>> {
    let misses = system.values(family, centre)?;
    let row = |(i, x): (usize, &N)| {
        let add = |sum: N, (j, f): (usize, &N)| N::from_f64(-inverse[(i, j)]).mul_add(f.clone(), sum);
        misses.iter().enumerate().fold(x.clone(), add)
    };
    Some(centre.iter().enumerate().map(row).collect())
}

/// Krawczyk's image of a box. Lemma T3
pub(super) fn image<S: System, N: Enclosing>(
    system: &S,
    family: &Family<N>,
    inverse: &DMatrix<f64>,
    x: &[N],
) -> Option<Vec<N>> {
    let centre: Vec<N> = x.iter().map(Enclosing::centre).collect();
    let newton = step(system, family, inverse, &centre)?;
    let columns = system.columns(family, x)?;
    let row = |(i, newton): (usize, N)| {
        columns.iter().enumerate().fold(newton, |sum, (j, column)| {
            // Entry (i, j) of 1 - Y F'(X).
            let one = N::from_f64(if i == j { 1.0 } else { 0.0 });
            let add = |sum: N, (l, f): (usize, &N)| N::from_f64(-inverse[(i, l)]).mul_add(f.clone(), sum);
            column.iter().enumerate().fold(one, add).mul_add(x[j].spread(), sum)
        })
    };
    Some(newton.into_iter().enumerate().map(row).collect())
}

/// Proves the one zero near a guess, with the largest domain of those tried. Lemma T3
pub(super) fn prove<S: System, N: Enclosing>(
    system: &S,
    family: &Family<N>,
    inverse: &DMatrix<f64>,
    guess: &[N],
    largest: f64,
) -> Option<Zero<N>> {
    let mut radius = largest;
    for _ in 0..MOST_DOMAINS {
        let domain: Vec<N> = guess.iter().map(|x| x.with_radius(radius)).collect();
        if let Some(at) = image(system, family, inverse, &domain).filter(|image| is_inside(image, &domain)) {
            return Some(Zero { at, domain });
        }
        radius *= FINER;
    }
    None
}

/// Narrows the enclosure of a proved zero as far as this arithmetic does, within its domain.
pub(super) fn refine<S: System, N: Enclosing>(
    system: &S,
    family: &Family<N>,
    inverse: &DMatrix<f64>,
    zero: &mut Zero<N>,
) {
    for _ in 0..MOST_IMAGES {
        let Some(narrower) = image(system, family, inverse, &zero.at) else { break };
        let gain = widest(&zero.at) - widest(&narrower);
        if !(gain > 0.0 && is_inside(&narrower, &zero.domain)) {
            break;
        }
        zero.at = narrower;
        if gain < 0.25 {
            break;
        }
    }
}

/// Proves a zero from a guess in one arithmetic, and narrows it.
///
/// `bits` is the precision of the arithmetic, `largest` the radius of the largest domain tried.
pub(super) fn certify<S: System, N: Enclosing>(
    system: &S,
    family: &Family<N>,
    inverse: &DMatrix<f64>,
    guess: &[N],
    (bits, largest): (u32, f64),
) -> Option<Zero<N>> {
    let mut guess = guess.to_vec();
    // Each step in doubles adds some thirty bits.
    for _ in 0..bits / 32 {
        guess = step(system, family, inverse, &guess)?.iter().map(Enclosing::centre).collect();
    }
    let mut zero = prove(system, family, inverse, &guess, largest)?;
    refine(system, family, inverse, &mut zero);
    Some(zero)
}
