//! A start of `tests/straddle`, run up to its first impact and judged by the truth: through a graze that the bits do not
//! tell, and through a rest and its release.
#![allow(dead_code)] // each test crate uses a part

use super::scene::{float, holds};
use impact_pair::Scene;
use impact_pair::exact::{Dyadic, Enclosure, Exact};
use impact_pair::orbit::{Impact, Orbit, Outcome, Place, Progress, Rest, Settings, Touch};
use impact_pair::pair::Wall as LibraryWall;
use impact_pair_truth::{Contact, Problem, Start, Truth, Wall, first_contact};
use rug::Float;

/// Bits of the truth: times of 2^60 forcing periods and offsets of 10^-60 leave more than 512.
pub const BITS: u32 = 768;

/// The verdict of the independent simulator on a first impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ImpactVerdict {
    /// Wall, time and velocity are right.
    Right,
    /// They are right after a rest and its release.
    Released,
    /// They are right after a graze that the bits did not decide.
    Grazed,
    /// No wall is ever touched, or nothing ever leaves one.
    Still,
    /// The library claims nothing of the impact.
    Undecided,
    /// The truth does not tell.
    Open,
    /// Beyond the range of flights.
    NoScene,
    /// The library is wrong.
    Wrong,
}

impl ImpactVerdict {
    pub const ALL: [ImpactVerdict; 8] = [
        ImpactVerdict::Right,
        ImpactVerdict::Released,
        ImpactVerdict::Grazed,
        ImpactVerdict::Still,
        ImpactVerdict::Undecided,
        ImpactVerdict::Open,
        ImpactVerdict::NoScene,
        ImpactVerdict::Wrong,
    ];
}

/// A result, or the verdict at which the comparison ends before the impact: a wrong claim, or nothing more to compare.
type Compared<T> = Result<T, (ImpactVerdict, String)>;

fn wrong<T>(words: String) -> Compared<T> {
    Err((ImpactVerdict::Wrong, words))
}

/// The value, rounded; exactly 0 where that many bits do not tell it from 0.
fn value(exact: &Exact) -> Float {
    let enclosure = exact.enclose(BITS);
    if enclosure.sign().is_none() { Float::new(BITS) } else { Float::with_val(BITS, float(enclosure.inf())) }
}

fn wall(library: LibraryWall) -> Wall {
    match library {
        LibraryWall::Left => Wall::Left,
        LibraryWall::Right => Wall::Right,
    }
}

/// The problem and the start of a scene of one harmonic and point data; `None` for others.
pub fn question(scene: &Scene) -> Option<(Problem, Start)> {
    let (pair, start) = (scene.pair(), scene.start());
    let harmonic = pair.excitation().only()?;
    let data = [harmonic.amplitude(), harmonic.frequency(), harmonic.phase(), pair.gap(), pair.restitution()];
    if !(start.is_point() && data.iter().all(|datum| datum.is_point())) {
        return None;
    }
    let [amplitude, omega, tau, gap, restitution] = data.map(value);
    let problem = Problem::new(BITS, &amplitude, &omega, &tau, &gap, &restitution);
    let (time, velocity) = (value(start.time()), value(start.velocity()));
    let start = match start.place() {
        Place::Wall(on) => {
            Start::on_wall(&problem, wall(*on), &time, &-Float::with_val(BITS, &restitution * &velocity))
        }
        Place::Inside(position) => Start::inside(&problem, &time, &value(position), &velocity),
    };
    Some((problem, start))
}

/// The bounds, further apart by what the truth may be off.
fn widened(bounds: &Enclosure) -> Enclosure {
    let slack = Enclosure::point(Dyadic::power_of_two(-500));
    bounds.add(&slack.hull(&slack.negated()), 2 * BITS)
}

/// An orbit next to its true state.
struct Pair<'a> {
    problem: &'a Problem,
    start: Start,
    orbit: Orbit,
    /// The verdict so far, by the rests and grazes passed before the impact.
    passed: ImpactVerdict,
}

