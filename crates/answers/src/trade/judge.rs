//! Comparison of a non-rigorous orbit with a certified one, impact by impact.
//!
//! An error is enclosed by the least and the greatest distance to the enclosure of the true value. An error exceeds a threshold if the least
//! distance does, and is within the threshold if the greatest distance is. Impacts are matched by their number as long as all walls agree. After
//! the first wall that disagrees, the orbit has departed from the true word and is not compared further. After a complete chatter the comparison
//! ends as well: how many of its impacts are listed depends on the digits.

use std::ops::ControlFlow;

use super::schedule::TradeArithmetic;
use impact_pair::exact::{Dyadic, Enclosure};
use impact_pair::orbit::{Arithmetic, Impact, Orbit, Progress, Rest, Settings};
use impact_pair::pair::Wall;
use impact_pair::scales::{Scales, Size, Unit};
use impact_pair::watch::Watch;
use impact_pair::{Error, Scene};

/// Digits of the truth: far beyond what doubles hold.
const DIGITS: u32 = 30;
/// Thresholds of the errors of times, powers of ten of a period.
const THRESHOLDS: [i32; 3] = [-9, -6, -3];
/// Bits of a difference.
const BITS: u32 = 64;

/// An impact as an orbit has it.
#[derive(Clone, Debug)]
struct Reading {
    wall: Wall,
    time: Enclosure,
    velocity: Enclosure,
}

impl Reading {
    fn new(orbit: &Orbit, impact: &Impact) -> Self {
        let (time, velocity) = orbit.bounds(impact);
        Self { wall: impact.wall, time, velocity }
    }
}

/// The true errors of an orbit, as far as it was compared.
#[derive(Clone, Debug)]
pub struct ErrorBounds {
    /// Units of the errors.
    pub units: Scales<Unit>,
    /// Number of impacts compared, on the true word.
    pub judged: u64,
    /// The largest error of a time.
    pub time: Largest,
    /// The largest error of a velocity.
    pub velocity: Largest,
    /// The impacts at which errors of times exceed the thresholds.
    pub crossings: Vec<Crossing>,
    /// The impact at which the orbit departs from the true word, if it does.
    pub departure: Option<Divergence>,
}

/// Bounds of the largest error so far; both only grow.
#[derive(Clone, Copy, Debug)]
pub struct Largest {
    /// A lower bound.
    pub at_least: Size,
    /// An upper bound.
    pub at_most: Size,
    /// The impact with the greatest upper bound.
    pub impact: u64,
}

impl Largest {
    const NONE: Self = Self { at_least: Size::ZERO, at_most: Size::ZERO, impact: 0 };

    fn note(&mut self, index: u64, [at_least, at_most]: [Size; 2]) {
        self.at_least = self.at_least.max(at_least);
        if self.impact == 0 || at_most > self.at_most {
            (self.at_most, self.impact) = (at_most, index);
        }
    }
}

/// The impacts at which the errors of times exceed a threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The power of ten of a period.
    pub exponent: i32,
    /// All errors up to this impact are proved not to exceed it.
    pub within: u64,
    /// The first error that is proved to exceed it.
    pub exceeded: Option<u64>,
}

/// The impact at which the orbit departs from the true word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Divergence {
    /// First impact that differs from the true one.
    pub impact: u64,
    /// True wall of the impact.
    pub truth: Wall,
    /// `None` if the orbit ends there.
    pub judged: Option<Wall>,
}

impl ErrorBounds {
    fn new(units: Scales<Unit>) -> Self {
        let crossing = |exponent| Crossing { exponent, within: 0, exceeded: None };
        Self {
            units,
            judged: 0,
            time: Largest::NONE,
            velocity: Largest::NONE,
            crossings: THRESHOLDS.map(crossing).into(),
            departure: None,
        }
    }

