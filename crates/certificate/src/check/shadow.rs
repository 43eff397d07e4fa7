//! Shadowed orbits: proof that one start near the given start has all listed impacts.
//!
//! Method (Lemma V10): Newton's iteration over all impacts at once turns the middles of the claimed bounds into an orbit with tiny jumps
//! ([`pseudo`](super::pseudo)). Nodes around its states, far smaller than the bounds, are proved to cover one another ([`chain`](super::chain)),
//! each link alone, on several threads. The events after the last node are followed as from any set ([`walk`](super::walk)).

use std::cmp::Ordering;
use std::ops::Range;

use num_rational::BigRational;

use super::blocks::{BLOCK_SIZE, in_blocks};
use super::budget::Budget;
use super::chain::{Course, Node, open};
use super::clock::{SetPosition, beside};
use super::contact::Doubt;
use super::data::{Data, Piece};
use super::frame::{ClaimedImpact, Frame};
use super::pseudo::{Point, Shot, improve, is_fine, plan, take, worst};
use super::standing::WalkState;
use super::step::Landing;
use super::target::narrowest;
use super::walk::Walk;
use super::{FIRST_BITS, Finding, Limits, Verdict};
use crate::Certificate;
use impact_pair_document::NearDocument;
use impact_pair_exact::{Dyadic, Real};
use impact_pair_model::Wall;
use impact_pair_model::watch::Watch;

/// Steps of Newton's iteration.
const STEPS: u32 = 8;
/// Bits of the arithmetic beyond those of the narrowest bounds.
const SPARE_BITS: i64 = 112;

/// Shares of the greatest expansion, tried in turn if the chain up to the next other event is not proved: the chain then ends where the
/// expansion first reaches the share. If the motion hardly expands, that is the start, and the scene's own motion is followed.
const EXPANSION_SHARES: [f64; 2] = [1.0, 1.0 / 16.0];

/// A claim that is not confirmed: its position among the events, and the reason.
pub(super) type Doubted = (usize, Doubt);

/// A proved chain of nodes.
struct Chained {
    /// Number of the last impact of the chain, and the last node; `None` for an empty chain.
    last: Option<(usize, Node)>,
    /// Distances of the nodes from the middles of the claimed bounds of time \[rad\] ([`Course::link`]).
    offs: Vec<Dyadic>,
}

/// A shadowed orbit and the limits of its check.
pub(super) struct Shadow<'c> {
    pub certificate: &'c Certificate,
    pub near: &'c NearDocument,
    /// The impacts before any other event.
    pub hits: Vec<ClaimedImpact<'c>>,
    pub is_of_times: bool,
    limits: &'c Limits,
    watch: &'c dyn Watch,
}

impl Certificate {
    /// The verdict on all events and the outcome of a shadowed orbit.
    pub(super) fn shadowed(
        &self,
        limits: &Limits,
        watch: &dyn Watch,
        data: &Data,
        progress: &mut impl FnMut(usize),
    ) -> Verdict {
        let end = self.events().len();
        let answer = (|| {
            self.says_one_thing().map_err(|doubt| (end, doubt))?;
            let near = self
                .ended()
                .start
                .as_ref()
                .ok_or_else(|| (end, Doubt::False("a shadowed orbit tells its start".into())))?;
            let start = WalkState::at_start(data, &data.parameters(&Piece::default(), FIRST_BITS), &Piece::default());
            let is_of_times = data.wall.is_some() && start.departure().velocity.hull().is_zero();
            let hits = self.events().iter().enumerate().map_while(ClaimedImpact::of).collect();
            let shadow = Shadow { certificate: self, near, hits, is_of_times, limits, watch };
            shadow.fits(start.last())?;
            if !data.is_point() {
                return Err((0, Doubt::open("a shadowed orbit is not checked where data are intervals")));
            }
            shadow.starts_around_the_scenes().map_err(|doubt| (end, doubt))?;
            let (bits, offs) = shadow.answer(data, progress)?;
            shadow.is_within_epsilon(offs).map_err(|doubt| (end, doubt))?;
            data.budget.add(limits.work);
            self.attracts(data, limits.pieces).map_err(|doubt| (end, doubt))?;
            Ok(bits)
        })();
        match answer {
            Ok(bits) => Verdict::Confirmed { bits, pieces: 1 },
            Err((event, Doubt::False(message))) => Verdict::Refuted(Finding { event, message }),
            Err((event, Doubt::Open(message))) => Verdict::Undecided(Finding { event, message }),
        }
    }
}

