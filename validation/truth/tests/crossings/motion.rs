//! An orbit JSON, judged by the true motion of each member of its data.

use impact_pair::exact::Exact;
use impact_pair_truth::{Contact, Next, Shaken, State, Wall, float};
use rug::Float;
use serde_json::Value;
use std::cmp::Ordering;

use super::members::{Bounds, Member, decimal, named, value};

/// The reason why a comparison ends: a claim is wrong, or the truth does not decide.
#[derive(Clone, Debug)]
pub enum Halt {
    Wrong(String),
    Open(&'static str),
}

pub type Compared<T> = Result<T, Halt>;

pub fn wrong<T>(words: String) -> Compared<T> {
    Err(Halt::Wrong(words))
}

/// Bounces of a chatter that are followed, and touches, rests and releases from one contact to the next.
const BOUNCES: usize = 1_000;
const MAX_EVENTS_BETWEEN: u32 = 6;
/// A bounce slower than `2^-this` of the box's speed ends a chatter that a rest is claimed of.
const CHATTER_END_BITS: u32 = 90;

/// The true motion, as far as it was followed.
pub struct Motion<'a> {
    shaken: &'a Shaken,
    state: State,
    /// Touches since the last contact.
    touches: u32,
}

impl<'a> Motion<'a> {
    /// The motion from a state on.
    pub fn new(shaken: &'a Shaken, state: State) -> Self {
        Self { shaken, state, touches: 0 }
    }

    /// The next event; where the simulator leaves it open the comparison ends.
    fn next(&self) -> Compared<Next> {
        match self.shaken.next(&self.state) {
            Next::Open => Err(Halt::Open("the flight is too long for the truth")),
            Next::Touch(..) if self.touches >= MAX_EVENTS_BETWEEN => Err(Halt::Open("it touches again and again")),
            next => Ok(next),
        }
    }

    fn rebound(&mut self, contact: &Contact) {
        (self.state, self.touches) = (State::after(self.shaken, contact), 0);
    }

    /// Goes on beyond a touch.
    fn pass(&mut self, clear: Float) {
        self.state.clear = clear;
        self.touches += 1;
    }

    /// Whether the last bounce is so slow that the rest has come; without a loss of speed there is no rest.
    fn has_ended(&self) -> bool {
        if self.shaken.restitution == 1 {
            return false;
        }
        let speed = self.shaken.tones.iter().fold(float(0), |sum, tone| sum + float(&tone.amplitude * &tone.frequency));
        float(self.state.velocity_after.abs_ref()) < (speed >> CHATTER_END_BITS)
    }

    /// The next contact, through touches, rests and releases; the start of each later flight is noted.
    pub fn contact(&mut self, releases: &mut Vec<(Wall, Float)>) -> Compared<Option<Contact>> {
        for _ in 0..MAX_EVENTS_BETWEEN {
            let slow = self.state.on.filter(|_| self.has_ended() && !self.state.velocity_after.is_zero());
            let next = match (slow, self.next()?) {
                // The end of a chatter: what is left of it takes no time.
                (Some(wall), Next::Contact(contact)) if contact.wall == wall => {
                    self.state.velocity_after = float(0);
                    self.next()?
                }
                (_, next) => next,
            };
            match next {
                Next::Contact(contact) => {
                    self.rebound(&contact);
                    return Ok(Some(contact));
                }
                Next::Touch(_, _, clear) => self.pass(clear),
                Next::Rests => {
                    let wall = self.state.on.expect("a rest is on a wall");
                    let Some(time) = self.shaken.release(wall, &self.state.time) else { return Ok(None) };
                    releases.push((wall, time.clone()));
                    self.state = State::on_wall(self.shaken, wall, time, float(0));
                }
                Next::Never => return Ok(None),
                Next::Open => return Err(Halt::Open("the flight is too long for the truth")),
            }
        }
        Err(Halt::Open("the truth takes too many steps"))
    }

    fn impact(&mut self, wall: Wall, time: &Bounds, velocity: &Bounds, what: &str) -> Compared<()> {
        match self.next()? {
            Next::Contact(contact) => {
                if contact.wall != wall || !time.holds(&contact.time) {
                    return wrong(format!("{what}, but the truth is {}", shown(&contact)));
                }
                if !velocity.holds(&contact.velocity_before) {
                    return wrong(format!("{what}: velocity {:.50}", contact.velocity_before));
                }
                self.rebound(&contact);
                Ok(())
            }
            // Both continuations agree: only what comes after it counts. The touch may be the impact itself, too slow for these bits.
            Next::Touch(at, on, clear) if time.place(&at).is_le() => {
                self.pass(clear);
                let may_be_it = on == wall && time.holds(&at);
                let later = self.impact(wall, time, velocity, what);
                if may_be_it { later.map_err(|_| Halt::Open("an impact or a touch")) } else { later }
            }
            other => wrong(format!("{what}, but the truth is {}", described(&other))),
        }
    }

