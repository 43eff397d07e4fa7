//! Distances of a shadowed orbit: of its start from the scene's start, of its impacts from the listed impacts (Lemma V10).

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::FIRST_BITS;
use super::clock::{SetPosition, beside};
use super::contact::Doubt;
use super::shadow::{Doubted, Shadow};
use super::standing::Last;
use super::walk::is_next;
use crate::Certificate;
use impact_pair_document::ClaimName;
use impact_pair_exact::{Dyadic, Exact, Real, decimal_bounds_f64};
use impact_pair_model::{EventKind, Harmonic, Place};

impl Shadow<'_> {
    /// Proves the numbers and mappings of the impacts.
    pub(super) fn fits(&self, mut last: Last) -> Result<(), Doubted> {
        for (k, claim) in self.certificate.events()[..self.hits.len()].iter().enumerate() {
            let EventKind::Impact { index, mapping, .. } = &claim.kind else { break };
            // exact: a length
            let is_numbered = is_next(k as u64, *index);
            is_numbered.and_then(|()| last.leads(*mapping, claim.wall)).map_err(|doubt| (k, doubt))?;
            last = Last::Wall(claim.wall);
        }
        Ok(())
    }

    /// Proves that the bounds of the start hold the scene's start, and that all of the bounds are near the scene's start.
    pub(super) fn starts_around_the_scenes(&self) -> Result<(), Doubt> {
        let [time, velocity] = self.bounds();
        let start = self.certificate.start();
        for (what, exact, bounds, is_varied) in [
            ("time", start.time(), time, self.is_of_times),
            ("velocity", start.velocity(), velocity, !self.is_of_times),
        ] {
            match place(exact, &bounds) {
                SetPosition::Inside => {}
                SetPosition::Outside if !is_varied => {
                    return Err(Doubt::False(format!("the start has not the scene's {what}")));
                }
                _ => return Err(Doubt::Open(format!("the bounds of the start's {what} do not hold the scene's"))),
            }
            if is_varied && !reach(exact, &bounds).is_below(&self.near()) {
                return Err(Doubt::Open(format!(
                    "the bounds of the start's {what} are too wide to call it near the scene's"
                )));
            }
        }
        Ok(())
    }

    /// Greatest distance of a near start: a thousandth of the time between two maxima of the excitation, or of the sum of the scene's
    /// speeds (the start's speed and the greatest speed of each harmonic).
    fn near(&self) -> Real {
        let (harmonics, of) = (self.certificate.pair().excitation(), |x: &Exact| Real::of(x, FIRST_BITS));
        let whole = if self.is_of_times {
            let turn = Real::pi(FIRST_BITS) * 2;
            turn.over(&of(harmonics.reference().frequency())).unwrap_or_else(|| Real::zero(FIRST_BITS)) // exact: nothing is near
        } else {
            let speed = Real::point(of(self.certificate.start().velocity()).enclosure().mag(), FIRST_BITS);
            let shaken = |harmonic: &Harmonic| of(harmonic.amplitude()) * &of(harmonic.frequency());
            harmonics.harmonics().iter().map(shaken).fold(speed, |sum, speed| sum + &speed)
        };
        whole * &Real::rational(&BigRational::new(1.into(), 1000.into()), FIRST_BITS)
    }

    /// Bounds of the start's time and velocity.
    pub(super) fn bounds(&self) -> [[BigRational; 2]; 2] {
        [&self.near.time, &self.near.velocity].map(impact_pair_document::Bounds::values)
    }

    /// Proves that the impacts are within the claimed distance of the middles of their bounds; `offs` \[rad\] are upper bounds. The bounds
    /// themselves may exceed it only by the rounding of printing.
    pub(super) fn is_within_epsilon(&self, offs: Vec<Dyadic>) -> Result<(), Doubt> {
        let Some(claimed) = &self.certificate.ended().epsilon else { return Ok(()) };
        let impacts = self.certificate.events().iter().filter(|claim| claim.kind.is_impact());
        let frequency = Real::of(self.certificate.pair().excitation().reference().frequency(), FIRST_BITS);
        // P1: bounds are printed at most a hundredth wider than the enclosure.
        let printed = Real::rational(&BigRational::new(101.into(), 100.into()), FIRST_BITS);
        let half = |[lower, upper]: &[BigRational; 2]| {
            let half = Real::rational(&((upper - lower) / BigInt::from(2)), FIRST_BITS);
            (half * &frequency).over(&printed).map_or_else(Dyadic::zero, |half| half.enclosure().inf().clone()) // exact: not 0
        };
        let halves: Vec<_> = impacts.map(|claim| half(&claim.time)).collect();
        let turn = Real::pi(FIRST_BITS) * 2;
        for (what, mut all) in [("the impacts", offs), ("the bounds of the impacts", halves)] {
            all.sort();
            let Some(most) = all.last() else { return Ok(()) };
            let median = &all[(all.len() - 1) / 2];
            for (which, found, epsilon) in [("half", median, &claimed.median), ("all", most, &claimed.maximum)] {
                let epsilon = Real::rational(&epsilon.value(), FIRST_BITS) * &turn;
                if found > epsilon.enclosure().inf() {
                    return Err(Doubt::Open(format!(
                        "{what} are not proved to be as near as claimed: {which} of them"
                    )));
                }
            }
        }
        Ok(())
    }
}

impl Certificate {
    /// The claimed distance of a shadowed orbit's start from the scene's start, in words; empty for the scene's own start.
    pub(crate) fn nearness(&self) -> String {
        let Some(near) = self.ended().start.as_ref().filter(|_| self.claim() == ClaimName::Shadowed) else {
            return String::new();
        };
        let is_zero = |x: &Exact| x.sign() == Some(Ordering::Equal);
        let is_at_rest = is_zero(self.start().velocity()) || is_zero(self.pair().restitution());
        let is_of_times = matches!(self.start().place(), Place::Wall(_)) && is_at_rest;
        let (what, exact, bounds) = match is_of_times {
            true => ("time", self.start().time(), &near.time),
            false => ("velocity", self.start().velocity(), &near.velocity),
        };
        let reach = reach(exact, &bounds.values()).enclosure().sup().to_f64_up();
        let [_, reach] = decimal_bounds_f64(0.5 * reach, reach);
        format!(", of a start whose {what} is within {reach} of the scene's")
    }
}

/// Upper bound of the distance of members of the bounds from an exact number.
fn reach(exact: &Exact, bounds: &[BigRational; 2]) -> Real {
    let exact = Real::of(exact, FIRST_BITS);
    let [lower, upper] = bounds.each_ref().map(|bound| (Real::rational(bound, FIRST_BITS) - &exact).enclosure().mag());
    Real::point(lower.max(upper), FIRST_BITS) // exact: the farther end
}

/// The position of an exact number relative to bounds.
fn place(exact: &Exact, bounds: &[BigRational; 2]) -> SetPosition {
    match exact.as_rational() {
        Some(x) if bounds[0] <= *x && *x <= bounds[1] => SetPosition::Inside,
        Some(_) => SetPosition::Outside,
        None => beside(&Real::of(exact, FIRST_BITS), bounds),
    }
}
