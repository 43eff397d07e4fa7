//! The periodic orbit that the orbit of a point converges to.

use impact_pair_document::SweepImpact;

use super::unit::Unit;
use crate::exact::Enclosure;
use crate::lyapunov::{Passed, limit};
use crate::mapping::Word;
use crate::orbit::Orbit;
use crate::pair::Wall;
use crate::periodic::{Attractor, PeriodicImpact};
use crate::units::in_radians;

/// The stable periodic orbit that an orbit is proved to converge to, measured from one of its impacts on.
///
/// That impact makes the word the first one in the alphabet of L and R; of several, the earliest in its cycle. So two
/// orbits that converge to the same one have the same word, and bounds that overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct Attraction {
    /// The word, from that impact on.
    pub word: Word,
    /// The impact; `None` where its phase is another one of the reference in each period, as where that does not move the box.
    pub first: Option<SweepImpact<Enclosure>>,
    /// The impact of the orbit from which on it is in a neighbourhood that the period contracts.
    pub from: u64,
    /// Bounds of what the exponent per impact tends to; `None` after a graze, where there is no derivative. Lemma L4
    pub limit: Option<[f64; 2]>,
}

/// The attractor measured from the impact that [`Attraction`] names.
pub(super) fn attraction(orbit: &Orbit, attractor: &Attractor, unit: &Unit, passed: Passed) -> Attraction {
    let Attractor { word, orbit: periodic, from, .. } = attractor;
    let impacts = &periodic.impacts;
    let rotated = |shift: usize| impacts.iter().cycle().skip(shift).take(impacts.len());
    let in_reference = |impact: &PeriodicImpact| unit.recurring(&impact.phase, periodic.bits);
    let own = |impact: &PeriodicImpact| in_radians(&impact.phase, periodic.bits);
    let is_right = |shift| rotated(shift).map(|impact| impact.wall == Wall::Right).collect::<Vec<_>>();
    let earlier = |a: &usize, b: &usize| {
        let phase = |shift: usize| in_reference(&impacts[shift]).unwrap_or_else(|| own(&impacts[shift])).mid_rad().0;
        is_right(*a).cmp(&is_right(*b)).then_with(|| phase(*a).total_cmp(&phase(*b)))
    };
    let shift = (0..impacts.len()).min_by(earlier).expect("a word has impacts");
    let mut mappings = word.mappings().to_vec();
    mappings.rotate_left(shift);
    let first = &impacts[shift];
    let velocity = orbit.clock().velocity(&first.velocity);
    Attraction {
        word: Word::new(mappings).expect("a closed word can be rotated"),
        first: in_reference(first).map(|phase| SweepImpact {
            index: 1 + shift as u64,
            wall: first.wall,
            phase,
            velocity,
        }),
        from: *from,
        limit: limit(periodic, passed),
    }
}
