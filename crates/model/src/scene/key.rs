//! The names of parameters and initial data.

use std::fmt;
use std::num::NonZeroU16;
use std::str::FromStr;

use super::letters::{listed, nearest, spelled};
use crate::error::Error;

/// The number of a term of the excitation, from 1, in the order of the scene file.
pub type Term = NonZeroU16;

/// A parameter or a datum of the start, as the scene file names it.
///
/// A key of the excitation refers to its only term, or by a number to one of several terms.
///
/// ```
/// use impact_pair_model::scene::Key;
/// assert_eq!("amplitude".parse::<Key>()?, Key::Amplitude(None));
/// assert_eq!("excitation.phase.2".parse::<Key>()?.to_string(), "phase.2");
/// assert_eq!("start.velocity".parse::<Key>()?.to_string(), "start.velocity");
/// assert_eq!("A.2".parse::<Key>()?, "amplitude.2".parse()?);
/// # Ok::<(), impact_pair_model::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Key {
    /// `A`
    Amplitude(Option<Term>),
    /// `W`
    Frequency(Option<Term>),
    /// `tau`
    Phase(Option<Term>),
    /// `d`
    Gap,
    /// `e`
    Restitution,
    /// The time of the start.
    StartTime,
    /// `W t + tau` at the start, instead of the start's time; with the scene's own W and tau (for several harmonics those
    /// of the fastest harmonic) unless W or tau vary as well.
    StartPhase,
    /// The relative displacement at a start inside the gap.
    StartPosition,
    /// The relative velocity at the start.
    StartVelocity,
}

impl Key {
    /// All keys without the numbers of terms, parameters first: in the order in which they take effect.
    pub const ALL: [Self; 9] = [
        Self::Amplitude(None),
        Self::Frequency(None),
        Self::Phase(None),
        Self::Gap,
        Self::Restitution,
        Self::StartTime,
        Self::StartPhase,
        Self::StartPosition,
        Self::StartVelocity,
    ];

    /// The path of the key in the scene file: `pair.gap`, `excitation.amplitude.2`.
    ///
    /// ```
    /// use impact_pair_model::scene::Key;
    /// assert_eq!("amplitude.2".parse::<Key>()?.place(), "excitation.amplitude.2");
    /// # Ok::<(), impact_pair_model::Error>(())
    /// ```
    pub fn place(self) -> String {
        let table = match self {
            Self::Amplitude(_) | Self::Frequency(_) | Self::Phase(_) => "excitation.",
            Self::Gap | Self::Restitution => "pair.",
            Self::StartTime | Self::StartPhase | Self::StartPosition | Self::StartVelocity => "",
        };
        format!("{table}{self}")
    }

    /// The name of the key without the number of a term.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Amplitude(_) => "amplitude",
            Self::Frequency(_) => "frequency",
            Self::Phase(_) => "phase",
            Self::Gap => "gap",
            Self::Restitution => "restitution",
            Self::StartTime => "start.time",
            Self::StartPhase => "start.phase",
            Self::StartPosition => "start.position",
            Self::StartVelocity => "start.velocity",
        }
    }

    /// The number of the term that the key names.
    pub fn term(self) -> Option<Term> {
        match self {
            Self::Amplitude(term) | Self::Frequency(term) | Self::Phase(term) => term,
            _ => None,
        }
    }

    /// The key of the same quantity of another term; `None` for a key that is not of a term.
    fn of(self, term: Term) -> Option<Self> {
        match self {
            Self::Amplitude(_) => Some(Self::Amplitude(Some(term))),
            Self::Frequency(_) => Some(Self::Frequency(Some(term))),
            Self::Phase(_) => Some(Self::Phase(Some(term))),
            _ => None,
        }
    }

    /// Whether both keys set the same datum of some scene: then they cannot be two axes of a grid.
    pub fn is_one_with(self, other: Self) -> bool {
        let is_time = |key| matches!(key, Self::StartTime | Self::StartPhase);
        let is_all = self.term().is_none() || other.term().is_none();
        self == other || (is_all && self.name() == other.name()) || (is_time(self) && is_time(other))
    }

    /// The symbol of the quantity in the paper, and its unit.
    pub fn symbol(self) -> (String, &'static str) {
        let (symbol, unit) = match self {
            Self::Amplitude(_) => ("A", "length"),
            Self::Frequency(_) => ("Ω", "rad/time"),
            Self::Phase(_) => ("τ", "rad"),
            Self::Gap => ("d", "length"),
            Self::Restitution => ("e", ""),
            Self::StartTime => ("t₀", "time"),
            Self::StartPhase => ("Ωt₀ + τ", "rad"),
            Self::StartPosition => ("y₀", "length"),
            Self::StartVelocity => ("v₀", "length/time"),
        };
        let lower = |digit: u8| char::from_u32(u32::from('₀') + u32::from(digit - b'0'));
        let number: String =
            self.term().iter().flat_map(|term| term.to_string().into_bytes()).filter_map(lower).collect();
        (format!("{symbol}{number}"), unit)
    }
}