impl Shadow<'_> {
    /// Bits for nodes in the narrowest bounds: the first impacts may have been certified in high precision.
    fn bits(&self) -> u32 {
        let near = self.bounds();
        let [times, velocities] = [0, 1].map(|i| {
            let bounds = self.hits.iter().map(move |hit| [hit.time, hit.velocity][i]);
            let bounds = bounds.chain((self.is_of_times == (i == 0)).then_some(&near[i]));
            let top = |x: &BigRational| Real::rational(x, FIRST_BITS).enclosure().mag().top();
            let largest = bounds.clone().flatten().filter_map(top).max();
            largest.zip(narrowest(bounds)).map(|(largest, narrowest)| largest - narrowest)
        });
        let digits = times.max(velocities).map_or(0, |digits| digits + SPARE_BITS); // proposes
        let bits = u32::try_from(digits).map_or(FIRST_BITS, |digits| digits.max(FIRST_BITS)); // proposes: bits to compute with
        bits.min(self.limits.bits.max(FIRST_BITS)) // proposes
    }

    /// Calls `answer` with data and a frame of the calling thread's own.
    fn under<T>(&self, bits: u32, answer: impl FnOnce(&Course<'_>) -> T) -> T {
        let Limits { work, parts, .. } = *self.limits;
        let data = Data::new(self.certificate.pair(), self.certificate.start()).expect("they have been read before");
        let data = Data { budget: Budget::new(work, parts, self.watch), ..data };
        let frame = Frame::new(&data, &Piece::default(), bits);
        answer(&Course { data: &data, frame, hits: &self.hits, is_of_times: self.is_of_times })
    }

    /// `answer` for each of the flights, or the first doubt, on several threads.
    fn of_each<T: Send>(
        &self,
        flights: Range<usize>,
        bits: u32,
        answer: impl Fn(&Course<'_>, usize) -> Result<T, Doubt> + Sync,
        progress: impl FnMut(usize),
    ) -> Result<Vec<T>, Doubted> {
        let of_block = |block: Range<usize>| {
            self.under(bits, |course| {
                block
                    .map(|k| {
                        let budget = &course.data.budget;
                        if budget.is_stopped() {
                            return Err((k, Doubt::open("it is stopped")));
                        }
                        budget.allow(bits, course.data.tones.len());
                        answer(course, k).map_err(|doubt| (k, doubt))
                    })
                    .collect()
            })
        };
        in_blocks(flights, BLOCK_SIZE, of_block, progress)
    }

    /// The bits that confirm all events and the outcome, and for each impact of the proved orbit an upper bound of its distance from the
    /// middle of the claimed bounds of its time \[rad\].
    fn answer(&self, data: &Data, progress: &mut impl FnMut(usize)) -> Result<(u32, Vec<Dyadic>), Doubted> {
        let mut bits = self.bits();
        let chained = EXPANSION_SHARES.into_iter().fold(self.chained(None, bits, progress), |chained, share| {
            chained.or_else(|_| self.chained(Some(share), bits, progress))
        });
        let Chained { last, offs: chained } = match chained {
            Ok(chained) => chained,
            // exact: where nothing is refuted, what is in doubt
            Err(doubted) => return Err(self.refuted().unwrap_or(doubted)),
        };
        let mut before = None;
        loop {
            let doubted = match self.goes_on(data, last.as_ref(), bits, progress) {
                Ok(offs) => return Ok((bits, [chained, offs].concat())),
                Err(doubted) => doubted,
            };
            let event = doubted.0;
            // More bits help after a release, which does not depend on the start.
            let is_stuck = before.is_some_and(|before| event <= before);
            if is_stuck || bits >= self.limits.bits || data.budget.is_spent() {
                let are_open = last.is_some();
                return Err(if are_open { doubted } else { self.refuted().unwrap_or(doubted) }); // exact: what is in doubt
            }
            before = Some(event);
            let more = self.under(bits, |course| self.certificate.more_bits(&course.frame, bits));
            bits = more.min(self.limits.bits); // proposes
        }
    }

    /// A chain of nodes along the impacts. With a `share` the chain ends where the expansion first reaches that share of the greatest expansion.
    fn chained(&self, share: Option<f64>, bits: u32, progress: &mut impl FnMut(usize)) -> Result<Chained, Doubted> {
        let nothing = |_: usize| {};
        let mut points = self.under(bits, |course| course.middles());
        let mut shots: Vec<Shot> = Vec::new();
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let shot = |course: &Course<'_>, k: usize| {
                course.shot(k, [&points[k], &points[k + 1]], shots.get(k).map(|shot| &shot.lasting))
            };
            shots = self.of_each(0..points.len() - 1, bits, shot, nothing)?;
            take(&mut points, &shots, share);
            if points.len() == 1 {
                return Ok(Chained { last: None, offs: Vec::new() });
            }
            let (at, ratio) = worst(&points);
            if is_fine(ratio) {
                break;
            }
            if ratio.partial_cmp(&before) != Some(Ordering::Less) {
                return Err((at - 1, Doubt::open("no orbit is found near the bounds")));
            }
            before = ratio;
            improve(&mut points).ok_or_else(|| (at - 1, Doubt::open("no orbit is found near the bounds")))?;
        }
        plan(&mut points);
        self.starts_near(&points[0], bits).map_err(|doubt| (0, doubt))?;
        let link =
            |course: &Course<'_>, k: usize| course.link(k, [&points[k].node, &points[k + 1].node], &shots[k].lasting);
        let offs = self.of_each(0..points.len() - 1, bits, link, progress)?;
        Ok(Chained { last: points.pop().map(|last| (points.len(), last.node)), offs })
    }

    /// Proves that the first node lies in the bounds of the start.
    fn starts_near(&self, first: &Point, bits: u32) -> Result<(), Doubt> {
        let [phase, velocity] = self.under(bits, |course| course.states(0, &first.node)).map(|x| x.hull());
        let bounds = self.bounds();
        self.under(bits, |course| {
            let (found, bounds) = match self.is_of_times {
                true => (course.frame.clock.time(&phase), &bounds[0]),
                false => (course.frame.clock.velocity(&velocity), &bounds[1]),
            };
            match beside(&found, bounds) {
                SetPosition::Inside => Ok(()),
                _ => Err(Doubt::open("no start in its bounds is proved to have this orbit")),
            }
        })
    }

    /// Follows the events after the last node, and the outcome; returns the distances of their impacts from the middles of the bounds.
    fn goes_on(
        &self,
        data: &Data,
        last: Option<&(usize, Node)>,
        bits: u32,
        progress: &mut impl FnMut(usize),
    ) -> Result<Vec<Dyadic>, Doubted> {
        let mut walk = match last {
            Some((impacts, node)) => {
                let [phase, velocity] = self.under(bits, |course| course.states(*impacts, node));
                let landing = Landing::new(self.hits[impacts - 1].wall, phase, velocity);
                let frame = Frame::new(data, &Piece::default(), bits);
                let standing = WalkState::after(&frame.parameters, landing);
                Walk::at((self.certificate, data), frame, standing, *impacts)
            }
            // Without a chain the start is the scene's.
            None => Walk::new(self.certificate, data, &Piece::default(), bits),
        };
        let mut offs = Vec::new();
        let mut confirmed = |walk: &Walk<'_>| {
            data.budget.allow(bits, data.tones.len());
            progress(walk.event);
            let claimed = &self.certificate.events()[walk.event - 1].time;
            let landing = walk.standing.landing();
            offs.extend(landing.map(|landing| walk.clock.off(&walk.clock.time(&landing.phase.hull()), claimed)));
        };
        walk.all(&mut confirmed).map_err(|doubt| (walk.event, open(&doubt)))?;
        Ok(offs)
    }

    /// A claim that is proved false: no flight from a state within the previous bounds leads into the claimed bounds.
    fn refuted(&self) -> Option<Doubted> {
        let [time, velocity] = self.bounds();
        let all = self.of_each(
            0..self.hits.len(),
            FIRST_BITS,
            |course, k| {
                let Course { data, frame, .. } = course;
                let standing = match k.checked_sub(1).map(|hit| &self.hits[hit]) {
                    Some(hit) => WalkState::after(&frame.parameters, frame.states(hit)),
                    None => {
                        // The wall does not matter inside the gap.
                        let starts = frame.hulls([&time, &velocity]);
                        let Landing { phase, velocity, .. } = frame.spanned(Wall::Left, starts);
                        WalkState::of_starts(course.departure(0, [phase, velocity]))
                    }
                };
                let frame = Frame::new(data, &Piece::default(), FIRST_BITS);
                let mut walk = Walk::at((self.certificate, data), frame, standing, k);
                match walk.confirm(&self.certificate.events()[k]) {
                    Err(doubt @ Doubt::False(_)) => Err(doubt),
                    _ => Ok(()),
                }
            },
            |_| {},
        );
        all.err().filter(|doubted| matches!(doubted, (_, Doubt::False(_))))
    }
}
