//! Times at which a flight cannot reach a wall: Lemma H6 of `docs/proofs/harmonics.md#H6`.

use std::cmp::Ordering;
use std::sync::OnceLock;

use super::flight::SumFlight;
use super::harmonics::{Harmonics, Sums};
use super::phased::FlightNumber;
use crate::number::Ball;
use crate::number::interval::Interval;

/// Bounds of the sum of the harmonics, `E/d`, at all times.
#[derive(Debug)]
pub(crate) struct Band {
    /// Bounds by the sum of the amplitudes.
    coarse: Interval,
    /// Bounds over a common period, to about [`TIGHT_TOLERANCE`], computed when first needed.
    tight: OnceLock<Interval>,
    period: Option<u64>,
}

/// Tolerance of the bounds of the extrema, relative to the sum of the amplitudes.
const TIGHT_TOLERANCE: f64 = 1e-13;
/// Longer common periods are not searched.
const LONGEST_PERIOD: u64 = 4096;
/// Parts that are looked at for each forcing period, and at most for each bound.
const PARTS_PER_PERIOD: u64 = 8;
const MOST_PARTS: usize = 1 << 18;

impl Band {
    pub fn new(harmonics: &Harmonics<Ball>, period: Option<u64>) -> Self {
        let period = period.filter(|period| *period <= LONGEST_PERIOD);
        Self { coarse: Interval::within(harmonics.rates.shift), tight: OnceLock::new(), period }
    }

    /// The extrema, where there is a common period.
    pub fn tight(&self, harmonics: &Harmonics<Ball>) -> Interval {
        *self.tight.get_or_init(|| match self.period {
            None => self.coarse,
            Some(period) => Interval::new(-greatest(harmonics, period, -1.0), greatest(harmonics, period, 1.0)),
        })
    }
}

/// An upper bound of `sign` times the sum of the harmonics over their common period: branch and prune.
fn greatest(harmonics: &Harmonics<Ball>, period: u64, sign: f64) -> f64 {
    let bend = Interval::within(0.5 * harmonics.rates.second);
    let see = |from: f64, width: f64| {
        let middle = from + 0.5 * width;
        let turns = middle.round(); // exact: below 4096
        let Sums { sine, cosine, .. } = harmonics.sums(turns as i64, &Ball::exact(middle - turns)); // exact: below 4096
        let (here, step) = (Interval::from(sine).signed(sign), Interval::within(0.5 * width));
        (here.inf(), (here + step * (Interval::from(cosine) + bend * step)).sup())
    };
    let width = 1.0 / PARTS_PER_PERIOD as f64; // exact: a power of two
    // exact: below 2^15
    let mut parts: Vec<(f64, f64)> = (0..period * PARTS_PER_PERIOD).map(|i| (i as f64 * width, width)).collect();
    let (mut best, mut bound) = (-harmonics.rates.shift, harmonics.rates.shift);
    while bound - best > TIGHT_TOLERANCE * harmonics.rates.shift && parts.len() <= MOST_PARTS {
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

/// Window of time in which a flight can no longer come back to the wall it drifts away from, and cannot yet reach the other wall.
#[derive(Debug)]
pub(crate) struct Reach<'b> {
    band: &'b Band,
    harmonics: &'b Harmonics<Ball>,
    window: Option<(f64, f64)>,
    requested: u32,
}

/// Pieces after which the band is taken tightly.
const MAX_COARSE_PIECES: u32 = 48;

impl<'b> Reach<'b> {
    pub fn new(band: &'b Band, harmonics: &'b Harmonics<Ball>) -> Self {
        Self { band, harmonics, window: None, requested: 0 }
    }

    /// End of the window in which no wall can be reached, in forcing periods after the start, if the time `now` lies in the window.
    pub fn jump<N: FlightNumber>(&mut self, flight: &SumFlight<'_, N>, now: f64) -> Option<f64> {
        self.requested += 1;
        if self.requested == 1 || self.requested == MAX_COARSE_PIECES {
            let band = if self.requested == 1 { self.band.coarse } else { self.band.tight(self.harmonics) };
            self.window = window(flight.offset.interval() - band, flight.drift.interval());
        }
        self.window.and_then(|(from, until)| (now >= from && until > now).then_some(until))
    }
}

/// The window between leaving one wall for good and coming near the other: at `h` the height is in `held + drift h`.
pub(super) fn window(held: Interval, drift: Interval) -> Option<(f64, f64)> {
    let (room, speed) = match drift.sign()? {
        Ordering::Greater => (held, drift),
        Ordering::Less => (Interval::ONE - held, -drift),
        Ordering::Equal => return None,
    };
    let (from, until) = ((-room).checked_div(speed)?.sup(), (Interval::ONE - room).checked_div(speed)?.inf());
    // H6: not before the start; both are finite
    (until > 0.0).then_some((from.max(0.0), until))
}
