//! Claims of components, windows and subintervals that were confirmed, though nothing judged them.

use impact_pair_certificate::{Claims, Effort};
use impact_pair_document::{CheckDocument, VerdictName};
use impact_pair_model::watch::Unwatched;
use serde_json::{Value, json};

use crate::globals::{atlas_of, checked, open, pair, recorded, with};

fn is_named(found: &CheckDocument, path: &str) -> bool {
    found.not_checked.iter().any(|own| own == path)
}

fn grazing() -> Value {
    json!({ "kind": "grazing", "boxes": 3, "area": "0.000001", "closed": false })
}

/// From `W t + tau = pi/2` the ball that grazes rises to 2 A: where the gap is less it meets the far wall, and does not graze again. Lemma A9
#[test]
fn r47_no_motion_grazes_for_ever_below_a_gap_of_two_amplitudes() {
    let of = |gap: &str, components: &[&Value]| checked(&with(&pair(gap, "0.2"), "undecided", components));
    assert_eq!(of("1.9999", &[&grazing(), &open(false)]).verdict, VerdictName::Refuted);
    let grazes = of("2", &[&grazing(), &open(false)]);
    assert!(grazes.verdict == VerdictName::Confirmed && !is_named(&grazes, "components[0].kind"), "{}", grazes.message);
    assert_eq!(of("2", &[&grazing(), &open(false), &grazing()]).verdict, VerdictName::Undecided);
    let may_graze = of("[1.9, 2.1]", &[&grazing(), &open(false)]);
    assert!(may_graze.verdict != VerdictName::Refuted && is_named(&may_graze, "components[0].kind"));
}

/// An undecided component with the false claim of a recorded horseshoe, whose h-sets are moved by `periods` forcing periods.
fn with_horseshoe(periods: u32) -> Value {
    let chaos = recorded("chaos");
    let mut bases = chaos["bases"].clone();
    for base in bases.as_array_mut().unwrap() {
        let later = |x: &Value| json!(x.as_f64().unwrap() + f64::from(periods));
        for corner in ["left", "right"].iter().flat_map(|side| [(side, 0), (side, 1)]) {
            let phase = &mut base["corners"][corner.0][corner.1][0];
            *phase = later(phase);
        }
        let middle: f64 = base["phase"].as_str().unwrap().parse().unwrap();
        base["phase"] = json!(format!("{:.9}", middle + std::f64::consts::TAU * f64::from(periods)));
    }
    let horseshoe = json!({ "depth": chaos["depth"], "entropy": chaos["entropy"], "bases": bases });
    json!({ "kind": "undecided", "boxes": 1, "area": "0.000001", "closed": false, "horseshoe": horseshoe })
}

/// A horseshoe is in one component; in which one of those listed is not in a document. Lemmas A13, V37
#[test]
fn r47_which_component_holds_a_horseshoe_is_not_checked() {
    let mut document = recorded("global");
    document["scene"] = recorded("chaos")["scene"].clone();
    let of = |components: &[&Value]| checked(&with(&document, "undecided", components));
    for components in [&[&with_horseshoe(0)][..], &[&open(false), &with_horseshoe(0)]] {
        let found = of(components);
        assert!(found.verdict == VerdictName::Confirmed && is_named(&found, "statement"), "{}", found.message);
        assert!(found.message.contains("not which component holds a horseshoe"), "{}", found.message);
    }
    let same = of(&[&with_horseshoe(0), &with_horseshoe(0)]);
    assert!(same.verdict == VerdictName::Refuted, "{}", same.message);
    let later = of(&[&with_horseshoe(0), &with_horseshoe(1)]);
    assert!(later.verdict == VerdictName::Undecided && later.message.contains("apart"), "{}", later.message);
}

/// Without both ends nothing is proved of a window from end to end. Lemma V30
#[test]
fn r47_a_window_without_ends_is_not_confirmed_from_end_to_end() {
    let mut document = recorded("windows");
    let whole = checked(&document);
    assert!(whole.message.contains("the orbits of 1 window from end to end"), "{}", whole.message);
    document["certified"] = json!(false);
    let window = &mut document["windows"][0];
    window["stable_between"] = json!(false);
    let found = checked(&document);
    assert!(found.message.contains("a stable orbit in 1 window, not from end to end"), "{}", found.message);
    assert!(found.verdict == VerdictName::Confirmed && is_named(&found, "windows[0].stable_between"));
    for key in ["ends", "from", "to"].map(|key| format!("windows[0].{key}")) {
        assert!(is_named(&found, &key) && !is_named(&whole, &key), "{key}: {:?}", found.not_checked);
    }
}

