//! Bounds that do not hold what they held: at the edge 0, with one digit, exchanged, a unit of the last place beyond.

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::forged::{Forged, Forgery, Original, bounds, fraction, magnitude, pair, walk};

pub const FORGERIES: &[Forgery] = &[
    Forgery { name: "bounds: at the edge 0", why: "they end before the true bounds begin", forge: at_zero },
    Forgery { name: "bounds: one digit", why: "a number of one digit is not in the true bounds", forge: of_one_digit },
    Forgery {
        name: "bounds: exchanged",
        why: "no number is above the upper bound and below the lower one",
        forge: reversed,
    },
    Forgery {
        name: "bounds: a unit beyond",
        why: "they begin a unit of the last place after the true ones end",
        forge: beyond,
    },
];

/// Pairs of bounds, one of each key first and last, of values that are in them wherever these are.
fn places(original: &Original) -> Vec<(String, [BigRational; 2])> {
    let mut all: Vec<(String, String, [BigRational; 2])> = Vec::new();
    walk(&original.document, &mut String::new(), &mut |path, value| {
        let name: String = path.split('/').filter(|part| part.parse::<usize>().is_err()).collect::<Vec<_>>().join("/");
        // A time before which nothing comes, and a start that is one of several, may be elsewhere as well.
        let is_other = ["/outcome/time", "/outcome/start", "/scene", "/expanding", "/contracting"]
            .iter()
            .any(|part| name.contains(part));
        if let Some(found) = bounds(value).filter(|_| !is_other) {
            all.push((name, path.to_owned(), found));
        }
    });
    let is_end = |k: usize| {
        let same = |other: &&(String, String, [BigRational; 2])| other.0 == all[k].0;
        !all[..k].iter().any(|other| same(&other)) || !all[k + 1..].iter().any(|other| same(&other))
    };
    // Of a shadowed orbit the last impact may be another start's as well.
    let last = format!("/events/{}", original.events().len().wrapping_sub(1));
    let is_pinned = |path: &str| original.kind != "shadow" || !path.starts_with(&last);
    (0..all.len())
        .filter(|&k| is_end(k) && is_pinned(&all[k].1))
        .map(|k| (all[k].1.clone(), all[k].2.clone()))
        .collect()
}

/// A distance beyond the bounds at which no value is true: of a shadowed orbit, whose start is one of several, some widths.
fn margin(original: &Original, [lower, upper]: &[BigRational; 2]) -> BigRational {
    if original.kind == "shadow" {
        return (upper - lower) * fraction(30, 1) + fraction(1, 1 << 50);
    }
    let ten = BigRational::from_integer(10.into());
    let mut unit = BigRational::one();
    while [lower, upper].iter().any(|bound| !(*bound / &unit).is_integer()) {
        unit /= &ten;
    }
    unit
}

fn each(original: &Original, of: impl Fn(&[BigRational; 2], &BigRational) -> Vec<[BigRational; 2]>) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, own) in places(original) {
        let margin = margin(original, &own);
        for [lower, upper] in of(&own, &margin) {
            all.push(original.with(path.clone(), &[(&path, pair(&lower, &upper))]));
        }
    }
    all
}

fn at_zero(original: &Original) -> Vec<Forged> {
    each(original, |[lower, upper], margin| {
        let zero = BigRational::zero();
        let mut all = Vec::new();
        if *lower > *margin {
            all.push([zero.clone(), lower - margin]);
        }
        if *upper < -margin {
            all.push([upper + margin, zero]);
        }
        all
    })
}

fn of_one_digit(original: &Original) -> Vec<Forged> {
    each(original, |[lower, upper], margin| {
        let power = magnitude(lower);
        let unit = if power < 0 { fraction(1, 10).pow(-power) } else { fraction(10, 1).pow(power) };
        let (below, above) = ((lower / &unit).floor() * &unit, (upper / &unit).ceil() * &unit);
        let mut all = Vec::new();
        if below < lower - margin {
            all.push([below.clone(), below]);
        }
        if above > upper + margin {
            all.push([above.clone(), above]);
        }
        all
    })
}

fn reversed(original: &Original) -> Vec<Forged> {
    each(original, |[lower, upper], _| if lower < upper { vec![[upper.clone(), lower.clone()]] } else { Vec::new() })
}

fn beyond(original: &Original) -> Vec<Forged> {
    each(original, |[lower, upper], margin| {
        let width = upper - lower;
        let (above, below) = (upper + margin, lower - margin);
        vec![[above.clone(), &above + &width], [&below - &width, below]]
    })
}
