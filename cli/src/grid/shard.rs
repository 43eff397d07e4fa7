//! One of several parts of a sweep or an atlas: `I/N`.

use std::str::FromStr;

/// One of several parts of a sweep or an atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 1.
    pub number: u64,
    pub of: u64,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = || {
            let (number, of) = text.split_once('/')?;
            let (number, of) = (number.parse().ok()?, of.parse().ok()?);
            (1..=of).contains(&number).then_some(Self { number, of })
        };
        numbers().ok_or_else(|| "accepted is I/N with I from 1 to N, such as 1/3".into())
    }
}
