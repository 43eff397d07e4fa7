//! Check of a JSON of a global analysis: each periodic motion found again (Lemma V8), the cycle with rests followed from the release,
//! and a graph of boxes of its own, each recurrent component of which is proved to be one of those claimed (Lemma V20).

mod basins;
mod graph;
mod limit;
mod parts;
mod saddles;
mod space;

use impact_pair_model::Error;
use impact_pair_model::vocabulary::ComponentKind;
use impact_pair_model::watch::{Latched, Silent, Watch};

use super::beam::{FlightBundle, Quad};
use super::horseshoe::{are_apart, is_proved};
use super::span::Span;
use super::{BITS, Law, STEPS_PER_PLACE};
use crate::check::contact::Doubt;
use crate::check::units::greatest_speed;
use crate::check::{Finding, Limits, Verdict};
use crate::global::{Claimed, GlobalCertificate};
use basins::{Areas, Known};
use graph::{Component, Released, Set};
use impact_pair_exact::Real;
use limit::Cycle;
use space::{Grid, Space};

/// Most columns and rows of the first partition, fewer where a document had fewer, and most halvings of components.
const FIRST_COLUMNS: f64 = 128.0;
const FIRST_ROWS: f64 = 64.0;
/// The most columns, where basins are judged.
const MAX_COLUMNS: f64 = 1024.0;
const HALVINGS: u32 = 20;
/// Boxes that are mapped at least before a document is left undecided, and the steps that the image of one takes, about.
const MIN_BOXES: u64 = 1 << 15;
const WORK_PER_IMAGE: u64 = 64;
/// Impacts of the released ball that are followed.
const IMPACTS: usize = 200;

