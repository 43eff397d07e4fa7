//! Events of an orbit in the units of the scene.

use super::{Graze, Impact, Orbit, Rest, Touch};
use crate::exact::Enclosure;
use crate::impact::finite;
use crate::number::Ball;
#[cfg(all(feature = "inari", target_feature = "fma"))]
use crate::number::inari::enclosing;
use crate::switch_plane::{SwitchPoint, absolute};

impl Orbit {
    /// Bounds of the time \[time\] and velocity \[length/time\] of an impact of this orbit; another orbit's impact has other units.
    pub fn bounds(&self, impact: &Impact) -> (Enclosure, Enclosure) {
        let (phase, velocity) = impact.enclosures();
        (self.clock.time(impact.turns, &phase), self.clock.velocity(&velocity))
    }

    /// The bounds of [`bounds`](Self::bounds) as intervals of the package inari, in a build with the feature `inari`.
    ///
    /// **Enclosure**: they hold the true time \[time\] and velocity \[length/time\], except with [`Arithmetic::Float`](super::Arithmetic::Float).
    ///
    /// ```
    /// use impact_pair::Scene;
    /// use impact_pair::orbit::Orbit;
    /// use impact_pair::inari::{Interval, const_interval};
    /// let scene = Scene::parse(r#"
    ///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
    ///     pair = { gap = 9.42497, restitution = 0.5 }
    ///     start = { time = 0, wall = "left", velocity = -12.56636 }
    /// "#)?;
    /// let mut orbit = Orbit::of(&scene, scene.settings())?;
    /// let mut before = const_interval!(0.0, 0.0);
    /// while let Some(impact) = orbit.next() {
    ///     let (time, velocity): (Interval, Interval) = orbit.intervals(&impact);
    ///     let frequency = (time - before).recip();
    ///     assert!(before.strict_precedes(time) && frequency.wid() < 1e-5 && !velocity.contains(0.0));
    ///     before = time;
    /// }
    /// # Ok::<(), impact_pair::Error>(())
    /// ```
    #[cfg(all(feature = "inari", target_feature = "fma"))]
    pub fn intervals(&self, impact: &Impact) -> (inari::Interval, inari::Interval) {
        let (time, velocity) = self.bounds(impact);
        (enclosing(&time), enclosing(&velocity))
    }

    /// The impact as a point of its switch-plane. **Equations** (18)-(23)
    pub fn switch_point(&self, impact: &Impact) -> SwitchPoint {
        let shaking = self.shaking(impact.turns, impact.phase);
        let (displacement, velocity) = absolute(shaking, impact.wall, impact.velocity);
        let (time, relative_velocity) = impact.enclosures();
        SwitchPoint {
            wall: impact.wall,
            time: self.clock.time_in_period(&time),
            relative_velocity: self.clock.velocity(&relative_velocity),
            displacement: self.clock.length(&finite(displacement)),
            absolute_velocity: self.clock.velocity(&finite(velocity)),
        }
    }

    /// `E/d` and `E'` in gap widths per forcing period.
    pub(super) fn shaking(&self, turns: i64, phase: Ball) -> (Ball, Ball) {
        let [shift, speed, _] = self.engine.given.shaken.displacement(turns, phase);
        (shift, speed)
    }

    /// Bounds of the beginning of a rest \[time\].
    pub fn rest_time(&self, rest: &Rest) -> Enclosure {
        self.clock.time(rest.at.turns, &rest.at.phase)
    }

    /// Bounds of the distance by which a graze misses its wall \[length\] and of the speed of a touch \[length/time\].
    pub fn graze_bounds(&self, graze: &Graze) -> (Enclosure, Enclosure) {
        (self.clock.length(&graze.distance), self.clock.velocity(&graze.speed))
    }

    /// Bounds of the time of a graze or a release \[time\], exact if possible.
    pub fn touch_time(&self, touch: &Touch) -> Enclosure {
        self.exact_time(touch.turns, &touch.phase)
    }

    /// Time of a phase, exact where the phase is.
    pub(super) fn exact_time(&self, turns: i64, phase: &Enclosure) -> Enclosure {
        match phase.mid_rad() {
            (exact, 0.0) => self.clock.time_of(turns, exact),
            _ => self.clock.time(turns, phase),
        }
    }
}
