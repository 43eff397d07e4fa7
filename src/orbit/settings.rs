//! How far an orbit is followed, and what computes it.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use crate::error::Error;
use crate::exact::Exact;

/// What computes the orbit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Arithmetic {
    /// The cheapest that certifies each impact to the asked digits: doubles first, then multiprecision, by plan. With
    /// intervals among the data it goes on as far as their own width allows.
    #[default]
    Auto,
    /// Plain double precision: nothing is proved.
    Float,
    /// Certified in double precision, as far as it decides; widths are what they are.
    Interval,
    /// Certified by the textbook method in `inari`'s intervals: what plain interval arithmetic does; of one harmonic.
    Inari,
    /// Certified in so many bits, as far as they decide; widths are what they are.
    Bits(u32),
}

/// How far an orbit is followed, and how.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Stop after so many impacts.
    pub impacts: Option<u64>,
    /// Stop at this time \[time\].
    pub until: Option<Exact>,
    /// Widths asked for: `10^-digits`, of a time relative to `2 pi/W`, of a velocity relative to `A W`.
    pub digits: u32,
    /// What computes.
    pub arithmetic: Arithmetic,
    /// Bits that [`Arithmetic::Auto`] takes at most.
    pub max_bits: u32,
    /// Whether to prove at the end, if possible, that the motion converges to a periodic orbit:
    /// [`Outcome::Attracted`](super::Outcome::Attracted).
    pub attractor: bool,
}

/// What is taken for [`Settings::max_bits`] when nothing is said.
pub const MAX_BITS: u32 = 1_000_000;
/// The bits that an orbit can be computed with.
pub const BITS: RangeInclusive<u32> = 64..=1_000_000_000;

impl Default for Settings {
    /// A hundred impacts at nine digits, `auto`; no attractor is sought.
    fn default() -> Self {
        Self {
            impacts: Some(100),
            until: None,
            digits: 9,
            arithmetic: Arithmetic::Auto,
            max_bits: MAX_BITS,
            attractor: false,
        }
    }
}

/// A width asked for; below the range of doubles it is 0 there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Width {
    pub linear: f64,
    pub log2: f64,
}

impl Width {
    /// `10^-digits` of `unit`, less a fiftieth, which printing may add.
    pub fn new(digits: u32, unit: f64) -> Self {
        let log2 = unit.log2() - f64::from(digits) * 10f64.log2();
        Self { linear: 0.98 * unit * 10f64.powi(-(digits.min(400) as i32)), log2: log2 + 0.98f64.log2() } // shown
    }
}

/// As the command line says it: `auto`, `float`, `interval`, `inari`, or a number of bits.
impl FromStr for Arithmetic {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        match text {
            "auto" => Ok(Self::Auto),
            "float" => Ok(Self::Float),
            "interval" => Ok(Self::Interval),
            "inari" => Ok(Self::Inari),
            _ => match text.parse() {
                Ok(bits) if BITS.contains(&bits) && cfg!(feature = "multiprecision") => Ok(Self::Bits(bits)),
                _ => Err(Error::arithmetic(text)),
            },
        }
    }
}

impl fmt::Display for Arithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.pad("auto"),
            Self::Float => f.pad("float"),
            Self::Interval => f.pad("interval"),
            Self::Inari => f.pad("inari"),
            Self::Bits(bits) => f.pad(&bits.to_string()),
        }
    }
}
