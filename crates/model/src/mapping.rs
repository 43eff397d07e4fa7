//! The mappings P1-P4 between the switch-planes, and words of them.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::pair::Wall;

/// A mapping from one switch-plane to the next. **Equations** (24)-(27)
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub enum Mapping {
    /// S+ -> S-, right wall to left wall; `D = -d` (A.1), (A.2).
    P1,
    /// S- -> S+, left wall to right wall; `D = +d` (A.3), (A.4).
    P2,
    /// S+ -> S+, right wall to itself; `D = 0` (A.5), (A.6).
    P3,
    /// S- -> S-, left wall to itself; `D = 0` (A.5), (A.6).
    P4,
}

impl Mapping {
    /// The mapping of a flight from one wall to another or to itself.
    pub fn between(from: Wall, to: Wall) -> Self {
        match (from, to) {
            (Wall::Right, Wall::Left) => Self::P1,
            (Wall::Left, Wall::Right) => Self::P2,
            (Wall::Right, Wall::Right) => Self::P3,
            (Wall::Left, Wall::Left) => Self::P4,
        }
    }

    /// The walls of departure and arrival.
    pub fn walls(self) -> (Wall, Wall) {
        match self {
            Self::P1 => (Wall::Right, Wall::Left),
            Self::P2 => (Wall::Left, Wall::Right),
            Self::P3 => (Wall::Right, Wall::Right),
            Self::P4 => (Wall::Left, Wall::Left),
        }
    }
}

impl fmt::Display for Mapping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::P1 => "P1",
            Self::P2 => "P2",
            Self::P3 => "P3",
            Self::P4 => "P4",
        })
    }
}

fn not_a_word(text: &str) -> Error {
    let accepted = "mappings P1 to P4 that chain, the first right-most (\"P2 P1\"), or walls in time order (\"RL\")";
    let upper = text.to_uppercase();
    let meant = (upper != text && upper.parse::<Word>().is_ok()).then_some(upper);
    Error::word(format!("the word is \"{text}\", but accepted are {accepted}")).meant(meant)
}

/// A composition of mappings, in time order; written as in the paper with the first mapping right-most.
///
/// Read from `"P2 P4 P1 P3"` or, by the walls of the impacts in time order, from `"RRLL"` (the same motion:
/// the ball is on the right wall, returns to it by P3, goes left by P1, returns by P4, goes right by P2).
///
/// ```
/// use impact_pair_model::mapping::{Mapping, Word};
/// let model_iii: Word = "P2 P4 P1 P3".parse()?;
/// assert_eq!(model_iii.mappings().first(), Some(&Mapping::P3));
/// assert_eq!(model_iii, "RRLL".parse()?);
/// assert_eq!(model_iii.to_string(), "P2 P4 P1 P3");
/// # Ok::<(), impact_pair_model::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Word(Vec<Mapping>);

impl Word {
    /// The word of the given mappings in time order.
    ///
    /// # Errors
    /// If a mapping does not start on the wall where the previous one ended, or there is none.
    pub fn new(mappings: Vec<Mapping>) -> Result<Self, Error> {
        let chained = mappings.windows(2).all(|pair| pair[0].walls().1 == pair[1].walls().0);
        let word = Self(mappings);
        if word.0.is_empty() || !chained {
            return Err(not_a_word(&word.to_string()));
        }
        Ok(word)
    }

    /// The mappings in time order.
    pub fn mappings(&self) -> &[Mapping] {
        &self.0
    }

    /// Whether the word can be repeated: it ends on the wall from which it starts.
    pub fn is_closed(&self) -> bool {
        self.0.first().map(|m| m.walls().0) == self.0.last().map(|m| m.walls().1)
    }
}

impl FromStr for Word {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let walls: Option<Vec<Wall>> = text
            .chars()
            .map(|c| match c {
                'L' => Some(Wall::Left),
                'R' => Some(Wall::Right),
                _ => None,
            })
            .collect();
        if let Some(walls) = walls.filter(|walls| !walls.is_empty()) {
            let next = walls.iter().cycle().skip(1);
            return Self::new(walls.iter().zip(next).map(|(&a, &b)| Mapping::between(a, b)).collect());
        }
        let mappings: Option<Vec<Mapping>> = text
            .split_whitespace()
            .rev()
            .map(|name| {
                [Mapping::P1, Mapping::P2, Mapping::P3, Mapping::P4].into_iter().find(|m| m.to_string() == name)
            })
            .collect();
        Self::new(mappings.ok_or_else(|| not_a_word(text))?)
    }
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, mapping) in self.0.iter().rev().enumerate() {
            if i > 0 {
                f.write_str(" ")?;
            }
            mapping.fmt(f)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_read_as_they_are_written() {
        for text in ["P2 P1", "P3", "P2 P4 P1 P3", "P2 P4 P1", "P1 P3 P2", "P2 P4 P4 P1 P3 P3"] {
            let word: Word = text.parse().unwrap();
            assert_eq!(word.to_string(), text);
            assert!(word.is_closed());
        }
    }

    #[test]
    fn words_that_do_not_chain_are_refused() {
        for text in ["", "P1 P1", "P5", "P2 P3 P2", "RLX", "rl"] {
            assert!(text.parse::<Word>().is_err(), "{text}");
        }
    }
}
