//! Certificates of every outcome, under one harmonic and several, and of periodic orbits.

use impact_pair::ImpactPair;
use impact_pair::Scene;
use impact_pair::document;
use impact_pair::mapping::Word;
use impact_pair::orbit::{Arithmetic, Settings, Start};
use impact_pair::pair::Wall;
use impact_pair::periodic::{Precision, Problem};
use impact_pair::two_impact::{self, Unknown};
use impact_pair::units::Units;
use serde_json::{Value, json};

/// Scenes with names and the outcome each must have.
const SCENES: [(&str, &str, &str); 17] = [
    (
        "count",
        "impacts-reached",
        r#"
        excitation = { amplitude = 8, frequency = "pi", phase = 0 }
        pair = { gap = 9.42497, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -12.56636 }
        run = { impacts = 6 }"#,
    ),
    (
        "time",
        "time-reached",
        r#"
        excitation = { amplitude = 8, frequency = "pi", phase = 0 }
        pair = { gap = 9.42497, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -12.56636 }
        run = { until = "2*pi/3" }"#,
    ),
    (
        "time of three harmonics",
        "time-reached",
        r#"
        excitation = { amplitude = [1, 0.7, 0.4], frequency = ["pi", "sqrt(2)*pi", "pi/3"], phase = [0.3, 1, 2] }
        pair = { gap = 3, restitution = 0.6 }
        start = { time = 0.25, wall = "left", velocity = -4 }
        run = { until = 3 }"#,
    ),
    (
        "inside",
        "impacts-reached",
        r#"
        excitation = { amplitude = [1, "1/3"], frequency = ["pi", "2*pi"], phase = 0 }
        pair = { gap = 3, restitution = 0.6 }
        start = { time = 0.5, position = 0.3, velocity = 1 }
        run = { impacts = 4 }"#,
    ),
    (
        "attracted",
        "attracted",
        r#"
        excitation = { amplitude = 2, frequency = "pi", phase = 0 }
        pair = { gap = 9.42497, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -12.56636 }
        run = { impacts = 16 }"#,
    ),
    (
        "attracted in a time",
        "attracted",
        r#"
        excitation = { amplitude = 2, frequency = "pi", phase = 0 }
        pair = { gap = 9.42497, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -12.56636 }
        run = { until = "15.5" }"#,
    ),
    (
        "attracted under two",
        "attracted",
        r#"
        excitation = { amplitude = [1, "1/5"], frequency = ["2*pi", "3*pi"], phase = 0 }
        pair = { gap = 9.42497, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -25 }
        run = { impacts = 60 }"#,
    ),
    (
        "chatter",
        "periodic",
        r#"
        excitation = { amplitude = 1, frequency = "pi", phase = "pi" }
        pair = { gap = 9.42497, restitution = 0.3 }
        start = { time = 0, wall = "left", velocity = -0.5 }
        run = { impacts = 40 }"#,
    ),
    (
        "chatter in a time",
        "time-reached",
        r#"
        excitation = { amplitude = 1, frequency = "pi", phase = "pi" }
        pair = { gap = 9.42497, restitution = 0.3 }
        start = { time = 0, wall = "left", velocity = -0.5 }
        run = { until = "1/2" }"#,
    ),
    (
        "dead impacts under two",
        "periodic",
        r#"
        excitation = { amplitude = [1, "1/2"], frequency = ["pi", "2*pi/3"], phase = 0 }
        pair = { gap = 2, restitution = 0 }
        start = { time = 0, wall = "left", velocity = -1 }
        run = { impacts = 24 }"#,
    ),
    (
        "rest",
        "rests-forever",
        r#"
        excitation = { amplitude = 0, frequency = 1, phase = 0 }
        pair = { gap = 2, restitution = 0 }
        start = { time = 0, position = 0, velocity = -1 }
        run = { impacts = 5 }"#,
    ),
    (
        "never",
        "never-impacts",
        r#"
        excitation = { amplitude = 1, frequency = 1, phase = "pi/2" }
        pair = { gap = 4.5, restitution = 0.5 }
        start = { time = 0, position = -1, velocity = 0 }
        run = { impacts = 5 }"#,
    ),
    (
        "grazes for ever",
        "periodic",
        r#"
        excitation = { amplitude = 1, frequency = 1, phase = "pi/2" }
        pair = { gap = 4, restitution = 0.5 }
        start = { time = 0, position = 0, velocity = 0 }
        run = { impacts = 5 }"#,
    ),
    (
        "graze",
        "impacts-reached",
        r#"
        excitation = { amplitude = 1, frequency = 2, phase = 0.7 }
        pair = { gap = 5.51996296806061375229774706079800496119226455, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -0.4 }
        run = { impacts = 3 }"#,
    ),
    (
        "intervals",
        "impacts-reached",
        r#"
        excitation = { amplitude = "[8, 8 + 1e-9]", frequency = "pi", phase = 0 }
        pair = { gap = 9.42497, restitution = "[1/2, 1/2 + 1e-9]" }
        start = { time = 0, wall = "left", velocity = -12.56636 }
        run = { impacts = 4 }"#,
    ),
    (
        "too wide",
        "undecided",
        r#"
        excitation = { amplitude = "[8, 8.001]", frequency = "pi", phase = 0 }
        pair = { gap = 9.42497, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -12.56636 }
        run = { impacts = 40 }"#,
    ),
    (
        "too long",
        "undecided",
        r#"
        excitation = { amplitude = 0, frequency = 1, phase = 0 }
        pair = { gap = 2, restitution = 1 }
        start = { time = 0, position = 0, velocity = 1e-30 }
        run = { impacts = 4 }"#,
    ),
];

