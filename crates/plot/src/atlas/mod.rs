//! An atlas: the plane of two parameters in the colours of what is proved of every motion, as a picture and as a page.

mod curves;
mod leaves;
mod map;
mod page;

pub use map::svg;
pub use page::html;