    /// Compares the next impact of both orbits; breaks off where the orbit leaves the true word.
    fn compare(&mut self, truth: &Reading, judged: Option<&Reading>) -> ControlFlow<()> {
        let index = self.judged + 1;
        let Some(reading) = judged.filter(|judged| judged.wall == truth.wall) else {
            self.departure =
                Some(Divergence { impact: index, truth: truth.wall, judged: judged.map(|judged| judged.wall) });
            return ControlFlow::Break(());
        };
        self.judged = index;
        let error = distance(&reading.time, &truth.time, &self.units.period);
        self.time.note(index, error);
        self.velocity.note(index, distance(&reading.velocity, &truth.velocity, &self.units.velocity));
        for crossing in &mut self.crossings {
            let threshold = Size::power_of_ten(crossing.exponent);
            if error[1] <= threshold && crossing.within + 1 == index {
                crossing.within = index;
            }
            if error[0] > threshold {
                crossing.exceeded.get_or_insert(index);
            }
        }
        ControlFlow::Continue(())
    }
}

/// Bounds of the distance between a point of one enclosure and a point of the other.
fn distance(one: &Enclosure, other: &Enclosure, unit: &Unit) -> [Size; 2] {
    let difference = one.sub(other, BITS);
    let (least, most): (Dyadic, Dyadic) = (difference.mig(), difference.mag());
    [unit.below(&least), unit.above(&most)]
}

/// Settings with which the true orbit is computed.
pub(super) fn truth(requested: &Settings) -> Settings {
    TradeArithmetic::Auto(DIGITS).settings(requested)
}

/// The truth in words.
pub(super) fn name(truth: &Settings) -> String {
    match truth.arithmetic {
        Arithmetic::Auto => format!("auto at {} digits", truth.digits),
        arithmetic => arithmetic.to_string(),
    }
}

/// The next entry in the list of an orbit.
enum Next {
    /// An impact; `None` at its end.
    Reading(Option<Reading>),
    /// Infinitely many impacts are left out before the next one.
    Skipped,
}

fn next(orbit: &mut Orbit) -> Next {
    loop {
        match orbit.advance() {
            Progress::Impact(impact) => return Next::Reading(Some(Reading::new(orbit, &impact))),
            Progress::Ended => return Next::Reading(None),
            Progress::Rest(Rest { is_accumulation: true, .. }) => return Next::Skipped,
            _ => {}
        }
    }
}

