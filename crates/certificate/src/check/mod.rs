//! Check of an orbit JSON, computed anew from its own decimal numbers.
//!
//! The method shares with the computation of the certificate only the exact numbers and their interval arithmetic. It uses physical
//! lengths instead of gaps, radians instead of forcing periods, and one arithmetic of integers whose precision rises until every claim is
//! decided; no closed-form extrema. The claimed times only say where to look. Every flight is followed from
//! the flight before, not from the claimed box, and proved clear of both walls up to its contact by halving ([`flight`], [`contact`],
//! Lemma V1). Sets are propagated in mean value form ([`affine`], [`step`], Lemma V2), those of a single motion along axes of their own
//! ([`aligned`]), and so is a neighbourhood of a periodic orbit over whole periods, until it is proved to shrink ([`attraction`], Lemma
//! V6). Of a shadowed orbit each link between two impacts is proved alone, from nodes computed from the claimed boxes ([`shadow`],
//! [`chain`], Lemma V10). Orbits of one list are distinguished by their bounds ([`distinct`], Lemma V13). Homoclinic tangencies are
//! enclosed by shooting from series of the manifolds ([`tangency`], Lemmas V17-V19). Regions and words of horseshoes are proved in
//! doubles ([`chaos`], Lemmas V11, V12, V39). A claim is confirmed when the computed enclosure lies inside its bounds, refuted when the
//! enclosure lies outside.

mod affine;
mod aligned;
mod angle;
mod atlas;
mod attraction;
mod axes;
mod basin;
mod bifurcation;
mod blocks;
mod budget;
mod chain;
mod chaos;
mod chatter;
mod clock;
mod complete;
mod contact;
mod curve;
mod cycles;
mod data;
mod distinct;
mod excursion;
mod fixed_point;
mod flight;
mod frame;
mod graze;
mod legs;
mod near;
mod need;
mod number;
mod outcome;
mod periodic;
mod points;
mod pseudo;
mod release;
mod rest;
mod root;
mod round;
mod shadow;
mod shaking;
mod span;
mod standing;
mod step;
mod still;
mod sweep;
mod tangency;
mod target;
mod units;
mod unlisted;
mod walk;
mod windows;

use std::collections::BTreeMap;

use super::Certificate;
use budget::Budget;
pub(super) use contact::Doubt;
pub(super) use data::{Data, Piece};
pub(super) use flight::Flight;
use frame::Frame;
use impact_pair_document::ClaimName;
use impact_pair_exact::{Enclosure, Real};
use impact_pair_model::Error;
use impact_pair_model::watch::{Latched, Stage, Watch};
pub(super) use step::{Launch, Parameters};
pub(super) use walk::Walk;

/// The verdict of a check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every claim is proved again.
    Confirmed {
        /// Greatest precision used, in bits.
        bits: u32,
        /// Number of pieces into which the interval data were cut; 1 for data that are points.
        pieces: usize,
    },
    /// A claim is proved to be false.
    Refuted(Finding),
    /// A claim is neither proved again nor refuted.
    Undecided(Finding),
    /// The caller has stopped the check; the events before were confirmed, for all data if these are points.
    Interrupted {
        /// Number of events that were confirmed, without a gap.
        events: usize,
    },
}

/// The first claim that is not confirmed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The position among the events, from 0; the number of events for the outcome.
    pub event: usize,
    /// The reason in words.
    pub message: String,
}

/// Limits of a check, beyond which a claim is left undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bits of the arithmetic.
    pub bits: u32,
    /// Parts into which a flight may be cut.
    pub parts: u32,
    /// Pieces into which the interval data may be cut.
    pub pieces: usize,
    /// Flight evaluations before a claim is left undecided, each with one harmonic and in up to 512 bits; an evaluation in
    /// `n` times as many bits counts `n^2` times. A confirmed claim allows 256 more, in the bits that the claim took.
    pub work: u64,
}

impl Default for Limits {
    /// 131,072 bits, 2,097,152 parts of a flight, 4,096 pieces of the data, 262,144 evaluations: some 5 to 10 s.
    fn default() -> Self {
        Self { bits: 1 << 17, parts: 1 << 21, pieces: 1 << 12, work: 1 << 18 }
    }
}

