//! Check of a trap JSON: the region is closed, and the claims about it are true (Lemma V11).

use std::collections::HashSet;
use std::ops::Range;

use impact_pair_exact::{Dyadic, Exact, Real, compare_rational};
use impact_pair_model::{Error, ImpactPair, Place, Start, Wall, within};
use num_rational::BigRational;

use super::guess::Guess;
use super::language;
use super::region::{Open, Region};
use super::span::Span;
use super::{BITS, Law};
use crate::Certificate;
use crate::check::blocks::{BLOCK_SIZE, in_blocks};
use crate::check::budget::Budget;
use crate::check::contact::Doubt;
use crate::check::data::{Data, Piece};
use crate::check::step::Landing;
use crate::check::units::{greatest_speed, period};
use crate::check::unlisted::Unlisted;
use crate::check::walk::Walk;
use crate::check::{FIRST_BITS, Finding, Limits, Verdict};
use crate::trap::TrapCertificate;
use impact_pair_document::{Decimal, TrapDocument};
use impact_pair_model::watch::{Latched, Stage, Watch};

/// The reason why a check of boxes ends early.
enum End {
    Open(usize, Open),
    Stopped,
}

impl TrapCertificate {
    /// Proves again that the region is closed, and what is said of it, or says what is not true or not proved, until the watch stops
    /// it, which receives the boxes confirmed so far.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions, or if it has several harmonics.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let watch = Latched::new(watch);
        let law = Law::of(&self.pair)?;
        let boxes = match self.boxes() {
            Ok(boxes) => boxes,
            Err(doubt) => return Ok(doubt.on(self.count())),
        };
        let TrapDocument { columns, rows, .. } = self.document;
        let region = Region::new(columns, rows, boxes.iter().copied());
        let guess = Guess::new(&law);
        let of_block = |block: Range<usize>| {
            block
                .map(|k| {
                    if !watch.goes_on() {
                        return Err(End::Stopped);
                    }
                    region.times(&law, &guess, boxes[k]).map_err(|why| End::Open(k, why))
                })
                .collect()
        };
        let mut confirmed = 0;
        let progress = |known| {
            confirmed = known;
            watch.note(Stage::Claims(known));
        };
        let times = match in_blocks(0..boxes.len(), BLOCK_SIZE, of_block, progress) {
            Ok(times) => times.into_iter().reduce(Span::hull),
            Err(End::Stopped) => return Ok(Verdict::Interrupted { events: confirmed }),
            Err(End::Open(event, why)) => {
                let message = match why {
                    Open::Rest => "it is not proved that no ball comes to rest from there",
                    Open::Leaves => "it is not proved that no flight from there leaves the region",
                };
                return Ok(Verdict::Undecided(Finding { event, message: message.to_owned() }));
            }
        };
        let Some(times) = times else {
            return Ok(Doubt::False("there is no box".into()).on(0));
        };
        let of_words = |words| language::says_what_holds(words, (&law, &guess), &region, &boxes, &watch);
        let answer = self.says_what_holds(times).and_then(|()| self.document.words.as_ref().map_or(Ok(()), of_words));
        let answer = answer.map(|()| f64::MANTISSA_DIGITS);
        let answer = match (answer, self.document.entered_at_impact) {
            (Ok(bits), Some(impact)) => self.enters(&region, impact, limits, &watch)?.map(|more| bits.max(more)), // exact: what is shown
            (answer, _) => answer,
        };
        Ok(match answer {
            Ok(bits) => Verdict::Confirmed { bits, pieces: 1 },
            Err(Doubt::Open(_)) if !watch.goes_on() => Verdict::Interrupted { events: confirmed },
            Err(doubt) => doubt.on(self.count()),
        })
    }

    /// The boxes, if there are N of them in a grid that is judged.
    fn boxes(&self) -> Result<Vec<[i64; 2]>, Doubt> {
        let TrapDocument { columns, rows, region, boxes, .. } = &self.document;
        let wrong = |message: &str| Err(Doubt::False(message.to_owned()));
        if !(columns.is_power_of_two() && *columns > 1 && rows.is_power_of_two()) {
            return Err(Doubt::open("only grids of powers of two are checked"));
        }
        let is_run = |&[column, first, last]: &[i32; 3]| {
            0 <= column && i64::from(column) < i64::from(*columns) && 0 <= first && first <= last
        };
        if !region.iter().all(is_run) {
            return wrong("a run of boxes is beyond the grid");
        }
        if self.count() > MAX_BOXES {
            return Err(Doubt::Open(format!("more than {MAX_BOXES} boxes are not checked")));
        }
        // exact: a length
        if self.count() as u64 != *boxes {
            return wrong("its runs have another number of boxes than given");
        }
        let run = |[column, first, last]: [i32; 3]| (first..=last).map(move |row| [column.into(), row.into()]);
        let all: Vec<[i64; 2]> = region.iter().copied().flat_map(run).collect();
        if all.iter().collect::<HashSet<_>>().len() < all.len() {
            return wrong("a box is listed twice");
        }
        Ok(all)
    }

    /// The bounds hold what is proved of all flights and boxes.
    fn says_what_holds(&self, times: Span) -> Result<(), Doubt> {
        let TrapDocument { rows, region, longest_flight, speed, flight, flight_time, speed_before, .. } =
            &self.document;
        let row = |row: i32| BigRational::new(row.into(), (*rows).into());
        let slowest = region.iter().map(|[_, first, _]| *first).min().map(row);
        let fastest = region.iter().map(|[.., last]| last + 1).max().map(row);
        let speeds = [slowest, fastest].map(|bound| Real::rational(&bound.expect("there is a box"), BITS));
        let times = [times.lo(), times.hi()].map(|x| Real::point(Dyadic::from_f64(x).expect("a finite bound"), BITS));
        let units = self.units()?;
        let scaled = |bounds: &[Real; 2], unit: &Real| bounds.each_ref().map(|bound| bound.clone() * unit);
        let is_below =
            |bound: &Real, claimed: &Decimal| compare_rational(bound.enclosure().sup(), &claimed.value()).is_le();
        let is_above =
            |bound: &Real, claimed: &Decimal| compare_rational(bound.enclosure().inf(), &claimed.value()).is_ge();
        for (what, bounds, claimed) in [
            ("flight", &times, flight),
            ("speed", &speeds, speed),
            ("flight_time", &scaled(&times, &units[0]), flight_time),
            ("speed_before", &scaled(&speeds, &units[1]), speed_before),
        ] {
            if !(is_above(&bounds[0], &claimed[0]) && is_below(&bounds[1], &claimed[1])) {
                return Err(Doubt::Open(format!("{what} is not proved to be within its bounds")));
            }
        }
        if !is_below(&times[1], longest_flight) {
            return Err(Doubt::open("longest_flight is not proved"));
        }
        if !times[0].is_positive() && self.document.no_rest {
            return Err(Doubt::open("no_rest is not proved"));
        }
        Ok(())
    }

    /// A period \[time\] and the greatest speed of the box \[length/time\].
    fn units(&self) -> Result<[Real; 2], Doubt> {
        let reference = self.pair.excitation().reference();
        let units = period(reference).and_then(|period| Ok([period, greatest_speed(reference)?]));
        let units = units.map_err(|_| Doubt::open("the units exceed the range of exact expressions"))?;
        Ok(units.map(|unit| Real::of(&unit, BITS)))
    }

    /// Proves that an impact of the scene's orbit, or its start as number 0, is in the region, or an earlier one is: then all later ones are,
    /// as it is closed; returns the bits used. All of it takes no more work than a claim that is left undecided.
    fn enters(
        &self,
        region: &Region,
        impact: u64,
        limits: &Limits,
        watch: &dyn Watch,
    ) -> Result<Result<u32, Doubt>, Error> {
        let (pair, start) = (&self.pair, &self.start);
        let open = || Doubt::Open(format!("entered_at_impact: impact {impact} is not proved to be in the region"));
        if impact == 0 {
            let state = starts_at(pair, start)?;
            let is_in = state.is_some_and(|state| holds(region, &state));
            return Ok(if is_in { Ok(BITS) } else { Err(open()) });
        }
        let budget = Budget::new(limits.work, limits.parts, watch);
        let data = Data { budget: budget.clone(), ..Data::new(pair, start)? };
        let certificate = Certificate::of_start(pair.clone(), start.clone());
        let harmonic = pair.harmonic("a region")?;
        let mut bits = FIRST_BITS;
        loop {
            let walk = Walk::new(&certificate, &data, &Piece::default(), bits);
            let is_in = |walk: &Walk<'_>, landing: &Landing| {
                let turn = Real::pi(bits) * 2;
                let phase = walk.absolute(&landing.phase.hull()).over(&turn)?;
                let velocity = landing.velocity.hull().over(&Real::of(harmonic.amplitude(), bits))?;
                Some(holds(region, &mirrored(landing.wall, phase, velocity)))
            };
            if walk.standing.still().is_none() && enters_set(walk, impact, is_in) {
                return Ok(Ok(bits));
            }
            if bits >= limits.bits || bits >= MAX_BITS || budget.is_spent() {
                return Ok(Err(open()));
            }
            bits = (2 * bits).min(limits.bits); // proposes: the bits to try
        }
    }
}

