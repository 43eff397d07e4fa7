//! Verbs of the impact pair: their options, their answers as documents and tables, and what is left undecided.
//!
//! The command line, Python and a [`Question`] in JSON have the same options, values and refusals.
//!
//! ```
//! use impact_pair::watch::Unwatched;
//! use impact_pair_answers::{Format, Question};
//!
//! let question = Question::read(r#"{
//!     "verb": "periodic",
//!     "scene": {"excitation": {"amplitude": ["1"], "frequency": ["pi"], "phase": ["0"]}, "gap": "9.42497",
//!               "restitution": "0.5", "start": {"time": "0", "wall": "left", "velocity": "-12.56636"}},
//!     "options": {"word": "RL", "cycles": 1}
//! }"#)?;
//! let found = question.answer(&Unwatched)?;
//! assert!(found.status().is_complete());
//! assert!(found.status().to_string().ends_with("others are not excluded (try --all)"));
//! assert!(found.status().in_python().ends_with("others are not excluded (try all=True)"));
//! assert!(found.text(Format::Json).unwrap().unwrap().starts_with("{\"schema\":\"impact-pair/periodic/1\""));
//! # Ok::<(), impact_pair_answers::Failure>(())
//! ```

pub mod atlas;
mod audit;
mod bifurcations;
mod chaos;
mod cycles;
pub mod describe;
mod failure;
mod global;
mod graph;
pub mod grid;
mod heading;
mod input;
mod options;
mod periodic;
mod picture;
mod question;
mod run;
#[cfg(test)]
mod scenes;
mod status;
pub mod sweep;
mod tangency;
#[cfg(test)]
#[path = "../../../tests/tolerances/mod.rs"]
mod tolerances;
pub mod trade;
mod trap;
mod two_impact;
pub mod values;
mod windows;
mod witness;

use anyhow::Result;
use clap::ValueEnum;
use impact_pair::Scene;
use impact_pair::watch::Watch;

pub use atlas::AtlasOptions;
pub use audit::AuditOptions;
pub use bifurcations::BifurcationOptions;
pub use chaos::ChaosOptions;
pub use cycles::CyclesOptions;
pub use describe::DescribeOptions;
pub use failure::Failure;
pub use global::GlobalOptions;
pub use input::Input;
pub use options::{Options, read_options};
pub use periodic::PeriodicOptions;
pub use picture::Picture;
pub use question::Question;
pub use run::{CSV_HEADER, Listing, RunOptions, csv_row};
pub use status::{Sentence, Status, Step};
pub use sweep::SweepOptions;
pub use tangency::TangencyOptions;
pub use trade::TradeOptions;
pub use trap::TrapOptions;
pub use two_impact::TwoImpactOptions;
pub use windows::WindowsOptions;
pub use witness::WitnessOptions;

use heading::{heading, pair_heading};
use periodic::{physical, symmetric};

/// Options of a verb, which are its arguments on the command line and the keys of `options` in a [`Question`].
pub trait Verb: clap::Args {
    /// Name on the command line.
    const NAME: &'static str;
    /// Formats of the answer, the usual one first, each with its help.
    const FORMATS: &'static [(Format, &'static str)];
    /// Schema of the document, as the help of the format names it; empty where the formats say it.
    const SCHEMA: &'static str;
    /// Help of the option that draws a picture.
    const PICTURE: &'static str = "";
    /// The answer.
    type Answer<'s>: Answer + 's;

    /// What the progress of the computation counts.
    fn counts(&self, _scene: &Scene) -> Counts {
        Counts::Stages
    }

    /// Files that the options name.
    fn inputs(&mut self) -> Vec<&mut Input> {
        Vec::new()
    }

    /// Answers the question, until the watch stops it; what is certified so far is kept.
    ///
    /// # Errors
    /// If a value of the scene or of an option is not accepted.
    fn answer<'s>(&self, asked: &Asked<'s>, watch: &dyn Watch) -> Result<Self::Answer<'s>, Failure>;

    /// Why these options have no answer in this format, and which formats they have; `None` if they have one.
    fn refuses(&self, _format: Format) -> Option<&'static str> {
        None
    }
}

/// What a verb is asked about.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'s> {
    /// The scene.
    pub scene: &'s Scene,
    /// Path of the scene, by which commands name it.
    pub name: &'s str,
    /// True if a picture is requested as well.
    pub is_drawn: bool,
    /// True if the answer is written as a document: then its witness is made.
    pub is_document: bool,
}

/// The answer of a verb.
pub trait Answer {
    /// How much of what was requested is certified.
    fn status(&self) -> Status;

    /// The answer in a format; `None` where there is nothing to write.
    ///
    /// # Errors
    /// If a value exceeds the range of exact expressions.
    fn text(&self, format: Format) -> Result<Option<String>>;

    /// Remarks that no format holds.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    /// The picture; `None` where there is nothing to draw.
    fn picture(&self) -> Option<Picture<'_>> {
        None
    }
}

/// Formats of answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Lines in columns.
    Table,
    /// Lines for people.
    Text,
    /// A document.
    Json,
    /// Documents, one a line.
    Jsonl,
    /// One row a line, bounds in columns.
    Csv,
    /// A graph in GraphML.
    Graphml,
    /// A graph in the language of Graphviz.
    Dot,
}

impl Format {
    /// True if people read it: then it says itself what is undecided.
    pub fn is_for_people(self) -> bool {
        matches!(self, Self::Table | Self::Text)
    }
}

/// Formats of periodic orbits, and of all verbs with these two.
const TABLE_OR_JSON: &[(Format, &str)] = &[
    (Format::Table, "Human-readable: the certain digits, then the last digits of both bounds"),
    (Format::Json, "One document of the schema named above"),
];

/// What progress counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counts {
    /// What each stage counts.
    Stages,
    /// Cells of the state space.
    Cells,
    /// Cells of the range of a parameter, of which there are this many.
    Parameters(u32),
    /// Impacts, up to this one if it is known.
    Impacts(Option<u64>),
    /// Nothing: this is what is done.
    Nothing(&'static str),
}

/// A document in one line.
fn line(document: &impl serde::Serialize) -> Result<String> {
    Ok(serde_json::to_string(document)? + "\n")
}
