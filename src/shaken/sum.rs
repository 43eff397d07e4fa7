//! The box with several harmonics at one time, as chains of impacts see it: Lemmas H10, H11 of `docs/proofs/periodic.md#H10`.

use super::shaking::{Hop, Shaking};
use crate::several::{Harmonics, PhaseNumber, Sums};

/// The harmonics and the restitution.
#[derive(Clone, Debug)]
pub(crate) struct Sum<N: PhaseNumber> {
    pub harmonics: Harmonics<N>,
    pub restitution: N,
}

/// The box at one time.
#[derive(Clone, Debug)]
pub(crate) struct Moment<N> {
    /// Sine and cosine of each harmonic.
    each: Vec<(N, N)>,
    sums: Sums<N>,
}

impl<N: PhaseNumber> Shaking<N> for Sum<N> {
    type Moment = Moment<N>;

    fn restitution(&self) -> &N {
        &self.restitution
    }

    fn moment(&self, turns: f64, rest: &N) -> Moment<N> {
        let whole = rest.middle().floor(); // H11: any whole number of forcing periods
        let rest = rest.clone() - N::from_f64(whole);
        // H11: whole, polished phases are below 2^40
        let each: Vec<_> = self.harmonics.waves((turns + whole) as i64, &rest).map(|(_, wave)| wave).collect();
        Moment { sums: self.harmonics.sums_of(&each), each }
    }

    fn travel(&self, from: &Moment<N>, to: &Moment<N>, displacement: f64) -> N {
        N::from_f64(displacement) + (to.sums.sine.clone() - from.sums.sine.clone())
    }

    fn relative(&self, drift: &N, at: &Moment<N>) -> N {
        drift.clone() - at.sums.cosine.clone()
    }

    fn acceleration(&self, at: &Moment<N>) -> N {
        at.sums.acceleration.clone()
    }

    fn hop(&self, time: &N, from: &Moment<N>) -> Option<Hop<N>> {
        let added = self.harmonics.departure(&from.each, time)?;
        let after = (-added.height).checked_div(time.clone())?;
        let drift = after.clone() + from.sums.cosine.clone();
        Some(Hop { drift, before: after.clone() + added.velocity, after })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Ball, Number};
    use crate::shaken::SeveralHarmonics;

    fn balls() -> Sum<Ball> {
        let pair = crate::tests::pair_of(&[["2", "pi", "0.3"], ["1", "3*pi", "pi/5"]], "4", "0.5");
        SeveralHarmonics::new(&pair, &0.into()).unwrap().unwrap().balls
    }

    /// (1) and its derivatives at a phase of the fastest, in gap widths and forcing periods.
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
    fn moments_are_those_of_equation_1_in_any_forcing_period() {
        let sum = balls();
        let is_near = |x: Ball, number: f64| (x.mid() - number).abs() < 1e-13 * (1.0 + number.abs()) && x.rad() < 1e-13;
        let zero = sum.moment(0.0, &Ball::exact(0.0));
        for (turns, rest) in [(0.0, 0.3), (2.0, 0.3), (-4.0, 0.9), (1.0, 4.25), (0.0, -2.75), (3_000_001.0, 0.5)] {
            let moment = sum.moment(turns, &Ball::exact(rest));
            let [displacement, velocity, acceleration] = shaking((turns % 3.0) + rest);
            assert!(is_near(sum.travel(&zero, &moment, 1.0), 1.0 + displacement - shaking(0.0)[0]), "{turns} {rest}");
            assert!(is_near(sum.relative(&Ball::exact(0.5), &moment), 0.5 - velocity), "{turns} {rest}");
            assert!(is_near(sum.acceleration(&moment), acceleration), "{turns} {rest}");
        }
    }

    #[test]
    fn hops_are_flights() {
        let sum = balls();
        for (phase, time) in [(0.2, 0.1), (1.7, 0.01), (2.9, 0.12)] {
            let [from, to] = [phase, phase + time].map(|phase| sum.moment(0.0, &Ball::exact(phase)));
            let hop = sum.hop(&Ball::exact(time), &from).unwrap();
            let drift = sum.travel(&from, &to, 0.0).checked_div(Ball::exact(time)).unwrap();
            let is_near = |a: Ball, b: Ball| (a.mid() - b.mid()).abs() < 1e-12;
            assert!(is_near(hop.drift, drift) && is_near(hop.after, sum.relative(&drift, &from)));
            assert!(is_near(hop.before, sum.relative(&drift, &to)));
        }
    }
}
