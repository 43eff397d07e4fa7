//! The program `impact-pair`.

use std::process::ExitCode;

fn main() -> ExitCode {
    impact_pair_cli::main()
}
