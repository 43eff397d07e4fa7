//! The events of a certificate, one after another, over a piece of its data.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::affine::Affine;
use super::clock::{Beside, Clock, beside};
use super::contact::{Claimed, Doubt, Start, first_hit};
use super::data::{Data, Piece};
use super::release::Release;
use super::rest::Rest;
use super::step::{Departure, Landing, Parameters};
use super::still::Still;
use crate::{Certificate, Claim, ClaimKind};
use impact_pair_exact::{Real, decimal_digits};
use impact_pair_model::Mapping;
use impact_pair_model::Period;
use impact_pair_model::Wall;

/// An orbit followed along the claims.
pub(crate) struct Walk<'c> {
    pub(super) certificate: &'c Certificate,
    pub(super) data: &'c Data,
    pub parameters: Parameters,
    pub clock: Clock,
    /// The whole half turns dropped from the phase that phases are counted from, which is within a turn of 0.
    pub(super) halves: BigInt,
    pub departure: Departure,
    /// The last impact.
    pub landing: Option<Landing>,
    pub(super) rest: Option<Rest>,
    pub(super) still: Option<Still>,
    /// The wall that the last flight between walls left; `None` where a graze since may have been a touch of the other.
    pub last: Option<Wall>,
    /// The first release from each wall under one harmonic: half turns, impacts before it.
    pub(super) releases: [Option<(BigInt, u64)>; 2],
    /// All releases under several harmonics.
    pub(super) released: Vec<Release>,
    pub(super) period: Option<Period>,
    pub(super) impacts: u64,
    pub(super) bits: u32,
    /// The position of the claim in hand.
    pub event: usize,
}

impl<'c> Walk<'c> {
    pub fn new(certificate: &'c Certificate, data: &'c Data, piece: &Piece, bits: u32) -> Self {
        let parameters = data.parameters(piece, bits);
        let (phase, velocity, height) = data.state(piece, bits);
        let clock = Clock::at_start(data, &phase, bits);
        let phase = phase.less_centre();
        let departure = match (data.wall, height) {
            (Some(wall), _) => Departure::rebound(&parameters, &Landing { wall, phase, velocity }),
            (None, height) => {
                let height = height.unwrap_or_else(|| Affine::fixed(Real::zero(bits)));
                Departure { start: Start { wall: None, is_release: false }, phase, height, velocity }
            }
        };
        let mut walk = Self {
            certificate,
            data,
            parameters,
            clock,
            halves: BigInt::from(2) * &data.turns,
            departure,
            landing: None,
            rest: None,
            still: None,
            last: data.wall,
            releases: [None, None],
            released: Vec::new(),
            period: None,
            impacts: 0,
            bits,
            event: 0,
        };
        walk.departure.start.is_release = walk.starts_where_pressure_vanishes(Ordering::Greater);
        walk.still = Still::of(data, walk.departure.velocity.hull().is_zero());
        walk
    }

    /// Confirms all claims from the one in hand on, or stops at the first that is not.
    pub fn all(&mut self, progress: &mut impl FnMut(usize)) -> Result<(), Doubt> {
        for claim in &self.certificate.events()[self.event..] {
            if self.data.budget.is_stopped() {
                return Err(Doubt::Open("it is stopped".into()));
            }
            self.confirm(claim)?;
            self.event += 1;
            progress(self.event);
        }
        self.outcome()
    }

    /// The phase `W t + tau` of phases counted from the origin.
    pub fn absolute(&self, phase: &Real) -> Real {
        // X1: any number of bits encloses
        let bits = phase.bits().saturating_add(u32::try_from(self.halves.bits()).unwrap_or(0));
        let dropped = Real::rational(&self.halves.clone().into(), bits) * &Real::pi(bits);
        dropped + &self.parameters.origin() + phase
    }

    /// The datum whose halving narrows the sets most, if the data make most of their width.
    pub fn widest_datum(&self) -> Option<usize> {
        let Departure { phase, velocity, .. } = &self.departure;
        [phase, velocity].into_iter().find(|x| x.is_wide_by_data()).and_then(Affine::widest)
    }

