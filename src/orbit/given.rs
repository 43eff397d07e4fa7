//! What is followed, exactly, and from where: in any arithmetic.

use std::sync::Arc;

use super::Arithmetic;
use super::Start;
use super::clock::Clock;
#[cfg(feature = "multiprecision")]
use super::motion::Swinging;
use super::motion::{FloatMotion, IntervalMotion, Motion};
use super::origin::{Location, Origin};
#[cfg(feature = "multiprecision")]
use super::plan::Plan;
#[cfg(feature = "multiprecision")]
use super::precise::PreciseMotion;
use super::several::Several;
use super::textbook::TextbookMotion;
use crate::Error;
use crate::exact::Exact;
use crate::number::Ball;
use crate::pair::{ImpactPair, Reduced, Wall, ball, within};
use crate::several::Zero;

/// A pair without units and a start.
#[derive(Clone, Debug)]
pub(super) struct Given {
    pub impact_pair: Arc<ImpactPair>,
    /// Under several harmonics `alpha` and `beta` are the sums of theirs.
    pub exact: Reduced<Exact>,
    pub pair: Reduced<Ball>,
    /// The orbit's start, or the last release.
    pub origin: Origin<Exact>,
    pub several: Option<Several>,
}

impl Given {
    /// What is given of `pair` from `start`, and the whole turns of its phase since the clock's origin.
    pub fn new(pair: &ImpactPair, start: &Start, clock: &Clock) -> Result<(i64, Self), Error> {
        let (turns, origin) = Origin::new(pair, start, clock)?;
        let several = Several::new(pair, clock.origin(), start, turns)?;
        let (exact, reduced) = match &several {
            None => {
                let exact = Reduced::exact(pair)?;
                let reduced = exact.enclosed()?;
                (exact, reduced)
            }
            Some(several) => {
                let amplitude = pair.excitation().reference().amplitude();
                let sums = within("excitation.amplitude", amplitude, several.sums())?;
                let enclose = |x: &Exact| ball("excitation.amplitude", x);
                let (alpha, beta) = (enclose(&sums.alpha)?, enclose(&sums.beta)?);
                let reduced = Reduced { alpha, beta, restitution: ball("pair.restitution", &sums.restitution)? };
                (sums, reduced)
            }
        };
        Ok((turns, Self { impact_pair: Arc::new(pair.clone()), exact, pair: reduced, origin, several }))
    }

    /// The origin in doubles.
    pub fn origin_ball(&self) -> Result<Origin<Ball>, Error> {
        self.origin.map(ball)
    }

    /// Goes on from a release with no velocity at this phase; under several harmonics from a zero of the pressure, which
    /// is known to so many bits.
    pub fn leave(&mut self, wall: Wall, phase: f64, zero: Option<Zero>, bits: u32) {
        let exact = |x: f64| Exact::from_f64(x).expect("a finite number");
        self.origin = match (&mut self.several, zero) {
            (Some(several), Some(zero)) => several.leave(zero, bits),
            _ => Origin { place: Location::Wall(wall), phase: exact(phase), velocity: exact(0.0) },
        };
    }

    /// The first motion from the origin that is tried in an arithmetic.
    pub fn motion(&self, arithmetic: Arithmetic) -> Result<Box<dyn Motion>, Error> {
        let origin = self.origin_ball()?;
        Ok(match (arithmetic, &self.several) {
            (Arithmetic::Float, None) => Box::new(FloatMotion::new(&self.pair, &origin)),
            (Arithmetic::Float, Some(several)) => Box::new(several.float(&self.pair, &origin)),
            (Arithmetic::Auto | Arithmetic::Interval, None) => Box::new(IntervalMotion::new(&self.pair, &origin)),
            (Arithmetic::Auto | Arithmetic::Interval, Some(several)) => Box::new(several.interval(&self.pair, &origin)),
            (Arithmetic::Inari, None) => Box::new(TextbookMotion::new(&self.pair, &origin)),
            (Arithmetic::Inari, Some(several)) => {
                let harmonics = several.harmonics();
                return Err(Error::several(harmonics, "the textbook method (arithmetic inari)"));
            }
            #[cfg(feature = "multiprecision")]
            (Arithmetic::Bits(bits), _) => self.precise(Plan::constant(bits)),
            #[cfg(not(feature = "multiprecision"))]
            (Arithmetic::Bits(bits), _) => return Err(Arithmetic::unknown(&bits.to_string())),
        })
    }

    /// The motion from the origin in as many bits as planned.
    #[cfg(feature = "multiprecision")]
    pub fn precise(&self, plan: Plan) -> Box<dyn Motion> {
        match &self.several {
            None => Box::new(PreciseMotion::new(&self.exact, &self.pair, &self.origin, plan)),
            Some(several) => Box::new(several.precise(&self.pair, &self.origin, plan)),
        }
    }

    /// The floating motion from the origin; `None` beyond doubles.
    #[cfg(feature = "multiprecision")]
    pub fn run(&self) -> Option<Box<dyn Swinging>> {
        let origin = self.origin_ball().ok()?;
        Some(match &self.several {
            None => Box::new(FloatMotion::new(&self.pair, &origin)),
            Some(several) => Box::new(several.float(&self.pair, &origin)),
        })
    }
}
