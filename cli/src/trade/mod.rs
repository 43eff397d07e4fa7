//! `impact-pair trade SCENE`: what accuracy costs on a scene.

pub mod arguments;
mod table;

use anyhow::{Context, Result, bail};
use impact_pair::json::one_a_line;
use impact_pair::orbit::Orbit;
use impact_pair::trade::Trade;

use crate::Answer;
use crate::destination::OpenOutput;
use crate::progress::Progress;
use crate::scene;
use arguments::{TradeArguments, TradeFormat};

pub fn trade(arguments: &TradeArguments) -> Result<Answer> {
    let format = arguments.drawing.format(arguments.format)?;
    let OpenOutput { scene, files, path } = arguments.drawing.begin(&arguments.scene)?;
    let requested = arguments.settings(&scene);
    if requested.impacts == Some(0) {
        bail!("{}: run.impacts is 0: no impacts to measure (try --impacts)", scene::name(path));
    }
    Orbit::of(&scene, requested.clone()).with_context(|| scene::name(path))?;
    let progress = Progress::new(requested.impacts, !files.quiet);
    let trade = Trade::of(&scene, requested, &progress).with_context(|| scene::name(path))?;
    progress.clear();

    let text = match format {
        TradeFormat::Table => table::table(&trade),
        TradeFormat::Json => format!("{}\n", one_a_line(&trade.document(), &["arithmetics"])),
    };
    let open = trade.interrupted.as_ref().map(|arithmetic| format!("interrupted in row {arithmetic}"));
    files.draw((&text, open, false), || Some(impact_pair_plot::trade::svg(&trade, &arguments.drawing.look)))
}
