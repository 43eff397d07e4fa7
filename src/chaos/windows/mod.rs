//! Stable periodic orbits near a scene, over a parameter, and the windows in which they are stable: Lemma Y8 of
//! `docs/proofs/bifurcations.md#Y8`.
//!
//! Orbits of the reduced map are searched in floating point (`search`), at the scene's own value and at others of the range. Each stable orbit is
//! then proved at an exact value of the parameter, and its window is enclosed ([`Window`]).

mod document;
mod search;

use std::sync::atomic::{AtomicUsize, Ordering};

use impact_pair_model::require_digits;

use super::law::{Law, Side};
use super::quad::State;
use crate::Error;
use crate::Scene;
use crate::exact::Exact;
use crate::number::Ball;
use crate::pair::{ImpactPair, Wall};
use crate::periodic::Precision;
use crate::periodic::bifurcation::{NoWindow, Window, WindowSeed};
use crate::scene::{Key, Range};
use crate::threads::{answers, available};
use crate::watch::{Latched, Stage, Watch};
pub use search::MAX_CYCLE as MOST_WINDOW_IMPACTS;
use search::{Family, Superstable, VariedParameter};

/// The keys over which windows are searched, in words.
pub const WINDOW_PARAMETERS: &str = "KEY one of gap, amplitude, restitution, A/d";

/// Whether windows are searched over such a range.
pub fn is_window_range(range: &Range) -> bool {
    matches!(range.key(), Key::Gap | Key::Amplitude(_) | Key::Restitution) && range.count().is_none()
}

/// The settings of a search for windows.
#[derive(Clone, Debug)]
pub struct WindowSettings {
    /// The parameter and its range: gap, amplitude or restitution.
    pub over: Range,
    /// Impacts of floating-point orbits that are searched.
    pub impacts: u64,
    /// Impacts of the reduced map that an orbit takes at most, up to [`MOST_WINDOW_IMPACTS`].
    pub longest: usize,
    /// Number of windows that are proved at most, those nearest to the scene's own value.
    pub most: usize,
    /// Requested widths of the enclosures.
    pub precision: Precision,
}

/// A stable orbit with its window, as the reduced map sees it.
#[derive(Clone, Debug)]
pub struct FoundWindow {
    /// Number of impacts after which the orbit repeats itself or its mirror image.
    pub impacts: usize,
    /// Flights of these impacts in time order: `F` to the far wall, `N` back to the near one.
    pub flights: String,
    /// The orbit and its window.
    pub window: Window,
}

impl FoundWindow {
    /// Whether another window is the same: at one value, with the same flights from another impact on.
    fn is_one(&self, flights: &str, window: &Window) -> bool {
        self.window.at.text() == window.at.text()
            && self.flights.len() == flights.len()
            && self.flights.repeat(2).contains(flights)
    }
}

/// Orbit of floating point that is not proved to be stable and periodic.
#[derive(Clone, Debug, PartialEq)]
pub struct UnprovedWindow {
    /// See [`FoundWindow::impacts`].
    pub impacts: usize,
    /// See [`FoundWindow::flights`].
    pub flights: String,
    /// The value of the parameter about which it was found, in the units of the scene.
    pub near: f64,
    /// The reason why it is not proved.
    pub reason: &'static str,
}

/// The stable orbits found over a parameter, with their windows. That there are no others is not proved.
#[derive(Clone, Debug)]
pub struct Windows {
    /// The parameter and its range.
    pub over: Range,
    /// The windows proved, the nearest to the scene's own value first.
    pub windows: Vec<FoundWindow>,
    /// Orbits of floating point of which nothing could be proved.
    pub unproved: Vec<UnprovedWindow>,
    /// Number of stable orbits of floating point that were found in all.
    pub seen: usize,
    /// `true` if it was interrupted before the search or the proofs were done.
    pub interrupted: bool,
}

/// Impacts that an orbit is followed for, at one value of the parameter.
const ORBIT_IMPACTS: u64 = 1 << 19;
/// The part of the golden section by which values of the parameter are spread.
const GOLDEN_FRACTION: f64 = 0.618_033_988_749_894_9;

