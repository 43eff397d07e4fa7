//! The extrema of a flight in closed form.
//!
//! `z' = c - beta cos th` vanishes only where `cos th = q = c/beta`: minima at `th = +2 pi p`, maxima at
//! `th = -2 pi p` modulo `2 pi`, with `2 pi p = acos q`. Between them `z` is monotone, and from one forcing period to
//! the next both kinds move by the drift `c`. So the first maximum above 1 or minimum below 0 is found by
//! one division, and a flight of 100,000 forcing periods costs no more than a short one.

use crate::flight::Flight;
use crate::number::Trigonometry;
use crate::pair::Wall;

/// First maximum and first minimum of a flight, times in forcing periods after the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extrema {
    /// The critical phase `acos(q) / (2 pi)`, in `[0, 1/2]`.
    pub p: f64,
    /// Sine of the critical phase, from `q` (coarse) or from the computed `p` (refined).
    pub sine: f64,
    /// True if the ball rises right after the start.
    pub rising: bool,
    /// Time of the first maximum after the start.
    pub first_max: f64,
    /// Time of the first minimum after the start.
    pub first_min: f64,
    /// The height of the first maximum.
    pub max: f64,
    /// The height of the first minimum.
    pub min: f64,
}

/// The wall on which a flight ends: the far one (height 1) or the one it is measured from (height 0).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    Near,
    Far,
}

impl Target {
    /// Wall of the target, for a flight measured from `near`.
    #[inline(always)]
    pub fn wall(self, near: Wall) -> Wall {
        match self {
            Self::Near => near,
            Self::Far => near.other(),
        }
    }

    #[inline(always)]
    pub fn height(self) -> f64 {
        match self {
            Self::Near => 0.0,
            Self::Far => 1.0,
        }
    }

    /// Sign of `z'` on arrival.
    #[inline(always)]
    pub fn direction(self) -> f64 {
        match self {
            Self::Near => -1.0,
            Self::Far => 1.0,
        }
    }
}

/// The monotone piece that a flight ends on: the piece before extremum `k` of the target's kind.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub target: Target,
    /// Number of extrema of this kind before the piece, a whole number.
    pub k: f64,
}

impl Extrema {
    /// The extrema of `flight`, with `q` clamped into [-1, 1].
    #[inline(always)]
    pub fn new<T: Trigonometry>(flight: &Flight<f64>) -> Self {
        let q = (flight.drift / flight.beta).clamp(-1.0, 1.0); // C4: beyond 1 only if nearly monotone
        let p = T::acos(q);
        let sine = (-q).mul_add(q, 1.0).sqrt();
        let rising = flight.velocity > 0.0 || (flight.velocity == 0.0 && flight.sin > 0.0); // C4: exactly no velocity
        // The phase of the start in the mirrored frame, in [0, 1): rising on (p, 1 - p).
        let mirrored = flight.phase + flight.wall.mirror_phase();
        let start = mirrored - mirrored.floor(); // C4: whole forcing periods; its rounding is refused near 0
        let (first_max, first_min) = if rising {
            let first_max = 1.0 - p - start;
            (first_max, first_max + 2.0 * p)
        } else {
            let first_min = p - if start > 0.5 { start - 1.0 } else { start };
            (first_min + (1.0 - 2.0 * p), first_min)
        };
        let mut extrema = Self { p, sine, rising, first_max, first_min, max: 0.0, min: 0.0 };
        extrema.evaluate(flight);
        extrema
    }

    /// Heights from the sine at the computed critical phase instead of `sqrt(1 - q^2)`.
    ///
    /// Lemma E2: the height is stationary there, so an error of `p` enters squared.
    #[cold]
    pub fn refine<T: Trigonometry>(&mut self, flight: &Flight<f64>) {
        self.sine = T::sin_cos(self.p).0;
        self.evaluate(flight);
    }

    #[inline(always)]
    fn evaluate(&mut self, flight: &Flight<f64>) {
        let base = flight.alpha.mul_add(flight.sin, flight.height);
        self.max = flight.alpha.mul_add(self.sine, flight.drift.mul_add(self.first_max, base));
        self.min = (-flight.alpha).mul_add(self.sine, flight.drift.mul_add(self.first_min, base));
    }

    /// Piece of the first contact, as far as floating point can tell; `None` when no wall is reached.
    #[inline(always)]
    pub fn first_piece(&self, drift: f64) -> Option<Piece> {
        let (far, near) = (self.max >= 1.0, self.min <= 0.0);
        if far && (self.rising || !near) {
            Some(Piece { target: Target::Far, k: 0.0 })
        } else if near {
            Some(Piece { target: Target::Near, k: 0.0 })
        } else if drift > 0.0 {
            // proposes: C4 is proved for this k
            Some(Piece { target: Target::Far, k: ((1.0 - self.max) / drift).ceil().max(1.0) })
        } else if drift < 0.0 {
            // proposes: C4 is proved for this k
            Some(Piece { target: Target::Near, k: (self.min / -drift).ceil().max(1.0) })
        } else {
            None
        }
    }

    /// Whether an extremum that decides about `piece` lies within `margin` of its wall.
    #[inline(always)]
    pub fn is_close(&self, piece: &Piece, drift: f64, margin: f64) -> bool {
        let extremum = match piece.target {
            Target::Far => (1.0 - self.max) - piece.k * drift,
            Target::Near => self.min + piece.k * drift,
        };
        // `extremum` is 1 - max or min of number k; the one before is larger by |drift|.
        let previous = extremum + drift.abs();
        extremum.abs() <= margin
            || (piece.k > 0.0 && previous.abs() <= margin)
            || (1.0 - self.max).abs() <= margin
            || self.min.abs() <= margin
    }

    /// Time of extremum `k = 0` of the target's kind, and duration of the monotone piece before each extremum of this kind.
    #[inline(always)]
    pub fn before(&self, target: Target) -> (f64, f64) {
        match target {
            Target::Far => (self.first_max, 1.0 - 2.0 * self.p),
            Target::Near => (self.first_min, 2.0 * self.p),
        }
    }
}
