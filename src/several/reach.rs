//! What a flight cannot reach: Lemma H6 of `docs/proofs.md`.

use std::cmp::Ordering;
use std::sync::OnceLock;

use super::flight::SumFlight;
use super::harmonics::{Harmonics, Phased, Sums};
use crate::number::{Ball, up};

/// Bounds of the sum of the harmonics, `E/d`, at all times.
#[derive(Debug)]
pub(crate) struct Band {
    /// The sum of the amplitudes.
    coarse: f64,
    /// Over a common period, to about [`TIGHT`], once it was needed.
    tight: OnceLock<(f64, f64)>,
    period: Option<u64>,
}

/// How near to the extrema the bounds come, relative to the sum of the amplitudes.
const TIGHT: f64 = 1e-13;
/// Longer common periods are not searched.
const LONGEST_PERIOD: u64 = 4096;
/// Parts that are looked at for each turn, and at most for each bound.
const PARTS: u64 = 8;
const MOST_PARTS: usize = 1 << 18;

impl Band {
    pub fn new(harmonics: &Harmonics<Ball>, period: Option<u64>) -> Self {
        let period = period.filter(|period| *period <= LONGEST_PERIOD);
        Self { coarse: harmonics.rates.shift, tight: OnceLock::new(), period }
    }

    fn coarse(&self) -> (f64, f64) {
        (-self.coarse, self.coarse)
    }

    /// The extrema, where there is a common period.
    fn tight(&self, harmonics: &Harmonics<Ball>) -> (f64, f64) {
        *self.tight.get_or_init(|| match self.period {
            None => self.coarse(),
            Some(period) => (-greatest(harmonics, period, -1.0), greatest(harmonics, period, 1.0)),
        })
    }
}

/// An upper bound of `sign` times the sum of the harmonics over their common period: branch and prune.
fn greatest(harmonics: &Harmonics<Ball>, period: u64, sign: f64) -> f64 {
    let see = |from: f64, width: f64| {
        let middle = from + 0.5 * width;
        let turns = middle.round(); // exact: below 4096
        let Sums { sine, cosine, .. } = harmonics.sums(turns as i64, &Ball::exact(middle - turns)); // exact: below 4096
        let (low, high) = sine.signed_bounds(sign);
        let half = 0.5 * width;
        (low, up(high + up(half * up(cosine.mag() + up(0.5 * harmonics.rates.second * half)))))
    };
    let width = 1.0 / PARTS as f64; // exact: a power of two
    // exact: below 2^15
    let mut parts: Vec<(f64, f64)> = (0..period * PARTS).map(|i| (i as f64 * width, width)).collect();
    let (mut best, mut bound) = (-harmonics.rates.shift, harmonics.rates.shift);
    while bound - best > TIGHT * harmonics.rates.shift && parts.len() <= MOST_PARTS {
        let seen: Vec<_> = parts.iter().map(|&(from, width)| (from, width, see(from, width))).collect();
        // H6: any value bounds the greatest from below
        best = seen.iter().map(|(.., (low, _))| *low).fold(best, f64::max);
        // H6: rates are below 2^400, so no NaN
        bound = seen.iter().map(|(.., (_, high))| *high).fold(best, f64::max).min(bound);
        let halves = |from: f64, width: f64| [(from, 0.5 * width), (from + 0.5 * width, 0.5 * width)];
        let open = seen.into_iter().filter(|(.., (_, high))| *high > best);
        parts = open.flat_map(|(from, width, _)| halves(from, width)).collect();
        // Narrower ones would not have exact middles.
        if parts.iter().any(|(_, width)| *width < 2f64.powi(-36)) {
            break;
        }
    }
    bound
}

impl Ball {
    /// Bounds of `sign` times it.
    fn signed_bounds(self, sign: f64) -> (f64, f64) {
        let (low, high) = Phased::bounds(&self);
        if sign < 0.0 { (-high, -low) } else { (low, high) }
    }
}

