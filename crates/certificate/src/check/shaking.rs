//! The forcing over a flight: equation (1) and its derivatives, summed over the harmonics.
//!
//! Phases are phases of the reference harmonic, `th = W t + tau`, which passes at the rate 1; harmonic `k` passes at the rate
//! `r_k = W_k/W`. With `s` the phase since the origin of an orbit and `f_k` the phase of harmonic `k` at that origin,
//! `E = sum A_k sin(f_k + r_k s)`, and `y'' = -E'' = sum A_k r_k^2 sin(f_k + r_k s)` between impacts.

use super::affine::Affine;
use impact_pair_exact::Real;

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
pub(crate) struct Shaking {
    pub waves: Vec<Wave>,
}

/// One harmonic over the flights of a set.
#[derive(Clone, Debug)]
pub(crate) struct Wave {
    pub amplitude: Real,
    /// `r_k`; `None` is 1.
    rate: Option<Real>,
    phase: Real,
    /// Sine and cosine of the phase at the departure.
    pub sin: Real,
    pub cos: Real,
}

impl Term {
    /// The harmonic for the members chosen by `member`, counted from the phase `since` after the origin.
    pub fn wave(&self, since: &Real, bits: u32, member: fn(&Affine) -> Real) -> Wave {
        let member = |x: &Affine| member(x).rounded(bits);
        let rate = self.rate.as_ref().map(member);
        let passed = rate.as_ref().map(|rate| rate.clone() * since);
        let phase = member(&self.phase) + passed.as_ref().unwrap_or(since); // exact: the rate is 1
        let (sin, cos) = phase.sin_cos();
        Wave { amplitude: member(&self.amplitude), rate, phase, sin, cos }
    }
}

impl Wave {
    fn rounded(&self, bits: u32) -> Self {
        let Self { amplitude, rate, phase, sin, cos } = self;
        let [amplitude, phase, sin, cos] = [amplitude, phase, sin, cos].map(|x| x.rounded(bits));
        Self { amplitude, rate: rate.as_ref().map(|rate| rate.rounded(bits)), phase, sin, cos }
    }

    /// Phase of the harmonic at `h` after the departure.
    fn at(&self, h: &Real) -> Real {
        match &self.rate {
            None => self.phase.clone() + h,
            Some(rate) => self.phase.clone() + &(rate.clone() * h),
        }
    }

    /// `(sin, cos)` of the phase of the harmonic at `h` after the departure.
    pub fn sin_cos(&self, h: &Real) -> (Real, Real) {
        self.at(h).sin_cos()
    }

    /// `r_k^n x`
    pub fn rated(&self, x: Real, n: u32) -> Real {
        match &self.rate {
            None => x,
            Some(rate) => (0..n).fold(x, |x, _| x * rate),
        }
    }

    /// `A_k r_k^n x`
    fn weighted(&self, x: Real, n: u32) -> Real {
        self.rated(x * &self.amplitude, n)
    }
}

impl Shaking {
    /// The forcing, rounded outward to fewer bits.
    pub fn rounded(&self, bits: u32) -> Self {
        Self { waves: self.waves.iter().map(|wave| wave.rounded(bits)).collect() }
    }

    fn sum(&self, of: impl Fn(&Wave) -> Real) -> Real {
        self.waves.iter().map(of).reduce(|sum, x| sum + &x).expect("an excitation has a term")
    }

    /// `E` at the departure. **Equation** (1)
    pub fn first_place(&self) -> Real {
        self.sum(|wave| wave.weighted(wave.sin.clone(), 0))
    }

    /// Upper bound of |E(t)| over all times \[length\].
    pub fn reach(&self) -> Real {
        self.sum(|wave| wave.amplitude.clone())
    }

    /// `E(h) - E(0)`: the change of `E` from the departure to `h`.
    pub fn shift(&self, h: &Real) -> Real {
        self.sum(|wave| wave.weighted(wave.at(h).sin() - &wave.sin, 0))
    }

    /// `E'(h) - E'(0)`. The differences are taken for each harmonic, which keeps flights of small phase change accurate.
    pub fn velocity_change(&self, h: &Real) -> Real {
        self.sum(|wave| wave.weighted(wave.at(h).cos() - &wave.cos, 1))
    }

    /// `E'` at the departure.
    pub fn first_velocity(&self) -> Real {
        self.sum(|wave| wave.weighted(wave.cos.clone(), 1))
    }

    /// `-E''` at `h`. **Equation** (10)
    pub fn acceleration(&self, h: &Real) -> Real {
        self.sum(|wave| wave.weighted(wave.at(h).sin(), 2))
    }

    /// `-E''` at the departure.
    pub fn first_acceleration(&self) -> Real {
        self.sum(|wave| wave.weighted(wave.sin.clone(), 2))
    }

    /// `-E'''` at `h`.
    pub fn jerk(&self, h: &Real) -> Real {
        self.sum(|wave| wave.weighted(wave.at(h).cos(), 3))
    }

    /// Whether the box stands still.
    pub fn is_still(&self) -> bool {
        self.waves.iter().all(|wave| wave.amplitude.is_zero())
    }
}
