//! Existence and uniqueness of an orbit in a box of phases: Krawczyk's operator on the whole chain.

use std::cmp::Ordering;

use super::chain::{Chain, Legs};
use super::precondition::Preconditioner;
use super::shaking::Shaking;
use crate::number::Enclosing;

/// An orbit proved: exactly one has its phases in `domain`, and it has them in `phases`.
#[derive(Clone, Debug, PartialEq)]
pub struct Proved<N> {
    /// Encloses the orbit's phases.
    pub phases: Vec<N>,
    /// The box in which there is no other orbit.
    pub domain: Vec<N>,
}

/// `2^-5`, the largest radius of a domain that is tried, in turns, and the factor from one to the next.
const LARGEST: f64 = 0.031_25;
const FINER: f64 = 0.125;
/// Images that take less than a quarter of a bit off an enclosure.
const MOST_SLOW: u32 = 64;

/// The flights over a box, if each is proved to take time: only then are they flights at all.
pub(super) fn flights<N: Enclosing, S: Shaking<N>>(
    chain: &Chain,
    shaking: &S,
    phases: &[N],
) -> Option<Legs<N, S::Moment>> {
    let legs = chain.legs(shaking, phases)?;
    legs.legs.iter().all(|leg| leg.time.certain_sign() == Some(Ordering::Greater)).then_some(legs)
}

/// Krawczyk's image `m - Y F(m) + (1 - Y F'(X))(X - m)` of a box `X` with centre `m`. Lemma T3
pub(super) fn image<N: Enclosing, S: Shaking<N>>(
    chain: &Chain,
    shaking: &S,
    inverse: &Preconditioner,
    phases: &[N],
) -> Option<Vec<N>> {
    let centre: Vec<N> = phases.iter().map(Enclosing::centre).collect();
    let misses = chain.residual(shaking, &flights(chain, shaking, &centre)?);
    let slopes = chain.slopes(shaking, &flights(chain, shaking, phases)?)?;
    let image = |i: usize| {
        let row = inverse.row(i);
        // The row of 1 - Y F'(X).
        let mut rest: Vec<N> = (0..row.len()).map(|j| N::from_f64(if i == j { 1.0 } else { 0.0 })).collect();
        for (l, j, slope) in slopes.entries() {
            rest[j] = N::from_f64(-row[l]).mul_add(slope.clone(), rest[j].clone());
        }
        let newton =
            row.iter().zip(&misses).fold(centre[i].clone(), |sum, (&y, f)| N::from_f64(-y).mul_add(f.clone(), sum));
        rest.into_iter().zip(phases).fold(newton, |sum, (g, x)| g.mul_add(x.spread(), sum))
    };
    Some((0..phases.len()).map(image).collect())
}

/// Whether each ball lies in the interior of its outer one.
pub(super) fn is_inside<N: Enclosing>(inner: &[N], outer: &[N]) -> bool {
    inner.iter().zip(outer).all(|(inner, outer)| inner.is_interior_to(outer))
}

/// Proves the one orbit near a guess, with the largest domain of those tried. Lemma T3
///
/// `None` when no box around the guess is mapped into its interior: the guess is none, or the orbit is too close to a
/// bifurcation or a graze for this arithmetic.
pub fn prove<N: Enclosing, S: Shaking<N>>(
    chain: &Chain,
    shaking: &S,
    inverse: &Preconditioner,
    guess: &[N],
    least: f64,
) -> Option<Proved<N>> {
    let mut radius = LARGEST;
    while radius >= least {
        let domain: Vec<N> = guess.iter().map(|x| x.with_radius(radius)).collect();
        if let Some(phases) = image(chain, shaking, inverse, &domain).filter(|image| is_inside(image, &domain)) {
            return Some(Proved { phases, domain });
        }
        radius *= FINER;
    }
    None
}

/// Narrows the enclosure of a proved orbit as far as this arithmetic does, within its domain.
pub fn refine<N: Enclosing, S: Shaking<N>>(
    chain: &Chain,
    shaking: &S,
    inverse: &Preconditioner,
    proved: &mut Proved<N>,
) {
    // Each image holds the orbit; a further one is worth its price while it takes something off the widest radius. Near a
    // bifurcation the first ones take little, and the narrower the box the more.
    let mut slow = 0;
    while let Some(narrower) = image(chain, shaking, inverse, &proved.phases) {
        let gain = widest(&proved.phases) - widest(&narrower);
        if !(gain > 0.0 && is_inside(&narrower, &proved.domain)) {
            break;
        }
        proved.phases = narrower;
        slow += u32::from(gain < 0.25); // proposes: when to stop
        if slow > MOST_SLOW {
            break;
        }
    }
}

/// `log2` of the greatest radius.
pub(super) fn widest<N: Enclosing>(balls: &[N]) -> f64 {
    balls.iter().map(Enclosing::log2_radius).fold(f64::NEG_INFINITY, f64::max) // shown: widths, not bounds
}
