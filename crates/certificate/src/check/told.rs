//! What a shadowed orbit says of its start and of its boxes, before any flight is followed (Lemma V10).

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::One;

use super::FIRST_BITS;
use super::clock::{Beside, beside};
use super::contact::Doubt;
use super::shadow::{Doubted, Shadow};
use super::standing::Last;
use super::walk::{are_bounds, is_next};
use crate::ClaimKind;
use impact_pair_exact::{Exact, Real, compare_rational};

impl Shadow<'_> {
    /// The impacts have their numbers and mappings.
    pub(super) fn fits(&self, mut last: Last) -> Result<(), Doubted> {
        for (k, claim) in self.certificate.events()[..self.hits.len()].iter().enumerate() {
            let ClaimKind::Impact { index, mapping, velocity } = &claim.kind else { break };
            // exact: a length
            let is_numbered = is_next(k as u64, *index);
            is_numbered
                .and_then(|()| last.leads(*mapping, claim.wall))
                .and_then(|()| are_bounds(velocity))
                .map_err(|doubt| (k, doubt))?;
            last = Last::Wall(claim.wall);
        }
        Ok(())
    }

    /// The bounds of the start are bounds, and hold the scene's start.
    pub(super) fn starts_as_told(&self) -> Result<(), Doubt> {
        let [time, velocity] = self.bounds();
        if [&time, &velocity].iter().any(|[lower, upper]| lower > upper) {
            return Err(Doubt::False("a lower bound of the start is above the upper one".into()));
        }
        let start = self.certificate.start();
        for (what, exact, bounds, is_varied) in [
            ("time", start.time(), time, self.is_of_times),
            ("velocity", start.velocity(), velocity, !self.is_of_times),
        ] {
            match place(exact, &bounds) {
                Beside::Inside => {}
                Beside::Outside if !is_varied => {
                    return Err(Doubt::False(format!("the start has not the scene's {what}")));
                }
                _ => return Err(Doubt::Open(format!("the {what} of the start is not told around the scene's"))),
            }
        }
        Ok(())
    }

    /// Bounds of the start's time and velocity.
    pub(super) fn bounds(&self) -> [[BigRational; 2]; 2] {
        [&self.near.time, &self.near.velocity].map(|bounds| bounds.each_ref().map(|bound| bound.value()))
    }

    /// The bounds of the impacts are as narrow as is told, but for their last digits.
    pub(super) fn is_as_near_as_told(&self) -> Result<(), Doubt> {
        let Some(told) = &self.certificate.ended().epsilon else { return Ok(()) };
        let impacts = self.certificate.events().iter().filter(|claim| matches!(claim.kind, ClaimKind::Impact { .. }));
        let mut widths: Vec<_> = impacts.map(|claim| certain_width(&claim.time)).collect();
        widths.sort();
        let Some(widest) = widths.last() else { return Ok(()) };
        let frequency = Real::of(self.certificate.pair().excitation().reference().frequency(), FIRST_BITS);
        let turns =
            frequency.over(&(Real::pi(FIRST_BITS) * 4)).ok_or_else(|| Doubt::Open("a turn is too short".into()))?;
        let middle = &widths[(widths.len() - 1) / 2];
        for (what, width, told) in [("half of them are", middle, &told.median), ("one is", widest, &told.maximum)] {
            let half = Real::rational(width, FIRST_BITS) * &turns;
            if compare_rational(half.enclosure().sup(), &told.value()).is_gt() {
                return Err(Doubt::Open(format!("the bounds are wider than is told: {what}")));
            }
        }
        Ok(())
    }
}

/// Where an exact number lies beside bounds.
fn place(exact: &Exact, bounds: &[BigRational; 2]) -> Beside {
    match exact.as_rational() {
        Some(x) if bounds[0] <= *x && *x <= bounds[1] => Beside::Inside,
        Some(_) => Beside::Outside,
        None => beside(&Real::of(exact, FIRST_BITS), bounds),
    }
}

/// The width of bounds less a unit in the last place of each, which rounding outward may have added.
fn certain_width([lower, upper]: &[BigRational; 2]) -> BigRational {
    let mut places = BigInt::one();
    while [lower, upper].iter().any(|bound| !places.is_multiple_of(bound.denom())) {
        places *= 10;
    }
    upper - lower - BigRational::new(2.into(), places)
}
