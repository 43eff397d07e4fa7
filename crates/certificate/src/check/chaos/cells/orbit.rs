//! Check of a stable periodic orbit of a claimed word for all parameters of a law, and of the convergence of the scene's own orbit to it
//! (Lemma V36).

use impact_pair_document::PeriodDocument;
use impact_pair_model::{ImpactPair, Start, Wall, Word};
use num_integer::Integer;

use super::super::allowance::{Allowance, End};
use super::super::beam::{Spot, State};
use super::super::guess::{Guess, MAX_PERIODS};
use super::super::span::Span;
use super::super::trap::mirrored;
use super::super::{BITS, Law};
use super::moving::{Landed, Set, apart};
use crate::Certificate;
use crate::check::contact::Doubt;
use crate::check::data::{Data, Piece};
use crate::check::walk::Walk;
use impact_pair_exact::Real;
use impact_pair_model::Error;

/// Impacts that sets are followed for.
const MAX_IMPACTS: usize = 2000;
/// The most impacts from a set to a later one that lies in it, and those that are followed on for fewer ones.
const MAX_RETURN_IMPACTS: usize = 128;
/// Sets are enlarged every `ENLARGING_INTERVAL` impacts, by a multiple of `ENLARGING_FACTORS` of the distance to an earlier middle, if that is near: much of it where
/// the orbit comes near its limit slowly, or from both sides in turn.
const ENLARGING_INTERVAL: usize = 32;
const ENLARGING_FACTORS: [f64; 3] = [0.0, 8.0, 128.0];
const NEAR_DISTANCE: f64 = 0.02;
/// Impacts of a floating-point orbit before it is looked at, and how near it has to come again.
const TRANSIENT: usize = 8_000;
const RETURN_DISTANCE: f64 = 1e-6;
/// States at which a floating-point orbit begins, if not at the scene's own first impact; then at `SPREAD_STARTS` states spread over all.
const OTHER_STARTS: [State; 4] = [[0.1, 0.5], [0.35, 1.5], [0.6, 1.0], [0.85, 2.0]];
const SPREAD_STARTS: u32 = 24;
/// A set that is followed for one impact counts as N flights that are looked at.
const WORK_PER_SET: usize = 8;
/// One impact of a floating-point orbit counts as N as well.
const WORK_PER_IMPACT: usize = 4;
/// Orbits of more impacts are not checked.
const MAX_ORBIT_IMPACTS: usize = 256;

/// A periodic orbit that is claimed.
pub(super) struct Period {
    /// True for each impact on the right wall, in the order of time.
    is_right: Vec<bool>,
    cycles: i64,
}

/// The sets of N impacts, of which the last one lies in the first, and whole forcing periods, after which the orbit that they lead to comes again.
#[derive(Clone, Copy)]
struct Round {
    from: usize,
    impacts: usize,
    turns: f64,
}

impl Round {
    /// Returns the round after which it repeats, if it does after N impacts as well: the greatest common divisor of both. Lemma V36
    fn divided(self, impacts: usize) -> Self {
        let common = self.impacts.gcd(&impacts);
        let turns = self.turns / (self.impacts / common) as f64; // exact: whole forcing periods after each part
        Self { impacts: common, turns, ..self }
    }
}

/// A finding on a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// The claim is true.
    Proved,
    /// The orbit repeats after fewer impacts.
    Fewer,
    /// The orbit that is found is another one.
    Other,
    /// Neither.
    Nothing,
}

impl Period {
    /// Returns the claims of a document, unless it contradicts itself.
    pub fn of(claimed: &PeriodDocument) -> Result<Self, Doubt> {
        let wrong = |message: &str| Err(Doubt::False(format!("period: {message}")));
        let Ok(word) = claimed.word.parse::<Word>() else { return wrong("its word is none") };
        let is_right: Vec<bool> = word.mappings().iter().map(|mapping| mapping.walls().0 == Wall::Right).collect();
        if !word.is_closed() {
            return wrong("its word does not end on the wall that it starts from");
        }
        // exact: of 32 bits
        if is_right.len() != claimed.impacts as usize || claimed.cycles == 0 {
            return wrong("its word has another number of impacts, or it takes no forcing period");
        }
        if is_right.len() > MAX_ORBIT_IMPACTS {
            return Err(Doubt::Open(format!(
                "period: orbits of more than {MAX_ORBIT_IMPACTS} impacts are not checked"
            )));
        }
        Ok(Self { is_right, cycles: claimed.cycles.into() })
    }

