//! Errors are for bad questions; verdicts are for hard ones.

use std::cmp::Ordering;

use crate::exact::Exact;
use crate::orbit::BITS;
use crate::scene::Key;

/// A question that cannot be asked: the message names the key, the value and what is accepted.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}{message}")]
pub struct Error {
    kind: Kind,
    /// The key of the scene file that is at fault, when it is one.
    key: Option<String>,
    /// `line 7: ` when the value stands in a file.
    place: String,
    message: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Range,
    Scene,
    Word,
    Certificate,
}

impl Error {
    fn new(kind: Kind, message: String) -> Self {
        Self { kind, key: None, place: String::new(), message }
    }

    /// Whether a value lies outside what is accepted.
    pub fn is_range(&self) -> bool {
        self.kind == Kind::Range
    }

    /// Whether a scene file does not read as one.
    pub fn is_scene(&self) -> bool {
        self.kind == Kind::Scene
    }

    /// Whether a word of mappings is malformed.
    pub fn is_word(&self) -> bool {
        self.kind == Kind::Word
    }

    /// Whether a certificate does not read as one.
    pub fn is_certificate(&self) -> bool {
        self.kind == Kind::Certificate
    }

    /// The key of the scene file that is at fault, such as `pair.gap`, when it is one.
    pub fn key(&self) -> Option<&str> {
        self.key.as_deref()
    }

    pub(crate) fn at_line(mut self, line: usize) -> Self {
        if self.place.is_empty() {
            self.place = format!("line {line}: ");
        }
        self
    }

    pub(crate) fn scene(message: String) -> Self {
        Self::new(Kind::Scene, message)
    }

    pub(crate) fn certificate(message: String) -> Self {
        Self::new(Kind::Certificate, message)
    }

    /// A value of a scene file, as written there, that is not of the accepted kind.
    pub(crate) fn entry(key: &str, written: &str, accepted: &str) -> Self {
        Self { key: Some(key.to_owned()), ..Self::scene(format!("{key} is {written}, but {accepted}")) }
    }

    pub(crate) fn range(key: &str, value: &Exact, accepted: &str) -> Self {
        let message = format!("{key} is {value}, but {accepted}");
        Self { key: Some(key.to_owned()), ..Self::new(Kind::Range, message) }
    }

    pub(crate) fn too_large(key: &str, value: &Exact) -> Self {
        Self::range(key, value, "double-precision flights accept at most 2^400 in units of gaps and turns")
    }

    pub(crate) fn several(harmonics: usize, what: &str) -> Self {
        let message = format!("the excitation has {harmonics} harmonics, but {what} is known of one only");
        Self { key: Some("excitation.amplitude".to_owned()), ..Self::new(Kind::Range, message) }
    }

    pub(crate) fn word(text: &str) -> Self {
        let accepted =
            "mappings P1 to P4 that chain, the first right-most (\"P2 P1\"), or walls in time order (\"RL\")";
        Self::new(Kind::Word, format!("the word is \"{text}\", but accepted are {accepted}"))
    }

    pub(crate) fn open_word(text: &str) -> Self {
        let accepted = "words that end on the wall they start from, such as \"P2 P1\"";
        Self::new(Kind::Word, format!("the word is \"{text}\", but accepted are {accepted}"))
    }

    pub(crate) fn cycles(cycles: u32, most: u32) -> Self {
        Self::new(Kind::Range, format!("the number of cycles is {cycles}, but must lie in [1, {most}]"))
    }

    pub(crate) fn uncommon_cycles(cycles: u32, period: u32) -> Self {
        let accepted = format!("must be a multiple of {period}: only after {period} turns of the fastest harmonic");
        Self::new(
            Kind::Range,
            format!("the number of cycles is {cycles}, but {accepted} are all phases what they were"),
        )
    }

    pub(crate) fn incommensurate(frequencies: &[String], most: u32) -> Self {
        let accepted = format!(
            "periodic orbits are known of frequencies whose ratios are proved to be fractions, with a common period of \
             at most {most} turns of the fastest"
        );
        let message = format!("excitation.frequency is [{}], but {accepted}", frequencies.join(", "));
        Self { key: Some("excitation.frequency".to_owned()), ..Self::new(Kind::Range, message) }
    }

    pub(crate) fn over(text: &str) -> Self {
        let accepted = "KEY=LO..HI with LO < HI, KEY one of amplitude, gap, restitution, frequency";
        Self::new(Kind::Range, format!("the range is \"{text}\", but accepted are {accepted}"))
    }

    pub(crate) fn key_to_vary(text: &str) -> Self {
        let keys = Key::ALL.map(Key::name).join(", ");
        Self::new(Kind::Range, format!("the key is \"{text}\", but accepted are {keys}"))
    }

    pub(crate) fn grid(text: &str, accepted: &str) -> Self {
        Self::new(Kind::Range, format!("the grid is \"{text}\", but accepted is {accepted}"))
    }

    pub(crate) fn position_on_wall(position: &Exact) -> Self {
        Self::range("start.position", position, "the scene starts on a wall (give it a start.position instead)")
    }

    pub(crate) fn arithmetic(text: &str) -> Self {
        let (least, most) = BITS.into_inner();
        let bits = if cfg!(feature = "multiprecision") {
            format!("or a number of bits from {least} to {most}")
        } else {
            "and, in a build with multiprecision, numbers of bits".to_owned()
        };
        let message = format!("the arithmetic is \"{text}\", but accepted are auto, float, interval, inari {bits}");
        Self::new(Kind::Range, message)
    }

    pub(crate) fn require_positive(key: &str, value: &Exact) -> Result<(), Self> {
        if value.sign() == Some(Ordering::Greater) {
            Ok(())
        } else {
            Err(Self::range(key, value, "must be greater than 0"))
        }
    }

    pub(crate) fn require_not_negative(key: &str, value: &Exact) -> Result<(), Self> {
        if is_at_least(value, 0) { Ok(()) } else { Err(Self::range(key, value, "must be at least 0")) }
    }

    pub(crate) fn require_range(key: &str, value: &Exact, low: i64, high: i64) -> Result<(), Self> {
        let inside = is_at_least(value, low) && is_at_most(value, high);
        if inside { Ok(()) } else { Err(Self::range(key, value, &format!("must lie in [{low}, {high}]"))) }
    }
}

/// Whether `value`, or every value of an interval, is proved to be at least `low`.
pub(crate) fn is_at_least(value: &Exact, low: i64) -> bool {
    let lowest = value.lower().unwrap_or_else(|| value.clone());
    matches!(lowest.compare(&Exact::from(low)), Some(Ordering::Greater | Ordering::Equal))
}

/// Whether `value`, or every value of an interval, is proved to be at most `high`.
pub(crate) fn is_at_most(value: &Exact, high: i64) -> bool {
    let highest = value.upper().unwrap_or_else(|| value.clone());
    matches!(highest.compare(&Exact::from(high)), Some(Ordering::Less | Ordering::Equal))
}
