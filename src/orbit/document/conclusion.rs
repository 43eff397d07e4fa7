//! Outcome of an orbit as a document, whose message follows from its fields.

use impact_pair_document::{Between, Decimal, EpsilonDocument, NearDocument, OutcomeDocument, Written, bounds};

use super::event::Event;
use crate::contact::Reason;
use crate::exact::{Enclosure, Exact, decimal_bounds_f64};
use crate::orbit::{Orbit, Outcome, Shadowing};
use crate::periodic::Attractor;
use crate::periodic::document::{measured, periodic_orbit};
use impact_pair_model::vocabulary::OutcomeKind;

/// The end of an orbit: the `outcome` of the orbit JSON.
#[derive(Clone, Debug)]
pub struct Conclusion {
    document: OutcomeDocument,
    reason: Option<Reason>,
}

impl Conclusion {
    /// Returns the conclusion of an orbit that has ended; that of an interrupted one otherwise. `last` is its last event.
    pub fn of(orbit: &Orbit, last: Option<&Event>) -> Self {
        let plain = OutcomeDocument {
            kind: orbit.outcome().map_or(OutcomeKind::Undecided, Outcome::kind),
            impacts: Some(orbit.listed()),
            until: orbit.listed_until().map(Written::from),
            may_be_later: orbit.listed_until().and_then(|until| later(orbit, until)),
            start: orbit.shadow().map(|shadow| near(&shadow)),
            epsilon: orbit.shadow().and_then(|shadow| shadow.nearness).map(epsilon),
            ..OutcomeDocument::default()
        };
        let decided = |document: OutcomeDocument| Self { document: document.with_message(), reason: None };
        match orbit.outcome() {
            Some(Outcome::ImpactsReached | Outcome::TimeReached | Outcome::NeverImpacts) => decided(plain),
            Some(Outcome::Periodic(period)) => decided(OutcomeDocument { period: Some(*period), ..plain }),
            Some(Outcome::Attracted(attractor)) => {
                let Attractor { word, cycles, from, orbit: found, .. } = &**attractor;
                let units = |velocity: &Enclosure| orbit.clock().velocity(velocity);
                decided(OutcomeDocument {
                    word: Some(word.to_string()),
                    cycles: Some(*cycles),
                    from: Some(*from),
                    orbit: Some(periodic_orbit(&measured(found, units))),
                    ..plain
                })
            }
            Some(Outcome::RestsForever(wall)) => decided(OutcomeDocument { wall: Some(*wall), ..plain }),
            Some(Outcome::Undecided { reason, wall, time }) => {
                let document = undecided(plain, *reason, time);
                Self { document: OutcomeDocument { wall: *wall, ..document }.with_message(), reason: Some(*reason) }
            }
            None => {
                let time = last.map_or_else(|| enclosed(orbit.start().time()), |event| event.time.enclosure().clone());
                let document = undecided(plain, Reason::Budget, &(time, None));
                let message = document.interruption().expect("what is interrupted is undecided");
                Self { document: OutcomeDocument { message, ..document }, reason: Some(Reason::Budget) }
            }
        }
    }

    /// Returns the message.
    pub fn message(&self) -> &str {
        &self.document.message
    }

    /// Returns why it is undecided, if it is.
    pub fn reason(&self) -> Option<Reason> {
        self.reason
    }

    /// Returns the `outcome` of the orbit JSON.
    pub fn document(&self) -> OutcomeDocument {
        self.document.clone()
    }
}

/// Returns the number of impacts listed whose bounds reach past the time to stop at.
fn later(orbit: &Orbit, until: &Exact) -> Option<u64> {
    let latest = |impact| {
        let [_, latest] = Event::new(orbit, impact).time.decimals();
        Decimal::printed(latest).value()
    };
    let times: Vec<_> = orbit.late().iter().map(latest).collect();
    OutcomeDocument::later_than(until, &times)
}

/// Returns the start of a shadowed orbit.
fn near(shadow: &Shadowing) -> NearDocument {
    let Shadowing { time, velocity, .. } = shadow;
    NearDocument { time: bounds(time), velocity: bounds(velocity) }
}

/// Returns the distances of the true impacts from the listed ones, median and maximum, in forcing periods, in three digits rounded up.
fn epsilon(nearness: [f64; 2]) -> EpsilonDocument {
    // Bounds are rounded outward by a two-hundredth of what is between them at most.
    let [median, maximum] = nearness.map(|at_most| {
        let [_, upper] = decimal_bounds_f64(0.5 * at_most, at_most);
        Decimal::printed(upper)
    });
    EpsilonDocument { median, maximum }
}

/// Returns the outcome of an undecided orbit: no contact comes before the time; and the next contact itself, if it is proved.
fn undecided(
    plain: OutcomeDocument,
    reason: Reason,
    (from, contact): &(Enclosure, Option<Enclosure>),
) -> OutcomeDocument {
    let time = match contact {
        Some(contact) => bounds(contact).each_ref().map(|bound| Some(bound.clone())),
        None => [Some(bounds(from)[0].clone()), None],
    };
    let time = Between::computed(time);
    OutcomeDocument { reason: Some(reason), time: Some(time), ..plain }
}

/// Bits that show the time of a start.
const START_BITS: u32 = 160;

fn enclosed(x: &Exact) -> Enclosure {
    x.enclose(START_BITS)
}
