//! Boxes keep the orbits in them, and enclosures of a flight hold its exact values.

use proptest::prelude::*;
use serde_json::{Value, json};

use super::*;
use crate::check::{Limits, Verdict};
use crate::periodic::{OrbitOf, PeriodicCertificate};
use impact_pair_exact::Dyadic;
use impact_pair_model::watch::Unwatched;

/// Lists of orbits of different words, in several periods, the last two under two harmonics.
const LISTS: [&str; 6] = [
    include_str!("../../../tests/documents/every-orbit.jsonl"),
    include_str!("../../../tests/documents/five-impacts.jsonl"),
    include_str!("../../../tests/documents/four-orbits.jsonl"),
    include_str!("../../../tests/documents/orbits-in-two-cycles.jsonl"),
    include_str!("../../../tests/documents/orbits-in-six-cycles.jsonl"),
    include_str!("../../../tests/documents/three-turns.jsonl"),
];

fn certificate(text: &str) -> PeriodicCertificate {
    let value: Value = serde_json::from_str(text.lines().next().unwrap()).unwrap();
    PeriodicCertificate::read(&[value]).unwrap().0
}

/// The admissible orbits of a list, with its equations.
fn admissible(certificate: &PeriodicCertificate) -> (Equations, Vec<Vec<Span>>) {
    let data = Data::new(&certificate.pair, &certificate.start).unwrap();
    let orbits = certificate.orbits.iter().filter(|claim| claim.orbit.physical == Some(true));
    let orbits: Vec<&OrbitOf> = orbits.collect();
    let claims: Vec<_> = orbits.iter().map(|claim| &claim.orbit).collect();
    let OrbitOf { word, cycles, .. } = orbits[0];
    let List { equations, listed, .. } = List::new(&data, word, *cycles, &claims).unwrap();
    (equations, listed)
}

fn holds(cell: &Cell, phases: &[Span]) -> bool {
    cell.phases.iter().zip(phases).all(|(own, its)| own.common(*its).is_some())
}

proptest! {
    /// A box about an orbit, which may lie at its ends, is never empty and keeps the orbit.
    #[test]
    fn boxes_keep_their_orbits(number in 0..LISTS.len(), which in 0usize..16, exponent in -20.0..0.5f64,
                               at in proptest::collection::vec((0.0..=1.0f64, 0u8..4), 16)) {
        let (equations, listed) = admissible(&certificate(LISTS[number]));
        let phases = &listed[which % listed.len()];
        let later = Span::point(-(phases[0].lo() / equations.period).floor() * equations.period);
        let phases: Vec<Span> = phases.iter().map(|&phase| phase + later).collect();
        let mut cell = equations.everything().unwrap().unwrap();
        prop_assert!(holds(&cell, &phases));
        let width = exponent.exp2();
        for ((own, its), (at, end)) in cell.phases.iter_mut().zip(&phases).zip(at) {
            let part = match end { 0 => 0.0, 1 => 1.0, _ => at };
            let lo = its.lo() - part * width;
            *own = own.common(Span::new(lo, (lo + width).max(its.hi()))).unwrap();
        }
        let kept = equations.contracted(cell.clone());
        prop_assert!(kept.as_ref().is_some_and(|kept| holds(kept, &phases)), "{cell:?}\n{kept:?}\n{phases:?}");
    }

    /// Against many bits: means, and velocities over the time of a hop.
    #[test]
    fn a_flight_holds_its_exact_values(number in 0..LISTS.len(), from in 0.0..2.0f64, exponent in -30.0..1.0f64,
                                       radius in prop_oneof![Just(0.0), 1e-9..0.1f64], at in -1.0..=1.0f64) {
        let (equations, _) = admissible(&certificate(LISTS[number]));
        let hop = (0..equations.count()).find(|&i| equations.next(i) != 0).unwrap();
        let time = exponent.exp2();
        let exact = |x: f64| Real::point(Dyadic::from_f64(x).unwrap(), 256);
        let (start, end) = (from + at * radius, from + at * radius + time);
        let data = certificate(LISTS[number]);
        let data = Data::new(&data.pair, &data.start).unwrap();
        let turn = Real::pi(256) * 2;
        // E and E' at a phase, in gap widths and forcing periods
        let wave = |u: f64| {
            let gap = Real::of(&data.half_gap, 256) * 2;
            let reference = Real::of(&data.tones[0].phase, 256);
            let passed = exact(u) * &turn - &reference;
            data.tones.iter().fold((Real::zero(256), Real::zero(256)), |(sum, slope), tone| {
                let rate = tone.rate.as_ref().map_or(Real::int(1, 256), |rate| Real::of(rate, 256));
                let passed = passed.clone() - &(turn.clone() * &Real::rational(&data.turns.clone().into(), 256));
                let (sin, cos) = (Real::of(&tone.phase, 256) + &(rate.clone() * &passed)).sin_cos();
                let size = Real::of(&tone.amplitude, 256).over(&gap).unwrap();
                (sum + &(size.clone() * &sin), slope + &(size * &rate * &turn * &cos))
            })
        };
        let ((e0, v0), (e1, v1)) = (wave(start), wave(end));
        let taken = exact(end) - &exact(start);
        let mean = (e1 - &e0).over(&taken).unwrap();
        let mut phases = vec![Span::point(0.0); equations.count()];
        phases[hop] = Span::new(from - radius, from + radius);
        phases[hop + 1] = Span::new(end - radius, end + radius);
        let along = equations.along(&phases, hop, Span::new(time.next_down(), time.next_up()).hull(Span::of(taken.enclosure())));
        let is_in = |range: Span, value: &Real| {
            let (low, high) = value.enclosure().to_f64_bounds();
            range.lo() <= high && low <= range.hi()
        };
        prop_assert!(is_in(along.mean().unwrap(), &mean), "{:?} {mean:?}", along.mean());
        let [after, before] = along.hop();
        let ratios = [mean.clone() - &v0, mean - &v1].map(|speed| speed.over(&taken).unwrap());
        prop_assert!(is_in(after, &ratios[0]) && is_in(before, &ratios[1]), "{after:?} {before:?} {ratios:?}");
    }
}

fn verdict(document: &Value) -> Verdict {
    let (certificate, _) = PeriodicCertificate::read(std::slice::from_ref(document)).unwrap();
    certificate.check_within(&Limits::default(), &Unwatched).unwrap()
}

/// Without one of its orbits a list is confirmed by no tree.
#[test]
fn a_list_that_lacks_an_orbit_is_not_complete() {
    let document: Value = serde_json::from_str(LISTS[0]).unwrap();
    let tree = document["witness"]["tree"].as_str().unwrap();
    assert!(matches!(verdict(&document), Verdict::Confirmed { .. }));
    for i in 0..document["orbits"].as_array().unwrap().len() {
        for tree in [tree, "-", "a.5--"] {
            let mut lacking = document.clone();
            lacking["orbits"].as_array_mut().unwrap().remove(i);
            lacking["witness"] = json!({"tree": tree});
            assert!(matches!(verdict(&lacking), Verdict::Undecided(_)), "orbit {i}, {tree}");
        }
    }
}
