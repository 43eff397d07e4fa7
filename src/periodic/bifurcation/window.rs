//! A window of a parameter in which a periodic orbit is stable, from a fold to a loss of stability, proved. Lemmas Y8, Y9
//!
//! Floating point finds orbits of given traces along the branch; the orbits between the two ends are proved in `between`.

use num_rational::BigRational;

use super::super::Precision;
use super::super::chain::Chain;
use super::super::chained::OneHarmonic;
use super::super::orbit::PeriodicOrbit;
use super::super::{Problem, Stability};
use super::between::{Between, Known, Reached};
use super::branch::{Branch, WindowSeed};
use super::claim::{Setting, prove_critical};
use super::over::Parameter;
use super::point::{Kind, Point};
use super::ring::Ring;
use super::trace::null_vector;
use crate::Error;
use crate::exact::{Enclosure, Exact};
use crate::pair::ImpactPair;
use crate::scene::Range;
use crate::watch::Watch;

/// An end of a window, proved.
#[derive(Clone, Debug)]
pub struct WindowEnd {
    /// The bifurcation there.
    pub point: Point,
    /// The value of the parameter, in the units of the scene.
    pub parameter: Enclosure,
}

/// The reason why no stable orbit is proved near a seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoWindow {
    /// The seed is no periodic orbit of a word.
    Seed,
    /// Floating point does not follow the branch.
    Branch,
    /// There is no value to prove an orbit at.
    Value,
    /// The orbit is not proved.
    Orbit,
    /// The orbit is not proved to be stable.
    Stability,
    /// A flight has an earlier contact.
    Virtual,
    /// The orbit's impacts are not proved to be those of one least period.
    Period,
}

impl NoWindow {
    /// The reason in words, for messages.
    pub fn reason(self) -> &'static str {
        match self {
            Self::Seed => "no periodic orbit has its walls and takes its number of forcing periods",
            Self::Branch => "floating point does not follow the branch to the eigenvalues 1 and -1",
            Self::Value => "its window has no value of the parameter with a pair",
            Self::Orbit => "existence is not proved at the value in the middle of its window",
            Self::Stability => "stability is not proved at the value in the middle of its window",
            Self::Virtual => "it is virtual: a flight has an earlier contact",
            Self::Period => "its impacts are not proved to be those of one least period",
        }
    }
}

/// A stable periodic orbit at an exact value of a parameter, and its window.
#[derive(Clone, Debug)]
pub struct Window {
    /// The value of the parameter, in the units of the scene.
    pub at: Exact,
    /// The problem that it is an orbit of, at this value.
    pub problem: Problem,
    /// The orbit at this value.
    pub orbit: PeriodicOrbit,
    /// The ends in the order of the parameter; `None` where one is not proved.
    pub ends: [Option<WindowEnd>; 2],
    /// `true` if for each value between the bounds of the ends a stable orbit of the word is proved, each flight to its first contact,
    /// all on one curve, which leads through `orbit` from one end to the other.
    pub is_stable_between: bool,
    /// The reason why that is not proved, if it is not.
    pub reason: Option<&'static str>,
}

impl Window {
    /// Proves the stable orbit near a seed and its window, or gives the reason why no stable orbit is proved. Lemmas Y8, Y9
    ///
    /// # Errors
    /// With several harmonics, if the range is not one of the parameter's, or a value exceeds the range of exact expressions.
    ///
    /// ```
    /// use impact_pair::Scene;
    /// use impact_pair::periodic::Precision;
    /// use impact_pair::periodic::bifurcation::{Window, WindowSeed};
    /// use impact_pair::watch::Unwatched;
    /// let scene = Scene::parse(r#"
    ///     excitation = { amplitude = 0.3, frequency = "pi", phase = 0 }
    ///     pair = { gap = 1, restitution = 0.8 }
    ///     start = { time = 0, wall = "left", velocity = -1 }
    /// "#)?;
    /// // Two impacts per period, from the fold of the closed forms (66)-(69) to the pitchfork.
    /// let seed = WindowSeed { word: "RL".parse()?, cycles: 1, is_mirrored: true, phases: vec![0.28], parameter: 0.3 };
    /// let over = "amplitude=0.03..0.4".parse()?;
    /// let window = Window::of(scene.pair(), &over, &seed, Precision::default(), &Unwatched)?.expect("proved");
    /// assert!(window.is_certified());
    /// # Ok::<(), impact_pair::Error>(())
    /// ```
    pub fn of(
        pair: &ImpactPair,
        over: &Range,
        seed: &WindowSeed,
        precision: Precision,
        watch: &dyn Watch,
    ) -> Result<Result<Self, NoWindow>, Error> {
        pair.harmonic("a window")?;
        let parameter = Parameter::new(pair, over)?;
        let base = OneHarmonic::of(&parameter.base()?)?;
        let chain = Chain::new(&seed.word, seed.cycles)?;
        let ring = if seed.is_mirrored { Ring::mirrored(&chain) } else { Some(Ring::whole(chain)) };
        let Some((unknown, ring)) = parameter.unknown.zip(ring) else { return Ok(Err(NoWindow::Seed)) };
        let setting = Setting { unknown, base: &base, parameter: &parameter };
        Proving { setting, ring: &ring, precision, watch }.window(seed)
    }