    /// A graze that is an impact is passed; before it there is none.
    fn graze(&mut self, wall: Wall, time: &Bounds, what: &str) -> Compared<()> {
        match self.next()? {
            Next::Contact(contact) => match time.place(&contact.time) {
                Ordering::Less => wrong(format!("{what}, but before it comes {}", shown(&contact))),
                Ordering::Equal if contact.wall == wall => {
                    self.rebound(&contact);
                    Ok(())
                }
                _ => Ok(()),
            },
            Next::Touch(at, on, clear) if on == wall && time.holds(&at) => {
                self.pass(clear);
                Ok(())
            }
            Next::Touch(at, _, clear) if time.place(&at).is_lt() => {
                self.pass(clear);
                self.graze(wall, time, what)
            }
            _ => Ok(()),
        }
    }

    fn rest(&mut self, wall: Wall, time: &Bounds, is_end: bool, what: &str) -> Compared<()> {
        if self.state.on != Some(wall) {
            return wrong(format!("{what}, but the ball was not there"));
        }
        if is_end && self.state.velocity_after.is_zero() {
            return wrong(format!("{what}, but no impact comes before it"));
        }
        for _ in 0..BOUNCES {
            match self.next()? {
                Next::Rests if time.holds(&self.state.time) => return Ok(()),
                Next::Contact(contact) if is_end && contact.wall == wall && !time.place(&contact.time).is_gt() => {
                    let before = self.state.time.clone();
                    self.rebound(&contact);
                    if self.has_ended() {
                        // The rest of the chatter takes less than the time from one bounce to the next but for a few bits.
                        let left = float(&self.state.time - &before) << 20;
                        let late = float(&self.state.time + &left);
                        self.state.velocity_after = float(0);
                        let is_there = !time.place(&late).is_lt();
                        return if is_there { Ok(()) } else { wrong(format!("{what}, but the end is earlier")) };
                    }
                }
                // A bounce so slow that the truth does not tell it from a touch.
                Next::Touch(at, on, _) if is_end && on == wall && time.holds(&at) && self.has_ended() => {
                    self.state.velocity_after = float(0);
                    return Ok(());
                }
                other => return wrong(format!("{what}, but the truth is {}", described(&other))),
            }
        }
        Err(Halt::Open("the chatter is too long for the truth"))
    }

    fn release(&mut self, wall: Wall, time: &Bounds, what: &str) -> Compared<()> {
        // The rest may have begun anywhere in its bounds: the contact force ends once in so short a time.
        let Some(at) = self.shaken.release(wall, &self.state.time) else {
            return Err(Halt::Open("the truth finds no release"));
        };
        if self.state.on != Some(wall) || !time.holds(&at) {
            return wrong(format!("{what}, but the truth is {at:.50}"));
        }
        self.state = State::on_wall(self.shaken, wall, at, float(0));
        Ok(())
    }

    /// One event of the document.
    pub fn follow(&mut self, event: &Value) -> Compared<()> {
        let what = format!("{} {} on {} in {}", event["event"], event["index"], event["wall"], event["time"]);
        let (Some(wall), Some(time)) = (named(&event["wall"]), Bounds::read(&event["time"])) else {
            return wrong(format!("{what}: no bounds"));
        };
        match event["event"].as_str() {
            Some("impact") => {
                let Some(velocity) = Bounds::read(&event["velocity"]) else {
                    return wrong(format!("{what}: no velocity"));
                };
                self.impact(wall, &time, &velocity, &what)
            }
            Some("graze") => self.graze(wall, &time, &what),
            Some("rest") => self.rest(wall, &time, event["skipped"] == "infinite", &what),
            Some("release") => self.release(wall, &time, &what),
            _ => wrong(format!("{what}: no event")),
        }
    }

    /// Checks that no contact comes before a time, in bounds or at once.
    fn is_clear(&mut self, until: &Float, what: &str) -> Compared<()> {
        match self.next()? {
            Next::Contact(contact) if contact.time < *until => {
                wrong(format!("{what}, but the truth is {}", shown(&contact)))
            }
            Next::Touch(at, _, clear) if at < *until => {
                self.pass(clear);
                self.is_clear(until, what)
            }
            _ => Ok(()),
        }
    }

