//! The forcing over a flight: equation (1) and its derivatives, summed over the harmonics.
//!
//! Phases are phases of the reference harmonic, `th = W t + tau`, which passes at the rate 1; harmonic `k` passes at the rate
//! `r_k = W_k/W`. With `s` the phase since the origin of an orbit and `f_k` the phase of harmonic `k` at that origin,
//! `E = sum A_k sin(f_k + r_k s)`, and `y'' = -E'' = sum A_k r_k^2 sin(f_k + r_k s)` between impacts.

use super::affine::Affine;
use super::angle::Angle;
use super::number::Number;
use super::span::Span;
use impact_pair_exact::Real;

/// Bits of phases before whole periods are taken off.
const PHASE_BITS: u32 = 128;

/// A harmonic over the data of the scene.
#[derive(Clone, Debug)]
pub(crate) struct Term {
    /// `A_k` \[length\]
    pub amplitude: Affine,
    /// `f_k` \[rad\]
    pub phase: Affine,
    /// `r_k`; `None` for the reference.
    pub rate: Option<Affine>,
}

/// All harmonics over the flights of a set, counted from their departures; the reference comes first.
#[derive(Clone, Debug)]
pub(crate) struct Shaking<N = Real> {
    pub waves: Vec<Wave<N>>,
}

/// One harmonic over the flights of a set.
#[derive(Clone, Debug)]
pub(crate) struct Wave<N = Real> {
    pub amplitude: N,
    /// `r_k`; `None` is 1.
    rate: Option<N>,
    /// The phase at the departure.
    pub first: Angle<N>,
    /// A later phase whose sine and cosine are known.
    later: Option<Angle<N>>,
}

impl Term {
    /// The harmonic for the members chosen by `member`, counted from the phase `since` after the origin; `angle` encloses its sine and
    /// cosine there.
    pub fn wave(
        &self,
        since: &Real,
        bits: u32,
        member: fn(&Affine) -> Real,
        angle: impl FnOnce(Real) -> Angle,
    ) -> Wave {
        let member = |x: &Affine| member(x).rounded(bits);
        let rate = self.rate.as_ref().map(member);
        let passed = rate.as_ref().map(|rate| rate.clone() * since);
        let phase = member(&self.phase) + passed.as_ref().unwrap_or(since); // exact: the rate is 1
        Wave { amplitude: member(&self.amplitude), rate, first: angle(phase), later: None }
    }
}

impl<N: Number> Wave<N> {
    fn rounded(&self, bits: u32) -> Self {
        let Self { amplitude, rate, first, later } = self;
        let later = later.as_ref().map(|later| later.rounded(bits));
        let rate = rate.as_ref().map(|rate| rate.rounded(bits));
        Self { amplitude: amplitude.rounded(bits), rate, first: first.rounded(bits), later }
    }

    /// Phase of the harmonic at `h` after the departure.
    fn at(&self, h: &N) -> N {
        match &self.rate {
            None => self.first.at.clone() + h,
            Some(rate) => self.first.at.clone() + &(rate.clone() * h),
        }
    }

    fn sin(&self, h: &N) -> N {
        let at = self.at(h);
        let known = self.later.as_ref().and_then(|later| later.widened(&at));
        known.map_or_else(|| at.sin(), |angle| angle.sin)
    }

    fn cos(&self, h: &N) -> N {
        let at = self.at(h);
        let known = self.later.as_ref().and_then(|later| later.widened(&at));
        known.map_or_else(|| at.cos(), |angle| angle.cos)
    }

    /// `(sin, cos)` of the phase of the harmonic at `h` after the departure.
    pub fn sin_cos(&self, h: &N) -> (N, N) {
        let at = self.at(h);
        let Angle { sin, cos, .. } = match &self.later {
            Some(later) => later.around(at),
            None => Angle::new(at),
        };
        (sin, cos)
    }

    /// `r_k^n x`
    pub fn rated(&self, x: N, n: u32) -> N {
        match &self.rate {
            None => x,
            Some(rate) => (0..n).fold(x, |x, _| x * rate),
        }
    }

