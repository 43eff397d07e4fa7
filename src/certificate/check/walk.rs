//! The events of a certificate, one after another, over a piece of its data.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::affine::Affine;
use super::clock::{Beside, Clock, beside};
use super::contact::{Doubt, Start};
use super::data::{Data, Piece};
use super::real::Real;
use super::rest::{accumulation, bounce, is_held};
use super::step::{Departure, Landing, Parameters};
use crate::certificate::{Certificate, Claim, ClaimKind};
use crate::exact::decimal_digits;
use crate::mapping::Mapping;
use crate::orbit::Period;
use crate::pair::Wall;

/// Bounces that are not listed are followed so far at most.
const MOST_BOUNCES: usize = 1 << 14;

/// An orbit followed along the claims.
pub(super) struct Walk<'c> {
    certificate: &'c Certificate,
    data: &'c Data,
    parameters: Parameters,
    clock: Clock,
    /// The phase that phases are counted from, within a turn of 0, and the whole half turns dropped from it.
    origin: Real,
    halves: BigInt,
    departure: Departure,
    rest: Option<Rest>,
    /// The first release from each wall: half turns, impacts before it.
    releases: [Option<(BigInt, u64)>; 2],
    period: Option<Period>,
    impacts: u64,
    bits: u32,
    /// The position of the claim in hand.
    pub event: usize,
}

/// The ball lies on a wall from this phase on.
struct Rest {
    wall: Wall,
    since: Real,
}

