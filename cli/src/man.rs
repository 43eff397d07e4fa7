//! `impact-pair man`: manual pages, made from the definitions that the command line is read by.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::{Args, Command};
use clap_mangen::Man;

use crate::Answer;
use crate::output::Output;

pub const HELP: &str = "\
Examples:
  impact-pair man > impact-pair.1
  impact-pair man --output man";

#[derive(Args, Debug)]
pub struct ManArguments {
    /// Write a page for the program and one for each verb into DIR, which is created if needed
    #[arg(long, short, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

/// Writes the pages of this command.
pub fn man(command: Command, arguments: &ManArguments) -> Result<Answer> {
    let mut command = command.disable_help_subcommand(true);
    // Gives the verbs their full names.
    command.build();
    let Some(folder) = &arguments.output else {
        write(&command, None)?;
        return Ok(Answer::Complete);
    };
    fs::create_dir_all(folder).with_context(|| format!("cannot create {}", folder.display()))?;
    for page in std::iter::once(&command).chain(command.get_subcommands()) {
        write(page, Some(folder))?;
    }
    Ok(Answer::Complete)
}

/// Writes a page into the folder, or to stdout.
fn write(command: &Command, folder: Option<&Path>) -> Result<()> {
    let man = Man::new(command.clone());
    let mut page = Vec::new();
    man.render(&mut page).context("cannot write the page")?;
    let path = folder.map(|folder| folder.join(man.get_filename()));
    let mut out = Output::open(path.as_deref())?;
    out.write_all(&page).context("cannot write the output")?;
    out.commit()
}
