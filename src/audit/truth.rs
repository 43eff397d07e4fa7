//! The reference for a list: the certified orbit with its grazes, chatters and rests.

use std::ops::ControlFlow;

use impact_pair_document::ArithmeticDocument;

use super::finding::Finding;
use super::tolerance::Tolerance;
use crate::exact::{Dyadic, Enclosure, Exact};
use crate::orbit::{Conclusion, Event, EventKind};
use crate::orbit::{Orbit, Outcome, Place, Settings};
use crate::pair::Wall;
use crate::watch::Watch;
use crate::{Error, Scene};

/// Impacts that are followed for each row of the list.
const IMPACTS_PER_ROW: usize = 2;
/// Impacts that are followed in addition to those.
const EXTRA_IMPACTS: usize = 1000;
/// Impacts in a row on one wall that are not counted: they may be a chatter's.
const IMPACTS_PER_RUN: usize = 1 << 16;

/// A certified contact that a list may have, in time order.
#[derive(Clone, Debug)]
pub struct Site {
    /// The kind of contact, which determines whether it has to be listed.
    pub kind: SiteKind,
    /// Number of the impact; for other contacts that of the last impact.
    pub index: u64,
    /// Wall of the contact.
    pub wall: Wall,
    /// \[time\]
    pub time: Enclosure,
    /// `y'` just before the contact \[length/time\]; `None` for a graze.
    pub velocity: Option<Enclosure>,
    /// The rest that comes next, before any other contact.
    pub rest: Option<Rest>,
}

/// The kind of a contact, which determines whether it has to be listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiteKind {
    /// An impact: has to be listed.
    Impact,
    /// The impact that the orbit starts with: need not be listed.
    Start,
    /// A graze: need not be listed.
    Graze,
}

impl Site {
    /// The middle of the time's enclosure.
    pub(super) fn middle(&self) -> Dyadic {
        self.time.inf().middle(self.time.sup())
    }
}

/// The ball on its wall.
#[derive(Clone, Debug)]
pub struct Rest {
    /// Beginning of the rest \[time\].
    pub from: Enclosure,
    /// End of the rest; `None`: for ever, or to the end.
    pub until: Option<Enclosure>,
    /// After infinitely many impacts.
    pub is_accumulation: bool,
}

/// The certified orbit, as far as it is needed.
pub(super) struct Truth {
    pub sites: Vec<Site>,
    /// Time from which on nothing is certified \[time\]; `None` if everything requested is.
    pub doubtful_from: Option<Enclosure>,
    /// True if the orbit was not followed further because the list lacks more impacts than it has rows.
    pub is_cut: bool,
    pub conclusion: Conclusion,
    /// The arithmetic that computed it, as in the orbit JSON.
    pub computed: ArithmeticDocument,
    /// First impact whose enclosure is wider than the requested digits.
    pub wide: Option<u64>,
}

