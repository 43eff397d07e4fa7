//! One answer, by `check` and by the truth.

use std::collections::BTreeSet;

use impact_pair::exact::Exact;
use impact_pair::orbit::{Orbit, Settings, Start};
use impact_pair::watch::Unwatched;
use impact_pair::{Scene, scene};
use impact_pair_certificate::{Claims, Limits, Verdict};
use impact_pair_truth::{Wall, float};
use rug::Float;
use serde_json::Value;

use super::members::{Bounds, Member};
use super::motion::{self, Compared, Halt, Motion, wrong};
use super::questions::Answer;
use super::scenes::Case;
use super::traits::Question;
use super::{attractors, boxes, cells, orbits, shadow, sweeps};
use crate::random::Random;

/// The verdict of one judge on an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Finding {
    /// Right, by this judge.
    Right,
    /// This judge does not decide.
    Open,
    /// Nothing is claimed, or nothing that this judge knows.
    Nothing,
    /// A claim is false.
    Wrong,
}

/// The verdicts of both judges on an answer.
pub struct AnswerVerdict {
    /// The verdicts of `check`, and of the truth.
    pub findings: [Finding; 2],
    /// The answer in a word: an outcome, orbits, a refusal.
    pub outcome: String,
    /// The error found, or the reason why it is undecided, by each judge.
    pub words: [String; 2],
}

/// The limits that a crossing needs; long flights and wide data are for other tests.
const LIMITS: Limits = Limits { bits: 384, parts: 1 << 6, pieces: 2, work: 1 << 9 };

fn check(document: &str) -> (Finding, String) {
    let Ok(claims) = Claims::parse(document) else { return (Finding::Nothing, "not read".into()) };
    if ["chaos/1", "trap/1"].iter().any(|own| document.contains(&format!("\"impact-pair/{own}\"")))
        && document.len() > 200_000
    {
        return (Finding::Open, "too large".into());
    }
    match claims.check_within(&LIMITS, &Unwatched) {
        Ok(Verdict::Confirmed { .. }) => (Finding::Right, String::new()),
        Ok(Verdict::Refuted(finding)) => (Finding::Wrong, claims.described(&finding)),
        Ok(Verdict::Undecided(finding)) if finding.message.starts_with("it claims nothing") => {
            (Finding::Nothing, claims.described(&finding))
        }
        Ok(Verdict::Undecided(finding)) => (Finding::Open, claims.described(&finding)),
        Ok(Verdict::Interrupted { .. }) => unreachable!("nobody stops it"),
        Err(error) => (Finding::Open, error.to_string()),
    }
}

/// The judge's word on all members, or orbits; a wrong one ends it, an open one is remembered.
fn all<T>(items: impl IntoIterator<Item = T>, mut one: impl FnMut(T) -> Compared<()>) -> Compared<()> {
    let mut open = None;
    for item in items {
        match one(item) {
            Err(Halt::Open(why)) => open = Some(why),
            other => other?,
        }
    }
    open.map_or(Ok(()), |why| Err(Halt::Open(why)))
}

/// Starts whose motions may lead to an orbit of the word.
fn starts(scene: &Scene, random: &mut Random) -> Vec<Start> {
    let member = Member::new(scene, || 0.0);
    let speed = orbits::speed(&member.tones);
    let mut all = vec![scene.start().clone()];
    for _ in 0..2 {
        let [time, velocity] = [random.uniform(0.0, 1.0), -speed * random.uniform(0.0, 3.0)]
            .map(|x| Exact::from_f64(x).expect("a number"));
        all.extend(Start::on_wall(time, impact_pair::pair::Wall::Left, velocity));
    }
    all
}

/// The scene at the middle of the bounds of a parameter.
pub fn at(scene: &Scene, key: &str, parameter: &Value) -> Option<Scene> {
    let middle = Bounds::read(parameter)?.middle().to_string_radix(10, Some(40));
    scene.with(&[(key.parse::<scene::Key>().ok()?, middle.parse().ok()?)]).ok()
}

