//! `check` on orbits: sets that hold the orbits of their members, work that is bounded and can be stopped, and what is listed up to a time.
//!
//! Single documents, true and false, are data: `crates/certificate/tests/forged`. [`crate::corpus`] makes many more.

use std::sync::Mutex;

use serde_json::{Value, json};

use impact_pair::Scene;
use impact_pair::exact::{Enclosure, Exact};
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use impact_pair::watch::{Stage, Unwatched, proceed_if};
use impact_pair_certificate::{Certificate, Claims, Limits, Verdict};

use crate::corpus::document as recorded;

/// The orbit JSON of a scene of one harmonic, with all its events.
fn certificate(amplitude: &str, start: &str, restitution: &str, impacts: u64) -> Value {
    orbit(&format!(
        "excitation = {{ amplitude = {amplitude}, frequency = \"pi\", phase = \"pi\" }}\n\
         pair = {{ gap = 9.42497, restitution = {restitution} }}\nstart = {{ time = 0, {start} }}\nrun = {{ impacts = {impacts} }}",
    ))
}

/// The orbit JSON of a scene, with all its events.
fn orbit(scene: &str) -> Value {
    let scene = Scene::parse(scene).unwrap();
    let settings = Settings { arithmetic: Arithmetic::Interval, attractor: false, ..scene.settings() };
    serde_json::to_value(Orbit::of(&scene, settings).unwrap().document()).unwrap()
}

/// The harmonic as two; of what is claimed to be one point, a release, it is claimed that it is within `10^-12` of it.
fn split(document: &Value) -> Value {
    let mut split = document.clone();
    let excitation = &mut split["scene"]["excitation"];
    excitation["amplitude"] = json!([excitation["amplitude"][0], excitation["amplitude"][0]]);
    excitation["frequency"] = json!(["pi", "pi"]);
    excitation["phase"] = json!(["4*pi/3", "2*pi/3"]);
    for event in split["events"].as_array_mut().unwrap() {
        if event["event"] == "release" {
            let time: u32 = event["time"][0].as_str().unwrap().parse().unwrap();
            event["time"] = json!([format!("{}.999999999999", time - 1), format!("{time}.000000000001")]);
        }
    }
    split
}

/// The impacts that a document lists, found again: times and velocities.
fn found_again(document: &Value) -> Vec<(Enclosure, Enclosure)> {
    Certificate::parse(&document.to_string()).unwrap().retraced(192).unwrap()
}

fn verdict(document: &Value) -> Verdict {
    Certificate::parse(&document.to_string()).unwrap().check(&Unwatched).unwrap()
}

/// The first event of a kind.
fn event(document: &Value, name: &str) -> usize {
    document["events"].as_array().unwrap().iter().position(|event| event["event"] == name).expect(name)
}

/// Bounds of time and velocity of the first impacts of [`proved`], from the right wall on by turns; from
/// `python validation/arb/simulate.py SCENE --impacts 6 --digits 14`, which encloses them in Arb's balls.
const PROVED: [[&str; 4]; 6] = [
    ["0.77621049727600641226", "0.77621049727600641227", "6.09718066506500039728", "6.09718066506500039729"],
    ["1.24268949131571683583", "1.24268949131571683584", "-8.83515431394829045518", "-8.83515431394829045517"],
    ["1.78671025839332870884", "1.78671025839332870885", "6.51313642915364352458", "6.51313642915364352459"],
    ["2.42748250247211105387", "2.42748250247211105388", "-5.95067562297451543682", "-5.95067562297451543681"],
    ["2.97489106279952938255", "2.97489106279952938256", "8.63000619818686017919", "8.63000619818686017920"],
    ["3.55525578060025564714", "3.55525578060025564715", "-8.66998377411411345750", "-8.66998377411411345749"],
];

