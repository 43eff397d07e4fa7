//! Measurement of one arithmetic: its reach, widths and times.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use impact_pair::json::ArithmeticDocument;

use super::schedule::TradeArithmetic;
use impact_pair::orbit::{Conclusion, Event};
use impact_pair::orbit::{Impact, Orbit, Settings};
use impact_pair::scales::{Scales, Size, Unit};
use impact_pair::watch::{Silent, Watch};
use impact_pair::{Error, Scene};

/// Runs are repeated until those without and with bounds, and their preparations, have taken this time together, ...
const MIN_TOTAL_TIME: Duration = Duration::from_millis(400);
/// ... or until there are this many of them.
const MAX_REPETITIONS: usize = 301;
/// The first run is timed impact by impact. It is not repeated if it takes longer than this, ...
const LONG_RUN: Duration = Duration::from_secs(1);
/// ... and longer than this per impact: reading the clock three times takes less than 1 % of it.
const SLOW_IMPACT: Duration = Duration::from_micros(20);

/// The measurements of one arithmetic.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The arithmetic as requested.
    pub arithmetic: TradeArithmetic,
    /// The arithmetic, as in the orbit JSON.
    pub computed: ArithmeticDocument,
    /// The most bits that an impact took.
    pub bits: u32,
    /// Impacts reached.
    pub impacts: u64,
    /// True if anything is certified.
    pub is_certified: bool,
    /// The outcome of the orbit.
    pub conclusion: Conclusion,
    /// The guaranteed widths; `None` if non-rigorous.
    pub widths: Option<Widths>,
    /// The computing times.
    pub times: Times,
}

impl Measured {
    /// Whether all requested impacts are reached.
    pub fn is_complete(&self) -> bool {
        self.conclusion.reason().is_none()
    }

    /// Digits of the widest enclosure of a time or a velocity.
    pub fn digits(&self) -> Option<f64> {
        self.widths.map(|Widths { time, velocity }| time.greatest.max(velocity.greatest).digits())
    }

    /// Microseconds per impact, for a duration of all impacts.
    pub fn microseconds(&self, whole: Duration) -> Option<f64> {
        (self.impacts > 0).then(|| whole.as_secs_f64() * 1e6 / self.impacts as f64)
    }
}

/// Guaranteed widths, in the units of [`Scales`].
#[derive(Clone, Copy, Debug)]
pub struct Widths {
    /// Widths of times.
    pub time: Extent,
    /// Widths of velocities.
    pub velocity: Extent,
}

/// Widths of the enclosures of a quantity.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// The greatest width.
    pub greatest: Size,
    /// Width of the last impact.
    pub last: Size,
}

impl Extent {
    const NONE: Self = Self { greatest: Size::ZERO, last: Size::ZERO };

    fn note(&mut self, width: Size) {
        *self = Self { greatest: self.greatest.max(width), last: width };
    }
}

/// Median times from the orbit's first impact to its end.
#[derive(Clone, Copy, Debug)]
pub struct Times {
    /// Time of the impacts, with phases and velocities enclosed in forcing periods and gap widths.
    pub orbit: Duration,
    /// Time of the impacts and of their bounds in the units of the scene; `None` without bounds.
    pub with_bounds: Option<Duration>,
    /// Number of runs of each median.
    pub repetitions: usize,
}

/// Measures an arithmetic; `None` if interrupted.
pub(super) fn measure(
    scene: &Scene,
    arithmetic: TradeArithmetic,
    requested: &Settings,
    units: &Scales<Unit>,
    watch: &dyn Watch,
) -> Result<Option<Measured>, Error> {
    let settings = arithmetic.settings(requested);
    let is_certified = settings.arithmetic.is_certified();
    let begin = || Orbit::of(scene, settings.clone());
    let mut orbit = begin()?;
    let Seen { last, widths, times } = observe(&mut orbit, units, watch);
    if orbit.outcome().is_none() {
        return Ok(None);
    }
    let impacts = orbit.listed();
    let is_long = |time: Duration| time > LONG_RUN && time.as_secs_f64() > SLOW_IMPACT.as_secs_f64() * impacts as f64;
    let times = if is_long(times.orbit) { Some(times) } else { repeat(begin, is_certified, watch)? };
    Ok(times.map(|times| Measured {
        arithmetic,
        computed: orbit.computed(),
        bits: orbit.bits(),
        impacts,
        is_certified,
        conclusion: Conclusion::of(&orbit, last.as_ref()),
        widths: widths.filter(|_| is_certified),
        times: Times { with_bounds: times.with_bounds.filter(|_| is_certified), ..times },
    }))
}

