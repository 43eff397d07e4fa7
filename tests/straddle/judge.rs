//! One start: `run` in some arithmetic, its document read back and checked.

use impact_pair::Scene;
use impact_pair::document::{Conclusion, Event, arithmetic, head};
use impact_pair::json::{EventDocument, write_orbit};
use impact_pair::orbit::{Arithmetic, INARI, Orbit, Progress, Settings};
use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Certificate, Effort, Verdict};

use super::starts::Case;

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

/// The effort that a start near a boundary of branches needs; the long flights among them need more than anybody waits for.
const EFFORT: Effort = Effort { bits: 640, parts: 1 << 7, pieces: 4, work: 1 << 16 };

/// The arithmetics in turn, and the most bits of `auto`.
fn settings(case: &Case, number: u64) -> Settings {
    let names = ["interval", "64", "auto", "inari", "128", "256"];
    let name = names[number as usize / 11 % names.len()];
    let is_known = name != "inari" || INARI && case.scene.pair().excitation().only().is_some();
    let arithmetic: Arithmetic = if is_known { name } else { "interval" }.parse().expect("an arithmetic");
    Settings { arithmetic, impacts: Some(case.impacts), max_bits: 1024, ..Settings::default() }
}

/// The orbit's document, and how many events it has.
fn document(scene: &Scene, settings: &Settings, mut orbit: Orbit) -> (String, usize) {
    let mut events = Vec::new();
    while events.len() <= 16 {
        let step = orbit.advance();
        if step == Progress::Ended {
            break;
        }
        events.extend(Event::of(&orbit, &step));
    }
    let conclusion = Conclusion::of(&orbit, events.last());
    let head = head(scene.pair(), scene.start(), settings.arithmetic, arithmetic(&orbit));
    let mut text = Vec::new();
    write_orbit(&mut text, &head, &conclusion.document(), events.iter().map(EventDocument::from))
        .expect("a vector takes all");
    (String::from_utf8(text).expect("JSON is text"), events.len())
}

/// Runs and checks; with words on what is refuted.
pub fn judge(case: &Case, number: u64) -> (StartVerdict, String) {
    let settings = settings(case, number);
    let Ok(orbit) = Orbit::of(&case.scene, settings.clone()) else { return (StartVerdict::NoScene, String::new()) };
    let (text, events) = document(&case.scene, &settings, orbit);
    if events == 0 {
        return (StartVerdict::Nothing, String::new());
    }
    let certificate = Certificate::parse(&text).expect("what is written can be read");
    match certificate.check_within(&EFFORT, &Unwatched).expect("a scene that was run") {
        Verdict::Confirmed { .. } => (StartVerdict::Confirmed, String::new()),
        Verdict::Interrupted { .. } => unreachable!("nobody stops it"),
        Verdict::Undecided(finding) => (StartVerdict::Open, finding.message),
        Verdict::Refuted(finding) => {
            let report = format!("{} {:?}, event {}", finding.message, settings.arithmetic, finding.event);
            (StartVerdict::Refuted, report)
        }
    }
}
