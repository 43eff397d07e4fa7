//! Starts of branches: orbits of the word at values spread over the range. Non-rigorous.

// Labels: proposes throughout.

use super::super::chain::Chain;
use super::super::guess::guesses;
use super::super::identity::View;
use super::family::Varied;
use super::over::Parameter;
use super::ring::Ring;
use crate::Error;
use crate::exact::Exact;
use crate::scene::Range;
use crate::watch::Watch;
use impact_pair_model::Start;

/// Values of the parameter at which orbits are looked for, less one.
const INTERVALS: u32 = 6;
/// Difference in forcing periods below which two phases count as equal.
const SAME_PHASE: f64 = 1e-7;

/// An orbit in floating point: its ring, its phases and its parameter.
pub(super) struct Seed {
    pub ring: Ring,
    /// The phases, then the parameter.
    pub x: Vec<f64>,
}

/// Orbits of the chain at some values of the parameter, symmetric and repeated ones on the rings of their parts; those that
/// are found before the watch stops it.
///
/// # Errors
/// If the range goes beyond the values that the parameter may have.
pub(super) fn seeds<S: Varied>(
    chain: &Chain,
    (parameter, start): (&Parameter, &Start),
    watch: &dyn Watch,
) -> Result<Vec<Seed>, Error> {
    let mut found: Vec<Seed> = Vec::new();
    for value in values(&parameter.over).into_iter().take_while(|_| watch.goes_on()) {
        let p = parameter.in_doubles(&value)?;
        let there = parameter.pair_at(value)?;
        // Without one of its harmonics the excitation is another one.
        let Some(shaken) = S::of(&there) else { continue };
        let from = found.len();
        for phases in guesses(chain, &shaken, &there, start).take_while(|_| watch.goes_on()) {
            let mut x = phases.clone();
            x.push(p);
            let is_new = |seed: &Seed| !is_same(chain, &seed.ring.lift(&seed.x[..seed.x.len() - 1]), &phases);
            if found[from..].iter().all(is_new) {
                found.push(fold(Ring::whole(chain.clone()), x));
            }
        }
    }
    Ok(found)
}

/// Values spread over the range, its ends among them.
fn values(over: &Range) -> Vec<Exact> {
    let part = |i: u32| {
        let weight = |n: u32| Exact::from(i64::from(n));
        let [low, high] = [(over.low(), INTERVALS - i), (over.high(), i)].map(|(end, n)| end.checked_mul(&weight(n)));
        let sum = low.ok()?.checked_add(&high.ok()?);
        sum.ok()?.checked_div(&weight(INTERVALS)).ok()
    };
    (0..=INTERVALS).filter_map(part).collect()
}

/// The orbit on the smallest ring that holds it.
fn fold(ring: Ring, x: Vec<f64>) -> Seed {
    let (p, phases) = x.split_last().expect("a parameter");
    let smaller = ring.parts().find(|part| {
        // The chain of a part that repeats is another one; it lifts to this one by being run through again.
        let unknowns = part.unknowns();
        let lifted = (unknowns..phases.len()).map(|i| phases[i - unknowns] + part.turns());
        phases[unknowns..].iter().zip(lifted).all(|(a, b)| (a - b).abs() < SAME_PHASE)
    });
    match smaller {
        Some(part) => {
            let x = [&phases[..part.unknowns()], &[*p]].concat();
            fold(part, x)
        }
        None => Seed { ring, x },
    }
}

/// Whether two orbits are one or mirror images, from whichever impact on. The chain of `one` may be half of the chain of `other`.
pub(super) fn is_same(chain: &Chain, one: &[f64], other: &[f64]) -> bool {
    let doubled: Vec<f64>;
    let one = if one.len() < other.len() && other.len().is_multiple_of(one.len()) {
        let times = other.len() / one.len();
        let turns = f64::from(chain.cycles()) / times as f64;
        doubled = (0..other.len()).map(|i| one[i % one.len()] + (i / one.len()) as f64 * turns).collect();
        &doubled
    } else {
        one
    };
    [false, true].into_iter().flat_map(|mirrored| View::of(chain, mirrored)).any(|view| {
        let count = other.len();
        let moved = |i: usize| {
            let at = i + view.shift;
            one[at % count] + if at >= count { f64::from(chain.cycles()) } else { 0.0 }
                - if view.mirrored { chain.mirror().unwrap_or(0.0) } else { 0.0 }
        };
        let period = f64::from(chain.period());
        let turns = ((moved(0) - other[0]) / period).round() * period;
        (0..count).all(|i| (moved(i) - turns - other[i]).abs() < SAME_PHASE)
    })
}
