//! `impact-pair chaos SCENE`: horseshoes and a lower bound of the entropy, proved.

use std::fmt::{self, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::{Context, Result, bail};
use clap::Args;
use impact_pair::Scene;
use impact_pair::certificate::document::{
    BaseDocument, ChaosCellsDocument, ChaosDocument, Decimal, SharesDocument, one_a_line,
};
use impact_pair::chaos::{Asked, Base, Cells, Chaos, Question};
use impact_pair::document::{self, counted};
use impact_pair::exact::Exact;
use impact_pair::pair::Wall;
use impact_pair::periodic::bifurcation::Over;
use serde::Deserialize;

use crate::Answer;
use crate::arguments::{Destination, PeriodicFormat};
use crate::heading::heading;
use crate::output::Output;
use crate::progress::{Progress, goes_on, interruption};
use crate::scene;

pub const HELP: &str = "\
Examples:
  impact-pair chaos scenes/figure-14.toml --depth 4
  impact-pair chaos scenes/figure-14.toml --bases bases.json --depth 3 --over gap=9.4249..9.4251
  impact-pair chaos scenes/figure-14.toml --over amplitude=9..9.1:4 --depth 8 --plot proved.svg
  impact-pair chaos scenes/figure-12.toml

Bases are quadrilaterals of states along the leaves of the attractor: found from a floating orbit, or those of --bases. From \
each a tube of boxes is followed, impact by impact; each box is proved to be mapped along the next tube. Where a tube \
crosses a base, that is a word. For each sequence of words that fit together there is a true motion with these impacts, for a periodic \
sequence a periodic one; how many there are bounds the topological entropy from below. That says that a horseshoe is there, and \
sensitive dependence in it; not that every motion is chaotic, that the attractor is, or that the Lyapunov exponent is positive. \
Of one harmonic.

Of the orbit of the scene's own start it is said what is proved: that it converges to a periodic one, so that only transients see \
the horseshoe, and that it stays in a region (trap) in which the horseshoe lies. With --over KEY=LO..HI:COUNT each cell of the range is \
asked whether it holds a horseshoe, or that orbit converges; each verdict holds for all values in its stretch.

Exit code: 0 a positive entropy is proved, of cells one verdict for each value; 1 it is not, or it was interrupted (what is proved until then is written); 2 usage, bad \
input, I/O.";

#[derive(Args, Debug)]
pub struct ChaosArguments {
    /// Scene file (TOML), or - for stdin
    scene: PathBuf,
    /// The most impacts of a word: each one more takes about 1.3 times as long
    #[arg(long, value_name = "K", default_value_t = 12, value_parser = clap::value_parser!(u32).range(1..=64))]
    depth: u32,
    /// Take the bases of FILE: JSON with a list "bases" as this verb writes it
    #[arg(long, value_name = "FILE")]
    bases: Option<PathBuf>,
    /// Prove it for all values of a parameter at once: amplitude, gap, restitution or frequency; with :COUNT in so many cells, each
    /// by itself: whether it holds a horseshoe, or the scene's own orbit converges to a periodic one
    #[arg(long, value_name = "KEY=LO..HI[:COUNT]")]
    over: Option<Range>,
    /// With :COUNT: halve a cell so often where nothing is proved of all of it
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(0..=24))]
    halvings: u32,
    /// How it is written; json is schema impact-pair/chaos/1, with :COUNT impact-pair/chaos-cells/1
    #[arg(long, value_enum, default_value_t)]
    format: PeriodicFormat,
    /// Draw the floating orbit, the bases and the first tubes into FILE (.svg or .png); with :COUNT the bifurcation diagram, coloured by
    /// what is proved
    #[arg(long, value_name = "FILE", value_parser = impact_pair_plot::picture::path)]
    plot: Option<PathBuf>,
    #[command(flatten)]
    pub destination: Destination,
}

/// What is read of a file of bases.
#[derive(Deserialize)]
struct Bases {
    bases: Vec<BaseDocument>,
}

fn bases(path: &Path) -> Result<Vec<Base>> {
    let named = || scene::name(path);
    let read: Bases = serde_json::from_str(&scene::text(path)?).with_context(named)?;
    if read.bases.is_empty() {
        bail!("{} has no bases", named());
    }
    Ok(document::bases(&read.bases))
}

/// `KEY=LO..HI`, all of it at once, or `KEY=LO..HI:COUNT`, cell by cell.
#[derive(Clone, Debug)]
struct Range {
    over: Over,
    cells: Option<u32>,
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (range, cells) = text.rsplit_once(':').map_or((text, None), |(range, cells)| (range, Some(cells)));
        let cells = cells.map(|cells| {
            let count = cells.trim().parse().ok().filter(|count| (1..=MOST_CELLS).contains(count));
            count.ok_or_else(|| format!("the number of cells is \"{cells}\", but accepted are 1 to {MOST_CELLS}"))
        });
        Ok(Self { over: range.parse::<Over>().map_err(|error| error.to_string())?, cells: cells.transpose()? })
    }
}