impl GlobalCertificate {
    /// Proves every claim again, or says what is not as claimed or not proved, until the watch stops it.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions, or if it has several harmonics.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let watch = Latched::new(watch);
        let end = |message: String| Finding { event: self.count(), message };
        if let Some(message) = self.contradiction.as_deref() {
            return Ok(Verdict::Refuted(end(message.to_owned())));
        }
        if let Some((place, doubt)) = self.doubts_grazing()? {
            return Ok(doubt.on(place));
        }
        if !self.claims_something() {
            return Ok(Verdict::Undecided(end("there is no component to check".to_owned())));
        }
        let mut bits = f64::MANTISSA_DIGITS;
        if let Some(orbits) = self.orbits.as_ref() {
            match orbits.check_within(limits, &Silent(&watch))? {
                Verdict::Confirmed { bits: most, .. } => bits = bits.max(most), // exact: what is shown
                Verdict::Interrupted { .. } => return Ok(Verdict::Interrupted { events: 0 }),
                Verdict::Refuted(finding) => return Ok(Verdict::Refuted(self.placed(finding))),
                Verdict::Undecided(finding) => return Ok(Verdict::Undecided(self.placed(finding))),
            }
        }
        if let Err((place, doubt)) = self.holds_horseshoes(limits, &watch)? {
            let is_open = matches!(doubt, Doubt::Open(_)) && !watch.goes_on();
            return Ok(if is_open { Verdict::Interrupted { events: 0 } } else { doubt.on(place) });
        }
        Ok(match self.covers(limits, &watch)? {
            Ok(()) => Verdict::Confirmed { bits, pieces: 1 },
            Err(Doubt::Open(_)) if !watch.goes_on() => Verdict::Interrupted { events: 0 },
            Err(doubt) => doubt.on(self.count()),
        })
    }

    /// Place and reason of a claim that a component grazes, if it is false or undecided: only one motion grazes for ever. Lemmas A9, V20
    fn doubts_grazing(&self) -> Result<Option<(usize, Doubt)>, Error> {
        let claims = self.claimed.iter().enumerate().filter(|(_, claim)| claim.kind == ComponentKind::Grazing);
        let places: Vec<usize> = claims.map(|(place, _)| place).collect();
        let Some(&last) = places.last() else { return Ok(None) };
        if Law::of(&self.pair)?.gap.hi() < 2.0 {
            let message = "no motion grazes one wall for ever: it meets the far wall, as d < 2 A";
            return Ok(Some((last, Doubt::False(message.into())))); // V20: A9's motion rises to 2 A
        }
        let is_second = places.len() > 1;
        Ok(is_second.then(|| (last, Doubt::open("it is not proved to hold any motion: one alone grazes"))))
    }

    /// The map has each horseshoe that a component is claimed to hold, and no other one holds the same. Lemma V37
    fn holds_horseshoes(&self, limits: &Limits, watch: &dyn Watch) -> Result<Result<(), (usize, Doubt)>, Error> {
        let law = Law::of(&self.pair)?;
        for (place, claim) in self.claimed.iter().enumerate() {
            let Some(horseshoe) = &claim.horseshoe else { continue };
            let allowed = limits.work.saturating_mul(STEPS_PER_PLACE); // proposes: when to give up
            if let Err(doubt) = is_proved(horseshoe, &law, (allowed, watch)) {
                return Ok(Err((place, doubt)));
            }
            let others = self.claimed[..place].iter().enumerate();
            for (other, held) in others.filter_map(|(other, claim)| Some((other, claim.horseshoe.as_ref()?))) {
                if let Err(doubt) = are_apart(horseshoe, held, other) {
                    return Ok(Err((place, doubt)));
                }
            }
        }
        Ok(Ok(()))
    }

    /// The cycle with rests is as claimed, and each recurrent component is one of those claimed, where it is said that there are no others.
    fn covers(&self, limits: &Limits, watch: &dyn Watch) -> Result<Result<(), Doubt>, Error> {
        let law = Law::of(&self.pair)?;
        let Some(space) = Space::new(&law, self.basins().map(|_| self.greatest_speed)) else {
            return Ok(Err(Doubt::open("greatest_speed is not proved to be more than 2/(1 - e)")));
        };
        let (rests, released) = from_release(&space);
        if let Some(claimed) = self.rest_cycle {
            match rests {
                Some(found) if found == claimed => {}
                Some((cycles, _)) => {
                    return Ok(Err(Doubt::False(format!("the cycle with rests takes {cycles} forcing periods"))));
                }
                None => return Ok(Err(Doubt::open("the released ball is not proved to rest again"))),
            }
        }
        let rest_claim = self.claimed.iter().position(|claim| claim.kind == ComponentKind::RestCycle);
        if !self.says_there_are_no_others {
            let is_open = rest_claim.is_some() && self.rest_cycle.is_none();
            let open = || Doubt::open("the released ball is not proved to rest again and again");
            return Ok(if is_open { Err(open()) } else { Ok(()) });
        }
        let cycles = self.cycles()?;
        let mut work = MIN_BOXES.saturating_add(limits.work / 2).saturating_mul(WORK_PER_IMAGE); // exact: what is allowed
        let has_rests = rests.is_some();
        let judge = ComponentChecker {
            space: &space,
            released: &released,
            cycles: &cycles,
            claimed: &self.claimed,
            rest_claim,
            has_rests,
        };
        let mut known = Vec::new();
        if let Err(doubt) = judge.covers(&judge.whole(first_boxes(self.boxes)), 0, &mut work, &mut known, watch) {
            return Ok(Err(doubt));
        }
        if let Some(place) = (0..self.count()).find(|place| known.iter().all(|(claim, _)| claim != place)) {
            return Ok(Err(Doubt::Open(format!("component {place} is not proved to hold any motion"))));
        }
        let Some((boxes, basins)) = self.basins() else { return Ok(Ok(())) };
        let all = judge.whole([root(boxes).clamp(FIRST_COLUMNS, MAX_COLUMNS); 2]); // V27: any boxes
        let split = match all.split(&space, &released, &mut work, watch) {
            Ok(split) => split,
            Err(doubt) => return Ok(Err(doubt)),
        };
        Ok(Areas::of(&all, &split, &known).judge(basins, space.fastest))
    }

    /// The cycles of the map that are claimed, each with the place of its component.
    fn cycles(&self) -> Result<Vec<(usize, Cycle, bool)>, Error> {
        let harmonic = self.pair.harmonic("a global analysis")?;
        let (turn, fastest) = (Real::pi(BITS) * 2, Real::of(&greatest_speed(harmonic)?, BITS));
        let half = Span::point(0.5);
        let state = |(is_right, phase, velocity): (bool, Real, Real)| {
            let phase = Span::of(phase.over(&turn)?.enclosure());
            let phase = if is_right { phase + half } else { phase };
            let speed = Span::of(velocity.over(&fastest)?.enclosure());
            let speed = if speed.is_negative() { -speed } else { speed };
            Some([phase - Span::point(phase.mid().floor()), speed]) // V20: any whole number of forcing periods
        };
        let of = |(place, claim): (usize, &Claimed)| {
            let states = claim.states(BITS).map(state).collect::<Option<Vec<_>>>()?;
            Some((place, Cycle { states }, claim.attracts))
        };
        Ok(self.claimed.iter().enumerate().filter_map(of).collect())
    }
}

/// The root of a number of boxes, about: a power of two.
fn root(boxes: u32) -> f64 {
    f64::powi(2.0, boxes.max(2).ilog2() as i32 / 2) // V20: any boxes
}

/// Boxes of the first partition: no more than the document had, about.
fn first_boxes(boxes: u32) -> [f64; 2] {
    [FIRST_COLUMNS, FIRST_ROWS].map(|most| most.min(root(boxes))) // V20: any boxes
}

/// The data that the recurrent components of boxes are compared with.
struct ComponentChecker<'j> {
    space: &'j Space<'j>,
    released: &'j Released,
    cycles: &'j [(usize, Cycle, bool)],
    claimed: &'j [Claimed],
    /// The place of the cycle with rests, if one is claimed, and whether the released ball is proved to rest again.
    rest_claim: Option<usize>,
    has_rests: bool,
}

