//! The JSON of all cycles of a region.

use std::ops::RangeInclusive;

use impact_pair_document::{
    Between, CYCLES_SCHEMA, CycleDocument, CyclesDocument, OpenCycleDocument, PROGRAM, SceneDocument,
};

use super::{Cycle, Cycles};
use crate::chaos::NoTrap;
use crate::periodic::Region;
use crate::units::Units;
use crate::{Error, Scene};

impl Cycles {
    /// Returns the document of the cycles of a scene, or the reason why no region is proved.
    ///
    /// # Errors
    /// If a value exceeds the range of exact expressions.
    pub fn document(
        scene: &Scene,
        requested: &RangeInclusive<u32>,
        found: Result<&Self, NoTrap>,
    ) -> Result<CyclesDocument, Error> {
        let units = Units::gaps(scene.pair())?;
        let cycle = |cycle: &Cycle| {
            let period = (cycle.problem.word().to_string(), cycle.problem.chain().cycles());
            CycleDocument::of(cycle.impacts as u32, period, units.orbit(&cycle.problem, &cycle.orbit))
        };
        let open = |(impacts, region): &(usize, Region)| OpenCycleDocument {
            reduced_impacts: *impacts as u32,
            impacts: region.impacts.iter().map(|impact| units.impact(impact, (f64::MANTISSA_DIGITS, 1))).collect(),
            reason: region.reason,
        };
        let all = found.ok();
        let (cycles, undecided) = (all.map_or(&[][..], Self::cycles), all.map_or(&[][..], Self::undecided));
        let counts = all.map(Self::fixed_points).into_iter().flatten();
        Ok(CyclesDocument {
            schema: CYCLES_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            certified: all.is_some_and(Self::is_certified),
            exhaustive: all.is_some_and(Self::is_exhaustive),
            scene: SceneDocument::new(scene.pair(), scene.start()),
            reason: found.err().map(|why| why.words().to_owned()),
            boxes: all.map_or(0, |all| all.trap().boxes() as u64),
            impacts: Between::computed([*requested.start(), *requested.end()]),
            fixed_points: counts.map(|(&impacts, &count)| (impacts as u32, count as u64)).collect(),
            no_attractor: all.is_some_and(Self::has_no_attractor),
            orbits: cycles.iter().map(cycle).collect(),
            undecided: undecided.iter().map(open).collect(),
        })
    }
}