/// A multiplier of a bifurcation is 1, or -1 at a doubling, to what bounds of `10^-9` leave of it.
fn bifurcation(point: &Value, scene: &Scene, key: &str) -> Compared<()> {
    let kind = point["kind"].as_str().unwrap_or_default();
    if kind == "graze" || point["orbit"]["physical"] != true {
        return Err(Halt::Open("no orbit that the truth follows"));
    }
    let Some(scene) = at(scene, key, &point["parameter"]) else { return Err(Halt::Open("no scene at the point")) };
    let member = Member::new(&scene, || 0.0);
    orbits::judge(&point["orbit"], &member)?;
    let [trace, determinant] = orbits::trace_and_determinant(&point["orbit"], &member)?;
    let sign = if kind == "period-doubling" { -1.0 } else { 1.0 };
    let value = 1.0 - sign * trace + determinant;
    if value.abs() > 1e-2 * (1.0 + trace.abs()) {
        return wrong(format!("{kind} at {}, but trace {trace} and determinant {determinant}", point["parameter"]));
    }
    Ok(())
}

/// Earliest time of the listed impact of this number; infinitely many of a chatter have no numbers.
fn listed_time(scene: &Scene, number: u64) -> Option<Float> {
    let settings = Settings { impacts: Some(number), ..Settings::default() };
    let orbit = serde_json::to_value(Orbit::of(scene, settings).ok()?.document()).ok()?;
    let event = orbit["events"].as_array()?.iter().find(|event| event["index"] == number)?;
    Some(Bounds::read(&event["time"])?.0)
}

/// Checks that speeds and flights are within the bounds from the listed impact on at which the motion is claimed to be in the region.
fn trap(document: &Value, scene: &Scene, member: &Member) -> Compared<()> {
    let Some(entered) = document["entered_at_impact"].as_u64() else { return Err(Halt::Open("not entered")) };
    let listed = if entered == 0 { Some(Float::with_val(64, f64::NEG_INFINITY)) } else { listed_time(scene, entered) };
    let Some(from) = listed else { return Err(Halt::Open("the impact is not listed")) };
    let (Some(speed), Some(flight)) = (Bounds::read(&document["speed_before"]), Bounds::read(&document["flight_time"]))
    else {
        return wrong("a region without bounds".into());
    };
    let mut motion = Motion::new(&member.shaken, member.start.clone());
    let mut last: Option<Float> = None;
    let mut walls = Vec::new();
    for _ in 1..=entered + 20 {
        let mut releases = Vec::new();
        let Some(contact) = motion.contact(&mut releases)? else { return wrong("a region, but it ends".into()) };
        if contact.time < from {
            continue;
        }
        if !speed.holds(&float(contact.velocity_before.abs_ref())) {
            return wrong(format!("speeds in {}, but {}", document["speed_before"], motion::shown(&contact)));
        }
        if let Some(last) = &last {
            let time = float(&contact.time - last);
            if !releases.is_empty() || !flight.holds(&time) {
                return wrong(format!("flights in {}, but {time:.20}", document["flight_time"]));
            }
        }
        walls.push(contact.wall);
        last = Some(contact.time);
    }
    wall_words(document, &walls)?;
    if last.is_some() { Ok(()) } else { Err(Halt::Open("it chatters before the region")) }
}

/// An orbit in a region makes at most the claimed number of words of `impacts` flights, each to the far or back to the near wall.
fn wall_words(document: &Value, walls: &[Wall]) -> Compared<()> {
    let words = &document["words"];
    let (Some(impacts), Some(count)) = (words["impacts"].as_u64(), words["count"].as_str()) else { return Ok(()) };
    let is_far: Vec<bool> = walls.windows(2).map(|pair| pair[0] != pair[1]).collect();
    let made = is_far.windows(impacts as usize).collect::<BTreeSet<_>>().len();
    if count.parse::<usize>().is_ok_and(|count| made > count) {
        return wrong(format!("{made} words of {impacts} walls, but {words}"));
    }
    Ok(())
}

