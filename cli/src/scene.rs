//! The scene that a verb is about: where it is read from, and what must not be written over it.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use impact_pair::Scene;

/// Reads the scene of a file, or of stdin when it is `-`.
pub fn read(path: &Path) -> Result<Scene> {
    Scene::parse(&text(path)?).with_context(|| name(path))
}

/// Reads a file, or stdin when it is `-`.
pub fn text(path: &Path) -> Result<String> {
    let text = if path.as_os_str() == "-" {
        let mut text = String::new();
        io::stdin().read_to_string(&mut text).map(|_| text)
    } else {
        fs::read_to_string(path)
    };
    text.with_context(|| format!("cannot read {}", name(path)))
}

/// The file as messages name it.
pub fn name(path: &Path) -> String {
    if path.as_os_str() == "-" { "stdin".into() } else { path.display().to_string() }
}

/// Refuses to write `output` onto what is read.
pub fn keep(scene: &Path, output: Option<&Path>) -> Result<()> {
    if let Some(output) = output.filter(|output| is_same_file(output, scene)) {
        bail!("cannot write {}: it is the input", output.display());
    }
    Ok(())
}

/// Refuses to write `output` and `plot` onto one file, or onto what is read.
pub fn keep_apart(inputs: &[&PathBuf], output: Option<&Path>, plot: Option<&Path>) -> Result<()> {
    for input in inputs {
        keep(input, output)?;
        keep(input, plot)?;
    }
    match (output, plot) {
        (Some(output), Some(plot)) if output == plot || is_same_file(output, plot) => {
            bail!("cannot write {}: --output and --plot name the same file", plot.display())
        }
        _ => Ok(()),
    }
}

/// Whether both paths name one file that exists.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    fs::canonicalize(one).is_ok_and(|one| fs::canonicalize(other).is_ok_and(|other| one == other))
}
