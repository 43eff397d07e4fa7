//! Errors of an expression: it cannot be read (`ParseError`), or it has no provable value (`ExactError`).

use std::fmt;

/// The reason why an expression is refused: its value is undefined, cannot be proved defined, or is out of all proportion.
///
/// Texts quoted in messages are shortened.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExactError {
    /// The divisor is zero, or an enclosure of it at 4096 bits still holds zero.
    #[error("the divisor `{divisor}` is zero or cannot be proved nonzero with 4096 bits")]
    DivisorMayBeZero {
        /// The divisor.
        divisor: String,
    },
    /// The radicand is negative, or an enclosure of it at 4096 bits still holds negative numbers.
    #[error("the square root of `{radicand}` needs a value that is provably >= 0")]
    NegativeRoot {
        /// The radicand.
        radicand: String,
    },
    /// The ends of an interval are not provably in order.
    #[error("the interval needs a lower bound that is provably <= the upper bound, got [{lower}, {upper}]")]
    EndsOutOfOrder {
        /// The first end.
        lower: String,
        /// The second end.
        upper: String,
    },
    /// An end of an interval is itself an interval.
    #[error("the endpoints of an interval must be single numbers, got `{end}`")]
    NestedInterval {
        /// The end.
        end: String,
    },
    /// An exponent of `^` is too large.
    #[error("the exponent {exponent} of `^` lies outside -10000..10000")]
    ExponentTooLarge {
        /// The exponent.
        exponent: i64,
    },
    /// A value is not provably within the accepted magnitudes.
    #[error("a value beyond 2^40000 in magnitude is not accepted")]
    TooLarge,
    /// The expression is nested too deeply.
    #[error("an expression of more than 256 nested operations is not accepted")]
    TooDeep,
    /// A double that is no real number.
    #[error("{value} is no real number")]
    NotFinite {
        /// The double.
        value: String,
    },
    /// Cancellation loses more bits than the internal precision allowed.
    #[error("a value loses too many digits to cancellation: 65536 bits do not suffice to enclose it")]
    TooIllConditioned,
}

/// The reason why a text is not an exact real number: the byte column (from 1), the text found there and what is accepted.
///
/// ```
/// use impact_pair_exact::Exact;
/// let error = Exact::parse("10*pie").unwrap_err();
/// assert_eq!(error.column(), 4);
/// assert_eq!(error.to_string(), "column 4: found `pie`, accepted are a number, `pi`, `sqrt(`, `sin(`, `cos(`, `(` or a sign");
/// ```
///
/// A similar text that can be read is suggested:
///
/// ```
/// use impact_pair_exact::Exact;
/// let error = Exact::parse("2pi").unwrap_err();
/// assert!(error.to_string().ends_with("or the end; did you mean `2*pi`?"));
/// assert_eq!(error.meant(), Some("2*pi"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("column {column}: {problem}{advice}")]
pub struct ParseError {
    column: usize,
    #[source]
    problem: Problem,
    advice: Advice,
}

/// A hint for the author of the text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) enum Advice {
    #[default]
    Nothing,
    /// A similar text that reads as a number.
    Meant(String),
    /// A number with a unit.
    Units,
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => Ok(()),
            Self::Meant(text) => write!(f, "; did you mean `{text}`?"),
            Self::Units => write!(f, "; numbers have no units here: use one unit of length and one of time throughout"),
        }
    }
}

impl ParseError {
    /// The error `problem` found at the byte offset `at`.
    pub(super) fn new(at: usize, problem: impl Into<Problem>) -> ParseError {
        ParseError { column: at + 1, problem: problem.into(), advice: Advice::Nothing }
    }

    pub(super) fn advised(self, advice: Advice) -> ParseError {
        ParseError { advice, ..self }
    }

    /// Similar text that reads as a number, if one is suggested.
    pub fn meant(&self) -> Option<&str> {
        match &self.advice {
            Advice::Meant(text) => Some(text),
            Advice::Nothing | Advice::Units => None,
        }
    }

    /// The byte column, counted from 1, where reading stopped.
    pub fn column(&self) -> usize {
        self.column
    }

    /// The mathematical reason, if the text is well formed but has no provable value.
    pub fn undefined(&self) -> Option<&ExactError> {
        match &self.problem {
            Problem::Undefined(reason) => Some(reason),
            _ => None,
        }
    }
}

/// The kinds of reading errors.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum Problem {
    #[error("found {found}, accepted are {accepted}")]
    Unexpected { found: String, accepted: &'static str },
    #[error("found `{found}`, accepted are finite real numbers only")]
    NotFinite { found: String },
    #[error(
        "found a sign after a sign, accepted is one, as in `1 - (-2)`; all values of 1.70 +- 0.01 are `[1.69, 1.71]`"
    )]
    TwoSigns,
    #[error("found an interval inside an expression, accepted is `[a, b]` as the whole text only")]
    InnerInterval,
    #[error("found a text of {length} bytes, accepted are at most {limit}")]
    TooLong { length: usize, limit: usize },
    #[error("found parentheses nested too deeply, accepted are at most {limit} levels")]
    TooNested { limit: usize },
    #[error("found a number of magnitude `{found}`, accepted are zero and magnitudes from 1e-10000 to 1e10000")]
    Magnitude { found: String },
    #[error(transparent)]
    Undefined(#[from] ExactError),
}

/// A text cut to a length fit for a message.
pub(super) fn shortened(text: &str) -> String {
    const LONGEST: usize = 60;
    match text.char_indices().nth(LONGEST) {
        None => text.to_owned(),
        Some((cut, _)) => format!("{}...", &text[..cut]),
    }
}
