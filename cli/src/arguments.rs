//! The command line: verbs, their arguments and their help.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use anyhow::Result;
use clap::builder::RangedI64ValueParser;
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use impact_pair::Scene;
use impact_pair::exact::Exact;
use impact_pair::mapping::Word;
use impact_pair::orbit::{Arithmetic, BITS, MAX_BITS, Settings};
use impact_pair::periodic::Precision;
use impact_pair::periodic::bifurcation::{Over, Wanted};
use impact_pair::periodic::chain::MOST_CYCLES;
use impact_pair::scene::{DIGITS, Run};
use impact_pair_certificate::Effort;

use crate::audit::arguments as audit;
use crate::chaos;
use crate::cycles;
use crate::describe;
use crate::ending;
use crate::plot::arguments as plot;
use crate::sweep::arguments as sweep;
use crate::trade::arguments as trade;
use crate::trap;
use crate::two_impact::arguments as two_impact;
use crate::version;

/// Verified numerics for the horizontal impact pair: every impact proved
#[derive(Debug, Parser)]
#[command(name = "impact-pair", version, long_version = version::text(), max_term_width = 100)]
#[command(after_help = EXIT_CODES, after_long_help = HELP)]
pub struct Cli {
    #[command(subcommand)]
    pub verb: Verb,
}

const EXIT_CODES: &str = "\
Exit code: 0 everything requested is certified; 1 some of it is not (the output still holds what is certified); 2 \
usage, bad input, I/O";

const HELP: &str = "\
Examples:
  impact-pair run scenes/figure-14.toml
  impact-pair run scenes/figure-14.toml --impacts 1000 --digits 30 --format csv --output impacts.csv
  impact-pair help run

Exit code: 0 everything requested is certified; 1 some of it is not (the output still holds what is certified); \
2 usage, bad input, I/O";

#[derive(Debug, Subcommand)]
pub enum Verb {
    /// List the certified impacts of a scene
    #[command(after_help = EXIT_CODES, after_long_help = RUN_HELP)]
    Run(RunArguments),
    /// Describe a motion: attracted, periodic, at rest or in a trapping region; its exponent, a horseshoe, what is undecided
    #[command(after_help = describe::EXIT_CODES, after_long_help = describe::HELP)]
    Describe(describe::DescribeArguments),
    /// Prove the periodic orbits of a word of mappings, and their stability
    #[command(after_help = EXIT_CODES, after_long_help = PERIODIC_HELP)]
    Periodic(PeriodicArguments),
    /// Prove the folds, pitchforks, period doublings and grazes of a word's orbits over a parameter
    #[command(after_help = EXIT_CODES, after_long_help = BIFURCATION_HELP)]
    Bifurcations(BifurcationArguments),
    /// Prove a trapping region of a scene: no sticking, no complete chatter, bounds for all time
    #[command(after_help = EXIT_CODES, after_long_help = trap::HELP)]
    Trap(trap::TrapArguments),
    /// Prove chaos: a horseshoe by covering relations, and a lower bound of the topological entropy
    #[command(after_help = EXIT_CODES, after_long_help = chaos::HELP)]
    Chaos(chaos::ChaosArguments),
    /// Find all periodic orbits with N impacts in a trapping region, and whether one attracts
    #[command(after_help = EXIT_CODES, after_long_help = cycles::HELP)]
    Cycles(cycles::CyclesArguments),
    /// Prove every claim of a JSON document again, by an independent method, from its own numbers
    #[command(after_help = CHECK_EXIT_CODES, after_long_help = CHECK_HELP)]
    Check(CheckArguments),
    /// Write a Coq file whose theorem states the claims of an orbit JSON
    #[command(after_help = PROVE_EXIT_CODES, after_long_help = PROVE_HELP)]
    Prove(ProveArguments),
    /// Certify an orbit at each point of a grid of parameters or initial data: bifurcation diagrams, exponents, basins
    #[command(after_help = sweep::EXIT_CODES, after_long_help = sweep::HELP)]
    Sweep(sweep::SweepArguments),
    /// Measure the cost of accuracy on a scene: speed, reach and widths of each arithmetic, and the true errors of floating point
    #[command(after_help = trade::EXIT_CODES, after_long_help = trade::HELP)]
    Trade(trade::TradeArguments),
    /// Draw the paper's figures for a scene from certified orbits, as SVG, PNG or PDF
    #[command(after_help = EXIT_CODES, after_long_help = plot::HELP)]
    Plot(plot::PlotArguments),
    /// Find the motions with two impacts in N cycles: closed forms (61)-(73), all others, first contacts, stability
    #[command(after_help = two_impact::EXIT_CODES, after_long_help = two_impact::HELP)]
    TwoImpact(two_impact::TwoImpactArguments),
    /// Compare another simulator's list of impacts with the certified orbit: inside, outside, missed, false; where it diverges
    #[command(after_help = audit::EXIT_CODES, after_long_help = audit::HELP)]
    Audit(audit::AuditArguments),
    /// Print the manual page, or write the pages of all verbs into a directory
    #[command(after_long_help = MAN_HELP)]
    Man(ManArguments),
    /// Print a completion script for a shell
    #[command(after_long_help = COMPLETIONS_HELP)]
    Completions {
        /// The shell
        shell: Shell,
    },
}

