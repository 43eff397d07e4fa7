//! `impact-pair tangency SCENE`: homoclinic tangencies of the equispaced motion over a parameter, proved.

use std::fmt::{self, Write};
use std::path::PathBuf;

use anyhow::{Error, Result, bail};
use clap::Args;
use impact_pair::exact::{decimal_bounds, decimal_digits};
use impact_pair::json::counted;
use impact_pair::scene::{Key, Over, Range};
use impact_pair::tangency::{
    Beside, FlightWord, TANGENCY_PARAMETERS, Tangencies, Tangency, TangencySettings, UnprovedTangency, at_least,
    is_tangency_range,
};
use impact_pair::{Effort, Scene};

use crate::Answer;
use crate::destination::{Drawing, OpenOutput};
use crate::periodic::PeriodicFormat;
use crate::progress::Progress;
use crate::scene;
use impact_pair_answers::heading;
use impact_pair_answers::values::{PrecisionArguments, count};

pub const HELP: &str = "\
Examples:
  impact-pair tangency scenes/figure-14.toml --over gap=9.425..9.426 --word FFFFFFFNFFFFFNFFNFFNFFFF
  impact-pair tangency scenes/figure-14.toml --over gap=9.4245..9.4252 --longest 18

The equispaced motion (66), (67) of half a forcing period between impacts is a fixed point of the reduced map, which \
mirrors every impact to the left wall. Where it is a saddle, floating point searches for folds of its unstable \
manifold near its stable one, along the flights of --word or along all words of at most --longest flights: F is a \
flight to the far wall, N one back to the near wall. Each tangency listed is proved: for exactly one value of the \
parameter within its bounds the two invariant manifolds have a common point along these flights, with sigma_u and sigma_s \
within their bounds, at which they are tangent; the tangency is quadratic (q is not 0); it unfolds with a speed other \
than 0 (m is not 0); each flight of the orbit ends at its first contact. The product of the eigenvalues is e^2: the \
saddle is dissipative. Other tangencies are not excluded, and the scene's own value of the parameter is not \
examined. One harmonic only.

On either side of a tangency two ranges of the parameter are listed where they are proved: for each value of the first, the invariant \
manifolds have exactly two common points along these flights, for each value of the second none, with sigma_u, sigma_s \
and all states between both points in the boxes of the JSON.

The coefficient of restitution may be an interval, with --over restitution gap and amplitude may: for each value in it there is \
exactly one tangency whose parameter, sigma_u, sigma_s and states are in the bounds of the JSON, all bounds hold for each, and \
--digits is not used.

Where sigma_u or sigma_s is not small, flights of the invariant manifolds are added to the word at that end: the orbit is the \
same.

Exit code: 0 there are tangencies, and all folds that were tried are proved to lead to one; 1 some are not, there is \
none, the search ended at the limit of its work, or the run was interrupted (the proved part is written); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("digits", |digits| digits.help("Requested width of enclosures, at most 10^-D: of d/A or e, and of the parameters of the invariant manifolds [default: that of the scene, or 9]")))]
#[command(mut_arg("plot", |plot| plot.help("Draw the nearest tangency: both invariant manifolds in the section, and the point of tangency 1,000 times as large, at its value and 1e-4 to either side")))]
pub struct TangencyArguments {
    /// Scene file (TOML), or - for stdin
    scene: PathBuf,
    /// The parameter and its range: gap, amplitude, restitution, or A/d, the amplitude in gaps [default: the gap, from 0.9999 to 1.0001 times that of
    /// the scene]
    #[arg(long, value_name = "KEY=LO..HI", value_parser = over)]
    over: Option<Over>,
    /// The flights from the unstable manifold to the stable one in time order: F to the far wall, N back to the near one
    /// [default: all words are searched]
    #[arg(long, value_name = "FLIGHTS")]
    word: Option<FlightWord>,
    /// Maximum number of flights that are searched without --word
    #[arg(long, value_name = "N", default_value_t = 18, value_parser = count(1..=40))]
    longest: u64,
    /// Maximum number of tangencies that are proved, the nearest ones
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = count(1..=100_000))]
    most: u64,
    /// Multiply the work by X: the search without --word takes about 30 million flights in floating point for each saddle, and as much again to
    /// follow folds, 10,000 flights each
    #[arg(long, value_name = "X", default_value_t)]
    effort: Effort,
    #[command(flatten)]
    precision: PrecisionArguments,
    /// Output format; json is schema impact-pair/tangency/1 [default: by the extension of --output, else table]
    #[arg(long, value_enum)]
    format: Option<PeriodicFormat>,
    #[command(flatten)]
    drawing: Drawing,
}

/// Reads `KEY=LO..HI` of a parameter over which tangencies are searched.
fn over(text: &str) -> Result<Over, impact_pair::Error> {
    Over::parse(text, &format!("KEY=LO..HI with LO < HI, {TANGENCY_PARAMETERS}"), is_tangency_range)
}

