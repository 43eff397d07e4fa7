//! Chains under several harmonics, equation (1): Lemmas H10-H12 of `docs/proofs.md`.

use std::sync::Arc;

use num_bigint::BigInt;
use num_traits::Zero;

use super::chain::{Chain, Legs, MOST_CYCLES};
use super::physical::{Claim, Found, all_first};
use super::shaken::{Moment, Passing, Shaken, Step};
use super::shaking::{Hop, Repetition, Shaking};
use crate::error::Error;
use crate::exact::Exact;
use crate::flight::Launch;
#[cfg(feature = "multiprecision")]
use crate::number::MpBall;
use crate::number::{Ball, Enclosing};
use crate::pair::{ImpactPair, Wall, ball, within};
use crate::several::{self, Band, Doubt, Harmonics, Phased, Reach, Scan, Spectrum, SumFlight, Sums};

/// The harmonics and the restitution.
#[derive(Clone, Debug)]
pub(super) struct Sum<N: Phased> {
    harmonics: Harmonics<N>,
    restitution: N,
}

/// The box at one time.
#[derive(Clone, Debug)]
pub(super) struct Waves<N> {
    /// Sine and cosine of each harmonic.
    each: Vec<(N, N)>,
    sums: Sums<N>,
}

impl<N: Phased> Shaking<N> for Sum<N> {
    type Moment = Waves<N>;

    fn restitution(&self) -> &N {
        &self.restitution
    }

    fn moment(&self, turns: f64, rest: &N) -> Waves<N> {
        let (low, high) = rest.bounds();
        let whole = (0.5 * (low + high)).floor(); // H11: any whole number of turns
        let rest = rest.clone() - N::from_f64(whole);
        // H11: whole, polished phases are below 2^40
        let each: Vec<_> = self.harmonics.waves((turns + whole) as i64, &rest).map(|(_, wave)| wave).collect();
        Waves { sums: self.harmonics.sums_of(&each), each }
    }

    fn way(&self, from: &Waves<N>, to: &Waves<N>, displacement: f64) -> N {
        N::from_f64(displacement) + (to.sums.sine.clone() - from.sums.sine.clone())
    }

    fn relative(&self, drift: &N, at: &Waves<N>) -> N {
        drift.clone() - at.sums.cosine.clone()
    }

    fn swing(&self, at: &Waves<N>) -> N {
        at.sums.swing.clone()
    }

    fn hop(&self, time: &N, from: &Waves<N>) -> Option<Hop<N>> {
        let added = self.harmonics.departure(&from.each, time)?;
        let after = (-added.height).checked_div(time.clone())?;
        let drift = after.clone() + from.sums.cosine.clone();
        Some(Hop { drift, before: after.clone() + added.velocity, after })
    }
}

/// A pair that is shaken by several harmonics with a common period.
#[derive(Clone, Debug)]
pub(super) struct Several {
    spectrum: Spectrum,
    floats: Sum<f64>,
    balls: Sum<Ball>,
    band: Arc<Band>,
    repetition: Repetition,
    speed: f64,
}

impl Several {
    /// The harmonics of `pair`, whose turn 0 begins where `W t + tau = 0` of the fastest; `None` of a single one.
    ///
    /// # Errors
    /// When their frequencies are not proved to be commensurate, the common period is longer than [`MOST_CYCLES`], or a
    /// value is beyond what exact expressions or doubles hold.
    pub fn new(pair: &ImpactPair) -> Result<Option<Self>, Error> {
        let Some(spectrum) = Spectrum::new(pair, &BigInt::zero())? else { return Ok(None) };
        let repetition = || {
            let turns = u32::try_from(spectrum.period?).ok().filter(|turns| *turns <= MOST_CYCLES)?;
            Some(Repetition { turns, is_odd: spectrum.is_odd()? })
        };
        let repetition = repetition().ok_or_else(|| {
            let terms = pair.excitation().terms().iter();
            let frequencies: Vec<String> = terms.map(|term| term.frequency().text().to_string()).collect();
            Error::incommensurate(&frequencies, MOST_CYCLES)
        })?;
        let harmonics = Harmonics::in_doubles(&spectrum, pair)?;
        let amplitude = pair.excitation().reference().amplitude();
        let sums = within("excitation.amplitude", amplitude, spectrum.sums())?;
        let speed = ball("excitation.amplitude", &sums.beta)?.mid();
        let in_doubles = f64::MANTISSA_DIGITS;
        let floats = Sum {
            harmonics: Harmonics::new(&spectrum, in_doubles),
            restitution: <f64 as Phased>::enclose(&spectrum.restitution, in_doubles),
        };
        let restitution = <Ball as Phased>::enclose(&spectrum.restitution, in_doubles);
        let band = Arc::new(Band::new(&harmonics, spectrum.period));
        let balls = Sum { harmonics, restitution };
        Ok(Some(Self { spectrum, floats, balls, band, repetition, speed }))
    }

