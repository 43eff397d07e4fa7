//! Number of common points of both manifolds on either side of a tangency (Lemma V31).

use num_traits::Signed;

use super::area::{Area, BITS, OTHER, PARAMETER, STABLE, STATES, UNSTABLE};
use super::chain::Chain;
use super::flights::Letter;
use super::krawczyk::{Found, System, parts};
use super::setting::Setting;
use super::shot::{Shot, Unknowns};
use crate::attraction::Bounds;
use crate::check::budget::Budget;
use crate::check::clock::{SetPosition, beside};
use crate::check::contact::Doubt;
use crate::check::frame::hull;
use crate::tangency::{ClaimedSides, ClaimedTangency};
use impact_pair_exact::{Dyadic, Real};

/// The greatest length of a word.
pub(super) const MAX_WORD_LENGTH: usize = 200;
/// Number of bisections of the curve of common points.
const BISECTIONS: u32 = 8;

/// The interval between two bounds.
pub(super) fn all(bounds: &Bounds) -> Real {
    hull(&bounds.each_ref().map(|bound| Real::rational(bound, BITS)))
}

/// Bounds half as wide again, and by more than rounding adds.
pub(super) fn wider(x: &Real) -> Real {
    let least = Real::within(&Dyadic::power_of_two(16 - i64::from(BITS)), BITS); // V31: a larger set is as sound
    x.clone() + &(x.clone() - &x.middle()).half() + &least
}

/// Whether values are proved to be within the bounds of the states.
pub(super) fn are_inside(found: &[Real], states: &[[Bounds; 2]]) -> bool {
    let is_inside = |(x, bounds): (&Real, &Bounds)| matches!(beside(x, bounds), SetPosition::Inside);
    found[STATES..].iter().zip(states.iter().flatten()).all(is_inside)
}

/// The curve of common points along the flights of a tangency.
struct Curve<'c, 'b> {
    claim: &'c ClaimedTangency,
    sides: &'c ClaimedSides,
    chain: Chain<'b>,
    system: System,
    two: Real,
    /// True if the two points occur for values of the parameter below the tangency's value.
    is_below: bool,
    /// Half the width of the other datum.
    spread: Real,
    /// Bounds of all claims and of all areas that are examined.
    bounds: Vec<Real>,
}

impl ClaimedTangency {
    /// Proves the claimed number of common points on both sides of the tangency, in the claimed boxes. Lemma V31
    pub(super) fn has_sides(
        &self,
        sides: &ClaimedSides,
        (setting, letters): (&Setting, &[Letter]),
        (at, shot): (&Unknowns, &Shot),
        budget: &Budget<'_>,
    ) -> Result<(), Doubt> {
        let count = letters.len();
        if count > MAX_WORD_LENGTH {
            return Err(Doubt::open("common points along more than 200 flights are not counted"));
        }
        let [two, none, own] = [&sides.two, &sides.none, &self.parameter].map(|bounds| setting.reduced(&all(bounds)));
        let (two, none, own) = (two?, none?, own?);
        let other = Real::of(&setting.other, BITS);
        let mut bounds = vec![all(&sides.unstable), all(&sides.stable), two.hull(&none), other.clone()];
        bounds.extend(sides.states.iter().flatten().map(all));
        let whole = [wider(&wider(&bounds[PARAMETER])), wider(&other)];
        let near = Real::rational(&self.phase[0], BITS);
        let chain =
            Chain::new(letters.to_vec(), (setting.is_restitution(), whole), &near, budget.clone()).map_err(unproved)?;
        let spread = Area::of(&bounds).radii[OTHER].clone();
        // The tangency, with phases as in the boxes.
        let mut values = at.clone().map(|x| x.at(BITS)).to_vec();
        values.push(other);
        for ([phase, speed], own) in shot.states[1..count].iter().zip(bounds[STATES..].chunks(2)) {
            let turns = ((phase.to_f64() - own[0].to_f64()) / std::f64::consts::TAU).round() as i64; // V31: any whole number
            values.extend([phase.at(BITS) - &(Real::pi(BITS) * 2 * turns), speed.at(BITS)]);
        }
        let start = values.iter().map(Real::middle).collect();
        let unknowns = [STABLE, PARAMETER].into_iter().chain(STATES..bounds.len()).collect();
        let system = System { equations: 2 * count, unknowns, given: vec![UNSTABLE, OTHER] };
        let ends = bounds[UNSTABLE].ends();
        let is_below = two.is_below(&own);
        let mut curve = Curve { claim: self, sides, chain, system, two, is_below, spread, bounds };
        curve.is_proved(start, &ends).map_err(unproved)?;
        curve.system.is_only(&mut curve.chain, &Area::of(&curve.bounds)).map_err(unproved)?;
        // The tangency is on the curve.
        let holds = |(own, x): (&Real, &Real)| own.enclosure().contains_enclosure(x.enclosure());
        if curve.bounds.iter().zip(&values).all(holds) {
            Ok(())
        } else {
            Err(Doubt::open("the tangency is not proved to be among the common points"))
        }
    }
}

