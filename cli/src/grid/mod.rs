//! The common part of `sweep` and `atlas`: points of a grid, computed by all threads or in shards, kept on disk, and written as tables.

mod format;
#[cfg(feature = "parquet")]
mod parquet;
mod shard;
mod work;

pub use format::{GridFormat, format, format_of_states, write};
pub use shard::GridArguments;
pub use work::{compute, merge, open_once};
