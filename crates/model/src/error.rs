//! Errors for invalid input; undecided questions are verdicts, not errors.

use std::cmp::Ordering;
use std::sync::Arc;
use std::{error, fmt};

use crate::excerpt::Excerpt;
use impact_pair_exact::{Exact, ExactError};

/// An error of the input: the message names the key, the value and what is accepted.
///
/// Errors with equal messages are equal, whatever their source.
#[derive(Clone, Debug)]
pub struct Error {
    kind: ErrorKind,
    /// The key of the scene file that is at fault, if there is one.
    key: Option<String>,
    /// The value of the key, as written.
    value: Option<String>,
    /// The place of the value in a file.
    excerpt: Option<Box<Excerpt>>,
    message: String,
    /// The underlying error, whose text is part of the message.
    cause: Option<Arc<dyn error::Error + Send + Sync>>,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(excerpt) = &self.excerpt {
            write!(f, "line {}: ", excerpt.line())?;
        }
        f.write_str(&self.message)
    }
}

impl error::Error for Error {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        self.cause.as_deref().map(|cause| cause as _)
    }
}

impl PartialEq for Error {
    fn eq(&self, other: &Self) -> bool {
        let said = |error: &Self| (error.kind, error.key.clone(), error.to_string());
        said(self) == said(other)
    }
}

impl Eq for Error {}

/// The kind of input that an [`Error`] is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A value is out of range, or a request is not supported.
    OutOfRange,
    /// A scene file is malformed.
    Scene,
    /// A word of mappings is malformed.
    Word,
    /// A certificate is malformed.
    Certificate,
    /// A list of impacts is malformed.
    List,
}

impl Error {
    fn new(kind: ErrorKind, message: String) -> Self {
        Self { kind, key: None, value: None, excerpt: None, message, cause: None }
    }

    /// The kind of input that the error is about.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The key of the scene file that is at fault, such as `pair.gap`, if there is one.
    pub fn key(&self) -> Option<&str> {
        self.key.as_deref()
    }

    /// The value at fault, as written, if it belongs to a key.
    pub fn value(&self) -> Option<&str> {
        self.value.as_deref()
    }

    /// The line of the scene file that is at fault, if there is one.
    pub fn excerpt(&self) -> Option<&Excerpt> {
        self.excerpt.as_deref()
    }

    /// Adds the line of the value, unless a line is known.
    pub(crate) fn at(mut self, excerpt: Excerpt) -> Self {
        self.excerpt.get_or_insert_with(|| Box::new(excerpt));
        self
    }

    /// Adds a suggestion to the message.
    #[must_use]
    pub fn meant(mut self, meant: Option<String>) -> Self {
        if let Some(meant) = meant {
            self.message.push_str(&format!("; did you mean `{meant}`?"));
        }
        self
    }

    /// Adds the underlying error, which the message includes.
    pub fn because(self, cause: impl error::Error + Send + Sync + 'static) -> Self {
        Self { cause: Some(Arc::new(cause)), ..self }
    }

    /// Error of a text that is not a scene file.
    pub fn scene(message: String) -> Self {
        Self::new(ErrorKind::Scene, message)
    }

    /// Error of a text that is not a certificate.
    pub fn certificate(message: String) -> Self {
        Self::new(ErrorKind::Certificate, message)
    }

    /// Error of a text that is not a list of impacts.
    pub fn list(message: String) -> Self {
        Self::new(ErrorKind::List, message)
    }

    /// Error of a value of a scene file that is not of the accepted kind.
    pub fn entry(key: &str, written: &str, accepted: &str) -> Self {
        let message = format!("{key} is {written}, but {accepted}");
        Self { key: Some(key.to_owned()), value: Some(written.to_owned()), ..Self::scene(message) }
    }

    /// Error of a value that is not accepted at its key.
    pub fn range(key: &str, value: &Exact, accepted: &str) -> Self {
        let value = value.to_string();
        let message = format!("{key} is {}, but {accepted}", shown(&value));
        Self { key: Some(key.to_owned()), value: Some(value), ..Self::new(ErrorKind::OutOfRange, message) }
    }

    /// Error of a request that is not supported; `key` is the key of the scene file at fault, if any.
    pub fn out_of_range<'k>(key: impl Into<Option<&'k str>>, message: String) -> Self {
        Self { key: key.into().map(str::to_owned), ..Self::new(ErrorKind::OutOfRange, message) }
    }

    /// Error of several harmonics where `what` requires a single harmonic.
    pub fn several(harmonics: usize, what: &str) -> Self {
        let message = format!("the excitation has {harmonics} harmonics, but {what} requires a single one");
        Self::out_of_range("excitation.amplitude", message)
    }

    /// Error of a malformed word of mappings.
    pub fn word(message: String) -> Self {
        Self::new(ErrorKind::Word, message)
    }

    /// Refuses a value unless it is proved to be greater than 0.
    ///
    /// # Errors
    /// Returns an error if this is not proved.
    pub fn require_positive(key: &str, value: &Exact) -> Result<(), Self> {
        if value.sign() == Some(Ordering::Greater) {
            Ok(())
        } else {
            Err(Self::range(key, value, "must be greater than 0"))
        }
    }

    /// Refuses a value unless it is proved to be at least 0.
    ///
    /// # Errors
    /// Returns an error if this is not proved.
    pub fn require_not_negative(key: &str, value: &Exact) -> Result<(), Self> {
        if is_at_least(value, 0) { Ok(()) } else { Err(Self::range(key, value, "must be at least 0")) }
    }

    /// Refuses a value unless it is proved to lie in `[low, high]`.
    ///
    /// # Errors
    /// Returns an error if this is not proved.
    pub fn require_range(key: &str, value: &Exact, low: i64, high: i64) -> Result<(), Self> {
        let inside = is_at_least(value, low) && is_at_most(value, high);
        if inside { Ok(()) } else { Err(Self::range(key, value, &format!("must lie in [{low}, {high}]"))) }
    }
}

/// The part of a value that messages show: the beginning of its first line.
pub(crate) fn shown(written: &str) -> String {
    const LONGEST: usize = 60;
    let shown: String = written.lines().next().unwrap_or_default().chars().take(LONGEST).collect();
    if shown.len() < written.trim_end().len() { shown + "..." } else { shown }
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

/// The value computed from `of`, the value at `key`; an error that names `key` if there is none.
///
/// # Errors
/// If it exceeds the range of exact expressions.
pub fn within<T>(key: &'static str, of: &Exact, value: Result<T, ExactError>) -> Result<T, Error> {
    value.map_err(|reason| Error::range(key, of, &reason.to_string()).because(reason))
}
