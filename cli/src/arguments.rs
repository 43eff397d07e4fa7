//! The command line: verbs, their arguments and their help.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use impact_pair::Scene;
use impact_pair::exact::Exact;
use impact_pair::orbit::{Arithmetic, BITS, MAX_BITS, Settings};
use impact_pair::scene::{DIGITS, Run};

/// Verified numerics for the horizontal impact pair: every impact proved
#[derive(Debug, Parser)]
#[command(name = "impact-pair", version = VERSION, max_term_width = 100, after_help = EXIT_CODES)]
pub struct Cli {
    #[command(subcommand)]
    pub verb: Verb,
}

macro_rules! version {
    ($bits:literal, $fma:literal) => {
        concat!(
            env!("CARGO_PKG_VERSION"),
            "\narithmetics: auto, float, interval (53 bits, rounded to nearest, error bounds proved)",
            $bits,
            "\ntarget CPU features: fma ",
            $fma
        )
    };
}

const FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));
const VERSION: &str = match (cfg!(feature = "multiprecision"), FUSED) {
    (true, true) => version!(", BITS (MPFR)", "yes"),
    (true, false) => version!(", BITS (MPFR)", "no"),
    (false, true) => version!("", "yes"),
    (false, false) => version!("", "no"),
};

const EXIT_CODES: &str = "\
Exit code: 0 all that was asked is certified; 1 some of it is not (the output still holds all that is); \
2 usage, bad input, I/O";

#[derive(Debug, Subcommand)]
pub enum Verb {
    /// List the certified impacts of a scene
    #[command(after_help = EXIT_CODES, after_long_help = RUN_HELP)]
    Run(RunArguments),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
}

const RUN_HELP: &str = "\
Scene: a TOML file with [excitation] amplitude, frequency, phase; [pair] gap, restitution; [start] time, velocity and \
wall or position; and, if you like, title and [run] impacts, until, digits. Numbers are exact decimals, strings are \
expressions such as \"3*pi\" or intervals such as \"[9.42, 9.43]\".

Table: 1.0000305639(24,68) means that the truth lies in [1.000030563924, 1.000030563968]: the digits before the \
parenthesis are certain, in it are the lower and the upper end of the rest, rounded outward. Where no digits are \
certain, 2.00000(-1,+3) means [1.99999, 2.00003]. Float runs claim nothing and show plain decimals.

Exit code: 0 all that was asked is certified (a float run that completes certifies nothing and exits 0 too); 1 some of \
it is not: the orbit became undecided, was interrupted, or is wider than --digits (the output still holds all that is \
certified); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
pub struct RunArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// Stop after so many impacts [default: that of the scene; 100 if there is no --until either]
    #[arg(long, value_name = "N")]
    impacts: Option<u64>,
    /// Stop at this time, a number or an expression such as 100*pi [default: that of the scene]
    #[arg(long, value_name = "T", value_parser = point, allow_hyphen_values = true)]
    until: Option<Exact>,
    /// Enclosures are asked to be at most 10^-D wide: of times relative to 2 pi/W, of velocities relative to A W
    /// [default: that of the scene, or 9]
    #[arg(long, value_name = "D", value_parser = clap::value_parser!(u32).range(i64::from(*DIGITS.start())..=i64::from(*DIGITS.end())))]
    digits: Option<u32>,
    /// What computes: auto, the cheapest that certifies the digits; float, plain doubles, nothing is certified; interval,
    /// certified in doubles, whatever the widths; or certified in so many BITS, whatever the widths
    #[arg(long, default_value = "auto", value_name = "auto|float|interval|BITS")]
    pub arithmetic: Arithmetic,
    /// Bits that auto takes at most
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS,
        value_parser = clap::value_parser!(u32).range(i64::from(*BITS.start())..=i64::from(*BITS.end())))]
    pub max_bits: u32,
    /// How the events are written
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// Write to FILE, which appears whole or not at all, instead of stdout
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// No notes and no progress on stderr
    #[arg(long, short)]
    pub quiet: bool,
}

impl RunArguments {
    /// How the scene is to be run: by its table `[run]`, as far as the command line does not say otherwise.
    pub fn settings(&self, scene: &Scene) -> Settings {
        let run = scene.run();
        let run = Run {
            impacts: self.impacts.or(run.impacts),
            until: self.until.clone().or_else(|| run.until.clone()),
            digits: self.digits.or(run.digits),
        };
        Settings { max_bits: self.max_bits, ..run.settings(self.arithmetic) }
    }
}

/// How the events of an orbit are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people: the certain digits, then the ends of the rest
    #[default]
    Table,
    /// One document, schema impact-pair/orbit/1
    Json,
    /// JSON Lines as they are certified: the head, an event a line, the outcome
    Jsonl,
    /// A line an event, bounds in columns
    Csv,
}

/// Reads a single exact number.
fn point(text: &str) -> Result<Exact, String> {
    let number = Exact::parse(text).map_err(|error| error.to_string())?;
    if number.is_point() { Ok(number) } else { Err("accepted is a single number, not an interval".into()) }
}