const MOST_CELLS: u32 = 1_000_000;

pub fn chaos(arguments: &ChaosArguments) -> Result<Answer> {
    let scene = scene::read(&arguments.scene)?;
    let Destination { output, quiet } = &arguments.destination;
    let (output, plot) = (output.as_deref(), arguments.plot.as_deref());
    scene::keep_apart(&[&arguments.scene], output, plot)?;
    let bases = arguments.bases.as_deref().map(bases).transpose()?.unwrap_or_default();
    // From here on Ctrl-C keeps what is proved.
    interruption();
    let files = Files { out: Output::open(output)?, picture: plot.map(|path| Output::open(Some(path))).transpose()? };
    let progress = Progress::boxes(!quiet);
    let work = Work { arguments, scene: &scene, progress: &progress, files };
    match &arguments.over {
        Some(Range { over, cells: Some(cells) }) => {
            if !bases.is_empty() {
                bail!("--bases are for one range, but --over {}=... is cut into {cells} cells", over.key);
            }
            work.cells(over, *cells)
        }
        over => work.horseshoe(over.as_ref().map(|range| &range.over), bases),
    }
}

struct Files {
    out: Output,
    picture: Option<Output>,
}

struct Work<'w> {
    arguments: &'w ChaosArguments,
    scene: &'w Scene,
    progress: &'w Progress,
    files: Files,
}

impl Work<'_> {
    /// One horseshoe, for one pair or for all of a range at once.
    fn horseshoe(self, over: Option<&Over>, bases: Vec<Base>) -> Result<Answer> {
        let (scene, depth) = (self.scene, self.arguments.depth as usize);
        let question = Question { depth, bases };
        let named = || scene::name(&self.arguments.scene);
        let pair = match over {
            Some(over) => scene.pair().with(over.key, Exact::interval(&over.low, &over.high)?).with_context(named)?,
            None => scene.pair().clone(),
        };
        let watch = |depth: usize, boxes: u64| {
            let at = if depth == 0 { "bases: ".to_owned() } else { format!("depth {depth}: ") };
            self.progress.boxed(&at, boxes);
            goes_on()
        };
        let found = Chaos::of(&pair, scene.start(), &question, &watch).with_context(named)?;
        self.progress.clear();
        let document = document::chaos(scene, over, &question, &found);
        let text = match self.arguments.format {
            PeriodicFormat::Json => serde_json::to_string(&document)? + "\n",
            PeriodicFormat::Table => heading(scene) + &table(&document, &found)?,
        };
        let is_proved = document.certified && !document.interrupted;
        let open = (!is_proved).then(|| conclusion(&document, &found));
        self.answer(&text, open, || impact_pair_plot::chaos::chaos(scene, &found))
    }

    /// What is proved of each value in a range.
    fn cells(self, over: &Over, cells: u32) -> Result<Answer> {
        let scene = self.scene;
        let (halvings, depth) = (self.arguments.halvings, self.arguments.depth as usize);
        let asked = Asked { over: over.clone(), cells, halvings, depth };
        let watch = |done: u32| {
            self.progress.boxed(&format!("of {cells} cells are done "), done.into());
            goes_on()
        };
        let found = Cells::of(scene.pair(), scene.start(), &asked, &watch);
        self.progress.clear();
        let found = found.with_context(|| scene::name(&self.arguments.scene))?;
        let document = document::cells(scene, &asked, &found);
        let text = match self.arguments.format {
            PeriodicFormat::Json => one_a_line(&document, &["stretches"]) + "\n",
            PeriodicFormat::Table => heading(scene) + &stretches(&document)?,
        };
        let open = (!document.certified).then(|| shares(&document));
        self.answer(&text, open, || impact_pair_plot::proved::cells(scene, &asked, &found))
    }

    fn answer(self, text: &str, open: Option<String>, svg: impl FnOnce() -> Result<String>) -> Result<Answer> {
        let is_table = self.arguments.format == PeriodicFormat::Table;
        let answer = self.files.out.answer(text, open, (self.arguments.destination.quiet, is_table))?;
        if let (Some(picture), Some(path)) = (self.files.picture, &self.arguments.plot) {
            picture.draw(path, svg)?;
        }
        Ok(answer)
    }
}

