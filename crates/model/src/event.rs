//! The kinds of events of an orbit.

use crate::Mapping;

/// The kind of an event of an orbit, with bounds of type `B` in the units of the scene.
#[derive(Clone, Debug)]
pub enum EventKind<B> {
    /// The ball hits the wall.
    Impact {
        /// Counts the impacts from 1.
        index: u64,
        /// The mapping that led here; `None` for the first contact of a start inside the gap, and where a graze of the other
        /// wall may have been a touch.
        mapping: Option<Mapping>,
        /// The relative velocity `y'` just before the impact \[length/time\].
        velocity: B,
    },
    /// The wall is touched with zero velocity, or nearly so, or nearly touched.
    Graze {
        /// Size of the graze; `None` in older documents.
        miss: Option<Miss<B>>,
    },
    /// The ball comes to rest on the wall.
    Rest {
        /// After infinitely many impacts that are not listed.
        is_accumulation: bool,
    },
    /// The ball leaves the wall that it rested on.
    Release,
}

/// Size of a graze, with bounds of type `B` in the units of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Miss<B> {
    /// Distance by which the wall is missed at the extremum of the flight \[length\], negative where the extremum lies beyond the wall.
    pub distance: B,
    /// Speed at which the wall may be touched \[length/time\]: from 0 to an upper bound.
    pub speed: B,
}

impl<B> EventKind<B> {
    /// Whether the event is an impact.
    pub fn is_impact(&self) -> bool {
        matches!(self, Self::Impact { .. })
    }
}
