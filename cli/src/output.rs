//! Output of data: to stdout, or to a file that is written atomically.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, IsTerminal, LineWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use impact_pair_plot::picture::{Look, encoded};
use tempfile::NamedTempFile;

use crate::Answer;

/// A writer that has to be [committed](Output::commit).
pub enum Output {
    /// Line by line, so that pipes see every event as it comes.
    Stdout(io::Stdout),
    /// An existing file that cannot be replaced, such as a device or a named pipe.
    Special(LineWriter<File>),
    /// A new file beside the one it is to replace.
    File { draft: BufWriter<NamedTempFile>, target: PathBuf },
}

impl Output {
    /// Opens `path`, or stdout when there is none or it is `-`.
    pub fn open(path: Option<&Path>) -> Result<Self> {
        let Some(path) = path.filter(|path| path.as_os_str() != "-") else { return Ok(Self::Stdout(io::stdout())) };
        Self::open_file(path).with_context(|| format!("cannot write {}", path.display()))
    }

    fn open_file(path: &Path) -> Result<Self> {
        // A link is followed, so that what it points at is replaced and not the link.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        match fs::metadata(&target) {
            Ok(existing) if existing.is_dir() => anyhow::bail!("it is a directory"),
            Ok(existing) if !existing.is_file() => {
                return Ok(Self::Special(LineWriter::new(OpenOptions::new().write(true).open(&target)?)));
            }
            _ => {}
        }
        let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        fs::metadata(folder)?;
        let mut draft = tempfile::Builder::new();
        draft.prefix(".impact-pair-");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As any new file: less what the umask says.
            draft.permissions(fs::Permissions::from_mode(0o666));
        }
        Ok(Self::File { draft: BufWriter::new(draft.tempfile_in(folder)?), target })
    }

    /// Returns whether the data go to stdout.
    pub fn is_stdout(&self) -> bool {
        matches!(self, Self::Stdout(_))
    }

    /// Returns whether the data go to a terminal.
    pub fn is_terminal(&self) -> bool {
        match self {
            Self::Stdout(stdout) => stdout.is_terminal(),
            Self::Special(file) => file.get_ref().is_terminal(),
            Self::File { .. } => false,
        }
    }

    /// Writes the picture of this `path`, all of it.
    pub fn draw(mut self, path: &Path, look: &Look, svg: Result<String>) -> Result<()> {
        let failed = || format!("cannot draw {}", path.display());
        let bytes = svg.and_then(|svg| encoded(&svg, look, path)).with_context(failed)?;
        self.write_all(&bytes).with_context(failed)?;
        self.commit()
    }

    /// Writes all of an answer; what it leaves open is said on stderr as well, unless it stands in a table on stdout.
    pub fn answer(mut self, text: &str, open: Option<String>, (quiet, is_table): (bool, bool)) -> Result<Answer> {
        let is_said = is_table && self.is_stdout();
        self.write_all(text.as_bytes()).context("cannot write the output")?;
        self.commit()?;
        let Some(open) = open else { return Ok(Answer::Complete) };
        note(quiet || is_said, &open);
        Ok(Answer::Incomplete)
    }

    /// Ends the output; only now does a file appear.
    pub fn commit(mut self) -> Result<()> {
        self.flush().context("cannot write the output")?;
        if let Self::File { draft, target } = self {
            let persist = || -> Result<()> {
                let draft = draft.into_inner().map_err(io::IntoInnerError::into_error)?;
                draft.as_file().sync_all()?;
                draft.persist(&target)?;
                Ok(())
            };
            persist().with_context(|| format!("cannot write {}", target.display()))?;
        }
        Ok(())
    }

    fn writer(&mut self) -> &mut dyn Write {
        match self {
            Self::Stdout(stdout) => stdout,
            Self::Special(file) => file,
            Self::File { draft, .. } => draft,
        }
    }
}

/// Says something on stderr.
pub fn note(is_silent: bool, text: &str) {
    if !is_silent {
        // Nobody may be listening.
        let _ = writeln!(io::stderr(), "{text}");
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer().flush()
    }
}
