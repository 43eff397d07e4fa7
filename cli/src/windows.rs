//! `impact-pair windows SCENE --over KEY=LO..HI`: stable periodic orbits near a scene and the windows in which they are stable, proved.

use std::fmt::{self, Write};
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use impact_pair::chaos::{
    FoundWindow, MOST_WINDOW_IMPACTS, WINDOW_PARAMETERS, WindowSettings, Windows, is_window_range,
};
use impact_pair::exact::decimal_digits;
use impact_pair::json::counted;
use impact_pair::periodic::bifurcation::WindowEnd;
use impact_pair::scene::Over;
use impact_pair::{Effort, Scene};

use crate::Answer;
use crate::destination::{Drawing, OpenOutput};
use crate::periodic::PeriodicFormat;
use crate::progress::Progress;
use crate::scene;
use impact_pair_answers::values::{PrecisionArguments, count};
use impact_pair_answers::{heading, physical, symmetric};

pub const HELP: &str = "\
Examples:
  impact-pair windows scenes/figure-14.toml --over gap=9.4247..9.4253 --impacts 4000000
  impact-pair windows scenes/figure-14.toml --over restitution=0.4999..0.5001 --impacts 2000000

Floating-point orbits of the reduced map, which mirrors every impact to the left wall, are searched for stable \
periodic orbits: half of them at the scene's own value of the parameter, the others at values of the range. Each \
orbit listed is proved at an exact value of the parameter: it exists, it is the only one within its bounds, and it is \
stable. Its window extends from a fold to a period doubling or a pitchfork, and both ends are enclosed. Where `stable \
between` is proved, there is a stable, admissible orbit of the word for every value between the bounds of the ends, \
and one curve of them leads from end to end through the orbit listed. \
Other windows are not excluded; floating-point orbits that are not proved, most of them long, have no claim. \
Windows of the doubled orbits, which adjoin, are not listed. One harmonic only.

The nearest windows to the scene's own value come first. Of windows narrower than about 10^-15 of the value, which \
doubles do not resolve, few are found.

Exit code: 0 there are windows, and of each the orbit, both ends and the orbits between are proved; 1 some of that is \
not, or the run was interrupted (the proved part is written); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("digits", |digits| digits.help("Requested width of enclosures, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W; ends are enclosed to four more digits than the width of the window takes [default: that of the scene, or 9]")))]
#[command(mut_arg("plot", |plot| plot.help("Draw the windows: the width over the parameter, on a logarithmic scale")))]
pub struct WindowsArguments {
    /// Scene file (TOML), or - for stdin
    scene: PathBuf,
    /// The parameter and its range: gap, amplitude, restitution, or A/d, the amplitude in gaps
    #[arg(long, value_name = "KEY=LO..HI", value_parser = over)]
    over: Over,
    /// Number of impacts of floating-point orbits that are searched
    #[arg(long, value_name = "N", default_value_t = 40_000_000, value_parser = count(1..=1_000_000_000_000))]
    impacts: u64,
    /// Multiply the work by X: --impacts many times X are searched
    #[arg(long, value_name = "X", default_value_t)]
    effort: Effort,
    /// Maximum number of impacts of an orbit in the reduced map
    #[arg(long, value_name = "N", default_value_t = 44, value_parser = count(1..=MOST_WINDOW_IMPACTS as u64))]
    longest: u64,
    /// Maximum number of windows that are proved, the nearest ones
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = count(1..=100_000))]
    most: u64,
    #[command(flatten)]
    precision: PrecisionArguments,
    /// Output format; json is schema impact-pair/windows/1 [default: by the extension of --output, else table]
    #[arg(long, value_enum)]
    format: Option<PeriodicFormat>,
    #[command(flatten)]
    drawing: Drawing,
}

/// Reads `KEY=LO..HI` of a parameter over which windows are searched.
fn over(text: &str) -> Result<Over, impact_pair::Error> {
    Over::parse(text, &format!("KEY=LO..HI with LO < HI, {WINDOW_PARAMETERS}"), is_window_range)
}