/// More bits than these are not worth their time for an impact that is not far from the start.
const MAX_BITS: u32 = 4096;

/// More boxes than the program looks for are not judged.
const MAX_BOXES: usize = 1 << 22;

/// Whether an impact to which a list may give this number, or a smaller one, is proved to be in a set, as long as there is work left. Lemma V42
fn enters_set(walk: Walk<'_>, impact: u64, is_in: impl Fn(&Walk<'_>, &Landing) -> Option<bool>) -> bool {
    let mut motion = Unlisted::new(walk);
    while motion.least() < impact && !motion.walk.data.budget.is_spent() {
        if let Some(rest) = motion.rest().cloned() {
            if motion.leave(&rest).is_err() {
                return false; // exact: nothing is proved
            }
            continue;
        }
        let Some(landing) = motion.next_landing() else { return false };
        if is_in(&motion.walk, &landing) == Some(true) {
            return true;
        }
        motion.go_on(landing);
    }
    false
}

/// A phase \[forcing periods\] and a speed over `A W`, mirrored to the left wall.
pub(super) fn mirrored(wall: Wall, phase: Real, velocity: Real) -> [Real; 2] {
    match wall {
        Wall::Left => [phase, -velocity],
        Wall::Right => [phase.clone() + &Real::int(1, phase.bits()).half(), velocity],
    }
}

