//! How far double precision can be trusted on this scene: impact-pair's own float orbit, judged as any other list.
//!
//! That it is outside is proved of this orbit alone. Other orbits in doubles round differently; the growth of their
//! errors is the scene's.

use std::ops::ControlFlow;

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::exact::{Enclosure, decimal_f64};
use impact_pair::orbit::{Arithmetic, Settings};
use num_rational::BigRational;

use super::judge::Judgement;
use super::list::{Listed, Number};
use super::tolerance::Tolerance;
use super::truth::{Site, SiteKind, Truth};
use super::verdict::Verdict;
use crate::follow::follow_impacts;
use crate::progress::Progress;

/// What is found of the float orbit, by impacts of the truth up to the end of the list.
pub struct Floats {
    /// The first that it does not agree in.
    pub disagrees: Option<(u64, Verdict)>,
    /// The first of another orbit.
    pub leaves: Option<u64>,
}

impl Floats {
    /// Judges the float orbit up to the last certified impact before `end`; `None` when interrupted.
    pub fn judge(
        scene: &Scene,
        settings: &Settings,
        truth: &Truth,
        end: &BigRational,
        tolerance: &Tolerance,
    ) -> Result<Option<Self>> {
        let of_list = |site: &&Site| site.kind == SiteKind::Impact && &site.time.hi().to_rational() <= end;
        let last = truth.sites.iter().rfind(of_list).map_or(0, |site| site.index);
        // One more than the truth has: a chatter in doubles need not end.
        let settings = Settings { arithmetic: Arithmetic::Float, impacts: Some(last + 1), ..settings.clone() };
        let Some(rows) = list(scene, settings)? else { return Ok(None) };
        let judgement = Judgement::new(truth, &rows, end, tolerance);
        let disagrees =
            judgement.first_disagreement().map(|finding| (judgement.impact(finding, truth), finding.verdict));
        let leaves = judgement.departure.map(|departure| departure.impact);
        Ok(Some(Self {
            disagrees: disagrees.filter(|&(impact, _)| impact <= last),
            leaves: leaves.filter(|&impact| impact <= last),
        }))
    }
}

/// The float orbit as a list; `None` when interrupted.
fn list(scene: &Scene, settings: Settings) -> Result<Option<Vec<Listed>>> {
    let mut orbit = scene.orbit(settings)?;
    let mut rows = Vec::new();
    let ended: ControlFlow<()> = follow_impacts(&mut orbit, &Progress::hidden(), |orbit, impact| {
        let (time, velocity) = orbit.bounds(&impact);
        let place = format!("impact {}", impact.index);
        rows.push(Listed { place, wall: impact.wall, time: number(&time), velocity: Some(number(&velocity)) });
        ControlFlow::Continue(())
    });
    debug_assert!(ended.is_continue(), "nothing breaks it off");
    Ok(orbit.outcome().map(|_| rows))
}

fn number(x: &Enclosure) -> Number {
    Number { low: x.lo().to_rational(), high: x.hi().to_rational(), written: decimal_f64(x.mid_rad().0) }
}
