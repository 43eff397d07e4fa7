//! The periodic orbit that the orbit of a point converges to.

use impact_pair::json::SweepImpact;

use impact_pair::exact::Enclosure;
use impact_pair::lyapunov::{Passed, limit};
use impact_pair::mapping::Word;
use impact_pair::orbit::{Orbit, Reference};
use impact_pair::pair::Wall;
use impact_pair::periodic::{Attractor, PeriodicImpact};
use impact_pair::units::in_radians;

/// Stable periodic orbit that an orbit is proved to converge to, measured from one of its impacts on.
///
/// This impact makes the word the first one in the alphabet of L and R; of several such impacts, it is the earliest in its cycle. So two orbits
/// that converge to the same periodic orbit have the same word, and bounds that overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct Attraction {
    /// The word, from that impact on.
    pub word: Word,
    /// First impact of the word; `None` where the reference's phase of this impact differs from period to period.
    pub first: Option<SweepImpact<Enclosure>>,
    /// Impact of the orbit from which on the orbit is in a neighbourhood that the period contracts.
    pub from: u64,
    /// Bounds of the limit of the exponent per impact; `None` after a graze, where there is no derivative. Lemma L4
    pub limit: Option<[f64; 2]>,
}

/// The attractor, measured from the first impact of [`Attraction`].
pub(super) fn attraction(orbit: &Orbit, attractor: &Attractor, unit: &Reference, passed: Passed) -> Attraction {
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