/// Of two impacts in three cycles at A/d = 0.045 an orbit that is not symmetric, with the fold of the symmetric ones as an end: it begins at
/// their pitchfork. Without the orbits between, an end is a bifurcation of the word, of whichever branch. Lemmas V9, V30
#[test]
fn r48_a_bifurcation_of_another_branch_is_not_confirmed_as_an_end_of_a_window() {
    let document: Value = serde_json::from_str(include_str!("window-of-another-branch.json")).unwrap();
    let found = checked(&document);
    assert!(found.verdict != VerdictName::Confirmed || is_named(&found, "windows[0].from"), "{:?}", found.not_checked);
    let mut between = document.clone();
    between["windows"][0]["stable_between"] = json!(true);
    assert_ne!(checked(&between).verdict, VerdictName::Confirmed);
}

/// The orbits of two impacts from the fold at A/d = 0.104 to the pitchfork at 0.385 are one curve: listed with two values of it, they were two
/// windows. Lemma V30
#[test]
fn r51_a_window_is_not_listed_twice_with_two_of_its_values() {
    let document: Value = serde_json::from_str(include_str!("windows-of-one-curve.json")).unwrap();
    let of = |changes: &[(&str, Value)]| {
        let mut copy = document.clone();
        for (path, value) in changes {
            *copy.pointer_mut(path).expect(path) = value.clone();
        }
        checked(&copy)
    };
    for i in 0..2 {
        let single = of(&[("/windows", json!([document["windows"][i]]))]);
        assert_eq!(single.verdict, VerdictName::Confirmed, "{}", single.message);
    }
    let unproved = [
        ("/certified", json!(false)),
        ("/windows/1/from", json!(null)),
        ("/windows/1/to", json!(null)),
        ("/windows/1/ends", json!([null, null])),
        ("/windows/1/stable_between", json!(false)),
    ];
    for found in [of(&[]), of(&unproved)] {
        assert!(found.verdict == VerdictName::Undecided && found.message.contains("may be one"), "{}", found.message);
    }
    // Where the one ends before the value of the other they are two, and that end is judged.
    let apart = of(&[("/windows/0/to", json!(["0.25", "0.25000001"]))]);
    assert!(apart.verdict != VerdictName::Confirmed && !apart.message.contains("may be one"), "{}", apart.message);
}

/// An orbit of twice the period under the reduced map, and its component; the claim leaves open whether the orbit is symmetric.
fn of_twice_the_period() -> (Value, Value) {
    let document = recorded("global");
    let mut own =
        document["components"].as_array().unwrap().iter().find(|own| own["reduced_impacts"] == 1).unwrap().clone();
    own["reduced_impacts"] = json!(2);
    own["orbit"].as_object_mut().unwrap().remove("symmetric");
    let radius: Vec<f64> = [0, 1].map(|i| own["spectral_radius"][i].as_str().unwrap().parse().unwrap()).to_vec();
    own["spectral_radius"] = json!([0, 1].map(|i| format!("{:.12}", radius[i] * radius[i] + [-1e-9, 1e-9][i])));
    (document, own)
}

/// The spectral radius is that of the period under the reduced map, which symmetry decides.
#[test]
fn r47_without_symmetry_no_spectral_radius_is_confirmed() {
    let (document, own) = of_twice_the_period();
    let found = checked(&with(&document, "undecided", &[&own, &open(false)]));
    assert_eq!(found.verdict, VerdictName::Confirmed, "{}", found.message);
    for path in ["components[0].reduced_impacts", "components[0].spectral_radius", "statement"] {
        assert!(is_named(&found, path), "{path}: {:?}", found.not_checked);
    }
}

/// Keys of single components that are named in a JSON of a global analysis are named in an atlas.
#[test]
fn r47_what_is_not_checked_of_a_component_is_named_in_an_atlas() {
    let (document, own) = of_twice_the_period();
    let document = with(&document, "undecided", &[&own, &open(false)]);
    let axis = |key: &str, from: &str| json!({ "key": key, "from": from, "to": "1", "count": 2 });
    let over = json!([axis("amplitude", "0.583258"), axis("restitution", "0.377273")]);
    let text = atlas_of(&document, &over, &json!(["0.583258", "0.377273"]));
    let claims = Claims::parse(&text).unwrap();
    let found = claims.document(&text, &claims.judge(&Effort::default(), &Unwatched).unwrap());
    for key in ["reduced_impacts", "spectral_radius"] {
        assert!(is_named(&found, &format!("points[0].components[0].{key}")), "{:?}", found.not_checked);
    }
}

/// Half vectors of h-sets are those of the corners, in an atlas as well. Lemma V12
#[test]
fn r61_half_vectors_of_an_h_set_are_compared_with_its_corners() {
    for (vector, verdict) in [(None, VerdictName::Confirmed), (Some(json!(["1", "1"])), VerdictName::Refuted)] {
        let mut own = with_horseshoe(0);
        if let Some(vector) = vector {
            own["horseshoe"]["bases"][0]["expanding"] = vector;
        }
        let mut document = recorded("global");
        document["scene"] = recorded("chaos")["scene"].clone();
        let global = with(&document, "undecided", &[&own]);
        let axis = |key: &str, from: &str| json!({ "key": key, "from": from, "to": "9.5", "count": 2 });
        let over = json!([axis("amplitude", "8"), axis("gap", "9.42497")]);
        let text = atlas_of(&global, &over, &json!(["8", "9.42497"]));
        let claims = Claims::parse(&text).unwrap();
        let of_atlas = claims.document(&text, &claims.judge(&Effort::default(), &Unwatched).unwrap());
        assert_eq!([checked(&global).verdict, of_atlas.verdict], [verdict; 2], "{}", of_atlas.message);
    }
}

