//! `impact-pair trade SCENE`: what accuracy costs on a scene.

pub mod arguments;
mod table;

use anyhow::{Context, Result, bail};
use impact_pair::json::one_a_line;
use impact_pair::orbit::Orbit;
use impact_pair::trade::Trade;

use crate::Answer;
use crate::output::Output;
use crate::progress::{Progress, catch_interruption};
use crate::scene;
use arguments::{TradeArguments, TradeFormat};

pub fn trade(arguments: &TradeArguments) -> Result<Answer> {
    let format = arguments.destination.format(arguments.format)?;
    let scene = scene::read(&arguments.scene)?;
    let asked = arguments.settings(&scene);
    if asked.impacts == Some(0) {
        bail!("{}: run.impacts is 0: no impacts to measure (try --impacts)", scene::name(&arguments.scene));
    }
    Orbit::of(&scene, asked.clone()).with_context(|| scene::name(&arguments.scene))?;
    let (output, plot) = (arguments.destination.output.as_deref(), arguments.plot.as_deref());
    scene::keep_apart(&[&arguments.scene], output, plot)?;

    // From here on Ctrl-C keeps what is measured.
    catch_interruption();
    let out = Output::open(output)?;
    let picture = plot.map(|path| Output::open(Some(path))).transpose()?;
    let progress = Progress::new(asked.impacts, !arguments.destination.quiet);
    let trade = Trade::of(&scene, asked, &progress).with_context(|| scene::name(&arguments.scene))?;
    progress.clear();

    let text = match format {
        TradeFormat::Table => table::table(&trade),
        TradeFormat::Json => format!("{}\n", one_a_line(&trade.document(), &["rungs"])),
    };
    let open = trade.interrupted.as_ref().map(|rung| format!("interrupted in row {rung}"));
    let answer = out.answer(&text, open, (arguments.destination.quiet, false))?;
    if let (Some(picture), Some(path)) = (picture, plot) {
        picture.draw(path, arguments.theme, || impact_pair_plot::trade::svg(&trade))?;
    }
    Ok(answer)
}
