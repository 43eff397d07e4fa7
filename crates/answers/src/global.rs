//! `global`: where every motion goes, proved.

use std::fmt::{self, Write};

use anyhow::Result;
use clap::Args;
use impact_pair::chaos::{Class, Global, GlobalSettings, Kind, MOST_DEPTH, OpenReason, Recurrence};
use impact_pair::exact::decimal_digits;
use impact_pair::json::{GlobalDocument, counted};
use impact_pair::watch::Watch;
use impact_pair::{Effort, Scene};

use crate::graph::{Graph, Value};
use crate::values::{digits, whole};
use crate::{Answer, Asked, Failure, Format, Picture, Status, Verb, line, pair_heading};

/// Options of `global`.
#[derive(Args, Clone, Debug)]
pub struct GlobalOptions {
    /// Multiply the work by X: at 1 about 300,000 boxes are mapped in all, from a partition into 16,384, those of the smallest undecided
    /// component first
    #[arg(long, value_name = "X", default_value_t)]
    pub effort: Effort,
    /// Prove basins of attraction, by about 65,536 boxes times --effort [with --plot they are]
    #[arg(long)]
    pub basins: bool,
    /// Look for a horseshoe in undecided components, the four largest ones, by words of at most K impacts: some seconds each
    #[arg(long, value_name = "K", value_parser = whole(1..=MOST_DEPTH))]
    pub horseshoes: Option<u32>,
    /// Requested width of periodic orbits, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W [default: that of
    /// the scene, or 9]
    #[arg(long, value_name = "D", value_parser = digits())]
    pub digits: Option<u32>,
}

/// Where every motion goes, and the document.
pub struct Analysis<'s> {
    scene: &'s Scene,
    found: Global,
    document: GlobalDocument,
}

impl Verb for GlobalOptions {
    const NAME: &'static str = "global";
    const FORMATS: &'static [(Format, &'static str)] = &[
        (Format::Table, "Human-readable"),
        (Format::Json, "One document of the schema named above"),
        (Format::Graphml, "The graph of components in GraphML"),
        (Format::Dot, "The same in the language of Graphviz"),
    ];
    const SCHEMA: &'static str = "impact-pair/global/1";
    const PICTURE: &'static str = "Draw the state space by the limits of its motions, and the graph of components";
    type Answer<'s> = Analysis<'s>;

    fn answer<'s>(
        &self,
        Asked { scene, is_drawn, .. }: &Asked<'s>,
        watch: &dyn Watch,
    ) -> Result<Analysis<'s>, Failure> {
        let has_basins = self.basins || *is_drawn;
        let usual = GlobalSettings {
            basins: has_basins.then_some(GlobalSettings::USUAL_BASINS),
            horseshoes: self.horseshoes.map(|depth| depth as usize),
            ..GlobalSettings::default()
        };
        let mut settings = usual.with_effort(self.effort);
        settings.precision.digits = self.digits.or(scene.run().digits).unwrap_or(settings.precision.digits);
        let found = Global::of(scene.pair(), &settings, watch)?;
        Ok(Analysis { document: found.document(scene, &settings)?, scene, found })
    }
}

impl Answer for Analysis<'_> {
    fn status(&self) -> Status {
        let GlobalDocument { interrupted, certified, class, statement, .. } = &self.document;
        let prefix = match (*interrupted, *certified) {
            (true, _) => "interrupted: ",
            (_, true) => "certified: ",
            _ if *class == Class::Undecided => "",
            _ => "proved in part: ",
        };
        Status::new(*certified, format!("{prefix}{statement}"))
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        Ok(Some(match format {
            Format::Json => line(&self.document)?,
            Format::Graphml | Format::Dot => graph(self.scene, &self.found).text(format)?,
            _ => table(self.scene, &self.found, &self.document, &self.status())?,
        }))
    }

    fn picture(&self) -> Option<Picture<'_>> {
        Some(Picture::Global(self.scene, &self.found, &self.document))
    }
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

fn table(scene: &Scene, found: &Global, document: &GlobalDocument, status: &Status) -> Result<String, fmt::Error> {
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
    writeln!(out, "\n{status}")?;
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
