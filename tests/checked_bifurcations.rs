//! Bifurcation JSONs: those that are computed are confirmed by `check`, and nothing else.

use crate::effort::effort;
use impact_pair::Scene;
use impact_pair::document;
use impact_pair::exact::{Exact, decimal_bounds};
use impact_pair::periodic::Precision;
use impact_pair::periodic::bifurcation::{DiagramSettings, survey};
use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Claims, Verdict};
use serde_json::{Value, json};

fn bifurcations(over: &str, doublings: u32, digits: u32) -> Value {
    under("amplitude = 0.36, frequency = \"pi\", phase = 0.25", 1, over, (doublings, digits))
}

fn under(excitation: &str, cycles: u32, over: &str, (doublings, digits): (u32, u32)) -> Value {
    let scene = format!(
        r#"
        excitation = {{ {excitation} }}
        pair = {{ gap = 1, restitution = 0.8 }}
        start = {{ time = 0, wall = "left", velocity = -1 }}"#
    );
    let scene = Scene::parse(&scene).unwrap();
    let precision = Precision { digits, ..Precision::default() };
    let diagram_settings = DiagramSettings { over: over.parse().unwrap(), doublings, precision };
    let requested = (&"RL".parse().unwrap(), cycles);
    let diagram = survey(scene.pair(), scene.start(), requested, &diagram_settings, &Unwatched).unwrap();
    json!(document::bifurcations(scene.start(), requested, &diagram).unwrap())
}

fn kinds(document: &Value) -> Vec<&str> {
    document["points"].as_array().unwrap().iter().map(|point| point["kind"].as_str().unwrap()).collect()
}

fn claims(document: &Value) -> Claims {
    Claims::parse(&document.to_string()).unwrap()
}

fn verdict(document: &Value) -> Verdict {
    claims(document).check_within(&effort(), &Unwatched).unwrap()
}

fn assert_confirmed(document: &Value) {
    assert!(matches!(verdict(document), Verdict::Confirmed { .. }), "{:?}", verdict(document));
}

/// Bounds next to these, which hold another number if these hold one.
fn beside(bounds: &Value, steps: &str) -> Value {
    let [lower, upper] = [0, 1].map(|end| bounds[end].as_str().unwrap());
    let moved = |end: &str| format!("{end} + ({steps}) * ({upper} - ({lower}) + 1e-60)").parse::<Exact>().unwrap();
    json!([decimal_bounds(&moved(lower).enclose(400))[0], decimal_bounds(&moved(upper).enclose(400))[1]])
}

/// The closed forms of the fold and the pitchfork (Lemmas W2, W4), and the cascade.
#[test]
fn r17_folds_pitchforks_and_doublings_are_confirmed() {
    let document = bifurcations("amplitude=0.03..0.499", 2, 20);
    assert_eq!(kinds(&document), ["fold", "pitchfork", "period-doubling", "period-doubling"]);
    assert_confirmed(&document);
    let expected = [
        "branches",
        "over.high",
        "over.low",
        "points.orbit.unique",
        "program",
        "scene.excitation.amplitude",
        "scene.start",
    ];
    assert_eq!(claims(&document).unjudged(), expected);
    assert_confirmed(&bifurcations("pair.gap=0.75..1.1", 1, 9));
    assert_confirmed(&bifurcations("restitution=0.6..0.7", 0, 40));
}

#[test]
fn r17_no_bifurcation_that_is_changed_is_confirmed() {
    let document = bifurcations("amplitude=0.03..0.48", 1, 12);
    assert_eq!(kinds(&document), ["fold", "pitchfork", "period-doubling"]);
    assert_eq!(corrupted(&document, ("/scene/excitation/frequency/0", "3.1416")), 3 * (2 * 9 + 2 + 7 + 6));
}