    /// Proves that the scene's own orbit converges to it, for all parameters of a pair.
    pub fn attracts(
        &self,
        (pair, start): (&ImpactPair, &Start),
        law: &Law,
        work: &Allowance,
    ) -> Result<Result<Found, End>, Error> {
        let Some((wall, state)) = first_impact(pair, start)? else { return Ok(Ok(Found::Nothing)) };
        Ok(self.found((wall == Wall::Right, Set::around(state)), law, work))
    }

    /// Proves that it or its mirror image is a stable orbit, for all parameters of a pair.
    pub fn exists(
        &self,
        (pair, start): (&ImpactPair, &Start),
        law: &Law,
        work: &Allowance,
    ) -> Result<Result<Found, End>, Error> {
        let own = first_impact(pair, start)?.map(|(_, state)| state.map(Span::mid));
        let guess = Guess::new(law);
        let fastest = 2.0 / (1.0 - law.restitution.mid()).max(0.05); // proposes: where sets begin
        let spread = (1..=SPREAD_STARTS).map(|k| [0.618_034, 0.414_214].map(|step| (f64::from(k) * step).fract())); // proposes: where sets begin
        let spread = spread.map(|[phase, part]| [phase, part * fastest]);
        for from in own.into_iter().chain(OTHER_STARTS).chain(spread) {
            match self.settled(&guess, from, work) {
                Ok(Some((is_right, state))) => {
                    return Ok(self.found((is_right, Set::around(state.map(Span::point))), law, work));
                }
                Ok(None) => {}
                Err(end) => return Ok(Err(end)),
            }
        }
        Ok(Ok(Found::Nothing))
    }

    /// A state that a floating-point orbit comes to and has again, where it makes the claimed impacts, and the wall that it is on.
    fn settled(&self, guess: &Guess, from: State, work: &Allowance) -> Result<Option<(bool, State)>, End> {
        // proposes: where sets begin
        let next = |state: State| {
            let image = guess.map(state)?;
            Some(([image.state[0].rem_euclid(1.0), image.state[1]], image.is_far))
        };
        work.spend(WORK_PER_IMPACT * TRANSIENT, 1.0)?;
        let Some(first) = (0..TRANSIENT).try_fold(from, |state, _| Some(next(state)?.0)) else { return Ok(None) };
        let (mut state, mut walls) = (first, vec![false]);
        for _ in 0..self.is_right.len() {
            let Some((image, is_far)) = next(state) else { return Ok(None) };
            walls.push(walls[walls.len() - 1] != is_far);
            state = image;
        }
        let on = |is_right: bool| walls.iter().skip(1).map(move |wall| *wall != is_right).collect::<Vec<_>>();
        let wall = [false, true].into_iter().find(|is_right| self.is_made_of(&on(*is_right)));
        Ok(wall.filter(|_| apart(state, first) < RETURN_DISTANCE).map(|is_right| (is_right, first)))
    }

    /// The finding on the orbit that sets lead to from a first one on.
    fn found(&self, first: (bool, Set), law: &Law, work: &Allowance) -> Result<Found, End> {
        let mut found = Found::Nothing;
        for room in ENLARGING_FACTORS {
            found = self.follow(first, room, law, work)?;
            if found != Found::Nothing {
                break;
            }
        }
        Ok(found)
    }

    fn follow(&self, (is_right, first): (bool, Set), room: f64, law: &Law, work: &Allowance) -> Result<Found, End> {
        let guess = Guess::new(law);
        let all = self.is_right.len();
        let (mut sets, mut walls) = (vec![first], vec![is_right]);
        let (mut round, mut proved_at): (Option<Round>, _) = (None, None);
        while sets.len() <= MAX_IMPACTS {
            let last = sets.len();
            let Some(Landed { set, is_far, time }) = sets[last - 1].next(law, &guess) else {
                work.spend(WORK_PER_SET, MAX_PERIODS)?;
                break;
            };
            work.spend(WORK_PER_SET, time)?;
            walls.push(walls[last - 1] != is_far);
            // V36: any of the sets before
            for impacts in (1..=last).take(MAX_RETURN_IMPACTS.max(all)) {
                if round.as_ref().is_some_and(|round| impacts.is_multiple_of(round.impacts)) {
                    continue;
                }
                let from = last - impacts;
                let Some(shift) = sets[from].holds(&set) else { continue };
                let turns = set.turns - sets[from].turns + shift;
                let own = round.map_or(Round { from, impacts, turns }, |round| round.divided(impacts));
                round = Some(own);
                match self.compared(&walls[own.from..=own.from + own.impacts], own.turns) {
                    Found::Proved if !self.may_have_fewer() => return Ok(Found::Proved),
                    Found::Proved => proved_at = proved_at.or(Some(last)),
                    Found::Nothing => {}
                    found => return Ok(found),
                }
            }
            if proved_at.is_some_and(|since| last >= since + MAX_RETURN_IMPACTS) {
                break;
            }
            let before = sets.get(last.wrapping_sub(all * (ENLARGING_INTERVAL / all).max(1))); // proposes: whole rounds before
            let away = before.map_or(0.0, |before| room * before.away(&set));
            // proposes: larger sets hold as much
            sets.push(if last.is_multiple_of(ENLARGING_INTERVAL) {
                set.with_room(if away < NEAR_DISTANCE { away } else { 0.0 })
            } else {
                set
            });
        }
        Ok(if proved_at.is_some() { Found::Proved } else { Found::Nothing })
    }

