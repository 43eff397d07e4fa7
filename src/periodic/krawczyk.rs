//! Existence and uniqueness of a zero in a box: Krawczyk's operator, for any equations and in any arithmetic. Lemma T3
//!
//! Periodic orbits, bifurcations and the slabs of a branch are zeros of different equations; this operator proves all of them.

use super::entries::Entries;
use super::precondition::Preconditioner;
use crate::number::{Ball, Enclosing, Number};

/// A system of as many equations as unknowns, `F(x) = 0`.
pub trait Equations<N> {
    /// `F(x)`; `None` where it may not be defined.
    fn values(&self, x: &[N]) -> Option<Vec<N>>;
    /// `J`, which holds `F'` at all members of the box `x`; `None` where it may not be defined.
    fn jacobian(&self, x: &[N]) -> Option<Entries<N>>;
}

/// A proved zero: exactly one lies in `domain`, and it lies in `at`.
#[derive(Clone, Debug, PartialEq)]
pub struct Proved<N> {
    /// Encloses the zero: of an orbit, its phases.
    pub at: Vec<N>,
    /// Box in which there is no other zero.
    pub domain: Vec<N>,
}

/// Limits of a proof. Nothing that is proved rests on them.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// The radius of the largest domain that is tried.
    pub largest: f64,
    /// Number of domains that are tried.
    pub domains: u32,
    /// Images that narrow the zero: where nothing is rounded (at quarter periods) they would do so for ever.
    pub images: u32,
    /// Number of images that may narrow the zero by less than a quarter of a bit.
    pub slow: u32,
}

/// `2^-5`, the largest radius that is of use, in forcing periods, and the factor from one domain to the next.
pub(super) const MAX_RADIUS: f64 = 0.031_25;
const DOMAIN_FACTOR: f64 = 0.125;
/// The fewest bits that an image takes off an enclosure if it is not slow.
const MIN_GAIN_BITS: f64 = 0.25;
/// Bits that one step with a preconditioner in doubles adds at least, where it adds what it should.
pub(super) const PRECONDITIONED_GAIN_BITS: u32 = 32;

/// `x - Y_i F`: an entry of a step of simplified Newton's iteration.
fn newton<N: Enclosing>(x: &N, row: &[f64], misses: &[N]) -> N {
    row.iter().zip(misses).fold(x.clone(), |sum, (&y, f)| N::from_f64(-y).mul_add(f.clone(), sum))
}

/// Krawczyk's image `m - Y F(m) + (1 - Y J)(X - m)` of a box `X` with centre `m`. Lemma T3
pub(super) fn image<N: Enclosing>(equations: &dyn Equations<N>, inverse: &Preconditioner, x: &[N]) -> Option<Vec<N>> {
    let centre: Vec<N> = x.iter().map(Enclosing::centre).collect();
    let misses = equations.values(&centre)?;
    let jacobian = equations.jacobian(x)?;
    let image = |i: usize| {
        let row = inverse.row(i);
        // The row of 1 - Y J.
        let mut rest: Vec<N> = (0..row.len()).map(|j| N::from_f64(if i == j { 1.0 } else { 0.0 })).collect();
        for (l, j, slope) in jacobian.iter() {
            rest[j] = N::from_f64(-row[l]).mul_add(slope.clone(), rest[j].clone());
        }
        let newton = newton(&centre[i], row, &misses);
        rest.into_iter().zip(x).fold(newton, |sum, (g, x)| g.mul_add(x.spread(), sum))
    };
    Some((0..x.len()).map(image).collect())
}

