//! Periodic orbits: each followed by the true motion from its own state, and those of a list that says there are no others compared
//! with what motions lead to.

use impact_pair::mapping::Word;
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use impact_pair::{ImpactPair, Scene, orbit};
use impact_pair_truth::{Contact, State, Tone, Wall, float};
use rug::Float;
use rug::float::Constant;
use serde_json::Value;

use super::members::{Bounds, Member, named};
use super::motion::{Compared, Halt, Motion, wrong};

/// Error allowed in the impacts of a period, in radians and in speeds of the box: bounds of `10^-9`, and the growth over a period.
const ORBIT_TOLERANCE: f64 = 1e-3;

/// A claimed impact of an orbit.
#[derive(Clone, Debug)]
pub struct ClaimedState {
    pub wall: Wall,
    pub phase: Float,
    pub velocity: Float,
    turn: u64,
    /// Whole forcing periods since the first impact's, where the document gives them.
    cycle: Option<i64>,
}

fn claimed_state(impact: &Value) -> Option<ClaimedState> {
    Some(ClaimedState {
        wall: named(&impact["wall"])?,
        phase: Bounds::read(&impact["phase"])?.middle(),
        velocity: Bounds::read(&impact["velocity"])?.middle(),
        turn: impact["turn"].as_u64().unwrap_or(0),
        cycle: impact["cycle"].as_i64(),
    })
}

/// All impacts of an orbit.
pub fn impacts(orbit: &Value) -> Option<Vec<ClaimedState>> {
    orbit["impacts"].as_array()?.iter().map(claimed_state).collect()
}

/// The harmonic whose phase documents give: the fastest.
pub fn reference(tones: &[Tone]) -> &Tone {
    tones.iter().reduce(|a, b| if b.frequency > a.frequency { b } else { a }).expect("a harmonic")
}

/// The difference of two phases, at most half a forcing period.
pub fn apart(a: &Float, b: &Float) -> f64 {
    let turn = float(Constant::Pi) * 2;
    let difference = float(a - b);
    let turns = float(&difference / &turn).round();
    float(difference - turns * turn).to_f64().abs()
}

/// The speed of the box.
pub fn speed(tones: &[Tone]) -> f64 {
    tones.iter().map(|tone| float(&tone.amplitude * &tone.frequency).to_f64()).sum::<f64>().max(1e-300)
}

/// The state just after an impact, its velocity before it varied, and its phase.
fn after(member: &Member, impact: &ClaimedState, varied: [f64; 2]) -> State {
    let tone = reference(&member.tones);
    let turns = float(Constant::Pi) * 2 * impact.turn;
    let time = float(&impact.phase + &turns) + float(varied[0]) - &tone.phase;
    let contact = Contact {
        time: time / &tone.frequency,
        wall: impact.wall,
        velocity_before: float(&impact.velocity + float(varied[1])),
    };
    State::after(&member.shaken, &contact)
}

/// The impacts of a period that come after the first one, and the first one again.
fn period(member: &Member, claimed_state: &[ClaimedState], varied: [f64; 2]) -> Compared<Vec<Contact>> {
    let mut motion = Motion::new(&member.shaken, after(member, &claimed_state[0], varied));
    let mut found = Vec::new();
    while found.len() < claimed_state.len() {
        let Some(contact) = motion.contact(&mut Vec::new())? else { break };
        found.push(contact);
    }
    Ok(found)
}

/// Distance of the true impacts from the claimed ones, in radians and in speeds of the box; infinite on other walls.
fn away(member: &Member, claimed_state: &[ClaimedState], found: &[Contact]) -> f64 {
    let tone = reference(&member.tones);
    let one = |(contact, claimed_state): (&Contact, &ClaimedState)| {
        let phase = float(&contact.time * &tone.frequency) + &tone.phase;
        let off = float(&contact.velocity_before - &claimed_state.velocity).to_f64().abs() / speed(&member.tones);
        if contact.wall == claimed_state.wall { apart(&phase, &claimed_state.phase).max(off) } else { f64::INFINITY }
    };
    if found.len() < claimed_state.len() {
        return f64::INFINITY;
    }
    found.iter().zip(claimed_state.iter().cycle().skip(1)).map(one).fold(0.0, f64::max)
}

