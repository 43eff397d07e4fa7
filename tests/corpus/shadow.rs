//! Search for a start near the scene's that has the impacts of a shadowed orbit, by the time of the last impact in 320 bits; its motion is
//! compared.

use impact_pair::exact::{Enclosure, Exact, decimal_bounds};
use impact_pair::json::{OutcomeDocument, SceneDocument};
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use num_rational::BigRational;
use serde_json::{Value, json};

use super::truth;

/// Bits of starts that are tried.
const BITS: u32 = 320;
/// Steps of the secant method.
const STEPS: u32 = 8;
/// Places of the last impact in its bounds at which it is sought, in sixteenths.
const PLACES: [i64; 5] = [8, 4, 12, 1, 15];
/// Factor by which rounding outward widens the bounds of a document at most.
const MAX_ROUNDING_FACTOR: f64 = 1.05;

pub fn is_true(document: &Value, outcome: &OutcomeDocument) -> bool {
    let (Some(near), Some(last)) =
        (&document["outcome"].get("start"), document["events"].as_array().and_then(|all| all.last()))
    else {
        return false;
    };
    let given = &document["scene"]["start"];
    let is_at_rest =
        given["wall"].is_string() && value(&given["velocity"]) == Some(BigRational::from_integer(0.into()));
    let (varied, fixed) = if is_at_rest { ("time", "velocity") } else { ("velocity", "time") };
    if !is_inside(&given[fixed], &near[fixed]) || !is_inside(&given[varied], &near[varied]) {
        return false;
    }
    is_near(document, outcome)
        && PLACES.iter().any(|&place| {
            let Some([lower, upper]) = bounds(&last["time"]) else { return false };
            let sought = &lower + (upper - &lower) * BigRational::new(place.into(), 16.into());
            start_of(document, varied, &sought).is_some_and(|start| has_impacts(document, varied, &start))
        })
}

fn value(text: &Value) -> Option<BigRational> {
    Exact::parse(text.as_str()?).ok()?.as_rational().cloned()
}

fn bounds(pair: &Value) -> Option<[BigRational; 2]> {
    Some([value(&pair[0])?, value(&pair[1])?])
}

fn is_inside(text: &Value, pair: &Value) -> bool {
    value(text).zip(bounds(pair)).is_some_and(|(x, [lower, upper])| lower <= x && x <= upper)
}

/// Half of the bounds are no wider than is claimed, and none is.
fn is_near(document: &Value, outcome: &OutcomeDocument) -> bool {
    let Some(made_consistent) = &outcome.epsilon else { return true };
    let frequency = Exact::parse(document["scene"]["excitation"]["frequency"][0].as_str().unwrap()).unwrap();
    let turns = frequency.enclose(64).mid_rad().0 / std::f64::consts::TAU;
    let width = |event: &Value| bounds(&event["time"]).map(|[lower, upper]| float(&(upper - lower)));
    let mut halves: Vec<f64> =
        document["events"].as_array().unwrap().iter().filter_map(width).map(|width| width * turns / 2.0).collect();
    halves.sort_by(f64::total_cmp);
    let is_claimed = |half: f64, made_consistent: &BigRational| half <= MAX_ROUNDING_FACTOR * float(made_consistent);
    is_claimed(halves[(halves.len() - 1) / 2], &made_consistent.median.value())
        && is_claimed(halves[halves.len() - 1], &made_consistent.maximum.value())
}

fn float(x: &BigRational) -> f64 {
    Enclosure::from_rational(x, 64).mid_rad().0
}

/// The events from another start.
fn motion(document: &Value, varied: &str, start: &BigRational) -> Option<Vec<Value>> {
    let mut scene = document["scene"].clone();
    scene["start"][varied] = json!(decimal_bounds(&Enclosure::from_rational(start, BITS))[0]);
    let (pair, start) = serde_json::from_value::<SceneDocument>(scene).ok()?.model().ok()?;
    let impacts = document["events"].as_array()?.len() as u64;
    let settings =
        Settings { impacts: Some(impacts), arithmetic: Arithmetic::Bits(BITS), digits: 60, ..Settings::default() };
    let found = json!(Orbit::new(&pair, &start, settings).ok()?.document());
    found["events"].as_array().cloned()
}

/// The start from which the last impact comes at a time.
fn start_of(document: &Value, varied: &str, sought: &BigRational) -> Option<BigRational> {
    let [lower, upper] = bounds(&document["outcome"]["start"][varied])?;
    let late = |start: &BigRational| {
        let events = motion(document, varied, start)?;
        bounds(&events.last()?["time"]).map(|[time, _]| time - sought)
    };
    let (mut one, mut other) = (lower, upper);
    let (mut at_one, mut at_other) = (late(&one)?, late(&other)?);
    for _ in 0..STEPS {
        let apart = &at_other - &at_one;
        if apart == BigRational::from_integer(0.into()) {
            break;
        }
        let next = &other - &at_other * (&other - &one) / apart;
        let next = Enclosure::from_rational(&next, BITS).inf().to_rational();
        (one, at_one) = (other, at_other);
        at_other = late(&next)?;
        other = next;
    }
    Some(other)
}

fn has_impacts(document: &Value, varied: &str, start: &BigRational) -> bool {
    let [lower, upper] = bounds(&document["outcome"]["start"][varied]).unwrap();
    let (claimed, found) = (document["events"].as_array().unwrap(), motion(document, varied, start));
    lower <= *start
        && *start <= upper
        && found.is_some_and(|found| {
            let is_same =
                |(claim, event): (&Value, &Value)| claim["index"] == event["index"] && truth::is_event(claim, event);
            claimed.len() == found.len() && claimed.iter().zip(&found).all(is_same)
        })
}
