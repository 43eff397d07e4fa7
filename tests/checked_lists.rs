//! Lists of orbits: what `check` proves of cycles with their counts, and that none is listed twice.

use crate::checked_documents::{SCENE, is_confirmed, judged, two_impact, verdict};
use crate::effort::effort;
use impact_pair::Scene;
use impact_pair::chaos::Cycles;
use impact_pair::document;
use impact_pair::periodic::{Precision, Problem};
use impact_pair::units::Units;
use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Claims, Verdict};
use serde_json::{Value, json};

/// All cycles of figure 14 with one to four impacts.
fn cycles() -> Value {
    let scene = Scene::parse(&SCENE.replace("phase = 0.1", "phase = 0")).unwrap();
    let found = Cycles::of(&scene, 0, &(1..=4), Precision::default(), &Unwatched).unwrap();
    json!(document::cycles(&scene, &(1..=4), found.as_ref().map_err(|why| *why)).unwrap())
}

/// By Lemma D23 the fixed points of `n` impacts are those of the cycles whose least number divides `n`: a document that says otherwise of
/// its own orbits contradicts itself.
#[test]
fn r32_cycles_whose_counts_are_not_those_of_their_orbits_are_refuted() {
    let document = cycles();
    let judged =
        |document: &Value| Claims::parse(&document.to_string()).unwrap().check_within(&effort(), &Unwatched).unwrap();
    assert!(matches!(judged(&document), Verdict::Confirmed { .. }), "{:?} {document}", judged(&document));
    let named = Claims::parse(&document.to_string()).unwrap().unjudged();
    for key in ["certified", "exhaustive", "fixed_points", "impacts", "no_attractor"] {
        assert!(named.contains(&key.to_owned()), "{key}: {named:?}");
    }
    let orbits = document["orbits"].as_array().unwrap();
    for left_out in 0..orbits.len() {
        let mut copy = document.clone();
        copy["orbits"].as_array_mut().unwrap().remove(left_out);
        assert!(matches!(judged(&copy), Verdict::Refuted(_)), "{left_out}: {:?}", judged(&copy));
    }
    for (path, value) in [
        ("/impacts", json!([1, 5])),
        ("/fixed_points/3", json!(1)),
        ("/fixed_points/4", json!(4)),
        ("/exhaustive", json!(false)),
        ("/orbits/0/reduced_impacts", json!(2)),
        ("/orbits/1/reduced_impacts", json!(1)),
    ] {
        let mut copy = document.clone();
        *copy.pointer_mut(path).expect(path) = value;
        assert!(matches!(judged(&copy), Verdict::Refuted(_)), "{path}: {:?}", judged(&copy));
    }
    // One listed twice, with counts that are those of the list.
    let fixed = orbits.iter().position(|orbit| orbit["reduced_impacts"] == 1).unwrap();
    let mut twice = document.clone();
    let first = twice["orbits"][fixed].clone();
    twice["orbits"].as_array_mut().unwrap().push(first);
    for n in ["1", "2", "3", "4"] {
        twice["fixed_points"][n] = json!(twice["fixed_points"][n].as_u64().unwrap() + 1);
    }
    assert!(!matches!(judged(&twice), Verdict::Confirmed { .. }), "{:?}", judged(&twice));
}

/// All orbits of the word LR in a cycle beyond the pitchfork (Lemma W4), `A/d = 0.36` and `e = 0.8`: two symmetric ones, and two that are mirror
/// images of each other.
fn four_orbits() -> Value {
    let scene = r#"
        excitation = { amplitude = 0.36, frequency = "pi", phase = 0.25 }
        pair = { gap = 1, restitution = 0.8 }
        start = { time = 0, wall = "left", velocity = -1 }"#;
    let scene = Scene::parse(scene).unwrap();
    let problem = Problem::new(scene.pair(), &"LR".parse().unwrap(), 1).unwrap();
    let census = problem.find(scene.start(), Precision::default());
    json!(Units::gaps(scene.pair()).unwrap().document(&problem, scene.start(), &census))
}

/// The document with one of its orbits at the end as well.
fn with_one_twice(document: &Value, i: usize) -> Value {
    let mut copy = document.clone();
    copy["orbits"].as_array_mut().unwrap().push(document["orbits"][i].clone());
    copy
}

/// Of the values of the second amplitude 0 is one: of this one the orbits are their own mirror images, of no other one they are.
#[test]
fn r39_where_a_harmonic_may_vanish_orbits_may_be_symmetric() {
    let found = |second: &str, cycles: u32| {
        let scene = Scene::parse(&format!(
            "excitation = {{ amplitude = [1, \"{second}\"], frequency = [\"pi\", \"2*pi\"], phase = 0 }}\n\
             pair = {{ gap = 9.42497, restitution = 0.5 }}\nstart = {{ time = 0, wall = \"left\", velocity = -12 }}"
        ));
        let scene = scene.unwrap();
        let problem = Problem::new(scene.pair(), &"P1 P2".parse().unwrap(), cycles).unwrap();
        let census = problem.find(scene.start(), Precision::default());
        json!(Units::gaps(scene.pair()).unwrap().document(&problem, scene.start(), &census))
    };
    let judged = |(second, cycles, truth): (&str, u32, Value)| {
        let document = found(second, cycles);
        let orbits = document["orbits"].as_array().unwrap();
        assert!(orbits.len() == 2 && orbits.iter().all(|orbit| orbit["symmetric"] == truth), "{second}: {document}");
        document
    };
    let cases = [("0", 1, json!(true)), ("1e-6", 2, json!(false)), ("[0, 1e-6]", 2, json!(null))];
    let [_, _, mut document] = cases.map(judged);
    document["orbits"].as_array_mut().unwrap().truncate(1);
    assert!(is_confirmed(&[document.clone()]), "{:?}", verdict(&[document]));
    for said in [true, false] {
        document["orbits"][0]["symmetric"] = json!(said);
        assert!(matches!(verdict(&[document.clone()]), Verdict::Undecided(_)), "{said}");
    }
}

