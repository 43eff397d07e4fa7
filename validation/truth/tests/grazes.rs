//! Past a graze that doubles cannot tell from a miss (Lemma G1): the orbit that misses by 10^-18 of the gap and the one
//! that hits by as much lie in the same enclosures.

use crate::common::scene::{At, Scene, Value, holds};
use crate::common::{Random, cases};
use impact_pair::orbit::{Impact, Progress};
use impact_pair_truth::{Contact, Wall};
use rug::Float;
use rug::float::Constant;

const BITS: u32 = 512;

/// A scene near a graze: with W = 2 pi and drift pi A a ball that starts at `y0` with `y' = -pi A` comes nearest to the right wall at
/// `t = 5/6`, where `y = y0 + A (5 pi/6 + sqrt(3)/2)`. This one passes the wall by `depth` (or misses it); with
/// `mirrored` the left wall.
fn scene(amplitude: f64, restitution: &str, depth: &str, mirrored: bool) -> Scene {
    let float = |x: f64| Float::with_val(BITS, x);
    let a = float(amplitude);
    let reach = float(5.0) / 6u32 * Float::with_val(BITS, Constant::Pi) + float(3.0).sqrt() / 2u32;
    let depth = Float::with_val(BITS, Float::parse(depth).expect("a decimal"));
    let sign = if mirrored { -1 } else { 1 };
    let position = (float(0.5) - reach * &a + depth) * sign;
    let velocity = -Float::with_val(BITS, Constant::Pi) * &a * sign;
    let decimal = |x: &Float| Value(x.to_string_radix(10, Some(120)), None);
    Scene {
        amplitude: decimal(&a),
        omega: "2*pi".into(),
        tau: if mirrored { "pi" } else { "0" }.into(),
        gap: "1".into(),
        restitution: restitution.into(),
        time: "0".into(),
        velocity: decimal(&velocity),
        at: At::Inside(decimal(&position)),
    }
}

/// The impacts after the graze, and how the orbit tells their bounds.
fn after_graze(scene: &Scene, impacts: u64) -> (impact_pair::orbit::Orbit, Vec<Impact>, bool) {
    let mut orbit = scene.orbit(impacts).expect("a scene");
    let (mut found, mut grazed) = (Vec::new(), false);
    loop {
        match orbit.advance() {
            Progress::Impact(impact) if grazed => found.push(impact),
            Progress::Impact(_) => return (orbit, found, false),
            Progress::Graze(graze) => {
                let (low, high) = orbit.touch_time(&graze.at).to_f64_bounds();
                assert!(low <= 5.0 / 6.0 && 5.0 / 6.0 <= high && high - low < 1e-4, "[{low}, {high}]");
                grazed = true;
            }
            Progress::Retraced(_) => {}
            Progress::Rest(_) | Progress::Release(_) | Progress::Ended => return (orbit, found, grazed),
        }
    }
}

#[test]
fn both_continuations_lie_in_what_follows_a_graze() {
    let mut random = Random::seeded(701);
    let (mut judged, mut grazes) = (0, 0);
    for index in 0..cases(200) {
        let amplitude = random.uniform(0.02, 0.26);
        let restitution = ["0", "0.3", "0.8", "1"][index % 4];
        let twins = ["1e-18", "-1e-18"].map(|depth| scene(amplitude, restitution, depth, index % 8 >= 4));
        let hit_wall = if index % 8 >= 4 { Wall::Left } else { Wall::Right };
        for library in &twins {
            let (orbit, found, grazed) = after_graze(library, 6);
            assert!(grazed, "no graze: {library:?}");
            grazes += 1;
            for (twin, hits) in twins.iter().zip([true, false]) {
                let truth: Vec<Contact> = twin.truth(BITS, [0.0; 5], found.len() + usize::from(hits));
                // The impact that the graze may be is not listed.
                let rest = if hits {
                    assert!(truth[0].wall == hit_wall && truth[0].velocity_before.to_f64().abs() < 1e-6);
                    &truth[1..]
                } else {
                    &truth[..]
                };
                for (impact, contact) in found.iter().zip(rest) {
                    let (time, velocity) = orbit.bounds(impact);
                    let same_wall = (impact.wall == impact_pair::pair::Wall::Left) == (contact.wall == Wall::Left);
                    let held = holds(&time, &contact.time) && holds(&velocity, &contact.velocity_before);
                    assert!(same_wall && held, "{impact:?} is not {contact:?}: {twin:?}");
                    judged += 1;
                }
            }
        }
    }
    println!("{grazes} grazes passed, {judged} impacts after them judged");
    assert!(judged > 2 * grazes);
}
