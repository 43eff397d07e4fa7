//! One orbit in every arithmetic, and what must hold between them.
#![allow(dead_code)] // each test crate uses a part

use super::scene::{Scene, float, holds};
use impact_pair::exact::Enclosure;
use impact_pair::orbit::{Arithmetic, Impact, Orbit, Outcome, Progress, Settings};
use impact_pair::pair::Wall as LibraryWall;
use impact_pair_truth::{Contact, Wall};
use rug::Float;
use rug::float::Constant;
use rug::ops::Pow;

/// An arithmetic and the digits asked of it.
pub type Kind = (Arithmetic, u32);

/// All that certify, narrower ones first; `auto` at each of its digits; the textbook's method.
pub const CERTIFIED: [Kind; 11] = [
    (Arithmetic::Interval, 9),
    (Arithmetic::Bits(64), 9),
    (Arithmetic::Bits(128), 9),
    (Arithmetic::Bits(256), 9),
    (Arithmetic::Bits(512), 9),
    (Arithmetic::Auto, 3),
    (Arithmetic::Auto, 9),
    (Arithmetic::Auto, 15),
    (Arithmetic::Auto, 30),
    (Arithmetic::Auto, 100),
    (Arithmetic::Inari, 9),
];

/// Bits that decide whatever here is decidable; what is not (exact grazes) is then given up soon.
const MOST_BITS: u32 = 1 << 15;

/// An orbit that has ended.
pub struct Run {
    pub kind: Kind,
    pub orbit: Orbit,
    pub impacts: Vec<Impact>,
    /// Bounds of time and velocity of each impact.
    pub bounds: Vec<(Enclosure, Enclosure)>,
    /// Number of calls to advance.
    pub steps: u64,
    /// True if it grazes or rests after the impacts.
    pub rests: bool,
}

impl Run {
    /// **Panics** when the orbit does not end within the greatest number of steps that an orbit without a hang takes.
    pub fn new(scene: &Scene, kind: Kind, impacts: u64) -> Run {
        let settings = Settings { digits: kind.1, arithmetic: kind.0, max_bits: MOST_BITS, ..Settings::default() };
        Run::within(scene, settings, impacts)
    }

    pub fn within(scene: &Scene, settings: Settings, impacts: u64) -> Run {
        let (pair, start) = scene.library().unwrap_or_else(|error| panic!("{error}: {scene:?}"));
        let settings = Settings { impacts: Some(impacts), ..settings };
        let kind = (settings.arithmetic, settings.digits);
        let mut orbit = Orbit::new(&pair, &start, settings).unwrap_or_else(|error| panic!("{error}: {scene:?}"));
        let (mut found, mut steps, mut rests) = (Vec::new(), 0, false);
        loop {
            steps += 1;
            // A restart at most doubles the bits, which are a million at most: some twenty passes.
            assert!(steps <= 40 * (impacts + 2), "{kind:?} goes on and on: {scene:?}");
            match orbit.advance() {
                Progress::Impact(impact) if !rests => found.push(impact),
                // The truth ends at a graze or a rest; `validation/arb` goes on.
                Progress::Graze(_) | Progress::Rest(_) => rests = true,
                Progress::Impact(_) | Progress::Retraced(_) | Progress::Release(_) => {}
                Progress::Ended => break,
            }
        }
        let bounds = found.iter().map(|impact| orbit.bounds(impact)).collect();
        Run { kind, orbit, impacts: found, bounds, steps, rests }
    }

    pub fn len(&self) -> usize {
        self.impacts.len()
    }

    pub fn outcome(&self) -> &Outcome {
        self.orbit.outcome().expect("the orbit ended")
    }

    /// The end in a few words.
    pub fn end(&self) -> String {
        match self.outcome() {
            Outcome::Undecided { reason, .. } => reason.name().into(),
            reached => reached.kind().into(),
        }
    }

    /// The widths of the bounds of an impact in units of `2 pi/W` and `A W`.
    pub fn widths(&self, scene: &Scene, index: usize) -> [Float; 2] {
        const BITS: u32 = 128;
        let (amplitude, omega) = (scene.amplitude.member(BITS, 0.0), scene.omega.member(BITS, 0.0));
        let period = Float::with_val(BITS, Constant::Pi) * 2 / &omega;
        let (time, velocity) = &self.bounds[index];
        [float(&time.wid()) / period, float(&velocity.wid()) / (amplitude * omega)]
    }