    /// When the excitation repeats.
    pub fn repetition(&self) -> Repetition {
        self.repetition
    }

    /// The coefficient of restitution.
    pub fn restitution(&self) -> &Exact {
        &self.spectrum.restitution
    }

    /// The first contacts of the flights that start so. Lemmas H2-H6
    fn first<N: Phased>(&self, shaking: &Sum<N>, all: Launch<N>) -> Result<FirstContact<N>, Doubt<N>> {
        let centre = SumFlight::new(&shaking.harmonics, all.map(Phased::centre_of), None);
        let all = SumFlight::new(&shaking.harmonics, all, None);
        let found = Scan::new(&all, &centre).first(&mut Reach::new(&self.band, &self.balls.harmonics))?;
        Ok(FirstContact { found, swing: all.acceleration })
    }

    /// Whether the first contact of a flight is its end. Lemma H12
    fn is_first<N: Phased + Enclosing>(&self, shaking: &Sum<N>, claim: &Claim<N>, after: N) -> Option<bool> {
        if !claim.arrives()? {
            return Some(false);
        }
        match self.first(shaking, launch(claim.from, claim.turns, claim.start.clone(), after)) {
            Ok(FirstContact { found, .. }) => {
                let phase = claim.start.clone() + found.at.rest.with_radius(found.reach);
                claim.is_at(shaking, Found { wall: found.wall, turns: found.at.turns as f64, phase }) // N1: below 2^52
            }
            // It stays on its wall.
            Err(Doubt::Rest) => Some(false),
            Err(_) => None,
        }
    }

    /// The impact law (15); nothing is exactly nothing, so that a dead impact leaves at rest.
    fn rebound(&self, before: Ball) -> Ball {
        let zero = Ball::exact(0.0);
        let is_dead = self.balls.restitution == zero || before == zero;
        if is_dead { zero } else { -(self.balls.restitution * before) }
    }
}

/// A first contact, and `y''` at the start of the flights.
struct FirstContact<N> {
    found: several::Found<N>,
    swing: N,
}

/// The start of a flight from a wall.
fn launch<N: Phased>(wall: Wall, turns: f64, phase: N, velocity: N) -> Launch<N> {
    let height = N::from_f64(0.0);
    // H11: whole, polished phases are below 2^40
    Launch { wall: Some(wall), height, turns: turns as i64, phase, velocity, is_release: false }
}

impl Shaken for Several {
    type In<N: Phased> = Sum<N>;

    fn floats(&self) -> &Sum<f64> {
        &self.floats
    }

    fn balls(&self) -> &Sum<Ball> {
        &self.balls
    }

    #[cfg(feature = "multiprecision")]
    fn precise(&self, bits: u32) -> Sum<MpBall> {
        let restitution = <MpBall as Phased>::enclose(&self.spectrum.restitution, bits);
        Sum { harmonics: Harmonics::new(&self.spectrum, bits), restitution }
    }

    fn speed(&self) -> f64 {
        self.speed
    }

    fn next(&self, (wall, phase, velocity): Passing) -> Option<Passing> {
        let after = -self.floats.restitution * velocity;
        let launch = launch(wall, phase.floor(), phase - phase.floor(), after); // proposes
        let found = self.first(&self.floats, launch).ok()?.found;
        Some((found.wall, phase + found.at.time(), found.centre_velocity))
    }

