//! The list that is judged: events of another simulator, read exactly, from text or JSON.

mod json;
mod text;

use anyhow::{Result, bail};
use impact_pair::exact::{Enclosure, Exact};
use impact_pair::pair::Wall;
use num_rational::BigRational;
use num_traits::Signed;

use super::arguments::Columns;

/// An event as it is listed.
#[derive(Clone, Debug)]
pub struct Listed {
    /// Where it stands: `line 7`, `events[6]`.
    pub place: String,
    pub wall: Wall,
    /// \[time\]
    pub time: Number,
    /// `y'` just before the impact \[length/time\], if it is listed.
    pub velocity: Option<Number>,
}

/// A number as it is listed: a decimal, or two bounds.
#[derive(Clone, Debug)]
pub struct Number {
    pub low: BigRational,
    pub high: BigRational,
    pub written: String,
}

impl Number {
    /// Exactly the decimal; `None` for anything else.
    fn decimal(text: &str) -> Option<Self> {
        let value = Exact::parse(text).ok().filter(|_| is_decimal(text))?.as_rational()?.clone();
        Some(Self { low: value.clone(), high: value, written: text.to_owned() })
    }

    /// What lies between two bounds; `None` if they are out of order.
    fn between([low, high]: [Self; 2]) -> Option<Self> {
        let is_point = low.low == high.low;
        let written = if is_point { low.written } else { format!("[{}, {}]", low.written, high.written) };
        (low.low <= high.low).then_some(Self { low: low.low, high: high.low, written })
    }

    /// Encloses it in ends of so many bits.
    pub fn enclose(&self, bits: u32) -> Enclosure {
        Enclosure::from_rational(&self.low, bits).hull(&Enclosure::from_rational(&self.high, bits))
    }
}

/// Whether a text is one decimal, such as `-1.5e+00`, and no expression.
fn is_decimal(text: &str) -> bool {
    let unsigned = |text: &str| -> String { text.strip_prefix(['+', '-']).unwrap_or(text).to_owned() };
    let is_natural = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let text = unsigned(text);
    let (mantissa, exponent) = text.split_once(['e', 'E']).map_or((text.as_str(), None), |(m, e)| (m, Some(e)));
    is_natural(&mantissa.replacen('.', "", 1)) && exponent.is_none_or(|exponent| is_natural(&unsigned(exponent)))
}

/// The words for walls, and for people who meet others.
const WALLS: &str = "left, right, L, R, -1, +1 or a position near -d/2 or +d/2";

/// Reads walls by name, by sign or by position.
pub struct Walls {
    /// `d/2`, about.
    half: BigRational,
}

impl Walls {
    /// Those of a box with this gap \[length\].
    pub fn new(gap: &Exact) -> Self {
        let gap = gap.enclose(64);
        let two = BigRational::from_integer(2.into());
        Self { half: (gap.lo().to_rational() + gap.hi().to_rational()) / &two / two }
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

/// Reads a list, whatever it is written in.
///
/// # Errors
/// Name the place, the value and what is accepted.
pub fn read(text: &str, columns: &Columns, walls: &Walls) -> Result<Vec<Listed>> {
    let text = text.trim_start_matches('\u{feff}');
    match text.trim_start().chars().next() {
        None => bail!("the list is empty: accepted is at least one event"),
        Some('{' | '[') => json::read(text, columns, walls),
        Some(_) => text::read(text, columns, walls),
    }
}

/// One event from its texts.
fn listed(place: String, [time, wall]: [&str; 2], velocity: Option<&str>, walls: &Walls) -> Result<Listed> {
    let number = |name: &str, text: &str| match Number::decimal(text) {
        Some(number) => Ok(number),
        None => bail!("{place}: {name} is `{}`, but accepted is a finite decimal number", shortened(text)),
    };
    let time = number("time", time)?;
    let velocity = velocity.map(|velocity| number("velocity", velocity)).transpose()?;
    let wall = read_wall(&place, wall, walls)?;
    Ok(Listed { place, wall, time, velocity })
}

fn read_wall(place: &str, wall: &str, walls: &Walls) -> Result<Wall> {
    match walls.read(wall) {
        Some(wall) => Ok(wall),
        None => bail!("{place}: wall is `{}`, but accepted is {WALLS}", shortened(wall)),
    }
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
