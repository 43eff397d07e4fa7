//! Homoclinic tangencies: other values, words, saddles and manifolds, numbers of another size or sign.

use num_rational::BigRational;
use serde_json::{Value, json};

use super::forged::{Forged, Forgery, Original, bounds, decimal, fraction, pair};

pub const FORGERIES: &[Forgery] = &[
    Forgery { name: "tangency: parameter", why: "the manifolds are tangent at another value", forge: parameters },
    Forgery { name: "tangency: none", why: "no value in these bounds is a tangency", forge: without },
    Forgery { name: "tangency: flights", why: "the orbit of tangency has another word", forge: flights },
    Forgery { name: "tangency: quadratic", why: "the quadratic coefficient is another one", forge: quadratic },
    Forgery {
        name: "tangency: unfolding",
        why: "the manifolds pass through each other at another speed",
        forge: unfolding,
    },
    Forgery { name: "tangency: eigenvalues", why: "the saddle has other eigenvalues", forge: eigenvalues },
    Forgery { name: "tangency: saddle", why: "no saddle is there", forge: saddles },
    Forgery {
        name: "tangency: manifolds",
        why: "the point of tangency is elsewhere on the manifolds",
        forge: manifolds,
    },
    Forgery { name: "tangency: least", why: "an impact is slower, or a flight shorter", forge: least },
    Forgery { name: "tangency: key", why: "the bounds are those of another parameter", forge: keys },
];

/// Forgeries of boxes of states.
pub const IN_BOXES: &[Forgery] = &[
    Forgery { name: "tangency: sides", why: "the common points are on the other side", forge: sides },
    Forgery {
        name: "tangency: counts",
        why: "for some of these values the common points are outside the boxes, or there are two",
        forge: counts,
    },
    Forgery { name: "tangency: boxes", why: "the common points are not all in this box", forge: boxes },
    Forgery {
        name: "tangency: interval",
        why: "tangencies of a wider interval are outside the boxes",
        forge: intervals,
    },
];

/// The tangencies with their paths.
fn tangencies(original: &Original) -> Vec<(String, &Value)> {
    let all = original.document["tangencies"].as_array().filter(|_| original.is(&["tangency"]));
    all.into_iter().flatten().enumerate().map(|(i, tangency)| (format!("/tangencies/{i}"), tangency)).collect()
}

/// Bounds moved by a part of their size, and by a few of their widths.
fn moved(value: &Value) -> Vec<(String, Value)> {
    let Some([low, high]) = bounds(value) else { return Vec::new() };
    let width = &high - &low;
    let by = |what: &str, by: BigRational| (what.to_owned(), pair(&(&low + &by), &(&high + &by)));
    vec![
        by("by a millionth", &low * fraction(1, 1_000_000)),
        by("by two widths", &width * fraction(2, 1)),
        by("by minus two widths", &width * fraction(-2, 1)),
        by("by a hundredth", &low * fraction(1, 100)),
    ]
}

/// Forgeries with each result of `moved` for the bounds at a path.
fn elsewhere(original: &Original, at: &str) -> Vec<Forged> {
    let of = |(path, tangency): (String, &Value)| {
        let path = format!("{path}{at}");
        let all = moved(tangency.pointer(at).unwrap());
        all.into_iter().map(|(what, value)| original.with(what, &[(&path, value)])).collect::<Vec<_>>()
    };
    tangencies(original).into_iter().flat_map(of).collect()
}

fn parameters(original: &Original) -> Vec<Forged> {
    elsewhere(original, "/parameter")
}

/// Wider bounds of all but the parameter, whose own are beside the true one.
fn without(original: &Original) -> Vec<Forged> {
    let of = |(path, tangency): (String, &Value)| {
        let wide = |at: &str, by: &BigRational| {
            let [low, high] = bounds(tangency.pointer(at).unwrap()).unwrap();
            (format!("{path}{at}"), pair(&(low - by), &(high + by)))
        };
        let [low, high] = bounds(&tangency["parameter"]).unwrap();
        let by = fraction(1, 1_000_000_000);
        let beside = |sign: i64| pair(&(&low + &by * fraction(sign, 1)), &(&high + &by * fraction(sign, 1)));
        let others = [
            "/saddle/phase",
            "/saddle/speed",
            "/saddle/eigenvalues/0",
            "/saddle/eigenvalues/1",
            "/unstable",
            "/stable",
        ];
        [1, -1].map(|sign| {
            let mut changes: Vec<(String, Value)> =
                others.iter().map(|at| wide(at, &(&by / BigRational::from_integer(10.into())))).collect();
            changes.push((format!("{path}/parameter"), beside(sign)));
            let changes: Vec<(&str, Value)> =
                changes.iter().map(|(path, value)| (path.as_str(), value.clone())).collect();
            original.with(format!("{sign} billionth beside"), &changes)
        })
    };
    tangencies(original).into_iter().flat_map(of).collect()
}

fn flights(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, tangency) in tangencies(original) {
        let own = tangency["flights"].as_str().unwrap();
        let last = own.len() - 1;
        let others = [
            own[..last].to_owned() + "N",
            own[..last].to_owned(),
            own.replacen('N', "F", 1),
            "F".to_owned() + own,
            String::new(),
        ];
        for other in others {
            all.push(original.with(format!("{other} for {own}"), &[(&format!("{path}/flights"), json!(other))]));
        }
    }
    all
}

/// The same with the other sign.
fn negative(original: &Original, at: &str) -> Vec<Forged> {
    let of = |(path, tangency): (String, &Value)| {
        let [low, high] = bounds(tangency.pointer(at).unwrap()).unwrap();
        original.with("of the other sign", &[(&format!("{path}{at}"), pair(&-high, &-low))])
    };
    tangencies(original).into_iter().map(of).chain(elsewhere(original, at)).collect()
}

