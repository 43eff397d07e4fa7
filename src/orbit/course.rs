//! The motion between the events of an orbit, as drawn in figures.

use super::{Impact, Orbit, Touch};
use crate::exact::Enclosure;
use crate::impact::finite;
use crate::number::Ball;
use crate::pair::Wall;
use crate::shaken::{Location, State};

/// A flight of an orbit over the whole set of its states, enclosed in doubles, under any number of harmonics.
///
/// **Equations** (11), (12): `y = offset + c h - E`, `y' = c - E'`, `h` after the phase that the flight is measured from.
#[derive(Clone, Copy, Debug)]
pub struct Course {
    /// Phase that the flight is measured from: whole forcing periods since the clock's origin, and the rest.
    turns: i64,
    phase: Ball,
    offset: Ball,
    /// `c`
    drift: Ball,
}

/// The state of the ball at some time, in both frames.
///
/// **Enclosure**: each coordinate holds that of the true motion. **Units**: time \[time\], length \[length\].
#[derive(Clone, Debug, PartialEq)]
pub struct CoursePoint {
    /// `t`
    pub time: Enclosure,
    /// `y`, relative to the box. **Equation** (11)
    pub displacement: Enclosure,
    /// `y'`. **Equation** (12)
    pub velocity: Enclosure,
    /// `x = y + E(t)`
    pub absolute_displacement: Enclosure,
    /// `x' = y' + E'(t)`
    pub absolute_velocity: Enclosure,
    /// `y''`. **Equation** (10); 0 at rest
    pub acceleration: Enclosure,
    /// `x'' = y'' + E''(t)`: 0 between impacts, the box's at rest
    pub absolute_acceleration: Enclosure,
}

/// The forces on the ball: none in flight; at rest the contact force.
#[derive(Clone, Copy)]
enum Forces {
    Flies,
    Rests,
}

/// `y` on a wall, in gaps.
fn on(wall: Wall) -> Ball {
    Ball::exact(-0.5 * wall.sign())
}

impl Orbit {
    /// Flight from the requested start, or from the start of a shadowed orbit, and its phase: whole forcing periods and the rest.
    pub fn first_course(&self) -> (Course, i64, Ball) {
        let State { turns, phase, velocity, .. } = self.initial;
        let course = match self.initial.place {
            Location::Wall(wall) => self.leaving(wall, turns, phase, self.engine.pair.rebound_of(velocity)),
            Location::Inside(height) => self.course(turns, phase, height - Ball::exact(0.5), velocity),
        };
        (course, turns, phase)
    }

    /// Flight that begins with an impact. **Equation** (15)
    pub fn course_after(&self, impact: &Impact) -> Course {
        self.leaving(impact.wall, impact.turns, impact.phase, self.engine.pair.rebound_of(impact.velocity))
    }

    /// Flight that ends with an impact, measured backwards from the impact: it holds both continuations of a graze before.
    pub fn course_before(&self, impact: &Impact) -> Course {
        self.leaving(impact.wall, impact.turns, impact.phase, impact.velocity)
    }

    /// Flight that begins with a release, with zero velocity.
    pub fn course_from(&self, release: &Touch) -> Course {
        let (turns, phase) = release.at();
        self.leaving(release.wall, turns, phase, Ball::exact(0.0))
    }

    /// The flight from a wall.
    fn leaving(&self, wall: Wall, turns: i64, phase: Ball, velocity: Ball) -> Course {
        self.course(turns, phase, on(wall), velocity)
    }

    /// The flight from a height `y` in gaps.
    fn course(&self, turns: i64, phase: Ball, height: Ball, velocity: Ball) -> Course {
        let (shift, speed) = self.shaking(turns, phase);
        Course { turns, phase, offset: height + shift, drift: velocity + speed }
    }

    /// Point of a flight at a phase: `turns` forcing periods since the clock's origin, and the rest; `None` beyond doubles.
    pub fn course_point(&self, course: &Course, turns: i64, phase: Ball) -> Option<CoursePoint> {
        let (displacement, velocity) = self.along(course, turns, phase);
        self.point((turns, phase), displacement, velocity, Forces::Flies)
    }

    /// States of the ball on its wall, just before and just after an impact. **Equation** (15)
    pub fn impact_points(&self, impact: &Impact) -> Option<[CoursePoint; 2]> {
        let Impact { wall, turns, phase, velocity, .. } = *impact;
        let on_wall = |velocity| self.point((turns, phase), on(wall), velocity, Forces::Flies);
        Some([on_wall(velocity)?, on_wall(self.engine.pair.rebound_of(velocity))?])
    }

    /// Point of the motion at a phase while the ball rests on `wall`.
    pub fn rest_point(&self, wall: Wall, turns: i64, phase: Ball) -> Option<CoursePoint> {
        self.point((turns, phase), on(wall), Ball::exact(0.0), Forces::Rests)
    }

