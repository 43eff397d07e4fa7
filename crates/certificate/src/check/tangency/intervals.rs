//! Tangencies for all values of an interval of the other datum (Lemma V32).

use super::area::{Area, BITS, OTHER, PARAMETER, STABLE, STATES, UNSTABLE};
use super::beside::{MAX_WORD_LENGTH, all, are_inside, wider};
use super::chain::Chain;
use super::flights::Letter;
use super::krawczyk::{Found, System, parts};
use super::saddle::{Family, Law};
use super::setting::Setting;
use super::shot::{Range, known};
use super::{at_least, no_resonance};
use crate::attraction::Bounds;
use crate::check::budget::Budget;
use crate::check::clock::{SetPosition, beside};
use crate::check::contact::Doubt;
use crate::tangency::ClaimedTangency;
use impact_pair_exact::Real;

/// Number of bisections of the interval.
const BISECTIONS: u32 = 8;

/// The tangencies of a family.
struct Tangencies<'c, 'b> {
    claim: &'c ClaimedTangency,
    states: &'c [[Bounds; 2]],
    setting: &'c Setting,
    chain: Chain<'b>,
    system: System,
    range: Range<'b>,
}

impl ClaimedTangency {
    /// Proves that there is one tangency for each value of the other datum, and returns the bits used. Lemma V32
    pub(super) fn is_for_each(
        &self,
        states: &[[Bounds; 2]],
        (setting, letters): (&Setting, Vec<Letter>),
        budget: &Budget<'_>,
    ) -> Result<u32, Doubt> {
        let count = letters.len();
        if count > MAX_WORD_LENGTH {
            return Err(Doubt::open("tangencies along more than 200 flights are not checked for an interval"));
        }
        let other = Real::of(&setting.other, BITS);
        let parameter = setting.reduced(&all(&self.parameter))?;
        let law =
            known(Family { is_restitution: setting.is_restitution(), other: other.clone() }.law_over(&parameter))?;
        self.is_saddle(&law)?;
        let mut bounds = vec![all(&self.unstable), all(&self.stable), parameter, other];
        bounds.extend(states.iter().flatten().map(all));
        let area = Area::of(&bounds);
        let whole = [wider(&bounds[PARAMETER]), wider(&bounds[OTHER])];
        let near = Real::rational(&self.phase[0], BITS);
        let range = Range::new(Vec::new(), near.clone(), budget.clone());
        let chain = Chain::new(letters, (setting.is_restitution(), whole), &near, budget.clone())?;
        let unknowns = [UNSTABLE, STABLE, PARAMETER].into_iter().chain(STATES..bounds.len()).collect();
        let system = System { equations: 2 * count + 1, unknowns, given: vec![OTHER] };
        let mut family = Tangencies { claim: self, states, setting, chain, system, range };
        let parts = parts(&bounds[OTHER].ends());
        parts.iter().try_for_each(|part| family.pieces(area.centre.clone(), part, BISECTIONS))?;
        family.system.is_only(&mut family.chain, &area)?;
        Ok(BITS)
    }
}

impl Tangencies<'_, '_> {
    /// The tangencies for all values of the other datum between `low` and `high`.
    fn found(&mut self, near: Vec<Real>, [low, high]: &[Real; 2]) -> Result<Found, Doubt> {
        let mut at = near;
        let others = low.hull(high);
        at[OTHER] = others.middle();
        let radius = Area::of(&[others]).radii[0].clone();
        self.system.found(&mut self.chain, at, &[(OTHER, radius)])
    }

    /// Whether all tangencies are proved to be within the claimed bounds.
    fn are_inside(&self, found: &Found) -> Result<bool, Doubt> {
        let parameter = self.setting.parameter(&found.bounds[PARAMETER]);
        let parameter = parameter.ok_or_else(|| Doubt::open("the parameter is not proved to be positive"))?;
        let is_inside = |x: &Real, bounds: &Bounds| matches!(beside(x, bounds), SetPosition::Inside);
        Ok(is_inside(&parameter, &self.claim.parameter)
            && is_inside(&found.bounds[UNSTABLE], &self.claim.unstable)
            && is_inside(&found.bounds[STABLE], &self.claim.stable)
            && are_inside(&found.bounds, self.states))
    }

    /// Proves that all numbers of the tangencies are as claimed.
    fn compare(&self, found: &Found) -> Result<(), Doubt> {
        let (claim, setting) = (self.claim, self.setting);
        let family = Family { is_restitution: setting.is_restitution(), other: found.bounds[OTHER].clone() };
        let law: Law = known(family.law_over(&found.bounds[PARAMETER]))?;
        let eigenvalues = claim.compare_fixed_point(&law, &self.range.saddle(&law)?)?;
        no_resonance(eigenvalues.each_ref(), claim.resonances)?;
        let [quadratic, unfolding] = &found.over.unfolding;
        claim.compare_unfolding([quadratic, unfolding])?;
        at_least("speed", &found.over.speeds, &claim.least_speed)?;
        at_least("flight", &found.over.times, &claim.least_flight)
    }

    fn pieces(&mut self, near: Vec<Real>, ends: &[Real; 2], depth: u32) -> Result<(), Doubt> {
        let found = self.found(near.clone(), ends);
        let (near, doubt) = match found {
            Ok(found) => match self.are_inside(&found)? {
                true => match self.compare(&found) {
                    Err(Doubt::Open(message)) => (found.area.centre, Doubt::Open(message)),
                    answer => return answer,
                },
                false => (found.area.centre, Doubt::open("the tangencies are not proved to be within the bounds")),
            },
            Err(doubt) => (near, doubt),
        };
        if depth == 0 {
            return Err(doubt);
        }
        let [low, high] = ends;
        let middle = low.hull(high).middle();
        self.pieces(near.clone(), &[low.clone(), middle.clone()], depth - 1)?;
        self.pieces(near, &[middle, high.clone()], depth - 1)
    }
}
