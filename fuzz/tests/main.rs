//! All that reads, in one executable: a module each.

mod certificates;
mod events;
mod expressions;
mod extremes;
mod scenes;