const RUN_HELP: &str = "\
Examples:
  impact-pair run scenes/figure-14.toml
  impact-pair run scenes/figure-14.toml --until 20*pi --digits 40 --format csv --output impacts.csv
  impact-pair run scenes/chatter.toml --arithmetic interval --format jsonl

Scene: a TOML file with [excitation] amplitude, frequency, phase; [pair] gap, restitution; [start] time, velocity \
and wall or position; optionally title and [run] impacts, until, digits. Numbers are exact decimals; strings are \
expressions such as \"3*pi\" or intervals such as \"[9.42, 9.43]\".

After the last impact run tries to prove that the motion converges to a stable periodic orbit: one with at most 128 impacts, near the \
last impacts listed, whose attraction is proved in double precision. Where the last line does not mention it, that is undecided: the \
motion may converge to a longer orbit, later, or more slowly than doubles resolve (chaos --over finds more).

Table: 1.0000305639(24,68) means that the true value lies in [1.000030563924, 1.000030563968]. The digits before the \
parenthesis are certain; the parenthesis holds the remaining digits of the lower and the upper bound, rounded \
outward. Where no digits are certain, 2.00000(-1,+3) means [1.99999, 2.00003]. Runs with --arithmetic float are not \
rigorous and print plain decimals.

Exit code: 0 everything requested is certified (a float run that completes certifies nothing and exits 0 too); 1 \
some of it is not: the orbit is undecided from some impact on, was interrupted, or is wider than --digits (the \
output still holds what is certified); 2 usage, bad input, I/O.";

/// Where an answer goes, and what is said beside it.
#[derive(Args, Debug)]
pub struct Destination {
    /// Write to FILE, atomically, instead of stdout; its ending chooses the format
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Print no notes and no progress on stderr
    #[arg(long, short)]
    pub quiet: bool,
}

impl Destination {
    /// The format of the output: the one given, else that of its ending, else the usual one.
    ///
    /// # Errors
    /// When the ending is of no format, or contradicts the one given.
    pub fn format<F: ValueEnum + Default>(&self, given: Option<F>) -> Result<F> {
        ending::format(given, ("--output", self.output.as_deref()), F::value_variants(), F::default())
    }
}

