//! Files that options name.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// What an option gives: the path of a file, or in a question in JSON the text itself.
#[derive(Clone, Debug)]
pub struct Input {
    given: OsString,
    text: Option<String>,
}

impl From<OsString> for Input {
    fn from(given: OsString) -> Self {
        Self { given, text: None }
    }
}

impl Input {
    /// The path.
    pub fn path(&self) -> PathBuf {
        PathBuf::from(&self.given)
    }

    /// The path as messages name it; stdin is `-`.
    pub fn name(&self) -> String {
        match self.text {
            Some(_) if self.given == "-" => "stdin".to_owned(),
            _ => Path::new(&self.given).display().to_string(),
        }
    }

    /// Reads the file that the path leads to: from then on this is the text.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn load<E>(&mut self, read: impl FnOnce(&Path) -> Result<String, E>) -> Result<(), E> {
        self.text = Some(read(Path::new(&self.given))?);
        Ok(())
    }

    /// The text: of the file, or else what is given.
    pub fn text(&self) -> &str {
        self.text.as_deref().or_else(|| self.given.to_str()).unwrap_or_default()
    }
}
