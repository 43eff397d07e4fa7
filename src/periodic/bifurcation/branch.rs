//! The branch of a window in floating point: orbits of given traces between its ends. Non-rigorous.

use super::super::chained::OneHarmonic;
use super::super::determinant;
use super::family::Family;
use super::ring::Ring;
use super::solve::newton;
use super::system::{System, Traced};
use crate::mapping::Word;

/// Places of the stations of a curve over an eigenvalue, in parts of the way from the inner one to an end.
const STATIONS: [f64; 5] = [1.0, 0.75, 0.5, 0.25, 0.0];
/// The eigenvalue at which the curve between begins, if that is far from where both are one.
const FIRST_EIGENVALUE: f64 = 0.2;
/// The trace at the orbit itself, which lies about the middle of a window.
const INNER_TRACE: f64 = -0.4;

/// An orbit near which a window may be, in floating point.
#[derive(Clone, Debug)]
pub struct WindowSeed {
    /// Walls of the orbit's impacts.
    pub word: Word,
    /// Number of forcing periods of the orbit.
    pub cycles: u32,
    /// `true` if the orbit is its own mirror image after half of these periods.
    pub is_mirrored: bool,
    /// Phases of the impacts in forcing periods, of one half of them if `is_mirrored`.
    pub phases: Vec<f64>,
    /// `A/d`, or `e` where that varies.
    pub parameter: f64,
}

/// Orbits with the phases and the parameter, by their eigenvalue.
pub(super) struct Branch {
    /// The orbits at [`STATIONS`], towards the middle, of each end.
    pub ends: [Vec<(f64, Vec<f64>)>; 2],
    /// Orbits from the last station of the first end to that of the second end.
    pub between: Vec<Vec<f64>>,
    /// An orbit in the middle of the window.
    pub inner: Vec<f64>,
}

impl Branch {
    /// Branch through a seed, in floating point.
    pub fn through(seed: &WindowSeed, ring: &Ring, floats: &Family<OneHarmonic, f64>) -> Option<Self> {
        let q = determinant(&floats.pair(seed.parameter).restitution, ring.unknowns());
        // proposes: far from where both eigenvalues are one, sqrt(q)
        let inner = if q.sqrt() < 0.25 { FIRST_EIGENVALUE.max(2.0 * q.sqrt()) } else { 0.5 * (1.0 + q.sqrt()) };
        let solved = |trace: f64, x: Vec<f64>| newton(&System::Traced(Traced { ring, trace }), floats, x);
        let start = solved(0.0, [&seed.phases[..], &[seed.parameter]].concat())?;
        let towards = |sign: f64| -> Option<Vec<(f64, Vec<f64>)>> {
            let mut x = start.clone();
            let mut all = Vec::new();
            for part in STATIONS.iter().rev() {
                // At the end exactly 1.
                let mu = sign * (1.0 - (1.0 - inner) * (1.0 - part));
                x = solved(mu + q / mu, x)?;
                all.push((mu, x.clone()));
            }
            all.reverse();
            Some(all)
        };
        let ends = [towards(1.0)?, towards(-1.0)?];
        let inner = solved(INNER_TRACE, start.clone()).unwrap_or_else(|| start.clone()); // proposes
        let between = vec![ends[0].last()?.1.clone(), start, ends[1].last()?.1.clone()];
        Some(Self { ends, between, inner })
    }
}
