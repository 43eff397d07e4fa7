//! A sweep: each point against the run of its own scene, which the true motion judges.

use impact_pair::Scene;
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use impact_pair_answers::sweep::PointSettings;
use impact_pair_truth::{Tone, float};
use rug::float::Constant;
use serde_json::Value;
use std::collections::BTreeSet;

use super::members::{Bounds, Member};
use super::motion::{self, Compared, Halt, wrong};
use crate::random::Random;

/// The harmonics whose phases the states so far may be.
type Units = BTreeSet<usize>;

/// The numbers of the harmonics whose phase it may be, at a time within bounds.
fn units(tones: &[Tone], time: &Bounds, phase: &Bounds) -> Units {
    let turn = float(Constant::Pi) * 2;
    let fits = |tone: &Tone| {
        let ahead = float(&tone.frequency * &time.middle()) + &tone.phase - phase.middle();
        let turns = float(&ahead / &turn).round();
        let wide = float(&time.1 - &time.0) * &tone.frequency + float(&phase.1 - &phase.0);
        let off = float(ahead - turns * &turn).abs();
        off <= wide
    };
    (0..tones.len()).filter(|&number| fits(&tones[number])).collect()
}

/// Whether two bounds of one quantity overlap.
fn meet(a: &Value, b: &Value) -> bool {
    let (Some(a), Some(b)) = (Bounds::read(a), Bounds::read(b)) else { return false };
    a.0 <= b.1 && b.0 <= a.1
}

/// Compares the states of a record with the events of a run, impact by impact; returns the harmonics whose phases they may be.
fn compared(record: &Value, run: &Value, tones: &[Tone]) -> Compared<Units> {
    let mut fits: Units = (0..tones.len()).collect();
    for state in record["states"].as_array().map_or(&[][..], Vec::as_slice) {
        let same = |event: &&Value| event["event"] == "impact" && event["index"] == state["index"];
        let event = run["events"].as_array().and_then(|events| events.iter().find(same));
        let Some(event) =
            event.filter(|event| event["wall"] == state["wall"] && meet(&event["velocity"], &state["velocity"]))
        else {
            return wrong(format!("{state}, but its own run says {event:?}"));
        };
        let (Some(time), Some(phase)) = (Bounds::read(&event["time"]), Bounds::read(&state["phase"])) else {
            return wrong(format!("{state}: no bounds"));
        };
        let here = units(tones, &time, &phase);
        if here.is_empty() {
            return wrong(format!("the phase of {state}, but its own run says {event}"));
        }
        fits = &fits & &here;
    }
    if fits.is_empty() { wrong("phases of one point are told in different units".into()) } else { Ok(fits) }
}

/// The run of a point's own scene; `None` where another orbit may have been listed: one near the start.
fn own(record: &Value, scene: &Scene, requested: &PointSettings) -> Compared<Option<Value>> {
    // Orbits that are not shadowed are certified from the exact start, to the digits.
    let is_shadow = requested.settings.arithmetic == Arithmetic::Shadow;
    // In the bits that it took: in more a graze may be distinguished from an impact, which has a number.
    let arithmetic = match record["bits"].as_u64() {
        Some(53) if is_shadow => Arithmetic::Interval,
        _ if is_shadow => Arithmetic::Auto,
        _ => requested.settings.arithmetic,
    };
    let impacts = Some(requested.transient + requested.impacts);
    let settings = Settings { impacts, arithmetic, attractor: true, ..requested.settings.clone() };
    let Ok(found) = Orbit::of(scene, settings).map(|mut orbit| orbit.document()) else {
        return wrong("the point is computed, its own scene is refused".into());
    };
    let found = serde_json::to_value(found).expect("plain data");
    if record["claim"] == "shadowed" {
        return Ok(None);
    }
    let kind = match found["outcome"]["kind"].as_str() {
        Some("impacts-reached" | "time-reached") => "undecided-limit",
        Some(kind) => kind,
        None => "none",
    };
    let is_same = record["outcome"] == kind && record["impacts"] == found["outcome"]["impacts"];
    if !is_shadow && !is_same {
        let (outcome, impacts) = (&record["outcome"], &record["impacts"]);
        return wrong(format!("{outcome} after {impacts} impacts, but its own run says {}", found["outcome"]));
    }
    Ok(Some(found))
}

/// All points of a sweep; their phases must be those of one harmonic.
pub fn judge(records: &[Value], points: &[Scene], requested: &PointSettings, random: &mut Random) -> Compared<()> {
    let (mut common, mut open): (Option<Units>, _) = (None, None);
    for (record, scene) in records.iter().zip(points) {
        if record["outcome"] == "undecided" && record["impacts"] == 0 {
            // Its own run would find as little, after a long search.
            open = Some("undecided before the first impact");
            continue;
        }
        let Some(run) = own(record, scene, requested)? else { continue };
        for member in Member::all(scene, random) {
            match motion::judge(&run, &member) {
                Err(Halt::Open(why)) => open = Some(why),
                other => other?,
            }
            let fits = compared(record, &run, &member.tones)?;
            let met = common.map_or(fits.clone(), |common| &common & &fits);
            if met.is_empty() {
                return wrong(format!("point {} tells phases in another unit than the points before", record["point"]));
            }
            common = Some(met);
        }
    }
    open.map_or(Ok(()), |why| Err(Halt::Open(why)))
}
