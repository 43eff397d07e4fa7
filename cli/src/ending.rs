//! The ending of a file's name chooses the format of what is written into it.

use std::path::Path;

use anyhow::{Result, bail};
use clap::ValueEnum;

/// Endings that say what is in a file: another format in it would mislead.
const DATA_EXTENSIONS: [&str; 16] = [
    "json", "jsonl", "ndjson", "csv", "tsv", "parquet", "xlsx", "nc", "svg", "png", "pdf", "html", "toml", "v",
    "graphml", "dot",
];

/// The format of the file that an option names: the one `given`, else that of its ending, else the `usual` one.
///
/// # Errors
/// Returns an error if the ending is not one of `accepted` and no format is given, or if the ending and the given format disagree.
pub fn format<F: ValueEnum>(
    given: Option<F>,
    (option, file): (&str, Option<&Path>),
    accepted: &[F],
    usual: F,
) -> Result<F> {
    let Some((path, ending)) = file.and_then(|path| Some((path, of(path)?))) else {
        return Ok(given.unwrap_or(usual));
    };
    let meant = accepted.iter().find(|format| name(*format) == ending);
    let shown = path.display();
    match (given, meant) {
        (None, Some(meant)) => Ok(meant.clone()),
        (None, None) => {
            let endings = listed(accepted);
            let or = if option == "--output" { ", or any with --format" } else { "" };
            bail!("{option} is {shown}, but accepted is a name that ends in {endings}{or}")
        }
        (Some(given), _) if name(&given) == ending || !DATA_EXTENSIONS.contains(&ending.as_str()) => Ok(given),
        (Some(given), _) => {
            let format = given.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned());
            bail!("{option} is {shown}, but --format is {format}: accepted is a name that ends in .{}", name(&given))
        }
    }
}

/// The ending of a file's name, in small letters; stdout and what has none have none.
fn of(path: &Path) -> Option<String> {
    path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase())
}

/// The ending of a format: its name, of what people read `txt`.
fn name(format: &impl ValueEnum) -> String {
    let name = format.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned());
    if matches!(name.as_str(), "table" | "text") { "txt".to_owned() } else { name }
}

/// Endings as they are said: `.csv, .jsonl or .parquet`.
fn listed(formats: &[impl ValueEnum]) -> String {
    let endings: Vec<String> = formats.iter().map(|format| format!(".{}", name(format))).collect();
    match endings.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => endings.concat(),
    }
}

/// Refuses the name of a file of which there is one format only.
///
/// # Errors
/// Returns an error if the name has another ending than `expected`.
pub fn only(expected: &str, file: Option<&Path>) -> Result<()> {
    match file.and_then(|path| Some((path, of(path)?))) {
        Some((path, ending)) if ending != expected => {
            bail!("--output is {}, but accepted is a name that ends in .{expected}", path.display())
        }
        _ => Ok(()),
    }
}
