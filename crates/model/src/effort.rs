//! How much work an answer may take, as a multiple of what is usual.

use std::fmt;
use std::str::FromStr;

use impact_pair_exact::Exact;

use crate::error::Error;

/// A multiple of the usual work of an answer, above 0: at 1 the limits of each search are its usual ones.
///
/// Which limits it multiplies each search says. All of them grow with it: more effort is never less work.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Effort(f64);

impl Effort {
    /// The greatest effort: limits of it are far beyond any computer, and far below 2^64.
    const MOST: f64 = 1e9;

    /// This many times a number that is above 0, rounded down, but at least 1.
    pub fn times(self, usual: u64) -> u64 {
        // proposes: a limit of work. The conversion ends at 2^64.
        ((usual as f64 * self.0) as u64).max(1)
    }

    /// How often 1 has to be doubled for this effort, rounded down; below 0 halved.
    pub fn doublings(self) -> i32 {
        self.0.log2().floor() as i32 // proposes: a limit of work
    }

    /// A usual number of doublings or halvings, with those of this effort, within the accepted ones.
    pub fn doubled(self, usual: u32, (least, most): (u32, u32)) -> u32 {
        usual.saturating_add_signed(self.doublings()).clamp(least, most) // proposes: a limit of work
    }
}

impl Default for Effort {
    fn default() -> Self {
        Self(1.0)
    }
}

impl FromStr for Effort {
    type Err = Error;

    /// Reads an exact number as others are read, and takes the next double.
    fn from_str(text: &str) -> Result<Self, Error> {
        let number = Exact::parse(text).ok().filter(Exact::is_point).map(|number| number.enclose(64).to_f64_bounds().1);
        number.filter(|number| *number > 0.0 && *number <= Self::MOST).map(Self).ok_or_else(|| {
            let accepted = "accepted is a number above 0 and at most 10^9, such as 0.5 or 4";
            Error::out_of_range(None, format!("the effort is \"{text}\", but {accepted}"))
        })
    }
}

impl fmt::Display for Effort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_limits_grow_with_the_effort_and_are_the_usual_ones_at_1() {
        let texts = ["1e-300", "1/1000", "0.5", "0.99", "1", "1.5", "2", "pi", "4", "1e3", "1e9"];
        let all: Vec<Effort> = texts.map(|text| text.parse().unwrap()).into();
        assert!(all.is_sorted());
        let usual = 300_000;
        let limits = |effort: &Effort| (effort.times(usual), effort.doubled(14, (8, 20)));
        assert!(all.iter().map(|effort| effort.times(usual)).is_sorted());
        assert!(all.iter().map(|effort| effort.doubled(14, (8, 20))).is_sorted());
        assert_eq!(limits(&Effort::default()), (usual, 14));
        assert_eq!(limits(&all[0]), (1, 8));
        assert_eq!(limits(&all[2]), (150_000, 13));
        assert_eq!(limits(&all[7]), (942_477, 15));
        assert_eq!(limits(&all[10]), (300_000_000_000_000, 20));
        assert_eq!(all[10].times(u64::MAX), u64::MAX);
    }

    #[test]
    fn what_is_no_number_above_0_is_refused() {
        for text in ["0", "-1", "1e10", "[1, 2]", "much", "", "inf"] {
            let error = text.parse::<Effort>().unwrap_err().to_string();
            assert!(error.contains("a number above 0 and at most 10^9"), "{error}");
        }
    }
}
