//! Numbers of documents: decimals, and texts of the user.

use impact_pair_exact::{Enclosure, Exact, decimal_bounds};
use num_rational::BigRational;
use num_traits::Signed;
use serde::{Deserialize, Serialize, Serializer};
use std::cmp::Ordering;
use std::fmt;
use std::ops::Deref;

/// A number written as a decimal, such as `-1.5e-3`.
///
/// Decimals of one value are equal, however they are written.
#[derive(Clone, Debug, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema), schemars(extend("pattern" = PATTERN)))]
#[serde(try_from = "String")]
pub struct Decimal(String);

/// The decimals that are read, as a regular expression of JSON Schema.
#[cfg(feature = "schemas")]
const PATTERN: &str = r"^-?(0|[1-9][0-9]*)(\.[0-9]+)?([eE][+-]?[0-9]+)?$";

/// A lower bound and an upper one: where the lower bound is above the upper one, they are not read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "[B; 2]", bound(deserialize = "B: Bound + Deserialize<'de>"))]
pub struct Between<B>([B; 2]);

/// Bounds of a number, rounded outward.
pub type Bounds = Between<Decimal>;

/// An end of what lies between two bounds.
pub trait Bound {
    /// Returns whether this bound is at most another one; `None` where one of them is no number.
    fn is_at_most(&self, other: &Self) -> Option<bool>;
}

impl Bound for Decimal {
    fn is_at_most(&self, other: &Self) -> Option<bool> {
        Some(self.value() <= other.value())
    }
}

/// Nothing bounds from one side.
impl Bound for Option<Decimal> {
    fn is_at_most(&self, other: &Self) -> Option<bool> {
        Some(self.as_ref().zip(other.as_ref()).is_none_or(|(low, high)| low.value() <= high.value()))
    }
}

/// A decimal, or an infinity.
impl Bound for String {
    fn is_at_most(&self, other: &Self) -> Option<bool> {
        let read = |text: &str| match text {
            "-inf" => Some((-1, None)),
            "inf" => Some((1, None)),
            text => Some((0, Some(value(text)?))),
        };
        Some(read(self)? <= read(other)?)
    }
}

impl Bound for u32 {
    fn is_at_most(&self, other: &Self) -> Option<bool> {
        Some(self <= other)
    }
}

impl<B: Bound> TryFrom<[B; 2]> for Between<B> {
    type Error = &'static str;

    fn try_from(bounds: [B; 2]) -> Result<Self, Self::Error> {
        match bounds[0].is_at_most(&bounds[1]) {
            Some(true) => Ok(Self(bounds)),
            Some(false) => Err("the lower bound is above the upper one"),
            None => Err("bounds are decimals, \"-inf\" and \"inf\""),
        }
    }
}

/// A whole number up to a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "u32")]
pub struct UpTo<const MOST: u32>(u32);

impl<const MOST: u32> UpTo<MOST> {
    /// A number that this project has counted within the limit.
    pub fn counted(number: usize) -> Self {
        Self(number as u32) // exact: at most the limit
    }

    /// Returns the number.
    pub fn get(self) -> u32 {
        self.0
    }
}

impl<const MOST: u32> TryFrom<u32> for UpTo<MOST> {
    type Error = String;

    fn try_from(number: u32) -> Result<Self, String> {
        if number <= MOST { Ok(Self(number)) } else { Err(format!("accepted is at most {MOST}")) }
    }
}

/// A decimal that is not negative.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Decimal")]
pub struct NotNegative(Decimal);

impl TryFrom<Decimal> for NotNegative {
    type Error = &'static str;

    fn try_from(number: Decimal) -> Result<Self, Self::Error> {
        if number.value().is_negative() { Err("accepted is a decimal that is not negative") } else { Ok(Self(number)) }
    }
}

impl NotNegative {
    /// A decimal that this project has printed.
    pub fn printed(text: String) -> Self {
        Self(Decimal::printed(text))
    }
}

impl Deref for NotNegative {
    type Target = Decimal;

    fn deref(&self) -> &Decimal {
        &self.0
    }
}

impl<B> Between<B> {
    /// Bounds that this project has computed, in order.
    pub fn computed(bounds: [B; 2]) -> Self {
        Self(bounds)
    }
}

impl Bounds {
    /// The values of both.
    pub fn values(&self) -> [BigRational; 2] {
        self.0.each_ref().map(Decimal::value)
    }
}

/// For the eye: `1.5 to 2`.
impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = &self.0;
        write!(f, "{} to {}", low.text(), high.text())
    }
}

impl<B> Deref for Between<B> {
    type Target = [B; 2];

