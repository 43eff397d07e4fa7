//! `chaos`: horseshoes and a lower bound of the entropy, proved.

mod table;

use std::slice;

use anyhow::Result;
use clap::{Args, ValueHint};
use impact_pair::chaos::{
    Cells, Chaos, HSet, HorseshoeSettings, Hyperbolic, LeftOut, MOST_CELLS, MOST_DEPTH, RangeSettings,
};
use impact_pair::exact::Exact;
use impact_pair::json::{ChaosCellsDocument, ChaosDocument, GivenBase, one_a_line};
use impact_pair::periodic::bifurcation::{PARAMETERS, is_parameter};
use impact_pair::scene::{Over, Range};
use impact_pair::watch::Watch;
use impact_pair::{Effort, Error, Scene};
use serde::Deserialize;

use crate::values::whole;
use crate::{
    Answer, Asked, Counts, Failure, Format, Input, Picture, Sentence, Status, Step, TABLE_OR_JSON, Verb,
    WitnessOptions, heading, line,
};

/// Options of `chaos`.
#[derive(Args, Clone, Debug)]
pub struct ChaosOptions {
    /// Maximum number of impacts of a word: each further impact takes about 1.3 times as long [default: as many as about a
    /// million boxes times --effort lead to; with :COUNT 12]
    #[arg(long, value_name = "K", value_parser = whole(1..=MOST_DEPTH))]
    pub depth: Option<u32>,
    /// Prove as well that the motions of the words are uniformly hyperbolic: bounds of the exponents of all their invariant measures, and of
    /// the Hausdorff dimension
    #[arg(long)]
    pub hyperbolic: bool,
    /// Leave out the fate of the orbit of the scene's own start: words and entropy alone, which check --verified covers
    #[arg(long)]
    pub no_orbit: bool,
    /// Read the h-sets from FILE: JSON with a list "bases" as written by this verb
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub bases: Option<Input>,
    /// Prove it for all values of a parameter at once: amplitude, gap, restitution, frequency, or A/d, the amplitude in gaps; with :COUNT in COUNT cells, one
    /// by one: whether each holds a horseshoe, or a stable periodic orbit that the scene's own orbit converges to, or another one
    #[arg(long, value_name = "KEY=LO..HI[:COUNT]", value_parser = range, allow_hyphen_values = true)]
    pub over: Option<Over>,
    /// Multiply the work by X: without --depth the million boxes that words may take; with :COUNT an undecided cell is bisected up to 8 times, and
    /// once more where X doubles, up to 24 times
    #[arg(long, value_name = "X", default_value_t)]
    pub effort: Effort,
    /// Whether the strips of the words are part of the document.
    #[command(flatten)]
    pub witness: WitnessOptions,
}

/// Number of impacts of a word in cells, if none is given.
const DEFAULT_DEPTH: u32 = 12;

/// The content of a file of h-sets.
#[derive(Deserialize)]
struct HSetFile {
    bases: Vec<GivenBase>,
}

/// Reads h-sets.
fn read_bases(input: &Input) -> Result<Vec<HSet>, Failure> {
    let name = input.name();
    let read: HSetFile = serde_json::from_str(input.text()).map_err(|error| Failure::Input {
        input: format!("--bases is {name}, but accepted is JSON with a list \"bases\""),
        error: Box::new(Error::certificate(error.to_string())),
    })?;
    if read.bases.is_empty() {
        return Err(Failure::malformed(format!("{name} has no h-sets: its list \"bases\" is empty")));
    }
    Ok(read.bases.iter().map(HSet::from).collect())
}

/// Reads `KEY=LO..HI`, all of it at once, or `KEY=LO..HI:COUNT`, cell by cell.
fn range(text: &str) -> Result<Over, impact_pair::Error> {
    let cells = 1..=u64::from(MOST_CELLS);
    let accepted =
        format!("KEY=LO..HI or KEY=LO..HI:COUNT with LO < HI and COUNT from 1 to {MOST_CELLS}, {PARAMETERS}");
    Over::parse(text, &accepted, |range| {
        is_parameter(range) && range.count().is_none_or(|count| cells.contains(&count))
    })
}

/// The number of cells that a range is divided into, if it is.
fn cells(over: &Range) -> Option<u32> {
    over.count().map(|count| count as u32) // exact: at most MOST_CELLS
}

/// One horseshoe, or the verdicts over a range.
pub enum Chaotic<'s> {
    /// A horseshoe for one pair, or for all of a range at once.
    Horseshoe {
        /// Scene of the horseshoe.
        scene: &'s Scene,
        /// The range, if there is one.
        over: Option<Range>,
        /// The horseshoe.
        found: Box<Chaos>,
        /// The hyperbolic set of its words, if it is requested and proved.
        set: Option<Hyperbolic>,
        /// Words that the hyperbolic set leaves out, by their place in the list.
        left_out: Vec<(usize, LeftOut)>,
        /// The document.
        document: Box<ChaosDocument>,
    },
    /// Verdicts over a range, cell by cell.
    Cells {
        /// Scene of the verdicts.
        scene: &'s Scene,
        /// What is requested.
        requested: RangeSettings,
        /// The verdicts.
        found: Cells,
        /// The document.
        document: ChaosCellsDocument,
    },
}

