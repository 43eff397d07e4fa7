//! `bifurcations`: folds, pitchforks, period doublings and grazes of a word's orbits over a parameter, proved.

use std::fmt::Write;
use std::slice;

use anyhow::Result;
use clap::Args;
use impact_pair::Scene;
use impact_pair::exact::decimal_digits;
use impact_pair::json::counted;
use impact_pair::mapping::Word;
use impact_pair::periodic::bifurcation::{BranchEnd, Diagram, DiagramSettings, Kind, over, survey};
use impact_pair::periodic::chain::MOST_CYCLES;
use impact_pair::scene::{Key, Over};
use impact_pair::watch::Watch;

use crate::values::{PrecisionArguments, whole};
use crate::{
    Answer, Asked, Counts, Failure, Format, Status, Step, TABLE_OR_JSON, Verb, heading, line, physical, symmetric,
};

/// Options of `bifurcations`.
#[derive(Args, Clone, Debug)]
#[command(mut_arg("digits", |digits| digits.help("Requested width of enclosures, at most 10^-D: of the parameter relative to itself, of phases relative to 2 pi, of velocities relative to A W [default: that of the scene, or 9]")))]
pub struct BifurcationOptions {
    /// The word, a sequence of mappings, the first one right-most ("P2 P4 P1 P3"), or of walls in time order (RRLL)
    #[arg(long, value_name = "WORD")]
    pub word: Word,
    /// The number of forcing periods 2 pi/W that the orbit takes
    #[arg(long, value_name = "N", value_parser = whole(1..=MOST_CYCLES))]
    pub cycles: u32,
    /// The parameter and its range: amplitude (with several terms amplitude.K), gap, restitution, frequency, or A/d, the
    /// amplitude in gaps
    #[arg(long, value_name = "KEY=LO..HI", value_parser = over, allow_hyphen_values = true)]
    pub over: Over,
    /// Number of period doublings after which new branches are not followed further
    #[arg(long, value_name = "K", default_value_t = 4, value_parser = whole(0..=8))]
    pub doublings: u32,
    /// Width of the enclosures.
    #[command(flatten)]
    pub precision: PrecisionArguments,
}

/// The proved bifurcations, and the branches that were followed.
pub struct Bifurcations<'s> {
    scene: &'s Scene,
    word: Word,
    cycles: u32,
    diagram: Diagram,
}

impl Verb for BifurcationOptions {
    const NAME: &'static str = "bifurcations";
    const FORMATS: &'static [(Format, &'static str)] = TABLE_OR_JSON;
    const SCHEMA: &'static str = "impact-pair/bifurcations/1";
    type Answer<'s> = Bifurcations<'s>;

    fn counts(&self, _: &Scene) -> Counts {
        Counts::Nothing("following branches")
    }

    fn answer<'s>(&self, Asked { scene, .. }: &Asked<'s>, watch: &dyn Watch) -> Result<Bifurcations<'s>, Failure> {
        let Self { word, cycles, over, doublings, precision } = self;
        let over = over.of(scene.pair())?;
        let settings = DiagramSettings { over: over.clone(), doublings: *doublings, precision: precision.of(scene) };
        let diagram = survey(scene.pair(), scene.start(), (word, *cycles), &settings, watch);
        Ok(Bifurcations {
            scene,
            word: word.clone(),
            cycles: *cycles,
            diagram: diagram.map_err(Failure::over(slice::from_ref(&over)))?,
        })
    }
}

impl Answer for Bifurcations<'_> {
    fn status(&self) -> Status {
        let diagram = &self.diagram;
        let is_certified = diagram.is_certified();
        let status = |words: String| Status::new(is_certified, words);
        if matches!(diagram.over().key(), Key::Frequency(_)) {
            let why = "nothing bifurcates over the frequency: only A/d and e matter, W is the unit of time";
            return status(format!("certified: {why}"));
        }
        let points = format!("{} proved", counted(diagram.points.len(), "bifurcation"));
        if diagram.interrupted {
            let rest = "some branches were not followed, or not to their ends";
            return status(format!("interrupted: {points} so far; {rest}"));
        }
        if diagram.points.is_empty() && is_certified {
            let how = "branches are found and followed in floating point";
            return status(format!("no bifurcation found, none excluded ({how})"));
        }
        let said = if is_certified { "certified" } else { "undecided" };
        let others = "others are not excluded (branches are found and followed in floating point)";
        let status = status(format!("{said}: {points}; {others}"));
        let is_lost = diagram.branches.iter().any(|branch| branch.ends.contains(&BranchEnd::Lost));
        let is_wide = diagram.points.iter().any(|point| !(point.is_narrow && point.is_decided()));
        let (narrower, more) = (Step::Narrower("over"), Step::More("max-bits"));
        // Of a change of sign that is not proved, nothing is known to help.
        match (is_lost, is_wide) {
            (true, true) => status.say("; try ").step(narrower).say(", or ").step(more),
            (true, false) => status.say("; try ").step(narrower),
            (false, true) => status.say("; try ").step(more),
            (false, false) => status,
        }
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        let Self { scene, word, cycles, diagram } = self;
        Ok(Some(match format {
            Format::Json => line(&diagram.document(scene.start(), (word, *cycles))?)?,
            _ => self.table()?,
        }))
    }
}

impl Bifurcations<'_> {
    fn table(&self) -> Result<String> {
        let Self { scene, diagram, .. } = self;
        let mut out = heading(scene);
        let (key, low, high) = (diagram.over().key(), diagram.over().low(), diagram.over().high());
        writeln!(out, "over {} from {low} to {high}\n", key.place())?;
        if !diagram.points.is_empty() {
            writeln!(out, "{:16} {:>7} {:>6}  {:36} orbit", "kind", "impacts", "cycles", key.place())?;
        }
        for point in &diagram.points {
            let (parameter, _) = diagram.in_units(point)?;
            let mut proved = symmetric(point.symmetric).to_owned();
            if point.kind != Kind::Graze {
                proved += ", ";
                proved += physical(point.orbit.as_ref().and_then(|orbit| orbit.physical));
            }
            let (kind, impacts) = (point.kind, point.impacts.len());
            let digits = decimal_digits(&parameter);
            writeln!(out, "{kind:16} {impacts:7} {:6}  {digits:36} {proved}", point.cycles)?;
        }
        for branch in &diagram.branches {
            let symmetric = if branch.symmetric { ", symmetric" } else { "" };
            let [low, high] = diagram.range_f64(branch.range);
            let [a, b] = branch.ends.map(end);
            let impacts = branch.word.mappings().len();
            let proved = if branch.is_proved { ", one proved curve" } else { "" };
            let cycles = branch.cycles;
            writeln!(
                out,
                "followed: {impacts} impacts in {cycles}{symmetric}, {low:.4} to {high:.4}{proved}; ends: {a}, {b}"
            )?;
        }
        for unproved in &diagram.unproved {
            let [near, _] = diagram.range_f64([unproved.near; 2]);
            let (kind, impacts) = (unproved.kind, unproved.word.mappings().len());
            writeln!(out, "undecided: {kind} of {impacts} impacts near {near:.9}")?;
        }
        writeln!(out, "\n{}", self.status())?;
        Ok(out)
    }
}

/// The reason why a branch ends, in words.
fn end(end: BranchEnd) -> String {
    match end {
        BranchEnd::Range => "the range".to_owned(),
        BranchEnd::Closed => "none, it closes".to_owned(),
        other => other.to_string(),
    }
}
