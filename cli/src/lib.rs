//! Command line of impact-pair: certified orbits of the horizontal impact pair.
//!
//! A library, so that it is compiled while the library that it calls is still being optimised.

mod arguments;
mod atlas;
mod audit;
mod bifurcations;
mod chaos;
mod check;
mod cycles;
mod describe;
mod destination;
mod ending;
mod global;
mod grid;
mod man;
mod output;
mod periodic;
mod plot;
mod progress;
mod prove;
mod run;
mod scene;
mod sweep;
mod tangency;
mod trade;
mod trap;
mod two_impact;
mod verb;
mod verified;
mod version;
mod windows;

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, Error, Result};
use clap::builder::Styles;
use clap::builder::styling::Style;
use clap::error::{ContextKind, ContextValue};
use clap::{Arg, Command, CommandFactory, FromArgMatches};
use clap_complete::Shell;

use arguments::{Cli, Verb};

/// The meaning of the exit code.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Answer {
    /// All that was asked is certified, or no proof was requested.
    Complete,
    /// Some of it is not.
    Incomplete,
}

/// Runs the program with the arguments of the process; returns its exit code.
pub fn main() -> ExitCode {
    let given = command().try_get_matches().and_then(|matches| Cli::from_arg_matches(&matches));
    let verb = match given {
        Ok(cli) => cli.verb,
        Err(error) => return parser_output(&with_a_verb(error)),
    };
    let answer = match verb {
        Verb::Run(arguments) => run::run(&arguments),
        Verb::Describe(arguments) => verb::answer(arguments),
        Verb::Periodic(arguments) => verb::answer(arguments),
        Verb::Bifurcations(arguments) => verb::answer(arguments),
        Verb::Trap(arguments) => verb::answer(arguments),
        Verb::Chaos(arguments) => verb::answer(arguments),
        Verb::Cycles(arguments) => verb::answer(arguments),
        Verb::Windows(arguments) => verb::answer(arguments),
        Verb::Global(arguments) => verb::answer(arguments),
        Verb::Atlas(arguments) => atlas::atlas(&arguments),
        Verb::Tangency(arguments) => verb::answer(arguments),
        Verb::Check(arguments) => check::check(&arguments),
        Verb::Prove(arguments) => prove::prove(&arguments),
        Verb::Plot(arguments) => plot::plot(&arguments),
        Verb::Sweep(arguments) => sweep::sweep(&arguments),
        Verb::Trade(arguments) => verb::answer(arguments),
        Verb::TwoImpact(arguments) => verb::answer(arguments),
        Verb::Audit(arguments) => verb::answer(arguments),
        Verb::Man(arguments) => man::man(Cli::command(), &arguments),
        Verb::Completions { shell } => completions(shell),
    };
    finished(answer)
}

/// Reports the error of an answer, if it is one, and returns the exit code.
fn finished(answer: Result<Answer>) -> ExitCode {
    match answer {
        Ok(Answer::Complete) => ExitCode::SUCCESS,
        Ok(Answer::Incomplete) => ExitCode::from(1),
        // A reader that closes the pipe has read enough.
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            report_error(&error);
            ExitCode::from(2)
        }
    }
}

/// Writes the help, the version or the error of the parser, and returns the exit code: help and version are data, which must not be lost.
fn parser_output(parser: &clap::Error) -> ExitCode {
    match parser.print() {
        Err(failed) if !parser.use_stderr() => finished(Err(failed).context("cannot write to stdout")),
        // Nobody may be listening.
        _ if parser.use_stderr() => ExitCode::from(2),
        _ => ExitCode::SUCCESS,
    }
}

/// The command line, where a negative number is a value of the option before it: that option's error says what is accepted.
fn command() -> Command {
    let reads_negative = |argument: Arg| {
        let is_option = !argument.is_positional() && argument.get_action().takes_values();
        if is_option { argument.allow_negative_numbers(true) } else { argument }
    };
    Cli::command().mut_subcommands(|verb| verb.mut_args(reads_negative))
}

/// The parser's error, with the command that was perhaps meant where a scene stands in the place of a verb.
fn with_a_verb(mut error: clap::Error) -> clap::Error {
    if let Some(ContextValue::String(given)) = error.get(ContextKind::InvalidSubcommand)
        && (given.ends_with(".toml") || Path::new(given).exists())
    {
        let tip = format!("the verb comes before the scene: impact-pair run {given}").into();
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip]));
    }
    if let Some(ContextValue::String(given)) = error.get(ContextKind::InvalidArg)
        && ["--precision", "--accuracy", "--prec"].contains(&given.as_str())
    {
        let tip = "widths are set by --digits D: at most 10^-D; bits by --arithmetic BITS".to_owned().into();
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip]));
    }
    error
}

/// Writes the error in the colours of the argument parser, with the line of the scene file that is at fault.
fn report_error(error: &Error) {
    let (word, place) = (style(Styles::get_error), style(Styles::get_literal));
    let excerpt = error.chain().find_map(|cause| cause.downcast_ref::<impact_pair::Error>()?.excerpt());
    let excerpt = excerpt.map(|excerpt| format!("\n{place}{excerpt}{place:#}")).unwrap_or_default();
    // Nobody may be listening.
    let _ = writeln!(anstream::stderr(), "{word}error:{word:#} {}{excerpt}", message_of(error));
}

fn style(of: impl Fn(&Styles) -> &Style) -> Style {
    *of(&Styles::default())
}

/// The error and its causes, down to one of the library, whose message tells what it comes from.
fn message_of(error: &Error) -> String {
    let ours = error.chain().position(|cause| cause.is::<impact_pair::Error>());
    let message_of = error.chain().take(ours.map_or(usize::MAX, |last| last + 1));
    message_of.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

fn is_broken_pipe(error: &Error) -> bool {
    error.chain().filter_map(|cause| cause.downcast_ref::<io::Error>()).any(|e| e.kind() == io::ErrorKind::BrokenPipe)
}

fn completions(shell: Shell) -> Result<Answer> {
    let mut command = Cli::command();
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut command, name, &mut script);
    io::stdout().write_all(&script).context("cannot write to stdout")?;
    Ok(Answer::Complete)
}
