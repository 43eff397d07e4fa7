//! `impact-pair atlas SCENE --over KEY=LO..HI:COUNT --over KEY=LO..HI:COUNT`: where every motion goes, over the plane of two parameters.

pub mod arguments;

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result};
use impact_pair::json::AtlasHead;
use impact_pair_answers::grid::{Points, Survey};
use impact_pair_plot::atlas::{html, svg};
use impact_pair_plot::picture::encoded;

use crate::Answer;
use crate::grid::{self, GridFormat, compute, merge, open_once};
use crate::output::Output;
use crate::scene;
use crate::verb::placed;
use arguments::{AtlasArguments, FORMATS, is_page};

pub fn atlas(arguments: &AtlasArguments) -> Result<Answer> {
    let AtlasArguments { grid, destination, plot, .. } = arguments;
    let inputs: Vec<_> = arguments.scene.iter().chain(&grid.merge).collect();
    scene::keep_apart(&inputs, destination.output.as_deref(), plot.as_deref())?;
    let format = grid::format(arguments.format, destination, grid.shard.is_some(), FORMATS)?;
    let finish = |atlas: &mut Points<AtlasHead>| finish(arguments, format, atlas);
    let Some(path) = &arguments.scene else {
        return merge(Points::merged(&grid.merge)?, destination.quiet, finish);
    };
    let about = |failure| placed(failure, path);
    let atlas = arguments.options.of(&scene::read(path)?, grid.shard()).map_err(about)?;
    atlas.check().map_err(about)?;
    open_once(&[destination.output.as_deref(), plot.as_deref()])?;
    compute(&atlas, &scene::name(path), (grid, destination), finish)
}

/// Writes the output and the plot.
fn finish(arguments: &AtlasArguments, format: GridFormat, atlas: &mut Points<AtlasHead>) -> Result<()> {
    let look = &arguments.look;
    let mut out = Output::open(arguments.destination.output.as_deref())?;
    let written = match format {
        GridFormat::Svg => out.write_all(look.of(&svg(atlas, look)?).as_bytes()).map_err(Into::into),
        GridFormat::Png => {
            out.write_all(&encoded(&svg(atlas, look)?, look, Path::new("atlas.png"))?).map_err(Into::into)
        }
        GridFormat::Html => out.write_all(html(atlas)?.as_bytes()).map_err(Into::into),
        table => grid::write(atlas, &mut out, table, ()),
    };
    written.context("cannot write the output")?;
    out.commit()?;
    let Some(path) = &arguments.plot else { return Ok(()) };
    let mut out = Output::open(Some(path))?;
    if is_page(path) {
        out.write_all(html(atlas)?.as_bytes())?;
        return out.commit();
    }
    out.draw(path, look, svg(atlas, look))
}
