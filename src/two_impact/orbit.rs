//! An orbit of two impacts in N cycles in the units of the scene, with all that is proved of it.

use std::cmp::Ordering;

use crate::exact::Enclosure;
use crate::pair::Wall;

use super::motion::Motion;
use super::stability::Spectrum;
use crate::exact::Real;
use crate::periodic::Stability;

/// One of the two impacts.
#[derive(Clone, Debug)]
pub struct Impact {
    /// The wall.
    pub wall: Wall,
    /// `W t + tau` in `[0, 2 pi)` \[rad\]; bounds that hold 0 reach a little below it.
    pub phase: Enclosure,
    /// The relative velocity `y'` just before the impact \[length/time\].
    pub velocity: Enclosure,
}

/// A periodic orbit of two impacts in N cycles.
///
/// **Enclosure**: for every choice of the parameters, one orbit lies within the bounds.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// In time order, from the impact on the left wall.
    pub impacts: [Impact; 2],
    /// `th1 - th0`, from the left impact to the right one \[rad\].
    pub spacing: Enclosure,
    /// `A` \[length\]
    pub amplitude: Enclosure,
    /// `d` \[length\]
    pub gap: Enclosure,
    /// Whether no other orbit with two impacts in N cycles lies within the bounds.
    pub is_unique: bool,
    /// Whether no wall is touched between the impacts: proved, refuted, or not decided.
    pub is_physical: Option<bool>,
    /// Whether it is its own mirror image.
    pub is_symmetric: bool,
    /// The sign of `sin th0`: solid or dashed in figures 10 and 11.
    pub sine: Option<Ordering>,
    /// The trace of the Jacobian (A.7) over a period.
    pub trace: Enclosure,
    /// Its determinant, `e^4`.
    pub determinant: Enclosure,
    /// Real and imaginary parts of its eigenvalues (38).
    pub eigenvalues: [[Enclosure; 2]; 2],
    /// Stability.
    pub stability: Stability,
}

/// What a motion is measured in.
pub(super) struct Units {
    /// `A`
    pub amplitude: Real,
    /// `W`
    pub frequency: Real,
    /// The bits that bounds are rounded to, outward.
    pub shown: u32,
}

impl Orbit {
    /// `None` if the speed may be 0.
    pub(super) fn of(motion: &Motion, units: &Units, is_unique: bool) -> Option<Self> {
        let Spectrum { trace, determinant, eigenvalues, stability } = Spectrum::of(motion)?;
        let Units { amplitude, frequency, shown } = units;
        let velocity = &motion.speed * amplitude * frequency;
        // Digits count from the unit, not from a greater number's first digit.
        let of = |x: &Real| {
            let beyond = x.enclosure().mag().top().map_or(0, |top| top.clamp(0, 4096) as u32); // shown
            x.enclosure().rounded(shown + beyond)
        };
        let impact =
            |wall, phase: &Real, velocity: &Real| Impact { wall, phase: of(&reduced(phase)), velocity: of(velocity) };
        Some(Self {
            impacts: [
                impact(Wall::Left, &motion.theta0, &-&velocity),
                impact(Wall::Right, &motion.theta1(), &velocity),
            ],
            spacing: of(&motion.spacing),
            amplitude: of(amplitude),
            gap: of(&(&motion.parameters.ratio * amplitude)),
            is_unique,
            is_physical: motion.is_physical(),
            is_symmetric: motion.is_symmetric,
            sine: motion.left.0.sign(),
            trace: of(&trace),
            determinant: of(&determinant),
            eigenvalues: eigenvalues.map(|parts| parts.map(|part| of(&part))),
            stability,
        })
    }

    /// The impacts in time order from the one on this wall.
    pub fn impacts_from(&self, wall: Wall) -> [&Impact; 2] {
        let [left, right] = &self.impacts;
        match wall {
            Wall::Left => [left, right],
            Wall::Right => [right, left],
        }
    }
}

/// A phase modulo `2 pi`, in `[0, 2 pi)` but for bounds that hold 0.
fn reduced(phase: &Real) -> Real {
    let turn = Real::pi(phase.bits()) * 2;
    // exact: any whole number is taken off
    let turns = phase.over(&turn).and_then(|turns| turns.ends()[1].floor()).expect("a phase of a few turns");
    phase - turn * turns
}