impl Truth {
    /// Follows the orbit of the scene for a list of `rows` rows; when interrupted, as far as it came.
    ///
    /// A row is at most one contact. So of more than `2 n + 1000` impacts a list of `n` rows lacks more than `n`: the list is wrong, and its
    /// later rows, at arbitrarily late times, are not worth following the orbit. Of the impacts since the ball left the other wall, the first
    /// `2^16` do not count: they may belong to a chatter, which need not be listed. Later ones count: with `e` at or near 1, hops on one wall
    /// have no end that can be waited for.
    pub fn follow(
        scene: &Scene,
        settings: Settings,
        tolerance: &Tolerance,
        rows: usize,
        watch: &dyn Watch,
    ) -> Result<Self, Error> {
        let mut orbit = Orbit::of(scene, settings)?;
        let mut sites: Vec<Site> = start(scene, tolerance.bits).into_iter().collect();
        let mut last: Option<Event> = None;
        let (mut impacts, mut counted) = (0, 0);
        let most = rows.saturating_mul(IMPACTS_PER_ROW).saturating_add(EXTRA_IMPACTS); // exact: of what fits into memory
        let ended = orbit.follow(watch, |orbit, step| {
            if let Some(event) = Event::of(orbit, &step) {
                let is_other = sites.last().is_some_and(|last| last.wall != event.wall || last.rest.is_some());
                note(&mut sites, (&event, orbit.listed()), tolerance);
                last = Some(event);
                if is_other {
                    // The run that ended keeps what it has.
                    impacts += sites[counted..].iter().filter(|site| site.kind == SiteKind::Impact).count();
                    counted = sites.len();
                }
                let in_run = sites.len().saturating_sub(counted); // exact: a rest may leave out some of those counted
                let most_in_run = most.saturating_add(IMPACTS_PER_RUN); // exact: of what fits into memory
                if impacts > most || in_run > most_in_run {
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        });
        let doubtful_from =
            match orbit.outcome() {
                Some(Outcome::Undecided { time: (from, _), .. }) => Some(from.clone()),
                Some(_) => None,
                None => Some(last.as_ref().map_or_else(
                    || scene.start().time().enclose(tolerance.bits),
                    |event| event.time.enclosure().clone(),
                )),
            };
        Ok(Self {
            sites,
            doubtful_from,
            is_cut: ended.is_break(),
            conclusion: Conclusion::of(&orbit, last.as_ref()),
            computed: orbit.computed(),
            wide: orbit.first_wide(),
        })
    }

    /// Outcome of the orbit, or the reason why it was not followed further.
    pub fn message(&self) -> String {
        match self.sites.last() {
            Some(last) if self.is_cut => {
                format!("not followed beyond impact {}: the list lacks more impacts than it has rows", last.index)
            }
            _ => self.conclusion.message().to_owned(),
        }
    }

    /// Number of the impact that a finding is about.
    pub fn impact(&self, finding: &Finding) -> u64 {
        finding.site.map_or(0, |site| self.sites[site].index)
    }

    /// Times between successive contacts at which the nearest contact changes: the middle of a rest between them, or else of the contacts.
    pub fn boundaries(&self) -> Vec<Dyadic> {
        let boundary = |pair: &[Site]| {
            let [one, next] = pair else { unreachable!("windows of two") };
            match one.rest.as_ref().and_then(|rest| Some((&rest.from, rest.until.as_ref()?))) {
                Some((from, until)) => from.sup().middle(until.inf()),
                None => one.middle().middle(&next.middle()),
            }
        };
        self.sites.windows(2).map(boundary).collect()
    }
}

/// The impact that the orbit starts with, if it starts on a wall.
fn start(scene: &Scene, bits: u32) -> Option<Site> {
    let start = scene.start();
    let Place::Wall(wall) = *start.place() else { return None };
    let enclose = |x: &Exact| x.enclose(bits);
    let (time, velocity) = (enclose(start.time()), Some(enclose(start.velocity())));
    Some(Site { kind: SiteKind::Start, index: 0, wall, time, velocity, rest: None })
}

/// Adds an event of the orbit; `index` is that of the last impact.
fn note(sites: &mut Vec<Site>, (event, index): (&Event, u64), tolerance: &Tolerance) {
    let (wall, time) = (event.wall, event.time.enclosure().clone());
    match &event.kind {
        EventKind::Impact { velocity, .. } => {
            let velocity = Some(velocity.enclosure().clone());
            sites.push(Site { kind: SiteKind::Impact, index, wall, time, velocity, rest: None });
        }
        EventKind::Graze { .. } => {
            sites.push(Site { kind: SiteKind::Graze, index, wall, time, velocity: None, rest: None })
        }
        EventKind::Rest { is_accumulation } => {
            if *is_accumulation {
                leave_out_tail(sites, &time, tolerance);
            }
            // A rest comes after a contact, were it that of the start.
            if let Some(last) = sites.last_mut() {
                last.rest = Some(Rest { from: time, until: None, is_accumulation: *is_accumulation });
            }
        }
        EventKind::Release => {
            if let Some(rest) = sites.last_mut().and_then(|last| last.rest.as_mut()) {
                rest.until = Some(time);
            }
        }
    }
}

/// Leaves out the last impacts of a chatter: those not proved, by more than the tolerance, to be earlier than its end or faster than the contact
/// before them. After a graze, which leaves no chatter behind, impacts of some speed are kept.
///
/// To the tolerance these are one with the infinitely many impacts that are not listed.
fn leave_out_tail(sites: &mut Vec<Site>, end: &Enclosure, tolerance: &Tolerance) {
    // G1: a graze is no impact, or one of a speed too small to tell
    let velocity = |site: &Site| site.velocity.clone().unwrap_or_else(|| Enclosure::point(Dyadic::zero()));
    while let [.., before, last] = sites.as_slice()
        && last.kind == SiteKind::Impact
        && before.wall == last.wall
        && before.rest.is_none()
        && !tolerance.is_outside_in_time(&tolerance.distance(end, &last.time))
        && !is_faster(&velocity(last), &velocity(before), tolerance)
    {
        sites.pop();
    }
}

/// Whether a velocity is proved, by more than the tolerance, not to lie between that of a contact and 0.
pub(super) fn is_faster(velocity: &Enclosure, than: &Enclosure, tolerance: &Tolerance) -> bool {
    let slower = than.hull(&Enclosure::point(Dyadic::zero()));
    tolerance.is_outside_in_velocity(&tolerance.distance(velocity, &slower))
}
