//! Tangencies that no producer of this project found: Newton's iteration of another program in 120 digits did.

use impact_pair_certificate::{Claims, Effort, Verdict};
use impact_pair_model::watch::Unwatched;
use serde_json::{Value, json};

const DOCUMENT: &str = include_str!("documents/tangency.jsonl");

/// The verdict on the document with other values at these pointers into its tangency.
fn judged(changes: &[(&str, Value)]) -> Verdict {
    let mut document: Value = serde_json::from_str(DOCUMENT).unwrap();
    for (pointer, value) in changes {
        *document.pointer_mut(&format!("/tangencies/0{pointer}")).unwrap() = value.clone();
    }
    Claims::parse(&document.to_string()).unwrap().check_within(&Effort::default(), &Unwatched).unwrap()
}

fn message(verdict: Verdict) -> String {
    match verdict {
        Verdict::Refuted(finding) => format!("refuted: {}", finding.message),
        Verdict::Undecided(finding) => format!("undecided: {}", finding.message),
        other => format!("{other:?}"),
    }
}

/// Phases count modulo 2 pi, and bounds may be wide: of numbers, and of the parameter as long as there is one tangency only.
#[test]
fn the_tangency_beside_figure_14_is_confirmed_within_wide_bounds() {
    let wide = [
        ("/saddle/phase", json!(["-1.2392", "-1.2390"])),
        ("/unfolding", json!(["-807", "-806"])),
        ("/parameter", json!(["9.425126376", "9.425126377"])),
        ("/unstable", json!(["0.001036717798", "0.001036717799"])),
        ("/stable", json!(["0.000108179847", "0.000108179848"])),
    ];
    let verdict = judged(&wide);
    assert!(matches!(verdict, Verdict::Confirmed { .. }), "{verdict:?}");
}

/// One tangency listed twice, the second time with a flight of the unstable manifold more, is one.
#[test]
fn r42_a_tangency_is_listed_once() {
    let mut document: Value = serde_json::from_str(DOCUMENT).unwrap();
    let mut again = document["tangencies"][0].clone();
    // sigma_u over the unstable eigenvalue, -2.3124365279...; q is another one, and the bounds of the parameter are the same.
    again["flights"] = json!("FFFFFFFFNFFFFFNFFNFFNFFFF");
    again["unstable"] = json!(["-0.000448322705", "-0.000448322704"]);
    document["tangencies"].as_array_mut().unwrap().push(again);
    let verdict = Claims::parse(&document.to_string()).unwrap().check_within(&Effort::default(), &Unwatched).unwrap();
    assert_eq!(message(verdict), "undecided: two tangencies may be one");
}

#[test]
fn another_saddle_another_word_and_exchanged_eigenvalues_are_refuted() {
    let shifted = json!(["9.425127376887204948431988399546", "9.425127376887204948431988399549"]);
    assert_eq!(message(judged(&[("/parameter", shifted)])), "refuted: no fixed point has this phase");
    let exchanged = json!([["-0.1082", "-0.1081"], ["-2.3125", "-2.3124"]]);
    let found = message(judged(&[("/saddle/eigenvalues", exchanged)]));
    assert!(found.starts_with("refuted: the true unstable eigenvalue is -2.3124365279"), "{found}");
    let found = message(judged(&[("/flights", json!("FFFFFFFNFFFFFNFFNFFNFFFN"))]));
    assert_eq!(found, "refuted: flight 24: a flight ends on the other wall");
}

#[test]
#[ignore = "deep"]
fn bounds_that_hold_no_tangency_and_false_numbers_are_refuted() {
    let shifted = [
        ("/parameter", json!(["9.42512637688720494843198", "9.42512637688720494843199"])),
        ("/unstable", json!(["0.0010367177987693767145451", "0.0010367177987693767145452"])),
    ];
    assert_eq!(message(judged(&shifted)), "refuted: there is no tangency within the bounds");
    assert_eq!(
        message(judged(&[("/flights", json!("FFFFFFFNFFFFFNFFNFFNFFF"))])),
        "refuted: there is no tangency within the bounds"
    );
    let positive = json!(["1158440084.207239054131", "1158440084.207239054134"]);
    let found = message(judged(&[("/quadratic", positive)]));
    assert!(found.starts_with("refuted: the true quadratic coefficient is -1158440084.2072390541"), "{found}");
    let found = message(judged(&[("/least_speed", json!("0.353"))]));
    assert_eq!(found, "refuted: the speed number 20 of the orbit is less than the least one");
}

