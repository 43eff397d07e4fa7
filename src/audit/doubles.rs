//! The reach of double precision on this scene: two orbits in doubles, compared as any other list.
//!
//! The first is the exact orbit of the scene's data rounded to doubles. Where this orbit is proved to be outside, a simulator that reads the
//! scene in doubles can be right only by chance, however accurately it computes. The second is impact-pair's own floating-point orbit: it shows
//! the effect of rounding on the way, and proves nothing about other programs.

use std::ops::ControlFlow;

use impact_pair_document::{ExcitationDocument, SceneDocument, StartDocument, Written};
use num_rational::BigRational;

use super::judge::Comparison;
use super::list::{Listed, Number};
use super::tolerance::Tolerance;
use super::truth::{Site, SiteKind, Truth};
use super::verdict::Verdict;
use crate::exact::{Enclosure, Exact, decimal_bounds, decimal_f64};
use crate::orbit::{Arithmetic, Orbit, Outcome, Settings};
use crate::watch::{Silent, Watch};
use crate::{Error, Scene};

/// Bits of a number that is rounded to a double.
const BITS: u32 = 256;

/// Where the two orbits in doubles part from the true orbit.
#[derive(Clone, Copy, Debug)]
pub struct Doubles {
    /// Exact orbit of the rounded data; `None` for intervals, or if that orbit could not be certified to the end.
    pub data: Option<Parting>,
    /// Floating-point orbit; `None` when interrupted.
    pub float: Option<Parting>,
}

/// First impacts at which an orbit differs from the true one, up to the end of the list, by the true numbers of the impacts.
#[derive(Clone, Copy, Debug)]
pub struct Parting {
    /// First impact with a verdict that disagrees.
    pub disagrees: Option<(u64, Verdict)>,
    /// First true impact that the orbit does not follow any more.
    pub leaves: Option<u64>,
}

impl Doubles {
    /// Compares both orbits up to the last certified impact before `end`.
    pub(super) fn judge(
        scene: &Scene,
        settings: &Settings,
        truth: &Truth,
        end: &BigRational,
        tolerance: &Tolerance,
        watch: &dyn Watch,
    ) -> Result<Self, Error> {
        let of_list = |site: &&Site| site.kind == SiteKind::Impact && &site.time.sup().to_rational() <= end;
        let last = truth.sites.iter().rfind(of_list).map_or(0, |site| site.index);
        // One more than the truth has: a chatter in doubles need not end.
        let settings = Settings { impacts: Some(last + 1), ..settings.clone() };
        let part = |rows: Vec<Listed>| {
            let judgement = Comparison::new(truth, &rows, (end, true), tolerance);
            let first = judgement.first_disagreement();
            let disagrees = first.map(|finding| (truth.impact(finding), finding.verdict));
            let leaves = judgement.departure.map(|departure| departure.impact);
            Parting {
                disagrees: disagrees.filter(|&(impact, _)| impact <= last),
                leaves: leaves.filter(|&impact| impact <= last),
            }
        };
        let float = Settings { arithmetic: Arithmetic::Float, ..settings.clone() };
        let data = rounded(scene).map(|scene| list(&scene, settings, watch)).transpose()?.flatten();
        Ok(Self { data: data.map(part), float: list(scene, float, watch)?.map(part) })
    }
}

/// The impacts of an orbit as a list; `None` when it is interrupted or undecided.
fn list(scene: &Scene, settings: Settings, watch: &dyn Watch) -> Result<Option<Vec<Listed>>, Error> {
    let mut orbit = Orbit::of(scene, settings)?;
    let mut rows = Vec::new();
    orbit.follow_impacts(&Silent(watch), |orbit, impact| {
        let (time, velocity) = orbit.bounds(&impact);
        let place = format!("impact {}", impact.index);
        rows.push(Listed { place, wall: impact.wall, time: number(&time), velocity: Some(number(&velocity)) });
        ControlFlow::Continue(())
    });
    Ok(match orbit.outcome() {
        None | Some(Outcome::Undecided { .. }) => None,
        Some(_) => Some(rows),
    })
}