/// Turns a refutation into an undecided claim: it may concern other orbits than the claimed ones.
fn unproved(doubt: Doubt) -> Doubt {
    match doubt {
        Doubt::False(message) | Doubt::Open(message) => Doubt::Open(format!("beside the tangency: {message}")),
    }
}

impl Curve<'_, '_> {
    /// Proves the whole curve, from one end of `sigma_u` to the other; at both ends the parameter is beyond the range with two points.
    fn is_proved(&mut self, near: Vec<Real>, ends: &[Real; 2]) -> Result<(), Doubt> {
        for end in ends {
            let found = self.found(near.clone(), [end, end])?;
            if !self.is_beyond(&found.bounds[PARAMETER]) {
                return Err(Doubt::open("the boxes may not hold the common points of all of the range with two"));
            }
        }
        parts(ends).iter().try_for_each(|part| self.pieces(near.clone(), part, BISECTIONS))
    }

    fn is_beyond(&self, parameter: &Real) -> bool {
        if self.is_below { parameter.is_below(&self.two) } else { self.two.is_below(parameter) }
    }

    /// The common points for all values of `sigma_u` between `low` and `high`.
    fn found(&mut self, near: Vec<Real>, [low, high]: [&Real; 2]) -> Result<Found, Doubt> {
        let mut at = near;
        at[UNSTABLE] = low.hull(high).middle();
        let radius = Area::of(&[low.hull(high)]).radii[0].clone();
        let found = self.system.found(&mut self.chain, at, &[(UNSTABLE, radius), (OTHER, self.spread.clone())])?;
        for (own, x) in self.bounds.iter_mut().zip(found.area.hulls()) {
            *own = own.hull(&x);
        }
        Ok(found)
    }

    /// Whether all tangencies of a piece of the curve unfold as the claimed tangency, and whether the states of the piece are in the boxes
    /// where its parameter may be in the range with two points.
    fn is_as_claimed(&self, found: &Found) -> bool {
        let claimed = [&self.claim.quadratic, &self.claim.unfolding];
        let is_alike = |(own, [low, _]): (&Real, &Bounds)| {
            if low.is_positive() { own.is_positive() } else { own.is_negative() }
        };
        let is_stable_inside = || matches!(beside(&found.bounds[STABLE], &self.sides.stable), SetPosition::Inside);
        found.over.unfolding.iter().zip(claimed).all(is_alike)
            && (self.is_beyond(&found.bounds[PARAMETER])
                || is_stable_inside() && are_inside(&found.bounds, &self.sides.states))
    }

    fn pieces(&mut self, near: Vec<Real>, [low, high]: &[Real; 2], depth: u32) -> Result<(), Doubt> {
        let found = self.found(near.clone(), [low, high]);
        let near = match found {
            Ok(found) if self.is_as_claimed(&found) => return Ok(()),
            Err(doubt) if depth == 0 => return Err(doubt),
            _ if depth == 0 => return Err(Doubt::open("the common points are not proved to be in the boxes")),
            Ok(found) => found.area.centre,
            Err(_) => near,
        };
        let middle = low.hull(high).middle();
        self.pieces(near.clone(), &[low.clone(), middle.clone()], depth - 1)?;
        self.pieces(near, &[middle, high.clone()], depth - 1)
    }
}
