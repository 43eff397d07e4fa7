//! The command line: verbs and their help.

use clap::{Parser, Subcommand};
use clap_complete::Shell;
use impact_pair_answers::{
    AuditOptions, BifurcationOptions, ChaosOptions, CyclesOptions, DescribeOptions, GlobalOptions, PeriodicOptions,
    TangencyOptions, TradeOptions, TrapOptions, TwoImpactOptions, WindowsOptions,
};

use crate::atlas::arguments as atlas;
use crate::destination::{Destination, Drawing};
use crate::plot::arguments as plot;
use crate::sweep::arguments as sweep;
use crate::verb::Arguments;
use crate::{
    audit, bifurcations, chaos, check, cycles, describe, global, man, periodic, prove, run, tangency, trade, trap,
    two_impact, version, windows,
};

/// Verified numerics for the horizontal impact pair: every impact proved
#[derive(Debug, Parser)]
#[command(name = "impact-pair", version, long_version = version::text(), max_term_width = 100)]
#[command(after_help = EXIT_CODES, after_long_help = HELP)]
pub struct Cli {
    #[command(subcommand)]
    pub verb: Verb,
}

const EXIT_CODES: &str = "\
Exit code: 0 everything requested is certified; 1 some of it is not (the output still has the certified part); 2 \
usage, bad input, I/O";

const HELP: &str = "\
Examples:
  impact-pair run scenes/figure-14.toml
  impact-pair run scenes/figure-14.toml --impacts 1000 --digits 30 --format csv --output impacts.csv
  impact-pair help run

Exit code: 0 everything requested is certified; 1 some of it is not (the output still has the certified part); \
2 usage, bad input, I/O";

#[derive(Debug, Subcommand)]
pub enum Verb {
    /// List the certified impacts of a scene
    #[command(after_help = EXIT_CODES, after_long_help = run::HELP)]
    Run(run::RunArguments),
    /// Describe a motion: attracted, periodic, at rest or in a trapping region; its exponent, a horseshoe, the undecided questions
    #[command(after_help = describe::EXIT_CODES, after_long_help = describe::HELP)]
    Describe(Arguments<DescribeOptions, Drawing>),
    /// Prove the periodic orbits of a word of mappings, and their stability
    #[command(after_help = EXIT_CODES, after_long_help = periodic::HELP)]
    Periodic(Arguments<PeriodicOptions, Destination>),
    /// Prove the folds, pitchforks, period doublings and grazes of a word's orbits over a parameter
    #[command(after_help = EXIT_CODES, after_long_help = bifurcations::HELP)]
    Bifurcations(Arguments<BifurcationOptions, Destination>),
    /// Prove a trapping region of a scene: no sticking, no complete chatter, bounds for all time
    #[command(after_help = EXIT_CODES, after_long_help = trap::HELP)]
    Trap(Arguments<TrapOptions, Drawing>),
    /// Prove chaos: a horseshoe by covering relations, and a lower bound of the topological entropy
    #[command(after_help = EXIT_CODES, after_long_help = chaos::HELP)]
    Chaos(Arguments<ChaosOptions, Drawing>),
    /// Find all periodic orbits with N impacts in a trapping region, and whether one attracts
    #[command(after_help = EXIT_CODES, after_long_help = cycles::HELP)]
    Cycles(Arguments<CyclesOptions, Destination>),
    /// Find stable periodic orbits near a scene over a parameter, and prove each with its window: both ends, and the orbits between
    #[command(after_help = EXIT_CODES, after_long_help = windows::HELP)]
    Windows(Arguments<WindowsOptions, Drawing>),
    /// Prove where every motion goes, for every start: cycles with rests, attracting periodic orbits, saddles
    #[command(after_help = EXIT_CODES, after_long_help = global::HELP)]
    Global(Arguments<GlobalOptions, Drawing>),
    /// Prove where every motion goes over two parameters, at the points of a grid or for all parameters of cells
    #[command(after_help = atlas::EXIT_CODES, after_long_help = atlas::HELP)]
    Atlas(atlas::AtlasArguments),
    /// Prove homoclinic tangencies of the equispaced motion over a parameter
    #[command(after_help = EXIT_CODES, after_long_help = tangency::HELP)]
    Tangency(Arguments<TangencyOptions, Drawing>),
    /// Prove every claim of a JSON document again, by an independent method, from its own numbers
    #[command(after_help = check::EXIT_CODES, after_long_help = check::HELP)]
    Check(check::CheckArguments),
    /// Write a Coq file whose theorem states the claims of an orbit JSON
    #[command(after_help = prove::EXIT_CODES, after_long_help = prove::HELP)]
    Prove(prove::ProveArguments),
    /// Certify an orbit at each point of a grid of parameters or initial data: bifurcation diagrams, exponents, basins
    #[command(after_help = sweep::EXIT_CODES, after_long_help = sweep::HELP)]
    Sweep(sweep::SweepArguments),
    /// Measure the cost of accuracy on a scene: speed, reach and widths of each arithmetic, and the true errors of floating point
    #[command(after_help = trade::EXIT_CODES, after_long_help = trade::HELP)]
    Trade(Arguments<TradeOptions, Drawing>),
    /// Draw the paper's figures for a scene from certified orbits, as SVG, PNG or PDF
    #[command(after_help = EXIT_CODES, after_long_help = plot::HELP)]
    Plot(plot::PlotArguments),
    /// Find the motions with two impacts in N cycles: closed forms (61)-(73), all others, first contacts, stability
    #[command(after_help = two_impact::EXIT_CODES, after_long_help = two_impact::HELP)]
    TwoImpact(Arguments<TwoImpactOptions, two_impact::ManifoldDrawing>),
    /// Compare another simulator's list of impacts with the certified orbit: inside, outside, missed, false; where it diverges
    #[command(after_help = audit::EXIT_CODES, after_long_help = audit::HELP)]
    Audit(Arguments<AuditOptions, Destination>),
    /// Print the manual page, or write the pages of all verbs into a directory
    #[command(after_long_help = man::HELP)]
    Man(man::ManArguments),
    /// Print a completion script for a shell
    #[command(after_long_help = COMPLETIONS_HELP)]
    Completions {
        /// The shell
        shell: Shell,
    },
}

const COMPLETIONS_HELP: &str = "\
Examples:
  impact-pair completions bash > impact-pair.bash
  impact-pair completions zsh > _impact-pair";