/// Returns the range of gaps next to that of a scene.
fn beside(scene: &Scene) -> Result<Range> {
    let gap = scene.pair().gap();
    if !gap.is_point() {
        bail!("--over is missing, but pair.gap is the interval {gap}: accepted is the range of one parameter");
    }
    let [low, high] = ["0.9999", "1.0001"].map(|part| Ok::<_, Error>(gap.checked_mul(&part.parse()?)?));
    Ok(Range::new(Key::Gap, low?, high?, None)?)
}

pub fn tangency(arguments: &TangencyArguments) -> Result<Answer> {
    let format = arguments.drawing.format(arguments.format)?;
    let OpenOutput { scene, files, path } = arguments.drawing.begin(&arguments.scene)?;
    let settings = TangencySettings {
        over: match &arguments.over {
            Some(over) => over.of(scene.pair()).map_err(|error| scene::about(error, &[], path))?,
            None => beside(&scene)?,
        },
        word: arguments.word.clone(),
        longest: usize::try_from(arguments.longest)?,
        most: usize::try_from(arguments.most)?,
        effort: arguments.effort,
        precision: arguments.precision.of(&scene),
    };
    let progress = Progress::stages(!files.quiet);
    let range = [(settings.over.key(), settings.over.to_string())];
    let found = Tangencies::of(&scene, &settings, &progress).map_err(|error| scene::about(error, &range, path))?;
    progress.clear();
    let text = match format {
        PeriodicFormat::Table => table(&scene, &found)?,
        PeriodicFormat::Json => serde_json::to_string(&found.document(&scene))? + "\n",
    };
    let open = (!found.is_certified()).then(|| conclusion(&found));
    let is_table = format == PeriodicFormat::Table;
    files.draw((&text, open, is_table), || {
        Some(impact_pair_plot::tangency::tangency(&scene, &found, &arguments.drawing.look))
    })
}

fn table(scene: &Scene, found: &Tangencies) -> Result<String, fmt::Error> {
    let mut out = heading(scene);
    let (key, low, high) = (found.over.key(), found.over.low(), found.over.high());
    writeln!(out, "over {} from {low} to {high}\n", key.place())?;
    for tangency in &found.tangencies {
        rows(&mut out, key, tangency)?;
    }
    for UnprovedTangency { near, flights } in &found.unproved {
        writeln!(out, "undecided: near {near:.12}, {flights}: {}", UnprovedTangency::REASON)?;
    }
    writeln!(out, "\n{}", conclusion(found))?;
    Ok(out)
}

fn rows(out: &mut String, key: Key, found: &Tangency) -> fmt::Result {
    let count = counted(found.flights.len() as u32, "flight");
    writeln!(out, "{} = {}: quadratic tangency, {count}", key.place(), decimal_digits(&found.parameter))?;
    writeln!(out, "  from P_u(sigma_u) to P_s(sigma_s): {}", found.flights)?;
    let [unstable, stable] = found.eigenvalues.each_ref().map(decimal_digits);
    writeln!(out, "  saddle: phase {} rad, speed {} A W", decimal_digits(&found.phase), decimal_digits(&found.speed))?;
    writeln!(out, "  eigenvalues {unstable} and {stable}; no resonance up to order {}", found.resonances_excluded_to)?;
    writeln!(out, "  sigma_u = {}", decimal_digits(&found.unstable))?;
    writeln!(out, "  sigma_s = {}", decimal_digits(&found.stable))?;
    let unit = if key == Key::Restitution { "e" } else { "d/A" };
    let [quadratic, unfolding] = [&found.quadratic, &found.unfolding].map(decimal_digits);
    writeln!(out, "  q = {quadratic}, m = {unfolding} per unit of {unit}")?;
    if found.states.is_some() {
        writeln!(out, "  exactly one for each value of the scene's interval, the states in the bounds of the JSON")?;
    }
    if let Some(Beside { two, none, .. }) = &found.beside {
        let [two, none] = [two, none].map(|range| decimal_bounds(range).join(" to "));
        writeln!(out, "  two common points for {two}, none for {none}: in the boxes of the JSON")?;
    }
    let [speed, flight] = [found.least_speed, found.least_flight].map(at_least);
    writeln!(out, "  speeds at least {} A W, flights at least {} rad", speed.text(), flight.text())
}

/// Returns the last line of the table: whether everything requested is proved.
fn conclusion(found: &Tangencies) -> String {
    let proved = match found.tangencies.len() {
        1 => "1 homoclinic tangency".to_owned(),
        count => format!("{count} homoclinic tangencies"),
    };
    if found.interrupted {
        return format!("interrupted: {proved} proved so far");
    }
    if found.is_certified() {
        return format!("certified: {proved}; others are not excluded");
    }
    if found.limited {
        return format!(
            "undecided: {proved} proved; the search ended at the limit of its work: try a --word, a smaller --longest or more --effort"
        );
    }
    format!("undecided: {proved} proved; try another --word, a larger --longest or a wider --over")
}