/// Whether the true impacts come in other forcing periods than claimed: then the claimed orbit passes over contacts at its own
/// phases. `None` where the forcing period of no later impact is given.
fn is_in_other_turns(member: &Member, claimed_state: &[ClaimedState], found: &[Contact]) -> Option<bool> {
    let (tone, turn) = (reference(&member.tones), float(Constant::Pi) * 2);
    let later: Vec<_> = claimed_state
        .iter()
        .skip(1)
        .zip(found)
        .map(|(claimed_state, contact)| Some((claimed_state, contact, claimed_state.cycle?)))
        .collect::<Option<_>>()?;
    let is_other = |(claimed_state, contact, cycle): &(&ClaimedState, &Contact, i64)| {
        let phase = float(&contact.time * &tone.frequency) + &tone.phase;
        float(phase - &claimed_state.phase - float(&turn * *cycle)).to_f64().abs() > 1.0
    };
    (!later.is_empty()).then(|| later.iter().any(is_other))
}

/// Checks one orbit of a list: the true motion is the claimed one if it is admissible, and another if it is virtual.
pub fn judge(orbit: &Value, member: &Member) -> Compared<()> {
    let Some(claimed_state) = impacts(orbit).filter(|claimed_state| !claimed_state.is_empty()) else {
        return wrong("an orbit without impacts".into());
    };
    let Some(is_physical) = orbit["physical"].as_bool() else { return Err(Halt::Open("undecided whether physical")) };
    let found = period(member, &claimed_state, [0.0; 2])?;
    let off = away(member, &claimed_state, &found);
    if is_physical && off > ORBIT_TOLERANCE {
        return wrong(format!("a physical orbit, but the true impacts are {off:e} away: {}", orbit["impacts"]));
    }
    if !is_physical && off < ORBIT_TOLERANCE * ORBIT_TOLERANCE {
        match is_in_other_turns(member, &claimed_state, &found) {
            Some(true) => return Ok(()),
            None if claimed_state[0].cycle.is_some() => return Err(Halt::Open("one impact in some cycles")),
            _ => {}
        }
        return wrong(format!("an orbit that is not physical, but it is one: {}", orbit["impacts"]));
    }
    Ok(())
}

/// Trace and determinant of the period, by differences of true motions.
pub fn trace_and_determinant(orbit: &Value, member: &Member) -> Compared<[f64; 2]> {
    let Some(claimed_state) = impacts(orbit).filter(|claimed_state| !claimed_state.is_empty()) else {
        return wrong("an orbit without impacts".into());
    };
    let (_, [[a, b], [c, d]]) = derivative(member, &claimed_state)?;
    Ok([a + d, a * d - b * c])
}

/// The state after a period, phase and velocity before its impact, and its derivatives by either, by differences of true motions: by rows.
fn derivative(member: &Member, claimed_state: &[ClaimedState]) -> Compared<([Float; 2], [[f64; 2]; 2])> {
    let step = 2f64.powi(-120);
    let tone = reference(&member.tones);
    let mut columns = Vec::new();
    let end = |varied: [f64; 2]| -> Compared<[Float; 2]> {
        let found = period(member, claimed_state, varied)?;
        let Some(last) = found.get(claimed_state.len() - 1) else {
            return Err(Halt::Open("the period does not close"));
        };
        Ok([float(&last.time * &tone.frequency), last.velocity_before.clone()])
    };
    let here = end([0.0; 2])?;
    for varied in [[step, 0.0], [0.0, step]] {
        let there = end(varied)?;
        let slope = |i: usize| (float(&there[i] - &here[i]) / float(step)).to_f64();
        columns.push([slope(0), slope(1)]);
    }
    let [phase, velocity] = here;
    Ok(([phase + &tone.phase, velocity], [0, 1].map(|i| [columns[0][i], columns[1][i]])))
}

/// Steps of Newton's iteration for an orbit of another member, and the size of the last one.
const STEPS: u32 = 12;
const LAST_STEP_SIZE: f64 = 1e-14;

