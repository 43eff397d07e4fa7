//! The table for people: one line per arithmetic, then the errors of `float`.

use super::{Crossing, ErrorBounds, Extent, Largest, Measured, Trade};
use impact_pair::json::counted;

use crate::heading;

const COLUMN_NOTES: &str = "us: microseconds, orbit: impacts enclosed, as impacts/s; bounds: with their exact bounds in the units of the scene";

pub fn table(trade: &Trade<'_>) -> String {
    let mut lines = vec![format!("{}requested: {}\n", heading(trade.scene), trade.goal()), names()];
    lines.extend(trade.rows.iter().map(row));
    lines.push(format!("\n{COLUMN_NOTES}"));
    let speed = trade.units.speed;
    lines.push(format!("widths: guaranteed, of times in periods 2 pi/W, of velocities in {speed}"));
    if let Some(judgement) = &trade.judgement {
        let impacts = trade.rows.first().map_or(0, |float| float.impacts);
        lines.extend(verdict(judgement, &trade.judge(), impacts));
    }
    if let Some(arithmetic) = trade.interrupted {
        lines.push(format!("\ninterrupted in row {arithmetic}"));
    }
    lines.join("\n") + "\n"
}

/// The names of the columns, in two lines.
fn names() -> String {
    let (cost, greatest) = ("us per impact", "greatest width");
    let upper = format!("{:32}{cost:>16}{:10}{greatest:>19}", "", "");
    let columns = ["bits", "impacts", "orbit", "bounds", "impacts/s", "time", "velocity"];
    upper + "\n" + &line("arithmetic", columns.map(str::to_owned), "end")
}

/// A line in columns of fixed widths.
fn line(name: &str, columns: [String; 7], end: &str) -> String {
    let [bits, impacts, orbit, bounds, rate, time, velocity] = columns;
    format!("{name:16}{bits:>7}{impacts:>9}{orbit:>8}{bounds:>8}{rate:>10}{time:>10}{velocity:>9}  {end}")
}

fn row(arithmetic: &Measured) -> String {
    let none = || "-".to_owned();
    let microseconds = |time| arithmetic.microseconds(time).map(significant);
    let rate = arithmetic.microseconds(arithmetic.times.orbit).map(|time| format!("{:.1e}", 1e6 / time));
    let width = |extent: Option<Extent>| match extent {
        Some(Extent { greatest, .. }) => greatest.short(),
        None => none(),
    };
    let time = width(arithmetic.widths.map(|widths| widths.time));
    let velocity = width(arithmetic.widths.map(|widths| widths.velocity));
    let columns = [
        arithmetic.bits.to_string(),
        arithmetic.impacts.to_string(),
        microseconds(arithmetic.times.orbit).unwrap_or_else(none),
        arithmetic.times.with_bounds.and_then(microseconds).unwrap_or_else(none),
        rate.unwrap_or_else(none),
        time,
        velocity,
    ];
    let end = match arithmetic.conclusion.reason() {
        None if arithmetic.is_certified => "all certified".into(),
        None => "not certified".into(),
        Some(reason) => format!("undecided: {reason}"),
    };
    line(&arithmetic.arithmetic.to_string(), columns, &end)
}

/// Three significant digits, no exponent.
fn significant(x: f64) -> String {
    let places = (2.0 - x.log10().floor()).clamp(0.0, 6.0);
    format!("{x:.*}", places as usize)
}

/// Returns the errors of `float` and the number of its impacts.
fn verdict(judgement: &ErrorBounds, truth: &str, impacts: u64) -> Vec<String> {
    let mut lines = vec![format!(
        "\ntrue errors of float, compared with {truth} on {} of {}:",
        judgement.judged,
        counted(impacts, "impact")
    )];
    let mut say = |what: &str, answer: String| lines.push(format!("  {what:38}{answer}"));
    if judgement.judged > 0 {
        let largest =
            |largest: &Largest, unit: &str| format!("{} {unit} (impact {})", between(largest), largest.impact);
        say("largest error of a time", largest(&judgement.time, "periods"));
        say("largest error of a velocity", largest(&judgement.velocity, &judgement.units.speed.to_string()));
        for crossing in &judgement.crossings {
            let what = format!("times off by more than 1e{} periods", crossing.exponent);
            say(&what, first(crossing, judgement.judged));
        }
    }
    let on_the_word = format!("not up to impact {}", judgement.judged);
    let departure = judgement.departure.map(|departure| {
        let float = departure.judged.map_or("float ends".to_owned(), |wall| format!("float on the {}", wall.name()));
        format!("at impact {}: the truth is on the {} wall, {float}", departure.impact, departure.truth.name())
    });
    say("departs from the true word", departure.unwrap_or(on_the_word));
    lines
}

/// Bounds that agree to two digits are one number.
fn between(largest: &Largest) -> String {
    let (least, most) = (largest.at_least.decimal_down(), largest.at_most.decimal_up());
    if largest.at_least.rounded() == largest.at_most.rounded() {
        largest.at_most.rounded()
    } else {
        format!("from {least} to {most}")
    }
}

fn first(crossing: &Crossing, judged: u64) -> String {
    match crossing.exceeded {
        Some(at) if crossing.within + 1 == at => format!("first at impact {at}"),
        Some(at) => format!("proved at impact {at}, not excluded from impact {}", crossing.within + 1),
        None if crossing.within == judged => format!("not up to impact {judged}"),
        None if crossing.within == 0 => "not decided".into(),
        None => format!("not up to impact {}, not decided from there on", crossing.within),
    }
}