impl From<impact_pair_model::Effort> for Limits {
    /// The usual limits, with that many times the parts and the evaluations: these are what claims are left undecided by.
    fn from(effort: impact_pair_model::Effort) -> Self {
        let usual = Self::default();
        let parts = u32::try_from(effort.times(usual.parts.into())).unwrap_or(u32::MAX); // proposes: when to give up
        Self { parts, work: effort.times(usual.work), ..usual }
    }
}

/// The first precision, in bits.
const FIRST_BITS: u32 = 192;
/// Bits at which a claim is given up if it was undecided at a quarter of them: then a bound is the exact value, or there is an exact
/// graze.
const GIVE_UP_BITS: u32 = 4096;

impl Doubt {
    /// The verdict on the claim `event`.
    fn on(self, event: usize) -> Verdict {
        match self {
            Self::False(message) => Verdict::Refuted(Finding { event, message }),
            Self::Open(message) => Verdict::Undecided(Finding { event, message }),
        }
    }
}

/// Checks claims one after another, each with `work`; returns the bits used, or the verdict on the first claim not confirmed.
fn one_by_one<C>(
    claims: impl Iterator<Item = (usize, C)>,
    (budget, work): (&Budget, u64),
    mut judge: impl FnMut(C) -> Result<u32, Doubt>,
    watch: &dyn Watch,
) -> Result<u32, Verdict> {
    let mut most = 0;
    for (event, claim) in claims {
        if !watch.goes_on() {
            return Err(Verdict::Interrupted { events: event });
        }
        budget.add(work);
        match judge(claim) {
            Err(Doubt::Open(_)) if budget.is_stopped() => return Err(Verdict::Interrupted { events: event }),
            Err(doubt) => return Err(doubt.on(event)),
            Ok(bits) => {
                most = most.max(bits); // exact: what is shown
                watch.note(Stage::Claims(event + 1));
            }
        }
    }
    Ok(most)
}

/// A document whose claims are checked one after another, and its properties that are known before.
struct DocumentCheck<'c> {
    /// A contradiction between the document's own fields.
    contradiction: Option<&'c str>,
    /// The message if two claims may be the same orbit.
    alike: Option<&'static str>,
    /// Number of claims.
    count: usize,
    /// The message of a document that has no claim to check.
    nothing: &'static str,
}

impl DocumentCheck<'_> {
    /// Checks the claims, until one is not confirmed or the watch stops the check.
    fn judged<C>(
        self,
        claims: impl Iterator<Item = (usize, C)>,
        limits: &Limits,
        watch: &dyn Watch,
        mut judge: impl FnMut(C, &Budget<'_>, &dyn Watch) -> Result<u32, Doubt>,
    ) -> Verdict {
        let Self { contradiction, alike, count, nothing } = self;
        if let Some(message) = contradiction {
            return Doubt::False(message.to_owned()).on(count);
        }
        if let Some(message) = alike {
            return Doubt::open(message).on(count);
        }
        let watch = Latched::new(watch);
        let budget = Budget::new(0, limits.parts, &watch);
        match one_by_one(claims, (&budget, limits.work), |claim| judge(claim, &budget, &watch), &watch) {
            Ok(0) => Doubt::open(nothing).on(count),
            Ok(bits) => Verdict::Confirmed { bits, pieces: 1 },
            Err(verdict) => verdict,
        }
    }
}

impl Certificate {
    /// Proves every claim again, or returns the first claim that is refuted or undecided. The watch can stop the check and receives
    /// the number of events confirmed so far.
    ///
    /// The outcome `impacts-reached` claims nothing after the events; `time-reached` and `undecided` claim that no event follows up to a time.
    ///
    /// **Cost**: a tenth of a millisecond per impact that doubles decide, 0.2 of a shadowed orbit of any length, on as many threads as
    /// there are processors. An impact of a chaotic orbit of 2,000 impacts takes 0.3 milliseconds, of 10,000 impacts 0.7: in the bits that
    /// the impacts still to come will lose.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions.
    pub fn check(&self, watch: &dyn Watch) -> Result<Verdict, Error> {
        self.check_within(&Limits::default(), watch)
    }