    fn deref(&self) -> &[B; 2] {
        &self.0
    }
}

/// Returns the bounds of an enclosure.
///
/// ```
/// use impact_pair_document::bounds;
/// use impact_pair_exact::Exact;
///
/// let [low, high] = &*bounds(&Exact::parse("pi").expect("a number").enclose(53));
/// assert!(low.text().starts_with("3.14159265358979") && high.text().starts_with("3.14159265358979"));
/// assert!(low.value() < high.value());
/// ```
pub fn bounds(x: &Enclosure) -> Bounds {
    Between(decimal_bounds(x).map(Decimal))
}

impl Decimal {
    /// Returns a decimal that this project has printed.
    pub fn printed(text: String) -> Self {
        Self(text)
    }

    /// Returns its text.
    pub fn text(&self) -> &str {
        &self.0
    }

    /// Returns the text in which this project prints the value, however it is written.
    pub fn canonical(&self) -> String {
        Exact::from_rational(self.value()).text()
    }

    /// Returns its value.
    ///
    /// # Panics
    /// Never for a decimal that was read or printed.
    pub fn value(&self) -> BigRational {
        value(&self.0).expect("a decimal")
    }
}

impl PartialEq for Decimal {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0 || self.value() == other.value()
    }
}

fn value(text: &str) -> Option<BigRational> {
    if is_decimal(text) { Exact::parse(text).ok()?.as_rational().cloned() } else { None }
}

/// Returns whether a text is a number in JSON's syntax, which every reader of decimals reads as the same number.
fn is_decimal(text: &str) -> bool {
    let are_digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let unsigned = text.strip_prefix('-').unwrap_or(text);
    let (number, exponent) = unsigned.split_once(['e', 'E']).unwrap_or((unsigned, "0"));
    let (whole, places) = number.split_once('.').unwrap_or((number, "0"));
    let exponent = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let is_padded = whole.len() > 1 && whole.starts_with('0');
    are_digits(whole) && !is_padded && are_digits(places) && are_digits(exponent)
}

impl TryFrom<String> for Decimal {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        if value(&text).is_some() { Ok(Self(text)) } else { Err("must be a decimal in a string") }
    }
}

/// An exact number as the user wrote it.
///
/// Two of them are equal where that is proved: however they are written, and both ends of intervals.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "String")]
pub struct Written(pub Exact);

impl TryFrom<String> for Written {
    type Error = String;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        Exact::parse(&text).map(Self).map_err(|error| format!("does not read as a number: {error}"))
    }
}

impl From<&Exact> for Written {
    fn from(number: &Exact) -> Self {
        Self(number.clone())
    }
}

impl Serialize for Written {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.0.text())
    }
}

impl PartialEq for Written {
    fn eq(&self, other: &Self) -> bool {
        let is_one = |a: &Exact, b: &Exact| a.compare(b) == Some(Ordering::Equal);
        let are_ends = || match (self.0.ends(), other.0.ends()) {
            (Some((a, b)), Some((c, d))) => is_one(&a, &c) && is_one(&b, &d),
            _ => false,
        };
        self.0.text() == other.0.text() || are_ends()
    }
}

#[cfg(feature = "schemas")]
impl<B: schemars::JsonSchema> schemars::JsonSchema for Between<B> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        <[B; 2]>::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        <[B; 2]>::json_schema(generator)
    }
}

#[cfg(feature = "schemas")]
impl<const MOST: u32> schemars::JsonSchema for UpTo<MOST> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        u32::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let mut schema = u32::json_schema(generator);
        schema.insert("maximum".to_owned(), MOST.into());
        schema
    }
}

#[cfg(feature = "schemas")]
impl schemars::JsonSchema for NotNegative {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "NotNegative".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "description": "A decimal that is not negative.",
            "type": "string",
            "pattern": PATTERN.replace("^-?", "^"),
        })
    }
}

#[cfg(feature = "schemas")]
impl schemars::JsonSchema for Written {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Written".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        String::json_schema(generator)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Texts that are not numbers in JSON's syntax, such as sums, are refused: some readers accept them and others do not.
    #[test]
    fn r40_bounds_are_plain_decimals() {
        for text in ["0", "-0", "12.50", "-1.5e-3", "2E+7", "0.1", "10e0"] {
            assert!(Decimal::try_from(text.to_owned()).is_ok(), "{text}");
        }
        for text in [
            "5-4.4", "1+1", "+1", "--1", ".5", "5.", "007", "", "-", "1e", "1e5-2", "1.2.3", "e5", "1e1.5", " 1", "1_0",
        ] {
            assert!(Decimal::try_from(text.to_owned()).is_err(), "{text}");
        }
    }
}
