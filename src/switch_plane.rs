//! The switch-planes Sigma+ and Sigma-, in the three coordinates of equations (18)-(23).
//!
//! An impact is a point of the switch-plane of its wall. The paper draws it as `(t mod 2 pi/W, y')` (18)-(21), as
//! `(x, x')` and as `(t mod 2 pi/W, x')` (22), (23), with `x = y + E(t)` the absolute displacement.

use crate::exact::Enclosure;
use crate::number::Number;
use crate::pair::Wall;

/// An impact in all the coordinates of the switch-planes, velocities just before the impact.
///
/// **Enclosure**: each coordinate holds that of the true impact. **Units**: time \[time\], length \[length\].
#[derive(Clone, Debug, PartialEq)]
pub struct SwitchPoint {
    /// The wall: Sigma- for the left one, Sigma+ for the right one.
    pub wall: Wall,
    /// `t mod 2 pi/W`; the lower bound lies in `[0, 2 pi/W)`, the upper one may lie beyond when the impact may be at 0.
    pub time: Enclosure,
    /// `y'`, relative to the box. **Equations** (18)-(21)
    pub relative_velocity: Enclosure,
    /// `x = y + E(t)`. **Equation** (22)
    pub displacement: Enclosure,
    /// `x' = y' + E'(t)`. **Equations** (22), (23)
    pub absolute_velocity: Enclosure,
}

/// `x/d` and `x'` in gap widths per forcing period, of an impact on `wall` while the box is at `E/d` with `E'`.
///
/// **Equations** (22), (23), without units.
pub fn absolute<N: Number + Copy>((shift, speed): (N, N), wall: Wall, velocity: N) -> (N, N) {
    (shift - N::from_f64(0.5 * wall.sign()), velocity + speed)
}
