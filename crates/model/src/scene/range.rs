//! Ranges of the values of a key: [`Range`].

use std::fmt;
use std::str::FromStr;

use super::Key;
use crate::error::Error;
use impact_pair_exact::{Exact, ExactError};

/// The values of a key from `low` to `high`, endpoints included: `KEY=LO..HI`, or `KEY=LO..HI:COUNT` for COUNT of them, or COUNT cells.
///
/// ```
/// use impact_pair_model::scene::{Key, Range};
/// let range: Range = "pair.gap=2..3:5".parse()?;
/// assert_eq!((range.key, range.low.text().as_str(), range.count), (Key::Gap, "2", Some(5)));
/// assert_eq!(range.value(1, 4)?.text(), "2.25");
/// assert!("gap=3..2".parse::<Range>().is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Range {
    /// The key.
    pub key: Key,
    /// Its least value.
    pub low: Exact,
    /// Its greatest value.
    pub high: Exact,
    /// The number of values or cells, if one is given.
    pub count: Option<u64>,
}

impl Range {
    /// Returns the number of values; all of them at once are one.
    pub fn points(&self) -> u64 {
        self.count.unwrap_or(1)
    }

    /// Returns `low + (high - low) index/of`; at both ends the number as it is written.
    ///
    /// # Errors
    /// If it exceeds the range of exact expressions.
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

    /// Reads a range that `is_accepted`; `accepted` says what is, in words.
    ///
    /// # Errors
    /// If the text is no range, or it is not accepted.
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
        let end = |text: &str| Exact::parse(text).ok().filter(Exact::is_point);
        let range = || {
            let (low, high) = (end(low)?, end(high)?);
            let count = count.map(|count| count.trim().parse()).transpose().ok()?;
            low.compare(&high)?.is_lt().then_some(Self { key, low, high, count })
        };
        range().filter(is_accepted).ok_or_else(refused)
    }
}

impl FromStr for Range {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let accepted = "KEY=LO..HI or KEY=LO..HI:COUNT with single numbers LO < HI and a whole number COUNT";
        Self::parse(text, accepted, |_| true)
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}..{}", self.key, self.low, self.high)?;
        self.count.map_or(Ok(()), |count| write!(f, ":{count}"))
    }
}