/// Those of two tones, with and without a mirror, over each parameter; and those of terms in step, of which one is varied.
#[test]
fn bifurcations_of_several_harmonics_are_confirmed_and_none_that_is_changed() {
    let [even, odd] = [("2*pi", "0.25"), ("3*pi", "0")].map(|(second, phase)| {
        format!("amplitude = [0.36, 0.02], frequency = [\"pi\", \"{second}\"], phase = [{phase}, 0.4]")
    });
    for (excitation, cycles, over) in [(&even, 2, "restitution=0.55..0.6"), (&odd, 3, "gap=0.77..0.9")] {
        let document = under(excitation, cycles, over, (1, 9));
        assert!(!kinds(&document).is_empty(), "{over}");
        assert_confirmed(&document);
    }
    let step = "amplitude = [0.1, 0.1], frequency = [\"pi\", \"pi\"], phase = [0.25, 0.25]";
    let document = under(step, 1, "amplitude.2=0.2..0.3", (0, 9));
    assert_eq!(kinds(&document), ["pitchfork"]);
    assert_confirmed(&document);
    assert!(claims(&document).unjudged().contains(&"scene.excitation.amplitude[1]".to_owned()));
    let document = under(&odd, 3, "amplitude.1=0.03..0.05", (0, 12));
    assert_eq!(kinds(&document), ["fold"]);
    assert_eq!(corrupted(&document, ("/scene/excitation/amplitude/1", "0.020001")), 2 * 9 + 2 + 7 + 6);
}

/// Judges documents in which one thing is changed, point by point; how many.
fn corrupted(document: &Value, (path, value): (&str, &str)) -> u32 {
    let mut tried = 0;
    for (i, kind) in kinds(document).into_iter().enumerate() {
        // Each point alone, so that what is wrong stands alone.
        let mut alone = document.clone();
        alone["points"] = json!([document["points"][i]]);
        assert_confirmed(&alone);
        let bounds = [
            "/parameter",
            "/orbit/impacts/0/phase",
            "/orbit/impacts/1/phase",
            "/orbit/impacts/0/velocity",
            "/orbit/impacts/1/velocity",
            "/orbit/trace",
            "/orbit/determinant",
            "/orbit/eigenvalues/0/re",
            "/orbit/eigenvalues/1/re",
        ];
        let point = &document["points"][i];
        let mut changes: Vec<(String, Value)> = Vec::new();
        for path in bounds {
            // A whole width and more to either side.
            changes.extend(["-1.5", "1.5"].map(|steps| (path.to_owned(), beside(point.pointer(path).unwrap(), steps))));
        }
        let others = ["fold", "pitchfork", "period-doubling"].into_iter().filter(|other| *other != kind);
        changes.extend(others.map(|other| ("/kind".to_owned(), json!(other))));
        let is_symmetric = point["orbit"]["symmetric"].as_bool().unwrap();
        for (path, value) in [
            ("/orbit/symmetric", json!(!is_symmetric)),
            ("/orbit/physical", json!(false)),
            ("/orbit/stability", json!("stable")),
            ("/orbit/stability", json!("unstable")),
            ("/cycles", json!(6)),
            ("/doublings", json!(4)),
            ("/word", json!("P1 P2")),
        ] {
            changes.push((path.to_owned(), value));
        }
        let mut judge = |path: &str, value: Value| {
            let mut copy = alone.clone();
            *copy.pointer_mut(path).expect(path) = value;
            assert!(!matches!(verdict(&copy), Verdict::Confirmed { .. }), "{kind}: {path}: {copy}");
            tried += 1;
        };
        for (path, value) in changes {
            judge(&format!("/points/0{path}"), value);
        }
        judge("/scene/gap", json!("1.00001"));
        judge("/scene/restitution", json!("0.80001"));
        judge(path, json!(value));
        judge("/over/key", json!("pair.gap"));
        judge("/over/key", json!("pair.restitution"));
        judge("/cycles", json!(2));
    }
    tried
}

/// A bifurcation over the gap is none over the frequency.
#[test]
fn no_bifurcation_over_the_frequency_is_confirmed() {
    let mut document = bifurcations("pair.gap=1.02..1.1", 0, 9);
    assert_confirmed(&document);
    document["over"]["key"] = json!("excitation.frequency");
    assert!(matches!(verdict(&document), Verdict::Refuted(_)));
    document["over"]["key"] = json!("gap");
    assert!(Claims::parse(&document.to_string()).is_err());
}

