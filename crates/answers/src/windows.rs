//! `windows`: stable periodic orbits near a scene and the windows in which they are stable, proved.

use std::fmt::{self, Write};
use std::slice;

use anyhow::Result;
use clap::Args;
use impact_pair::chaos::{
    FoundWindow, MOST_WINDOW_IMPACTS, WINDOW_PARAMETERS, WindowSettings, Windows, is_window_range,
};
use impact_pair::exact::decimal_digits;
use impact_pair::json::{WindowsDocument, counted};
use impact_pair::periodic::bifurcation::WindowEnd;
use impact_pair::scene::Over;
use impact_pair::watch::Watch;
use impact_pair::{Effort, Scene};

use crate::values::{PrecisionArguments, count};
use crate::{
    Answer, Asked, Failure, Format, Picture, Status, Step, TABLE_OR_JSON, Verb, heading, line, physical, symmetric,
};

/// Options of `windows`.
#[derive(Args, Clone, Debug)]
#[command(mut_arg("digits", |digits| digits.help("Requested width of enclosures, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W; ends are enclosed to four more digits than the width of the window takes [default: that of the scene, or 9]")))]
pub struct WindowsOptions {
    /// The parameter and its range: gap, amplitude, restitution, or A/d, the amplitude in gaps
    #[arg(long, value_name = "KEY=LO..HI", value_parser = over)]
    pub over: Over,
    /// Number of impacts of floating-point orbits that are searched
    #[arg(long, value_name = "N", default_value_t = 40_000_000, value_parser = count(1..=1_000_000_000_000))]
    pub impacts: u64,
    /// Multiply the work by X: --impacts many times X are searched
    #[arg(long, value_name = "X", default_value_t)]
    pub effort: Effort,
    /// Maximum number of impacts of an orbit in the reduced map
    #[arg(long, value_name = "N", default_value_t = 44, value_parser = count(1..=MOST_WINDOW_IMPACTS as u64))]
    pub longest: u64,
    /// Maximum number of windows that are proved, the nearest ones
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = count(1..=100_000))]
    pub most: u64,
    /// Width of the enclosures.
    #[command(flatten)]
    pub precision: PrecisionArguments,
}

/// Reads `KEY=LO..HI` of a parameter over which windows are searched.
fn over(text: &str) -> Result<Over, impact_pair::Error> {
    Over::parse(text, &format!("KEY=LO..HI with LO < HI, {WINDOW_PARAMETERS}"), is_window_range)
}

/// Windows and their document.
pub struct StableWindows<'s> {
    scene: &'s Scene,
    found: Windows,
    document: WindowsDocument,
}

impl Verb for WindowsOptions {
    const NAME: &'static str = "windows";
    const FORMATS: &'static [(Format, &'static str)] = TABLE_OR_JSON;
    const SCHEMA: &'static str = "impact-pair/windows/1";
    const PICTURE: &'static str = "Draw the windows: the width over the parameter, on a logarithmic scale";
    type Answer<'s> = StableWindows<'s>;

    fn answer<'s>(&self, Asked { scene, .. }: &Asked<'s>, watch: &dyn Watch) -> Result<StableWindows<'s>, Failure> {
        let settings = WindowSettings {
            over: self.over.of(scene.pair())?,
            impacts: self.effort.times(self.impacts),
            longest: self.longest as usize,
            most: self.most as usize,
            precision: self.precision.of(scene),
        };
        let found = Windows::of(scene, &settings, watch).map_err(Failure::over(slice::from_ref(&settings.over)))?;
        Ok(StableWindows { document: found.document(scene, &settings)?, scene, found })
    }
}

impl Answer for StableWindows<'_> {
    fn status(&self) -> Status {
        let found = &self.found;
        let windows = counted(found.windows.len() as u32, "window");
        if found.interrupted {
            return Status::new(found.is_certified(), format!("interrupted: {windows} proved so far"));
        }
        let unproved = match found.unproved.len() {
            0 => String::new(),
            count => format!(", {count} of them not proved, of which nothing is claimed"),
        };
        let seen = format!("{} seen in floating point{unproved}", counted(found.seen as u32, "stable orbit"));
        if found.is_certified() {
            return Status::new(true, format!("certified: {windows}; {seen}; others are not excluded"));
        }
        let whole = found.windows.iter().filter(|found| found.window.is_certified()).count();
        let between = "of them proved with all orbits between the ends";
        let status = Status::new(false, format!("undecided: {windows}, {whole} {between}; {seen}"));
        // More orbits find more windows; they prove no more of one.
        match found.windows.is_empty() {
            true => status.say("; try ").step(Step::More("effort")).say(" or ").step(Step::Wider("over")),
            false => status,
        }
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        Ok(Some(if format == Format::Json {
            line(&self.document)?
        } else {
            table(self.scene, &self.found, &self.status())?
        }))
    }

    fn picture(&self) -> Option<Picture<'_>> {
        Some(Picture::Windows(self.scene, &self.found))
    }
}

fn table(scene: &Scene, found: &Windows, status: &Status) -> Result<String, fmt::Error> {
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
    writeln!(out, "\n{status}")?;
    Ok(out)
}

/// An end in words.
fn end(end: &Option<WindowEnd>) -> String {
    end.as_ref().map_or_else(
        || "an end that is not proved".to_owned(),
        |end| format!("{} ({})", decimal_digits(&end.parameter), end.point.kind),
    )
}