impl ComponentChecker<'_> {
    /// The set of all states that motions have in the end, in about this number of boxes across and along.
    fn whole(&self, [across, along]: [f64; 2]) -> Set {
        let rows = (along / self.space.fastest).log2().ceil().exp2().max(64.0); // V20: any boxes; the greatest speed is a multiple of a row
        let (columns, last) = (across as i64, (self.space.fastest * rows) as i64); // exact: whole numbers
        let cells = (0..columns).flat_map(|column| (0..last).map(move |row| [column, row])).collect();
        Set { grid: Grid { columns: across, rows }, cells, has_release: true, is_closed: true }
    }

    /// Proves that all motions that stay in a set are claimed; adds the components that are proved to be those claimed.
    fn covers(
        &self,
        set: &Set,
        halved: u32,
        work: &mut u64,
        known: &mut Vec<Known>,
        watch: &dyn Watch,
    ) -> Result<(), Doubt> {
        let split = set.split(self.space, self.released, work, watch)?;
        let is_rest = |claim: usize| set.is_closed && split.is_released_always && self.claimed[claim].closed;
        if let Some(claim) = self.rest_claim.filter(|&claim| is_rest(claim)) {
            known.push((claim, set.clone()));
            return Ok(());
        }
        for Component { set, .. } in split.components {
            match self.claim(&set) {
                Some(claim) if set.is_closed && !self.claimed[claim].closed => {
                    return Err(Doubt::Open(format!("component {claim} is closed, which is not said of it")));
                }
                Some(claim) => known.push((claim, set)),
                None if halved >= HALVINGS || set.cells.is_empty() => {
                    return Err(Doubt::Open(format!(
                        "where every motion goes: {} boxes that may hold motions are not proved to be among the components",
                        set.cells.len()
                    )));
                }
                None => self.covers(&set.halved(), halved + 1, work, known, watch)?,
            }
        }
        Ok(())
    }

    /// The place of the component that a set is proved to be; one that is claimed to be closed has to be so.
    fn claim(&self, set: &Set) -> Option<usize> {
        let is_as_closed = |&place: &usize| set.is_closed || !self.claimed[place].closed;
        if set.cells.is_empty() {
            return self.rest_claim.filter(|_| set.has_release && self.has_rests);
        }
        let cycle = self.cycles.iter().find(|(_, cycle, attracts)| cycle.is_limit_of(set, self.space, *attracts));
        let grazing = || {
            self.claimed
                .iter()
                .position(|claim| claim.kind == ComponentKind::Grazing)
                .filter(|_| limit::grazes(set, self.space))
        };
        let saddles = || {
            let mut claims = self.claimed.iter();
            claims.position(|claim| claim.is_saddle_set).filter(|_| saddles::have_no_area(set, self.space))
        };
        cycle.map(|(place, ..)| *place).or_else(grazing).or_else(saddles).filter(is_as_closed)
    }
}

/// The forcing periods of the cycle with rests, and whether the ball rests on both walls in turn, if the released ball rests again; and its first
/// impact, else.
fn from_release(space: &Space<'_>) -> (Option<(u32, bool)>, Released) {
    let first = landed(space);
    let [mut phase, mut speed] = first;
    let mut crossings = 1;
    for _ in 0..IMPACTS {
        let turns = phase.mid().floor(); // V20: any whole number of forcing periods
        let within = phase - Span::point(turns);
        if space.chatters([within.lo(), 0.0], [within.hi(), speed.hi()]) {
            let halves = 2.0 * (turns + 1.0) - f64::from(crossings); // exact: small whole numbers
            let alternates = crossings % 2 == 1;
            let cycles = if alternates { halves } else { 0.5 * halves }; // exact: small whole numbers
            if cycles > f64::from(u32::MAX) {
                break; // V20: more than a document can say, so nothing is known of it
            }
            return (Some((cycles as u32, alternates)), None); // exact: a whole number of 32 bits
        }
        let quad = Quad::rectangle([within.lo(), speed.lo()], [within.hi(), speed.hi()]);
        let landing = space.guess.map(quad.middle()).and_then(|image| {
            Some((image.is_far, FlightBundle::new(space.law, &quad).land(image.is_far, image.time)?))
        });
        let Some((is_far, landing)) = landing else { break };
        crossings += u32::from(is_far);
        let [zero, one] = [0.0, 1.0].map(Span::point);
        phase = landing.along([one, zero], [zero, zero]) + Span::point(turns);
        speed = landing.along([zero, one], [zero, zero]);
        if !speed.is_positive() {
            break;
        }
    }
    (None, Some(first))
}

/// Phase and speed of the first impact after the release, on the far wall: `x - sin x = D`, `w = 1 - cos x`.
fn landed(space: &Space<'_>) -> [Span; 2] {
    let height = |u: f64| Span::point(u).turned() - Span::point(u).sin_cos().0;
    let gap = space.law.gap;
    let between = |is_below: &dyn Fn(Span) -> bool| {
        let (mut low, mut high) = (0.0, gap.hi() + 2.0); // V20: the height is more than D there
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            if is_below(height(middle)) { low = middle } else { high = middle }
        }
        [low, high]
    };
    let low = between(&|z| z.hi() <= gap.lo())[0];
    let high = between(&|z| z.lo() < gap.hi())[1];
    let phase = Span::new(low, high);
    [phase + Span::point(0.5), Span::point(1.0) - phase.sin_cos().1]
}
