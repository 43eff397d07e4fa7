//! The events of a certificate, one after another, over a piece of its data.

use num_bigint::BigInt;
use num_rational::BigRational;

use super::affine::Affine;
use super::clock::{Clock, SetPosition, beside};
use super::contact::{Claimed, Doubt, first_hit};
use super::data::{Data, Piece};
use super::excursion::first_exit;
use super::frame::Frame;
use super::release::Release;
use super::standing::WalkState;
use super::step::{Landing, Launch, Parameters};
use crate::{Certificate, Claim};
use impact_pair_exact::{Real, decimal_digits};
use impact_pair_model::Period;
use impact_pair_model::Wall;
use impact_pair_model::{EventKind, Mapping};

/// Bits by which a set may be wider than its deviations of the data and still be worth halving: wider sets grow by rounding, or at a graze.
const SECOND_ORDER_BITS: i64 = 20;

/// An orbit followed along the claims.
pub(crate) struct Walk<'c> {
    pub(super) certificate: &'c Certificate,
    pub(super) data: &'c Data<'c>,
    pub parameters: Parameters<'c>,
    pub clock: Clock,
    /// Whole half periods removed from the phase of the origin, so that it stays within a forcing period of 0.
    pub(super) halves: BigInt,
    /// The states that the walk has reached.
    pub standing: WalkState<'c>,
    /// All releases so far.
    pub(super) released: Vec<Release>,
    /// The first period that is proved between two listed releases.
    pub(super) period: Option<Period>,
    /// For the periods of the claimed number of cycles: whether each has the claimed number of impacts.
    pub(super) has_period: Option<bool>,
    pub(super) impacts: u64,
    /// Grazes whose claimed distance is wider than point data allow: their positions, and the enclosed distances.
    pub grazes: Vec<(usize, Real)>,
    pub(super) bits: u32,
    /// Position of the claim that is confirmed next.
    pub event: usize,
}

impl<'c> Walk<'c> {
    /// The walk from the scene's own start.
    pub fn new(certificate: &'c Certificate, data: &'c Data<'c>, piece: &Piece, bits: u32) -> Self {
        let frame = Frame::new(data, piece, bits);
        let standing = WalkState::at_start(data, &frame.parameters, piece);
        Self::at((certificate, data), frame, standing, 0)
    }