/// [`image`] with `1 - Y J` enclosed in doubles, whatever the arithmetic: only deviations from the centre are multiplied by it, and `Y` itself
/// is the inverse of `J` no better than doubles are. Lemma T3
pub(super) fn image_by_doubles<N: Enclosing>(
    equations: &dyn Equations<N>,
    inverse: &Preconditioner,
    x: &[N],
) -> Option<Vec<N>> {
    let centre: Vec<N> = x.iter().map(Enclosing::centre).collect();
    let misses = equations.values(&centre)?;
    let jacobian = equations.jacobian(x)?;
    let slopes: Vec<(usize, usize, Ball)> = jacobian.iter().map(|(l, j, slope)| (l, j, slope.as_ball())).collect();
    let spreads: Vec<Ball> = x.iter().map(|x| Ball::exact(x.spread().as_ball().mag())).collect();
    let image = |i: usize| {
        let row = inverse.row(i);
        let mut rest = vec![Ball::exact(0.0); row.len()];
        rest[i] = Ball::exact(1.0);
        for &(l, j, slope) in &slopes {
            rest[j] = Ball::exact(-row[l]).mul_add(slope, rest[j]);
        }
        let spread = |sum: Ball, (g, x): (Ball, &Ball)| Ball::exact(g.mag()).mul_add(*x, sum);
        let most = rest.into_iter().zip(&spreads).fold(Ball::exact(0.0), spread).mag();
        newton(&centre[i], row, &misses) + N::from_f64(0.0).with_radius(most)
    };
    Some((0..x.len()).map(image).collect())
}

/// Whether each ball lies in the interior of its outer one.
pub fn is_inside<N: Enclosing>(inner: &[N], outer: &[N]) -> bool {
    inner.iter().zip(outer).all(|(inner, outer)| inner.is_interior_to(outer))
}

/// Guess after `steps` steps of simplified Newton's iteration; nothing is proved.
pub fn polish<N: Enclosing>(
    equations: &dyn Equations<N>,
    inverse: &Preconditioner,
    guess: Vec<N>,
    steps: u32,
) -> Vec<N> {
    let mut at = guess;
    for _ in 0..steps {
        let Some(misses) = equations.values(&at) else { break };
        at = at.iter().enumerate().map(|(i, x)| newton(x, inverse.row(i), &misses).centre()).collect();
    }
    at
}

/// Proves the one zero near a guess, with the largest domain of those tried, and narrows it. Lemma T3
///
/// `None` when no box around the guess is mapped into its interior: the guess is none, or the zero is too near to a double one or
/// to where the equations end for this arithmetic.
pub fn prove<N: Enclosing>(
    equations: &dyn Equations<N>,
    inverse: &Preconditioner,
    guess: &[N],
    limits: Limits,
) -> Option<Proved<N>> {
    let mut radius = limits.largest;
    for _ in 0..limits.domains {
        let domain: Vec<N> = guess.iter().map(|x| x.with_radius(radius)).collect();
        if let Some(at) = image(equations, inverse, &domain).filter(|image| is_inside(image, &domain)) {
            return Some(Proved { at: refine(equations, inverse, at, &domain, limits), domain });
        }
        radius *= DOMAIN_FACTOR;
    }
    None
}

/// Proves the one zero near a guess in a domain with its own radius for each unknown. A domain is somewhat larger than the image of the domain
/// before. Lemma T3
///
/// `None` as of [`prove`], or where the images grow without end: the equations hold for all members of intervals that are too wide.
pub fn prove_inflating<N: Enclosing>(
    equations: &dyn Equations<N>,
    inverse: &Preconditioner,
    guess: &[N],
    limits: Limits,
) -> Option<Proved<N>> {
    const INFLATION: f64 = 1.25;
    let mut domain: Vec<N> = guess.iter().map(|x| x.with_radius(limits.largest)).collect();
    for _ in 0..limits.domains {
        let at = image(equations, inverse, &domain)?;
        if is_inside(&at, &domain) {
            return Some(Proved { at: refine(equations, inverse, at, &domain, limits), domain });
        }
        let grown = |(guess, at): (&N, N)| {
            let needed = (at - guess.clone()).as_ball().mag();
            guess.with_radius((INFLATION * needed).max(f64::MIN_POSITIVE)) // proposes
        };
        domain = guess.iter().zip(at).map(grown).collect();
    }
    None
}

