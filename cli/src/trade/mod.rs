//! `impact-pair trade SCENE`: what accuracy costs on a scene.

mod axis;
mod document;
mod judge;
mod labels;
mod ladder;
mod measure;
mod plot;
pub mod size;
mod table;

use std::io::{self, IsTerminal, Write};
use std::path::Path;

use anyhow::{Context, Result, bail};
use impact_pair::Scene;
use impact_pair::orbit::{Orbit, Settings};

use crate::Answer;
use crate::arguments::{TradeArguments, TradeFormat};
use crate::output::Output;
use crate::progress::{Progress, interruption};
use crate::scene;
use impact_pair_plot::picture::encoded;
use judge::Judgement;
use ladder::{Ladder, Rung};
use measure::{Measured, measure};
use size::Units;

/// What has been measured on a scene.
pub struct Trade<'s> {
    scene: &'s Scene,
    /// How far each rung is asked to go.
    asked: Settings,
    /// What widths and errors are measured in.
    units: Units,
    rungs: Vec<Measured>,
    /// The true errors of `float`.
    judgement: Option<Judgement>,
    /// The rung that Ctrl-C came in.
    interrupted: Option<Rung>,
}

pub fn trade(arguments: &TradeArguments) -> Result<Answer> {
    let scene = scene::read(&arguments.scene)?;
    let asked = arguments.settings(&scene);
    if asked.impacts == Some(0) {
        bail!("{}: run.impacts is 0, there is nothing to measure (try --impacts)", scene::name(&arguments.scene));
    }
    Orbit::of(&scene, asked.clone()).with_context(|| scene::name(&arguments.scene))?;
    let (output, plot) = (arguments.output.as_deref(), arguments.plot.as_deref());
    scene::keep(&arguments.scene, output)?;
    scene::keep(&arguments.scene, plot)?;
    if let (Some(output), Some(plot)) = (output, plot)
        && (output == plot || scene::is_same_file(output, plot))
    {
        bail!("cannot write {}: --output and --plot name the same file", plot.display());
    }

    // From here on Ctrl-C keeps what is measured.
    interruption();
    let mut out = Output::open(output)?;
    let picture = plot.map(|path| Output::open(Some(path))).transpose()?;
    let visible = !arguments.quiet && io::stderr().is_terminal();
    let progress = Progress::new(asked.impacts, visible);
    let trade = Trade::measure(&scene, asked, &progress).with_context(|| scene::name(&arguments.scene))?;
    progress.clear();

    let text = match arguments.format {
        TradeFormat::Table => table::table(&trade),
        TradeFormat::Json => document::document(&trade),
    };
    out.write_all(text.as_bytes()).context("cannot write the output")?;
    out.commit()?;
    if let Some(picture) = picture {
        draw(&trade, picture, plot)?;
    }
    let Some(rung) = trade.interrupted else { return Ok(Answer::Complete) };
    if !arguments.quiet {
        // Nobody may be listening.
        let _ = writeln!(io::stderr(), "interrupted in rung {rung}");
    }
    Ok(Answer::Incomplete)
}

fn draw(trade: &Trade<'_>, mut picture: Output, path: Option<&Path>) -> Result<()> {
    let path = path.unwrap_or(Path::new("the plot"));
    let failed = || format!("cannot draw {}", path.display());
    let bytes = plot::svg(trade).and_then(|svg| encoded(svg, path)).with_context(failed)?;
    picture.write_all(&bytes).with_context(failed)?;
    picture.commit()
}

impl<'s> Trade<'s> {
    /// Measures rung after rung, and judges the first one.
    fn measure(scene: &'s Scene, asked: Settings, progress: &Progress) -> Result<Self> {
        let units = Units::of(scene);
        let one_harmonic = scene.pair().excitation().only().is_some();
        let mut ladder = Ladder::new(asked.max_bits, one_harmonic);
        let mut trade = Self { scene, asked, units, rungs: Vec::new(), judgement: None, interrupted: None };
        while let Some(rung) = ladder.rung() {
            progress.stage(&rung.to_string());
            let Some(measured) = measure(scene, rung, &trade.asked, &units, progress)? else {
                trade.interrupted = Some(rung);
                break;
            };
            ladder.climb(measured.impacts, measured.is_complete());
            trade.rungs.push(measured);
            if rung == Rung::Float {
                progress.stage("true errors of float");
                trade.judgement = Some(judge::judge_float(scene, &trade.asked, &units, progress)?);
            }
        }
        Ok(trade)
    }

    /// How far each rung is asked to go, in words.
    fn goal(&self) -> String {
        let impacts = self.asked.impacts.map(counted);
        let until = self.asked.until.as_ref().map(|until| format!("t = {until}"));
        match (impacts, until) {
            (Some(impacts), Some(until)) => format!("{impacts}, or up to {until}"),
            (Some(goal), None) | (None, Some(goal)) => goal,
            (None, None) => unreachable!("there is a default"),
        }
    }
}

fn counted(impacts: u64) -> String {
    if impacts == 1 { "1 impact".into() } else { format!("{impacts} impacts") }
}
