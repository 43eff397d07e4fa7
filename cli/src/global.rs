//! `impact-pair global SCENE`: where every motion goes, proved.

use std::fmt::{self, Write};
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use impact_pair::chaos::{Class, Global, GlobalSettings, Kind, MOST_DEPTH, OpenReason, Recurrence};
use impact_pair::exact::decimal_digits;
use impact_pair::json::{GlobalDocument, counted};
use impact_pair::{Effort, Scene};

use crate::Answer;
use crate::destination::{Drawing, OpenOutput};
use crate::graph::{Graph, Value};
use crate::progress::Progress;
use crate::scene;
use impact_pair_answers::pair_heading;
use impact_pair_answers::values::{digits, whole};

pub const HELP: &str = "\
Examples:
  impact-pair global scenes/figure-12.toml
  impact-pair global scenes/figure-14.toml --plot global.svg --format json --output global.json

With every impact mirrored to the left wall, all phases and all speeds that motions have in the end are covered by \
boxes. Enclosures of the successors of each box, an impact or a rest and its release, make a graph; at a graze both \
continuations are included. Its recurrent components hold all that motions do in the end: each is halved, box by box, \
until the limit of its motions is proved (a periodic orbit, a cycle with rests, a graze in every forcing period), \
or until enough boxes are mapped. The start of the scene is not used. One harmonic and a restitution below 0.99 only; \
parameters may be intervals.

An undecided component has no claim, not even that a motion stays in it. Of a \
`closed` one all motions are in it in the end. With --basins the basin of an attractor is the boxes all of whose motions \
are proved to end in it, as a part of the state space: lower bounds. With --horseshoes the largest few undecided \
components are searched for horseshoes, as chaos proves them: where one is proved the component holds a compact \
invariant set of positive topological entropy.

With --plot the state space is coloured by the attractor that its motions end in, beside the graph of components. The \
formats graphml and dot write that graph: an edge where motions may go from one component to another.

Exit code: 0 every motion that touches a wall is proved to end in one cycle with rests, or to tend to one attractor, \
apart from saddles and grazes; 1 not so, or the run was interrupted (the proved part is written); 2 usage, bad input, \
I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("plot", |plot| plot.help("Draw the state space by the limits of its motions, and the graph of components")))]
pub struct GlobalArguments {
    /// Scene file (TOML), or - for stdin
    scene: PathBuf,
    /// Multiply the work by X: at 1 about 300,000 boxes are mapped in all, from a partition into 16,384, those of the smallest undecided
    /// component first
    #[arg(long, value_name = "X", default_value_t)]
    effort: Effort,
    /// Prove basins of attraction, by about 65,536 boxes times --effort [with --plot they are]
    #[arg(long)]
    basins: bool,
    /// Look for a horseshoe in undecided components, the four largest ones, by words of at most K impacts: some seconds each
    #[arg(long, value_name = "K", value_parser = whole(1..=MOST_DEPTH))]
    horseshoes: Option<u32>,
    /// Requested width of periodic orbits, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W [default: that of
    /// the scene, or 9]
    #[arg(long, value_name = "D", value_parser = digits())]
    digits: Option<u32>,
    /// Output format; json is schema impact-pair/global/1 [default: by the extension of --output, else table]
    #[arg(long, value_enum)]
    format: Option<GlobalFormat>,
    #[command(flatten)]
    drawing: Drawing,
}

/// Output formats of a global analysis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum GlobalFormat {
    /// Human-readable
    #[default]
    Table,
    /// One document of the schema named above
    Json,
    /// The graph of components in GraphML
    Graphml,
    /// The same in the language of Graphviz
    Dot,
}

pub fn global(arguments: &GlobalArguments) -> Result<Answer> {
    let format = arguments.drawing.format(arguments.format)?;
    let OpenOutput { scene, files, path } = arguments.drawing.begin(&arguments.scene)?;
    let named = || scene::name(path);
    let has_basins = arguments.basins || arguments.drawing.plot.is_some();
    let usual = GlobalSettings {
        basins: has_basins.then_some(GlobalSettings::USUAL_BASINS),
        horseshoes: arguments.horseshoes.map(|depth| depth as usize),
        ..GlobalSettings::default()
    };
    let mut settings = usual.with_effort(arguments.effort);
    settings.precision.digits = arguments.digits.or(scene.run().digits).unwrap_or(settings.precision.digits);
    let progress = Progress::stages(!files.quiet);
    let found = Global::of(scene.pair(), &settings, &progress).with_context(named)?;
    progress.clear();
    let document = found.document(&scene, &settings).with_context(named)?;
    let text = match format {
        GlobalFormat::Table => table(&scene, &found, &document)?,
        GlobalFormat::Json => serde_json::to_string(&document)? + "\n",
        GlobalFormat::Graphml => graph(&scene, &found).graphml()?,
        GlobalFormat::Dot => graph(&scene, &found).dot()?,
    };
    let open = (!document.certified).then(|| conclusion(&document));
    files.draw((&text, open, format == GlobalFormat::Table), || {
        Some(impact_pair_plot::global::global(&scene, &found, &document, &arguments.drawing.look))
    })
}

