//! Global analysis of a pair: the components that all its motions end in. Lemmas A1-A14 of `docs/proofs/global.md#A1`.
//!
//! Boxes cover the speeds that motions have in the end. `image` encloses all that may follow each box; `graph` finds the components that motions
//! may stay in for ever; `analysis` refines each component alone. `cycle` proves the limits of their motions. Where no limit is
//! proved, `attractors` and `horseshoes` look inside. `basins` finds the boxes whose motions all go to one attractor.

mod analysis;
mod attractors;
mod basins;
mod cycle;
mod document;
mod graph;
mod horseshoes;
mod image;
mod known;
mod saddles;
#[cfg(test)]
mod tests;
mod walks;

use impact_pair_model::require_digits;

use super::horseshoe::Horseshoe;
use super::law::Law;
use crate::exact::Exact;
use crate::pair::{ImpactPair, too_large};
use crate::periodic::Precision;
use crate::units;
use crate::watch::Watch;
use crate::{Effort, Error};
use analysis::{Analysis, Request};
pub use basins::{Basin, BasinOutcome, Patch};
pub(super) use cycle::closed;
use image::Space;
pub use impact_pair_model::vocabulary::{Class, OpenReason};
use known::Released;
pub use known::{Kind, LimitCycle, RestCycle};

/// The settings of a global analysis.
#[derive(Clone, Copy, Debug)]
pub struct GlobalSettings {
    /// Boxes of the first partition, about: a power of two from 2^8 to 2^20.
    pub boxes: u32,
    /// Number of times that the boxes of a component are halved at most, up to 40.
    pub halvings: u32,
    /// Boxes whose images are computed in all, about.
    pub most: usize,
    /// The work of their images in all, about: views of flights, columns that long flights may land in, and boxes that are noted; as much
    /// again is allowed for those of basins.
    pub work: u64,
    /// Boxes by which basins are proved, about, if they are requested: a power of two from 2^8 to 2^24.
    pub basins: Option<u32>,
    /// The most impacts of words of horseshoes, if these are looked for in components of which nothing else is decided.
    pub horseshoes: Option<usize>,
    /// Requested widths of the enclosures of periodic orbits.
    pub precision: Precision,
}

impl Default for GlobalSettings {
    fn default() -> Self {
        Self {
            boxes: 1 << 14,
            halvings: Self::MOST_HALVINGS,
            most: 300_000,
            work: 100_000_000,
            basins: None,
            horseshoes: None,
            precision: Precision::default(),
        }
    }
}

impl GlobalSettings {
    /// Boxes by which basins are proved, where no other number is requested.
    pub const USUAL_BASINS: u32 = 1 << 16;
    /// Accepted logarithms to base 2 of the boxes of the first partition.
    const BOXES: (u32, u32) = (8, 20);
    /// The most halvings.
    const MOST_HALVINGS: u32 = 40;
    /// Accepted logarithms to base 2 of the boxes of basins.
    const BASINS: (u32, u32) = (8, 24);

    /// These limits with an effort: so many times the boxes and their work, with partitions rounded down to powers of two. Each doubling allows one
    /// halving of a component's boxes more; below 1 there are no fewer, as fewer boxes end it first.
    #[must_use]
    pub fn with_effort(self, effort: Effort) -> Self {
        let power = |boxes: u32, accepted| 1 << effort.doubled(boxes.ilog2(), accepted);
        Self {
            boxes: power(self.boxes, Self::BOXES),
            halvings: effort.doubled(self.halvings, (self.halvings, Self::MOST_HALVINGS)),
            most: usize::try_from(effort.times(self.most as u64)).unwrap_or(usize::MAX), // proposes: when to give up
            work: effort.times(self.work),
            basins: self.basins.map(|boxes| power(boxes, Self::BASINS)),
            ..self
        }
    }

    /// Refuses settings that no analysis is made with.
    fn require_accepted(&self) -> Result<(), Error> {
        let boxes = [("boxes", Some(self.boxes), Self::BOXES), ("basins", self.basins, Self::BASINS)];
        for (key, number, accepted) in boxes {
            let (least, most) = accepted;
            if let Some(number) = number.filter(|n| !(n.is_power_of_two() && (least..=most).contains(&n.ilog2()))) {
                let message = format!("{key} is {number}, but must be a power of two from 2^{least} to 2^{most}");
                return Err(Error::out_of_range(key, message));
            }
        }
        let halvings = Exact::from(i64::from(self.halvings));
        Error::require_range("halvings", &halvings, 0, Self::MOST_HALVINGS.into())?;
        require_digits(self.precision.digits)
    }

    /// The usual limits for one of many points of two parameters: fewer halvings.
    pub fn of_point() -> Self {
        Self { halvings: 18, ..Self::default() }
    }

    /// The usual limits for one of many cells: fewer boxes, less work.
    pub fn of_cell() -> Self {
        Self { boxes: 1 << 12, most: 20_000, work: 5_000_000, ..Self::of_point() }
    }
}