impl Pair<'_> {
    fn truth(&self) -> Compared<Truth> {
        match first_contact(self.problem, &self.start) {
            Truth::Graze { time } => Err((ImpactVerdict::Open, format!("the truth may graze at {time:.30}"))),
            truth => Ok(truth),
        }
    }

    /// The true contact, where the library claims one.
    fn contact(&self, claim: &str) -> Compared<Contact> {
        match self.truth()? {
            Truth::Contact { time, wall, velocity_before } => Ok(Contact { time, wall, velocity_before }),
            other => wrong(format!("{claim}, but the truth is {other:?}")),
        }
    }

    fn impact(&self, impact: &Impact) -> Compared<()> {
        let claim = format!("{impact:?}");
        let contact = self.contact(&claim)?;
        let (time, velocity) = self.orbit.bounds(impact);
        let names = [("time", &time, &contact.time), ("velocity", &velocity, &contact.velocity_before)];
        if contact.wall != wall(impact.wall) {
            return wrong(format!("{claim}, but the truth is {contact:?}"));
        }
        match names.into_iter().find(|(_, bounds, value)| !holds(&widened(bounds), value)) {
            Some((name, bounds, value)) => wrong(format!("{name} {value:.70} is not in {:?}", bounds.to_f64_bounds())),
            None => Ok(()),
        }
    }

    /// A graze that is an impact is passed; before it there is none.
    fn graze(&mut self, graze: &Touch) -> Compared<()> {
        let bounds = self.orbit.touch_time(graze);
        let truth = self.truth()?;
        let Truth::Contact { time, wall: hit, velocity_before } = truth else { return Ok(()) };
        if time < float(bounds.inf()) {
            return wrong(format!("a graze from {:?}, but an impact on {hit:?} at {time:.70}", bounds.to_f64_bounds()));
        }
        if hit == wall(graze.wall) && holds(&bounds, &time) {
            self.start = Contact { time, wall: hit, velocity_before }.after(self.problem);
        }
        self.passed = ImpactVerdict::Grazed;
        Ok(())
    }

    /// Checks a rest: at once, or after bounces on one wall of which the first is before the rest.
    fn rest(&mut self, rest: &Rest) -> Compared<()> {
        let end = self.orbit.rest_time(rest);
        let is_there = self.start.on == Some(wall(rest.at.wall));
        match self.truth()? {
            Truth::Rests if is_there && holds(&widened(&end), &self.start.time) => Ok(()),
            Truth::Contact { time, wall: hit, .. }
                if is_there
                    && rest.is_accumulation
                    && hit == wall(rest.at.wall)
                    && time <= float(widened(&end).sup()) =>
            {
                Ok(())
            }
            other => wrong(format!("{rest:?}, but the truth is {other:?}")),
        }
    }

    /// Checks a release: at whole forcing periods on the left, half a period later on the right; at most half a period after the rest.
    fn release(&mut self, rest: &Rest, release: &Touch) -> Compared<()> {
        let [lower, upper, began] = [
            self.orbit.touch_time(release).inf(),
            self.orbit.touch_time(release).sup(),
            self.orbit.rest_time(rest).sup(),
        ]
        .map(float);
        let shift = if release.wall == LibraryWall::Left { 0.0 } else { 0.5 };
        let time = (Float::with_val(BITS, &lower - shift)).round() + shift;
        let since = Float::with_val(BITS, &time - &began);
        let late = 1e-9;
        if !(lower <= time && time <= upper && release.wall == rest.at.wall && since >= -late && since <= 0.5 + late) {
            return wrong(format!("{release:?} at {time}, after {rest:?}"));
        }
        self.start = Start::on_wall(self.problem, wall(release.wall), &time, 0);
        self.passed = ImpactVerdict::Released;
        Ok(())
    }

    fn ended(&self) -> Compared<()> {
        let outcome = self.orbit.outcome().expect("it has ended");
        let truth = self.truth()?;
        match (outcome, &truth) {
            (Outcome::Undecided { reason, .. }, _) => Err((ImpactVerdict::Undecided, reason.name().into())),
            (Outcome::NeverImpacts, Truth::Never) | (Outcome::RestsForever(_), Truth::Rests) => {
                Err((ImpactVerdict::Still, String::new()))
            }
            _ => wrong(format!("{outcome:?}, but the truth is {truth:?}")),
        }
    }

    /// Follows both up to the first impact.
    fn first_impact(&mut self) -> Compared<()> {
        let mut rest = None;
        loop {
            match self.orbit.advance() {
                Progress::Impact(impact) => return self.impact(&impact),
                Progress::Graze(graze) => self.graze(&graze.at)?,
                Progress::Rest(at) => {
                    self.rest(&at)?;
                    rest = Some(at);
                }
                Progress::Release(release) => self.release(rest.as_ref().expect("after a rest"), &release)?,
                Progress::Retraced(_) => {}
                Progress::Ended => return self.ended(),
            }
        }
    }
}

/// Runs a scene of `W = 2 pi` and `tau = 0` and judges its first impact; with words on what is not right.
pub fn judge(scene: &Scene, (problem, start): (&Problem, &Start), settings: Settings) -> (ImpactVerdict, String) {
    let Ok(orbit) = Orbit::of(scene, Settings { impacts: Some(1), ..settings }) else {
        return (ImpactVerdict::NoScene, String::new());
    };
    let mut pair = Pair { problem, start: start.clone(), orbit, passed: ImpactVerdict::Right };
    match pair.first_impact() {
        Ok(()) => (pair.passed, String::new()),
        Err(judged) => judged,
    }
}
