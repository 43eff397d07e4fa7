//! Orbits of several harmonics: those of one harmonic `A sin(th)` are true of `A sin(th + pi/3) + A sin(th - pi/3)`, and one is another
//! program's.

use super::*;

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
        assert!(matches!(corrupted(&document, path, value), Verdict::Refuted(_)), "{path}");
    }
    // A bound past the truth, by a unit of its last place or two.
    for (path, end) in [("time", 0), ("time", 1), ("velocity", 0), ("velocity", 1)] {
        let path = entry(11, path);
        let bounds = document.pointer(&path).unwrap().as_array().unwrap();
        let other = &bounds[1 - end];
        let mut claimed = bounds.clone();
        claimed[end] = other.clone();
        assert!(!matches!(corrupted(&document, &path, json!(claimed)), Verdict::Confirmed { .. }), "{path}");
    }
}

#[test]
fn the_orbit_that_another_program_proved_is_confirmed_for_these_data_only() {
    let document = proved(|_, value| value.to_owned());
    assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "{:?}", verdict(&document));
    for (path, value) in DATA {
        let other = json!(format!("{value} + 1e-17"));
        assert!(matches!(corrupted(&document, path, other), Verdict::Refuted(_)), "{path}");
    }
}

/// The sets found for the two ends of a datum lie inside those found for all of it, `whole`, and, if `is_tight`, reach nearly
/// as far.
pub(super) fn assert_sets(
    whole: &[(Enclosure, Enclosure)],
    ends: [&[(Enclosure, Enclosure)]; 2],
    datum: usize,
    is_tight: bool,
) {
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
