//! `trap`: a trapping region, proved.

use std::fmt::{self, Write};

use anyhow::Result;
use clap::Args;
use impact_pair::chaos::{BoxGraph, MOST_COUNTED, NoTrap, Trap, WallWords};
use impact_pair::json::{TrapDocument, WallWordsDocument, counted};
use impact_pair::watch::Watch;
use impact_pair::{Effort, Error, Scene};

use crate::graph::{Graph, Value};
use crate::values::whole;
use crate::{Answer, Asked, Failure, Format, Picture, Status, Verb, heading, line};

/// Options of `trap`.
#[derive(Args, Clone, Debug)]
pub struct TrapOptions {
    /// Multiply the work by X, for narrower bounds: 2, 4, .., 64 bisect the boxes of the coarsest forward-invariant grid once, twice, .., 6 times
    #[arg(long, value_name = "X", default_value_t)]
    pub effort: Effort,
    /// Count the words of N walls that the motions in the region can make, and bound their entropy from above
    #[arg(long, value_name = "N", value_parser = whole(1..=MOST_COUNTED))]
    pub words: Option<u32>,
}

/// A region, or the reason why none is proved.
pub struct Trapped<'s> {
    scene: &'s Scene,
    region: Result<Region, NoTrap>,
}

/// A region, its document, its graph and its words.
struct Region {
    trap: Trap,
    document: TrapDocument,
    words: Option<WallWords>,
    /// The reason why the words are not counted, if they are requested.
    uncounted: Option<&'static str>,
}

impl Verb for TrapOptions {
    const NAME: &'static str = "trap";
    const FORMATS: &'static [(Format, &'static str)] = &[
        (Format::Table, "Human-readable"),
        (Format::Json, "One document of the schema named above"),
        (Format::Graphml, "The graph of boxes, or of words, in GraphML"),
        (Format::Dot, "The same in the language of Graphviz"),
    ];
    const SCHEMA: &'static str = "impact-pair/trap/1";
    const PICTURE: &'static str = "Draw the region, and a floating-point orbit in it";
    type Answer<'s> = Trapped<'s>;

    fn answer<'s>(&self, Asked { scene, .. }: &Asked<'s>, watch: &dyn Watch) -> Result<Trapped<'s>, Failure> {
        let trap = match Trap::of(scene, self.effort, watch)? {
            Ok(trap) => trap,
            Err(why) => return Ok(Trapped { scene, region: Err(why) }),
        };
        let mut document = trap.document(scene)?;
        let graph =
            self.words.map(|impacts| Ok::<_, Error>((impacts, BoxGraph::of(scene.pair(), &trap)?))).transpose()?;
        let counted = graph.map(|(impacts, graph)| WallWords::of(&graph, impacts, watch)).transpose();
        let uncounted = counted.as_ref().err().map(|why| why.words());
        let words = counted.ok().flatten();
        document.words = words.as_ref().map(WallWordsDocument::from);
        Ok(Trapped { scene, region: Ok(Region { trap, document, words, uncounted }) })
    }
}

impl Answer for Trapped<'_> {
    fn status(&self) -> Status {
        match &self.region {
            Ok(region) => {
                let mut open = region.missing();
                open.extend(region.document.entered_at_impact.is_none().then(|| entered(&region.document)));
                match open.is_empty() {
                    true => Status::new(true, format!("certified: a trapping region; {}", entered(&region.document))),
                    false => Status::new(false, open.join("; ")),
                }
            }
            Err(why) => Status::new(false, format!("undecided: no region is proved; {}", why.words())),
        }
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        Ok(match (&self.region, format) {
            (Err(_), Format::Table) => Some(format!("{}\n", self.status())),
            (Ok(region), Format::Table) => Some(region.table(self.scene)?),
            (Ok(region), Format::Json) => Some(line(&region.document)?),
            (Err(_), _) => None,
            // The words are requested, and not counted.
            (Ok(Region { uncounted: Some(_), .. }), _) => None,
            (Ok(region), format) => Some(region.graph(self.scene, format)?),
        })
    }

    fn picture(&self) -> Option<Picture<'_>> {
        Some(Picture::Trap(self.scene, &self.region.as_ref().ok()?.trap))
    }
}

impl Region {
    /// What is requested of the region and not proved.
    fn missing(&self) -> Vec<String> {
        let uncounted = self.uncounted.map(|why| format!("undecided: the words are not counted; {why}"));
        self.trap.coarser().map(not_finer).into_iter().chain(uncounted).collect()
    }

    fn table(&self, scene: &Scene) -> Result<String, fmt::Error> {
        let mut out = heading(scene);
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
        for why in self.missing() {
            writeln!(out, "{why};")?;
        }
        writeln!(out, "{}", entered(document))?;
        Ok(out)
    }

    /// The graph that is written: of words if they are counted, else of boxes.
    fn graph(&self, scene: &Scene, format: Format) -> Result<String> {
        let (pair, TrapDocument { columns, rows, .. }) = (scene.pair(), &self.document);
        let keys = &[("column", "long"), ("row", "long")];
        let lettered = |(from, letter, to): (usize, char, usize)| (from, Some(letter), to);
        if let Some(words) = &self.words {
            let nodes = (0..words.sets()).map(|_| Vec::new()).collect();
            let title = format!("words of walls, from node 0 on; {}", pair.in_words());
            return Ok(Graph { title, keys, nodes, edges: Box::new(words.edges().map(lettered)) }.text(format)?);
        }
        let graph = BoxGraph::of(pair, &self.trap)?;
        let words = pair.in_words();
        let title = format!("boxes, {columns} columns per forcing period, {rows} rows per speed A W; {words}");
        let nodes = graph.boxes().iter().map(|&(column, row)| [column, row].map(Value::of).into()).collect();
        Ok(Graph { title, keys, nodes, edges: Box::new(graph.edges().map(lettered)) }.text(format)?)
    }
}

/// That the region is not as fine as requested.
pub(crate) fn not_finer(why: NoTrap) -> String {
    format!("undecided: no finer region is proved, this one is of the coarsest grid; {}", why.words())
}

/// From which impact on the scene's own orbit lies in the region, if that is proved.
fn entered(document: &TrapDocument) -> String {
    match document.entered_at_impact {
        Some(0) => "the scene's start and all impacts after it are in it".to_owned(),
        Some(impact) => format!("the scene's orbit is in it from impact {impact} on"),
        None => "undecided whether the scene's orbit enters it: none of its first 100 impacts is proved to lie in it"
            .to_owned(),
    }
}
