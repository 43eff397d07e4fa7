//! A finished atlas in its formats.

use std::io::Write;
use std::path::Path;

use anyhow::Result;
use impact_pair::atlas::{csv_head, csv_rows};
use impact_pair::json::AtlasHead;
use impact_pair_plot::atlas::{html, svg};
use impact_pair_plot::picture::{Look, encoded};
use impact_pair_plot::records::Records;

use super::arguments::{AtlasFormat, is_page};
use crate::grid::Gathered;
use crate::output::Output;
use impact_pair_answers::grid::line;

/// Writes the table, the picture or the page.
pub fn write(atlas: &mut Gathered<AtlasHead>, out: &mut Output, format: AtlasFormat, look: &Look) -> Result<()> {
    match format {
        AtlasFormat::Jsonl => {
            writeln!(out, "{}", line(&atlas.head))?;
            atlas.each(|text| Ok(writeln!(out, "{text}")?))
        }
        AtlasFormat::Csv => {
            let head = atlas.head.clone();
            out.write_all(csv_head(&head).as_bytes())?;
            atlas.each_record(|record| Ok(out.write_all(csv_rows(&head, &record).as_bytes())?))
        }
        #[cfg(feature = "parquet")]
        AtlasFormat::Parquet => {
            let head = atlas.head.clone();
            let columns = impact_pair::atlas::columns(&head);
            crate::grid::parquet::write(atlas, out, &columns, |record| impact_pair::atlas::rows(&head, record))
        }
        #[cfg(not(feature = "parquet"))]
        AtlasFormat::Parquet => anyhow::bail!("this build has no Parquet"),
        AtlasFormat::Svg => Ok(out.write_all(look.of(&svg(atlas, look)?).as_bytes())?),
        AtlasFormat::Png => Ok(out.write_all(&encoded(&svg(atlas, look)?, look, Path::new("atlas.png"))?)?),
        AtlasFormat::Html => Ok(out.write_all(html(atlas)?.as_bytes())?),
    }
}

/// Writes the picture of this `path`, or the page.
pub fn draw(atlas: &mut Gathered<AtlasHead>, mut out: Output, path: &Path, look: &Look) -> Result<()> {
    if is_page(path) {
        out.write_all(html(atlas)?.as_bytes())?;
        return out.commit();
    }
    out.draw(path, look, svg(atlas, look))
}