fn not_a_key(text: &str) -> Error {
    let keys = listed(&Key::ALL.map(Key::name));
    let terms = "of several terms with a number, such as amplitude.2";
    let meant = Key::meant(text).map(str::to_owned);
    Error::out_of_range(None, format!("the key is \"{text}\", but accepted are {keys}; {terms}")).meant(meant)
}

impl Key {
    /// The name of the key that an unknown text resembles, such as `restitution` for `r`.
    pub fn meant(text: &str) -> Option<&'static str> {
        let names = Self::ALL.map(Self::name);
        nearest(text, &names).or_else(|| {
            let of_start = nearest(text, &["time", "velocity", "position"])?;
            names.into_iter().find(|name| name.strip_prefix("start.") == Some(of_start))
        })
    }
}

impl fmt::Display for Key {
    /// The name in messages and outputs.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        self.term().map_or(Ok(()), |term| write!(f, ".{term}"))
    }
}

impl FromStr for Key {
    type Err = Error;

    /// The table of a parameter (`pair.gap`) may be left out, the table `start` may not; letters stand for the names of parameters.
    fn from_str(text: &str) -> Result<Self, Error> {
        let short = text.strip_prefix("excitation.").or_else(|| text.strip_prefix("pair.")).unwrap_or(text);
        let named = |name: &str| Self::ALL.into_iter().find(|key| key.name() == spelled(name));
        let of_term = || {
            let (name, number) = short.rsplit_once('.')?;
            named(name)?.of(number.parse().ok()?)
        };
        named(short).or_else(of_term).ok_or_else(|| not_a_key(text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_that_set_one_datum_are_named_in_the_error() {
        let is_one = |a: &str, b: &str| a.parse::<Key>().unwrap().is_one_with(b.parse().unwrap());
        assert!(is_one("gap", "pair.gap") && is_one("start.time", "start.phase"));
        assert!(is_one("phase.2", "phase.2") && is_one("phase", "phase.1") && is_one("phase.1", "phase"));
        assert!(!is_one("phase.1", "phase.2") && !is_one("phase.1", "amplitude.1") && !is_one("gap", "restitution"));
    }

    #[test]
    fn letters_stand_for_the_names_of_parameters() {
        let key = |text: &str| text.parse::<Key>().unwrap().to_string();
        let letters = ["A", "W", "angular-frequency", "tau", "d", "e", "A.2", "excitation.tau.3", "pair.e"];
        let names = "amplitude frequency frequency phase gap restitution amplitude.2 phase.3 restitution";
        assert_eq!(letters.map(key).join(" "), names);
        let message = "r".parse::<Key>().unwrap_err().to_string();
        assert!(message.contains("amplitude (A), frequency (W, angular-frequency), phase (tau), gap (d)"), "{message}");
        assert!(message.ends_with("did you mean `restitution`?"), "{message}");
    }

    #[test]
    fn a_key_of_the_start_is_suggested() {
        assert!("velocity".parse::<Key>().unwrap_err().to_string().contains("start.velocity"));
    }
}