impl<'c> Walk<'c> {
    pub fn new(certificate: &'c Certificate, data: &'c Data, piece: &Piece, bits: u32) -> Self {
        let parameters = data.parameters(piece, bits);
        let (phase, velocity, height) = data.state(piece, bits);
        let clock = Clock::at_start(data, &phase, bits);
        // Phases are counted from the middle of those of the start.
        let origin = phase.centre.clone();
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
            origin,
            halves: BigInt::from(2) * &data.turns,
            departure,
            rest: None,
            releases: [None, None],
            period: None,
            impacts: 0,
            bits,
            event: 0,
        };
        walk.departure.start.is_release = walk.starts_where_pressure_ends(0);
        walk
    }

    /// Confirms all claims, or stops at the first that is not.
    pub fn all(&mut self, progress: &mut impl FnMut(usize)) -> Result<(), Doubt> {
        for claim in self.certificate.events() {
            self.confirm(claim)?;
            self.event += 1;
            progress(self.event);
        }
        self.outcome()
    }

    /// The datum whose halving narrows the sets most, if the data make most of their width.
    pub fn widest_datum(&self) -> Option<usize> {
        let Departure { phase, velocity, .. } = &self.departure;
        [phase, velocity].into_iter().find(|x| x.is_wide_by_data()).and_then(Affine::widest)
    }

    fn confirm(&mut self, claim: &Claim) -> Result<(), Doubt> {
        let [lower, upper] = &claim.time;
        if lower > upper {
            return Err(Doubt::False("the lower bound of the time is above the upper one".into()));
        }
        match &claim.kind {
            ClaimKind::Impact { index, mapping, velocity } => self.impact(claim, *index, *mapping, velocity),
            ClaimKind::Rest { is_accumulation } => self.come_to_rest(claim, *is_accumulation),
            ClaimKind::Release => self.release(claim),
            ClaimKind::Graze => Err(Doubt::Open("grazes are not proved again".into())),
        }
    }

    fn impact(
        &mut self,
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
        if mapping != self.departure.start.wall.map(|from| Mapping::between(from, claim.wall)) {
            return Err(Doubt::False("the mapping does not lead from the wall before to this one".into()));
        }
        if velocity[0] > velocity[1] {
            return Err(Doubt::False("the lower bound of the velocity is above the upper one".into()));
        }
        let guess = Real::point(self.clock.phase(&claim.time), self.bits) - &self.departure.phase.centre;
        let guess = Real::point(guess.middle(), self.bits);
        if !guess.is_positive() {
            return Err(Doubt::False("the time is not after the event before".into()));
        }
        let landing = self.land(claim.wall, &guess)?;
        let time = self.clock.time(&landing.phase.hull());
        let found = self.clock.velocity(&landing.velocity.hull());
        self.departure = Departure::rebound(&self.parameters, &landing);
        self.impacts += 1;
        compare("time", &time, &claim.time)?;
        compare("velocity", &found, velocity)
    }

    fn land(&self, wall: Wall, guess: &Real) -> Result<Landing, Doubt> {
        self.departure.land(&self.parameters, &self.origin, wall, guess)
    }

    fn come_to_rest(&mut self, claim: &Claim, is_accumulation: bool) -> Result<(), Doubt> {
        let Some(wall) = self.departure.start.wall.filter(|&wall| wall == claim.wall && self.rest.is_none()) else {
            return Err(Doubt::False(format!("the ball is not on the {} wall", claim.wall.name())));
        };
        if is_accumulation {
            let since = self.chatter(claim)?;
            self.rest = Some(Rest { wall, since });
            return Ok(());
        }
        let begins = self.event == 0 && self.starts_where_pressure_ends(2);
        if !is_held(&self.departure, &self.parameters, &self.origin, begins) {
            return Err(Doubt::Open("the ball is not proved to stay on its wall".into()));
        }
        let since = self.departure.phase.hull();
        compare("time", &self.clock.time(&since), &claim.time)?;
        self.rest = Some(Rest { wall, since });
        Ok(())
    }

    /// The phases of the rest after infinitely many impacts, which lie inside the claimed bounds.
    fn chatter(&mut self, claim: &Claim) -> Result<Real, Doubt> {
        for _ in 0..MOST_BOUNCES {
            let lasting = accumulation(&self.departure, &self.parameters, &self.origin)
                .ok_or_else(|| Doubt::Open("the chatter is not proved to end in rest".into()))?;
            let since = self.departure.phase.hull() + &lasting;
            match beside(&self.clock.time(&since), &claim.time) {
                Beside::Inside => return Ok(since),
                Beside::Outside => return compare("time", &self.clock.time(&since), &claim.time).map(|()| since),
                Beside::Across => {
                    let guess = bounce(&self.departure, &self.parameters, &self.origin)?;
                    let landing = self.land(claim.wall, &guess)?;
                    self.departure = Departure::rebound(&self.parameters, &landing);
                }
            }
        }
        Err(Doubt::Open("the rest is not enclosed as claimed".into()))
    }

    /// Whether the start is exactly where, seen from its wall, the acceleration turns inward (`quarters` = 0), or presses from
    /// then on (2).
    fn starts_where_pressure_ends(&self, quarters: i64) -> bool {
        let mirrored = match self.data.wall {
            Some(Wall::Left) => quarters,
            Some(Wall::Right) => quarters + 2,
            None => return false,
        };
        let is_at = |at: BigInt| (at - mirrored) % 4 == BigInt::ZERO;
        let velocity = self.departure.velocity.hull();
        velocity.is_zero() && !self.parameters.amplitude.hull().is_zero() && self.data.quarter().is_some_and(is_at)
    }

    /// The ball leaves where the acceleration turns inward: at an even number of half turns on the left wall, an odd one on
    /// the right wall.
    fn release(&mut self, claim: &Claim) -> Result<(), Doubt> {
        let Some(Rest { wall, since }) = self.rest.take().filter(|rest| rest.wall == claim.wall) else {
            return Err(Doubt::False(format!("the ball does not lie on the {} wall", claim.wall.name())));
        };
        if self.parameters.amplitude.hull().is_zero() {
            return Err(Doubt::False("the ball lies on its wall for ever".into()));
        }
        let odd = i64::from(wall == Wall::Right);
        let turn = Real::pi(self.bits) + &Real::pi(self.bits);
        let half = Real::integer(odd, self.bits) * &Real::pi(self.bits);
        let turns = (self.origin.clone() + &since - &half).over(&turn).and_then(|turns| turns.set().floor());
        let turns = turns.ok_or_else(|| Doubt::Open("the turn of the release is not decided".into()))?;
        // Whole turns dropped so far are an even number of half turns, or the odd one of a release before.
        let halves = &self.halves + (turns + 1) * 2 + odd;
        let clock = Clock::at_half_turns(self.data, &halves, self.bits);
        self.clock = clock.ok_or_else(|| Doubt::Open("the time of the release is too large".into()))?;
        let zero = || Real::zero(self.bits);
        compare("time", &self.clock.time(&zero()), &claim.time)?;
        self.origin = half;
        let still = || Affine::fixed(zero());
        self.departure = Departure::on_wall(&self.parameters, wall, still(), still());
        self.departure.start.is_release = true;
        self.halves = &halves - odd;
        let first = &mut self.releases[usize::from(wall == Wall::Right)];
        match first {
            None => *first = Some((halves, self.impacts)),
            Some((since, before)) if self.period.is_none() => {
                let cycles: BigInt = (halves - &*since) / 2;
                let cycles = cycles.to_u64().unwrap_or(u64::MAX);
                self.period = Some(Period { cycles, impacts: self.impacts - *before });
            }
            Some(_) => {}
        }
        Ok(())
    }

    /// What is claimed of the future.
    fn outcome(&self) -> Result<(), Doubt> {
        let (is_true, message) = match self.certificate.outcome() {
            "periodic" => (self.period.is_some() && self.period == self.certificate.period(), "the period is not proved"),
            "rests-forever" => {
                let stays = self.rest.is_some() && self.parameters.amplitude.hull().is_zero();
                (stays, "the ball is not proved to rest for ever")
            }
            "never-impacts" => (self.never_impacts(), "the ball is not proved never to touch a wall"),
            "impacts-reached" | "time-reached" | "undecided" => (true, ""),
            _ => (false, "this version does not check the outcome"),
        };
        if is_true { Ok(()) } else { Err(Doubt::Open(message.into())) }
    }

    /// Without drift, `c = 0` exactly, the motion is `y = y0 + A sin th0 - A sin th`: it stays between the walls.
    fn never_impacts(&self) -> bool {
        let (data, flight) = (self.data, self.departure.flights(&self.parameters, &self.origin));
        let has_no_drift = match data.quarter() {
            _ if flight.amplitude.is_zero() => flight.velocity.is_zero(),
            // cos th0 = 0
            Some(quarter) => flight.velocity.is_zero() && quarter % 2 != BigInt::ZERO,
            None => false,
        };
        let middle = flight.height.clone() + &flight.curvature(&flight.departure.0);
        let (low, high) = (middle.clone() - &flight.amplitude, middle + &flight.amplitude);
        let is_inside = flight.level(Wall::Left).is_below(&low) && high.is_below(&flight.level(Wall::Right));
        self.certificate.events().is_empty() && self.departure.start.wall.is_none() && has_no_drift && is_inside
    }
}

/// What is found lies inside the claimed bounds.
fn compare(what: &str, found: &Real, claimed: &[BigRational; 2]) -> Result<(), Doubt> {
    let shown = || decimal_digits(&found.set().rounded(160));
    match beside(found, claimed) {
        Beside::Inside => Ok(()),
        Beside::Outside => Err(Doubt::False(format!("the true {what} is {}", shown()))),
        Beside::Across => Err(Doubt::Open(format!("the true {what}, {}, is not proved to be inside", shown()))),
    }
}