/// Harmonics of one frequency cancel: the box moves as with the first harmonic alone, under which the same orbits are their own mirror images.
#[test]
fn r44_where_harmonics_cancel_orbits_may_be_symmetric() {
    let found = |excitation: &str, cycles: u32| {
        let scene = Scene::parse(&format!(
            "excitation = {{ {excitation} }}\npair = {{ gap = 9.42497, restitution = 0.5 }}\n\
             start = {{ time = 0, wall = \"left\", velocity = -12 }}"
        ));
        let scene = scene.unwrap();
        let problem = Problem::new(scene.pair(), &"P1 P2".parse().unwrap(), cycles).unwrap();
        let census = problem.find(scene.start(), Precision::default());
        json!(Units::gaps(scene.pair()).unwrap().document(&problem, scene.start(), &census))
    };
    let symmetric = |document: &Value| -> Vec<Value> {
        document["orbits"].as_array().unwrap().iter().map(|orbit| orbit["symmetric"].clone()).collect()
    };
    let alone = found("amplitude = 1, frequency = \"pi\", phase = 0", 1);
    assert_eq!(symmetric(&alone), [true, true]);
    let cancelled = "amplitude = 1, frequency = [\"pi\", \"2*pi\", \"2*pi\"], phase = [0, 0, \"pi\"]";
    let mut document = found(&cancelled.replace("= 1,", "= [1, 1, 1],"), 2);
    assert_eq!(symmetric(&document), [json!(null), json!(null)]);
    document["orbits"].as_array_mut().unwrap().truncate(1);
    assert!(is_confirmed(&[document.clone()]), "{:?}", verdict(&[document]));
    document["orbits"][0]["symmetric"] = json!(false);
    assert!(matches!(verdict(&[document]), Verdict::Undecided(_)));
}

#[test]
fn r32_an_orbit_listed_twice_is_not_two() {
    for document in [four_orbits(), two_impact(3)] {
        assert!(matches!(judged(&document), Verdict::Confirmed { .. }), "{:?}", judged(&document));
        for i in 0..document["orbits"].as_array().unwrap().len() {
            let twice = judged(&with_one_twice(&document, i));
            match document["orbits"][i]["physical"] == true {
                true => assert!(matches!(twice, Verdict::Refuted(_)), "{i}: {twice:?}"),
                false => assert!(matches!(twice, Verdict::Undecided(_)), "{i}: {twice:?}"),
            }
        }
    }
}

/// An orbit with bounds wider than requested is the same orbit.
#[test]
fn r32_an_orbit_in_wider_bounds_is_not_another_one() {
    let document = four_orbits();
    let mut copy = with_one_twice(&document, 0);
    let last = copy["orbits"].as_array().unwrap().len() - 1;
    for impact in copy["orbits"][last]["impacts"].as_array_mut().unwrap() {
        for (key, end, by) in
            [("phase", 0, "-1e-9"), ("phase", 1, "1e-9"), ("velocity", 0, "-1e-9"), ("velocity", 1, "1e-9")]
        {
            let moved = format!("{} + ({by})", impact[key][end].as_str().unwrap());
            let moved =
                impact_pair::exact::decimal_bounds(&moved.parse::<impact_pair::exact::Exact>().unwrap().enclose(200));
            impact[key][end] = json!(moved[end]);
        }
    }
    assert!(matches!(judged(&copy), Verdict::Refuted(_)), "{:?}", judged(&copy));
}

/// Of cycles, a motion and its mirror image are one.
#[test]
fn r32_a_cycle_listed_with_its_mirror_image_is_not_two() {
    let document = four_orbits();
    let symmetric = |i: &usize| document["orbits"][*i]["symmetric"] == true;
    let cycles = |chosen: &[usize]| {
        let cycle = |&i: &usize| {
            let mut cycle = document["orbits"][i].clone();
            cycle["reduced_impacts"] = json!(if symmetric(&i) { 1 } else { 2 });
            cycle["word"] = document["word"].clone();
            cycle["cycles"] = document["cycles"].clone();
            cycle
        };
        // Lemma D23.
        let ones = chosen.iter().filter(|i| symmetric(i)).count();
        json!({
            "schema": "impact-pair/cycles/1", "program": "none", "certified": true, "exhaustive": true, "scene": document["scene"],
            "boxes": 1, "impacts": [1, 2], "fixed_points": {"1": ones, "2": 2 * chosen.len() - ones}, "no_attractor": false,
            "orbits": chosen.iter().map(cycle).collect::<Vec<_>>(),
        })
    };
    let count = document["orbits"].as_array().unwrap().len();
    let (own, others): (Vec<usize>, Vec<usize>) = (0..count).partition(symmetric);
    assert_eq!((own.len(), others.len()), (2, 2));
    assert!(matches!(judged(&cycles(&[own[0], own[1], others[0]])), Verdict::Confirmed { .. }));
    assert!(matches!(judged(&cycles(&others)), Verdict::Undecided(_)));
    assert!(matches!(judged(&cycles(&[own[0], own[0]])), Verdict::Refuted(_)));
    // That none is left out is not judged, and named.
    let claims = Claims::parse(&cycles(&own).to_string()).unwrap();
    assert!(claims.unjudged().iter().any(|key| key == "certified"), "{:?}", claims.unjudged());
}
