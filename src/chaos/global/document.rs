//! The JSON of a global analysis.

use impact_pair_document::{
    BasinDocument, BasinsDocument, Bounds, ComponentDocument, Decimal, GLOBAL_SCHEMA, GlobalDocument, HorseshoeWitness,
    PROGRAM, PeriodicOrbitDocument, ProvedHorseshoeDocument, SceneDocument, UpTo, bounds,
};

use super::known::spectral_radius;
use super::{Basin, Class, Global, GlobalSettings, Kind, Recurrence};
use crate::chaos::document::{base, entropy, strip, word};
use crate::chaos::horseshoe::Horseshoe;
use crate::exact::{Enclosure, decimal_f64};
use crate::units::Units;
use crate::{Error, Scene};

/// Areas are written in these parts of the state space.
const PARTS: f64 = 1e6;
/// Bits of bounds that are read from decimals.
const BITS: u32 = 256;

impl Global {
    /// Returns the document of where the motions of a scene's pair go.
    ///
    /// # Errors
    /// If a value exceeds the range of exact expressions.
    pub fn document(&self, scene: &Scene, settings: &GlobalSettings) -> Result<GlobalDocument, Error> {
        let class = self.class();
        let document = GlobalDocument {
            schema: GLOBAL_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            certified: !self.interrupted && matches!(class, Class::OneRestCycle | Class::OneAttractor),
            scene: SceneDocument::new(scene.pair(), scene.start()),
            class,
            statement: String::new(),
            greatest_speed: Decimal::printed(decimal_f64(self.fastest)),
            boxes: settings.boxes,
            halvings: settings.halvings,
            interrupted: self.interrupted,
            components: self.components.iter().map(|own| component(own, settings)).collect::<Result<_, _>>()?,
            order: self.order.iter().map(|pair| pair.map(|i| i as u32)).collect(),
            basins: settings.basins.and_then(|boxes| basins(boxes, self)),
        };
        Ok(document.with_statement())
    }
}

/// The basins of the attractors, if there are any. Lemma A11: in whole parts of the state space, rounded so that no more is proved
fn basins(boxes: u32, found: &Global) -> Option<BasinsDocument> {
    let proved = found.basins()?;
    let parts = |area: f64| if area < 1.0 { (area * PARTS).next_down().max(0.0).floor() as u32 } else { PARTS as u32 };
    let written = |parts: u32| Decimal::printed(format!("{:.6}", f64::from(parts) / PARTS));
    let areas: Vec<u32> = proved.iter().map(|basin| parts(basin.area)).collect();
    let undecided = (PARTS as u32).saturating_sub(areas.iter().sum()); // A11: what is left of the whole
    let of =
        |(basin, &parts): (&Basin, &u32)| BasinDocument { component: basin.component as u32, area: written(parts) };
    let areas: Vec<BasinDocument> = proved.iter().zip(&areas).map(of).collect();
    (!areas.is_empty()).then(|| BasinsDocument { boxes, areas, undecided: written(undecided) })
}

fn component(found: &Recurrence, settings: &GlobalSettings) -> Result<ComponentDocument, Error> {
    let limit = found.kind.limit();
    let orbit =
        limit.map(|limit| Ok(Units::gaps(limit.problem.pair())?.orbit(&limit.problem, &limit.orbit))).transpose()?;
    let (cycles, alternates) = match found.kind {
        Kind::RestCycle(rest) => (rest.map(|rest| rest.cycles), rest.map(|rest| rest.alternates)),
        _ => (limit.map(|limit| limit.problem.chain().cycles()), None),
    };
    Ok(ComponentDocument {
        kind: found.kind.kind(),
        reduced_impacts: limit.map(|limit| limit.impacts as u32),
        word: limit.map(|limit| limit.problem.word().to_string()),
        cycles,
        spectral_radius: orbit.as_ref().zip(limit).and_then(|(orbit, limit)| radius(orbit, limit.impacts)),
        alternates,
        boxes: found.boxes as u64,
        area: Decimal::printed(format!("{:.6}", found.area)),
        closed: found.is_closed,
        reason: found.reason,
        horseshoe: found.horseshoe.as_ref().zip(settings.horseshoes).map(|(found, depth)| horseshoe(found, depth)),
        orbit,
    })
}

/// Returns the document of a horseshoe of words of at most N impacts.
pub(super) fn horseshoe(found: &Horseshoe, depth: usize) -> ProvedHorseshoeDocument {
    let bases = found.bases.iter().map(base).collect();
    let words = found.words.iter().map(word).collect();
    let witness = HorseshoeWitness { words, strips: found.strips.iter().map(strip).collect() };
    ProvedHorseshoeDocument {
        depth: UpTo::counted(depth),
        entropy: entropy(found.entropy),
        bases,
        witness: Some(witness),
    }
}

/// Bounds of the spectral radius, by the bounds of the eigenvalues as they are printed: these hold it, whoever computes it from them.
fn radius(orbit: &PeriodicOrbitDocument, reduced: usize) -> Option<Bounds> {
    let read = |bounds: &Bounds| {
        let [low, high] = bounds.values().map(|bound| Enclosure::from_rational(&bound, BITS));
        low.hull(&high)
    };
    let eigenvalues = orbit.eigenvalues.as_ref()?.each_ref().map(|value| [read(&value.re), read(&value.im)]);
    let radius = spectral_radius(eigenvalues.each_ref().map(<[_; 2]>::each_ref), orbit.impacts.len() / reduced)?;
    Some(bounds(&radius))
}
