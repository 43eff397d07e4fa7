//! `run`: the certified events of a scene.

mod listing;
mod orbit;
mod table;

use clap::Args;
use impact_pair::Scene;
use impact_pair::exact::Exact;
use impact_pair::orbit::{Arithmetic, MAX_BITS, Settings};
use impact_pair::scene::Run;

use crate::values::{ARITHMETICS, bits, count, digits, point};
pub use listing::{CSV_HEADER, Listing, csv_row};

/// Options of `run`, and of all else that follows the orbit of a scene.
#[derive(Args, Clone, Debug)]
pub struct RunOptions {
    /// Stop after N impacts [default: that of the scene; 100 if there is no --until either]
    #[arg(long, value_name = "N", value_parser = count(0..=u64::MAX))]
    pub impacts: Option<u64>,
    /// Stop at this time, a number or an expression such as 100*pi [default: that of the scene]
    #[arg(long, value_name = "T", value_parser = point, allow_hyphen_values = true)]
    pub until: Option<Exact>,
    /// Requested width of enclosures, at most 10^-D: of times relative to 2 pi/W, of velocities relative to A W
    /// [default: that of the scene, or 9; with shadow 6]
    #[arg(long, value_name = "D", value_parser = digits())]
    pub digits: Option<u32>,
    /// The arithmetic: auto, the cheapest that certifies the digits; float, plain doubles, not rigorous; interval,
    /// certified in doubles, without a limit of widths; inari, the textbook interval method, for one harmonic; shadow, for
    /// chaotic motion, a true orbit that starts within about 1e-12 of the given start, for any number of impacts; or BITS,
    /// certified at that precision, without a limit of widths
    #[arg(long, default_value = "auto", value_name = ARITHMETICS)]
    pub arithmetic: Arithmetic,
    /// With --arithmetic shadow: prove the first M impacts in higher precision, so that the start is nearer to the given one
    #[arg(long, value_name = "M", default_value_t = 0, value_parser = count(0..=u64::MAX))]
    pub splice: u64,
    /// Maximum precision of auto, in bits
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS, value_parser = bits())]
    pub max_bits: u32,
}

impl RunOptions {
    /// The requested part of the table `[run]`.
    pub fn run(&self) -> Run {
        Run { impacts: self.impacts, until: self.until.clone(), digits: self.digits }
    }

    /// The settings of the orbit: those of the options, else those of the scene's table `[run]`.
    pub fn settings(&self, scene: &Scene) -> Settings {
        let settings = scene.settings_requested(self.run(), self.arithmetic);
        Settings { max_bits: self.max_bits, splice: self.splice, attractor: true, ..settings }
    }
}
