//! The common part of `sweep` and `atlas`: points of a grid, computed by all threads or in shards, kept on disk, and written as tables.

#[cfg(feature = "parquet")]
pub mod parquet;
pub mod points;
mod shard;
pub mod work;

pub use points::Gathered;
pub use shard::GridArguments;
pub use work::{Tally, Work, answered, named, open_once};
