//! Homoclinic tangencies: values of a parameter at which the stable and the unstable manifold of a saddle of the reduced impact map are
//! tangent, proved. Lemmas J1-J13 of `docs/proofs/tangency.md#J1`.
//!
//! The saddle is a fixed point of the map that mirrors every impact to the left wall: the equispaced motion (66), (67). Floating point looks for
//! folds of the unstable manifold near the stable one (`search`); the manifolds are Taylor series with proved errors (`series`, `local`,
//! `manifold`), the tangency is a regular zero of the equations of all flights between them (`chain`), proved by Krawczyk's operator (`prove`).

mod begin;
mod beside;
mod boxes;
mod chain;
mod disc;
mod document;
mod family;
mod flight;
mod flights;
mod local;
mod manifold;
mod only;
mod portrait;
mod proof;
mod prove;
mod saddle;
mod scene;
mod search;
mod series;
mod terms;
#[cfg(test)]
mod tests;
mod unfolding;
mod word;

use crate::exact::Enclosure;
use crate::periodic::Precision;
use crate::scene::{Key, Range};
use crate::watch::{Latched, Stage, Watch};
use crate::{Effort, Error, Scene};
pub use boxes::StateBounds;
pub use document::at_least;
pub use portrait::Portrait;
use scene::{Folds, Search};
pub use word::{FlightWord, MOST_FLIGHTS};

/// The keys over which tangencies are searched, in words.
pub const TANGENCY_PARAMETERS: &str = "KEY one of gap, amplitude, restitution, A/d";

/// Whether tangencies are searched over such a range.
pub fn is_tangency_range(range: &Range) -> bool {
    matches!(range.key(), Key::Gap | Key::Amplitude(_) | Key::Restitution) && range.count().is_none()
}

/// The settings of a search for tangencies.
#[derive(Clone, Debug)]
pub struct TangencySettings {
    /// The parameter and its range: gap, amplitude or restitution.
    pub over: Range,
    /// The flights of the orbit; `None` for a search over all of them.
    pub word: Option<FlightWord>,
    /// The most flights that are searched without a word.
    pub longest: usize,
    /// Number of tangencies that are proved at most, those nearest to the scene's own value.
    pub most: usize,
    /// A multiple of the work of the search without a word: about 30 million flights in floating point for each saddle. Following a fold to
    /// its tangency counts as 10,000 flights; as much work again is allowed for all folds.
    pub effort: Effort,
    /// Requested widths of the enclosures: of `D` and of the parameters of the manifolds, absolute.
    pub precision: Precision,
}

/// A homoclinic tangency: for exactly one value of the parameter within its bounds the two manifolds of the saddle have a common point along
/// these flights, with `unstable` and `stable` within theirs, at which they are tangent. It is quadratic, and unfolds with a speed other than 0.
#[derive(Clone, Debug)]
pub struct Tangency {
    /// The value of the parameter, in the units of the scene.
    pub parameter: Enclosure,
    /// The flights from the point of the unstable manifold to that of the stable one.
    pub flights: FlightWord,
    /// The phase of the saddle in radians, in `[0, 2 pi)`.
    pub phase: Enclosure,
    /// Speed of the saddle, over `A W`.
    pub speed: Enclosure,
    /// Eigenvalues of the saddle: the unstable one and the stable one.
    pub eigenvalues: [Enclosure; 2],
    /// The parameter of the unstable manifold, along which the phase has the derivative 1 at the saddle.
    pub unstable: Enclosure,
    /// The parameter of the stable manifold, with the same derivative.
    pub stable: Enclosure,
    /// `q` of Lemma J5, not 0: the relative curvature of the two manifolds.
    pub quadratic: Enclosure,
    /// `m` of Lemma J5, not 0: the speed at which the manifolds pass through each other, per unit of `D = d/A`.
    pub unfolding: Enclosure,
    /// A lower bound of all speeds of the orbit, over `A W`.
    pub least_speed: f64,
    /// A lower bound of all its flights, in radians.
    pub least_flight: f64,
    /// No product of powers of the eigenvalues of an order from 2 to this one is one of them.
    pub resonances_excluded_to: u32,
    /// Bounds of the states between both points, where a datum of the scene is an interval. For each value of that datum there is exactly
    /// one value of the parameter with a tangency whose `unstable`, `stable`, parameter and states are in their bounds; all other bounds
    /// hold for each.
    pub states: Option<Vec<StateBounds>>,
    /// The common points on either side; `None` where they are not proved.
    pub beside: Option<Beside>,
}