    /// `A_k r_k^n x`
    fn weighted(&self, x: N, n: u32) -> N {
        self.rated(x * &self.amplitude, n)
    }
}

impl<N: Number> Shaking<N> {
    /// The forcing, rounded outward to fewer bits.
    pub fn rounded(&self, bits: u32) -> Self {
        Self { waves: self.waves.iter().map(|wave| wave.rounded(bits)).collect() }
    }

    /// The same forcing, with sines known at `h`: those over parts that hold `h` follow from these.
    pub fn known_at(mut self, h: &N) -> Self {
        for wave in &mut self.waves {
            wave.later = Some(Angle::new(wave.at(h)));
        }
        self
    }

    /// The same forcing, with the later sines of `one` of its members.
    pub fn known_as(mut self, one: &Self) -> Self {
        for (wave, one) in self.waves.iter_mut().zip(&one.waves) {
            wave.later.clone_from(&one.later);
        }
        self
    }

    /// The later known phases of all harmonics, or none.
    pub fn known_later(&self) -> Vec<Angle<N>> {
        // exact: none is known
        self.waves.iter().map(|wave| wave.later.clone()).collect::<Option<_>>().unwrap_or_default()
    }

    fn sum(&self, of: impl Fn(&Wave<N>) -> N) -> N {
        self.waves.iter().map(of).reduce(|sum, x| sum + &x).expect("an excitation has a term")
    }

    /// `E` at the departure. **Equation** (1)
    pub fn first_place(&self) -> N {
        self.sum(|wave| wave.weighted(wave.first.sin.clone(), 0))
    }

    /// Upper bound of |E(t)| over all times \[length\].
    pub fn reach(&self) -> N {
        self.sum(|wave| wave.amplitude.clone())
    }

    /// `E(h) - E(0)`: the change of `E` from the departure to `h`.
    pub fn shift(&self, h: &N) -> N {
        self.sum(|wave| wave.weighted(wave.sin(h) - &wave.first.sin, 0))
    }

    /// `E'(h) - E'(0)`. The differences are taken for each harmonic, which keeps flights of small phase change accurate.
    pub fn velocity_change(&self, h: &N) -> N {
        self.sum(|wave| wave.weighted(wave.cos(h) - &wave.first.cos, 1))
    }

    /// `E'` at the departure.
    pub fn first_velocity(&self) -> N {
        self.sum(|wave| wave.weighted(wave.first.cos.clone(), 1))
    }

    /// `-E''` at `h`. **Equation** (10)
    pub fn acceleration(&self, h: &N) -> N {
        self.sum(|wave| wave.weighted(wave.sin(h), 2))
    }

    /// `-E''` at the departure.
    pub fn first_acceleration(&self) -> N {
        self.sum(|wave| wave.weighted(wave.first.sin.clone(), 2))
    }

    /// `-E'''` at `h`.
    pub fn jerk(&self, h: &N) -> N {
        self.sum(|wave| wave.weighted(wave.cos(h), 3))
    }

    /// Whether the box stands still.
    pub fn is_still(&self) -> bool {
        self.waves.iter().all(|wave| wave.amplitude.is_zero())
    }
}

impl Shaking {
    /// The forcing in doubles; `None` where whole periods cannot be taken off the phases.
    pub fn in_doubles(&self) -> Option<Shaking<Span>> {
        let of = |x: &Real| Span::of(x.enclosure());
        let wave = |wave: &Wave| {
            let Angle { at, sin, cos } = &wave.first;
            let at = at.rounded(PHASE_BITS); // X1: any number of bits encloses
            let turn = Real::pi(PHASE_BITS) * 2;
            let turns = at.over(&turn)?.middle().floor()?; // V1: any whole number of periods
            let first = Angle { at: of(&(at - &(turn * turns))), sin: of(sin), cos: of(cos) };
            Some(Wave { amplitude: of(&wave.amplitude), rate: wave.rate.as_ref().map(of), first, later: None })
        };
        Some(Shaking { waves: self.waves.iter().map(wave).collect::<Option<_>>()? })
    }
}