    /// Confirms the next claim.
    pub fn confirm(&mut self, claim: &Claim) -> Result<(), Doubt> {
        let [lower, upper] = &claim.time;
        if lower > upper {
            return Err(Doubt::False("the lower bound of the time is above the upper one".into()));
        }
        match &claim.kind {
            ClaimKind::Impact { index, mapping, velocity } => self.impact(claim, *index, *mapping, velocity),
            ClaimKind::Rest { is_accumulation } => self.come_to_rest(claim, *is_accumulation),
            ClaimKind::Release => self.release(claim),
            ClaimKind::Graze if self.still.is_some() => self.graze_again(claim),
            ClaimKind::Graze => self.graze(claim),
        }
    }

    fn impact(
        &mut self,
        claim: &Claim,
        index: u64,
        mapping: Option<Mapping>,
        velocity: &[BigRational; 2],
    ) -> Result<(), Doubt> {
        self.fits(claim, index, mapping, velocity)?;
        let landing = self.land(claim.wall, &self.ahead(claim)?)?;
        let time = self.clock.time(&landing.phase.hull());
        let found = self.clock.velocity(&landing.velocity.hull());
        self.departure = Departure::rebound(&self.parameters, &landing);
        self.landing = Some(landing);
        (self.impacts, self.last) = (self.impacts + 1, Some(claim.wall));
        compare("time", &time, &claim.time)?;
        compare("velocity", &found, velocity)
    }

    /// Whether an impact may be the next event, by its number, its mapping and the order of its bounds.
    pub(super) fn fits(
        &self,
        claim: &Claim,
        index: u64,
        mapping: Option<Mapping>,
        velocity: &[BigRational; 2],
    ) -> Result<(), Doubt> {
        if self.rest.is_some() {
            return Err(Doubt::False("the ball lies on its wall until it is released".into()));
        }
        if index != self.impacts + 1 {
            return Err(Doubt::False(format!("the impact is number {}, not {index}", self.impacts + 1)));
        }
        if mapping != self.last.map(|from| Mapping::between(from, claim.wall)) {
            let is_after_graze =
                matches!(self.certificate.events()[..self.event].last(), Some(Claim { kind: ClaimKind::Graze, .. }));
            return Err(match mapping {
                // It is the one or the other.
                Some(mapping) if self.last.is_none() && is_after_graze && mapping.walls().1 == claim.wall => {
                    Doubt::Open("the graze before is not told from a touch, so no mapping is proved".into())
                }
                _ => Doubt::False("the mapping does not lead from the wall before to this one".into()),
            });
        }
        if velocity[0] > velocity[1] {
            return Err(Doubt::False("the lower bound of the velocity is above the upper one".into()));
        }
        Ok(())
    }

    /// Where after the departure the claim says to look: in the middle of what of its bounds comes later.
    pub(super) fn ahead(&self, claim: &Claim) -> Result<Claimed, Doubt> {
        let [from, to] = claim.time.each_ref().map(|time| self.clock.phase(time) - &self.departure.phase.hull());
        if !to.is_positive() && !to.is_across() || self.rest.is_some() {
            return Err(Doubt::False("the time is not after the event before".into()));
        }
        let zero = Real::zero(self.bits);
        let later = if from.is_positive() { from.hull(&to) } else { zero.hull(&to) };
        let guess = Real::point(later.mid(), self.bits);
        if guess.is_positive() {
            Ok(Claimed { from, guess, to: Some(to), is_first: true })
        } else {
            Err(Doubt::Open("the time is too near".into()))
        }
    }

    /// The next impact, which no claim tells of: of the middle's own flight the first part with a contact tells where to look.
    pub fn next_landing(&self) -> Option<Landing> {
        let flight = self.departure.flights(&self.parameters);
        let guess = first_hit(&flight, self.departure.start)?;
        let y = flight.height(&guess);
        let wall = if y.is_positive() { Wall::Right } else { Wall::Left };
        let claimed = Claimed { from: Real::zero(self.bits), guess, to: None, is_first: true };
        self.land(wall, &claimed).ok()
    }

    pub(super) fn land(&self, wall: Wall, claimed: &Claimed) -> Result<Landing, Doubt> {
        self.departure.land(&self.parameters, wall, claimed)
    }
}

/// What is found lies inside the claimed bounds.
pub(super) fn compare(what: &str, found: &Real, claimed: &[BigRational; 2]) -> Result<(), Doubt> {
    let shown = || decimal_digits(&found.enclosure().rounded(160));
    match beside(found, claimed) {
        Beside::Inside => Ok(()),
        Beside::Outside => Err(Doubt::False(format!("the true {what} is {}", shown()))),
        Beside::Across => Err(Doubt::Open(format!("the true {what}, {}, is not proved to be inside", shown()))),
    }
}