/// A set of states that motions may stay in for ever.
#[derive(Clone, Debug)]
pub struct Recurrence {
    /// The behaviour of the motions that stay in it, as far as it is proved.
    pub kind: Kind,
    /// Number of its boxes; 0 of the motion from the release alone, and of an attractor in an undecided component.
    pub boxes: usize,
    /// The part of the state space that they cover.
    pub area: f64,
    /// `true` if its motions are never in another component later, apart from an attractor inside it: it is an attracting block.
    pub is_closed: bool,
    /// The limit that stopped its refinement, if nothing is proved of it.
    pub reason: Option<OpenReason>,
    /// The horseshoe that is proved to be in it, of one of which nothing else is.
    pub horseshoe: Option<Horseshoe>,
}

impl Recurrence {
    /// The component of a motion that has no boxes of its own.
    fn point(kind: Kind) -> Self {
        Self { kind, boxes: 0, area: 0.0, is_closed: true, reason: None, horseshoe: None }
    }
}

/// The components that all motions of a pair end in.
///
/// **Enclosure**: for every member of the data the impacts of every motion that touches a wall are in one component in the end, or the
/// motion rests for ever again and again; of each component holds what its [`Kind`] says. Lemmas A1-A14
#[derive(Clone, Debug)]
pub struct Global {
    /// The components, those first from which motions may go on to others.
    pub components: Vec<Recurrence>,
    /// `[i, j]`: motions may go from component `i` to component `j`, as far as the boxes can distinguish.
    pub order: Vec<[usize; 2]>,
    /// The boxes of components, and if basins were requested, the state space in rectangles, each with where its motions go.
    pub patches: Vec<Patch>,
    /// The greatest speed over `A W` that motions have in the end.
    pub fastest: f64,
    /// Factor from speeds in gap widths per forcing period to those over `A W`: about, for pictures.
    pub speed_unit: f64,
    /// `true` if it was interrupted: components may not be refined.
    pub interrupted: bool,
}

impl Global {
    /// Proved part of the basin of each attractor, if basins were requested.
    pub fn basins(&self) -> Option<Vec<Basin>> {
        basins::basins(&self.components, &self.patches, self.fastest)
    }

    /// Finds the ends of all motions of a pair, until the watch stops the analysis.
    ///
    /// # Errors
    /// With settings that are not accepted, several harmonics, or a restitution that is not below 0.99, and when a value is beyond the range
    /// of double-precision flights.
    pub fn of(pair: &ImpactPair, settings: &GlobalSettings, watch: &dyn Watch) -> Result<Self, Error> {
        settings.require_accepted()?;
        let space = Self::space(pair)?;
        let speed_unit = 1.0 / space.law().beta().expect("a gap is larger than 0").mid(); // shown
        let released = Released::of(pair, &space)?;
        let analysis = Analysis::of(Request { pair, space, released, settings, watch });
        let (mut components, mut order) = (analysis.components(), analysis.order());
        for (place, limit) in analysis.attractors_within(&components) {
            order.push([place, components.len()]);
            components.push(Recurrence::point(Kind::Attracting(limit)));
        }
        let patches = analysis.patches(&components, settings.basins);
        let is_open = components.iter().any(|component| component.kind.is_undecided());
        let is_cut = is_open && settings.horseshoes.is_some() && !watch.goes_on();
        Ok(Self {
            components,
            order,
            patches,
            fastest: space.fastest(),
            speed_unit,
            interrupted: analysis.is_interrupted() || is_cut,
        })
    }

    /// Whether [`of`](Self::of) accepts a pair.
    ///
    /// # Errors
    /// As of [`of`](Self::of).
    pub fn accepts(pair: &ImpactPair) -> Result<(), Error> {
        Self::space(pair).map(drop)
    }

    fn space(pair: &ImpactPair) -> Result<Space, Error> {
        let law = Law::of(pair)?;
        if law.beta().is_none() {
            return Err(too_large(units::RATIO, &units::ratio(pair)?));
        }
        Space::new(law).ok_or_else(|| {
            let said =
                format!("pair.restitution is {}, but must be below 0.99 for a global analysis", pair.restitution());
            Error::out_of_range("pair.restitution", said)
        })
    }

    /// Class of the pair, from the kinds of all components.
    pub fn class(&self) -> Class {
        let count = |is: fn(&Kind) -> bool| self.components.iter().filter(|component| is(&component.kind)).count();
        let attractors = count(Kind::is_attractor);
        let undecided = count(Kind::is_undecided);
        let rests = count(|kind| matches!(kind, Kind::RestCycle(_)));
        // That all states are in the whole state space says nothing.
        let is_proper = |component: &Recurrence| component.is_closed && component.area < 1.0; // exact: 1 where it is all boxes
        let closed = self.components.iter().all(|component| !component.kind.is_undecided() || is_proper(component));
        match (attractors, undecided) {
            (1, 0) if rests == 1 && self.components.len() == 1 => Class::OneRestCycle,
            (1, 0) => Class::OneAttractor,
            (0, 1..) if closed => Class::Closed,
            (1.., _) => Class::Attractors,
            _ => Class::Undecided,
        }
    }
}