/// The orbits of a window from its value to both ends, where they are claimed to be stable.
fn between(window: &Value, scene: &Scene) -> Compared<()> {
    let key = window["key"].as_str().unwrap_or_default();
    let number = |value: &Value| value.as_str().and_then(|text| text.parse::<f64>().ok());
    let Some(own) = number(&window["at"]).filter(|_| window["stable_between"] == true) else { return Ok(()) };
    for end in ["from", "to"] {
        let Some([low, high]) = number(&window[end][0]).zip(number(&window[end][1])).map(<[_; 2]>::from) else {
            continue;
        };
        let last = 0.5 * (low + high);
        let value = |part: u32| format!("{:.17}", own + (last - own) * f64::from(part) / 16.0);
        let there = |part: u32| at(scene, key, &Value::Array(vec![Value::String(value(part)); 2]));
        let members: Option<Vec<Member>> = (1..16).map(|part| Some(Member::new(&there(part)?, || 0.0))).collect();
        orbits::stay_stable(&window["orbit"], &members.ok_or(Halt::Open("no scene at the value"))?)?;
    }
    Ok(())
}

/// The saddle of each tangency is the equispaced motion (66), (67), with eigenvalues whose product is `e^2`.
fn tangency(document: &Value) -> Compared<()> {
    let end = |bounds: &Value, i: usize| -> f64 {
        bounds[i].as_str().and_then(|text| text.parse::<f64>().ok()).unwrap_or(f64::NAN)
    };
    let middle = |bounds: &Value| 0.5 * (end(bounds, 0) + end(bounds, 1));
    for found in list(document, "tangencies") {
        let saddle = &found["saddle"];
        let [phase, speed] = [middle(&saddle["phase"]), middle(&saddle["speed"])];
        let [unstable, stable] = [0, 1].map(|i| middle(&saddle["eigenvalues"][i]));
        let e = (unstable * stable).sqrt();
        let trace = 2.0 * e + (1.0 - e * e) * std::f64::consts::FRAC_PI_2 * phase.tan();
        // For all members of a family the bounds are wide.
        let all = [&saddle["phase"], &saddle["speed"], &saddle["eigenvalues"][0], &saddle["eigenvalues"][1]];
        let wide: f64 = all.iter().map(|bounds| end(bounds, 1) - middle(bounds)).sum();
        let is_close = |a: f64, b: f64| (a - b).abs() < (1e-9 + 10.0 * wide) * (1.0 + b.abs());
        if !(is_close(speed, 2.0 * phase.cos() / (1.0 - e)) && is_close(unstable + stable, trace)) {
            return wrong(format!("no saddle: {saddle}"));
        }
    }
    Ok(())
}

/// The orbit and the region that a description has are true, and its fate is theirs.
fn description(document: &Value, scene: &Scene, member: &Member) -> Compared<()> {
    let kind = document["fate"]["kind"].as_str().unwrap_or_default();
    if document["certified"] != (kind != "undecided") {
        return wrong(format!("certified is {}, but the fate is {kind}", document["certified"]));
    }
    if document["proof"].is_object() {
        if document["proof"]["outcome"]["kind"] != kind {
            return wrong(format!("the fate is {kind}, but the orbit is {}", document["proof"]["outcome"]["kind"]));
        }
        return motion::judge(&document["proof"], member);
    }
    if document["region"].is_object() { trap(&document["region"], scene, member) } else { Err(Halt::Open("no proof")) }
}

/// True impacts are neither missed nor false nor outside.
fn audit(document: &Value) -> Compared<()> {
    let counts = &document["counts"];
    let bad = ["outside", "missed", "false"].map(|key| counts[key].as_u64().unwrap_or(0));
    if bad != [0; 3] {
        return wrong(format!("true impacts, but the audit says {counts}: {}", document["first_disagreement"]));
    }
    if document["agreed"] == true { Ok(()) } else { Err(Halt::Open("the audit does not decide")) }
}

/// Nothing of a float run is certified, and the document says so.
fn floats(document: &Value) -> Compared<()> {
    let is_said = document["certified"] == false;
    if is_said { Ok(()) } else { wrong("certified in floats".into()) }
}

