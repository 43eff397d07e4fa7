//! The list that is compared: events of another simulator, read exactly, from text or JSON.

/// Ends a function with the error that a list does not read as one.
macro_rules! refuse {
    ($($said:tt)*) => { return Err($crate::Error::list(format!($($said)*))) };
}

mod json;
mod text;

use impact_pair_document::ListedRow;
use num_rational::BigRational;
use num_traits::Signed;

use crate::exact::{Enclosure, Exact};
use crate::pair::Wall;
use crate::{Error, ImpactPair};

/// Layout of a list: the columns of times, walls and velocities.
#[derive(Clone, Debug)]
pub struct Columns {
    /// The times \[time\].
    pub time: Column,
    /// The walls, by name, by sign or by position.
    pub wall: Column,
    /// `y'` just before each impact \[length/time\]; `None`: velocities are not compared.
    pub velocity: Option<Column>,
}

impl Default for Columns {
    /// Columns under their usual names, or else the first three.
    fn default() -> Self {
        Self { time: Column::time(None), wall: Column::wall(None), velocity: Some(Column::velocity(None)) }
    }
}

/// Usual names of `y'` just before an impact, the explicit ones first.
const VELOCITIES: [&str; 8] =
    ["v_minus", "v-", "v_before", "velocity_minus", "velocity_before", "velocity", "v", "vel"];

/// The name of a column, given or usual, and the option that gives it.
#[derive(Clone, Debug)]
pub struct Column {
    /// Command-line option that names the column.
    flag: &'static str,
    /// Usual names of the column.
    names: &'static [&'static str],
    /// The name or the number given.
    given: Option<String>,
}

impl Column {
    /// Column of times: by its name or its number from 1, or under a usual name.
    pub fn time(given: Option<String>) -> Self {
        Self { flag: "--time-column", names: &["time", "t"], given }
    }

    /// Column of walls.
    pub fn wall(given: Option<String>) -> Self {
        Self { flag: "--wall-column", names: &["wall", "side"], given }
    }

    /// Column of velocities.
    pub fn velocity(given: Option<String>) -> Self {
        Self { flag: "--velocity-column", names: &VELOCITIES, given }
    }

    /// Names that the column may have: the given one, or the usual ones.
    fn names(&self) -> impl Iterator<Item = &str> {
        let usual = if self.given.is_some() { &[] } else { self.names };
        self.given.as_deref().into_iter().chain(usual.iter().copied())
    }

    /// The error that there is no such column in `what`.
    fn missing(&self, what: &str) -> Error {
        let (names, flag) = (self.names().collect::<Vec<_>>().join(" or "), self.flag);
        Error::list(format!("{what} has no {names}: say which one it is by {flag} NAME"))
    }
}

/// Events of another simulator, and the columns of its list that are not read.
#[derive(Clone, Debug)]
pub struct List {
    /// The events, in their order; at least one.
    pub rows: Vec<Listed>,
    /// The names of columns that are not read, `column 4` where one has no name.
    pub unused: Vec<String>,
    /// True if velocities are looked for.
    pub velocities: bool,
}

/// An event as listed.
pub type Listed = ListedRow<Number>;

/// A number as listed: a decimal, or two bounds.
#[derive(Clone, Debug)]
pub struct Number {
    /// The decimal, or the lower bound.
    pub low: BigRational,
    /// The decimal, or the upper bound.
    pub high: BigRational,
    /// The text as it is written.
    pub written: String,
}

impl Number {
    /// Exactly the decimal; `None` for anything else.
    pub fn decimal(text: &str) -> Option<Self> {
        let value = Exact::parse(text).ok().filter(|_| is_decimal(text))?.as_rational()?.clone();
        Some(Self { low: value.clone(), high: value, written: text.to_owned() })
    }

    /// The interval between two bounds; `None` if they are out of order.
    pub fn between([low, high]: [Self; 2]) -> Option<Self> {
        let is_point = low.low == high.low;
        let written = if is_point { low.written } else { format!("[{}, {}]", low.written, high.written) };
        (low.low <= high.low).then_some(Self { low: low.low, high: high.low, written })
    }

    /// Encloses the number, with ends of `bits` bits.
    pub(super) fn enclose(&self, bits: u32) -> Enclosure {
        Enclosure::from_rational(&self.low, bits).hull(&Enclosure::from_rational(&self.high, bits))
    }
}

/// Whether a text is one decimal, such as `-1.5e+00`, and no expression.
fn is_decimal(text: &str) -> bool {
    let unsigned = |text: &str| -> String { text.strip_prefix(['+', '-']).unwrap_or(text).to_owned() }; // exact: a text
    let is_natural = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let text = unsigned(text);
    let (mantissa, exponent) = text.split_once(['e', 'E']).map_or((text.as_str(), None), |(m, e)| (m, Some(e)));
    is_natural(&mantissa.replacen('.', "", 1)) && exponent.is_none_or(|exponent| is_natural(&unsigned(exponent)))
}

