//! Outputs of a verb: they are proved to be other files than its inputs, and opened.

use std::path::{Path, PathBuf};

use anyhow::{Error, Result};
use clap::{Args, ValueEnum};
use impact_pair::Scene;
use impact_pair_plot::picture::Look;

use crate::output::Output;
use crate::progress::catch_interruption;
use crate::{Answer, ending, scene};

/// The output of a verb, and whether notes are printed.
#[derive(Args, Debug)]
pub struct Destination {
    /// Write to FILE, atomically, instead of stdout; its ending chooses the format
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Print no notes and no progress on stderr
    #[arg(long, short)]
    pub quiet: bool,
}

impl Destination {
    /// The format of the output: the one given, else that of its ending, else the usual one.
    ///
    /// # Errors
    /// Returns an error if the ending belongs to no format, or contradicts the given format.
    pub fn format<F: ValueEnum + Default>(&self, given: Option<F>) -> Result<F> {
        ending::format(given, ("--output", self.output.as_deref()), F::value_variants(), F::default())
    }

    /// Opens the outputs of a verb that reads these inputs. From here on Ctrl-C keeps the certified part.
    ///
    /// # Errors
    /// If an output is one of the inputs or cannot be written, or both outputs are one file.
    pub fn open(&self, inputs: &[&PathBuf], plot: Option<(&Path, &Look)>) -> Result<Files> {
        let output = self.output.as_deref();
        scene::keep_apart(inputs, output, plot.map(|(path, _)| path))?;
        catch_interruption();
        let out = Output::open(output)?;
        let open =
            |(path, look): (&Path, &Look)| Ok::<_, Error>((Output::open(Some(path))?, path.to_owned(), look.clone()));
        Ok(Files { out, picture: plot.map(open).transpose()?, quiet: self.quiet })
    }

    /// Reads the scene of a verb and opens its outputs.
    ///
    /// # Errors
    /// If the scene is none, and as [`open`](Self::open).
    pub fn begin<'a>(&self, path: &'a PathBuf, plot: Option<(&Path, &Look)>) -> Result<OpenOutput<'a>> {
        let scene = scene::read(path)?;
        Ok(OpenOutput { files: self.open(&[path], plot)?, scene, path })
    }
}

/// The picture of an answer, and where both go. What the picture is of, each verb says by `mut_arg("plot", ..)`.
#[derive(Args, Debug)]
pub struct Drawing {
    /// Draw the answer
    #[arg(long, value_name = "FILE.svg|FILE.png|FILE.pdf", value_parser = impact_pair_plot::picture::path)]
    pub plot: Option<PathBuf>,
    #[command(flatten)]
    pub look: Look,
    #[command(flatten)]
    pub destination: Destination,
}

/// A verb that has begun.
pub struct OpenOutput<'a> {
    /// The scene that the verb reads.
    pub scene: Scene,
    /// The path of the scene file.
    pub path: &'a PathBuf,
    /// The outputs.
    pub files: Files,
}

/// The open outputs of a verb.
pub struct Files {
    pub out: Output,
    picture: Option<(Output, PathBuf, Look)>,
    pub quiet: bool,
}

impl Files {
    /// Writes an answer, and the picture if one is requested and there is something to draw. What the answer leaves open is said on stderr
    /// as well, unless it `is_said` in the text and that goes to stdout.
    pub fn draw(
        self,
        (text, open, is_said): (&str, Option<String>, bool),
        svg: impl FnOnce() -> Option<Result<String>>,
    ) -> Result<Answer> {
        let answer = self.out.answer(text, open, (self.quiet, is_said))?;
        if let Some((picture, path, look)) = self.picture
            && let Some(svg) = svg()
        {
            picture.draw(&path, &look, svg)?;
        }
        Ok(answer)
    }
}