    /// Asserts that no width is beyond the requested digits.
    pub fn assert_narrow(&self, scene: &Scene) {
        let most = Float::with_val(128, 10).pow(-(self.kind.1 as i32));
        for index in 0..self.len() {
            for (width, of) in self.widths(scene, index).into_iter().zip(["time", "velocity"]) {
                assert!(width <= most, "{:?}: {of} of impact {} is {width:.3} wide: {scene:?}", self.kind, index + 1);
            }
        }
    }

    /// The first contradiction to the truth in words, or `None`.
    pub fn objection(&self, truth: &[Contact]) -> Option<String> {
        for (index, (impact, (time, velocity))) in self.impacts.iter().zip(&self.bounds).enumerate() {
            let number = index as u64 + 1;
            let Some(contact) = truth.get(index) else {
                return Some(format!("{:?}: impact {number}, but the truth ends before", self.kind));
            };
            if impact.index != number || is_left(impact) != (contact.wall == Wall::Left) {
                return Some(format!("{:?}: {impact:?}, but number {number} is {contact:?}", self.kind));
            }
            for (name, bounds, value) in
                [("time", time, &contact.time), ("velocity", velocity, &contact.velocity_before)]
            {
                if !holds(bounds, value) {
                    let (low, high) = bounds.to_f64_bounds();
                    return Some(format!("{:?}: {name} {number} {value:.60} is not in [{low:e}, {high:e}]", self.kind));
                }
            }
        }
        None
    }

    /// Asserts that both have the same word and enclosures that meet, as far as both go.
    pub fn assert_meets(&self, other: &Run, scene: &Scene) {
        let both = |index: usize| format!("{:?}, {:?}, impact {}: {scene:?}", self.kind, other.kind, index + 1);
        for (index, (a, b)) in self.impacts.iter().zip(&other.impacts).enumerate() {
            assert_eq!((a.wall, a.mapping), (b.wall, b.mapping), "{}", both(index));
            let (a, b) = (&self.bounds[index], &other.bounds[index]);
            assert!(a.0.intersection(&b.0).is_some(), "times do not meet: {}", both(index));
            assert!(a.1.intersection(&b.1).is_some(), "velocities do not meet: {}", both(index));
        }
    }
}

fn is_left(impact: &Impact) -> bool {
    impact.wall == LibraryWall::Left
}

/// The first impact that plain doubles get wrong: another wall, or a time off by a millionth of a period.
pub fn first_wrong(scene: &Scene, run: &Run, truth: &[Contact]) -> Option<usize> {
    let limit = 1e-6 * std::f64::consts::TAU / scene.omega.member(64, 0.0).to_f64();
    run.impacts.iter().zip(&run.bounds).enumerate().position(|(index, (impact, (time, _)))| {
        let Some(contact) = truth.get(index) else { return true };
        let off = Float::with_val(64, float(time.inf()) - &contact.time).to_f64().abs();
        is_left(impact) != (contact.wall == Wall::Left) || off > limit
    })
}

/// Runs every certified arithmetic and asserts all of the above; the runs in the order of [`CERTIFIED`].
///
/// The truth at `bits` is computed again at thrice the bits before anything is called wrong.
pub fn assert_stable(scene: &Scene, impacts: u64, bits: u32) -> Vec<Run> {
    let runs: Vec<Run> = CERTIFIED.into_iter().map(|kind| Run::new(scene, kind, impacts)).collect();
    let most = runs.iter().map(Run::len).max().expect("runs");
    let truth = scene.truth(bits, [0.0; 5], most);
    if runs.iter().any(|run| run.objection(&truth).is_some()) {
        let truth = scene.truth(3 * bits, [0.0; 5], most);
        for run in &runs {
            if let Some(objection) = run.objection(&truth) {
                panic!("{objection}; {scene:?}");
            }
        }
    }
    for (index, run) in runs.iter().enumerate() {
        for narrower in &runs[..index] {
            run.assert_meets(narrower, scene);
        }
        if run.kind.0 == Arithmetic::Auto {
            run.assert_narrow(scene);
        }
    }
    let float = Run::new(scene, (Arithmetic::Float, 9), impacts);
    let wrong = first_wrong(scene, &float, &scene.truth(bits, [0.0; 5], float.len()));
    let ends: Vec<_> = runs.iter().map(|run| format!("{} {}", run.len(), run.end())).collect();
    println!("{}; float is wrong from impact {:?} of {}", ends.join(", "), wrong.map(|index| index + 1), float.len());
    runs
}
