//! `describe`: what becomes of a motion, in one answer.

use std::fmt::{self, Write};

use anyhow::Result;
use clap::Args;
use impact_pair::Scene;
use impact_pair::chaos::MOST_DEPTH;
use impact_pair::json::DescriptionDocument;
use impact_pair::orbit::MAX_BITS;
use impact_pair::watch::Watch;

use super::{Description, describe, lines};
use crate::values::{bits, count, whole};
use crate::{Answer, Asked, Failure, Format, Picture, Status, Verb, heading, line};

/// Options of `describe`: the limits within which the questions are examined.
#[derive(Args, Clone, Copy, Debug)]
pub struct DescribeOptions {
    /// Maximum number of impacts that are certified to decide the fate, in double precision ten times as many
    #[arg(long, value_name = "N", default_value_t = Self::default().impacts, value_parser = count(1..=100_000_000))]
    pub impacts: u64,
    /// Maximum number of impacts of a word of the horseshoe
    #[arg(long, value_name = "K", default_value_t = Self::default().depth, value_parser = whole(1..=MOST_DEPTH))]
    pub depth: u32,
    /// Maximum precision of the orbit, in bits
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS, value_parser = bits())]
    pub max_bits: u32,
}

impl Default for DescribeOptions {
    fn default() -> Self {
        Self { impacts: 2000, depth: 6, max_bits: MAX_BITS }
    }
}

/// A description and its document.
pub struct Described<'s> {
    scene: &'s Scene,
    found: Description,
    document: DescriptionDocument,
}

impl Verb for DescribeOptions {
    const NAME: &'static str = "describe";
    const FORMATS: &'static [(Format, &'static str)] = &[
        (Format::Text, "Human-readable: one line for each question"),
        (Format::Json, "One document of the schema named above"),
    ];
    const SCHEMA: &'static str = "impact-pair/description/1";
    const PICTURE: &'static str =
        "Draw time series, phase plane, impacts with region and h-sets, and itinerary on one page";
    type Answer<'s> = Described<'s>;

    fn answer<'s>(&self, Asked { scene, name, .. }: &Asked<'s>, watch: &dyn Watch) -> Result<Described<'s>, Failure> {
        let found = describe(scene, self, watch)?;
        Ok(Described { document: found.document(scene, name)?, scene, found })
    }
}

impl Answer for Described<'_> {
    fn status(&self) -> Status {
        let DescriptionDocument { certified, interrupted, fate, .. } = &self.document;
        let stopped = if *interrupted { "interrupted; " } else { "" };
        let said = if *certified { "certified: " } else { "" };
        Status::new(*certified && !interrupted, format!("{stopped}{said}{}", fate.message))
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        Ok(Some(if format == Format::Json { line(&self.document)? } else { self.table()? }))
    }

    fn picture(&self) -> Option<Picture<'_>> {
        Some(Picture::Description(self.scene, &self.found, &self.document))
    }
}

impl Described<'_> {
    /// The description for people.
    fn table(&self) -> Result<String, fmt::Error> {
        let mut out = heading(self.scene);
        writeln!(out)?;
        let mut last = "";
        for (label, text) in lines(&self.document) {
            writeln!(out, "{:12}  {text}", if label == last { "" } else { label })?;
            last = label;
        }
        if self.document.interrupted {
            writeln!(out, "interrupted")?;
        }
        Ok(out)
    }
}
