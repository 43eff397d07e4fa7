//! The scene that a verb is about: where it is read from, and what must not be written over it.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use anyhow::{Context, Error, Result, anyhow, bail};
use impact_pair::Scene;
use impact_pair::orbit::Settings;

/// Reads the scene of a file, or of stdin when it is `-`.
pub fn read(path: &Path) -> Result<Scene> {
    let text = text(path)?;
    Scene::parse(&text).map_err(|error| match text.trim_start().chars().next() {
        Some('{') => anyhow!(
            "{0} is a JSON document, but accepted is a scene (TOML): impact-pair check {0} proves a document again",
            name(path)
        ),
        _ => Error::from(error).context(name(path)),
    })
}

/// An error of an orbit with what it is about: `--until`, where the time to stop at is not that of a line of the scene, or else the scene.
pub fn of_orbit(error: impact_pair::Error, settings: &Settings, scene: &Path) -> Error {
    let is_given = error.key() == Some("run.until") && error.excerpt().is_none();
    let until = settings.until.as_ref().filter(|_| is_given);
    let place = until.map_or_else(|| name(scene), |until| format!("--until {until}"));
    Error::from(error).context(place)
}

/// Reads a file, or stdin when it is `-`.
pub fn text(path: &Path) -> Result<String> {
    let text = if is_stdio(path) {
        let mut text = String::new();
        io::stdin().read_to_string(&mut text).map(|_| text)
    } else {
        fs::read_to_string(path)
    };
    text.with_context(|| format!("cannot read {}", name(path)))
}

/// The file as messages name it.
pub fn name(path: &Path) -> String {
    if is_stdio(path) { "stdin".into() } else { path.display().to_string() }
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
    differ(("--output", output), ("--plot", plot))
}

/// Refuses to write what two arguments, each with its name, ask for onto one file.
pub fn differ((one, path): (&str, Option<&Path>), (other, its): (&str, Option<&Path>)) -> Result<()> {
    match (path, its) {
        (Some(path), Some(its)) if is_same_file(path, its) => {
            bail!("cannot write {}: {one} and {other} name the same file", its.display())
        }
        _ => Ok(()),
    }
}

/// Returns whether both paths name the same file, existing or not; stdin and stdout are no files.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    place(one).is_some_and(|one| place(other) == Some(one))
}

/// Returns whether a path is `-`, which stands for stdin or stdout.
pub fn is_stdio(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Returns the file that a path leads to, links and dots resolved.
fn place(path: &Path) -> Option<PathBuf> {
    if is_stdio(path) {
        return None;
    }
    let folder = || path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    fs::canonicalize(path).ok().or_else(|| Some(fs::canonicalize(folder()).ok()?.join(path.file_name()?)))
}
