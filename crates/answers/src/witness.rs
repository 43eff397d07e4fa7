//! Whether a document carries its witness.

use clap::Args;

/// Option of the verbs whose documents carry a witness: data that `check` proves claims with, and that claim nothing themselves.
#[derive(Args, Clone, Copy, Debug)]
pub struct WitnessOptions {
    /// Leave the witness out of the JSON: the document is shorter, and check proves less of it
    #[arg(long)]
    pub no_witness: bool,
}
