//! Certificates of several harmonics: those of one harmonic `A sin(th)` are true of `A sin(th + pi/3) + A sin(th - pi/3)`, and
//! one is another program's.

use serde_json::{Value, json};

use impact_pair::Scene;
use impact_pair::document;
use impact_pair::exact::{Enclosure, Exact};
use impact_pair::orbit::{Arithmetic, Settings};
use impact_pair::watch::{Stage, Unwatched, proceed_if};
use impact_pair_certificate::{Certificate, Effort, Verdict};

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
    serde_json::to_value(document::orbit(scene.pair(), scene.start(), settings).unwrap()).unwrap()
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

/// Where the impacts that a document lists come, and how fast, found again: times and velocities.
fn found_again(document: &Value) -> Vec<(Enclosure, Enclosure)> {
    Certificate::parse(&document.to_string()).unwrap().retraced(192).unwrap()
}

fn verdict(document: &Value) -> Verdict {
    Certificate::parse(&document.to_string()).unwrap().check(&Unwatched).unwrap()
}

/// The verdict of a copy with another value at a path.
fn spoiled(document: &Value, path: &str, value: Value) -> Verdict {
    let mut copy = document.clone();
    *copy.pointer_mut(path).expect(path) = value;
    // Words that say something else would be refused whatever the fields are.
    copy["outcome"]["message"] = json!("");
    verdict(&copy)
}

/// Released at `t = 1` it is released again 7 cycles and 70 listed impacts later, on the same wall: so it is after twice or three times that.
#[test]
fn r46_a_multiple_of_a_period_is_a_period() {
    let document = certificate("1", "wall = \"left\", velocity = 0", "0.5", 80);
    assert_eq!(document["outcome"]["period"], json!({ "cycles": 7, "impacts": 70 }));
    let with = |cycles: u64, impacts: u64| {
        spoiled(&document, "/outcome/period", json!({ "cycles": cycles, "impacts": impacts }))
    };
    for times in 1..4 {
        assert!(matches!(with(7 * times, 70 * times), Verdict::Confirmed { .. }), "{times}");
    }
    for (cycles, impacts) in [(14, 70), (7, 140), (14, 139), (10, 100), (0, 0), (u64::MAX / 7 * 7, 70)] {
        assert!(matches!(with(cycles, impacts), Verdict::Refuted(_)), "{impacts} in {cycles}");
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

fn event(document: &Value, name: &str) -> usize {
    document["events"].as_array().unwrap().iter().position(|event| event["event"] == name).expect(name)
}

#[test]
fn r17_an_outcome_is_what_its_fields_say() {
    let document = certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 3);
    assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{:?}", verdict(&document));
    let refuted = |outcome: Value| {
        let mut copy = document.clone();
        copy["outcome"] = outcome;
        matches!(verdict(&copy), Verdict::Refuted(_))
    };
    assert!(refuted(json!({"kind": "impacts-reached", "impacts": 3, "message": "9999 impacts"})));
    assert!(refuted(json!({"kind": "impacts-reached", "impacts": 4, "message": "4 impacts"})));
    assert!(refuted(json!({"kind": "impacts-reached", "impacts": 3, "until": "1"})));
    let until = |time: &str| json!({"kind": "time-reached", "impacts": 3, "until": time});
    assert!(
        refuted(until("9999"))
            && refuted(until("1e-3"))
            && refuted(json!({"kind": "time-reached", "impacts": 3, "until": null}))
    );
    // Up to just before the next impact, and just beyond it.
    let next = found_again(&certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 4)).pop().unwrap().0;
    let [lower, upper] = impact_pair::exact::decimal_bounds(&next.rounded(64));
    let mut copy = document.clone();
    copy["outcome"] = until(&lower);
    assert!(matches!(verdict(&copy), Verdict::Confirmed { .. }), "{:?}", verdict(&copy));
    assert!(!matches!(
        verdict(&{
            copy["outcome"] = until(&upper);
            copy
        }),
        Verdict::Confirmed { .. }
    ));
    assert!(refuted(until(&format!("{upper} + 1e-12"))));
    let older = document.to_string().replace("\"impacts\":3,", "").replace(",\"impacts\":3", "");
    let refused = Certificate::parse(&older).unwrap_err().to_string();
    assert!(refused.contains("outcome.impacts is missing"), "{refused}");
}