    fn step(&self, wall: Wall, turns: f64, phase: Ball, before: Ball) -> Option<Step> {
        let FirstContact { found, swing } =
            self.first(&self.balls, launch(wall, turns, phase, self.rebound(before))).ok()?;
        let time = found.at.time().widened(found.reach);
        Some(Step { wall: found.wall, time, velocity: found.velocity, swings: [swing, found.acceleration] })
    }

    fn is_physical(&self, chain: &Chain, phases: &[Ball], legs: &Legs<Ball, Moment<Self, Ball>>) -> Option<bool> {
        all_first(chain, phases, &legs.legs, |claim| self.is_first(&self.balls, claim, self.rebound(claim.before)))
    }

    #[cfg(feature = "multiprecision")]
    fn is_physical_precisely(
        &self,
        shaking: &Sum<MpBall>,
        chain: &Chain,
        phases: &[MpBall],
        legs: &Legs<MpBall, Moment<Self, MpBall>>,
    ) -> Option<bool> {
        all_first(chain, phases, &legs.legs, |claim| {
            self.is_first(shaking, claim, -(shaking.restitution.clone() * claim.before.clone()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Number;
    use crate::{Excitation, Harmonic};

    fn several() -> Several {
        let value = |text: &str| text.parse::<Exact>().unwrap();
        let terms = [("2", "pi", "0.3"), ("1", "3*pi", "pi/5")];
        let terms = terms.map(|(a, w, tau)| Harmonic::new(value(a), value(w), value(tau)).unwrap());
        let pair = ImpactPair::new(Excitation::new(terms.to_vec()).unwrap(), value("4"), value("0.5")).unwrap();
        Several::new(&pair).unwrap().unwrap()
    }

    /// (1) and its derivatives at a phase of the fastest, in gaps and turns.
    fn shaking(u: f64) -> [f64; 3] {
        let tau = std::f64::consts::TAU;
        let time = (tau * u - std::f64::consts::PI / 5.0) / (3.0 * std::f64::consts::PI);
        let slow = std::f64::consts::PI * time + 0.3;
        let rate = tau / 3.0;
        let sin = 0.5 * slow.sin() + 0.25 * (tau * u).sin();
        let cos = 0.5 * rate * slow.cos() + 0.25 * tau * (tau * u).cos();
        [sin, cos, 0.5 * rate * rate * slow.sin() + 0.25 * tau * tau * (tau * u).sin()]
    }

    #[test]
    fn moments_are_those_of_equation_1_in_whichever_turn() {
        let sum = several().balls;
        let is_near = |x: Ball, number: f64| (x.mid() - number).abs() < 1e-13 * (1.0 + number.abs()) && x.rad() < 1e-13;
        let zero = sum.moment(0.0, &Ball::exact(0.0));
        for (turns, rest) in [(0.0, 0.3), (2.0, 0.3), (-4.0, 0.9), (1.0, 4.25), (0.0, -2.75), (3_000_001.0, 0.5)] {
            let moment = sum.moment(turns, &Ball::exact(rest));
            let [displacement, velocity, swing] = shaking((turns % 3.0) + rest);
            assert!(is_near(sum.way(&zero, &moment, 1.0), 1.0 + displacement - shaking(0.0)[0]), "{turns} {rest}");
            assert!(is_near(sum.relative(&Ball::exact(0.5), &moment), 0.5 - velocity), "{turns} {rest}");
            assert!(is_near(sum.swing(&moment), swing), "{turns} {rest}");
        }
    }

    #[test]
    fn hops_are_flights() {
        let sum = several().balls;
        for (phase, time) in [(0.2, 0.1), (1.7, 0.01), (2.9, 0.12)] {
            let [from, to] = [phase, phase + time].map(|phase| sum.moment(0.0, &Ball::exact(phase)));
            let hop = sum.hop(&Ball::exact(time), &from).unwrap();
            let drift = sum.way(&from, &to, 0.0).checked_div(Ball::exact(time)).unwrap();
            let is_near = |a: Ball, b: Ball| (a.mid() - b.mid()).abs() < 1e-12;
            assert!(is_near(hop.drift, drift) && is_near(hop.after, sum.relative(&drift, &from)));
            assert!(is_near(hop.before, sum.relative(&drift, &to)));
        }
    }
}
