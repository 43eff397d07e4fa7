//! Verdicts over a parameter: what becomes of the scene's own motion for each value of an interval, against the true motion at one.

use impact_pair::Error;
use impact_pair::chaos::{Cells, RangeSettings};
use impact_pair::watch::Stage;
use impact_pair_truth::{Contact, Wall};
use serde_json::{Value, json};

use super::judge::at;
use super::members::Member;
use super::motion::{Compared, Halt, Motion, wrong};
use super::orbits::apart;
use super::questions::{Answer, CallLimit};
use super::scenes::Case;
use super::traits::Restitution;

/// Number of calls of the watch after which a search is stopped: enough for sets over some impacts, not for horseshoes, which take seconds.
const MAX_WATCH_CALLS: usize = 400;
/// Impacts of the true motion, and of the longest word that these decide.
const IMPACTS: usize = 160;
const LONGEST: usize = 12;
/// Two rounds are one orbit when they are so near, in radians.
const SAME_ORBIT_DISTANCE: f64 = 1e-9;

impl Case {
    /// One cell beside the scene's own amplitude or gap, as narrow as one that is halved a few times.
    pub fn cells(&mut self) -> Result<Answer, Error> {
        // Nothing attracts, and flights are long.
        if self.crossing.restitution == Restitution::One {
            return Ok(Answer::Nothing("no loss of speed"));
        }
        let key = self.random.pick(&["amplitude", "gap"]);
        let (name, own) = self.key(key);
        let wide = self.random.pick(&[1e-2, 1e-4, 1e-6]);
        let over = format!("{name}={own}..{own}+{wide}").parse()?;
        let limit = CallLimit::new();
        let requested = RangeSettings { over, cells: 1, halvings: 0, depth: 2 };
        let found = Cells::of(self.scene.pair(), self.scene.start(), &requested, &|_: Stage<'_>| {
            limit.goes_on(MAX_WATCH_CALLS)
        })?;
        Ok(Answer::Cells(json!(found.document(&self.scene, &requested))))
    }
}

/// The walls of a word in time order, the first one mapping's start.
fn walls(word: &str) -> Vec<Wall> {
    let from = |mapping: &str| if matches!(mapping, "P1" | "P3") { Wall::Right } else { Wall::Left };
    word.split_whitespace().rev().map(from).collect()
}

/// Checks that the true motion at the lower end of each interval claimed to be attracted makes the claimed word in the end.
pub fn judge(document: &Value, case: &Case) -> Compared<()> {
    let stretches = document["stretches"].as_array().map_or(&[][..], Vec::as_slice);
    let attracted: Vec<&Value> = stretches.iter().filter(|own| own["verdict"] == "attracted").collect();
    if attracted.is_empty() {
        return Err(Halt::Open("no value whose motion is attracted"));
    }
    attracted.into_iter().try_for_each(|own| {
        let low = Value::Array(vec![own["low"].clone(); 2]);
        let key = document["over"]["key"].as_str().unwrap_or_default();
        let Some(scene) = at(&case.scene, key, &low) else { return Err(Halt::Open("no scene at the value")) };
        let word = walls(own["period"]["word"].as_str().unwrap_or_default());
        if word.len() > LONGEST {
            return Err(Halt::Open("a long word"));
        }
        ends_in(&Member::new(&scene, || 0.0), &word)
    })
}

/// The true motion comes to be periodic, and its impacts are on the walls of the word.
fn ends_in(member: &Member, word: &[Wall]) -> Compared<()> {
    let mut motion = Motion::new(&member.shaken, member.start.clone());
    let mut contacts: Vec<Contact> = Vec::new();
    for _ in 0..IMPACTS {
        match motion.contact(&mut Vec::new())? {
            Some(contact) => contacts.push(contact),
            None => return wrong(format!("attracted to {word:?}, but the motion ends after {}", contacts.len())),
        }
    }
    let frequency = &member.tones[0].frequency;
    let last = &contacts[IMPACTS - 1];
    let is_again = |impacts: &usize| {
        let before = &contacts[IMPACTS - 1 - impacts];
        let phase = |contact: &Contact| impact_pair_truth::float(&contact.time * frequency);
        before.wall == last.wall && apart(&phase(before), &phase(last)) < SAME_ORBIT_DISTANCE
    };
    let Some(period) = (1..=IMPACTS / 2).find(is_again) else { return Err(Halt::Open("not yet periodic")) };
    let own: Vec<Wall> = contacts[IMPACTS - period..].iter().map(|contact| contact.wall).collect();
    let is_word = |shift: usize| (0..own.len() * word.len()).all(|i| own[i % period] == word[(i + shift) % word.len()]);
    if (0..word.len()).any(is_word) {
        Ok(())
    } else {
        wrong(format!("attracted to {word:?}, but the truth is {own:?}"))
    }
}

/// The proved verdict in a few words.
pub fn outcome(document: &Value) -> String {
    let is = |verdict: &str| {
        let mut stretches = document["stretches"].as_array().into_iter().flatten();
        stretches.any(|own| own["verdict"] == verdict)
    };
    let found = ["attracted", "stable", "horseshoe"].into_iter().find(|verdict| is(verdict));
    format!("cells: {}", found.unwrap_or("undecided"))
}
