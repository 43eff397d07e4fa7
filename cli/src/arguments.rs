//! The command line: verbs, their arguments and their help.

use std::ffi::OsStr;
use std::path::PathBuf;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Args, Command, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use impact_pair::exact::Exact;
use impact_pair::orbit::Arithmetic;
use impact_pair::scene::{DIGITS, Run};

/// Verified numerics for the horizontal impact pair: every impact proved
#[derive(Debug, Parser)]
#[command(name = "impact-pair", version = VERSION, max_term_width = 100, after_help = EXIT_CODES)]
pub struct Cli {
    #[command(subcommand)]
    pub verb: Verb,
}

macro_rules! version {
    ($fma:literal) => {
        concat!(
            env!("CARGO_PKG_VERSION"),
            "\narithmetics: auto, float, interval (53 bits, rounded to nearest, error bounds proved)",
            "\ntarget CPU features: fma ",
            $fma
        )
    };
}

const VERSION: &str =
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) { version!("yes") } else { version!("no") };

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
    /// What computes
    #[arg(long, default_value = "auto", value_parser = ArithmeticParser)]
    pub arithmetic: Arithmetic,
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
    /// The scene's table `[run]`, as far as the command line does not say otherwise.
    pub fn over(&self, run: &Run) -> Run {
        Run {
            impacts: self.impacts.or(run.impacts),
            until: self.until.clone().or_else(|| run.until.clone()),
            digits: self.digits.or(run.digits),
        }
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

/// Reads an arithmetic by its name.
#[derive(Clone)]
struct ArithmeticParser;

const ARITHMETICS: [(Arithmetic, &str, &str); 3] = [
    (Arithmetic::Auto, "auto", "The cheapest that certifies the digits; the orbit ends where none does"),
    (Arithmetic::Float, "float", "Plain double precision, nothing is certified"),
    (Arithmetic::Interval, "interval", "Certified in double precision as far as it decides, whatever the widths"),
];

/// What the command line calls it.
pub fn arithmetic_name(arithmetic: Arithmetic) -> &'static str {
    ARITHMETICS.iter().find(|(known, ..)| *known == arithmetic).map_or("", |(_, name, _)| name)
}

impl TypedValueParser for ArithmeticParser {
    type Value = Arithmetic;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<Arithmetic, clap::Error> {
        let name = StringValueParser::new().parse_ref(command, arg, value)?;
        let found = ARITHMETICS.iter().find(|(_, known, _)| *known == name);
        found.map(|(arithmetic, ..)| *arithmetic).ok_or_else(|| {
            let mut error = clap::Error::new(ErrorKind::InvalidValue).with_cmd(command);
            let option = arg.map_or("--arithmetic".to_owned(), ToString::to_string);
            error.insert(ContextKind::InvalidArg, ContextValue::String(option));
            error.insert(ContextKind::InvalidValue, ContextValue::String(name));
            let names = ARITHMETICS.iter().map(|(_, name, _)| (*name).to_owned()).collect();
            error.insert(ContextKind::ValidValue, ContextValue::Strings(names));
            let note = "this version computes with auto, float and interval; it has no multiprecision";
            error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![note.into()]));
            error
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(ARITHMETICS.iter().map(|(_, name, help)| PossibleValue::new(*name).help(*help))))
    }
}
