use std::sync::Arc;

use num_rational::BigRational;
use num_traits::{One, Signed};
use proptest::prelude::*;

use super::reach::{Band, window};
use super::rest::{accumulation, first_zero};
use super::*;
use crate::exact::{Exact, Real};
use crate::number::Ball;
use crate::number::interval::Interval;
use crate::pair::Wall;
use crate::tests::pair_of;

/// Harmonics of a gap of 1, each an amplitude, a frequency and a phase.
fn spectrum(terms: &[[&str; 3]]) -> Spectrum {
    Spectrum::new(&pair_of(terms, "1", "1/2"), &0.into()).unwrap().unwrap()
}

/// Sums with and without a common period.
fn sums() -> impl Strategy<Value = Spectrum> {
    let second = prop::sample::select(vec!["3*pi", "5*pi/7", "41*pi/200", "pi/2", "sqrt(2)*pi", "1"]);
    let amplitudes = prop::sample::select(vec![["3/10", "1/5"], ["1", "1/1000"], ["1/100", "1/70"]]);
    let phase = prop::sample::select(vec!["0", "1", "-2", "pi/2", "2/5"]);
    (second, amplitudes, phase.clone(), phase)
        .prop_map(|(w, [a, b], tau, other)| spectrum(&[[a, "pi", tau], [b, w, other]]))
}

/// `z''` after `turns` periods of the fastest, by exact numbers.
fn acceleration(spectrum: &Spectrum, turns: i64, rest: f64) -> Real {
    let bits = 200;
    let time = Exact::from_f64(rest).unwrap().checked_add(&Exact::from(turns)).unwrap();
    let term = |term: &spectrum::Term| {
        let [alpha, ratio, shift] = [&term.alpha, &term.ratio, &term.shift].map(|x| Real::of(x, bits));
        let rate = Real::pi(bits) * 2 * &ratio;
        let phase = (ratio * Real::of(&time, bits) + shift) * Real::pi(bits) * 2;
        alpha * rate.square() * phase.sin()
    };
    spectrum.terms.iter().map(term).fold(Real::zero(bits), |sum, term| sum + term)
}