/// The numbers of common points of the two manifolds on either side of a tangency, along its flights, with their `sigma_u`, `sigma_s` and
/// the states between both in these boxes.
#[derive(Clone, Debug)]
pub struct Beside {
    /// Values of the parameter, in the units of the scene: for each there are exactly two common points.
    pub two: Enclosure,
    /// Values of the parameter, in the units of the scene: for each there is no common point.
    pub none: Enclosure,
    /// The range of `sigma_u`.
    pub unstable: Enclosure,
    /// The range of `sigma_s`.
    pub stable: Enclosure,
    /// The boxes of the states.
    pub states: Vec<StateBounds>,
}

/// A tangency of floating point that is not proved.
#[derive(Clone, Debug)]
pub struct UnprovedTangency {
    /// The value of the parameter near which the fold is, in the units of the scene.
    pub near: f64,
    /// The flights of the fold.
    pub flights: FlightWord,
}

/// The tangencies found over a parameter. That there are no others is not proved.
#[derive(Clone, Debug)]
pub struct Tangencies {
    /// The parameter and its range.
    pub over: Range,
    /// The tangencies proved, the nearest to the scene's own value first.
    pub tangencies: Vec<Tangency>,
    /// Folds of floating point of which nothing is proved.
    pub unproved: Vec<UnprovedTangency>,
    /// `true` if it was interrupted before the search or the proofs were done.
    pub interrupted: bool,
    /// `true` if the search ended at the limit of its work before all words and all folds were tried.
    pub limited: bool,
}

impl TangencySettings {
    /// The work for each saddle, in flights: with the usual effort some 20 seconds.
    fn work(&self) -> usize {
        usize::try_from(self.effort.times(30_000_000)).unwrap_or(usize::MAX) // proposes: when to give up
    }
}

impl Tangencies {
    /// Searches tangencies of the manifolds of the equispaced motion and proves them, until the watch stops it.
    ///
    /// # Errors
    /// With several harmonics, if the range is not one of the parameter's, or if over the gap the amplitude is an interval, or over the
    /// amplitude the gap.
    ///
    /// ```
    /// use impact_pair::periodic::Precision;
    /// use impact_pair::tangency::{Tangencies, TangencySettings};
    /// use impact_pair::watch::Unwatched;
    /// use impact_pair::{Effort, Scene};
    /// let scene = Scene::parse(r#"
    ///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
    ///     pair = { gap = 9.42497, restitution = 0.5 }
    ///     start = { time = 0, wall = "left", velocity = -1 }
    /// "#)?;
    /// let settings = TangencySettings {
    ///     over: "gap=9.4249..9.4252".parse()?,
    ///     word: Some("FFFFFFFNFFFFFNFFNFFNFFFF".parse()?),
    ///     longest: 24,
    ///     most: 1,
    ///     effort: Effort::default(),
    ///     precision: Precision::default(),
    /// };
    /// let found = Tangencies::of(&scene, &settings, &Unwatched)?;
    /// assert_eq!(format!("{:.10}", found.tangencies[0].parameter.mid_rad().0), "9.4251263769");
    /// # Ok::<(), impact_pair::Error>(())
    /// ```
    pub fn of(scene: &Scene, settings: &TangencySettings, watch: &dyn Watch) -> Result<Self, Error> {
        let watch = Latched::new(watch);
        let search = Search::new(scene.pair(), settings)?;
        let Folds { folds, limited } = search.folds(settings, &watch);
        let (over, tangencies, unproved) = (settings.over.clone(), Vec::new(), Vec::new());
        let mut all = Self { over, tangencies, unproved, interrupted: false, limited };
        for (i, fold) in folds.iter().enumerate() {
            let at = Stage::Tangencies { proved: i, of: folds.len() };
            if all.tangencies.len() >= settings.most || watch.proceed(at).is_break() {
                break;
            }
            let flights = FlightWord(fold.flights.clone());
            match prove::tangency(fold, &search.request) {
                Some(proof) => {
                    let found = search.tangency(proof)?;
                    if search.is_inside(&found.parameter)? && all.tangencies.iter().all(|known| !known.meets(&found)) {
                        all.tangencies.push(found);
                    }
                }
                None => all
                    .unproved
                    .push(UnprovedTangency { near: search.in_units_f64(search.own_of(&fold.pair)), flights }),
            }
        }
        all.interrupted = watch.is_stopped();
        Ok(all)
    }

    /// Whether there are tangencies, the search was not cut short, and all folds that were tried are proved to lead to one.
    pub fn is_certified(&self) -> bool {
        !self.interrupted && !self.limited && self.unproved.is_empty() && !self.tangencies.is_empty()
    }
}

impl UnprovedTangency {
    /// Reason why the tangency is undecided.
    pub const REASON: &str = "the tangency near this fold of floating point, or one of its flights, is not proved";
}

impl Tangency {
    /// Whether another tangency may be at the same value.
    fn meets(&self, other: &Self) -> bool {
        self.parameter.intersection(&other.parameter).is_some()
    }
}
