//! Questions that are refused.

use impact_pair::Error;
use impact_pair::scene::Range;
use thiserror::Error as ThisError;

use crate::Sentence;

/// Why a question has no answer: a value is not accepted.
#[derive(Clone, Debug, ThisError)]
pub enum Failure {
    /// A value of the scene, or what the verb requires of the scene.
    #[error("{0}")]
    Scene(#[from] Error),
    /// The value of an option, which reads as another thing than is accepted there.
    #[error("{error}")]
    Option {
        /// Name of the option.
        option: String,
        /// Value of the option, as written.
        value: String,
        /// The error.
        error: Box<Error>,
    },
    /// The value of an option, which is out of range.
    #[error("{option} is {value}, but {accepted}")]
    Value {
        /// Name of the option.
        option: String,
        /// Value of the option, as written.
        value: String,
        /// What is accepted.
        accepted: String,
    },
    /// An error that names an option as its key.
    #[error("{0}")]
    Named(Error),
    /// The text of an input.
    #[error("{error}")]
    Input {
        /// Name of the input.
        input: String,
        /// The error.
        error: Box<Error>,
    },
    /// The question is none: it is malformed, or an option is missing or unknown.
    #[error("{0}")]
    Question(Sentence),
}

impl Failure {
    /// The error of a computation over ranges: of the range whose key the error names, else of the scene.
    pub fn over(ranges: &[Range]) -> impl Fn(Error) -> Self {
        move |error| {
            let is_own = |range: &&Range| error.key().is_some_and(|key| key.starts_with(&range.key().place()));
            match ranges.iter().find(is_own) {
                Some(range) => {
                    Self::Option { option: "over".to_owned(), value: range.to_string(), error: Box::new(error) }
                }
                None => Self::Scene(error),
            }
        }
    }

    /// The error of a question that is malformed.
    pub(crate) fn malformed(what: impl std::fmt::Display) -> Self {
        Self::Question(what.to_string().into())
    }
}