impl Verb for ChaosOptions {
    const NAME: &'static str = "chaos";
    const FORMATS: &'static [(Format, &'static str)] = TABLE_OR_JSON;
    const SCHEMA: &'static str = "impact-pair/chaos/1, with :COUNT impact-pair/chaos-cells/1";
    const PICTURE: &'static str = "Draw a floating-point orbit, the h-sets and their first images; with :COUNT the bifurcation diagram, coloured by verdict";
    type Answer<'s> = Chaotic<'s>;

    fn counts(&self, scene: &Scene) -> Counts {
        match self.range(scene) {
            Ok(Some(over)) => cells(&over).map_or(Counts::Stages, Counts::Parameters),
            Ok(None) | Err(_) => Counts::Stages,
        }
    }

    fn inputs(&mut self) -> Vec<&mut Input> {
        self.bases.iter_mut().collect()
    }

    fn answer<'s>(&self, Asked { scene, .. }: &Asked<'s>, watch: &dyn Watch) -> Result<Chaotic<'s>, Failure> {
        let bases = self.bases.as_ref().map(read_bases).transpose()?.unwrap_or_default();
        let range = self.range(scene)?;
        let Some((over, cells)) = range.as_ref().and_then(|over| Some((over.clone(), cells(over)?))) else {
            return self.horseshoe(scene, range, bases, watch);
        };
        let single = [(!bases.is_empty(), "bases"), (self.no_orbit, "no-orbit"), (self.hyperbolic, "hyperbolic")];
        if let Some((_, option)) = single.iter().find(|(is_given, _)| *is_given) {
            let said = Sentence::default().step(Step::Name(option)).say(" applies to one range, but ");
            let key = over.key();
            let said = said.step(Step::Name("over")).say(format!(" {key}=... is divided into {cells} cells"));
            return Err(Failure::Question(said));
        }
        let halvings = RangeSettings::halvings(self.effort);
        let depth = self.depth.unwrap_or(DEFAULT_DEPTH) as usize;
        let requested = RangeSettings { over, cells, halvings, depth };
        let found = Cells::of(scene.pair(), scene.start(), &requested, watch);
        let found = found.map_err(Failure::over(slice::from_ref(&requested.over)))?;
        let mut document = found.document(scene, &requested);
        if self.witness.no_witness {
            document.stretches.iter_mut().for_each(|stretch| stretch.witness.clear());
        }
        Ok(Chaotic::Cells { document, scene, requested, found })
    }
}

impl ChaosOptions {
    /// The range of a parameter of this scene, if there is one.
    fn range(&self, scene: &Scene) -> Result<Option<Range>, Error> {
        self.over.as_ref().map(|over| over.of(scene.pair())).transpose()
    }

    /// One horseshoe, for one pair or for all of a range at once.
    fn horseshoe<'s>(
        &self,
        scene: &'s Scene,
        range: Option<Range>,
        bases: Vec<HSet>,
        watch: &dyn Watch,
    ) -> Result<Chaotic<'s>, Failure> {
        let over = range.as_ref();
        let about = |error: Error| match over {
            Some(over) => Failure::over(slice::from_ref(over))(error),
            None => Failure::Scene(error),
        };
        let question = HorseshoeSettings { depth: self.depth.map(|depth| depth as usize), bases, effort: self.effort };
        let pair = match over {
            Some(over) => {
                let all = Exact::interval(over.low(), over.high())
                    .map_err(|error| Error::range(&over.key().place(), over.low(), &error.to_string()))?;
                scene.pair().with(over.key(), all).map_err(about)?
            }
            None => scene.pair().clone(),
        };
        let found = Box::new(Chaos::of(&pair, scene.start(), &question, watch).map_err(about)?);
        let set = self.hyperbolic.then(|| Hyperbolic::of(&pair, &found, watch)).transpose().map_err(about)?;
        let left_out = set.as_ref().map(|set| set.as_ref().map_or_else(Clone::clone, |set| set.left_out.clone()));
        let mut document = Box::new(found.document(scene, over, set.as_ref()));
        document.scene_orbit = document.scene_orbit.filter(|_| !self.no_orbit);
        document.witness = document.witness.filter(|_| !self.witness.no_witness);
        let (set, left_out) = (set.and_then(Result::ok), left_out.unwrap_or_default());
        Ok(Chaotic::Horseshoe { scene, over: range, found, set, left_out, document })
    }
}

impl Answer for Chaotic<'_> {
    fn status(&self) -> Status {
        match self {
            Self::Horseshoe { found, document, .. } => table::conclusion(document, found),
            Self::Cells { document, .. } => Status::new(document.certified, table::shares(document)),
        }
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        Ok(Some(match (self, format) {
            (Self::Horseshoe { document, .. }, Format::Json) => line(document)?,
            (Self::Horseshoe { scene, found, document, .. }, _) => heading(scene) + &table::horseshoe(document, found)?,
            (Self::Cells { document, .. }, Format::Json) => one_a_line(document, &["stretches"]) + "\n",
            (Self::Cells { scene, document, .. }, _) => heading(scene) + &table::stretches(document)?,
        }))
    }

    fn notes(&self) -> Vec<String> {
        match self {
            Self::Horseshoe { left_out, .. } => table::left_out(left_out),
            Self::Cells { .. } => Vec::new(),
        }
    }

    fn picture(&self) -> Option<Picture<'_>> {
        Some(match self {
            Self::Horseshoe { scene, over, found, set, .. } => {
                Picture::Chaos(scene, over.as_ref(), found, set.as_ref())
            }
            Self::Cells { scene, requested, found, .. } => Picture::ChaosCells(scene, requested, found),
        })
    }
}
