//! The exact pair and start of the motion that is followed, for any arithmetic.

use std::sync::Arc;

use super::motion::{FloatMotion, IntervalMotion, Motion};
use super::plan::Plan;
use super::precise::PreciseMotion;
use super::shadowed::ShadowMotion;
use super::splice::Splice;
#[cfg(all(feature = "inari", target_feature = "fma"))]
use super::textbook::TextbookMotion;
use super::{Arithmetic, Start};
use crate::Error;
use crate::clock::Clock;
use crate::exact::Exact;
use crate::number::Ball;
use crate::pair::{ImpactPair, ball};
use crate::shaken::{Either, Flying, Origin, Released, Shaken, under};

/// A pair and a start.
#[derive(Clone, Debug)]
pub(super) struct Given {
    pub pair: Arc<ImpactPair>,
    /// The pair without units, with one harmonic or several.
    pub shaken: Arc<dyn Motions>,
    /// The start or a later state of its motion, or the last release.
    pub origin: Origin<Exact>,
}

/// The motions under the excitation: what follows is compiled for each kind of it.
pub(super) trait Motions: Shaken {
    /// The motion in plain doubles.
    fn float(self: Arc<Self>, origin: &Origin<Ball>) -> Box<dyn Motion>;
    /// The motion in doubles, certified.
    fn interval(self: Arc<Self>, origin: &Origin<Ball>) -> Box<dyn Motion>;
    /// A motion near the given one, for `impacts` impacts; also the number of impacts after which the motion does not expand, if so. `None` where
    /// no chain begins.
    fn shadow(self: Arc<Self>, origin: &Origin<Ball>, impacts: Option<u64>) -> Option<(Box<dyn Motion>, Option<u64>)>;
    /// The motion near the given one, after the impacts that are proved in higher precision.
    fn spliced(self: Arc<Self>, splice: Splice, left: Option<u64>) -> Option<Box<dyn Motion>>;
    /// The motion in the planned bits.
    fn precise(self: Arc<Self>, origin: &Origin<Exact>, plan: Plan) -> Box<dyn Motion>;
}

impl<S: Flying> Motions for S {
    fn float(self: Arc<Self>, origin: &Origin<Ball>) -> Box<dyn Motion> {
        Box::new(FloatMotion::new(self, origin))
    }

    fn interval(self: Arc<Self>, origin: &Origin<Ball>) -> Box<dyn Motion> {
        Box::new(IntervalMotion::new(self, origin))
    }

    fn shadow(self: Arc<Self>, origin: &Origin<Ball>, impacts: Option<u64>) -> Option<(Box<dyn Motion>, Option<u64>)> {
        ShadowMotion::from(self, origin, impacts)
    }

    fn spliced(self: Arc<Self>, splice: Splice, left: Option<u64>) -> Option<Box<dyn Motion>> {
        ShadowMotion::spliced(self, splice, left)
    }

    fn precise(self: Arc<Self>, origin: &Origin<Exact>, plan: Plan) -> Box<dyn Motion> {
        Box::new(PreciseMotion::new(self, origin, plan))
    }
}

impl Given {
    /// Pair and start in exact numbers, with times converted by the clock.
    pub fn new(pair: &ImpactPair, start: &Start, clock: &Clock) -> Result<Self, Error> {
        let either = Either::new(pair, clock)?;
        let origin = either.origin(pair, start, clock)?;
        let shaken: Arc<dyn Motions> = under!(either, shaken => shaken);
        Ok(Self { pair: Arc::new(pair.clone()), shaken, origin })
    }

    /// The origin in doubles.
    pub fn origin_ball(&self) -> Result<Origin<Ball>, Error> {
        self.origin.map(ball)
    }

    /// Goes on from a release.
    pub fn leave(&mut self, release: Released) {
        self.origin = Origin::released(release);
    }

    /// First motion from the origin that is tried in an arithmetic; a motion near by has another origin.
    pub fn motion(&self, arithmetic: Arithmetic) -> Result<Box<dyn Motion>, Error> {
        let (shaken, origin) = (self.shaken.clone(), self.origin_ball()?);
        Ok(match arithmetic {
            Arithmetic::Float => shaken.float(&origin),
            // F5: no other start has the state of a release.
            Arithmetic::Auto | Arithmetic::Interval | Arithmetic::Shadow => shaken.interval(&origin),
            #[cfg(not(all(feature = "inari", target_feature = "fma")))]
            Arithmetic::Inari => return Err(Arithmetic::unknown("inari")),
            #[cfg(all(feature = "inari", target_feature = "fma"))]
            Arithmetic::Inari => {
                self.pair.harmonic("the textbook method (arithmetic inari)")?;
                Box::new(TextbookMotion::new(shaken.pair(), &origin))
            }
            Arithmetic::Bits(bits) => self.precise(Plan::constant(bits)),
        })
    }

    /// Motion from the origin in as many bits as planned.
    pub fn precise(&self, plan: Plan) -> Box<dyn Motion> {
        self.shaken.clone().precise(&self.origin, plan)
    }
}
