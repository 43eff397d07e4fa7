//! Trace, determinant, eigenvalues and stability of a period: equations (38)-(40), Lemma T4.

use std::cmp::Ordering;

use crate::exact::{Dyadic, Enclosure};
use crate::number::{Enclosing, Number};
pub use impact_pair_model::vocabulary::Stability;

/// Stability from trace and determinant, a power of the restitution: Jury's conditions, with the signs of (39) and (40). Lemma T4
pub fn stability<N: Enclosing>(trace: &N, determinant: &N, restitution: &N) -> Stability {
    let one = || N::from_f64(1.0);
    let sum = one() + determinant.clone();
    // (40) and (39): the characteristic polynomial at 1 and at -1.
    let ends = [sum.clone() - trace.clone(), sum + trace.clone()].map(|x| x.certain_sign());
    if ends.contains(&Some(Ordering::Less)) {
        return Stability::Unstable;
    }
    // T4: 1 - e has the sign of 1 - q, and is exactly 0 where e is 1
    let shrinks = (one() - restitution.clone()).certain_sign();
    match shrinks.filter(|_| ends == [Some(Ordering::Greater); 2]) {
        Some(Ordering::Greater) => Stability::Stable,
        Some(Ordering::Equal) => Stability::Elliptic,
        _ => Stability::Undecided,
    }
}

/// Trace of the period's Jacobian.
pub fn trace<N: Number>(monodromy: &[[N; 2]; 2]) -> N {
    monodromy[0][0].clone() + monodromy[1][1].clone()
}

/// Determinant of the period's Jacobian: `e^(2k)` after `k` impacts, exactly. Lemma T4
pub fn determinant<N: Number>(restitution: &N, impacts: usize) -> N {
    let square = restitution.clone() * restitution.clone();
    (1..impacts).fold(square.clone(), |power, _| power * square.clone())
}

/// An eigenvalue: real and imaginary part.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigenvalue {
    /// Real part.
    pub re: Enclosure,
    /// Imaginary part; the point 0 when the eigenvalue is proved to be real.
    pub im: Enclosure,
}

/// Encloses both eigenvalues, the one of larger modulus first. **Equation** (38)
///
/// A pair that may be real or complex has both parts enclosed for either case.
pub fn eigenvalues(trace: &Enclosure, determinant: &Enclosure, bits: u32) -> [Eigenvalue; 2] {
    let zero = || Enclosure::point(Dyadic::zero());
    let whole = |n: f64| Enclosure::from_f64_bounds(n, n).expect("a finite number");
    let half = |x: &Enclosure| x.mul(&whole(0.5), bits);
    let under = trace.mul(trace, bits).sub(&determinant.mul(&whole(4.0), bits), bits);
    let middle = half(trace);
    let apart = |re: &Enclosure, im: &Enclosure| {
        [
            Eigenvalue { re: middle.add(re, bits), im: im.clone() },
            Eigenvalue { re: middle.sub(re, bits), im: im.negated() },
        ]
    };
    let root_of = |end: &Dyadic| Enclosure::point(end.clone()).sqrt(bits).map_or_else(zero, |root| half(&root));
    match under.sign() {
        Some(Ordering::Greater) => {
            let root = half(&under.sqrt(bits).expect("a positive number"));
            // The larger one without cancellation; the other by the determinant.
            let large = match trace.sign() {
                Some(Ordering::Greater) => middle.add(&root, bits),
                Some(Ordering::Less) => middle.sub(&root, bits),
                _ => return apart(&root, &zero()),
            };
            let small = determinant.div(&large, bits).expect("larger than 0");
            [Eigenvalue { re: large, im: zero() }, Eigenvalue { re: small, im: zero() }]
        }
        Some(Ordering::Less) => apart(&zero(), &half(&under.negated().sqrt(bits).expect("a positive number"))),
        _ => {
            let re = zero().hull(&root_of(under.sup()));
            let im = zero().hull(&root_of(under.negated().sup()));
            apart(&re, &im)
        }
    }
}
