//! A claimed periodic orbit: its bounds in radians, and the comparison of an enclosed orbit with them.

use std::cmp::Ordering;

use impact_pair_model::vocabulary::{Sign, Stability};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::One;

use super::basin::Ellipse;
use super::contact::Doubt;
use super::data::{Data, Piece};
use super::fixed_point::{Eigenvalue, FixedPoint, eigenvalues};
use super::frame::{Frame, hull};
use super::round::Round;
use super::step::Landing;
use super::walk::compare;
use crate::attraction::{Bounds, ClaimedOrbit};
use impact_pair_exact::Real;
use impact_pair_model::{Wall, Word};

/// Bits in which neighbourhoods are proved.
pub(super) const BITS: u32 = 192;
/// Bits of the arithmetic beyond those of the claimed bounds.
const SPARE_BITS: u32 = 96;
pub(super) const MAX_BITS: u32 = 1 << 12;
/// Number of times that the bits are doubled.
const MAX_DOUBLINGS: u32 = 3;

/// A claimed orbit of a word.
pub(super) struct Target<'c> {
    pub data: &'c Data<'c>,
    pub claim: &'c ClaimedOrbit,
    /// Walls of the impacts of the word.
    pub walls: Vec<Wall>,
    pub cycles: u64,
    /// Forcing periods of the reference after which the forcing repeats.
    pub turns: BigInt,
}

impl<'c> Target<'c> {
    /// The claim, if it can be an orbit of the word `word` in `cycles` cycles.
    pub fn new(data: &'c Data, word: &Word, cycles: u64, claim: &'c ClaimedOrbit) -> Result<Self, Doubt> {
        let walls: Vec<Wall> = word.mappings().iter().map(|mapping| mapping.walls().0).collect();
        if !word.is_closed() {
            return Err(Doubt::False("the word does not end on the wall that it starts from".into()));
        }
        if claim.impacts.len() != walls.len() {
            return Err(Doubt::False(format!("the orbit has {} impacts", walls.len())));
        }
        if claim.impacts.iter().zip(&walls).any(|(impact, wall)| impact.wall != *wall) {
            return Err(Doubt::False("an impact of the orbit is on the other wall".into()));
        }
        let open = |message: &str| Doubt::open(message);
        let turns = data.common_turns().ok_or_else(|| open("the harmonics are not proved to have a common period"))?;
        if cycles == 0 || !BigInt::from(cycles).is_multiple_of(&turns) {
            return Err(open("the cycles are not a multiple of the common period of all harmonics"));
        }
        let is_valid = |turn: Option<u32>| match turn {
            None => turns.is_one(),
            Some(turn) => !turns.is_one() && BigInt::from(turn) < turns,
        };
        if !claim.impacts.iter().all(|impact| is_valid(impact.turn)) {
            return Err(Doubt::False("the `turn` of an impact of the orbit is not in the common period".into()));
        }
        Ok(Self { data, claim, walls, cycles, turns })
    }

    /// The round of the word with the given approximate durations of the flights.
    pub fn round<'p>(&'p self, frame: &'p Frame, times: Vec<Real>, is_physical: bool) -> Round<'p> {
        let turns = |turns: &BigInt| frame.turn.clone() * &Real::rational(&turns.clone().into(), frame.turn.bits());
        Round {
            parameters: &frame.parameters,
            walls: &self.walls,
            common: turns(&self.turns),
            lasting: turns(&self.cycles.into()),
            is_physical,
            times,
        }
    }

    /// Difference between a claimed phase `W t + tau` and the phase since the origin, up to whole common periods.
    pub fn origin(&self, frame: &Frame, turn: Option<u32>) -> Real {
        // exact: without a forcing period, the common period is one
        let turns = (&self.data.turns - BigInt::from(turn.unwrap_or(0))).mod_floor(&self.turns);
        frame.parameters.origin() + &(frame.turn.clone() * &Real::rational(&turns.into(), frame.turn.bits()))
    }

    /// The claimed states of an impact, in phases since the origin.
    pub fn state(&self, frame: &Frame, impact: usize) -> Landing {
        let (claim, bits) = (&self.claim.impacts[impact], frame.turn.bits());
        let origin = self.origin(frame, claim.turn);
        let phase = hull(&claim.phase.each_ref().map(|phase| Real::rational(phase, bits) - &origin));
        let velocity = hull(&claim.velocity.each_ref().map(|x| frame.clock.slowed(&Real::rational(x, bits))));
        frame.spanned(claim.wall, [phase, velocity])
    }

    /// The claimed states of the first impact.
    pub fn first(&self, frame: &Frame) -> Landing {
        self.state(frame, 0)
    }

