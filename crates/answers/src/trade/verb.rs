//! `trade`: what accuracy costs on a scene.

use anyhow::Result;
use clap::Args;
use impact_pair::json::one_a_line;
use impact_pair::orbit::{Arithmetic, MAX_BITS, Orbit, Settings};
use impact_pair::scene::Run;
use impact_pair::watch::Watch;
use impact_pair::{Error, Scene};

use super::{Trade, table};
use crate::values::{bits, count};
use crate::{Answer, Asked, Counts, Failure, Format, Picture, Status, Verb};

/// Options of `trade`.
#[derive(Args, Clone, Debug)]
pub struct TradeOptions {
    /// Stop each row after N impacts [default: that of the scene; 100 if the scene has no stop time either]
    #[arg(long, value_name = "N", value_parser = count(1..=u64::MAX))]
    pub impacts: Option<u64>,
    /// Maximum precision of a row, in bits
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS, value_parser = bits())]
    pub max_bits: u32,
}

impl TradeOptions {
    /// How far each row is followed.
    fn settings(&self, scene: &Scene) -> Settings {
        let run = Run { impacts: self.impacts, ..Run::default() };
        Settings { max_bits: self.max_bits, ..scene.settings_requested(run, Arithmetic::Auto) }
    }
}

impl Verb for TradeOptions {
    const NAME: &'static str = "trade";
    const FORMATS: &'static [(Format, &'static str)] = &[
        (Format::Table, "Human-readable: one line per row"),
        (Format::Json, "One document, schema impact-pair/trade/1"),
    ];
    const SCHEMA: &'static str = "";
    const PICTURE: &'static str = "Draw the time per impact over the certified digits";
    type Answer<'s> = Trade<'s>;

    fn counts(&self, scene: &Scene) -> Counts {
        Counts::Impacts(self.settings(scene).impacts)
    }

    fn answer<'s>(&self, Asked { scene, .. }: &Asked<'s>, watch: &dyn Watch) -> Result<Trade<'s>, Failure> {
        let requested = self.settings(scene);
        if requested.impacts == Some(0) {
            let message = "run.impacts is 0: no impacts to measure (try --impacts)";
            return Err(Error::out_of_range("run.impacts", message.to_owned()).into());
        }
        Orbit::of(scene, requested.clone())?;
        Ok(Trade::of(scene, requested, watch)?)
    }
}

impl Answer for Trade<'_> {
    fn status(&self) -> Status {
        match self.interrupted {
            Some(arithmetic) => Status::new(false, format!("interrupted in row {arithmetic}")),
            None => Status::new(true, "every row was measured"),
        }
    }

    fn text(&self, format: Format) -> Result<Option<String>> {
        Ok(Some(match format {
            Format::Json => format!("{}\n", one_a_line(&self.document(), &["arithmetics"])),
            _ => table::table(self),
        }))
    }

    fn picture(&self) -> Option<Picture<'_>> {
        Some(Picture::Trade(self))
    }
}
