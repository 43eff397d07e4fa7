//! The exponent in the limit, of an orbit that converges to a stable periodic one: Lemma L4.

use super::Passed;
use crate::exact::{Dyadic, Enclosure};
use crate::number::{Ball, Number, logarithm};
use crate::periodic::{PeriodicOrbit, Stability};

/// Bounds of `ln rho` per impact, `rho` being the spectral radius of the period's Jacobian: what the finite-time exponents of every
/// orbit that converges to this one tend to; `None` where they have no derivative after what the disturbance has `passed`. Lemma L4
///
/// **Equation** (38)
/// **Range** Below 0 for a stable orbit; the lower bound is minus infinity where a rest has forgotten all disturbances, and where `e` is, or may
/// be, 0: then a motion may forget them at one impact, whatever `rho` is.
pub fn limit(orbit: &PeriodicOrbit, passed: Passed) -> Option<[f64; 2]> {
    if passed == Passed::Break {
        return None; // L4: only a motion whose map has a derivative
    }
    let impacts = orbit.impacts.len();
    let bits = orbit.bits + GUARD;
    // L4: the square of the larger modulus lies between the larger lower and the larger upper end of both.
    let square = |x: &Enclosure| x.powi(2, bits).expect("a power that is not negative");
    let [one, other] =
        orbit.eigenvalues.each_ref().map(|eigenvalue| square(&eigenvalue.re).add(&square(&eigenvalue.im), bits));
    let larger = |one: &Dyadic, other: &Dyadic| if one < other { other.clone() } else { one.clone() };
    // L4: nor is it below the product of both.
    let least = larger(&larger(one.inf(), other.inf()), &orbit.determinant.mig());
    let [low, high] = [least, larger(one.sup(), other.sup())].map(|square| per_impact(&square, impacts));
    let is_invertible = orbit.determinant.mig().sign().is_gt() && passed == Passed::Flights;
    let low = low.filter(|_| is_invertible); // L4: e > 0, and no rest before
    let high = high.map_or(f64::NEG_INFINITY, |[_, high]| high);
    // L4: of a stable orbit it is below 1, whatever the enclosures of the eigenvalues say
    let high = if orbit.stability == Stability::Stable { high.min(0.0) } else { high };
    Some([low.map_or(f64::NEG_INFINITY, |[low, _]| low), high])
}

/// Bits beyond those of the orbit, so that nothing is lost to rounding here.
const GUARD: u32 = 32;

/// Bounds of `ln(square)/(2 n)`; `None` for `ln 0`.
fn per_impact(square: &Dyadic, impacts: usize) -> Option<[f64; 2]> {
    let top = square.top()?;
    // A power of two is taken out, so that no double is out of range.
    let (low, high) = Enclosure::point(square.scaled(-top)).to_f64_bounds();
    let [low, high] = [low, high].map(|end| logarithm(Ball::exact(end)).expect("it lies in [1, 2]"));
    let exponent = Ball::exact(top as f64); // exact: far below 2^53
    let two = logarithm(Ball::exact(2.0)).expect("2 is positive");
    let count = Ball::exact(2.0 * impacts as f64); // exact: a length
    let all = |mantissa: Ball| {
        let quotient = (mantissa + exponent * two).checked_div(count).expect("a word has impacts");
        quotient.enclosure().expect("finite").to_f64_bounds()
    };
    Some([all(low).0, all(high).1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::periodic::{Precision, Problem};
    use crate::tests::{pair_of, start};

    /// Orbits of two impacts a cycle with `A = 1`.
    fn orbits(gap: &str, restitution: &str) -> Vec<PeriodicOrbit> {
        let pair = pair_of(&[["1", "pi", "0"]], gap, restitution);
        Problem::new(&pair, &"RL".parse().unwrap(), 1).unwrap().find(&start(), Precision::default()).orbits
    }

    /// Of a complex pair both moduli are `e^n`, after `n` impacts: the limit is `ln e`, whatever the orbit.
    #[test]
    fn the_limit_for_a_complex_pair_is_the_logarithm_of_the_restitution() {
        let complex = |orbit: &&PeriodicOrbit| orbit.eigenvalues[0].im.sign() == Some(std::cmp::Ordering::Greater);
        let mut seen = 0;
        for restitution in ["0.5", "0.6", "0.7", "0.8", "0.9"] {
            for orbit in orbits("3*pi", restitution).iter().filter(complex) {
                let [low, high] = limit(orbit, Passed::Flights).unwrap();
                let truth = restitution.parse::<f64>().unwrap().ln();
                assert!(low <= truth && truth <= high && high - low < 1e-12, "{restitution}: {low} {high}");
                seen += 1;
            }
        }
        assert!(seen > 0, "no complex pair");
    }

    /// Of a real pair the trace is the sum of both: `rho + e^(2n)/rho`.
    #[test]
    fn the_limit_for_a_real_pair_reproduces_the_trace() {
        let real = |orbit: &&PeriodicOrbit| orbit.eigenvalues[0].im.is_point() && orbit.stability == Stability::Stable;
        let mut seen = 0;
        for gap in ["9.42497", "9.425", "9.43"] {
            for orbit in orbits(gap, "0.5").iter().filter(real) {
                let [low, high] = limit(orbit, Passed::Flights).unwrap().map(|end| (2.0 * end).exp());
                let trace = orbit.trace.mid_rad().0.abs();
                assert!((low + 0.0625 / low - trace).abs() < 1e-8 && high - low < 1e-8, "{low} {high} {trace}");
                seen += 1;
            }
        }
        assert!(seen > 0, "no real pair");
    }

    /// Far beyond doubles: the powers of two are taken out.
    #[test]
    fn squares_beyond_doubles_have_a_logarithm() {
        let [low, high] = per_impact(&Dyadic::power_of_two(-4000), 1000).unwrap();
        let truth = -2.0 * std::f64::consts::LN_2;
        assert!(low <= truth && truth <= high && high - low < 1e-14, "{low} {high}");
        assert!(per_impact(&Dyadic::zero(), 1).is_none());
    }
}