    /// Compares the outcome with the motion after the last event.
    pub fn ended(&mut self, outcome: &Value, member: &Member) -> Compared<()> {
        let what = format!("{} after the last event", outcome["kind"]);
        match outcome["kind"].as_str().unwrap_or_default() {
            "time-reached" => {
                let until = Exact::parse(outcome["until"].as_str().unwrap_or("none")).map(|until| value(&until));
                let Ok(until) = until else { return wrong("no time is told".into()) };
                self.is_clear(&until, &format!("{what} up to {}", outcome["until"]))
            }
            "undecided" => {
                let Some(from) = decimal(&outcome["time"][0]) else { return wrong("no time is told".into()) };
                self.is_clear(&from, &format!("{what}, not before {}", outcome["time"][0]))?;
                // A second bound is that of a proved contact.
                let Some(to) = decimal(&outcome["time"][1]) else { return Ok(()) };
                match self.next()? {
                    Next::Contact(contact) if contact.time <= to => Ok(()),
                    other => {
                        wrong(format!("{what}, up to {}, but the truth is {}", outcome["time"][1], described(&other)))
                    }
                }
            }
            "never-impacts" => match self.next()? {
                Next::Touch(_, _, clear) => {
                    self.pass(clear);
                    self.ended(outcome, member)
                }
                Next::Never => Ok(()),
                other => wrong(format!("{what}, but the truth is {}", described(&other))),
            },
            "rests-forever" => match self.next()? {
                Next::Rests if self.shaken.tones.is_empty() => Ok(()),
                other => wrong(format!("{what}, but the truth is {}", described(&other))),
            },
            "periodic" => self.repeats(outcome, member),
            "attracted" => self.converges(outcome, member),
            _ => Ok(()),
        }
    }

    /// Checks that the ball leaves the same wall again after the claimed number of cycles, if it is released at all.
    fn repeats(&mut self, outcome: &Value, member: &Member) -> Compared<()> {
        let cycles = outcome["period"]["cycles"].as_u64().unwrap_or(0);
        let mut releases = Vec::new();
        for _ in 0..400 {
            if self.contact(&mut releases)?.is_none() {
                return Ok(());
            }
            let Some((wall, first)) = releases.first() else { continue };
            let ends: Vec<Float> = member.turns().iter().map(|turn| float(turn * cycles) + first).collect();
            let near = |time: &Float, end: &Float| float(float(time - end).abs()) < 1e-40f64;
            if releases.iter().any(|(on, time)| on == wall && ends.iter().any(|end| near(time, end))) {
                return Ok(());
            }
            if ends.iter().all(|end| releases.last().is_some_and(|(_, last)| last > end)) {
                return wrong(format!("{outcome}, but it is released at {releases:.20?}"));
            }
        }
        Err(Halt::Open("no release comes"))
    }

    /// Checks that it is within the bounds of the orbit after many periods, or nearer to it than at first: intervals among the data are many
    /// orbits.
    fn converges(&mut self, outcome: &Value, member: &Member) -> Compared<()> {
        let impacts = outcome["orbit"]["impacts"].as_array().map_or(&[][..], Vec::as_slice);
        let speeds: Option<Vec<_>> =
            impacts.iter().map(|impact| Some((named(&impact["wall"])?, Bounds::read(&impact["velocity"])?))).collect();
        let Some(speeds) = speeds.filter(|speeds| !speeds.is_empty()) else { return wrong("no orbit is told".into()) };
        let mut passed = Vec::new();
        for _ in 0..60 * speeds.len() {
            let Some(contact) = self.contact(&mut Vec::new())? else {
                return wrong("attracted, but no impact follows".into());
            };
            passed.push(contact);
        }
        let scale: f64 = member.tones.iter().map(|tone| float(&tone.amplitude * &tone.frequency).to_f64()).sum();
        let away = |shift: usize, from: usize| {
            let one = |i: usize| {
                let (wall, velocity) = &speeds[(i + shift) % speeds.len()];
                let (contact, middle) = (&passed[from + i], velocity.middle());
                if contact.wall != *wall {
                    f64::INFINITY
                } else if velocity.holds(&contact.velocity_before) {
                    0.0
                } else {
                    float(&contact.velocity_before - &middle).to_f64().abs() / scale
                }
            };
            (0..speeds.len()).map(one).fold(0.0, f64::max)
        };
        let last = passed.len() - speeds.len();
        let nearest = |from: usize| (0..speeds.len()).map(|shift| away(shift, from)).fold(f64::INFINITY, f64::min);
        let (first, last) = (nearest(0), nearest(last));
        if last < 1e-6 || last < first {
            return Ok(());
        }
        wrong(format!("attracted, but {first:e} away at first and {last:e} after 60 periods"))
    }
}

pub fn shown(contact: &Contact) -> String {
    format!("an impact on {:?} at {:.40} with {:.20}", contact.wall, contact.time, contact.velocity_before)
}

fn described(next: &Next) -> String {
    match next {
        Next::Contact(contact) => shown(contact),
        Next::Touch(time, wall, _) => format!("a touch of {wall:?} at {time:.40}"),
        Next::Rests => "a rest".into(),
        Next::Never => "no impact ever".into(),
        Next::Open => "open".into(),
    }
}

/// All events and the outcome, from the start of a member.
pub fn judge(document: &Value, member: &Member) -> Compared<()> {
    let mut motion = Motion::new(&member.shaken, member.start.clone());
    let events = document["events"].as_array().map_or(&[][..], Vec::as_slice);
    let impacts = events.iter().filter(|event| event["event"] == "impact").count() as u64;
    if document["outcome"]["impacts"] != impacts {
        return wrong(format!("{impacts} impacts are listed, {} told", document["outcome"]["impacts"]));
    }
    events.iter().try_for_each(|event| motion.follow(event))?;
    motion.ended(&document["outcome"], member)
}
