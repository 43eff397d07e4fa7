//! The impact map over sets: images hold the next impacts of their members, Jacobians the quotients of their differences.

use crate::crossings::motion::Motion;
use crate::flights::judge::{holds, reduced, same_wall};
use crate::random::{Random, cases};
use impact_pair::impact_map::{Image, ImpactMap, States};
use impact_pair::number::Ball;
use impact_pair::{Harmonic, ImpactPair, pair};
use impact_pair_truth::{Contact, Shaken, State, Wall, float};
use rug::Float;

/// A pair with `W = 2 pi`, `tau = 0` and `d = 1`, in which times are phases and velocities are without units.
struct Pair {
    map: ImpactMap,
    shaken: Shaken,
}

impl Pair {
    fn new(amplitude: f64, restitution: f64) -> Self {
        let exact = |x: f64| format!("{x:?}").parse().unwrap();
        let harmonic = Harmonic::new(exact(amplitude), "2*pi".parse().unwrap(), exact(0.0)).unwrap();
        let pair = ImpactPair::new(harmonic, exact(1.0), exact(restitution)).unwrap();
        Self { map: ImpactMap::new(&pair).unwrap(), shaken: reduced(float(amplitude), restitution) }
    }

    /// The impacts that follow one at this phase, with this velocity before it, as far as they are told.
    fn impacts(&self, wall: Wall, phase: f64, velocity: f64, count: usize) -> Vec<Contact> {
        let before = Contact { time: float(phase), wall, velocity_before: float(velocity) };
        let mut motion = Motion::new(&self.shaken, State::after(&self.shaken, &before));
        (0..count).map_while(|_| motion.contact(&mut Vec::new()).ok()?).collect()
    }
}

fn wall(random: &mut Random) -> (pair::Wall, Wall) {
    if random.below(2) == 0 { (pair::Wall::Left, Wall::Left) } else { (pair::Wall::Right, Wall::Right) }
}

/// The phase and the velocity of a set's impact, as numbers without whole forcing periods.
fn phase(states: &States, time: &Float) -> Float {
    float(time) - states.turns()
}

fn assert_holds(image: &Image, contact: &Contact, case: &str) {
    let states = &image.states;
    assert!(same_wall(states.wall(), contact.wall), "{case}: {image:?}, but {contact:?}");
    assert!(holds(states.phase(), &phase(states, &contact.time)), "{case}: {image:?}, but {contact:?}");
    assert!(holds(states.velocity(), &contact.velocity_before), "{case}: {image:?}, but {contact:?}");
}

/// Sets of every width around random states, their members at random, by the reference simulator in 256 bits.
#[test]
fn images_hold_the_impacts_of_their_members() {
    let mut random = Random::seeded(34);
    let (mut decided, count) = (0, cases(600));
    for _ in 0..count {
        let restitution = [0.0, 1.0, random.uniform(0.3, 0.95)][random.below(3) as usize];
        let pair = Pair::new(random.magnitude(-2.0, 1.0), restitution);
        let (ours, theirs) = wall(&mut random);
        let towards = if ours == pair::Wall::Left { -1.0 } else { 1.0 };
        let centre = [random.uniform(-0.5, 0.5), towards * random.magnitude(-3.0, 2.0)];
        let radius = [random.magnitude(-12.0, -2.0), random.magnitude(-12.0, -2.0) * centre[1].abs()];
        let states = pair.map.states(ours, Ball::new(centre[0], radius[0]), Ball::new(centre[1], radius[1])).unwrap();
        let impacts = 1 + random.below(3) as usize;
        let Ok(image) = pair.map.iterate(&states, impacts) else { continue };
        decided += 1;
        for _ in 0..4 {
            let member = [0, 1].map(|i| centre[i] + random.uniform(-1.0, 1.0) * radius[i] * (1.0 - 1e-9));
            let case = format!("{ours:?} {centre:?} {radius:?} e = {restitution}, {impacts} impacts from {member:?}");
            let contacts = pair.impacts(theirs, member[0], member[1], impacts);
            assert_eq!(contacts.len(), impacts, "{case}: {image:?}");
            assert_holds(&image, &contacts[impacts - 1], &case);
        }
    }
    assert!(3 * decided > count, "{decided} of {count}");
}