    /// Whether all is proved: the orbit with its stability, both ends, and the orbits between.
    pub fn is_certified(&self) -> bool {
        self.is_stable_between
            && self.ends.iter().all(Option::is_some)
            && self.orbit.is_decided()
            && self.orbit.is_narrow
    }

    /// Approximate width of the window, in units of the parameter; `None` where an end is not proved.
    pub fn width(&self) -> Option<f64> {
        let [from, to] = [self.ends[0].as_ref()?, self.ends[1].as_ref()?];
        Some(to.parameter.sub(&from.parameter, 64).mid_rad().0)
    }
}

/// Digits of the ends beyond those of the width.
const END_DIGITS: f64 = 4.0;
/// A value lies no farther from the middle of its window than that part of it.
const MIDDLE_PART: i64 = 4;
/// Digits of a value at most.
const MOST_DIGITS: u32 = 400;

/// The eigenvalues at the two ends of a branch.
const MULTIPLIERS: [f64; 2] = [1.0, -1.0];

struct Proving<'p> {
    setting: Setting<'p, OneHarmonic>,
    ring: &'p Ring,
    precision: Precision,
    watch: &'p dyn Watch,
}

impl Proving<'_> {
    fn window(&self, seed: &WindowSeed) -> Result<Result<Window, NoWindow>, Error> {
        let floats = self.setting.floats();
        let Some(branch) = Branch::through(seed, self.ring, &floats) else { return Ok(Err(NoWindow::Branch)) };
        let parameter = |x: &[f64]| x[x.len() - 1];
        let ends = branch.ends.each_ref().map(|end| &end[0].1[..]);
        let [a, b] = ends.map(parameter);
        let width = ((a - b) / a).abs();
        // Digits that distinguish the ends of the window.
        let digits = (END_DIGITS - width.max(f64::MIN_POSITIVE).log10()).ceil() as u32; // proposes
        let digits = digits.max(self.precision.digits); // proposes: digits to prove it to
        let fine = Precision { digits, ..self.precision };
        let flip = if self.ring.is_mirrored() { Kind::Pitchfork } else { Kind::PeriodDoubling };
        let directions = [0, 1].map(|i| null_vector(self.ring, &floats, ends[i], MULTIPLIERS[i]));
        let [Some(one), Some(other)] = directions else { return Ok(Err(NoWindow::Branch)) };
        let directions = [one, other];
        let points = [(0, Kind::Fold), (1, flip)].map(|(i, kind)| {
            let critical = (kind, MULTIPLIERS[i], directions[i].clone());
            self.watch.goes_on().then(|| prove_critical(&self.setting, self.ring, critical, ends[i], fine)).flatten()
        });
        let Some(at) = self.value(&points, [a, b])? else { return Ok(Err(NoWindow::Value)) };
        let (problem, orbit) = match self.orbit(&at, &branch.inner, fine)? {
            Ok(proved) => proved,
            Err(none) => return Ok(Err(none)),
        };
        let between = match &points {
            [Some(fold), Some(flip)] => {
                let reached = |i: usize, point| Reached {
                    stations: &branch.ends[i],
                    point,
                    direction: &directions[i],
                    mu: MULTIPLIERS[i],
                };
                let known = Known { parameter: self.setting.parameter.without_units(&at)?, orbit: &orbit };
                let (setting, ring) = (&self.setting, self.ring);
                let ends = [reached(0, fold), reached(1, flip)];
                Between { setting, ring, ends, middle: &branch.between, known, watch: self.watch }.prove(width)
            }
            [None, _] => Err("the fold is not proved"),
            _ => Err("the loss of stability is not proved"),
        };
        let ends = self.ends(points, [a, b])?;
        let (is_stable_between, reason) = (between.is_ok(), between.err());
        Ok(Ok(Window { at, problem, orbit, ends, is_stable_between, reason }))
    }

    /// The stable orbit at a value of the parameter, near one of floating point, and its problem.
    fn orbit(
        &self,
        at: &Exact,
        inner: &[f64],
        precision: Precision,
    ) -> Result<Result<(Problem, PeriodicOrbit), NoWindow>, Error> {
        // A value that no pair has is none of an orbit.
        let Ok(there) = self.setting.parameter.pair_at(at.clone()) else { return Ok(Err(NoWindow::Value)) };
        let problem = Problem::new(&there, &self.ring.word(), self.ring.chain().cycles())?;
        let inner = self.ring.lift(&inner[..self.ring.unknowns()]);
        let Some(orbit) = problem.prove(&inner, precision) else { return Ok(Err(NoWindow::Orbit)) };
        if orbit.stability != Stability::Stable {
            return Ok(Err(NoWindow::Stability));
        }
        if orbit.physical == Some(false) {
            return Ok(Err(NoWindow::Virtual));
        }
        // Y9: then it is its own mirror image after the impacts of a mirrored ring
        if problem.reduced_impacts(&orbit) != Some(self.ring.unknowns()) {
            return Ok(Err(NoWindow::Period));
        }
        Ok(Ok((problem, orbit)))
    }

    /// The ends in the order of the parameter; where one is not proved, in that of the floating-point values `about`.
    fn ends(&self, points: [Option<Point>; 2], about: [f64; 2]) -> Result<[Option<WindowEnd>; 2], Error> {
        let end = |point: Option<Point>| -> Result<Option<WindowEnd>, Error> {
            let Some(point) = point else { return Ok(None) };
            let (parameter, _) = self.setting.parameter.in_units(&point.parameter, point.bits)?;
            Ok(Some(WindowEnd { point, parameter }))
        };
        let [one, other] = points;
        let mut ends = [end(one)?, end(other)?];
        let is_reversed = match &ends {
            [Some(one), Some(other)] => one.parameter.inf() > other.parameter.inf(),
            _ => about.map(|x| self.setting.parameter.range_f64([x; 2])[0]).is_sorted_by(|x, y| x > y),
        };
        if is_reversed {
            ends.reverse();
        }
        Ok(ends)
    }

    /// A value of the parameter in the middle of the window, with few digits; `None` where there is none.
    fn value(&self, points: &[Option<Point>; 2], [a, b]: [f64; 2]) -> Result<Option<Exact>, Error> {
        let in_units = |point: &Point| self.setting.parameter.in_units(&point.parameter, point.bits);
        let known = match points {
            [Some(fold), Some(flip)] => {
                let [fold, flip] = [in_units(fold)?.0, in_units(flip)?.0];
                let (fold, flip) = if fold.inf() < flip.inf() { (fold, flip) } else { (flip, fold) };
                Some([fold.sup().to_rational(), flip.inf().to_rational()])
            }
            _ => {
                let [low, high] = self.setting.parameter.range_f64([a, b]);
                BigRational::from_float(low).zip(BigRational::from_float(high)).map(<[_; 2]>::from)
            }
        };
        let Some([low, high]) = known.filter(|[low, high]| low < high) else { return Ok(None) };
        let part = (&high - &low) / BigRational::from_integer(MIDDLE_PART.into());
        let middle = (&low + &high) / BigRational::from_integer(2.into());
        let ten = BigRational::from_integer(10.into());
        let mut scale = BigRational::from_integer(1.into());
        for _ in 0..MOST_DIGITS {
            let rounded = (&middle * &scale).round() / &scale; // exact: a fraction; the value is what it is
            if (&rounded - &middle) <= part && (&middle - &rounded) <= part {
                return Ok(Some(Exact::from_rational(rounded)));
            }
            scale *= &ten;
        }
        Ok(None)
    }
}