#[derive(Args, Debug)]
pub struct RunArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// Stop after N impacts [default: that of the scene; 100 if there is no --until either]
    #[arg(long, value_name = "N", value_parser = count(0..=u64::MAX))]
    impacts: Option<u64>,
    /// Stop at this time, a number or an expression such as 100*pi [default: that of the scene]
    #[arg(long, value_name = "T", value_parser = point, allow_hyphen_values = true)]
    until: Option<Exact>,
    /// Requested width of enclosures, at most 10^-D: of times relative to 2 pi/W, of velocities relative to A W
    /// [default: that of the scene, or 9; with shadow 6]
    #[arg(long, value_name = "D", value_parser = digits())]
    digits: Option<u32>,
    /// The arithmetic: auto, the cheapest that certifies the digits; float, plain doubles, not rigorous; interval,
    /// certified in doubles, whatever the widths; inari, the textbook interval method, for one harmonic; shadow, for
    /// chaotic motion, a true orbit that starts within about 1e-12 of the given start, for any number of impacts; or BITS,
    /// certified at that precision, whatever the widths
    #[arg(long, default_value = "auto", value_name = ARITHMETICS)]
    pub arithmetic: Arithmetic,
    /// With --arithmetic shadow: prove the first M impacts in higher precision, so that the start is nearer to the given one
    #[arg(long, value_name = "M", default_value_t = 0, value_parser = count(0..=u64::MAX))]
    splice: u64,
    /// Maximum precision of auto, in bits
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS, value_parser = bits())]
    pub max_bits: u32,
    /// Output format [default: as the ending of --output says, else table]
    #[arg(long, value_enum)]
    pub format: Option<Format>,
    #[command(flatten)]
    pub destination: Destination,
}

impl RunArguments {
    /// How the scene is to be run: by its table `[run]`, as far as the command line does not say otherwise.
    pub fn settings(&self, scene: &Scene) -> Settings {
        let run = Run { impacts: self.impacts, until: self.until.clone(), digits: self.digits };
        Settings { max_bits: self.max_bits, splice: self.splice, ..scene.settings_asked(run, self.arithmetic) }
    }
}

const PERIODIC_HELP: &str = "\
Examples:
  impact-pair periodic scenes/figure-15.toml --word RRLLL --cycles 1
  impact-pair periodic scenes/figure-13.toml --word \"P2 P1\" --cycles 1 --digits 30 --format json
  impact-pair periodic scenes/figure-13.toml --word RL --cycles 1 --all

Each orbit listed is proved to be the only one within its bounds. Admissible: no flight touches a wall before it \
ends; otherwise the orbit is virtual. Stable: both eigenvalues of the Jacobian of a period lie inside the unit \
circle; unstable: one lies outside. Without --all the search starts from the scene's own motion and from a grid of \
initial conditions, and there may be other orbits. Motions with sticking are not searched for, not even with --all: \
for e > 0 they have infinitely many impacts per period, or meet a wall with zero velocity exactly where the contact \
force sets in; for e = 0 each follows from a release, and run proves it from there.

Exit code: 0 everything requested is certified; 1 some of it is not: no orbit was found, or part of one is undecided \
or wider than --digits (the output still holds what is certified); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
pub struct PeriodicArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// The word, a sequence of mappings, the first one right-most ("P2 P4 P1 P3"), or of walls in time order (RRLL)
    #[arg(long, value_name = "WORD")]
    pub word: Word,
    /// The number of forcing periods 2 pi/W that the orbit takes; W is that of the fastest harmonic
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_CYCLES)))]
    pub cycles: u32,
    /// Search the whole state space, so that the list is complete up to orbits with sticking
    #[arg(long)]
    pub all: bool,
    /// Requested width of enclosures, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W
    /// [default: that of the scene, or 9]
    #[arg(long, value_name = "D", value_parser = digits())]
    digits: Option<u32>,
    /// Maximum precision, in bits
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS, value_parser = bits())]
    max_bits: u32,
    /// Output format; json is schema impact-pair/periodic/1 [default: as the ending of --output says, else
    /// table]
    #[arg(long, value_enum)]
    pub format: Option<PeriodicFormat>,
    #[command(flatten)]
    pub destination: Destination,
}

