//! The kernel's sine and cosine, and our own intervals and balls of them, against `inari`'s sine, which is MPFR's.
//!
//! The library is built with an `inari` that has no sine; only here is there one, to judge ours.

use crate::random::{Random, cases};
use impact_pair::inari::Interval;
use impact_pair::number::kernel::{self, SIN_COS_ERROR};
use impact_pair::number::{Ball, Number, Wave};

fn between(inf: f64, sup: f64) -> Interval {
    Interval::try_from((inf, sup)).unwrap()
}

/// Phases below half a forcing period, where `2 pi u` loses nothing that counts: at quarter periods and next to them, and anywhere.
fn phase(random: &mut Random) -> f64 {
    let quarter = random.below(5) as f64 / 4.0 - 0.5;
    match random.below(4) {
        0 => quarter,
        1 => (quarter + random.magnitude(-16.0, 0.0)).min(0.5),
        2 => random.magnitude(-30.0, -1.0),
        _ => random.uniform(-0.5, 0.5),
    }
}

/// The sine and the cosine of `2 pi u`, by MPFR: one unit of the angle wide.
fn judge(u: Interval) -> [Interval; 2] {
    let angle = Interval::TAU * u;
    [angle.sin(), angle.cos()]
}

#[test]
fn the_kernel_keeps_its_bound() {
    let mut random = Random::seeded(31);
    for _ in 0..cases(50_000) {
        let u = phase(&mut random);
        let (sin, cos) = kernel::sin_cos(u);
        for (ours, theirs) in [sin, cos].into_iter().zip(judge(between(u, u))) {
            let error = between(-SIN_COS_ERROR, SIN_COS_ERROR);
            assert!(!(between(ours, ours) + error).disjoint(theirs), "{u:e}: {ours:e} {theirs:?}");
        }
    }
}

/// Both hold the true range: neither may lie beside the other, and ours is no wider than theirs by more than its error.
#[test]
fn waves_of_intervals_are_those_of_mpfr() {
    let mut random = Random::seeded(31);
    for _ in 0..cases(50_000) {
        let inf = phase(&mut random);
        let width = if random.below(2) == 0 { random.magnitude(-16.0, 0.0) } else { random.uniform(0.0, 2.0) };
        let u = between(inf, inf + width);
        let (sin, cos) = u.wave();
        for (ours, theirs) in [sin, cos].into_iter().zip(judge(u)) {
            // An end of an angle below 16 is up to 2^-47 wide, and its sine as much.
            let slack = between(-32.0 * f64::EPSILON, 32.0 * f64::EPSILON);
            assert!(ours.subset(theirs + slack) && theirs.subset(ours + slack), "{u:?}: {ours:?} {theirs:?}");
        }
    }
}

#[test]
fn waves_of_balls_hold_those_of_mpfr() {
    let mut random = Random::seeded(31);
    for _ in 0..cases(50_000) {
        let ball = Ball::new(phase(&mut random), random.magnitude(-16.0, 0.0));
        let u = Interval::from(ball);
        let (sin, cos) = ball.wave();
        // At both ends and the middle: each is a member.
        for member in [u.inf().next_up(), ball.mid(), u.sup().next_down()] {
            for (ours, theirs) in [sin, cos].into_iter().zip(judge(Interval::from_f64(member))) {
                assert!(!Interval::from(ours).disjoint(theirs), "{ball:?} {member:e}");
            }
        }
    }
}
