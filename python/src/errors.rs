//! Errors, as the exceptions of `impact_pair.errors`.

use std::fmt::Display;
use std::ops::RangeInclusive;

use impact_pair::{Effort, Error, ErrorKind};
use impact_pair_answers::Failure;
use pyo3::prelude::*;

/// An error of a computation: a question that is refused, or a text that does not read as what it should be.
pub enum Fault {
    Ours(Error),
    Said { class: &'static str, message: String, key: Option<String>, value: Option<String> },
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Self::Ours(error)
    }
}

/// Options are keywords.
impl From<Failure> for Fault {
    fn from(failure: Failure) -> Self {
        let keyword = |option: &str| option.replace('-', "_");
        match failure {
            Failure::Scene(error) | Failure::Named(error) => Self::Ours(error),
            Failure::Input { error, .. } => Self::Ours(*error),
            Failure::Option { option, value, error } => Self::keyed(*error, &keyword(&option), &value),
            Failure::Value { option, value, accepted } => Self::range(&keyword(&option), value, &accepted),
            Failure::Question(said) => {
                Self::Said { class: "RangeError", message: said.in_python(), key: None, value: None }
            }
        }
    }
}

impl Fault {
    /// An error of the library among others.
    pub fn of(error: anyhow::Error) -> Self {
        error.downcast::<Error>().map_or_else(Self::other, Self::Ours)
    }

    /// A keyword whose value is not accepted.
    pub fn range(key: &str, value: impl Display, accepted: &str) -> Self {
        let (message, value) = (format!("{key} is {value}, but {accepted}"), Some(value.to_string()));
        Self::Said { class: "RangeError", message, key: Some(key.to_owned()), value }
    }

    /// The error of a text that this keyword gives, which names no key of its own.
    pub fn keyed(error: Error, key: &str, text: &str) -> Self {
        Self::Ours(error).about(key, text)
    }

    /// The same about a keyword that is given as this text, where it names no key of its own.
    pub fn about(self, key: &str, text: &str) -> Self {
        match self.described() {
            Self::Said { class, message, key: None, value: None } => {
                Self::Said { class, message, key: Some(key.to_owned()), value: Some(text.to_owned()) }
            }
            named => named,
        }
    }

    /// The same with its class and its words.
    fn described(self) -> Self {
        let Self::Ours(error) = self else { return self };
        let class = match error.kind() {
            ErrorKind::Word => "WordError",
            ErrorKind::Certificate => "CertificateError",
            ErrorKind::List => "ListError",
            ErrorKind::Scene => "SceneError",
            _ => "RangeError",
        };
        let (key, value) = (error.key().map(str::to_owned), error.value().map(str::to_owned));
        Self::Said { class, message: error.to_string(), key, value }
    }

    /// A text that is no document.
    pub fn certificate(error: impl Display) -> Self {
        Self::Said { class: "CertificateError", message: error.to_string(), key: None, value: None }
    }

    /// Anything else.
    pub fn other(message: impl Display) -> Self {
        Self::Said { class: "Error", message: message.to_string(), key: None, value: None }
    }
}

/// Refuses a number outside the range that the command line accepts.
pub fn accepted<T: PartialOrd + Display>(key: &str, value: T, range: RangeInclusive<T>) -> Result<T, Fault> {
    if range.contains(&value) {
        return Ok(value);
    }
    Err(Fault::range(key, value, &format!("must be from {} to {}", range.start(), range.end())))
}

/// The multiple of the usual work that is given as text.
pub fn effort_of(text: &str) -> Result<Effort, Fault> {
    text.parse().map_err(|error| Fault::keyed(error, "effort", text))
}

impl From<Fault> for PyErr {
    fn from(fault: Fault) -> Self {
        let Fault::Said { class, message, key, value } = fault.described() else { unreachable!("what is said") };
        Python::attach(|py| {
            let raised = || py.import("impact_pair.errors")?.getattr(class)?.call1((message, key, value));
            raised().map_or_else(|error| error, PyErr::from_value)
        })
    }
}
