//! `check` of regions and of words of horseshoes: right ones are confirmed, corrupted ones never.

use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::fs;

use impact_pair::Scene;
use impact_pair::chaos::{Chaos, HorseshoeSettings, Hyperbolic, Trap};
use impact_pair::document;
use impact_pair::exact::Exact;
use impact_pair::json::GivenBase;
use impact_pair::orbit::Settings;
use impact_pair::scene::Range;
use impact_pair::watch::{Stage, Unwatched, proceed_if};
use impact_pair_certificate::{Claims, Effort, Finding, Verdict};
use serde_json::{Value, json};

fn file(name: &str) -> String {
    fs::read_to_string(format!("{}/{name}", impact_pair_tests::ROOT)).unwrap()
}

fn figure(name: &str) -> Scene {
    Scene::parse(&file(&format!("scenes/{name}.toml"))).unwrap()
}

/// The chaos JSON of figure 14 with the bases that the documentation has, over a range of a parameter if one is given.
fn chaos(depth: usize, over: Option<&str>) -> Value {
    chaos_of("figure-14", "docs/bases-figure-14.json", depth, over)
}

fn chaos_of(name: &str, bases: &str, depth: usize, over: Option<&str>) -> Value {
    let scene = figure(name);
    let read: Value = serde_json::from_str(&file(bases)).unwrap();
    let bases: Vec<GivenBase> = serde_json::from_value(read["bases"].clone()).unwrap();
    let question = HorseshoeSettings { depth: Some(depth), bases: document::bases(&bases) };
    let over: Option<Range> = over.map(|over| over.parse().unwrap());
    let pair = match &over {
        Some(over) => scene.pair().with(over.key(), Exact::interval(over.low(), over.high()).unwrap()).unwrap(),
        None => scene.pair().clone(),
    };
    let found = Chaos::of(&pair, scene.start(), &question, &Unwatched).unwrap();
    json!(document::chaos(&scene, over.as_ref(), &found))
}

/// The chaos JSON of figure 14 with what its hyperbolic set is measured to be.
pub fn hyperbolic(depth: usize) -> Value {
    let scene = figure("figure-14");
    let read: Value = serde_json::from_str(&file("docs/bases-figure-14.json")).unwrap();
    let bases: Vec<GivenBase> = serde_json::from_value(read["bases"].clone()).unwrap();
    let question = HorseshoeSettings { depth: Some(depth), bases: document::bases(&bases) };
    let found = Chaos::of(scene.pair(), scene.start(), &question, &Unwatched).unwrap();
    let set = Hyperbolic::of(scene.pair(), &found, &Unwatched).unwrap();
    json!(document::with_hyperbolic(document::chaos(&scene, None, &found), &set))
}

/// Its bounds are proved again by strips and cells of its own; none that is narrower than what is true, and no other words or cones.
#[test]
fn a_hyperbolic_set_is_proved_again() {
    let document = hyperbolic(3);
    assert!(is_confirmed(&document), "{:?}", verdict(&document));
    let refuses = |key: &str, value: Value, reason: &str| {
        let mut forged = document.clone();
        *forged.pointer_mut(&format!("/hyperbolic/{key}")).unwrap() = value;
        refuses(&forged, key, reason);
    };
    refuses("exponents/per_impact/1", json!("0.83"), "hyperbolic.exponents");
    refuses("kappa", json!("400"), "kappa");
    refuses("words", json!([0, 1, 2, 3, 5]), "lead back");
    refuses("words", json!([0, 2, 3, 3]), "different");
    refuses("words", json!([0, 2, 3]), "entropy");
    refuses("entropy/per_cycle", json!(["0.6", "0.6931"]), "entropy.per_cycle");
}

/// All 21 words of up to 8 impacts, slow impacts and folds among them.
#[test]
#[ignore = "deep: all 21 words of up to 8 impacts; by default a_hyperbolic_set_is_proved_again"]
fn a_hyperbolic_set_of_many_words_is_proved_again() {
    let document = hyperbolic(8);
    assert!(is_confirmed(&document), "{:?}", verdict(&document));
}

