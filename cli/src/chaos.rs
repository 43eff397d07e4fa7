//! `impact-pair chaos SCENE`: horseshoes and a lower bound of the entropy, proved.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use impact_pair::certificate::document::{BaseDocument, ChaosDocument};
use impact_pair::chaos::{Base, Chaos, Question};
use impact_pair::document;
use impact_pair::exact::Exact;
use impact_pair::pair::Wall;
use impact_pair::periodic::bifurcation::Over;
use serde::Deserialize;

use crate::Answer;
use crate::arguments::PeriodicFormat;
use crate::heading::heading;
use crate::output::Output;
use crate::progress::{Progress, goes_on, interruption};
use crate::scene;

pub const HELP: &str = "\
Examples:
  impact-pair chaos scenes/figure-14.toml --depth 4
  impact-pair chaos scenes/figure-14.toml --bases bases.json --depth 3 --over gap=9.4249..9.4251
  impact-pair chaos scenes/figure-12.toml

Bases are quadrilaterals of states along the leaves of the attractor: found from a floating orbit, or those of --bases. From \
each a tube of boxes is followed, impact by impact; each box is proved to be mapped along the next tube. Where a tube \
crosses a base, that is a word. For each sequence of words that fit together there is a true motion with these impacts, for a periodic \
sequence a periodic one; how many there are bounds the topological entropy from below. That says that a horseshoe is there, and \
sensitive dependence in it; not that every motion is chaotic, that the attractor is, or that the Lyapunov exponent is positive. \
Of one harmonic.

Exit code: 0 a positive entropy is proved; 1 none is, or it was interrupted (what is proved until then is written); 2 usage, bad \
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
    /// Prove it for all values of a parameter: amplitude, gap, restitution or frequency
    #[arg(long, value_name = "KEY=LO..HI")]
    over: Option<Over>,
    /// How it is written; json is schema impact-pair/chaos/1
    #[arg(long, value_enum, default_value_t)]
    format: PeriodicFormat,
    /// Write to FILE, which appears whole or not at all, instead of stdout
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Draw the floating orbit, the bases and the first tubes into FILE (.svg or .png)
    #[arg(long, value_name = "FILE", value_parser = impact_pair_plot::picture::path)]
    plot: Option<PathBuf>,
    /// No notes and no progress on stderr
    #[arg(long, short)]
    quiet: bool,
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

pub fn chaos(arguments: &ChaosArguments) -> Result<Answer> {
    let scene = scene::read(&arguments.scene)?;
    scene::keep_apart(&[&arguments.scene], arguments.output.as_deref(), arguments.plot.as_deref())?;
    let bases = arguments.bases.as_deref().map(bases).transpose()?.unwrap_or_default();
    let question = Question { depth: arguments.depth as usize, bases };
    let named = || scene::name(&arguments.scene);
    let pair = match &arguments.over {
        Some(over) => scene.pair().with(over.key, Exact::interval(&over.low, &over.high)?).with_context(named)?,
        None => scene.pair().clone(),
    };
    interruption();
    let progress = Progress::boxes(!arguments.quiet);
    let watch = |depth: usize, boxes: u64| {
        let at = if depth == 0 { "bases: ".to_owned() } else { format!("depth {depth}: ") };
        progress.boxed(&at, boxes);
        goes_on()
    };
    let found = Chaos::of(&pair, scene.start(), &question, &watch).with_context(named)?;
    progress.clear();
    let document = document::chaos(&scene, arguments.over.as_ref(), &question, &found);
    let mut out = Output::open(arguments.output.as_deref())?;
    let write = "cannot write the output";
    match arguments.format {
        PeriodicFormat::Json => writeln!(out, "{}", serde_json::to_string(&document)?).context(write)?,
        PeriodicFormat::Table => {
            write!(out, "{}", heading(&scene)).context(write)?;
            table(&mut out, &document, &found).context(write)?;
        }
    }
    out.commit()?;
    if let Some(path) = &arguments.plot {
        Output::open(Some(path))?.draw(path, || impact_pair_plot::chaos::chaos(&scene, &found))?;
    }
    let is_proved = found.entropy() > 0.0 && !document.interrupted;
    Ok(if is_proved { Answer::Complete } else { Answer::Incomplete })
}

fn table(out: &mut impl Write, document: &ChaosDocument, found: &Chaos) -> io::Result<()> {
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
    let stopped = if document.interrupted { "interrupted: " } else { "" };
    if found.entropy() > 0.0 {
        // Rounded down.
        let down = |x: f64| (x * 1e5).floor() / 1e5;
        let [impact, cycle] = [found.entropy(), found.entropy_a_cycle()].map(down);
        writeln!(
            out,
            "\n{stopped}certified: the impact map holds a horseshoe; its topological entropy is at least {impact:.5} an impact, {cycle:.5} a cycle"
        )
    } else if found.bases().is_empty() && found.exponent().is_some_and(|exponent| exponent < 1e-3) {
        writeln!(
            out,
            "\nundecided: the floating orbit is regular: no horseshoe is looked for; one may be there all the same, off the attractor"
        )
    } else {
        let hint = if document.over.is_some() { "; try a narrower --over" } else { "; try more --depth" };
        writeln!(out, "\n{stopped}undecided: no horseshoe is proved{hint}")
    }
}
