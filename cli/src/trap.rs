//! `impact-pair trap SCENE`: a trapping region, proved.

use std::fmt::{self, Write};
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use impact_pair::chaos::{BoxGraph, MOST_COUNTED, NoTrap, Trap, WallWords};
use impact_pair::json::{TrapDocument, WallWordsDocument, counted};
use impact_pair::{Effort, Scene};

use crate::Answer;
use crate::destination::{Drawing, OpenOutput};
use crate::graph::{Graph, Value};
use crate::output::note;
use crate::progress::Progress;
use crate::scene;
use impact_pair_answers::heading;
use impact_pair_answers::values::whole;

pub const HELP: &str = "\
Examples:
  impact-pair trap scenes/figure-14.toml
  impact-pair trap scenes/figure-17.toml --plot region.svg --format json --output region.json
  impact-pair trap scenes/figure-14.toml --words 22

The trapping region (forward invariant) is a set of boxes in phase and speed before the impact, with every impact \
mirrored to the left wall. It grows from the end of a floating-point orbit until each flight from a box is proved to \
land in boxes; at a graze both continuations are included. A motion with one impact in the region has all later \
impacts there, never sticks, has no complete chatter, and keeps within the bounds for all time. Whether the region \
attracts motions from outside is not claimed. One harmonic only.

With --words N an edge of the graph of boxes leads from each to all that its flights may land in: F on the far wall \
(P1 or P2), N on the near one (P3 or P4). The sets of boxes that words of F and N lead to are the nodes of the graph \
of words. The words of N letters that it allows are counted exactly: the motions in the region make no others, so \
the topological entropy of their words is at most ln count / N for each N, and at most the growth rate of the paths \
where the graph of words is closed. Of P1-P4 there are twice as many words, as each begins on either wall. The \
entropy of the motions themselves may be greater: two may have one word.

The formats graphml and dot write the graph of boxes, with --words the graph of words, whose paths from node 0 on \
are the words. At a graze both walls are allowed.

Exit code: 0 a region is proved, as fine as --effort requests, the scene's own orbit is in it from some impact on, and the \
words are counted if --words is given; 1 one of these is undecided; 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("plot", |plot| plot.help("Draw the region, and a floating-point orbit in it")))]
pub struct TrapArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// Multiply the work by X, for narrower bounds: 2, 4, .., 64 bisect the boxes of the coarsest forward-invariant grid once, twice, .., 6 times
    #[arg(long, value_name = "X", default_value_t)]
    effort: Effort,
    /// Count the words of N walls that the motions in the region can make, and bound their entropy from above
    #[arg(long, value_name = "N", value_parser = whole(1..=MOST_COUNTED))]
    words: Option<u32>,
    /// Output format; json is schema impact-pair/trap/1
    /// [default: by the extension of --output, else table]
    #[arg(long, value_enum)]
    format: Option<TrapFormat>,
    #[command(flatten)]
    drawing: Drawing,
}

/// Output formats of a region.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum TrapFormat {
    /// Human-readable
    #[default]
    Table,
    /// One document of the schema named above
    Json,
    /// The graph of boxes, or of words, in GraphML
    Graphml,
    /// The same in the language of Graphviz
    Dot,
}

/// A region and its document.
struct Proved<'s> {
    scene: &'s Scene,
    graph: Option<BoxGraph>,
    words: Option<WallWords>,
    document: TrapDocument,
}