    /// Compares the claimed impacts with those on these walls, after which the last state of the reduced map lies in the first set.
    fn compared(&self, walls: &[bool], turns: f64) -> Found {
        let flights = walls.len() - 1;
        let far = walls.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let half_cycles = 2 * turns as i64 - far as i64; // V36: whole numbers, each far impact is half a period later
        // On the other wall the orbit is mirrored: it is what it was after twice as many.
        let rounds = if far.is_multiple_of(2) { 1 } else { 2 };
        let own: Vec<bool> =
            (0..rounds).flat_map(|round| walls[..flights].iter().map(move |wall| *wall != (round == 1))).collect();
        let all = self.is_right.len();
        let is_one_speed = self.cycles * 2 * flights as i64 == half_cycles * all as i64; // exact: small numbers
        match (is_one_speed && self.is_made_of(&own), own.len()) {
            (false, _) => Found::Other,
            (true, impacts) if impacts < all => Found::Fewer,
            (true, impacts) if impacts == all => Found::Proved,
            // It may repeat after a part of these.
            (true, _) => Found::Nothing,
        }
    }

    /// Returns whether both may be of one orbit: the walls of the other one, or of its mirror image, are these repeated, in as many forcing
    /// periods per impact. Lemma V38
    pub fn may_be(&self, other: &Self) -> bool {
        let mirrored: Vec<bool> = other.is_right.iter().map(|wall| !wall).collect();
        let [all, others] = [self, other].map(|period| period.is_right.len() as i64); // exact: lengths
        let is_one_speed = self.cycles * others == other.cycles * all; // exact: small numbers
        is_one_speed && (self.is_made_of(&other.is_right) || self.is_made_of(&mirrored))
    }

    /// Returns whether the claimed walls, from some impact on, are these walls repeated.
    fn is_made_of(&self, walls: &[bool]) -> bool {
        let all = self.is_right.len();
        let is_turned =
            |shift: usize| (0..all + walls.len()).all(|i| walls[i % walls.len()] == self.is_right[(i + shift) % all]);
        (0..all).any(is_turned)
    }

    /// Returns whether the word is a shorter one repeated, so that the orbit may be.
    fn may_have_fewer(&self) -> bool {
        let all = self.is_right.len();
        let is_repeated = |part: usize| (0..all).all(|i| self.is_right[i] == self.is_right[(i + part) % all]);
        (1..all).any(|part| all.is_multiple_of(part) && is_repeated(part))
    }
}

