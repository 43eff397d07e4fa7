//! What is claimed of a periodic orbit that the motion converges to.
//!
//! The route (Lemma V6): from the last of the claimed impacts, confirmed before as theorems, Newton's iteration seeks a state that
//! comes again after a period of the word. An ellipse around it is proved to be mapped into itself and contracted ([`basin`](super::basin)), and
//! the motion to come into it. A narrow ellipse of the same kind then encloses the orbit ([`fixed_point`](super::fixed_point)), which must lie in
//! the claimed bounds.

use num_bigint::BigInt;
use num_integer::Integer;

use super::basin::{Ellipse, basin};
use super::contact::Doubt;
use super::data::{Data, Piece};
use super::fixed_point::{Eigenvalue, FixedPoint, eigenvalues};
use super::frame::{Frame, hull};
use super::round::Round;
use super::step::Landing;
use super::walk::compare;
use crate::attraction::{Attraction, Bounds};
use crate::{Certificate, Claim, ClaimKind};
use impact_pair_exact::Real;
use impact_pair_model::Wall;

/// Bits that neighbourhoods are proved with.
const BITS: u32 = 192;
/// Bits beyond those that the claimed bounds are worth.
const SPARE_BITS: u32 = 96;
const MOST_BITS: u32 = 1 << 12;
/// How often these are doubled.
const DOUBLED: u32 = 3;
/// Pieces that intervals among the data are cut into.
const MOST_PIECES: usize = 256;
/// Periods that a motion is followed beyond the claimed impacts.
const FOLLOWED: u32 = 1 << 10;

impl Certificate {
    /// Proves that the motion converges to the orbit claimed, where that is claimed; the data are cut into `most` pieces at most.
    pub(super) fn attracts(&self, data: &Data, most: usize) -> Result<(), Doubt> {
        if self.outcome() != "attracted" {
            return Ok(());
        }
        let claim = self.attraction().ok_or_else(|| Doubt::False("the outcome has no orbit".into()))?;
        if !claim.is_attractor {
            return Err(Doubt::False("only an orbit that is unique, physical and stable is an attractor".into()));
        }
        let open = |message: &str| Doubt::Open(message.into());
        let walls: Vec<Wall> = claim.word.mappings().iter().map(|mapping| mapping.walls().0).collect();
        if !claim.word.is_closed() {
            return Err(Doubt::False("the word does not end on the wall that it starts from".into()));
        }
        if claim.impacts.len() != walls.len() {
            return Err(Doubt::False(format!("the orbit has {} impacts", walls.len())));
        }
        if claim.impacts.iter().zip(&walls).any(|(impact, wall)| impact.wall != *wall) {
            return Err(Doubt::False("an impact of the orbit is on the other wall".into()));
        }
        let turns = data.common_turns().ok_or_else(|| open("the harmonics are not proved to have a common period"))?;
        if claim.cycles == 0 || !BigInt::from(claim.cycles).is_multiple_of(&turns) {
            return Err(open("the cycles are no common periods of all harmonics"));
        }
        let question = Question { claim, data, walls: &walls, turns, hits: self.hits() };
        let most = most.min(MOST_PIECES); // proposes: when to give up
        let (mut pieces, mut cut) = (vec![Piece::default()], 1);
        while let Some(piece) = pieces.pop() {
            let Err(doubt) = question.answer(&piece) else { continue };
            match (&doubt, question.widest_datum(&piece)) {
                (Doubt::Open(_), Some(datum)) if cut < most => {
                    pieces.extend(piece.halves(datum));
                    cut += 1;
                }
                _ => return Err(doubt),
            }
        }
        Ok(())
    }

    /// The claimed impacts.
    fn hits(&self) -> Vec<Hit<'_>> {
        let (mut hits, mut follows) = (Vec::new(), false);
        for Claim { wall, time, kind } in self.events() {
            if let ClaimKind::Impact { index, velocity, .. } = kind {
                hits.push(Hit { index: *index, wall: *wall, time, velocity, follows });
            }
            follows = matches!(kind, ClaimKind::Impact { .. });
        }
        hits
    }
}

/// A claimed impact.
struct Hit<'c> {
    index: u64,
    wall: Wall,
    time: &'c Bounds,
    velocity: &'c Bounds,
    /// Whether the event before it is an impact as well.
    follows: bool,
}

/// Whether a motion converges to an orbit.
struct Question<'c> {
    claim: &'c Attraction,
    data: &'c Data,
    /// Of the impacts of the word.
    walls: &'c [Wall],
    /// Of the reference, after which the shaking repeats.
    turns: BigInt,
    hits: Vec<Hit<'c>>,
}