/// Paths to the data of [`proved`] and their values.
const DATA: [(&str, &str); 13] = [
    ("/scene/excitation/amplitude/0", "1"),
    ("/scene/excitation/amplitude/1", "0.7"),
    ("/scene/excitation/amplitude/2", "0.4"),
    ("/scene/excitation/frequency/0", "pi"),
    ("/scene/excitation/frequency/1", "sqrt(2)*pi"),
    ("/scene/excitation/frequency/2", "pi/3"),
    ("/scene/excitation/phase/0", "0.3"),
    ("/scene/excitation/phase/1", "1"),
    ("/scene/excitation/phase/2", "2"),
    ("/scene/gap", "3"),
    ("/scene/restitution", "0.6"),
    ("/scene/start/time", "0.25"),
    ("/scene/start/velocity", "-4"),
];

/// The certificate of an orbit under three harmonics, two of them incommensurate, with data put into other words.
fn proved(word: impl Fn(usize, &str) -> String) -> Value {
    let event = |(i, [t0, t1, v0, v1]): (usize, &[&str; 4])| {
        let (wall, mapping) = if i % 2 == 0 { ("right", "P2") } else { ("left", "P1") };
        json!({
            "event": "impact", "index": i + 1, "mapping": mapping, "wall": wall, "time": [t0, t1], "velocity": [v0, v1],
        })
    };
    let mut document = json!({
        "schema": "impact-pair/orbit/1", "certified": true, "outcome": {"kind": "impacts-reached", "impacts": PROVED.len()},
        "scene": {
            "excitation": {"amplitude": [0, 0, 0], "frequency": [0, 0, 0], "phase": [0, 0, 0]},
            "gap": 0, "restitution": 0, "start": {"time": 0, "wall": "left", "velocity": 0},
        },
        "events": PROVED.iter().enumerate().map(event).collect::<Vec<_>>(),
    });
    for (i, (path, value)) in DATA.iter().enumerate() {
        *document.pointer_mut(path).expect(path) = json!(word(i, value));
    }
    document
}

/// The sets found for the two ends of a datum lie inside those found for all of it, `whole`, and, if `is_tight`, reach nearly
/// as far.
fn assert_sets(whole: &[(Enclosure, Enclosure)], ends: [&[(Enclosure, Enclosure)]; 2], datum: usize, is_tight: bool) {
    for (i, (times, velocities)) in whole.iter().enumerate() {
        let [(t0, v0), (t1, v1)] = ends.map(|end| &end[i]);
        for (set, a, b) in [(times, t0, t1), (velocities, v0, v1)] {
            let hull = a.hull(b);
            assert!(set.contains_enclosure(&hull), "datum {datum}, impact {i}: {set:?} {hull:?}");
            // Twice, for derivatives that are 0 nearby.
            assert!(!is_tight || set.wid() <= hull.wid().scaled(1), "datum {datum}, impact {i}: {set:?} {hull:?}");
        }
    }
}

/// Sets hold the orbits of their members (Lemma V2), and little else where only one datum is not known.
#[test]
fn sets_under_a_sum_depend_on_each_datum_as_their_members() {
    for (datum, (path, _)) in DATA.iter().enumerate() {
        let with =
            |word: &str| found_again(&proved(|i, x| if i == datum { word.replace('x', x) } else { x.to_owned() }));
        let (whole, ends) = (with("[x, x + 1e-12]"), [with("x"), with("x + 1e-12")]);
        assert_eq!(whole.len(), PROVED.len());
        // These are several data: rates, phases, velocities in lengths a radian, and the times of phases.
        let is_one = !["frequency", "time", "phase/1"].iter().any(|several| path.contains(several));
        assert_sets(&whole, ends.each_ref().map(Vec::as_slice), datum, is_one);
    }
}

