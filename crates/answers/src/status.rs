//! How much of what was requested is certified, and the next steps that are known to help.

use std::fmt::{self, Display};

/// How much of what was requested is certified: the last line of a table, and the exit code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Status {
    is_complete: bool,
    sentence: Sentence,
}

/// Words in which options are named as the reader gives them: on the command line, or as keywords of Python.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sentence(Vec<Piece>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Piece {
    Words(String),
    Step(Step),
}

/// A change of an option that is known to help.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Switch the option on: `--all`.
    Set(&'static str),
    /// Use the option, of which the sentence says no value: `--velocity-column`.
    Name(&'static str),
    /// Give the option a value, as it has none yet: `a --word`.
    A(&'static str),
    /// Give the option another value.
    Another(&'static str),
    /// Give the option this value: `--arithmetic auto`.
    Value(&'static str, &'static str),
    /// Ask for a greater number: `more --effort`.
    More(&'static str),
    /// Ask for a smaller number: `fewer --digits`.
    Fewer(&'static str),
    /// Raise the limit that the option sets: `a larger --longest`.
    Larger(&'static str),
    /// Lower the limit that the option sets: `a smaller --longest`.
    Smaller(&'static str),
    /// Take a part of the range that the option gives: `a narrower --over`.
    Narrower(&'static str),
    /// Take a range that contains the one of the option.
    Wider(&'static str),
}

impl Step {
    /// The change, before the name of the option.
    fn parts(self) -> (&'static str, &'static str) {
        match self {
            Self::Set(option) | Self::Name(option) | Self::Value(option, _) => ("", option),
            Self::A(option) => ("a ", option),
            Self::Another(option) => ("another ", option),
            Self::More(option) => ("more ", option),
            Self::Fewer(option) => ("fewer ", option),
            Self::Larger(option) => ("a larger ", option),
            Self::Smaller(option) => ("a smaller ", option),
            Self::Narrower(option) => ("a narrower ", option),
            Self::Wider(option) => ("a wider ", option),
        }
    }

    /// The step in Python: options are keywords.
    fn in_python(self) -> String {
        let (change, option) = self.parts();
        let keyword = match (self, option) {
            (Self::Value(_, value), option) => format!("{option}={value:?}"),
            (_, "velocity-column") => "columns".to_owned(),
            (_, "no-velocity") => "velocities=False".to_owned(),
            (Self::Set(_), switch) => format!("{}=True", switch.replace('-', "_")),
            (_, option) => option.replace('-', "_"),
        };
        format!("{change}{keyword}")
    }
}

impl Display for Step {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (change, option) = self.parts();
        write!(out, "{change}--{option}")?;
        if let Self::Value(_, value) = self { write!(out, " {value}") } else { Ok(()) }
    }
}

impl Sentence {
    /// The sentence with more words.
    #[must_use]
    pub fn say(mut self, words: impl Into<String>) -> Self {
        self.0.push(Piece::Words(words.into()));
        self
    }

    /// The sentence with a step.
    #[must_use]
    pub fn step(mut self, step: Step) -> Self {
        self.0.push(Piece::Step(step));
        self
    }

    /// The sentence, in which options are keywords of Python.
    pub fn in_python(&self) -> String {
        let text = |piece: &Piece| match piece {
            Piece::Words(words) => words.clone(),
            Piece::Step(step) => step.in_python(),
        };
        self.0.iter().map(text).collect()
    }
}

impl From<String> for Sentence {
    fn from(words: String) -> Self {
        Self::default().say(words)
    }
}

/// The sentence, in which options are those of the command line.
impl Display for Sentence {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|piece| match piece {
            Piece::Words(words) => out.write_str(words),
            Piece::Step(step) => step.fmt(out),
        })
    }
}

impl Status {
    /// A status whose sentence begins with these words.
    pub fn new(is_complete: bool, words: impl Into<String>) -> Self {
        Self { is_complete, sentence: Sentence::default().say(words) }
    }

    /// The status with more words.
    #[must_use]
    pub fn say(self, words: impl Into<String>) -> Self {
        Self { sentence: self.sentence.say(words), ..self }
    }

    /// The status with a step.
    #[must_use]
    pub fn step(self, step: Step) -> Self {
        Self { sentence: self.sentence.step(step), ..self }
    }

    /// True if all that was requested is certified.
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// The steps that are known to help.
    pub fn steps(&self) -> impl Iterator<Item = Step> {
        self.sentence.0.iter().filter_map(|piece| match piece {
            Piece::Step(step) => Some(*step),
            Piece::Words(_) => None,
        })
    }

    /// The sentence, in which options are keywords of Python.
    pub fn in_python(&self) -> String {
        self.sentence.in_python()
    }
}

/// The sentence, in which options are those of the command line.
impl Display for Status {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.sentence.fmt(out)
    }
}

#[cfg(test)]
mod tests {
    use super::{Status, Step};

    #[test]
    fn steps_are_named_as_the_reader_calls_them() {
        let status = Status::new(false, "try ").step(Step::More("max-bits")).say(" or ").step(Step::Set("all"));
        assert_eq!(status.to_string(), "try more --max-bits or --all");
        assert_eq!(status.in_python(), "try more max_bits or all=True");
        assert_eq!(status.steps().collect::<Vec<_>>(), [Step::More("max-bits"), Step::Set("all")]);
    }
}
