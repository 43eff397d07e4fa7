//! One start: `run` in some arithmetic, its document read back and checked.

use impact_pair::orbit::{Arithmetic, INARI, Orbit, Settings};
use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Certificate, Limits, Verdict};
use serde_json::json;

use super::starts::{Case, FAMILIES};

/// The verdict on a start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartVerdict {
    /// Every claim is proved by the other route.
    Confirmed,
    /// The other route does not decide.
    Open,
    /// Nothing is claimed.
    Nothing,
    /// Beyond the range of flights.
    NoScene,
    /// A claim is false.
    Refuted,
}

impl StartVerdict {
    pub const NAMES: [&'static str; 5] = ["confirmed", "open", "nothing claimed", "out of range", "refuted"];

    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// The limits that a start near a boundary of branches needs; the long flights among them need more than anybody waits for.
const LIMITS: Limits = Limits { bits: 640, parts: 1 << 7, pieces: 4, work: 1 << 16 };

/// The arithmetics in turn, and the most bits of `auto`.
fn settings(case: &Case, number: u64) -> Settings {
    let names = ["interval", "64", "auto", "inari", "128", "256"];
    let name = names[number as usize / FAMILIES.len() % names.len()];
    let is_known = name != "inari" || INARI && case.scene.pair().excitation().only().is_some();
    let arithmetic: Arithmetic = if is_known { name } else { "interval" }.parse().expect("an arithmetic");
    Settings { arithmetic, impacts: Some(case.impacts), max_bits: 1024, ..Settings::default() }
}

/// Runs and checks; with words on what is refuted.
pub fn judge(case: &Case, number: u64) -> (StartVerdict, String) {
    let settings = settings(case, number);
    let arithmetic = settings.arithmetic;
    let Ok(orbit) = Orbit::new(case.scene.pair(), case.scene.start(), settings).map(|mut orbit| orbit.document())
    else {
        return (StartVerdict::NoScene, String::new());
    };
    let document = json!(orbit);
    if document["events"].as_array().is_none_or(Vec::is_empty) {
        return (StartVerdict::Nothing, String::new());
    }
    let certificate = Certificate::parse(&document.to_string()).expect("what is written can be read");
    match certificate.check_within(&LIMITS, &Unwatched).expect("a scene that was run") {
        Verdict::Confirmed { .. } => (StartVerdict::Confirmed, String::new()),
        Verdict::Interrupted { .. } => unreachable!("nobody stops it"),
        Verdict::Undecided(finding) => (StartVerdict::Open, finding.message),
        Verdict::Refuted(finding) => {
            (StartVerdict::Refuted, format!("{} {arithmetic:?}, event {}", finding.message, finding.event))
        }
    }
}