/// Observations of the first run.
struct Seen {
    last: Option<Event>,
    widths: Option<Widths>,
    times: Times,
}

/// The first run: looks at each impact, and at the clock.
fn observe(orbit: &mut Orbit, units: &Scales<Unit>, watch: &dyn Watch) -> Seen {
    let mut widths = Widths { time: Extent::NONE, velocity: Extent::NONE };
    let mut last = None;
    let (mut in_orbit, mut in_bounds) = (Duration::ZERO, Duration::ZERO);
    let mut since = Instant::now();
    orbit.follow_impacts(watch, |orbit, impact| {
        let computed = Instant::now();
        let (time, velocity) = orbit.bounds(&impact);
        let bounded = Instant::now();
        in_orbit += computed - since;
        in_bounds += bounded - computed;
        widths.time.note(units.period.above(&time.wid()));
        widths.velocity.note(units.velocity.above(&velocity.wid()));
        last = Some(impact);
        since = Instant::now();
        ControlFlow::Continue(())
    });
    in_orbit += since.elapsed();
    Seen {
        widths: last.is_some().then_some(widths),
        last: last.map(|impact| Event::new(orbit, &impact)),
        times: Times { orbit: in_orbit, with_bounds: Some(in_orbit + in_bounds), repetitions: 1 },
    }
}

/// Repeats the run for a while, alternately without and, if they are certified, with bounds; `None` if interrupted.
fn repeat(
    begin: impl Fn() -> Result<Orbit, Error>,
    is_certified: bool,
    watch: &dyn Watch,
) -> Result<Option<Times>, Error> {
    let (mut without, mut with) = (Vec::new(), Vec::new());
    let begun = Instant::now();
    while without.is_empty() || (without.len() < MAX_REPETITIONS && begun.elapsed() < MIN_TOTAL_TIME) {
        let alone = time(begin()?, watch, |_, impact| _ = black_box(impact));
        let Some(alone) = alone else { return Ok(None) };
        without.push(alone);
        if is_certified {
            let bounded = time(begin()?, watch, |orbit, impact| _ = black_box(orbit.bounds(&impact)));
            let Some(bounded) = bounded else { return Ok(None) };
            with.push(bounded);
        }
    }
    let repetitions = without.len();
    let with_bounds = is_certified.then(|| median(with));
    Ok(Some(Times { orbit: median(without), with_bounds, repetitions }))
}

/// Computing time of the orbit from here to its end; `None` if interrupted.
fn time(mut orbit: Orbit, watch: &dyn Watch, each: impl Fn(&Orbit, Impact)) -> Option<Duration> {
    let since = Instant::now();
    orbit.follow_impacts(&Silent(watch), |orbit, impact| {
        each(orbit, impact);
        ControlFlow::Continue(())
    });
    let time = since.elapsed();
    orbit.outcome().map(|_| time)
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    let (half, count) = (times.len() / 2, times.len());
    if count % 2 == 1 { times[half] } else { (times[half - 1] + times[half]) / 2 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_pair::watch::Unwatched;

    #[test]
    fn the_median_is_in_the_middle() {
        let of = |times: &[u64]| median(times.iter().copied().map(Duration::from_secs).collect());
        assert_eq!(of(&[9]), Duration::from_secs(9));
        assert_eq!(of(&[5, 1, 100]), Duration::from_secs(5));
        assert_eq!(of(&[4, 1, 2, 100]), Duration::from_secs(3));
    }

    #[test]
    fn widths_are_those_of_the_enclosures() {
        let scene = crate::scenes::scene("figure-12-exact");
        let (requested, units) =
            (Settings { impacts: Some(5), ..scene.settings() }, Scales::of(&scene).unwrap().units());
        let of = |arithmetic| measure(&scene, arithmetic, &requested, &units, &Unwatched).unwrap().unwrap();
        let float = of(TradeArithmetic::Float);
        assert!((float.impacts, float.is_complete(), float.is_certified) == (5, true, false));
        assert!(float.widths.is_none() && float.times.with_bounds.is_none());
        let interval = of(TradeArithmetic::Interval);
        // A period is two units of time, A W is pi: no narrower than doubles, no wider than a few.
        let digits = interval.digits().unwrap();
        assert!((13.0..16.5).contains(&digits), "{digits}");
        let Widths { time, velocity } = interval.widths.unwrap();
        assert!(time.last <= time.greatest && velocity.last <= velocity.greatest);
    }
}