pub fn trap(arguments: &TrapArguments) -> Result<Answer> {
    let format = arguments.drawing.format(arguments.format)?;
    let OpenOutput { scene, files, path } = arguments.drawing.begin(&arguments.scene)?;
    let named = || scene::name(path);
    let progress = Progress::stages(!files.quiet);
    let found = Trap::of(&scene, arguments.effort, &progress).with_context(named)?;
    progress.clear();
    let is_table = format == TrapFormat::Table;
    let region = match found {
        Ok(region) => region,
        Err(why) => {
            let why = format!("undecided: no region is proved; {}", why.words());
            if is_table {
                return files.answer(&format!("{why}\n"), Some(why), is_table);
            }
            note(files.quiet, &why);
            return Ok(Answer::Incomplete);
        }
    };
    let is_drawn = matches!(format, TrapFormat::Graphml | TrapFormat::Dot);
    let graph = (arguments.words.is_some() || is_drawn).then(|| BoxGraph::of(scene.pair(), &region));
    let graph = graph.transpose().with_context(named)?;
    let mut document = region.document(&scene).with_context(named)?;
    let counted = graph.as_ref().zip(arguments.words).map(|(graph, impacts)| WallWords::of(graph, impacts, &progress));
    progress.clear();
    let (words, uncounted) = match counted {
        Some(Err(why)) => (None, Some(format!("undecided: the words are not counted; {}", why.words()))),
        Some(Ok(words)) => (Some(words), None),
        None => (None, None),
    };
    if let (true, Some(why)) = (is_drawn, &uncounted) {
        note(files.quiet, why);
        return Ok(Answer::Incomplete);
    }
    let missing: Vec<String> = region.coarser().map(not_finer).into_iter().chain(uncounted).collect();
    document.words = words.as_ref().map(WallWordsDocument::from);
    let proved = Proved { scene: &scene, graph, words, document };
    let text = match format {
        TrapFormat::Json => serde_json::to_string(&proved.document)? + "\n",
        TrapFormat::Table => proved.table(&missing)?,
        TrapFormat::Graphml => proved.graph().graphml()?,
        TrapFormat::Dot => proved.graph().dot()?,
    };
    let entered = proved.document.entered_at_impact.is_none().then(|| entered(&proved.document));
    let open: Vec<String> = missing.into_iter().chain(entered).collect();
    let open = (!open.is_empty()).then(|| open.join("; "));
    files
        .draw((&text, open, is_table), || Some(impact_pair_plot::chaos::trap(&scene, &region, &arguments.drawing.look)))
}

impl Proved<'_> {
    /// The region, and what was requested of it and is missing.
    fn table(&self, missing: &[String]) -> Result<String, fmt::Error> {
        let mut out = heading(self.scene);
        let document = &self.document;
        writeln!(
            out,
            "\nregion of {} boxes, {} columns per forcing period, {} rows per speed A W\nflight [time]       {}\nspeed [length/time] {}",
            document.boxes, document.columns, document.rows, document.flight_time, document.speed_before,
        )?;
        if let (Some(own), Some(words)) = (&document.words, &self.words) {
            let walls = counted(own.impacts, "wall");
            let sets = counted(words.sets() as u64, "set");
            let closed = if words.is_closed() { "closed" } else { "not closed" };
            writeln!(
                out,
                "{:20}at most {}: {sets} of boxes, {closed}\nentropy of words    at most {} per impact",
                format!("words of {walls} "),
                own.count.text(),
                own.entropy_at_most.text()
            )?;
        }
        writeln!(out, "\ncertified: a trapping region, without sticking and without complete chatter;")?;
        for why in missing {
            writeln!(out, "{why};")?;
        }
        writeln!(out, "{}", entered(document))?;
        Ok(out)
    }

    /// The graph that is written: of words if they are counted, else of boxes.
    fn graph(&self) -> Graph<'_> {
        let (scene, TrapDocument { columns, rows, .. }) = (self.scene.pair().in_words(), &self.document);
        let keys = &[("column", "long"), ("row", "long")];
        let lettered = |(from, letter, to): (usize, char, usize)| (from, Some(letter), to);
        match (&self.words, &self.graph) {
            (Some(words), _) => Graph {
                title: format!("words of walls, from node 0 on; {scene}"),
                keys,
                nodes: (0..words.sets()).map(|_| Vec::new()).collect(),
                edges: Box::new(words.edges().map(lettered)),
            },
            (None, Some(graph)) => Graph {
                title: format!("boxes, {columns} columns per forcing period, {rows} rows per speed A W; {scene}"),
                keys,
                nodes: graph.boxes().iter().map(|&(column, row)| [column, row].map(Value::of).into()).collect(),
                edges: Box::new(graph.edges().map(lettered)),
            },
            (None, None) => unreachable!("a graph is found before it is written"),
        }
    }
}

/// Returns the sentence that says that the region is not as fine as requested.
pub fn not_finer(why: NoTrap) -> String {
    format!("undecided: no finer region is proved, this one is of the coarsest grid; {}", why.words())
}

/// Returns the sentence that says from which impact on the scene's own orbit lies in the region, if that is proved.
fn entered(document: &TrapDocument) -> String {
    match document.entered_at_impact {
        Some(0) => "the scene's start and all impacts after it are in it".to_owned(),
        Some(impact) => format!("the scene's orbit is in it from impact {impact} on"),
        None => "undecided whether the scene's orbit enters it: none of its first 100 impacts is proved to lie in it"
            .to_owned(),
    }
}