fn table(document: &ChaosDocument, found: &Chaos) -> Result<String, fmt::Error> {
    let mut out = String::new();
    if let Some(over) = &document.over {
        writeln!(out, "for all values of {} from {} to {}", over.key, over.low.0, over.high.0)?;
    }
    let words = found.words().len();
    writeln!(
        out,
        "\n{} bases, {words} words of at most {} impacts, {} boxes",
        document.bases.len(),
        document.depth,
        document.boxes
    )?;
    if let Some([a, b]) = found.horseshoe() {
        let time = |half: i64| if half == 2 { "1 cycle".to_owned() } else { format!("{} cycles", 0.5 * half as f64) };
        let blocks = [a, b].map(|word| format!("{} ({})", word.in_mappings(), time(word.half_cycles)));
        let mirrored = [a, b].iter().any(|word| word.walls.last() == Some(&Wall::Right));
        let mirrored = if mirrored { " (mirrored where it starts on the right wall)" } else { "" };
        writeln!(
            out,
            "for every sequence of these two blocks{mirrored} there is a motion, for a periodic one a periodic motion:"
        )?;
        writeln!(out, "  {}\n  {}", blocks[0], blocks[1])?;
    }
    if let Some(exponent) = document.exponent_seen {
        writeln!(out, "Lyapunov exponent of the floating orbit: {exponent:.3} an impact (seen, not proved)")?;
    }
    for line in fate(document) {
        writeln!(out, "{line}")?;
    }
    writeln!(out, "\n{}", conclusion(document, found))?;
    Ok(out)
}

/// Whether the scene's own orbit is where the horseshoe is, as far as that is proved.
fn fate(document: &ChaosDocument) -> Vec<String> {
    let mut lines = Vec::new();
    let scene_orbit = document.scene_orbit.as_ref();
    let attracted = scene_orbit.and_then(|orbit| orbit.attracted.as_ref());
    if let Some(period) = attracted {
        let (impacts, cycles) = (counted(period.impacts, "impact"), counted(period.cycles, "cycle"));
        let beside =
            if document.certified { ": the horseshoe is not what it tends to, only transients can see it" } else { "" };
        lines.push(format!(
            "the scene's own orbit converges to a stable periodic orbit of {impacts} in {cycles} (proved){beside}"
        ));
    }
    if !document.certified {
        return lines;
    }
    lines.push(match scene_orbit.and_then(|orbit| orbit.region.as_ref()) {
        Some(region) if region.holds_bases => format!(
            "the horseshoe lies in a region of {} boxes that the scene's own orbit is in from impact {} on, for ever (proved)",
            region.boxes, region.entered_at_impact
        ),
        Some(region) => format!(
            "undecided whether the horseshoe lies in the region of {} boxes that the scene's own orbit does not leave",
            region.boxes
        ),
        None if attracted.is_none() => "undecided whether the scene's own orbit comes where the horseshoe is".to_owned(),
        None => return lines,
    });
    lines
}

/// The last line.
fn conclusion(document: &ChaosDocument, found: &Chaos) -> String {
    let stopped = if document.interrupted { "interrupted: " } else { "" };
    if document.certified {
        let [impact, cycle] = [&document.entropy.per_impact, &document.entropy.per_cycle].map(Decimal::text);
        return format!(
            "{stopped}certified: the impact map holds a horseshoe; its topological entropy is at least {impact} an impact, {cycle} a cycle"
        );
    }
    if found.bases().is_empty() && document.exponent_seen.is_some_and(|exponent| exponent < 1e-3) {
        return "undecided: the floating orbit is regular, and no horseshoe is found among transients; one may be there all the same"
            .to_owned();
    }
    let hint = if document.over.is_some() { "; try a narrower --over" } else { "; try more --depth" };
    format!("{stopped}undecided: no horseshoe is proved{hint}")
}

fn stretches(document: &ChaosCellsDocument) -> Result<String, fmt::Error> {
    let mut out = String::new();
    writeln!(out, "over {} from {} to {}\n", document.over.key, document.over.low.0, document.over.high.0)?;
    writeln!(out, "{:>12} {:>12}  {:10}", "from", "to", "verdict")?;
    for stretch in &document.stretches {
        let [low, high] = [&stretch.low, &stretch.high].map(|end| end.0.text());
        let what = match (&stretch.entropy, &stretch.period) {
            (Some(entropy), _) => format!(
                "entropy at least {} an impact, {} a cycle",
                entropy.per_impact.text(),
                entropy.per_cycle.text()
            ),
            (_, Some(period)) => {
                format!("{} in {}", counted(period.impacts, "impact"), counted(period.cycles, "cycle"))
            }
            _ => String::new(),
        };
        writeln!(out, "{}", format!("{low:>12} {high:>12}  {:10} {what}", stretch.verdict).trim_end())?;
    }
    writeln!(out, "\n{}", shares(document))?;
    Ok(out)
}

/// How much of the range is proved.
fn shares(document: &ChaosCellsDocument) -> String {
    let SharesDocument { horseshoe, attracted, undecided } = &document.shares;
    let percent = |share: &f64| format!("{:.2} %", 100.0 * share);
    let said = if document.certified { "certified" } else { "not all certified" };
    let stopped = if document.interrupted { "interrupted: " } else { "" };
    format!(
        "{stopped}{said}: a horseshoe over {} of the range, the scene's own orbit attracted to a periodic one over {}, undecided {}",
        percent(horseshoe),
        percent(attracted),
        percent(undecided)
    )
}