    /// State in the units of the scene, from forcing periods and gaps.
    fn point(
        &self,
        (turns, phase): (i64, Ball),
        displacement: Ball,
        velocity: Ball,
        forces: Forces,
    ) -> Option<CoursePoint> {
        let [shift, speed, pull] = self.engine.given.shaken.displacement(turns, phase);
        let still = Ball::exact(0.0);
        let (acceleration, absolute_acceleration) = match forces {
            Forces::Flies => (pull, still),
            Forces::Rests => (still, -pull),
        };
        let clock = &self.clock;
        Some(CoursePoint {
            time: clock.time(turns, &phase.enclosure()?),
            displacement: clock.length(&displacement.enclosure()?),
            velocity: clock.velocity(&velocity.enclosure()?),
            absolute_displacement: clock.length(&(displacement + shift).enclosure()?),
            absolute_velocity: clock.velocity(&(velocity + speed).enclosure()?),
            acceleration: clock.acceleration(&acceleration.enclosure()?),
            absolute_acceleration: clock.acceleration(&absolute_acceleration.enclosure()?),
        })
    }

    /// Half the gap `d/2`: where the walls are \[length\].
    pub fn wall_displacement(&self) -> Enclosure {
        self.clock.length(&finite(Ball::exact(0.5)))
    }

    /// `y` in gaps and `y'` in gap widths per forcing period, of the whole set of states. **Equations** (11), (12)
    fn along(&self, course: &Course, turns: i64, phase: Ball) -> (Ball, Ball) {
        let Course { turns: from, phase: start, offset, drift } = *course;
        let (shift, speed) = self.shaking(turns, phase);
        // Lemma N1; exact below 2^53, and flights are at most 2^52 forcing periods long.
        let time = Ball::exact((turns - from) as f64) + (phase - start);
        (offset + drift * time - shift, drift - speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Enclosure;

    fn meets(a: &Enclosure, b: &Enclosure) -> bool {
        a.intersection(b).is_some()
    }

    fn orbit(arithmetic: &str) -> Orbit {
        let scene = crate::tests::scene("figure-14");
        Orbit::of(&scene, crate::orbit::Settings { arithmetic: arithmetic.parse().unwrap(), ..scene.settings() })
            .unwrap()
    }

    #[test]
    fn each_flight_leads_from_impact_to_impact() {
        let mut orbit = orbit("interval");
        let (mut course, _, _) = orbit.first_course();
        for _ in 0..60 {
            let impact = orbit.next().unwrap();
            let (time, velocity) = orbit.bounds(&impact);
            let wall = orbit.wall_displacement();
            let wall = if impact.wall == Wall::Right { wall } else { wall.negated() };
            let switch = orbit.switch_point(&impact);
            let [before, after] = orbit.impact_points(&impact).unwrap();
            assert!(before.displacement == wall && before.velocity == velocity && after.displacement == wall);
            let half = Enclosure::from_f64_bounds(-0.5, -0.5).unwrap();
            assert!(meets(&after.velocity, &velocity.mul(&half, 200)));
            let left = orbit.course_point(&orbit.course_after(&impact), impact.turns, impact.phase).unwrap();
            assert!(meets(&after.velocity, &left.velocity));
            for course in [course, orbit.course_before(&impact)] {
                let point = orbit.course_point(&course, impact.turns, impact.phase).unwrap();
                assert!(meets(&point.time, &time) && meets(&point.displacement, &wall), "impact {}", impact.index);
                assert!(meets(&point.velocity, &velocity), "impact {}", impact.index);
                assert!(meets(&point.absolute_displacement, &switch.displacement));
                assert!(meets(&point.absolute_velocity, &switch.absolute_velocity));
                let (low, high) = point.displacement.to_f64_bounds();
                assert!(high - low < 1e-3, "impact {}: {low} {high}", impact.index);
            }
            course = orbit.course_after(&impact);
        }
    }

    #[test]
    fn between_impacts_the_ball_is_inside_the_gap() {
        let mut orbit = orbit("interval");
        let (mut course, mut turns, phase) = orbit.first_course();
        let mut from = phase.mid();
        for _ in 0..40 {
            let impact = orbit.next().unwrap();
            let to = (impact.turns - turns) as f64 + impact.phase.mid();
            for step in 1..16 {
                let at = from + (to - from) * f64::from(step) / 16.0;
                let whole = at.round();
                let phase = Ball::exact(at - whole);
                let forward = orbit.course_point(&course, turns + whole as i64, phase).unwrap();
                let backward = orbit.course_point(&orbit.course_before(&impact), turns + whole as i64, phase).unwrap();
                assert!(meets(&forward.displacement, &backward.displacement));
                let (low, high) = forward.displacement.to_f64_bounds();
                assert!(low > -4.712485 && high < 4.712485, "impact {}: {low} {high}", impact.index);
            }
            (course, turns, from) = (orbit.course_after(&impact), impact.turns, impact.phase.mid());
        }
    }
}
