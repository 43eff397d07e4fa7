//! A window of a parameter in which a periodic orbit is stable, from a fold to a loss of stability, proved. Lemma Y8
//!
//! Floating point finds orbits of given traces along the branch. From each end, where an eigenvalue is 1 or -1, the branch is followed as a curve
//! over that eigenvalue; between, where the eigenvalues may be complex, as a curve of orbits that have neither 1 nor -1 for an eigenvalue.

use std::cmp::Ordering;

use nalgebra::{DMatrix, Scalar};
use num_rational::BigRational;

use super::super::Precision;
use super::super::chain::Chain;
use super::super::chained::{Chained, OneHarmonic};
use super::super::equations::flights;
use super::super::krawczyk::{Equations, image, is_inside};
use super::super::orbit::PeriodicOrbit;
use super::super::precondition::Preconditioner;
use super::super::{Problem, Stability, determinant};
use super::claim::{Setting, prove_critical};
use super::family::{Family, Varied};
use super::over::Parameter;
use super::point::{Kind, Point};
use super::ring::Ring;
use super::solve::newton;
use super::system::{Curve, Multiplied, Traced};
use super::trace::{null_vector, twisted_matrix};
use super::tube::{Proof, Tube, take_time};
use crate::Error;
use crate::exact::{Enclosure, Exact};
use crate::mapping::Word;
#[cfg(feature = "multiprecision")]
use crate::number::MpBall;
use crate::number::{Ball, Enclosing};
use crate::pair::ImpactPair;
use crate::scene::Range;
use crate::several::Turning;
use crate::watch::Watch;

/// An orbit near which a window may be, in floating point.
#[derive(Clone, Debug)]
pub struct WindowSeed {
    /// The walls of its impacts.
    pub word: Word,
    /// The forcing periods it takes.
    pub cycles: u32,
    /// Whether it is its own mirror image after half of them.
    pub is_mirrored: bool,
    /// The phases of its impacts, of one half where it is mirrored, in forcing periods.
    pub phases: Vec<f64>,
    /// `A/d`, or `e` where that varies.
    pub parameter: f64,
}

/// An end of a window, proved.
#[derive(Clone, Debug)]
pub struct WindowEnd {
    /// What happens there.
    pub point: Point,
    /// The value of the parameter, in the units of the scene.
    pub parameter: Enclosure,
}

/// Why no stable orbit is proved near a seed.
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
    /// It is not proved to be stable.
    Stability,
    /// A flight has an earlier contact.
    Virtual,
}

impl NoWindow {
    /// Returns it in words.
    pub fn reason(self) -> &'static str {
        match self {
            Self::Seed => "no periodic orbit has its walls and takes its number of forcing periods",
            Self::Branch => "floating point does not follow the branch to the eigenvalues 1 and -1",
            Self::Value => "its window has no value of the parameter with a pair",
            Self::Orbit => "existence is not proved at the value in the middle of its window",
            Self::Stability => "stability is not proved at the value in the middle of its window",
            Self::Virtual => "it is virtual: a flight has an earlier contact",
        }
    }
}

/// A stable periodic orbit at an exact value of a parameter, and its window.
#[derive(Clone, Debug)]
pub struct Window {
    /// The value of the parameter, in the units of the scene.
    pub at: Exact,
    /// What it is an orbit of, at this value.
    pub problem: Problem,
    /// The orbit at this value.
    pub orbit: PeriodicOrbit,
    /// The ends in the order of the parameter; `None` where one is not proved.
    pub ends: [Option<WindowEnd>; 2],
    /// Whether for each value between the bounds of the ends a stable orbit of the word is proved, each flight to its first contact.
    pub is_stable_between: bool,
    /// Why that is not proved, if it is not.
    pub reason: Option<&'static str>,
}

impl Window {
    /// Proves the stable orbit near a seed and its window, or says why no stable orbit is proved. Lemma Y8
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

    /// Returns whether all is proved: the orbit with its stability, both ends, and the orbits between.
    pub fn is_certified(&self) -> bool {
        self.is_stable_between
            && self.ends.iter().all(Option::is_some)
            && self.orbit.is_decided()
            && self.orbit.is_narrow
    }

    /// Returns how wide the window is, about; `None` where an end is not proved.
    pub fn width(&self) -> Option<f64> {
        let [from, to] = [self.ends[0].as_ref()?, self.ends[1].as_ref()?];
        Some(to.parameter.sub(&from.parameter, 64).mid_rad().0)
    }
}