/// Of these nothing is proved, and so nothing is refuted.
#[test]
fn what_is_not_checked_is_undecided() {
    let found = message(judged(&[("/key", json!("excitation.frequency"))]));
    assert_eq!(found, "undecided: only reduced maps over gap, amplitude and restitution are checked");
    let found = message(judged(&[("/resonances_excluded_to", json!(2000))]));
    assert_eq!(found, "undecided: resonances of orders above 1024 are not checked");
    let wide = [("/parameter", json!(["9.3", "9.5"])), ("/saddle/phase", json!(["5", "5.1"]))];
    let found = message(judged(&wide));
    assert!(found.starts_with("undecided: "), "{found}");
}

/// With the one to the other side of the printed gap, found by the same other program.
#[test]
#[ignore = "deep"]
fn both_tangencies_beside_figure_14_are_confirmed() {
    let text = include_str!("../../../docs/tangency-figure-14.json");
    let claims = Claims::parse(text).unwrap();
    let verdict = claims.check_within(&Effort::default(), &Unwatched).unwrap();
    assert!(matches!(verdict, Verdict::Confirmed { .. }), "{verdict:?}");
    assert_eq!(claims.all(), "2 homoclinic tangencies");
}

/// The tangency over the restitution, at the gap of that of e = 1/2: its numbers are those of the one over the gap, but for the speed of
/// unfolding by e. That one is -m dD*/de, m by D, where D* = 1.17814266031.. and 1.178138934085.. at e = 1/2 -+ 1e-5.
fn over_the_restitution(changes: &[(&str, Value)]) -> Verdict {
    let mut document: Value = serde_json::from_str(DOCUMENT).unwrap();
    document["scene"]["gap"] = json!("8*1.17814079711090061855399854994343000656779766745018");
    let tangency = &mut document["tangencies"][0];
    tangency["key"] = json!("pair.restitution");
    tangency["parameter"] = json!(["0.4999999999999999999999999999", "0.5000000000000000000000000001"]);
    tangency["unstable"] = json!(["0.00103671779876937671453524864", "0.00103671779876937671453524865"]);
    tangency["stable"] = json!(["0.000108179847481761014690377576", "0.000108179847481761014690377577"]);
    tangency["unfolding"] = json!(["-150.1974", "-150.1973"]);
    let [phase, speed] = [["5.0440821019", "5.0440821020"], ["1.3025773114", "1.3025773115"]];
    let eigenvalues = [["-2.312436528", "-2.312436527"], ["-0.108111076", "-0.108111075"]];
    tangency["saddle"] = json!({ "phase": phase, "speed": speed, "eigenvalues": eigenvalues });
    tangency.as_object_mut().unwrap().remove("beside");
    for (pointer, value) in changes {
        *tangency.pointer_mut(pointer).unwrap() = value.clone();
    }
    Claims::parse(&document.to_string()).unwrap().check_within(&Effort::default(), &Unwatched).unwrap()
}

#[test]
fn a_tangency_over_the_restitution_is_confirmed_and_shifted_ones_are_refuted() {
    let verdict = over_the_restitution(&[]);
    assert!(matches!(verdict, Verdict::Confirmed { .. }), "{verdict:?}");
    let per_gap = json!(["-806.1637", "-806.1636"]);
    let found = message(over_the_restitution(&[("/unfolding", per_gap)]));
    assert!(found.starts_with("refuted: the true speed of unfolding is -150.197365"), "{found}");
    let shifted = json!(["0.5000000000000000000000000001", "0.5000000000000000000000000003"]);
    let found = message(over_the_restitution(&[("/parameter", shifted)]));
    assert_eq!(found, "refuted: there is no tangency within the bounds");
}