proptest! {
    /// The rates hold what they bound, of which each is the greatest there is if all sines are 1 at once, and little more.
    #[test]
    fn rates_hold_the_sums(spectrum in sums()) {
        let rates = Harmonics::<Ball>::new(&spectrum, 53).rates;
        for (power, rate) in [(0, rates.shift), (2, rates.second), (3, rates.third), (4, rates.fourth)] {
            let term = |term: &spectrum::Term| {
                let rate = Real::pi(200) * 2 * Real::of(&term.ratio, 200);
                (0..power).fold(Real::of(&term.alpha, 200), |product, _| product * &rate)
            };
            let sum = spectrum.terms.iter().map(term).fold(Real::zero(200), |sum, term| sum + term);
            let (low, high) = sum.enclosure().to_f64_bounds();
            prop_assert!(high <= rate && rate <= low * (1.0 + 1e-14), "{power}: {rate} {high}");
        }
    }

    /// Lemma H6: inside the window no member's height is outside the gap, and the window is as long as that allows.
    #[test]
    fn no_wall_is_reached_in_a_window(
        held in -3.0..4.0f64, drift in prop_oneof![-2.0..2.0f64, -1e-9..1e-9f64], widths in prop::array::uniform2(prop_oneof![Just(0.0), 0.0..0.5f64]),
        part in prop_oneof![Just(0.0), Just(1.0), 0.0..1.0f64],
    ) {
        let exact = |x: f64| BigRational::from_float(x).unwrap();
        let (held, drift) = (Interval::new(held, held + widths[0]), Interval::new(drift, drift + widths[1] * drift.abs()));
        let Some((from, until)) = window(held, drift) else {
            // Then some member is outside from the start, or too late inside, or does not drift.
            let ahead = if drift.inf() > 0.0 { held.sup() } else { 1.0 - held.inf() };
            prop_assert!(drift.contains(0.0) || ahead >= 1.0 - 1e-15);
            return Ok(());
        };
        let time = exact(from) + (exact(until) - exact(from)) * exact(part);
        if until >= from {
            let heights = [held.inf(), held.sup()].into_iter().flat_map(|held| [drift.inf(), drift.sup()].map(|drift| exact(held) + exact(drift) * &time));
            for height in heights {
                prop_assert!(!height.is_negative() && height <= BigRational::one(), "{held:?} {drift:?}");
            }
        }
        let (slowest, fastest) = (drift.abs().inf(), drift.mag());
        let [room, ahead] = if drift.inf() > 0.0 { [held.inf(), held.sup()] } else { [1.0 - held.sup(), 1.0 - held.inf()] };
        let best = [-room / if room < 0.0 { slowest } else { fastest }, (1.0 - ahead) / fastest];
        let slack = 1e-15 * (1.0 + room.abs() + ahead.abs()) / slowest;
        let is_best = (from - best[0].max(0.0)).abs() <= slack && (until - best[1]).abs() <= slack;
        prop_assert!(is_best, "{held:?} {drift:?}: {from} {until}");
    }

    /// Lemma H8: the contact force is positive up to the bracket and falls through 0 in it, by exact numbers.
    #[test]
    fn a_release_is_where_the_contact_force_first_vanishes(spectrum in sums(), turns in 0..40i64, phase in -0.5..0.5f64, is_left: bool) {
        let wall = if is_left { Wall::Left } else { Wall::Right };
        let spectrum = Arc::new(spectrum);
        let harmonics = Harmonics::<Ball>::new(&spectrum, 53);
        let pressure = |turns, rest| (acceleration(&spectrum, turns, rest) * -(wall.sign() as i64)).to_f64();
        let start = pressure(turns, phase);
        prop_assume!(start >= 0.0);
        let Ok(zero) = first_zero(&spectrum, &harmonics, wall, turns, Ball::exact(phase)) else {
            prop_assert!(start < 1e-3 * harmonics.rates.second);
            return Ok(());
        };
        let (at, reach) = (zero.phase().mid(), zero.phase().rad());
        prop_assert!(reach < 1e-9);
        let [before, after] = [at - 2.0 * reach, at + 2.0 * reach].map(|rest| pressure(zero.turns, rest));
        prop_assert!(before > 0.0 && after < 0.0, "{before} {after}");
        let ahead = (zero.turns - turns) as f64 + at - phase;
        for part in 1..100 {
            let rest = phase + f64::from(part) / 100.0 * ahead;
            prop_assert!(pressure(turns, rest) > 0.0, "{rest}");
        }
    }

    /// Lemma H7: against bounces in doubles, under a contact force that is linear over each: that is off by less than a 10^7th.
    #[test]
    fn chatter_takes_no_longer_than_proved(
        spectrum in sums(), turns in 0..40i64, phase in -0.5..0.5f64, size in (-12.0..-5.0f64).prop_map(|x| 10f64.powf(x)),
    ) {
        let harmonics = Harmonics::<Ball>::new(&spectrum, 53);
        let pressure = |rest| -acceleration(&spectrum, turns, rest).to_f64();
        let now = pressure(phase);
        prop_assume!(now > 0.1 * harmonics.rates.second);
        let speed = size * now;
        let found = accumulation(&harmonics, Ball::exact(0.5), Wall::Left, turns, Ball::exact(phase), Ball::exact(speed)).unwrap();
        let slope = (pressure(phase + 1e-6) - pressure(phase - 1e-6)) / 2e-6;
        let (mut time, mut now, mut speed) = (0.0, now, speed);
        while speed > 1e-9 * size {
            // The root of v h - p h^2/2 - p' h^3/6.
            let hop = 2.0 * speed / (0.5 * now + (0.25 * now * now + 2.0 / 3.0 * slope * speed).sqrt());
            speed = 0.5 * ((now + 0.5 * slope * hop) * hop - speed);
            (time, now) = (time + hop, now + slope * hop);
        }
        prop_assert!(found >= time * (1.0 - 1e-7) && found <= 1.02 * time, "{found} {time}");
    }
}

/// Lemma H6: against the sum at many points.
#[test]
fn the_band_holds_the_sum_and_is_tight() {
    for [second, phase] in [["3*pi", "0"], ["3*pi", "1"], ["5*pi/7", "2"], ["41*pi/200", "-1"]] {
        let spectrum = spectrum(&[["0.3", "pi", "0.4"], ["0.2", second, phase]]);
        let harmonics = Harmonics::<Ball>::new(&spectrum, 53);
        let band = Band::new(&harmonics, spectrum.period).tight(&harmonics);
        let points = 4000 * spectrum.period.unwrap();
        let sum = |i: u64| harmonics.sums((i / 4000) as i64, &Ball::exact((i % 4000) as f64 / 4000.0)).sine.mid();
        let (least, most) = (0..points).map(sum).fold((1.0f64, -1.0f64), |(a, b), x| (a.min(x), b.max(x)));
        assert!(band.contains(least) && band.contains(most), "{second}");
        // Between points a 4000th of a forcing period apart the sum rises by (2 pi/8000)^2/2 of its amplitudes at most.
        assert!(least - band.inf() < 4e-7 && band.sup() - most < 4e-7, "{second}: {band:?} {least} {most}");
    }
}