/// Each member has its own release, at another time.
#[test]
fn releases_depend_on_each_datum_as_their_members() {
    let mut document = split(&certificate("1", "wall = \"left\", velocity = -0.5", "0.3", 40));
    let [rest, release] = [event(&document, "rest"), event(&document, "release")];
    document["events"].as_array_mut().unwrap().truncate(release + 4);
    // Wide enough for all members.
    document["events"][rest]["time"] = json!(["0.2", "0.25"]);
    document["events"][release]["time"] = json!(["0.9", "1.1"]);
    for datum in 0..6 {
        let with = |word: &str| {
            let mut document = document.clone();
            let word = |i: usize, x: &str| if i == datum { word.replace('x', x) } else { x.to_owned() };
            document["scene"]["excitation"] = json!({
                "amplitude": [word(0, "1"), word(1, "1")], "frequency": [word(2, "(pi - 1e-9)"), word(3, "pi")],
                "phase": [word(4, "4*pi/3"), word(5, "2*pi/3")],
            });
            found_again(&document)
        };
        let (whole, ends) = (with("[x, x + 1e-24]"), [with("x"), with("x + 1e-24")]);
        assert_eq!(whole.len(), release - 1 + 3);
        assert_sets(&whole[rest..], ends.each_ref().map(|end| &end[rest..]), datum, true);
    }
}

/// The time to stop at is less than the event by what its bounds tell, as the time of the event is an exact expression, `pi/2` or `pi`: it was enclosed
/// less narrowly, and the event listed.
#[test]
fn r46_no_exact_event_is_listed_that_comes_after_the_time_to_stop_at() {
    let half_pi = "1.570796326794896619231321691639751442098584699687552910487472296153908203143";
    let pi = "3.141592653589793238462643383279502884197169399375105820974944592307816406286";
    let events = |start: &str, until: &str| {
        let document = orbit(&format!(
            "excitation = {{ amplitude = 1, frequency = 1, phase = 0 }}\npair = {{ gap = 2, restitution = 0.5 }}\n\
             start = {{ {start} }}\nrun = {{ until = \"{until}\" }}"
        ));
        assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{until}: {:?}", verdict(&document));
        document["events"].as_array().unwrap().len()
    };
    let grazes = "time = 0, position = 0, velocity = -1";
    assert_eq!([&format!("{half_pi}098"), &format!("{half_pi}2")].map(|until| events(grazes, until)), [0, 1]);
    // It rests on the right wall until it is released.
    let rests = "time = 0.5, wall = \"right\", velocity = 0";
    assert_eq!([&format!("{pi}19"), &format!("{pi}3")].map(|until| events(rests, until)), [1, 2]);
}

#[test]
fn r17_work_is_counted_and_a_graze_that_is_invented_is_bounded_by_it() {
    let document = certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 3);
    let [_, upper] = impact_pair::exact::decimal_bounds(&found_again(&document).pop().unwrap().0);
    let invented = |time: [&str; 2], work: u64| {
        let mut copy = document.clone();
        copy["events"].as_array_mut().unwrap().push(json!({"event": "graze", "wall": "right", "time": time}));
        let certificate = Certificate::parse(&copy.to_string()).unwrap();
        certificate.check_within(&Limits { work, ..Limits::default() }, &Unwatched).unwrap()
    };
    match invented([&upper, "50"], 0) {
        Verdict::Undecided(finding) => assert!(finding.message.ends_with("the work allowed is spent"), "{finding:?}"),
        other => panic!("{other:?}"),
    }
    // Far from the wall nothing need be sought.
    let whole = Limits::default().work;
    let middle = |by: &str| {
        impact_pair::exact::decimal_bounds(&format!("{upper} + {by}").parse::<Exact>().unwrap().enclose(96))[0].clone()
    };
    assert!(matches!(invented([&middle("0.3"), &middle("0.3001")], whole), Verdict::Refuted(_)));
}