fn truth(case: &mut Case, answer: &Answer) -> Compared<()> {
    let members = Member::all(&case.scene, &mut case.random);
    let is_point = members.len() == 1;
    let point = || if is_point { Ok(&members[0]) } else { Err(Halt::Open("a box of data")) };
    match answer {
        Answer::Refused(_) | Answer::Nothing(_) | Answer::Chaos(_) => Err(Halt::Open("nothing")),
        Answer::Orbit(document) if document["certified"] == false => floats(document),
        Answer::Orbit(_) if matches!(case.crossing.question, Question::Impacts("float") | Question::Until("float")) => {
            wrong("certified in floats".into())
        }
        Answer::Orbit(document) if document["claim"] == "shadowed" => {
            all(&members, |member| shadow::judge(document, member))
        }
        Answer::Orbit(document) => all(&members, |member| motion::judge(document, member)),
        Answer::Sweep { records, points, requested, .. } => sweeps::judge(records, points, requested, &mut case.random),
        Answer::Periodic(document) => {
            let listed = all(list(document, "orbits"), |orbit| orbits::judge(orbit, point()?));
            if document["exhaustive"] == true && !matches!(listed, Err(Halt::Wrong(_))) {
                let starts = starts(&case.scene, &mut case.random);
                orbits::judge_all(document, &case.scene, &starts)?;
            }
            listed
        }
        Answer::Bifurcations(document) => {
            let key = document["over"]["key"].as_str().unwrap_or_default();
            point()?;
            all(list(document, "points"), |point| bifurcation(point, &case.scene, key))
        }
        Answer::Description(document) => all(&members, |member| description(document, &case.scene, member)),
        Answer::Cells(document) => point().and_then(|_| cells::judge(document, case)),
        Answer::Trap(document) => all(&members, |member| trap(document, &case.scene, member)),
        Answer::Cycles(document) => {
            let member = point()?;
            list(document, "orbits").iter().try_for_each(|orbit| orbits::judge(orbit, member))
        }
        Answer::Windows(document) => {
            point()?;
            list(document, "windows").iter().try_for_each(|found| window(found, &case.scene))
        }
        // The orbits; and where the scene's own motion goes, it is not elsewhere.
        Answer::Global(document) => components(document, point()?),
        // The same at each point.
        Answer::Atlas { records, points, .. } => {
            point()?;
            let mut all = records.iter().zip(points);
            all.try_for_each(|(record, scene)| components(record, &Member::new(scene, || 0.0)))
        }
        Answer::Tangency(document) => tangency(document),
        Answer::Boxes(images) => all(&members, |member| boxes::judge(images, member)),
        Answer::Audit(document) => audit(document),
    }
}

/// The rows of a list of a document.
fn list<'d>(document: &'d Value, key: &str) -> &'d [Value] {
    document[key].as_array().map_or(&[][..], Vec::as_slice)
}

/// The orbit of a window, at its value, and those between its ends.
fn window(window: &Value, scene: &Scene) -> Compared<()> {
    let value = Value::Array(vec![window["at"].clone(); 2]);
    let there = at(scene, "pair.gap", &value).ok_or(Halt::Open("no scene at the value"))?;
    orbits::judge(&window["orbit"], &Member::new(&there, || 0.0))?;
    between(window, scene)
}

/// The periodic motions among the components of a global analysis.
fn components(document: &Value, member: &Member) -> Compared<()> {
    let orbits = list(document, "components").iter().filter(|own| own["orbit"].is_object());
    orbits.map(|own| &own["orbit"]).try_for_each(|orbit| orbits::judge(orbit, member))?;
    attractors::judge(document, member)
}

impl Answer {
    /// The text that `check` reads; `None` where there is nothing for it.
    fn text(&self) -> Option<String> {
        match self {
            Self::Refused(_) | Self::Nothing(_) | Self::Boxes(_) | Self::Audit(_) => None,
            Self::Orbit(document) if document["certified"] == false => None,
            Self::Orbit(document)
            | Self::Periodic(document)
            | Self::Bifurcations(document)
            | Self::Description(document)
            | Self::Trap(document)
            | Self::Chaos(document)
            | Self::Cells(document)
            | Self::Cycles(document)
            | Self::Windows(document)
            | Self::Global(document) => Some(document.to_string()),
            Self::Tangency(document) => Some(document.to_string()),
            Self::Sweep { head, records, .. } | Self::Atlas { head, records, .. } => {
                let lines = [head].into_iter().chain(records).map(|line| line.to_string() + "\n");
                Some(lines.collect())
            }
        }
    }

