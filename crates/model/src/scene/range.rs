//! Ranges of the values of a key: [`Range`], and of what varies: [`Over`].

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

use super::Key;
use crate::error::{Error, within};
use crate::pair::ImpactPair;
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
        Self::read(text, str::parse, accepted, is_accepted)
    }

    /// The same, with the key as `key` reads it.
    fn read(
        text: &str,
        read_key: impl Fn(&str) -> Result<Key, Error>,
        accepted: &str,
        is_accepted: impl Fn(&Self) -> bool,
    ) -> Result<Self, Error> {
        let parts = || {
            let (key, rest) = text.split_once('=')?;
            let (ends, count) = rest.rsplit_once(':').map_or((rest, None), |(ends, count)| (ends, Some(count)));
            let (low, high) = ends.split_once("..")?;
            Some((key, low, high, count))
        };
        let refused = || Error::out_of_range(None, format!("the range is \"{text}\", but accepted is {accepted}"));
        let (key, low, high, count) = parts().ok_or_else(refused)?;
        let key = read_key(key.trim())?;
        let range = || {
            let (low, high) = (Exact::parse(low).ok()?, Exact::parse(high).ok()?);
            let count = count.map(|count| count.trim().parse()).transpose().ok()?;
            Self::new(key, low, high, count).ok()
        };
        range().filter(is_accepted).ok_or_else(refused)
    }
}

/// What varies, as requests say it: the values of a key, or `A/d=LO..HI`, values of the amplitude while the gap stays.
///
/// ```
/// use impact_pair_model::Scene;
/// use impact_pair_model::scene::Over;
/// let scene = Scene::parse(r#"
///     excitation = { A = 1, W = "pi", tau = 0 }
///     pair = { d = 9.5, e = 0.5 }
///     start = { time = 0, wall = "left", velocity = -1 }
/// "#)?;
/// let over = Over::parse("A/d=0.2..1/2:3", "KEY=LO..HI:COUNT", |range| range.count() == Some(3))?;
/// assert_eq!(over.of(scene.pair())?.to_string(), "amplitude=1.9..4.75:3");
/// # Ok::<(), impact_pair_model::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Over {
    /// The values; of `A/d` those of the amplitude, over the gap.
    range: Range,
    is_of_gap: bool,
}

/// The key of amplitudes over the gap.
const AMPLITUDE_OVER_GAP: &str = "A/d";

impl Over {
    /// Reads what varies, of which the range `is_accepted`; `accepted` describes accepted ranges in words.
    ///
    /// # Errors
    /// If the text is not a range, or the range is not accepted.
    pub fn parse(text: &str, accepted: &str, is_accepted: impl Fn(&Range) -> bool) -> Result<Self, Error> {
        let is_of_gap = text.split_once('=').is_some_and(|(key, _)| key.trim() == AMPLITUDE_OVER_GAP);
        let read_key = |key: &str| if is_of_gap { Ok(Key::Amplitude(None)) } else { key.parse() };
        Ok(Self { range: Range::read(text, read_key, accepted, is_accepted)?, is_of_gap })
    }

    /// The key that varies.
    pub fn key(&self) -> Key {
        self.range.key()
    }

    /// The number of values or cells, if one is given.
    pub fn count(&self) -> Option<u64> {
        self.range.count()
    }

    /// The values of the key for a pair.
    ///
    /// # Errors
    /// Of `A/d`, if the gap is an interval, or if a value exceeds the range of exact expressions.
    pub fn of(&self, pair: &ImpactPair) -> Result<Range, Error> {
        if !self.is_of_gap {
            return Ok(self.range.clone());
        }
        let gap = pair.gap();
        if !gap.is_point() {
            return Err(Error::range("pair.gap", gap, "must be a single number where A/d varies"));
        }
        let amplitude = |ratio: &Exact| within(AMPLITUDE_OVER_GAP, ratio, ratio.checked_mul(gap));
        let Range { key, low, high, count } = &self.range;
        Range::new(*key, amplitude(low)?, amplitude(high)?, *count)
    }

    /// The values of all keys that vary together.
    ///
    /// # Errors
    /// As of [`Over::of`], and if the gap varies beside `A/d`.
    pub fn all(overs: &[Self], pair: &ImpactPair) -> Result<Vec<Range>, Error> {
        if let Some(over) = overs.iter().find(|over| over.is_of_gap)
            && overs.iter().any(|over| over.key() == Key::Gap)
        {
            let message =
                format!("over {over} the gap stays, but another range is of the gap: accepted is amplitude=LO..HI");
            return Err(Error::out_of_range(None, message));
        }
        overs.iter().map(|over| over.of(pair)).collect()
    }
}

impl fmt::Display for Over {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_of_gap { self.range.written(AMPLITUDE_OVER_GAP, f) } else { self.range.fmt(f) }
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
        self.written(&self.key.to_string(), f)
    }
}

impl Range {
    /// Writes the range as one of this key.
    fn written(&self, key: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{key}={}..{}", self.low, self.high)?;
        self.count.map_or(Ok(()), |count| write!(f, ":{count}"))
    }
}
