//! Fractions of a range of a parameter, rounded so that no more is said to be proved than is. Lemma D14

use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

use impact_pair_document::SharesDocument;

use super::{Cells, Stretch, Verdict};
use crate::exact::Exact;
use crate::scene::Range;

/// The fractions are whole numbers of these parts of the range.
const PARTS: i64 = 1_000_000;
/// Bits that a fraction which is not rational is enclosed with.
const BITS: u32 = 64;

/// The direction in which a fraction is rounded.
#[derive(Clone, Copy)]
enum Rounded {
    Down,
    Up,
}

/// Returns the fractions of a range in which something is proved, rounded down, and that in which nothing is, rounded up.
pub(super) fn shares(over: &Range, cells: &Cells) -> SharesDocument {
    let share = |is: fn(&Verdict) -> bool, rounded| {
        let is = |stretch: &&Stretch| is(&stretch.verdict);
        if cells.stretches.iter().all(|stretch| is(&stretch)) {
            return 1.0;
        }
        let parts = cells.stretches.iter().filter(is).map(|stretch| [&stretch.low, &stretch.high]);
        fraction(parts, [over.low(), over.high()], rounded)
    };
    SharesDocument {
        horseshoe: share(|verdict| verdict.horseshoe().is_some(), Rounded::Down),
        attracted: share(|verdict| matches!(verdict, Verdict::Attracted { .. }), Rounded::Down),
        stable: share(|verdict| matches!(verdict, Verdict::Stable { .. }), Rounded::Down),
        both: share(|verdict| verdict.period().is_some() && verdict.horseshoe().is_some(), Rounded::Down),
        undecided: share(|verdict| *verdict == Verdict::Undecided, Rounded::Up),
    }
}

/// The fraction of a range that parts of it are; where their widths are beyond exact expressions, 0 rounded down and 1 rounded up.
fn fraction<'p>(parts: impl Iterator<Item = [&'p Exact; 2]>, all: [&Exact; 2], rounded: Rounded) -> f64 {
    let end = |part| end_of_fraction(part, all, rounded);
    let sum = parts.map(end).try_fold(BigRational::zero(), |sum, part| Some(sum + part?));
    let whole = BigRational::from_integer(PARTS.into());
    // D14: a fraction lies between 0 and 1
    let parts = match (sum, rounded) {
        (Some(sum), Rounded::Down) => (sum * &whole).floor().max(BigRational::zero()), // D14: at least 0
        (Some(sum), Rounded::Up) => (sum * &whole).ceil().min(whole),                  // D14: at most 1
        (None, Rounded::Down) => BigRational::zero(),
        (None, Rounded::Up) => whole,
    };
    // D14: a number of millionths; written in JSON it is that decimal
    parts.to_integer().to_i64().unwrap_or(0) as f64 / PARTS as f64
}

/// A lower or an upper bound of the fraction of a range that a part of it is, exact where it is rational.
fn end_of_fraction([low, high]: [&Exact; 2], all: [&Exact; 2], rounded: Rounded) -> Option<BigRational> {
    let long = |low: &Exact, high: &Exact| high.checked_sub(low);
    let part = long(low, high).ok()?.checked_div(&long(all[0], all[1]).ok()?).ok()?;
    if let Some(exact) = part.as_rational() {
        return Some(exact.clone());
    }
    let enclosed = part.enclose(BITS);
    Some(match rounded {
        Rounded::Down => enclosed.inf().to_rational(),
        Rounded::Up => enclosed.sup().to_rational(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rounded_shares(parts: &[[&str; 2]], all: [&str; 2]) -> [f64; 2] {
        let number = |text: &str| Exact::parse(text).unwrap();
        let parts: Vec<[Exact; 2]> = parts.iter().map(|part| part.map(number)).collect();
        let all = all.map(number);
        [Rounded::Down, Rounded::Up]
            .map(|rounded| fraction(parts.iter().map(|[a, b]| [a, b]), [&all[0], &all[1]], rounded))
    }

    /// A range with a gap of less than half a millionth was said to be proved as a whole, and nothing of it to be undecided.
    #[test]
    fn r41_shares_are_rounded_outward() {
        assert_eq!(rounded_shares(&[["0", "0.9999999"]], ["0", "1"]), [0.999_999, 1.0]);
        assert_eq!(rounded_shares(&[["0.9999999", "1"]], ["0", "1"]), [0.0, 0.000_001]);
        assert_eq!(rounded_shares(&[["2", "7/3"]], ["2", "3"]), [0.333_333, 0.333_334]);
        // Exact fractions are not rounded, in any unit.
        assert_eq!(rounded_shares(&[["1", "1.25"], ["1.5", "1.75"]], ["1", "2"]), [0.5, 0.5]);
        assert_eq!(rounded_shares(&[["pi", "1.5*pi"]], ["pi", "2*pi"]), [0.5, 0.5]);
        assert_eq!(rounded_shares(&[["sqrt(2)", "sqrt(2)+1e-9"]], ["sqrt(2)", "sqrt(2)+1e-3"]), [0.000_001, 0.000_001]);
        assert_eq!(rounded_shares(&[["0", "1/2"]], ["0", "sqrt(2)"]), [0.353_553, 0.353_554]);
        assert_eq!(rounded_shares(&[], ["0", "1"]), [0.0, 0.0]);
    }
}