/// Bounds of the scene's own first impact after its start, and its wall; `None` where it is not found.
fn first_impact(pair: &ImpactPair, start: &Start) -> Result<Option<(Wall, Spot)>, Error> {
    let certificate = Certificate::of_start(pair.clone(), start.clone());
    let data = Data::new(pair, start)?;
    let harmonic = pair.harmonic("the impact map without units")?;
    let walk = Walk::new(&certificate, &data, &Piece::default(), BITS);
    if walk.standing.still().is_some() {
        return Ok(None);
    }
    let Some(landing) = walk.next_landing() else { return Ok(None) };
    let turn = Real::pi(BITS) * 2;
    let phase = walk.absolute(&landing.phase.hull()).over(&turn);
    let velocity = landing.velocity.hull().over(&Real::of(harmonic.amplitude(), BITS));
    let Some((phase, velocity)) = phase.zip(velocity) else { return Ok(None) };
    let [phase, speed] = mirrored(landing.wall, phase, velocity);
    let turns = phase.middle().floor().unwrap_or(0); // exact: any whole number of forcing periods
    let phase = phase.clone() - &Real::int(turns, phase.bits());
    Ok(Some((landing.wall, [&phase, &speed].map(|x| Span::of(x.enclosure())))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Limits;
    use crate::check::chaos::STEPS_PER_PLACE;
    use impact_pair_model::watch::Unwatched;
    use std::f64::consts::TAU;

    fn period(word: &str, cycles: u32) -> Period {
        let impacts = word.split(' ').count() as u32;
        Period::of(&PeriodDocument { word: word.to_owned(), cycles, impacts }).unwrap()
    }

    fn followed(word: &str, cycles: u32, [alpha, restitution]: [f64; 2], first: (bool, State), room: f64) -> Found {
        let [gap, restitution] = [1.0 / alpha, restitution].map(Span::point);
        let first = (first.0, Set::around(first.1.map(Span::point)));
        let work = Allowance::new(STEPS_PER_PLACE * Limits::default().work, &Unwatched);
        period(word, cycles).follow(first, room, &Law { gap, restitution }, &work).unwrap()
    }

    /// One impact of an orbit of three impacts in one cycle has phase 0, to 1e-9: others come near it from both sides in turn, so that sets lie
    /// in earlier ones that are in another forcing period.
    #[test]
    fn v36_forcing_periods_are_counted_where_sets_go_from_one_to_another() {
        for phase in [0.83939, 0.83879] {
            let first = (true, [phase, 1.859]);
            let found =
                [1, 2, 3].map(|cycles| followed("P2 P4 P1", cycles, [0.5045322695, 0.63], first, ENLARGING_FACTORS[1]));
            assert_eq!(found, [Found::Proved, Found::Other, Found::Other], "{phase}");
        }
    }

    /// The equispaced orbit of (66)-(69) is a saddle beyond the pitchfork: sets that are near each other do not prove that it is stable.
    #[test]
    fn v36_sets_about_a_saddle_do_not_lie_in_one_another() {
        let [alpha, restitution] = [0.475_f64, 0.8];
        let along = TAU / 2.0 * (1.0 + restitution) / (1.0 - restitution);
        let phase = (0..60).fold(-1.5_f64, |phase, _| -((1.0 / alpha - 2.0 * phase.sin()) / along).acos());
        let state = [phase / TAU + 1.0, 2.0 * phase.cos() / (1.0 - restitution)];
        let missed = Guess::new(&Law { gap: Span::point(1.0 / alpha), restitution: Span::point(restitution) })
            .map(state)
            .unwrap();
        assert!(missed.is_far && apart(missed.state, state) < 1e-9);
        for room in ENLARGING_FACTORS {
            assert_eq!(followed("P1 P2", 1, [alpha, restitution], (false, state), room), Found::Nothing, "{room}");
        }
    }

    /// Walls from L to R to L, ... of rounds, and whole forcing periods of the reduced map, which counts half of one less for each far impact.
    #[test]
    fn v36_a_round_is_compared_by_its_walls_and_its_forcing_periods() {
        let walls = |text: &str| text.chars().map(|wall| wall == 'R').collect::<Vec<_>>();
        for (word, cycles, round, turns, found) in [
            ("P1 P2", 1, "LR", 1.0, Found::Proved),
            ("P1 P2", 1, "LRL", 2.0, Found::Proved),
            ("P1 P2", 1, "LRLRL", 4.0, Found::Nothing),
            ("P1 P2", 1, "LRL", 3.0, Found::Other),
            ("P1 P2", 3, "LR", 1.0, Found::Other),
            ("P1 P2 P1 P2", 2, "LRL", 2.0, Found::Fewer),
            ("P1 P2 P1 P2", 2, "LRLRL", 4.0, Found::Proved),
            ("P1 P2 P4", 1, "LRL", 2.0, Found::Other),
            ("P1 P2 P4 P4", 1, "LRLRL", 3.0, Found::Other),
            ("P1 P2 P4", 1, "LRLL", 2.0, Found::Proved),
            ("P1 P2 P4", 1, "LLRL", 2.0, Found::Proved),
            ("P3 P2 P1", 1, "RLRR", 2.0, Found::Proved),
            ("P3 P2 P1", 1, "LRLL", 2.0, Found::Other),
            ("P4 P1 P3 P2", 1, "LLR", 1.0, Found::Proved),
            ("P4 P1 P3 P2", 1, "LRLRL", 3.0, Found::Other),
        ] {
            assert_eq!(period(word, cycles).compared(&walls(round), turns), found, "{word} {cycles} {round} {turns}");
        }
        assert!(period("P1 P2 P1 P2", 2).may_have_fewer() && !period("P1 P2 P4", 1).may_have_fewer());
    }
}