    /// The answer in a few words.
    fn outcome(&self) -> String {
        let orbits = |document: &Value, key: &str| document[key].as_array().map_or(0, Vec::len);
        let none_or = |count: usize, what: &str| if count == 0 { format!("no {what}") } else { format!("{what}s") };
        match self {
            Self::Refused(_) => "refused".into(),
            Self::Nothing(why) => (*why).into(),
            Self::Orbit(document) => {
                let (outcome, claim) = (&document["outcome"], &document["claim"]);
                let kind = outcome["kind"].as_str().unwrap_or("none");
                let reason = outcome["reason"].as_str().map_or(String::new(), |reason| format!(" ({reason})"));
                let prefix = if document["certified"] == false { "float: " } else { "" };
                let near = if claim == "shadowed" { "shadowed: " } else { "" };
                format!("{prefix}{near}{kind}{reason}")
            }
            Self::Sweep { records, .. } => {
                let mut kinds: Vec<_> = records.iter().filter_map(|record| record["outcome"].as_str()).collect();
                kinds.sort_unstable();
                kinds.dedup();
                if kinds.len() == 1 { format!("points: {}", kinds[0]) } else { "points of several outcomes".into() }
            }
            Self::Periodic(document) => {
                let all = if document["exhaustive"] == true { ", and no others" } else { "" };
                none_or(orbits(document, "orbits"), "orbit") + all
            }
            Self::Bifurcations(document) => none_or(orbits(document, "points"), "bifurcation"),
            Self::Description(document) => {
                format!("described: {}", document["fate"]["kind"].as_str().unwrap_or("none"))
            }
            Self::Trap(_) => "a region".into(),
            Self::Chaos(document) if document["hyperbolic"].is_object() => "a hyperbolic set".into(),
            Self::Chaos(document) if document["certified"] == true => "a horseshoe".into(),
            Self::Chaos(_) => "no horseshoe".into(),
            Self::Cells(document) => cells::outcome(document),
            Self::Cycles(document) if document["exhaustive"] == true => "all cycles".into(),
            Self::Cycles(_) => "not all cycles".into(),
            Self::Windows(document) => none_or(orbits(document, "windows"), "window"),
            Self::Atlas { records, .. } => {
                let is_decided =
                    |record: &Value| record["class"].as_str().is_some_and(|class| class.starts_with("one-"));
                if records.iter().any(is_decided) { "atlas: decided points".into() } else { "atlas: undecided".into() }
            }
            Self::Global(document) => attractors::outcome(document)
                .map_or_else(|| format!("global: {}", document["class"].as_str().unwrap_or("none")), str::to_owned),
            Self::Tangency(document) => match orbits(document, "tangencies") {
                0 => "no tangency".into(),
                _ => "tangencies".into(),
            },
            Self::Boxes(images) => boxes::outcome(images).into(),
            Self::Audit(document) if document["agreed"] == true => "agreed".into(),
            Self::Audit(_) => "not agreed".into(),
        }
    }

    /// The document in short, for a failure.
    pub fn shown(&self) -> String {
        match self {
            Self::Refused(why) => why.clone(),
            Self::Audit(document) => document.to_string(),
            _ => self.text().unwrap_or_default(),
        }
    }
}

/// Both judges' findings on an answer.
pub fn judge(case: &mut Case, answer: &Answer) -> AnswerVerdict {
    let (check, said) = answer.text().map_or((Finding::Nothing, String::new()), |text| check(&text));
    let (truth, found) = match answer {
        Answer::Refused(_) | Answer::Nothing(_) | Answer::Chaos(_) => (Finding::Nothing, String::new()),
        _ => match truth(case, answer) {
            Ok(()) => (Finding::Right, String::new()),
            Err(Halt::Open(why)) => (Finding::Open, why.to_owned()),
            Err(Halt::Wrong(words)) => (Finding::Wrong, words),
        },
    };
    AnswerVerdict { findings: [check, truth], outcome: answer.outcome(), words: [said, found] }
}