#[test]
fn r17_work_is_counted_and_a_graze_that_is_invented_is_bounded_by_it() {
    let document = certificate("8", "wall = \"left\", velocity = -12.56636", "0.5", 3);
    let [_, upper] = impact_pair::exact::decimal_bounds(&found_again(&document).pop().unwrap().0);
    let invented = |time: [&str; 2], work: u64| {
        let mut copy = document.clone();
        copy["events"].as_array_mut().unwrap().push(json!({"event": "graze", "wall": "right", "time": time}));
        let certificate = Certificate::parse(&copy.to_string()).unwrap();
        certificate.check_within(&Effort { work, ..Effort::default() }, &Unwatched).unwrap()
    };
    match invented([&upper, "50"], 0) {
        Verdict::Undecided(finding) => assert!(finding.message.ends_with("the work allowed is spent"), "{finding:?}"),
        other => panic!("{other:?}"),
    }
    // Far from the wall nothing need be sought.
    let whole = Effort::default().work;
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
        certificate.check_within(&Effort::default(), &stop).unwrap()
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

#[test]
fn a_contact_that_does_not_come_is_refuted_in_the_first_bits() {
    let document = certificate("8", "wall = \"left\", velocity = 0", "0.5", 3);
    let refuted = |edit: fn(&mut Vec<Value>)| {
        let mut copy = document.clone();
        edit(copy["events"].as_array_mut().unwrap());
        let certificate = Certificate::parse(&copy.to_string()).unwrap();
        let effort = Effort { bits: 192, ..Effort::default() };
        match certificate.check_within(&effort, &Unwatched).unwrap() {
            Verdict::Refuted(finding) => finding.message,
            other => panic!("{other:?}"),
        }
    };
    // A rest, a release, impacts on the right, the left and the left wall.
    let elsewhere = refuted(|events| (events[3]["wall"], events[3]["mapping"]) = (json!("right"), json!("P3")));
    assert_eq!(elsewhere, "the ball is not at the right wall then");
    let twice = refuted(|events| {
        events[4] = events[3].clone();
        (events[4]["index"], events[4]["mapping"]) = (json!(3), json!("P4"));
    });
    assert_eq!(twice, "no contact with the left wall comes by then");
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

/// A path to an entry of an event.
fn entry(event: usize, key: &str) -> String {
    format!("/events/{event}/{key}")
}

#[test]
fn the_orbit_of_a_sum_is_confirmed_and_nothing_else() {
    let document = split(&certificate("2", "wall = \"left\", velocity = -12.56636", "0.5", 12));
    assert_eq!(document["events"].as_array().unwrap().len(), 12);
    assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{:?}", verdict(&document));
    for (path, value) in [
        ("/scene/excitation/phase/1", json!("2.0944")),
        ("/scene/excitation/amplitude/0", json!("2.0001")),
        ("/scene/excitation/frequency/1", json!("3.1416")),
        ("/scene/gap", json!("9.42")),
        ("/events/5/wall", json!(if document["events"][5]["wall"] == "left" { "right" } else { "left" })),
    ] {
        assert!(matches!(spoiled(&document, path, value), Verdict::Refuted(_)), "{path}");
    }
    // A bound past the truth, by a unit of its last place or two.
    for (path, end) in [("time", 0), ("time", 1), ("velocity", 0), ("velocity", 1)] {
        let path = entry(11, path);
        let bounds = document.pointer(&path).unwrap().as_array().unwrap();
        let other = &bounds[1 - end];
        let mut claimed = bounds.clone();
        claimed[end] = other.clone();
        assert!(!matches!(spoiled(&document, &path, json!(claimed)), Verdict::Confirmed { .. }), "{path}");
    }
}

#[test]
fn the_orbit_that_another_program_proved_is_confirmed_for_these_data_only() {
    let document = proved(|_, value| value.to_owned());
    assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{:?}", verdict(&document));
    for (path, value) in DATA {
        let other = json!(format!("{value} + 1e-17"));
        assert!(matches!(spoiled(&document, path, other), Verdict::Refuted(_)), "{path}");
    }
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

#[test]
#[cfg(feature = "multiprecision")]
fn r16_after_a_graze_no_mapping_is_confirmed_that_is_not_proved() {
    let document = orbit(
        "excitation = { amplitude = 1, frequency = 2, phase = 0.7 }\n\
         pair = { gap = 5.51996296806061375229774706080799496119226455, restitution = 0.5 }\n\
         start = { time = 0, wall = \"left\", velocity = -0.4 }\nrun = { impacts = 3 }",
    );
    assert_eq!((event(&document, "graze"), &document["events"][1]["mapping"]), (0, &Value::Null));
    assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{:?}", verdict(&document));
    for mapping in ["P2", "P3"] {
        let verdict = spoiled(&document, &entry(1, "mapping"), json!(mapping));
        assert!(matches!(verdict, Verdict::Undecided(_)), "{mapping}: {verdict:?}");
    }
    assert!(matches!(spoiled(&document, &entry(1, "mapping"), json!("P1")), Verdict::Refuted(_)));
    assert!(matches!(spoiled(&document, &entry(2, "mapping"), Value::Null), Verdict::Refuted(_)));
}

#[test]
fn rests_and_releases_of_a_sum_are_confirmed_and_nothing_else() {
    let document = split(&certificate("1", "wall = \"left\", velocity = -0.5", "0.3", 40));
    let [rest, release] = [event(&document, "rest"), event(&document, "release")];
    assert_eq!((&document["outcome"]["kind"], release), (&json!("periodic"), rest + 1));
    assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{:?}", verdict(&document));
    let late = json!(["2.999999999999", "3.000000000001"]);
    assert!(matches!(spoiled(&document, &entry(release, "time"), late), Verdict::Refuted(_)));
    assert!(matches!(spoiled(&document, &entry(rest, "wall"), json!("right")), Verdict::Refuted(_)));
    assert!(matches!(spoiled(&document, &entry(rest, "time"), json!(["0.9", "0.91"])), Verdict::Refuted(_)));
    assert!(matches!(spoiled(&document, &entry(release, "event"), json!("rest")), Verdict::Refuted(_)));
    for key in ["cycles", "impacts"] {
        let path = format!("/outcome/period/{key}");
        assert!(matches!(spoiled(&document, &path, json!(1)), Verdict::Refuted(_)), "{key}");
    }
}

/// There are two releases from a wall in a common period, and a second one of each kind only after a while.
#[test]
fn the_period_ends_with_a_release_at_the_same_phase_of_all_harmonics() {
    let document = orbit(include_str!("../validation/certificates/scenes/dead-impacts.toml"));
    assert_eq!(document["outcome"]["period"], json!({"cycles": 3, "impacts": 6}));
    assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{:?}", verdict(&document));
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

/// `y = -sin(2 pi t)/2` touches the left wall at 1/4 and the right one at 3/4 of every turn (Lemma Z4), whenever the ball starts.
#[test]
fn r32_exact_grazes_without_drift_are_confirmed_from_any_phase() {
    let of = |[time, position, velocity]: [&str; 3], grazes: [(&str, &str); 3]| {
        let graze = |(wall, time)| json!({"event": "graze", "wall": wall, "time": [time, time]});
        json!({
            "schema": "impact-pair/orbit/1", "certified": true, "events": grazes.map(graze),
            "outcome": {"kind": "periodic", "impacts": 0, "period": {"cycles": 1, "impacts": 0}},
            "scene": {
                "excitation": {"amplitude": ["1/2"], "frequency": ["2*pi"], "phase": ["0"]}, "gap": "1", "restitution": "1/2",
                "start": {"time": time, "position": position, "velocity": velocity},
            },
        })
    };
    let grazes = [("left", "0.25"), ("right", "0.75"), ("left", "1.25")];
    let later = [("right", "0.75"), ("left", "1.25"), ("right", "1.75")];
    let twelfth = ["1/12", "-1/4", "-pi*cos(pi/6)"];
    let confirmed = |document: &Value| matches!(verdict(document), Verdict::Confirmed { .. });
    for (start, grazes) in [(["0", "0", "-pi"], grazes), (twelfth, grazes), (["1/2", "0", "pi"], later)] {
        let document = of(start, grazes);
        assert!(confirmed(&document), "{start:?}: {:?}", verdict(&document));
    }
    for (start, grazes) in [
        (["0", "0", "-pi"], later),
        (["1/2", "0", "pi"], grazes),
        (["0", "0", "-pi + 1e-30"], grazes),
        (["0", "0", "-pi - 1e-30"], grazes),
        (["1/12", "-1/4 + 1e-30", "-pi*cos(pi/6)"], grazes),
        (["0", "0", "pi"], grazes),
    ] {
        assert!(!confirmed(&of(start, grazes)), "{start:?}");
    }
    // Where the box may stand still the ball may lie on its wall.
    let mut on_wall = of(["1/4", "0", "0"], [("left", "1.25"), ("left", "2.25"), ("left", "3.25")]);
    on_wall["scene"]["start"] = json!({"time": "1/4", "wall": "left", "velocity": "0"});
    for (amplitude, is_true) in [("[0.1, 0.2]", true), ("[0, 0.1]", false)] {
        on_wall["scene"]["excitation"]["amplitude"][0] = json!(amplitude);
        assert_eq!(confirmed(&on_wall), is_true, "{amplitude}: {:?}", verdict(&on_wall));
    }
}

/// `y = -1/2 + 2^-103 + (1 - sin(2 pi t))/10` comes within `2^-103` of the left wall in every turn: no touch, but a graze as far as the
/// bounds of a time tell (Lemma G1).
#[test]
fn r32_a_miss_that_is_not_told_from_a_touch_is_a_graze() {
    let of = |graze: [&str; 2]| {
        json!({
            "schema": "impact-pair/orbit/1", "certified": true,
            "events": [{"event": "graze", "wall": "left", "time": graze}],
            "outcome": {"kind": "undecided", "reason": "graze", "impacts": 0, "time": ["0.9", null]},
            "scene": {
                "excitation": {"amplitude": ["1/10"], "frequency": ["2*pi"], "phase": ["0"]}, "gap": "1", "restitution": "1/2",
                "start": {"time": "0", "position": "-1/2 + 1/2^103 + 1/10", "velocity": "-pi/5"},
            },
        })
    };
    let verdict = verdict(&of(["0.2499999999", "0.2500000001"]));
    assert!(matches!(verdict, Verdict::Confirmed { .. }), "{verdict:?}");
    // The wall is missed by more than these bounds allow, or elsewhere.
    assert!(matches!(self::verdict(&of(["0.25", "0.25"])), Verdict::Refuted(_)));
    assert!(!matches!(self::verdict(&of(["0.26", "0.27"])), Verdict::Confirmed { .. }));
}

#[test]
fn what_never_touches_a_wall_is_confirmed_and_nothing_else() {
    let document = |amplitudes: [&str; 2], frequencies: [&str; 2], position: &str, velocity: &str| {
        json!({
            "schema": "impact-pair/orbit/1", "certified": true, "events": [], "outcome": {"kind": "never-impacts", "impacts": 0},
            "scene": {
                "excitation": {"amplitude": amplitudes, "frequency": frequencies, "phase": ["pi/2", "-pi/2"]},
                "gap": "4", "restitution": "0.5",
                "start": {"time": "0", "position": position, "velocity": velocity},
            },
        })
    };
    let [incommensurate, in_step] = [["1", "sqrt(2)"], ["1", "3"]];
    let confirmed = |document: Value| matches!(verdict(&document), Verdict::Confirmed { .. });
    let amplitudes = ["1", "1/2"];
    // y + E = y(0) + 1/2 is at most 1/2 where E gets as far as 3/2.
    assert!(confirmed(document(amplitudes, incommensurate, "-1e-6", "0")));
    assert!(!confirmed(document(amplitudes, incommensurate, "1e-6", "0")));
    assert!(!confirmed(document(amplitudes, incommensurate, "-1e-6", "1e-30")));
    // E = cos t - cos(3 t)/2 gets only 1.07583 far.
    assert!(confirmed(document(amplitudes, in_step, "0.42416", "0")));
    assert!(matches!(verdict(&document(amplitudes, in_step, "0.42418", "0")), Verdict::Refuted(_)));
}
