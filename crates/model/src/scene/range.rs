//! Ranges of the values of a key: [`Range`].

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

use super::Key;
use crate::error::Error;
use impact_pair_exact::{Exact, ExactError};

const ACCEPTED: &str = "KEY=LO..HI or KEY=LO..HI:COUNT with single numbers LO < HI and a whole number COUNT";

/// The values of a key from `low` to `high`, ends included: `KEY=LO..HI`, or `KEY=LO..HI:COUNT` for COUNT values or cells.
///
/// ```
/// use impact_pair_model::scene::{Key, Range};
/// let range: Range = "pair.gap=2..3:5".parse()?;
/// assert_eq!((range.key(), range.low().text().as_str(), range.count()), (Key::Gap, "2", Some(5)));
/// assert_eq!(range.value(1, 4)?.text(), "2.25");
/// assert!("gap=3..2".parse::<Range>().is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Range {
    key: Key,
    low: Exact,
    high: Exact,
    count: Option<u64>,
}

impl Range {
    /// The values of a key from `low` to `high`.
    ///
    /// # Errors
    /// If the ends are not single numbers, or `low < high` is not proved.
    pub fn new(key: Key, low: Exact, high: Exact, count: Option<u64>) -> Result<Self, Error> {
        let range = Self { key, low, high, count };
        let is_one = range.low.is_point() && range.high.is_point();
        if is_one && range.low.compare(&range.high) == Some(Ordering::Less) {
            return Ok(range);
        }
        Err(Error::out_of_range(None, format!("the range is \"{range}\", but accepted is {ACCEPTED}")))
    }

    /// The key.
    pub fn key(&self) -> Key {
        self.key
    }

    /// The least value, a single number.
    pub fn low(&self) -> &Exact {
        &self.low
    }

    /// The greatest value, a single number.
    pub fn high(&self) -> &Exact {
        &self.high
    }

    /// The number of values or cells, if one is given.
    pub fn count(&self) -> Option<u64> {
        self.count
    }

    /// The number of values; 1 if the range stands for all values at once.
    pub fn points(&self) -> u64 {
        self.count.unwrap_or(1)
    }

    /// `low + (high - low) index/of`; at both ends the number as written.
    ///
    /// # Errors
    /// If the value exceeds the range of exact expressions.
    pub fn value(&self, index: u64, of: u64) -> Result<Exact, ExactError> {
        if index == 0 {
            return Ok(self.low.clone());
        }
        if index >= of {
            return Ok(self.high.clone());
        }
        let whole = |n: u64| Exact::from(i64::try_from(n).unwrap_or(i64::MAX));
        let part = whole(index).checked_div(&whole(of))?;
        self.low.checked_add(&self.high.checked_sub(&self.low)?.checked_mul(&part)?)
    }

    /// Reads a range that `is_accepted`; `accepted` describes accepted ranges in words.
    ///
    /// # Errors
    /// If the text is not a range, or the range is not accepted.
    pub fn parse(text: &str, accepted: &str, is_accepted: impl Fn(&Self) -> bool) -> Result<Self, Error> {
        let parts = || {
            let (key, rest) = text.split_once('=')?;
            let (ends, count) = rest.rsplit_once(':').map_or((rest, None), |(ends, count)| (ends, Some(count)));
            let (low, high) = ends.split_once("..")?;
            Some((key, low, high, count))
        };
        let refused = || Error::out_of_range(None, format!("the range is \"{text}\", but accepted is {accepted}"));
        let (key, low, high, count) = parts().ok_or_else(refused)?;
        let key = key.trim().parse()?;
        let range = || {
            let (low, high) = (Exact::parse(low).ok()?, Exact::parse(high).ok()?);
            let count = count.map(|count| count.trim().parse()).transpose().ok()?;
            Self::new(key, low, high, count).ok()
        };
        range().filter(is_accepted).ok_or_else(refused)
    }
}

impl FromStr for Range {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        Self::parse(text, ACCEPTED, |_| true)
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}..{}", self.key, self.low, self.high)?;
        self.count.map_or(Ok(()), |count| write!(f, ":{count}"))
    }
}