impl Question<'_> {
    /// Whether it does so for all data of a piece.
    fn answer(&self, piece: &Piece) -> Result<(), Doubt> {
        let frame = Frame::new(self.data, piece, BITS);
        let mut answer = Err(Doubt::Open("the motion is not proved to follow the word at its end".into()));
        // A word that is one of walls several times over fits in several places: a claim is false if it is so in all.
        for (n, end) in self.ends().into_iter().enumerate() {
            match (self.answer_from(end, piece, &frame), &answer) {
                (Ok(()), _) => return Ok(()),
                (doubt @ Err(Doubt::Open(_)), _) => answer = doubt,
                (doubt, _) if n == 0 => answer = doubt,
                _ => {}
            }
        }
        answer
    }

    /// The datum that the orbit depends on most.
    fn widest_datum(&self, piece: &Piece) -> Option<usize> {
        let frame = Frame::new(self.data, piece, BITS);
        let end = *self.ends().first().filter(|_| frame.parameters.columns() > 0)?;
        let mut round = self.round(end, &frame);
        let (centre, derivative) = round.polish(self.guess(end, &frame)).ok()?;
        let still = derivative.map(|row| row.map(|_| Real::zero(BITS)));
        let last = round.run(round.set(&centre, &still)).ok()?.pop()?;
        last.phase.widest().or(last.velocity.widest())
    }

    /// The last impacts after which all data of a piece may be at the first of the word.
    fn ends(&self) -> Vec<usize> {
        let first = self.hits.len().saturating_sub(self.walls.len()); // exact: an index
        (first..self.hits.len()).filter(|&end| self.beginning(end) < end).collect()
    }

    /// The first impact from which on the motion follows the word, as often as it does, up to the impact `end`.
    fn beginning(&self, end: usize) -> usize {
        let mut at = end;
        while let Some(before) = at.checked_sub(self.walls.len()) {
            let [first, rest @ ..] = &self.hits[before..=at] else { break };
            let walls = self.walls.iter().cycle().skip(1);
            if first.wall != self.walls[0]
                || rest.iter().zip(walls).any(|(hit, &wall)| !hit.follows || hit.wall != wall)
            {
                break;
            }
            at = before;
        }
        at
    }

    fn round<'p>(&'p self, end: usize, frame: &'p Frame) -> Round<'p> {
        let phases: Vec<_> =
            self.hits[end - self.walls.len()..=end].iter().map(|hit| frame.clock.phase(&hit.time[0])).collect();
        let bits = frame.turn.bits();
        Round {
            parameters: &frame.parameters,
            walls: self.walls,
            common: frame.turn.clone() * &Real::rational(&self.turns.clone().into(), bits),
            lasting: frame.turn.clone() * &Real::rational(&BigInt::from(self.claim.cycles).into(), bits),
            times: phases.windows(2).map(|flight| Real::point((flight[1].clone() - &flight[0]).mid(), bits)).collect(),
        }
    }

    fn state(&self, end: usize, frame: &Frame) -> Landing {
        let Hit { wall, time, velocity, .. } = &self.hits[end];
        frame.states(*wall, time, velocity)
    }

    fn guess(&self, end: usize, frame: &Frame) -> [Real; 2] {
        let state = self.state(end, frame);
        [state.phase.centre, state.velocity.centre]
    }

    fn answer_from(&self, end: usize, piece: &Piece, frame: &Frame) -> Result<(), Doubt> {
        let open = |message: &str| Doubt::Open(message.into());
        let mut round = self.round(end, frame);
        let (centre, derivative) = round.polish(self.guess(end, frame))?;
        let near = |state: Landing| {
            let phase = round.near(&state.phase, &centre[0]).ok_or_else(|| open("the phase is too large"))?;
            Ok(Landing { phase, ..state })
        };
        let state = near(self.state(end, frame))?;
        let first = &self.claim.impacts[0];
        let origin = self.origin(frame, first.turn);
        let phase = hull(&first.phase.each_ref().map(|phase| Real::rational(phase, BITS) - &origin));
        let velocity = hull(&first.velocity.each_ref().map(|x| frame.clock.slowed(&Real::rational(x, BITS))));
        let claimed = near(frame.spanned(first.wall, phase, velocity))?;
        let basin = basin(&round, &centre, &derivative, [&state, &claimed])?;
        arrives(&round, &basin, state)?;
        let from = self.hits[self.beginning(end)].index;
        if from > self.claim.from {
            return Err(Doubt::Open(format!("that is proved only from impact {from} on")));
        }
        let mut bits = self.claim.bits();
        for n in 0..=DOUBLED {
            let frame = Frame::new(self.data, piece, bits);
            let mut round = self.round(end, &frame);
            let (centre, _) = round.polish(centre.clone())?;
            match FixedPoint::enclosed(&round, &basin, &centre).and_then(|orbit| self.compare(&frame, &orbit)) {
                Err(Doubt::Open(_)) if n < DOUBLED && round.first() == 0 => bits *= 2,
                Ok(()) if !basin.holds(&claimed) => {
                    return Err(open("the orbit is not proved to be the only one in its bounds"));
                }
                answer => return answer,
            }
        }
        unreachable!("the last answer is one")
    }

    /// What is taken off the phase `W t + tau` of a claim for one since the origin, less whole common periods.
    fn origin(&self, frame: &Frame, turn: u64) -> Real {
        let turns = (&self.data.turns - BigInt::from(turn)).mod_floor(&self.turns);
        frame.parameters.origin() + &(frame.turn.clone() * &Real::rational(&turns.into(), frame.turn.bits()))
    }

    /// All that is found of the orbit lies inside the claimed bounds.
    fn compare(&self, frame: &Frame, orbit: &FixedPoint<'_>) -> Result<(), Doubt> {
        let Attraction { symmetric, impacts, numbers, .. } = self.claim;
        match orbit.is_symmetric(self.data.has_mirror()) {
            None => return Err(Doubt::Open("it is not decided whether the orbit is symmetric".into())),
            found if found != *symmetric => {
                return Err(Doubt::False("whether the orbit is symmetric is claimed wrongly".into()));
            }
            Some(_) => {}
        }
        if !orbit.is_whole() {
            return Err(Doubt::Open("the orbit is not proved to be no shorter one".into()));
        }
        // Phases are those of one turn, or all so many turns later.
        let bits = frame.turn.bits();
        let turn = |phase: &Bounds| {
            let turns = Real::rational(&phase[0], bits).over(&frame.turn).and_then(|turns| turns.floor()); // V6: shared by all members
            turns.ok_or_else(|| Doubt::Open("the turn of a phase is not decided".into()))
        };
        let first = turn(&impacts[0].phase)?;
        for (claimed, found) in impacts.iter().zip(orbit.impacts()) {
            if turn(&claimed.phase)? != first {
                return Err(Doubt::False("the phases of the orbit are not those of one turn".into()));
            }
            let phase = found.phase.clone().shifted(&self.origin(frame, claimed.turn));
            let middle = hull(&claimed.phase.each_ref().map(|phase| Real::rational(phase, bits))).middle();
            let phase = orbit.near(&phase, &middle).ok_or_else(|| Doubt::Open("a phase is too large".into()))?;
            compare("phase of the orbit", &phase.hull(), &claimed.phase)?;
            compare("velocity of the orbit", &frame.clock.velocity(&found.velocity.hull()), &claimed.velocity)?;
        }
        let trace = orbit.trace();
        let power = i32::try_from(2 * self.walls.len()).ok();
        let restitution = Real::of(&self.data.restitution, bits);
        let determinant = power.and_then(|power| restitution.enclosure().powi(power, bits));
        let determinant = Real::new(determinant.ok_or_else(|| Doubt::Open("the word is too long".into()))?, bits);
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
        // Where both are as large, either may be listed first.
        both(&one, &other).or_else(|doubt| both(&other, &one).map_err(|_| doubt))
    }
}

impl Attraction {
    /// Bits that are worth more than the claimed bounds.
    fn bits(&self) -> u32 {
        let bounds = self.impacts.iter().flat_map(|impact| [&impact.phase, &impact.velocity]);
        let widths = bounds.map(|[lower, upper]| Real::rational(&(upper - lower), 64).enclosure().mig().top());
        // proposes: bits to enclose the orbit with
        let narrowest = widths.flatten().min().unwrap_or(0);
        // proposes
        SPARE_BITS.saturating_add(u32::try_from(-narrowest).unwrap_or(0)).clamp(BITS, MOST_BITS)
    }
}

/// The motion comes into a basin, from a set of its states on.
fn arrives(round: &Round<'_>, basin: &Ellipse, mut state: Landing) -> Result<(), Doubt> {
    for _ in 0..FOLLOWED {
        if basin.holds(&state) {
            return Ok(());
        }
        state = round.run(state)?.pop().expect("the set");
    }
    Err(Doubt::Open("the motion is not proved to come near enough to the orbit".into()))
}
