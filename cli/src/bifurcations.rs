//! `impact-pair bifurcations SCENE --word WORD --cycles N --over KEY=LO..HI`: folds, pitchforks, doublings, grazes, proved.

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use impact_pair::Scene;
use impact_pair::exact::decimal_digits;
use impact_pair::json::counted;
use impact_pair::mapping::Word;
use impact_pair::periodic::bifurcation::{Diagram, DiagramSettings, End, Kind, over, survey};
use impact_pair::periodic::chain::MOST_CYCLES;
use impact_pair::scene::{Key, Range};

use crate::Answer;
use crate::destination::{Destination, OpenOutput};
use crate::heading::heading;
use crate::periodic::{PeriodicFormat, physical, symmetric};
use crate::progress::Progress;
use crate::scene;
use crate::values::{PrecisionArguments, whole};

pub const HELP: &str = "\
Examples:
  impact-pair bifurcations scenes/cascade.toml --word RL --cycles 1 --over amplitude=0.3..0.499
  impact-pair bifurcations scenes/cascade.toml --word RL --cycles 1 --over gap=1.02..1.1
  impact-pair bifurcations scenes/square-wave.toml --word RL --cycles 5 --over amplitude.2=0..2

Orbits of the word are searched for at values spread over the range. Their branches are followed through folds, and \
so are the branches that leave at pitchforks and period doublings: the cascade. Each point listed is proved: exactly \
one such bifurcation lies within its bounds. Other bifurcations are not excluded. Only A/d and e matter: over \
frequency there are no bifurcations.

With several harmonics, --over amplitude.K=... varies the amplitude of term K, counted from 1. The frequencies must \
be commensurate, and N must be a whole number of common periods, counted in periods of the fastest harmonic. \
Pitchforks exist only if each harmonic changes sign over half the common period.

Exit code: 0 every change that was found is proved to the requested width; 1 some are not, a branch was lost, or the \
run was interrupted (the output still has the certified part); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("digits", |digits| digits.help("Requested width of enclosures, at most 10^-D: of the parameter relative to itself, of phases relative to 2 pi, of velocities relative to A W [default: that of the scene, or 9]")))]
pub struct BifurcationArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// The word, a sequence of mappings, the first one right-most ("P2 P4 P1 P3"), or of walls in time order (RRLL)
    #[arg(long, value_name = "WORD")]
    pub word: Word,
    /// The number of forcing periods 2 pi/W that the orbit takes
    #[arg(long, value_name = "N", value_parser = whole(1..=MOST_CYCLES))]
    pub cycles: u32,
    /// The parameter and its range: amplitude (with several terms amplitude.K), gap, restitution or frequency
    #[arg(long, value_name = "KEY=LO..HI", value_parser = over, allow_hyphen_values = true)]
    over: Range,
    /// Number of period doublings after which new branches are not followed further
    #[arg(long, value_name = "K", default_value_t = 4, value_parser = whole(0..=8))]
    doublings: u32,
    #[command(flatten)]
    precision: PrecisionArguments,
    /// Output format; json is schema impact-pair/bifurcations/1 [default: by the extension of --output
    /// says, else table]
    #[arg(long, value_enum)]
    pub format: Option<PeriodicFormat>,
    #[command(flatten)]
    pub destination: Destination,
}

impl BifurcationArguments {
    /// Returns the settings of the diagram.
    pub fn diagram_settings(&self, scene: &Scene) -> DiagramSettings {
        let precision = self.precision.of(scene);
        DiagramSettings { over: self.over.clone(), doublings: self.doublings, precision }
    }
}

pub fn bifurcations(arguments: &BifurcationArguments) -> Result<Answer> {
    let format = arguments.destination.format(arguments.format)?;
    let OpenOutput { scene, files, path } = arguments.destination.begin(&arguments.scene, None)?;
    let named = || scene::name(path);
    let diagram_settings = arguments.diagram_settings(&scene);
    let (word, cycles) = (&arguments.word, arguments.cycles);
    let progress = Progress::of("following branches", !files.quiet);
    let diagram = survey(scene.pair(), scene.start(), (word, cycles), &diagram_settings, &progress);
    let range = [(diagram_settings.over.key(), diagram_settings.over.to_string())];
    let diagram = diagram.map_err(|error| scene::about(error, &range, path))?;
    progress.clear();
    let text = match format {
        PeriodicFormat::Table => table(&scene, &diagram)?,
        PeriodicFormat::Json => {
            let document = diagram.document(scene.start(), (word, cycles)).with_context(named)?;
            serde_json::to_string(&document)? + "\n"
        }
    };
    let open = (!diagram.is_certified()).then(|| conclusion(&diagram));
    files.answer(&text, open, format == PeriodicFormat::Table)
}

fn table(scene: &Scene, diagram: &Diagram) -> Result<String> {
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
        let (kind, impacts) = (point.kind.name(), point.impacts.len());
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
        writeln!(
            out,
            "undecided: {} of {} impacts near {near:.9}",
            unproved.kind.name(),
            unproved.word.mappings().len()
        )?;
    }
    writeln!(out, "\n{}", conclusion(diagram))?;
    Ok(out)
}

/// Returns the reason why a branch ends, in words.
fn end(end: End) -> &'static str {
    match end {
        End::Range => "the range",
        End::At(kind) => kind.name(),
        End::Closed => "none, it closes",
        End::Lost => "lost",
        End::Interrupted => "interrupted",
    }
}

/// The last line: how much of what was asked is proved.
fn conclusion(diagram: &Diagram) -> String {
    if matches!(diagram.over().key(), Key::Frequency(_)) {
        return "certified: nothing bifurcates over the frequency: only A/d and e matter, W is the unit of time".into();
    }
    let points = format!("{} proved", counted(diagram.points.len(), "bifurcation"));
    if diagram.interrupted {
        return format!("interrupted: {points} so far; some branches were not followed, or not to their ends");
    }
    if diagram.points.is_empty() && diagram.is_certified() {
        return "no bifurcation found, none excluded (branches are found and followed in floating point)".into();
    }
    let certified = if diagram.is_certified() { "certified: " } else { "undecided: " };
    let is_lost = diagram.branches.iter().any(|branch| branch.ends.contains(&End::Lost));
    let is_wide = diagram.points.iter().any(|point| !(point.is_narrow && point.is_decided()));
    // Of a change of sign that is not proved, nothing is known to help.
    let hint = match (is_lost, is_wide) {
        (true, true) => "; try a narrower --over, or more --max-bits",
        (true, false) => "; try a narrower --over",
        (false, true) => "; try more --max-bits",
        (false, false) => "",
    };
    format!("{certified}{points}; others are not excluded (branches are found and followed in floating point){hint}")
}