    /// The walk from states after `impacts` impacts, which are the first claimed events.
    pub fn at(
        (certificate, data): (&'c Certificate, &'c Data<'c>),
        frame: Frame<'c>,
        standing: WalkState<'c>,
        impacts: usize,
    ) -> Self {
        let Frame { parameters, clock, turn } = frame;
        Self {
            certificate,
            data,
            parameters,
            clock,
            halves: BigInt::from(2) * &data.turns,
            standing,
            released: Vec::new(),
            period: None,
            has_period: None,
            impacts: impacts as u64, // exact: a length
            grazes: Vec::new(),
            bits: turn.bits(),
            event: impacts,
        }
    }

    /// Confirms all claims from `event` on, or stops at the first claim that is not confirmed.
    pub fn all(&mut self, progress: &mut impl FnMut(&Self)) -> Result<(), Doubt> {
        for claim in &self.certificate.events()[self.event..] {
            if self.data.budget.is_stopped() {
                return Err(Doubt::open("it is stopped"));
            }
            self.confirm(claim)?;
            self.event += 1;
            progress(self);
        }
        self.outcome()
    }

    /// The phase `W t + tau` of a phase since the origin.
    pub fn absolute(&self, phase: &Real) -> Real {
        // X1: any number of bits encloses
        let bits = phase.bits().saturating_add(u32::try_from(self.halves.bits()).unwrap_or(0));
        let dropped = Real::rational(&self.halves.clone().into(), bits) * &Real::pi(bits);
        dropped + &self.parameters.origin() + phase
    }

    /// The datum whose halving narrows the sets most, if the data make up most of their width.
    pub fn widest_datum(&self) -> Option<usize> {
        let (Launch { phase, velocity, .. }, data) = (self.standing.departure(), self.data.deviations());
        // proposes: what is not rounded away is of second order in the data, and halves of these narrow it, too
        let is_by_data = |x: &Affine| x.without(data).reach().scaled(SECOND_ORDER_BITS) > x.own_reach(data);
        [phase, velocity].into_iter().find(|x| is_by_data(x)).and_then(|x| x.widest(data))
    }

    /// Confirms the next claim.
    pub fn confirm(&mut self, claim: &Claim) -> Result<(), Doubt> {
        match &claim.kind {
            EventKind::Impact { index, mapping, velocity } => self.impact(claim, *index, *mapping, velocity),
            EventKind::Rest { is_accumulation } => self.come_to_rest(claim, *is_accumulation),
            EventKind::Release => self.release(claim),
            // A motion that misses its wall by less than the bounds distinguish is checked as any other graze (G1).
            EventKind::Graze { miss } => match self.standing.still().filter(|still| still.grazes()).cloned() {
                Some(still) => self.graze_again(still, claim, miss.as_ref()),
                None => self.graze(claim, miss.as_ref()),
            },
        }
    }

    fn impact(
        &mut self,
        claim: &Claim,
        index: u64,
        mapping: Option<Mapping>,
        velocity: &[BigRational; 2],
    ) -> Result<(), Doubt> {
        if self.standing.rest().is_some() {
            return Err(Doubt::False("the ball lies on its wall until it is released".into()));
        }
        is_next(self.impacts, index)?;
        self.standing.last().leads(mapping, claim.wall)?;
        let landing = self.land(claim.wall, &self.ahead(claim)?)?;
        let time = self.clock.time(&landing.phase.hull());
        let found = self.clock.velocity(&landing.velocity.hull());
        self.go_on(landing);
        compare("time", &time, &claim.time)?;
        compare("velocity", &found, velocity)
    }

    /// Continues the walk from an impact.
    pub fn go_on(&mut self, landing: Landing) {
        self.standing = WalkState::after(&self.parameters, landing.aligned(self.data.deviations()));
        self.impacts += 1;
    }

    /// The claimed place of the next event after the departure; the guess is the middle of the part of the bounds that lies ahead.
    pub(super) fn ahead(&self, claim: &Claim) -> Result<Claimed, Doubt> {
        let departed = self.standing.departure().phase.hull();
        let [from, to] = claim.time.each_ref().map(|time| self.clock.phase(time) - &departed);
        if !to.is_positive() && !to.is_across() || self.standing.rest().is_some() {
            return Err(Doubt::False("the time is not after the event before".into()));
        }
        let zero = Real::zero(self.bits);
        let later = if from.is_positive() { from.hull(&to) } else { zero.hull(&to) };
        let guess = Real::point(later.mid(), self.bits);
        if guess.is_positive() {
            Ok(Claimed { from, guess, to: Some(to), is_first: true })
        } else {
            Err(Doubt::open("the time is too near"))
        }
    }

    /// Encloses the next impact, without a claim: the first contact of the middle's flight in doubles, or else of all flights by parts,
    /// gives the place to search.
    pub fn next_landing(&self) -> Option<Landing> {
        let departure = self.standing.departure();
        let land = |(wall, guess): (Wall, Real)| {
            let claimed = Claimed { from: Real::zero(self.bits), guess, to: None, is_first: true };
            self.land(wall, &claimed).ok()
        };
        first_exit(&departure.middle_flight(&self.parameters)).and_then(land).or_else(|| {
            let flight = departure.flights(&self.parameters);
            let hit = first_hit(&flight, departure.start)?;
            let y = flight.height(&hit);
            land((if y.is_positive() { Wall::Right } else { Wall::Left }, hit))
        })
    }

    fn land(&self, wall: Wall, claimed: &Claimed) -> Result<Landing, Doubt> {
        self.standing.departure().land(&self.parameters, wall, claimed)
    }
}

/// Proves that an impact's number `index` is the next number.
pub(super) fn is_next(impacts: u64, index: u64) -> Result<(), Doubt> {
    let next = impacts + 1;
    if index == next { Ok(()) } else { Err(Doubt::False(format!("the impact is number {next}, not {index}"))) }
}

/// Compares an enclosure with the claimed bounds that it must lie in.
pub(super) fn compare(what: &str, found: &Real, claimed: &[BigRational; 2]) -> Result<(), Doubt> {
    let shown = || decimal_digits(&found.enclosure().rounded(160));
    match beside(found, claimed) {
        SetPosition::Inside => Ok(()),
        SetPosition::Outside => Err(Doubt::False(format!("the true {what} is {}", shown()))),
        SetPosition::Across => Err(Doubt::Open(format!("the true {what}, {}, is not proved to be inside", shown()))),
    }
}