impl Windows {
    /// Searches stable orbits near a scene and proves them, until the watch stops it; what is proved until then is kept.
    ///
    /// # Errors
    /// With several harmonics, when the range is none of the parameter's or of another key, or a value is beyond exact expressions.
    ///
    /// ```no_run
    /// use impact_pair::chaos::{WindowSettings, Windows};
    /// use impact_pair::periodic::Precision;
    /// use impact_pair::watch::Unwatched;
    /// use impact_pair::Scene;
    /// # let text = "";
    /// let scene = Scene::parse(text)?;
    /// let over = "gap=9.4247..9.4253".parse()?;
    /// let settings = WindowSettings { over, impacts: 30_000_000, longest: 44, most: 10, precision: Precision::default() };
    /// for found in Windows::of(&scene, &settings, &Unwatched)?.windows {
    ///     println!("{} impacts at {}: {:?}", found.impacts, found.window.at, found.window.width());
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(scene: &Scene, settings: &WindowSettings, watch: &dyn Watch) -> Result<Self, Error> {
        let watch = Latched::new(watch);
        let search = Search::new(scene.pair(), settings)?;
        let seen = search.all(&watch);
        let mut all = Self {
            over: settings.over.clone(),
            windows: Vec::new(),
            unproved: Vec::new(),
            seen: seen.len(),
            interrupted: false,
        };
        for (i, found) in search.proved(&seen, settings, &watch)? {
            if all.windows.len() >= settings.most {
                break;
            }
            let (impacts, flights) = (seen[i].flights.len(), word(&seen[i].flights));
            match found {
                // Of a window across an end of the range the middle may be outside.
                Ok(window) if !search.holds(&window) => {}
                // Floating point may come to one orbit from several of its impacts.
                Ok(window) if all.windows.iter().any(|known| known.is_one(&flights, &window)) => {}
                Ok(window) => all.windows.push(FoundWindow { impacts, flights, window }),
                Err(why) => {
                    let near = search.in_units(seen[i].parameter);
                    all.unproved.push(UnprovedWindow { impacts, flights, near, reason: why.reason() });
                }
            }
        }
        all.interrupted = watch.is_stopped();
        Ok(all)
    }

    /// Whether there are windows and all is proved of each: the orbit, its stability, both ends, and the orbits between. Unproved orbits claim
    /// no window.
    pub fn is_certified(&self) -> bool {
        !self.interrupted && !self.windows.is_empty() && self.windows.iter().all(|found| found.window.is_certified())
    }
}

/// The letters of flights.
fn word(flights: &[Side]) -> String {
    flights.iter().map(|side| if *side == Side::Far { 'F' } else { 'N' }).collect()
}

/// Index of a cycle, and its proved window.
type Tried = (usize, Result<Window, NoWindow>);

/// A search over a parameter of a pair. It proposes
struct Search<'p> {
    pair: &'p ImpactPair,
    family: Family,
    /// The scene's own value of `D` or `e`, if the range has it, else one in the middle.
    own: f64,
    key: Key,
    /// The ends of the range.
    ends: [&'p Exact; 2],
    /// The amplitude where the gap varies, the gap where the amplitude does, or 1.
    unit: f64,
    impacts: u64,
}

impl<'p> Search<'p> {
    fn new(pair: &'p ImpactPair, settings: &'p WindowSettings) -> Result<Self, Error> {
        let (key, low, high) = (settings.over.key(), settings.over.low(), settings.over.high());
        if !is_window_range(&settings.over) {
            let message =
                format!("the range is \"{}\", but accepted is KEY=LO..HI, {WINDOW_PARAMETERS}", settings.over);
            return Err(Error::out_of_range(None, message));
        }
        require_digits(settings.precision.digits)?;
        let law = |value: &Exact| Law::of(&pair.with(key, value.clone())?);
        let laws = [law(low)?, law(high)?];
        let varies = if key == Key::Restitution { VariedParameter::Restitution } else { VariedParameter::Gap };
        let of = |law: &Law| if varies == VariedParameter::Gap { law.gap.mid() } else { law.restitution.mid() };
        let ends = laws.each_ref().map(of);
        // proposes
        let range = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let own = Law::of(pair).ok().map(|own| of(&own)).filter(|own| (range[0]..=range[1]).contains(own)); // proposes
        let fixed = if varies == VariedParameter::Gap { laws[0].restitution.mid() } else { laws[0].gap.mid() };
        let size = |x: &Exact| Ball::of(x).mid();
        let unit = match key {
            Key::Gap => size(pair.excitation().reference().amplitude()),
            Key::Amplitude(_) => size(pair.gap()),
            _ => 1.0,
        };
        let longest = settings.longest.min(MOST_WINDOW_IMPACTS); // proposes
        let own = own.unwrap_or(0.5 * (range[0] + range[1])); // proposes: where a search begins
        let family = Family { varies, fixed, range, longest };
        Ok(Self { pair, family, own, key, ends: [low, high], unit, impacts: settings.impacts })
    }

    /// A value of the parameter in the units of the scene.
    fn in_units(&self, value: f64) -> f64 {
        match self.key {
            Key::Gap => value * self.unit,
            Key::Amplitude(_) => self.unit / value,
            _ => value,
        }
    }

