//! Command-line arguments of `trade`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use impact_pair::Scene;
use impact_pair::orbit::{Arithmetic, MAX_BITS, Settings};
use impact_pair::scene::Run;

use crate::destination::Drawing;

pub const EXIT_CODES: &str = "\
Exit code: 0 every row was measured (an undecided one is a result); 1 interrupted (the output holds what was \
measured); 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair trade scenes/figure-14.toml --impacts 200
  impact-pair trade scenes/figure-12.toml --impacts 100 --format json --plot trade.svg

The rows: float; interval; inari, the textbook method, for one harmonic; shadow; 64, 128, 256, ... bits until one reaches \
all the impacts, two more bring no progress, or --max-bits; auto to 3, 9, 15, 30 and 100 digits.

Times are medians of 301 runs after a first one, or of as many as fit into 0.2 s. Orbit: impacts with phase and \
velocity enclosed in reduced units; with bounds: also their times and velocities in the units of the scene, as exact \
bounds. Reading the scene and printing are not included.

Widths are guaranteed: of times in periods 2 pi/W, of velocities in A W (in gap widths per period if A may be 0), \
rounded up. Certified digits: -log10 of the larger width. The errors of float are measured against certified \
enclosures (auto at 30 digits), as long as its walls are the true ones; an error is reported to exceed a threshold only where that is proved.

Exit code: 0 every row was measured (an undecided one is a result); 1 interrupted (the output holds what was \
measured); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("plot", |plot| plot.help("Draw the time per impact over the certified digits")))]
pub struct TradeArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// Stop each row after N impacts [default: that of the scene; 100 if the scene has no stop time either]
    #[arg(long, value_name = "N", value_parser = impact_pair_answers::values::count(1..=u64::MAX))]
    impacts: Option<u64>,
    /// Maximum precision of a row, in bits
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS, value_parser = impact_pair_answers::values::bits())]
    pub max_bits: u32,
    /// Output format [default: by the extension of --output, else table]
    #[arg(long, value_enum)]
    pub format: Option<TradeFormat>,
    #[command(flatten)]
    pub drawing: Drawing,
}

impl TradeArguments {
    /// Returns how far each row is followed.
    pub fn settings(&self, scene: &Scene) -> Settings {
        let run = Run { impacts: self.impacts, ..Run::default() };
        Settings { max_bits: self.max_bits, ..scene.settings_requested(run, Arithmetic::Auto) }
    }
}

/// The output formats of `trade`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum TradeFormat {
    /// Human-readable: one line per row
    #[default]
    Table,
    /// One document, schema impact-pair/trade/1
    Json,
}
