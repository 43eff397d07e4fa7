//! The first line of `check` names the claims that no lemma of the check covers.

use impact_pair_certificate::{Claims, Limits, Verdict};
use impact_pair_document::CheckDocument;
use impact_pair_model::watch::Unwatched;
use serde_json::{Value, json};

use crate::recorded;

/// The check of a recorded document that a change has made another one.
fn checked(name: &str, change: impl Fn(&mut Value)) -> CheckDocument {
    let mut lines = recorded::document(name);
    change(&mut lines[0]);
    let text = recorded::text(&lines);
    let claims = Claims::parse(&text).unwrap();
    let judged = claims.judge(&Limits::default(), &Unwatched).unwrap();
    assert!(matches!(judged.verdict, Verdict::Confirmed { .. }), "{name}: {:?}", judged.verdict);
    claims.document(&judged)
}

fn drop_one(orbits: &mut Value) {
    orbits.as_array_mut().unwrap().pop();
}

/// A false claim that is not checked stands in the first line; the headline of a document without one is another.
#[test]
fn r61_a_false_claim_that_is_not_checked_is_named() {
    let dropped = checked("two impacts", |document| drop_one(&mut document["orbits"]));
    assert_eq!(dropped.unchecked_claims, ["exhaustive"]);
    assert!(dropped.message.starts_with("confirmed, but not: exhaustive"), "{}", dropped.message);

    let exponent = checked("description", |document| document["exponent"]["limit"] = json!(["5", "5"]));
    assert_eq!(exponent.unchecked_claims, ["exponent"]);
    let entropy = checked("description", |document| {
        document["exponent"] = json!({"limit": null, "finite_time": null});
        document["entropy"] = json!({"per_impact": "50", "per_cycle": "50"});
    });
    assert_eq!(entropy.unchecked_claims, ["entropy"]);

    let partial = checked("two impacts", |document| {
        document["exhaustive"] = json!(false);
        document.as_object_mut().unwrap().remove("excludes");
    });
    assert!(partial.unchecked_claims.is_empty() && partial.message.starts_with("confirmed: "), "{}", partial.message);
}

/// Settings are no claims: a document that has nothing else unchecked is confirmed without a reservation.
#[test]
fn settings_are_no_claims() {
    let orbit = checked("count", |document| document["program"] = json!("another"));
    assert!(orbit.unchecked_claims.is_empty() && !orbit.not_checked.is_empty());
    let cycles = checked("cycles", |document| document["boxes"] = json!(7));
    assert_eq!(cycles.unchecked_claims, ["exhaustive", "fixed_points", "no_attractor"]);
}

/// Of a document of subintervals only keys that it has are named, and what the verdict `attracted` is about is not.
#[test]
fn r47_cells_name_what_they_have_and_do_not_use() {
    let document = recorded::document("cells").remove(0);
    assert_eq!(document["stretches"][0]["verdict"], "attracted");
    let unjudged = |document: &Value| Claims::parse(&document.to_string()).unwrap().unjudged();
    assert_eq!(unjudged(&document), ["cells", "depth", "halvings", "program", "scene.excitation.amplitude"]);
    let mut stable = document.clone();
    stable["stretches"][0]["verdict"] = json!("stable");
    stable["interrupted"] = json!(true);
    let named = unjudged(&stable);
    for key in ["interrupted", "scene.start", "scene.excitation.phase", "scene.excitation.frequency"] {
        assert!(named.iter().any(|own| own == key), "{key}: {named:?}");
    }
}
