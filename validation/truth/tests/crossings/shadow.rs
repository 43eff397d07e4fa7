//! Check of a shadowed orbit: a start within the claimed bounds, its time or its velocity that of the scene, has the impacts listed.
//!
//! It is sought impact by impact: Newton's steps lead the time of each impact to the middle of its bounds, and where all impacts are
//! within theirs the start must be within its own.

use impact_pair_truth::{Contact, State, float};
use rug::Float;
use serde_json::Value;

use super::members::{Bounds, Member, named};
use super::motion::{Compared, Halt, Motion, shown, wrong};

/// Newton's steps for an impact.
const STEPS: u32 = 12;
/// Parts of its bounds at which the last impact is sought.
const LAST_IMPACT_PLACES: [f64; 5] = [0.5, 0.25, 0.75, 0.1, 0.9];

/// The datum of the start that is varied.
#[derive(Clone, Copy, PartialEq)]
enum Varied {
    Time,
    Velocity,
}

struct Claim<'a> {
    member: &'a Member,
    varied: Varied,
    start: Bounds,
    /// Walls, times and velocities.
    impacts: Vec<(impact_pair_truth::Wall, Bounds, Bounds)>,
}

impl Claim<'_> {
    fn state(&self, start: &Float) -> State {
        let (shaken, given) = (&self.member.shaken, self.member.start.clone());
        match (self.varied, given.on) {
            (Varied::Time, _) => State { time: start.clone(), ..given },
            (Varied::Velocity, None) => State { velocity_after: start.clone(), ..given },
            (Varied::Velocity, Some(_)) => State { velocity_after: -float(&shaken.restitution * start), ..given },
        }
    }

    /// The first impacts from a start, through rests.
    fn impacts(&self, start: &Float, count: usize) -> Compared<Vec<Contact>> {
        let mut motion = Motion::new(&self.member.shaken, self.state(start));
        let mut found = Vec::new();
        while found.len() < count {
            let Some(contact) = motion.contact(&mut Vec::new())? else { break };
            found.push(contact);
        }
        Ok(found)
    }

    fn has_impacts(&self, found: &[Contact]) -> bool {
        let is_one = |((wall, time, velocity), contact): (&(_, Bounds, Bounds), &Contact)| {
            *wall == contact.wall && time.holds(&contact.time) && velocity.holds(&contact.velocity_before)
        };
        found.len() == self.impacts.len() && self.impacts.iter().zip(found).all(is_one)
    }

    /// A start from which impact `index`, from 0, comes at a time; from a start whose impacts before are about right.
    fn aimed(&self, from: &Float, index: usize, sought: &Float) -> Compared<Option<Float>> {
        let mut start = from.clone();
        for _ in 0..STEPS {
            let little = float((float(start.abs_ref()) + 1u32) >> 300u32);
            let [here, beside] = [start.clone(), float(&start + &little)].map(|start| self.impacts(&start, index + 1));
            let (here, beside) = (here?, beside?);
            let (Some(here), Some(beside)) = (here.get(index), beside.get(index)) else { return Ok(None) };
            if here.wall != self.impacts[index].0 {
                return Ok(None);
            }
            let slope = float(&beside.time - &here.time) / little;
            if slope.is_zero() {
                return Ok(None);
            }
            let step = float(&here.time - sought) / slope;
            start -= &step;
            if step.is_zero() || float(step.abs_ref()) < (float(start.abs_ref()) + 1u32) >> 280u32 {
                return Ok(Some(start));
            }
        }
        Ok(None)
    }

    /// The start that has all these impacts.
    fn found(&self) -> Compared<Option<Float>> {
        let mut start = self.start.middle();
        for (index, (_, time, _)) in self.impacts.iter().enumerate() {
            let Some(next) = self.aimed(&start, index, &time.middle())? else { return Ok(None) };
            start = next;
        }
        let last = self.impacts.len() - 1;
        let Bounds(low, high) = &self.impacts[last].1;
        for place in LAST_IMPACT_PLACES {
            let sought = float(float(high - low) * place) + low;
            let Some(aimed) = self.aimed(&start, last, &sought)? else { continue };
            if self.has_impacts(&self.impacts(&aimed, last + 1)?) {
                return Ok(Some(aimed));
            }
        }
        Ok(None)
    }

    /// Both ends of the bounds of the start and its middle have the first impact on the same side of its bounds.
    fn is_beside(&self) -> Compared<Option<String>> {
        let (wall, time, _) = &self.impacts[0];
        let Bounds(low, high) = &self.start;
        let mut places = Vec::new();
        for start in [low.clone(), self.start.middle(), high.clone()] {
            let found = self.impacts(&float(start), 1)?;
            let Some(contact) = found.first().filter(|contact| contact.wall == *wall) else { return Ok(None) };
            places.push((time.place(&contact.time), shown(contact)));
        }
        let is_beside = places[0].0.is_ne() && places.iter().all(|place| place.0 == places[0].0);
        Ok(is_beside.then(|| places[0].1.clone()))
    }
}

