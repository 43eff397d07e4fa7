//! Upper bounds of the growth rate of the number of words: Lemmas D30 and D31.

use num_bigint::BigUint;
use num_traits::{One, ToPrimitive};

use crate::chaos::boxes::parts;
use crate::number::{Ball, Number, logarithm, up};

/// Bits of a count that are looked at.
const COUNT_BITS: u64 = 52;
/// Steps towards a vector, and those without progress after which there are no more.
const POWER_ITERATIONS: usize = 20_000;
const STALLED_ITERATIONS: usize = 200;

/// Upper bound of the logarithm of a count over the length of the words. Lemma D30
pub(super) fn rate(count: &BigUint, letters: u32) -> f64 {
    if count.is_one() {
        return 0.0; // exact: its logarithm
    }
    let shift = count.bits().saturating_sub(COUNT_BITS); // D30: of a short one no bits are left out
    let leading = (count >> shift).to_f64().unwrap_or(f64::INFINITY) + 1.0; // exact: below 2^53
    let two = logarithm(Ball::exact(2.0)).expect("a positive number");
    let sum = logarithm(Ball::exact(leading)).map(|log| log + two * Ball::exact(shift as f64)); // exact: a small whole number
    let rate = sum.and_then(|sum| sum.checked_div(Ball::exact(f64::from(letters))));
    rate.map_or(f64::INFINITY, above)
}

/// Upper bound of the growth rate of the number of paths. Lemma D31
pub(super) fn limit(steps: &[[Option<u32>; 2]]) -> f64 {
    let radius = parts(&successors(steps)).iter().map(|part| radius(steps, part)).fold(1.0, f64::max); // D31: at least one path goes on
    if radius == 1.0 { 0.0 } else { logarithm(Ball::exact(radius)).map_or(f64::INFINITY, above) } // exact: the logarithm of 1
}

fn above(x: Ball) -> f64 {
    (x.mid() + x.rad()).next_up().max(0.0) // D30: a count is at least 1
}

/// Upper bound of the spectral radius of a strongly connected part: `M v <= r v` for a positive vector `v`. Lemma D31
fn radius(steps: &[[Option<u32>; 2]], part: &[usize]) -> f64 {
    let place = |node: u32| part.binary_search(&(node as usize)).ok(); // exact: an index
    let inside: Vec<Vec<usize>> =
        part.iter().map(|&node| steps[node].iter().flatten().filter_map(|&to| place(to)).collect()).collect();
    let mut vector = vec![1.0f64; part.len()];
    let (mut least, mut since) = (f64::INFINITY, 0);
    for _ in 0..POWER_ITERATIONS {
        let image: Vec<f64> = inside
            .iter()
            .map(|to| match to[..] {
                [a, b] => up(vector[a] + vector[b]),
                [a] => vector[a],
                _ => 0.0, // exact: it leads nowhere in its part
            })
            .collect();
        let quotient = |image: f64, x: f64| if image == x { 1.0 } else { up(image / x) };
        let ratio = image.iter().zip(&vector).map(|(image, x)| quotient(*image, *x)).fold(0.0, f64::max); // D31: of all members
        since = if ratio < least { 0 } else { since + 1 };
        least = least.min(ratio); // D31: each vector proves its own
        if since > STALLED_ITERATIONS {
            break;
        }
        // proposes: any positive vector
        let most = vector.iter().zip(&image).map(|(x, image)| x + image).fold(0.0, f64::max);
        vector.iter_mut().zip(&image).for_each(|(x, image)| *x = ((*x + image) / most).max(f64::MIN_POSITIVE)); // proposes: any positive vector
    }
    least
}

/// The nodes that each one leads to.
fn successors(steps: &[[Option<u32>; 2]]) -> Vec<Vec<usize>> {
    steps.iter().map(|steps| steps.iter().flatten().map(|&to| to as usize).collect()).collect() // exact: indices
}
