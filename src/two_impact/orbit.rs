//! An orbit of two impacts in N cycles in the units of the scene, with all that is proved of it.

use std::cmp::Ordering;

use impact_pair_document::MeasuredImpact;

use crate::exact::{Enclosure, Real};
use crate::pair::Wall;
use crate::periodic::{Eigenvalue, MeasuredOrbit};
use crate::units::Units;

use super::motion::Motion;
use super::stability::Spectrum;

/// A periodic orbit of two impacts in N cycles.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// As any periodic orbit, from the impact on the left wall on.
    pub measured: MeasuredOrbit,
    /// `th1 - th0`, from the left impact to the right one \[rad\].
    pub spacing: Enclosure,
    /// `A` \[length\]
    pub amplitude: Enclosure,
    /// `d` \[length\]
    pub gap: Enclosure,
    /// The sign of `sin th0`: solid or dashed in figures 10 and 11.
    pub sine: Option<Ordering>,
}

impl Orbit {
    /// Orbit of a motion in amplitudes and `A W`, its bounds rounded outward to `shown` bits; `None` if the speed may be 0.
    pub(super) fn of(motion: &Motion, units: &Units<Real>, shown: u32, unique: bool) -> Option<Self> {
        let Spectrum { trace, determinant, eigenvalues, stability } = Spectrum::of(motion)?;
        let velocity = &motion.speed * &units.velocity;
        // Digits count from the unit, not from a greater number's first digit.
        let of = |x: &Real| {
            let beyond = x.enclosure().mag().top().map_or(0, |top| top.clamp(0, 4096) as u32); // shown
            x.enclosure().rounded(shown + beyond)
        };
        let impact = |wall, phase: &Real, velocity: &Real| MeasuredImpact {
            wall,
            phase: of(&reduced(phase)),
            velocity: of(velocity),
            turn: None,
            cycle: None,
        };
        let measured = MeasuredOrbit {
            period: 1,
            impacts: vec![
                impact(Wall::Left, &motion.theta0, &-&velocity),
                impact(Wall::Right, &motion.theta1(), &velocity),
            ],
            unique,
            physical: motion.is_physical(),
            symmetric: Some(motion.is_symmetric),
            // T13: the walls differ
            times: Some(1),
            trace: of(&trace),
            determinant: of(&determinant),
            eigenvalues: eigenvalues.map(|[re, im]| Eigenvalue { re: of(&re), im: of(&im) }),
            stability,
        };
        Some(Self {
            measured,
            spacing: of(&motion.spacing),
            amplitude: of(&units.length),
            gap: of(&(&motion.parameters.ratio * &units.length)),
            sine: motion.left.0.sign(),
        })
    }
}

/// A phase modulo `2 pi`, in `[0, 2 pi)` but for bounds that hold 0.
fn reduced(phase: &Real) -> Real {
    let turn = Real::pi(phase.bits()) * 2;
    // exact: any whole number is taken off
    let turns = phase.over(&turn).and_then(|turns| turns.ends()[1].floor()).expect("a phase of a few forcing periods");
    phase - turn * turns
}
