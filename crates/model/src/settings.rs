//! The settings of an orbit: its length, accuracy and arithmetic.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use crate::error::Error;
use impact_pair_exact::Exact;

/// The arithmetic of an orbit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Arithmetic {
    /// The cheapest arithmetic that certifies each impact to the requested digits: doubles first, then multiprecision,
    /// by plan. With interval data it continues as far as the widths of the data allow.
    #[default]
    Auto,
    /// Plain double precision: non-rigorous.
    Float,
    /// Certified in double precision, as far as it decides; widths are not controlled.
    Interval,
    /// Certified by the textbook method in the intervals of the package inari: plain interval arithmetic, for one harmonic, in a build
    /// with the feature `inari`.
    Inari,
    /// For a chaotic orbit, certified in double precision for any number of impacts: a true orbit from a start very near the
    /// given one. Without expansion, as [`Arithmetic::Interval`] from the exact start; after a release, whose state is exact, as
    /// [`Arithmetic::Auto`].
    Shadow,
    /// Certified at this precision in bits, as far as it decides; widths are not controlled.
    Bits(u32),
}

impl Arithmetic {
    /// Returns whether the arithmetic is rigorous.
    pub fn is_certified(self) -> bool {
        match self {
            Self::Float => false,
            Self::Auto | Self::Interval | Self::Inari | Self::Shadow | Self::Bits(_) => true,
        }
    }

    /// Error for the name of an arithmetic that this build does not have.
    pub fn unknown(text: &str) -> Error {
        if text == "inari" {
            let target = if cfg!(feature = "inari") {
                "for a processor with fused multiply-add, such as -C target-cpu=x86-64-v3"
            } else {
                "with the cargo feature \"inari\""
            };
            let message = format!("the arithmetic inari is not in this build: build impact-pair {target}");
            return Error::out_of_range(None, message);
        }
        let inari = if INARI { "inari, " } else { "" };
        let (least, most) = BITS.into_inner();
        let accepted = format!("auto, float, interval, {inari}shadow or a number of bits from {least} to {most}");
        Error::out_of_range(None, format!("the arithmetic is \"{text}\", but accepted are {accepted}"))
    }
}

/// The accepted numbers of digits.
pub const DIGITS: RangeInclusive<u32> = 1..=400;

/// Refuses a number of digits outside [`DIGITS`].
///
/// # Errors
/// If `digits` is not in [`DIGITS`].
pub fn require_digits(digits: u32) -> Result<(), Error> {
    let (least, most) = DIGITS.into_inner();
    Error::require_range("digits", &Exact::from(i64::from(digits)), least.into(), most.into())
}

/// The settings of an orbit: its length, accuracy and arithmetic.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Stop after this number of impacts.
    pub impacts: Option<u64>,
    /// Stop at this time \[time\].
    pub until: Option<Exact>,
    /// Requested widths: `10^-digits`, of a time relative to `2 pi/W`, of a velocity relative to `A W`.
    pub digits: u32,
    /// The arithmetic.
    pub arithmetic: Arithmetic,
    /// Maximum precision of [`Arithmetic::Auto`], in bits.
    pub max_bits: u32,
    /// Number of impacts that [`Arithmetic::Shadow`] first proves in higher precision; the start of the orbit is then nearer to
    /// the given one.
    pub splice: u64,
    /// True if a proof that the motion converges to a periodic orbit is tried at the end.
    pub attractor: bool,
}

/// True if this build has the arithmetic `inari`: it was asked for, and the target has an instruction for fused multiply-add.
pub const INARI: bool = cfg!(all(feature = "inari", target_feature = "fma"));
/// Default of [`Settings::max_bits`].
pub const MAX_BITS: u32 = 1_000_000;
/// Accepted precisions, in bits.
pub const BITS: RangeInclusive<u32> = 64..=10_000_000;

impl Settings {
    /// Refuses settings that are outside the accepted ranges.
    ///
    /// # Errors
    /// If the digits or a number of bits are not accepted.
    pub fn require_accepted(&self) -> Result<(), Error> {
        require_digits(self.digits)?;
        match self.arithmetic {
            Arithmetic::Bits(bits) if !BITS.contains(&bits) => Err(Arithmetic::unknown(&bits.to_string())),
            _ => Ok(()),
        }
    }
}

impl Default for Settings {
    /// A hundred impacts at nine digits, `auto`; no attractor is sought.
    fn default() -> Self {
        Self {
            impacts: Some(100),
            until: None,
            digits: 9,
            arithmetic: Arithmetic::Auto,
            max_bits: MAX_BITS,
            splice: 0,
            attractor: false,
        }
    }
}

/// Spelling of the command line: `auto`, `float`, `interval`, `inari`, `shadow`, or a number of bits.
impl FromStr for Arithmetic {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        match text {
            "auto" => Ok(Self::Auto),
            "float" => Ok(Self::Float),
            "interval" => Ok(Self::Interval),
            "inari" if INARI => Ok(Self::Inari),
            "shadow" => Ok(Self::Shadow),
            _ => match text.parse() {
                Ok(bits) if BITS.contains(&bits) => Ok(Self::Bits(bits)),
                _ => Err(Self::unknown(text)),
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
            Self::Shadow => f.pad("shadow"),
            Self::Bits(bits) => f.pad(&bits.to_string()),
        }
    }
}