    /// Proves that the only orbit of a basin is as claimed, and, for an admissible orbit, the only orbit in the claimed bounds.
    ///
    /// `near` is a round near the orbit.
    pub fn encloses(
        &self,
        piece: &Piece,
        basin: &Ellipse,
        claimed: &Landing,
        centre: &[Real; 2],
        near: &Round<'_>,
    ) -> Result<(), Doubt> {
        let mut bits = self.bits();
        for n in 0..=MAX_DOUBLINGS {
            let frame = Frame::new(self.data, piece, bits);
            let times = near.times.iter().map(|time| time.at(bits)).collect();
            let mut round = self.round(&frame, times, near.is_physical);
            let (centre, _) = round.polish(centre.clone())?;
            match FixedPoint::enclosed(&round, basin, &centre).and_then(|orbit| self.compare(&frame, &orbit)) {
                Err(Doubt::Open(_)) if n < MAX_DOUBLINGS && round.first() == 0 && !self.data.budget.is_spent() => {
                    bits *= 2
                }
                // Solutions with earlier contacts may include others, in longer flights.
                Ok(()) if near.is_physical && !basin.holds(claimed) => {
                    return Err(Doubt::open("the orbit is not proved to be the only one in its bounds"));
                }
                answer => return answer,
            }
        }
        unreachable!("the last answer is one")
    }

    /// Proves that all numbers of the enclosed orbit lie inside the claimed bounds.
    pub fn compare(&self, frame: &Frame, orbit: &FixedPoint<'_>) -> Result<(), Doubt> {
        let ClaimedOrbit { symmetric, times, impacts, numbers, physical, .. } = self.claim;
        if let Some(claimed) = symmetric {
            orbit.is_symmetric_as(*claimed, self.data.has_mirror())?;
        }
        if let Some(claimed) = times {
            orbit.runs_as(*claimed, &(BigInt::from(self.cycles) / &self.turns))?;
        }
        let bits = frame.turn.bits();
        let turn = |phase: &Bounds| {
            let turns = Real::rational(&phase[0], bits).over(&frame.turn).and_then(|turns| turns.floor()); // V6: shared by all members
            turns.ok_or_else(|| Doubt::open("the forcing period of a phase is not decided"))
        };
        let mut places = Vec::new();
        for (claimed, found) in impacts.iter().zip(orbit.impacts()) {
            if turn(&claimed.phase)? != 0 {
                return Err(Doubt::False("a phase of the orbit is not in [0, 2 pi)".into()));
            }
            let phase = found.phase.clone().shifted(&self.origin(frame, claimed.turn));
            let middle = hull(&claimed.phase.each_ref().map(|phase| Real::rational(phase, bits))).middle();
            let phase = orbit.near(&phase, &middle).ok_or_else(|| Doubt::open("a phase is too large"))?;
            compare("phase of the orbit", &phase.hull(), &claimed.phase)?;
            places.push(phase.hull());
            compare("velocity of the orbit", &frame.clock.velocity(&found.velocity.hull()), &claimed.velocity)?;
        }
        self.compare_cycles(frame, orbit, &places)?;
        self.compare_spacing(frame, orbit)?;
        orbit.is_physical_as(*physical)?;
        let trace = orbit.trace();
        let power = i32::try_from(2 * self.walls.len()).ok();
        let restitution = Real::of(&self.data.restitution, bits);
        let determinant = power.and_then(|power| restitution.enclosure().powi(power, bits));
        let determinant = Real::new(determinant.ok_or_else(|| Doubt::open("the word is too long"))?, bits);
        self.compare_stability(&trace, &determinant)?;
        let Some(numbers) = numbers else { return Ok(()) };
        let [one, other] = eigenvalues(&trace, &determinant);
        let inside = |found: [&Real; 2], claimed: &[Bounds]| {
            found
                .into_iter()
                .zip(claimed)
                .try_for_each(|(found, claimed)| compare("number of the orbit", found, claimed))
        };
        let (product, rest) = numbers.split_at(2);
        let (first, second) = rest.split_at(2);
        inside([&trace, &determinant], product)?;
        let both = |one: &Eigenvalue, other: &Eigenvalue| {
            inside(one.each_ref(), first).and_then(|()| inside(other.each_ref(), second))
        };
        // The pair has no order.
        both(&one, &other).or_else(|doubt| both(&other, &one).map_err(|_| doubt))
    }

