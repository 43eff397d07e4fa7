//! Scenes at the extremes: what is read is followed to an end, whatever its values are.

use impact_pair::Scene;
use impact_pair::orbit::{Arithmetic, Orbit, Progress, Settings};
use impact_pair_fuzz::config;
use proptest::prelude::*;
use proptest::test_runner::Config;

const MANTISSAS: [&str; 5] = ["1", "2", "7", "3.3", "1.0000001"];

/// One of these, or a power of ten in a range.
fn value(usual: &'static [&'static str], exponents: std::ops::Range<i32>) -> impl Strategy<Value = String> {
    prop_oneof![
        3 => prop::sample::select(usual).prop_map(str::to_owned),
        1 => (prop::sample::select(&MANTISSAS[..]), exponents).prop_map(|(mantissa, exponent)| format!("{mantissa}e{exponent}")),
        1 => (prop::sample::select(&MANTISSAS[..]), -12..12).prop_map(|(mantissa, exponent)| format!("{mantissa}e{exponent}")),
    ]
}

fn excitation() -> impl Strategy<Value = String> {
    let amplitude = value(&["1", "0.1", "0", "8", "sqrt(2)", "[0.1, 1]"], -300..300);
    let frequency = value(&["1", "pi", "2*pi", "sqrt(2)"], -300..300);
    let phase = value(&["0", "pi/2", "pi", "-3*pi", "0.3", "pi/5"], -100..100);
    prop::collection::vec((amplitude, frequency, phase), 1..4).prop_map(|terms| {
        let list = |text: &dyn Fn(&(String, String, String)) -> &String| {
            let values: Vec<_> = terms.iter().map(|term| format!("\"{}\"", text(term))).collect();
            format!("[{}]", values.join(", "))
        };
        let [a, w, tau] = [list(&|term| &term.0), list(&|term| &term.1), list(&|term| &term.2)];
        format!("excitation = {{ amplitude = {a}, frequency = {w}, phase = {tau} }}")
    })
}

fn pair() -> impl Strategy<Value = (String, String)> {
    let gap = value(&["1", "9.42497", "3*pi"], -300..300);
    let restitution = prop::sample::select(
        &["0", "1", "0.5", "0.8", "1e-40", "1 - 1e-300", "1 - 1e-12", "0.99", "1e-4", "[0, 0.1]"][..],
    );
    (gap, restitution).prop_map(|(gap, restitution)| {
        let pair = format!("pair = {{ gap = \"{gap}\", restitution = \"{restitution}\" }}");
        (gap, pair)
    })
}

/// A start; `GAP` stands for the gap.
fn start() -> impl Strategy<Value = String> {
    let time = value(&["0", "1/3", "-1", "1e10"], -50..50);
    let speed = value(
        &["0", "1", "1e-9", "3.7", "12.56636", "cos(0.3) - cos(-0.3)", "cos(pi/5) - cos(2*pi/5) - 1/2"],
        -300..300,
    );
    let place = prop::sample::select(&["left", "right", "0", "0.3", "-0.49999999", "1/2 - 1e-50", "1/2 - 1e-300"][..]);
    (time, speed, place, any::<bool>()).prop_map(|(time, speed, place, is_back)| {
        let sign = if place == "left" || place != "right" && is_back { "-" } else { "" };
        let place = match place {
            "left" | "right" => format!("wall = \"{place}\""),
            part => format!("position = \"(GAP)*({part})\""),
        };
        format!("start = {{ time = \"{time}\", {place}, velocity = \"{sign}({speed})\" }}")
    })
}

/// Upper bound of the bits that `auto` takes: 8,192 for decisions, and as many again for the digits.
const MOST_BITS: u32 = 16_384;

proptest! {
    // Some take a second.
    #![proptest_config(Config { cases: config().cases / 5, ..config() })]

    #[test]
    fn extreme_scenes_come_to_an_end(excitation in excitation(), (gap, pair) in pair(), start in start(), which in 0_usize..6) {
        let Ok(scene) = Scene::parse(&format!("{excitation}\n{pair}\n{}", start.replace("GAP", &gap))) else { return Ok(()) };
        let arithmetic = ["auto", "auto", "auto", "interval", "float", "256"][which].parse().unwrap_or(Arithmetic::Interval);
        let settings = Settings { arithmetic, impacts: Some(10), ..scene.settings() };
        let Ok(mut orbit) = Orbit::of(&scene, settings) else { return Ok(()) };
        while !matches!(orbit.advance(), Progress::Ended) {}
        prop_assert!(orbit.bits() <= MOST_BITS, "{} bits", orbit.bits());
    }
}
