//! What `trade` is asked on the command line.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use impact_pair::Scene;
use impact_pair::orbit::{Arithmetic, MAX_BITS, Settings};
use impact_pair::scene::Run;
use impact_pair_plot::picture::Theme;

use crate::arguments::Destination;

pub const EXIT_CODES: &str = "\
Exit code: 0 all rungs were measured (an undecided one is a result); 1 interrupted (the output holds what was \
measured); 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair trade scenes/figure-14.toml --impacts 200
  impact-pair trade scenes/figure-12.toml --impacts 100 --format json --plot trade.svg

The rungs: float; interval; inari, the textbook's method, of one harmonic; 64, 128, 256, ... bits until one reaches all the impacts, two more bring none, or --max-bits; \
auto to 3, 9, 15, 30 and 100 digits. A build without multiprecision has no rungs of bits.

Times are medians of 301 runs after a first one, or of as many as fit into 0.2 s. Orbit: impacts, their phases and velocities enclosed \
in turns and gaps; with bounds: also their times and velocities in the units of the scene, as exact bounds. Reading \
the scene and printing are not counted.

Widths are guaranteed: of times in periods 2 pi/W, of velocities in A W (in gaps a turn if A may be 0), rounded up. \
Certified digits: -log10 of the greatest of both. Errors of float are judged by certified enclosures (auto at 30 \
digits; a build without multiprecision: interval), as long as its walls are the true ones; an error is said to exceed \
a threshold only where that is proved.

Exit code: 0 all rungs were measured (an undecided one is a result); 1 interrupted (the output holds what was \
measured); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
pub struct TradeArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// Stop each rung after so many impacts [default: that of the scene; 100 if it has no time to stop at either]
    #[arg(long, value_name = "N", value_parser = crate::arguments::count(1..=u64::MAX))]
    impacts: Option<u64>,
    /// Bits that a rung takes at most
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS, value_parser = crate::arguments::bits())]
    pub max_bits: u32,
    /// How the rungs are written [default: as the ending of --output says, else table]
    #[arg(long, value_enum)]
    pub format: Option<TradeFormat>,
    /// Draw the rungs: the time of an impact over the certified digits
    #[arg(long, value_name = "FILE.svg|FILE.png|FILE.pdf", value_parser = impact_pair_plot::picture::path)]
    pub plot: Option<PathBuf>,
    /// What the picture stands on
    #[arg(long, value_enum, default_value_t, value_name = "light|dark", requires = "plot")]
    pub theme: Theme,
    #[command(flatten)]
    pub destination: Destination,
}

impl TradeArguments {
    /// How far each rung is followed.
    pub fn settings(&self, scene: &Scene) -> Settings {
        let run = Run { impacts: self.impacts, ..Run::default() };
        Settings { max_bits: self.max_bits, ..scene.settings_asked(run, Arithmetic::Auto) }
    }
}

/// How the rungs of a trade are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum TradeFormat {
    /// For people: a line a rung
    #[default]
    Table,
    /// One document, schema impact-pair/trade/1
    Json,
}