/// The state of a start on a wall.
fn starts_at(pair: &ImpactPair, start: &Start) -> Result<Option<[Real; 2]>, Error> {
    let Place::Wall(wall) = start.place() else { return Ok(None) };
    let harmonic = pair.harmonic("a region")?;
    let turn = Exact::pi() * Exact::from(2);
    let phase = harmonic.frequency().checked_mul(start.time()).and_then(|x| x.checked_add(harmonic.phase()));
    let phase = within("start.time", start.time(), phase.and_then(|phase| phase.checked_div(&turn)))?;
    let velocity = start.velocity().checked_div(&greatest_speed(harmonic)?);
    let velocity = within("start.velocity", start.velocity(), velocity)?;
    Ok(Some(mirrored(*wall, Real::of(&phase, BITS), Real::of(&velocity, BITS))))
}

/// Returns whether all states within these bounds are in boxes of the region.
fn holds(region: &Region, [phase, speed]: &[Real; 2]) -> bool {
    // Whole forcing periods are taken off before it becomes doubles.
    let turns = phase.middle().floor().unwrap_or(0); // exact: any whole number of forcing periods
    let phase = phase.clone() - &Real::int(turns, phase.bits());
    let [phase, speed] = [&phase, speed].map(|x| Span::of(x.enclosure()));
    speed.lo() >= 0.0 && region.holds(phase, speed) // V11: no speed is negative
}