fn number(x: &Enclosure) -> Number {
    Number { low: x.inf().to_rational(), high: x.sup().to_rational(), written: decimal_f64(x.mid_rad().0) }
}

/// The scene with each number of its data rounded to the nearest double; `None` if it has intervals, or the rounded numbers
/// are no scene.
fn rounded(scene: &Scene) -> Option<Scene> {
    let data = SceneDocument::new(scene.pair(), scene.start());
    let terms = |terms: &[Written]| {
        let terms: Option<Vec<String>> = terms.iter().map(double).collect();
        Some(format!("[{}]", terms?.join(", ")))
    };
    let ExcitationDocument { amplitude, frequency, phase } = &data.excitation;
    let (amplitude, frequency, phase) = (terms(amplitude)?, terms(frequency)?, terms(phase)?);
    let (gap, restitution) = (double(&data.gap)?, double(&data.restitution)?);
    let StartDocument { time, wall, position, velocity } = &data.start;
    let place = match (wall, position) {
        (Some(wall), _) => format!("wall = \"{}\"", wall.name()),
        (None, Some(position)) => format!("position = {}", double(position)?),
        (None, None) => return None,
    };
    let (time, velocity) = (double(time)?, double(velocity)?);
    let text = format!(
        "excitation = {{ amplitude = {amplitude}, frequency = {frequency}, phase = {phase} }}\n\
         pair = {{ gap = {gap}, restitution = {restitution} }}\n\
         start = {{ time = {time}, {place}, velocity = {velocity} }}\n"
    );
    Scene::parse(&text).ok()
}

/// A number rounded to a double, in TOML.
fn double(number: &Written) -> Option<String> {
    Some(format!("\"{}\"", nearest_double(&number.0)?.text()))
}

/// The double nearest to a number, exactly.
fn nearest_double(exact: &Exact) -> Option<Exact> {
    // More than 70 digits: only a number that near to the middle of two doubles could be rounded to the wrong one.
    let exact = Some(exact).filter(|exact| exact.is_point())?;
    let [lower, _] = decimal_bounds(&exact.enclose(BITS));
    Exact::from_f64(lower.parse().ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_are_rounded_to_the_nearest_doubles() {
        let double = |text: &str| nearest_double(&text.parse().unwrap()).unwrap().as_rational().unwrap().clone();
        let exactly = |x: f64| Exact::from_f64(x).unwrap().as_rational().unwrap().clone();
        for (text, x) in
            [("9.42497", 9.42497), ("pi", std::f64::consts::PI), ("-0.1", -0.1), ("0.5", 0.5), ("2/3", 2.0 / 3.0)]
        {
            assert_eq!(double(text), exactly(x), "{text}");
        }
        assert!(nearest_double(&"[1, 2]".parse().unwrap()).is_none());
    }

    #[test]
    fn a_scene_is_rounded_as_a_whole() {
        let scene = |amplitude: &str, place: &str| {
            let excitation = format!("amplitude = {amplitude}, frequency = \"pi\", phase = 0");
            let start = format!("time = 0, {place}, velocity = -12.56636");
            crate::tests::scene_of(&excitation, "gap = 9.42497, restitution = 0.5", &start)
        };
        for place in ["wall = \"left\"", "position = 0.1"] {
            let rounded = rounded(&scene("8", place)).unwrap();
            let frequency = rounded.pair().excitation().reference().frequency();
            assert_eq!(frequency.as_rational(), Exact::from_f64(std::f64::consts::PI).unwrap().as_rational());
            assert_eq!(rounded.pair().gap().as_rational(), Exact::from_f64(9.42497).unwrap().as_rational());
        }
        assert!(rounded(&scene("\"[7.9, 8]\"", "wall = \"left\"")).is_none());
    }
}
