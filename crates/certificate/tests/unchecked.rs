//! The first line of `check` names the claims that no lemma of the check covers.

use impact_pair_certificate::{Claims, Effort, Verdict};
use impact_pair_document::CheckDocument;
use impact_pair_model::watch::Unwatched;
use serde_json::{Value, json};

use crate::recorded;

/// The check of a recorded document that a change has made another one.
fn checked(name: &str, change: impl Fn(&mut Value)) -> CheckDocument {
    let (_, mut lines) = recorded::all().into_iter().find(|(own, _)| own == name).expect("a recorded document");
    change(&mut lines[0]);
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    let claims = Claims::parse(&text).unwrap();
    let judged = claims.judge(&Effort::default(), &Unwatched).unwrap();
    assert!(matches!(judged.verdict, Verdict::Confirmed { .. }), "{name}: {:?}", judged.verdict);
    claims.document(&text, &judged)
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

/// The theorem in words stands beside a confirmation alone.
#[test]
fn a_confirmation_is_a_theorem() {
    // The others take the check seconds.
    let slow = ["chaos", "cells", "tangency", "atlas"];
    for (name, lines) in recorded::all().into_iter().filter(|(name, _)| !slow.iter().any(|slow| name.contains(slow))) {
        let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
        let claims = Claims::parse(&text).unwrap();
        let confirmed = claims.judge(&Effort::default(), &Unwatched).unwrap();
        let found = claims.document(&text, &confirmed);
        assert_eq!(
            found.theorem.is_some_and(|theorem| !theorem.is_empty()),
            found.message.starts_with("confirmed"),
            "{name}"
        );
    }
}
