//! The trade JSON, schema `impact-pair/trade/1`.
//!
//! Widths and errors are decimal strings, since they may be below the range of doubles: a width is an upper bound, an
//! error lies between two bounds. `digits` is `-log10` of the greatest width, rounded down. Times are those of one
//! machine on one day.

use std::time::Duration;

use impact_pair::certificate::document::{PROGRAM, SceneDocument};
use serde_json::{Value, json};

use super::Trade;
use super::judge::{self, Judgement, Largest};
use super::ladder::Rung;
use super::measure::{Extent, Measured};

const SCHEMA: &str = "impact-pair/trade/1";

/// The whole document, a rung a line.
pub fn document(trade: &Trade<'_>) -> String {
    let (scene, asked) = (trade.scene, &trade.asked);
    let until = asked.until.as_ref().map(|until| until.text());
    let head = [
        ("schema", json!(SCHEMA)),
        ("program", json!(PROGRAM)),
        ("scene", json!(SceneDocument::new(scene.pair(), scene.start()))),
        ("asked", json!({"impacts": asked.impacts, "until": until, "max_bits": asked.max_bits})),
        ("units", json!({"time": "2 pi/W", "velocity": trade.units.speed.to_string()})),
        ("interrupted", json!(trade.interrupted.map(|rung| rung.to_string()))),
    ];
    let head: Vec<String> = head.iter().map(|(key, value)| format!("\"{key}\":{value}")).collect();
    let rungs: Vec<String> = trade.rungs.iter().map(|measured| rung(measured, trade).to_string()).collect();
    format!("{{{},\n \"rungs\":[\n  {}]}}\n", head.join(",\n "), rungs.join(",\n  "))
}

fn rung(measured: &Measured, trade: &Trade<'_>) -> Value {
    let time = |whole: Duration| measured.microseconds(whole);
    let times = &measured.times;
    let mut row = json!({
        "name": measured.rung.to_string(),
        "asked": asked(measured.rung),
        "arithmetic": measured.computed,
        "certified": measured.is_certified,
        "complete": measured.is_complete(),
        "impacts": measured.impacts,
        "outcome": measured.conclusion.document(),
        "seconds": {
            "orbit": times.orbit.as_secs_f64(),
            "with_bounds": times.with_bounds.map(|time| time.as_secs_f64()),
            "repetitions": times.repetitions,
        },
        "microseconds_per_impact": {"orbit": time(times.orbit), "with_bounds": times.with_bounds.and_then(time)},
        "impacts_per_second": time(times.orbit).map(|time| 1e6 / time),
        "digits": measured.digits().map(|digits| (digits * 100.0).floor() / 100.0),
        "widths": measured.widths.map(|widths| json!({"time": extent(&widths.time), "velocity": extent(&widths.velocity)})),
    });
    if let (Rung::Float, Some(judgement)) = (measured.rung, &trade.judgement) {
        row["truth"] = truth(judgement, trade);
    }
    row
}

/// The rung as the command line says it.
fn asked(rung: Rung) -> Value {
    match rung {
        Rung::Float => json!({"arithmetic": "float"}),
        Rung::Interval => json!({"arithmetic": "interval"}),
        Rung::Inari => json!({"arithmetic": "inari"}),
        Rung::Bits(bits) => json!({"arithmetic": bits.to_string()}),
        Rung::Auto(digits) => json!({"arithmetic": "auto", "digits": digits}),
    }
}

fn extent(extent: &Extent) -> Value {
    json!({"greatest": extent.greatest.decimal_up(), "last": extent.last.decimal_up()})
}

fn truth(judgement: &Judgement, trade: &Trade<'_>) -> Value {
    let largest = |largest: &Largest| {
        (largest.impact > 0).then(|| {
            let bounds = [largest.at_least.decimal_down(), largest.at_most.decimal_up()];
            json!({"bounds": bounds, "impact": largest.impact})
        })
    };
    let crossings: Value = judgement
        .crossings
        .iter()
        .map(|crossing| {
            let threshold = format!("1e{}", crossing.exponent);
            json!({"threshold": threshold, "within": crossing.within, "exceeded": crossing.exceeded})
        })
        .collect();
    let departure = judgement.departure.map(|departure| {
        let float = departure.judged.map(|wall| wall.name());
        json!({"impact": departure.impact, "truth": departure.truth.name(), "float": float})
    });
    json!({
        "judge": judge::name(&judge::truth(&trade.asked)),
        "judged": judgement.judged,
        "largest_error": {"time": largest(&judgement.time), "velocity": largest(&judgement.velocity)},
        "time_errors": crossings,
        "leaves_word": departure,
    })
}