/// A set of saddle type beside an undecided component may hold no motion: their number is not checked then.
#[test]
fn r48_sets_of_saddle_type_that_may_be_none_are_not_counted() {
    let (document, own) = of_twice_the_period();
    let saddle = json!({ "kind": "saddle", "boxes": 3, "area": "0.000001", "closed": false });
    let axis = |key: &str, from: &str| json!({ "key": key, "from": from, "to": "1", "count": 2 });
    let over = json!([axis("amplitude", "0.583258"), axis("restitution", "0.377273")]);
    for components in [&[&own, &open(false)][..], &[&own, &open(false), &saddle]] {
        let document = with(&document, "undecided", components);
        let text = atlas_of(&document, &over, &json!(["0.583258", "0.377273"]));
        let claims = Claims::parse(&text).unwrap();
        let found = claims.document(&text, &claims.judge(&Effort::default(), &Unwatched).unwrap());
        assert_eq!(is_named(&found, "points[0].n_saddle"), components.len() == 3, "{:?}", found.not_checked);
    }
}

/// A fate "without sticking" is not proved by a region that does not claim to be without rests.
#[test]
fn r48_a_region_that_may_hold_rests_does_not_prove_a_fate_without_sticking() {
    let mut document = recorded("description of a region");
    assert_eq!(checked(&document).verdict, VerdictName::Confirmed);
    document["region"]["no_rest"] = json!(false);
    let found = checked(&document);
    assert!(found.verdict == VerdictName::Refuted && found.message.contains("fate.message"), "{}", found.message);
}

/// A region proves no other fate: its motions do not rest. That the fate is undecided claims nothing, and is not confirmed either.
#[test]
fn r49_a_fate_that_no_document_proves_is_not_confirmed() {
    let of = |fate: Value, certified: bool| {
        let mut document = recorded("description of a region");
        (document["fate"], document["certified"]) = (fate, json!(certified));
        checked(&document)
    };
    let message = "the ball rests on the left wall for ever";
    let rests = of(json!({ "kind": "rests-forever", "message": message, "impacts": 5, "wall": "left" }), true);
    assert!(
        rests.verdict == VerdictName::Undecided && rests.message.contains("fate is rests-forever"),
        "{}",
        rests.message
    );
    assert!(rests.claims.iter().any(|claim| claim.path == "fate" && claim.verdict == VerdictName::Undecided));
    let message = "undecided after 60 certified impacts";
    let open = of(json!({ "kind": "undecided", "message": message, "impacts": 60 }), false);
    assert!(open.verdict == VerdictName::Confirmed && is_named(&open, "fate"), "{}", open.message);
    assert!(open.message.contains("not the fate") && !open.message.contains("the fate:"), "{}", open.message);
}

/// A bifurcation of an orbit, of another kind and with other doublings.
fn bifurcations(kind: &str, doublings: u32) -> Value {
    let mut document = recorded("bifurcations");
    (document["points"][0]["kind"], document["points"][0]["doublings"]) = (json!(kind), json!(doublings));
    document
}

/// A period doubling is the first one of the requested word at least.
#[test]
fn r48_a_period_doubling_is_counted() {
    assert_eq!(checked(&bifurcations("period-doubling", 0)).verdict, VerdictName::Refuted);
    assert_ne!(checked(&bifurcations("period-doubling", 1)).verdict, VerdictName::Refuted);
}

/// Grazes are not proved again, nor that all points are proved where there are some.
#[test]
fn r48_with_grazes_it_is_not_checked_that_all_points_are_proved() {
    let mut document = recorded("bifurcations");
    assert!(document["certified"] == true && !is_named(&checked(&document), "certified"));
    let mut graze = document["points"][0].clone();
    (graze["kind"], graze["parameter"]) = (json!("graze"), json!(["0.39", "0.3900001"]));
    document["points"].as_array_mut().unwrap().push(graze);
    let found = checked(&document);
    assert_eq!(found.verdict, VerdictName::Confirmed, "{}", found.message);
    assert!(is_named(&found, "points[1]") && is_named(&found, "certified"), "{:?}", found.not_checked);
}

/// Of a document of subintervals only keys that it has are named, and what the verdict `attracted` is about is not.
#[test]
fn r47_cells_name_what_they_have_and_do_not_use() {
    let document = recorded("cells");
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