/// By the mean value theorem a quotient of differences is a value of the derivative between; (A.7) is that of one impact.
#[test]
fn jacobians_hold_quotients_of_differences() {
    let mut random = Random::seeded(34);
    let mut decided = 0;
    for _ in 0..cases(200) {
        let pair = Pair::new(random.uniform(0.1, 2.0), random.uniform(0.3, 1.0));
        let centre = [random.uniform(-0.5, 0.5), -random.uniform(0.5, 6.0)];
        let radius = 1e-7;
        let states =
            pair.map.states(pair::Wall::Left, Ball::new(centre[0], radius), Ball::new(centre[1], radius)).unwrap();
        let Ok(image) = pair.map.iterate(&states, 2) else { continue };
        decided += 1;
        for column in 0..2 {
            let ends = [-1.0, 1.0].map(|side| {
                let mut member = centre;
                member[column] += side * 0.5 * radius;
                (member[column], pair.impacts(Wall::Left, member[0], member[1], 2).pop().unwrap())
            });
            let [(x0, from), (x1, to)] = &ends;
            let step = float(x1) - float(x0);
            let quotients = [float(&to.time - &from.time), float(&to.velocity_before - &from.velocity_before)];
            for (row, difference) in quotients.into_iter().enumerate() {
                let quotient = difference / &step;
                let entry = image.jacobian[row][column];
                assert!(holds(entry, &quotient), "{centre:?} [{row}][{column}]: {entry:?}, but {quotient:.20}");
            }
        }
    }
    assert!(decided > cases(200) / 2, "{decided}");
}

/// One orbit and its mirror image half a forcing period later are one in phase and speed.
#[test]
fn mirrored_states_have_mirrored_images() {
    let pair = Pair::new(0.8, 0.5);
    let start = |wall, phase, velocity| pair.map.states(wall, Ball::exact(phase), Ball::exact(velocity)).unwrap();
    let left = pair.map.iterate(&start(pair::Wall::Left, 0.1, -3.0), 5).unwrap();
    let right = pair.map.iterate(&start(pair::Wall::Right, -0.4, 3.0), 5).unwrap();
    assert_ne!(left.states.wall(), right.states.wall());
    let whole = |x: Ball| x + Ball::exact(-x.mid().floor());
    let [one, other] = [left, right].map(|image| {
        let [phase, speed] = image.states.mirrored();
        [whole(phase), speed]
    });
    for (a, b) in one.into_iter().zip(other) {
        assert!((a.mid() - b.mid()).abs() <= a.rad() + b.rad(), "{a:?} {b:?}");
    }
    let jacobians = [left.jacobian_of_speeds(pair::Wall::Left), right.jacobian_of_speeds(pair::Wall::Right)];
    for (a, b) in jacobians[0].iter().flatten().zip(jacobians[1].iter().flatten()) {
        assert!((a.mid() - b.mid()).abs() <= a.rad() + b.rad(), "{a:?} {b:?}");
    }
}

#[test]
fn states_that_do_not_arrive_are_refused() {
    let map = Pair::new(1.0, 0.5).map;
    let refused = |wall, phase: f64, velocity| map.states(wall, Ball::exact(phase), velocity).unwrap_err().to_string();
    assert!(refused(pair::Wall::Left, 0.0, Ball::exact(1.0)).contains("velocity"));
    assert!(refused(pair::Wall::Right, 0.0, Ball::new(1.0, 2.0)).contains("velocity"));
    assert!(refused(pair::Wall::Left, 1.5, Ball::exact(-1.0)).contains("phase"));
    assert!(refused(pair::Wall::Left, f64::NAN, Ball::exact(-1.0)).contains("phase"));
    assert!(refused(pair::Wall::Left, 0.0, Ball::exact(f64::NAN)).contains("velocity"));
}
