//! `check` confirms right bounds and refuses wrong ones, to the last printed unit: the truth says which are which.

use impact_pair::Scene;
use impact_pair::orbit::{Orbit, Settings};
use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Certificate, Verdict};
use rug::ops::Pow;
use rug::{Float, Integer, Rational};
use serde_json::{Value, json};

use crate::crossings::members::Member;
use crate::crossings::motion::Motion;

fn verdict(document: &Value) -> Verdict {
    Certificate::parse(&document.to_string()).unwrap().check(&Unwatched).unwrap()
}

/// A printed decimal as mantissa and power of ten.
fn units(decimal: &str) -> (Integer, i32) {
    let (number, power) = decimal.split_once('e').unwrap_or((decimal, "0"));
    let (whole, part) = number.split_once('.').unwrap_or((number, ""));
    let mantissa = format!("{whole}{part}").parse().unwrap();
    (mantissa, power.parse::<i32>().unwrap() - part.len() as i32)
}

/// `decimal` and `n` units of its last place more.
fn moved(decimal: &str, n: &Integer) -> String {
    let (mantissa, power) = units(decimal);
    format!("{}e{power}", mantissa + n)
}

/// Number of whole units of its last place that lie between a bound and the truth.
fn units_to(decimal: &str, truth: &Float) -> Integer {
    let (mantissa, power) = units(decimal);
    let unit = Rational::from(Integer::from(10).pow(power.unsigned_abs()));
    let unit = if power < 0 { unit.recip() } else { unit };
    let distance = truth.to_rational().unwrap() - Rational::from(mantissa) * &unit;
    let distance: Rational = distance.abs() / unit;
    distance.trunc().numer().clone()
}

/// Each bound may be moved inward up to the truth, and not one unit farther: all four of each impact.
#[test]
fn a_bound_is_refused_from_the_unit_on_that_makes_it_false() {
    for (figure, impacts) in [(13, 6), (14, 12), (15, 6), (17, 8)] {
        let path = format!("{}/../../scenes/figure-{figure}.toml", env!("CARGO_MANIFEST_DIR"));
        let scene = Scene::parse(&std::fs::read_to_string(path).unwrap()).unwrap();
        let settings = Settings { impacts: Some(impacts), digits: 9, ..Settings::default() };
        let document = json!(Orbit::of(&scene, settings).unwrap().document());
        assert!(matches!(verdict(&document), Verdict::Confirmed { .. }), "figure {figure}");
        let member = Member::new(&scene, || 0.0);
        let mut motion = Motion::new(&member.shaken, member.start.clone());
        for i in 0..impacts as usize {
            let contact = motion.contact(&mut Vec::new()).unwrap().expect("an impact");
            for (key, value) in [("time", &contact.time), ("velocity", &contact.velocity_before)] {
                for (end, sign) in [(0, 1), (1, -1)] {
                    let bound = document["events"][i][key][end].as_str().unwrap().to_owned();
                    let last = units_to(&bound, value);
                    let mut edited = document.clone();
                    edited["events"][i][key][end] = json!(moved(&bound, &Integer::from(&last * sign)));
                    assert!(matches!(verdict(&edited), Verdict::Confirmed { .. }), "figure {figure}, {i} {key}");
                    edited["events"][i][key][end] = json!(moved(&bound, &((last + 1u32) * sign)));
                    let found = verdict(&edited);
                    assert!(matches!(&found, Verdict::Refuted(finding) if finding.event == i), "{found:?} of {edited}");
                }
            }
        }
    }
}