/// Compares the `float` orbit on this scene with the true one, up to the first complete chatter; when interrupted, as far as it came.
pub(super) fn judge_float(
    scene: &Scene,
    requested: &Settings,
    units: &Scales<Unit>,
    watch: &dyn Watch,
) -> Result<ErrorBounds, Error> {
    let mut truth = Orbit::of(scene, self::truth(requested))?;
    let mut float = Orbit::of(scene, TradeArithmetic::Float.settings(requested))?;
    let mut judgement = ErrorBounds::new(*units);
    let _ = truth.follow(watch, |truth, event| match event {
        Progress::Impact(impact) => match next(&mut float) {
            Next::Skipped => ControlFlow::Break(()),
            Next::Reading(judged) => judgement.compare(&Reading::new(truth, &impact), judged.as_ref()),
        },
        Progress::Rest(Rest { is_accumulation: true, .. }) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    Ok(judgement)
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::scenes::scene;

    /// Floats and truths of the first impacts of figure 14.
    fn readings(impacts: u64) -> (Scales<Unit>, Vec<Reading>, Vec<Reading>) {
        let scene = scene("figure-14");
        let requested = Settings { impacts: Some(impacts), ..scene.settings() };
        let read = |settings: Settings| {
            let mut orbit = Orbit::of(&scene, settings).unwrap();
            let impacts: Vec<_> = orbit.by_ref().collect();
            impacts.iter().map(|impact| Reading::new(&orbit, impact)).collect()
        };
        (
            Scales::of(&scene).unwrap().units(),
            read(TradeArithmetic::Float.settings(&requested)),
            read(truth(&requested)),
        )
    }

    fn judge(units: Scales<Unit>, floats: &[Reading], truths: &[Reading]) -> ErrorBounds {
        let mut judgement = ErrorBounds::new(units);
        let _ = truths.iter().enumerate().try_for_each(|(i, truth)| judgement.compare(truth, floats.get(i)));
        judgement
    }

    #[test]
    fn a_flipped_wall_is_detected_at_its_impact() {
        let (units, mut floats, truths) = readings(20);
        assert_eq!(judge(units, &floats, &truths).departure, None);
        for flipped in [1, 7, 20] {
            let wall = floats[flipped - 1].wall;
            floats[flipped - 1].wall = wall.other();
            let judgement = judge(units, &floats, &truths);
            let impact = flipped as u64;
            assert_eq!(judgement.departure, Some(Divergence { impact, truth: wall, judged: Some(wall.other()) }));
            assert_eq!(judgement.judged, impact - 1);
            floats[flipped - 1].wall = wall;
        }
    }

    /// Of the chatter of scenes/chatter.toml the truth lists more impacts than the orbit in doubles does, which follows the same word.
    #[test]
    fn r44_after_a_complete_chatter_no_departure_is_reported() {
        let scene = scene("chatter");
        let requested = Settings { impacts: Some(60), ..scene.settings() };
        let judgement =
            judge_float(&scene, &requested, &Scales::of(&scene).unwrap().units(), &impact_pair::watch::Unwatched)
                .unwrap();
        assert!((6..60).contains(&judgement.judged) && judgement.departure.is_none(), "{judgement:?}");
        assert!(judgement.crossings.iter().all(|crossing| crossing.exceeded.is_none()));
    }

    #[test]
    fn an_orbit_that_ends_early_has_left_the_word() {
        let (units, floats, truths) = readings(20);
        let departure = judge(units, &floats[..12], &truths).departure.unwrap();
        assert_eq!((departure.impact, departure.judged), (13, None));
    }

    #[test]
    fn bounds_of_the_largest_error_grow_and_hold_it() {
        let (units, floats, truths) = readings(20);
        let mut judgement = ErrorBounds::new(units);
        let mut before = Largest::NONE;
        for (float, truth) in floats.iter().zip(&truths) {
            assert!(judgement.compare(truth, Some(float)).is_continue());
            let now = judgement.time;
            assert!(now.at_least <= now.at_most);
            assert!(now.at_least >= before.at_least && now.at_most >= before.at_most && now.impact >= before.impact);
            before = now;
        }
        // A chaotic orbit in doubles: wrong, but not by much yet.
        assert!(before.at_most > Size::power_of_ten(-15) && before.at_most < Size::power_of_ten(-9));
    }

    /// The reading with its time shifted by `shift`.
    fn shifted(reading: &Reading, shift: f64) -> Reading {
        let shift = Enclosure::from_f64_bounds(shift, shift).unwrap();
        Reading { time: reading.time.add(&shift, 200), ..reading.clone() }
    }

    #[test]
    fn a_threshold_is_exceeded_only_where_that_is_proved() {
        let (units, _, truths) = readings(9);
        // Two units of time are a period.
        let errors = [0.0, 1e-12, 3e-9, 0.0, 3e-6, 1e-3, 3e-3, 0.0, 1e-12];
        let floats: Vec<_> = truths.iter().zip(errors).map(|(truth, error)| shifted(truth, error)).collect();
        let judgement = judge(units, &floats, &truths);
        let crossings = [(-9, 2, 3), (-6, 4, 5), (-3, 6, 7)];
        let crossings = crossings.map(|(exponent, within, at)| Crossing { exponent, within, exceeded: Some(at) });
        assert_eq!(judgement.crossings, crossings);
        assert_eq!((judgement.judged, judgement.time.impact), (9, 7));

        // A wide truth proves less: errors between 0 and 2e-3 periods neither keep within nor exceed.
        let wide =
            |reading: &Reading| Reading { time: reading.time.hull(&shifted(reading, 4e-3).time), ..reading.clone() };
        let judgement = judge(units, &truths, &truths.iter().map(wide).collect::<Vec<_>>());
        assert!(judgement.crossings.iter().all(|crossing| crossing.within == 0 && crossing.exceeded.is_none()));
        assert!(judgement.time.at_least == Size::ZERO && judgement.time.at_most > Size::power_of_ten(-3));
    }
}