/// The same orbit of members one after another, each near the one before: whether all of them are stable, on the same walls. Lost ones are left open.
pub fn stay_stable(orbit: &Value, members: &[Member]) -> Compared<()> {
    let Some(mut claimed_state) = impacts(orbit).filter(|claimed_state| !claimed_state.is_empty()) else {
        return wrong("an orbit without impacts".into());
    };
    for member in members {
        let mut is_closed = false;
        for _ in 0..STEPS {
            let ([phase, velocity], [[a, b], [c, d]]) = derivative(member, &claimed_state)?;
            let turn = float(Constant::Pi) * 2;
            let off = float(phase - &claimed_state[0].phase);
            let turns = float(&off / &turn).round();
            let off = [float(off - turns * turn).to_f64(), float(velocity - &claimed_state[0].velocity).to_f64()];
            let determinant = (1.0 - a) * (1.0 - d) - b * c;
            let step =
                [(off[0] * (1.0 - d) + b * off[1]) / determinant, (off[1] * (1.0 - a) + c * off[0]) / determinant];
            claimed_state[0].phase += step[0];
            claimed_state[0].velocity += step[1];
            if step[0].abs() + step[1].abs() / speed(&member.tones) < LAST_STEP_SIZE {
                is_closed = true;
                break;
            }
        }
        let walls = period(member, &claimed_state, [0.0; 2])?;
        let are_same = walls
            .iter()
            .zip(claimed_state.iter().cycle().skip(1))
            .all(|(contact, claimed_state)| contact.wall == claimed_state.wall);
        if !(is_closed && are_same) {
            return Err(Halt::Open("the orbit of a window is lost at another value"));
        }
        let (_, [[a, b], [c, d]]) = derivative(member, &claimed_state)?;
        let (trace, determinant) = (a + d, a * d - b * c);
        if trace.abs() > (1.0 + determinant) * (1.0 + ORBIT_TOLERANCE) {
            return wrong(format!("the orbit of a window is unstable between its ends: trace {trace}"));
        }
    }
    Ok(())
}

/// The walls from which a word starts, in order of time.
fn walls(word: &Word) -> Vec<bool> {
    let is_left = |mapping: &str| matches!(mapping, "P2" | "P4");
    let names: Vec<String> = word.mappings().iter().map(|mapping| format!("{mapping:?}")).collect();
    names.iter().map(|name| is_left(name)).collect()
}

fn is_rotated(a: &[bool], b: &[bool]) -> bool {
    a.len() == b.len() && (0..a.len()).any(|shift| a.iter().cycle().skip(shift).zip(b).all(|(a, b)| a == b))
}

/// A list that claims completeness: every periodic motion of the word and its cycles that a run proves must be listed,
/// including motions with rests, unless the document states that it leaves them out.
pub fn judge_all(document: &Value, scene: &Scene, starts: &[orbit::Start]) -> Compared<()> {
    let Ok(word) = document["word"].as_str().unwrap_or_default().parse::<Word>() else {
        return wrong("no word".into());
    };
    let listed = document["orbits"].as_array().map_or(&[][..], Vec::as_slice);
    let own = walls(&word);
    for start in starts {
        let Some(found) = run(scene.pair(), start) else { continue };
        let outcome = &found["outcome"];
        let events = found["events"].as_array().map_or(&[][..], Vec::as_slice);
        match outcome["kind"].as_str() {
            Some("attracted") if outcome["cycles"] == document["cycles"] => {
                let Some(orbit) = impacts(&outcome["orbit"]) else { continue };
                let sides: Vec<bool> = orbit.iter().map(|impact| impact.wall == Wall::Left).collect();
                let is_there = |claimed_state: &Vec<ClaimedState>| {
                    let near =
                        |a: &ClaimedState, b: &ClaimedState| a.wall == b.wall && apart(&a.phase, &b.phase) < 1e-4;
                    (0..claimed_state.len())
                        .any(|shift| claimed_state.iter().cycle().skip(shift).zip(&orbit).all(|(a, b)| near(a, b)))
                };
                if is_rotated(&sides, &own)
                    && !listed.iter().filter_map(impacts).any(|claimed_state| is_there(&claimed_state))
                {
                    return wrong(format!("there is another: {}", outcome["orbit"]["impacts"]));
                }
            }
            Some("periodic") if outcome["period"]["cycles"] == document["cycles"] => {
                let count = outcome["period"]["impacts"].as_u64().unwrap_or(0) as usize;
                let hits = events.iter().filter(|event| event["event"] == "impact");
                let sides: Vec<bool> = hits.map(|event| event["wall"] == "left").collect();
                let is_skipped = events.iter().any(|event| event["skipped"] == "infinite");
                let last = &sides[sides.len().saturating_sub(count)..];
                let excludes_rests = document["excludes"].as_str().is_some_and(|words| words.contains("rest"));
                if count > 0 && !is_skipped && !excludes_rests && is_rotated(last, &own) {
                    return wrong(format!("there is another, with rests, from {:?}", start));
                }
            }
            _ => {}
        }
    }
    Ok(())
}

/// The orbit JSON of a motion, with the attractor that it converges to.
fn run(pair: &ImpactPair, start: &orbit::Start) -> Option<Value> {
    let settings =
        Settings { arithmetic: Arithmetic::Interval, impacts: Some(40), attractor: true, ..Settings::default() };
    serde_json::to_value(Orbit::new(pair, start, settings).ok()?.document()).ok()
}