/// The document with a base more than a forcing period wide in the place of base 1, from which and to which no word leads.
#[test]
fn r32_a_base_wider_than_a_turn_is_refused() {
    let of_width = |width: f64| {
        let mut document = chaos(3, None);
        document["words"].as_array_mut().unwrap().retain(|word| word["from"] != 1);
        let edge = |phase: f64| json!([[phase, 5.0], [phase, 5.125]]);
        let base = &mut document["bases"][1];
        base["corners"] = json!({ "left": edge(0.125), "right": edge(0.125 + width) });
        base["phase"] = json!((TAU * (0.125 + 0.5 * width)).to_string());
        base["speed"] = json!("5.0625");
        base["expanding"] = json!([(TAU * 0.5 * width).to_string(), "0"]);
        base["contracting"] = json!(["0", "0.0625"]);
        document
    };
    assert!(is_confirmed(&of_width(0.75)), "{:?}", verdict(&of_width(0.75)));
    refuses(&of_width(1.25), "a base of more than a turn", "translate");
}

/// V12, work: words of three bases' tubes at A/d = 0.036, where flights last for some cycles and expand by hundreds: minutes before.
#[test]
fn r32_a_check_of_few_words_is_bounded() {
    let document: Value = serde_json::from_str(&file("tests/chaos-0.036.json")).unwrap();
    let claims = Claims::parse(&document.to_string()).unwrap();
    let effort = Effort { work: 1 << 11, ..Effort::default() };
    let found = claims.check_within(&effort, &Unwatched).unwrap();
    assert!(matches!(&found, Verdict::Undecided(finding) if finding.message.contains("work")), "{found:?}");
    let found = claims.check_within(&Effort::default(), &|_: Stage<'_>| proceed_if(false)).unwrap();
    assert!(matches!(found, Verdict::Interrupted { events: 0 }), "{found:?}");
}

/// Of the scene's own orbit no lemma proves anything again: it is named beside the verdict. What contradicts itself is refuted.
#[test]
fn r32_what_is_said_of_the_scenes_own_orbit() {
    let document = chaos(3, None);
    assert!(Claims::parse(&document.to_string()).unwrap().unjudged().iter().any(|key| key == "scene_orbit"));
    let attracted = |word: &str, impacts: u32, cycles: u32| {
        let period = json!({ "word": word, "impacts": impacts, "cycles": cycles });
        with(&document, &[("/scene_orbit/attracted", period)])
    };
    assert!(is_confirmed(&attracted("P1 P2", 2, 1)));
    for (word, impacts, cycles) in [("P1 P2", 3, 1), ("P1 P2", 2, 0), ("P2", 1, 1), ("P2 P2", 2, 1), ("whatever", 2, 1)]
    {
        refuses(&attracted(word, impacts, cycles), word, "scene_orbit");
    }
    refuses(&with(&document, &[("/scene_orbit/region/boxes", json!(0))]), "no box", "scene_orbit");
}

fn trap(name: &str) -> Value {
    let scene = figure(name);
    json!(document::trap(&scene, &Trap::of(&scene, 0, &Unwatched).unwrap().unwrap()).unwrap())
}

/// `None` where it is refused as it is read.
fn verdict(document: &Value) -> Option<Verdict> {
    Some(Claims::parse(&document.to_string()).ok()?.check_within(&Effort::default(), &Unwatched).unwrap())
}

fn is_confirmed(document: &Value) -> bool {
    matches!(verdict(document), Some(Verdict::Confirmed { .. }))
}

/// The document with other values at these paths.
fn with(document: &Value, changes: &[(&str, Value)]) -> Value {
    let mut copy = document.clone();
    for (path, value) in changes {
        *copy.pointer_mut(path).expect(path) = value.clone();
    }
    copy
}

/// Asserts that a document is not confirmed, with a message that contains `words`.
fn refuses(document: &Value, whose: &str, words: &str) {
    match verdict(document) {
        Some(Verdict::Refuted(Finding { message, .. }) | Verdict::Undecided(Finding { message, .. })) => {
            assert!(message.contains(words), "{whose}: {message}");
        }
        found => panic!("{whose}: {found:?}"),
    }
}

#[test]
fn words_are_confirmed() {
    for document in [chaos(7, None), chaos(3, Some("gap=9.42477..9.42498"))] {
        assert!(is_confirmed(&document), "{:?} {document}", verdict(&document));
    }
}

/// The claim of docs/paper.md on figure 14: long words, from the h-sets that `chaos --depth 22` finds. Each of the checker's ways to make
/// chains loses some of them, of the longest ones a few for good: the others have the entropy that the document states.
#[test]
#[ignore = "deep: words of up to 22 impacts; by default words_are_confirmed"]
fn the_entropy_of_long_words_is_confirmed() {
    let document = chaos_of("figure-14", "tests/bases-figure-14.json", 22, None);
    let claimed = |key: &str| document["entropy"][key].as_str().unwrap().parse::<f64>().unwrap();
    assert!(claimed("per_impact") >= 0.4704 && claimed("per_cycle") >= 1.2166, "{}", document["entropy"]);
    let found = verdict(&document);
    let Some(Verdict::Undecided(Finding { message, .. })) = &found else { panic!("{found:?}") };
    let proved = message.split_once("have an entropy of at least ").and_then(|(_, rest)| rest.split(' ').next());
    assert!(proved.unwrap().parse::<f64>().unwrap() >= 0.4704, "{message}");
}

/// Words of figure 16, whose expansion is slow, from the bases that `chaos` finds: chains of boxes as fine as those of figure 14 are too coarse.
#[test]
#[ignore = "deep: words of up to 20 impacts; by default words_are_confirmed"]
fn r37_long_words_of_figure_16_are_confirmed() {
    let document = chaos_of("figure-16", "tests/bases-figure-16.json", 20, None);
    assert!(document["words"].as_array().unwrap().len() > 40 && is_confirmed(&document), "{:?}", verdict(&document));
}

#[test]
fn corrupted_words_are_refused() {
    refuses_corrupted_words(3, 1);
}

#[test]
#[ignore = "deep: every word of up to 5 impacts; by default corrupted_words_are_refused"]
fn corrupted_longer_words_are_refused() {
    refuses_corrupted_words(5, usize::MAX);
}

/// The first words of the horseshoe to this depth, each changed in each way.
fn refuses_corrupted_words(depth: usize, most: usize) {
    let document = chaos(depth, None);
    assert!(is_confirmed(&document));
    let words = document["words"].as_array().unwrap();
    let edited = |edit: &dyn Fn(&mut Vec<Value>)| {
        let mut copy = document.clone();
        edit(copy["words"].as_array_mut().unwrap());
        copy
    };
    for k in 0..words.len().min(most) {
        let listed = format!("words[{k}]");
        let twice = edited(&|words| words.push(words[k].clone()));
        let left = format!("the {} of {} words that are proved have an entropy", words.len(), words.len() + 1);
        refuses(&twice, &listed, &format!("it is not proved again; {left}"));
        let later = edited(&|words| words[k]["half_cycles"] = json!(words[k]["half_cycles"].as_i64().unwrap() + 2));
        assert!(!is_confirmed(&later), "{listed}");
        let longer = edited(&|words| words[k]["impacts"] = json!(words[k]["impacts"].as_u64().unwrap() + 1));
        refuses(&longer, &listed, "contradicts");
        let other = edited(&|words| {
            let flights = words[k]["flights"].as_str().unwrap();
            let last = if flights.ends_with('F') { "N" } else { "F" };
            words[k]["flights"] = json!(format!("{}{last}", &flights[1..]));
        });
        assert!(!is_confirmed(&other), "{listed}");
    }
    let added = json!({ "from": 0, "to": 1, "impacts": 2, "half_cycles": 2, "flights": "NN" });
    refuses(&edited(&|words| words.push(added.clone())), "a word more", "not proved again");
    let beyond = json!({ "from": 3, "to": 0, "impacts": 2, "half_cycles": 2, "flights": "FF" });
    refuses(&edited(&|words| words.push(beyond.clone())), "a base that is not there", "contradicts");
    let shallow = with(&document, &[("/depth", json!(depth - 2))]);
    refuses(&shallow, "a lower depth", "contradicts");
}

/// A word less is no error, but what does not follow from the others is.
#[test]
fn entropies_follow_from_the_words_that_are_listed() {
    let document = chaos(3, None);
    let mut fewer = document.clone();
    fewer["words"].as_array_mut().unwrap().retain(|word| word["flights"] != "FF");
    refuses(&fewer, "words without FF", "does not follow");
    // By the renewal equation 1 = x^2 + x^3 an impact and 1 = 2 x^2 a half cycle: these digits are of the roots, rounded down and up.
    for (key, below, above) in [
        ("per_impact", "0.28119957432296184", "0.28119957432296185"),
        ("per_cycle", "0.693147180559945309417", "0.693147180559945309418"),
    ] {
        let claimed = |digits: &str| with(&document, &[(&format!("/entropy/{key}"), json!(digits))]);
        assert!(is_confirmed(&claimed(below)), "{key}: {:?}", verdict(&claimed(below)));
        refuses(&claimed(above), key, "does not follow");
    }
    let none = json!({ "per_impact": "0", "per_cycle": "0" });
    refuses(&with(&document, &[("/entropy", none)]), "no entropy", "gives none");
    let named = document["horseshoe"].as_str().unwrap();
    for (old, new) in [
        ("P1 P2 P4", "P1 P2 P3"),
        ("P1 P2 P4 (2", "P1 P2 P4 (4"),
        (", in any order", ""),
        (" in the map mirrored to one wall", ""),
    ] {
        refuses(&with(&document, &[("/horseshoe", json!(named.replace(old, new)))]), new, "horseshoe");
    }
    refuses(&with(&document, &[("/horseshoe", json!(null))]), "no horseshoe", "horseshoe");
}

#[test]
fn another_h_set_is_refused() {
    refuses_others(&[0], &[[0.0, 0.02]], &[]);
}

/// Tubes with room for so little have none for a hundredth.
#[test]
#[ignore = "deep: words over a range of gaps a hundred times as wide; by default another_h_set_is_refused"]
fn a_wider_range_is_refused() {
    let over = chaos(3, Some("gap=9.42477..9.42498"));
    refuses(&with(&over, &[("/over/high", json!("9.5192"))]), "over", "not proved again");
}

#[test]
#[ignore = "deep: two more bases, two more shifts, three pairs; by default another_h_set_is_refused"]
fn h_sets_moved_otherwise_and_pairs_on_either_side_are_refused() {
    let pairs = [("gap", "9.42497 * 1.01"), ("gap", "9.42497 * 0.99"), ("restitution", "0.505")];
    refuses_others(&[0, 2], &[[0.0, 0.02], [0.0, -0.02], [0.1, 0.0]], &pairs);
}

/// The words of figure 14 from bases moved so, and of pairs with these values.
fn refuses_others(bases: &[usize], shifts: &[[f64; 2]], pairs: &[(&str, &str)]) {
    let document = chaos(3, None);
    let moves = bases.iter().flat_map(|&k| shifts.iter().map(move |by| (k, by, true)));
    // No word leads to base 1: where it is moved there may well be the same words.
    for (k, by, both) in moves.chain([(1, &shifts[0], false)]) {
        let mut moved = document.clone();
        let base = &mut moved["bases"][k];
        for edge in ["left", "right"] {
            for corner in base["corners"][edge].as_array_mut().unwrap() {
                *corner = json!([0, 1].map(|i| corner[i].as_f64().unwrap() + by[i]));
            }
        }
        if both {
            let at = |key: &str| base[key].as_str().unwrap().parse::<f64>().unwrap();
            let (phase, speed) = (at("phase") + by[0] * TAU, at("speed") + by[1]);
            (base["phase"], base["speed"]) = (json!(phase.to_string()), json!(speed.to_string()));
        }
        refuses(&moved, &format!("base {k} moved by {by:?}"), if both { "not proved" } else { "middle" });
    }
    let mut twice = document.clone();
    twice["bases"][1] = twice["bases"][0].clone();
    refuses(&twice, "one base twice", "disjoint");
    let mut turned = document.clone();
    let corners = turned["bases"][2]["corners"].take();
    turned["bases"][2]["corners"] = json!({ "left": corners["right"], "right": corners["left"] });
    refuses(&turned, "left is right", "convex");
    for (key, value) in pairs {
        refuses(&with(&document, &[(&format!("/scene/{key}"), json!(value))]), key, "not proved again");
    }
}

#[test]
fn regions_are_confirmed() {
    for name in ["figure-14", "figure-17", "figure-12"] {
        let document = trap(name);
        assert!(is_confirmed(&document), "{name}: {:?}", verdict(&document));
    }
}

/// Boxes of 1/256 of a forcing period and 1/32 of `A W` that the orbit of figure 14 is in from its third impact on.
fn reached() -> Vec<[i64; 2]> {
    let scene = figure("figure-14");
    let settings = Settings { impacts: Some(30), ..Settings::default() };
    let document = json!(document::orbit(scene.pair(), scene.start(), settings).unwrap());
    let box_of = |event: &Value| {
        let middle = |key: &str| -> f64 {
            (0..2).map(|end| 0.5 * event[key][end].as_str().unwrap().parse::<f64>().unwrap()).sum()
        };
        // W is pi, A is 8, and what is on the right wall is mirrored.
        let phase = 0.5 * middle("time") + if event["wall"] == "right" { 0.5 } else { 0.0 };
        let speed = middle("velocity").abs() / (8.0 * PI);
        [(256.0 * phase.rem_euclid(1.0)).floor() as i64, (32.0 * speed).floor() as i64]
    };
    let all = document["events"].as_array().unwrap().iter().skip(2).map(box_of);
    all.collect::<BTreeSet<_>>().into_iter().collect()
}

#[test]
fn corrupted_regions_are_refused() {
    let document = trap("figure-14");
    let runs = document["region"].as_array().unwrap();
    // A box less in which the scene's own orbit is, with the number of boxes told right.
    for reached in reached() {
        let mut fewer = document.clone();
        fewer["boxes"] = json!(document["boxes"].as_u64().unwrap() - 1);
        let split = |run: &Value| {
            let [column, first, last] = [0, 1, 2].map(|i| run[i].as_i64().unwrap());
            let is_it = column == reached[0] && (first..=last).contains(&reached[1]);
            let parts = if is_it { [[first, reached[1] - 1], [reached[1] + 1, last]] } else { [[first, last], [1, 0]] };
            parts
                .into_iter()
                .filter(|[first, last]| first <= last)
                .map(move |[first, last]| json!([column, first, last]))
        };
        fewer["region"] = runs.iter().flat_map(split).collect();
        refuses(&fewer, &format!("without {reached:?}"), "leaves");
    }
    let number = |path: &str| document.pointer(path).unwrap().as_str().unwrap().parse::<f64>().unwrap();
    let times = |path: &str, factor: f64| with(&document, &[(path, json!((number(path) * factor).to_string()))]);
    for (path, factor) in [
        ("/longest_flight", 0.9),
        ("/flight/0", 1.1),
        ("/flight/1", 0.9),
        ("/flight_time/0", 1.1),
        ("/flight_time/1", 0.9),
        ("/speed/1", 0.99),
        ("/speed_before/1", 0.99),
    ] {
        refuses(&times(path, factor), path, "not proved");
    }
    refuses(&with(&document, &[("/speed/0", json!("0.01"))]), "speed", "not proved");
    let boxes = document["boxes"].as_u64().unwrap();
    for claimed in [boxes - 1, boxes + 1] {
        refuses(&with(&document, &[("/boxes", json!(claimed))]), "boxes", "number of boxes");
    }
    let first = runs[0].clone();
    let mut twice = with(&document, &[("/boxes", json!(boxes + 2))]);
    twice["region"].as_array_mut().unwrap().push(first);
    refuses(&twice, "a run twice", "twice");
    let entered = document["entered_at_impact"].as_u64().unwrap();
    for impact in 0..entered {
        refuses(&with(&document, &[("/entered_at_impact", json!(impact))]), "entered", "entered_at_impact");
    }
    for (key, value) in [("gap", "9.42497 * 1.01"), ("restitution", "0.505")] {
        refuses(&with(&document, &[(&format!("/scene/{key}"), json!(value))]), key, "leaves");
    }
}

/// V11: once an impact is in the region all later ones are; and what is not proved with the work allowed is undecided, however far off.
#[test]
fn r32_a_far_impact_in_a_region_is_bounded() {
    let far = with(&trap("figure-14"), &[("/entered_at_impact", json!(1_000_000_000_000_000u64))]);
    assert!(is_confirmed(&far), "{:?}", verdict(&far));
    let little = Effort { work: 1 << 8, ..Effort::default() };
    let found = Claims::parse(&far.to_string()).unwrap().check_within(&little, &Unwatched).unwrap();
    assert!(
        matches!(&found, Verdict::Undecided(finding) if finding.message.contains("entered_at_impact")),
        "{found:?}"
    );
}

/// A ball that is hardly thrown on a pressed wall rests: no set with such a state is closed without a rest.
#[test]
fn a_region_in_which_a_ball_rests_is_refused() {
    let all: Vec<[i32; 3]> = (0..64).map(|column| [column, 0, 63]).collect();
    let document = trap("figure-14");
    let changes = [("/columns", json!(64)), ("/rows", json!(8)), ("/boxes", json!(64 * 64)), ("/region", json!(all))];
    let document = with(&document, &changes);
    refuses(&document, "all states", "rest");
}

#[test]
fn a_stopped_check_reports_its_progress() {
    let claims = Claims::parse(&chaos(6, None).to_string()).unwrap();
    let stop = |at: Stage<'_>| proceed_if(!matches!(at, Stage::Claims(6..)));
    let found = claims.check_within(&Effort::default(), &stop).unwrap();
    assert!(matches!(found, Verdict::Interrupted { events } if events >= 6), "{found:?}");
}
