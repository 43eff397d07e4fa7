//! Threads and shards `I/N` by which the points of a grid are computed, and the points that exist already.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;

use impact_pair_answers::values::whole;

/// The points to compute, and the number of threads.
#[derive(Args, Debug)]
pub struct GridArguments {
    /// Number of threads [default: the number of processors]
    #[arg(long, value_name = "N", value_parser = whole(1..=4096))]
    pub threads: Option<u32>,
    /// Compute only the points of shard I of N; written as jsonl
    #[arg(long, value_name = "I/N", conflicts_with = "plot")]
    pub shard: Option<Shard>,
    /// Merge shards
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub merge: Vec<PathBuf>,
    /// Continue from FILE.partial, if it exists
    #[arg(long, requires = "output")]
    pub resume: bool,
}

impl GridArguments {
    /// The number of the shard, and of how many.
    pub fn shard(&self) -> Option<[u64; 2]> {
        self.shard.map(|shard| [shard.number, shard.of])
    }
}

/// One of several parts of a sweep or an atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 1.
    pub number: u64,
    pub of: u64,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = || {
            let (number, of) = text.split_once('/')?;
            let (number, of) = (number.parse().ok()?, of.parse().ok()?);
            (1..=of).contains(&number).then_some(Self { number, of })
        };
        numbers().ok_or_else(|| "accepted is I/N with I from 1 to N, such as 1/3".into())
    }
}