/// Narrows the enclosure of a proved zero as far as this arithmetic does, within its domain.
///
/// Each image holds the zero; a further one is worth its price while it takes something off the widest radius. Near a double zero
/// the first ones take little, and the narrower the box the more.
fn refine<N: Enclosing>(
    equations: &dyn Equations<N>,
    inverse: &Preconditioner,
    mut at: Vec<N>,
    domain: &[N],
    limits: Limits,
) -> Vec<N> {
    let mut slow = 0;
    for _ in 0..limits.images {
        let Some(narrower) = image(equations, inverse, &at) else { break };
        let gain = widest(&at) - widest(&narrower);
        if !(gain > 0.0 && is_inside(&narrower, domain)) {
            break;
        }
        at = narrower;
        slow += u32::from(gain < MIN_GAIN_BITS); // proposes: when to stop
        if slow > limits.slow {
            break;
        }
    }
    at
}

/// `log2` of the greatest radius.
pub(super) fn widest<N: Enclosing>(balls: &[N]) -> f64 {
    balls.iter().map(Enclosing::log2_radius).fold(f64::NEG_INFINITY, f64::max) // shown: widths, not bounds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Wave;
    use proptest::prelude::*;

    const LIMITS: Limits = Limits { largest: MAX_RADIUS, domains: 14, images: 40, slow: 0 };

    /// `x^2 + y^2 = 1`, `x sin a = y cos a`: the zeros are `(cos a, sin a)` and its opposite.
    struct Circle {
        sin: Ball,
        cos: Ball,
    }

    impl Equations<Ball> for Circle {
        fn values(&self, at: &[Ball]) -> Option<Vec<Ball>> {
            let (x, y) = (at[0], at[1]);
            Some(vec![x * x + y * y - Ball::exact(1.0), x * self.sin - y * self.cos])
        }

        fn jacobian(&self, at: &[Ball]) -> Option<Entries<Ball>> {
            let two = Ball::exact(2.0);
            Some(Entries::new(2, vec![(0, 0, two * at[0]), (0, 1, two * at[1]), (1, 0, self.sin), (1, 1, -self.cos)]))
        }
    }

    /// `x^2 = 0`: a double zero.
    struct Square;

    impl Equations<Ball> for Square {
        fn values(&self, at: &[Ball]) -> Option<Vec<Ball>> {
            Some(vec![at[0] * at[0]])
        }

        fn jacobian(&self, at: &[Ball]) -> Option<Entries<Ball>> {
            Some(Entries::new(1, vec![(0, 0, Ball::exact(2.0) * at[0])]))
        }
    }

    /// The inverse at these doubles.
    fn inverse(equations: &dyn Equations<Ball>, at: &[Ball]) -> Preconditioner {
        Preconditioner::new(&equations.jacobian(at).unwrap().map(|x| x.mid())).unwrap()
    }

    proptest! {
        #[test]
        fn a_known_zero_is_proved_narrowed_and_held(
            phase in prop_oneof![0.0..1.0f64, (0..8u32).prop_map(|n| f64::from(n) / 8.0)],
            off in prop::array::uniform2(-1e-3..1e-3f64),
        ) {
            let (sin, cos) = Ball::exact(phase).wave();
            let circle = Circle { sin, cos };
            let guess = [cos, sin].into_iter().zip(off).map(|(x, off)| Ball::exact(x.mid() + off)).collect::<Vec<_>>();
            let inverse = inverse(&circle, &guess);
            let Proved { at, domain } = prove(&circle, &inverse, &guess, LIMITS).unwrap();
            for (found, zero) in at.iter().zip([cos, sin]) {
                prop_assert!((found.mid() - zero.mid()).abs() <= found.rad() + zero.rad() && found.rad() < 1e-14);
            }
            prop_assert!(is_inside(&at, &domain));
            // No box that misses both zeros is mapped into itself.
            let away: Vec<Ball> = guess.iter().map(|x| Ball::exact(x.mid() + 0.25)).collect();
            prop_assert_eq!(prove(&circle, &inverse, &away, LIMITS), None);
        }

        /// T3 proves regular zeros only.
        #[test]
        fn a_double_zero_is_never_proved(guess in prop_oneof![-0.1..0.1f64, -1e-9..1e-9f64], slope in 1e-9..1.0f64) {
            let inverse = inverse(&Square, &[Ball::exact(slope)]);
            prop_assert_eq!(prove(&Square, &inverse, &[Ball::exact(guess)], LIMITS), None);
        }
    }
}