/// Chaotic ones: their velocities are varied, or times where the first one is 0.
const SHADOWED: [(&str, &str); 2] = [
    (
        "shadowed",
        r#"
        excitation = { amplitude = 8, frequency = "pi", phase = 0 }
        pair = { gap = 9.42497, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -12.56636 }
        run = { impacts = 8 }"#,
    ),
    (
        "shadowed in time",
        r#"
        excitation = { amplitude = 10, frequency = "200*pi", phase = 1.047196 }
        pair = { gap = 10, restitution = 0.8 }
        start = { time = 0, wall = "left", velocity = 0 }
        run = { impacts = 6 }"#,
    ),
];

/// The orbit JSON of a scene, its impacts as narrow as `arithmetic` makes them.
pub fn orbit(scene: &str, arithmetic: Arithmetic) -> Value {
    let scene = Scene::parse(scene).unwrap();
    let settings = Settings { arithmetic, attractor: true, ..scene.settings() };
    json!(document::orbit(scene.pair(), scene.start(), settings).unwrap())
}

/// The periodic JSON of a word.
pub fn periodic((pair, start): (&ImpactPair, &Start), word: &Word, cycles: u32, digits: u32) -> Value {
    let problem = Problem::new(pair, word, cycles).unwrap();
    let census = problem.find(start, Precision { digits, ..Precision::default() });
    json!(Units::gaps(pair).unwrap().document(&problem, start, &census))
}

/// The periodic JSON of two-impact motions.
pub fn two_impact((pair, start): (&ImpactPair, &Start), cycles: u32, digits: u32, wall: Wall) -> Value {
    let answer = two_impact::Problem::new(pair, cycles, Unknown::Velocity).unwrap().answer(digits);
    json!(document::two_impact(start, &answer, wall))
}

pub fn all() -> Vec<(String, Value)> {
    let orbits = SCENES.iter().map(|(name, outcome, scene)| {
        let document = orbit(scene, Arithmetic::Auto);
        assert_eq!(document["outcome"]["kind"], *outcome, "{name}: {}", document["outcome"]);
        ((*name).to_owned(), document)
    });
    let shadows = SHADOWED.map(|(name, scene)| {
        let document = orbit(scene, Arithmetic::Shadow);
        assert_eq!(document["claim"], "shadowed", "{name}");
        (name.to_owned(), document)
    });
    let scene = |amplitude: &str, frequency: &str, gap: &str, restitution: &str| {
        Scene::parse(&format!(
            "excitation = {{ amplitude = {amplitude}, frequency = {frequency}, phase = 0 }}\n\
             pair = {{ gap = {gap}, restitution = {restitution} }}\nstart = {{ time = 0, wall = \"left\", velocity = -12 }}"
        ))
        .unwrap()
    };
    let of = |scene: &Scene| (scene.pair().clone(), scene.start().clone());
    let one = of(&scene("2", "\"pi\"", "9.42497", "0.5"));
    let unstable = of(&scene("2", "\"10*pi\"", "1", "0.8"));
    let several = of(&scene("[1, \"1/5\"]", "[\"2*pi\", \"3*pi\"]", "9.42497", "0.5"));
    // Its motions of two impacts all touch a wall earlier.
    let steep = of(&scene("4", "1", "2", "0.5"));
    let even = of(&scene("1", "1", "10.82", "0.5"));
    orbits
        .chain(shadows)
        .chain([
            ("stable and unstable".to_owned(), periodic((&one.0, &one.1), &"P1 P2".parse().unwrap(), 1, 9)),
            ("five impacts".to_owned(), periodic((&unstable.0, &unstable.1), &"P4 P4 P1 P3 P2".parse().unwrap(), 1, 9)),
            ("three turns".to_owned(), periodic((&several.0, &several.1), &"P1 P2".parse().unwrap(), 3, 9)),
            ("two impacts".to_owned(), two_impact((&even.0, &even.1), 2, 9, Wall::Left)),
            ("two from the right".to_owned(), two_impact((&one.0, &one.1), 1, 9, Wall::Right)),
            ("not physical".to_owned(), two_impact((&steep.0, &steep.1), 1, 9, Wall::Left)),
        ])
        .collect()
}
