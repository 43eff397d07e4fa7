//! Check of a claimed entropy from words that may follow one another (Lemmas D10, V12).

use num_rational::BigRational;
use num_traits::Signed;

use impact_pair_exact::{Dyadic, Real};

/// Bits of the sums.
const BITS: u32 = 256;
/// Greater entropies are not judged.
const MAX_ENTROPY: i64 = 64;
/// Words that weigh more are not judged: their flights last longer than any that is followed.
const MAX_WEIGHT: i64 = 1 << 16;
/// Entropies that are given are multiples of one in N parts.
const ENTROPY_DENOMINATOR: i64 = 10_000;
/// Steps towards an eigenvector.
const POWER_ITERATIONS: u32 = 1000;

/// Encloses `e^x`, `0 <= x <= MAX_ENTROPY`.
pub(super) fn exponential(x: &Real) -> Real {
    let (mut sum, mut term, mut n) = (Real::zero(BITS), Real::int(1, BITS), 0);
    let tiny = Dyadic::power_of_two(-i64::from(BITS) - 2);
    loop {
        sum = sum + &term;
        n += 1;
        term = (term * x).over(&Real::int(n, BITS)).expect("a positive number");
        let most = term.enclosure().mag();
        // V12: each term more is at most half of the one before
        if n > 2 * MAX_ENTROPY && most <= tiny {
            let rest = Real::zero(BITS).hull(&Real::point(most.scaled(1), BITS));
            return sum + &rest;
        }
    }
}

/// Returns whether the entropy `h` is proved, for words given by the h-sets that they lead from and to, and their weights.
pub(super) fn is_reached(words: &[(usize, usize, i64)], bases: usize, h: &BigRational) -> bool {
    let most = BigRational::from_integer(MAX_ENTROPY.into());
    if !h.is_positive() {
        return true; // exact: no entropy is negative
    }
    if *h > most || words.iter().any(|&(.., weight)| !(1..=MAX_WEIGHT).contains(&weight)) {
        return false; // exact: nothing is proved
    }
    let e = exponential(&Real::rational(h, BITS));
    let Some(q) = Real::int(1, BITS).over(&e) else { return false };
    let longest = words.iter().map(|&(.., weight)| weight).max().unwrap_or(0); // exact: none where there are no words
    let mut powers = vec![Real::int(1, BITS)];
    for k in 0..longest {
        powers.push(powers[k as usize].clone() * &q); // exact: not negative
    }
    let mut matrix = vec![vec![Real::zero(BITS); bases]; bases];
    for &(from, to, weight) in words {
        matrix[from][to] = matrix[from][to].clone() + &powers[weight as usize]; // exact: not negative
    }
    let vector = eigenvector(&matrix);
    let image =
        |row: &[Real]| row.iter().zip(&vector).fold(Real::zero(BITS), |sum, (entry, x)| sum + &(entry.clone() * x));
    let is_kept = |(row, x): (&Vec<Real>, &Real)| !(image(row) - x).enclosure().inf().sign().is_lt();
    vector.iter().any(Real::is_positive) && matrix.iter().zip(&vector).all(is_kept)
}

/// The greatest multiple of 1/10,000 that [`is_reached`], as a decimal; `None` where that is 0.
pub(super) fn at_least(words: &[(usize, usize, i64)], bases: usize) -> Option<String> {
    let decimal = |n: i64| BigRational::new(n.into(), ENTROPY_DENOMINATOR.into());
    // The first is reached, the second is not.
    let [mut low, mut high] = [0, MAX_ENTROPY * ENTROPY_DENOMINATOR + 1];
    while low + 1 < high {
        let middle = i64::midpoint(low, high);
        *(if is_reached(words, bases, &decimal(middle)) { &mut low } else { &mut high }) = middle;
    }
    (low > 0).then(|| format!("{}.{:04}", low / ENTROPY_DENOMINATOR, low % ENTROPY_DENOMINATOR))
}

/// A vector without negative members, about that of the greatest eigenvalue: any will do.
fn eigenvector(matrix: &[Vec<Real>]) -> Vec<Real> {
    let size = matrix.len();
    let mut vector = vec![Real::int(1, BITS); size];
    for _ in 0..POWER_ITERATIONS {
        let image = |a: usize| (0..size).fold(vector[a].clone(), |sum, b| sum + &(matrix[a][b].clone() * &vector[b]));
        let image: Vec<Real> = (0..size).map(image).collect();
        let top = image.iter().filter_map(|x| x.enclosure().mag().top()).max().unwrap_or(0); // proposes: a size
        let scaled = |x: &Real| {
            let middle = x.mid().scaled(-top);
            let is_small = middle.top().is_none_or(|size| size < NEGLIGIBLE);
            Real::point(if is_small { Dyadic::zero() } else { middle }, BITS)
        };
        vector = image.iter().map(scaled).collect();
    }
    vector
}

/// Smaller members, as a power of two beside the greatest, are those of h-sets that no word leads back from.
const NEGLIGIBLE: i64 = -30;
