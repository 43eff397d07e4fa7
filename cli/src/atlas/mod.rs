//! `impact-pair atlas SCENE --over KEY=LO..HI:COUNT --over KEY=LO..HI:COUNT`: where every motion goes, over the plane of two parameters.

pub mod arguments;
mod tally;
mod write;

use std::path::Path;

use anyhow::{Context, Result, bail};
use clap::ValueEnum;
use impact_pair::Scene;
use impact_pair::atlas::{self, Plane};
use impact_pair::chaos::Global;
use impact_pair::json::AtlasHead;

use crate::grid::{Gathered, Work, answered, named, open_once};
use crate::output::{Output, note};
use crate::progress::Interruption;
use crate::scene::{self, ranged};
use crate::{Answer, ending};
use arguments::{AtlasArguments, AtlasFormat};
use impact_pair_answers::grid::line;
use tally::Classes;

pub fn atlas(arguments: &AtlasArguments) -> Result<Answer> {
    let inputs: Vec<_> = arguments.scene.iter().chain(&arguments.grid.merge).collect();
    scene::keep_apart(&inputs, arguments.destination.output.as_deref(), arguments.plot.as_deref())?;
    let format = format(arguments)?;
    match &arguments.scene {
        Some(path) => compute(arguments, format, path),
        None => {
            let mut atlas = Gathered::merged(&arguments.grid.merge)?;
            let tally = finish(arguments, format, &mut atlas)?;
            note(arguments.destination.quiet, &tally.to_string());
            Ok(answered(&tally))
        }
    }
}

/// The format of the output.
fn format(arguments: &AtlasArguments) -> Result<AtlasFormat> {
    let is_shard = arguments.grid.shard.is_some();
    let usual = if is_shard { AtlasFormat::Jsonl } else { AtlasFormat::Csv };
    let file = arguments.destination.output.as_deref();
    let format = ending::format(arguments.format, ("--output", file), AtlasFormat::value_variants(), usual)?;
    let requested = || match file.filter(|_| arguments.format.is_none()) {
        Some(file) => format!("--output {}", file.display()),
        None => "--format".to_owned(),
    };
    if is_shard && format != AtlasFormat::Jsonl {
        bail!("{} is not jsonl, but shards are written as jsonl, to be merged by --merge", requested());
    }
    if format == AtlasFormat::Parquet && cfg!(not(feature = "parquet")) {
        bail!(
            "{} is parquet, but this build lacks Parquet: use csv or jsonl, or build with --features parquet",
            requested()
        );
    }
    if format == AtlasFormat::Png && cfg!(not(feature = "png")) {
        bail!("{} is png, but this build lacks PNG: use svg, or build with --features png", requested());
    }
    Ok(format)
}

fn compute(arguments: &AtlasArguments, format: AtlasFormat, path: &Path) -> Result<Answer> {
    let scene: Scene = scene::read(path)?;
    let plane = Plane::new(ranged(&arguments.over, &scene, path)?, arguments.cells)?;
    let settings = arguments.settings();
    let head = atlas::head(&scene, &plane, &settings, arguments.grid.shard());
    // All corners are scenes that are analysed, before anything is computed.
    let ranges: Vec<_> = plane.axes().iter().map(|axis| (axis.key(), axis.to_string())).collect();
    let corners = || plane.corners(&scene)?.iter().try_for_each(|corner| Global::accepts(corner.pair()));
    corners().map_err(|error| scene::about(error, &ranges, path))?;
    open_once(&[arguments.destination.output.as_deref(), arguments.plot.as_deref()])?;
    let point = |point: u64| {
        let record = atlas::record(&scene, &plane, &settings, point, &Interruption);
        let at = || plane.values(point).map_or_else(|error| error.to_string(), |values| named(point, &values));
        Ok(record.with_context(at)?.map(|record| line(&record)))
    };
    let (grid, destination) = (&arguments.grid, &arguments.destination);
    let work = Work { head, point: &point, grid, destination };
    work.answer(&scene::name(path), |atlas| finish(arguments, format, atlas))
}

/// Writes the output and the plot.
fn finish(arguments: &AtlasArguments, format: AtlasFormat, atlas: &mut Gathered<AtlasHead>) -> Result<Classes> {
    let tally = Classes::of(atlas)?;
    let mut out = Output::open(arguments.destination.output.as_deref())?;
    write::write(atlas, &mut out, format, &arguments.look).context("cannot write the output")?;
    out.commit()?;
    if let Some(path) = &arguments.plot {
        let out = Output::open(Some(path))?;
        write::draw(atlas, out, path, &arguments.look)?;
    }
    Ok(tally)
}