pub fn windows(arguments: &WindowsArguments) -> Result<Answer> {
    let format = arguments.drawing.format(arguments.format)?;
    let OpenOutput { scene, files, path } = arguments.drawing.begin(&arguments.scene)?;
    let named = || scene::name(path);
    let settings = WindowSettings {
        over: arguments.over.of(scene.pair()).map_err(|error| scene::about(error, &[], path))?,
        impacts: arguments.effort.times(arguments.impacts),
        longest: arguments.longest as usize,
        most: usize::try_from(arguments.most)?,
        precision: arguments.precision.of(&scene),
    };
    let progress = Progress::stages(!files.quiet);
    let range = [(settings.over.key(), settings.over.to_string())];
    let found = Windows::of(&scene, &settings, &progress).map_err(|error| scene::about(error, &range, path))?;
    progress.clear();
    let text = match format {
        PeriodicFormat::Table => table(&scene, &found)?,
        PeriodicFormat::Json => serde_json::to_string(&found.document(&scene, &settings).with_context(named)?)? + "\n",
    };
    let open = (!found.is_certified()).then(|| conclusion(&found));
    let is_table = format == PeriodicFormat::Table;
    files.draw((&text, open, is_table), || {
        Some(impact_pair_plot::windows::windows(&scene, &found, &arguments.drawing.look))
    })
}

fn table(scene: &Scene, found: &Windows) -> Result<String, fmt::Error> {
    let mut out = heading(scene);
    let (key, low, high) = (found.over.key(), found.over.low(), found.over.high());
    writeln!(out, "over {} from {low} to {high}\n", key.place())?;
    for FoundWindow { impacts, flights, window } in &found.windows {
        let cycles = counted(window.problem.chain().cycles(), "cycle");
        let (orbit, count) = (&window.orbit, window.problem.chain().impacts());
        let is_physical = physical(orbit.physical);
        writeln!(out, "{} = {}: stable, {is_physical}, {count} impacts in {cycles}", key.place(), window.at)?;
        writeln!(
            out,
            "  {} of the reduced map: {flights}; {}",
            counted(*impacts as u32, "impact"),
            symmetric(orbit.symmetric)
        )?;
        let [from, to] = window.ends.each_ref().map(end);
        writeln!(out, "  from {from}")?;
        writeln!(out, "  to   {to}")?;
        let width = window.width().map_or_else(|| "unknown".to_owned(), |width| format!("{width:.3e}"));
        let between = window.reason.map_or_else(|| "proved".to_owned(), |reason| format!("not proved: {reason}"));
        writeln!(out, "  width about {width}; stable between: {between}")?;
    }
    for open in &found.unproved {
        writeln!(
            out,
            "not proved: a floating-point orbit of {} of the reduced map near {:.12}: {}: {}",
            counted(open.impacts as u32, "impact"),
            open.near,
            open.flights,
            open.reason
        )?;
    }
    writeln!(out, "\n{}", conclusion(found))?;
    Ok(out)
}

/// An end in words.
fn end(end: &Option<WindowEnd>) -> String {
    end.as_ref().map_or_else(
        || "an end that is not proved".to_owned(),
        |end| format!("{} ({})", decimal_digits(&end.parameter), end.point.kind),
    )
}

/// Returns the last line of the table: whether everything requested is proved.
fn conclusion(found: &Windows) -> String {
    let windows = counted(found.windows.len() as u32, "window");
    if found.interrupted {
        return format!("interrupted: {windows} proved so far");
    }
    let unproved = match found.unproved.len() {
        0 => String::new(),
        count => format!(", {count} of them not proved, of which nothing is claimed"),
    };
    let seen = format!("{} seen in floating point{unproved}", counted(found.seen as u32, "stable orbit"));
    if found.is_certified() {
        return format!("certified: {windows}; {seen}; others are not excluded");
    }
    let whole = found.windows.iter().filter(|found| found.window.is_certified()).count();
    // More orbits find more windows; they prove no more of one.
    let advice = if found.windows.is_empty() { "; try more --effort or a wider --over" } else { "" };
    format!("undecided: {windows}, {whole} of them proved with all orbits between the ends; {seen}{advice}")
}