impl PeriodicArguments {
    /// How narrow the enclosures are asked to be.
    pub fn precision(&self, scene: &Scene) -> Precision {
        precision(self.digits, self.max_bits, scene)
    }
}

const BIFURCATION_HELP: &str = "\
Examples:
  impact-pair bifurcations scenes/cascade.toml --word RL --cycles 1 --over amplitude=0.3..0.499
  impact-pair bifurcations scenes/cascade.toml --word RL --cycles 1 --over gap=1.02..1.1
  impact-pair bifurcations scenes/square-wave.toml --word RL --cycles 5 --over amplitude.2=0..2

Orbits of the word are searched for at values spread over the range. Their branches are followed through folds, and \
so are the branches that leave at pitchforks and period doublings: the cascade. Each point listed is proved: exactly \
one such bifurcation lies within its bounds. Other bifurcations are not excluded. Only A/d and e matter: over \
frequency nothing bifurcates.

With several harmonics, --over amplitude.K=... varies the amplitude of term K, counted from 1. The frequencies must \
be commensurate, and N must be a whole number of common periods, counted in periods of the fastest harmonic. \
Pitchforks exist only if each harmonic changes sign over half the common period.

Exit code: 0 every change that was found is proved to the requested width; 1 some are not, a branch was lost, or the \
run was interrupted (the output still holds what is certified); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
pub struct BifurcationArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// The word, a sequence of mappings, the first one right-most ("P2 P4 P1 P3"), or of walls in time order (RRLL)
    #[arg(long, value_name = "WORD")]
    pub word: Word,
    /// The number of forcing periods 2 pi/W that the orbit takes
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_CYCLES)))]
    pub cycles: u32,
    /// The parameter and its range: amplitude (with several terms amplitude.K), gap, restitution or frequency
    #[arg(long, value_name = "KEY=LO..HI")]
    over: Over,
    /// Number of period doublings after which new branches are not followed further
    #[arg(long, value_name = "K", default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=8))]
    doublings: u32,
    /// Requested width of enclosures, at most 10^-D: of the parameter relative to itself, of phases relative to 2
    /// pi, of velocities relative to A W [default: that of the scene, or 9]
    #[arg(long, value_name = "D", value_parser = digits())]
    digits: Option<u32>,
    /// Maximum precision, in bits
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS, value_parser = bits())]
    max_bits: u32,
    /// Output format; json is schema impact-pair/bifurcations/1 [default: as the ending of --output
    /// says, else table]
    #[arg(long, value_enum)]
    pub format: Option<PeriodicFormat>,
    #[command(flatten)]
    pub destination: Destination,
}

impl BifurcationArguments {
    /// What is asked of the branches.
    pub fn wanted(&self, scene: &Scene) -> Wanted {
        let precision = precision(self.digits, self.max_bits, scene);
        Wanted { over: self.over.clone(), doublings: self.doublings, precision }
    }
}

/// How periodic orbits and bifurcations are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum PeriodicFormat {
    /// Human-readable: the certain digits, then the last digits of both bounds
    #[default]
    Table,
    /// One document of the schema named above
    Json,
}

const CHECK_EXIT_CODES: &str = "\
Exit code: 0 every claim is proved again; 1 a claim is refuted or undecided; 2 usage, bad input, I/O";

const CHECK_HELP: &str = "\
Examples:
  impact-pair run scenes/figure-14.toml --format json | impact-pair check -
  impact-pair run scenes/chatter.toml --format jsonl --output orbit.jsonl
  impact-pair check orbit.jsonl --format json

Each flight is followed again from the exact data of the certificate's own scene, by an independent method: in the \
units of the scene, by bisection, in one integer arithmetic whose precision rises until every claimed bound is \
decided. A claim is confirmed if the value found lies within its bounds, and refuted if it lies outside. JSON Lines \
are accepted as well.