/// Accepted walls, in words.
const WALLS: &str = "left, right, L, R, -1, +1 or a position near -d/2 or +d/2";

/// Reads walls by name, by sign or by position.
struct Walls {
    /// `d/2`, about.
    half: BigRational,
}

impl Walls {
    /// Reader for the walls of a box with this gap \[length\].
    fn new(gap: &Exact) -> Self {
        let gap = gap.enclose(64);
        let two = BigRational::from_integer(2.into());
        Self { half: (gap.inf().to_rational() + gap.sup().to_rational()) / &two / two }
    }

    /// The wall; a position must be nearer to it than to the middle of the gap, so that no other code passes for one.
    fn read(&self, text: &str) -> Option<Wall> {
        match text.to_ascii_lowercase().as_str() {
            "left" | "l" => return Some(Wall::Left),
            "right" | "r" => return Some(Wall::Right),
            _ => {}
        }
        let position = Number::decimal(text)?.low;
        let size = position.abs();
        let is_code = size == BigRational::from_integer(1.into());
        // Nearer to d/2 than to 0 is within d/4 of it.
        let is_near = (&size - &self.half).abs() * BigRational::from_integer(2.into()) < self.half;
        let wall = if position.is_negative() { Wall::Left } else { Wall::Right };
        (is_code || is_near).then_some(wall)
    }
}

/// Reads a list in any of the accepted formats.
///
/// Text has commas, semicolons, tabs or blanks between columns. It has a header, a header in a comment, or none. Two columns may bound one
/// quantity (`time_lower`, `time_upper`). With a column `event`, rows of other events than `impact` are skipped. JSON is an array of objects, an
/// object of arrays, JSON Lines, or the orbit JSON. Walls may be positions near `-d/2` and `d/2` of the pair.
///
/// # Errors
/// If the list is malformed ([`ErrorKind::List`](crate::ErrorKind::List)): the message names the place, the value and what is accepted.
pub fn read(text: &str, columns: &Columns, pair: &ImpactPair) -> Result<List, Error> {
    let walls = &Walls::new(pair.gap());
    let text = text.trim_start_matches('\u{feff}');
    match text.trim_start().chars().next() {
        None => Err(Error::list("the list is empty: accepted is at least one event".into())),
        Some('{' | '[') => json::read(text, columns, walls),
        Some(_) => text::read(text, columns, walls),
    }
}

/// Whether an event in a list is an impact; other events are skipped.
fn is_impact_name(event: &str) -> bool {
    event.eq_ignore_ascii_case("impact")
}

fn read_wall(place: &str, wall: &str, walls: &Walls) -> Result<Wall, Error> {
    walls.read(wall).ok_or_else(|| refused(place, "wall", wall, WALLS))
}

fn refused(place: &str, name: &str, written: &str, accepted: &str) -> Error {
    Error::list(format!("{place}: {name} is `{}`, but accepted is {accepted}", shortened(written)))
}

/// A text cut to a length fit for a message.
fn shortened(text: &str) -> String {
    let mut shown: String = text.chars().take(60).collect();
    if shown.len() < text.len() {
        shown.push_str("...");
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_exact_and_nothing_else_is_one() {
        let tenth = BigRational::new(1.into(), 10.into());
        for text in ["0.1", "+1e-1", "1.0E-01", ".1", "1.e-1", "100e-3"] {
            assert_eq!(Number::decimal(text).unwrap().low, tenth, "{text}");
        }
        for text in ["", "-", ".", "nan", "inf", "-Infinity", "1-2", "pi", "1/3", "[0, 1]", "0x1", "1e", "1,5", "1.2.3"]
        {
            assert!(Number::decimal(text).is_none(), "{text}");
        }
    }

    #[test]
    fn walls_by_name_sign_or_position() {
        let walls = Walls::new(&Exact::parse("9.42497").unwrap());
        for text in ["left", "Left", "L", "l", "-1", "-1.0", "-4.712485", "-4.7124849999"] {
            assert_eq!(walls.read(text), Some(Wall::Left), "{text}");
        }
        for text in ["right", "R", "1", "+1", "4.712485", "4.8"] {
            assert_eq!(walls.read(text), Some(Wall::Right), "{text}");
        }
        for text in ["0", "2", "-2.3", "7.1", "100", "top", "", "nan", "lr"] {
            assert_eq!(walls.read(text), None, "{text}");
        }
    }
}
