//! First flights made to be hard, each judged by the truth: none may be wrong, none undecided.
//!
//! `data/hard-flights.jsonl` has them: grazes and near misses down to 1e-40 of the gap, by velocity, by gap, in low hops and 1e15 periods
//! from the start; contacts after 1e-9 periods; flights of 1e11 forcing periods whose last peak barely reaches; starts at rest.

use impact_pair::Scene;
use impact_pair::orbit::{Orbit, Settings};
use serde_json::{Value, json};

use crate::crossings::members::Member;
use crate::crossings::motion::{Halt, judge};
use crate::random::cases;

/// A line of the file: a family, the scene, and what `exponent` of ten makes it hard.
struct Flight {
    line: Value,
    scene: Scene,
}

/// One of five pairs of flights, spread over all that a family varies; all where more cases than the default are requested. The two of a
/// pair differ by twice a depth and by nothing else.
fn flights() -> Vec<Flight> {
    let is_all = cases(8) > 1;
    let chosen = include_str!("../../../data/hard-flights.jsonl").lines().enumerate();
    let chosen = chosen.filter(|(number, _)| is_all || number / 2 % 5 == 0);
    let flight = |line: Value| Flight { scene: Scene::parse(line["scene"].as_str().unwrap()).unwrap(), line };
    chosen.map(|(_, line)| flight(serde_json::from_str(line).unwrap())).collect()
}

impl Flight {
    /// The first impact in `auto`, as a document.
    fn asked(&self) -> Value {
        let settings = Settings { impacts: Some(1), digits: 9, ..Settings::default() };
        json!(Orbit::new(self.scene.pair(), self.scene.start(), settings).unwrap().document())
    }

    /// The finding on a document, by the motion of this flight.
    fn finds(&self, document: &Value) -> Result<(), Halt> {
        judge(document, &Member::new(&self.scene, || 0.0))
    }
}

#[test]
fn hard_first_flights_are_right_and_decided() {
    let flights = flights();
    for flight in &flights {
        let found = flight.asked();
        assert_eq!(found["outcome"]["kind"], "impacts-reached", "undecided: {} {}", flight.line, found["outcome"]);
        assert_eq!(found["events"][0]["event"], "impact", "{}: {}", flight.line, found["events"]);
        flight.finds(&found).unwrap_or_else(|halt| panic!("{halt:?}: {}", flight.line));
    }
    println!("{} hard flights", flights.len());
    assert!(flights.len() >= 370);
}

/// The bounds of the data set for other simulators: figures, one and two harmonics, chatters, grazes and near misses.
#[test]
fn the_data_set_holds_the_truth() {
    let sets = [
        include_str!("../../../data/flights.jsonl"),
        include_str!("../../../data/chatters.jsonl"),
        include_str!("../../../data/orbits.jsonl"),
    ];
    for line in sets.into_iter().flat_map(str::lines) {
        let mut line: Value = serde_json::from_str(line).unwrap();
        let excitation = line["scene"]["excitation"].take();
        let tables = ["amplitude", "frequency", "phase"].map(|key| format!("{key} = {}", excitation[key]));
        let start = line["scene"]["start"].as_object().unwrap();
        let start: Vec<_> = start.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        let (gap, restitution) = (&line["scene"]["gap"], &line["scene"]["restitution"]);
        let text = format!(
            "excitation = {{ {} }}\npair = {{ gap = {gap}, restitution = {restitution} }}\nstart = {{ {} }}",
            tables.join(", "),
            start.join(", ")
        );
        let scene = Scene::parse(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
        let events = line["events"].as_array().unwrap();
        let impacts = events.iter().filter(|event| event["event"] == "impact").count();
        // Of what a motion tends to no orbit is given.
        let kind = if line["outcome"] == "time-reached" { "time-reached" } else { "impacts-reached" };
        let outcome = json!({ "kind": kind, "until": line["until"], "impacts": impacts });
        let document = json!({ "events": events, "outcome": outcome });
        judge(&document, &Member::new(&scene, || 0.0)).unwrap_or_else(|halt| panic!("{halt:?}: {}", line["name"]));
    }
}

/// The control: the library's answer to one of a pair, judged by the truth of the other, has to be found wrong; a judge that passes it would
/// pass anything.
#[test]
fn the_truth_refutes_the_answer_to_a_changed_scene() {
    let flights = flights();
    let is_pair =
        |pair: &&[Flight]| ["graze", "graze by gap", "long flight"].iter().any(|name| pair[0].line["family"] == *name);
    let mut found = 0;
    for pair in flights.chunks_exact(2).filter(is_pair) {
        for (one, other) in [(&pair[0], &pair[1]), (&pair[1], &pair[0])] {
            let finding = other.finds(&one.asked());
            assert!(matches!(finding, Err(Halt::Wrong(_))), "{finding:?}: {} {}", one.line, other.line);
            found += 1;
        }
    }
    assert!(found > 60);
}