For a shadowed orbit (run --arithmetic shadow), one start within the given bounds is proved to have all the impacts, \
each in its box: link by link, on all processors.

For periodic, two-impact and cycles, each orbit is proved again: existence and uniqueness within its bounds, \
stability, symmetry, and whether a wall is touched earlier. That there are no other orbits is not checked; for \
cycles, the counts are compared with the orbits listed. For bifurcations, each fold, pitchfork and period doubling \
is proved again, the grazes are not. For sweep, the listed impacts are proved again, the long-term outcome is not. \
For trap, the listed boxes are proved to be forward invariant. For chaos, each listed word is proved along chains of \
boxes computed anew, and the entropies are proved to follow from the words. For describe, the orbit and the region in \
it are proved again, and the fate is compared with theirs. Parameter manifolds are not checked. A \
separate line names the values that are not checked; with --format json each value of the document is listed among \
the claims with its verdict, or among those not checked. Ctrl-C keeps what is proved so far.

With --verified the program impact-pair-verified answers, if it is beside impact-pair or on PATH: its checker is \
extracted from a proof in Coq. It prints what an orbit JSON claims, and that it is verified, or why not: a document \
that claims more than the theorem covers, such as a rest, is not verified.

Exit code: 0 every claim is proved again, except those named as not checked; 1 a claim is refuted or undecided, or not \
verified; 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
pub struct CheckArguments {
    /// JSON of run or sweep (or JSON Lines), describe, periodic, two-impact, cycles, bifurcations, trap or chaos, or - for stdin
    pub certificate: PathBuf,
    /// Have the program impact-pair-verified, whose checker is extracted from its proof in Coq, check an orbit JSON instead
    #[arg(long, conflicts_with_all = ["effort", "format"])]
    pub verified: bool,
    /// Multiply the work allowed for each claim by TIMES before it is left undecided
    #[arg(long, value_name = "TIMES", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    pub effort: u64,
    /// Output format; json is schema impact-pair/check/1 [default: as the ending of --output says, else text]
    #[arg(long, value_enum)]
    pub format: Option<CheckFormat>,
    #[command(flatten)]
    pub destination: Destination,
}

/// How a verdict is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum CheckFormat {
    /// Human-readable: the verdict in one line, what is not checked in another
    #[default]
    Text,
    /// Each claim with its verdict, and the path of each value that is not checked
    Json,
}

impl CheckArguments {
    /// How much a check may take.
    pub fn effort(&self) -> Effort {
        let Effort { parts, work, .. } = Effort::default();
        let times = u32::try_from(self.effort).unwrap_or(u32::MAX);
        Effort { parts: parts.saturating_mul(times), work: work.saturating_mul(self.effort), ..Effort::default() }
    }
}

const PROVE_EXIT_CODES: &str = "\
Exit code: 0 the file proves all the impacts requested; 1 fewer of them; 2 usage, bad input, I/O";

const PROVE_HELP: &str = "\
Examples:
  impact-pair run scenes/figure-14.toml --format json | impact-pair prove - --output Figure14.v
  impact-pair run scenes/figure-12.toml --format json | impact-pair prove - --impacts 10

The theorem: for every start and all parameters that the scene allows there is exactly one sequence of impacts, each the \
first contact after the one before, on the listed walls, at times and velocities within the printed bounds. It covers \
the impacts up to the first graze, rest or release. Coq checks it on top of the library of validation/coq; nothing of \
impact-pair is trusted for that.

Exit code: 0 the file proves all the impacts requested (or those up to the first other event); 1 fewer of them; 2 usage, bad \
input, I/O.";

#[derive(Args, Debug)]
pub struct ProveArguments {
    /// Orbit JSON or JSON Lines, as written by run --format json or jsonl, or - for stdin
    pub certificate: PathBuf,
    /// Prove the first N impacts [default: all]
    #[arg(long, value_name = "N", value_parser = count(1..=u64::MAX))]
    pub impacts: Option<u64>,
    #[command(flatten)]
    pub destination: Destination,
}

