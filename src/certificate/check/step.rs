//! One impact for all states of a set: from a departure to the next landing (Lemma V2).

use super::affine::Affine;
use super::contact::{Claimed, Doubt, Start, first_contact, newton};
use super::flight::Flight;
use crate::exact::Real;
use crate::pair::Wall;

/// What the motion depends on, over the data of the scene.
#[derive(Clone, Debug)]
pub(in crate::certificate) struct Parameters {
    /// `A` \[length\]
    pub amplitude: Affine,
    /// `d/2` \[length\]
    pub half_gap: Affine,
    /// `e`
    pub restitution: Affine,
}

/// The states in which a flight begins; phases are counted from the origin of the orbit.
#[derive(Clone, Debug)]
pub(in crate::certificate) struct Departure {
    pub start: Start,
    /// \[rad\]
    pub phase: Affine,
    /// `y0` \[length\]
    pub height: Affine,
    /// `y'` after the impact \[length/rad\]
    pub velocity: Affine,
}

/// The states just before an impact.
#[derive(Clone, Debug)]
pub(in crate::certificate) struct Landing {
    pub wall: Wall,
    pub phase: Affine,
    /// `y'` \[length/rad\]
    pub velocity: Affine,
}

/// Bits kept below the errors of a set.
const SPARE_BITS: u32 = 64;

/// `1` for the right wall, `-1` for the left one: the side of `y`.
fn side(wall: Wall, bits: u32) -> Real {
    Real::int(if wall == Wall::Right { 1 } else { -1 }, bits)
}

impl Departure {
    /// From `wall` after the impact law (15), `p = -e v`.
    pub fn rebound(parameters: &Parameters, landing: &Landing) -> Self {
        let Landing { wall, phase, velocity } = landing;
        let restitution = &parameters.restitution;
        let centre = -(restitution.centre.clone() * &velocity.centre);
        let slopes = (-velocity.hull(), -restitution.hull());
        let after = Affine::of(centre, &[(&slopes.0, restitution), (&slopes.1, velocity)]);
        Self::on_wall(parameters, *wall, phase.clone(), after)
    }

    /// From `wall` with velocity `velocity` after the impact.
    pub fn on_wall(parameters: &Parameters, wall: Wall, phase: Affine, velocity: Affine) -> Self {
        let half_gap = &parameters.half_gap;
        let side = side(wall, half_gap.centre.bits());
        let height = Affine::of(half_gap.centre.clone() * &side, &[(&side, half_gap)]);
        Self { start: Start { wall: Some(wall), is_release: false }, phase, height, velocity }
    }

    /// The flights of those members of the set that `member` says, phases counted from `origin`.
    fn flight(&self, parameters: &Parameters, origin: &Real, member: fn(&Affine) -> Real) -> Flight {
        let bits = self.bits(origin.bits());
        let member = |x: &Affine| member(x).rounded(bits);
        let phase = origin.rounded(bits) + &member(&self.phase);
        let departure = phase.sin_cos();
        Flight {
            amplitude: member(&parameters.amplitude),
            half_gap: member(&parameters.half_gap),
            height: member(&self.height),
            velocity: member(&self.velocity),
            phase,
            departure,
        }
    }

    /// The bits that are worth computing: none far below what is not known of the set anyway.
    fn bits(&self, most: u32) -> u32 {
        let known = [&self.phase, &self.velocity].into_iter().filter_map(Affine::accuracy).max();
        known.map_or(most, |known| known.saturating_add(SPARE_BITS).min(most))
    }

    /// The flights of the whole set.
    pub fn flights(&self, parameters: &Parameters, origin: &Real) -> Flight {
        self.flight(parameters, origin, Affine::hull)
    }

    /// The landings, if all flights are proved to touch `wall` first, near where it is claimed.
    pub fn land(
        &self,
        parameters: &Parameters,
        origin: &Real,
        wall: Wall,
        claimed: &Claimed,
    ) -> Result<Landing, Doubt> {
        let set = self.flights(parameters, origin);
        let centre = self.flight(parameters, origin, |x| x.centre.clone());
        let contact = first_contact(&set, self.start, wall, claimed)?;
        let bits = set.phase.bits();
        // The middle, where Newton's iteration ends; it need not be the root.
        let h = newton(&centre, wall, &contact).at(bits);
        let departed = self.phase.centre.rounded(bits);
        let landed = Real::point((departed.clone() + &h).mid(), bits);
        let h = landed.clone() - &departed;
        let (sin, cos) = centre.sin_cos(&h);
        let contact = contact.at(bits).hull(&h);
        let (sin1, cos1) = set.sin_cos(&contact);
        let v = set.slope(&cos1);
        let over = |x: Real| x.over(&v).ok_or_else(|| Doubt::Open("a graze is not excluded".into()));
        let miss = over(centre.height(&h, &sin) - &centre.level(wall))?;
        let velocity = centre.slope(&cos);

        // d(th1, v1) by implicit differentiation of (A.2/4/6) and of (A.1/3/5).
        let (acceleration0, acceleration1) = (set.curvature(&set.departure.0), set.curvature(&sin1));
        let one = Real::int(1, bits);
        let by_amplitude = (sin1 - &set.departure.0) - &(set.departure.1.clone() * &contact);
        let dt = [
            (over(acceleration0.clone() * &contact + &set.velocity)?, &self.phase),
            (over(-one.clone())?, &self.height),
            (over(-contact)?, &self.velocity),
            (over(side(wall, bits))?, &parameters.half_gap),
            (over(by_amplitude)?, &parameters.amplitude),
        ];
        let direct = [-acceleration0, Real::zero(bits), one, Real::zero(bits), set.departure.1.clone() - &cos1];
        let dv: Vec<Real> =
            dt.iter().zip(&direct).map(|((slope, _), direct)| acceleration1.clone() * slope + direct).collect();

        let phase = Affine::of(landed - &miss, &dt.each_ref().map(|(slope, x)| (slope, *x)));
        let terms: Vec<_> = dv.iter().zip(&dt).map(|(slope, (_, x))| (slope, *x)).collect();
        let velocity = Affine::of(velocity - &(acceleration1 * &miss), &terms);
        Ok(Landing { wall, phase: phase.recentred(), velocity: velocity.recentred() })
    }
}