/// Where a curve over an eigenvalue has a station, in parts of the way from the inner one to an end.
const STATIONS: [f64; 5] = [1.0, 0.75, 0.5, 0.25, 0.0];
/// The eigenvalue at which the curve between begins, if that is far from where both are one.
const LEAST: f64 = 0.2;
/// The trace at the orbit itself, which lies about the middle of a window.
const INNER: f64 = -0.4;
/// A window relatively narrower is proved in more bits than doubles have, where there are such.
const NARROW: f64 = 1e-10;
/// In doubles: steps to the centre of a slab, and what is added to radii.
const STEPS: u32 = 12;
const PAD: f64 = 1e-14;
/// Digits of the ends beyond those of the width.
const END_DIGITS: f64 = 4.0;
/// A value lies no farther from the middle of its window than that part of it.
const MIDDLE: i64 = 4;
/// Digits of a value at most.
const MOST_DIGITS: u32 = 400;

/// The branch in floating point: orbits with the phases and the parameter, by their eigenvalue.
struct Branch {
    /// Of each end: the orbits at [`STATIONS`], towards the middle.
    ends: [Vec<(f64, Vec<f64>)>; 2],
    /// From the last station of the one to that of the other.
    between: Vec<Vec<f64>>,
    /// An orbit in the middle of the window.
    inner: Vec<f64>,
}