    /// Proves the claimed whole forcing periods between the first impact and the others; `places` are the impacts' phases. Lemma T13
    fn compare_cycles(&self, frame: &Frame, orbit: &FixedPoint<'_>, places: &[Real]) -> Result<(), Doubt> {
        let (claims, impacts) = (&self.claim.impacts, orbit.impacts());
        if claims[0].cycle.is_some_and(|cycle| cycle != 0) {
            return Err(Doubt::False("the `cycle` of the first impact of the orbit is not 0".into()));
        }
        let half = Real::int(1, frame.turn.bits()).half();
        for ((claimed, found), place) in claims.iter().zip(impacts).zip(places) {
            let Some(cycle) = claimed.cycle else { continue };
            let passed = found.phase.hull() - &impacts[0].phase.hull();
            let beyond = passed - &(place.clone() - &places[0]);
            match beyond.over(&frame.turn).map(|turns| turns - cycle) {
                // Both differ by less than 1/2 and are whole numbers: they are equal.
                Some(off) if off.is_below(&half) && (-off.clone()).is_below(&half) => {}
                Some(off) if half.is_below(&off) || half.is_below(&-off.clone()) => {
                    return Err(Doubt::False("an impact of the orbit is in another forcing period".into()));
                }
                _ => return Err(Doubt::open("the forcing period of an impact is not decided")),
            }
        }
        Ok(())
    }

    /// Proves the claimed spacing and sine of a two-impact motion.
    fn compare_spacing(&self, frame: &Frame, orbit: &FixedPoint<'_>) -> Result<(), Doubt> {
        let ClaimedOrbit { spacing, sine, .. } = self.claim;
        let on = |wall: Wall| orbit.impacts().iter().find(|impact| impact.wall == wall);
        let (Some(left), Some(right)) = (on(Wall::Left), on(Wall::Right)) else { return Ok(()) };
        if spacing.is_none() && sine.is_none() {
            return Ok(());
        }
        if self.walls.len() != 2 {
            return Err(Doubt::False("only motions of two impacts have a spacing and a sine".into()));
        }
        if let Some(claimed) = spacing {
            let bits = frame.turn.bits();
            let middle = hull(&claimed.each_ref().map(|x| Real::rational(x, bits))).middle();
            let lasting = frame.turn.clone() * &Real::rational(&BigInt::from(self.cycles).into(), bits);
            let found = right.phase.hull() - &left.phase.hull();
            let found = if found.is_negative() { found + &lasting } else { found };
            // V8 (spacing): each of both flights is the mirror image of the other
            let found = if orbit.is_a_symmetric_motion(self.data.has_mirror()) { lasting.half() } else { found };
            if middle.is_negative() || lasting.is_below(&middle) {
                return Err(Doubt::False("the spacing does not fit the number of forcing periods".into()));
            }
            compare("spacing", &found, claimed)?;
        }
        if let Some(claimed) = sine {
            let found = (left.phase.hull() + &frame.parameters.origin()).sin();
            let is_it = match claimed {
                Sign::Positive => found.is_positive(),
                Sign::Negative => found.is_negative(),
                Sign::Zero => return Err(Doubt::open("no sine is proved to be zero")),
            };
            if !is_it {
                let message = "the sine on the left wall has another sign".to_owned();
                return Err(if found.is_positive() || found.is_negative() {
                    Doubt::False(message)
                } else {
                    Doubt::Open(message)
                });
            }
        }
        Ok(())
    }

    /// Proves the claimed stability by trace and determinant (Lemma T4). **Equations** (39), (40)
    fn compare_stability(&self, trace: &Real, determinant: &Real) -> Result<(), Doubt> {
        let one = Real::int(1, trace.bits());
        let at = [one.clone() + determinant - trace, one.clone() + determinant + trace];
        let are_within = at.iter().all(Real::is_positive);
        let found = if at.iter().any(Real::is_negative) {
            Stability::Unstable
        } else if are_within && determinant.is_below(&one) {
            Stability::Stable
        } else if are_within && (determinant.clone() - &one).sign() == Some(Ordering::Equal) {
            Stability::Elliptic
        } else {
            Stability::Undecided
        };
        match (self.claim.stability, found) {
            (claimed, found) if claimed == found || claimed == Stability::Undecided => Ok(()),
            (_, Stability::Undecided) => Err(Doubt::open("the stability is undecided")),
            _ => Err(Doubt::False("the stability claimed is false".into())),
        }
    }

    /// Bits of the enclosure of the orbit: more than the claimed bounds have.
    fn bits(&self) -> u32 {
        let bounds = self.claim.impacts.iter().flat_map(|impact| [&impact.phase, &impact.velocity]);
        // proposes: bits to enclose the orbit with
        let narrowest = narrowest(bounds).unwrap_or(0);
        // proposes
        SPARE_BITS.saturating_add(u32::try_from(-narrowest).unwrap_or(0)).clamp(BITS, MAX_BITS)
    }
}

/// The least width of the bounds, as a power of 2.
pub(super) fn narrowest<'b>(bounds: impl Iterator<Item = &'b Bounds>) -> Option<i64> {
    bounds.filter_map(|[lower, upper]| Real::rational(&(upper - lower), 64).enclosure().mig().top()).min()
}