const MAN_HELP: &str = "\
Examples:
  impact-pair man > impact-pair.1
  impact-pair man --output man";

#[derive(Args, Debug)]
pub struct ManArguments {
    /// Write a page for the program and one for each verb into DIR, which is created if needed
    #[arg(long, short, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

const COMPLETIONS_HELP: &str = "\
Examples:
  impact-pair completions bash > impact-pair.bash
  impact-pair completions zsh > _impact-pair";

/// How the events of an orbit are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Human-readable: the certain digits, then the last digits of both bounds
    #[default]
    Table,
    /// One document, schema impact-pair/orbit/1
    Json,
    /// JSON Lines as they are certified: the head, one event per line, the outcome
    Jsonl,
    /// One event per line, bounds in columns
    Csv,
}

/// The arithmetics, as they are typed.
pub const ARITHMETICS: &str = "auto|float|interval|inari|shadow|BITS";
/// The digits of the command line, or else of the scene, or else the usual ones.
fn precision(digits: Option<u32>, max_bits: u32, scene: &Scene) -> Precision {
    let digits = digits.or(scene.run().digits).unwrap_or(Precision::default().digits);
    Precision { digits, max_bits }
}

/// Reads a number of digits.
pub fn digits() -> impl Fn(&str) -> Result<u32, String> + Clone {
    let whole = count(u64::from(*DIGITS.start())..=u64::from(*DIGITS.end()));
    // exact: in the range of digits
    move |text| whole(text).map(|digits| digits as u32)
}

/// Reads a number of bits.
pub fn bits() -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(i64::from(*BITS.start())..=i64::from(*BITS.end()))
}

/// Reads how many: a whole number of this range.
pub fn count(range: RangeInclusive<u64>) -> impl Fn(&str) -> Result<u64, String> + Clone {
    move |text| match text.parse() {
        Ok(number) if range.contains(&number) => Ok(number),
        Ok(_) if *range.end() == u64::MAX => Err(format!("accepted are whole numbers from {} on", range.start())),
        Ok(_) => Err(format!("accepted are whole numbers from {} to {}", range.start(), range.end())),
        Err(_) => {
            // 1e5, 1,000
            let meant = Exact::parse(text).ok().and_then(|number| number.as_rational().map(ToString::to_string));
            let meant = meant.unwrap_or_else(|| text.replace([',', '_', ' ', '\''], ""));
            let hint = if meant.parse::<u64>().is_ok() { format!("; did you mean {meant}?") } else { String::new() };
            let range = match *range.end() {
                u64::MAX => String::new(),
                most => format!(" from {} to {most}", range.start()),
            };
            Err(format!("accepted are whole numbers{range}{hint}"))
        }
    }
}

/// Reads a single exact number.
pub fn point(text: &str) -> Result<Exact, String> {
    let unit = || match text.trim().split_once(' ') {
        Some((number, unit)) if Exact::parse(number).is_ok() && unit.trim().chars().all(char::is_alphabetic) => {
            format!("; numbers are in the units of the scene and have none of their own: did you mean {number}?")
        }
        _ => String::new(),
    };
    let number = Exact::parse(text).map_err(|error| format!("{error}{}", unit()))?;
    if number.is_point() { Ok(number) } else { Err("accepted is a single number, not an interval".into()) }
}

/// Reads a range on an axis of a picture: about what its ends are.
pub fn window(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| Ok::<f64, String>(point(text)?.enclose(64).mid_rad().0);
    let (low, high) = text.split_once("..").ok_or("accepted is a range such as 0.2..0.5")?;
    match (number(low)?, number(high)?) {
        (low, high) if low < high => Ok([low, high]),
        _ => Err("accepted is a range whose lower end comes first".into()),
    }
}