/// An end of the branch: the bifurcation there, and the orbits from it to the middle.
struct End<'b> {
    stations: &'b [(f64, Vec<f64>)],
    point: &'b Point,
    /// `c` of the equations of both.
    direction: &'b [f64],
    /// The eigenvalue at the bifurcation.
    mu: f64,
}

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
        let Some(branch) = self.branch(&floats, seed) else { return Ok(Err(NoWindow::Branch)) };
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
        let [fold, flip] = &points;
        let between = match (fold, flip) {
            (Some(fold), Some(flip)) => {
                let one = End { stations: &branch.ends[0], point: fold, direction: &directions[0], mu: MULTIPLIERS[0] };
                let other =
                    End { stations: &branch.ends[1], point: flip, direction: &directions[1], mu: MULTIPLIERS[1] };
                self.is_stable(&branch, &[one, other], width)
            }
            (None, _) => Err("the fold is not proved"),
            _ => Err("the loss of stability is not proved"),
        };
        let Some(at) = self.value(&points, [a, b])? else { return Ok(Err(NoWindow::Value)) };
        // A value that no pair has is none of an orbit.
        let Ok(there) = self.setting.parameter.pair_at(at.clone()) else { return Ok(Err(NoWindow::Value)) };
        let problem = Problem::new(&there, &self.ring.word(), self.ring.chain().cycles())?;
        let inner = self.ring.lift(&branch.inner[..self.ring.unknowns()]);
        let Some(orbit) = problem.prove(&inner, self.precision) else { return Ok(Err(NoWindow::Orbit)) };
        if orbit.stability != Stability::Stable {
            return Ok(Err(NoWindow::Stability));
        }
        if orbit.physical == Some(false) {
            return Ok(Err(NoWindow::Virtual));
        }
        let end = |point: Option<Point>| -> Result<Option<WindowEnd>, Error> {
            let Some(point) = point else { return Ok(None) };
            let (parameter, _) = self.setting.parameter.in_units(&point.parameter, point.bits)?;
            Ok(Some(WindowEnd { point, parameter }))
        };
        let [one, other] = points;
        let mut ends = [end(one)?, end(other)?];
        // In the order of the parameter; where an end is not proved, as far as floating point tells.
        let is_reversed = match &ends {
            [Some(one), Some(other)] => one.parameter.inf() > other.parameter.inf(),
            _ => [a, b].map(|x| self.setting.parameter.range_f64([x; 2])[0]).is_sorted_by(|x, y| x > y),
        };
        if is_reversed {
            ends.reverse();
        }
        let (is_stable_between, reason) = (between.is_ok(), between.err());
        Ok(Ok(Window { at, problem, orbit, ends, is_stable_between, reason }))
    }

    /// The branch through a seed, in floating point. Non-rigorous.
    fn branch(&self, floats: &Family<OneHarmonic, f64>, seed: &WindowSeed) -> Option<Branch> {
        let ring = self.ring;
        let q = determinant(&floats.pair(seed.parameter).restitution, ring.unknowns());
        // proposes: far from where both eigenvalues are one, sqrt(q)
        let inner = if q.sqrt() < 0.25 { LEAST.max(2.0 * q.sqrt()) } else { 0.5 * (1.0 + q.sqrt()) };
        let solved = |trace: f64, x: Vec<f64>| newton(&Traced { ring, trace }, floats, x);
        let start = solved(0.0, [&seed.phases[..], &[seed.parameter]].concat())?;
        let towards = |sign: f64| -> Option<Vec<(f64, Vec<f64>)>> {
            let mut x = start.clone();
            let mut all = Vec::new();
            for part in STATIONS.iter().rev() {
                // At the end exactly 1.
                let mu = sign * (1.0 - (1.0 - inner) * (1.0 - part));
                x = solved(mu + q / mu, x)?;
                all.push((mu, x.clone()));
            }
            all.reverse();
            Some(all)
        };
        let ends = [towards(1.0)?, towards(-1.0)?];
        let inner = solved(INNER, start.clone()).unwrap_or_else(|| start.clone()); // proposes
        let between = vec![ends[0].last()?.1.clone(), start, ends[1].last()?.1.clone()];
        Some(Branch { ends, between, inner })
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
        let part = (&high - &low) / BigRational::from_integer(MIDDLE.into());
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

    /// Proves that all orbits of the branch between the two ends are stable, or says where that fails. Lemma Y8
    fn is_stable(&self, branch: &Branch, ends: &[End<'_>; 2], width: f64) -> Result<(), &'static str> {
        let doubles = self.setting.doubles();
        let of_ball = |x: &Enclosure| {
            let (mid, rad) = x.mid_rad();
            Ball::new(mid, rad)
        };
        if width > NARROW && self.is_stable_in(&doubles, (STEPS, PAD), (branch, ends), &of_ball).is_ok() {
            return Ok(());
        }
        self.is_stable_precisely(branch, ends)
    }

    #[cfg(feature = "multiprecision")]
    fn is_stable_precisely(&self, branch: &Branch, ends: &[End<'_>; 2]) -> Result<(), &'static str> {
        const BITS: u32 = 128;
        let pad = (24.0 - f64::from(BITS)).exp2();
        let of_ball = |x: &Enclosure| MpBall::enclosing(x, BITS);
        self.is_stable_in(&self.setting.balls(BITS), (BITS / 4, pad), (branch, ends), &of_ball)
    }

    /// Doubles are all there is.
    #[cfg(not(feature = "multiprecision"))]
    fn is_stable_precisely(&self, _: &Branch, _: &[End<'_>; 2]) -> Result<(), &'static str> {
        Err("they are not proved in doubles")
    }

    fn is_stable_in<N: Enclosing + Turning + Scalar>(
        &self,
        family: &Family<OneHarmonic, N>,
        (steps, pad): (u32, f64),
        (branch, ends): (&Branch, &[End<'_>; 2]),
        of: &dyn Fn(&Enclosure) -> N,
    ) -> Result<(), &'static str> {
        let outer = |i: usize| self.outer(family, (steps, pad), &ends[i], of);
        let one = outer(0).ok_or("the orbits next to the fold are not proved")?;
        let other = outer(1).ok_or("the orbits next to the loss of stability are not proved")?;
        let floats = self.setting.floats();
        let holds =
            |x: &[N]| self.is_admissible(family, x) && [1.0, -1.0].iter().all(|mu| self.excludes(family, x, *mu));
        let tube = Tube {
            curve: &Curve(self.ring),
            over: None,
            floats: &floats,
            family,
            steps,
            pad,
            holds: &holds,
            watch: self.watch,
        };
        let middle = "the orbits in the middle are not proved";
        let [first, last] = tube.follow(&branch.between).ok_or(middle)?;
        if first.holds(&one) && last.holds(&other) { Ok(()) } else { Err(middle) }
    }

    /// Proves the orbits over an eigenvalue, from the bifurcation at the end of a window to the middle; the phases and the parameter at
    /// the inner end. Lemma Y8
    fn outer<N: Enclosing + Turning + Scalar>(
        &self,
        family: &Family<OneHarmonic, N>,
        (steps, pad): (u32, f64),
        end: &End<'_>,
        of: &dyn Fn(&Enclosure) -> N,
    ) -> Option<Vec<N>> {
        let (ring, floats) = (self.ring, self.setting.floats());
        let direction = end.direction;
        let lift = |(mu, x): &(f64, Vec<f64>)| -> Option<Vec<f64>> {
            let w = null_vector(ring, &floats, x, *mu)?;
            let along: f64 = w.iter().zip(direction).map(|(a, b)| a * b).sum();
            let (p, phases) = x.split_last()?;
            let w = w.iter().map(|w| w / along);
            Some(phases.iter().copied().chain(w).chain([*p, *mu]).collect())
        };
        let lifted: Vec<Vec<f64>> = end.stations.iter().map(lift).collect::<Option<_>>()?;
        let curve = Multiplied { ring, direction: direction.to_vec() };
        let project = |x: &[N]| -> Vec<N> { [&x[..ring.unknowns()], &x[x.len() - 2..x.len() - 1]].concat() };
        let holds = |x: &[N]| self.is_admissible(family, &project(x)) && self.is_dominant(family, x);
        // Over mu, the last unknown.
        let over = Some(2 * ring.unknowns() + 1);
        let tube = Tube { curve: &curve, over, floats: &floats, family, steps, pad, holds: &holds, watch: self.watch };
        let [first, last]: [Proof<N>; 2] = tube.follow(&lifted)?;
        let mut zero: Vec<N> = end.point.zero.iter().map(of).collect();
        zero.push(N::from_f64(end.mu));
        first.holds(&zero).then(|| project(&last.end))
    }

    /// Whether the other eigenvalue lies inside the unit circle for each member of a box: `e^(2m) < |mu|`. Lemma Y8
    fn is_dominant<N: Enclosing + Turning>(&self, family: &Family<OneHarmonic, N>, x: &[N]) -> bool {
        let (mu, p) = (&x[x.len() - 1], &x[x.len() - 2]);
        let q = determinant(&family.pair(p.clone()).restitution, self.ring.unknowns());
        let sign = if mu.as_ball().mid() < 0.0 { -1.0 } else { 1.0 }; // Y8: of the wrong sign it is not larger
        (mu.clone().signed(sign) - q).certain_sign() == Some(Ordering::Greater)
    }

    /// Whether what the lemma takes for granted holds for each member of a box of phases and a parameter: flights that take time, to
    /// their first contacts, and `0 < e < 1`. Lemma Y8
    fn is_admissible<N: Enclosing + Turning>(&self, family: &Family<OneHarmonic, N>, x: &[N]) -> bool {
        let e = x.last().map(|p| family.pair(p.clone()).restitution);
        let is_positive = |x: N| x.certain_sign() == Some(Ordering::Greater);
        e.is_some_and(|e| is_positive(e.clone()) && is_positive(N::from_f64(1.0) - e))
            && take_time(self.ring, family, x)
            && self.is_physical(x)
    }

    /// Whether no orbit of a box has the eigenvalue `mu`, 1 or -1: `F'_mu` is regular. Lemma Y8
    fn excludes<N: Enclosing + Turning + Scalar>(&self, family: &Family<OneHarmonic, N>, x: &[N], mu: f64) -> bool {
        let ring = self.ring;
        let centre: Vec<f64> = x.iter().map(|x| x.as_ball().mid()).collect();
        let regular = || {
            let inverse = Preconditioner::new(&twisted_matrix(ring, &self.setting.floats(), &centre, &mu)?)?;
            let matrix = twisted_matrix(ring, family, x, &N::from_f64(mu))?;
            // Any lengths of the coordinates: those of the box.
            let unit = |x: &N| N::from_f64(0.0).with_radius(x.as_ball().rad());
            let all: Vec<N> = x[..ring.unknowns()].iter().map(unit).collect();
            Some(is_inside(&image(&Linear(matrix), &inverse, &all)?, &all))
        };
        regular().unwrap_or(false) // exact: not proved
    }

    /// Whether each flight of the orbits of a box of phases and a parameter is proved to end at its first contact. Lemma T5
    fn is_physical<N: Enclosing>(&self, x: &[N]) -> bool {
        let balls: Vec<Ball> = x.iter().map(Enclosing::as_ball).collect();
        let proved = || {
            let (p, phases) = balls.split_last()?;
            let (_, pair) = self.setting.parameter.in_units(&p.as_enclosure()?, f64::MANTISSA_DIGITS).ok()?;
            let there = <OneHarmonic as Varied>::of(&pair)?;
            let (chain, phases) = (self.ring.chain(), self.ring.lift(phases));
            let legs = flights(chain, &self.setting.doubles().pair(*p), &phases)?;
            there.is_physical(chain, &phases, &legs)
        };
        proved() == Some(true)
    }
}

/// The equations `L w = 0`.
struct Linear<N>(DMatrix<N>);

impl<N: Enclosing> Equations<N> for Linear<N> {
    type Jacobian = DMatrix<N>;

    /// At 0.
    fn values(&self, x: &[N]) -> Option<Vec<N>> {
        Some(x.iter().map(|_| N::from_f64(0.0)).collect())
    }

    fn jacobian(&self, _: &[N]) -> Option<DMatrix<N>> {
        Some(self.0.clone())
    }
}