    /// Whether the value at which a window is proved is in the range.
    fn holds(&self, window: &Window) -> bool {
        const BITS: u32 = 256;
        let [low, high] = self.ends.map(|end| end.enclose(BITS));
        let at = window.at.enclose(BITS);
        low.sup() <= at.inf() && at.sup() <= high.inf()
    }

    /// The stable cycles that orbits come near to, the nearest to the scene's own value first.
    fn all(&self, watch: &dyn Watch) -> Vec<Superstable> {
        let orbits = usize::try_from(self.impacts.div_ceil(ORBIT_IMPACTS)).unwrap_or(usize::MAX); // proposes
        let done = AtomicUsize::new(0);
        let found = answers(available(), orbits, &|k| {
            let impacts = self.impacts.min((done.load(Ordering::Relaxed) as u64) * ORBIT_IMPACTS); // shown
            watch.proceed(Stage::Searched(impacts)).is_continue().then(|| {
                let own = self.orbit(k, watch);
                done.fetch_add(1, Ordering::Relaxed);
                own
            })
        });
        let mut all: Vec<Superstable> = Vec::new();
        for cycle in found.into_iter().flatten() {
            if all.iter().all(|other| !cycle.is_near(other)) {
                all.push(cycle);
            }
        }
        let own = self.in_units(self.own);
        let away = |cycle: &Superstable| (self.in_units(cycle.parameter) - own).abs();
        all.sort_by(|a, b| away(a).total_cmp(&away(b)));
        all
    }

    /// Proves the first of these cycles side by side, until as many are proved as are wanted, or the watch stops it: each with its place, in
    /// their order.
    fn proved(
        &self,
        cycles: &[Superstable],
        settings: &WindowSettings,
        watch: &Latched<'_>,
    ) -> Result<Vec<Tried>, Error> {
        let count = AtomicUsize::new(0);
        let found = answers(available(), cycles.len(), &|i| {
            let proved = count.load(Ordering::Relaxed);
            let at = Stage::Windows { proved, of: cycles.len() };
            if proved >= settings.most || watch.proceed(at).is_break() {
                return None; // exact: no more are requested
            }
            let window = match self.seed(&cycles[i]) {
                Some(seed) => Window::of(self.pair, &settings.over, &seed, settings.precision, watch),
                None => Ok(Err(NoWindow::Seed)),
            };
            if watch.is_stopped() {
                return None; // exact: what is stopped is not listed
            }
            count.fetch_add(usize::from(matches!(window, Ok(Ok(_)))), Ordering::Relaxed);
            Some((i, window))
        });
        found.into_iter().map(|(i, window)| Ok((i, window?))).collect()
    }

    /// Stable cycles that orbit `k` comes near to: every second orbit is at the scene's own value.
    fn orbit(&self, k: usize, watch: &dyn Watch) -> Vec<Superstable> {
        let part = |n: usize| (n as f64 * GOLDEN_FRACTION).fract(); // proposes
        let [low, high] = self.family.range;
        let value = if k.is_multiple_of(2) { self.own } else { (high - low).mul_add(part(k), low) };
        let start: State = [part(k + 1), 1.0 + part(3 * k)];
        let impacts = usize::try_from(self.impacts.min(ORBIT_IMPACTS)).unwrap_or(usize::MAX); // proposes
        self.family.search((value, start), impacts, watch)
    }

    /// Seed of a cycle's window; `None` where the number of forcing periods is out of range.
    fn seed(&self, cycle: &Superstable) -> Option<WindowSeed> {
        let (phases, lasting) = self.family.phases(cycle)?;
        let crossings = cycle.flights.iter().filter(|side| **side == Side::Far).count();
        let is_mirrored = !crossings.is_multiple_of(2);
        let rounds: u8 = if is_mirrored { 2 } else { 1 };
        let cycles = (f64::from(rounds) * lasting).round(); // proposes
        let (mut wall, mut walls) = (Wall::Left, String::new());
        for side in cycle.flights.iter().cycle().take(usize::from(rounds) * cycle.flights.len()) {
            walls.push(if wall == Wall::Left { 'L' } else { 'R' });
            wall = side.lands_on(wall);
        }
        let parameter =
            if self.family.varies == VariedParameter::Gap { 1.0 / cycle.parameter } else { cycle.parameter };
        // proposes
        (1.0..1e6).contains(&cycles).then_some(())?;
        Some(WindowSeed { word: walls.parse().ok()?, cycles: cycles as u32, is_mirrored, phases, parameter }) // proposes
    }
}