/// From when on a flight cannot come back to the wall it drifts away from, and until when it cannot reach the other.
#[derive(Debug)]
pub(crate) struct Reach<'b> {
    band: &'b Band,
    harmonics: &'b Harmonics<Ball>,
    window: Option<(f64, f64)>,
    asked: u32,
}

/// Pieces after which the band is taken tightly.
const PATIENCE: u32 = 48;

impl<'b> Reach<'b> {
    pub fn new(band: &'b Band, harmonics: &'b Harmonics<Ball>) -> Self {
        Self { band, harmonics, window: None, asked: 0 }
    }

    /// When to look next, in turns after the start, if until then no wall is near at `now`.
    pub fn jump<N: Phased>(&mut self, flight: &SumFlight<'_, N>, now: f64) -> Option<f64> {
        self.asked += 1;
        if self.asked == 1 || self.asked == PATIENCE {
            let band = if self.asked == 1 { self.band.coarse() } else { self.band.tight(self.harmonics) };
            self.window = window(flight.offset.bounds(), flight.drift.bounds(), band);
        }
        self.window.and_then(|(from, until)| (now >= from && until > now).then_some(until))
    }
}

/// The window between leaving one wall for good and coming near the other: `z = offset + drift h - sum`, the sum in `band`.
fn window((low, high): (f64, f64), drift: (f64, f64), (least, most): (f64, f64)) -> Option<(f64, f64)> {
    let (behind, ahead, slowest, fastest) = match (drift.0.partial_cmp(&0.0), drift.1.partial_cmp(&0.0)) {
        (Some(Ordering::Greater), _) => (most - low, (1.0 - high) + least, drift.0, drift.1),
        (_, Some(Ordering::Less)) => ((high - least) - 1.0, low - most, -drift.1, -drift.0),
        _ => return None,
    };
    // Differences of numbers of the order of a gap and of the band.
    let size = 8.0 * f64::EPSILON * (1.0 + low.abs() + high.abs() + least.abs() + most.abs());
    let (from, until) = (up(up(behind + size) / slowest), ((ahead - size) / fastest) * (1.0 - 4.0 * f64::EPSILON));
    // H6: not before the start; no NaN, as `until` is finite
    (until > 0.0 && until.is_finite()).then_some((from.max(0.0), until))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::several::Spectrum;
    use crate::{Excitation, Harmonic, ImpactPair};

    #[test]
    fn the_band_holds_the_sum_and_is_tight() {
        let value = |text: &str| text.parse().unwrap();
        for (second, phase) in [("3*pi", "0"), ("3*pi", "1"), ("5*pi/7", "2"), ("41*pi/200", "-1")] {
            let terms = [("0.3", "pi", "0.4"), ("0.2", second, phase)];
            let terms = terms.map(|(a, w, tau)| Harmonic::new(value(a), value(w), value(tau)).unwrap());
            let pair = ImpactPair::new(Excitation::new(terms.to_vec()).unwrap(), value("1"), value("1")).unwrap();
            let spectrum = Spectrum::new(&pair, &0.into()).unwrap().unwrap();
            let harmonics = Harmonics::<Ball>::new(&spectrum, 53);
            let (low, high) = Band::new(&harmonics, spectrum.period).tight(&harmonics);
            let points = 4000 * spectrum.period.unwrap();
            let sum = |i: u64| harmonics.sums((i / 4000) as i64, &Ball::exact((i % 4000) as f64 / 4000.0)).sine.mid();
            let (least, most) = (0..points).map(sum).fold((1.0f64, -1.0f64), |(a, b), x| (a.min(x), b.max(x)));
            assert!(low <= least && most <= high, "{second}");
            // Between points a 4000th of a turn apart the sum rises by (2 pi/8000)^2/2 of its amplitudes at most.
            assert!(least - low < 4e-7 && high - most < 4e-7, "{second}: {low} {least} {most} {high}");
        }
    }
}
