//! Trace, determinant, eigenvalues (38) and stability of the map over a period (Lemma W4).

use std::cmp::Ordering;

use super::motion::Motion;
use crate::exact::Real;
use crate::periodic::Stability;

/// The spectrum of `DP` over a period.
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    pub trace: Real,
    pub determinant: Real,
    /// Real and imaginary parts, (38).
    pub eigenvalues: [[Real; 2]; 2],
    pub stability: Stability,
}

impl Spectrum {
    /// `None` if the speed may be 0.
    pub fn of(motion: &Motion) -> Option<Self> {
        let e = &motion.parameters.restitution;
        let square = e.square();
        let determinant = square.square();
        // The derivative of the half map, whose square DP is, knows more: its trace is the larger number.
        let (trace, discriminant, stability) = if motion.is_symmetric {
            let half = half_trace(motion)?.square();
            let discriminant = &half * (&half - &square * 4);
            let stability = match stability(&half, &(&square + 1).square(), e) {
                // W4: the trace of DP is -2 where that of the half map is 0.
                Stability::Elliptic if half.sign() != Some(Ordering::Greater) => Stability::Undecided,
                stability => stability,
            };
            (half - &square * 2, discriminant, stability)
        } else {
            let trace = product_trace(motion)?;
            let discriminant = trace.square() - &determinant * 4;
            let stability = stability(&trace.square(), &(&determinant + 1).square(), e);
            (trace, discriminant, stability)
        };
        let eigenvalues = eigenvalues(&trace, &discriminant);
        Some(Self { trace, determinant, eigenvalues, stability })
    }
}

/// Stability, from the square of the trace and from `bound`, the square of 1 plus the determinant.
fn stability(trace: &Real, bound: &Real, e: &Real) -> Stability {
    let is_elastic = (e - 1).sign() == Some(Ordering::Equal);
    match (trace - bound).sign() {
        Some(Ordering::Greater) => Stability::Unstable,
        Some(Ordering::Less) if is_elastic => Stability::Elliptic,
        Some(Ordering::Less) => Stability::Stable,
        _ => Stability::Undecided,
    }
}

/// `tr M = 2e + (1 + e) N pi sin th0/V`.
fn half_trace(motion: &Motion) -> Option<Real> {
    let e = &motion.parameters.restitution;
    let swing = (motion.parameters.half_period() * &motion.left.0).over(&motion.speed)?;
    Some(e * 2 + (e + 1) * swing)
}

/// The trace of `M(-s1, -s0, q) M(s0, s1, p)`.
fn product_trace(motion: &Motion) -> Option<Real> {
    let (s0, s1) = (&motion.left.0, &motion.right.0);
    let there = passage(motion, s0, s1, &motion.spacing)?;
    let back = passage(motion, &-s1, &-s0, &motion.back())?;
    let [[a, b], [c, d]] = &there;
    let [[p, q], [r, s]] = &back;
    Some(p * a + q * c + r * b + s * d)
}

/// `M(s0, s1, h)` in `(theta, |v|)`, (A.7).
fn passage(motion: &Motion, s0: &Real, s1: &Real, h: &Real) -> Option<[[Real; 2]; 2]> {
    let e = &motion.parameters.restitution;
    let time = h.over(&motion.speed)?;
    let f = s0 * &time + e;
    let shift = e * &time;
    Some([[f.clone(), -&shift], [s1 * &f - s0, e - s1 * &shift]])
}

/// `[tr +- sqrt(tr^2 - 4 det)]/2` (38), real and imaginary parts; of either kind where the sign below the root is not certain.
fn eigenvalues(trace: &Real, discriminant: &Real) -> [[Real; 2]; 2] {
    let nothing = || Real::int(0, trace.bits());
    let real = discriminant.sqrt().unwrap_or_else(nothing);
    let imaginary = (-discriminant).sqrt().unwrap_or_else(nothing).half();
    [[(trace + &real).half(), imaginary.clone()], [(trace - real).half(), -imaginary]]
}
