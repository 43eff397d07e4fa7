//! The paper's closed forms over the plane of an atlas: folds and pitchforks of equispaced motions (66)-(69), and the places of figures 12-17.

use std::f64::consts::PI;

use impact_pair::exact::{Exact, Real};
use impact_pair::json::SceneDocument;
use impact_pair::scene::{Key, Range};
use impact_pair::two_impact::closed_forms::grazing_angle;

use crate::sweep::value;

/// Points of a curve, and bits of a phase on it.
const POINTS: u32 = 200;
const BITS: u32 = 64;
/// Numbers N of forcing periods in which the motions have two impacts; N is odd.
const CYCLES: [u32; 3] = [1, 3, 5];

/// Number, `A/d` and `e` of the paper's figures.
const FIGURES: [(u32, f64, f64); 6] = [
    (12, 1.0 / 9.42497, 0.5),
    (13, 2.0 / 9.42497, 0.5),
    (14, 8.0 / 9.42497, 0.5),
    (15, 2.0, 0.8),
    (16, 10.0, 0.8),
    (17, 1.0, 0.8),
];

/// A bifurcation of the equispaced motion with two impacts in N forcing periods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bifurcation {
    /// The fold, at which the orbit appears together with a saddle.
    Fold,
    /// The pitchfork, at which the orbit loses its symmetry.
    Pitchfork,
}

/// The amplitude, the gap and the restitution coefficient of a plane in which two of them vary.
pub struct Parameters {
    keys: [Key; 2],
    amplitude: f64,
    gap: f64,
    restitution: f64,
}

impl Parameters {
    /// The parameters of a scene with one harmonic, if the axes are two of them; `None` where another parameter varies.
    pub fn of(scene: &SceneDocument, axes: &[Range; 2]) -> Option<Self> {
        let keys = axes.each_ref().map(|axis| axis.key());
        let is_one = |key: &Key| matches!(key, Key::Amplitude(_) | Key::Gap | Key::Restitution);
        let [amplitude] = &scene.excitation.amplitude[..] else { return None };
        let (gap, restitution) = (value(&scene.gap.0), value(&scene.restitution.0));
        keys.iter().all(is_one).then_some(Self { keys, amplitude: value(&amplitude.0), gap, restitution })
    }

    /// The place on both axes of `A/d = alpha` and `e = restitution`; if both lengths vary, `gap` is the gap, else one length is the scene's own.
    fn place(&self, alpha: f64, restitution: f64, gap: f64) -> [f64; 2] {
        let varies = |key: fn(&Key) -> bool| self.keys.iter().any(key);
        let amplitude = if varies(|key| matches!(key, Key::Amplitude(_))) { alpha * gap } else { self.amplitude };
        let gap = if varies(|key| matches!(key, Key::Amplitude(_))) { gap } else { amplitude / alpha };
        self.keys.map(|key| match key {
            Key::Amplitude(_) => amplitude,
            Key::Gap => gap,
            _ => restitution,
        })
    }

    /// The points of a bifurcation over the ranges of both axes.
    pub fn curve(&self, kind: Bifurcation, cycles: u32, ranges: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
        let free = self.keys.iter().position(|key| *key == Key::Restitution);
        let part = |[low, high]: [f64; 2], i: u32| low + (high - low) * f64::from(i) / f64::from(POINTS);
        let at = |i: u32| match free {
            Some(axis) => {
                let restitution = part(ranges[axis], i);
                (restitution, self.gap)
            }
            // Both lengths vary: a line through the origin.
            None => {
                let axis = self.keys.iter().position(|key| *key == Key::Gap).unwrap_or_default();
                (self.restitution, part(ranges[axis], i))
            }
        };
        let points = (0..=POINTS).map(at).filter(|(e, _)| (0.0..1.0).contains(e));
        points.filter_map(|(e, gap)| Some(self.place(alpha(kind, cycles, e)?, e, gap))).collect()
    }

    /// The figures in the ranges of both axes, with their numbers; figures at one place share it.
    pub fn figures(&self, ranges: [[f64; 2]; 2]) -> Vec<(u32, [f64; 2])> {
        let is_free = self.keys.contains(&Key::Restitution);
        let is_own = |e: f64| is_free || e == self.restitution; // drawn
        let inside = |[x, y]: [f64; 2]| [x, y].iter().zip(ranges).all(|(at, [low, high])| (low..=high).contains(at));
        let places = FIGURES.iter().filter(|(_, _, e)| is_own(*e));
        places
            .map(|&(number, alpha, e)| (number, self.place(alpha, e, self.gap)))
            .filter(|(_, at)| inside(*at))
            .collect()
    }
}

/// The curves that are drawn.
pub fn all() -> impl Iterator<Item = (Bifurcation, u32)> {
    CYCLES.into_iter().flat_map(|cycles| [(Bifurcation::Fold, cycles), (Bifurcation::Pitchfork, cycles)])
}

/// `A/d` at a bifurcation, N = `cycles`: with `kappa = (1 + e)/(1 - e)` and `K = N pi kappa`, `d/A = 2 sin th0 + K cos th0`. An eigenvalue
/// is 1 at `tan th0 = (2/(N pi))/kappa`, the fold, and at `tan th0 = -(2/(N pi)) kappa`, the pitchfork; `None` where the motion at
/// the pitchfork is virtual, as it grazes the near wall first.
pub fn alpha(kind: Bifurcation, cycles: u32, e: f64) -> Option<f64> {
    let (kappa, half) = ((1.0 + e) / (1.0 - e), 2.0 / (f64::from(cycles) * PI));
    let theta = match kind {
        Bifurcation::Fold => (half / kappa).atan(),
        Bifurcation::Pitchfork => -(half * kappa).atan(),
    };
    let inverse = 2.0 * theta.sin() + f64::from(cycles) * PI * kappa * theta.cos();
    let is_virtual = theta < 0.0 && grazes(theta, e)?;
    (inverse > 0.0 && !is_virtual).then(|| 1.0 / inverse)
}

/// Whether a motion that starts at a phase below 0 touches the wall of its departure before the other wall. Lemma W3
fn grazes(theta: f64, e: f64) -> Option<bool> {
    let greatest = grazing_angle(&Real::of(&Exact::parse(&e.to_string()).ok()?, BITS))?;
    let (greatest, _) = greatest.enclosure().mid_rad();
    Some(-theta >= greatest) // drawn
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The forms of `A/d`: `1/sqrt(4 + K^2)` at the fold, and the form in `K` and `kappa` at the pitchfork, whose window begins at e = 0.0867.
    #[test]
    fn curves_are_those_of_the_closed_forms() {
        for (e, cycles) in [(0.2f64, 1u32), (0.5, 1), (0.5, 3), (0.8, 5)] {
            let (kappa, n) = ((1.0 + e) / (1.0 - e), f64::from(cycles) * PI);
            let k = n * kappa;
            let fold = 1.0 / (4.0 + k * k).sqrt();
            let pitchfork = (1.0 + 4.0 * kappa * kappa / (n * n)).sqrt() / (k * (1.0 - 4.0 / (n * n)));
            assert!((alpha(Bifurcation::Fold, cycles, e).unwrap() / fold - 1.0).abs() < 1e-12);
            assert!((alpha(Bifurcation::Pitchfork, cycles, e).unwrap() / pitchfork - 1.0).abs() < 1e-12);
        }
        assert!(alpha(Bifurcation::Pitchfork, 1, 0.085).is_none() && alpha(Bifurcation::Pitchfork, 1, 0.088).is_some());
    }
}