/// The components, and which of them motions may go from and to.
fn graph<'f>(scene: &Scene, found: &'f Global) -> Graph<'f> {
    let node = |own: &Recurrence| {
        vec![Value::Word(own.kind.kind().to_string()), Value::Number(own.boxes as i64), Value::of(own.is_closed)]
    };
    Graph {
        title: format!("components that motions may stay in; {}", scene.pair().in_words()),
        keys: &[("kind", "string"), ("boxes", "long"), ("closed", "long")],
        nodes: found.components.iter().map(node).collect(),
        edges: Box::new(found.order.iter().map(|&[from, to]| (from, None, to))),
    }
}

fn table(scene: &Scene, found: &Global, document: &GlobalDocument) -> Result<String, fmt::Error> {
    let mut out = pair_heading(scene);
    writeln!(
        out,
        "\n   {:10}  {:>8}  {:>22}  {:>6}  {:>8}  closed",
        "kind", "period", "spectral radius", "boxes", "area"
    )?;
    for (i, component) in found.components.iter().enumerate() {
        writeln!(out, "{}", row(i + 1, component))?;
    }
    let known = found.components.iter().enumerate().filter_map(|(i, component)| Some((i, component.kind.limit()?)));
    for (i, limit) in known {
        let word = limit.problem.word();
        writeln!(out, "{}: {} of the reduced map, {word}", i + 1, counted(limit.impacts as u32, "impact"))?;
    }
    for (i, reason) in found.components.iter().enumerate().filter_map(|(i, own)| Some((i, own.reason?))) {
        writeln!(out, "{}: not refined further: {}", i + 1, limit(reason))?;
    }
    if !document.order.is_empty() {
        let pairs: Vec<String> = document.order.iter().map(|[i, j]| format!("{} to {}", i + 1, j + 1)).collect();
        writeln!(out, "motions may go from {}", pairs.join(", "))?;
    }
    if let Some(basins) = &document.basins {
        let own = basins.areas.iter().map(|basin| format!("{} of {}", basin.area.text(), basin.component + 1));
        let all = own.collect::<Vec<_>>().join(", ");
        writeln!(out, "basins, parts of the state space, at least: {all}; undecided {}", basins.undecided.text())?;
    }
    writeln!(out, "\n{}", conclusion(document))?;
    Ok(out)
}

/// The limit that leaves a component undecided.
fn limit(reason: OpenReason) -> &'static str {
    match reason {
        OpenReason::Most => "as many boxes are mapped as --effort allows",
        OpenReason::Halvings => "its boxes are halved as often as they can be",
        OpenReason::Work => "its images take more than --effort leaves for them",
        OpenReason::Interrupted => "interrupted",
    }
}

/// Returns the line of a component.
fn row(number: usize, Recurrence { kind, boxes, area, is_closed, .. }: &Recurrence) -> String {
    let cycles = match kind {
        Kind::RestCycle(rest) => rest.map(|rest| rest.cycles),
        kind => kind.limit().map(|limit| limit.problem.chain().cycles()),
    };
    let period = cycles.map_or(String::new(), |cycles| counted(cycles, "cycle"));
    let radius = kind.limit().map_or(String::new(), |limit| decimal_digits(&limit.spectral_radius));
    let (name, closed) = (kind.kind(), if *is_closed { "yes" } else { "no" });
    format!("{number:<2} {name:10}  {period:>8}  {radius:>22}  {boxes:>6}  {area:>8.6}  {closed}")
}

/// Returns the last line: where all motions end.
fn conclusion(document: &GlobalDocument) -> String {
    let prefix = match (document.interrupted, document.certified) {
        (true, _) => "interrupted: ",
        (_, true) => "certified: ",
        _ if document.class == Class::Undecided => "",
        _ => "proved in part: ",
    };
    format!("{prefix}{}", document.statement)
}
