//! Angles of given sine and cosine (Lemma W9).

use crate::exact::{Dyadic, Real};

/// Greatest number of steps of [`angle`]: each one triples the digits.
const STEPS: usize = 16;

/// The phase of `(cos, sin)`, between -pi and pi or a little beyond; `None` if the sets are too wide for one.
///
/// Encloses the angle whose sine and cosine are members of `sin` and `cos`. (Lemma W9)
pub(super) fn angle(sin: &Real, cos: &Real) -> Option<Real> {
    let guess = Dyadic::from_f64(sin.to_f64().atan2(cos.to_f64()))?;
    let mut at = Real::point(guess, sin.bits());
    let mut best: Option<Real> = None;
    for _ in 0..STEPS {
        let (s, c) = (at.sin(), at.cos());
        let y = sin * &c - cos * &s;
        let is_near = y.enclosure().mag() <= Dyadic::power_of_two(-1) && (cos * &c + sin * &s).is_positive();
        if !is_near {
            return best;
        }
        let size = Real::point(y.enclosure().mag(), y.bits());
        let error = &size.square() * &size;
        let here = &at + &y + (-&error).hull(&error);
        let next = best.as_ref().map_or(Some(here.clone()), |best| best.intersection(&here)).expect("both hold it");
        let is_better = best.is_none_or(|best| next.wid().scaled(1) < best.wid());
        at = next.middle();
        best = Some(next);
        if !is_better {
            break;
        }
    }
    best
}

/// The angle between 0 and pi with this cosine, for the members in `[-1, 1]`; `None` if there is none.
pub(super) fn acos(x: &Real) -> Option<Real> {
    let one = Real::int(1, x.bits());
    let value = x.intersection(&(-&one).hull(&one))?;
    // acos falls.
    let [low, high] = value.ends().map(|cos| angle(&(&one - &cos.square()).sqrt()?, &cos));
    Some(high?.hull(&low?))
}

/// `a`, `sin a` and `cos a` for the members `cos a = c <= 1` of a drift; at `c = 1` for greater ones.
pub(super) fn critical(drift: &Real) -> Option<(Real, Real, Real)> {
    let cosine = drift.at_most(1);
    let sine = (Real::int(1, drift.bits()) - cosine.square()).sqrt()?;
    Some((acos(&cosine)?, sine, cosine))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Enclosure;
    use proptest::prelude::*;

    fn point(x: f64, bits: u32) -> Real {
        Real::new(Enclosure::from_f64_bounds(x, x).unwrap(), bits)
    }

    proptest! {
        #[test]
        fn angles_are_found_again(t in -3.1..3.1f64, bits in 60u32..400) {
            let t = point(t, bits);
            let angle = angle(&t.sin(), &t.cos()).unwrap();
            prop_assert!(!angle.is_apart_from(&t));
            prop_assert!(angle.wid() < Dyadic::power_of_two(8 - i64::from(bits)));
            let arc = acos(&t.cos()).unwrap();
            prop_assert!(!arc.is_apart_from(&t) || !arc.is_apart_from(&-&t));
        }

        #[test]
        fn wide_sets_keep_their_members(t in 0.0..3.1f64, width in 0.0..0.04f64) {
            let set = point(t, 64).hull(&point(t + width, 64));
            let arc = acos(&set.cos()).unwrap();
            prop_assert!([t, t + width].iter().all(|&t| !arc.is_apart_from(&point(t, 64)) || t > 3.1));
            let angle = angle(&set.sin(), &set.cos()).unwrap();
            prop_assert!(!angle.is_apart_from(&point(t, 64)) && !angle.is_apart_from(&point(t + width, 64)));
        }
    }
}
