//! `impact-pair chaos SCENE`: horseshoes and a lower bound of the entropy, proved.

mod table;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use impact_pair::chaos::{Cells, Chaos, HSet, HorseshoeSettings, Hyperbolic, MOST_CELLS, MOST_DEPTH, RangeSettings};
use impact_pair::exact::Exact;
use impact_pair::json::{GivenBase, one_a_line};
use impact_pair::periodic::bifurcation::{PARAMETERS, is_parameter};
use impact_pair::scene::{Over, Range};
use impact_pair::{Effort, Scene};
use serde::Deserialize;

use crate::Answer;
use crate::destination::{Drawing, Files, OpenOutput};
use crate::output::note;
use crate::periodic::PeriodicFormat;
use crate::progress::Progress;
use crate::scene;
use impact_pair_answers::heading;
use impact_pair_answers::values::whole;

pub const HELP: &str = "\
Examples:
  impact-pair chaos scenes/figure-14.toml --depth 4
  impact-pair chaos scenes/figure-14.toml --bases bases.json --depth 3 --hyperbolic
  impact-pair chaos scenes/figure-14.toml --over amplitude=1..1.1:2 --plot proved.svg

The h-sets are quadrilaterals of states along the leaves of the attractor, found from a floating-point orbit or read \
from --bases. The image of each is followed, impact by impact, by a chain of boxes; each box is proved to be mapped \
along the next ones. Where the image covers an h-set (a covering relation), the walls of its impacts are a word. For \
each sequence of words that fit together there is a true motion with these impacts, and for a periodic sequence a \
periodic one; their number bounds the topological entropy from below. This proves a horseshoe and sensitive \
dependence on initial conditions in it. It does not prove that every motion is chaotic, that the attractor is, or \
that the Lyapunov exponent is positive. One harmonic only.

With --hyperbolic, words are proved to be uniformly hyperbolic by cones, where they are; the others are left out. For each two-sided sequence of these words there is then exactly one motion, and the output bounds their entropy from both sides, the Lyapunov exponents of every invariant measure on the set of these motions, and its Hausdorff dimension. That set is not the attractor, and a typical orbit is not in it.

For the orbit of the scene's own start, the output states whether it is proved to converge to a periodic orbit, so \
that only transients visit the horseshoe, or to stay in a trapping region that contains the horseshoe. With --over \
KEY=LO..HI:COUNT, each cell of the range is tested for a horseshoe, for convergence of that orbit, and for a stable \
periodic orbit that it may not converge to; each verdict holds for all values in its interval.

Exit code: 0 a positive entropy is proved, or with COUNT a verdict for every value; 1 it is not, or the run was \
interrupted (the proved part is written); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("plot", |plot| plot.help("Draw a floating-point orbit, the h-sets and their first images; with :COUNT the bifurcation diagram, coloured by verdict")))]
pub struct ChaosArguments {
    /// Scene file (TOML), or - for stdin
    scene: PathBuf,
    /// Maximum number of impacts of a word: each further impact takes about 1.3 times as long [default: as many as about a
    /// million boxes times --effort lead to; with :COUNT 12]
    #[arg(long, value_name = "K", value_parser = whole(1..=MOST_DEPTH))]
    depth: Option<u32>,
    /// Prove as well that the motions of the words are uniformly hyperbolic: bounds of the exponents of all their invariant measures, and of
    /// the Hausdorff dimension
    #[arg(long)]
    hyperbolic: bool,
    /// Leave out the fate of the orbit of the scene's own start: words and entropy alone, which check --verified covers
    #[arg(long)]
    no_orbit: bool,
    /// Read the h-sets from FILE: JSON with a list "bases" as written by this verb
    #[arg(long, value_name = "FILE")]
    bases: Option<PathBuf>,
    /// Prove it for all values of a parameter at once: amplitude, gap, restitution, frequency, or A/d, the amplitude in gaps; with :COUNT in COUNT cells, one
    /// by one: whether each holds a horseshoe, or a stable periodic orbit that the scene's own orbit converges to, or another one
    #[arg(long, value_name = "KEY=LO..HI[:COUNT]", value_parser = range, allow_hyphen_values = true)]
    over: Option<Over>,
    /// Multiply the work by X: without --depth the million boxes that words may take; with :COUNT an undecided cell is bisected up to 8 times, and
    /// once more where X doubles, up to 24 times
    #[arg(long, value_name = "X", default_value_t)]
    effort: Effort,
    /// Output format; json is schema impact-pair/chaos/1, with :COUNT impact-pair/chaos-cells/1
    /// [default: by the extension of --output, else table]
    #[arg(long, value_enum)]
    format: Option<PeriodicFormat>,
    #[command(flatten)]
    drawing: Drawing,
}

/// Number of impacts of a word in cells, if none is given.
const DEFAULT_DEPTH: usize = 12;

/// The content of a file of h-sets.
#[derive(Deserialize)]
struct HSetFile {
    bases: Vec<GivenBase>,
}