fn quadratic(original: &Original) -> Vec<Forged> {
    negative(original, "/quadratic")
}

fn unfolding(original: &Original) -> Vec<Forged> {
    negative(original, "/unfolding")
}

fn eigenvalues(original: &Original) -> Vec<Forged> {
    let exchanged = |(path, tangency): (String, &Value)| {
        let [unstable, stable] = [0, 1].map(|i| tangency["saddle"]["eigenvalues"][i].clone());
        original.with("exchanged", &[(&format!("{path}/saddle/eigenvalues"), json!([stable, unstable]))])
    };
    let exchanged = tangencies(original).into_iter().map(exchanged);
    exchanged
        .chain(["/saddle/eigenvalues/0", "/saddle/eigenvalues/1"].iter().flat_map(|at| negative(original, at)))
        .collect()
}

fn saddles(original: &Original) -> Vec<Forged> {
    ["/saddle/phase", "/saddle/speed"].iter().flat_map(|at| elsewhere(original, at)).collect()
}

fn manifolds(original: &Original) -> Vec<Forged> {
    let exchanged = |(path, tangency): (String, &Value)| {
        let [unstable, stable] = ["unstable", "stable"].map(|key| tangency[key].clone());
        original.with("exchanged", &[(&format!("{path}/unstable"), stable), (&format!("{path}/stable"), unstable)])
    };
    let exchanged = tangencies(original).into_iter().map(exchanged);
    exchanged.chain(["/unstable", "/stable"].iter().flat_map(|at| elsewhere(original, at))).collect()
}

fn least(original: &Original) -> Vec<Forged> {
    let of = |(path, _): (String, &Value)| {
        let [speed, flight] = [fraction(36, 100), fraction(109, 100)].map(|x| json!(decimal(&x)));
        [
            original.with("a larger least speed", &[(&format!("{path}/least_speed"), speed)]),
            original.with("a longer least flight", &[(&format!("{path}/least_flight"), flight)]),
        ]
    };
    tangencies(original).into_iter().flat_map(of).collect()
}

fn sides(original: &Original) -> Vec<Forged> {
    let of = |(path, tangency): (String, &Value)| {
        let at = |key: &str| format!("{path}/beside/{key}");
        let [two, none, own] = [&tangency["beside"]["two"], &tangency["beside"]["none"], &tangency["parameter"]];
        let [a, b, own] = [bounds(two)?, bounds(none)?, bounds(own)?];
        Some([
            original.with("exchanged", &[(&at("two"), none.clone()), (&at("none"), two.clone())]),
            original.with("two beyond the tangency", &[(&at("two"), pair(&a[0], &b[0]))]),
            original.with("none before the tangency", &[(&at("none"), pair(&a[1], &own[1]))]),
        ])
    };
    tangencies(original).into_iter().filter_map(of).flatten().collect()
}

/// Wider by parts of the width, downwards and upwards.
fn widened(value: &Value, [down, up]: [i64; 2]) -> Option<Value> {
    let [low, high] = bounds(value)?;
    let width = &high - &low;
    Some(pair(&(low - &width * fraction(down, 1)), &(high + &width * fraction(up, 1))))
}

fn counts(original: &Original) -> Vec<Forged> {
    let of = |(path, tangency): (String, &Value)| {
        let sides = tangency.get("beside")?;
        let wider = |key: &str, by| {
            let value = widened(&sides[key], by)?;
            Some(original.with(format!("{key} {by:?} wider"), &[(&format!("{path}/beside/{key}"), value)]))
        };
        let all = [("two", [4, 0]), ("two", [0, 4]), ("none", [2, 0]), ("none", [40, 0])];
        all.into_iter().map(|(key, by)| wider(key, by)).collect::<Option<Vec<_>>>()
    };
    tangencies(original).into_iter().filter_map(of).flatten().collect()
}

/// Boxes moved by more than half of their width.
fn boxes(original: &Original) -> Vec<Forged> {
    let of = |(path, tangency): (String, &Value)| {
        let lists = ["states", "beside/states"].map(|list| (list, tangency.pointer(&format!("/{list}"))));
        let mut all = Vec::new();
        for (list, states) in lists {
            for (k, _) in states.and_then(Value::as_array).into_iter().flatten().enumerate() {
                for key in ["phase", "speed"] {
                    let at = format!("{path}/{list}/{k}/{key}");
                    let [low, high] = bounds(original.document.pointer(&at).unwrap()).unwrap();
                    let by = (&high - &low) * fraction(3, 5);
                    all.push(original.with(format!("{list} {k} {key}"), &[(&at, pair(&(low + &by), &(high + &by)))]));
                }
            }
        }
        all
    };
    tangencies(original).into_iter().flat_map(of).collect()
}

fn intervals(original: &Original) -> Vec<Forged> {
    let is_interval = tangencies(original).iter().any(|(_, tangency)| tangency["states"].is_array());
    let wider = ["[0.69999, 0.700001]", "[0.699999, 0.70001]", "[0.7, 0.700003]"];
    let of = |other: &str| original.with(other, &[("/scene/restitution", json!(other))]);
    if is_interval { wider.into_iter().map(of).collect() } else { Vec::new() }
}

fn keys(original: &Original) -> Vec<Forged> {
    let of = |(path, _): (String, &Value)| {
        ["excitation.amplitude", "pair.restitution", "excitation.frequency"]
            .map(|key| original.with(key, &[(&format!("{path}/key"), json!(key))]))
    };
    tangencies(original).into_iter().flat_map(of).collect()
}