/// The claims of a shadowed orbit for a member of the data.
pub fn judge(document: &Value, member: &Member) -> Compared<()> {
    let (near, events) = (&document["outcome"]["start"], document["events"].as_array().map_or(&[][..], Vec::as_slice));
    let (Some(time), Some(velocity)) = (Bounds::read(&near["time"]), Bounds::read(&near["velocity"])) else {
        return wrong("shadowed, but no start is told".into());
    };
    let (has_time, has_velocity) = (time.holds(&member.start.time), velocity.holds(&member.velocity));
    let is_wide = |bounds: &Bounds| float(&bounds.1 - &bounds.0) > 1e-200f64;
    let (varied, start) = match (has_time, has_velocity) {
        (false, false) => return wrong(format!("neither the time nor the velocity of {near} is the scene's")),
        (true, _) if is_wide(&velocity) && member.velocity.is_zero() && member.start.on.is_some() => {
            (Varied::Time, time)
        }
        (true, false) => (Varied::Velocity, velocity),
        (false, true) => (Varied::Time, time),
        (true, true) if float(&time.1 - &time.0) > float(&velocity.1 - &velocity.0) => (Varied::Time, time),
        (true, true) => (Varied::Velocity, velocity),
    };
    let impact = |event: &Value| {
        Some((named(&event["wall"])?, Bounds::read(&event["time"])?, Bounds::read(&event["velocity"])?))
    };
    let impacts: Option<Vec<_>> = events.iter().filter(|event| event["event"] == "impact").map(impact).collect();
    let Some(impacts) = impacts else { return wrong("an impact without bounds".into()) };
    // The motion after an impact that is no node is that of all starts in its bounds.
    let nodes = events.iter().take_while(|event| event["event"] == "impact").count();
    let claim = Claim { member, varied, start, impacts: impacts.into_iter().take(nodes).collect() };
    if claim.impacts.is_empty() {
        return Err(Halt::Open("no impact before the first other event"));
    }
    if let Some(beside) = claim.is_beside()? {
        return wrong(format!("impact 1 is not that of any start in {near}: {beside}"));
    }
    // Few impacts in wide bounds have many starts: the claimed ones may be as good as the one that is sought.
    for start in [claim.start.middle(), claim.start.0.clone(), claim.start.1.clone()] {
        if claim.has_impacts(&claim.impacts(&start, claim.impacts.len())?) {
            return Ok(());
        }
    }
    match claim.found()? {
        Some(start) if claim.start.holds(&start) => Ok(()),
        Some(start) => {
            let [low, high] = [&claim.start.0, &claim.start.1].map(|end| format!("{end:.25e}"));
            // Another start may have them as well.
            let width = float(&claim.start.1 - &claim.start.0);
            let off = float(&start - &claim.start.middle()).to_f64().abs() / width.to_f64();
            if off < 2.0 {
                return Err(Halt::Open("a start at the edge of its bounds"));
            }
            wrong(format!("the start with these impacts is {start:.25e}, {off:.1} widths from [{low}, {high}]"))
        }
        None => Err(Halt::Open("no start is found")),
    }
}