#[test]
fn r17_who_stops_a_check_keeps_what_is_proved() {
    let document = certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 9);
    let certificate = Certificate::parse(&document.to_string()).unwrap();
    let stop_at = |event: usize| {
        let stop = |at: Stage<'_>| proceed_if(at != Stage::Claims(event));
        certificate.check_within(&Limits::default(), &stop).unwrap()
    };
    for events in [1, 4, 8] {
        assert_eq!(stop_at(events), Verdict::Interrupted { events });
    }
    assert!(matches!(stop_at(99), Verdict::Confirmed { .. }));
}

#[test]
fn r35_who_stops_a_proof_keeps_what_is_proved() {
    let document = certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 9);
    let certificate = Certificate::parse(&document.to_string()).unwrap();
    let theorem = certificate.prove(9, &|at: Stage<'_>| proceed_if(at != Stage::Claims(5))).unwrap();
    assert_eq!((theorem.impacts, theorem.stop.map(|stop| stop.message)), (4, Some("interrupted".to_owned())));
}

/// A time between the last impact that the digits list and the rest, in the first chatter and in a period that is repeated: with four
/// digits that is from 0.217982 to 0.218013 and from 18.362865 to 18.362908, each time 18 later.
#[test]
fn r53_impacts_of_a_chatter_up_to_a_time_are_listed() {
    let text = "excitation = { amplitude = 1, frequency = \"pi\", phase = \"pi\" }\n\
                pair = { gap = 9.42497, restitution = 0.3 }\nstart = { time = 0, wall = \"left\", velocity = -0.5 }";
    let scene = Scene::parse(text).unwrap();
    for (until, impacts, last) in [
        ("0.21", 2, "impact"),
        ("0.218005", 8, "impact"),
        ("0.2180133", 11, "impact"),
        ("0.2181", 7, "rest"),
        ("1.5", 7, "release"),
        ("36.3629", 36, "impact"),
        ("54.3629", 50, "impact"),
        ("54.363", 49, "rest"),
    ] {
        let settings = Settings { until: Some(Exact::parse(until).unwrap()), digits: 4, ..scene.settings() };
        let document = Orbit::of(&scene, settings).unwrap().document();
        let document = serde_json::to_value(document).unwrap();
        let events = document["events"].as_array().unwrap();
        let found =
            (document["outcome"]["impacts"].as_u64().unwrap(), events.last().unwrap()["event"].as_str().unwrap());
        assert_eq!(found, (impacts, last), "{until}");
        assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{until}: {:?}", verdict(&document));
    }
}

#[test]
fn a_stopped_check_keeps_the_proved_links() {
    let certificate = Certificate::parse(&recorded("shadow of a thousand impacts").to_string()).unwrap();
    let reported = Mutex::new(Vec::new());
    let stop = |at: Stage<'_>| {
        let Stage::Claims(confirmed) = at else { return proceed_if(true) };
        reported.lock().unwrap().push(confirmed);
        proceed_if(confirmed < 100)
    };
    let found = certificate.check_within(&Limits::default(), &stop).unwrap();
    let reported = reported.into_inner().unwrap();
    let Verdict::Interrupted { events } = found else { panic!("{found:?}") };
    assert!((100..1000).contains(&events) && reported.is_sorted(), "{events} {reported:?}");
}

#[test]
fn a_stopped_check_of_words_reports_its_progress() {
    let claims = Claims::parse(&recorded("chaos").to_string()).unwrap();
    let stop = |at: Stage<'_>| proceed_if(!matches!(at, Stage::Claims(6..)));
    let found = claims.check_within(&Limits::default(), &stop).unwrap();
    assert!(matches!(found, Verdict::Interrupted { events } if events >= 6), "{found:?}");
}

#[test]
fn no_theorem_is_written_of_a_shadowed_orbit() {
    let certificate = Certificate::parse(&recorded("shadowed").to_string()).unwrap();
    let refused = certificate.prove(5, &Unwatched).unwrap_err().to_string();
    assert!(refused.contains("shadowed") && refused.contains("exact start"), "{refused}");
}
