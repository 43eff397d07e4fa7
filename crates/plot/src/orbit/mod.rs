//! An orbit in the eight panels of figures 12-17.

mod curves;
mod figure;
mod frame;
mod panel;
mod recorder;
mod sheet;
mod style;
mod symbols;
mod trace;

pub use figure::Figure;
pub(crate) use frame::Frame;
pub use frame::{Caption, Panel};
pub(crate) use panel::{draw as panel, title};
pub use recorder::{Recorder, end_of};
pub use sheet::Sheet;
pub use style::Style;
pub(crate) use symbols::explain;
pub use trace::Trace;

#[cfg(test)]
mod tests;
