//! The flights of a homoclinic orbit, as a word.

use crate::Error;
use crate::chaos::Side;

/// The most flights between the two manifolds.
pub const MOST_FLIGHTS: usize = 200;

/// Flights between the walls in time order: `F` to the far wall, `N` back to the near one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FlightWord(pub(super) Vec<Side>);

impl std::str::FromStr for FlightWord {
    type Err = Error;

    /// Reads the letters of flights.
    fn from_str(text: &str) -> Result<Self, Error> {
        let side = |letter: char| match letter {
            'F' => Some(Side::Far),
            'N' => Some(Side::Near),
            _ => None,
        };
        let sides: Option<Vec<Side>> = text.trim().chars().map(side).collect();
        sides.filter(|sides| (1..=MOST_FLIGHTS).contains(&sides.len())).map(Self).ok_or_else(|| {
            Error::out_of_range(
                None,
                format!("the word is \"{text}\", but accepted are 1 to {MOST_FLIGHTS} letters F (a flight to the far wall) and N (back to the near one)"),
            )
        })
    }
}

impl FlightWord {
    /// The number of flights.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Always false: a word has a letter.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl std::fmt::Display for FlightWord {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.iter().try_for_each(|side| f.write_str(if *side == Side::Far { "F" } else { "N" }))
    }
}