#[test]
fn r17_a_document_that_contradicts_itself_is_refuted() {
    let document = bifurcations("amplitude=0.03..0.04", 0, 9);
    let refuted = |edit: fn(&mut Value)| {
        let mut copy = document.clone();
        edit(&mut copy);
        matches!(verdict(&copy), Verdict::Refuted(_))
    };
    assert!(refuted(|copy| copy["undecided"] = json!([{"kind": "graze", "near": 0.3, "word": "P2 P1"}])));
    assert!(refuted(|copy| copy["points"][0]["orbit"]["physical"] = Value::Null));
    assert!(refuted(|copy| copy["branches"][0]["ends"][0] = json!("lost")));
    // With no bifurcation but grazes nothing is proved.
    let mut none = document.clone();
    none["points"][0]["kind"] = json!("graze");
    assert!(matches!(verdict(&none), Verdict::Undecided(_)));
    assert!(claims(&none).unjudged().contains(&"points[0]".to_owned()));
}

/// At the lower end of the bounds, 0, the second harmonic vanishes: what bifurcates under the first one alone does not for any other value of them.
/// The fold is that of the closed form (Lemma W2), `A_sn = 1/sqrt(4 + 81 pi^2)`.
#[test]
fn r32_a_harmonic_that_vanishes_at_an_end_of_the_bounds_is_not_left_out() {
    let alone = bifurcations("amplitude=0.03..0.04", 0, 12);
    assert_eq!(kinds(&alone), ["fold"]);
    assert_confirmed(&alone);
    let fold = 1.0 / (4.0 + 81.0 * std::f64::consts::PI.powi(2)).sqrt();
    // No common period, a common one, and one of a forcing period; bounds from and around 0.
    for frequency in ["sqrt(2)*pi", "2*pi", "pi/2"] {
        for lower in ["0", "-0.01", "-0.010559228503146"] {
            let mut document = alone.clone();
            document["scene"]["excitation"] =
                json!({ "amplitude": ["0.03", "0.001"], "frequency": ["pi", frequency], "phase": ["0.25", "0"] });
            document["over"]["key"] = json!("excitation.amplitude.2");
            let upper = format!("{:.15}", 2.0 * (fold - 0.03) + lower.parse::<f64>().unwrap().abs());
            document["points"][0]["parameter"] = json!([lower, upper]);
            assert!(!matches!(verdict(&document), Verdict::Confirmed { .. }), "{frequency}: {lower}");
        }
    }
}

/// Of a fold on the branch of symmetric orbits, and of a doubling beyond the pitchfork: whatever is said of first contacts, nothing else than the
/// truth is confirmed of the mirror image.
#[test]
fn r32_symmetry_is_checked_independently_of_first_contacts() {
    let document = bifurcations("amplitude=0.03..0.48", 1, 12);
    for (i, kind) in kinds(&document).into_iter().enumerate() {
        let is_symmetric = document["points"][i]["orbit"]["symmetric"].as_bool().unwrap();
        assert_eq!(is_symmetric, kind != "period-doubling");
        for (physical, certified) in [(json!(true), true), (Value::Null, false)] {
            let said = |symmetric: bool| {
                let mut copy = document.clone();
                copy["points"] = json!([document["points"][i]]);
                copy["certified"] = json!(certified);
                copy["points"][0]["orbit"]["physical"] = physical.clone();
                copy["points"][0]["orbit"]["symmetric"] = json!(symmetric);
                verdict(&copy)
            };
            assert!(matches!(said(is_symmetric), Verdict::Confirmed { .. }), "{kind}: {physical}");
            assert!(!matches!(said(!is_symmetric), Verdict::Confirmed { .. }), "{kind}: {physical}");
        }
    }
}

/// One bifurcation listed twice is not two; nor is a graze, though it is not proved again.
#[test]
fn r32_a_bifurcation_listed_twice_is_not_two() {
    let with_graze = bifurcations("amplitude=0.3..0.55", 1, 9);
    assert!(kinds(&with_graze).contains(&"graze"), "{:?}", kinds(&with_graze));
    for document in [bifurcations("amplitude=0.03..0.48", 1, 12), with_graze] {
        assert_confirmed(&document);
        for i in 0..kinds(&document).len() {
            let mut copy = document.clone();
            copy["points"].as_array_mut().unwrap().push(document["points"][i].clone());
            assert!(matches!(verdict(&copy), Verdict::Undecided(_)), "{:?}", verdict(&copy));
        }
    }
}