    /// Checks within these limits; see [`check`](Self::check).
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let watch = Latched::new(watch);
        let budget = Budget::new(limits.work, limits.parts, &watch);
        let data = Data { budget: budget.clone(), ..Data::new(self.pair(), self.start())? };
        let mut reached = 0;
        let mut progress = |event: usize| {
            reached = reached.max(event); // exact: a count
            watch.note(Stage::Claims(event));
        };
        let is_whole = data.is_point();
        let verdict = match self.claim() {
            ClaimName::ExactStart => self.judged(limits, &data, &mut progress),
            ClaimName::Shadowed => self.shadowed(limits, &watch, &data, &mut progress),
        };
        Ok(match verdict {
            Verdict::Undecided(_) if budget.is_stopped() => {
                Verdict::Interrupted { events: if is_whole { reached } else { 0 } }
            }
            Verdict::Undecided(Finding { event, message }) if budget.is_spent() => {
                Verdict::Undecided(Finding { event, message: format!("{message}; the work allowed is spent") })
            }
            verdict => verdict,
        })
    }

    /// The verdict on all events and the outcome.
    fn judged(&self, limits: &Limits, data: &Data, progress: &mut impl FnMut(usize)) -> Verdict {
        let (mut bits, mut pieces, mut cut) = (FIRST_BITS, vec![Piece::default()], 1);
        // The event at which more bits did not help, and the number of bits at the first attempt.
        let mut stuck = (0, bits);
        let mut grazes: BTreeMap<usize, Real> = BTreeMap::new();
        let mut farthest = 0;
        while let Some(piece) = pieces.pop() {
            let mut walk = Walk::new(self, data, &piece, bits);
            let mut confirmed = |walk: &Walk<'_>| {
                // A piece that is halved later has confirmed claims in vain: only the first of them allows more.
                if walk.event > farthest {
                    farthest = walk.event;
                    data.budget.allow(bits, data.tones.len());
                }
                progress(walk.event);
            };
            let Err(doubt) = walk.all(&mut confirmed) else {
                self.events().iter().for_each(|_| data.budget.allow(bits, data.tones.len()));
                for (event, distance) in walk.grazes {
                    let hull = grazes.get(&event).map_or_else(|| distance.clone(), |found| distance.hull(found));
                    grazes.insert(event, hull);
                }
                continue;
            };
            let event = walk.event;
            match walk.widest_datum() {
                _ if matches!(doubt, Doubt::False(_)) || data.budget.is_spent() => return doubt.on(event),
                Some(datum) if cut < limits.pieces => {
                    pieces.extend(piece.halves(datum));
                    cut += 1;
                }
                widest => {
                    let is_stuck = stuck.0 == event;
                    stuck = if is_stuck { stuck } else { (event, bits) };
                    // proposes: the bits to try
                    let is_enough = bits >= GIVE_UP_BITS.max(4 * stuck.1) || bits >= limits.bits;
                    if widest.is_some() || is_enough {
                        return doubt.on(event);
                    }
                    // proposes
                    let more = if is_stuck { 2 * bits } else { self.more_bits(&Frame::new(data, &piece, bits), bits) };
                    (bits, farthest) = (more.min(limits.bits), 0); // proposes
                    pieces.push(piece);
                }
            }
        }
        if let Err((event, doubt)) = self.are_grazes(data, &grazes) {
            return doubt.on(event);
        }
        data.budget.add(limits.work);
        match self.attracts(data, limits.pieces) {
            Ok(()) => Verdict::Confirmed { bits, pieces: cut },
            Err(doubt) => doubt.on(self.events().len()),
        }
    }

    /// Encloses times \[time\] and velocities \[length/time\] of the listed impacts, computed again in `bits` bits: of as many impacts
    /// as certainly are on one wall.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions.
    pub fn retraced(&self, bits: u32) -> Result<Vec<(Enclosure, Enclosure)>, Error> {
        let data = Data::new(self.pair(), self.start())?;
        let mut walk = Walk::new(self, &data, &Piece::default(), bits);
        let mut found = Vec::new();
        for claim in self.events() {
            // Here the set need not lie inside the printed bounds.
            let before = walk.impacts;
            let _ = walk.confirm(claim);
            if !claim.kind.is_impact() {
                continue;
            }
            let Some(landing) = walk.standing.landing().filter(|_| walk.impacts > before) else { break };
            let time = walk.clock.time(&landing.phase.hull());
            let velocity = walk.clock.velocity(&landing.velocity.hull());
            found.push((time.enclosure().clone(), velocity.enclosure().clone()));
        }
        Ok(found)
    }
}