fn bases(path: &Path) -> Result<Vec<HSet>> {
    let named = || scene::name(path);
    let read: Result<HSetFile, _> = serde_json::from_str(&scene::text(path)?);
    let accepted = || format!("--bases is {}, but accepted is JSON with a list \"bases\"", named());
    let read = read.with_context(accepted)?;
    if read.bases.is_empty() {
        bail!("{} has no h-sets: its list \"bases\" is empty", named());
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

pub fn chaos(arguments: &ChaosArguments) -> Result<Answer> {
    let format = arguments.drawing.format(arguments.format)?;
    let OpenOutput { scene, files, .. } = arguments.drawing.begin(&arguments.scene)?;
    let bases = arguments.bases.as_deref().map(bases).transpose()?.unwrap_or_default();
    let work = Work { arguments, format, scene: &scene, files };
    let over = arguments.over.as_ref().map(|over| over.of(scene.pair())).transpose();
    let over = over.map_err(|error| scene::about(error, &[], &arguments.scene))?;
    match over.as_ref().map(|over| (over, over.count())) {
        Some((over, Some(cells))) => {
            if !bases.is_empty() {
                bail!("--bases applies to one range, but --over {}=... is divided into {cells} cells", over.key());
            }
            if arguments.no_orbit {
                bail!("--no-orbit applies to one range, but --over {}=... is divided into {cells} cells", over.key());
            }
            if arguments.hyperbolic {
                bail!("--hyperbolic applies to one range, but --over {}=... is divided into {cells} cells", over.key());
            }
            work.cells(over, u32::try_from(cells)?)
        }
        over => work.horseshoe(over.map(|(over, _)| over), bases),
    }
}

struct Work<'w> {
    arguments: &'w ChaosArguments,
    format: PeriodicFormat,
    scene: &'w Scene,
    files: Files,
}

impl Work<'_> {
    /// One horseshoe, for one pair or for all of a range at once.
    fn horseshoe(self, over: Option<&Range>, bases: Vec<HSet>) -> Result<Answer> {
        let (scene, depth) = (self.scene, self.arguments.depth.map(|depth| depth as usize));
        let question = HorseshoeSettings { depth, bases, effort: self.arguments.effort };
        let ranges: Vec<_> = over.iter().map(|over| (over.key(), over.to_string())).collect();
        let about = |error: impact_pair::Error| scene::about(error, &ranges, &self.arguments.scene);
        let pair = match over {
            Some(over) => {
                let all = Exact::interval(over.low(), over.high())?;
                scene.pair().with(over.key(), all).map_err(about)?
            }
            None => scene.pair().clone(),
        };
        let progress = Progress::stages(!self.files.quiet);
        let found = Chaos::of(&pair, scene.start(), &question, &progress).map_err(about)?;
        let set = self.arguments.hyperbolic.then(|| Hyperbolic::of(&pair, &found, &progress));
        let set = set.transpose().map_err(about)?;
        progress.clear();
        if let Some(set) = &set {
            let left_out = set.as_ref().map_or_else(|none| none, |set| &set.left_out);
            table::left_out(left_out).iter().for_each(|line| note(self.files.quiet, line));
        }
        let mut document = found.document(scene, over, set.as_ref());
        document.scene_orbit = document.scene_orbit.filter(|_| !self.arguments.no_orbit);
        let proved = set.and_then(Result::ok);
        let text = match self.format {
            PeriodicFormat::Json => serde_json::to_string(&document)? + "\n",
            PeriodicFormat::Table => heading(scene) + &table::horseshoe(&document, &found)?,
        };
        let is_proved = document.certified && !document.interrupted && document.hyperbolic != Some(None);
        let open = (!is_proved).then(|| table::conclusion(&document, &found));
        let is_table = self.format == PeriodicFormat::Table;
        self.files.draw((&text, open, is_table), || {
            Some(impact_pair_plot::chaos::chaos(scene, over, (&found, proved.as_ref()), &self.arguments.drawing.look))
        })
    }

    /// Writes the verdicts over a range.
    fn cells(self, over: &Range, cells: u32) -> Result<Answer> {
        let scene = self.scene;
        let halvings = RangeSettings::halvings(self.arguments.effort);
        let depth = self.arguments.depth.map_or(DEFAULT_DEPTH, |depth| depth as usize);
        let requested = RangeSettings { over: over.clone(), cells, halvings, depth };
        let progress = Progress::cells(cells, !self.files.quiet);
        let found = Cells::of(scene.pair(), scene.start(), &requested, &progress);
        progress.clear();
        let found =
            found.map_err(|error| scene::about(error, &[(over.key(), over.to_string())], &self.arguments.scene))?;
        let document = found.document(scene, &requested);
        let text = match self.format {
            PeriodicFormat::Json => one_a_line(&document, &["stretches"]) + "\n",
            PeriodicFormat::Table => heading(scene) + &table::stretches(&document)?,
        };
        let open = (!document.certified).then(|| table::shares(&document));
        let is_table = self.format == PeriodicFormat::Table;
        self.files.draw((&text, open, is_table), || {
            Some(impact_pair_plot::proved::cells(scene, &requested, &found, &self.arguments.drawing.look))
        })
    }
}
